"""Predicts the time of measurements from the time already taken."""
import math
from typing import NamedTuple

MINUTE = 60
LEAST_DEGREES = 4  # of freedom: with fewer, the estimated error is usually wrong by more than a third


def rounded_up(x):
    """To two digits, so that the error can be reached."""
    unit = 10. ** (math.floor(math.log10(x)) - 1)
    return math.ceil(x / unit - 1e-9) * unit


class ReferenceProgress(NamedTuple):
    """rotations: number of finished rotations; below 1, the fraction of points answered in the first one. least_rotations: minimum
    number. seconds: time taken. error, target: relative standard error, achieved and requested. more_threads: whether -n 0 would use
    more threads."""

    rotations: float
    least_rotations: int
    seconds: float
    error: float
    target: float
    points: int
    more_threads: bool = False

    def can_predict(self):
        """Whether the error, estimated from the rotations of all points, is accurate enough for predictions."""
        return self.rotations > 1 and (self.rotations - 1) * self.points >= LEAST_DEGREES

    def rotations_needed(self):
        """If the error falls with the square root of the number of rotations; the minimum if the error is not yet known."""
        if not self.can_predict() or self.target <= 0:
            return self.least_rotations
        return max(self.least_rotations, self.rotations * (self.error / self.target) ** 2)

    def seconds_left(self):
        return max(0.0, self.rotations_needed() - self.rotations) * self.seconds / self.rotations

    def slow(self):
        """A message if the whole reference takes longer than a minute, with options that make it faster; otherwise empty. The error
        that it suggests for -Te takes about a minute."""
        each = self.seconds / self.rotations
        whole, least = self.rotations_needed() * each, self.least_rotations * each
        if whole <= MINUTE:
            return ""
        quicker, soon = [], max(MINUTE, least)
        if self.can_predict():
            text = (f"about {duration_text(whole)} (error {100 * self.error:.2g}% after {self.rotations:g} rotations, "
                    f"{100 * self.target:.2g}% wanted)")
            if whole > soon:
                quicker.append(f"-Te {rounded_up(self.error * math.sqrt(self.seconds / soon)):.2g} ends it after {duration_text(soon)}")
        else:
            text = f"at least {duration_text(least)} for its {self.least_rotations} rotations"
        fewer = int(self.points * MINUTE / (least if least > MINUTE else whole))
        quicker.append(f"-Tm {max(fewer, 1)} measures fewer points")
        if self.more_threads:
            quicker.append("-n 0 uses all cores")
        return f"the reference takes {text}: {', '.join(quicker)}"


def cost_of(settings):
    """The relative cost of a setting: its directions times the power 3/4 of the indirect rays of each (-ad). For the default settings
    this is right within a factor of about two, which is sufficient to predict the remaining time."""
    rays = max(1, settings.number("-ad")) if settings.number("-ab") > 0 else 1
    return (settings.number("-Sn") if settings.sphere_mode else 1) * rays ** .75


def seconds_left(costs, done, seconds):
    """The time for the remaining settings, predicted from the time for the first `done` settings."""
    before = sum(costs[:done])
    return seconds * sum(costs[done:]) / before if before > 0 else 0.0


def duration_text(seconds):
    """A duration as "40 s", "2.5 min", "12 min" or "3.5 h"."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    if seconds < 100 * MINUTE:
        return f"{seconds / MINUTE:.{1 if seconds < 10 * MINUTE else 0}f} min"
    return f"{seconds / (60 * MINUTE):.1f} h"
