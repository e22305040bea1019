"""Reports of rooms by rsphere-layout --report: closed forms, the worst UGR, verdicts, and faults in one line.

PROGRAMS in the environment is the folder of rsphere and plan; PYTHONPATH has the folder of the package rsphere.
"""
import argparse
import os
import re
import unittest
import unittest.mock
import warnings
import xml.dom.minidom

import numpy as np

import rsphere
from rsphere.fault import Fault
from rsphere.layout.dimming import dimmed
from rsphere.layout.forward import BEYOND
from rsphere.layout.limits import ACTIVITIES, activities_named
from rsphere.layout.report import GAZES, Report, Row
from rsphere.layout.room import distance
from rsphere.layout.tasks import Lamps
from run_here import InAFolder, built, run_here
from test_layout_points import L_SHAPE, ROOM, box

BLACK = ROOM.replace("5 .6 .6 .6 0 0", "5 0 0 0 0 0")
CANDELA = 1000.0  # straight down, of the lamp of 1 dm2, which is Lambertian
AT = np.array([4, 2.5, 2.9])


def lamp(name="tube", at=AT, candela=CANDELA):
    x, y, z = at
    radiance = candela / rsphere.LUMENS_PER_WATT / 0.01
    corners = " ".join(f"{x + a:.9g} {y + b:.9g} {z:.9g}" for a, b in ((-.05, -.05), (-.05, .05), (.05, .05), (.05, -.05)))
    return f"void light {name}\n0\n0\n3 {radiance:.9g} {radiance:.9g} {radiance:.9g}\n{name} polygon {name}.1 0 0 12 {corners}\n"


class Reports(InAFolder):
    def report(self, lines, room, **options):
        goals, scene = self.file("\n".join(lines), "tasks.txt"), self.file(room, "room.rad")
        given = dict(goals=goals, room=[scene], output=self.folder.name, title="", bounces=1, accuracy=0.05, no_plan=True)
        report = Report(rsphere, argparse.Namespace(**{**given, **options}))
        few = unittest.mock.patch.multiple("rsphere.layout.report", COARSE=64, FINE=128, LAST=128, AROUND=128)
        with open(os.devnull, "w", encoding="ascii") as silence, unittest.mock.patch("sys.stdout", silence), few, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # rooms of tests have black backgrounds
            report.run()
        return report

    def row(self, report, of, what):
        return next(r for r in report.rows if (r.of, r.what) == (of, what))

    def test_closed_form(self):
        """A lamp in a black room, dimmed to a half, with a maintenance factor: inverse squares and cosines."""
        lines = ["maintenance .8", "luminaire tube watts 40 factor .5", "task floor 34.2 margin .5 height .7", "eyes height 1.6 spacing 1",
                 "walls north", "ceiling ceiling"]
        report = self.report(lines, BLACK + lamp())
        points = report.tasks.tasks[0].surface.cells.mean(axis=1)
        self.assertEqual(len(points), 9 * 6)  # of 7 x 4 m, at most .2 * 5^log10(7) m apart
        to = AT - points
        square = (to**2).sum(axis=1)
        lux = 0.4 * CANDELA * to[:, 2] ** 2 / square**2
        mean, uniformity = self.row(report, "floor", "E_m"), self.row(report, "floor", "U_o")
        self.assertAlmostEqual(mean.value / lux.mean(), 1, delta=0.003 + 3 * mean.error / lux.mean())
        self.assertAlmostEqual(uniformity.value, lux.min() / lux.mean(), delta=0.01)
        to = AT - np.array([p for _, p in report.places])
        self.assertEqual(len(to), 7 * 4)
        square = (to**2).sum(axis=1)
        cylindrical = 0.4 * CANDELA * to[:, 2] * np.hypot(*to[:, :2].T) / square**2 / np.pi
        self.assertAlmostEqual(self.row(report, "eyes, 1.6 m", "E_m,z").value / cylindrical.mean(), 1, delta=0.02)
        self.assertEqual(self.row(report, "ceiling", "E_m").value, 0)
        self.assertEqual(self.row(report, "walls", "E_m").verdict(), "not met")
        self.assertAlmostEqual(self.row(report, "power", "W/m2").value, 40 * 0.5 / 40)
        self.assertAlmostEqual(self.row(report, "power", "W/m2/100 lx").value, 50 / mean.value)
        self.assertFalse(report.met())

    def test_worst_glare(self):
        """It is that of rsphere -Su at all places and in all eight directions, and the luminaire is named."""
        room = ROOM + lamp("one", (1.5, 1, 2.5), 300) + lamp("two", (6, 3, 2.2), 400)
        report = self.report(["maintenance .5", "task floor 34.2", "eyes spacing 4", "eye me 2 2 1.2"], room)
        places = np.array([p for _, p in report.places])
        self.assertEqual(len(places), 2 * 1 + 1)
        found = rsphere.Scene(os.path.join(self.folder.name, "room.rad")).glare(
            np.repeat(places, 8, axis=0), np.tile(GAZES, (len(places), 1)), directions=128, Sub=BEYOND).ugr
        row = self.row(report, "glare", "worst UGR")
        self.assertAlmostEqual(row.value, found.max() + 8 * np.log10(0.5), delta=0.2)
        self.assertGreater(found.max() - np.sort(found)[-9], 1, "of another place")
        self.assertRegex(row.where, r"at [-0-9. ]+ looking to [-0-9. ]+; [0-9]+% by two\.1 \(two\)")

    def test_worst_glare_beside_a_mirror(self):
        """Its light is in the background, and an image in it is no luminaire, as by rsphere -Su."""
        mirror = "void mirror silver 0 0 3 .9 .9 .9\nsilver polygon mirror 0 0 12 7.99 .5 .2 7.99 .5 2.8 7.99 4.5 2.8 7.99 4.5 .2\n"
        room = ROOM + lamp("one", (6, 2.5, 2.2), 400) + mirror
        report = self.report(["task floor 34.2", "eyes spacing 20", "eye me 7 2.5 1.2"], room)
        places = np.array([p for _, p in report.places])
        found = rsphere.Scene(os.path.join(self.folder.name, "room.rad")).glare(
            np.repeat(places, 8, axis=0), np.tile(GAZES, (len(places), 1)), directions=128, Sub=BEYOND).ugr
        row = self.row(report, "glare", "worst UGR")
        self.assertAlmostEqual(row.value, found.max(), delta=0.3)

    def test_areas(self):
        """Around a desk: within half a metre, in the room, not on another desk, not under a shelf; a board's is on its wall."""
        desks = "".join(f"white polygon desk{i} 0 0 12 {x} .3 .75 {x + 1.4} .3 .75 {x + 1.4} 1 .75 {x} 1 .75\n" for i, x in ((1, .2), (2, 1.8)))
        board = "white polygon board 0 0 12 3 4.99 1 5 4.99 1 5 4.99 2 3 4.99 2\n"
        shelf = box("white", "shelf", (0.1, 1.1, 1.4), (1, 1.6, 1.6))
        report = self.report(["task desk* 34.2", "task board 5.36.4", "eyes spacing 3"], ROOM + lamp() + desks + board + shelf)
        desk, _, board = report.tasks.tasks
        points = report.surrounding(desk, np.array([0, 0, 1.0]))
        self.assertTrue(np.allclose(points[:, 2], 0.756))
        self.assertTrue((points[:, :2] > 0).all())
        self.assertFalse(((points[:, 0] > 1.8) & (points[:, 1] > .3) & (points[:, 1] < 1)).any(), "on the other desk")
        self.assertFalse(((points[:, 0] > .1) & (points[:, 0] < 1) & (points[:, 1] > 1.1)).any(), "under the shelf")
        self.assertTrue(((points[:, 0] > 1.1) & (points[:, 1] > 1.1)).any())
        flat = desk.surface.outlines[0][0][:, :2]
        away = distance(flat, points[:, :2])
        self.assertTrue(((away > 0) & (away <= .5)).all())
        for width, least, most in ((0, 0, 0), (1e-9, 0, 10), (0.02, 20, 1000)):
            desk.around = width
            self.assertTrue(least <= len(report.surrounding(desk, np.array([0, 0, 1.0]))) <= most, width)
        around = report.surrounding(board, board.surface.normals[0])
        self.assertTrue(np.allclose(around[:, 1], 4.984))
        self.assertTrue((around[:, 0].min() < 2.8) and (around[:, 2].max() > 2.2))
        self.assertEqual(self.row(report, "around board", "E_m").limit, 300)
        self.assertEqual([r.of for r in report.rows if r.what == "E_m"],
                         ["desk1", "around desk1", "background of desk1", "desk2", "around desk2", "background of desk2", "board", "around board"])

    def test_dark_and_narrow(self):
        """No luminaire at all; luminaires behind the ceiling; a corridor that is narrower than two margins."""
        with self.assertRaisesRegex(Fault, "the scene has no light sources; a report is on a room"):
            self.report(["task floor 34.2", "eyes spacing 3"], ROOM)
        report = self.report(["task floor 34.2", "eyes spacing 3"], ROOM + lamp(at=(4, 2.5, 3.5)))
        self.assertEqual(self.row(report, "floor", "E_m").value, 0)
        narrow = "\n".join(line.replace(" 5 ", " .8 ") if "polygon" in line else line for line in ROOM.split("\n")) + lamp("tube", (4, .4, 2.9))
        report = self.report(["task floor 5.1.1", "eyes spacing 3"], narrow)
        self.assertGreater(self.row(report, "eyes, 1.2 m", "E_m,z").value, 0)

    def test_millimetres(self):
        """The same room in other units has the same values."""
        lines = ["task floor 5.1.1", "eyes spacing 4", "ceiling ceiling"]
        metres = self.report(lines, BLACK + lamp())
        scaled = (BLACK + lamp()).replace("polygon", "POLYGON")
        scaled = re.sub(r"(POLYGON \S+ 0 0 12) (.*)", lambda m: m[1] + " " + " ".join(f"{1000 * float(v):.9g}" for v in m[2].split()), scaled).replace("POLYGON", "polygon")
        other = self.report(["units mm", lines[0], "eyes spacing 4000", lines[2]], scaled)
        self.assertEqual([(r.of, r.what) for r in metres.rows], [(r.of, r.what) for r in other.rows])
        for a, b in zip(metres.rows, other.rows):
            if a.unit != "UGR" and a.value > 0:
                self.assertAlmostEqual(a.value / b.value, 1, delta=0.03, msg=f"{a} {b}")

    def test_distance(self):
        points = np.array([[1, 1], [4, 4], [-3, -4], [2, 3], [7, 1], [3.0, 2.5]])
        np.testing.assert_allclose(distance(L_SHAPE[:, :2], points), [0, 2, 5, 0, 1, 0.5])

    def test_verdicts(self):
        for value, error, most, words in ((500, 0, False, "met"), (499, 0, False, "not met"), (499, 1, False, "within noise"), (503, 1, False, "met"),
                                          (19.5, .1, True, "not met"), (18.5, .1, True, "met"), (19.1, .1, True, "within noise")):
            self.assertEqual(Row("", "", 19 if most else 500, value, error, "", most).verdict(), words)
        self.assertEqual(Row("", "", None, 5, 0).verdict(), "")

    def test_limits(self):
        self.assertGreaterEqual(len(ACTIVITIES), 30)
        self.assertEqual([ACTIVITIES[n].surrounding() for n in ("34.3", "34.2", "34.1", "34.7", "5.1.1")], [500, 300, 200, 150, 100])
        changed = ACTIVITIES["34.2"].changed({"ugr": 16})
        self.assertEqual((changed.ugr, changed.illuminance), (16, 500))
        self.assertIn("EN 12464-1:2021, changed: ugr", changed.title())

    def test_page(self):
        tasks, room = self.file("maintenance .9\ntask floor 5.1.1\neyes spacing 4\n", "tasks.txt"), self.file(ROOM + lamp(), "room.rad")
        run = run_here([built("rsphere-layout"), "--report", "--accuracy", ".1", "-b", "0", "-o", self.folder.name, tasks, room])
        self.assertEqual(run.stderr, "")
        self.assertEqual(run.returncode, 0 if "not met" not in run.stdout else 2)
        self.assertRegex(run.stdout, r"(?m)^floor +E_m +100 lx +[0-9]+ lx +[0-9.]+ lx +(not )?met +5\.1\.1 Circulation areas and corridors$")
        self.assertIn("EN 12464-1:2011", run.stdout)
        with open(os.path.join(self.folder.name, "report.txt"), encoding="utf-8") as stream:
            self.assertTrue(run.stdout.startswith(stream.read()))
        page = xml.dom.minidom.parse(os.path.join(self.folder.name, "report.html"))
        self.assertEqual(len(page.getElementsByTagName("table")), 2)
        self.assertEqual(len(page.getElementsByTagName("svg")), 1)
        self.assertIn("@media print", page.toxml())
        self.assertRegex(run_here([built("rsphere-layout"), "--activities"]).stdout, r"(?m)^5\.26\.2 Writing.*: 500 lx, U_o 0\.60, UGR 19; at eyes")

    def test_data_beside_the_scene(self):
        """Luminaires whose data lie beside them, in another folder, are dimmed."""
        self.file("1 0 9 2 1 1\n", "even.dat")
        text = ROOM + lamp().replace("void light tube", "void brightdata even 4 noop even.dat . Px 0 0\neven light tube")
        tasks, room = self.file("task floor 5.1.1 height .2 margin 1\nluminaire tube watts 9\neyes spacing 4\n", "tasks.txt"), self.file(text, "room.rad")
        run = run_here([built("rsphere-layout"), "--report", "--accuracy", ".1", "-b", "0", "-o", self.folder.name, tasks, room])
        self.assertEqual(run.stderr, "")
        self.assertIn("floor", run.stdout)

    def test_activities_by_name(self):
        for words, number in (("34.2", "34.2"), ("5.26.2", "5.26.2"), ("Writing", "34.2"), ("data processing", "34.2"), ("MEETING ROOM", "34.5"),
                              ("classroom", "44.1"), ("kitchen", "5.29.2"), ("corridors", "5.1.1"), ("archives", "5.26.7")):
            self.assertEqual([a.number for a in activities_named(words)], [number], words)
        self.assertEqual([a.number for a in activities_named("room")], ["34.5", "44.1"])  # of 2021 alone
        self.assertEqual(activities_named("typist"), [])
        room = self.file(ROOM + lamp(), "room.rad")
        rows = []
        for activity in ("5.1.1", "circulation areas"):
            tasks = self.file(f"maintenance .9\ntask floor {activity} height .2 margin 1\neyes spacing 4\n", "tasks.txt")
            rows.append(run_here([built("rsphere-layout"), "--report", "--accuracy", ".1", "-b", "0", "-o", self.folder.name, tasks, room]).stdout.split("\n")[2:9])
        self.assertEqual(*rows)

    def test_faults(self):
        room = self.file(ROOM + lamp(), "room.rad")
        for line, words in (
            ("task", "task needs the name of a surface"), ("task flor 34.2", 'no polygon or modifier "flor"; it has floor'),
            ("task floor 99.9", 'no activity "99.9"; rsphere-layout --activities'), ("task floor", "needs the number or the name of an activity"),
            ("task floor typist height 1", 'no activity "typist"; rsphere-layout'), ("task floor work hight 1", 'no activity "work hight"'),
            ("task floor classrooms height 1", '"classrooms" is part of 5.36.1 (Classrooms, tutorial rooms) and of 5.36.2 (Classrooms for'),
            ("task floor 34.2 hight 1", '"hight" is none of height, margin'), ("task floor 34.2 uniformity 2", "uniformity must be from 0 to 1"),
            ("task floor 34.2 margin 9", "no sensor fits"), ("task floor 34.2 ugr nan", "must be a number"), ("taks floor 34.2", '"taks" is none of'),
            ("maintenance 0", "maintenance factor must be from"), ("luminaire lamps watts 3\ntask floor 34.2", 'no light source has the modifier "lamps"; there are tube'),
            ("luminaire tube factor 2", "factor must be from 0 to 1"), ("luminaire tube wats 3", "neither watts nor factor"),
            ("walls", "walls needs the name"), ("floor ceiling", "does not face up"), ("eye me 1 1", "z of the place"), ("eye me 1e8 1 1", "far from the scene"),
            ("eyes heigth 1", "neither height nor spacing"), ("eyes height 9", "1: eyes at 9 are above the scene, whose height is 3; is it in the units"),
            ("task floor 34.2\neyes spacing .001", '2: the spacing makes more than 20000 points on "floor"'), ("eyes spacing 1\neyes height 1", "2: eyes is in line 1, too"),
            ("task floor 34.2\ntask fl* 5.1.1", "2: a second task on floor"), ("task floor 34.2 height 1e8", '1: the task on "floor" is far from the scene'),
            ("task floor 34.2 ugr 19 ugr 22", "1: ugr is given twice"), ("maintenance .8\nmaintenance .9", "2: maintenance is in line 1, too; take one out"),
            ("units mm", "in mm the scene would have"), ("", "there is no task SURFACE ACTIVITY"),
        ):
            with self.subTest(line=line):
                tasks = self.file(line + "\n", "tasks.txt")
                run = run_here([built("rsphere-layout"), "--report", "-o", self.folder.name, tasks, room])
                self.assertEqual((run.returncode, run.stdout), (1, ""))
                self.assertRegex(run.stderr, rf"\Arsphere-layout: fatal - {re.escape(tasks)}:[^\n]*{re.escape(words)}[^\n]*\n\Z")

    def test_dimming(self):
        """Light sources of commands, on one line or on many, are found; comments and other materials stay as they are."""
        inner = self.file("void glow panel_2\n0\n0\n4 1e1 2. .3 0\n", "inner.rad")
        text = f"# void light panel_0\nvoid light panel_1 0 0 3 4 5 6\n  !cat \\\n {inner}\nvoid plastic panel_3 0 0 5 1 1 1 0 0\npat spotlight other 0 0 7 1 1 1 30 0 0 1\n"
        lamps = [Lamps("panel*", 0, .5, ("tasks.txt", 1)), Lamps("panel_1", 0, .1, ("tasks.txt", 2))]
        (path,) = dimmed([self.file(text, "a.rad")], lamps, self.folder.name)
        with open(path, encoding="ascii") as stream:
            found = stream.read()
        self.assertIn("void light panel_1 0 0 3 0.2 0.25 0.3\n", found)
        self.assertIn("void glow panel_2\n0\n0\n4 5 1 0.15 0\n", found)
        self.assertIn("plastic panel_3 0 0 5 1 1 1 0 0\npat spotlight other 0 0 7 1 1 1 30 0 0 1\n", found)
        for file, words in ((self.file("#?RADIANCE\n", "a.oct"), "is an octree"), (self.file("!false\n", "b.rad"), "the command fails: false"),
                            (os.path.join(self.folder.name, "none.rad"), "cannot be read")):
            with self.assertRaisesRegex(Fault, words):
                dimmed([file], lamps, self.folder.name)


if __name__ == "__main__":
    unittest.main()
