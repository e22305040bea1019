"""UGR tables of luminaires (rsphere.photometry): closed forms, equal luminaires in other files, and a room that is traced."""
import os
import unittest
import unittest.mock
import xml.dom.minidom

import numpy as np

import rsphere
from rsphere.photometry import read_luminaire
from rsphere.photometry.lamp_rad import pattern_text, rotation, surfaces_text, turning_words, write_data
from rsphere.photometry.ugr_table import REFLECTANCES, ROOMS, Direct, UgrTable, form_factor, glare_sum, indirect, places
from rsphere.layout.surface_parts import surface_parts
from run_here import InAFolder, built, run_here

PANEL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/layout/cases/panel.ies")


def ies(candela, size, planes="0", gammas=None):
    """A file with these intensities, whose opening is `size`: width, length and height (m)."""
    candela = np.atleast_2d(candela)
    gammas = np.linspace(0, 90, candela.shape[1]) if gammas is None else gammas
    text = lambda values: " ".join(f"{v:.9g}" for v in values)  # noqa: E731
    return (f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {candela.shape[1]} {len(candela)} 1 2 {size}\n1 1 10\n{text(gammas)}\n{planes}\n"
            + "\n".join(map(text, candela)) + "\n")


def eulumdat(candela, size, heights=(0, 0, 0, 0)):
    """A file of 1000 lm with these intensities in the planes C0, C90, C180 and C270. size: length and width (mm)."""
    gammas = np.linspace(0, 90, len(candela[0]))
    lines = ["maker", 1, 0, 4, 90, len(gammas), 0, "report", "lamp", 7, "file.ldt", "today", *size, 80, *size, *heights, 100, 100, 1, 0,
             1, 1, "LED", 1000, 830, 80, 10, *[0] * 10, 0, 90, 180, 270, *gammas, *np.ravel(candela)]
    return "\r\n".join(map(str, lines)) + "\r\n"


GAMMAS = np.radians(np.linspace(0, 90, 91))
LAMBERT = 1000 * np.cos(GAMMAS)


class Tables(InAFolder):
    def lamp(self, text, name="lamp.ies"):
        return read_luminaire(self.file(text, name))

    def test_exchange(self):
        """CIE 190 prints these factors of rooms of 4H x 8H: for light that meets the ceiling, the walls, and the plane of the eye."""
        np.testing.assert_allclose(indirect((4, 8), (0.7, 0.5, 0.2)), (0.307, 0.211, 0.115), atol=5e-4)
        np.testing.assert_allclose(indirect((8, 4), (0.3, 0.3, 0.2)), (0.114, 0.092, 0.081), atol=5e-4)
        self.assertAlmostEqual(form_factor(1, 1), 0.1998249, places=6)  # of a cube

    def test_lambertian_disk(self):
        """Four disks above 2H x 2H, by hand: two count, at 1 m aside and 3 m ahead; the index of position is 3.784 there."""
        disk = self.lamp(ies(LAMBERT, "-.4 -.4 0"))
        cosine = 2 / np.sqrt(14)
        glare = 2 * (1000 * cosine) ** 2 / (np.pi / 4 * 0.4**2 * cosine) / 14 / 3.784**2
        self.assertAlmostEqual(glare_sum(disk, (2, 2), 1, False) / glare, 1, delta=1e-3)
        # What a point above a corner sees of a rectangle a x b at a distance of 1, of all that it could see.
        corner = lambda a, b: (a / np.sqrt(1 + a * a) * np.arctan(b / np.sqrt(1 + a * a))  # noqa: E731
                               + b / np.sqrt(1 + b * b) * np.arctan(a / np.sqrt(1 + b * b))) / (2 * np.pi)
        down = sum(corner(a, b) for a in (0.5, 1.5) for b in (0.5, 1.5))
        np.testing.assert_allclose(Direct(disk).flux((2, 2)), np.pi * 1000 * np.array([0, 1 - down, down]), rtol=2e-3, atol=1)
        # Reflection by reflection: 1000 lm to the walls, half of which they reflect, and so on.
        f, walls, plane = form_factor(2, 2), 1 - down, down
        aside = (1 - f) / 2
        got, ceiling = np.array([0, walls, plane]), 0.0
        for _ in range(60):
            left = got * (0.7, 0.5, 0.2)
            got = np.array([left[1] * aside + left[2] * f, left[1] * (1 - 2 * aside) + (left[0] + left[2]) * (1 - f),
                            left[1] * aside + left[0] * f])
            ceiling += got[1]
        luminance = 4 * np.pi * 1000 * ceiling / (2 * 4 * 4) / np.pi
        table = UgrTable(disk, 1)
        self.assertAlmostEqual(table.values[0, 0], 8 * np.log10(0.25 * glare / luminance), delta=0.005)
        np.testing.assert_allclose(table.values[:, :5], table.values[:, 5:], atol=1e-9)  # it is round
        self.assertAlmostEqual(UgrTable(disk, 1, 10).values[3, 7], table.values[3, 7] + 8, places=9)
        self.assertTrue((np.diff(table.values[:, [0, 1]], axis=1) > 0).all(), "darker walls, more glare")

    def test_equal_luminaires(self):
        """A strip along C90 in EULUMDAT is one along the plane 0 in IES; an opening that is wide there lies along 90."""
        across, along = 400 * np.cos(GAMMAS[::10]), 300 * np.cos(GAMMAS[::10]) ** 2
        german = UgrTable(self.lamp(eulumdat([across, along, across, along], (1200, 100)), "lamp.ldt")).values
        american = UgrTable(self.lamp(ies([along, across], ".1 1.2 0", "0 90"))).values
        wide = UgrTable(self.lamp(ies([across, along], "1.2 .1 0", "0 90"))).values
        np.testing.assert_allclose(american, german, atol=0.002)
        np.testing.assert_allclose(wide, german, atol=0.002)
        self.assertGreater(np.abs(german[:, :5] - german[:, 5:]).max(), 1)

    def test_eye_is_at_c0_and_c90(self):
        """A wallwasher dazzles who sees its bright side: crosswise that of C0, endwise that of C90."""
        dim, bright = 1 + 0 * GAMMAS[::10], 500 + 0 * GAMMAS[::10]
        for planes, columns in (((bright, dim, dim, dim), slice(0, 5)), ((dim, bright, dim, dim), slice(5, 10))):
            values = UgrTable(self.lamp(eulumdat(planes, (300, 300)), "lamp.ldt")).values
            self.assertGreater((values[:, columns] - np.delete(values, np.arange(10)[columns], axis=1)).min(), 1)

    def test_sides(self):
        """The area in view is that of the side that faces the eye: C0 here, of 1 m x .1 m."""
        lamp = self.lamp(eulumdat([300 + 0 * GAMMAS[::10]] * 4, (1000, 200), (100, 0, 0, 0)), "lamp.ldt")
        level, down = np.array([1.0, 0, 0]), np.array([0, 0, -1.0])
        self.assertAlmostEqual(float(lamp.luminous_area(level)), 0.1)
        self.assertAlmostEqual(float(lamp.luminous_area(-level)), 0)
        self.assertAlmostEqual(float(lamp.luminous_area(down)), 0.2)
        self.assertAlmostEqual(float(lamp.luminous_area((level + down) / np.sqrt(2))), 0.3 / np.sqrt(2))

    def test_sides_as_scene(self):
        """All sides had the height of the highest one: the luminaire was too dim, and its traced UGR 1.5 below its table."""
        gammas = list(range(0, 181, 45))
        lines = ["maker", 1, 0, 4, 90, 5, 0, "report", "lamp", 7, "file.ldt", "today", 400, 200, 80, 400, 200, 300, 100, 200, 0, 50, 100, 1, 0,
                 1, 1, "LED", 1000, 830, 80, 10, *[0] * 10, 0, 90, 180, 270, *gammas, *[300] * 20]
        lamp = self.lamp("\r\n".join(map(str, lines)) + "\r\n", "lamp.ldt")
        data, lights = write_data(lamp, self.folder.name, "lamp"), os.path.join(self.folder.name, "room.rad")
        with open(lights, "w", encoding="ascii") as stream:
            stream.write(pattern_text(lamp, "lamp", data, 1) + surfaces_text(lamp, "l", "lamp"))
        towards = np.array([[-1, 0, 0], [0, -1, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0], [-0.6, 0, 0.8]])
        with unittest.mock.patch.dict(os.environ, RAYPATH=self.folder.name):
            seen = rsphere.photometric(rsphere.Scene([lights]).trace(np.hstack([-5 * towards - [0, 0, 0.14], towards]) * 1.0).value)
            far = rsphere.Scene([lights]).trace(np.hstack([-200 * towards, towards]), irradiance_at_origin=True, ds=0.02).value
        area = np.array([0.12, 0.02, 0.08, np.inf, 0.08, 0.6 * 0.12 + 0.8 * 0.08])
        np.testing.assert_allclose(seen[:5], (300 / area)[:5], rtol=1e-4)
        np.testing.assert_allclose(rsphere.photometric(far)[[0, 1, 2, 4, 5]] * 200**2, 300, rtol=0.01)
        parts = surface_parts(lamp, 200)
        np.testing.assert_allclose(parts.areas.sum(), 0.16 + 0.12 + 0.02 + 0.08)
        self.assertLess(parts.points[parts.normals[:, 1] > 0.9][:, 2].max(), -0.05 + 1e-9)

    def test_no_light_towards_the_eye(self):
        """A narrow spot: no logarithm of 0, and a row of <10."""
        table = self.run_on(self.file(ies([1000, 900, 0, 0, 0, 0, 0, 0, 0, 0], "-.1 -.1 0")), "--csv")
        self.assertEqual(table.stdout.splitlines()[4], ",".join(["<10"] * 10))

    def test_traced(self):
        """The same sum by rsphere -Su, in rooms where the luminaires hang that count; the other view differs."""
        panel, room, found = read_luminaire(PANEL), (2, 3), []
        data, lights = write_data(panel, self.folder.name, "lamp"), os.path.join(self.folder.name, "room.rad")
        for endwise in (False, True):
            turn = -90 if endwise else 180  # from the luminaires, the eye is in the plane 0, or in that of 90
            text = "void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey bubble room 0 0 4 0 6 1 30\n"
            text += pattern_text(panel, "lamp", data, 1, turning_words((0, 0, -1), turn))
            for i, (x, y) in enumerate(zip(*places(room, 1))):
                if y > 1.1:
                    text += surfaces_text(panel, f"l{i}", "lamp", rotation((0, 0, -1), turn), (x, y, 2))
            with open(lights, "w", encoding="ascii") as stream:
                stream.write(text)
            before, os.environ["RAYPATH"] = os.environ.get("RAYPATH", "."), self.folder.name
            a = rsphere.Scene([lights]).glare([[0, 0, 0]], [[0, 1, 0]], ab=1, directions=512, Sub=1e12)
            os.environ["RAYPATH"] = before
            found.append(4 * a.background[0] * 10 ** (a.ugr[0] / 8))
        sums = [glare_sum(panel, room, 1, endwise) for endwise in (False, True)]
        differences = 8 * np.log10(np.array(found) / sums)
        self.assertLess(np.abs(differences).max(), 0.3, differences)
        self.assertGreater(np.abs(8 * np.log10(np.array(found) / sums[::-1])).max(), 0.3)

    def run_on(self, file, *options):
        return run_here([built("rsphere-luminaire"), "--ugr", *options, file])

    def test_forms(self):
        numbers = [[line.split(",") for line in self.run_on(PANEL, *form).stdout.splitlines() if line[0] != "#"] for form in ((), ("--csv",))]
        self.assertEqual([[v.strip() for v in row] for row in numbers[0]], numbers[1])
        self.assertEqual([len(row) for row in numbers[0]], [2 * len(REFLECTANCES)] * len(ROOMS))
        shown = xml.dom.minidom.parseString(self.run_on(PANEL, "--svg").stdout).getElementsByTagName("text")
        words = [node.firstChild.data for node in shown]
        for row in numbers[1]:
            self.assertIn(" ".join(row), " ".join(words))
        self.assertFalse(os.path.exists("panel.dat"), "a table writes no scene")

    def test_faults(self):
        for file, options, words in (
            (self.file(ies(LAMBERT, "0 0 0"), "point.ies"), (), r"point\.ies: has no luminous area"),
            (self.file("TILT=NONE\n1 x\n", "bad.ies"), (), r'bad\.ies:2: the lumens of a lamp must be a number, not "x"'),
            (os.path.join(self.folder.name, "none.ldt"), (), r"none\.ldt: cannot be read"),
            (self.folder.name + "/", (), "cannot be read"),
            (PANEL, ("--csv", "--svg"), "argument --svg: not allowed with argument --csv"),
            (PANEL, ("-u", "mm"), "-u is that of a scene, without --ugr"),
            (PANEL, ("--factor", "0"), "--factor must be from 1e-06 to"),
            (PANEL, ("--spacing", "2"), "invalid choice: '?2'?"),
        ):
            with self.subTest(words=words):
                run = self.run_on(file, *options)
                self.assertEqual((run.returncode, run.stdout), (1, ""))
                self.assertRegex(run.stderr, r"\Arsphere-luminaire: fatal - [^\n]*" + words + r"[^\n]*\n\Z")


if __name__ == "__main__":
    unittest.main()
