"""Diagrams as SVG. In a separate file, a diagram is black on white. In a page (page.py) it has the page's colors, because the style
sheet of the page overrides colors of elements by class."""
import math
from typing import NamedTuple

from .page import escaped
from .program import Fault

INK = "#333333"  # of lines that accompany text; pages replace it

# In units of the viewBox. ROW: of a legend.
WIDTH, PLOT_HEIGHT, LEFT, RIGHT, TOP, BELOW, ROW = 720, 385, 74, 20, 36, 56, 18
BOTTOM = TOP + PLOT_HEIGHT
MARGIN = 1.3  # factor by which the axes extend beyond the values
FEWEST_TICKS, MOST_TICKS = 3, 12
# Extensions of pictures and documents that are no SVG.
OTHER_FORMATS = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".gif", ".bmp", ".hdr", ".exr", ".pdf", ".eps", ".ps")


def opening(height, title):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:g}" role="img" '
            f'aria-label="{escaped(title)}" font-family="sans-serif" font-size="12">\n'
            f'<rect class="paper" width="{WIDTH}" height="{height:g}" fill="white"/>\n'
            f'<text x="12" y="22" font-size="14" font-weight="bold">{escaped(title)}</text>\n')


class LogAxis:
    """Maps values from low to high (above 0) to pixels from begin to end, logarithmically."""

    def __init__(self, low, high, begin=0.0, end=1.0):
        self.low, self.high, self.begin, self.end = low, high, begin, end

    def at(self, value):
        return self.begin + (self.end - self.begin) * math.log(value / self.low) / math.log(self.high / self.low)

    def ticks(self):
        """3 to 12 round values; fewer if the ends are too close for 3 values of two digits."""
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        # Every power of ten; if there are many, every second, third and so on.
        step = 1 + (last - first) // MOST_TICKS

        def with_digits(*digits):
            values = (digit * 10. ** power for power in range(first, last + 1) if power % step == 0 for digit in digits)
            return [x for x in values if self.low <= x <= self.high]
        if step > 1:
            return with_digits(1)
        best = with_digits(1, 2, 5)
        if len(best) > MOST_TICKS:
            return with_digits(1)
        if len(best) < FEWEST_TICKS:
            best = with_digits(*range(1, 10))
        # For ranges below a factor of about 2: even steps, which are nearly even on the logarithmic axis.
        steps = (digit * 10. ** power for power in range(last, -400, -1) for digit in (5, 2, 1))
        while len(best) < FEWEST_TICKS:
            step = next(steps)
            best = [k * step for k in range(math.ceil(self.low / step), math.floor(self.high / step) + 1)]
        return best


class Axis(NamedTuple):
    """The text beside an axis: a title, and values that are followed by a unit."""

    title: str
    unit: str = ""


class Plot:
    """A plot with logarithmic axes, which contain all points of `extent`, with a margin. extent: (x, y), above 0 and finite, not
    empty. same_scale: both axes have one range."""

    def __init__(self, title, extent, x_axis, y_axis, same_scale=False):
        self.title, self.x_axis, self.y_axis = title, x_axis, y_axis
        ends = [(min(values) / MARGIN, max(values) * MARGIN) for values in zip(*extent)]
        if same_scale:
            ends = [(min(ends)[0], max(high for _, high in ends))] * 2
        self.x, self.y = LogAxis(*ends[0], LEFT, WIDTH - RIGHT), LogAxis(*ends[1], BOTTOM, TOP)
        self.lines, self.marks, self.entries = "", "", []

    def line(self, points, color, style=""):
        """Lines may extend beyond the plot; they are clipped. style: further attributes, such as stroke-dasharray."""
        path = "L".join(f"{self.x.at(x):.1f} {self.y.at(y):.1f}" for x, y in points)
        self.lines += f'<path d="M{path}" fill="none" {stroke(color, style)}/>\n'

    def mark(self, point, radius, color, hint=""):
        """A disc. hint: text that a browser shows while the pointer is on it."""
        inside = f"><title>{escaped(hint)}</title></circle>\n" if hint else "/>\n"
        self.marks += f'<circle {self.center(point)} r="{radius:g}" fill="{color}"{inside}'

    def ring(self, point, color):
        """A ring around a disc."""
        self.marks += f'<circle class="ring" {self.center(point)} r="10" fill="none" stroke="{color}" stroke-width="3"/>\n'

    def center(self, point):
        return f'cx="{self.x.at(point[0]):.1f}" cy="{self.y.at(point[1]):.1f}"'

    def legend(self, key, color, text, style=""):
        """key: disc, ring or line. style: of the line."""
        self.entries.append((key, color, text, style))

    def svg(self):
        top = BOTTOM + BELOW
        svg = opening(top + ROW * ((len(self.entries) + 1) // 2) + 6, self.title)
        for tick in self.x.ticks():
            x = f"{self.x.at(tick):.1f}"
            svg += (f'<path class="grid" d="M{x} {TOP}V{BOTTOM}" stroke="#ddd"/><text class="tick-x" x="{x}" y="{BOTTOM + 18}" '
                    f'text-anchor="middle">{tick:g}{escaped(self.x_axis.unit)}</text>\n')
        for tick in self.y.ticks():
            y = self.y.at(tick)
            svg += (f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/><text class="tick-y" x="{LEFT - 6}" '
                    f'y="{y + 4:.1f}" text-anchor="end">{tick:g}{escaped(self.y_axis.unit)}</text>\n')
        # An inner svg element clips everything outside its box.
        box = f"{LEFT} {TOP} {WIDTH - RIGHT - LEFT} {PLOT_HEIGHT}"
        svg += (f'<path class="frame" d="M{LEFT} {TOP}V{BOTTOM}H{WIDTH - RIGHT}" fill="none" stroke="#777"/>\n'
                f'<text x="{(LEFT + WIDTH - RIGHT) / 2:g}" y="{BOTTOM + 38}" text-anchor="middle">{escaped(self.x_axis.title)}</text>\n'
                f'<text transform="translate(16 {(TOP + BOTTOM) / 2:g}) rotate(-90)" text-anchor="middle">'
                f"{escaped(self.y_axis.title)}</text>\n"
                f'<svg x="{LEFT}" y="{TOP}" width="{WIDTH - RIGHT - LEFT}" height="{PLOT_HEIGHT}" viewBox="{box}">\n'
                f"{self.lines}</svg>\n{self.marks}")
        for k, (key, color, text, style) in enumerate(self.entries):
            x, y = (LEFT if k % 2 == 0 else (LEFT + WIDTH) / 2), top + ROW * (k // 2)
            svg += {"disc": f'<circle cx="{x + 9:g}" cy="{y}" r="4.5" fill="{color}"/>',
                    "ring": f'<circle cx="{x + 9:g}" cy="{y}" r="6" fill="none" stroke="{color}" stroke-width="3"/>',
                    "line": f'<path d="M{x:g} {y}h18" {stroke(color, style)}/>'}[key]
            svg += f'<text x="{x + 24:g}" y="{y + 4}">{escaped(text)}</text>\n'
        return svg + "</svg>\n"


def stroke(color, style):
    return f'class="{"line ink" if color == INK else "line"}" stroke="{color}"' + (f" {style}" if style else "")


def bars_svg(title, bars):
    """A bar diagram, with bars one below the other. bars: text, value of 0 or more, and color of each."""
    text_width, count_width, row = 170, 70, 22
    most = max((value for _, value, _ in bars), default=0)
    svg, y = opening(TOP + row * len(bars) + 10, title), TOP
    for text, value, color in bars:
        length = (WIDTH - text_width - count_width) * value / most if most > 0 else 0
        svg += (f'<text x="{text_width - 8}" y="{y + 15}" text-anchor="end">{escaped(text)}</text><rect x="{text_width}" y="{y + 3}" '
                f'width="{length:.1f}" height="{row - 6}" fill="{color}"/><text x="{text_width + length + 6:.1f}" y="{y + 15}">'
                f"{value:g}</text>\n")
        y += row
    return svg + "</svg>\n"


def require_svg_name(option, name, what):
    """Raises Fault if an option gives a file for a diagram the extension of another format, in which programs would open it."""
    stem, dot, ending = name.rpartition(".")
    if (dot + ending).lower() in OTHER_FORMATS:
        raise Fault(f'{option} "{name}": {what} is an SVG file; use the name {stem}.svg')
