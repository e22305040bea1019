"""What is seen of the world outside, by EN 17037: sunlight on a day, and the view out.

The standard was not read; the definitions are those of public texts about it. What these leave open is decided here, and said by notes:
- Sunlight: a reference point lies in the plane of the window, in the middle of its width, 1.2 m above the floor and .3 m above the
  sill or higher, on a cloudless day from 1 February to 21 March. The sun counts from an altitude up that each country chooses.
- View: three layers (sky, landscape, ground), the angle in plan under which the outside is seen, and the distance of what stands
  opposite, seen by three quarters of the area.
"""
import math
import warnings
from dataclasses import dataclass

import numpy as np

from ..fault import Fault, fault, lines_of, number, whole
from ..progress import PROGRESS
from .sun import MONTHS, sun_position
from .verdicts import Verdict

SUNLIGHT = "EN 17037:2018+A1:2021, exposure to sunlight: on one day from 1 February to 21 March"
VIEW = "EN 17037:2018+A1:2021, table A.5, view out; its layers and distances as rsphere-annual(1) defines them"
LOWEST_SUN = 11  # degrees, Germany's; 13 in the Czech Republic. The standard's table of other countries was not read
ABOVE_FLOOR, ABOVE_SILL = 1.2, 0.3  # m
DAYS = ((2, 1), (3, 21))
MINUTE = 1 / 60  # h, between positions of the sun
LEVELS = (("minimum", 1.5, 14, 6, "landscape"), ("medium", 3, 28, 20, "landscape and one more layer"), ("high", 4, 54, 50, "all layers"))
VIEW_AREA = 0.75
FLAT = 0.9  # of the normal along z: such windows are roof windows, such surfaces are ground
MOST_PANES = 16  # one behind another
FAR = 1e9  # lengths of rays that leave the scene are larger
AZIMUTHS, ALTITUDES, STEEPEST = 360, 24, 70  # rays of an eye, and degrees up and down: views beyond are no view out
LAYERS = ("sky", "landscape", "ground")


def seen_along(scene, rays, through=()):
    """What rays (n, 6) meet, straight through panes and surfaces `through`: modifiers and names (2, n), lengths (infinite if nothing), and
    the lengths to the first pane (0 if none). Mirrors end rays."""
    here = np.array(rays, float)
    names = np.full((2, len(here)), "", dtype=object)
    length, first = np.zeros(len(here)), np.zeros(len(here))
    left = np.arange(len(here))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # no light sources are needed
        for _ in range(MOST_PANES):
            if not len(left):
                break
            a = scene.trace(here[left], outputs="LXms", ambient_bounces=0)
            leaves = a.first_length > FAR
            passes = ~leaves & ((a.unmirrored_length > a.first_length * (1 + 1e-9)) | np.isin(a.modifier, through) | np.isin(a.surface, through))
            names[:, left] = a.modifier, a.surface
            step = np.where(leaves, np.inf, a.first_length)
            length[left] += step
            first[left] = np.where(passes & (first[left] == 0), length[left], first[left])
            left, step = left[passes], step[passes]
            here[left, :3] += step[:, None] * here[left, 3:]
    return names, length, first


def day_of(word):
    """Month and day of --day."""
    month, _, day = word.partition("-")
    month = whole(month, "--day " + word, None, "the month", 2, 3)
    day = whole(day, "--day " + word, None, "the day", 1, MONTHS[month - 1] if month == 2 else 21)
    return month, day


@dataclass
class Window:
    """A reference point."""

    name: str
    point: np.ndarray
    outwards: np.ndarray  # normal, or 0 0 0 if it is not known


def panes_of(word, polygons):
    """The polygons with a name or modifier."""
    return [p for p in polygons if word in (p.modifier, p.name) and np.linalg.norm(p.vector()) > 0]


def windows_of(word, polygons, inside, floor):
    """The reference points of --sunlight: in each polygon with a name or modifier, or in a file of points x y z.

    inside: points in the room; floor: its height.
    """
    found = []
    for p in panes_of(word, polygons):
        normal = p.vector() / np.linalg.norm(p.vector())
        outwards = -normal if np.sign((inside - p.corners[0]) @ normal).sum() > 0 else normal
        middle = (p.corners.min(axis=0) + p.corners.max(axis=0)) / 2
        if abs(normal[2]) < FLAT:
            right = np.cross([0, 0, 1], outwards) / np.linalg.norm(np.cross([0, 0, 1], outwards))
            up = np.cross(outwards, right)
            flat = (p.corners - p.corners[0]) @ np.stack([right, up]).T
            sill, top = p.corners[:, 2].min(), p.corners[:, 2].max()
            height = max(floor + ABOVE_FLOOR, sill + ABOVE_SILL)
            height = height if height < top else (sill + top) / 2
            middle = p.corners[0] + (flat[:, 0].min() + flat[:, 0].max()) / 2 * right
            middle = middle + (height - middle[2]) / up[2] * up
        found.append(Window(p.name, middle, outwards))
    if found:
        return found
    try:
        lines = lines_of(word)
    except Fault:
        known = ", ".join(sorted({p.modifier for p in polygons})[:8])
        raise Fault(f'--sunlight {word}: is neither a modifier or polygon of the scene, which has {known}, nor a file of points') from None
    for line, text in enumerate(lines, 1):
        words = text.split()
        if words and len(words) != 3:
            raise fault(word, line, f"a point in a window is x y z, not {len(words)} words")
        if words:
            point = np.array([number(w, word, line, what) for w, what in zip(words, "xyz")])
            found.append(Window(f"{word}:{line}", point, np.zeros(3)))
    if not found:
        raise fault(word, None, "has no points")
    return found


def sun_of_day(day, place, lowest):
    """Directions to the sun, minute by minute, where it is higher than lowest (degrees)."""
    angles = (sun_position(*day, (i + 0.5) * MINUTE, *place) for i in range(round(24 / MINUTE)))
    return np.array([(math.cos(a) * math.sin(z), math.cos(a) * math.cos(z), math.sin(a)) for a, z in angles if a > math.radians(max(0, lowest))]
                    ).reshape(-1, 3)


def sunlight(scene, windows, day, place, lowest, through=()):
    """Whether the sun shines on each window: (windows, positions of sun_of_day())."""
    to_sun = sun_of_day(day, place, lowest)
    lit = np.zeros((len(windows), len(to_sun)), bool)
    for row, window in zip(lit, windows):
        front = np.flatnonzero((to_sun @ window.outwards > 0) | (not window.outwards.any()))
        rays = np.hstack([np.tile(window.point, (len(front), 1)), to_sun[front]])
        row[front] = np.isinf(seen_along(scene, rays, through)[1])
    return lit


def sunlight_verdicts(scene, windows, day, place, lowest, through):
    """Verdicts on all windows together, and the rows of a table: a window, its point, hours on the day, on the first and on the last."""
    days = {d: sunlight(scene, windows, d, place, lowest, through) * MINUTE for d in (day, *DAYS)}
    names = [f"{d} {('February', 'March')[m - 2]}" for m, d in days]
    together, named = float(days[day].max(axis=0, initial=0).sum()), names[0]
    verdicts = [Verdict(f"sun of {lowest:g} degrees or higher at the windows on {named}", f"{hours:g} h: {level}", together, hours, SUNLIGHT, share=False)
                for level, hours, *_ in LEVELS]
    rows = [[w.name, " ".join(f"{x:.5g}" for x in w.point), *(f"{lit[i].sum():.2f}" for lit in days.values())] for i, w in enumerate(windows)]
    return verdicts, [["window", "point", *(f"h on {name}" for name in names)], *rows]


class View:
    """What eyes see of the outside: directions on a grid, denser than any layer that counts."""

    def __init__(self, scene, eyes, landscape, ground, through=()):
        """eyes: (n, 3). landscape, ground: modifiers or names of surfaces."""
        azimuth, row = (x.ravel() for x in np.meshgrid(np.arange(AZIMUTHS), np.arange(ALTITUDES), indexing="ij"))
        part = (azimuth * (math.sqrt(5) - 1) / 2) % 1  # each azimuth has other altitudes, evenly spread
        altitude = np.radians(STEEPEST) * (2 * (row + part) / ALTITUDES - 1)
        turn = 2 * np.pi * azimuth / AZIMUTHS
        directions = np.stack([np.cos(altitude) * np.sin(turn), np.cos(altitude) * np.cos(turn), np.sin(altitude)], axis=1)
        cell = 2 * np.pi / AZIMUTHS * np.radians(2 * STEEPEST) / ALTITUDES * np.cos(altitude)
        self.names = set()  # of all that is seen
        self.solid_angles, self.angle, self.distance = np.zeros((len(eyes), len(LAYERS))), np.zeros(len(eyes)), np.zeros(len(eyes))
        for i, eye in enumerate(eyes):
            names, length, first = seen_along(scene, np.hstack([np.tile(eye, (len(directions), 1)), directions]), through)
            self.names.update(*(set(n) for n in names))
            leaves = np.isinf(length)
            layers = [leaves & (altitude > 0), np.isin(names, landscape).any(axis=0), (leaves & (altitude <= 0)) | np.isin(names, ground).any(axis=0)]
            self.solid_angles[i] = [cell[layer].sum() for layer in layers]
            outside = np.any(layers, axis=0).reshape(AZIMUTHS, ALTITUDES)
            self.angle[i] = 360 / AZIMUTHS * outside.any(axis=1).sum()
            if outside.any():  # in each azimuth the direction nearest to the horizon
                level = np.where(outside, np.abs(altitude).reshape(outside.shape), np.inf)[outside.any(axis=1)].argmin(axis=1)
                beyond = ((length - first) * np.cos(altitude)).reshape(outside.shape)[outside.any(axis=1), level]
                self.distance[i] = np.median(beyond)
            PROGRESS.advance()

    def unseen(self, names):
        return [name for name in names if name not in self.names]

    def verdicts(self, weights):
        seen = self.solid_angles > 0
        more = seen.sum(axis=1)
        for (level, _, angle, distance, layers), count in zip(LEVELS, (1, 2, 3)):
            good = seen[:, 1] & (more >= count) & (self.angle >= angle) & (self.distance >= distance)
            yield Verdict(f"view, {level}: {angle} degrees, {distance} m, {layers}", f"{VIEW_AREA:.0%} of the area", float(weights @ good), VIEW_AREA, VIEW)

    def quantities(self):
        none = np.zeros(len(self.angle))
        found = {f"visible {layer}": (self.solid_angles[:, i], none, "sr") for i, layer in enumerate(LAYERS)}
        return {**found, "sight angle": (self.angle, none, "degrees"), "distance of the view": (np.minimum(self.distance, 1e4), none, "m")}
