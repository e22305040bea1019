"""Luminaires as scene text: a brightdata pattern on the luminous opening, as RADIANCE's ies2rad makes it."""
import os
import re
import shutil

import numpy as np

from ..fault import write_text
from .intensities import TINY

SIDES = 16  # of a prism that stands for a cylinder: its width is within 1.3% of the cylinder's
SLENDER = 0.2  # a cylinder is one as long as its radius is at most this share of its height
LUMENS_PER_WATT = 179.0  # RADIANCE's, of white light
UNITS = {"m": 1.0, "cm": 100.0, "mm": 1000.0, "ft": 1 / 0.3048, "in": 12 / 0.3048}  # in a metre


def word(name):
    """A name as a word of scene text, and as a data file that RAYPATH finds: names with a dot in front are not looked for."""
    clean = "".join(c if c.isascii() and (c.isalnum() or c in "_-.") else "_" for c in name)
    return re.sub(r"^[.-]", "_", clean) or "lamp"


def data_text(photometry):
    """The data file: W/sr by azimuth and gamma. Beyond the angles of the file it is 0: data files extrapolate."""
    gammas, values = list(photometry.gammas), photometry.candela
    zero = np.zeros((len(values), 1))
    if gammas[0] > 0:
        gammas, values = [0, gammas[0] - TINY] + gammas, np.hstack([zero, zero, values])
    if gammas[-1] < 180:
        gammas, values = gammas + [gammas[-1] + TINY, 180], np.hstack([values, zero, zero])
    planes = list(photometry.planes)
    if len(planes) == 1:
        planes, values = [0, 360], np.vstack([values, values])
    lines = ["2"]
    for angles in (planes, gammas):
        lines.append(f"0 0 {len(angles)} " + " ".join(f"{a:.9g}" for a in angles))
    lines += [" ".join(f"{v / (1 if photometry.radiant else LUMENS_PER_WATT):.9g}" for v in row) for row in values]
    return "\n".join(lines) + "\n"


def turning_words(aim, turn):
    """The options of xform that turn a luminaire as rotation() does."""
    aim = np.asarray(aim, dtype=float) / np.linalg.norm(aim)
    across = np.hypot(aim[0], aim[1])
    azimuth = np.degrees(np.arctan2(aim[1], aim[0])) if across >= 1e-12 else 0.0
    steps = (("-rz", turn - azimuth), ("-ry", -np.degrees(np.arctan2(across, -aim[2]))), ("-rz", azimuth))
    return [word for axis, angle in steps if abs(angle) > 1e-9 for word in (axis, f"{angle:.9g}")]


def pattern_text(photometry, name, data, factor, turning=()):
    """The pattern and the material of the luminous surfaces. factor: on the light. turning: options of xform."""
    x, y, h = photometry.size
    sides = all(photometry.shines()) and h > 0
    if photometry.shape in ("sphere", "point"):
        function, numbers = "round", [factor / (np.pi / 4 * x * x)]
    elif not sides:
        area = np.pi / 4 * x * x if photometry.shape == "cylinder" else x * y
        function, numbers = "flat", [factor / area]
    elif photometry.shape == "cylinder":
        function, numbers = "cylinder", [factor, x, h]
    elif len(set(photometry.heights())) == 1:
        function, numbers = "box", [factor, x, y, h]
    else:
        function, numbers = "sides", [factor, x, y, *photometry.heights()]
    shown = " ".join(f"{v:.9g}" for v in numbers)
    words = ["", function, data, "lamp.cal", "azimuth", "gamma", *turning]
    return (f"void brightdata {name}_light\n{len(words) - 1}{' '.join(words)}\n0\n{len(numbers)} {shown}\n"
            f"{name}_light light {name}\n0\n0\n3 1 1 1\n")


def prism_radius(radius, half):
    """How far the edges of what stands for a vertical cylinder are from its axis; see tube()."""
    return radius if radius <= SLENDER * 2 * half else np.pi * radius / (SIDES * np.sin(np.pi / SIDES))


def tube(radius, half):
    """The side of a vertical cylinder. A short wide one is a prism: rtrace's rays miss much of such a cylinder.

    rtrace warns of it ("source aspect too small"). The prism is as wide, on average over all directions.
    """
    if radius <= SLENDER * 2 * half:
        return [("cylinder", [0, 0, -half, 0, 0, half, radius], "ppppppl")]
    corner = prism_radius(radius, half)
    angles = 2 * np.pi * np.arange(SIDES + 1) / SIDES
    at = lambda t, z: [corner * np.cos(t), corner * np.sin(t), z]  # noqa: E731
    return [("polygon", [*at(a, -half), *at(b, -half), *at(b, half), *at(a, half)], "p" * 12) for a, b in zip(angles, angles[1:])]


def faces(photometry):
    """The luminous surfaces around the origin (m): (type, numbers, kind of each number: p place, v direction, l length)."""
    x, y, h = photometry.size
    down, up = photometry.shines()
    if photometry.shape in ("sphere", "point"):
        return [("sphere", [0, 0, 0, x / 2], "pppl")]
    half = max(h, TINY) / 2
    found = []
    if photometry.shape == "cylinder":
        if down:
            found.append(("ring", [0, 0, -half, 0, 0, -1, 0, x / 2], "pppvvvll"))
        if up:
            found.append(("ring", [0, 0, half, 0, 0, 1, 0, x / 2], "pppvvvll"))
        if down and up and h > 0:
            found += tube(x / 2, half)
        return found
    a, b = x / 2, y / 2
    bottom = [(-a, -b), (-a, b), (a, b), (a, -b)]
    if down:
        found.append(("polygon", [v for p in bottom for v in (*p, -half)], "p" * 12))
    if up:
        found.append(("polygon", [v for p in bottom[::-1] for v in (*p, half)], "p" * 12))
    if down and up and h > 0:
        c0, c90, c180, c270 = photometry.heights()
        for p, q, high in zip(bottom, bottom[1:] + bottom[:1], (c180, c90, c0, c270)):
            side = [(*p, -half), (*p, high - half), (*q, high - half), (*q, -half)]
            if high > 0:
                found.append(("polygon", [v for corner in side for v in corner], "p" * 12))
    return found


def rotation(aim, turn):
    """The matrix that takes a luminaire to its main direction `aim`, first turned by `turn` degrees about -z.

    Turning is from +x towards +y. A luminaire that is not aimed down is tilted in the vertical plane of its aim.
    """
    aim = np.asarray(aim, dtype=float) / np.linalg.norm(aim)
    t = np.radians(turn)
    turned = np.array([[np.cos(t), -np.sin(t), 0], [np.sin(t), np.cos(t), 0], [0, 0, 1.0]])
    across = np.hypot(aim[0], aim[1])
    tilt = np.arctan2(across, -aim[2])
    if across < 1e-12:
        axis = np.array([0.0, 1.0, 0.0])  # straight up: over +x
    else:
        axis = np.array([aim[1], -aim[0], 0.0]) / across
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return (np.eye(3) + np.sin(tilt) * k + (1 - np.cos(tilt)) * k @ k) @ turned


def placed(numbers, kinds, turn, origin, units):
    """The numbers of a surface that is turned by a matrix, scaled to the units of the scene, and moved."""
    out, i = [], 0
    while i < len(numbers):
        if kinds[i] == "l":
            out.append(numbers[i] * units)
            i += 1
            continue
        vector = turn @ np.array(numbers[i : i + 3], dtype=float)
        out += list(vector * units + origin if kinds[i] == "p" else vector)
        i += 3
    return [0.0 if abs(v) < 1e-12 else v for v in out]


def surfaces_text(photometry, name, modifier, turn=None, origin=(0, 0, 0), units=1.0):
    """The luminous surfaces at a place, with a modifier."""
    turn = np.eye(3) if turn is None else turn
    text = ""
    for i, (kind, numbers, kinds) in enumerate(faces(photometry)):
        moved = placed(numbers, kinds, turn, np.asarray(origin, dtype=float), units)
        shown = " ".join(f"{v:.9g}" for v in moved)
        text += f"{modifier} {kind} {name}.{i + 1}\n0\n0\n{len(moved)} {shown}\n"
    return text


def write_data(photometry, folder, name):
    """Writes the data file and lamp.cal into a folder. Returns the name of the data file."""
    write_text(os.path.join(folder, f"{name}.dat"), data_text(photometry))
    target = os.path.join(folder, "lamp.cal")
    if not os.path.exists(target):
        shutil.copy(os.path.join(os.path.dirname(os.path.abspath(__file__)), "lamp.cal"), target)
    return f"{name}.dat"
