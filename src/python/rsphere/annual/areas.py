"""The area of a work plane that each of its sensors stands for.

Each place counts with the sensor nearest to it. Where the grid is whole, that is the sensor's cell. A cell that an edge cuts has no sensor (plan
keeps half a spacing from edges, as EN 12464-1 keeps its points off walls), and what is left of it goes to the sensors around, piece by piece. One
in its middle would stand closer to the wall than the others, and be no point of the plans; without the piece, shares would not be of the
reference plane, of which EN 17037 and LM-83 ask them. A margin is no part of this plane: the band of .5 m along walls of EN 17037.
"""
import math

import numpy as np

from ..layout.room import frame_of, inside

SAME, ASIDE = 1e-6, 1e-5  # of a plane's size: rounding of corners, and places beside an edge, as plan has them
TINY = 1e-13  # of a plane's size, squared: parts of this area are rounding
ROUND = 64  # corners of the circle of a margin around a corner, within it: where a corner points inwards, .16% of its area are lost


def sides(part):
    return zip(part, part[1:] + part[:1])


def area(part):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in sides(part)) / 2


def halves(part, a, b):
    """What of a convex polygon, a list of corners, is to the left of a line from a to b, and what to its right (Sutherland and Hodgman 1974)."""
    found = [], []
    depth = [(b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) for x, y in part]
    for (p, q), (dp, dq) in zip(sides(part), sides(depth)):
        for half, sign in zip(found, (1, -1)):
            if sign * dp >= 0:
                half.append(p)
            if dp * dq < 0:
                half.append((p[0] + dp / (dp - dq) * (q[0] - p[0]), p[1] + dp / (dp - dq) * (q[1] - p[1])))
    return found


def boxes_of(parts):
    """Their bounding rectangles: the lowest coordinates, and the highest."""
    return np.array([[*np.min(p, axis=0), *np.max(p, axis=0)] for p in parts]).reshape(-1, 4)


def near(boxes, part):
    """The indexes of the rectangles that overlap that of a part."""
    return np.flatnonzero(((boxes[:, :2] < np.max(part, axis=0)) & (boxes[:, 2:] > np.min(part, axis=0))).all(axis=1))


def without(part, holes, boxes, tiny):
    """Convex polygons: what of one is outside of others."""
    rest = [part]
    for hole in (holes[k] for k in near(boxes, part)):
        whole, rest = rest, []
        for p in whole:
            inner, outer = p, []
            for a, b in sides(hole):
                inner, right = halves(inner, a, b)
                outer.append(right)
            rest += [o for o in outer if area(o) > tiny] if area(inner) > tiny else [p]
    return rest


def edges_of(rings, size):
    """For each edge its start, its way, and from 0 to 1 the places along it at which others meet it."""
    starts, ways = np.concatenate(rings), np.concatenate([np.roll(ring, -1, axis=0) - ring for ring in rings])
    lengths = np.hypot(*ways.T)
    for a, along in zip(starts, ways):
        with np.errstate(divide="ignore", invalid="ignore"):
            slant = along[0] * ways[:, 1] - along[1] * ways[:, 0]
            t, u = (((starts - a)[:, 0] * d[..., 1] - (starts - a)[:, 1] * d[..., 0]) / slant for d in (ways, along))
            meets = (np.abs(slant) > SAME * np.hypot(*along) * lengths) & (np.abs(u - 0.5) < 0.5 + SAME * size / lengths) & (t > 0) & (t < 1)
        yield a, along, [0, *sorted(t[meets]), 1]


def trapezoids(ring, size):
    """The parts of a polygon between levels at which it has corners. Inside is what an odd number of crossings says, as in RADIANCE."""
    edges = [sorted(side, key=lambda p: p[1]) for side in sides(ring.tolist())]
    at = lambda a, b, y: a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1])  # noqa: E731
    levels = sorted({*ring[:, 1].tolist(), *(float(a[1] + t * along[1]) for a, along, cuts in edges_of([ring], size) for t in cuts[1:-1])})
    for low, high in zip(levels, levels[1:]):
        crossed = sorted(((at(a, b, low), at(a, b, high)) for a, b in edges if a[1] <= low and b[1] >= high), key=sum)
        for left, right in zip(crossed[::2], crossed[1::2]):
            yield [(left[0], low), (right[0], low), (right[1], high), (left[1], high)]


def outline(rings, size):
    """Pieces of edges with the plane on one side alone: ends and unit normals. Seams of holes are none."""
    pieces = []
    for a, along, cuts in edges_of(rings, size):
        length = np.hypot(*along)
        pieces += [(a + s * along, a + e * along, np.array([-along[1], along[0]]) / length) for s, e in zip(cuts, cuts[1:]) if (e - s) * length > SAME * size]
    pieces = np.array(pieces)
    aside = [pieces[:, :2].mean(axis=1) + d * size * pieces[:, 2] for d in (ASIDE, -ASIDE)]
    left, right = (np.any([inside(ring, places) for ring in rings], axis=0) for places in aside)
    return pieces[left != right]


def parts_of(rings, margin):
    """Convex polygons that have no place in common: the plane of polygons, which may overlap, without a margin along its outline."""
    size = np.ptp(np.concatenate(rings), axis=0).max()
    whole, tiny = [[*trapezoids(ring, size)] for ring in rings], TINY * size**2
    holes = [p for ring in whole for p in ring]
    boxes, had, parts = boxes_of(holes), 0, []
    for ring in whole:
        parts += [rest for p in ring for rest in without(p, holes, boxes[:had], tiny)]
        had += len(ring)
    if not margin > 0:
        return parts
    edges, turn = outline(rings, size), np.exp(2j * np.pi * np.arange(ROUND) / ROUND)
    bands = [np.array([a - margin * n, b - margin * n, b + margin * n, a + margin * n]) for a, b, n in edges]
    bands += [end + margin * np.stack([turn.real, turn.imag], axis=1) for end in np.unique(edges[:, :2].reshape(-1, 2), axis=0)]
    bands = [[*map(tuple, band.tolist())] for band in bands]
    boxes = boxes_of(bands)
    return [rest for p in parts for rest in without(p, bands, boxes, tiny)]


def areas_of(sensors, polygons, margin):
    """The area that each of the sensors on a work plane stands for."""
    largest = max((p.vector() for p in polygons), key=np.linalg.norm)
    frame = np.stack(frame_of(largest / np.linalg.norm(largest)), axis=1)
    rings, places = [p.corners @ frame for p in polygons], sensors[:, :3] @ frame
    low = np.concatenate(rings).min(axis=0)  # as origin: coordinates may be those of a map
    rings, places, found = [ring - low for ring in rings], places - low, []
    right, top = np.concatenate(rings).max(axis=0)
    parts = parts_of(rings, margin)
    boxes = boxes_of(parts)
    for place in places:
        far = np.hypot(*(places - place).T)
        cell = [(0, 0), (right, 0), (right, top), (0, top)]
        for k in np.argsort(far)[1:]:
            if far[k] >= 2 * max(math.dist(place, corner) for corner in cell):
                break
            middle, way = (place + places[k]) / 2, places[k] - place
            cell = halves(cell, middle, (middle[0] - way[1], middle[1] + way[0]))[0]
        found.append(0)
        for part in (parts[k] for k in near(boxes, cell)):
            for a, b in sides(cell):
                part = halves(part, a, b)[0]
            found[-1] += area(part)
    return np.array(found)
