"""The steps from goals to a page: matrix, search, luminaires as built, check by light traced forward, plans."""
import contextlib
import dataclasses
import math
import os
import statistics
import tempfile
import time

import numpy as np

from ..fault import fault, needs_light, write_text
from ..page import Page, aligned, table
from ..progress import PROGRESS
from .built import write_lamps
from .design import read_design
from .forward import Forward, daylight_of
from .polish import STEPS as ROUNDS
from .polish import layout_text, neighbours, not_allowed, read_layout, spaces
from .drawing import drawing
from .room import plan_of, polygons_named, read_polygons
from .search import TIE, Layout, most_of, nearest, search
from .standing import covered_text, darkest_text
from .transfer import Transfer
from .wanted import Answer, Light, answers, light_of, receiver_of, rows_of

TOLERANCE = 0.03  # of the check: what was planned and what is found agree within it
AGREE = {None: TOLERANCE, "ugr": 0.2}  # UGR by its difference
SHARES = (0.6, 0.5, 1.0)  # of the time that is left, for the first search and for those with what the first has shown
OTHERS_SHARE = 0.1  # of it, for layouts of equal watts
POLISH_SHARE, POLISH_GAP = 0.3, 1e-4  # of it for each round of polishing, whose search is a small one
POLISH_DIMMED = 0.01  # what watts of levels cost there, in watts of luminaires: dimmed ones are to take less, too
POLISH_ROUNDS = 2  # with or without a gain; then steps are halved while that gains, and takes no longer than these
POLISH_LIMIT = 20  # times the seconds of the search: no round begins later
POLISH_REPEATS = 2  # of its search, with what luminaires as built have shown
ALIKE = 0.005  # the worst goals of two layouts are missed by shares that differ by less: they are equally good
LESS = 1e-3  # of the watts: polishing saves more, or the layout stays
NOISY = 0.01  # of a planned uniformity: with a larger standard error, its light has more directions
MOST_FINER = 8  # times the directions, where the few luminaires that are left allow it
DAYLIGHT_DIVISIONS = 1024
DARKEST_TOLD = 3  # on the terminal, the most uneven ones; the page has all
REMEDY_SECONDS, REMEDIES_SECONDS = 3, 30  # for what would meet a goal, and for limits that would do, of all goals together
BISECTIONS = 5  # for such a limit
MOST_AGAINST = 2  # limits that are named with a goal that they prevent
HARDLY_LIT = 0.02  # of what is wanted: less light than this from all candidates together means that a goal faces the wrong way


@contextlib.contextmanager
def raypath(*folders):
    """RAYPATH with folders in front."""
    before = os.environ.get("RAYPATH")
    os.environ["RAYPATH"] = ":".join([*map(os.path.abspath, folders), before or ".:/usr/local/lib/ray"])
    try:
        yield
    finally:
        if before is None:
            del os.environ["RAYPATH"]
        else:
            os.environ["RAYPATH"] = before


class Steps:
    def __init__(self, rsphere, given):
        self.rsphere, self.given, self.seconds = rsphere, given, {}
        self.polygons = read_polygons(given.room)
        self.design = read_design(given.goals, self.polygons)
        if given.plan:
            polygons_named(self.polygons, given.plan, ("--plan", None))  # its fault is not to come behind minutes of work
        self.title = given.title or f"Layout for {os.path.basename(given.goals)}"
        self.rows = []  # of the table: (scene, goal, planned, found)
        self.miss_texts = {}  # by scene and goal
        self.faults, self.checked = [], []  # of a layout that is judged; by polishing, the Answers of each scene

    def timed(self, name, function):
        begin = time.monotonic()
        value = function()
        PROGRESS.clear()
        self.seconds[name] = self.seconds.get(name, 0.0) + time.monotonic() - begin
        return value

    def run(self):
        with tempfile.TemporaryDirectory() as folder:
            d = self.design
            self.transfer = Transfer(self.rsphere, self.given.room, d, folder, self.given.bounces)
            self.polished = ""
            if self.given.judge:
                self.take_layout(folder)
            else:
                self.use(d.candidates)
                self.matrix = self.timed("matrix", lambda: self.transfer.matrix(d.candidates, self.given.directions))
                self.light = light_of(self.transfer, d.candidates, self.matrix)
                self.check_sides()
                self.daylight = [self.daylight_in(s) for s in d.all_scenes()]
                print(f"Matrix: {len(self.transfer.receivers)} receivers, {len(d.candidates)} candidates, standard error "
                      f"{self.matrix_error():.1%}, {self.seconds['matrix']:.1f} s")
                self.find_layout(folder)
                if self.given.polish:
                    self.polish(folder)
            self.tell_layout()
            self.check()
            self.tell_points()
            self.pages()

    def use(self, candidates):
        self.candidates = list(candidates)
        self.watts = np.array([self.design.luminaires[c.luminaire].watts for c in candidates])

    def take_layout(self, folder):
        """A layout that is to be judged, planned as built."""
        layout, levels = read_layout(self.given.judge, self.design)
        self.faults = not_allowed(self.design, layout)
        self.timed("light", lambda: self.transfer.prepare(self.design.candidates))  # points that all candidates leave dark take no part
        self.daylight = [self.daylight_in(s) for s in self.design.all_scenes()]
        self.use(layout)
        self.matrix = None
        self.layout = Layout(np.arange(len(layout)), list(levels), 0.0, [], False, lambda seconds: [])
        self.timed("plan", lambda: self.plan_as_built(folder))

    def worst(self):
        """By what share of it the worst goal of the layout is missed, as built; 0 if all are met."""
        return max(0.0, *(self.shortfall(a) for s in range(len(self.daylight)) for a in self.planned(s)))

    def cost(self):
        """Watts of the luminaires, and of these as they are dimmed, on average over the scenes."""
        return float(self.watts[self.layout.chosen].sum()), float(np.mean([self.scene_watts(levels) for levels in self.layout.levels]))

    def polish(self, folder):
        """Looks for luminaires beside those of the layout, by the importance there. Light traced forward decides whether they stay."""
        d = self.design
        if d.rows or not len(self.layout.chosen):
            print("Polish: rows stay where they are." if d.rows else "Polish: there is no luminaire.")
            return
        before = self.candidates, self.watts, self.light, self.layout, self.planned_light
        cost, worst, room, begin, longest, gains = self.cost(), self.worst(), spaces(d, self.candidates), time.monotonic(), np.inf, True
        limit = POLISH_LIMIT * self.given.seconds
        for turn in range(len(ROUNDS)):
            if turn == POLISH_ROUNDS:
                longest = 2 * (time.monotonic() - begin)
            if (turn >= POLISH_ROUNDS and not gains) or time.monotonic() - begin > min(longest, limit):
                break
            more, room_more = neighbours(d, self.candidates, self.layout.chosen, room, turn)
            if not more:
                break
            count, old = len(self.candidates), (self.layout, self.planned_light, self.cost(), self.worst())
            matrix = self.timed("polish", lambda: self.transfer.matrix(more, self.given.directions))  # noqa: B023
            self.light = joined(self.light, light_of(self.transfer, more, matrix))
            self.use([*self.candidates, *more])
            room = np.concatenate([room, room_more])
            pool = np.concatenate([self.layout.chosen, np.arange(count, len(self.candidates))])
            factors = [self.factors_as_built(s, {}) for s in range(len(self.daylight))]
            for _ in range(POLISH_REPEATS):
                layout = self.timed("polish", lambda: self.searched(factors, POLISH_SHARE * self.given.seconds, pool))  # noqa: B023
                layout.bound, layout.proven = self.layout.bound, self.layout.proven
                self.layout = layout
                self.timed("polish", lambda: self.plan_as_built(folder))
                if self.worst() <= old[3] + ALIKE:
                    break
                factors = [self.factors_as_built(s, f) for s, f in enumerate(factors)]
            gains = self.better(self.cost(), self.worst(), old[2], old[3])
            if not gains:
                self.layout, self.planned_light = old[:2]
        less, missed = self.cost(), self.worst()
        if self.layout is before[3]:
            self.polished = "nothing beside the candidates is better"
        elif self.holds(before, folder):
            self.polished = (f"{less[1]:.1f} W instead of {cost[1]:.1f} W" + f", {less[0]:g} W instead of {cost[0]:g} W undimmed" * (d.dims() and less[0] != cost[0])
                             + f"; the worst goal is missed by {missed:.1%} instead of {worst:.1%}" * (worst > 1e-3))
        else:
            self.candidates, self.watts, self.light, self.layout, self.planned_light = before
            self.polished = "light traced forward does not confirm what was planned; the layout stays"
        longer = f"; no round begins after {limit:g} s, {POLISH_LIMIT} times -s" if time.monotonic() - begin > limit else ""
        print(f"Polish: {self.polished}{longer} ({self.seconds['polish']:.1f} s)")

    @staticmethod
    def better(cost, worst, old_cost, old_worst):
        """A layout that misses less, or else one that takes less: luminaires first, then levels."""
        if abs(worst - old_worst) > ALIKE:
            return worst < old_worst
        return cost[0] < old_cost[0] - LESS * old_cost[0] or (cost[0] <= old_cost[0] + 1e-6 and cost[1] < old_cost[1] * (1 - LESS))

    def holds(self, before, folder):
        """Whether light traced forward meets every goal, or comes as near to it as with the layout before."""
        if not self.given.check:
            return True
        after, short = (self.candidates, self.watts, self.light, self.layout, self.planned_light), []
        for state in (before, after):
            self.candidates, self.watts, self.light, self.layout, self.planned_light = state
            self.checked = [self.timed("polish", lambda: self.traced(s, scene, folder)) for s, scene in enumerate(self.design.all_scenes())]  # noqa: B023
            short.append([0.0 if a.met(TOLERANCE) else self.shortfall(a) for answers_of in self.checked for a in answers_of])
        good = bool((np.array(short[1]) <= np.array(short[0]) + LESS).all())
        self.checked = self.checked if good else []
        return good

    def traced(self, s, scene, folder):
        """What light traced forward finds for the goals of a scene, with the luminaires written into a folder."""
        with raypath(folder):
            return self.found(scene, write_lamps(self.design, self.candidates, self.layout.chosen, self.layout.levels[s], folder, "polished"))

    def check_sides(self):
        """Raises Fault for a surface or sensor that all candidates together hardly light: it faces a wall, or out of the room."""
        for scene in self.design.all_scenes():
            for goal in scene.goals:
                if goal.kind != "illuminance" or scene.daylight:
                    continue
                i = receiver_of(self.transfer, goal.target, ("plane",))
                most = float(self.matrix.total()[i].sum())
                if most < HARDLY_LIT * goal.value:
                    x, y, z = self.transfer.receivers[i].normals.mean(axis=0) + 0.0
                    remedy = "turn it round" if goal.target in self.design.sensors else self.other_side(goal.target)
                    raise fault(*goal.place, f"all candidates together give {goal.target} {most:.2g} lx where it faces, "
                                f"{x:.2g} {y:.2g} {z:.2g}; if its other side is meant, {remedy}")

    def other_side(self, surface):
        return "write back behind the goal" if self.design.surfaces[surface].side > 0 else "leave out back"

    def matrix_error(self):
        """rms of the standard errors, each by what all candidates together give to its receiver on average."""
        mean = self.matrix.total().mean(axis=1, keepdims=True)
        mean[mean == 0] = np.inf  # nothing reaches an eye: the table shows that
        return float(np.sqrt(((self.matrix.error() / mean) ** 2).mean()))

    def daylight_in(self, scene):
        if not scene.daylight:
            return None
        outdoors = self.rsphere.Scene([*scene.daylight, *self.given.room])
        with needs_light(f"{scene.place[0]}:{scene.place[1]}: there is no light in {', '.join(scene.daylight)}, the daylight of the scene {scene.name}"):
            direct = self.timed("daylight", lambda: daylight_of(self.transfer, outdoors, DAYLIGHT_DIVISIONS))
        return Light(direct, np.zeros((1, len(direct), 1)), {})

    def find_layout(self, folder):
        """Searches, and again with what the luminaires as built take from the light, until the goals are met as built."""
        factors = [{} for _ in self.design.all_scenes()]
        best = None
        for share in SHARES:
            left = max(self.given.seconds - self.seconds.get("search", 0.0), 0.0)
            layout = self.timed("search", lambda: self.searched(factors, share * left))  # noqa: B023
            if best and layout.misses:
                break
            self.layout = layout
            self.timed("plan", lambda: self.plan_as_built(folder))
            if layout.misses:
                nearer = self.nearer(layout)
                if nearer is not layout:
                    self.layout = layout = nearer
                    self.timed("plan", lambda: self.plan_as_built(folder))
            shortfall = max(self.shortfall(a) for s in range(len(factors)) for a in self.planned(s))
            if best is None or shortfall < best[0]:
                best = shortfall, layout, self.planned_light
            if shortfall <= 0 or layout.misses:
                break
            factors = [self.factors_as_built(s, f) for s, f in enumerate(factors)]
        _, self.layout, self.planned_light = best

    @staticmethod
    def shortfall(answer):
        """By what share a goal is missed; below 0 if it is met."""
        goal = answer.goal
        if goal.kind == "ugr":
            return (answer.value - goal.value) / 10
        miss = (goal.value - answer.value) / max(goal.value, 1e-9)
        return -miss if goal.kind == "most" else miss

    def factors_as_built(self, s, before):
        """Factors on the light of each goal in a scene, so that it is met by luminaires as built."""
        scene, levels = self.design.all_scenes()[s], self.layout.levels[s]
        found = {}
        as_points = answers(self.transfer, scene.goals, self.light_of_chosen(), levels, self.daylight[s])
        for built, planned in zip(self.planned(s), as_points):
            kind, key = built.goal.kind, (built.goal.kind, built.goal.target)
            ratio = 10 ** ((built.value - planned.value) / 8) if kind == "ugr" else built.value / max(planned.value, 1e-9)
            found[key] = (max if kind in ("ugr", "most") else min)(ratio, before.get(key, 1.0))
        return found

    def searched(self, factors, seconds, pool=None):
        """pool: the candidates that a polished layout may have."""
        PROGRESS.begin("Search", seconds=seconds)
        light = self.light if pool is None else chosen_light(self.light, pool)
        scenes = [rows_of(self.transfer, s.goals, light, day, f)
                  for s, day, f in zip(self.design.all_scenes(), self.daylight, factors)]
        if pool is None:
            return search(self.design, self.candidates, self.watts, scenes, seconds, self.given.gap)
        layout = search(self.design, [self.candidates[j] for j in pool], self.watts[pool], scenes, seconds, POLISH_GAP, POLISH_DIMMED)
        layout.chosen = pool[layout.chosen]
        return layout

    def light_of_chosen(self):
        """The light of the chosen luminaires as points, which hide nothing."""
        return chosen_light(self.light, self.layout.chosen)

    def plan_as_built(self, folder):
        """The light of the chosen luminaires once more, where they hang: they hide and absorb light, as bodies."""
        d, chosen = self.design, self.layout.chosen
        if not len(chosen):
            self.planned_light = self.light_of_chosen()
            return
        lamps, files = [self.candidates[j] for j in chosen], list(self.given.room)
        files.append(write_lamps(d, self.candidates, chosen, np.ones(len(chosen)), folder, "bodies"))
        with raypath(folder):
            transfer = Transfer(self.rsphere, files, d, folder, self.given.bounces, fine=True)
            finer = min(max(len(self.candidates) // (2 * len(lamps)), 1), MOST_FINER)
            self.planned_light = light_of(transfer, lamps, transfer.matrix(lamps, finer * self.given.directions))
            by_more = {}
            for i, relative in self.noise(transfer).items():
                if relative > NOISY and finer < MOST_FINER:
                    by_more.setdefault(min(math.ceil((relative / NOISY) ** 2 * finer), MOST_FINER) - finer, []).append(i)
            for more, noisy in by_more.items():
                self.planned_light.cells.update(
                    transfer.with_more_directions(lamps, finer * self.given.directions, more * self.given.directions, noisy))

    def noise(self, transfer):
        """By receiver, the largest standard error of its planned uniformities, relative: that of its darkest cell alone."""
        found = {}
        for s in range(len(self.daylight)):
            for a in self.planned(s):
                if a.goal.kind == "uniformity" and a.value > 0:
                    i = receiver_of(transfer, a.goal.target, ("plane",))
                    found[i] = max(found.get(i, 0.0), a.error / a.value)
        return found

    def dimmed_text(self):
        """The watts of each scene, if luminaires are dimmed."""
        if not self.design.dims():
            return ""
        each = (f"{s.name} {self.scene_watts(levels):.0f} W".strip() for s, levels in zip(self.design.all_scenes(), self.layout.levels))
        return f"; dimmed: {', '.join(each)}"

    def tie_text(self):
        return f", as dimmed within {TIE:.1%}" if self.design.dims() else ""

    def tell_points(self):
        """Which points are left out, and where goals are darkest."""
        room, self.points_text, self.darkest = self.rsphere.Scene(self.given.room), [], []
        self.points_text += [covered_text(room, s) for s in self.design.surfaces.values() if len(s.covered)]
        below = min(c.position[2] for c in self.candidates)
        uneven = [(scene, goal, found or planned) for scene, goal, planned, found in self.rows if goal.kind == "uniformity"]
        for scene, goal, answer in sorted(uneven, key=lambda row: row[2].value):
            if answer.place is not None:
                normal = self.design.surfaces[goal.target].normals[0]
                self.darkest.append((scene.name, answer.place))
                self.points_text.append(darkest_text(room, f"{scene.name} {goal.target}".strip(), answer.place, normal, answer.value, below))
        covered = len(self.points_text) - len(self.darkest)
        for line in self.points_text[: covered + DARKEST_TOLD]:
            print(f"{line}.")

    def scene_watts(self, levels):
        return float(self.watts[self.layout.chosen] @ levels)

    def tell_layout(self):
        layout, d = self.layout, self.design
        # The program asks for all that is wanted; what is nearer than the check's tolerance counts as met.
        layout.misses = [m for m in layout.misses if not next(a for a in self.planned(m[0]) if a.goal is m[1]).met(TOLERANCE)]
        total = float(self.watts[layout.chosen].sum())
        longer = "; -s gives the search more time" if total * (1 - self.given.gap) > layout.bound + 0.5 and not self.given.judge else ""
        gap = f" ({1 - layout.bound / total:.1%} less{longer})" if total - layout.bound > 0.5 else ""
        here = " at the candidates" if self.polished else ""  # there, others are not proven to take more
        unknown = "; the least watts are not known: -s gives the search more time" if total > 0 and not (layout.misses or self.given.judge) else ""
        bound = f"; none{here} takes less than {layout.bound:.0f} W{gap}" if layout.bound > 0 else unknown
        print(f"Layout: {len(layout.chosen)} luminaires, {total:g} W{bound}{self.dimmed_text()} ({self.seconds.get('search', 0):.1f} s)")
        self.others = self.timed("others", lambda: layout.others(OTHERS_SHARE * self.given.seconds)) if not (layout.misses or self.polished or self.given.judge) else []
        for k, (other, levels) in enumerate(self.others):
            name = f"layout{k + 2}.txt"
            self.write(name, layout_text(d, self.candidates, other, levels))
            elsewhere = len(set(other) - set(layout.chosen))
            print(f"{len(other)} luminaires, {elsewhere} of them elsewhere, take as many watts{self.tie_text()}: {name}; not checked")
        self.write("layout.txt", layout_text(d, self.candidates, layout.chosen, layout.levels))
        for text in self.faults:
            print(f"Not allowed: {text}")
        for s, goal, slack in layout.misses:
            name = d.all_scenes()[s].name
            text = self.miss_texts[s, id(goal)] = f"{self.miss_text(s, goal)}{self.remedy(s, goal)}"
            print(f"{self.miss_head()}{' in ' + name if name else ''}: {text}")

    def miss_head(self):
        return "Cannot be met" if self.layout.proven else "Not found in the time of -s"

    def remedy(self, s, goal):
        """What would meet a goal that is missed: whether other goals stand against it, or how much more light it takes."""
        if goal.kind not in ("illuminance", "cylindrical"):
            return self.limit_text(s, goal)
        row = rows_of(self.transfer, [goal], self.light, self.daylight[s], {})[0]
        more = most_of(self.design, self.candidates, row, REMEDY_SECONDS)
        if more is None:
            return ""
        best = more + goal.value
        if best >= goal.value:
            return f"; alone it could have {shown(goal, best)}: the other goals or their limits stand against it{self.against_text(s, goal)}"
        return (f"; all that can hang here gives {shown(goal, best)}: {goal.value / max(best, 1e-9):.2f} times the light of the luminaires, "
                f"more places, or a goal of {shown(goal, best)} would do")

    def would_do(self, s, goal, kept):
        """Which limit would do in place of that of a goal of uniformity, UGR or most, if it gives way to those that are kept. None if that is not known."""
        if not len(self.layout.chosen):
            return None
        scene, factors = self.design.all_scenes()[s], [self.factors_as_built(k, {}) for k in range(len(self.daylight))]
        factor = factors[s].get((goal.kind, goal.target), 1.0)

        def reached(value, elastic):
            changed = dataclasses.replace(goal, value=value)
            if self.seconds.get("remedies", 0.0) > REMEDIES_SECONDS:
                return None
            rows = self.rows_with(factors, lambda g: changed if g is goal else g if kept(g) else None)
            levels = self.timed("remedies", lambda: nearest(self.design, self.candidates, self.watts, rows, changed if elastic else None, REMEDY_SECONDS))
            if levels is None or not levels[s].any():
                return None
            found = next(a for a in answers(self.transfer, scene.goals, self.light, levels[s], self.daylight[s]) if a.goal is goal).value
            return found + 8 * math.log10(factor) if goal.kind == "ugr" else found * factor

        value, wanted = reached(goal.value, True), goal.value
        for _ in range(BISECTIONS if value is not None else 0):  # slacks are lux, so that less light came nearer to a uniformity
            middle = (value + wanted) / 2
            found = reached(middle, False)
            value, wanted = (value, middle) if found is None else (found, wanted)
        if value is None or self.shortfall(Answer(goal, value, 0.0)) <= 0:
            return None
        return math.floor(100 * value) / 100 if goal.kind == "uniformity" else math.ceil(10 * value) / 10

    def rows_with(self, factors, change):
        """The rows of each scene. change: of a goal, what takes its place, or None."""
        return [rows_of(self.transfer, [g for g in map(change, scene.goals) if g], self.light, day, f)
                for scene, day, f in zip(self.design.all_scenes(), self.daylight, factors)]

    def nearer(self, layout):
        """A layout that misses a uniformity, and nothing else, by less."""
        (s, goal, _), *more = layout.misses
        before = next(a for a in self.planned(s) if a.goal is goal).value
        value = self.would_do(s, goal, lambda g: True) if goal.kind == "uniformity" and not more else None
        if value is None or value <= before:
            return layout
        changed = dataclasses.replace(goal, value=value)
        rows = self.rows_with([self.factors_as_built(k, {}) for k in range(len(self.daylight))], lambda g: changed if g is goal else g)
        better = self.timed("search", lambda: search(self.design, self.candidates, self.watts, rows, REMEDY_SECONDS, self.given.gap))
        if better.misses:
            return layout
        better.misses, better.bound, better.proven, better.others = [(s, goal, goal.value - value)], 0.0, layout.proven, layout.others
        return better

    def limit_text(self, s, goal):
        missed = {id(g) for _, g, _ in self.layout.misses}
        for kept, words in ((lambda g: True, "all others kept"), (lambda g: id(g) not in missed, "those kept that are met")):
            value = self.would_do(s, goal, kept)
            if value is not None:
                return f"; {shown(goal, value)} would do, {words}; for {shown(goal, goal.value)} it takes other luminaires, aims or places"
        return ""

    def against_text(self, s, goal):
        """Which single limits, and how far changed, would let a goal be met that is missed because of others."""
        found = []
        for other in self.design.all_scenes()[s].goals:
            if other is not goal and other.kind in ("ugr", "most", "uniformity") and len(found) < MOST_AGAINST:
                value = self.would_do(s, other, lambda g: True)
                found += [f"{other.kind} {other.target} of {shown(other, value)}"] if value is not None else []
        return f"; with {' or '.join(found)} it could be met, all others kept" if found else ""

    def miss_text(self, s, goal):
        planned = self.planned(s)
        value = next(a for a in planned if a.goal is goal)
        return f"{goal.kind} {goal.target}: {shown(goal, goal.value)} is wanted, {shown(goal, value.value)} is the nearest to all goals"

    def planned(self, s):
        scene = self.design.all_scenes()[s]
        return answers(self.transfer, scene.goals, self.planned_light, self.layout.levels[s], self.daylight[s])

    def check(self):
        self.files = []
        for s, (scene, levels) in enumerate(zip(self.design.all_scenes(), self.layout.levels)):
            name = f"lamps_{scene.name}" if scene.name else "lamps"
            file = write_lamps(self.design, self.candidates, self.layout.chosen, levels, self.given.output, name)
            self.files.append(file)
            planned = self.planned(s)
            found = [None] * len(planned)
            if self.checked:
                found = self.checked[s]  # the light is the same
            elif self.given.check and len(self.layout.chosen):
                found = self.timed(f"check {s}", lambda: self.found(scene, file))  # noqa: B023
            self.rows += [(scene, p.goal, p, f) for p, f in zip(planned, found)]
        self.tell_table()

    def found(self, scene, file):
        """Answers by light traced forward. Glare is that of luminaires alone, as planned."""
        with raypath(self.given.output):
            electric = Forward(self.transfer, self.rsphere.Scene([*self.given.room, file]), self.given.check)
            if not scene.daylight:
                return electric.answers(scene.goals)
            both = Forward(self.transfer, self.rsphere.Scene([*scene.daylight, *self.given.room, file]),
                           max(self.given.check, DAYLIGHT_DIVISIONS))
            glare = iter(electric.answers([g for g in scene.goals if g.kind == "ugr"]))
            rest = iter(both.answers([g for g in scene.goals if g.kind != "ugr"]))
            return [next(glare if g.kind == "ugr" else rest) for g in scene.goals]

    def table_rows(self):
        for scene, goal, planned, found in self.rows:
            row = [scene.name, goal.kind, goal.target, shown(goal, goal.value), shown(goal, planned.value)]
            if found:
                row += [shown(goal, found.value), shown(goal, found.error, True), deviation_text(planned, found),
                        "yes" if found.met(TOLERANCE) else "!no"]
            yield row if self.design.scenes else row[1:]

    def head(self):
        head = ["scene", "goal", "of", "wanted", "planned", "found", "+-", "deviation", "met"]
        return head if self.design.scenes else head[1:]

    def tell_table(self):
        text = "\n".join(aligned([self.head(), *self.table_rows()], range(3 if self.design.scenes else 2))) + "\n"
        print(text, end="")
        print(self.verdict())
        self.write("table.txt", text + self.verdict() + "\n")

    def differences(self, kind):
        """How far what was planned is from what is found: by goals of a kind, None for illuminances (ratios)."""
        both = [(p.value, f.value) for _, g, p, f in self.rows if f and (g.kind if g.kind in AGREE else None) == kind]
        return [abs(p - f) if kind else abs(p / f - 1) for p, f in both if kind or f > 0]

    def agree(self):
        return all(d <= most for kind, most in AGREE.items() for d in self.differences(kind))

    def met(self):
        return not self.layout.misses and not self.faults and all(f is None or f.met(TOLERANCE) for *_, f in self.rows)

    def help_text(self):
        """What would meet the goals that are missed by light traced forward alone."""
        missed = [(p, f) for *_, p, f in self.rows if f and not f.met(TOLERANCE)]
        more = [p.value / f.value - 1 for p, f in missed if p.met() and p.goal.kind not in ("most", "ugr") and f.value > 0]
        if len(more) < len(missed):
            return " More seconds for the search (-s) or more places may meet them."
        return f" They are met as planned: goals that ask for {max(more):.0%} more will be met."

    def verdict(self):
        if not any(f for *_, f in self.rows):
            return "Not checked."
        largest = [(f"{max(d):.2f} ({kind})" if kind else f"{max(d):.1%}") for kind in AGREE for d in [self.differences(kind)] if d]
        text = (f"Planned and found {'agree' if self.agree() else 'DO NOT agree'} within {TOLERANCE:.0%}: the largest deviations are "
                f"{', '.join(largest)}.")
        missed = sum(not f.met(TOLERANCE) for *_, f in self.rows if f)
        if missed or self.layout.misses:
            helps = "" if self.layout.misses or self.given.judge else self.help_text()
            return f"{max(missed, len(self.layout.misses))} of {len(self.rows)} goals are not met. {text}{helps}"
        return f"All {len(self.rows)} goals are met. {text}"

    def falsecolor(self, s, scene):
        floor = max((p for p in self.polygons if p.vector()[2] > 0), key=lambda p: p.vector()[2], default=None)
        name = self.given.plan or (floor and floor.name)
        if self.given.no_plan or not name or not (scene.daylight or self.layout.levels[s].any()):
            return None
        d = self.design
        heights = [surface.points[0, 2] for surface in d.surfaces.values() if surface.normals[0, 2] > 0.9]
        height = self.given.height
        if height is None:
            height = statistics.median(heights) - floor.corners[0, 2] if heights and not self.given.plan else 0.75 * d.units
        PROGRESS.begin("Plan in false colors")
        path = os.path.join(self.given.output, f"plan_{scene.name or 'all'}.svg")
        size = np.ptp(floor.corners[:, :2], axis=0).max() if floor else 10 * d.units
        outlines = list(dict.fromkeys(p.name for surface in d.surfaces.values() for p in surface.polygons))[:60] + [f"{d.luminaires[self.candidates[j].luminaire].name}.{n + 1}.1"
                                            for n, (j, l) in enumerate(zip(self.layout.chosen, self.layout.levels[s]))
                                            if l >= 1e-4 and d.luminaires[self.candidates[j].luminaire].photometry.shape == "box"]
        command = ["-s", name, "-h", f"{height:g}", "-d", f"{size / 28:g}", "-z", "-t",
                   f"Illuminance {height / d.units:.2f} m above {name} (lx){': ' + scene.name if scene.name else ''}"]
        command += [word for o in outlines for word in ("-c", o)]
        command += [*scene.daylight, *self.given.room, self.files[s], "--", "-ab", str(self.given.bounces + 1), "-ad", "512", "-as", "128"]
        folder = os.path.abspath(self.given.output)
        path_of = ":".join(p for p in (folder, os.environ.get("RAYPATH", ".")) if p)
        return plan_of(path, command, path_of)

    def pages(self):
        page, d = Page(self.title), self.design
        page.banner(self.met() and self.agree(), self.verdict())
        for s, goal, _ in self.layout.misses:
            page.banner(False, f"{self.miss_head()}: {d.all_scenes()[s].name + ' ' if d.all_scenes()[s].name else ''}{self.miss_texts[s, id(goal)]}")
        for s, (scene, levels) in enumerate(zip(d.all_scenes(), self.layout.levels)):
            title = self.layout_title(scene, levels)
            darkest = [place for name, place in self.darkest if name == scene.name]
            svg = drawing(d, self.polygons, self.candidates, self.layout.chosen, levels, title, darkest)
            self.write(f"layout_{scene.name}.svg" if scene.name else "layout.svg", svg)
            page.heading(title)
            page.figure(svg)
            page.note(self.load(levels))
            plan = self.timed(f"plan {s}", lambda: self.falsecolor(s, scene))  # noqa: B023
            if plan:
                page.figure(plan)
                page.note(f"The maintenance factor of {d.maintenance:g} is in the light of the luminaires.")
        page.heading("Planned against found")
        page.add(table(self.head(), list(self.table_rows()), 3 if d.scenes else 2))
        for line in self.points_text:
            page.note(f"{line}.")
        for line in self.faults:
            page.banner(False, f"Not allowed: {line}")
        if self.polished:
            page.note(f"Polished between the candidates: {self.polished}.")
        if self.others:
            page.note(f"{len(self.others)} other layouts take as many watts{self.tie_text()}: {', '.join(f'layout{k + 2}.txt' for k in range(len(self.others)))}, not checked.")
        planned = (f"the importance of the goals at {len(self.candidates)} candidates, {self.given.bounces} reflections, standard error "
                   f"{self.matrix_error():.1%}") if self.matrix else f"the importance of the goals at the luminaires, {self.given.bounces} reflections"
        page.note(f"Planned: by {planned}. Found: light traced forward from the luminaires as built (rsphere -I), with its "
                  f"standard error. A goal is met if what is found keeps it within {TOLERANCE:.0%}, a limit of UGR within .1.")
        page.heading("Luminaires")
        page.add(table(["number", "luminaire", "x", "y", "z", "turn", "aim", *(s.name or "level" for s in d.all_scenes())], list(self.lamp_rows()), 2))
        page.note(f"Scene text: {', '.join(os.path.basename(f) for f in self.files)}. Seconds: "
                  + ", ".join(f"{k} {v:.1f}" for k, v in self.seconds.items()) + ".")
        self.write("page.html", page.html())

    def write(self, name, text):
        write_text(os.path.join(self.given.output, name), text)

    def layout_title(self, scene, levels):
        """The watts are those of the luminaires, and as they are dimmed where this is less."""
        total, dimmed = float(self.watts[self.layout.chosen].sum()), self.scene_watts(levels)
        less = f", {dimmed:.0f} W as dimmed" if dimmed < total - 0.5 else ""
        return f"{len(self.layout.chosen)} luminaires, {total:.0f} W{less}" + (f": {scene.name}" if scene.name else "")

    def load(self, levels):
        """How many luminaires of each kind, and the watts on the floor."""
        kinds = [self.candidates[j].luminaire for j in self.layout.chosen]
        each = [f"{kinds.count(i)} {l.name} of {l.watts:g} W" for i, l in enumerate(self.design.luminaires) if i in kinds]
        area = max((p.vector()[2] for p in self.polygons), default=0) / self.design.units**2
        share = f": {self.scene_watts(levels) / area:.1f} W/m2 on {area:.0f} m2" if area > 0 else ""
        return (", ".join(each) or "No luminaire") + share + "."

    def lamp_rows(self):
        for n, j in enumerate(self.layout.chosen):
            c = self.candidates[j]
            yield [str(n + 1), self.design.luminaires[c.luminaire].name, *(f"{v:.3f}" for v in c.position), f"{c.turn:g}",
                   " ".join(f"{v + 0.0:.2g}" for v in c.aim),
                   *(f"{levels[n]:.0%}" for levels in self.layout.levels)]


def chosen_light(light, chosen):
    """The Light of some of the candidates."""
    return Light([a[:, chosen] for a in light.direct], light.sets[:, :, chosen], {k: v[chosen] for k, v in light.glare.items()})


def joined(light, more):
    """The Light of the candidates of both."""
    return Light([np.hstack([a, b]) for a, b in zip(light.direct, more.direct)], np.concatenate([light.sets, more.sets], axis=2),
                 {k: np.concatenate([v, more.glare[k]]) for k, v in light.glare.items()})


def shown(goal, value, error=False):
    if goal.kind == "uniformity":
        return f"{value:.3f}" if error else f"{value:.2f}"
    if goal.kind == "ugr":
        return f"{value:.2f}" if error else f"{value:.1f}"
    return f"{value:.1f} lx" if error else f"{value:.0f} lx"


def deviation_text(planned, found):
    if planned.goal.kind == "ugr":
        return f"{planned.value - found.value:+.2f}"
    if planned.goal.kind == "uniformity":
        return f"{planned.value - found.value:+.3f}"
    return f"{planned.value / found.value - 1:+.1%}" if found.value > 0 else "-"
