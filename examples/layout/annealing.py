"""Layouts tried one after the other: simulated annealing, and gradient descent, for comparison with the integer program."""
import numpy as np

from rsphere.layout.search import too_near

PENALTY = 10.0  # watts of the largest luminaire that a goal missed altogether costs
COOLING = (0.5, 0.01)  # the temperature at the begin and at the end, in watts of the largest luminaire
RATE = 0.03  # of gradient descent: how far levels move in a step, at first
HALVES = 0.5  # of the watts of the largest luminaire: what a level of a half costs at the end, so that levels become 0 or 1


class Judge:
    """What a layout costs, and whether it meets all goals: from the rows of a scene."""

    def __init__(self, rows, watts):
        self.watts = watts
        self.coefficients = np.array([-r.sense * r.coefficients / r.size for r in rows])
        self.constant = np.array([-r.sense * r.constant / r.size for r in rows])
        goals = {}
        self.goal = np.array([goals.setdefault(id(r.goal), len(goals)) for r in rows])

    def cost(self, hangs):
        """The cost, and the watts if the goals are met (otherwise infinite)."""
        missed = np.maximum(self.coefficients @ hangs + self.constant, 0)
        worst = sum(missed[self.goal == g].max() for g in range(self.goal.max() + 1))
        watts = float(self.watts @ hangs)
        return watts + PENALTY * self.watts.max() * worst, watts if worst < 1e-9 else np.inf


def annealed(design, candidates, judge, tries, seed):
    """The least watts of a layout that meets the goals, after each try; infinite as long as none does."""
    random, near = np.random.default_rng(seed), too_near(design, candidates)
    hangs, best, found = np.zeros(len(candidates)), np.inf, np.full(tries, np.inf)
    cost, _ = judge.cost(hangs)
    largest = judge.watts.max()
    for i in range(tries):
        tried = hangs.copy()
        used, move = np.flatnonzero(tried), random.integers(3)  # one luminaire more, one less, or one elsewhere
        if move > 0 and len(used):
            tried[random.choice(used)] = 0
        if move != 1:
            tried[random.integers(len(candidates))] = 1
        if not near[np.ix_(tried > 0, tried > 0)].any():
            new, watts = judge.cost(tried)
            temperature = largest * COOLING[0] * (COOLING[1] / COOLING[0]) ** (i / tries)
            if new <= cost or random.random() < np.exp((cost - new) / temperature):
                hangs, cost = tried, new
            best = min(best, watts)
        found[i] = best
    return found


def rounded(levels, near, judge):
    """The watts of the layout that takes luminaires in the order of their levels until all goals are met; infinite if none does."""
    hangs = np.zeros(len(levels))
    for j in np.argsort(-levels, kind="stable"):
        if near[j, hangs > 0].any():
            continue
        hangs[j] = 1
        _, watts = judge.cost(hangs)
        if np.isfinite(watts) or levels[j] < 1e-3:
            break
    return judge.cost(hangs)[1]


def descended(design, candidates, judge, steps, seed):
    """As annealed(), by gradient descent: levels from 0 to 1 follow the gradient of the watts and of the goals that are missed.

    The gradient of a goal is its row, which importance gives. Steps are Adam's (Kingma and Ba 2015).
    """
    random, near = np.random.default_rng(seed), too_near(design, candidates)
    levels, largest = random.uniform(0, 0.5, len(candidates)), judge.watts.max()
    mean, square, best, found = np.zeros(len(candidates)), np.zeros(len(candidates)), np.inf, np.full(steps, np.inf)
    for i in range(steps):
        missed = np.maximum(judge.coefficients @ levels + judge.constant, 0)
        slope = judge.watts + PENALTY * largest * 2 * missed @ judge.coefficients * 10
        slope = slope + HALVES * largest * i / steps * 4 * (1 - 2 * levels)
        mean, square = 0.9 * mean + 0.1 * slope, 0.999 * square + 0.001 * slope**2
        step = RATE * (1 - i / steps) * mean / (1 - 0.9 ** (i + 1)) / (np.sqrt(square / (1 - 0.999 ** (i + 1))) + 1e-9)
        levels = np.clip(levels - step, 0, 1)
        best = min(best, rounded(levels, near, judge))
        found[i] = best
    return found
