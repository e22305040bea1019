"""Reads IES LM-63 files (1986 to 2019)."""
import os

import numpy as np

from ..fault import Fault, Numbers, fault, lines_of
from .intensities import Photometry, checked_angles, checked_candela, unfolded
from .radiant import UNITS, unit_in

MOST_ANGLES = 3601  # a tenth of a degree, all round
MOST_VALUES = 1_000_000  # intensities; by half degrees all round there are 260,000
MOST_TILT_FACTOR = 5  # lamps that are tilted have about as much light; percentages would be larger
FOOT = 0.3048
PLANES = 2.0  # degrees between the C planes that stand for types A and B, and at most between their angles of gamma
PARTS = 4  # of gamma between the angles of types A and B: a beam of 15 degrees in steps of 2.5 has its flux within .1%
LONGITUDE, LATITUDE = 180, 90  # the largest angles of types A and B: about their axis, and from its equator
TOLERANCE = 1e-3  # degrees, and metres where dimensions are compared


class Words(Numbers):
    """The numbers behind the line TILT=, with the lines that they are on."""

    def __init__(self, file, lines, first):
        self.file, self.line, self.last = file, first, len(lines)
        self.words = self.split(lines, first)

    def split(self, lines, first):
        for index in range(first, len(lines)):
            for word in lines[index].split():
                yield index + 1, word[:-1] if len(word) > 1 and word.endswith(",") else word

    def text(self, what):
        self.line, word = next(self.words, (self.last, None))
        if word is None:
            raise fault(self.file, self.line, f"the file ends before {what}")
        return word

    def end(self):
        for line, word in self.words:
            raise fault(self.file, line, f'"{word[:40]}" follows the last candela value; are the counts of angles right?')


def head(file, lines):
    """The keywords, and the index and the value of the line TILT=."""
    keywords = {}
    for index, line in enumerate(lines):
        text = line.strip()
        if text.upper().startswith("TILT="):
            return keywords, index, text[5:].strip()
        if text.startswith("[") and "]" in text:
            key, value = text[1:].split("]", 1)
            keywords.setdefault(key.strip().upper(), value.strip())
    raise fault(file, len(lines), "there is no line TILT=; is this an IES file?")


def read_tilt(words):
    words.whole("the lamp's position in the luminaire (after TILT=INCLUDE)", 1, 3)
    count = words.whole("the number of tilt angles", 1, MOST_ANGLES)
    angles = words.numbers(count, "tilt angle", 0, 180)
    checked_angles(angles, words.file, words.line, "tilt angles")
    return tuple(angles), tuple(words.numbers(count, "tilt factor", 0, MOST_TILT_FACTOR))


def tilt_of(file, value, words):
    if value.upper() == "NONE":
        return (0.0, 180.0), (1.0, 1.0)
    if value.upper() == "INCLUDE":
        return read_tilt(words)
    if not value:
        raise fault(file, words.line, "TILT= needs NONE, INCLUDE or the name of a file")
    if "/" in value or "\\" in value or value in (".", ".."):  # a fault there would print what is in it
        raise fault(file, words.line, f"TILT={value[:40]}: the file of tilt factors must be in the same folder")
    other = os.path.join(os.path.dirname(file), value)
    beside = os.path.realpath(os.path.dirname(file)), os.path.dirname(os.path.realpath(file))
    if os.path.islink(other) and os.path.dirname(os.path.realpath(other)) not in beside:
        raise fault(file, words.line, f"TILT={value[:40]}: the file of tilt factors is a link to another folder")
    if os.path.exists(other) and not os.path.isfile(other) and not os.path.isdir(other):
        raise fault(file, words.line, f"TILT={value[:40]}: is a pipe or a device, not a file of tilt factors")
    try:
        tilt_words = Words(other, lines_of(other), 0)
    except Fault as text:
        raise fault(file, words.line, f"TILT={value[:40]}: {text}") from None
    tilt = read_tilt(tilt_words)
    tilt_words.end()
    return tilt


def opening_of(words, width, length, height, metres):
    """The shape and the size along x, y and z (m): length is along the plane 0, which is +x, and width across it."""
    w, l, h = (abs(v) * metres for v in (width, length, height))
    if max(w, l, h) > 100:
        raise fault(words.file, words.line, f"the luminous opening is larger than 100 m: {w:g} x {l:g} x {h:g}")
    if w == 0 and l == 0:
        if h > TOLERANCE:
            return "box", (TOLERANCE, TOLERANCE, h)
        return "point", (TOLERANCE, TOLERANCE, TOLERANCE)
    if width < 0 and length <= 0 or width == 0 and length < 0:  # round; before 1995, one diameter alone was negative
        diameter = max(w, l)
        if height < 0 and abs(h - diameter) < TOLERANCE:
            return "sphere", (diameter,) * 3
        return "cylinder", (diameter, diameter, h)
    return "box", (max(l, TOLERANCE), max(w, TOLERANCE), h)


def all_round(words, planes, candela):
    """Intensities for planes from 0 to 360, by the symmetry that the first and the last plane of the file state."""
    first, last = planes[0], planes[-1]

    def at(value, wanted):
        return abs(value - wanted) < TOLERANCE

    if len(planes) == 1 and at(first, 0):
        return np.array([0.0]), candela
    if at(first, 0) and at(last, 90):
        planes, candela = unfolded(planes, candela, 90)
        half = planes <= 180 + TOLERANCE
        return unfolded(planes[half], candela[half], 180)
    if at(first, 0) and at(last, 180):
        return unfolded(planes, candela, 180)
    if at(first, 90) and at(last, 270):
        return unfolded(planes, candela, 90)
    if at(first, 0) and at(last, 360):
        return planes, candela
    raise fault(
        words.file,
        words.line,
        f"horizontal angles from {first:g} to {last:g} are none of 0, 0 to 90, 0 to 180, 90 to 270 and 0 to 360",
    )


def by_planes(kind, vertical, horizontal, candela):
    """Of type A or B: planes, gammas and intensities of type C, whose C0 is up and C270 to the right, seen along the main direction.

    The angles are longitudes and latitudes about an axis across the main direction: of type A horizontal and vertical ones about
    the axis that points up, of type B vertical and horizontal ones about that to the right. From 0 on, they are those of either side.
    """
    angles = np.unique(np.abs(np.concatenate([horizontal, vertical])))
    gammas = np.concatenate([*(angles[:-1] + np.diff(angles) * part for part in np.arange(PARTS) / PARTS), np.arange(0, 180 + PLANES / 2, PLANES)])
    gammas = np.unique(np.round(gammas[gammas <= (90 if angles[-1] <= 90 + TOLERANCE else 180)], 6))
    planes = np.arange(0, 360 + PLANES / 2, PLANES)
    c, gamma = np.meshgrid(np.radians(planes), np.radians(gammas), indexing="ij")
    ahead, up, right = np.cos(gamma), np.sin(gamma) * np.cos(c), -np.sin(gamma) * np.sin(c)
    axis, across = (up, right) if kind == "A" else (right, up)
    longitude, latitude = np.degrees(np.arctan2(across, ahead)), np.degrees(np.arcsin(np.clip(axis, -1, 1)))
    found = dict(zip(("horizontal", "vertical"), (longitude, latitude) if kind == "A" else (latitude, longitude)))
    outside, at = np.zeros(c.shape, bool), []
    for of, known in (("horizontal", horizontal), ("vertical", vertical)):
        value = np.abs(found[of]) if known[0] >= 0 else found[of]
        outside |= (value < known[0] - TOLERANCE) | (value > known[-1] + TOLERANCE)
        at.append(np.interp(value, known, np.arange(len(known))))
    low = [np.minimum(a.astype(int), len(known) - 2) for a, known in zip(at, (horizontal, vertical))]
    s, t = (a - l for a, l in zip(at, low))
    i, j = low
    value = (candela[i, j] * (1 - t) + candela[i, j + 1] * t) * (1 - s) + (candela[i + 1, j] * (1 - t) + candela[i + 1, j + 1] * t) * s
    return planes, gammas, np.where(outside, 0, value)


def polar_angles(words, vertical, horizontal):
    """The angles of type C, of so many numbers."""
    gammas = checked_angles(words.numbers(vertical, "vertical angle", 0, 180), words.file, words.line, "vertical angles")
    if min(gammas[0], abs(gammas[0] - 90)) > TOLERANCE or min(abs(gammas[-1] - 90), 180 - gammas[-1]) > TOLERANCE:
        raise fault(words.file, words.line, f"vertical angles must begin at 0 or 90 and end at 90 or 180, not {gammas[0]:g} and {gammas[-1]:g}")
    return gammas, checked_angles(words.numbers(horizontal, "horizontal angle", 0, 360), words.file, words.line, "horizontal angles")


def angles_of(words, kind, vertical, horizontal):
    """The angles of type A or B, of so many numbers. Raises Fault for those of another type."""
    found = []
    for count, of, most in ((vertical, "vertical", LATITUDE if kind == "A" else LONGITUDE), (horizontal, "horizontal", LONGITUDE if kind == "A" else LATITUDE)):
        angles = checked_angles(words.numbers(count, f"{of} angle", -most, most), words.file, words.line, f"{of} angles")
        if len(angles) < 2 or angles[0] > TOLERANCE or angles[-1] <= 0:
            raise fault(words.file, words.line, f"{of} angles of type {kind} must begin at 0 or below and end above, not {angles[0]:g} and {angles[-1]:g}")
        found.append(angles)
    return found


def read_ies(file, intensity=None):
    """The Photometry of an IES file. intensity: the unit of its values, whatever it says. Raises Fault with its line."""
    lines = lines_of(file)
    keywords, index, tilt_value = head(file, lines)
    unit = UNITS[intensity] if intensity else unit_in("\n".join(lines[:index]))
    if unit is None:
        raise fault(file, None, "says that it is radiant, but not in which unit; say so by --intensity, as W/sr, mW/sr, uW/sr or cd")
    words = Words(file, lines, index + 1)
    tilt = tilt_of(file, tilt_value, words)
    lamps = words.whole("the number of lamps", 1, 10000)
    lumens = words.number("the lumens of a lamp", -1, 1e9)
    if -1 < lumens <= 0:
        raise fault(file, words.line, "the lumens of a lamp must be above 0, or -1 for absolute photometry")
    multiplier = words.number("the multiplier", 1e-9, 1e9)
    gammas = words.whole("the number of vertical angles", 2, MOST_ANGLES)
    planes = words.whole("the number of horizontal angles", 1, MOST_ANGLES)
    if gammas * planes > MOST_VALUES:
        raise fault(file, words.line, f"{planes} x {gammas} candela values are more than {MOST_VALUES}; use larger steps between angles")
    kind = " CBA"[words.whole("the photometric type", 1, 3)]
    metres = FOOT if words.whole("the unit of lengths (1 feet, 2 metres)", 1, 2) == 1 else 1.0
    size = [words.number(f"the {what} of the luminous opening", -1e4, 1e4) for what in ("width", "length", "height")]
    shape, size = opening_of(words, *size, metres)
    factor = words.number("the ballast factor", 1e-9, 100)
    factor *= words.number("the factor behind the ballast factor", 1e-9, 100)
    watts = words.number("the watts", 0, 1e6)
    if kind == "C":
        vertical, horizontal = polar_angles(words, gammas, planes)
    else:
        vertical, horizontal = angles_of(words, kind, gammas, planes)
    values = np.array(words.numbers(gammas * planes, "candela value", 0, 1e9)).reshape(planes, gammas)
    if kind == "C":
        horizontal, candela = all_round(words, horizontal, values)
    else:
        horizontal, vertical, candela = by_planes(kind, vertical, horizontal, values)
    words.end()
    if not candela.any():
        raise fault(file, words.line, "all candela values are 0")
    candela = checked_candela(candela * multiplier * factor * unit[1], file, words.line)
    name = " ".join(keywords.get(key, "") for key in ("MANUFAC", "LUMCAT", "LUMINAIRE")).strip()
    # Type C: the plane 0 is along the luminaire. Where the opening is wider, its longer side decides.
    axis = "y" if size[1] > size[0] else "x"
    notes = (f"photometry of type {kind}: C0 is up and C270 to the right, seen along the main direction",) if kind != "C" else ()
    return Photometry(file, name or os.path.basename(file), horizontal, vertical, candela, shape, size, watts, tilt, axis, unit[0], notes, kind)
