"""Luminous intensity distributions: what the readers of IES and EULUMDAT files return.

A luminaire hangs at the origin, and its main direction is -z. C is the azimuth from +x towards +y, and gamma the
angle from -z, in degrees.
"""
from dataclasses import dataclass, field

import numpy as np

from ..fault import fault


TINY = 0.0005  # m; degrees
OPENING = 0.002, 8.0  # m: longest sides of luminous openings; others are most likely in other units
POINT = 0.001  # m: the side that stands for a point in many files
EFFICACY = 0.1, 500.0  # lm/W: candles have .3, and no lamp has more than 350
MOST_NAME = 100  # characters; names are those of makers, which nobody has checked
LARGEST = 1e-6, 1e9  # cd, the least and the most that the largest intensity of a luminaire can be: searchlights have 1e9


@dataclass
class Photometry:
    """Intensities and luminous opening of a luminaire. Lengths are metres."""

    file: str
    name: str
    planes: np.ndarray  # C angles, ascending from 0 to 360; a single 0 if intensities do not depend on C
    gammas: np.ndarray  # ascending, within 0 to 180; there is no light beyond them
    candela: np.ndarray  # (planes, gammas), of the whole luminaire: all factors and lamps are in it
    shape: str  # box (flat if the height is 0), cylinder (vertical; a disk if the height is 0), sphere or point
    size: tuple  # along x, along y, height
    watts: float
    tilt: tuple = field(default=((0.0, 180.0), (1.0, 1.0)))  # angles of the luminaire, and factors on its light
    axis: str = "x"  # that a long luminaire lies along; one that is seen crosswise has it across the line of sight
    radiant: bool = False  # intensities are in W/sr and not in cd, as those of UV
    notes: tuple = ()  # what is to be said of the file
    kind: str = "C"  # of the angles in the file: A or B are those of floodlights, which are aimed
    sides: tuple = None  # the heights of the luminous sides that face C0, C90, C180 and C270, where these differ

    def __post_init__(self):
        self.name = "".join(c if c.isprintable() else "?" for c in self.name[:MOST_NAME])

    def intensity(self, directions):
        """cd in directions (..., 3): unit vectors from the luminaire. Linear between the angles of the file."""
        d = np.asarray(directions, dtype=float)
        gamma = np.degrees(np.arctan2(np.hypot(d[..., 0], d[..., 1]), -d[..., 2]))
        g = np.interp(gamma, self.gammas, np.arange(len(self.gammas)))
        low = np.minimum(g.astype(int), max(len(self.gammas) - 2, 0))
        high = np.minimum(low + 1, len(self.gammas) - 1)
        t = g - low
        if len(self.planes) == 1:
            value = self.candela[0][low] * (1 - t) + self.candela[0][high] * t
        else:
            azimuth = np.degrees(np.arctan2(d[..., 1], d[..., 0])) % 360
            c = np.interp(azimuth, self.planes, np.arange(len(self.planes)))
            left = np.minimum(c.astype(int), len(self.planes) - 2)
            s = c - left
            first = self.candela[left, low] * (1 - t) + self.candela[left, high] * t
            second = self.candela[left + 1, low] * (1 - t) + self.candela[left + 1, high] * t
            value = first * (1 - s) + second * s
        outside = (gamma < self.gammas[0] - 1e-6) | (gamma > self.gammas[-1] + 1e-6)
        return np.where(outside, 0.0, value)

    def lumens(self):
        """The luminous flux (lm), or the radiant flux (W): the integral of the intensities."""
        fine = np.radians(np.linspace(0, 180, 3601))
        mean = self.candela[0]
        if len(self.planes) > 1:
            mean = np.sum((self.candela[1:] + self.candela[:-1]) / 2 * np.diff(self.planes)[:, None], axis=0) / 360
        curve = np.interp(np.degrees(fine), self.gammas, mean, left=0, right=0)
        weighed = curve * np.sin(fine)
        return np.pi * ((weighed[1:] + weighed[:-1]) * np.diff(fine)).sum()

    def doubts(self):
        """What is so unlikely that a number or its unit may be wrong; the file holds nevertheless."""
        longest, lumens = max(self.size), self.lumens()
        if abs(longest - POINT) > 1e-6 and not OPENING[0] <= longest <= OPENING[1]:
            yield f"the luminous opening is {longest:.3g} m long; are its lengths in the unit that the file is to have?"
        if not self.radiant and self.watts > 0 and not EFFICACY[0] <= lumens / self.watts <= EFFICACY[1]:
            yield f"{lumens:.4g} lm of {self.watts:g} W are {lumens / self.watts:.3g} lm/W; are both right?"

    def tilt_factor(self, angle):
        """The factor on the light of a luminaire whose main direction is turned by an angle (degrees) from -z."""
        return float(np.interp(angle, *self.tilt))

    def shines(self):
        """Whether there is light below and above the horizontal, by the angles of the file."""
        return bool(self.gammas[0] < 90), bool(self.gammas[-1] > 90)

    def heights(self):
        """Of the luminous sides of a box that face C0, C90, C180 and C270."""
        return self.sides or (self.size[2],) * 4

    def luminous_area(self, directions):
        """The luminous area (m2) in view from directions (..., 3): unit vectors from the luminaire."""
        d = np.asarray(directions, dtype=float)
        x, y, h = self.size
        if self.shape in ("sphere", "point"):
            return np.full(d.shape[:-1], np.pi / 4 * x * x)
        if self.shape == "cylinder":
            return np.pi / 4 * x * x * np.abs(d[..., 2]) + x * h * np.hypot(d[..., 0], d[..., 1])
        sides = self.heights()
        ahead, beside = np.where(d[..., 0] > 0, *sides[::2]), np.where(d[..., 1] > 0, *sides[1::2])
        return x * y * np.abs(d[..., 2]) + y * ahead * np.abs(d[..., 0]) + x * beside * np.abs(d[..., 1])


def checked_angles(angles, file, line, what):
    """Angles as an array. Raises Fault if they do not ascend."""
    for before, after in zip(angles, angles[1:]):
        if not before < after:
            raise fault(file, line, f"{what} must ascend, but {after:g} follows {before:g}")
    return np.array(angles)


def checked_candela(candela, file, line):
    """Intensities with all factors. Raises Fault if they are not those of any luminaire."""
    largest = float(candela.max())
    if not LARGEST[0] <= largest <= LARGEST[1]:
        raise fault(file, line, f"with all factors, the largest intensity is {largest:.3g} cd; it must be from {LARGEST[0]:g} to {LARGEST[1]:g}")
    return candela


def unfolded(planes, candela, middle):
    """Planes all round, from those of one half, which is mirrored in the plane `middle` (0, 90 or 180)."""
    mirrored = (2 * middle - planes) % 360
    both = np.concatenate([planes % 360, mirrored])
    order, first = np.unique(np.round(both, 9), return_index=True)
    rows = np.concatenate([candela, candela])[first]
    order, rows = np.append(order, order[0] + 360), np.vstack([rows, rows[:1]])
    if order[0] > 0:
        order, rows = np.insert(order, 0, order[-2] - 360), np.vstack([rows[-2:-1], rows])
    return order, rows
