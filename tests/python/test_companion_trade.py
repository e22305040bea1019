"""rsphere-trade: its statistics, its predictions, its settings and its report."""
import math
import os
import random
import re
import unittest
from array import array

from companions.curve import DARKEST_POINT, Figures, Reference, Trial, cheapest, figures_of, recommend, with_best
from companions.ladder import ladder, reference_words
from companions.schedule import ReferenceProgress, cost_of, duration_text, seconds_left
from companions.trade import COMPANION, chosen_points
from companions.trade_report import Subject, bounces_text, trade_page, trade_plot, trade_table
from of_companions import OwnOptions, fault_of, line_of, parsed, settings_of, texts
from run_here import PROGRAMS, InAFolder

POINTS = 24


def setUpModule():
    os.environ["PATH"] = PROGRAMS + os.pathsep + os.environ["PATH"]


def answers(repeats, noise, bias, seed):
    """The exact answers to the points are 1, 2, 3 and so on."""
    chance = random.Random(seed)
    return [(k % POINTS + 1) * (1 + bias + noise * chance.gauss(0, 1)) for k in range(repeats * POINTS)]


def reference_of(repeats, noise, seed):
    return Reference(POINTS, answers(repeats, noise, 0, seed))


def trial_of(noise, bias, seed, repeats=8):
    trial = Trial(["words"])
    trial.values = answers(repeats, noise, bias, seed)
    trial.estimates = [noise * (i + 1) for i in range(POINTS)]
    return trial


class Errors(unittest.TestCase):
    def test_reference_knows_its_error(self):
        reference = reference_of(64, .008, 1)
        self.assertAlmostEqual(reference.error, .001, delta=.0002)
        self.assertAlmostEqual(reference.mean_error, .001 / math.sqrt(POINTS), delta=.0001)
        self.assertAlmostEqual(reference.means[9], 10, delta=10 * .004)
        self.assertEqual(reference.repeats, 64)

    def test_reference_knows_the_dark(self):
        self.assertTrue(Reference(2, [0, 0, 0, 0]).is_dark())
        self.assertFalse(Reference(2, [0, 0, 0, 1]).is_dark())

    def test_figures_are_those_of_noise_and_bias(self):
        exact = reference_of(2, 0, 1)
        f, rms = figures_of(trial_of(.01, .02, 2), exact), math.hypot(.01, .02)
        self.assertAlmostEqual(f.rms, rms, delta=.1 * rms)
        self.assertGreater(f.rms_at_most, rms)
        self.assertAlmostEqual(f.bias, .02, delta=4 * f.bias_error)
        self.assertAlmostEqual(f.bias_error, .01 / math.sqrt(8 * POINTS), delta=.0005)
        self.assertAlmostEqual(f.estimated, .01, delta=1e-12)
        self.assertTrue(f.biased)
        self.assertFalse(f.limited)
        self.assertFalse(figures_of(trial_of(.01, 0, 3), exact).biased)

    def test_no_bias_is_claimed_where_there_is_none(self):
        """A false bias is claimed once in a hundred times; a bias of half the noise is nearly always found."""
        alarms = spoiled = 0
        for seed in range(400):
            reference = reference_of(16, .01, seed)
            alarms += figures_of(trial_of(.01, 0, ~seed), reference).biased
            spoiled += figures_of(trial_of(.01, .005, ~seed), reference).biased
        self.assertLessEqual(alarms, 12)  # 4 expected; 12 and more once in a thousand
        self.assertGreaterEqual(spoiled, 300)

    def test_figures_are_without_the_error_of_the_reference(self):
        """If it hides that of the setting, the figures are limited."""
        good = reference_of(16, .02, 5)  # .5%
        f = figures_of(trial_of(.02, 0, 6), good)
        self.assertAlmostEqual(f.rms, .02, delta=.003)
        self.assertFalse(f.limited)
        hidden = figures_of(trial_of(.002, 0, 7), good)
        self.assertTrue(hidden.limited)
        self.assertLess(hidden.rms, .005)
        self.assertGreater(hidden.rms_at_most, .004)

    def test_dark_points_have_a_scale(self):
        trial = Trial()
        trial.values = [.01, 1, .01, 1]
        self.assertAlmostEqual(figures_of(trial, Reference(2, [0, 1, 0, 1])).largest, .01 / (DARKEST_POINT * .5), delta=1e-9)

    def test_best_and_cheapest(self):
        def of(*pairs):
            return [Figures([], seconds=seconds, rms=rms, rms_at_most=rms) for seconds, rms in pairs]
        best = with_best(of((1, .1), (2, .05), (2, .06), (3, .05), (4, .01), (.5, .2), (.6, .2)))
        self.assertEqual([f.best for f in best], [True, True, False, False, True, True, False])
        settings = of((1, .1), (2, .05), (1.5, .05), (4, .01))
        self.assertEqual([cheapest(settings, accuracy) for accuracy in (.05, .02, .001)], [2, 3, None])
        self.assertEqual([recommend(settings, accuracy) for accuracy in (.05, .001)], [(2, True), (3, False)])


def progress(rotations, seconds, error, points=32, more_threads=False):
    return ReferenceProgress(rotations, 8, seconds, error, .001, points, more_threads)


class Schedule(unittest.TestCase):
    def test_of_the_reference(self):
        """Errors fall with the square root of the number of rotations."""
        for at, left in ((progress(2, 4, .01), 396),  # 200 rotations of two seconds
                         (progress(2, 4, .001), 12),  # eight rotations are the minimum
                         (progress(10, 20, .0005), 0), (progress(1, 2, 0), 14), (progress(.25, 2, 0), 62)):
            self.assertAlmostEqual(at.seconds_left(), left)
        # One rotation, or two of a single point, do not suffice to estimate the error.
        self.assertFalse(progress(1, 2, 0).can_predict())
        self.assertFalse(progress(2, 2, .01, 1).can_predict())
        self.assertTrue(progress(5, 2, .01, 1).can_predict())

    def test_a_slow_reference_names_what_makes_it_quicker(self):
        self.assertEqual(progress(2, 4, .003).slow(), "")  # 36 s
        # A minute suffices for 30 rotations, whose error is 1% times the square root of 2/30.
        self.assertEqual(progress(2, 4, .01).slow(),
                         "the reference takes about 6.7 min (error 1% after 2 rotations, 0.1% wanted): -Te 0.0026 ends it after 60 s, "
                         "-Tm 4 measures fewer points")
        self.assertEqual(progress(1, 20, 0).slow(), "the reference takes at least 2.7 min for its 8 rotations: -Tm 12 measures fewer points")
        self.assertEqual(progress(2, 40, .01).slow(),
                         "the reference takes about 67 min (error 1% after 2 rotations, 0.1% wanted): -Te 0.005 ends it after 2.7 min, "
                         "-Tm 12 measures fewer points")
        self.assertEqual(progress(.5, 3600, 0, more_threads=True).slow(),
                         "the reference takes at least 16.0 h for its 8 rotations: -Tm 1 measures fewer points, -n 0 uses all cores")

    def test_of_settings(self):
        def cost(divisions, bounces):
            return cost_of(settings_of("-S+", "-Sn 100", f"-ad {divisions}", f"-ab {bounces}"))
        self.assertEqual((cost(1, 2), cost(16, 2), cost(16, 0)), (100, 800, 100))
        self.assertEqual([seconds_left([1, 2, 3], done, 5) for done in (1, 3, 0)], [25, 0, 0])

    def test_durations_are_short(self):
        self.assertEqual([duration_text(s) for s in (0, 59.6, 150, 720, 9000)], ["0 s", "60 s", "2.5 min", "12 min", "2.5 h"])


class Options(OwnOptions, InAFolder):
    companion, letter = COMPANION, "-T"

    def settings_for(self, *words):
        line = line_of(COMPANION, *words, "scene", "points")
        return ladder(line.own["-Tl"], line.own["-Tb"], line.settings)

    def test_settings_are_options_of_rsphere(self):
        """Each of the default settings is a valid command line."""
        line = line_of(COMPANION, "-ab", "2", "-Tb", "scene", "points")
        settings = ladder("", True, line.settings)
        self.assertGreater(len(settings), 15)
        for words in [*settings, reference_words(True)]:
            self.assertEqual(line.split(words)[1], [])
            self.assertIn("-S+", "".join(line.defaults(words)))
        rays = line_of(COMPANION, "-S-", "-ab", "2", "-Tb", "scene", "points")
        for words in [*ladder("", True, rays.settings), reference_words(False)]:
            self.assertIn("-S-", "".join(rays.defaults(["-S-", *words])))

    def test_indirect_light_is_left_alone_where_there_is_none(self):
        for words in self.settings_for("-ab", "0"):
            self.assertFalse({"-ad", "-ab"} & set(words))

    def test_fewer_bounces_besides_those_of_a_file(self):
        file = self.file("-Sn 100\n# a comment\n-Sn 200 -ab 1\n", "ladder")
        of_file = [["-Sn", "100"], ["-Sn", "200", "-ab", "1"]]
        self.assertEqual(self.settings_for("-Tl", file, "-ab", "2"), of_file)
        fewer = self.settings_for("-Tl", file, "-Tb", "-ab", "2")
        self.assertEqual(fewer[:2], of_file)
        self.assertEqual([words[-2:] for words in fewer[2:]], [["-ab", "0"], ["-ab", "1"]])

    def test_what_is_wrong_with_a_file(self):
        self.assertIn('cannot open "/nowhere/ladder"', fault_of(lambda: self.settings_for("-Tl", "/nowhere/ladder")))
        self.assertIn("/dev/null: no settings", fault_of(lambda: self.settings_for("-Tl", "/dev/null")))

    def test_points_are_spread_over_the_file(self):
        self.assertEqual(list(chosen_points(array("d", range(30)), 3, 3)), [0, 1, 2, 9, 10, 11, 18, 19, 20])
        self.assertEqual(len(chosen_points(array("d", range(30)), 3, 99)), 30)


def three_settings():
    settings = [Figures(["-Sw", "h" if n == 1 else "c", "-Sn", str(100 * n)], .00123 * n, 0, 111 * n, .0123 / n, .0145 / n, .0333 / n,
                        -.0011 * n, .0022 * n, False, 0 if n == 2 else .011) for n in (1, 2, 3)]
    index, sure = recommend(settings, .01)
    subject = Subject('a<b&"c".rad', "p & q", 7, [1, 2, 3.5, 4, 5, 6.25], 3, .01, 3, index, sure,
                      "rsphere -Sn 200 'a<b&\"c\".rad' < 'p & q'", "rsphere-trade a", "-Sw c", 4, 0, "1.0")
    return with_best(settings), subject


class Report(unittest.TestCase):
    reference = Reference(2, [1, 3, 1.001, 3.001])

    def page(self, settings, subject):
        return parsed(self, trade_page(settings, self.reference, subject, 0))

    def test_plot_has_a_mark_for_each_setting(self):
        settings = [Figures(["-Sw", "h" if i == 0 else "c", "<&"], .001 * (i + 1), rms=0 if i == 2 else .01 / (i + 1)) for i in range(3)]
        subject = three_settings()[1]._replace(scene="a & b", recommended=0)
        svg = trade_plot(with_best(settings), subject)
        self.assertEqual(svg.count("<title>"), 2)  # the exact one is omitted
        self.assertIn("a &amp; b", svg)
        self.assertIn("&lt;&amp;", svg)
        self.assertNotIn("nan", svg)
        self.assertIn("</svg>", trade_plot([], subject))

    def test_dashed_line_is_named_only_where_it_is_drawn(self):
        """A curve needs two settings: with one, the legend named a line that was not there."""
        settings, subject = three_settings()
        dashes, name = 'stroke-dasharray="4 3"', "nothing is as fast and as accurate"
        three = trade_plot(settings, subject)
        one = trade_plot([f._replace(best=i == 1) for i, f in enumerate(settings)], subject)
        for text in (dashes, name):
            self.assertIn(text, three)
            self.assertNotIn(text, one)

    def test_accuracy_asked_for_is_on_the_axis(self):
        """One that every setting exceeds was a line in the legend, and none in the plot."""
        settings, subject = three_settings()
        for accuracy in (1e-4, .5):
            plot = trade_plot(settings, subject._replace(accuracy=accuracy))
            # The box that clips lines, and the first of them: the dotted one.
            found = re.search(r'<svg x=.*viewBox="\S+ (\S+) \S+ (\S+)">\n<path d="M\S+ ([0-9.]+)', plot)
            top, height, y = map(float, found.groups())
            self.assertTrue(top < y < top + height)

    def test_rays_are_named_only_where_they_are_measured(self):
        """Interpolation (-aa) of what points see is no setting of rays."""
        settings, subject = three_settings()
        settings[0] = settings[0]._replace(words=["-aa", ".1"])
        self.assertNotIn("rays, as", trade_plot(settings, subject))
        self.assertIn("rays, as", trade_plot(settings, subject._replace(per_point=6)))

    def test_page_has_every_figure_of_the_table(self):
        settings, subject = three_settings()
        page = self.page(settings, subject)
        self.assertEqual(texts(page, "body/div[@class='wide']//tbody/tr/td"), [
            "on the curve", "-Sw h -Sn 100", "1.23", "1.23%", "1.45%", "3.33%", "-0.110% \u00b1 0.220%", "1.10%", "111", "",
            "recommended", "-Sw c -Sn 200", "2.46", "0.615%", "0.725%", "1.67%", "-0.220% \u00b1 0.440%", "-", "222", "",
            "on the curve", "-Sw c -Sn 300", "3.69", "0.410%", "0.483%", "1.11%", "-0.330% \u00b1 0.660%", "1.10%", "333", ""])
        self.assertEqual(texts(page, ".//tr[@class='chosen']/td")[1], "-Sw c -Sn 200")
        self.assertEqual(texts(page, ".//details//tbody/tr/td"), ["1", "1", "2", "3.5", "1", "2", "4", "5", "6.25", "3"])
        self.assertEqual(texts(page, ".//pre[@class='command']"), [subject.command])
        self.assertEqual(texts(page, ".//h1"), ["Speed and accuracy: " + subject.scene])
        self.assertEqual(len(page.findall(".//svg//circle/title")), 3)
        self.assertEqual(texts(page, ".//p[@class='note']")[0], bounces_text(3))

    def test_table_explains_the_recommendation(self):
        self.assertIn("2.46   0.615%    0.725%    1.67%", trade_table(three_settings()[0]))
        self.assertTrue(bounces_text(3).startswith(
            "These errors hold for -ab 3. The light that further bounces would add is not in them"))

    def test_recommended_setting_is_marked(self):
        """The ring is around its mark."""
        settings, subject = three_settings()
        for chosen in range(3):
            page = self.page(settings, subject._replace(recommended=chosen))
            ring, mark = page.find(".//circle[@class='ring']"), page.findall(".//svg//circle[title]")[chosen]
            self.assertEqual((ring.get("cx"), ring.get("cy")), (mark.get("cx"), mark.get("cy")))

    def test_page_says_if_no_setting_is_accurate_enough(self):
        settings, subject = three_settings()
        index, sure = recommend(settings, .0001)
        self.assertEqual((index, sure), (2, False))
        page = self.page(settings, subject._replace(accuracy=.0001, recommended=index, sure=sure, repeats_of_last=2))
        self.assertTrue(texts(page, ".//p[@class='banner open']")[0].startswith("No setting is sure"))
        self.assertEqual(texts(page, ".//tr[@class='chosen']/td")[-1], "2 of 4 repeats")

    def test_exact_settings_are_in_the_table(self):
        """They have no place on a logarithmic axis."""
        settings, subject = three_settings()
        page = self.page([f._replace(rms=0, rms_at_most=0) for f in settings], subject)
        self.assertEqual(len(page.findall("body/div//tbody/tr")), 3)
        self.assertEqual(page.findall(".//svg//circle"), [])


if __name__ == "__main__":
    unittest.main()
