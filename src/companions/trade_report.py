"""The report of rsphere-trade as text, as a table of comma-separated values, as a plot and as a page."""
from typing import NamedTuple

from .page import Page, Table
from .plot import INK, Axis, Plot, bars_svg
from .program import date_and_time

DISHONEST = 1.5  # ratio of the measured error to a setting's own estimate from which the estimate is regarded as too small
# Settings with each letter of -Sw, and two others.
SERIES = {"h": ("equal weights (-Sw h)", "#888888"), "v": ("the paper's cells (-Sw v)", "#d95f02"),
          "c": ("cells within silhouettes (-Sw c)", "#1b6fb3"), "-Sa": ("until an accuracy (-Sa)", "#1a9850"),
          "rays": ("rays, as -ad and -as say", "#7570b3")}
RING, DASHES, DOTS = "#c2185b", 'stroke-width="2" stroke-dasharray="4 3"', 'stroke-dasharray="1 4"'
WIDTHS = (9, 9, 10, 9, 9, 10, 9, 10, 6)


class Subject(NamedTuple):
    """The subject of a report, apart from the settings."""

    scene: str  # files of the scene
    points_file: str
    points_in_file: int
    points: list  # measured points, or the origins and directions of rays
    per_point: int  # numbers of each: 3 of a point, 6 of a ray
    accuracy: float  # requested accuracy
    bounces: int  # of the reference (-ab)
    recommended: int  # index of a setting
    sure: bool  # whether that is sure to have the accuracy
    command: str  # command line with the recommended setting
    given: str  # the command line of rsphere-trade
    reference_words: str  # the setting of the reference
    repeats: int  # number of repeats of each setting
    repeats_of_last: int  # of the last setting, if a signal ended it early; otherwise 0
    version: str  # of rsphere

    def recommendation(self):
        return "recommended" if self.sure else "nearest to the accuracy asked for"


def percent(x):
    size = abs(100 * x)
    return f"{100 * x:.{1 if size >= 10 else 2 if size >= 1 or size == 0 else 3}f}%"


def milliseconds(seconds):
    return f"{1e3 * seconds:.{2 if seconds < .01 else 1}f}"


def dishonesty(f):
    """The ratio of the measured error to the error estimated by the setting; 0 without an estimate."""
    return f.rms / f.estimated if f.estimated > 0 else 0


def trade_table(settings):
    """A line for each setting, and an explanation of marks."""
    def row(star, words, setting):
        return f"{star} " + "".join(f"{word:>{width}}" for word, width in zip(words, WIDTHS)) + f"  {setting}\n"
    text = row(" ", ("ms/point", "rms", "95% sure", "largest", "bias", "+-", "says", "true/says", ""), "setting")
    for f in settings:
        marks = ("~" if f.limited else "") + ("b" if f.biased else "") + ("!" if dishonesty(f) >= DISHONEST else "")
        says = (percent(f.estimated), f"{dishonesty(f):.2f}") if f.estimated > 0 else ("-", "-")
        text += row("*" if f.best else " ", (milliseconds(f.seconds), *map(
            percent, (f.rms, f.rms_at_most, f.largest, f.bias, f.bias_error)), *says, marks), " ".join(f.words))
    text += ("* nothing is as fast and as accurate   95% sure: the rms error is below this   says: the error that the setting "
             "estimates itself\n")
    if any(f.limited for f in settings):
        text += "~ the reference is not good enough to tell (-Te)\n"
    if any(f.biased for f in settings):
        text += "b a bias that is certain (99%)\n"
    if any(dishonesty(f) >= DISHONEST for f in settings):
        text += "! the error is more than half again as large as the setting says\n"
    return text


def trade_csv(settings, reference):
    text = "setting,seconds,setup_seconds,directions,rms,rms_at_most,largest,bias,bias_error,estimated,best,reference_error\n"
    for f in settings:
        numbers = (f.seconds, f.setup_seconds, f.directions, f.rms, f.rms_at_most, f.largest, f.bias, f.bias_error, f.estimated)
        text += ",".join((" ".join(f.words), *(f"{x:.6g}" for x in numbers), f"{f.best:d}", f"{reference.error:.6g}")) + "\n"
    return text


def bounces_text(bounces):
    """Errors do not include the light of further bounces, because the reference omits it as well."""
    return (f"These errors hold for -ab {bounces}. The light that further bounces would add is not in them; -Tb with a larger -ab "
            "measures it.")


def series_of(f, rays):
    if "-Sa" in f.words:
        return "-Sa"
    if rays:
        return "rays"
    return f.words[f.words.index("-Sw") + 1][0] if "-Sw" in f.words else "c"


def trade_plot(settings, subject):
    """An SVG plot of rms error against seconds for a point, with logarithmic axes. Each setting is a mark in the color of its weights
    (-Sw). A line connects the best settings, and a ring marks the recommended one. Settings without error or time are omitted."""
    def point_of(f):
        return 1e3 * f.seconds, 100 * f.rms

    def is_drawn(f):
        return f.rms > 0 and f.seconds > 0
    drawn = list(filter(is_drawn, settings))
    title = f"{subject.scene}: {len(subject.points) // subject.per_point} points"
    if not drawn:
        return bars_svg(title + ": no setting has both an error and a time", [])
    wanted, rays = 100 * subject.accuracy, subject.per_point == 6
    curve = sorted(point_of(f) for f in drawn if f.best)
    # The legend names the line of the accuracy.
    extent = [(point_of(drawn[0])[0], wanted), *map(point_of, drawn)]
    plot = Plot(title, extent, Axis("CPU time a point, ms"), Axis("rms error, relative to the reference", "%"))
    plot.line([(plot.x.low, wanted), (plot.x.high, wanted)], INK, DOTS)
    if len(curve) > 1:
        plot.line(curve, INK, DASHES)
    for f in drawn:
        plot.mark(point_of(f), 5 if f.best else 3.5, SERIES[series_of(f, rays)][1],
                  f"{' '.join(f.words)}: {milliseconds(f.seconds)} ms, {percent(f.rms)}")
    for key, (name, color) in SERIES.items():
        if any(series_of(f, rays) == key for f in drawn):
            plot.legend("disc", color, name)
    if is_drawn(settings[subject.recommended]):
        plot.ring(point_of(settings[subject.recommended]), RING)
        plot.legend("ring", RING, subject.recommendation())
    if len(curve) > 1:
        plot.legend("line", INK, "nothing is as fast and as accurate", DASHES)
    plot.legend("line", INK, f"the accuracy asked for: {wanted:g}%", DOTS)
    return plot.svg()


def settings_table(settings, subject):
    rows = []
    for i, f in enumerate(settings):
        remarks = [text for text, holds in (
            ("the reference limits the accuracy", f.limited), ("biased (99% sure)", f.biased),
            ("own estimate too small", dishonesty(f) >= DISHONEST),
            (f"{subject.repeats_of_last} of {subject.repeats} repeats", subject.repeats_of_last > 0 and i + 1 == len(settings)))
            if holds]
        rows.append([subject.recommendation() if i == subject.recommended else "on the curve" if f.best else "", " ".join(f.words),
                     milliseconds(f.seconds), percent(f.rms), percent(f.rms_at_most), percent(f.largest),
                     f"{percent(f.bias)} \u00b1 {percent(f.bias_error)}", percent(f.estimated) if f.estimated > 0 else "-",
                     f"{f.directions:.0f}", "; ".join(remarks)])
    head = ["", "Setting", "Time a point, ms", "rms error", "95% sure below", "Largest error", "Bias", "Own estimate", "Directions",
            "Remarks"]
    return Table(head, rows, subject.recommended, 2, True)


def trade_page(settings, reference, subject, when):
    """An HTML page with the plot, the table, the command and the points."""
    chosen, wanted = settings[subject.recommended], f"{100 * subject.accuracy:g}%"
    took, error, sure = milliseconds(chosen.seconds), percent(chosen.rms), percent(chosen.rms_at_most)
    page = Page(f"Speed and accuracy: {subject.scene}", f"rsphere-trade {subject.version}, {date_and_time(when)}")
    if subject.sure:
        page.banner("good", f"The fastest setting for an rms error of {wanted} takes {took} ms of CPU time a point. "
                            f"Its error is {error} (95% sure: below {sure}).")
    else:
        page.banner("open", f"No setting is sure to have an rms error of {wanted}. The nearest has {error} (95% sure: below {sure}) "
                            f"and takes {took} ms of CPU time a point.")
    page.command(subject.command)
    page.note(bounces_text(subject.bounces))
    page.heading("Error against time")
    page.figure(trade_plot(settings, subject),
                "Each mark is a setting. Settings further down are more accurate, and settings further left are faster. A browser "
                "shows the options of a mark when the pointer rests on it.")
    page.heading("Settings")
    page.table(settings_table(settings, subject))
    page.note("Time: CPU time of one thread, without reading the scene and other work before the first point. Errors are relative to "
              "the reference: those of single answers, as root mean square (rms) over points and repeats, and the largest. Bias: the "
              "mean error \u00b1 its standard error. Own estimate: the standard error that the setting states itself (-oe).")
    page.heading("Measurement")
    page.facts([("Scene", subject.scene),
                ("Points", f"{subject.points_file}: {reference.points} of {subject.points_in_file} points"),
                ("Reference", f"{reference.repeats} rotations of {subject.reference_words}; relative standard error "
                              f"{percent(reference.error)}, of the mean over the points {percent(reference.mean_error)}"),
                ("Repeats", f"{subject.repeats} of each setting"), ("Command", subject.given), ("Date", date_and_time(when)),
                ("Version", f"rsphere {subject.version}")])
    rows = [[str(i + 1), *(f"{x:g}" for x in subject.points[subject.per_point * i:][:3]), f"{reference.means[i]:.4g}"]
            for i in range(reference.points)]
    page.folded_table("The points, with their mean radiance (brightness) in the reference",
                      Table(["Point", "x", "y", "z", "Mean radiance, W/sr/m2"], rows))
    return page.html()
