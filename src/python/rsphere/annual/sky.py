"""Luminance of patches of the sky, and the sun, hour by hour, from rows of a weather file.

The patches are those of reinhart.cal: Tregenza's 145, each divided into MF x MF (Reinhart), here the factor, and the ground as number 0.

- Perez, Seals, Michalsky 1993, "All-weather model for sky luminance distribution": how the sky's light is distributed
- Perez, Ineichen, Seals, Michalsky, Stewart 1990, "Modeling daylight availability and irradiance components from direct and global
  irradiance": clearness, brightness, luminous efficacies
"""
import math
from typing import NamedTuple

import numpy as np
from .sun import air_mass, day_of_year, sun_position

# By clearness, from overcast to clear: a1 to a4 of the first parameter, then those of b, c, d, e (1993, table 1).
LUMINANCE = np.array("""
  1.3525 -.2576 -.2690 -1.4366  -.7670 .0007 1.2734 -.1233  2.8000 .6004 1.2375 1.0000  1.8734 .6297 .9738 .2809  .0356 -.1246 -.5718 .9938
  -1.2219 -.7730 1.4148 1.1016  -.2054 .0367 -3.9128 .9156  6.9750 .1774 6.4477 -.1239  -1.5798 -.5081 -1.7812 .1080  .2624 .0672 -.2190 -.4285
  -1.1000 -.2515 .8952 .0156  .2782 -.1812 -4.5000 1.1766  24.7219 -13.0812 -37.7000 34.8438  -5.0000 1.5218 3.9229 -2.6204  -.0156 .1597 .4199 -.5562
  -.5484 -.6654 -.2672 .7117  .7234 -.6219 -5.6812 2.6297  33.3389 -18.3000 -62.2500 52.0781  -3.5000 .0016 1.1477 .1062  .4659 -.3296 -.0876 -.0329
  -.6000 -.3566 -2.5000 2.3250  .2937 .0496 -5.6812 1.8415  21.0000 -4.7656 -21.5906 7.2492  -3.5000 -.1554 1.4062 .3988  .0032 .0766 -.0656 -.1294
  -1.0156 -.3670 1.0078 1.4051  .2875 -.5328 -3.8500 3.3750  14.0000 -.9999 -7.1406 7.5469  -3.4000 -.1078 -1.0750 1.5702  -.0672 .4016 .3017 -.4844
  -1.0000 .0211 .5025 -.5119  -.3000 .1922 .7023 -1.6317  19.0000 -5.0000 1.2438 -1.9094  -4.0000 .0250 .3844 .2656  1.0468 -.3788 -2.4517 1.4656
  -1.0500 .0289 .4260 .3590  -.3250 .1156 .7781 .0025  31.0625 -14.5000 -46.1148 55.3750  -7.2312 .4050 13.3500 .6234  1.5000 -.6426 1.8564 .5636
""".split(), float).reshape(8, 5, 4)
CLEARNESS = [1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2]  # where one class ends and the next begins
# lm/W by these classes: diffuse light a + b W + c cos(zenith) + d ln(brightness), the sun a + b W + c exp(5.73 zenith - 5) + d
# brightness; W: precipitable water, cm (1990, table 4).
DIFFUSE = [(97.24, -0.46, 12.0, -8.91), (107.22, 1.15, 0.59, -3.95), (104.97, 2.96, -5.53, -8.77), (102.39, 5.59, -13.95, -13.9),
           (100.71, 5.94, -22.75, -23.74), (106.42, 3.83, -36.15, -28.83), (141.88, 1.9, -53.24, -14.03), (152.23, 0.35, -45.27, -7.98)]
DIRECT = [(57.2, -4.55, -2.98, 117.12), (98.99, -3.46, -1.21, 12.38), (109.83, -4.9, -1.71, -8.81), (110.34, -5.84, -1.99, -4.56),
          (106.36, -3.97, -1.75, -6.16), (107.19, -1.25, -1.51, -26.73), (105.75, 0.77, -1.26, -34.44), (101.18, 1.58, -1.1, -8.29)]
WATER = math.exp(0.07 * 11 - 0.075)  # at a dew point of 11 degrees
SOLAR_CONSTANT = 1367  # W/m2
GROUND = 0.2  # its reflectance, beyond the ground of the scene


def patches(factor):
    """Directions (unit; x east, y north) to the middles of the patches, and their solid angles (sr)."""
    step = math.pi / 2 / (7 * factor + 0.5)
    directions, solid_angles = [(0, 0, -1)], [2 * math.pi]
    for row in range(7 * factor):
        count = (30, 30, 24, 24, 18, 12, 6)[row // factor] * factor
        altitude = step * (row + 0.5)
        for i in range(count):
            azimuth = 2 * math.pi * i / count
            directions.append((math.cos(altitude) * math.sin(azimuth), math.cos(altitude) * math.cos(azimuth), math.sin(altitude)))
            solid_angles.append(2 * math.pi * (math.sin(step * (row + 1)) - math.sin(step * row)) / count)
    return np.array(directions + [(0, 0, 1)]), np.array(solid_angles + [2 * math.pi * (1 - math.cos(step / 2))])


def relative_luminances(parameters, to_sun, up):
    """Of points of the sky at an angle to_sun (radians) from the sun, up: sine of their altitude."""
    a, b, c, d, e = parameters
    return (1 + a * np.exp(b / np.maximum(up, 0.01))) * (1 + c * np.exp(d * to_sun) + e * np.cos(to_sun) ** 2)


def parameters_of(kind, zenith, brightness):
    p = LUMINANCE[kind]
    a, b, c, d, e = (x[0] + x[1] * zenith + brightness * (x[2] + x[3] * zenith) for x in p)
    if kind == 0:
        c = math.exp((brightness * (p[2][0] + p[2][1] * zenith)) ** p[2][2]) - p[2][3]
        d = p[3][2] + brightness * p[3][3] - math.exp(brightness * (p[3][0] + p[3][1] * zenith))
    return a, b, c, d, e


class Daylight(NamedTuple):
    """Of each hour of a list: what comes from the patches of the sky, and from the sun."""

    luminance: np.ndarray  # (hours, patches), cd/m2, without the sun
    sun: np.ndarray  # lx on a surface that faces it
    to_sun: np.ndarray  # (hours, 3)
    diffuse: np.ndarray  # lx of the sky on an unobstructed horizontal surface
    dark: np.ndarray  # whether the file has light that is left out: the sun is down, or there is no diffuse light


def light_of(row, altitude):
    """lx of the sky on a horizontal surface and of the sun on one that faces it, and the parameters of the sky's distribution."""
    month, day, _, direct, diffuse = row
    zenith = min(math.pi / 2, max(math.radians(3), math.pi / 2 - altitude))
    extraterrestrial = SOLAR_CONSTANT * (1 + 0.033 * math.cos(2 * math.pi * day_of_year(int(month), int(day)) / 365))
    brightness = min(0.6, max(0.01, diffuse * air_mass(altitude) / extraterrestrial))
    clearness = ((diffuse + direct) / diffuse + 1.041 * zenith**3) / (1 + 1.041 * zenith**3)
    kind = sum(clearness >= limit for limit in CLEARNESS)
    a, b, c, d = DIFFUSE[kind]
    by_sky = diffuse * (a + b * WATER + c * math.cos(zenith) + d * math.log(brightness))
    a, b, c, d = DIRECT[kind]
    by_sun = direct * max(0.0, a + b * WATER + c * math.exp(5.73 * zenith - 5) + d * brightness)
    if 1 <= kind <= 4:
        brightness = max(brightness, 0.2)  # below, the model's luminances may be negative (Perez 1993)
    return by_sky, by_sun, parameters_of(kind, zenith, brightness)


def daylight_of(rows, place, factor):
    """The Daylight of rows of read_weather(). All is 0 by night."""
    directions, solid_angles = patches(factor)
    projected = solid_angles * np.maximum(0, directions[:, 2])
    n = len(rows)
    found = Daylight(np.zeros((n, len(solid_angles)), np.float32), np.zeros(n), np.tile([0.0, 0, -1], (n, 1)), np.zeros(n), np.zeros(n, bool))
    for i, row in enumerate(rows):
        altitude, azimuth = sun_position(int(row[0]), int(row[1]), row[2], *place)
        if altitude <= 0 or row[4] <= 0:
            found.dark[i] = row[3] + row[4] > 0
            continue
        by_sky, by_sun, parameters = light_of(row, altitude)
        sun = np.array([math.cos(altitude) * math.sin(azimuth), math.cos(altitude) * math.cos(azimuth), math.sin(altitude)])
        to_sun = np.arccos(np.clip(directions @ sun, -1, 1))
        luminance = np.maximum(0, relative_luminances(parameters, to_sun, directions[:, 2]))
        luminance[0] = 0
        if not luminance @ projected > 0:  # of weather that cannot be; an even sky, of which other hours may warn
            luminance[1:] = 1
        luminance *= by_sky / (luminance @ projected)
        luminance[0] = GROUND * (by_sky + by_sun * math.sin(altitude)) / math.pi
        found.luminance[i], found.sun[i], found.to_sun[i], found.diffuse[i] = luminance, by_sun, sun, by_sky
    return found


def with_sun(daylight, factor):
    """The luminances of the patches with the sun spread over the four around it, as RADIANCE's gendaymtx does."""
    directions, solid_angles = patches(factor)
    luminance = daylight.luminance.copy()
    for i in np.flatnonzero(daylight.sun):
        to_sun = np.arccos(np.clip(directions @ daylight.to_sun[i], -1, 1))
        nearest = np.argpartition(to_sun[1:], 4)[:4] + 1
        share = 1 / (to_sun[nearest] ** 2 + 0.1 * solid_angles[nearest])
        luminance[i, nearest] += daylight.sun[i] * share / share.sum() / solid_angles[nearest]
    return luminance
