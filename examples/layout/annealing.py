"""Layouts tried one after the other: simulated annealing, for comparison with the integer program."""
import numpy as np

from rsphere.layout.search import too_near

PENALTY = 10.0  # watts of the largest luminaire that a goal missed altogether costs
COOLING = (0.5, 0.01)  # the temperature at the begin and at the end, in watts of the largest luminaire


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
