"""Where light is computed: sensors of a file, or a grid over work planes of the scene; and the files of the scene, if it is an octree."""
import os
import subprocess
from html import escape

import numpy as np

from ..command import program
from ..fault import fault, fault_of, lines_of, number, write_text
from ..layout.room import frame_of, inside, polygons_named
from .areas import areas_of

WORDS = ("x", "y", "z", "the direction along x", "the direction along y", "the direction along z")


MOST_OF_OCTREE = 1 << 16  # bytes, header and names
OCTREE = b"FORMAT=Radiance_octree"
CUBE = 4  # its origin and size, as strings
COLORS = np.array([[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]])  # from low to high, readable without color vision
WIDE, EDGE = 700, 40  # of a plan, pixels
SAME_PLANE = 1e-3  # of the size of a polygon: how far it may be from a plane in which it lies
SAMPLE = 200  # sensors by which their spacing is judged


def scene_files(path):
    """The scene files that an octree of oconv was made of, or the file itself if it is no octree."""
    try:
        with open(path, "rb") as stream:
            header, _, data = stream.read(MOST_OF_OCTREE).partition(b"\n\n")
    except OSError:
        return [path]  # readers of scenes say what is wrong
    if not header.startswith(b"#?") or OCTREE not in header:
        return [path]
    names = data[2:].split(b"\0")[CUBE:]  # behind two bytes
    files = [os.fsdecode(name) for name in names[: names.index(b"")]] if b"" in names else []
    if not files:
        raise fault(path, None, "is a frozen octree, to which no sky can be added: give the scene files that it was made of")
    return files


def read_sensors(path, kind="a sensor"):
    """Rows of a place and the direction that a sensor, or an eye, faces."""
    rows = []
    for line, text in enumerate(lines_of(path), 1):
        words = text.split()
        if not words:
            continue
        if len(words) != 6:
            raise fault(path, line, f"{kind} is a place and the direction that it faces, x y z dx dy dz, not {len(words)} words")
        rows.append([number(word, path, line, what) for word, what in zip(words, WORDS)])
        if not any(rows[-1][3:]):
            raise fault(path, line, f"the direction of {kind} must not be 0 0 0")
    if not rows:
        raise fault(path, None, "has no sensors" if kind == "a sensor" else "has no eyes")
    return np.array(rows)


def plan_command(given, name):
    return [program("plan"), "-s", name, "-h", f"{given.height:.9g}", "-d", f"{given.spacing:.9g}", "-m", f"{given.margin:.9g}"]


def polygons_below(sensors, height, name, polygons):
    """The polygons over which plan lays a grid: of a name, or else of a modifier, whichever side is up; or of its aliases, which plan alone knows."""
    normal = sensors[0, 3:]
    feet, frame = sensors[:, :3] - height * normal, np.stack(frame_of(normal), axis=1)
    has = lambda p: inside(p.corners @ frame, feet @ frame) & (np.abs((feet - p.corners[0]) @ normal) < SAME_PLANE * np.ptp(p.corners, axis=0).max())  # noqa: E731
    named = [p for p in polygons if p.name == name] or [p for p in polygons if p.modifier == name]
    lost = ~np.any([has(p) for p in named], axis=0)
    return named + [p for p in polygons if (has(p) & lost).any()]


def sensors_on(given, polygons):
    """The sensors of a grid over each of the work planes, by the rules of the program plan; the share of the area of each; and, for each
    work plane, its name and which of the sensors are on it."""
    rows, areas, planes = [], [], []
    for name in given.on:
        polygons_named(polygons, name, ("--on " + name, None))  # or a fault with names that resemble it
        run = subprocess.run([*plan_command(given, name), "-p", *given.scene], capture_output=True, text=True, check=False)
        if run.returncode:
            raise fault_of(run.stderr)
        found = [[float(word) for word in line.split()] for line in run.stdout.splitlines()]
        planes.append((name, slice(len(rows), len(rows) + len(found))))
        rows += found
        areas += [*areas_of(np.array(found), polygons_below(np.array(found), given.height, name, polygons), given.margin)]
    return np.array(rows), np.array(areas) / sum(areas), planes


def draw(given, name, values, unit, title, path):
    """A plan of values of the sensors on a work plane, as SVG."""
    write_text(path + ".txt", "".join(f"{v:.6g}\n" for v in values))
    levels = ["-l", "10,20,30,40,50,60,70,80,90"] if unit == "%" else []
    command = [*plan_command(given, name), *levels, "-q", unit, "-i", path + ".txt", "-o", path, "-t", title, *given.scene]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    os.remove(path + ".txt")
    if run.returncode:
        raise fault_of(run.stderr)
    with open(path, encoding="utf-8", errors="replace") as stream:
        return stream.read()


def draw_points(sensors, polygons, values, unit, title, path):
    """A plan of values of sensors that are in no grid, as SVG: seen from above, with the outlines of floors around them."""
    low, high = sensors[:, :2].min(axis=0), sensors[:, :2].max(axis=0)
    some = sensors[:: max(1, len(sensors) // SAMPLE), :2]
    apart = np.linalg.norm(some[:, None] - sensors[None, :, :2], axis=2)
    apart = np.where(apart > 0, apart, np.inf).min(axis=1, initial=np.inf)
    spacing = float(np.median(apart[np.isfinite(apart)])) if np.isfinite(apart).any() else 1.0
    low, high = low - spacing, high + spacing
    scale = (WIDE - 2 * EDGE) / max(high - low)
    at = lambda p: np.stack([EDGE + (p[..., 0] - low[0]) * scale, EDGE + (high[1] - p[..., 1]) * scale], axis=-1)  # noqa: E731
    width, tall = at(np.array([high[0], low[1]])) + EDGE
    most = 100 if unit == "%" else max(values.max(), 1e-9)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {tall:.0f}" font-family="sans-serif">',
             '<rect width="100%" height="100%" fill="white"/>', f'<text x="{EDGE}" y="{EDGE / 2}" font-size="14">{escape(title)}</text>']
    for p in polygons:
        inside = (p.corners[:, :2].min(axis=0) < high).all() and (p.corners[:, :2].max(axis=0) > low).all()
        if inside and p.vector()[2] > 0.99 * np.linalg.norm(p.vector()) and p.corners[0, 2] <= sensors[:, 2].max():
            corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in at(np.clip(p.corners[:, :2], low, high)))
            lines.append(f'<polygon points="{corners}" fill="none" stroke="#888"/>')
    for place, value in zip(at(sensors[:, :2]), values):
        part = np.clip(value / most, 0, 1) * (len(COLORS) - 1)
        red, green, blue = (np.interp(part, range(len(COLORS)), COLORS[:, i]) for i in range(3))
        lines.append(f'<circle cx="{place[0]:.1f}" cy="{place[1]:.1f}" r="{0.45 * spacing * scale:.1f}" fill="rgb({red:.0f},{green:.0f},{blue:.0f})"/>')
        lines.append(f'<text x="{place[0]:.1f}" y="{place[1]:.1f}" font-size="{0.35 * spacing * scale:.1f}" text-anchor="middle" dominant-baseline="central" '
                     f'fill="{"#000" if part > 2.5 else "#fff"}">{value:.0f}</text>')
    svg = "\n".join(lines) + "\n</svg>\n"
    write_text(path, svg)
    return svg
