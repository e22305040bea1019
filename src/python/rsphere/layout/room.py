"""The room: its polygons by name, and surfaces of goals with points on them."""
import difflib
import fnmatch
import re
import subprocess
from dataclasses import dataclass

import numpy as np

from ..command import program
from ..fault import Fault, fault

LIFT = 0.004  # m: surfaces of goals lie this far above what they cover, and above sheets of paper on it
FACE = re.compile(r"\.(1540|4620|6457|3267|5137|2310)\Z")  # behind the name of a box
BYTE = re.compile(r"\\x([89a-f][0-9a-f])")  # plan's word for a byte that is not UTF-8: Latin-1, as a surrogate
MOST_CELLS = 20000  # of a polygon
FINE = 6  # points along each side of a cell
PARTS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 4  # points in a cell, from its middle, by its sides


@dataclass
class Polygon:
    name: str
    modifier: str
    corners: np.ndarray  # (n, 3), in units of the scene

    def box(self):
        """The name of the box of RADIANCE's genbox that this is a face of; else the polygon's own."""
        return FACE.sub("", self.name)

    def vector(self):
        """The normal of the front, as long as the area is large."""
        c = self.corners - self.corners[0]
        return np.cross(c, np.roll(c, -1, axis=0)).sum(axis=0) / 2


@dataclass
class Surface:
    """Polygons that are one goal, divided into cells of about equal area.

    The illuminance of a cell, which stands for a sensor, is the mean of four points in it.
    """

    name: str
    polygons: list
    side: int  # 1: their fronts, -1: their backs
    area: float  # in square units of the scene
    cells: np.ndarray  # the corners (n, 4, 3)
    points: np.ndarray  # (4 n, 3), those of a cell one after the other
    normals: np.ndarray  # (4 n, 3)

    def fine_points(self):
        """Points spread over all cells, FINE along each of their sides."""
        part = (np.arange(FINE) + 0.5) / FINE
        u, v = (x.ravel()[:, None] for x in np.meshgrid(part, part))
        corner, right, up = self.cells[:, :1], self.cells[:, 1:2] - self.cells[:, :1], self.cells[:, 3:] - self.cells[:, :1]
        return (corner + u * right + v * up).reshape(-1, 3)


def read_polygons(files):
    """All polygons of scene files, by the program plan, which reads them as rsphere does."""
    try:
        run = subprocess.run([program("plan"), "-a", *files], capture_output=True, check=False,
                             encoding="utf-8", errors="surrogateescape")
    except OSError:
        raise Fault("the program plan is missing; cmake --build build --target plan makes it, PROGRAMS names its folder") from None
    if run.returncode:
        raise Fault(run.stderr.strip().split("\n")[-1].removeprefix("plan: fatal - "))
    polygons = []
    for line in run.stdout.split("\n")[:-1]:
        name, modifier, numbers = BYTE.sub(lambda found: chr(0xDC00 + int(found[1], 16)), line).split("\t")
        polygons.append(Polygon(name, modifier, np.array(numbers.split(), dtype=float).reshape(-1, 3)))
    return polygons


def has_mirrors(files):
    """Whether surfaces mirror light without blur: special objects (rsphere -Sl) that are not panes of glass."""
    command = [program("rsphere"), "-h", "-w-", "-Sl", *files]
    run = subprocess.run(command, capture_output=True, check=False, stdin=subprocess.DEVNULL, encoding="utf-8", errors="surrogateescape")
    kinds = [line.split("\t")[1].split(" ")[0] for line in run.stdout.splitlines() if line.count("\t") >= 3]
    return any(kind not in ("glass", "mist", "antimatter") for kind in kinds)


def names_matching(polygons, pattern):
    """Names of boxes and polygons, or else of their modifiers, that match a pattern (desk*), in the order of the scene."""
    for names in ([p.box() for p in polygons], [p.modifier for p in polygons], [p.name for p in polygons]):
        found = [n for n in dict.fromkeys(names) if fnmatch.fnmatchcase(n, pattern)]
        if found:
            return found
    return []


def polygons_named(polygons, name, place):
    """The polygons of a name, or else of a box or a modifier; of these, those that face up if some do. place: file and line."""
    named = [p for p in polygons if p.name == name]
    if not named:
        named = [p for p in polygons if p.box() == name] or [p for p in polygons if p.modifier == name]
        up = [p for p in named if p.vector()[2] > 0.999 * np.linalg.norm(p.vector())]
        named = up or named
    named = [p for p in named if np.linalg.norm(p.vector()) > 0]
    if not named:
        known = sorted({p.box() for p in polygons} | {p.modifier for p in polygons})
        near = difflib.get_close_matches(name, known, 4, 0.5) or [p.name for p in sorted(polygons, key=lambda p: -abs(p.vector()[2]))[:4]]
        raise fault(*place, f'the scene has no polygon or modifier "{name[:60]}"; it has {", ".join(near) or "no polygons"}')
    return named


def frame_of(normal):
    """Two unit vectors along a plane: to the right and up; x and y if it is horizontal."""
    if abs(normal[2]) > 0.99999:
        return np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
    right = np.cross([0, 0, 1.0], normal)
    right /= np.linalg.norm(right)
    return right, np.cross(normal, right)


def inside(corners, points):
    """Whether points (n, 2) are inside of a polygon (m, 2), by an odd number of crossings."""
    odd = np.zeros(len(points), dtype=bool)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0)):
        if ay != by:
            crosses = (points[:, 1] < ay) != (points[:, 1] < by)
            odd ^= crosses & (points[:, 0] < ax + (bx - ax) * (points[:, 1] - ay) / (by - ay))
    return odd


def cells_of(polygon, spacing, margin, place):
    """The middles and corners of cells of at most a spacing, parallel to the first edge, with the middle inside."""
    normal = polygon.vector() / np.linalg.norm(polygon.vector())
    right, up = frame_of(normal)
    edge = polygon.corners[1] - polygon.corners[0]
    if np.linalg.norm(edge) > 0 and abs(normal[2]) > 0.99999:
        right = edge / np.linalg.norm(edge)
        if abs(right[1]) > abs(right[0]):
            right = np.array([right[1], -right[0], 0])
        right = right if right[0] > 0 else -right
        up = np.array([-right[1], right[0], 0])
    origin = polygon.corners[0]
    flat = np.stack([(polygon.corners - origin) @ right, (polygon.corners - origin) @ up], axis=1)
    low, high = flat.min(axis=0) + margin, flat.max(axis=0) - margin
    if not (high > low).all():
        return np.zeros((0, 3)), [], (0, 0)
    counts = np.maximum(np.ceil((high - low) / np.asarray(spacing) - 1e-6).astype(int), 1)
    if np.prod(counts.astype(float)) > MOST_CELLS:
        raise fault(*place, f'the spacing makes more than {MOST_CELLS} points on "{polygon.name}"; is it in the units of the scene?')
    step = (high - low) / counts
    v, u = np.meshgrid(*(low[i] + (np.arange(counts[i]) + 0.5) * step[i] for i in (1, 0)), indexing="ij")
    middles = np.stack([u.ravel(), v.ravel()], axis=1)
    middles = middles[inside(flat, middles)]
    around = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2 * step
    at = lambda p: origin + p[..., :1] * right + p[..., 1:] * up  # noqa: E731
    return at(middles), [at(m + around) for m in middles], step


def standard_spacing(length, width):
    """The largest spacing of EN 12464-1 (m)."""
    longer, shorter = max(length, width), min(length, width)
    d = shorter if longer >= 2 * shorter * (1 - 1e-9) else longer
    return min(0.2 * 5 ** np.log10(max(d, 1e-3)), 10.0)


def surface_of(polygons, name, place, units, back=False, spacing=None, margin=0.0):
    """The surface of a goal. spacing, margin: of its sensors, in units of the scene (EN 12464-1's, at least 6 points)."""
    named = polygons_named(polygons, name, place)
    side = -1 if back else 1
    area = sum(np.linalg.norm(p.vector()) for p in named)
    points, normals, cells = [], [], []
    for p in named:
        normal = side * p.vector() / np.linalg.norm(p.vector())
        size = np.ptp(p.corners @ np.stack(frame_of(normal)).T, axis=0)
        most = spacing or min(standard_spacing(*(size / units)) * units, np.sqrt(np.linalg.norm(p.vector()) / 6))
        for corners in cells_of(p, most, margin, place)[1]:
            sides = np.stack([corners[1] - corners[0], corners[3] - corners[0]])
            cells.append(corners)
            points += list(corners.mean(axis=0) + PARTS @ sides + normal * 1.5 * LIFT * units)
            normals += [normal] * 4
    if not points:
        raise fault(*place, f'no sensor fits on "{name}"; is its margin too wide?')
    return Surface(name, named, side, area, np.array(cells), np.array(points), np.array(normals))


def goal_text(surface, modifier, units):
    """Scene text of a surface that emits importance: its polygons, a little above themselves."""
    text = f"void alias {modifier} {surface.polygons[0].modifier}\n"
    for i, p in enumerate(surface.polygons):
        normal = surface.side * p.vector() / np.linalg.norm(p.vector())
        corners = (p.corners + normal * LIFT * units)[:: surface.side]
        shown = " ".join(f"{v:.9g}" for v in corners.ravel())
        text += f"{modifier} polygon {modifier}.{i + 1}\n0\n0\n{corners.size} {shown}\n"
    return text
