"""The module rsphere: the same bytes as the commands, arrays, exceptions, warnings, threads, Ctrl-C.

test_rsphere.py PROGRAMS: the folder of rsphere and rtrace. PYTHONPATH has the folder of the module.
"""
import contextlib
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np

import rsphere

TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
ROOM = os.path.join(TESTS, "cli/same-bytes-interpolated/small_room.rad")
SPECTRAL = os.path.join(TESTS, "scenes/spectral/room.rad")
FURNACE = os.path.join(TESTS, "../examples/minimal/furnace.rad")
PROGRAMS = sys.argv.pop(1) if len(sys.argv) > 1 else "build/bin"


def command(program, options, records, scene=ROOM):
    """The numbers that the command writes for binary records."""
    words = [os.path.join(PROGRAMS, program), "-h", "-fdd", *options, scene]
    records = np.ascontiguousarray(records, dtype=np.float64)
    return subprocess.run(words, input=records.tobytes(), stdout=subprocess.PIPE, check=True).stdout


def some_rays(count=50):
    i = np.arange(count)
    position = np.stack([0.1 + i * 0.04, np.full(count, 1.3), 0.4 + i * 0.03], axis=1)
    return np.hstack([position, np.stack([np.cos(i), np.sin(i), np.cos(3 * i)], axis=1)])


POINTS = np.array([[0.5, 0.5, 1], [1.5, 2.5, 2], [2, 1, 0.3]])


class SameBytes(unittest.TestCase):
    def test_rays(self):
        scene = rsphere.Scene(ROOM)
        answers = scene.trace(some_rays(), ambient_bounces=2, ad=16, as_=0, aa=0.2, av=(0.1, 0.2, 0.1), outputs="vpl")
        found = np.hstack([answers.value, answers.point, answers.effective_length[:, None]])
        options = "-ab 2 -ad 16 -as 0 -aa 0.2 -av 0.1 0.2 0.1 -ovpl".split()
        self.assertEqual(found.tobytes(), command("rtrace", options, some_rays()))

    def test_points(self):
        scene = rsphere.Scene([ROOM])
        answers = scene.sphere(POINTS, ambient_bounces=1, directions=256, most_directions=600, rotation=3)
        columns = [
            answers.mean,
            answers.mean_standard_error,
            answers.scalar_irradiance,
            answers.cylindrical_irradiance,
            answers.face_irradiance.reshape(3, 18),
            answers.light_vector,
            answers.directions[:, None].astype(float),
        ]
        options = "-ab 1 -Sn 256 -Sx 600 -Sr 3 -oveECHuk".split()
        self.assertEqual(np.hstack(columns).tobytes(), command("rsphere", options, POINTS))
        self.assertIsNone(answers.point)
        self.assertEqual(answers.directions.dtype, np.int64)

    def test_switches_and_words(self):
        scene = rsphere.Scene(ROOM)
        answers = scene.trace(some_rays(), I=True, dv=False, threads=3, arguments=["-ab", "1", "-pY"])
        self.assertEqual(answers.value.shape, (50,))
        options = "-I -dv- -ab 1 -pY".split()
        self.assertEqual(answers.value.tobytes(), command("rtrace", options, some_rays()))

    def test_bands(self):
        scene = rsphere.Scene(SPECTRAL)
        answers = scene.trace(some_rays(), cs=8, co=True)
        self.assertEqual(answers.value.shape, (50, 8))
        self.assertEqual(answers.value.tobytes(), command("rtrace", "-cs 8 -co".split(), some_rays(), SPECTRAL))
        points = scene.sphere(POINTS, cs=8, co=True, directions=128, most_directions=300)
        self.assertEqual(points.mean_standard_error.shape, (3, 8))
        self.assertEqual(points.face_irradiance.shape, (3, 6, 8))
        self.assertEqual(scene.trace(some_rays(), cs=8).value.shape, (50, 3))


class Contributors(unittest.TestCase):
    def test_importance(self):
        scene = rsphere.Scene(ROOM)
        goals = ["steel", "wall"]
        answers = scene.importance(POINTS, goals, ambient_bounces=1, directions=128, bins=6)
        self.assertEqual(answers.contributors, goals)
        self.assertEqual(answers.mean.shape, (3, 2, 3))
        self.assertEqual(answers.mean_standard_error.shape, (3, 2, 3))
        self.assertEqual(answers.face_irradiance.shape, (3, 2, 6, 3))
        self.assertEqual(answers.light_vector.shape, (3, 2, 3))
        self.assertEqual(answers.bins.shape, (3, 2, 6, 3))
        self.assertEqual(answers.bins_standard_error.shape, (3, 2, 6, 3))
        self.assertEqual(answers.directions.shape, (3,))
        np.testing.assert_allclose(answers.bins.mean(axis=2), answers.mean, rtol=1e-9)
        options = "-ab 1 -Sn 128 -Sg steel -Sg wall -Sp -oH".split()
        self.assertEqual(answers.face_irradiance.tobytes(), command("rsphere", options, POINTS))
        self.assertEqual(scene.importance(POINTS, ["wall"], directions=64, arguments=["-pY"]).mean.shape, (3, 1))
        for goals in ([], ["wall", "wall"], ["none"]):
            with self.assertRaises(rsphere.Error):
                scene.importance(POINTS, goals)

    def test_importance_of_sensors(self):
        scene = rsphere.Scene(ROOM)
        sensors = np.array([[1, 1, .8, 0, 0, 1], [1, 2, 1.2, 1, 0, 0]])
        answers = scene.importance(POINTS, sensors, ambient_bounces=1, directions=128, bins=6)
        self.assertEqual(answers.contributors, ["sensor1", "sensor2"])
        self.assertEqual(answers.bins.shape, (3, 2, 6, 3))
        one = scene.importance(POINTS, sensors[:1].tolist(), ambient_bounces=1, directions=128)
        self.assertEqual(one.mean.shape, (3, 1, 3))
        for goals in ("wall", [[1, 2, 3]], 7):
            with self.assertRaises((TypeError, ValueError)):
                scene.importance(POINTS, goals)
        with self.assertRaisesRegex(rsphere.Error, "sensor 1: the direction that it faces is 0 0 0"):
            scene.importance(POINTS, [[1, 1, 1, 0, 0, 0]])

    def test_lamps(self):
        scene = rsphere.Scene(ROOM)
        whole = scene.sphere(POINTS, directions=64)
        self.assertIsNone(whole.contributors)
        self.assertIsNone(whole.bins)
        parts = scene.sphere(POINTS, directions=64, Sp=True)
        self.assertEqual(parts.contributors, ["bulb"])
        np.testing.assert_allclose(parts.mean.sum(axis=1), whole.mean, rtol=1e-9)

    def test_contributions_of_sources_drawn_at_random(self):
        """With -Ss, a drawn source stands for those that are not: its contribution was that of one shadow ray alone."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "lamps.rad")
            with open(path, "w", encoding="ascii") as stream:
                stream.write("void light l 0 0 3 1 1 1\nl sphere a 0 0 4 0 0 2 .1\nvoid light m 0 0 3 1 1 1\nm sphere b 0 0 4 1 0 2 .1\n"
                             "void plastic p 0 0 5 .5 .5 .5 0 0\np polygon f 0 0 12 -5 -5 0 5 -5 0 5 5 0 -5 5 0\n")
            scene = rsphere.Scene(path)
        rays = [[x, y, 1, 0, 0, -1] for x in np.linspace(-.5, .5, 64) for y in np.linspace(-.5, .5, 64)]
        every, drawn = (scene.contributions(rays, ["l", "m"], samples=1, ambient_bounces=0, Ss=n).value.mean(axis=(0, 2, 3)) for n in (0, 1))
        np.testing.assert_allclose(drawn, every, rtol=.02)
        self.assertGreater(every.min(), 1e-4)

    def test_contributions(self):
        scene = rsphere.Scene(ROOM)
        rays = some_rays(12)
        one = scene.contributions(rays, ["bulb", "none"], samples=1, ambient_bounces=1, ad=8, u=True)
        self.assertEqual(one.value.shape, (12, 2, 1, 3))
        self.assertIsNone(one.standard_error)
        options = "-V+ -ab 1 -ad 8 -m bulb -m none".split()
        self.assertEqual(one.value.tobytes(), command("rcontrib", options, rays))
        divided = scene.contributions(rays, ["bulb"], bins=9, samples=4, ambient_bounces=1, ad=8)
        self.assertEqual((divided.value.shape, divided.standard_error.shape), ((12, 1, 9, 3), (12, 1, 9, 3)))
        by_function = {"expression": "if(Dz,1,0)", "count": 2}
        halves = scene.contributions(rays, ["bulb"], bins=by_function, samples=1, ambient_bounces=1, ad=8, u=True)
        np.testing.assert_allclose(halves.value.sum(axis=2), one.value[:, :1, 0], rtol=1e-9, atol=1e-12)
        accurate = scene.contributions(rays[:3], ["bulb"], accuracy=.1, ad=8)
        errors = accurate.standard_error[:, 0, 0, 1] / np.maximum(accurate.value[:, 0, 0, 1], 1e-9)
        self.assertTrue(np.all(errors < .15), errors)
        with self.assertRaises(TypeError):
            scene.contributions(rays, ["bulb"], bins={"expresion": "0"})
        with self.assertRaises(TypeError):
            scene.contributions(rays, ["bulb"], bins="Dz")
        with self.assertRaises(rsphere.Error):
            scene.contributions(rays, ["bulb"], samples=0)

    def test_zones(self):
        middles = rsphere.zone_middles(33)
        np.testing.assert_allclose(np.linalg.norm(middles, axis=1), 1)
        for count, error, words in ((0, ValueError, "count must be at least 1, not 0"), (-1, ValueError, "at least 1, not -1"),
                                    (2.5, TypeError, "count must be a whole number .* not 2.5"), (10**12, TypeError, "below 2147483648"), ("a", TypeError, "not 'a'")):
            with self.assertRaisesRegex(error, words):
                rsphere.zone_middles(count)

    def test_bins_of_directions(self):
        scene = rsphere.Scene(ROOM)
        points = [[0.5, 1.3, 1.2], [0.9, 1.3, 1.2]]
        halves = {"parameters": "limit=0", "expression": "if(Dz-limit,0,1)", "count": 2}
        found = scene.sphere(points, bins=halves, ambient_bounces=1, directions=64)
        np.testing.assert_allclose(found.bins_solid_angle, 2 * np.pi, rtol=1e-6)
        np.testing.assert_allclose(found.bins.mean(axis=1), found.mean, rtol=1e-6)
        self.assertTrue((found.bins_standard_error > 0).all())
        options = ["-Szb", "if(Dz,0,1)", "-Szn", "2", "-ab", "1", "-Sn", "64", "-oz"]
        self.assertEqual(found.bins.tobytes(), command("rsphere", options, points))
        zones = scene.sphere(points, bins=5, directions=64)
        np.testing.assert_allclose(zones.bins_solid_angle, [4 * np.pi / 5] * 5)
        with self.assertRaises(rsphere.Error):
            scene.sphere(points, bins={"expression": "Px", "count": 2})


class Glare(unittest.TestCase):
    EYES = np.array([[0.5, 1.3, 1.2], [0.9, 1.3, 1.2], [1.3, 1.3, 1.2], [1.5, 1.0, 1.0]])
    GAZES = np.array([[1, 0, 0.5], [0, 1, 0.5], [-1, 0.2, 0], [0.3, -1, 0.5]])

    def test_is_that_of_the_command(self):
        scene = rsphere.Scene(ROOM)
        answers = scene.glare(self.EYES, self.GAZES, ambient_bounces=1, directions=64)
        columns = "ugr illuminance background dgp".split()
        found = np.stack([getattr(answers, c + e) for c in columns for e in ("", "_standard_error")], axis=1)
        records = np.hstack([self.EYES, self.GAZES])
        options = "-Su -ab 1 -Sn 64".split()
        self.assertEqual(found.tobytes(), command("rsphere", [*options, "-ouUvVbBgG"], records))
        np.testing.assert_array_equal(answers.threshold, [2000] * 4)
        rows = [
            np.column_stack([s.direction, s.luminance, s.luminance_standard_error, s.solid_angle,
                             s.solid_angle_standard_error, s.position_index])
            for s in answers.sources
        ]
        self.assertEqual(np.vstack(rows).tobytes(), command("rsphere", [*options, "-Sd", "-odlLwWp"], records))
        self.assertEqual(len(answers.sources), 4)
        names = [name for s in answers.sources for name in s.surface]
        self.assertEqual(len(names), sum(map(len, rows)))
        self.assertLessEqual({"lamp1", "lamp2"}, set(names))

    def test_one_gaze_for_all(self):
        scene = rsphere.Scene(ROOM)
        options = {"ab": 1, "directions": 64, "Sub": 5, "Sut": (30, 20), "outputs": "ut"}
        one = scene.glare(self.EYES, [0, 1, 0], **options)
        all_ = scene.glare(self.EYES, np.tile([0, 1, 0], (4, 1)), **options)
        np.testing.assert_array_equal(one.ugr, all_.ugr)
        np.testing.assert_array_equal(one.threshold, all_.threshold)
        self.assertIsNone(one.dgp)
        for gazes in ([0, 1], np.zeros((3, 3)), [[0, 1, 0]], np.zeros((4, 2))):
            with self.assertRaises(ValueError):
                scene.glare(self.EYES, gazes)
        with self.assertRaises(ValueError):
            scene.glare([0, 1, 2], [0, 1, 0])
        with self.assertRaises(rsphere.Error):
            scene.glare(self.EYES, [0, 0, 1])
        nobody = scene.glare(np.empty((0, 3)), [0, 1, 0])
        self.assertEqual((nobody.ugr.shape, nobody.sources), ((0,), []))


class Arrays(unittest.TestCase):
    def test_other_layouts_and_types(self):
        scene = rsphere.Scene(ROOM)
        wanted = scene.trace(some_rays()).value
        np.testing.assert_array_equal(scene.trace(np.asfortranarray(some_rays())).value, wanted)
        np.testing.assert_array_equal(scene.trace(some_rays().tolist()).value, wanted)
        np.testing.assert_array_equal(scene.trace(some_rays(100)[::2][:3]).value, scene.trace(some_rays(6)[::2]).value)

    def test_names(self):
        answers = rsphere.Scene(ROOM).trace([[1.5, 1.5, 2, 0, 0, 1], [9, 9, 9, 1, 0, 0]], outputs="smL")
        self.assertEqual(answers.surface.tolist(), ["ceiling", "*"])
        self.assertEqual(answers.modifier.tolist(), ["wall", "*"])
        self.assertEqual(answers.first_length.tolist(), [0.5, 1e10])
        self.assertIsNone(answers.value)

    def test_no_records(self):
        scene = rsphere.Scene(ROOM)
        self.assertEqual(scene.trace(np.empty((0, 6))).value.shape, (0, 3))
        self.assertEqual(scene.sphere(np.empty((0, 3))).face_irradiance.shape, (0, 6, 3))

    def test_answers_outlive_the_scene(self):
        answers = rsphere.Scene(ROOM).trace([[1.5, 1.5, 2, 0, 0, 1]], outputs="p")
        np.testing.assert_array_equal(answers.point, [[1.5, 1.5, 2.5]])

    def test_photometric(self):
        scene = rsphere.Scene(ROOM)
        colors = scene.sphere(POINTS, directions=64, outputs="EH")
        lux = scene.sphere(POINTS, directions=64, outputs="EH", arguments=["-pY"])
        np.testing.assert_allclose(rsphere.photometric(colors.scalar_irradiance), lux.scalar_irradiance, rtol=1e-12)
        np.testing.assert_allclose(rsphere.photometric(colors.face_irradiance), lux.face_irradiance, rtol=1e-12)
        self.assertAlmostEqual(float(rsphere.photometric([1, 1, 1])), rsphere.LUMENS_PER_WATT)
        for color, error, words in ((1.0, ValueError, r"shape \(..., 3\), not \(\)"), ([1, 2], ValueError, r"not \(2,\)"), (None, TypeError, "not requested are None"),
                                    ([[True] * 3], TypeError, "color must be numbers"), ("a", (TypeError, ValueError), "float")):
            with self.assertRaisesRegex(error, words):  # a number gave the weights of the colors
                rsphere.photometric(color)

    def test_the_standard_error_is_that_of_repeats(self):
        scene = rsphere.Scene(ROOM)
        repeats = [scene.sphere(POINTS[:1], ab=1, Sn=256, Sx=512, Sr=i) for i in range(1, 31)]
        spread = np.std([r.mean[0, 1] for r in repeats], ddof=1)
        stated = np.sqrt(np.mean([r.mean_standard_error[0, 1] ** 2 for r in repeats]))
        # The spread of 30 repeats is known to 13%, and the estimate errs to the safe side.
        self.assertGreater(stated, 0.65 * spread)
        self.assertLess(stated, 2.5 * spread)


class Faults(unittest.TestCase):
    def test_place(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "room.rad")
            with open(path, "w") as file:
                file.write("void plastic grey 0 0 5 .5 .5 .5 0 0\n\nwall sphere ball 0 0 4 0 0 0 1\n")
            with self.assertRaises(rsphere.Error) as caught:
                rsphere.Scene([path])
        error = caught.exception
        self.assertTrue(str(error).startswith(path + ':3: undefined modifier "wall"'), str(error))
        self.assertEqual((error.file, error.line, error.cause), (path, 3, "input"))

    def test_system(self):
        with self.assertRaises(rsphere.Error) as caught:
            rsphere.Scene("/no/such/room.rad")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.cause), ("/no/such/room.rad", None, "system"))

    def test_options(self):
        scene = rsphere.Scene(FURNACE)
        for options, text in [
            ({"qq": 3}, r"option '-qq': there is no such option; see help\(rsphere.Scene\)$"),
            ({"abb": 3}, "option '-abb': there is no such option; the nearest is \"-ab\"; see help"),
            ({"ab": "x"}, "option '-ab': \"x\" is not a whole number"),
            ({"av": [1, 2]}, "option '-av': 1 of its 3 values are missing"),
            ({"av": [1, 2], "ad": 5}, "option '-av': 1 of its 3 values are missing .*: -ad follows"),
            ({"M": "a\0b"}, r'the option "a\\x00b" contains a NUL byte'),
            ({"arguments": ["-Sg", "goal"]}, "option '-Sg': "),
        ]:
            with self.assertRaisesRegex(rsphere.Error, "^" + text):
                scene.trace([[0, 0, 0, 1, 0, 0]], **options)
        with self.assertRaisesRegex(TypeError, r"^'ambient_bounce' is not an option; help\(rsphere.Scene\) lists"):
            scene.sphere([[0, 0, 0]], ambient_bounce=3)
        for name in ["foo", "out", "f1", "time"]:  # not -f oo, -o ut and -ti me
            with self.assertRaisesRegex(TypeError, f"^'{name}' is not an option; help"):
                scene.trace([[0, 0, 0, 1, 0, 0]], **{name: 1})
        for short in [{"ab": 1}, {"as_": 1, "ambient_super_samples": 0}]:
            with self.assertRaisesRegex(TypeError, "are the same option: give one of them$"):
                scene.trace([[0, 0, 0, 1, 0, 0]], ambient_bounces=0, **short)
        with self.assertRaisesRegex(TypeError, "^threads has a value of the wrong type: 'x'"):
            scene.sphere([[0, 0, 0]], threads="x")

    def test_missing_and_wrong_arguments(self):
        # These used to be answered with the signature of a function of the binding.
        scene, rays, points = rsphere.Scene(ROOM), some_rays(2), [[2, 2, 1]]
        for call, text in [
            (lambda: scene.trace(), r"^trace\(\) needs rays: an array of shape \(n, 6\)$"),
            (lambda: scene.sphere(), r"^sphere\(\) needs points: "),
            (lambda: scene.importance(points), r"^importance\(\) needs goals: a list of modifiers, or sensors"),
            (lambda: scene.glare(points), r"^glare\(\) needs gazes: the directions in which the eyes look"),
            (lambda: scene.glare(gazes=[0, 1, 0]), r"^glare\(\) needs eyes: "),
            (lambda: scene.contributions(rays), r"^contributions\(\) needs of: the modifiers that contribute"),
            (lambda: scene.contributions(rays, of="bulb"), r"^of must be a list: \['bulb'\]$"),
            (lambda: scene.contributions(rays, of=["bulb", 1]), r"^of must be a list of modifiers: "),
            (lambda: scene.contributions(rays, of=1), r"^of must be a list of modifiers: "),
            (lambda: scene.importance(points, goals="desk"), r"^goals must be a list: \['desk'\]$"),
            (lambda: scene.contributions(rays, of=["bulb"], values=False), r"gives values unless coefficients=True"),
            (lambda: scene.contributions(rays, of=["bulb"], samples="8"), r"^samples must be a whole number .*, not '8'$"),
            (lambda: scene.contributions(rays, of=["bulb"], samples=2.5), r"^samples must be a whole number .*, not 2\.5$"),
            (lambda: scene.contributions(rays, of=["bulb"], samples=2**40), r"^samples must be a whole number below 2147483648"),
            (lambda: scene.contributions(rays, of=["bulb"], samples=True), r"^samples must be a whole number .*, not True$"),
            (lambda: scene.contributions(rays, of=["bulb"], coefficients="no"), r"^coefficients must be True or False, not 'no'$"),
            (lambda: scene.contributions(rays, of=["bulb"], coefficients=None), r"^coefficients must be True or False, not None$"),
            (lambda: scene.trace(rays, irradiance=None), r"^'irradiance' is not an option"),
            (lambda: rsphere.Scene(), r"^Scene\(\) needs files: "),
            (lambda: rsphere.Scene(ROOM, ROOM), r"^Scene\(\) takes several files as one list: "),
            (lambda: rsphere.Scene(5), r"^expected str, bytes or os.PathLike object, not int$"),
            (lambda: rsphere.Scene(ROOM, commands="no"), r"^commands must be True or False, not 'no'$"),
            (lambda: rsphere.Scene(ROOM, goals="desk"), r"^goals must be a list: \['desk'\]$"),
            (lambda: rsphere.Scene(ROOM, goals=5), r"^goals must be a list of modifiers: "),
            (lambda: scene.trace(rays, values=False), r"^'values' is not an option; help\(rsphere.Scene\) lists"),
        ]:
            with self.assertRaisesRegex(TypeError, text):
                call()

    def test_a_scene_without_files(self):
        # It used to end the process.
        with self.assertRaisesRegex(TypeError, "^the Scene has no files"):
            rsphere.Scene.__new__(rsphere.Scene).trace([[0, 0, 0, 1, 0, 0]])
        with self.assertRaisesRegex(TypeError, "^this method belongs to a Scene"):
            rsphere.Scene.sphere(5, [[0, 0, 0]])
        with self.assertRaisesRegex(rsphere.Error, r'^the file name "a\\x00.rad" contains a NUL byte'):
            rsphere.Scene("a\0.rad")

    def test_records(self):
        scene = rsphere.Scene(FURNACE)
        # The imaginary parts and the mask used to be dropped.
        with self.assertRaisesRegex(TypeError, "^points must be real numbers, not complex"):
            scene.sphere(np.array([[0, 0, 1j]]))
        # Truth values and dates used to be taken as numbers.
        for wrong in np.zeros((1, 3), bool), np.zeros((1, 3), "M8[s]"), np.zeros((1, 3), "m8[s]"):
            with self.assertRaisesRegex(TypeError, "^points must be numbers, not truth values or dates"):
                scene.sphere(wrong)
        with self.assertRaisesRegex(TypeError, "^points must not be a masked array"):
            scene.sphere(np.ma.array([[0, 0, 1.0]], mask=[[0, 0, 1]]))
        with self.assertRaisesRegex(ValueError, r"^points must be an array of shape \(n, 3\)"):
            scene.sphere([[0, 0, 0, 1]])
        with self.assertRaisesRegex(rsphere.Error, r"^points\[1\]: nan is not a finite number"):
            scene.sphere([[0, 0, 0], [0, np.nan, 0]])

    def test_untrusted(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.rad")
            with open(path, "w") as file:
                file.write("!echo void plastic grey 0 0 5 .5 .5 .5 0 0\n")
            rsphere.Scene(path)
            with self.assertRaises(rsphere.Error) as caught:
                rsphere.Scene(path, commands=False)
            self.assertEqual(caught.exception.line, 1)

    def test_warnings(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "dark.rad")
            with open(path, "w") as file:
                file.write("void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey sphere ball 0 0 4 0 0 0 1\n")
            scene = rsphere.Scene(path)
            with self.assertWarnsRegex(UserWarning, "^no light sources found$"):
                scene.trace([[0, 0, 3, 0, 0, -1]])
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                with self.assertRaises(UserWarning):
                    scene.trace([[0, 0, 3, 0, 0, -1]], ab=1)


class Threads(unittest.TestCase):
    def test_modifiers_that_no_surface_has(self):
        scene = rsphere.Scene(FURNACE)
        ray = [[0, 0, 0, 0, 0, 1]]
        with self.assertWarnsRegex(UserWarning, 'no surface has the modifier "sopt"'):
            answers = scene.contributions(ray, of=["sopt"])
        self.assertEqual(np.abs(answers.value).sum(), 0)
        for name in ("void", "sopt"):
            with self.assertRaisesRegex(rsphere.Error, "no surface has the goal's modifier"):
                scene.importance([[0, 0, 0]], goals=[name])
        with self.assertRaisesRegex(rsphere.Error, "cannot track 'void' modifier"):
            scene.contributions(ray, of=["void"])
        with self.assertRaisesRegex(rsphere.Error, "bins need an expression"):
            scene.contributions(ray, of=["sopt"], bins={"files": ["reinhart.cal"]})

    def test_points_and_sensors_far_away(self):
        scene = rsphere.Scene(ROOM)
        far = [[0.5, 0.5, 1], [500, 500, 1000]]
        for ask in (
            lambda: scene.sphere(far, directions=64),
            lambda: scene.trace(np.hstack([far, far]), irradiance_at_origin=True),
            lambda: scene.glare(far, [1, 0, 0], directions=64),
            lambda: scene.contributions(np.hstack([far, far]), of=["wall"], irradiance_at_origin=True),
        ):
            with self.assertWarnsRegex(UserWarning, "1 of 2 .*; the first is index 1: check the units of the"):
                ask()

    def test_texts(self):
        """repr() printed pages of numbers, and help() had "points: object = None"."""
        answers = rsphere.Scene(FURNACE).sphere([[0, 0, 0]], directions=64)
        self.assertRegex(repr(answers), r"^rsphere\.Answers: mean \(1, 3\), mean_standard_error \(1, 3\), .*, directions \(1,\)$")
        for name in ("trace", "sphere", "importance", "glare", "contributions"):
            self.assertRegex(getattr(rsphere.Scene, name).__doc__, rf"^{name}\([a-z]+: array \(n, [36]\), [^\n]*\n")
            self.assertNotIn("object", getattr(rsphere.Scene, name).__doc__.split("\n")[0])

    def test_a_scene_keeps_its_files(self):
        scene = rsphere.Scene(FURNACE)
        for files in (["nosuch.rad"], ROOM):
            with self.assertRaisesRegex(TypeError, "this Scene has its files already"):
                scene.__init__(files)
        with self.assertRaisesRegex(TypeError, "needs files"):
            rsphere.Scene()
        self.assertIn("files: str | list[str]", rsphere.Scene.__init__.__doc__)

    def test_options_of_the_other_mode(self):
        scene = rsphere.Scene(FURNACE)
        with self.assertRaisesRegex(rsphere.Error, "option '-Sn': needs sphere mode"):
            scene.trace([[0, 0, 0, 0, 0, 1]], directions=10)
        with self.assertRaisesRegex(rsphere.Error, "option '-I': needs ray mode"):
            scene.sphere([[0, 0, 0]], irradiance_at_origin=True)

    def test_others_run_during_a_call(self):
        """While one thread computes, others count and compute: the lock of the interpreter is released."""
        scene = rsphere.Scene(ROOM)
        points = np.tile(POINTS, (40, 1))
        wanted = scene.sphere(points[:3], ab=1, threads=1, directions=256).mean
        done = threading.Event()
        found = {}

        def compute(name, count):
            found[name] = scene.sphere(points[:count], ab=1, threads=1, directions=256).mean
            if name == "long":
                done.set()

        threads = [threading.Thread(target=compute, args=("long", 120))]
        threads[0].start()
        steps = 0
        while not done.is_set():
            if steps == 5:
                threads.append(threading.Thread(target=compute, args=("short", 3)))
                threads[1].start()
            steps += 1
            time.sleep(0.001)
        for thread in threads:
            thread.join()
        self.assertGreater(steps, 10)
        np.testing.assert_array_equal(found["short"], wanted)
        np.testing.assert_array_equal(found["long"], np.tile(wanted, (40, 1)))

    def test_control_c(self):
        scene = rsphere.Scene(ROOM)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            scene.sphere(np.tile(POINTS, (100000, 1)), ab=2)
        timer.join()
        self.assertEqual(scene.sphere(POINTS, Sn=64).mean.shape, (3, 3))

    def test_control_c_while_the_last_record_is_answered(self):
        """It was a SystemError: the call returned its answers although the signal had raised an exception."""
        scene = rsphere.Scene(ROOM)
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            scene.sphere(POINTS[:1], Sn=6000, Sx=12000, ab=2)
            self.fail("the call took too little time")
        timer.join()


class Page(unittest.TestCase):
    """examples/python/README.md: its program runs, and what takes the place of rtrace has rtrace's numbers."""

    def test_program_and_lines(self):
        with open(os.path.join(TESTS, "../examples/python/README.md")) as file:
            page = file.read()
        programs = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertEqual(len(programs), 3)
        # Few directions: the page's figures are not compared.
        programs, calls = zip(*[
            re.subn(r"(scene\.(?:sphere|importance|glare)\(.*)\)$", r"\1, directions=128)", program, flags=re.M)
            for program in programs
        ])
        self.assertEqual(calls, (1, 1, 1))
        lines = re.findall(r"\| `([^|`]*scene\.trace[^|`]*)` \|$", page, re.M)
        self.assertEqual(len(lines), 6)
        rays, options = some_rays(), "-ab 1 -ad 32 -fdd -h".split()
        wanted = command("rtrace", ["-ab", "1", "-ad", "32"], rays)
        lux = command("rtrace", ["-ab", "1", "-ad", "32", "-I"], rays)
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as printed:
            os.chdir(folder)
            try:
                shutil.copy(ROOM, "room.rad")
                np.savetxt("grid.pts", rays, fmt="%s")
                names = {}
                exec(programs[0], names)  # pylint: disable=exec-used
                self.assertEqual(printed.getvalue().count("["), 8)
                with open("room.rad", "a") as room:
                    room.write("void alias desk1 wall\nvoid alias desk2 wall\n")
                    room.write("desk1 polygon a 0 0 12 .2 .2 .7 .8 .2 .7 .8 .8 .7 .2 .8 .7\n")
                    room.write("desk2 polygon b 0 0 12 2.2 .2 .7 2.8 .2 .7 2.8 .8 .7 2.2 .8 .7\n")
                names["scene"] = rsphere.Scene("room.rad")
                exec(programs[1], names)  # pylint: disable=exec-used
                self.assertIn("(2, 2, 12, 3) (2, 2, 12, 3)", printed.getvalue())
                exec(programs[2], names)  # pylint: disable=exec-used
                self.assertRegex(printed.getvalue(), "\nlamp2 ")
                shutil.copy(ROOM, "room.rad")
                values = {
                    "scene": rsphere.Scene("room.rad"),
                    "rsphere": rsphere,
                    "np": np,
                    "rays": rays,
                    "vecs": rays,
                    "text": "\n".join(" ".join(map(repr, row)) for row in rays.tolist()),
                    "options": options,
                    "args": " ".join(options),
                }
                pyradiance, sensors, frads, honeybee, raytraverse, process = [eval(line, values) for line in lines]
            finally:
                os.chdir(before)
        for found in (pyradiance, raytraverse, process):
            self.assertEqual(found.tobytes(), wanted)
        self.assertEqual(sensors.tobytes(), lux)
        self.assertEqual(frads.tobytes(), command("rtrace", "-av .31831 .31831 .31831".split(), rays))
        np.testing.assert_array_equal(honeybee, rsphere.photometric(sensors))

    def test_script(self):
        script = os.path.join(TESTS, "../examples/python/sensor_grid.py")
        with tempfile.TemporaryDirectory() as folder:
            output = os.path.join(folder, "grid.npz")
            words = [sys.executable, script, ROOM, "--corners", "0", "0", "3", "1.5", "--output", output, "--bounces", "1"]
            text = subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout.decode()
            with np.load(output) as arrays:
                lux, sensors = arrays["lux"], arrays["sensors"]
        self.assertEqual((lux.shape, sensors.shape), ((3, 6), (18, 6)))
        options = "-I -ab 1 -ad 1024 -as 512 -aa .1 -ar 64 -lw 1e-4".split()
        colors = np.frombuffer(command("rtrace", options, sensors)).reshape(18, 3)
        np.testing.assert_allclose(lux.ravel(), rsphere.photometric(colors), rtol=1e-12)
        self.assertRegex(text, rf"\naverage {lux.mean():.0f} lx, .*\neyes in the middle: cylindrical [1-9]")
        fault = subprocess.run([*words[:2], "/none.rad", *words[3:]], stderr=subprocess.PIPE, check=False)
        self.assertEqual(fault.returncode, 1)
        self.assertTrue(fault.stderr.startswith(b"sensor_grid.py: /none.rad: cannot open"), fault.stderr)


class Version(unittest.TestCase):
    def test_is_that_of_the_command(self):
        line = subprocess.run([os.path.join(PROGRAMS, "rsphere"), "-version"], stdout=subprocess.PIPE, check=True).stdout
        self.assertEqual(line.decode().split()[:2], ["rsphere", rsphere.__version__])


if __name__ == "__main__":
    unittest.main()
