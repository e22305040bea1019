"""Where the sun stands."""
import math

MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
LEAP = 0.2  # days: weather of a year names no year, and this is nearest to the sun of 2006 to 2025 (.09 degrees rms, .24 at most)
TILT = math.radians(23.439)  # of the earth's axis


def day_of_year(month, day):
    return sum(MONTHS[: month - 1]) + min(day, MONTHS[month - 1])


def sun_position(month, day, hour, latitude, longitude, zone):
    """Altitude, and azimuth from north towards east (radians), at an hour of local standard time. Latitude, longitude and the
    meridian of the time zone in degrees north and east. By the low-precision formulas of the Astronomical Almanac (Michalsky 1988)."""
    days = day_of_year(month, day) - 1 + (hour - zone / 15) / 24 + LEAP
    mean, anomaly = math.radians(280.460 + 0.9856474 * days), math.radians(357.528 + 0.9856003 * days)
    along = mean + math.radians(1.915 * math.sin(anomaly) + 0.020 * math.sin(2 * anomaly))
    declination = math.asin(math.sin(TILT) * math.sin(along))
    ascension = math.atan2(math.cos(TILT) * math.sin(along), math.cos(along))
    turn = math.pi * (hour + (longitude - zone) / 15 - 12) / 12 + math.remainder(mean - ascension, 2 * math.pi)
    north = math.radians(latitude)
    up = math.sin(north) * math.sin(declination) + math.cos(north) * math.cos(declination) * math.cos(turn)
    east = -math.cos(declination) * math.sin(turn)
    northwards = math.cos(north) * math.sin(declination) - math.sin(north) * math.cos(declination) * math.cos(turn)
    return math.asin(max(-1.0, min(1.0, up))), math.atan2(east, northwards)


def air_mass(altitude):
    """Relative to that at the zenith: Kasten 1965."""
    return 1 / (math.sin(altitude) + 0.15 * (math.degrees(altitude) + 3.885) ** -1.253)
