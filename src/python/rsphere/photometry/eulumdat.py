"""Reads EULUMDAT files (.ldt)."""
import os

import numpy as np

from ..fault import Numbers, fault, lines_of
from .intensities import Photometry, checked_angles, checked_candela, unfolded

MOST_PLANES = 721
MOST_LAMPS = 20
DOUBTFUL = 0.1  # how far a light output ratio may be from that of the intensities until it is told


class Lines(Numbers):
    """The lines of a file, one value on each."""

    def __init__(self, file):
        self.file, self.lines, self.line = file, lines_of(file), 0

    def text(self, what):
        if self.line >= len(self.lines) or (self.line == len(self.lines) - 1 and not self.lines[-1]):
            raise fault(self.file, len(self.lines), f"the file ends before {what}")
        self.line += 1
        return self.lines[self.line - 1].strip()

    def end(self):
        for index in range(self.line, len(self.lines)):
            if self.lines[index].strip():
                raise fault(self.file, index + 1, "this follows the last intensity; are the numbers of angles right?")


def stored_planes(symmetry, planes):
    """The indices of the C planes whose intensities the file has, from the first C angle on."""
    if symmetry == 1:
        return range(0, 1)
    if symmetry == 2:
        return range(0, planes // 2 + 1)
    if symmetry == 3:  # from C270 over C0 to C90
        return range(3 * planes // 4, 3 * planes // 4 + planes // 2 + 1)
    if symmetry == 4:
        return range(0, planes // 4 + 1)
    return range(0, planes)


def all_round(angles, candela, symmetry):
    """Intensities for planes from 0 to 360. angles: of the stored planes; those of symmetry 3 begin at -90."""
    if symmetry == 1:
        return np.array([0.0]), candela
    if symmetry == 0:
        return np.append(angles, angles[0] + 360), np.vstack([candela, candela[:1]])
    if symmetry == 3:
        order = np.argsort(angles % 360)
        return unfolded((angles % 360)[order], candela[order], 90)
    if symmetry == 4:
        angles, candela = unfolded(angles, candela, 90)
        half = angles <= 180 + 1e-6
        angles, candela = angles[half], candela[half]
    return unfolded(angles, candela, 180)


def read_lamps(lines):
    """The lumens and the watts of the first set of lamps; the others are alternatives."""
    sets = lines.whole("the number of sets of lamps", 1, MOST_LAMPS)
    first = None
    for i in range(sets):
        of = f"of set {i + 1}"
        count = lines.whole(f"the number of lamps {of}", -10000, 10000)
        if count == 0:
            raise fault(lines.file, lines.line, f"the number of lamps {of} must not be 0")
        lines.text(f"the type of lamps {of}")
        flux = lines.number(f"the lumens of the lamps {of}", 0, 1e9)
        lines.text(f"the color temperature {of}")
        lines.text(f"the color rendering {of}")
        power = lines.number(f"the watts {of}", 0, 1e6)
        if flux == 0:
            raise fault(lines.file, lines.line - 3, f"the lumens of the lamps {of} must be above 0")
        first = first or (flux, power)
    return first


def read_opening(lines):
    """The shape, the size and the heights of the sides (m): C0, which is +x, is across the length."""
    names = ("length", "width", "height")
    body = [lines.number(f"the {what} of the luminaire (mm)", 0, 1e5) for what in names]
    length = lines.number("the length of the luminous area (mm)", 0, 1e5)
    width = lines.number("the width of the luminous area (mm)", 0, 1e5)
    heights = lines.numbers(4, "height of the luminous area (mm)", 0, 1e5)
    if length == 0 and width == 0:
        length, width = body[0], body[1]
    if length == 0:
        return "point", (0.001, 0.001, 0.001), None
    if width == 0:
        return "cylinder", (length / 1000, length / 1000, max(heights) / 1000), None
    return "box", (width / 1000, length / 1000, max(heights) / 1000), tuple(h / 1000 for h in heights)


def read_eulumdat(file):
    """The Photometry of an EULUMDAT file. Raises Fault with its line."""
    lines = Lines(file)
    maker = lines.text("the maker")
    lines.whole("the type (0 to 3)", 0, 3)
    symmetry = lines.whole("the symmetry (0 to 4)", 0, 4)
    planes = lines.whole("the number of C planes", 1, MOST_PLANES)
    lines.number("the distance between C planes", 0, 360)
    gammas = lines.whole("the number of angles in a plane", 2, MOST_PLANES)
    lines.number("the distance between the angles in a plane", 0, 180)
    lines.text("the number of the report")
    name = lines.text("the name of the luminaire")
    for what in ("the number of the luminaire", "the name of the file", "the date"):
        lines.text(what)
    if symmetry > 1 and planes % (2 if symmetry == 2 else 4):
        raise fault(file, 4, f"{planes} C planes do not fit symmetry {symmetry}")
    shape, size, sides = read_opening(lines)
    lines.number("the downward flux fraction (%)", 0, 100)
    ratio = lines.number("the light output ratio (%)", 0, 1000)
    factor = lines.number("the factor on intensities", 1e-9, 1e9)
    lines.number("the tilt during the measurement", -360, 360)
    lumens, watts = read_lamps(lines)
    lines.numbers(10, "direct ratio", -1000, 1000)
    angles = checked_angles(lines.numbers(planes, "C angle", 0, 360), file, lines.line, "C angles")
    if planes > 1 and (angles[0] != 0 or angles[-1] >= 360):
        raise fault(file, lines.line, f"C angles must begin at 0 and end below 360, not {angles[0]:g} and {angles[-1]:g}")
    vertical = checked_angles(lines.numbers(gammas, "angle in a plane", 0, 180), file, lines.line, "angles in a plane")
    stored = stored_planes(symmetry, planes)
    values = lines.numbers(len(stored) * gammas, "intensity", 0, 1e9)
    lines.end()
    if not any(values):
        raise fault(file, lines.line, "all intensities are 0")
    used = np.array([angles[i % planes] for i in stored])
    check_symmetry(lines, used, symmetry)
    used, candela = all_round(used, np.array(values).reshape(len(stored), gammas), symmetry if planes > 1 else 1)
    # cd per 1000 lm of the lamps, also where a negative number of lamps marks absolute photometry.
    candela = checked_candela(candela * factor * lumens / 1000, file, lines.line)
    name = f"{maker} {name}".strip() or os.path.basename(file)
    read = Photometry(file, name, used, vertical, candela, shape, size, watts, axis="y", sides=sides)
    found = 100 * read.lumens() / lumens
    if ratio and abs(found / ratio - 1) > DOUBTFUL:
        read.notes += (f"the intensities have {found:.0f}% of the light of the lamps, and the file says {ratio:.0f}%; they hold",)
    return read


def check_symmetry(lines, angles, symmetry):
    ends = {2: (0, 180), 3: (270, 90), 4: (0, 90)}.get(symmetry)
    if ends and (abs(angles[0] - ends[0]) > 1e-3 or abs(angles[-1] - ends[1]) > 1e-3):
        raise fault(lines.file, lines.line, f"symmetry {symmetry} needs the planes C{ends[0]} to C{ends[1]}, "
                    f"but the file has C{angles[0]:g} to C{angles[-1]:g}")
