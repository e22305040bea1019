"""The UGR table of a luminaire as text, comma-separated values, or a drawing (SVG)."""
from html import escape

from .ugr_table import HEIGHT, LEAST_UGR, REFLECTANCES, ROOMS

VIEWS = "crosswise", "endwise"
SURFACES = "ceiling", "walls", "plane"


def number(value):
    """A fraction as it is written in tables: .25."""
    return f"{value:g}".removeprefix("0")


def rating(value):
    """A value of the table. Ratings below 10 are not told apart."""
    return f"{value:.1f}" if value >= LEAST_UGR else f"<{LEAST_UGR}"


def title(table):
    p = table.photometry
    return f"UGR of {' '.join(p.name.split())}, {p.lumens():.0f} lm, in rooms of X by Y"


def conditions(table):
    return (f"CIE 117:1995, CIE 190:2010: luminaires H = {HEIGHT:g} m above the eye, {number(table.spacing)} H apart; "
            "background: walls by reflected light")


def reflectances(i):
    """Of one kind of surface, in all columns."""
    return [number(r[i]) for r in REFLECTANCES] * len(VIEWS)


def blocks(table):
    """Rooms of one X (in H): X, and Y and the ratings of each."""
    rooms = [(room, [rating(v) for v in values]) for room, values in zip(ROOMS, table.values)]
    return [(across, [(room[1], values) for room, values in rooms if room[0] == across]) for across in dict.fromkeys(x for x, _ in ROOMS)]


def text(table):
    """The table with aligned columns; lines of words begin with #, so that programs read the rest as they read csv()."""
    half = len(REFLECTANCES)
    line = lambda cells: "".join(f"{c:>6}" for c in cells[:half]) + "  " + "".join(f"{c:>6}" for c in cells[half:])  # noqa: E731
    lines = [f"# {title(table)}", f"# {conditions(table)}", "#", f"#{'':9}{VIEWS[0]:^{6 * half}}  {VIEWS[1]:^{6 * half}}".rstrip()]
    lines += [f"# {surface:<8}" + line(reflectances(i)) for i, surface in enumerate(SURFACES)]
    for across, rooms in blocks(table):
        lines.append(f"# X = {across}H, Y = {', '.join(f'{y}H' for y, _ in rooms)}")
        lines += [" " * 11 + line([v + "," for v in values]).rstrip(",") for _, values in rooms]
    return "\n".join(lines) + "\n"


def csv(table):
    """19 rows of 10 numbers, behind lines of what they mean."""
    lines = [f"# {title(table)}", f"# {conditions(table)}", "# rows X x Y: " + " ".join(f"{x}Hx{y}H" for x, y in ROOMS),
             f"# columns: {', then '.join(VIEWS)}; {', '.join(SURFACES)}: " + "; ".join(" ".join(map(number, r)) for r in REFLECTANCES)]
    lines += [",".join(values) for _, rooms in blocks(table) for _, values in rooms]
    return "\n".join(lines) + "\n"


def svg(table):
    half, step, left, top, down = len(REFLECTANCES), 46, 110, 92, 20
    at = lambda i: left + step * (i + 0.6) + 14 * (i >= half)  # noqa: E731
    parts, y = [], top
    put = lambda x, y, words, size=12, anchor="middle": parts.append(  # noqa: E731
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="#222">{escape(words)}</text>')
    put(16, 26, title(table), 15, "start")
    put(16, 46, conditions(table), 11, "start")
    for view, words in enumerate(VIEWS):
        put(at(half * view + half // 2), top - 20, words, 13)
    for i, surface in enumerate(SURFACES):
        put(16, y, surface, anchor="start")
        for column, value in enumerate(reflectances(i)):
            put(at(column), y, value)
        y += down
    put(40, y, "X")
    put(80, y, "Y")
    width = at(2 * half - 1) + step
    for across, rooms in blocks(table):
        parts.append(f'<path d="M16 {y + 7:.1f}H{width - 16:.1f}" stroke="#999"/>')
        put(40, y + down, f"{across}H")
        for ahead, values in rooms:
            y += down
            put(80, y, f"{ahead}H")
            for column, value in enumerate(values):
                put(at(column), y, value)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{y + 20:.0f}" viewBox="0 0 {width:.0f} {y + 20:.0f}" '
            f'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>{"".join(parts)}</svg>\n')
