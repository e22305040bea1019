"""The goals as linear rows: what each candidate adds to what is wanted, to daylight, and to what limits it."""
from dataclasses import dataclass, field

import numpy as np

from .glare import factor_of_limit, glare_terms, rating


@dataclass
class Light:
    """What the receivers of a design get: of each candidate at full power, or of daylight (one column)."""

    direct: list  # of each receiver: (points, candidates)
    sets: np.ndarray  # what is reflected, by each set of directions: (sets, receivers, candidates)
    glare: dict  # of each eye with a gaze: (candidates,)
    cells: dict = field(default_factory=dict)  # what is reflected to each cell, where known: (sets, cells, candidates)

    def __post_init__(self):
        self.reflected = self.sets.mean(axis=0)

    def at_cells(self, i, receiver):
        """What each cell of receiver i gets: (sets, cells, candidates). Where it is not known, what is reflected is even."""
        return receiver.cell_means(self.direct[i]) + (self.cells[i] if i in self.cells else self.sets[:, i, None])

    def error(self, i, levels):
        """The standard error of what receiver i gets, from the spread of the sets."""
        values = self.sets[:, i] @ levels
        return float(values.std(ddof=1) / np.sqrt(len(values))) if len(values) > 1 else 0.0


@dataclass
class Row:
    """sense 1: coefficients @ levels + constant >= 0; -1: <= 0. size: what a slack of 1 stands for."""

    goal: object
    coefficients: np.ndarray
    constant: float
    sense: int
    size: float


def light_of(transfer, candidates, matrix):
    glare = {}
    for eye in transfer.design.eyes.values():
        if eye.gaze is not None:
            glare[eye.name] = glare_terms(transfer, candidates, eye)
    return Light(transfer.points.exact, matrix.sets, glare, matrix.cells)


def receiver_of(transfer, name, kinds=("plane", "cylinder")):
    return next(transfer.index[name, k] for k in kinds if (name, k) in transfer.index)


def mean_row(light, i):
    return light.direct[i].mean(axis=0) + light.reflected[i]


def rows_of(transfer, goals, light, daylight, factors):
    """The rows of goals. factors: on what each goal gets, from luminaires as built."""
    rows = []
    for goal in goals:
        factor = factors.get((goal.kind, goal.target), 1.0)
        if goal.kind == "ugr":
            eye = transfer.index[goal.target, "eye"]
            background = factor_of_limit(goal.value) / np.pi * light.reflected[eye]
            size = max(float(background.sum()), 1e-9)
            rows.append(Row(goal, light.glare[goal.target] * factor - background, 0.0, -1, size))
            continue
        i = receiver_of(transfer, goal.target, ("cylinder",) if goal.kind == "cylindrical" else ("plane",))
        mean, day = mean_row(light, i) * factor, mean_row(daylight, i)[0] if daylight else 0.0
        if goal.kind == "uniformity":
            least = min(goal.value / factor, 1.0)
            at = light.at_cells(i, transfer.receivers[i]).mean(axis=0)
            day_at = daylight.at_cells(i, transfer.receivers[i]).mean(axis=0)[:, 0] if daylight else np.zeros(len(at))
            average, day_average = at.mean(axis=0), day_at.mean()
            size = next((g.value for g in goals if g.kind == "illuminance" and g.target == goal.target), 100.0)
            for row, there in zip(at, day_at):
                rows.append(Row(goal, row - least * average, float(there - least * day_average), 1, size or 1.0))
        else:
            rows.append(Row(goal, mean, float(day - goal.value), -1 if goal.kind == "most" else 1, goal.value or 1.0))
    return rows


@dataclass
class Answer:
    goal: object
    value: float
    error: float  # standard error of value
    place: np.ndarray = None  # where the least is, of uniformity

    def met(self, tolerance=0.0):
        if self.goal.kind in ("most", "ugr"):
            slack = 0.1 if self.goal.kind == "ugr" else self.goal.value * tolerance
            return self.value <= self.goal.value + slack
        return self.value >= self.goal.value * (1 - tolerance)


def answers(transfer, goals, light, levels, daylight):
    """What the goals get with these levels, and the standard errors of what is reflected."""
    found = []
    for goal in goals:
        if goal.kind == "ugr":
            eye = transfer.index[goal.target, "eye"]
            background = float(light.reflected[eye] @ levels) / np.pi
            total = float(light.glare[goal.target] @ levels**2)
            share = light.error(eye, levels) / np.pi / max(background, 1e-9)
            found.append(Answer(goal, rating(total, background), 8 / np.log(10) * share))
            continue
        i = receiver_of(transfer, goal.target, ("cylinder",) if goal.kind == "cylindrical" else ("plane",))
        error = light.error(i, levels)
        value = float(mean_row(light, i) @ levels) + (mean_row(daylight, i)[0] if daylight else 0)
        if goal.kind == "uniformity":
            receiver = transfer.receivers[i]
            at = light.at_cells(i, receiver) @ levels + (daylight.at_cells(i, receiver)[..., 0] if daylight else 0)
            found.append(uniformity(goal, at, receiver))
        else:
            found.append(Answer(goal, value, error))
    return found


def uniformity(goal, at, receiver):
    """The Answer for repeats of the illuminance of cells: least over mean, of the means of all repeats."""
    middle = at.mean(axis=0)  # the least of noisy values is too low
    values = at[:, middle.argmin()] / at.mean(axis=1)
    error = values.std(ddof=1) / np.sqrt(len(values)) if len(values) > 1 else 0.0
    return Answer(goal, float(middle.min() / middle.mean()), float(error), receiver.cell_means(receiver.points)[middle.argmin()])
