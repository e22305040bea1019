"""The benchmark of layouts: each layout that is kept is allowed, and takes the watts that its table says; one is judged by traced light.

PROGRAMS in the environment is the folder of rsphere and plan; PYTHONPATH has the folder of the package rsphere.
"""
import os
import re
import subprocess
import unittest

import numpy as np

from rsphere.layout.design import read_design
from rsphere.layout.polish import not_allowed, read_layout
from rsphere.layout.room import read_polygons
from run_here import InAFolder, built, run_here

LAYOUT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../examples/layout")
CASES = os.path.join(LAYOUT, "cases")
ROOMS = {"glare": "office.rad", "rows": "office.rad", "daylight": "../../daylight/room.rad"}  # others are CASE.rad
MADE = {"paper": "../openplan/generate 50 | awk 'BEGIN { RS = \"\"; ORS = \"\\n\\n\" } !/ luminaire[0-9]/'", "large": "cases/large"}
ROW = re.compile(r"^\| `([a-z]+)` \|[^|]*\| ([0-9]+) W(?:, ([0-9]+) W dimmed)? \|", re.MULTILINE)  # what the best layout takes


class Cases(InAFolder):
    def room(self, case):
        if case in MADE:
            return self.file(subprocess.run(MADE[case], shell=True, cwd=LAYOUT, stdout=subprocess.PIPE, check=True).stdout, f"{case}.rad")
        return os.path.join(CASES, ROOMS.get(case, f"{case}.rad"))

    def test_layouts_of_the_table(self):
        with open(os.path.join(CASES, "README.md"), encoding="utf-8") as stream:
            rows = ROW.findall(stream.read())
        kept = {name.removesuffix(".txt") for name in os.listdir(os.path.join(CASES, "layouts"))}
        self.assertGreaterEqual(kept, {"hall", "museum", "street"})
        self.assertGreaterEqual({row[0] for row in rows}, kept)
        for case, watts, dimmed in rows:
            if case not in kept:
                continue
            with self.subTest(case=case):
                design = read_design(os.path.join(CASES, f"{case}.txt"), read_polygons([self.room(case)]))
                layout, levels = read_layout(os.path.join(CASES, f"layouts/{case}.txt"), design)
                self.assertEqual(not_allowed(design, layout), [])
                each = np.array([design.luminaires[c.luminaire].watts for c in layout])
                self.assertEqual(round(each.sum()), int(watts))
                self.assertEqual(round(np.mean(levels @ each)), int(dimmed or watts))

    def test_judged(self):
        """The street's, with fewer reflections, which light on a road hardly needs; and with half of its light."""
        layout = os.path.join(CASES, "layouts/street.txt")
        with open(layout, encoding="utf-8") as stream:
            head, *lines = stream.read().splitlines()
        halved = "\n".join([head, *(f"{' '.join(line.split()[:-1])} {float(line.split()[-1]) / 2:.6g}" for line in lines)])
        for file, status, words in (layout, 0, "All 8 goals are met"), (self.file(halved, "half.txt"), 2, "goals are not met"):
            run = run_here([built("rsphere-layout"), "--judge", file, "--no-plan", "-b", "2", "-d", "256", "-c", "16", "-o", self.folder.name,
                            os.path.join(CASES, "street.txt"), os.path.join(CASES, "street.rad")])
            self.assertEqual(run.returncode, status, run.stdout + run.stderr)
            self.assertIn(words, run.stdout)
            self.assertNotIn("Not allowed", run.stdout)


if __name__ == "__main__":
    unittest.main()
