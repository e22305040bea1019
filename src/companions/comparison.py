"""Statistics of repeated answers of two programs to the same records."""
import bisect
import enum
import math
from operator import mul
from typing import NamedTuple

from .colors import RGB
from .statistics import chance_of, moments, standard_error

PERCENTILES = (.5, .9, .99, 1)
DARKEST = .01  # of the mean over all records: the least scale of a record's differences
# Probability of a false alarm, for the means of all channels together, and for all records together.
FALSE_ALARM = .001
# If no bias is certain: a bias above the tolerance is ruled out if its probability is below this.
UNDECIDED = .05
ROUNDING = 1e-6  # the original computes in single precision, so its answers are rounded
TINY = 1e-300


class Verdict(enum.IntEnum):
    """The result of a comparison with the tolerance, in ascending order of difference."""

    SAME = 0  # no bias is certain, and a bias above the tolerance is ruled out
    SMALL = 1  # a bias is certain, but a bias above the tolerance is ruled out
    UNDECIDED = 2  # no bias above the tolerance is certain, but noise could hide one
    DIFFERS = 3  # a bias above the tolerance is certain, or too many records exceed the tolerance


class Answers:
    """Answers of one program. The answer to record i in repeat r is channels[c][r * records + i] for each of colors.names."""

    def __init__(self, records, repeats, channels, colors=RGB):
        self.records, self.repeats, self.channels, self.colors = records, repeats, channels, colors

    def of(self, record):
        """The means of the channels over the repeats."""
        return [sum(channel[record::self.records]) / self.repeats for channel in self.channels]

    def brightness(self, record):
        return sum(map(mul, self.colors.photopic, self.of(record)))

    def brightnesses(self):
        """Of all answers, as one of the channels."""
        return [sum(map(mul, self.colors.photopic, color)) for color in zip(*self.channels)]


class Channel(NamedTuple):
    """The comparison of one channel, or of one band in a spectral run. The bias is relative to the mean of the original. The
    difference of a record is the difference between the two programs' means over the repeats, relative to the mean of both
    programs for the record, or to DARKEST times the mean over all records if that is larger."""

    name: str  # "red", or the middle wavelength of the band: "570 nm"
    our_mean: float
    original_mean: float
    bias: float  # relative bias of the mean
    bias_error: float  # its standard error
    rms: float  # of the relative differences of the records
    noise_rms: float  # the part of rms that is explained by noise
    our_noise: float  # relative standard deviation of single answers, rms
    original_noise: float
    percentiles: list  # of the absolute relative differences: PERCENTILES
    share_within: float  # fraction of records within the tolerance
    beyond: int  # number of records that exceed it with certainty
    verdict: Verdict


class Difference(NamedTuple):
    """Relative difference of a record's brightness (photopic), and its standard error."""

    difference: float
    error: float


class Comparison(NamedTuple):
    channels: list
    records: list
    worst: list  # indices, in descending order of the difference beyond noise
    verdict: Verdict

    @property
    def middle(self):
        """The result for green, or for the middle band of the spectrum."""
        return self.channels[len(self.channels) // 2]


class Pair:
    """The answers of both programs to a record in one channel."""

    def __init__(self, ours, original):
        (self.ours, self.our_variance), (self.original, self.original_variance) = moments(ours), moments(original)
        self.difference = self.ours - self.original
        self.variance = (self.our_variance + self.original_variance) / len(ours)  # of the difference

    def scale(self, mean):
        """The mean of both programs: with that of one, an outlier of this program would also enlarge the scale, so that its
        noise would look smaller than the other's."""
        return max(abs(self.original + self.ours) / 2, DARKEST * abs(mean), TINY)


def pairs_of(ours, original, records):
    return [Pair(ours[i::records], original[i::records]) for i in range(records)]


def mean_of(values, count):
    return sum(values) / count


def mean_error(pairs, ours, original, independent):
    """Standard error of the mean difference, and its degrees of freedom."""
    records = len(pairs)
    repeats = len(ours) // records
    if independent:
        return math.sqrt(sum(pair.variance for pair in pairs)) / records, 2 * records * (repeats - 1)
    differences = [mean_of(ours[r:r + records], records) - mean_of(original[r:r + records], records)
                   for r in range(0, records * repeats, records)]
    return standard_error(differences), repeats - 1


def certain(excess, error, degrees, count):
    return excess > ROUNDING and chance_of(excess, error, degrees) < FALSE_ALARM / count


def compare_channel(name, ours, original, records, tests, tolerance, share_beyond, independent):
    """tests: number of channels that are compared."""
    pairs = pairs_of(ours, original, records)
    our_mean, original_mean = mean_of((p.ours for p in pairs), records), mean_of((p.original for p in pairs), records)
    scale = abs(original_mean) or max(abs(our_mean), TINY)
    error, degrees = mean_error(pairs, ours, original, independent)
    bias, bias_error = (our_mean - original_mean) / scale, error / scale
    chance = 1 if abs(bias) <= ROUNDING else chance_of(bias, bias_error, degrees)

    sizes, beyond, squares, noise, our_noise, original_noise = [], 0, 0, 0, 0, 0
    degrees_of_record = 2 * (len(ours) // records - 1)
    for pair in pairs:
        by = pair.scale(original_mean)
        size = abs(pair.difference) / by
        sizes.append(size)
        # Divided twice, because the square of the scale underflows to 0 if all answers are 0.
        squares += size * size
        noise += pair.variance / by / by
        our_noise += pair.our_variance / by / by
        original_noise += pair.original_variance / by / by
        beyond += certain(size - tolerance, math.sqrt(pair.variance) / by, degrees_of_record, tests * records)
    sizes.sort()

    room = tolerance + 2 * ROUNDING - abs(bias)
    if certain(abs(bias) - tolerance, bias_error, degrees, tests) or beyond > share_beyond * records:
        verdict = Verdict.DIFFERS
    elif room <= 0 or chance_of(room, bias_error, degrees) > UNDECIDED:
        verdict = Verdict.UNDECIDED
    else:
        verdict = Verdict.SMALL if chance < FALSE_ALARM / tests else Verdict.SAME
    return Channel(name, our_mean, original_mean, bias, bias_error,
                   *(math.sqrt(x / records) for x in (squares, noise, our_noise, original_noise)),
                   [sizes[int(p * (records - 1) + .5)] for p in PERCENTILES],
                   bisect.bisect_right(sizes, tolerance) / records, beyond, verdict)


def compare(ours, original, tolerance, share_beyond, independent):
    """Compares the answers of two programs to the same records, at least one, in an equal number of repeats, at least two.

    tolerance: relative. share_beyond: fraction of records that may exceed it. independent: whether the errors of different
    records are; if not (points that share directions), the error of the mean is estimated from the means of whole repeats. Noise
    is assumed to be normal. Probabilities are those of Student's t with 2 (repeats - 1) degrees of freedom for a record, with
    Sidak's correction for the number of records."""
    names = ours.colors.names
    channels = [compare_channel(name, a, b, ours.records, len(names), tolerance, share_beyond, independent)
                for name, a, b in zip(names, ours.channels, original.channels)]
    pairs = pairs_of(ours.brightnesses(), original.brightnesses(), ours.records)
    mean = mean_of((pair.original for pair in pairs), len(pairs))
    records = [Difference(pair.difference / pair.scale(mean), math.sqrt(pair.variance) / pair.scale(mean)) for pair in pairs]
    worst = sorted(range(len(records)), key=lambda i: 2 * records[i].error - abs(records[i].difference))
    return Comparison(channels, records, worst, max(channel.verdict for channel in channels))
