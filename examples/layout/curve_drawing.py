"""The drawing of watts against processor time."""
import html
import math

LEFT, RIGHT, TOP, BOTTOM = 60, 620, 40, 315
STYLES = (("#1b6fb3", ""), ("#e7298a", ""), ("#d95f02", ""), ("#d95f02", "2 4"), ("#1b9e77", "6 4"), ("#7570b3", "6 4"))


def curve_drawing(curves):
    """SVG of (name, seconds, watts): steps, from where a first layout is known to the end of the longest way."""
    first = math.floor(math.log10(min(s[0] for _, s, _ in curves)))
    last = math.ceil(math.log10(max(s[-1] for _, s, _ in curves)))
    # Layouts of several times the least watts would flatten what follows; lines come from above the drawing.
    most = min(1.1 * max(w[0] for _, _, w in curves), 2.5 * min(w[-1] for _, _, w in curves))

    def x(seconds):
        return LEFT + (RIGHT - LEFT) * (math.log10(seconds) - first) / (last - first)

    def y(watts):
        return BOTTOM - (BOTTOM - TOP) * min(1, watts / most)

    def text(at_x, at_y, words, anchor):
        return (f'<text x="{at_x:.1f}" y="{at_y:.1f}" text-anchor="{anchor}" stroke="white" stroke-width="3" stroke-linejoin="round" '
                f'paint-order="stroke">{html.escape(words)}</text>\n')

    height = 368 + 14 * len(curves)
    svg = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 640 {height}" font-family="sans-serif" font-size="12">\n'
           f'<rect width="640" height="{height}" fill="white"/>\n'
           + text(LEFT, 22, "The best layout known that meets all goals (W)", "start")
           + text((LEFT + RIGHT) / 2, 350, "processor time (s)", "middle"))
    step = 10 ** math.floor(math.log10(most / 3))
    step *= next(f for f in (1, 2, 5) if most / (f * step) < 8)
    for i in range(int(most / step) + 1):
        svg += f'<path d="M{LEFT} {y(i * step):.1f}H{RIGHT}" stroke="#ddd"/>\n' + text(LEFT - 6, y(i * step) + 4, f"{i * step:g}", "end")
    for power in range(first, last + 1):
        svg += text(x(10.0**power), BOTTOM + 16, f"{10.0**power:g}", "middle")
    for (name, seconds, watts), (color, dashes) in zip(curves, STYLES):
        path = f"M{x(seconds[0]):.1f} {TOP}V{y(watts[0]):.1f}"
        for at, value in zip(seconds[1:], watts[1:]):
            path += f"H{x(at):.1f}V{y(value):.1f}"
        svg += f'<path d="{path}" fill="none" stroke="{color}" stroke-width="2" stroke-dasharray="{dashes or "none"}"/>\n'
        svg += f'<circle cx="{x(seconds[-1]):.1f}" cy="{y(watts[-1]):.1f}" r="4" fill="{color}"/>\n'
    row = 374
    for (name, _, _), (color, dashes) in zip(curves, STYLES):
        svg += (f'<path d="M{LEFT} {row - 4:.1f}h30" stroke="{color}" stroke-width="2" stroke-dasharray="{dashes or "none"}"/>\n'
                + text(LEFT + 36, row, name, "start"))
        row += 14
    return svg + "</svg>\n"
