"""Daylight of a year at sensors: sDA and UDI, from a weather file and coefficients of the sky."""
import math
import sys

import numpy as np

from ..command import Options
from ..fault import fault
from .sky import read_weather, sky_matrix

TEXT = """\
The weather is .wea or .epw. Coefficients are what rcontrib -I -faf -y N wrote for the bins of patches.cal, or of
reinhart.cal, and an even sky of radiance 1. Writes da.txt and udi.txt, for each sensor the share (%) of the hours from 8 to 18 h of all days
with at least 300 lx, and with 100 to 3000 lx, and prints what the room has."""

VISIBLE = np.array([0.265, 0.670, 0.065], np.float32)  # shares of red, green and blue in what the eye sees
HOURS_OF_YEAR, HOURS_OF_LEAP_YEAR = 8760, 8784


def read_coefficients(path):
    """Sensors by bins, and factor of patches.cal. Raises Fault."""
    try:
        with open(path, "rb") as file:
            header, _, numbers = file.read().partition(b"\n\n")
    except OSError as error:
        raise fault(path, None, f"cannot be read: {error.strerror}") from None
    words = dict(line.strip().split(b"=", 1) for line in header.split(b"\n") if b"=" in line)
    if words.get(b"FORMAT") != b"float":
        raise fault(path, None, "has no header with FORMAT=float: coefficients are the output of rcontrib -faf")
    shape = []
    for name in (b"NROWS", b"NCOLS", b"NCOMP"):
        word = words.get(name, b"")
        if not word.isdigit() or not 0 < len(word) < 10 or not int(word):
            raise fault(path, None, f"its header lacks {name.decode()}=, a whole number: coefficients are the output of rcontrib -y N")
        shape.append(int(word))
    sensors, bins, channels = shape
    if channels != 3:
        raise fault(path, None, f"has coefficients of NCOMP={channels}, not of red, green and blue (3)")
    factor = round(math.sqrt(max(1, (bins - 2) / 144)))
    if bins != 144 * factor * factor + 2:
        raise fault(path, None, f"has {bins} bins, but patches.cal and reinhart.cal have 146, 578, 1298, 2306 and so on")
    if len(numbers) != 4 * sensors * bins * channels:
        raise fault(path, None, f"has {len(numbers)} bytes of coefficients, not {4 * sensors * bins * channels}")
    order = ">" if words.get(b"BigEndian") == b"1" else "<"
    coefficients = np.frombuffer(numbers, order + "f4").reshape(shape)
    if not np.isfinite(coefficients).all():
        raise fault(path, None, "has a coefficient that is not a finite number")
    return coefficients.astype(np.float32) @ VISIBLE, factor


def say(file, text):
    print(f"rsphere-annual: warning - {file}: {text}", file=sys.stderr)


def save(name, values):
    try:
        np.savetxt(name, values, "%.2f")
    except OSError as error:
        raise fault(name, None, f"cannot be written: {error.strerror}") from None


def main():
    parser = Options("", TEXT)
    parser.add_argument("--weather", required=True, metavar="FILE", help="the hours of a year")
    parser.add_argument("--coefficients", required=True, metavar="FILE", help="what sensors get of each patch of the sky")
    given = parser.parse_args()
    coefficients, factor = read_coefficients(given.coefficients)
    weather = read_weather(given.weather)
    hours, missing, _ = weather
    if len(hours) + missing > HOURS_OF_LEAP_YEAR:
        raise fault(given.weather, None, f"has {len(hours) + missing} rows, more than a year has hours: each must be an hour")
    sky = sky_matrix(weather, factor, lambda row: 8 < row[2] < 18)
    if not len(sky):
        raise fault(given.weather, None, "has no hour from 8 to 18 h")
    if missing:
        say(given.weather, f"{missing} of {len(hours) + missing} hours have no irradiance (9999) and are left out")
    if len(hours) + missing < HOURS_OF_YEAR:
        say(given.weather, f"has {len(hours) + missing} hours, fewer than a year's {HOURS_OF_YEAR}")
    illuminance = coefficients @ sky.T  # lx: sensors by hours
    autonomy = (illuminance >= 300).mean(axis=1)
    useful = ((illuminance >= 100) & (illuminance <= 3000)).mean(axis=1)
    save("da.txt", 100 * autonomy)
    save("udi.txt", 100 * useful)
    print(f"{illuminance.shape[0]} sensors, {illuminance.shape[1]} hours from 8 to 18 h")
    for lux in (300, 500, 750):
        enough = (illuminance >= lux).mean(axis=1) >= 0.5
        print(f"sDA {lux} lx / 50%: {100 * enough.mean():.1f}% of the sensors")
    print(f"300 lx or more: {100 * autonomy.mean():.1f}% of the hours, mean of the sensors")
    print(f"UDI, 100 to 3000 lx: {100 * useful.mean():.1f}% of the hours, mean of the sensors")
    print(f"Light of the year: {illuminance.mean(axis=0).sum() / 1e6:.3f} Mlx h, mean of the sensors")
