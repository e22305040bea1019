"""What stands in the room: outlines for the drawing, and what lies above points."""
from collections import Counter

import numpy as np

from .room import Polygon

ABOVE_FLOOR = 0.02  # m: rugs and the floor itself do not stand in the room
MOST = 2000  # outlines in a drawing


def tops(polygons, floor, ceiling, units):
    """The polygons that face up between two heights, the lowest first: the tops of furniture, beams and what else there is."""
    found = [p for p in polygons if p.vector()[2] > 0.9 * np.linalg.norm(p.vector()) > 0]
    gap = ABOVE_FLOOR * units
    found = [p for p in found if floor + gap < p.corners[:, 2].mean() < ceiling - gap]
    return sorted(found, key=lambda p: p.corners[:, 2].mean())[:MOST]


def above(scene, points, normals):
    """The name of what each point faces, boxes as a whole."""
    names = scene.trace(np.hstack([points, normals]), outputs="s").surface
    return [Polygon(name, "", np.zeros((0, 3))).box() for name in names]


def covered_text(scene, surface):
    """Which of the points of a surface lie under what."""
    count, left = len(surface.covered), len(surface.points)
    up = np.broadcast_to(surface.normals[0], surface.covered.shape)
    under = Counter(above(scene, surface.covered, up)).most_common(6)
    return (f"{surface.name}: {count} of {count + left} points are left out, which get no light straight from any candidate, since they lie under "
            + ", ".join(f"{name} ({number})" for name, number in under))


def darkest_text(scene, name, place, normal, value, below):
    """Where a goal is darkest, and under what, if that is lower than below."""
    over = above(scene, place[None], normal[None])[0]
    hit = scene.trace(np.hstack([place, normal])[None], outputs="L").first_length[0]
    under = f", under {over}" if normal[2] > 0.9 and place[2] + hit < below else ""
    return f"{name} is darkest at {' '.join(f'{v:.2f}' for v in place[:2])}: {value:.0%} of the mean{under}"
