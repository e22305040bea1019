"""The search: which candidates, and at which levels, take the least watts. A mixed integer program, by HiGHS."""
import time
from dataclasses import dataclass

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import coo_matrix, csr_matrix

from ..fault import fault
from ..progress import PROGRESS

MOST_MISSED = 4  # rows of a goal that are added at once
SHARE = 0.4  # of the time that is left, for the whole program at once
DIMMED_SHARE, DIMMED_GAP = 0.2, 1e-3  # of the time, for less watts as dimmed
OTHERS = 2  # layouts of equal watts that are looked for
TIE = 0.005  # of the watts as dimmed, which are equal within it
ELSEWHERE = 0.25  # of the luminaires: how many of another layout hang where none of the first do
EVEN = 1e-3  # of a spacing: rows are as far apart as others
FLAT = 0.01  # m: the height of a flat luminaire, where others do not fit


@dataclass
class Layout:
    chosen: np.ndarray  # indices of candidates
    levels: list  # of each scene: levels of the chosen, 0 to 1
    bound: float  # no layout takes less (W); 0 if that is not known
    misses: list  # (scene, goal, by what share of its size), if not all goals are met
    proven: bool  # that these goals cannot all be met; otherwise the time was too short
    others: object  # function of seconds: other layouts of equal watts, as indices of candidates and levels of each scene


class Program:
    """Collects variables and constraints."""

    def __init__(self):
        self.cost, self.integer, self.upper = [], [], []
        self.entries, self.low, self.high = [], [], []

    def variables(self, count, cost=0.0, integer=False, upper=1.0):
        first = len(self.cost)
        self.cost += list(np.broadcast_to(cost, count))
        self.integer += [int(integer)] * count
        self.upper += list(np.broadcast_to(upper, count))
        return np.arange(first, first + count)

    def constrain(self, variables, coefficients, low, high):
        self.entries.append((np.asarray(variables), np.asarray(coefficients, dtype=float)))
        self.low.append(low)
        self.high.append(high)

    def matrix(self):
        lengths = [len(v) for v, _ in self.entries]
        rows = np.repeat(np.arange(len(self.entries)), lengths)
        columns = np.concatenate([v for v, _ in self.entries]) if self.entries else np.zeros(0, int)
        values = np.concatenate([c for _, c in self.entries]) if self.entries else np.zeros(0)
        return csr_matrix(coo_matrix((values, (rows, columns)), shape=(len(self.entries), len(self.cost))))

    def solve(self, seconds, gap, fixed=(), values=()):
        """fixed: variables that keep these values."""
        constraints = [LinearConstraint(self.matrix(), self.low, self.high)] if self.entries else []
        low, high = np.zeros(len(self.cost)), np.array(self.upper, dtype=float)
        fixed = np.asarray(fixed, dtype=int)
        low[fixed] = high[fixed] = values
        return milp(np.array(self.cost), constraints=constraints, integrality=np.array(self.integer),
                    bounds=Bounds(low, high), options={"time_limit": seconds, "mip_rel_gap": gap})


def extents(design, candidate):
    """Half the size of a luminaire along x, y and z, in units of the scene."""
    size = np.array(design.luminaires[candidate.luminaire].photometry.size)
    return np.abs(candidate.matrix()) @ np.maximum(size, FLAT) / 2 * design.units


def too_near(design, candidates):
    """Which candidates cannot hang together: they overlap, are nearer than `apart`, or are at the same place."""
    position = np.array([c.position for c in candidates])
    half = np.array([extents(design, c) for c in candidates])
    near = np.zeros((len(candidates),) * 2, dtype=bool)
    for i in range(len(candidates)):
        apart = np.abs(position - position[i])
        overlap = (apart < half + half[i] - 1e-9 * design.units).all(axis=1)
        near[i] = overlap | (np.hypot(*apart[:, :2].T) < max(design.apart * (1 - 1e-9), 1e-9 * design.units))
    np.fill_diagonal(near, False)
    return near


def cliques(near):
    """Sets of candidates of which at most one can hang, that have all pairs of `near`: few rows and tight bounds."""
    left = np.triu(near)
    for i in range(len(near)):
        for j in range(i + 1, len(near)):
            if not left[i, j]:
                continue
            members, common = [i, j], near[i] & near[j]
            while common.any():
                k = int(np.flatnonzero(common)[np.argmax(left[:, common].sum(axis=0))])
                members.append(k)
                common &= near[k]
            for a in members:
                left[a, members] = False
            yield np.array(members)


def mirror_of(design, candidates, axis, coordinate):
    """For each candidate the one in its mirror place, or -1. It may be turned the same way, or mirrored."""
    found, tolerance = np.full(len(candidates), -1), 1e-4 * design.units
    position = np.array([c.position for c in candidates])
    for i, c in enumerate(candidates):
        place, aim = c.position.copy(), c.aim.copy()
        place[axis], aim[axis] = 2 * coordinate - place[axis], -aim[axis]
        turns = [c.turn % 360, (180 - c.turn if axis == 0 else -c.turn) % 360]
        for j in np.flatnonzero(np.abs(position - place).max(axis=1) < tolerance):
            other = candidates[j]
            if other.luminaire == c.luminaire and np.abs(other.aim - aim).max() < 1e-6 and other.turn % 360 in turns:
                found[i] = j
                break
    return found


def arrange(program, design, candidates, x):
    """The constraints on where luminaires may hang together."""
    for members in cliques(too_near(design, candidates)):
        program.constrain(x[members], np.ones(len(members)), 0, 1)
    if design.most is not None:
        program.constrain(x, np.ones(len(x)), 0, design.most)
    for axis, coordinate in design.mirrors:
        mirrored = mirror_of(design, candidates, axis, coordinate)
        if (mirrored < 0).all():
            raise fault(design.file, None, f"mirror {'xy'[axis]} {coordinate:g}: no candidate has another in its mirror place")
        for i, j in enumerate(mirrored):
            if j < 0:
                program.constrain([x[i]], [1], 0, 0)
            elif i < j:
                program.constrain([x[i], x[j]], [1, -1], 0, 0)
    if design.rows:
        arrange_rows(program, candidates, x, design.even)


def arrange_rows(program, candidates, x, even):
    """Of each grid, some rows and some columns are used, evenly spaced or not, and a luminaire of one kind hangs wherever they cross."""
    used, places = {}, {}

    def variable(key):
        if key not in used:
            used[key] = program.variables(1, integer=True)[0]
        return used[key]

    crossings = {}
    for i, c in enumerate(candidates):
        if c.row is None:
            continue
        grid, row, column = c.row
        crossings.setdefault((grid, row, column), []).append(i)
        for key in ("row", grid, row), ("column", grid, column), ("kind", grid, c.luminaire, tuple(c.aim), c.turn):
            program.constrain([x[i], variable(key)], [1, -1], -1, 0)
        places["row", grid, row], places["column", grid, column] = c.position[1], c.position[0]
    for (grid, row, column), members in crossings.items():
        crossing = [*x[members], variable(("row", grid, row)), variable(("column", grid, column))]
        program.constrain(crossing, [1] * len(members) + [-1, -1], -1, np.inf)
    for kind, grid in dict.fromkeys(key[:2] for key in places) if even else ():
        keys = sorted((key for key in places if key[:2] == (kind, grid)), key=places.get)
        arrange_evenly(program, [used[key] for key in keys], [places[key] for key in keys])
    for grid in {key[1] for key in used}:
        kinds = [v for key, v in used.items() if key[0] == "kind" and key[1] == grid]
        program.constrain(kinds, np.ones(len(kinds)), 0, 1)


def arrange_evenly(program, used, places):
    """Rows (or columns) that are used are evenly spaced. used: the variable of each; places: their coordinates, ascending."""
    choices = even_choices(places)
    chosen = program.variables(len(choices), integer=True)
    program.constrain(chosen, np.ones(len(chosen)), 0, 1)
    for i, variable in enumerate(used):
        here = [v for v, choice in zip(chosen, choices) if i in choice]
        program.constrain([variable, *here], [1] + [-1] * len(here), 0, 0)


def even_choices(places):
    """All sets (of indices) of one place or more that are evenly spaced. places: ascending."""
    found = [{i} for i in range(len(places))]
    for i, first in enumerate(places):
        for j in range(i + 1, len(places)):
            step, choice = places[j] - first, {i}
            for k in range(j, len(places)):
                steps = (places[k] - first) / step
                if abs(steps - len(choice)) < EVEN:
                    choice.add(k)
                    found.append(set(choice))
    return found


def constrain_goal(program, row, variables, slack=None):
    coefficients, constant = row.coefficients / row.size, row.constant / row.size
    variables, coefficients = (variables, coefficients) if slack is None else (
        np.append(variables, slack), np.append(coefficients, row.sense))
    if row.sense > 0:
        program.constrain(variables, coefficients, -constant, np.inf)
    else:
        program.constrain(variables, coefficients, -np.inf, -constant)


def build(design, candidates, watts, scenes, elastic, dimmed):
    """scenes: the rows of each. elastic: goals may be missed (if it is a goal, this one alone), which is what costs; slacks are by goal.
    dimmed: cost of levels, by watts."""
    program, slacks, by_scene = Program(), [], []
    x = program.variables(len(candidates), 1e-6 * watts if elastic else watts, integer=True)
    arrange(program, design, candidates, x)
    for s, rows in enumerate(scenes):
        levels = x
        if design.dims():
            levels = program.variables(len(candidates), dimmed / len(scenes) * watts)
            for i in range(len(candidates)):
                program.constrain([levels[i], x[i]], [1, -1], -1, 0)
        by_scene.append(levels)
        by_goal = {}
        for row in rows:
            slack = None
            if elastic is True or elastic is row.goal:
                key = id(row.goal)
                if key not in by_goal:
                    by_goal[key] = program.variables(1, 1.0, upper=np.inf)[0]
                    slacks.append((s, row.goal, by_goal[key]))
                slack = by_goal[key]
            constrain_goal(program, row, levels, slack)
    return program, x, by_scene, slacks


class Rows:
    """The rows of scenes. Of those of uniformity, one for each point, only those that matter take part in the search."""

    def __init__(self, scenes):
        self.scenes = scenes
        self.used = [np.array([row.goal.kind != "uniformity" for row in rows]) for rows in scenes]

    def taken(self):
        return [[row for row, use in zip(rows, used) if use] for rows, used in zip(self.scenes, self.used)]

    def add_missed(self, levels, allowed):
        """Takes those that a solution misses: of each goal the MOST_MISSED worst. Whether there are any."""
        count = 0
        for s, rows in enumerate(self.scenes):
            by_goal = {}
            for i, row in enumerate(rows):
                miss = -row.sense * (row.coefficients @ levels[s] + row.constant) / row.size - allowed.get((s, id(row.goal)), 0)
                if not self.used[s][i] and miss > 1e-6:
                    by_goal.setdefault(id(row.goal), []).append((miss, i))
            for misses in by_goal.values():
                worst = [i for _, i in sorted(misses, reverse=True)[:MOST_MISSED]]
                self.used[s][worst] = True
                count += len(worst)
        return count > 0


class Solver:
    """Solves until no row is missed that was left out; what time is left goes into better layouts."""

    def __init__(self, design, candidates, watts, scenes, elastic, dimmed):
        self.design, self.candidates, self.watts, self.elastic, self.dimmed = design, candidates, watts, elastic, dimmed
        self.rows = Rows(scenes)
        self.slack = None  # by how much goals may be missed, if watts are what counts
        self.build()

    def build(self):
        """Rows that are added leave the numbers of the variables as they are."""
        self.program, self.x, self.levels, self.slacks = build(self.design, self.candidates, self.watts, self.rows.taken(), self.elastic, self.dimmed)
        if self.slack is not None:
            for (_, _, v), most in zip(self.slacks, self.slack):
                self.program.cost[v], self.program.upper[v] = 0.0, most
            for v, watts in zip(self.x, self.watts):
                self.program.cost[v] = watts

    def missed(self, found):
        """Whether rows are missed that were left out; then they are there from now on."""
        allowed = {(s, id(goal)): found.x[v] for s, goal, v in self.slacks}
        missed = self.rows.add_missed([found.x[v] for v in self.levels], allowed)
        if missed:
            self.build()
        return missed

    def solve(self, seconds, gap):
        end = time.monotonic() + seconds
        while True:
            found = self.program.solve(max(SHARE * (end - time.monotonic()), 0.5), gap)
            if found.x is None or not self.missed(found) or time.monotonic() > end:
                break
        if found.x is not None and found.status != 0:
            bound = found.mip_dual_bound
            found = self.improved(found, end, bound, gap)
            found.mip_dual_bound = bound
        return found

    def improved(self, best, end, bound, gap):
        """Sets some luminaires free that hang near to each other, all others kept, and solves again; more if that does not help."""
        random = np.random.default_rng(1)
        position = np.array([c.position[:2] for c in self.candidates])
        free, failed = min(60, len(position)), 0
        while time.monotonic() < end and best.fun > bound + gap * abs(best.fun):
            if not self.elastic:
                PROGRESS.show(f"Search: {best.fun:.0f} W found, none takes less than {bound:.0f} W, {end - time.monotonic():.0f} s left")
            middle = position[random.choice(len(position))]
            others = np.argsort(np.hypot(*(position - middle).T), kind="stable")[free:]
            found = self.program.solve(min(3.0, max(end - time.monotonic(), 0.1)), 1e-4, self.x[others], np.round(best.x[self.x[others]]))
            if found.x is not None and found.fun < best.fun - 1e-6 and not self.missed(found):
                best, failed = found, 0
                continue
            failed += 1
            if failed == 8:
                free, failed = int(1.3 * free), 0
        return best

    def with_fewer_watts(self, best, seconds):
        """Layouts that miss no goal by more than the best does, but take less."""
        self.slack = [max(best.x[v], 0) + 1e-6 for _, _, v in self.slacks]
        self.build()
        best.fun = float(np.dot(self.program.cost, best.x))
        return self.improved(best, time.monotonic() + seconds, 0.0, 0.0)

    def less_dimmed(self, best, seconds):
        """The layout that takes least as dimmed, of those with the watts of the best; the best if none is found in the time."""
        before, end, total = self.dimmed_watts(best), time.monotonic() + seconds, float(self.watts @ np.round(best.x[self.x]))
        self.dimmed = 1.0
        while time.monotonic() < end:
            self.build()
            self.program.constrain(self.x, self.watts, 0, total + 1e-6)
            for v in self.x:
                self.program.cost[v] = 0.0
            found = self.program.solve(max(end - time.monotonic(), 0.1), DIMMED_GAP)
            if found.x is None:
                break
            if not self.missed(found):
                return found if self.dimmed_watts(found) < before else best
        return best

    def dimmed_watts(self, found):
        """Of all scenes together."""
        return float(sum(self.watts @ found.x[v] for v in self.levels))

    def others(self, best, seconds, dimmed):
        """Other layouts (indices of candidates) with the watts of the best, a share of which hang elsewhere. dimmed: its watts as dimmed, of all scenes."""
        known, end = [np.flatnonzero(best.x[self.x] > 0.5)], time.monotonic() + seconds
        while len(known) <= OTHERS and time.monotonic() < end:
            self.build()
            self.program.constrain(self.x, self.watts, 0, float(self.watts[known[0]].sum()) + 1e-6)
            if self.design.dims():
                self.program.constrain(np.concatenate(self.levels), np.tile(self.watts, len(self.levels)), 0, (1 + TIE) * dimmed)
            for here in known:
                self.program.constrain(self.x[here], np.ones(len(here)), 0, len(here) - max(1, round(ELSEWHERE * len(here))))
            found = self.program.solve(max(end - time.monotonic(), 0.1), 1.0)
            if found.x is None:
                break
            if not self.missed(found):
                known.append(np.flatnonzero(found.x[self.x] > 0.5))
        return known[1:]


def search(design, candidates, watts, scenes, seconds=30.0, gap=0.005, dimmed=0.0):
    """The Layout of least watts. watts: of each candidate. scenes: the rows of each scene. dimmed: what watts of levels cost beside those; 0: they decide among
    layouts of equal watts."""
    decide, cost = design.dims() and not dimmed, dimmed or 1e-9
    solver = Solver(design, candidates, watts, scenes, False, cost)
    found = solver.solve((1 - DIMMED_SHARE * decide) * seconds, gap)
    if found.x is not None and decide:
        found, found.mip_dual_bound = solver.less_dimmed(found, DIMMED_SHARE * seconds), found.mip_dual_bound
    misses, bound = [], getattr(found, "mip_dual_bound", None) or 0.0
    proven = found.status == 2  # not just out of time
    if found.x is None:
        solver = Solver(design, candidates, watts, scenes, True, cost)
        found = solver.solve(seconds / 2, gap)
        if found.x is not None and found.status != 0:  # out of time: watts have hardly counted
            found = solver.with_fewer_watts(found, seconds / 2)
        if found.x is None:
            raise fault(design.file, None, "the arrangement (rows, mirror, apart, most) leaves no layout")
        misses = [(s, goal, float(found.x[v])) for s, goal, v in solver.slacks if found.x[v] > 1e-3]
        bound = 0.0
    x = solver.x
    chosen = np.flatnonzero(found.x[x] > 0.5)
    allowed = {(s, id(goal)): slack for s, goal, slack in misses}

    def dim_all(chosen):
        return [dim(design, watts[chosen], s, rows, chosen, allowed, seconds) for s, rows in enumerate(scenes)]

    levels = dim_all(chosen)

    def others(more):
        if solver.elastic:
            return []  # they miss any goal
        return [(other, dim_all(other)) for other in solver.others(found, more, sum(watts[chosen] @ l for l in levels))]

    return Layout(chosen, levels, bound, misses, proven, others)


def most_of(design, candidates, row, seconds):
    """The most that a goal can get if it is the only one, by its row: what the row has, where all luminaires hang as they may."""
    program = Program()
    x = program.variables(len(candidates), -row.coefficients, integer=True)
    arrange(program, design, candidates, x)
    found = program.solve(seconds, 0.01)
    return None if found.x is None else float(row.coefficients @ np.round(found.x[x]) + row.constant)


def nearest(design, candidates, watts, scenes, goal, seconds):
    """The levels of all candidates in each scene that come nearest to a goal, all others of `scenes` kept; goal None: that keep all.

    None if they cannot be kept, or for lack of time.
    """
    solver = Solver(design, candidates, watts, scenes, goal, 1e-9)
    found = solver.solve(seconds, 0.01)
    if found.x is None:
        return None
    return [found.x[v] if design.dims() else np.round(found.x[v]) for v in solver.levels]


def dim(design, watts, scene, rows, chosen, allowed, seconds):
    """The levels of the chosen luminaires in a scene that take the least power."""
    if not design.dims() or len(chosen) == 0:
        return np.ones(len(chosen))
    program = Program()
    levels = program.variables(len(chosen), watts)
    for row in rows:
        slack = program.variables(1, 1e6, upper=np.inf)[0] if (scene, id(row.goal)) in allowed else None
        small = type(row)(row.goal, row.coefficients[chosen], row.constant, row.sense, row.size)
        constrain_goal(program, small, levels, slack)
    found = program.solve(seconds, 1e-4)
    return np.ones(len(chosen)) if found.x is None else np.clip(found.x[levels], 0, 1)
