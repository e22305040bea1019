"""Points of goals in rsphere.layout: margins, points inside of furniture, rows, and what is said of them.

PROGRAMS in the environment is the folder of rsphere and plan; PYTHONPATH has the folder of the package rsphere.
"""
import os
import re
import tempfile
import unittest
import unittest.mock
import xml.dom.minidom

import numpy as np

from rsphere.layout import steps
from rsphere.layout.room import Polygon, inside_margin, surface_of, vector_of
from rsphere.layout.search import even_choices
from rsphere.layout.transfer import Transfer, smoothed
from run_here import built, run_here

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/layout/cases")
L_SHAPE = np.array([[0, 0, 1], [6, 0, 1], [6, 2, 1], [2, 2, 1], [2, 6, 1], [0, 6, 1.0]])

ROOM = """void plastic white 0 0 5 .6 .6 .6 0 0
void metal steel 0 0 5 .7 .7 .7 .8 .1
white polygon floor 0 0 12 0 0 0 8 0 0 8 5 0 0 5 0
white polygon ceiling 0 0 12 0 0 3 0 5 3 8 5 3 8 0 3
white polygon south 0 0 12 0 0 0 0 0 3 8 0 3 8 0 0
white polygon north 0 0 12 0 5 0 8 5 0 8 5 3 0 5 3
white polygon west 0 0 12 0 0 0 0 5 0 0 5 3 0 0 3
white polygon east 0 0 12 8 0 0 8 0 3 8 5 3 8 5 0
"""


def box(material, name, low, high):
    """A closed box, its faces outwards."""
    (x, y, z), (a, b, c) = low, high
    faces = {"1540": (x, y, z, x, y, c, a, y, c, a, y, z), "4620": (x, y, z, x, b, z, x, b, c, x, y, c), "6457": (x, y, c, x, b, c, a, b, c, a, y, c),
             "3267": (x, b, z, a, b, z, a, b, c, x, b, c), "5137": (a, y, z, a, y, c, a, b, c, a, b, z), "2310": (x, y, z, a, y, z, a, b, z, x, b, z)}
    faces["6457"] = (x, y, c, a, y, c, a, b, c, x, b, c)
    faces["2310"] = (x, y, z, x, b, z, a, b, z, a, y, z)
    return "".join(f"{material} polygon {name}.{face} 0 0 12 {' '.join(map(str, at))}\n" for face, at in faces.items())


class Smoothing(unittest.TestCase):
    """Reflected light of cells: a plain with noise, a step that is more than noise, cells in a line, and few cells."""

    def setUp(self):
        self.random = np.random.default_rng(5)
        self.places = np.stack([*np.meshgrid(np.arange(8.0), np.arange(6.0)), np.zeros((6, 8))], axis=-1).reshape(-1, 3)

    def noisy(self, even, share):
        return even[None, :, None] * (1 + share * self.random.normal(size=(4, len(even), 3)))

    def off(self, sets, even):
        return np.sqrt(((sets.mean(axis=(0, 2)) / even - 1) ** 2).mean())

    def test_less_noise(self):
        even = 50 + self.places[:, 0] - 0.2 * self.places[:, 1] ** 2
        sets = self.noisy(even, 0.2)
        found = smoothed(sets, self.places)
        self.assertLess(self.off(found, even), 0.6 * self.off(sets, even))
        np.testing.assert_allclose(smoothed(self.noisy(even, 0), self.places).mean(axis=(0, 2)), even)
        np.testing.assert_allclose(found.mean(axis=1), sets.mean(axis=1))

    def test_steps_stay(self):
        even = np.where(self.places[:, 0] > 3, 50.0, 30.0)
        sets = self.noisy(even, 0.02)
        self.assertLess(self.off(smoothed(sets, self.places), even), 1.2 * self.off(sets, even))

    def test_lines_and_few(self):
        even = np.full(8, 40.0)
        line = np.stack([np.arange(8.0), np.zeros(8), np.full(8, 2.0)], axis=1)
        sets = self.noisy(even, 0.1)
        self.assertLess(self.off(smoothed(sets, line), even), self.off(sets, even))
        self.assertIs(smoothed(sets[:, :5], line[:5]).base, sets)


class Shapes(unittest.TestCase):
    def test_margin(self):
        """A rectangle and an L, whose bounding rectangle has the margin."""
        square = Polygon("p", "m", np.array([[1, 1, 0], [5, 1, 0], [5, 4, 0], [1, 4, 0.0]]))
        np.testing.assert_allclose(sorted(map(tuple, inside_margin(square, 1))), [(2, 2, 0), (2, 3, 0), (4, 2, 0), (4, 3, 0)])
        self.assertEqual(len(inside_margin(square, 1.6)), 0)
        self.assertIs(inside_margin(square, 0), square.corners)
        cut = inside_margin(Polygon("l", "m", L_SHAPE), 0.5)
        self.assertAlmostEqual(np.linalg.norm(vector_of(cut)), 5 * 5 - 3.5 * 3.5)
        back = inside_margin(Polygon("l", "m", L_SHAPE[::-1]), 0.5)
        self.assertLess(vector_of(back)[2], 0)

    def test_covered_points(self):
        """What is left has the area of the quarters of cells around the open points, whichever these are."""
        random = np.random.default_rng(3)
        for _ in range(5):
            surface = surface_of([Polygon("p", "m", L_SHAPE)], "p", ("goals.txt", 1), 1.0, spacing=0.5, margin=0.25)
            self.assertAlmostEqual(surface.area(), 5.5 * 5.5 - 3.75 * 3.75)
            points, quarter = len(surface.points), np.linalg.norm(surface.cells[0, 1] - surface.cells[0, 0]) ** 2 / 4
            covered = random.random(points) < 0.4
            surface.leave_out(covered)
            self.assertEqual((len(surface.points), len(surface.covered)), ((~covered).sum(), covered.sum()))
            self.assertAlmostEqual(surface.area(), (~covered).sum() * quarter)
            self.assertLess(len(surface.outlines), (~covered).sum(), "strips")
            for corners, normal in surface.outlines:
                np.testing.assert_allclose(vector_of(corners) / np.linalg.norm(vector_of(corners)), normal, atol=1e-9)

    def test_even_rows(self):
        self.assertEqual(even_choices([0, 1, 3]), [{0}, {1}, {2}, {0, 1}, {0, 2}, {1, 2}])
        self.assertIn({0, 2, 4}, even_choices([0, .8, 1.6, 2.4, 3.2]))
        self.assertNotIn({0, 1, 3}, even_choices([0, .8, 1.6, 2.4, 3.2]))


class Layouts(unittest.TestCase):
    def run_on(self, lines, furniture, *options):
        with tempfile.TemporaryDirectory() as folder:
            goals, room, out = (os.path.join(folder, name) for name in ("goals.txt", "room.rad", "out"))
            lines = [f"luminaire panel {os.path.join(CASES, 'panel.ies')}", *lines]
            for path, text in (goals, "\n".join(lines)), (room, ROOM + furniture):
                with open(path, "w", encoding="ascii") as stream:
                    stream.write(text + "\n")
            run = run_here([built("rsphere-layout"), "-o", out, "--no-plan", *options, goals, room])
            self.assertEqual(run.stderr, "")
            with open(os.path.join(out, "page.html"), encoding="utf-8") as stream:
                page = stream.read()
        figure = xml.dom.minidom.parseString(page[page.find("<svg") : page.find("</svg>") + 6])
        return run, page, figure

    def values(self, run):
        """By kind of goal: planned and found."""
        rows = [line.replace(" lx", "").split() for line in run.stdout.splitlines() if re.match("illuminance|uniformity", line)]
        return {row[0]: (float(row[3]), float(row[4])) for row in rows}

    def test_margin_beside_mirrors(self):
        """Light that went straight to the margin counted as if mirrors brought it: 5% too much."""
        lines = ["grid panel ceiling spacing 2 margin 1", "illuminance floor 300 margin 1"]
        run, _, _ = self.run_on(lines, box("steel", "beam", (1, 2.4, 2.2), (7, 2.5, 2.4)), "-c", "32", "-d", "512", "-b", "2")
        planned, found = self.values(run)["illuminance"]
        self.assertAlmostEqual(planned / found, 1, delta=0.012)

    def test_polished_steel(self):
        """The plan had the lamp that walls see in a sheet of steel, and the check had not: 17% above found."""
        steel = "void metal polished 0 0 5 .8 .8 .8 .95 0\npolished polygon sheet 0 0 12 2.4 1 .2 5.6 1 .2 5.6 4 .2 2.4 4 .2\n"
        lines = ["place panel 4 2.5 2.9", "illuminance floor 10 margin .3"]
        run, _, _ = self.run_on(lines, steel, "-c", "128", "-d", "1024", "-b", "3")
        planned, found = self.values(run)["illuminance"]
        self.assertAlmostEqual(planned / found, 1, delta=0.02, msg=run.stdout)

    def test_daylight_where_points_are_left_out(self):
        """It was computed at all points, and did not fit the light of luminaires."""
        lines = ["grid panel ceiling spacing 4 5", "scene day", f"daylight {os.path.join(CASES, 'sky.rad')}", "illuminance floor 20 uniformity .1"]
        run, _, _ = self.run_on(lines, box("white", "chest", (1, 1, 0), (3, 3, 0.5)), "-c", "1", "-d", "64", "-b", "0")
        self.assertIn("points are left out", run.stdout)
        self.assertRegex(run.stdout, r"(?m)^day +illuminance +floor +20 lx .* yes$")

    def test_luminaires_aimed_aside(self):
        """Under the ceiling, half of them was above it, and planned was a fifth above found."""
        lines = [f"luminaire spot {os.path.join(CASES, 'downlight.ies')}", "grid spot ceiling spacing 4 5 aim 1 0 -1", "illuminance floor 8"]
        run, _, _ = self.run_on(lines, "", "-c", "32", "-d", "128", "-b", "0")
        planned, found = self.values(run)["illuminance"]
        self.assertAlmostEqual(planned / found, 1, delta=0.05)

    def test_goals_keep_their_patterns(self):
        """A goal with a pattern reflected as if it had none, light to other goals as well."""
        picture = "void colorfunc dark\n4 .2 .2 .2 .\n0\n0\ndark plastic canvas 0 0 5 1 1 1 0 0\n"
        picture += "canvas polygon picture 0 0 12 .05 .5 .5 .05 4.5 .5 .05 4.5 2.8 .05 .5 2.8\n"
        lines = ["place panel 1.2 2.5 1.7 aim -1 0 0", "illuminance picture 10", "illuminance floor 5"]
        run, _, _ = self.run_on(lines, picture, "-c", "64", "-d", "512", "-b", "1")
        rows = [line.replace(" lx", "").split() for line in run.stdout.splitlines() if line.startswith("illuminance")]
        self.assertEqual([row[1] for row in rows], ["picture", "floor"], run.stdout)
        for row in rows:
            self.assertAlmostEqual(float(row[3]) / float(row[4]), 1, delta=0.05, msg=run.stdout)

    def test_floor_under_furniture(self):
        """A chest covers a fifth of the floor, and not whole cells: its points took part in means and uniformity."""
        chest = box("white", "chest", (5.9, .001, 0), (7.999, 4.999, .5))
        lines = ["place panel 2 2.5 2.9", "place panel 4.5 2.5 2.9", "illuminance floor 100 uniformity .01"]
        run, page, figure = self.run_on(lines, chest, "-c", "64", "-d", "512", "-b", "2")
        mean, evenness = self.values(run).values()
        self.assertAlmostEqual(mean[0] / mean[1], 1, delta=0.02, msg=run.stdout)
        self.assertAlmostEqual(evenness[0], evenness[1], delta=0.03, msg=run.stdout)
        self.assertGreater(evenness[1], 0.15, run.stdout)
        text = re.search(r"^floor: ([0-9]+) of ([0-9]+) points are left out, .* under chest \(\1\)\.$", run.stdout, re.MULTILINE)
        self.assertAlmostEqual(int(text[1]) / int(text[2]), 2.1 / 8, delta=0.04)
        self.assertRegex(run.stdout, r"(?m)^floor is darkest at [0-9.]+ [0-9.]+: [0-9]+% of the mean\.$")
        words = [node.firstChild.data for node in figure.getElementsByTagName("text")]
        self.assertIn("chest", words)
        self.assertTrue(any("rings: where goals are darkest" in w for w in words))
        self.assertIn(text[0][:-1].split(";")[0], page)

    def test_concave_goal(self):
        """What walls reflect to an L-shaped stage was missing, a fifth of its light."""
        stage = "white polygon stage 0 0 18 .1 .1 .3 7.9 .1 .3 7.9 1.5 .3 2 1.5 .3 2 4.9 .3 .1 4.9 .3\n"
        run, _, _ = self.run_on(["place panel 5 3.5 2.9", "illuminance stage 20"], stage, "-c", "32", "-d", "512", "-b", "2")
        planned, found = re.search(r"(?m)^illuminance +stage +20 lx +([0-9.]+) lx +([0-9.]+) lx", run.stdout).groups()
        self.assertAlmostEqual(float(planned) / float(found), 1, delta=0.03, msg=run.stdout)

    def test_more_directions_where_noisy(self):
        """Of two uniform surfaces the cells of the noisy one alone have further directions: less noise, and the same light."""
        shelf = "white polygon shelf 0 0 12 5 1 1 7 1 1 7 2 1 5 2 1\n"
        lines = ["place panel 2 2.5 2.9", "illuminance floor 5 uniformity .01", "illuminance shelf 5 uniformity .01"]
        asked, original = [], Transfer.with_more_directions

        def watched(transfer, lamps, directions, more, receivers):
            before = transfer.importance.copy()
            found = original(transfer, lamps, directions, more, receivers)
            asked.append((list(receivers), more / directions, list(found), transfer.cells, before, transfer.importance))
            return found

        with unittest.mock.patch.object(Transfer, "with_more_directions", watched), \
                unittest.mock.patch.object(steps.Steps, "noise", lambda self, transfer: {0: 0.001, 1: 0.05}):
            self.run_on(lines, shelf, "-c", "0", "-d", "2048", "-b", "2")
        [(receivers, times, found, cells, before, after)] = asked
        self.assertEqual((receivers, times, found), ([1], 7, [1]))
        there = cells[1][0]
        others = np.setdiff1d(np.arange(before.shape[1]), there)
        np.testing.assert_array_equal(before[:, others], after[:, others])
        self.assertAlmostEqual(after[:, there].sum() / before[:, there].sum(), 1, delta=0.05)
        noise = [np.sqrt(values[:, there].var(axis=0, ddof=1).mean()) for values in (before, after)]
        self.assertLess(noise[1], 0.7 * noise[0])

    def test_floor_in_a_glass_box(self):
        """What the panes of a box reflect to the floor inside of it was missing in the plan: a tenth of the reflected light."""
        glass = "void glass clear 0 0 3 .94 .94 .94\n" + box("clear", "box", (4.5, .5, 0), (7.5, 4.5, 2.4))
        glass = "\n".join(line for line in glass.split("\n") if " box.2310 " not in line)
        lines = ["place panel 1.5 2.5 2.9", "illuminance floor 10 uniformity .01"]
        run, _, _ = self.run_on(lines, glass, "-c", "128", "-d", "2048")
        planned, found = self.values(run)["illuminance"]
        self.assertAlmostEqual(planned / found, 1, delta=0.03, msg=run.stdout)
        deviation = float(re.search(r"(?m)^uniformity .* (\S+)  yes$", run.stdout)[1])
        self.assertAlmostEqual(deviation, 0, delta=0.008, msg=f"of .11, by light in the box that panes reflect: {run.stdout}")  # it was .020

    def test_watts_of_dimmed_luminaires(self):
        """The terminal had the watts of the luminaires, and the page those of the scene, without a word."""
        lines = ["place panel 4 2.5 2.9", "dimming yes", "illuminance floor 20"]
        run, page, _ = self.run_on(lines, "", "-c", "16", "-d", "128", "-b", "1")
        all_watts, dimmed = re.search(r"Layout: 1 luminaires, ([0-9]+) W.*; dimmed: ([0-9]+) W", run.stdout).groups()
        self.assertLess(int(dimmed), int(all_watts))
        self.assertIn(f"1 luminaires, {all_watts} W, {dimmed} W as dimmed", page)

    def test_what_would_meet_a_goal(self):
        """Too few places, and two goals against each other."""
        run, page, _ = self.run_on(["place panel 4 2.5 2.9", "illuminance floor 200"], "", "-c", "0", "-d", "64", "-b", "0", "-s", "2")
        best = re.search(r"Cannot be met: illuminance floor: 200 lx is wanted, ([0-9]+) lx is the nearest to all goals; "
                         r"all that can hang here gives \1 lx: ([0-9.]+) times the light of the luminaires", run.stdout)
        self.assertAlmostEqual(float(best[2]), 200 / int(best[1]), delta=0.02)
        self.assertIn(best[0], page)
        lines = ["place panel 4 2.5 2.9", "illuminance floor 30", "illuminance ceiling 1", "illuminance south 1 most 3"]
        run, _, _ = self.run_on(lines, "", "-c", "0", "-d", "64", "-b", "1", "-s", "2")
        self.assertRegex(run.stdout, "Cannot be met: illuminance floor: .* alone it could have [0-9]+ lx: the other goals")

    def test_limits_that_would_do(self):
        """Nothing was said of uniformity and of glare. What is said to do, does; a little more does not."""
        eye, options = "eye me 1.5 2.5 1.2 1 0 0", ("-c", "0", "-d", "64", "-b", "1", "-s", "2")
        places = [f"place panel {x} 2.5 2.9" for x in (2, 4, 6)]
        for lines, change, asked, more in (
            ([eye, "illuminance floor 120", "ugr me 10"], "ugr me {:g}", "illuminance floor: 120 lx .* alone it could have [0-9]+ lx: the other goals or their "
             "limits stand against it; with ugr me of ([0-9.]+) it could be met, all others kept", -0.5),
            (["illuminance floor 50 uniformity .9"], "illuminance floor 50 uniformity {:g}", r"uniformity floor: 0\.90 is wanted, [^;]*; ([0-9.]+) would do, all", 0.05),
        ):
            run, page, _ = self.run_on([*places, *lines], "", *options)
            said = re.search(f"Cannot be met: {asked}", run.stdout)
            self.assertTrue(said, run.stdout)
            self.assertIn(said[0], page)
            for value, missed in ((float(said[1]), False), (float(said[1]) + more, True)):
                run, _, _ = self.run_on([*places, *lines[:-1], change.format(value)], "", *options)
                self.assertEqual("Cannot be met" in run.stdout, missed, f"{change.format(value)}: {run.stdout}")

    def test_rows_are_even(self):
        lines = ["grid panel ceiling spacing 1 margin .5", "rows", "most 9", "illuminance floor 300 uniformity .3"]
        run, page, _ = self.run_on(lines, "", "-c", "0", "-d", "64", "-b", "0", "-s", "1")
        watts = float(re.search(r"Layout: [0-9]+ luminaires, ([0-9.]+) W", run.stdout)[1])
        lines[1] = "rows uneven"
        uneven, _, _ = self.run_on(lines, "", "-c", "0", "-d", "64", "-b", "0", "-s", "1")
        self.assertLessEqual(float(re.search(r"Layout: [0-9]+ luminaires, ([0-9.]+) W", uneven.stdout)[1]), watts)
        cells = re.findall(r'<tr><td class="words">[0-9]+</td><td class="words">panel</td><td class="">([0-9.]+)</td><td class="">([0-9.]+)</td>', page)
        places = np.array(cells, dtype=float)
        self.assertGreater(len(places), 3, run.stdout)
        for values in places.T:
            self.assertLessEqual(len(np.unique(np.round(np.diff(np.unique(values)), 6))), 1, places)


if __name__ == "__main__":
    unittest.main()
