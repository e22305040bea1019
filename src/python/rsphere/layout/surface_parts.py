"""Parts of the luminous surfaces of a luminaire: where its light leaves, and which share of it by direction."""
from dataclasses import dataclass

import numpy as np

from ..photometry.intensities import TINY
from ..photometry.lamp_rad import prism_radius

PART = 0.2  # m: the largest size of a part, as long as there are no more than `FEW`
FEW = 12
GOLDEN = 0.6180339887  # step of points along the shorter side, modulo 1: no two are near each other
LEAST_ROUND = 6  # parts of a surface that is curved
SMALL = 0.03  # of the area of all surfaces: a surface below it has no parts
IN_FRONT = 0.001  # m: parts are this far in front of their surface, so that it does not hide them


@dataclass
class Parts:
    """Around the middle of the luminaire, which is not turned. Lengths in m."""

    points: np.ndarray  # (n, 3)
    normals: np.ndarray  # (n, 3), unit
    areas: np.ndarray  # (n,)

    def __post_init__(self):
        self.planes, of = np.unique(np.round(self.normals, 9), axis=0, return_inverse=True)
        self.plane_areas = np.bincount(of.ravel(), self.areas)

    def facing(self, directions):
        """The area of each part that is seen from unit directions (..., n, 3) from the luminaire, one for each part."""
        return np.maximum((directions * self.normals).sum(axis=-1), 0) * self.areas

    def shares(self, directions):
        """The share of the light in unit directions (..., n, 3), one for each part, that leaves from that part.

        All parts in view are equally bright, so that shares are those of the area in view.
        """
        total = np.maximum(directions @ self.planes.T, 0) @ self.plane_areas
        return self.facing(directions) / np.where(total > 0, total, 1)


def lattice(width, height, most):
    """Points (n, 2) in the unit square, spread evenly over a rectangle of this size without rows or columns.

    Without them, because the edges of things that hide a luminaire are often parallel to it.
    """
    size = np.array([width, height])
    count = int(min(np.prod(np.maximum(np.ceil(size * np.sqrt(most / FEW) / PART), 1)), most))
    step = np.array([1 / count, GOLDEN] if width >= height else [GOLDEN, 1 / count])
    return ((np.arange(count) - (count - 1) / 2)[:, None] * step + 0.5) % 1


def around(t):
    return np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)


def rectangle(middle, along, across, normal, most):
    """along, across: the sides."""
    at = lattice(np.linalg.norm(along), np.linalg.norm(across), most) - 0.5
    return middle + at[:, :1] * along + at[:, 1:] * across, np.broadcast_to(normal, (len(at), 3))


def disk(radius, height, up, most):
    at = lattice(2 * radius, 2 * radius, most)
    away = radius * np.sqrt(at[:, 0]) if len(at) > 1 else np.zeros(1)
    x, y = around(at[:, 1])
    return np.stack([away * x, away * y, np.full(len(at), height)], axis=-1), np.tile([0, 0, 1.0 if up else -1.0], (len(at), 1))


def tube(radius, height, most):
    at = lattice(2 * np.pi * radius, height, most)
    if len(at) < LEAST_ROUND:
        at = (np.arange(LEAST_ROUND)[:, None] * [1 / LEAST_ROUND, GOLDEN] + 0.5 / LEAST_ROUND) % 1
    x, y = around(at[:, 0])
    return np.stack([radius * x, radius * y, (at[:, 1] - 0.5) * height], axis=-1), np.stack([x, y, 0 * x], axis=-1)


def ball(radius, most):
    count = len(lattice(2 * radius, 2 * radius, most))
    count = max(count, LEAST_ROUND)
    z, (x, y) = 1 - (2 * np.arange(count) + 1) / count, around(np.arange(count) * GOLDEN % 1)
    normals = np.stack([np.sqrt(1 - z * z) * x, np.sqrt(1 - z * z) * y, z], axis=-1)
    return radius * normals, normals


def surfaces(photometry):
    """The luminous surfaces, as lamp_rad.faces() has them: (area, function of the largest number of parts)."""
    x, y, h = photometry.size
    down, up = photometry.shines()
    half, sides = max(h, TINY) / 2, down and up and h > 0
    if photometry.shape in ("sphere", "point"):
        return [(np.pi * x * x, lambda most: ball(x / 2, most))]
    ends = [(-half, False)] * down + [(half, True)] * up
    if photometry.shape == "cylinder":
        found = [(np.pi / 4 * x * x, lambda most, z=z, u=u: disk(x / 2, z, u, most)) for z, u in ends]
        if sides:
            found.append((np.pi * x * h, lambda most: tube(prism_radius(x / 2, half), h, most)))
        return found
    axes = np.eye(3)
    found = [(x * y, lambda most, z=z, u=u: rectangle(z * axes[2], x * axes[0], y * axes[1], axes[2] if u else -axes[2], most)) for z, u in ends]
    if sides:
        for axis, sign, high in zip((0, 1, 0, 1), (1, 1, -1, -1), photometry.heights()):
            out, along, width = sign * axes[axis], axes[1 - axis], (y, x)[axis]
            middle = (x, y)[axis] / 2 * out + (high - h) / 2 * axes[2]
            if high > 0:
                found.append((width * high, lambda most, m=middle, a=width * along, u=high * axes[2], o=out: rectangle(m, a, u, o, most)))
    return found


def surface_parts(photometry, most):
    """The Parts of all luminous surfaces: at most `most`, but at least one of each surface that is not small."""
    found = surfaces(photometry)
    total = sum(area for area, _ in found)
    points, normals, areas = [], [], []
    for area, place in found:
        if area < SMALL * total:
            continue
        p, n = place(max(int(round(most * area / total)), 1))
        points.append(p + n * IN_FRONT)
        normals.append(n)
        areas.append(np.full(len(p), area / len(p)))
    return Parts(np.concatenate(points), np.concatenate(normals), np.concatenate(areas))
