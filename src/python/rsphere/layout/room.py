"""The room: its polygons by name, and surfaces of goals with points on them."""
import difflib
import fnmatch
import os
import re
import subprocess
from dataclasses import dataclass, field

import numpy as np

from ..command import program
from ..fault import Fault, fault, fault_of

LIFT = 0.004  # m: surfaces of goals lie this far above what they cover, and above sheets of paper on it
FACE = re.compile(r"\.(1540|4620|6457|3267|5137|2310)\Z")  # behind the name of a box
BYTE = re.compile(r"\\x([89a-f][0-9a-f])")  # plan's word for a byte that is not UTF-8: Latin-1, as a surrogate
MOST_CELLS = 20000  # of a polygon
FINE = 6  # points along each side of a cell
EDGE = 24  # points along each edge of an outline
PARTS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 4  # points in a cell, from its middle, by its sides


def vector_of(corners):
    """The normal of a polygon's front, as long as its area is large."""
    c = corners - corners[0]
    return np.cross(c, np.roll(c, -1, axis=0)).sum(axis=0) / 2


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
        return vector_of(self.corners)


@dataclass
class Surface:
    """Polygons that are one goal, divided into cells of about equal area.

    The illuminance of a cell, which stands for a sensor, is the mean of four points in it.
    """

    name: str
    polygons: list
    side: int  # 1: their fronts, -1: their backs
    outlines: list  # of what is inside the margin: corners (n, 3) and normals; the mean is that over them
    cells: np.ndarray  # the corners (n, 4, 3)
    points: np.ndarray  # (4 n, 3), those of a cell one after the other
    normals: np.ndarray  # (4 n, 3)
    cell_of: np.ndarray  # (4 n,), the number of the cell of each point
    covered: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))  # points that are left out: inside of furniture

    def area(self):
        """In square units of the scene."""
        return sum(np.linalg.norm(vector_of(corners)) for corners, _ in self.outlines)

    def leave_out(self, covered):
        """Leaves out points that are covered, and the parts of the surface that they stand for. covered: of each point."""
        outlines = list(self.open_strips(~covered))
        self.covered, self.outlines = self.points[covered], outlines
        self.points, self.normals, self.cell_of = self.points[~covered], self.normals[~covered], self.cell_of[~covered]

    def open_strips(self, is_open):
        """The quarters of cells around open points, those side by side as one: corners and normals."""
        corner, right, up = self.cells[:, 0], (self.cells[:, 1] - self.cells[:, 0]) / 2, (self.cells[:, 3] - self.cells[:, 0]) / 2
        which, normals = is_open.reshape(-1, 4), self.normals[::4]
        for upper, pair in ((0, (0, 1)), (1, (3, 2))):  # the halves of rows of cells, in the order of PARTS
            strip = None
            for cell in range(len(self.cells)):
                for aside, point in enumerate(pair):
                    low = corner[cell] + aside * right[cell] + upper * up[cell]
                    quarter = np.array([low, low + right[cell], low + right[cell] + up[cell], low + up[cell]])
                    goes_on = strip is not None and np.allclose(strip[0][1:3], quarter[[0, 3]], atol=1e-6 * np.abs(right[cell]).max())
                    if strip is not None and not (goes_on and which[cell, point]):
                        yield strip
                        strip = None
                    if which[cell, point]:
                        strip = (np.array([quarter[0] if strip is None else strip[0][0], quarter[1], quarter[2],
                                           quarter[3] if strip is None else strip[0][3]]), normals[cell])
            if strip is not None:
                yield strip

    def fine_points(self):
        """Points spread over all cells, FINE along each of their sides, and along the outlines."""
        part = (np.arange(FINE) + 0.5) / FINE
        u, v = (x.ravel()[:, None] for x in np.meshgrid(part, part))
        corner, right, up = self.cells[:, :1], self.cells[:, 1:2] - self.cells[:, :1], self.cells[:, 3:] - self.cells[:, :1]
        edges = [c + t * (np.roll(c, -1, axis=0) - c) for c, _ in self.outlines for t in np.linspace(0, 1, EDGE, endpoint=False)]
        return np.concatenate([(corner + u * right + v * up).reshape(-1, 3), *edges])



def read_polygons(files):
    """All polygons of scene files, by the program plan, which reads them as rsphere does."""
    real = [*map(os.path.realpath, files)]
    for file, path in zip(files, real):
        if real.count(path) > 1:
            raise Fault(f"{file}: is named twice; its surfaces would lie in each other")
    try:
        run = subprocess.run([program("plan"), "-a", *files], capture_output=True, check=False,
                             encoding="utf-8", errors="surrogateescape")
    except OSError:
        raise Fault("the program plan is missing; cmake --build build --target plan makes it, PROGRAMS names its folder") from None
    if run.returncode:
        raise fault_of(run.stderr)
    polygons = []
    for line in run.stdout.split("\n")[:-1]:
        name, modifier, numbers = BYTE.sub(lambda found: chr(0xDC00 + int(found[1], 16)), line).split("\t")
        polygons.append(Polygon(name, modifier, np.array(numbers.split(), dtype=float).reshape(-1, 3)))
    return polygons


def plan_of(path, words, raypath_of):
    """The drawing that the program plan writes to a path."""
    run = subprocess.run([program("plan"), "-o", path, *words], capture_output=True, text=True, check=False, env=dict(os.environ, RAYPATH=raypath_of))
    if run.returncode:
        raise fault_of(run.stderr)
    with open(path, encoding="utf-8", errors="replace") as stream:
        return stream.read()


def mirrors_among(files):
    """The materials of surfaces that mirror light without blur: special objects (rsphere -Sl) that are not panes of glass."""
    command = [program("rsphere"), "-h", "-w-", "-Sl", *files]
    run = subprocess.run(command, capture_output=True, check=False, stdin=subprocess.DEVNULL, encoding="utf-8", errors="surrogateescape")
    kinds = [line.split("\t")[1].split(" ")[0] for line in run.stdout.splitlines() if line.count("\t") >= 3]
    return {kind for kind in kinds if kind not in ("glass", "mist", "antimatter")}


def names_matching(polygons, pattern):
    """Names of boxes and polygons, or else of their modifiers, that match a pattern (desk*), in the order of the scene."""
    for names in ([p.box() for p in polygons], [p.modifier for p in polygons], [p.name for p in polygons]):
        found = [n for n in dict.fromkeys(names) if fnmatch.fnmatchcase(n, pattern)]
        if found:
            return found
    return []


def upward(polygons):
    """Those that face up."""
    return [p for p in polygons if p.vector()[2] > 0.999 * np.linalg.norm(p.vector()) > 0]


def polygons_named(polygons, name, place):
    """The polygons of a name, or else of a box or a modifier; of these, those that face up if some do. place: file and line."""
    named = [p for p in polygons if p.name == name]
    if not named:
        named = [p for p in polygons if p.box() == name] or [p for p in polygons if p.modifier == name]
        named = upward(named) or named
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


def flat_frame(polygon):
    """The origin and two unit vectors of a polygon's plane, parallel to its first edge, and its corners there (n, 2)."""
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
    return origin, right, up, np.stack([(polygon.corners - origin) @ right, (polygon.corners - origin) @ up], axis=1)


def inside_margin(polygon, margin):
    """The corners of the part of a polygon that is inside of its bounding rectangle by a margin; none if there is no such part."""
    if not margin > 0:
        return polygon.corners
    origin, right, up, flat = flat_frame(polygon)
    low, high = flat.min(axis=0) + margin, flat.max(axis=0) - margin
    for axis in range(2):  # Sutherland and Hodgman 1974
        for bound, sign in ((low[axis], 1), (high[axis], -1)):
            kept = []
            for a, b in zip(flat, np.roll(flat, -1, axis=0)):
                da, db = sign * (a[axis] - bound), sign * (b[axis] - bound)
                if da >= 0:
                    kept.append(a)
                if da * db < 0:
                    kept.append(a + (b - a) * da / (da - db))
            if len(kept) < 3:
                return np.zeros((0, 3))
            flat = np.array(kept)
    return origin + flat[:, :1] * right + flat[:, 1:] * up


def distance(corners, points):
    """How far points (n, 2) are from a polygon (m, 2); 0 inside."""
    nearest = np.full(len(points), np.inf)
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        along = b - a
        t = ((points - a) @ along / max(along @ along, 1e-300)).clip(0, 1)
        nearest = np.minimum(nearest, np.hypot(*(points - a - t[:, None] * along).T))
    return np.where(inside(corners, points), 0.0, nearest)


def cells_of(polygon, spacing, margin, place):
    """The middles and corners of cells of at most a spacing, parallel to the first edge, with the middle inside."""
    origin, right, up, flat = flat_frame(polygon)
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
    outlines = [inside_margin(p, margin) for p in named]
    named = [p for p, o in zip(named, outlines) if len(o)]
    outlines = [(o, side * p.vector() / np.linalg.norm(p.vector())) for o, p in zip((o for o in outlines if len(o)), named)]
    points, normals, cells = [], [], []
    for p, (outline, normal) in zip(named, outlines):
        size = np.ptp(outline @ np.stack(frame_of(normal)).T, axis=0)
        most = spacing or min(standard_spacing(*(size / units)) * units, np.sqrt(np.linalg.norm(vector_of(outline)) / 6))
        for corners in cells_of(p, most, margin, place)[1]:
            sides = np.stack([corners[1] - corners[0], corners[3] - corners[0]])
            cells.append(corners)
            points += list(corners.mean(axis=0) + PARTS @ sides + normal * 1.5 * LIFT * units)
            normals += [normal] * 4
    if not points:
        raise fault(*place, f'no sensor fits on "{name}"; is its margin too wide?')
    return Surface(name, named, side, outlines, np.array(cells), np.array(points), np.array(normals), np.arange(len(points)) // 4)


def goal_text(surface, modifier, units):
    """Scene text of a surface that emits importance: its outlines, a little above themselves."""
    text = f"inherit alias {modifier} {surface.polygons[0].modifier}\n"  # with its pattern
    for i, (outline, normal) in enumerate(surface.outlines):
        corners = outline + normal * LIFT * units
        corners = corners if vector_of(corners) @ normal > 0 else corners[::-1]
        shown = " ".join(f"{v:.9g}" for v in corners.ravel())
        text += f"{modifier} polygon {modifier}.{i + 1}\n0\n0\n{corners.size} {shown}\n"
    return text
