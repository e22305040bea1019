"""Where the sun stands."""
import math

MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)


def day_of_year(month, day):
    """1 to 365. 29 February has the number of 1 March, as in gensky and gendaymtx; that of 28 February would be as far from its sun."""
    return sum(MONTHS[: month - 1]) + day


def sun_position(month, day, hour, latitude, longitude, zone):
    """Altitude, and azimuth from north towards east (radians), at an hour of local standard time. Latitude, longitude and the
    meridian of the time zone in degrees north and east. By the formulas of RADIANCE's gensky before 2019 (IES RP-21, 1984)."""
    j = day_of_year(month, day)
    declination = 0.4093 * math.sin(2 * math.pi * (j - 81) / 368)
    equation = 0.170 * math.sin(4 * math.pi * (j - 80) / 373) - 0.129 * math.sin(2 * math.pi * (j - 8) / 355)
    turn = math.pi * (hour + equation + (longitude - zone) / 15 - 12) / 12
    north = math.radians(latitude)
    up = math.sin(north) * math.sin(declination) + math.cos(north) * math.cos(declination) * math.cos(turn)
    east = -math.cos(declination) * math.sin(turn)
    northwards = math.cos(north) * math.sin(declination) - math.sin(north) * math.cos(declination) * math.cos(turn)
    return math.asin(max(-1.0, min(1.0, up))), math.atan2(east, northwards)


def air_mass(altitude):
    """Relative to that at the zenith: Kasten 1965."""
    return 1 / (math.sin(altitude) + 0.15 * (math.degrees(altitude) + 3.885) ** -1.253)
