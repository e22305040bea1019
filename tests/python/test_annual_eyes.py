"""rsphere.annual.alpha_opic: light at eyes by the observers of CIE S 026, against closed forms and rsphere's own curves."""
import os
import subprocess
import unittest

import numpy as np

import rsphere
from rsphere.annual.alpha_opic import BANDS, MELANOPIC, OBSERVERS, SHARES, by_observers, melanopic_year, quantities_of_eyes, verdicts_of_eyes
from rsphere.annual.light import Light
from rsphere.annual.passes import Settings
from rsphere.annual.verdicts import Year
from rsphere.annual.weather import Weather
from run_here import InAFolder, built

SETTINGS = Settings(bounces=2, divisions=256, sun_divisions=64, seasons=3, hours=2)
HOURS = [(6, 21, hour + 0.5, 400, 120) for hour in range(6, 18)]
# D65, means of the bands, from the table of CIE 15 at steps of 5 nm.
D65 = np.array([60.85, 62.17, 69.12, 70.48, 72.33, 80.76, 80.99, 84.49, 89.23, 90.79, 97.11, 103.12, 106.14, 107.44, 110.72, 115.86, 114.17, 92.92, 89.79, 60.51])


class Eyes(InAFolder):
    def light(self, text, eyes, sensors=((0, 0, 1, 0, 0, 1),), estimates=2):
        sensors = np.array(sensors, float)
        light = Light([self.file(text, "room.rad")], sensors, np.full(len(sensors), 1 / len(sensors)), Weather(HOURS, 0, [47.0, 15.0, 15.0]), [],
                      self.folder.name, SETTINGS, np.array(eyes, float))
        for _ in range(estimates):
            light.add()
        return light

    GROUND = "void plastic grass 0 0 5 {} 0 0\ngrass ring ground 0 0 8 0 0 0 0 0 1 0 1000\n"

    def test_shares(self):
        """Each observer's shares are 1 together; those of S cones are short waves, and the first band is that of 760 to 780 nm."""
        np.testing.assert_allclose(SHARES.sum(axis=1), 1, atol=5e-6)
        middle = SHARES @ (770 - 20 * np.arange(BANDS))
        self.assertEqual([OBSERVERS[i].split("-")[0].split()[0] for i in np.argsort(middle)], ["S", "melanopic", "rhodopic", "M", "illuminance", "L"])

    def test_curves_of_the_program(self):
        """Shares divided by D65 are the curves of rsphere's -pY, whose table is shifted as RADIANCE's is, and of -pE."""
        curves = SHARES / D65
        curves /= curves.sum(axis=1)[:, None]
        text = "".join(f"void glow {c} 0 0 4 {c == 'r':d} {c == 'g':d} {c == 'b':d} 0\n{c} sphere s{c} 0 0 4 {x} 0 0 .5\n" for x, c in ((0, "r"), (2, "g"), (4, "b")))
        scene = rsphere.Scene(self.file(text + "void light l 0 0 3 1 1 1\nl source l 0 0 4 0 0 -1 1\n"))
        bands = scene.trace([[x, 0, 2, 0, 0, -1] for x in (0, 2, 4)], arguments=["-cs", str(BANDS), "-co"]).value
        self.assertEqual(bands.sum(axis=0).tolist(), [1] * BANDS)
        for observer, option in enumerate(("-pY", "-pEsc", "-pEmc", "-pElc", "-pErh", "-pEmel")):
            found = scene.trace([[x, 0, 2, 0, 0, -1] for x in (0, 2, 4)], arguments=["-cs", str(BANDS), option]).value
            np.testing.assert_allclose(bands @ curves[observer], found / found.sum(), atol=0.015 if option == "-pY" else 0.004, err_msg=option)

    def test_daylight_without_colors(self):
        """D65 gives EDI equal to lux in all five, at any gaze."""
        light = self.light(self.GROUND.format(".3 .3 .3"), [(0, 0, 1, 0, 0, -1), (0, 0, 1, 1, 0, 0), (0, 0, 1, 0, -0.6, 0.8)])
        lux = light.at_eyes.reshape(-1, len(OBSERVERS), 3, len(light.daylight.sun))
        self.assertGreater(lux.min(), 100)
        np.testing.assert_allclose(lux, np.broadcast_to(lux[:, :1], lux.shape), rtol=2e-5)

    def test_colored_ground(self):
        """An eye that looks down on a wide ground gets its reflectance in each band times the global illuminance."""
        light = self.light(self.GROUND.format(".1 .3 .6"), [(0, 0, 0.01, 0, 0, -1)], estimates=4)
        d = light.daylight
        middle = 770 - 20 * np.arange(BANDS)
        reflectance = np.where(middle > 588, 0.1, np.where(middle > 480, 0.3, 0.6))
        wanted = (d.diffuse + d.sun * d.to_sun[:, 2]).sum() * (SHARES @ reflectance)
        found = light.at_eyes.mean(axis=0).sum(axis=1)
        np.testing.assert_allclose(found / found[0], wanted / wanted[0], rtol=1e-3)
        np.testing.assert_allclose(found, wanted, rtol=0.02)
        self.assertGreater(found[MELANOPIC] / found[0], 1.2)

    def test_sensors_are_as_without_eyes(self):
        text, sensors = self.GROUND.format(".1 .3 .6"), [(0, 0, 1, 0, 0, 1), (0, 0, 1, 0, 1, 0)]
        with_eyes, without = self.light(text, [(0, 0, 1, 1, 0, 0)], sensors), self.light(text, np.zeros((0, 6)), sensors)
        np.testing.assert_array_equal(with_eyes.year.lux, without.year.lux)
        np.testing.assert_array_equal(with_eyes.year.direct, without.year.direct)
        self.assertEqual(without.at_eyes.shape[1], 0)

    def test_order_of_observers(self):
        value = np.arange(2 * 3 * BANDS, dtype=float).reshape(2, 3, BANDS)
        np.testing.assert_allclose(by_observers(value)[2 * MELANOPIC + 1, 2], value[1, 2] @ SHARES[MELANOPIC])

    def test_limits(self):
        """Shares of eyes with 150 and 275 lx of melanopic EDI in half of the hours: the limits and half of the hours are enough."""
        rows = np.array([(6, 1 + i, 12.5) for i in range(4)])
        melanopic = np.array([[150, 150, 0, 0], [149.9, 150, 0, 0], [275, 275, 150, 150], [274.9, 275, 149, 149]])
        lux = np.full((1, len(OBSERVERS), 4, 4), 1e4)
        lux[0, MELANOPIC] = melanopic
        lux = lux.reshape(1, -1, 4)
        year = Year(rows, None, None, None, np.ones(4), np.ones(4), None, 4, 4)
        verdicts = list(verdicts_of_eyes(melanopic_year(year, lux)))
        self.assertEqual([v.value for v in verdicts], [3 / 4, (2 + 1 + 4 + 2) / 16, 1 / 4, 3 / 16])
        self.assertFalse(any(v.hangs() for v in verdicts))
        found = quantities_of_eyes(year, lux)
        np.testing.assert_allclose(found["mean melanopic EDI"][0], melanopic.mean(axis=1))
        np.testing.assert_allclose(found["melanopic EDI of 150 lx"][0], [0.5, 0.25, 1, 0.5])
        self.assertEqual(len(found), len(OBSERVERS) + 2)

    def test_command(self):
        with open(os.path.join(self.folder.name, "w.wea"), "w", encoding="ascii") as stream:
            stream.write("place X\nlatitude 47\nlongitude -15\ntime_zone -15\nsite_elevation 0\nweather_data_file_units 1\n")
            stream.writelines(" ".join(f"{x:g}" for x in row) + "\n" for row in HOURS)
        self.file(self.GROUND.format(".1 .3 .6").replace("ring ground 0 0 8 0 0 0 0 0 1 0 1000", "polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0"), "room.rad")
        self.file("0 0 1 0 1 0\n1 0 1 0 0 -1\n", "eyes.txt")
        self.file("0 0 1 0 0 0\n", "blind.txt")
        command = [built("rsphere-annual"), "--weather", "w.wea", "-d", "16", "-e", "2", "--spacing", "9", "room.rad", "--eyes"]
        run = subprocess.run([*command, "eyes.txt"], cwd=self.folder.name, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, r"mean S-cone-opic EDI: [0-9.]+ lx \+- [0-9.]+, mean of the eyes")
        self.assertRegex(run.stdout, r"CIE S 026:2018, melanopic EDI at eyes .*:\neyes with 150 lx in half of the hours +100\.0% +0\.0 +0\n")
        with open(os.path.join(self.folder.name, "annual/eyes.txt"), encoding="utf-8") as stream:
            self.assertEqual([line.split("\t")[:6] for line in stream][1:], [["0", "0", "1", "0", "1", "0"], ["1", "0", "1", "0", "0", "-1"]])
        for file, said in (("blind.txt", "blind.txt:1: the direction of an eye must not be 0 0 0"), ("none.txt", "none.txt: cannot be read")):
            run = subprocess.run([*command, file], cwd=self.folder.name, capture_output=True, text=True, check=False)
            self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (1, "", 1), run.stderr)
            self.assertIn(said, run.stderr)


if __name__ == "__main__":
    unittest.main()
