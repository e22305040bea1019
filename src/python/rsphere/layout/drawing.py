"""The drawing of a layout from above (SVG)."""
from html import escape

import numpy as np

from .built import outline
from .standing import tops

COLORS = ("#e8a200", "#2277cc", "#bb3377", "#228855", "#775544")  # of kinds of luminaires


def label(text, size, across, down, anchor="start", color="#222"):
    return f'<text x="{across:.1f}" y="{down:.1f}" font-size="{size}" text-anchor="{anchor}" fill="{color}">{escape(text)}</text>'


def overlap(a, b):
    """The area that two rectangles (left, top, right, bottom) share."""
    return max(0.0, min(a[2], b[2]) - max(a[0], b[0])) * max(0.0, min(a[3], b[3]) - max(a[1], b[1]))


def beside(middle, half, words, others):
    """Where the number of a small luminaire is written: at that of its sides where it covers the least of others, first at the upper right."""
    (x, y), width = middle, 6.8 * len(words)
    places = [(x + half[0] + 2, y - half[1] + 2), (x + half[0] + 2, y + half[1] + 6), (x - half[0] - 2 - width, y - half[1] + 2),
              (x - half[0] - 2 - width, y + half[1] + 6)]
    return min(places, key=lambda p: sum(overlap((p[0], p[1] - 9, p[0] + width, p[1]), other) for other in others))


def free_place(corners, words, size, taken, dots):
    """Where the label of a surface covers nothing that is taken, and then no dots: at a corner, or else along its lower or upper edge;
    the lower left corner if that is free. taken: rectangles (left, top, right, bottom), to which its own is added."""
    (left, top), (right, bottom), width = corners.min(axis=0), corners.max(axis=0), 0.62 * size * len(words)
    last = max(left + 4, right - 2 - width)
    places = [(x, y) for across in ((left + 4, last), np.arange(left + 8, last, 4)) for y in (bottom - 4, top + 12) for x in across]

    def clearance(place, others, enough):
        x, y = place
        gaps = (np.hypot(max(l - x - width, x - r, 0), max(t - y, y - size - b, 0)) for l, t, r, b in others)
        return min(enough, min(gaps, default=enough))

    x, y = max(places, key=lambda place: (clearance(place, taken, 8), clearance(place, dots, 2)))
    taken.append((x, y - size, x + width, y))
    return x, y


def shape(corners, style):
    return f'<path d="M{"L".join(f"{x:.1f} {y:.1f}" for x, y in corners)}Z" {style}/>'


def scale_bar(pixels, units, down):
    """A bar of 1 m (or 2, 5, 10, ...) at the right; pixels: in a unit of the scene."""
    metres = next((m for m in (1, 2, 5, 10, 20, 50) if m * units * pixels > 40), 100)
    length = metres * units * pixels
    return (f'<path d="M{680 - length:.1f} {down - 5:.1f}v5h{length:.1f}v-5" fill="none" stroke="#222"/>'
            + label(f"{metres} m", 12, 680 - length - 6, down, "end"))


def drawing(design, polygons, candidates, chosen, levels, title, darkest=()):
    """Outlines of the room, of what stands in it and of what is wanted, candidates as dots, luminaires to scale with numbers and levels.

    darkest: places where goals are.
    """
    flat = [p for p in polygons if abs(p.vector()[2]) > 0.9 * np.linalg.norm(p.vector()) > 0]
    room = max(flat, key=lambda p: abs(p.vector()[2]))
    shown = [room.corners, *(c for surface in design.surfaces.values() for c, _ in surface.outlines), [c.position for c in design.candidates]]
    shown = np.concatenate(shown)[:, :2]  # a street has goals beside the largest polygon
    low, high = shown.min(axis=0), shown.max(axis=0)
    scale = 660 / max(high[0] - low[0], 1e-9)
    height = (high[1] - low[1]) * scale
    to = lambda p: np.stack([(p[..., 0] - low[0]) * scale + 20, height - (p[..., 1] - low[1]) * scale + 40], axis=-1)  # noqa: E731
    outlines, dots = [to(outline(design, candidates[j])) for j in chosen], to(np.unique(np.round([c.position for c in design.candidates], 6), axis=0))
    number = 44 if design.dims() else 10
    taken = [(*(c.min(axis=0) - (0, 8)), *(c.max(axis=0) + (number, 0))) for c in outlines]  # a small one has its number at its upper right
    taken += [(x - 6, y - 6, x + 6, y + 6) for x, y in (to(p) for p in darkest)]
    around_dots = [(x - 1, y - 1, x + 1, y + 1) for x, y in dots]
    parts, names = [label(title, 15, 20, 24), shape(to(room.corners), 'fill="#f6f4ef" stroke="#555" stroke-width="2"')], []
    wanted = {id(p) for surface in design.surfaces.values() for p in surface.polygons}
    floor = max((p for p in flat if p.vector()[2] > 0), key=lambda p: p.vector()[2], default=room)
    standing = [p for p in tops(polygons, floor.corners[:, 2].max(), max(p.corners[:, 2].max() for p in polygons), design.units) if id(p) not in wanted]
    for p in standing:
        corners, size = to(p.corners), np.ptp(to(p.corners), axis=0)
        over = p.corners[:, 2].min() > min(c.position[2] for c in candidates) - design.units  # beams: what is below shows
        parts.append(shape(corners, 'fill="none" stroke="#b5aea0" stroke-dasharray="3 3"' if over else 'fill="#e4dfd3" stroke="#b5aea0"'))
        if size[0] > 6.2 * len(p.box()) and size[1] > 14:
            names.append(label(p.box(), 9, *free_place(corners, p.box(), 9, taken, around_dots), color="#857d6c"))
    for surface in sorted(design.surfaces.values(), key=lambda s: -s.area()):  # small ones on top
        for p in surface.polygons:
            corners = to(p.corners)
            # A goal about as large as the room would hide the room.
            large = abs(p.vector()[2]) > 0.5 * abs(room.vector()[2])
            style = 'fill="none" stroke="#5a8a63" stroke-dasharray="6 4"' if large else 'fill="#cfe3d2" stroke="#5a8a63"'
            parts.append(shape(corners, style))
        size = np.ptp(corners, axis=0)
        if size[0] > 6.2 * len(surface.name) and size[1] > 16:
            names.append(label(surface.name, 10, *free_place(corners, surface.name, 10, taken, around_dots), color="#3a6343"))
    for x, y in dots:
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.3" fill="#999"/>')
    for eye in design.eyes.values():
        x, y = to(eye.position)
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="#b22"/>')
        if eye.gaze is not None:
            parts.append(f'<path d="M{x:.1f} {y:.1f}l{16 * eye.gaze[0]:.1f} {-16 * eye.gaze[1]:.1f}" stroke="#b22" stroke-width="2"/>')
        names.append(label(eye.name, 10, x, y + 15, "middle", "#b22"))
    for sensor in design.sensors.values():
        x, y = to(sensor.position)
        parts.append(f'<path d="M{x - 4:.1f} {y:.1f}h8m-4 -4v8" stroke="#3a6343" stroke-width="2"/>')
        names.append(label(sensor.name, 10, x, y + 15, "middle", "#3a6343"))
    for number, (j, level, corners) in enumerate(zip(chosen, levels, outlines), 1):
        color, photometry = COLORS[candidates[j].luminaire % len(COLORS)], design.luminaires[candidates[j].luminaire].photometry
        style = f'fill="{color}" fill-opacity="{0.15 + 0.7 * level:.2f}" stroke="#222"'
        (x, y), half = corners.mean(axis=0), np.ptp(corners, axis=0) / 2
        round_one = photometry.shape != "box" and abs(candidates[j].aim[2]) > 0.999
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{half[0]:.1f}" {style}/>' if round_one else shape(corners, style))
        text = str(number) if level > 0.995 else f"{number}: {level:.0%}"
        inside = half[0] > 3.4 * len(text) and half[1] > 7
        others = [(*c.min(axis=0), *c.max(axis=0)) for c in outlines if c is not corners]
        names.append(label(text, 11, *((x, y + 4, "middle") if inside else beside((x, y), half, text, others))))
    for x, y in (to(place) for place in darkest):
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="none" stroke="#3a6343" stroke-width="2"/>')
    for i, l in enumerate(design.luminaires):
        parts.append(f'<rect x="{20 + 180 * (i % 3)}" y="{height + 54 + 20 * (i // 3):.0f}" width="22" height="12" '
                     f'fill="{COLORS[i % len(COLORS)]}" stroke="#222"/>')
        parts.append(label(f"{l.name} {l.watts:g} W", 12, 48 + 180 * (i % 3), height + 64 + 20 * (i // 3)))
    bottom = height + 64 + 20 * ((len(design.luminaires) - 1) // 3)
    parts.append(scale_bar(scale, design.units, bottom))
    legend = ["dots: where luminaires may hang" + "; green: goals" * bool(design.surfaces or design.sensors) + "; red: eyes" * bool(design.eyes)]
    legend.append("; ".join(["rings: where goals are darkest"] * bool(len(darkest)) + ["grey: what stands in the room"] * bool(standing)))
    for line in filter(None, legend):
        bottom += 20
        parts.append(label(line, 12, 20, bottom + 2))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="700" height="{bottom + 16:.0f}" viewBox="0 0 700 {bottom + 16:.0f}" '
            f'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>{"".join(parts)}{"".join(names)}</svg>\n')
