"""Means, variances and the chance of a difference."""
import math


def moments(values):
    """Mean and sample variance; the variance of a single value is 0. Equal values have exactly 0."""
    first, count = values[0], len(values)
    mean = first + sum(x - first for x in values) / count
    return mean, sum((x - mean) ** 2 for x in values) / (count - 1) if count > 1 else 0.0


def standard_error(values):
    """Of the mean, if the values are independent."""
    return math.sqrt(moments(values)[1] / len(values))


def beyond_t(t, degrees):
    """The two-sided probability of Student's t: of a value above |t| or below -|t|. 1 for degrees < 1. Error below 1e-14.

    Source: Abramowitz and Stegun, 26.7.3 and 26.7.4 (finite sums). Above 200 degrees, the normal distribution is used, which is
    wrong by a factor of at most 1.4 for probabilities above 1e-6."""
    nearly_normal = 200
    t = abs(t)
    if degrees < 1:
        return 1.0
    if degrees > nearly_normal:
        return math.erfc(t / math.sqrt(2))
    angle = math.atan2(t, math.sqrt(degrees))
    cosine, odd = math.cos(angle), degrees % 2 == 1
    term = cosine if odd else 1.0
    total = 0.0 if degrees == 1 else term
    for k in range(3 if odd else 2, degrees - 1, 2):
        term *= cosine * cosine * (k - 1) / k
        total += term
    within = 2 / math.pi * (angle + math.sin(angle) * total) if odd else math.sin(angle) * total
    return max(0.0, 1 - within)


def chance_of(difference, error, degrees):
    """The probability of a difference at least as large if its expected value is 0: beyond_t() of the difference over its
    standard error. If that is 0, it is 1 for a difference of 0, otherwise 0."""
    if not error > 0:
        return 1.0 if difference == 0 else 0.0
    return beyond_t(difference / error, degrees)
