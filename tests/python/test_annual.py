"""rsphere-annual with coefficients of a file: faults of it and of weather files are one line with file and line, and nothing that
is left out is left out silently."""
import gzip
import os
import re
import tempfile
import unittest

import numpy as np

from rsphere.annual.sky import daylight_of, patches
from rsphere.annual.sun import sun_position
from run_here import built, run_here

WEA = "place X\nlatitude 50\nlongitude -10\ntime_zone -15\nsite_elevation 100\nweather_data_file_units 1\n"
DAY = [f"6 1 {hour + 0.5:g} {300 * (6 < hour < 18)} {150 * (6 < hour < 18)}" for hour in range(24)]
EPW = "LOCATION,PLACE,-,X,src,1,50.0,10.0,1.0,100" + "\nX" * 7 + "\n"


def epw(place="P", irradiances="300,150"):
    """A day of an .epw that is dark but for one hour, and another that is as bright unless `irradiances` are given."""
    lit = {12: irradiances, 13: "300,150"}
    rows = (f"2000,6,1,{hour},60,C9{',1' * 8},{lit.get(hour, '0,0')},0,0\n" for hour in range(1, 25))
    return EPW.replace("PLACE", place) + "".join(rows)


def coefficients(order="<", header="", values=146 * 3, **changes):
    words = {"NROWS": "1", "NCOLS": "146", "NCOMP": "3", "FORMAT": "float", **changes}
    lines = "".join(f"{name}={word}\n" for name, word in words.items() if word)
    numbers = np.full(values, 0.01, order + ("f8" if words["FORMAT"] == "double" else "f4")).tobytes()
    if words["FORMAT"] == "ascii":
        numbers = "\n".join(values * ["1e-2"]).encode() + b"\n"
    return f"#?RADIANCE\n{lines}{header}\n".encode() + numbers


class Annual(unittest.TestCase):
    def run_annual(self, weather, of_sky=None, name="w.wea"):
        with tempfile.TemporaryDirectory() as folder:
            for file, data in ((name, weather), ("co.f", coefficients() if of_sky is None else of_sky)):
                with open(os.path.join(folder, file), "wb") as stream:
                    stream.write(data if isinstance(data, bytes) else data.encode("latin-1"))
            before = os.getcwd()
            os.chdir(folder)
            try:
                run = run_here([built("rsphere-annual"), name, "co.f"])  # --weather name --coefficients co.f
            finally:
                os.chdir(before)
        return run.returncode, run.stdout, run.stderr

    def refuse(self, said, *arguments, **named):
        status, out, err = self.run_annual(*arguments, **named)
        self.assertEqual((status, out, err.count("\n")), (1, "", 1), err)
        self.assertIn(said, err)

    def light(self, *arguments, **named):
        status, out, err = self.run_annual(*arguments, **named)
        self.assertEqual(status, 0, err)
        return float(out.split("light of the year: ")[1].split()[0]), err

    def test_rows_of_wea_are_checked(self):
        for row, said in (
            ("6 1 nan 1 1", "the hour must be a number"), ("6 1 25 1 1", "the hour must be from 0 to 24"),
            ("0 1 1 1 1", "the month must be from 1 to 12"), ("2.5 1 1 1 1", "the month must be a whole number"),
            ("6 31 1 1 1", "the day must be from 1 to 30"), ("6 1 1 9999 1", "the direct normal irradiance must be from 0"),
            ("6 1 1 1 -100", "the diffuse horizontal irradiance must be from 0"),
            ("6 1 1 inf 1", "the direct normal irradiance must be a number"),
            ("6 1 1", "an hour is month, day, hour"),
        ):  # fmt: skip
            with self.subTest(row):
                self.refuse(f"rsphere-annual: fatal - w.wea:7: {said}", WEA + row)

    def test_headers_of_wea_are_checked(self):
        self.refuse("w.wea:2: the latitude must be from -90 to 90", WEA.replace("50", "200") + DAY[12])
        self.refuse("w.wea:2: the latitude must be a number", WEA.replace("50", "north") + DAY[12])
        self.refuse("w.wea:6: weather_data_file_units must be 1", WEA.replace("units 1", "units 2") + DAY[12])
        self.refuse("w.wea:6: the header lacks latitude", WEA.replace("latitude 50\n", "") + DAY[12])
        self.refuse("has no hours", WEA)
        self.refuse("has no hours", "")
        self.refuse("has no hours", EPW, name="w.epw")
        self.refuse("has no hour from 8 to 18 h", WEA + DAY[2])
        self.refuse("has no hour with diffuse light", WEA + "6 1 12.5 0 0")

    def test_missing_hours_are_left_out_and_said(self):
        light, said = self.light(epw(irradiances="9999,9999"), name="w.epw")
        self.assertLess(light, 0.6 * self.light(epw(), name="w.epw")[0])
        self.assertGreater(light, 0)
        self.assertIn("1 of 24 hours have no irradiance (9999)", said)
        self.refuse("w.epw:20: the direct normal irradiance", epw(irradiances="9998,1"), name="w.epw")

    def test_quotes_in_location(self):
        self.assertEqual(self.light(epw('"P, Q"'), name="w.epw")[0], self.light(epw(), name="w.epw")[0])

    def test_a_part_of_a_year_is_said(self):
        self.assertIn("has 24 hours, fewer than a year's 8760; shares are of these hours", self.light(WEA + "\n".join(DAY))[1])
        self.refuse("w.wea:31: the hour is not after", WEA + "\n".join(400 * DAY))

    def test_coefficients_of_the_other_byte_order(self):
        wea = WEA + "\n".join(DAY)
        self.assertEqual(self.light(wea)[0], self.light(wea, coefficients(">", "BigEndian=1\n"))[0])
        self.assertGreater(self.light(wea)[0], 0)

    def test_order_of_hours(self):
        """Repeated hours counted twice, and a file backwards was as good as any."""
        self.refuse("w.wea:31: the hour is not after the one before it", WEA + "\n".join(DAY + DAY))
        self.refuse("w.wea:8: the hour is not after the one before it", WEA + "\n".join(DAY[::-1]))
        self.refuse("w.wea:8: the hour is not after", WEA + f"{DAY[12]}\n{DAY[12]}")

    def test_a_place_on_the_other_side_of_the_earth(self):
        """The sun was down by day, and its light was left out without a word."""
        self.assertEqual(self.light(WEA + "\n".join(DAY))[1].count("\n"), 1)
        said = self.light(WEA.replace("time_zone -15", "time_zone 165") + "\n".join(DAY))[1]
        self.assertRegex(said, "[0-9]+% of the direct light is at hours without a sun or without diffuse light, such as 6-1 at [0-9.]+ h; are its latitude")

    def test_direct_light_of_nights(self):
        """Some files have direct light without diffuse light before and after the day: it is not the place that is wrong."""
        light, said = self.light(WEA + "\n".join(DAY).replace("6 1 19.5 0 0", "6 1 19.5 300 0"))
        self.assertIn("8% of the direct light is at hours without diffuse light, such as 6-1 at 19.5 h, and left out\n", said)
        self.assertEqual(light, self.light(WEA + "\n".join(DAY))[0])

    def test_kinds_of_coefficients(self):
        wea = WEA + "\n".join(DAY)
        for made in (coefficients(FORMAT="ascii"), coefficients(FORMAT="double"), coefficients(NCOMP="1", values=146)):
            self.assertAlmostEqual(self.light(wea)[0], self.light(wea, made)[0], delta=0.01 * self.light(wea)[0])
        self.refuse("co.f: has a coefficient that is not a number", wea, coefficients(FORMAT="ascii") + b"x\n")
        self.refuse("co.f: has 439 coefficients, not 438", wea, coefficients(FORMAT="ascii") + b"1\n")
        self.refuse("co.f: has a coefficient below 0", wea, coefficients(FORMAT="ascii")[:-5] + b"-1\n")

    def test_files_of_other_kinds(self):
        """What was taken for weather or coefficients without a word, or was refused by a line without its place."""
        good, e = WEA + "\n".join(DAY) + "\n", epw()
        hours = lambda direct, diffuse: WEA + "\n".join(f"6 1 {h + 0.5} {direct * (6 < h < 18)} {diffuse * (6 < h < 18)}" for h in range(24))  # noqa: E731
        for said, weather, of_sky in (
            ("w.wea:1: is not a text file", good.encode("utf-16"), None), ("w.wea:1: is not a text file", gzip.compress(good.encode()), None),
            ("w.wea:1: the header lacks place", good.replace(" ", ";"), None), ("w.wea:1: the header lacks place", "<html>404</html>\n", None),
            ("w.wea:3: latitude is in line 2 already", good.replace("latitude 50", "latitude 50\nlatitude -50"), None),
            ("w.wea:1: the header lacks place", "\n".join(DAY) + "\n" + WEA, None), ("w.wea:19: the hour must be a number, not \"12,5\"; decimals", good.replace("12.5", "12,5"), None),
            ("w.wea:8: is 0.25 h after the row before it; each row must be an hour", WEA + "6 1 12 1 1\n6 1 12.25 1 1\n", None),
            ("w.wea:7: an hour is month, day, hour, direct normal and diffuse irradiance, not 6 words", WEA + "2020 6 1 12.5 300 100\n", None),
            ("w.wea:7: the day must be from 1 to 29", WEA + "2 30 12.5 300 100\n", None), ("w.wea:7: the direct normal irradiance must be from 0 to 1500", WEA + "6 1 12.5 -999 0\n", None),
            ("w.wea:1: the fields of an .epw are separated by commas", e.replace(",", ";"), None), ("w.wea:2: is an hour, but an .epw has 8 lines", "\n".join(e.split("\n")[:1] + e.split("\n")[8:]), None),
            ("w.wea:9: an hour has at least 16 fields", "\n".join(["LOCATION" + e.split("LOCATION")[1].split("\n")[0], "X", *e.split("\n")[1:]]), None),
            ("w.wea:1: the time zone must be from -15 to 15", e.replace(",1.0,100", ",60,100"), None), ("w.wea:20: the direct normal irradiance must be a number, not \"-\"", epw(irradiances="-,-"), None),
            ("w.wea:9: the hour must be from 1 to 24", e.replace("2000,6,1,1,60", "2000,6,1,0,60"), None), ("w.wea:1: LOCATION has 2 fields", e.replace("LOCATION,P", 'LOCATION,"P'), None),
            ("co.f: has no header with FORMAT=ascii", good, b""), ("co.f: has no header", good, gzip.compress(coefficients())), ("co.f: has 0 bytes", good, coefficients(values=0)),
            ("co.f: has a coefficient that is not a finite", good, coefficients(FORMAT="ascii").replace(b"1e-2", b"nan", 1)),
            ("co.f: has a coefficient that is not a number: \"1?0\"", good, coefficients(FORMAT="ascii").replace(b"1e-2", b"1_0", 1)),
            ("co.f: its header lacks NROWS=, a whole number", good, coefficients(NROWS="-1")), ("co.f: has 1 bins", good, coefficients(NROWS="146", NCOLS="1")),
            ("co.f: has 1752 bytes of coefficients, not 1751999998248", good, coefficients(NROWS="999999999")), ("co.f: its BigEndian= must be 0 or 1", good, coefficients(header="BigEndian=2\n")),
            ("co.f: has a sensor whose coefficients add up to 1.46e+03, more than pi", good, coefficients(FORMAT="ascii").replace(b"1e-2", b"10")),
            ("co.f: has 8760 bins", good, coefficients(NCOLS="8760", values=8760 * 3)),
        ):  # fmt: skip
            with self.subTest(said):
                self.refuse(f"rsphere-annual: fatal - {said}", weather, of_sky)
        for said, weather, of_sky in (
            ("the meridian of the time zone, 1 degrees, is at no quarter of an hour", good.replace("time_zone -15", "time_zone -1"), None),
            ("no hour has more than 5% of the irradiance outside", hours(0.3, 0.15), None), ("11 of 11 hours with a high sun have more irradiance", hours(1080, 540), None),
            ("11 of 11 hours with a high sun have more irradiance", hours(50, 1400), None),
            ("co.f: 1 of 2 sensors have coefficients of 0 alone", good, coefficients(FORMAT="ascii", NROWS="2", values=876).replace(b"1e-2\n", b"0\n", 438)),
        ):  # fmt: skip
            with self.subTest(said):
                self.assertIn(said, self.light(weather, of_sky)[1])
        for weather in (b"\xef\xbb\xbf" + good.encode(), good.replace(" ", "\t"), good.replace("\n", "\r\n"), good.replace("place X", "place New York")):
            self.assertEqual(self.light(weather), self.light(good))
        self.assertEqual(self.light(e.replace(",", ", ").replace("LOCATION, ", "LOCATION,"), name="w.epw"), self.light(e, name="w.epw"), "blanks before fields")
        self.assertEqual(self.light(WEA + "2 29 12.5 300 100\n")[1].count("\n"), 1, "one hour")

    def test_misspelt_options(self):
        """-time was read as -t ime, and the next word as a scene."""
        for command, words, nearest in (("annual", ("-time", "8"), "--title"), ("annual", ("--wether", "w"), "--weather"), ("annual", ("-weather=w",), "--weather"),
                                        ("annual", ("--quite", "w"), None), ("layout", ("-secnds", "8"), "--seconds"), ("luminaire", ("--unit", "m"), "--units")):
            with self.subTest(words):
                run = run_here([built("rsphere-" + command), *words, "a", "b"])
                hint = f'; the nearest is "{nearest}"' if nearest else ""
                self.assertEqual((run.returncode, run.stdout, run.stderr), (1, "", f"rsphere-{command}: fatal - command line error at '{words[0].split('=')[0]}': "
                                                                                   f"there is no such option{hint}; see -help\n"))
        run = run_here([built("rsphere-annual"), "-n1", "--weather=none.epw", "a.rad"])
        self.assertEqual((run.returncode, run.stderr), (1, "rsphere-annual: fatal - none.epw: cannot be read: No such file or directory\n"), "glued values")

    def test_the_sun_of_a_leap_day(self):
        """It was that of 28 February; gensky 2 29 and 3 1, and gendaymtx, have the sun of 1 March: beside -a 47 -o -8 -m -15."""
        before, leap, after = (sun_position(month, day, 12, 47, 8, 15) for month, day in ((2, 28), (2, 29), (3, 1)))
        self.assertEqual(leap, after)
        self.assertAlmostEqual(np.degrees(after[0] - before[0]), 0.375, delta=0.01)
        self.assertAlmostEqual(np.sin(leap[0]), 0.5588, delta=0.002)
        days = [WEA + "".join(f"{date} {hour}.5 300 100\n" for hour in range(7, 18)) for date in ("2 28", "2 29", "3 1")]
        light = [self.light(text)[0] for text in days]
        self.assertEqual(light[1], light[2])
        self.assertNotEqual(light[0], light[1])

    def test_weather_that_is_surely_wrong(self):
        """Of many hours it is refused, with the first line that is: it was computed with a warning, in one case to not a number."""
        def of_days(direct=300, diffuse=150, header=WEA):
            return header + "\n".join(f"6 {day} {h + 0.5} {direct * (6 < h < 18)} {diffuse * (6 < h < 18)}" for day in range(1, 11) for h in range(24)) + "\n"
        self.assertGreater(self.light(of_days())[0], 0)
        for said, weather in (
            ("w.wea:15: 73% of the direct light is at hours without a sun or without diffuse light, such as 6-1 at 8.5 h", of_days(header=WEA.replace("longitude -10", "longitude 170"))),
            ("w.wea:7: 33% of the diffuse light is at hours without a sun", WEA + "\n".join(f"6 {day} {h + 0.5} 0 200" for day in range(1, 11) for h in range(24)) + "\n"),
            ("w.wea:14: 110 of 110 hours with a high sun have more irradiance than there is outside", of_days(150, 1400)),
            ("w.wea: no hour has more than 5% of the irradiance outside", of_days(0.3, 0.15)),
            ("w.wea:1: the fields of an .epw are separated by commas alone", epw().replace(",", " , ")),
            ("w.wea:32: has 17 fields, fewer than the rows before it: the file is cut off", epw()[:-3]),
        ):  # fmt: skip
            with self.subTest(said):
                self.refuse(f"rsphere-annual: fatal - {said}", weather)
        for dark in (coefficients(">"), coefficients(FORMAT="ascii").replace(b"1e-2", b"0")):
            self.refuse("rsphere-annual: fatal - co.f: all sensors have coefficients of 0 alone, or nearly so; is BigEndian= right?", of_days(), dark)

    def test_luminances_of_weather_that_cannot_be(self):
        """Where Perez's model has no sky at all, the sky is even; it was not a number."""
        rows = [[5, 6, 12.5, 0.556, 0.268], [5, 10, 12.5, 0.648, 0.263], [5, 6, 12.5, 556, 268]]
        found = daylight_of(rows, [41.98, -87.92, -90.0], 3)
        self.assertTrue(np.isfinite(found.luminance).all())
        directions, solid_angles = patches(3)
        np.testing.assert_allclose(found.luminance @ (solid_angles * np.maximum(0, directions[:, 2])), found.diffuse, rtol=1e-4)
        self.assertEqual(np.ptp(found.luminance[0, 1:]), 0)
        self.assertGreater(np.ptp(found.luminance[2, 1:]), 0)

    def test_any_word_replaced(self):
        """A line of fault with its place, or numbers; never a traceback, and never silence about what was not understood."""
        words = ["nan", "-1", "1e99", "", "x", "9999", "1,5", "0x1", "\0", "\u0663", "24.5", "1 1"]
        random = np.random.default_rng(5)
        for name, text in (("w.wea", WEA + "\n".join(DAY)), ("w.epw", epw())):
            for k, word in enumerate(words):
                lines = text.split("\n")
                row = int(random.integers(0, 6)) if k % 3 == 0 and name == "w.wea" else int(random.integers(6 if name == "w.wea" else 8, len(lines) - 1))
                parts = lines[row].split("," if name == "w.epw" else " ")
                place = int(random.choice([1, 2, 3, 14, 15] if name == "w.epw" else range(len(parts))))
                parts[place] = word
                lines[row] = ("," if name == "w.epw" else " ").join(parts)
                with self.subTest(word=word, row=row, place=place):
                    status, out, err = self.run_annual("\n".join(lines).encode(), name=name)
                    self.assertNotIn("Traceback", err)
                    if status:
                        self.assertEqual((status, out, err.count("\n")), (1, "", 1), err)
                        self.assertRegex(err, rf"^rsphere-annual: fatal - {re.escape(name)}(:[0-9]+)?: ")
                    else:
                        self.assertNotIn("nan", out)

    def test_command_lines(self):
        for words, said in (([], "needs --weather FILE"), (["--weather", "w"], "needs scene files, or --coeff"),
                            (["--weather", "w", "r.rad", "-d", "x"], "argument -d/--divisions: invalid int"),
                            (["--weather", "w", "r.rad", "--spacing", "0"], "--spacing must be from 1e-06"),
                            (["--weather", "nowhere", "r.rad"], "nowhere: cannot be read: No such file"), (["w.epw", "r.rad"], "w.epw: cannot be read: No such file"),
                            (["w.epw"], "needs scene files, or --coefficients alone"), (["r.rad", "w.epw"], "w.epw: cannot be read: No such file"),
                            (["a.wea", "r.rad", "b.epw"], "a.wea and b.epw are weather, of which there is one"), (["a.wea", "--weather", "b", "r.rad"], "b and a.wea are weather"),
                            (["a.wea", "r.rad", "--day", "3-1"], "--day needs --sunlight NAME"), (["a.wea", "r.rad", "--sun-altitude", "9"], "--sun-altitude needs --sunlight"),
                            (["a.wea", "r.rad", "--landscape", "x"], "--landscape needs --view H"), (["a.wea", "r.rad", "--view", "1", "--landscape", "ground"], "--landscape ground: is ground, too"),
                            (["a.wea", "r.rad", "--sensors", "s", "--margin", "1"], "--margin belongs to a grid"), (["a.wea", "r.rad", "--sensors", "s", "--height", "1"], "--height is that of a grid"),
                            (["a.wea", "--coefficients", "c", "--shades", "pane"], "--shades needs scene files instead of"), (["a.wea", "--coefficients", "c", "-d", "99"], "-d needs scene files"),
                            (["--weather", "w", "r.rad", "--on", "a", "--sensors", "s"], "not both"),
                            (["--weather", "w", "r.rad", "--shades", "pane=r.rad"], "--shades pane=r.rad: is a file of the scene")):
            with self.subTest(words):
                run = run_here([built("rsphere-annual"), *words])
                self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (1, "", 1), run.stderr)
                self.assertIn(said, run.stderr)

    def test_coefficients_of_another_shape(self):
        for said, made in (
            ("co.f: has coefficients of NCOMP=2", coefficients(NCOMP="2")),
            ("co.f: has 147 bins", coefficients(NCOLS="147")),
            ("co.f: its header lacks NROWS=", coefficients(NROWS="")),
            ("co.f: has 4 bytes of coefficients, not 1752", coefficients(values=1)),
            ("co.f: has no header with FORMAT=ascii", b"1 2 3"),
        ):
            with self.subTest(said):
                self.refuse(said, WEA + "\n".join(DAY), made)


if __name__ == "__main__":
    unittest.main()
