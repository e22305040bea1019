"""rsphere-compare: its statistics, its report, and the options that it hands to the original."""
import os
import random
import unittest

from companions import compare_page
from companions.colors import Colors
from companions.command_line import LAMP, read_records
from companions.compare import COMPANION, rotated_directions, without_bogus
from companions.compare_page import MOST_MARKS, Subject, compare_plot
from companions.compare_report import difference_classes, differences_on_screen, equal_error_text, percent, verdict_text, warnings_text
from companions.comparison import DARKEST, Answers, Channel, Difference, Verdict, compare
from companions.original import is_octree, original_options
from companions.program import Messages
from of_companions import OwnOptions, line_of, parsed, settings_of, texts
from run_here import PROGRAMS, InAFolder

TOLERANCE, SHARE = .002, .001
SUBJECT = Subject('<scene> & "more"', "r<s", "rsphere-compare 'a<b' r", "/opt/rtrace", "RADIANCE <test>", "1.0", False, "W/sr/m2", .01, 0, 0,
                  "record 1 & 2\n", "1 s < 2 s\n", [])


def setUpModule():
    os.environ["PATH"] = PROGRAMS + os.pathsep + os.environ["PATH"]


def noisy(records, repeats, noise, bias, seed):
    """Records with values from 1 to 2, with relative noise and bias."""
    chance = random.Random(seed)
    values = [[(1 + i / records) * (1 + bias) * (1 + noise * chance.gauss(0, 1)) for _ in range(3)]
              for _ in range(repeats) for i in range(records)]
    return Answers(records, repeats, [list(channel) for channel in zip(*values)])


def gray(records, *values):
    return Answers(records, len(values) // records, [list(values)] * 3)


def of_bias(bias, noise, seed, tolerance=TOLERANCE):
    return compare(noisy(300, 8, noise, bias, seed), noisy(300, 8, noise, 0, ~seed), tolerance, SHARE, True)


class Comparisons(unittest.TestCase):
    def test_tells_a_bias_from_noise(self):
        self.assertEqual(of_bias(.005, .01, 1).verdict, Verdict.DIFFERS)
        self.assertEqual(of_bias(0, .01, 2).verdict, Verdict.SAME)

    def test_a_bias_below_the_tolerance_is_small(self):
        comparison = of_bias(.005, .01, 3, .01)
        self.assertEqual(comparison.verdict, Verdict.SMALL)
        self.assertAlmostEqual(comparison.channels[1].bias, .005, delta=4 * comparison.channels[1].bias_error)

    def test_too_much_noise_is_undecided(self):
        self.assertEqual(of_bias(0, .3, 4).verdict, Verdict.UNDECIDED)
        self.assertEqual(of_bias(.005, .3, 4).verdict, Verdict.UNDECIDED)

    def test_noise_of_both_programs_is_taken_alike(self):
        """Values with rare bright outliers. The scale of a record is the mean of both programs, so that the outliers of one do not make
        its noise look smaller than that of the other."""
        def rare(seed):
            chance = random.Random(seed)
            return gray(8000, *(30 if chance.random() < .01 else 1 for _ in range(8 * 8000)))
        channel = compare(rare(1), rare(2), TOLERANCE, SHARE, True).channels[1]
        self.assertAlmostEqual(channel.our_noise, channel.original_noise, delta=.1 * channel.original_noise)

    def test_false_alarms_are_as_rare_as_said(self):
        """FALSE_ALARM holds for all channels together. A bias of a tenth of the noise must always be found."""
        def alarms(bias):
            return sum(compare(noisy(40, 4, .01, bias, seed), noisy(40, 4, .01, 0, ~seed), .01, SHARE, True).verdict != Verdict.SAME
                       for seed in range(300))
        self.assertLessEqual(alarms(0), 3)  # .3 expected; more than 3 once in 4000
        self.assertGreater(alarms(.005), 150)

    def test_shared_noise_is_no_bias(self):
        """If records share their noise, as points that share directions do, the error follows only from whole repeats."""
        alarms = naive = 0
        for seed in range(200):
            chance = random.Random(f"shared {seed}")
            ours, theirs = noisy(50, 6, .001, 0, seed), noisy(50, 6, .001, 0, ~seed)
            for r in range(6):
                shared = 1 + .01 * chance.gauss(0, 1)
                for channel in ours.channels:
                    channel[50 * r:50 * (r + 1)] = [shared * x for x in channel[50 * r:50 * (r + 1)]]
            alarms += compare(ours, theirs, .5, SHARE, False).verdict != Verdict.SAME
            naive += compare(ours, theirs, .5, SHARE, True).verdict != Verdict.SAME
        self.assertLessEqual(alarms, 3)
        self.assertGreater(naive, 100)

    def test_finds_the_record_that_differs(self):
        ours, theirs = noisy(300, 8, .003, 0, 5), noisy(300, 8, .003, 0, 6)
        for channel in ours.channels:
            for r in range(8):
                channel[300 * r + 123] *= 1.1
        comparison = compare(ours, theirs, .05, 0, True)
        self.assertEqual(comparison.worst[0], 123)
        self.assertEqual(comparison.channels[0].beyond, 1)
        self.assertEqual(comparison.verdict, Verdict.DIFFERS)
        self.assertEqual(verdict_text(comparison.channels[0]),
                         "differs: 1 record by more than the tolerance, even after allowing for noise")
        self.assertAlmostEqual(comparison.records[123].difference, .1, delta=.01)
        # One of 300 records may exceed the tolerance, but it also biases the mean.
        self.assertEqual(compare(ours, theirs, .05, .004, True).verdict, Verdict.SMALL)

    def test_figures_are_those_of_the_definition(self):
        channel = compare(gray(4, 1, 2, 3, 4.2, 1, 2, 3, 4.2), gray(4, 1, 2, 3, 3.8, 1, 2, 3, 3.8), .05, 0, True).channels[0]
        self.assertAlmostEqual(channel.bias, .4 / 9.8, delta=1e-12)
        self.assertEqual(channel.bias_error, 0)
        self.assertAlmostEqual(channel.rms, .05, delta=1e-12)
        self.assertEqual((channel.share_within, channel.beyond), (.75, 1))
        self.assertAlmostEqual(channel.percentiles[3], .1, delta=1e-12)
        self.assertEqual(channel.percentiles[0], 0)

    def test_dark_records_have_a_scale(self):
        """The differences of records that are black in the original are relative to the mean."""
        ours = Answers(2, 2, [[.01, 1, .01, 1], [0] * 4, [0] * 4])
        theirs = Answers(2, 2, [[0, 1, 0, 1], [0] * 4, [0] * 4])
        comparison = compare(ours, theirs, .05, 0, True)
        self.assertAlmostEqual(comparison.channels[0].percentiles[3], .01 / (DARKEST * .5), delta=1e-9)
        self.assertEqual(comparison.channels[1].verdict, Verdict.SAME)

    def test_black_answers_are_the_same(self):
        channel = compare(gray(2, 0, 0, 0, 0), gray(2, 0, 0, 0, 0), .05, 0, True).channels[0]
        self.assertEqual((channel.bias, channel.bias_error, channel.rms, channel.noise_rms, channel.our_noise, channel.original_noise),
                         (0,) * 6)
        self.assertEqual(channel.verdict, Verdict.SAME)

    def test_bands_of_a_spectral_run(self):
        """Each band is compared, and records by their photopic sums: a fault in one band is found."""
        bands = Colors(["730 nm", "630 nm", "530 nm", "430 nm"], [.002, .3, .65, .03], [[0] * 4] * 3)
        ours = Answers(1, 2, [[1.2, 1.2], [1, 1], [1, 1], [1, 1]], bands)
        comparison = compare(ours, Answers(1, 2, [[1, 1]] * 4, bands), .05, 0, True)
        self.assertEqual([channel.name for channel in comparison.channels], bands.names)
        self.assertEqual(comparison.middle.name, "530 nm")
        self.assertAlmostEqual(comparison.channels[0].bias, .2, delta=1e-12)
        self.assertEqual([channel.verdict for channel in comparison.channels], [Verdict.DIFFERS] + [Verdict.SAME] * 3)
        # The eye hardly sees the first band.
        self.assertTrue(0 < comparison.records[0].difference < .01)


def steady(records, factor, noise):
    """Records that answer 1, 2, 3 and so on, with a little noise, times a factor."""
    values = [(i + 1) * factor * (1 + (noise if r % 2 == 0 else -noise)) for r in range(4) for i in range(records)]
    return Answers(records, 4, [values, [.5 * x for x in values], [.25 * x for x in values]])


def page_of(test, ours, original, **subject):
    comparison = compare(ours, original, .01, .001, True)
    return comparison, parsed(test, compare_page.compare_page(ours, original, comparison, SUBJECT._replace(**subject), 0))


class Reports(unittest.TestCase):
    def test_page_has_the_figures_and_the_verdict(self):
        comparison, page = page_of(self, steady(6, 1.05, .0001), steady(6, 1, .0001))
        self.assertEqual(texts(page, ".//p[@class='banner bad']"), ["They differ."])
        red = comparison.channels[0]
        self.assertEqual(texts(page, "body/div[@class='wide']//tbody/tr/td[2]"), [
            "3.6750e+00", "3.5000e+00", "+5.00% \u00b1 " + percent(red.bias_error), "4.88%", percent(red.noise_rms),
            *map(percent, red.percentiles), "0.0%", percent(red.our_noise), percent(red.original_noise)])
        self.assertEqual(texts(page, "body/table[1]//td"),
                         [text for channel in comparison.channels for text in (channel.name, verdict_text(channel))])
        self.assertEqual(texts(page, ".//pre"), [SUBJECT.worst, SUBJECT.times])
        self.assertEqual(len(page.findall(".//svg//circle[@r='3']")), 6)
        self.assertEqual(page.findall(".//img"), [])

    def test_page_says_if_there_is_no_difference(self):
        _, page = page_of(self, steady(6, 1, .0001), steady(6, 1, .0001))
        self.assertEqual(len(page.findall(".//p[@class='banner good']")), 1)
        self.assertEqual(len(page.findall(".//svg//circle[@r='2.5']")), 6)
        self.assertEqual(len(page.findall(".//svg//circle[@r='3']")), 0)

    def test_page_has_the_warnings(self):
        """Who is handed the page does not see the standard error of the program."""
        warnings = ["a <cache>", "no light"]
        _, page = page_of(self, steady(6, 1, .0001), steady(6, 1, .0001), warnings=warnings)
        self.assertEqual(texts(page, ".//p[@class='banner open']"), ["Warning: a <cache>", "Warning: no light"])
        self.assertEqual(warnings_text(warnings), "Warning: a <cache>\nWarning: no light\n")

    def test_page_has_pictures_of_records_that_form_one(self):
        _, page = page_of(self, steady(6, 1.05, 0), steady(6, 1, 0), width=3, height=2)
        sources = [image.get("src") for image in page.findall(".//img")]
        self.assertEqual(len(sources), 3)
        for source in sources:  # the first bytes of a PNG file
            self.assertTrue(source.startswith("data:image/png;base64,iVBORw0KGgo"))
        self.assertNotEqual(sources[0], sources[1])

    def test_plot_is_thinned(self):
        """A plot of many records has few marks, and the worst record among them."""
        ours, original = steady(20000, 1, 0), steady(20000, 1, 0)
        for channel in ours.channels:
            channel[12345::20000] = [2 * x for x in channel[12345::20000]]
        svg = parsed(self, compare_plot(ours, original, compare(ours, original, .01, .001, True), SUBJECT))
        self.assertEqual(sum(circle.get("r") in ("2.5", "3") for circle in svg.iter("circle")), MOST_MARKS)
        self.assertEqual(texts(svg, ".//circle/title"), ["record 12346: +66.7%"])

    def test_black_records_are_counted(self):
        ours = steady(3, 1, 0)
        for channel in ours.channels:
            channel[::3] = [0] * 4
        svg = compare_plot(ours, ours, compare(ours, ours, .01, .001, True), SUBJECT)
        self.assertIn("3 records, 1 of them black", svg)
        self.assertNotIn("nan", svg)
        dark = gray(2, 0, 0, 0, 0)
        self.assertIn("none to draw", compare_plot(dark, dark, compare(dark, dark, .01, .001, True), SUBJECT))

    def test_equal_error_is_a_setting_of_the_original(self):
        """Noise falls with the number of rays or with its square root; the time is proportional to the number."""
        def text(ours, original):
            middle = Channel("green", *[0] * 6, ours, original, [0] * 4, 1, 0, Verdict.SAME)
            return equal_error_text(middle, 128, 2, 3)
        self.assertEqual(text(.01, .04), "Equal error: with -Cn 512 to 2048 the original is about as noisy as rsphere (its noise falls with "
                         "the number of rays, or its square root). All repeats then take it about 12 to 48 s of CPU time; rsphere took 2 s.\n")
        self.assertEqual(text(.02, .01), "Equal error: with -Cn 32 to 64 the original is about as noisy as rsphere (its noise falls with the "
                         "number of rays, or its square root). All repeats then take it about 0.75 to 1.5 s of CPU time; rsphere took 2 s.\n")
        self.assertEqual(text(.00001, .1),
                         "Equal error: more than the 1000000 rays that -Cn allows; fewer directions of rsphere (-Sn, -Sx) do it.\n")
        self.assertEqual(text(1, .01), "Equal error: fewer than the 8 rays that -Cn needs; more directions of rsphere (-Sn, -Sx) do it.\n")
        self.assertEqual(text(0, .01), "Equal error: one of them has no noise to go by.\n")

    def test_classes_and_colors_of_differences(self):
        records = [Difference(x, 0) for x in (-.5, -.015, .001, .02, .15)]
        counts = {c.low: c.records for c in difference_classes(records, .01) if c.records}
        self.assertEqual(counts, {"less": 1, "-2.00%": 1, "-0.50%": 1, "+1.00%": 1, "+8.00%": 1})
        self.assertEqual(differences_on_screen([Difference(.05, 0), Difference(-.2, 0)], .01), [1, .5, .5, 0, 0, 1])


class Options(OwnOptions, InAFolder):
    companion, letter = COMPANION, "-C"

    def test_are_those_of_rsphere_and_its_own(self):
        line = line_of(COMPANION, "-ab", "2", "-Ct", ".002", "-Cr", "3", "-I", "-Cp", "d.png", "a.oct", "rays")
        self.assertEqual((line.own["-Ct"], line.own["-Cr"], line.own["-Cp"]), (.002, 3, "d.png"))
        self.assertEqual(line.settings.number("-ab"), 2)
        self.assertTrue(line.settings.on("-I"))
        self.assertFalse(line.settings.sphere_mode)
        self.assertEqual((line.scene, line.records), (["a.oct"], "rays"))
        points = line_of(COMPANION, "-S", "a.oct", "points")
        self.assertTrue(points.settings.sphere_mode)
        self.assertEqual(points.settings.number("-ad"), 4)

    def test_original_gets_those_that_concern_rays(self):
        self.file("g(x) = x;", "f.cal")
        words = f"-h -ab 2 -Cr 3 -I+ -n 4 -x 3 -y 8 -ff -e a=1 -e {self.folder.name}/err.txt -f f.cal -ae floor -ae wall -Sr 2 -pY -w a b"
        line = line_of(COMPANION, *words.split())
        self.assertEqual(original_options(line), "-ab 2 -I+ -e a=1 -f f.cal -ae floor -ae wall".split())

    def test_original_gets_the_defaults_of_points(self):
        words = original_options(line_of(COMPANION, "-S", "-ab", "2", "a", "b"))
        self.assertEqual(words[words.index("-ad") + 1], "4")
        self.assertEqual(words[-2:], ["-ab", "2"])

    def test_rays_without_direction_are_left_out(self):
        name = self.file("0 0 0 0 0 1\n1 1 1 0 0 0\n2 2 2 1 0 0\n")
        rays = read_records(name, settings_of("-faa", "-S-"), Messages("test"))
        self.assertEqual(list(without_bogus(rays)), [0, 0, 0, 0, 0, 1, 2, 2, 2, 1, 0, 0])

    def test_planes_face_all_ways(self):
        first, second = rotated_directions(64, 1), rotated_directions(64, 2)
        self.assertEqual(len(first), 3 * 64)
        self.assertNotEqual(first, second)
        for c in range(3):
            self.assertAlmostEqual(sum(first[c::3]) / 64, 0, delta=.02)
            self.assertAlmostEqual(sum(x * x for x in first[c::3]) / 64, 1 / 3, delta=.02)

    def test_octrees(self):
        scenes = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../scenes")
        octree = os.path.join(scenes, "octree/frozen.oct")
        self.assertTrue(is_octree([octree]))
        self.assertTrue(is_octree(["!cat " + octree]))
        self.assertFalse(is_octree([self.file(LAMP, "lamp.rad")]))
        self.assertFalse(is_octree([octree, octree]))


if __name__ == "__main__":
    unittest.main()
