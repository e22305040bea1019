"""rsphere.annual.glare: DGP over a year against that of rsphere -Su in single hours, and its parts by hand."""
import os
import unittest
import unittest.mock
import warnings

import numpy as np

import rsphere
from rsphere.annual.glare import DIRECTIONS, PEAK, Glare, Sources, dgp, sun_through
from rsphere.annual.light import Light
from rsphere.annual.passes import Settings
from rsphere.annual.shades import group_of
from rsphere.annual.sky import light_of, patches, relative_luminances
from rsphere.annual.sun import sun_position
from rsphere.annual.verdicts import Year
from rsphere.annual.weather import Weather
from rsphere.layout.room import read_polygons
from rsphere.photometry.position_index import position_index
from run_here import InAFolder, built, run_here

PLACE = [47.0, 15.0, 15.0]
HOURS = [(3, 21, 8.5, 450, 80), (6, 21, 10.5, 0, 200), (9, 21, 14.5, 650, 110), (12, 21, 12.5, 500, 70)]
ROOM = "void plastic white 0 0 5 .3 .3 .3 0 0\nvoid glass pane 0 0 3 .87 .87 .87\npane polygon glazing 0 0 12 1 0 1 1 0 2.5 3 0 2.5 3 0 1\n" + "".join(
    f"white polygon {name} 0 0 12 {corners}\n" for name, corners in (
        ("floor", "0 0 0 4 0 0 4 4 0 0 4 0"), ("north", "0 4 0 4 4 0 4 4 3 0 4 3"), ("west", "0 0 0 0 4 0 0 4 3 0 0 3"), ("east", "4 0 0 4 0 3 4 4 3 4 4 0"),
        ("top", "0 0 3 0 4 3 4 4 3 4 0 3"), ("sill", "0 0 0 0 0 1 4 0 1 4 0 0"), ("lintel", "0 0 2.5 0 0 3 4 0 3 4 0 2.5"),
        ("left", "0 0 1 0 0 2.5 1 0 2.5 1 0 1"), ("right", "3 0 1 3 0 2.5 4 0 2.5 4 0 1")))
PEREZ = ("sky = if(Dz, A1 * (1 + A3 * exp(A4 / if(Dz - .01, Dz, .01))) * (1 + A5 * exp(A6 * acos(c)) + A7 * c * c), A2);\n"
         "c = Dx * A8 + Dy * A9 + Dz * A10;\n")


class Parts(InAFolder):
    def test_position_index(self):
        """That of rsphere -Su at lamps in all parts of the view, with a level and with a raised gaze."""
        lamps = [(x, z) for x in (-3, -1, 0.4, 2) for z in (-2, -0.3, 0.2, 1, 4)]
        text = "void light l 0 0 3 100 100 100\n" + "".join(f"l sphere s{i} 0 0 4 {x} 3 {z} .01\n" for i, (x, z) in enumerate(lamps))
        scene = rsphere.Scene(self.file(text, "lamps.rad"))
        for gaze in ((0, 1, 0), (0.2, 0.9, 0.3)):
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # the background is black
                found = scene.glare([[0, 0, 0]], gaze).sources[0]
            self.assertEqual(len(found.surface), len(lamps))
            np.testing.assert_allclose(position_index(np.array(gaze) / np.linalg.norm(gaze), found.direction), found.position_index, rtol=1e-3)

    def test_sources(self):
        """Bright directions near each other are one source of their mean luminance; brighter ones than 50,000 cd/m2 are others."""
        sources = Sources([0, 1, 0])
        self.assertAlmostEqual(len(sources.directions) * sources.solid_angle, 2 * np.pi, delta=0.05)
        sources.keep(np.arange(len(sources.directions)))
        d, omega = sources.directions, 4 * np.pi / DIRECTIONS

        def weight(*parts):  # (luminance, middle, radius)
            luminance = np.full(len(d), 100.0)
            wanted = 0
            for value, middle, radius in parts:
                inside = np.arccos(d @ middle / np.linalg.norm(middle)) < radius
                luminance[inside] = value
                mean = d[inside].sum(axis=0) / np.linalg.norm(d[inside].sum(axis=0))
                wanted += value**2 * omega * inside.sum() / position_index(sources.gaze, mean) ** 2
            return sources.weight(luminance), wanted

        np.testing.assert_allclose(*weight((3000, np.array([0.3, 1, 0.2]), 0.2)))
        np.testing.assert_allclose(*weight((3000, np.array([0.5, 1, 0.2]), 0.2), (8000, np.array([-0.5, 1, 0.2]), 0.2)))
        np.testing.assert_allclose(*weight((PEAK + 1, np.array([0, 1, 0.5]), 0.1)))
        self.assertEqual(weight((1999, np.array([0, 1, 0.5]), 0.1))[0], 0)
        ring = np.arccos(d @ [0, 1, 0])
        luminance = np.where(ring < 0.2, 4000.0, np.where(ring < 0.3, 2000.0, 0))
        chosen = luminance > 0
        self.assertAlmostEqual(sources.weight(luminance) / (luminance[chosen].mean() ** 2 * omega * chosen.sum()), 1, delta=0.01)

    def test_formula(self):
        self.assertEqual(dgp(np.zeros(1), np.zeros(1))[0], 0.16)
        np.testing.assert_allclose(dgp(np.array([2000.0]), np.array([1e8])), 5.87e-5 * 2000 + 0.0918 * np.log10(1 + 1e8 / 2000**1.87) + 0.16)
        self.assertEqual(dgp(np.array([1e5]), np.array([1e12]))[0], 1)

    def test_sun_through_panes_and_walls(self):
        sky = "void glow rsphere_sky 0 0 4 1 1 1 0\nrsphere_sky source d 0 0 4 0 0 1 360\n"
        scene = rsphere.Scene(self.file(ROOM + sky, "room.rad"))
        found = sun_through(scene, [2, 2, 1.5], np.array([[0, -1, 0], [0, 1, 0], [0.9, -1, 0]]) / [[1], [1], [np.hypot(0.9, 1)]])
        self.assertAlmostEqual(found[0], 0.8, delta=0.01, msg="a pane of transmissivity .87")
        self.assertEqual(list(found[1:]), [0, 0])

    def test_shares_at_their_limits(self):
        """Hours above a limit, by the hours of 8 to 18 h, those of night included; at the worst eye at most 5%."""
        n = 20
        rows = np.array([(6, 1 + i, 12.5) for i in range(n)])
        year = Year(rows, None, None, None, np.ones(n), np.ones(n), None, 40, 40)
        glare = Glare.__new__(Glare)
        glare.year = year
        level = lambda x: (x - 0.16) / 5.87e-5  # noqa: E731  lx, without sources
        lux = np.full((1, 2, n), level(0.2))
        lux[0, 1, :4], lux[0, 0, 0] = [level(x) for x in (0.401, 0.449, 0.36, 0.349)], level(0.5)
        glare.lux, glare.weights = [lux, lux], [[np.zeros(n)] * 2] * 2
        verdicts = list(glare.verdicts())
        self.assertEqual([round(40 * v.value) for v in verdicts], [1, 2, 3])
        self.assertEqual([v.met() for v in verdicts], [True, True, False], "2 of 40 hours are allowed")
        found = glare.quantities()
        np.testing.assert_allclose(found["DGP above 0.40"][0], [1 / 40, 2 / 40])
        np.testing.assert_allclose(found["DGP exceeded in 5% of the hours"][0], [0.2, 0.36], err_msg="exceeded in 2 of 40 hours")


class Hours(InAFolder):
    def sky(self, row):
        """The sky and the sun of an hour as a scene."""
        altitude, azimuth = sun_position(*row[:3], *PLACE)
        by_sky, by_sun, parameters = light_of(row, altitude)
        sun = np.array([np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)])
        directions, solid_angles = patches(8)
        up = np.maximum(0, directions[:, 2])
        scale = by_sky / (relative_luminances(parameters, np.arccos(directions @ sun), directions[:, 2]) @ (solid_angles * up))
        ground = 0.2 * (by_sky + by_sun * sun[2]) / np.pi
        cal = self.file(PEREZ, "perez.cal")
        numbers = " ".join(f"{x:.9g}" for x in (scale / 179, ground / 179, *parameters, *sun))
        disk = by_sun / (2 * np.pi * (1 - np.cos(np.radians(0.533 / 2)))) / 179
        return (f"void light solar 0 0 3 {disk} {disk} {disk}\nsolar source sun 0 0 4 {sun[0]} {sun[1]} {sun[2]} .533\n" * (by_sun > 0) +
                f"void brightfunc light 2 sky {cal} 0 10 {numbers}\nlight glow g 0 0 4 1 1 1 0\ng source all 0 0 4 0 0 1 360\n")

    def test_single_hours(self):
        """DGP of an hour is that of rsphere -Su with the sky of the hour, within .01; also where the sun is in view, and with blinds."""
        room = self.file(ROOM, "room.rad")
        eyes = np.array([[2, 2.5, 1.2, 0, -1, 0], [2.2, 2.2, 1.2, -0.6, -0.8, 0]])
        for shades, hours in (((), HOURS), (("pane=0.1",), HOURS[3:])):
            weather = Weather([list(row) for row in hours], 0, PLACE)
            groups = [group_of(word, read_polygons([room]), eyes[:, :3]) for word in shades]
            settings = Settings(bounces=4, divisions=512, sun_divisions=128, seasons=7, hours=1)
            light = Light([room], np.array([[2, 2, 0.8, 0, 0, 1.0]]), np.ones(1), weather, groups, self.folder.name, settings, eyes)
            for _ in range(2):
                light.add()
            with unittest.mock.patch("rsphere.annual.glare.DIVISIONS", 32):
                glare = Glare([room], eyes, weather, groups, self.folder.name, light)
            lowered = np.zeros(len(hours), int) if light.states is None else light.states[:, 0]
            self.assertEqual(lowered.any(), bool(shades))
            for h, row in enumerate(hours):
                blinds = groups[0].lowered if lowered[h] else ""
                scene = rsphere.Scene([self.file(self.sky(row) + blinds, "sky.rad"), room])
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    wanted = scene.glare(eyes[:, :3], eyes[:, 3:], directions=1024, ambient_bounces=4)
                for i in range(len(eyes)):
                    found = dgp(glare.lux[1].mean(axis=0)[i, h], glare.weights[i][1][h])
                    self.assertAlmostEqual(found, wanted.dgp[i], delta=0.01, msg=f"{row} eye {i} {shades}")
        self.assertLess(glare.share_above(0.35, 1)[0].max(), glare.share_above(0.35, 0)[0].max(), "blinds help")

    def test_commands(self):
        self.file("0 0 1 0 0 1\n", "up.txt")
        with open(os.path.join(self.folder.name, "w.wea"), "w", encoding="ascii") as stream:
            stream.write("place X\nlatitude 47\nlongitude -15\ntime_zone -15\nsite_elevation 0\nweather_data_file_units 1\n")
            stream.writelines(" ".join(f"{x:g}" for x in row) + "\n" for row in HOURS)
        room = self.file(ROOM, "room.rad")
        before = os.getcwd()
        os.chdir(self.folder.name)
        self.addCleanup(os.chdir, before)
        for words, said in ((["--glare"], "--glare needs --eyes FILE"), (["--glare", "--eyes", "up.txt"], "up.txt: has a gaze straight up or down")):
            run = run_here([built("rsphere-annual"), "--weather", "w.wea", "--spacing", "2", *words, room])
            self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (1, "", 1), run.stderr)
            self.assertIn(said, run.stderr)
        self.file("2 2.5 1.2 0 -1 0\n", "eyes.txt")
        run = run_here([built("rsphere-annual"), "--weather", "w.wea", "--spacing", "2", "-d", "16", "-e", "2", "--shades", "pane", "--eyes", "eyes.txt", "--glare", room])
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"DGP exceeded in 5% of the hours: 0\.[0-9]{2} \+- 0\.[0-9]{2}, mean of the eyes")
        self.assertRegex(run.stdout, r"protection from glare: .*:\nDGP above 0\.45: minimum +at most 5% of the hours +[0-9.]+% +[0-9.]+ +(yes|no)")


if __name__ == "__main__":
    unittest.main()
