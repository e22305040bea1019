"""The report of rsphere-compare as text and pictures."""
import bisect
from typing import NamedTuple

from .comparison import Verdict
from .pictures import stores_radiance, write_picture

CONCLUSIONS = {
    Verdict.SAME: "No difference but noise",
    Verdict.SMALL: "Within the tolerance: a bias that is certain, but smaller",
    Verdict.UNDECIDED: "Undecided: noise could hide a difference above the tolerance; more repeats (-Cr) or samples tell",
    Verdict.DIFFERS: "They differ"}
VERDICTS = {
    Verdict.SAME: "the same but for noise",
    Verdict.SMALL: "a bias below the tolerance",
    Verdict.UNDECIDED: "noise could hide more than the tolerance",
    Verdict.DIFFERS: "differs: a bias above the tolerance"}
FEWEST_RAYS, MOST_RAYS = 8, 1000000  # limits of -Cn
EDGES = (-8, -4, -2, -1, -.5, .5, 1, 2, 4, 8)  # of the histogram's classes, in units of the tolerance
WIDEST = 50  # letters of its largest class
FULL_COLOR = 10  # the difference of saturated colors, in units of the tolerance


def percent(x):
    """0.0123 as "1.23%", with more decimals for smaller values."""
    size = abs(100 * x)
    if size >= 1000:
        return f"{100 * x:.2g}%"
    return f"{100 * x:.{1 if size >= 10 or size == 0 else 2 if size >= .1 else 4}f}%"


def signed_percent(x):
    return ("" if x < 0 else "+") + percent(x)


def verdict_text(channel):
    if channel.verdict == Verdict.DIFFERS and channel.beyond > 0:
        records = "1 record" if channel.beyond == 1 else f"{channel.beyond} records"
        return f"differs: {records} by more than the tolerance, even after allowing for noise"
    return VERDICTS[channel.verdict]


def warnings_text(warnings):
    return "".join(f"Warning: {warning}\n" for warning in warnings)


def figures_text(comparison, tolerance):
    """A table of the figures, with a line for each channel or band; then the verdicts and the conclusion."""
    def row(name, mean, *rest):
        widths = (9, 10, 9, 10, 9, 9, 9, 9, 9)
        return f"{name:<6}{mean:>11}" + "".join(f"{word:>{width}}" for word, width in zip(rest, widths)) + "\n"
    text = row("", "original", "mean", "+-", "records", "of it", "half", "90%", "99%", "all", "within")
    text += row("", "mean", "differs", "", "rms", "noise", "below", "below", "below", "below", percent(tolerance))
    for c in comparison.channels:
        text += row(c.name, f"{c.original_mean:.4e}", signed_percent(c.bias), percent(c.bias_error), percent(c.rms),
                    percent(c.noise_rms), *map(percent, c.percentiles), percent(c.share_within))
    middle = comparison.middle
    text += (f"Noise of one answer (rms, {middle.name}): rsphere {percent(middle.our_noise)}, "
             f"the original {percent(middle.original_noise)}\n")
    text += "".join(f"{c.name}: {verdict_text(c)}\n" for c in comparison.channels)
    return text + f"{CONCLUSIONS[comparison.verdict]}.\n"


def equal_error_text(middle, orientations, our_seconds, original_seconds):
    """For points: the -Cn at which the original's answers would be as noisy as rsphere's in the middle channel, and the CPU time for
    it, predicted from its noise and time with `orientations` planes. Because planes are evenly spread, the error falls in proportion
    to their number where irradiance is smooth, and with its square root where it is random; the text gives both. Time is
    proportional to -Cn, except for loading. Seconds are totals over all repeats."""
    if middle.our_noise <= 0 or middle.original_noise <= 0:
        return "Equal error: one of them has no noise to go by.\n"
    ratio = middle.original_noise / middle.our_noise
    fewest, most = min(ratio, ratio * ratio), max(ratio, ratio * ratio)
    if orientations * fewest > MOST_RAYS:
        return (f"Equal error: more than the {MOST_RAYS} rays that -Cn allows; fewer directions of rsphere (-Sn, -Sx) do it.\n")
    if orientations * most < FEWEST_RAYS:
        return (f"Equal error: fewer than the {FEWEST_RAYS} rays that -Cn needs; more directions of rsphere (-Sn, -Sx) do it.\n")
    few, many = (min(max(orientations * factor, FEWEST_RAYS), MOST_RAYS) for factor in (fewest, most))
    each = original_seconds / orientations
    return (f"Equal error: with -Cn {few:.0f} to {many:.0f} the original is about as noisy as rsphere (its noise falls with the "
            f"number of rays, or its square root). All repeats then take it about {each * few:.3g} to {each * many:.3g} s of CPU "
            f"time; rsphere took {our_seconds:.3g} s.\n")


class DifferenceClass(NamedTuple):
    low: str
    high: str
    records: int
    within: bool  # whether the class is within the tolerance


def difference_classes(records, tolerance):
    """The number of records in each class of relative differences of brightness."""
    unit = tolerance or 1e-6
    counts = [0] * (len(EDGES) + 1)
    for record in records:
        counts[bisect.bisect_left(EDGES, record.difference / unit)] += 1
    names = ["less", *(signed_percent(edge * unit) for edge in EDGES), "more"]
    return [DifferenceClass(names[k], names[k + 1], count, 0 < k < len(EDGES) and EDGES[k - 1] >= -1 and EDGES[k] <= 1)
            for k, count in enumerate(counts)]


def histogram_text(records, tolerance):
    classes = difference_classes(records, tolerance)
    most = max(c.records for c in classes)
    return "Relative difference of records (brightness)\n" + "".join(
        f"{c.low:>9} to {c.high:<9}{c.records:>9}  {'#' * ((c.records * WIDEST + most - 1) // most)}\n" for c in classes)


def differences_on_screen(records, tolerance):
    """The pixels of a picture from blue (the original is brighter by ten times the tolerance) through white to red."""
    pixels = []
    for record in records:
        pale = 1 - min(1.0, abs(record.difference) / (FULL_COLOR * (tolerance or 1e-6)))
        pixels += (1.0, pale, pale) if record.difference > 0 else (pale, pale, 1.0)
    return pixels


def write_differences(name, width, height, records, tolerance):
    """Formats of radiance contain the absolute differences in three equal channels, other formats differences_on_screen()."""
    pixels = ([abs(record.difference) for record in records for _ in range(3)] if stores_radiance(name)
              else differences_on_screen(records, tolerance))
    write_picture(name, width, height, pixels)
