"""rsphere-trade: measures the speed and accuracy of settings at the points of a file, and recommends one."""
import os
import signal
import time
from array import array

from .command_line import CommandLine, Companion, Own, Settings, read_records, shell_line
from .curve import Reference, Trial, figures_of, recommend, with_best
from .ladder import ladder, reference_words
from .plot import require_svg_name
from .program import SIGNALS, Fault, run_program, write_file, write_output
from .schedule import ReferenceProgress, cost_of, duration_text, seconds_left
from .trade_report import Subject, bounces_text, trade_csv, trade_page, trade_plot, trade_table
from .trials import Setting, Trials

COMPANION = Companion("rsphere-trade", "[options] scene... points", "a scene and a file of points", True, [
    Own("-Tr", "N", "repeats of a setting", 4, 2, 10000, "repeats"),
    Own("-Tm", "N", "most points measured", 32, 1, 1000000, "points"),
    Own("-Te", "frac", "error of the reference", 0.0, 0, 1),
    Own("-Tb", "", "fewer bounces on|fewer bounces off", False),
    Own("-Tl", "file", "user-defined settings", ""),
    Own("-Tc", "file", "table as a CSV file", ""),
    Own("-Tp", "file", "plot as an SVG file", ""),
    Own("-Th", "file", "report as an HTML page", "")])

# Rotations of the reference start here and those of settings at 1, so that they are always different.
REFERENCE_ROTATION = 1 << 30
# Limits on the rotations of the reference: with fewer its error is unknown, and more would take too long.
LEAST_ROTATIONS, MOST_ROTATIONS = 8, 100000
# Minimum number of answers of each setting for which estimated errors are collected.
ESTIMATES = 8
# If a signal ends the measurement of a setting early, it is reported only if it has this number of repeats, which is sufficient to
# estimate its bias.
LEAST_REPEATS = 2
USUAL_ACCURACY = .01


def chosen_points(numbers, size, most):
    """At most so many points, spread evenly over all. size: numbers of a record."""
    count = len(numbers) // size
    chosen = min(count, most)
    points = array("d")
    for k in range(chosen):
        at = size * (k * count // chosen)
        points += numbers[at:at + size]
    return points


class Trade:
    """What is measured of a command line. reference: None before its first rotation; figures: of measured settings; last: the repeats
    of the setting in progress."""

    def __init__(self, line):
        self.line, self.settings, self.messages = line, line.settings, line.messages
        self.accuracy = self.settings.number("-Sa") or USUAL_ACCURACY
        self.reference, self.reference_is_done, self.figures, self.last = None, False, [], Trial()

    def run(self):
        own, per_record = self.line.own, self.settings.per_record
        self.measured = [self.parsed(words) for words in ladder(own["-Tl"], own["-Tb"], self.settings)]
        numbers = read_records(self.line.records, self.settings, self.messages)
        self.points_in_file = len(numbers) // per_record
        self.points = chosen_points(numbers, per_record, own["-Tm"])
        self.trials = Trials(self.line.scene, self.points, per_record, self.messages)
        stop = None
        try:
            self.make_reference()
            self.measure_all()
        except Fault as fault:
            if fault.kind != "signal":
                raise
            stop = fault
        signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
        self.conclude()
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
        if stop:
            raise stop

    def parsed(self, words):
        """A setting of the ladder: its own words, and the setting."""
        try:
            return words, self.setting_of(words)
        except Fault as fault:
            if not self.line.own["-Tl"]:
                raise
            raise Fault(f"{self.line.own['-Tl']}: {' '.join(words)}: {fault}", fault.kind) from None

    def setting_of(self, words):
        """The options of the command line, overridden by those of the setting. -Sa is the accuracy asked for, but not of each."""
        used, rest = self.line.split(words)
        if rest:  # the scene is the same for all settings
            raise Fault(f'"{rest[0]}" is not an option')
        if any(option.name == "-Sg" for option in used):
            raise Fault("-Sg applies to all settings: give it on the command line")
        whole = [*self.line.words_of_answers("-Sa"), *words]
        return Setting(whole, Settings(self.line.defaults(whole)))

    def make_reference(self):
        setting, trial = self.setting_of(reference_words(self.settings.sphere_mode)), Trial()
        points, target = self.trials.count, self.line.own["-Te"] or self.accuracy / 10
        cores = len(os.sched_getaffinity(0))
        threads = int(self.settings.number("-n")) or cores
        start, said = time.monotonic(), 0.0  # total time predicted by the last warning

        def progress(rotations, error=0.0):
            return ReferenceProgress(rotations, LEAST_ROTATIONS, time.monotonic() - start, error, target, points, threads < cores)

        def say_slow(at):
            nonlocal said
            whole, slow = at.seconds + at.seconds_left(), at.slow()
            if slow and whole >= 2 * said:
                self.messages.warning(slow)
                said = whole

        def first_points(count):
            if threads <= count < points:
                say_slow(progress(count / points))
        for r in range(MOST_ROTATIONS):
            answered = [first_points] if r == 0 else []
            self.trials.run(setting, REFERENCE_ROTATION + r, False, False, trial, *answered)
            self.reference = Reference(points, trial.values)
            at = progress(r + 1, self.reference.error)
            errors = f", error {100 * at.error:.3f}%, {100 * target:.3f}% wanted" if at.can_predict() else ""
            self.progress(f"reference: rotation {r + 1}{errors}, about {duration_text(at.seconds_left())} left")
            say_slow(at)
            if r + 1 >= LEAST_ROTATIONS and at.error <= target:
                break
        self.reference_is_done = True

    def measure(self, words, setting):
        trial = self.last = Trial(words)
        repeats = self.line.own["-Tr"]
        for r in range(1, repeats + 1):
            self.trials.run(setting, setting.first + r, setting.estimates, True, trial)
        while setting.states_errors and len(trial.estimates) < ESTIMATES:
            r += 1
            self.trials.run(setting, setting.first + r, True, False, trial)
        self.figures.append(figures_of(trial, self.reference))
        self.last = Trial()

    def measure_all(self):
        if self.reference.is_dark():
            self.messages.warning("no light arrives at the points: relative errors are undefined")
        costs = [cost_of(setting.settings) for _, setting in self.measured]
        start = time.monotonic()
        for i, (words, setting) in enumerate(self.measured, 1):
            self.measure(words, setting)
            seconds, last = time.monotonic() - start, self.figures[-1]
            self.progress(f"setting {i} of {len(costs)}: {1e3 * last.seconds:.1f} ms a point, {100 * last.rms:.3f}%; "
                          f"{duration_text(seconds)} so far, about {duration_text(seconds_left(costs, i, seconds))} left")

    def progress(self, text):
        if self.settings.number("-t") > 0 or os.isatty(2):
            self.messages.report(text)

    def conclude(self):
        """Reports what has been measured."""
        if not self.reference_is_done:
            self.messages.warning("no setting has been measured yet; rotations of the reference so far: "
                                  f"{self.reference.repeats if self.reference else 0}")
        repeats_of_last = len(self.last.values) // self.trials.count
        if repeats_of_last >= LEAST_REPEATS:
            self.figures.append(figures_of(self.last, self.reference))
        else:
            repeats_of_last = 0
        if self.figures:
            self.report(with_best(self.figures), repeats_of_last)

    def report(self, figures, repeats_of_last):
        own, reference = self.line.own, self.reference
        index, sure = recommend(figures, self.accuracy)
        chosen, bounces = figures[index], int(self.settings.number("-ab"))
        words = " ".join(reference_words(self.settings.sphere_mode))
        subject = Subject(" ".join(self.line.scene), self.line.records, self.points_in_file, self.points, self.settings.per_record,
                          self.accuracy, bounces, index, sure, self.paste_line(chosen.words), self.line.given_line(), words,
                          own["-Tr"], repeats_of_last, self.line.rsphere_version())
        text = (f'{reference.points} points; reference: {reference.repeats} rotations of "{words}", relative standard error '
                f"{100 * reference.error:.3f}% (mean over the points {100 * reference.mean_error:.3f}%)\n") + trade_table(figures)
        if repeats_of_last > 0:
            text += f"The last setting has {repeats_of_last} of {own['-Tr']} repeats.\n"
        text += bounces_text(bounces) + "\n\n"
        if sure:
            text += (f"The fastest for an rms error of {100 * self.accuracy:g}% (95% sure: below {100 * chosen.rms_at_most:.3f}%):\n")
        else:
            text += f"None is sure to have an rms error of {100 * self.accuracy:g}%; the nearest, with {100 * chosen.rms:.3f}%:\n"
        text += f"  {subject.command}\n"
        # If one of the outputs fails, the others are still written, because measuring again would take long.
        faults = []
        for option, made in (("-Tc", lambda: trade_csv(figures, reference)), ("-Tp", lambda: trade_plot(figures, subject)),
                             ("-Th", lambda: trade_page(figures, reference, subject, time.time()))):
            try:
                if own[option]:
                    write_file(own[option], made())
            except Fault as fault:
                faults.append(fault)
        write_output(text)
        if faults:
            raise faults[0]

    def paste_line(self, words):
        """A command line of rsphere with the given options, overridden by those of the setting."""
        used = [w for option in self.line.used if option.name not in ("-Sa", "-t", *words) for w in option.words]
        return f"{shell_line(['rsphere', *used, *words, *self.line.scene])} < {shell_line([self.line.records])}"


def run_trade(line):
    settings = line.settings
    if not settings.sphere_mode and not line.gave("-ab"):
        raise Fault("-S-: needs -ab, because the settings of rays are compared with equal bounces")
    if settings.on("-Su"):
        raise Fault("-Su: the errors of glare are stated by -oUVBG")
    if settings.on("-Sp"):
        raise Fault("-Sp: errors are measured for sums, not for the parts of contributors")
    require_svg_name("-Tp", line.own["-Tp"], "the plot")
    Trade(line).run()
    return 0


def main(words):
    def body(messages):
        line = CommandLine(COMPANION, words, messages)
        return line.answer_request() if line.request else run_trade(line)
    return run_program(COMPANION.program, body)
