"""rsphere.annual.outside: hours of sun and the view out, by EN 17037, against closed forms."""
import os
import subprocess
import unittest
import unittest.mock

import numpy as np

import rsphere
from rsphere.annual.outside import ALTITUDES, MINUTE, View, day_of, seen_along, sun_of_day, sunlight, sunlight_verdicts, windows_of
from rsphere.annual.sun import sun_position
from rsphere.fault import Fault
from rsphere.layout.room import read_polygons
from run_here import InAFolder, built

PLACE = [52.5, 13.4, 15.0]
GLASS = "void glass pane 0 0 3 .9 .9 .9\n"
GREY = "void plastic grey 0 0 5 .5 .5 .5 0 0\n"
WINDOW = GLASS + "pane polygon glazing 0 0 12 1 0 1 1 0 2 3 0 2 3 0 1\n"  # in the plane y = 0, 2 x 1 m


def wall(name, *corners, material="grey"):
    return f"{material} polygon {name} 0 0 {3 * len(corners)} {' '.join(f'{v:g}' for c in corners for v in c)}\n"


ROOM = GREY + WINDOW + "".join(wall(*w) for w in (  # 4 x 6 x 3 m, the window to the south
    ("floor", (0, 0, 0), (4, 0, 0), (4, 6, 0), (0, 6, 0)), ("top", (0, 0, 3), (0, 6, 3), (4, 6, 3), (4, 0, 3)),
    ("north", (0, 6, 0), (4, 6, 0), (4, 6, 3), (0, 6, 3)), ("west", (0, 0, 0), (0, 6, 0), (0, 6, 3), (0, 0, 3)),
    ("east", (4, 0, 0), (4, 0, 3), (4, 6, 3), (4, 6, 0)), ("sill", (0, 0, 0), (0, 0, 1), (4, 0, 1), (4, 0, 0)),
    ("lintel", (0, 0, 2), (0, 0, 3), (4, 0, 3), (4, 0, 2)), ("left", (0, 0, 1), (0, 0, 2), (1, 0, 2), (1, 0, 1)),
    ("right", (3, 0, 1), (3, 0, 2), (4, 0, 2), (4, 0, 1))))
INSIDE = np.array([[2.0, 3, 0.85]])


class Outside(InAFolder):
    def scene(self, text):
        self.path = self.file(text, "room.rad")
        return rsphere.Scene(self.path)

    def windows(self, text, word="pane", floor=0.0):
        self.scene(text)
        return windows_of(word, read_polygons([self.path]), INSIDE, floor)

    def test_straight_through_panes(self):
        """Two panes and a mirror behind them: its name and the length to it, not what it mirrors."""
        text = GLASS + "void mirror m 0 0 3 .9 .9 .9\n" + "".join(wall(n, (-9, y, -9), (9, y, -9), (9, y, 9), (-9, y, 9), material=m)
                                                                   for n, m, y in (("a", "pane", 1), ("b", "pane", 2), ("c", "m", 5)))
        names, length, first = seen_along(self.scene(text), [[0, 0, 0, 0, 1, 0], [0, 0, 0, 0, -1, 0], [0, 4, 0, 0, -0.6, 0.8]])
        self.assertEqual([list(n) for n in names], [["m", "*", "*"], ["c", "*", "*"]])
        np.testing.assert_allclose(length, [5, np.inf, np.inf])
        np.testing.assert_allclose(first, [1, 0, 2 / 0.6])

    def test_reference_points(self):
        """In the middle of the width, 1.2 m above the floor and .3 m above the sill, whichever is higher."""
        for sill, top, floor, height in ((1, 2, 0, 1.3), (0.2, 2, 0, 1.2), (0.2, 2, -0.5, 0.7), (0.1, 1.1, 0, 0.6)):
            found, = self.windows(WINDOW.replace(" 1 3", f" {sill} 3").replace("0 1\n", f"0 {sill}\n").replace("1 0 1 1", f"1 0 {sill} 1")
                                  .replace(" 2", f" {top}"), floor=floor)
            np.testing.assert_allclose(found.point, [2, 0, height], err_msg=f"{sill} {top} {floor}")
            np.testing.assert_allclose(found.outwards, [0, -1, 0])
        sloped, = self.windows(GLASS + wall("w", (1, 0, 1), (3, 0, 1), (3, 1, 2), (1, 1, 2), material="pane"))
        np.testing.assert_allclose(sloped.point, [2, 0.3, 1.3], atol=1e-12)
        roof, = self.windows(GLASS + wall("w", (1, 1, 3), (3, 1, 3), (3, 2, 3), (1, 2, 3), material="pane"))
        np.testing.assert_allclose([roof.point, roof.outwards], [[2, 1.5, 3], [0, 0, 1]])

    def test_sun_to_the_minute(self):
        """A wall of 10 m in the south, 10 m away and 6 m wide, hides the sun below its edge; the sun counts from 11 degrees up."""
        text = ROOM + wall("opposite", (-1, -10, 0), (-1, -10, 10), (5, -10, 10), (5, -10, 0))
        windows = self.windows(text)
        for day in ((2, 1), (3, 21)):
            wanted = []
            for minute in range(24 * 60):
                altitude, azimuth = sun_position(*day, (minute + 0.5) / 60, *PLACE)
                if altitude > np.radians(11):
                    east, north, up = np.sin(azimuth), np.cos(azimuth), np.tan(altitude)
                    hidden = north < 0 and abs(10 * east / north) < 3 and 1.3 + 10 * up / -north < 10
                    wanted.append(north < 0 and not hidden)
            lit = sunlight(self.scene(text), windows, day, PLACE, 11)[0]
            self.assertEqual(len(lit), len(wanted))
            self.assertEqual(list(lit), wanted)
            self.assertGreater(sum(wanted), 60)
            self.assertLess(sum(wanted), len(wanted) - 60)

    def test_sun_of_several_windows(self):
        """Hours of any of them; a window to the north has none."""
        text = GLASS + "".join(wall(*w, material="pane") for w in (("western", (0, 1, 1), (0, 3, 1), (0, 3, 2), (0, 1, 2)),
               ("eastern", (4, 1, 1), (4, 3, 1), (4, 3, 2), (4, 1, 2)), ("northern", (1, 6, 1), (3, 6, 1), (3, 6, 2), (1, 6, 2))))
        scene, windows = self.scene(text), self.windows(text)
        self.assertEqual([w.name for w in windows], ["western", "eastern", "northern"])
        lit = sunlight(scene, windows, (3, 21), PLACE, 11)
        self.assertFalse(lit[2].any())
        verdicts, rows = sunlight_verdicts(scene, windows, (3, 21), PLACE, 11, ())
        self.assertAlmostEqual(verdicts[0].value, lit.any(axis=0).sum() / 60)
        self.assertEqual(lit.any(axis=0).sum(), lit.sum())
        self.assertGreater(lit.sum(axis=1)[:2].min(), 200)
        self.assertEqual(rows[0][2:], ["h on 21 March", "h on 1 February"])
        self.assertEqual(rows[1][:3], ["western", "0 2 1.3", f"{lit[0].sum() / 60:.2f}"])

    def test_sunlight_at_its_limits(self):
        """1.5, 3 and 4 h, to the minute: a window through which the sun comes from one hour angle on."""
        for minutes, met in ((89, 0), (90, 1), (179, 1), (180, 2), (239, 2), (240, 3)):
            with unittest.mock.patch("rsphere.annual.outside.sunlight", lambda *_, n=minutes: np.arange(600)[None] < n):
                verdicts, _ = sunlight_verdicts(None, windows_of_points([[0, 0, 0]]), (2, 14), PLACE, 11, ())
                self.assertEqual([v.met() for v in verdicts], [True] * met + [False] * (3 - met), minutes)

    def test_days(self):
        self.assertEqual([day_of(w) for w in ("2-1", "2-28", "3-21")], [(2, 1), (2, 28), (3, 21)])
        for word, said in (("1-31", "the month must be from 2"), ("3-22", "the day must be from 1 to 21"), ("2-29", "from 1 to 28"), ("3", "the day must be a number")):
            with self.assertRaisesRegex(Fault, said):
                day_of(word)
        self.assertGreater(sun_of_day((2, 1), PLACE, 11)[:, 2].min(), np.sin(np.radians(11)))
        self.assertEqual(len(sun_of_day((2, 1), PLACE, 45)), 0, "never that high")
        self.assertEqual(MINUTE, 1 / 60)

    def test_points_of_a_file(self):
        text = ROOM
        points = self.file("2 -1 1.3\n\n2 3 1.3\n", "points.txt")
        windows = self.windows(text, points)
        self.assertEqual([w.point[1] for w in windows], [-1, 3])
        lit = sunlight(self.scene(text), windows, (3, 21), PLACE, 11)
        self.assertTrue(lit[0].all(), "free to all sides but the room's north")
        self.assertLess(lit[1].sum(), lit[0].sum() / 2, "inside of the room, through its window")
        for data, said in (("1 2\n", "points.txt:1: a point in a window is x y z, not 2 words"), ("1 2 x", "points.txt:1: z must be a number"), ("\n", "has no points")):
            with self.assertRaisesRegex(Fault, said):
                self.windows(text, self.file(data, "points.txt"))
        with self.assertRaisesRegex(Fault, "--sunlight pain: is neither a modifier or polygon of the scene, which has grey, pane, nor a file"):
            self.windows(text, "pain")

    def test_angle_and_solid_angles_of_a_view(self):
        """Through the window alone: the angle in plan, and sky and ground by the solid angles of the window above and below the eye."""
        for y, z in ((1, 1.2), (3, 1.2), (5, 1.5), (3, 0.5)):
            view = View(self.scene(ROOM), np.array([[2.0, y, z]]), ["landscape"], ["ground"])
            self.assertAlmostEqual(view.angle[0], np.degrees(2 * np.arctan(1 / y)), delta=1.01)

            def rectangle(h, y=y):  # from the foot of the normal up to h, 1 m to either side: twice the solid angle of 1 x h at distance y
                return 2 * np.arctan(h / (y * np.sqrt(1 + h * h + y * y)))
            wanted = [rectangle(2 - z) - rectangle(max(0, 1 - z)), 0, rectangle(max(0, z - 1))]
            np.testing.assert_allclose(view.solid_angles[0], wanted, atol=0.03 * sum(wanted), err_msg=f"{y} {z}")
            self.assertEqual(view.distance[0], np.inf)

    def test_layers_and_distance(self):
        """A building opposite: landscape, as far as it stands from the pane; the ground before it, and the sky above it if it is low."""
        def view(high, far, y=3.0):
            opposite = wall("opposite", (-99, -far, -1), (-99, -far, high), (99, -far, high), (99, -far, -1), material="brick")
            ground = wall("lawn", (-99, -99, -1), (99, -99, -1), (99, 0, -1), (-99, 0, -1), material="grass")
            text = ROOM + GREY.replace("grey", "brick") + GREY.replace("grey", "grass") + opposite + ground
            return View(self.scene(text), np.array([[2.0, y, 1.5]]), ["brick"], ["lawn"])

        for high, far, layers in ((3, 20, [1, 1, 1]), (20, 20, [0, 1, 1]), (3, 7, [1, 1, 0]), (20, 5.9, [0, 1, 0]), (2, 50, [1, 1, 1])):
            found = view(high, far)
            self.assertEqual(list((found.solid_angles[0] > 0).astype(int)), layers, f"{high} {far}")
            self.assertAlmostEqual(found.distance[0], far, delta=0.04 * far)
        met = lambda v: [x.met() for x in v.verdicts(np.ones(1))]  # noqa: E731
        self.assertEqual(met(view(3, 20.2)), [True, True, False])
        self.assertEqual(met(view(3, 55, 1.0)), [True, True, True])
        self.assertEqual(met(view(3, 55, 3.0)), [True, True, False], "37 degrees")
        self.assertEqual(met(view(20, 22)), [True, True, False], "two layers")
        self.assertEqual(met(view(20, 9)), [True, False, False])
        self.assertEqual(met(view(20, 5)), [False, False, False])

    def test_share_of_the_area(self):
        """Three quarters of the area."""
        view = View(self.scene(ROOM), np.zeros((0, 3)), [], [])
        view.angle, view.distance = np.array([60.0, 60, 60, 10]), np.full(4, 99.0)
        view.solid_angles = np.ones((4, 3))
        self.assertEqual([v.met() for v in view.verdicts(np.full(4, 0.25))], [True] * 3)
        self.assertEqual([v.met() for v in view.verdicts(np.array([0.3, 0.2, 0.2, 0.3]))], [False] * 3)
        self.assertEqual(ALTITUDES, 24)
        for level, (angle, distance, layers) in enumerate(((14, 6, 1), (28, 20, 2), (54, 50, 3))):  # at and beside the limits of each level
            for a, d, n, met in ((angle, distance, layers, True), (angle - 0.1, distance, layers, False), (angle, distance - 0.1, layers, False), (99, 99, layers - 1, False)):
                view.angle, view.distance, view.solid_angles = np.full(4, a), np.full(4, d), np.tile([n > 1, n > 0, n > 2], (4, 1)).astype(float)
                self.assertEqual(list(view.verdicts(np.full(4, 0.25)))[level].met(), met, (level, a, d, n))

    def test_command(self):
        with open(os.path.join(self.folder.name, "w.wea"), "w", encoding="ascii") as stream:
            stream.write("place X\nlatitude 52.5\nlongitude -13.4\ntime_zone -15\nsite_elevation 0\nweather_data_file_units 1\n")
            stream.writelines(f"6 21 {h + 0.5} {300 * (5 < h < 19)} {150 * (5 < h < 19)}\n" for h in range(24))
        room = os.path.basename(self.file(ROOM, "room.rad"))
        command = [built("rsphere-annual"), "--weather", "w.wea", "-d", "16", "-e", "2", "--spacing", "2", "--sunlight", "pane", "--view", "1.5"]
        run = subprocess.run([*command, "--day", "2-14", room], cwd=self.folder.name, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("No surface is landscape (--landscape NAME): no view is met.", run.stdout)
        self.assertRegex(run.stdout, r"sun of 11 degrees or higher at the windows on 14 February +1\.5 h: minimum +6\.[0-9] h +0\.0 +yes")
        self.assertRegex(run.stdout, r"view, minimum: 14 degrees, 6 m, landscape +75% of the area +0\.0%")
        self.assertRegex(run.stdout, r"window\tpoint\th on 14 February\th on 1 February\th on 21 March\nglazing\t2 0 1\.3\t6\.[0-9]+\t")
        self.assertIn("view.svg", os.listdir(os.path.join(self.folder.name, "annual")))
        for words, said in ((["--day", "4-1"], "--day 4-1: the month must be from 2 to 3"), (["--sunlight", "none"], "--sunlight none: is neither"),
                            (["--view", "-1"], "--view must be from 0 to 100"), (["--sun-altitude", "50"], "--sun-altitude must be from 0 to 45")):
            run = subprocess.run([*command, *words, room], cwd=self.folder.name, capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, run.stdout, run.stderr.count("fatal")), (1, "", 1), run.stderr)
            self.assertIn(said, run.stderr)


def windows_of_points(points):
    from rsphere.annual.outside import Window
    return [Window("w", np.array(p), np.zeros(3)) for p in points]


if __name__ == "__main__":
    unittest.main()
