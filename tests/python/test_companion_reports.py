"""What rsphere-compare and rsphere-trade have in common: statistics, command lines, files of records, pages, plots and pictures."""
import base64
import math
import os
import struct
import subprocess
import unittest
import zlib

from companions import colors, command_line, pictures
from companions.command_line import read_records, shell_line
from companions.compare import COMPANION
from companions.page import Page, Table, escaped
from companions.plot import Axis, LogAxis, Plot, bars_svg, require_svg_name
from companions.program import Fault, Messages, printable, run, write_file
from companions.statistics import beyond_t, chance_of, moments, standard_error
from of_companions import fault_of, line_of, parsed, settings_of, texts
from run_here import PROGRAMS, InAFolder

ODD = "a<b>&\"c\"'</pre></td><script>alert(1)</script>"


def setUpModule():
    os.environ["PATH"] = PROGRAMS + os.pathsep + os.environ["PATH"]


class Statistics(unittest.TestCase):
    def test_closed_forms(self):
        """For one and two degrees of freedom."""
        for t in (0, .1, 1, 3, 20):
            self.assertAlmostEqual(beyond_t(t, 1), 1 - 2 / math.pi * math.atan(t), delta=1e-14)
            self.assertAlmostEqual(beyond_t(-t, 2), 1 - t / math.sqrt(2 + t * t), delta=1e-14)

    def test_tables(self):
        """Values from tables of Student's distribution, two-sided."""
        for t, degrees, chance, error in ((2.2281, 10, .05, 1e-5), (4.1403, 14, .001, 1e-6), (3.5518, 7, .00932, 1e-4),
                                          (1.9720, 199, .05, 1e-4), (1.9600, 201, .05, 1e-4)):
            self.assertAlmostEqual(beyond_t(t, degrees), chance, delta=error)
        self.assertEqual(beyond_t(3, 0), 1)

    def test_without_noise_is_certain(self):
        self.assertEqual(chance_of(0, 0, 8), 1)
        self.assertEqual(chance_of(1e-9, 0, 8), 0)
        self.assertEqual(chance_of(2, 1, 8), beyond_t(2, 8))

    def test_moments(self):
        values = [1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16]
        self.assertEqual(moments(values), (1e9 + 10, 30))
        self.assertEqual(standard_error(values), math.sqrt(7.5))
        self.assertEqual(moments([.1] * 3), (.1, 0))
        self.assertEqual(moments([3]), (3, 0))


class CommandLines(InAFolder):
    def test_shell_line(self):
        self.assertEqual(shell_line([]), "")
        self.assertEqual(shell_line(["rsphere", "-t", "", "a b"]), "rsphere -t '' 'a b'")
        self.assertEqual(shell_line(["-Sn", "../a_b/room.oct", "a<b&$c", "it's"]), "-Sn ../a_b/room.oct 'a<b&$c' 'it'\\''s'")

    def test_table_has_every_option(self):
        """-help all is read as rsphere reads a command line: each option with as many words as rsphere takes."""
        table = command_line.option_table()
        for name, count, group in (("-ab", 1, "Indirect light"), ("-av", 3, "Indirect light"), ("-pc", 8, "Colors"), ("-u", 0, "Program"),
                                   ("-Sut", 2, "Sphere mode"), ("-f", 1, "Program"), ("-f*", 0, "Records"), ("-ld", 0, "Records")):
            self.assertEqual(table[name], (count, group), name)

    def test_words_are_split_as_by_rsphere(self):
        line = line_of(COMPANION, "-av", ".1", "1", "0", "-ff", "-u+", "-tefloor", "-te", "wall", "-e", "a=1", "-e", self.file("", "err"),
                       "-w", "-Ct", ".5", "a.oct", "b", "rays")
        self.assertEqual([option.words for option in line.used],
                         [["-av", ".1", "1", "0"], ["-ff"], ["-u+"], ["-tefloor"], ["-te", "wall"], ["-e", "a=1"],
                          ["-e", self.folder.name + "/err"], ["-w"]])
        self.assertEqual((line.scene, line.records), (["a.oct", "b"], "rays"))
        self.assertEqual(line.settings.input_format, "f")
        self.assertFalse(line.settings.on("-w"))

    def test_options_of_files_and_variables(self):
        os.environ["OPTIONS_OF_TEST"] = "-ab 3 'a b.oct'"
        line = line_of(COMPANION, "@" + self.file("-Ct .5\n$OPTIONS_OF_TEST", "options"), "rays")
        self.assertEqual((line.own["-Ct"], line.settings.number("-ab"), line.scene), (.5, 3, ["a b.oct"]))
        loop = self.file("", "loop")
        self.file("@" + loop + " @" + loop, "loop")
        self.assertIn("too many words", fault_of(lambda: line_of(COMPANION, "@" + loop, "rays")))
        self.assertIn("cannot expand '@/nowhere'", fault_of(lambda: line_of(COMPANION, "@/nowhere")))

    def test_what_is_wrong(self):
        for words, why in ((["-Cr", "1", "a", "b"], "1 is not from 2 to 10000"), (["-Ct", "-1", "a", "b"], "-1 is not from 0 to 1"),
                           (["-Ct", "2", "a", "b"], "2 is not from 0 to 1: 2% is written 0.02"), (["-Cq", "a", "b"], "no such option"),
                           (["-Cr", "x", "a", "b"], '"x" is not a whole number from 2 to 10000'), (["-Cr"], "its value is missing (-Cr N)"),
                           (["a", "-ab", "1"], "the scene begins here, but '-ab' follows"), (["-ab", "x", "a", "b"], "not a whole number"),
                           (["-Cn", "9", "a", "b"], "needs sphere mode (-S+)"), (["a"], "missing argument: a scene and a file")):
            self.assertIn(why, fault_of(lambda words=words: line_of(COMPANION, *words)), words)

    def test_records(self):
        rays = settings_of("-faa", "-S-")
        last = "; the file of records is the last argument, after the scene"

        def fault_of_text(text):
            name = self.file(text, "records")
            return fault_of(lambda: read_records(name, rays, Messages("test"))).replace(self.folder.name + "/", "")
        self.assertEqual(fault_of_text("void plastic white 0 0 5 .7 .7 .7 0 0\n"), 'records:1: expected 6 numbers, got "void"' + last)
        self.assertEqual(fault_of_text("#?RADIANCE\noconv room.rad\n"), 'records:1: expected 6 numbers, got "#?RADIANCE"' + last)
        self.assertEqual(fault_of_text("1 2 3 0 0 1\n1 2 3 0 0 1\n"), "no fault")
        self.assertEqual(fault_of_text("1 2 3 0 0 1\n1 2 x 0 0 1\n"), 'records:2: expected 6 numbers, got "x"')
        self.assertEqual(fault_of_text(""), "records: no records")
        self.assertEqual(list(read_records(self.file("\xef\xbb\xbf1 2e1 -3 0 0 1\n"), rays, Messages("test"))), [1, 20, -3, 0, 0, 1])
        floats = self.file(struct.pack("6f", 1, 2, 3, 0, .5, 1))
        self.assertEqual(list(read_records(floats, settings_of("-ffa", "-S+"), Messages("test"))), [1, 2, 3, 0, .5, 1])
        self.assertIn("use -fa", fault_of(lambda: read_records(self.file("1 2 3 0 0 1\n" * 2), settings_of("-ffa", "-S-"), Messages("t"))))

    def test_messages(self):
        self.assertEqual(printable("a\x1bb\udce9 \u202ec"), "a\\x1bb\\xe9 \\xe2\\x80\\xaec")
        self.assertEqual(len(printable("n" * 3000)), 3 + 2 * 248)
        self.assertEqual(fault_of(lambda: write_file("/nowhere/page.html", "text")), 'cannot write "/nowhere/page.html": No such file or directory')

    def test_programs_are_not_left_behind(self):
        with self.assertRaises(Fault) as caught:
            run(["/nowhere/program"])
        self.assertEqual(caught.exception.kind, "system")
        ended = run(["/bin/sh", "-c", "cat; echo error >&2; exit 3"], b"text")
        self.assertEqual(ended[:3], (3, b"text", b"error\n"))
        busy = run(["/bin/sh", "-c", "i=0; while [ $i -lt 100000 ]; do i=$((i + 1)); done"])
        self.assertGreater(busy.seconds, .01)


class Pages(unittest.TestCase):
    def test_text_survives_the_parser(self):
        odd = "a < b && \"c\" > 'd' ]]> <!-- --> </title>\n\u00e9\u20ac\U0001f600"
        root = parsed(self, f'<p t="{escaped(odd)}">{escaped(odd)}</p>')
        self.assertEqual(root.text, odd)
        self.assertEqual(root.get("t"), odd.replace("\n", " "))  # XML's rule for values of attributes

    def test_what_is_no_text_is_replaced(self):
        for text, shown in ((b"\x01 \x7f\r", "? ??"), (b"\0", "?"), (b"\xe9t\xe9", "?t?"), (b"\xc0\xaf", "??"), (b"\xed\xa0\x80", "???"),
                            (b"\xf4\x90\x80\x80", "????"), (b"\xe2\x82<", "??&lt;"), (b"\xef\xbf\xbf", "?")):
            self.assertEqual(escaped(os.fsdecode(text)), shown.replace("?", "\ufffd"), text)

    def test_all_text_is_shown_as_given(self):
        page = Page(ODD, ODD)
        page.heading(ODD)
        page.note(ODD)
        page.banner("bad", ODD)
        page.command(ODD)
        page.lines(ODD)
        page.facts([(ODD, ODD)])
        table = Table([ODD, "n"], [[ODD, "1"], ["chosen", "2"]], 1)
        page.table(table)
        page.folded_table(ODD, table)
        page.figure("<svg/>", ODD)
        page.pictures([(b"bytes", ODD)])
        root = parsed(self, page.html())
        for path in ("head/title", ".//h1", ".//h2", ".//p[@class='note']", ".//p[@class='above']", ".//p[@class='banner bad']",
                     ".//pre[@class='command']", ".//table[@class='facts']//td[1]", ".//table[@class='facts']//td[2]", ".//summary",
                     "body/div//th[@class='text']", "body/figure/figcaption", ".//div[@class='pictures']//figcaption"):
            self.assertEqual(texts(root, path), [ODD], path)
        self.assertEqual([pre.text for pre in root.iter("pre") if not pre.get("class")], [ODD])
        rows = root.findall("body/div[@class='wide']//tbody/tr")
        self.assertEqual([(row.get("class"), texts(row, "td")) for row in rows], [(None, [ODD, "1"]), ("chosen", ["chosen", "2"])])
        image = root.find(".//img")
        self.assertEqual((image.get("alt"), image.get("src")), (ODD, "data:image/png;base64," + base64.b64encode(b"bytes").decode()))

    def test_options_in_a_table_stay_whole(self):
        """A line of the table may break between options, not between an option and its value."""
        page, cells = Page("title", "above"), ["-Sw c -Sn 512 <x>", "-1", "not -1"]
        page.table(Table(["", "n", ""], [cells]))
        page.table(Table(["", "n", ""], [cells], last_is_text=True))
        first, second = parsed(self, page.html()).findall("body/div")
        self.assertEqual(texts(first, ".//td"), cells)
        self.assertEqual(texts(first, ".//span"), ["-Sw c", "-Sn 512 <x>"])
        self.assertEqual(len(texts(first, ".//td[@class='text']")), 1)
        self.assertEqual(texts(second, ".//td[@class='text']"), ["-Sw c -Sn 512 <x>", "not -1"])


class Plots(unittest.TestCase):
    def test_axis_spreads_values_by_their_logarithms(self):
        axis = LogAxis(.01, 100, 0, 400)
        for value, at in ((.01, 0), (.1, 100), (100, 400)):
            self.assertAlmostEqual(axis.at(value), at)

    def test_ticks_are_few_and_round(self):
        for low, high in ((.5, 50), (.77, 1.3), (7.7, 13), (1e-9, 1e9), (1e-30, 1e30), (.002, 3)):
            ticks = LogAxis(low, high).ticks()
            self.assertTrue(3 <= len(ticks) <= 19, (low, high))
            self.assertEqual(ticks, sorted(set(ticks)))
            for tick in ticks:
                self.assertTrue(low <= tick <= high)
                digits = tick / 10 ** (math.floor(math.log10(tick) + 1e-9) - 1)
                self.assertAlmostEqual(digits, round(digits), delta=1e-6)

    def test_labels_do_not_overlap(self):
        """From .94 to 1.59 they used to be .94, .95, ..., 1, 1.1, ...: 12 pixels apart, with 25 for each label."""
        low = .1
        while low < 10:
            for ratio in (1.69, 1.8, 2.5, 4, 9, 30):
                axis = LogAxis(low, low * ratio, 0, 626)
                places = list(map(axis.at, axis.ticks()))
                self.assertGreaterEqual(len(places), 3, (low, ratio))
                self.assertGreaterEqual(min(b - a for a, b in zip(places, places[1:])), 30, (low, ratio))
            low *= 1.013

    def test_marks_are_where_the_ticks_say(self):
        plot = Plot("a < b", [(1, 100), (100, 1000)], Axis("time & more", " ms"), Axis("error", "%"))
        plot.mark((10, 100), 4, "#123456", "<hint>")
        plot.ring((100, 1000), "#654321")
        plot.legend("disc", "#123456", "one & two")
        root = parsed(self, plot.svg())
        mark, ring = root.find("circle[@fill='#123456']"), root.find("circle[@class='ring']")
        self.assertEqual(mark.find("title").text, "<hint>")

        def tick(axis, text):
            return next(float(tick.get(axis)) for tick in root.findall(f"text[@class='tick-{axis}']") if tick.text == text)
        self.assertAlmostEqual(float(mark.get("cx")), tick("x", "10 ms"), delta=.11)
        self.assertAlmostEqual(float(mark.get("cy")), tick("y", "100%") - 4, delta=.11)
        self.assertAlmostEqual(float(ring.get("cx")), tick("x", "100 ms"), delta=.11)
        self.assertLess(float(ring.get("cy")), float(mark.get("cy")))
        for text in ("a < b", "time & more", "error", "one & two"):
            self.assertIn(text, texts(root, "text"))

    def test_equal_values_have_an_axis_too(self):
        plot = Plot("", [(.25, .25)], Axis("x"), Axis("y"), True)
        plot.mark((.25, .25), 2, "red")
        self.assertNotRegex(plot.svg(), "nan|inf")
        self.assertTrue(plot.x.low < .25 < plot.x.high)

    def test_bars_are_as_long_as_their_values(self):
        root = parsed(self, bars_svg("t", [("<few", 10, "#111111"), ("many", 40, "#222222"), ("none", 0, "#333333")]))
        few, many, none = (float(root.find(f"rect[@fill='#{k}{k}{k}{k}{k}{k}']").get("width")) for k in (1, 2, 3))
        self.assertAlmostEqual(many, 4 * few, delta=.3)
        self.assertGreater(few, 0)
        self.assertEqual(none, 0)
        self.assertEqual(len(parsed(self, bars_svg("nothing", [])).findall(".//rect")), 1)

    def test_name_has_no_extension_of_another_format(self):
        for name in ("", "plan", "plan.SVG"):
            require_svg_name("-o", name, "the plan")
        self.assertEqual(fault_of(lambda: require_svg_name("-o", "a.b/plan.PNG", "the plan")),
                         '-o "a.b/plan.PNG": the plan is an SVG file; use the name a.b/plan.svg')


class Pictures(InAFolder):
    PIXELS = [1, 0, 0, 0, .5, 0, 0, 0, 2, .25, .25, .25, 0, 0, 0, 1, 1, 1]  # 3 times 2

    def test_png(self):
        data = pictures.png(3, 2, self.PIXELS)
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (3, 2))
        at = data.index(b"IDAT")
        rows = zlib.decompress(data[at + 4:at + 4 + struct.unpack(">I", data[at - 4:at])[0]])
        self.assertEqual(list(rows), [0, 255, 0, 0, 0, 128, 0, 0, 0, 255, 0, 64, 64, 64, 0, 0, 0, 255, 255, 255])

    def test_picture_of_radiance_is_read_by_rsphere(self):
        """A source in its colors; within a mantissa of eight bits."""
        name = os.path.join(self.folder.name, "p.hdr")
        pictures.write_picture(name, 3, 2, [1, .5, .25] * 6)
        scene = self.file(f'void colorpict c 7 red green blue {name} . .5 .5 0 0 c glow g 0 0 4 1 1 1 0 g source s 0 0 4 0 0 1 360\n', "s.rad")
        ended = subprocess.run([PROGRAMS + "/rsphere", "-S-", "-h-", "-w-", scene], input=b"0 0 0 0 0 1\n", capture_output=True, check=True)
        for found, wanted in zip(map(float, ended.stdout.split()), (1, .5, .25)):
            self.assertAlmostEqual(found, wanted, delta=.01)

    def test_other_formats(self):
        codec = os.path.join(PROGRAMS, "../lib/rsphere/openimageio.so")
        name = os.path.join(self.folder.name, "p.exr")
        if os.path.exists(codec):
            pictures.write_picture(name, 3, 2, self.PIXELS)
            with open(name, "rb") as stream:
                self.assertEqual(stream.read(4), b"\x76\x2f\x31\x01")
            self.assertIn("cannot write picture", fault_of(lambda: pictures.write_picture("p.nosuch", 3, 2, self.PIXELS)))
        else:
            self.assertIn("apt install rsphere-pictures", fault_of(lambda: pictures.write_picture(name, 3, 2, self.PIXELS)))

    def test_cannot_be_written(self):
        self.assertEqual(fault_of(lambda: pictures.write_picture("/nowhere/p.png", 3, 2, self.PIXELS)),
                         'cannot write picture "/nowhere/p.png": No such file or directory')

    def test_bands_are_as_bright_as_rsphere_says(self):
        bands = colors.bands_of_spectrum(7, 400, 750)
        self.assertEqual(bands.names[0], "725 nm")
        self.assertAlmostEqual(sum(bands.photopic), 1, delta=.01)
        self.assertGreater(bands.photopic[3], 5 * bands.photopic[0])
        self.assertEqual(round(min(bands.shown([0, 0, 0, 1, 0, 0, 0])), 9), 0)  # outside the gamut, brought to its border
        for channel in bands.shown([1] * 7):  # equal energy is white
            self.assertAlmostEqual(channel, 1, delta=.02)


if __name__ == "__main__":
    unittest.main()
