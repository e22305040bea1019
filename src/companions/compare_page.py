"""The report of rsphere-compare as a page, with a plot."""
import math
from typing import NamedTuple

from .colors import MID_BRIGHT, srgb
from .comparison import Verdict
from .compare_report import CONCLUSIONS, difference_classes, differences_on_screen, percent, signed_percent, verdict_text
from .page import Page, Table
from .pictures import png
from .plot import INK, Axis, Plot, bars_svg
from .program import date_and_time

WITHIN, BEYOND, DASHES = "#1b6fb3", "#d95f02", 'stroke-dasharray="4 3"'
MOST_MARKS = 2000
TONES = {Verdict.SAME: "good", Verdict.SMALL: "good", Verdict.UNDECIDED: "open", Verdict.DIFFERS: "bad"}


class Subject(NamedTuple):
    """The subject of a comparison, and the parts of the report that are text."""

    scene: str
    records_file: str
    given: str  # the command line of rsphere-compare
    original: str  # path and version of the program
    original_version: str
    version: str  # of rsphere
    points: bool  # records are points, not rays
    unit: str  # of answers
    tolerance: float
    width: int  # of the picture formed by the records; both 0 if they do not form one
    height: int
    worst: str  # lines on the worst records
    times: str  # lines on CPU times and the like
    warnings: list  # written to standard error


def png_of(answers, subject, exposure):
    """The mean over the repeats as a picture."""
    pixels = [srgb(exposure * x) for i in range(answers.records) for x in answers.colors.shown(answers.of(i))]
    return png(subject.width, subject.height, pixels)


def exposure_of(original):
    """The exposure at which the median of the original's pixels that are not black becomes middle gray."""
    bright = sorted(b for b in map(original.brightness, range(original.records)) if b > 0)
    return MID_BRIGHT / bright[len(bright) // 2] if bright else 1


def records_drawn(comparison):
    """An evenly chosen subset and the worst ones, if there are more than MOST_MARKS."""
    records = len(comparison.records)
    even = min(records, MOST_MARKS * 9 // 10)
    drawn = {k * records // even for k in range(even)}
    for i in comparison.worst:
        if len(drawn) >= MOST_MARKS:
            break
        drawn.add(i)
    return sorted(drawn)


def figures_table(comparison, subject):
    shares = ("Half of the records differ by less than", "90% of the records differ by less than",
              "99% of the records differ by less than", "Largest difference of a record")
    head = ["", f"Mean of rsphere, {subject.unit}", f"Mean of the original, {subject.unit}",
            "Difference of the means \u00b1 its standard error", "Differences of records, rms", "of these, noise explains", *shares,
            f"Records that differ by less than {percent(subject.tolerance)}", "Noise of one answer of rsphere, rms",
            "Noise of one answer of the original, rms"]
    rows = [[c.name, f"{c.our_mean:.4e}", f"{c.original_mean:.4e}", f"{signed_percent(c.bias)} \u00b1 {percent(c.bias_error)}",
             *map(percent, (c.rms, c.noise_rms, *c.percentiles, c.share_within, c.our_noise, c.original_noise))]
            for c in comparison.channels]
    if len(rows) > 3:  # a spectral run has too many bands for the width of a page
        return Table(head, rows)
    columns = [list(column) for column in zip(head, *rows)]
    return Table(columns[0], columns[1:])


def compare_plot(ours, original, comparison, subject):
    """An SVG plot of the brightness of rsphere's answers against the original's (means of the repeats), with logarithmic axes. Records
    with an answer that is not above 0 are omitted."""
    drawn = records_drawn(comparison)
    marks = []
    for i in drawn:
        x, y = original.brightness(i), ours.brightness(i)
        if x > 0 and y > 0 and math.isfinite(x) and math.isfinite(y):
            marks.append(((x, y), i, abs(comparison.records[i].difference) <= subject.tolerance))
    records = len(comparison.records)
    title = f"{records} records" if len(drawn) == records else f"{len(drawn)} of {records} records"
    if len(marks) < len(drawn):
        title += f", {len(drawn) - len(marks)} of them black"
    if not marks:
        return bars_svg(title + ": none to draw", [])
    plot = Plot(title, [at for at, _, _ in marks], Axis(f"original, {subject.unit}"), Axis(f"rsphere, {subject.unit}"), True)
    # Differences are relative to the mean of both programs.
    ratio = (1 + subject.tolerance / 2) / (1 - subject.tolerance / 2)
    for factor, style in ((1, ""), (ratio, DASHES), (1 / ratio, DASHES)):
        plot.line([(x, factor * x) for x in (plot.x.low, plot.x.high)], INK, style)
    tolerance = percent(subject.tolerance)
    # Marks beyond the tolerance are drawn last, so that none is hidden.
    for within, radius, color, much in ((True, 2.5, WITHIN, "at most"), (False, 3, BEYOND, "more than")):
        some = [(at, i) for at, i, inside in marks if inside == within]
        for at, i in some:
            plot.mark(at, radius, color, "" if within else f"record {i + 1}: {signed_percent(comparison.records[i].difference)}")
        if some:
            plot.legend("disc", color, f"differs by {much} {tolerance}")
    plot.legend("line", INK, "equal")
    plot.legend("line", INK, f"{tolerance} apart, the tolerance", DASHES)
    return plot.svg()


def compare_page(ours, original, comparison, subject, when):
    """An HTML page with the verdict, the warnings, the figures, the plot, a histogram, the pictures, and the rest of the report."""
    page = Page(f"rsphere beside rtrace: {subject.scene}", f"rsphere-compare {subject.version}, {date_and_time(when)}")
    page.banner(TONES[comparison.verdict], CONCLUSIONS[comparison.verdict] + ".")
    for warning in subject.warnings:
        page.banner("open", f"Warning: {warning}")
    page.table(figures_table(comparison, subject))
    page.note("Differences are relative to the original's mean, or for a record to the mean of both programs.")
    page.facts([(c.name, verdict_text(c)) for c in comparison.channels])
    if subject.width > 0:
        page.heading("Pictures")
        exposure = exposure_of(original)
        page.pictures([
            (png_of(ours, subject, exposure), "rsphere"), (png_of(original, subject, exposure), "original"),
            (png(subject.width, subject.height, differences_on_screen(comparison.records, subject.tolerance)),
             "Difference: red where rsphere is brighter, blue where the original is; colors are full at "
             + percent(10 * subject.tolerance))])
        page.note("Both pictures are means of the repeats, with the same exposure.")
    page.heading("Records")
    page.figure(compare_plot(ours, original, comparison, subject),
                "Brightness of each record, as the mean of its repeats. Both axes have the same scale.")
    bars = [(f"{c.low} to {c.high}", c.records, WITHIN if c.within else BEYOND)
            for c in difference_classes(comparison.records, subject.tolerance)]
    page.figure(bars_svg("Number of records by relative difference (brightness)", bars),
                "Blue: within the tolerance. Positive where rsphere is brighter.")
    if subject.worst:
        page.heading("Worst records")
        page.lines(subject.worst)
    page.heading("Measurement")
    page.facts([("Scene", subject.scene),
                ("Records", f"{subject.records_file}: {ours.records} {'points' if subject.points else 'rays'}, {ours.repeats} repeats"),
                ("Original", f"{subject.original} ({subject.original_version})"), ("Tolerance", percent(subject.tolerance)),
                ("Command", subject.given), ("Date", date_and_time(when)), ("Version", f"rsphere {subject.version}")])
    page.lines(subject.times)
    return page.html()
