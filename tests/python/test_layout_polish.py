"""Layouts between the candidates, layouts that are judged, and layouts of equal watts.

PROGRAMS in the environment is the folder of rsphere and plan; PYTHONPATH has the folder of the package rsphere.
"""
import argparse
import contextlib
import io
import itertools
import os
import re
import unittest
import unittest.mock

import numpy as np

from rsphere.fault import Fault
from rsphere.layout.built import maintenance_in, write_lamps
from rsphere.layout.design import Goal, read_design
from rsphere.layout.polish import MOST_TILT, SHARES, TILTS, layout_text, neighbours, not_allowed, read_layout, spaces, tilted
from rsphere.layout.room import read_polygons
from rsphere.layout.search import Layout, Solver, search
from rsphere.layout.steps import Steps
from rsphere.layout.wanted import Answer, Row
from run_here import InAFolder, built, run_here
from test_layout_points import CASES, ROOM

SPOT = f"luminaire spot {os.path.join(CASES, 'downlight.ies')}"
DESK = "white polygon desk 0 0 12 1.2 1 .75 2.8 1 .75 2.8 1.8 .75 1.2 1.8 .75\n"


class Places(InAFolder):
    def design(self, *lines):
        room, goals = self.file(ROOM + DESK, "room.rad"), self.file("\n".join([SPOT, *lines, "illuminance desk 100"]), "goals.txt")
        return read_design(goals, read_polygons([room]))

    def layout(self, text, design):
        return read_layout(self.file(text, "layout.txt"), design)[0]

    def test_neighbours(self):
        """Around a place of a grid, along a line, and of a single place; aims turn only where they are not straight down."""
        design = self.design("grid spot ceiling spacing 2 2.5 drop .1", "place spot 1 1 2.5 aim 0 1 -1", "place spot 2 1 2.4", "place spot 2.5 1 2.4")
        c, room = design.candidates, spaces(design, design.candidates)
        np.testing.assert_allclose(room[[0, 8, 9, 10]], [[1, 1.25], [0, 0], [0.25, 0], [0.25, 0]])
        for turn, share in enumerate(SHARES):
            found, more = neighbours(design, c, [0, 8, 9], room, turn)
            self.assertEqual(len(found), 8 + 4 + 2)
            moved = np.array([n.position for n in found[:8]]) - c[0].position
            self.assertEqual({tuple(np.round(m, 9)) for m in moved},
                             {(2 * share * a, 2 * share * b * 1.25, 0) for a in (-1, 0, 1) for b in (-1, 0, 1) if a or b})
            np.testing.assert_allclose([n.aim @ c[8].aim for n in found[8:12]], np.cos(np.radians(TILTS[turn])))
            np.testing.assert_array_equal(more[:8], np.tile(room[0], (8, 1)))
        self.assertLess(sum(SHARES), 0.5)
        self.assertLess(sum(TILTS), MOST_TILT)

    def test_tilted(self):
        aim = np.array([0.6, 0, -0.8])
        np.testing.assert_allclose(tilted(aim, (0, 1), 90), [0, -1, 0], atol=1e-12)
        np.testing.assert_allclose(tilted(aim, (1, 0), 90), [0.8, 0, 0.6], atol=1e-12)

    def test_what_is_allowed(self):
        grid = "grid spot ceiling spacing 2 2.5 drop .1"  # x 1 3 5 7, y 1.25 3.75, z 2.9
        aside = "place spot 4 1 2.5 aim 0 1 -1"
        for lines, text, words in (
            ([grid], "spot 1 1.25 2.9 0 0 -1 0 1", ""), ([grid], "spot 1.9 2.3 2.9 0 0 -1 0 1", ""), ([grid], "spot 1 1.25 2.8 0 0 -1 0 1", "1 spot hangs where none"),
            ([grid], "spot -.1 1.25 2.9 0 0 -1 0 1", "1 spot hangs"), ([grid], "spot 1 1.25 2.9 0 0 -1 45 1", "1 spot hangs"),
            ([grid], "spot 1 1.25 2.9 0 .1 -1 0 1", "1 spot hangs"), ([grid, aside], "spot 4 1 2.5 0 1 -.9 0 1", ""),
            ([grid, aside], "spot 4 1 2.5 0 1 -.5 0 1", "1 spot hangs"), ([grid, aside], "spot 4 1.1 2.5 0 1 -1 0 1", "1 spot hangs"),
            ([grid], "spot 1 1.25 2.9 0 0 -1 0 1\nspot 1.1 1.25 2.9 0 0 -1 0 1", "1 and 2 overlap"), ([grid, "most 1"], "spot 1 1.25 2.9 0 0 -1 0 1\nspot 3 1.25 2.9 0 0 -1 0 1", "more than 1"),
            ([grid, "apart 1"], "spot 1 1.25 2.9 0 0 -1 0 1\nspot 1.9 1.25 2.9 0 0 -1 0 1", "1 and 2 overlap or are too near"),
            ([grid, "mirror x 4"], "spot 1 1.25 2.9 0 0 -1 0 1", "not symmetric about x = 4"),
            ([grid, "mirror x 4"], "spot 1.5 1.25 2.9 0 0 -1 0 1\nspot 6.5 1.25 2.9 0 0 -1 0 1", ""),
            ([grid, "rows"], "spot 1 1.25 2.9 0 0 -1 0 1\nspot 3 1.25 2.9 0 0 -1 0 1", ""),
            ([grid, "rows"], "spot 1 1.25 2.9 0 0 -1 0 1\nspot 3 3.75 2.9 0 0 -1 0 1", "not in rows"),
            ([grid, "rows"], "spot 1 1.25 2.9 0 0 -1 0 1\nspot 3.2 1.25 2.9 0 0 -1 0 1", "not in rows"),
        ):
            with self.subTest(lines=lines, text=text):
                design = self.design(*lines)
                found = not_allowed(design, self.layout(text, design))
                self.assertRegex("; ".join(found), words or r"\A\Z")

    def test_files_of_layouts(self):
        design = self.design("grid spot ceiling spacing 2 2.5 drop .1", "scene day", "illuminance floor 20", "scene night", "illuminance floor 10")
        text = layout_text(design, design.candidates, [1, 5], [[1, 0.25], [0.5, 0]])
        layout, levels = read_layout(self.file(text, "layout.txt"), design)
        np.testing.assert_allclose([c.position for c in layout], [design.candidates[j].position for j in (1, 5)])
        np.testing.assert_allclose(levels, [[1, 0.25], [0.5, 0]])
        for text, line, words in (
            ("panel 1 1 1 0 0 -1 0 1 1", 1, 'no luminaire "panel" in the goals; there are spot'), ("# none\nspot 1 1", 2, "z of the place"), ("", None, "there is no luminaire"),
            ("spot 1 1 1 0 0 0 0 1 1", 1, "aim must not be 0 0 0"), ("spot 1 1 1 0 0 -1 0 1 2", 1, "level in night must be from 0 to 1"),
            ("spot 1 1 1 0 0 -1 0 1", 1, "needs the level in night"), ("spot 1 1 1 0 0 -1 0 1 1 1", 1, '"1" is not expected'), ("spot 1 nan 1 0 0 -1 0 1 1", 1, "must be a number"),
            ("\n".join(["spot 1 1 1 0 0 -1 0 1 1"] * 3000), 2001, "more than 2000 luminaires"), ("spot 1e300 1 1 0 0 -1 0 1 1", 1, "x of the place must be from"), ("\0", 1, "not a text file"),
            ("spot 1 1 1 0 0 -1 0 1 -.1", 1, "level in night must be from 0 to 1"), ("SPOT 1 1 1 0 0 -1 0 1 1", 1, 'no luminaire "SPOT"'), ("spot 1 1 1 0 0 -1 400 1 1", 1, "turn must be from -360"),
        ):
            with self.subTest(text=text):
                with self.assertRaises(Fault) as caught:
                    self.layout(text + "\n", design)
                self.assertRegex(str(caught.exception), r"layout\.txt:" + (f"{line}: " if line else " ") + ".*" + re.escape(words))
        with self.assertRaisesRegex(Fault, "are not dimmed"):
            self.layout("spot 1 1 1 0 0 -1 0 .5\n", self.design("grid spot ceiling"))

    def test_maintenance_in_files_of_luminaires(self):
        """A report with a maintenance factor of its own took that of the layout once more, without a word."""
        design = self.design("maintenance .7", "grid spot ceiling spacing 2 2.5 drop .1")
        lamps, room = write_lamps(design, design.candidates, [0], [1.0], self.folder.name, "lamps"), os.path.join(self.folder.name, "room.rad")
        self.assertEqual([maintenance_in(file) for file in (lamps, room, "none.rad")], [0.7, 1, 1])
        for factor, words in ((0.9, r"lamps\.rad: the luminaires have a maintenance factor of 0\.7 in their light, and the report multiplies it by 0\.9"), (1, r"\A\Z")):
            tasks = self.file(f"maintenance {factor}\ntask desk 34.2\neyes spacing 4\n", "tasks.txt")
            run = run_here([built("rsphere-layout"), "--report", "--accuracy", ".5", "-b", "0", "--no-plan", "-o", self.folder.name, tasks, room, lamps])
            self.assertRegex(run.stderr, words)
            self.assertIn("desk", run.stdout)

    def test_no_others_where_goals_are_missed(self):
        """Layouts that missed the goals by more were listed as equally good."""
        design, goal = self.design("place spot 4 2.5 2.8", "place spot 3 2.5 2.8"), Goal("illuminance", "desk", 300, ("goals.txt", 1))
        for wanted, count in ((300, 0), (90, 1)):
            rows = [Row(goal, np.array([100.0, 100.0]), -float(wanted), 1, float(wanted))]
            layout = search(design, design.candidates, np.array([13.0, 13.0]), [rows], 2.0)
            self.assertEqual((bool(layout.misses), len(layout.others(1.0))), (not count, count))

    def test_others_that_are_dimmed(self):
        """Only what takes as much as dimmed, within .5%, is as good."""
        design = self.design("dimming yes", *(f"place spot {x} 2.5 2.8" for x in (1, 3, 5, 7)))
        rows = [Row(Goal("illuminance", "desk", 50, ("goals.txt", 1)), np.array([90.0, 99.7, 100.0, 99.8]), -50.0, 1, 50.0)]
        layout = search(design, design.candidates, np.full(4, 13.0), [rows], 2.0, 0.0)
        self.assertEqual(list(layout.chosen), [2], "what takes least as dimmed")
        self.assertAlmostEqual(layout.bound, 13, delta=1e-3)
        others = {int(other[0]): float(levels[0][0]) for other, levels in layout.others(4.0)}
        self.assertEqual(sorted(others), [1, 3])
        self.assertAlmostEqual(others[1], 50 / 99.7, delta=1e-3)

    def test_polishing_goes_on_while_it_gains(self):
        """Two rounds in any case, and then halved steps until a round gains nothing."""
        for gains, turns, tick in (([0, 0, 1], 2, 0), ([0, 1, 0, 1], 3, 0), ([1, 1, 1, 0, 1], 4, 0), ([1] * 5, 5, 0), ([1] * 5, 1, 15)):  # the limit is 20 s
            steps, seen = Steps.__new__(Steps), []
            steps.design, steps.given, steps.seconds = argparse.Namespace(rows=None, dims=lambda: False), argparse.Namespace(directions=64, polish=True, seconds=1, check=0), {}
            steps.candidates, steps.watts, steps.light, steps.planned_light, steps.daylight = [None] * 2, np.ones(2), None, None, [None]
            steps.layout = Layout(np.array([0]), [np.ones(1)], 0.0, [], False, None)
            steps.transfer = argparse.Namespace(matrix=lambda more, directions: None)
            steps.cost, steps.worst, steps.use = (lambda: (1.0, 1.0)), (lambda: 0.0), (lambda candidates: None)
            steps.factors_as_built, steps.plan_as_built = (lambda s, f: {}), (lambda folder: None)
            steps.searched = lambda *_: Layout(np.array([0]), [np.ones(1)], 0.0, [], False, None)
            left = iter(gains)
            steps.better = lambda *_: bool(next(left))  # noqa: B023

            def beside(design, candidates, chosen, room, turn):
                seen.append(turn)  # noqa: B023
                return [None], np.zeros((1, 2))

            patches = dict(neighbours=beside, spaces=lambda *_: np.zeros((2, 2)), light_of=lambda *_: None, joined=lambda *_: None)
            with unittest.mock.patch.multiple("rsphere.layout.steps", **patches), contextlib.redirect_stdout(io.StringIO()) as said:
                steps.timed = lambda name, function: steps.seconds.setdefault(name, 0.0) or function()  # noqa: B023
                with unittest.mock.patch("rsphere.layout.steps.time.monotonic", lambda clock=itertools.count(0, tick): next(clock)):
                    steps.polish("")
            self.assertEqual(seen, list(range(turns)), gains)
            self.assertEqual("no round begins after 20 s, 20 times -s" in said.getvalue(), tick > 0)

    def test_fewer_watts_where_goals_are_missed(self):
        """What was found when the time was out hung all luminaires, since only what goals miss counted."""
        design = self.design(*(f"place spot {x} 2.5 2.8" for x in (1, 3, 5, 7)))
        goal, other = (Goal("illuminance", name, 300, ("goals.txt", 1)) for name in ("desk", "floor"))
        # The last two luminaires give the desk nothing, and the limit on the floor is missed by what hangs.
        rows = [Row(goal, np.array([100.0, 90.0, 0.0, 0.0]), -300.0, 1, 300.0), Row(other, np.array([1.0, 1.0, 0.0, 0.0]), 0.0, -1, 1.0)]
        solver = Solver(design, design.candidates, np.full(4, 13.0), [rows], True, 1e-9)
        found = solver.program.solve(5, 0.0, solver.x, np.ones(4))
        less = solver.with_fewer_watts(found, 0.5)
        self.assertEqual([round(v) for v in found.x[solver.x]], [1, 1, 1, 1])
        self.assertEqual([round(v) for v in less.x[solver.x]], [1, 1, 0, 0])
        for (_, _, v), most in zip(solver.slacks, solver.slack):
            self.assertLessEqual(less.x[v], most + 1e-9)

    def test_what_would_help(self):
        """A search that was too short said that goals are missed, and nothing else."""
        steps, goal = Steps.__new__(Steps), Goal("illuminance", "desk", 500, ("goals.txt", 1))
        steps.layout = Layout(np.array([0]), [np.ones(1)], 0.0, [], False, None)
        for judge, planned, found, words in (("", 490, 300, "1 of 1 goals are not met.*More seconds for the search"), ("", 510, 480, "goals that ask for 6% more"),
                                             ("mine.txt", 510, 300, r"not met[^M]*\Z"), ("", 510, 500, r"goals are met[^M]*\Z")):
            steps.given, steps.rows = argparse.Namespace(judge=judge), [(None, goal, Answer(goal, planned, 1), Answer(goal, found, 1))]
            self.assertRegex(steps.verdict(), words)

    def run_on(self, lines, *options):
        room, goals = self.file(ROOM + DESK, "room.rad"), self.file("\n".join([SPOT, *lines]), "goals.txt")
        return run_here([built("rsphere-layout"), goals, room, "-o", os.path.join(self.folder.name, "out"), "--no-plan", "-d", "128", "-b", "1", "-c", "16", *options])

    def test_polished(self):
        """Spots that are dimmed take less beside their candidates, light traced forward agrees, and judges the layout as it was found."""
        lines = ["dimming yes", "grid spot ceiling spacing 2 2.5 drop .2", "illuminance desk 150 uniformity .3"]
        run = self.run_on(lines, "--polish", "-s", "5")
        less, watts = (float(w) for w in re.search(r"Polish: ([0-9.]+) W instead of ([0-9.]+) W", run.stdout).groups())
        self.assertLess(less, 0.9 * watts, run.stdout)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertIn("none at the candidates takes less than", run.stdout)  # it takes less
        found = re.search(r"(?m)^illuminance +desk +150 lx +[0-9]+ lx +([0-9]+) lx", run.stdout)[1]
        again = self.run_on(lines, "--judge", os.path.join(self.folder.name, "out/layout.txt"))
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        self.assertIn(f"dimmed: {less:.0f} W", again.stdout)
        self.assertAlmostEqual(float(re.search(r"(?m)^illuminance +desk +150 lx +[0-9]+ lx +([0-9]+) lx", again.stdout)[1]), float(found), delta=3)
        self.assertRegex(self.run_on([*lines, "rows"], "--polish", "-c", "0").stdout, "Polish: rows stay")

    def test_no_light(self):
        """Goals that need no luminaire have a page without plans; a sky without light is one line."""
        room, dark = self.file(ROOM + DESK, "room.rad"), self.file("void plastic black 0 0 5 0 0 0 0 0\nblack sphere far 0 0 4 0 90 0 1\n", "dark.rad")
        for lines, status, said in (([], 0, ""), (["scene morning", "daylight dark.rad"], 1, rf"goals\.txt:4: there is no light in {re.escape(dark)}, the daylight of the scene morning\n")):
            goals = self.file("\n".join([SPOT, "grid spot ceiling spacing 2 2.5 drop .2", "illuminance desk 0", *lines]), "goals.txt")
            run = run_here([built("rsphere-layout"), goals, room, "-o", os.path.join(self.folder.name, "out"), "-d", "128", "-b", "1", "-c", "16"])
            self.assertEqual(run.returncode, status, run.stderr)
            self.assertRegex(run.stderr, rf"\A(rsphere-layout: fatal - .*{said})?\Z")

    def test_judged_and_not_allowed(self):
        layout = self.file("spot 2 1.4 2 0 0 -1 0 1\n", "mine.txt")
        run = self.run_on(["grid spot ceiling spacing 2 2.5 drop .2", "illuminance desk 100"], "--judge", layout)
        self.assertIn("Not allowed: 1 spot hangs where none may", run.stdout)
        self.assertRegex(run.stdout, r"(?m)^illuminance +desk +100 lx .* yes$")
        self.assertEqual(run.returncode, 2)

    def test_layouts_of_equal_watts(self):
        """Any of the spots lights the floor enough; one of others is a file that can be judged."""
        lines = ["place spot 4 2.5 2.8", "place spot 3.6 2.5 2.8", "place spot 4.4 2.5 2.8", "illuminance floor 10"]
        run = self.run_on(lines, "-c", "0")
        self.assertRegex(run.stdout, r"Layout: 1 luminaires, 13 W; none takes less than 13 W")
        self.assertRegex(run.stdout, r"(?m)^1 luminaires, 1 of them elsewhere, take as many watts: layout2\.txt; not checked$")
        texts = set()
        for name in ("layout.txt", "layout2.txt", "layout3.txt"):
            with open(os.path.join(self.folder.name, "out", name), encoding="utf-8") as stream:
                texts.add(stream.read().splitlines()[1])
        self.assertEqual(len(texts), 3)


if __name__ == "__main__":
    unittest.main()
