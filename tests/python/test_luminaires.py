"""Readers of IES and EULUMDAT files in rsphere.photometry: faults with file and line, and luminaires as RADIANCE scenes."""
import os
import re
import subprocess
import unittest
import warnings

import numpy as np

import rsphere
from rsphere.fault import Fault
from rsphere.photometry import read_luminaire
from run_here import InAFolder, built, run_here

CASES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/layout/cases")
PANEL = os.path.join(CASES, "panel.ies")
DOWNLIGHT = os.path.join(CASES, "downlight.ies")

# Light up and down from a box, symmetric about one plane, in feet, with factors.
BOX = """IESNA:LM-63-2002
TILT=NONE
2 1000 1.5 7 5 1 1 1 2 .3
.9 1 70
0 30 60 90 120 150 180
0 45 90 135 180
100 95 60 20 40 70 80
110 99 61 21 41 72 80
120 103 66 25 48 74 80
115 101 64 24 44 73 80
105 97 61 22 42 71 80
"""

# Radiance (W/sr/m2) in 20 directions by ies2rad, oconv and rtrace of RADIANCE 6.1a. source_corr() there leaves out A1
# where it is the only argument, though source.cal documents it: for the flat luminaires it is multiplied here.
OF_BOX = [
    2.971905, 2.868735, 2.629824, 2.424545, 2.477176, 2.311401, 2.379878, 2.508254, 2.495524, 3.868403,
    2.735286, 3.183294, 3.177694, 3.864310, 3.302926, 3.504616, 3.385507, 3.884027, 3.873877, 4.194701]
OF_PANEL = [
    8.906339, 8.886847, 8.847693, 8.788144, 8.703984, 8.592359, 8.459602, 8.303202, 8.112931, 7.883423, 7.630459,
    7.274743, 6.436834, 4.781246, 3.847934, 2.707871, .9490356, .3388491, .2409763, .1654637]
OF_DOWNLIGHT = [
    8.705229, 8.626258, 8.383040, 8.083650, 7.691896, 7.203990, 6.675329, 6.082506, 5.459833, 4.811321, 4.151640,
    3.482145, 2.788023, 2.113687, 1.456176, .8372111, .4688085, .1874212, .07759523, .03038701]


def eulumdat(**changes):
    """A text like BOX's kind: a box of .3 x 1.2 m, symmetric about both planes, 90 cd/klm straight down."""
    lines = ["maker", "1", "4", "4", "90", "3", "45", "report", "strip", "7", "file.ldt", "today",
             "1200", "300", "80", "1190", "290", "0", "0", "0", "0", "100", "25", "1", "0",
             "1", "2", "LED", "4000", "830", "80", "36", *["0"] * 10,
             "0", "90", "180", "270", "0", "45", "90", "90", "50", "0", "90", "60", "10"]
    for place, text in changes.items():
        lines[int(place[1:]) - 1] = text
    return "\r\n".join(lines) + "\r\n"


def floodlight(kind, vertical, horizontal, candela):
    """A file of type A or B. candela: a function of the direction: ahead, up and to the right."""
    lines = []
    for h in np.radians(horizontal):
        row = []
        for v in np.radians(vertical):
            across = (np.sin(v), np.cos(v) * np.sin(h)) if kind == "A" else (np.cos(h) * np.sin(v), np.sin(h))
            row.append(f"{candela(np.cos(v) * np.cos(h), *across):.9g}")
        lines.append(" ".join(row))
    angles = (" ".join(f"{a:g}" for a in angles) for angles in (vertical, horizontal))
    return "\n".join(["IESNA:LM-63-2002", "TILT=NONE", f"1 -1 1 {len(vertical)} {len(horizontal)} {' CBA'.index(kind)} 2 .2 .4 0", "1 1 100", *angles, *lines]) + "\n"


class Files(InAFolder):
    def refused(self, text, line, words, name="lamp.ies"):
        path = self.file(text, name)
        with self.assertRaises(Fault) as caught:
            read_luminaire(path)
        place = path if line is None else f"{path}:{line}"
        self.assertTrue(str(caught.exception).startswith(place + ": "), str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        self.assertRegex(str(caught.exception), words)


class Floodlights(Files):
    """Types A and B, whose angles are about an axis across the main direction."""

    ALL, HALF = np.arange(-90, 91.0), np.arange(0, 91.0)

    def read(self, *words):
        return read_luminaire(self.file(floodlight(*words)))

    def test_flux_and_intensities(self):
        """Of cosines to a power: flux by its integral, and in each direction the intensity of the same source in a file of type C."""
        random = np.random.default_rng(5).normal(size=(500, 3))
        away = random / np.linalg.norm(random, axis=1)[:, None]
        gammas = " ".join(f"{a:g}" for a in self.HALF)
        for kind in "AB":
            for power in (1, 5, 80):
                lamp = self.read(kind, self.ALL, self.ALL, lambda ahead, *_: 1e4 * max(ahead, 0) ** power)  # noqa: B023
                self.assertAlmostEqual(lamp.lumens() / (1e4 * 2 * np.pi / (power + 1)), 1, delta=1e-3)
                of_c = self.file("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 91 1 1 2 .2 .4 0\n1 1 100\n" + gammas + "\n0\n"
                                 + " ".join(f"{1e4 * max(np.cos(g), 0) ** power:.9g}" for g in np.radians(self.HALF)) + "\n", "c.ies")
                of_c = read_luminaire(of_c)
                np.testing.assert_allclose(lamp.intensity(away), of_c.intensity(away), atol=20)  # of 10,000 cd
                self.assertAlmostEqual(lamp.lumens() / of_c.lumens(), 1, delta=2e-3)  # narrow beams are wider in steps of gamma
                self.assertEqual((lamp.kind, lamp.shape, lamp.size[:2]), (kind, "box", (.4, .2)))

    def test_directions(self):
        """A beam that is aimed up and to the right has its maximum there: C0 is up and C270 to the right. Half of the angles are both halves."""
        def beam(ahead, up, right):
            return 1e4 * max(.8 * ahead + .36 * up + .48 * right, 0) ** 20
        for kind in "AB":
            lamp = self.read(kind, self.ALL, self.ALL, beam)
            np.testing.assert_allclose(lamp.intensity(np.array([[.36, -.48, -.8], [.48, -.36, -.8], [.36, .48, -.8]])), [1e4, beam(.8, .48, .36), 0], rtol=.003, atol=3)
            half = self.read(kind, self.HALF, self.HALF, beam)
            np.testing.assert_allclose(half.intensity(np.array([[a, b, -.8] for a in (.36, -.36) for b in (.48, -.48)])), 1e4, rtol=.003)

    def test_narrow_angles(self):
        """There is no light beyond the angles of the file: 1000 cd within 20 degrees of latitude and 30 of longitude, either side."""
        for kind, angles in (("A", ((-20, 0, 20), (-30, 0, 30))), ("B", ((-30, 0, 30), (-20, 0, 20)))):
            lamp = self.read(kind, *angles, lambda *_: 1000)
            self.assertAlmostEqual(lamp.lumens() / (1000 * np.radians(60) * 2 * np.sin(np.radians(20))), 1, delta=.02)
            up, right = ((20, 30) if kind == "A" else (30, 20))
            for a, b, seen in ((up - 1, 0, 1000), (up + 3, 0, 0), (0, right - 1, 1000), (0, right + 3, 0), (180, 0, 0)):
                a, b = np.radians([a, b])
                self.assertAlmostEqual(float(lamp.intensity([np.sin(a), -np.sin(b), -np.cos(a) * np.cos(b)])), seen, delta=1)

    def test_beside_radiance(self):
        """Illuminance (lx) from 1 m, in a file of 5 degrees, with ies2rad and rtrace of RADIANCE 6.1a in the planes C0 and C90: elsewhere
        its angle to the side is that of a projection, and intensities are up to a third less than those of the file."""
        fives = np.arange(-90, 91.0, 5)
        lamp = self.read("B", fives, fives, lambda ahead, up, right: 1000 * max(ahead, 0) * (1 + .5 * up - .3 * right))
        found = lamp.intensity([[np.sin(g) * x, np.sin(g) * y, -np.cos(g)] for g, x, y in ((0, 1, 0), *((np.radians(d), *c) for d in (30, 50) for c in ((1, 0), (0, 1))))])
        np.testing.assert_allclose(found, [1000.5, 1083.0, 996.3, 889.1, 790.6], rtol=1e-3)

    def test_ugr_table(self):
        lamp = self.file(floodlight("B", self.ALL, self.ALL, lambda ahead, *_: 1000 * max(ahead, 0)), "flood.ies")
        run = run_here([built("rsphere-luminaire"), "--ugr", lamp])
        self.assertEqual((run.returncode, run.stdout), (1, ""))
        self.assertRegex(run.stderr, r"\Arsphere-luminaire: fatal - .*flood\.ies: is of type B, of floodlights; the UGR table is of [^\n]*\n\Z")
        run = run_here([built("rsphere-luminaire"), "-o", self.folder.name, lamp])
        self.assertIn("\n# photometry of type B: C0 is up and C270 to the right, seen along the main direction\n", run.stdout)


class Ies(Files):
    def changed(self, before, after):
        self.assertIn(before, BOX)
        return BOX.replace(before, after, 1)

    def test_hostile(self):
        for text, line, words in (
            ("", 1, "no line TILT="),
            (b"IESNA\nTILT=NO\0NE\n", 2, "not a text file"),
            ("a\nb\n", 3, "no line TILT="),
            (self.changed("TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n100 95"), 6, "tilt factor 1 of 2 must be from 0 to 5"),
            (self.changed("1000 1.5", "nan 1.5"), 3, 'lumens of a lamp must be a number, not "nan"'),
            (self.changed("1000 1.5", "1e999 1.5"), 3, "must be from"),
            (self.changed("1000 1.5", "0 1.5"), 3, "above 0"),
            (self.changed("1.5", "1,5"), 3, "decimals need a point"),
            (self.changed("7 5 1 1", "7 5 2 1"), 6, "horizontal angle 4 of 5 must be from -90 to 90"),
            (self.changed("7 5 1 1", "7 5 3 1"), 5, "vertical angle 5 of 7 must be from -90 to 90"),
            (self.changed("7 5 1 1", "7 1 2 1"), 6, "horizontal angles of type B must begin at 0 or below and end above, not 0 and 0"),
            (floodlight("B", [10, 20, 90], [0, 45, 90], lambda *_: 1), 5, "vertical angles of type B must begin at 0 or below and end above, not 10 and 90"),
            (floodlight("A", [-90, -20, 0], [0, 45, 90], lambda *_: 1), 5, "vertical angles of type A must begin at 0 or below and end above, not -90 and 0"),
            (self.changed("7 5 1 1", "7 5 1 3"), 3, "unit of lengths"),
            (self.changed("7 5 1 1", "7 1000000000 1 1"), 3, "horizontal angles must be from"),
            (self.changed("7 5 1 1", "2000 501 1 1"), 3, "501 x 2000 candela values are more than 1000000; use larger steps"),
            (self.changed("7 5 1 1", "6 5 1 1"), 5, "vertical angles must begin"),
            (self.changed("7 5 1 1", "7.5 5 1 1"), 3, "whole number"),
            (self.changed("7 5 1 1", "-7 5 1 1"), 3, "vertical angles must be from"),
            (self.changed("2 .3", "1e9 .3"), 3, "must be from"),
            (self.changed("30 60", "60 30"), 5, "must ascend, but 30 follows 60"),
            (self.changed("45 90 135 180", "45 90 135 170"), None, "none of 0, 0 to 90"),
            (self.changed(" 71 80\n", " 71\n"), None, "the file ends before candela value 35 of 35"),
            (BOX + "17\n", 12, '"17" follows the last candela value'),
            (self.changed("100 95", "-100 95"), 7, "candela value 1 of 35 must be from 0"),
            (self.changed("TILT=NONE", "TILT=nowhere.tlt"), 2, r"nowhere\.tlt: cannot be read"),
            (self.changed("TILT=NONE", "TILT="), 2, "needs NONE, INCLUDE or the name of a file"),
            (self.changed("1000 1.5", "1e9 1e9"), 11, r"largest intensity is .*e\+1. cd; it must be from 1e-06 to 1e\+09"),
            (self.changed("1000 1.5", "1000 1e-9").replace(".9 1 70", "1e-3 1 70"), 11, "largest intensity is .*e-1. cd"),
            (self.changed("TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1"), None, ""),
            ("TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 5\n0 90\n0\n0 0\n", 6, "all candela values are 0"),
            (BOX.encode("utf-16"), 1, "not a text file"),
            (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), 3, "not a text file"),
            ("x" * 1_000_000, 1, "no line TILT="),
            ("[" * 1_000_000 + "\nTILT=NONE\n", 3, "ends before the number of lamps"),
            ("[OTHER] " + "m W " * 100_000 + "\nTILT=NONE\n", 3, "ends before the number of lamps"),
            (self.changed("TILT=NONE", "TILT=" + "x" * 100_000), 2, "cannot be read: File name too long"),
            (self.changed("TILT=NONE", "TILT=\x1b[31mred"), 2, r"TILT=\?\[31mred"),
            (self.changed("1000 1.5", "1e" + "9" * 100_000 + " 1.5"), 3, "must be from -1"),
            (self.changed("1000 1.5", "1" + "0" * 100_000 + " 1.5"), 3, "must be from -1"),
            (self.changed("1000 1.5", "0x10 1.5"), 3, "must be a number"),
            (self.changed("1000 1.5", "1_000 1.5"), 3, "must be a number"),
            (b" " * (17 << 20), None, "larger than 16 MB"),
        ):
            with self.subTest(words=words, text=text[:200]):
                if line is None:
                    with self.assertRaisesRegex(Fault, words):
                        read_luminaire(self.file(text))
                else:
                    self.refused(text, line, words)

    def test_each_word_replaced(self):
        """Whatever a word is replaced by: a fault with a line, or a luminaire of finite intensities; nothing else."""
        words = re.split(r"(\s+)", BOX)
        refused = 0
        self.enterContext(warnings.catch_warnings())
        warnings.simplefilter("ignore")  # of so many lumens per watt
        for i in range(0, len(words), 2):
            for other in ("x", "-1", "1e300", "0", "99999999", ""):
                path = self.file("".join([*words[:i], other, *words[i + 1 :]]))
                try:
                    self.assertTrue(np.isfinite(read_luminaire(path).candela).all())
                except Fault as text:
                    refused += 1
                    self.assertRegex(str(text), re.escape(path) + r":\d+: ")
        self.assertGreater(refused, len(words))

    def test_each_truncation(self):
        for end in range(len(BOX.rstrip())):
            path = self.file(BOX[:end])
            with self.subTest(end=end), self.assertRaises(Fault):
                if end < len(BOX.rstrip()) - 1:
                    read_luminaire(path)
                else:
                    raise Fault("80 cut to 8 is a number as well")

    def test_intensities(self):
        lamp = read_luminaire(self.file(BOX))
        down = lamp.intensity(np.array([0, 0, -1.0]))
        self.assertAlmostEqual(float(down), 100 * 1.5 * .9, places=9)
        left, right = (lamp.intensity(np.array([.6, y, 0])) for y in (.8, -.8))
        self.assertAlmostEqual(float(left), float(right), places=9)  # mirrored in the plane from 0 to 180
        np.testing.assert_allclose(lamp.size, (.6096, .3048, .09144), rtol=1e-9)
        self.assertEqual(lamp.watts, 70)


class Eulumdat(Files):
    def test_a_light_output_ratio_that_intensities_lack_is_told(self):
        found = read_luminaire(self.file(eulumdat(), "strip.ldt")).lumens() / 40
        notes = [read_luminaire(self.file(eulumdat(L23=f"{ratio:g}"), "strip.ldt")).notes for ratio in (1.05 * found, 1.2 * found, 0)]
        self.assertEqual([len(of) for of in notes], [0, 1, 0])
        self.assertIn(f"have {found:.0f}% of the light of the lamps, and the file says {1.2 * found:.0f}%", notes[1][0])

    def test_hostile(self):
        for changes, line, words in (
            ({"l3": "7"}, 3, "symmetry"),
            ({"l4": "3"}, 4, "do not fit symmetry"),
            ({"l4": "1e9"}, 4, "C planes must be from"),
            ({"l6": "0"}, 6, "angles in a plane must be from"),
            ({"l24": "0"}, 24, "factor on intensities"),
            ({"l26": "0"}, 26, "sets of lamps"),
            ({"l27": "0"}, 27, "must not be 0"),
            ({"l29": "nan"}, 29, "must be a number"),
            ({"l48": "0"}, 49, "must ascend"),
            ({"l53": "x"}, 53, 'must be a number, not "x"'),
            ({"l55": "5\r\n9"}, 56, "follows the last intensity"),
            ({"l3": "4.5"}, 3, "symmetry"),
            ({"l4": "1e300"}, 4, "C planes must be from"),
            ({"l24": "inf"}, 24, "must be a number"),
            ({"l24": "0x10"}, 24, "must be a number"),
            ({"l26": "99999"}, 26, "sets of lamps"),
            ({"l27": "-1e9"}, 27, "number of lamps"),
            ({"l9": "\0"}, 9, "not a text file"),
            ({"l53": "1" + "0" * 100_000}, 53, "must be from 0"),
        ):
            with self.subTest(changes=changes):
                path = self.file(eulumdat(**changes), "lamp.ldt")
                with self.assertRaises(Fault) as caught:
                    read_luminaire(path)
                self.assertRegex(str(caught.exception), re.escape(path) + rf":{line}: .*{words}")

    def test_each_line_replaced_and_missing(self):
        lines = eulumdat().split("\r\n")[:-1]
        for i in range(len(lines)):
            for other in (["x"], ["-1"], ["1e300"], []):
                path = self.file("\r\n".join([*lines[:i], *other, *lines[i + 1 :]]) + "\r\n", "lamp.ldt")
                try:
                    self.assertTrue(np.isfinite(read_luminaire(path).candela).all())
                    self.assertTrue(other)  # with a line less, what follows is short of one
                except Fault as text:
                    self.assertRegex(str(text), re.escape(path) + r":\d+: ")

    def test_intensities(self):
        lamp = read_luminaire(self.file(eulumdat(), "lamp.ldt"))
        # cd per 1000 lm, of 4000 lm; C0 is across the length.
        self.assertAlmostEqual(float(lamp.intensity(np.array([0, 0, -1.0]))), 90 * 4, places=9)
        s = np.sqrt(.5)
        self.assertAlmostEqual(float(lamp.intensity(np.array([s, 0, -s]))), 50 * 4, places=9)
        self.assertAlmostEqual(float(lamp.intensity(np.array([0, -s, -s]))), 60 * 4, places=9)
        np.testing.assert_allclose(lamp.size[:2], (.29, 1.19))
        self.assertEqual(lamp.watts, 36)


class Doubts(Files):
    def test_units(self):
        """Lengths in other units, a watt or a factor that is a thousand times too large: such files were read without a word."""
        ies = lambda before, after: (BOX.replace(before, after, 1), "lamp.ies")  # noqa: E731
        for (text, name), words in (
            (ies("1 1 1 2 .3", "1 1 1 200 30"), r"the luminous opening is 61 m long; are its lengths"), (ies("1 70", "1 70000"), r"945\.6 lm of 70000 W are 0\.0135 lm/W"),
            (ies("1000 1.5", "1000 150"), r"1\.35e\+03 lm/W; are both right"), ((eulumdat(L16="1.19", L17=".29"), "lamp.ldt"), r"is 0\.00119 m long"),
            ((eulumdat(L16="1", L17="0"), "lamp.ldt"), None), ((eulumdat(L29="4"), "lamp.ldt"), r"1\.001 lm of 36 W"), (ies("1 70", "1 0"), None), ((BOX, "lamp.ies"), None),
        ):
            with self.subTest(words=words):
                path = self.file(text, name)
                if words:
                    with self.assertWarnsRegex(UserWarning, rf"\A{re.escape(path)}: .*({words})"):
                        read_luminaire(path)
                else:
                    with warnings.catch_warnings():
                        warnings.simplefilter("error")
                        read_luminaire(path)


class AsScene(Files):
    def made(self, file):
        run = subprocess.run([built("rsphere-luminaire"), file, "-o", self.folder.name],
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.stderr, "")
        return self.file(run.stdout, "lamp.rad")

    def radiance(self, file, rays):
        scene = self.made(file)
        before, os.environ["RAYPATH"] = os.environ.get("RAYPATH"), self.folder.name
        try:
            return rsphere.Scene([scene]).trace(rays).value[:, 1]
        finally:
            if before is None:
                del os.environ["RAYPATH"]
            else:
                os.environ["RAYPATH"] = before

    def rays(self, gammas, turn=0.0):
        """Rays from 3 m away to the middle of the luminaire. gammas: angles from -z (degrees)."""
        g, c = np.radians(gammas), np.radians(np.arange(20) * 137.50776 + turn)
        d = np.stack([np.sin(g) * np.cos(c), np.sin(g) * np.sin(c), -np.cos(g)], axis=1)
        return np.hstack([np.round(3 * d, 6), np.round(-d, 6)])

    def test_box(self):
        gammas = np.degrees(np.arccos(-(1 - 2 * (np.arange(20) + .5) / 20)))
        found = self.radiance(self.file(BOX, "box.ies"), self.rays(gammas, 11))
        np.testing.assert_allclose(found, OF_BOX, rtol=1e-4)

    def test_flat(self):
        found = self.radiance(PANEL, self.rays(4.4 * (np.arange(20) + .5)))
        np.testing.assert_allclose(found, np.array(OF_PANEL) * 2.89771, rtol=1e-4)
        self.assertFalse(np.allclose(found, np.array(OF_PANEL) * 2.899, rtol=1e-4))

    def test_disk(self):
        found = self.radiance(DOWNLIGHT, self.rays(3.2 * (np.arange(20) + .5)))
        np.testing.assert_allclose(found, np.array(OF_DOWNLIGHT) * 56.5884, rtol=1e-4)

    def test_short_cylinder(self):
        """As a cylinder of .5 m across and .2 m high it lost up to half of its light: rtrace's rays pass by the rim."""
        scene = self.made(self.file("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 -.5 -.5 .2\n1 1 40\n0 90 180\n0\n500 500 500\n"))
        angles = np.radians([20, 50, 80, 90, 100, 130, 160])
        down = np.stack([np.sin(angles) * .6, np.sin(angles) * .8, -np.cos(angles)], axis=1)
        os.environ["RAYPATH"] = self.folder.name
        try:
            found = rsphere.Scene([scene]).trace(np.hstack([8 * down, -down]), irradiance_at_origin=True, ambient_bounces=0,
                                                 dt=0, dj=0, ds=.02).value
        finally:
            del os.environ["RAYPATH"]
        np.testing.assert_allclose(rsphere.photometric(found) * 64, 500, rtol=.02)

    def test_fault(self):
        run = subprocess.run([built("rsphere-luminaire"), self.file("TILT=NONE\n1 x\n")],
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r'\Arsphere-luminaire: fatal - .*lamp\.ies:2: the lumens of a lamp must be a number, not "x"\n\Z')
        self.assertEqual(run.stdout, "")

    def test_makes_its_folder(self):
        """As layout does; a folder that was missing was a fault."""
        folder = os.path.join(self.folder.name, "new/lamps")
        run = subprocess.run([built("rsphere-luminaire"), PANEL, "-o", folder], capture_output=True, text=True, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(sorted(os.listdir(folder)), ["lamp.cal", "panel.dat"])

    def test_full_disk(self):
        """It was a traceback."""
        with open("/dev/full", "w", encoding="ascii") as full:
            run = subprocess.run([built("rsphere-luminaire"), PANEL, "-o", self.folder.name], stdout=full,
                                 stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((run.returncode, run.stderr), (2, "rsphere-luminaire: system - write error: No space left on device\n"))

    def test_closed_output(self):
        """It was a traceback."""
        run = subprocess.run(["sh", "-c", 'exec "$0" "$1" >&-', built("rsphere-luminaire"), PANEL], stderr=subprocess.PIPE, text=True,
                             check=False)
        self.assertEqual((run.returncode, run.stderr), (2, "rsphere-luminaire: system - write error: Bad file descriptor\n"))

    def test_percentage(self):
        """-f 80 made the light 80 times as bright without a word."""
        for factor, words in (("80", "80 times as bright; 80% is 0.8"), ("250", "250 times as bright"), ("2", None)):
            run = run_here([built("rsphere-luminaire"), PANEL, "-o", self.folder.name, "-f", factor])
            self.assertEqual(run.returncode, 0)
            self.assertEqual(run.stderr, f"rsphere-luminaire: warning - -f {factor} makes the light {words}\n" if words else "")

    def test_folder_that_is_a_file(self):
        """Of ies2rad, -o is the name of the scene; here it was a folder of that name."""
        for name in ("panel.rad", "panel.dat", self.file("", "panel")):
            run = run_here([built("rsphere-luminaire"), PANEL, "-o", os.path.join(self.folder.name, name)])
            self.assertEqual((run.returncode, run.stdout), (1, ""))
            self.assertRegex(run.stderr, r"\Arsphere-luminaire: fatal - -o .*: this is the folder of the data file; the scene goes to the standard output, .*panel\.rad\n\Z")
        self.assertEqual(os.listdir(self.folder.name), ["panel"])


if __name__ == "__main__":
    unittest.main()
