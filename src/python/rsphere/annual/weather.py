"""Hours of a weather file: .epw, or .wea as RADIANCE's gendaymtx reads it."""
import csv
import re
from typing import NamedTuple

from ..fault import fault, lines_of, number, whole
from .sun import MONTHS

LARGEST_IRRADIANCE = 1500  # W/m2; the sun has at most 1415 outside of the atmosphere, in January
SHORTEST = 0.9  # h, between rows
MISSING = re.compile(r" *9999\.?0* *")  # instead of an irradiance of an .epw
HEADER = 8  # lines of an .epw before the first hour
WEA_PLACE = (("latitude", 1), ("longitude", -1), ("time_zone", -1))  # and the degrees north or east that 1 is
WEA_HEADER = ("place", *(name for name, _ in WEA_PLACE), "site_elevation", "weather_data_file_units")


class Weather(NamedTuple):
    hours: list  # rows of month, day, hour (the middle), direct normal and diffuse horizontal irradiance (W/m2)
    missing: int  # how many more the file marks as missing
    place: list  # latitude, longitude, meridian of the time zone: degrees north and east
    lines: list = []  # of the hours in the file


def hour_of(file, line, date, middle, irradiances):
    """A row of Weather. middle: how long the middle of the hour is before the time in the file."""
    month = whole(date[0], file, line, "the month", 1, 12)
    day = whole(date[1], file, line, "the day", 1, 29 if month == 2 else MONTHS[month - 1])
    hour = number(date[2], file, line, "the hour", 2 * middle, 24) - middle
    direct = number(irradiances[0], file, line, "the direct normal irradiance", 0, LARGEST_IRRADIANCE)
    diffuse = number(irradiances[1], file, line, "the diffuse horizontal irradiance", 0, LARGEST_IRRADIANCE)
    return [month, day, hour, direct, diffuse]


def add_hour(hours, lines, file, line, row):
    """Adds a row that must be later than the last, and its line."""
    if hours and row[:3] <= hours[-1][:3]:
        raise fault(file, line, "the hour is not after the one before it; a file has one row for each hour of one year, in their order")
    if hours and row[:2] == hours[-1][:2] and row[2] - hours[-1][2] < SHORTEST:
        raise fault(file, line, f"is {row[2] - hours[-1][2]:.2g} h after the row before it; each row must be an hour: take means")
    hours.append(row)
    lines.append(line)


def place_of(file, latitude, longitude, zone):
    """Each is its word, its line, and the degrees north or east that 1 is."""
    kinds = (("the latitude", latitude, 90), ("the longitude", longitude, 180), ("the time zone", zone, 225))
    return [
        unit * number(word, file, line, what, -most / abs(unit), most / abs(unit)) for what, (word, line, unit), most in kinds
    ]


def read_epw(file, lines):
    place = next(csv.reader(lines[:1], skipinitialspace=True))
    if len(place) < 9:
        raise fault(file, 1, f"LOCATION has {len(place)} fields instead of 10")
    hours, at, missing = [], [], 0
    early = next((line for line, text in enumerate(lines[1:HEADER], 2) if text[:1].isdigit()), None)
    if early:
        raise fault(file, early, f"is an hour, but an .epw has {HEADER} lines before its first hour")
    for line, text in enumerate(lines[HEADER:], HEADER + 1):
        row = next(csv.reader([text], skipinitialspace=True), [])
        if row and len(row) < 16:
            raise fault(file, line, f"an hour has at least 16 fields, up to the diffuse horizontal irradiance, not {len(row)}")
        if row and any(MISSING.fullmatch(word) for word in row[14:16]):
            missing += 1
        elif row:
            add_hour(hours, at, file, line, hour_of(file, line, row[1:4], 0.5, row[14:16]))
    if len(at) > 1 and lines[-1] and len(row) < len(next(csv.reader([lines[at[0] - 1]]))):
        raise fault(file, line, f"has {len(row)} fields, fewer than the rows before it: the file is cut off")
    return hours, missing, place_of(file, (place[6], 1, 1), (place[7], 1, 1), (place[8], 1, 15)), at


def read_wea(file, lines):
    header, hours, at = {}, [], []
    for line, words in enumerate((text.split() for text in lines), 1):
        if len(words) > 1 and words[0] in WEA_HEADER and not hours:
            if words[0] in header:
                raise fault(file, line, f"{words[0]} is in line {header[words[0]][1]} already")
            header[words[0]] = words[1], line
        elif words:
            lacks = [name for name in WEA_HEADER if name not in header]
            if lacks:
                raise fault(file, line, f"the header lacks {lacks[0]}; the weather is an .epw, or a .wea as gendaymtx reads it")
            if len(words) != 5:
                raise fault(file, line, f"an hour is month, day, hour, direct normal and diffuse irradiance, not {len(words)} words")
            add_hour(hours, at, file, line, hour_of(file, line, words[:3], 0, words[3:]))
    if hours and header["weather_data_file_units"][0] != "1":
        raise fault(file, header["weather_data_file_units"][1], "weather_data_file_units must be 1: direct normal and diffuse, W/m2")
    return hours, 0, place_of(file, *((*header[name], unit) for name, unit in WEA_PLACE)) if hours else [], at


def read_weather(path):
    """The Weather of an .epw or .wea. Raises Fault."""
    lines = lines_of(path)
    if lines[0].lstrip().startswith("LOCATION") and not lines[0].startswith("LOCATION,"):
        raise fault(path, 1, "the fields of an .epw are separated by commas alone: LOCATION,")
    hours, missing, place, at = (read_epw if lines[0].startswith("LOCATION,") else read_wea)(path, lines)
    if not hours:
        raise fault(path, None, "has no hours with irradiance" if missing else "has no hours")
    return Weather(hours, missing, place, at)
