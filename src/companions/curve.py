"""Speed and accuracy of settings, computed from their answers and from those of a reference."""
import math
from typing import NamedTuple

from .statistics import chance_of, moments, standard_error

DARKEST_POINT = .01  # of the mean over all points: the least scale of a point's errors
ROUNDING = 1e-24  # differences as small as rounding of the reference's sum are not errors
SURE = 1.645


def means_of_repeats(values, points, value_of):
    """The mean of value_of(point, value) over all points, for each repeat."""
    return [sum(value_of(i, values[r + i]) for i in range(points)) / points for r in range(0, len(values), points)]


class Reference:
    """Means of the points over many repeats. values: the answers (brightness of the mean radiance), those to all points in repeat r
    at [r * points, (r + 1) * points). Relative errors of a point refer to its scale: its mean, or DARKEST_POINT times the mean over
    all points if that is larger. error, mean_error: relative standard errors, the rms over the points, and that of their mean."""

    def __init__(self, points, values):
        self.points, self.repeats = points, len(values) // points
        self.means, variances = zip(*(moments(values[i::points]) for i in range(points)))
        least = max(DARKEST_POINT * sum(map(abs, self.means)) / points, 1e-300)
        self.scales = [max(abs(mean), least) for mean in self.means]
        errors = [math.sqrt(variance / self.repeats) / scale for variance, scale in zip(variances, self.scales)]
        self.error = math.sqrt(sum(error * error for error in errors) / points)
        self.mean_error = standard_error(means_of_repeats(values, points, lambda i, x: x / self.scales[i]))

    def is_dark(self):
        return not any(self.means)


class Trial:
    """The measurements of a setting. estimates: standard errors that it estimates; number k is of point k % points. seconds: CPU time
    for a point, without the error estimate unless -Sa needs it; setup_seconds: before the first one, reading of the scene included.
    timed: number of answers over which seconds and directions are means."""

    def __init__(self, words=()):
        self.words, self.values, self.estimates = words, [], []
        self.timed, self.seconds, self.setup_seconds, self.directions = 0, 0.0, 0.0, 0.0


class Figures(NamedTuple):
    """All errors are relative to the reference."""

    words: list
    seconds: float = 0
    setup_seconds: float = 0
    directions: float = 0
    rms: float = 0  # rms error of answers, without the error of the reference
    rms_at_most: float = 0  # upper limit of rms at 95% confidence
    largest: float = 0
    bias: float = 0  # mean error
    bias_error: float = 0  # its standard error
    biased: bool = False  # whether the bias is significant (99%)
    estimated: float = 0  # rms of the standard errors estimated by the setting
    limited: bool = False  # whether the error of the reference is over half of the difference found, so that rms is uncertain
    best: bool = False  # whether no other setting is both as fast and as accurate


def figures_of(trial, reference):
    """trial: of at least one repeat of the points of the reference."""
    points, count = reference.points, len(trial.values)

    def error(i, x):
        return (x - reference.means[i]) / reference.scales[i]
    errors = [error(k % points, x) for k, x in enumerate(trial.values)]
    found, of_reference = sum(e * e for e in errors) / count, reference.error ** 2
    rms = math.sqrt(max(0.0, found - of_reference))
    limited = of_reference > found / 4 and found > ROUNDING
    # If the error of the reference dominates, the whole difference may be the error of the setting.
    at_most = (math.sqrt(found) if limited else rms) * (1 + SURE / math.sqrt(2 * count))
    means = means_of_repeats(trial.values, points, error)
    bias, bias_error = moments(means)[0], math.hypot(standard_error(means), reference.mean_error)
    biased = len(means) > 1 and abs(bias) > 1e-9 and chance_of(bias, bias_error, len(means) - 1) < .01
    relative = [e / reference.scales[k % points] for k, e in enumerate(trial.estimates)]
    estimated = math.sqrt(sum(e * e for e in relative) / len(relative)) if relative else 0
    return Figures(trial.words, trial.seconds, trial.setup_seconds, trial.directions, rms, at_most, max(map(abs, errors)), bias,
                   bias_error, biased, estimated, limited)


def with_best(settings):
    """The figures of settings, those marked for which no other is both as fast and as accurate."""
    def beats(a, b):
        return a.seconds <= b.seconds and a.rms <= b.rms and (a.seconds < b.seconds or a.rms < b.rms)
    return [one._replace(best=not any(beats(other, one) for other in settings)) for one in settings]


def cheapest(settings, accuracy):
    """The index of the fastest setting whose rms_at_most is within the accuracy; None if there is none."""
    return min((i for i, f in enumerate(settings) if f.rms_at_most <= accuracy), key=lambda i: settings[i].seconds, default=None)


def recommend(settings, accuracy):
    """The index of the recommended setting: cheapest() or, if there is none, the one with the smallest rms; and which it is."""
    found = cheapest(settings, accuracy)
    if found is not None:
        return found, True
    return min(range(len(settings)), key=lambda i: settings[i].rms), False
