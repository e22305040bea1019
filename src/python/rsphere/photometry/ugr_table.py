"""The UGR table of a luminaire, by CIE 117:1995 and CIE 190:2010: what it would be rated in rooms that are full of it.

An eye in the middle of a wall looks straight across the room, which reaches X to its sides and Y ahead. Luminaires hang H = 2 m
above it, in even rows that begin half a spacing from the walls, and aim down.

    UGR = 8 lg(.25 / Lb sum L^2 w / P^2),   L^2 w = I^2 / (A r^2)

of the intensities I towards the eye, the luminous areas A in view, the distances r, and Guth's position index P. The luminance of
the background is Lb = E / pi of the mean illuminance E that walls between the eye's plane and that of the luminaires get indirectly.

Where a room is traced instead (rsphere -Su), Lb follows from the illuminance at the eye itself, and all luminaires in view count.
"""
import numpy as np

from ..fault import fault
from .position_index import position_index

ROOMS = tuple((x, y) for x, ys in ((2, (2, 3, 4, 6, 8, 12)), (4, (2, 3, 4, 6, 8, 12)), (8, (4, 6, 8, 12)), (12, (4, 6, 8))) for y in ys)  # X, Y in H
REFLECTANCES = ((0.7, 0.5, 0.2), (0.7, 0.3, 0.2), (0.5, 0.5, 0.2), (0.5, 0.3, 0.2), (0.3, 0.3, 0.2))  # ceiling, walls, eye's plane
SPACINGS = 0.25, 1.0  # in H: of catalogues, and of CIE 190
HEIGHT = 2.0  # m, H
# Luminaires count that CIE 117's table of the position index has. (Overhead, those nearer than 1.05 m in plan do not count.)
MOST_ASIDE = 3.0  # times the distance ahead
MOST_ABOVE = 1.9  # times the distance ahead
FLUX_SPACING = 1  # in H: CIE 190's shares of the flux that reach the walls are those of luminaires at this spacing, in all tables
STEP = 0.5, 3.0  # degrees of gamma and C, for integrals: .1% of the flux of a beam of 10 degrees
LEAST_UGR = 10  # what is below is not told apart


class UgrTable:
    """values: (19, 10), for ROOMS and for REFLECTANCES, seen crosswise and then endwise; -inf where no light reaches the eye."""

    def __init__(self, photometry, spacing=SPACINGS[0], factor=1.0):
        """spacing: of luminaires, in H. factor: on the light."""
        if photometry.shape == "point" or min(photometry.size[:2]) <= 0:
            raise fault(photometry.file, None, "has no luminous area, which UGR needs; write its width and length into the file")
        if photometry.radiant:
            raise fault(photometry.file, None, "is radiant (W/sr): its light has no UGR")
        if photometry.kind != "C":
            raise fault(photometry.file, None, f"is of type {photometry.kind}, of floodlights; the UGR table is of luminaires that hang in rows and aim down")
        self.photometry, self.spacing, self.factor = photometry, spacing, factor
        self.direct = Direct(photometry)
        self.values = np.array([[v for endwise in (False, True) for v in self.ratings(room, endwise)] for room in ROOMS])

    def ratings(self, room, endwise):
        """The UGR of a room (X, Y in H) with each of REFLECTANCES."""
        glare = glare_sum(self.photometry, room, self.spacing, endwise) * self.factor**2
        luminances = [self.background(room, endwise, r) for r in REFLECTANCES]
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(glare > 0, 8 * np.log10(0.25 * glare / np.array(luminances)), -np.inf)

    def background(self, room, endwise, reflectances):
        """The luminance of the background (cd/m2): the illuminance that all luminaires give to the walls indirectly, over pi."""
        sizes = room if looks_along_y(self.photometry, endwise) else room[::-1]  # along x and y of the luminaires
        count, walls = len(places(room, self.spacing)[0]), 2 * sum(room) * HEIGHT**2
        return float(self.factor * count * indirect(room, reflectances) @ self.direct.flux(sizes) / walls / np.pi)


def places(room, spacing):
    """Where luminaires hang from the eye (m): to the side, and ahead."""
    counts = [int(round(size / spacing)) for size in room]
    aside = (np.arange(counts[0]) - (counts[0] - 1) / 2) * spacing * HEIGHT
    ahead = (np.arange(counts[1]) + 0.5) * spacing * HEIGHT
    return [v.ravel() for v in np.meshgrid(aside, ahead)]


def looks_along_y(photometry, endwise):
    """Whether the line of sight is along y of the luminaires: it is along their axis if they are seen endwise."""
    return bool(endwise) == (photometry.axis == "y")


def glare_sum(photometry, room, spacing, endwise):
    """The sum of L^2 w / P^2 over the luminaires that count. The eye is in the direction of C0 of those ahead, or of C90."""
    aside, ahead = places(room, spacing)
    counts = (np.abs(aside) <= MOST_ASIDE * ahead * (1 + 1e-9)) & (HEIGHT <= MOST_ABOVE * ahead)
    aside, ahead = aside[counts], ahead[counts]
    square = aside**2 + ahead**2 + HEIGHT**2
    plan = (aside, ahead) if looks_along_y(photometry, endwise) else (ahead, aside)
    away = np.stack([*plan, np.full_like(ahead, -HEIGHT)], axis=-1) / np.sqrt(square)[:, None]
    towards = np.stack([aside, ahead, np.full_like(ahead, HEIGHT)], axis=-1) / np.sqrt(square)[:, None]
    index = position_index(np.array([0, 1.0, 0]), towards)
    return float((photometry.intensity(away) ** 2 / (photometry.luminous_area(away) * square * index**2)).sum())


class Direct:
    """The light that goes straight from the luminaires of a room to its surfaces, on average of all of them."""

    def __init__(self, photometry):
        gamma = np.radians((np.arange(180 / STEP[0]) + 0.5) * STEP[0])[:, None]
        azimuth = np.radians((np.arange(360 / STEP[1]) + 0.5) * STEP[1])
        x, y, z = np.sin(gamma) * np.cos(azimuth), np.sin(gamma) * np.sin(azimuth), -np.cos(gamma) + 0 * azimuth
        part = np.sin(gamma) * np.radians(STEP[0]) * np.radians(STEP[1])  # sr
        self.lumens, self.down = photometry.intensity(np.stack([x, y, z], axis=-1)) * part, z < 0
        self.shifts, self.known = (x / np.abs(z), y / np.abs(z)), {}

    def within(self, axis, size):
        """The share of luminaires in a row across a room from which each part of the light arrives between the walls."""
        if (axis, size) not in self.known:
            at = (np.arange(size / FLUX_SPACING) + 0.5) * FLUX_SPACING + self.shifts[axis][..., None]
            self.known[axis, size] = ((at > 0) & (at < size)).mean(axis=-1)
        return self.known[axis, size]

    def flux(self, sizes):
        """The lumens that meet the ceiling, the walls and the plane of the eye first. sizes: of the room along x and y, in H."""
        met = self.within(0, sizes[0]) * self.within(1, sizes[1])
        down = self.lumens * self.down
        return np.array([self.lumens.sum() - down.sum(), (down * (1 - met)).sum(), (down * met).sum()])


def indirect(room, reflectances):
    """The lumens that the walls get indirectly, for a lumen that goes straight to the ceiling, to the walls and to the plane."""
    across_room = form_factor(*room)  # from the ceiling to the plane
    area = room[0] * room[1] / (2 * sum(room))  # of the ceiling, over that of the walls
    to_walls, from_walls = 1 - across_room, (1 - across_room) * area
    exchange = np.array([[0, from_walls, across_room], [to_walls, 1 - 2 * from_walls, to_walls], [across_room, from_walls, 0]])
    return np.linalg.inv(np.eye(3) - exchange * np.array(reflectances))[1] - np.array([0, 1, 0])


def form_factor(x, y):
    """Of two equal rectangles that face each other at a distance of 1, by their sides."""
    a, b = np.sqrt(1 + x * x), np.sqrt(1 + y * y)
    terms = (np.log(a * b / np.sqrt(1 + x * x + y * y)), x * b * np.arctan(x / b), y * a * np.arctan(y / a), -x * np.arctan(x), -y * np.arctan(y))
    return 2 / (np.pi * x * y) * sum(terms)
