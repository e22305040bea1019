"""rsphere-annual: faults of weather files and coefficients are one line with file and line, and missing hours are left out."""
import os
import tempfile
import unittest

import numpy as np

from run_here import built, run_here

WEA = "place X\nlatitude 50\nlongitude -10\ntime_zone -15\nsite_elevation 100\nweather_data_file_units 1\n"
DAY = [f"6 1 {hour + 0.5:g} {300 * (6 < hour < 18)} {150 * (6 < hour < 18)}" for hour in range(24)]
EPW = "LOCATION,PLACE,-,X,src,1,50.0,10.0,1.0,100" + "\nX" * 7 + "\n"


def epw(place="P", irradiances="300,150"):
    """A day of an .epw that is dark but for one hour."""
    rows = (f"2000,6,1,{hour},60,C9{',1' * 8},{irradiances if hour == 12 else '0,0'},0,0\n" for hour in range(1, 25))
    return EPW.replace("PLACE", place) + "".join(rows)


def coefficients(order="<", header="", values=146 * 3, **changes):
    words = {"NROWS": "1", "NCOLS": "146", "NCOMP": "3", **changes}
    lines = "".join(f"{name}={word}\n" for name, word in words.items() if word)
    return f"#?RADIANCE\n{lines}{header}FORMAT=float\n\n".encode() + np.full(values, 0.01, order + "f4").tobytes()


class Annual(unittest.TestCase):
    def run_annual(self, weather, of_sky=None, name="w.wea"):
        with tempfile.TemporaryDirectory() as folder:
            for file, data in ((name, weather), ("co.f", of_sky or coefficients())):
                with open(os.path.join(folder, file), "wb") as stream:
                    stream.write(data if isinstance(data, bytes) else data.encode("latin-1"))
            before = os.getcwd()
            os.chdir(folder)
            try:
                run = run_here([built("rsphere-annual"), "--weather", name, "--coefficients", "co.f"])
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
        return float(out.split("Light of the year: ")[1].split()[0]), err

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

    def test_missing_hours_are_left_out_and_said(self):
        light, said = self.light(epw(irradiances="9999,9999"), name="w.epw")
        self.assertEqual(light, 0)
        self.assertIn("1 of 24 hours have no irradiance (9999)", said)
        self.refuse("w.epw:20: the direct normal irradiance", epw(irradiances="9998,1"), name="w.epw")

    def test_quotes_in_location(self):
        self.assertEqual(self.light(epw('"P, Q"'), name="w.epw")[0], self.light(epw(), name="w.epw")[0])

    def test_a_part_of_a_year_is_said(self):
        self.assertIn("has 24 hours, fewer than a year's 8760", self.light(WEA + "\n".join(DAY))[1])
        self.refuse("has 9600 rows, more than a year has hours", WEA + "\n".join(400 * DAY))

    def test_coefficients_of_the_other_byte_order(self):
        wea = WEA + "\n".join(DAY)
        self.assertEqual(self.light(wea)[0], self.light(wea, coefficients(">", "BigEndian=1\n"))[0])
        self.assertGreater(self.light(wea)[0], 0)

    def test_coefficients_of_another_shape(self):
        for said, made in (
            ("co.f: has coefficients of NCOMP=1", coefficients(NCOMP="1")),
            ("co.f: has 147 bins", coefficients(NCOLS="147")),
            ("co.f: its header lacks NROWS=", coefficients(NROWS="")),
            ("co.f: has 4 bytes of coefficients, not 1752", coefficients(values=1)),
            ("co.f: has no header with FORMAT=float", b"1 2 3"),
        ):
            with self.subTest(said):
                self.refuse(said, WEA + "\n".join(DAY), made)


if __name__ == "__main__":
    unittest.main()
