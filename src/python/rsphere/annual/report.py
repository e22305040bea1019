"""The table of verdicts, what each sensor has, plans, and the page for the browser."""
import math
import os

import numpy as np

from ..fault import write_text
from ..page import Page, aligned, table
from .sensors import draw, draw_points
from .verdicts import quantities_of

HEAD = ["rule", "asked", "has", "+-", "met", "unsure sensors"]
HOURS = ", 8 to 18 h"
DRAWN = (("DA 300 lx", "autonomy", HOURS), ("UDI 300 to 3000 lx", "useful", HOURS), ("direct sun of 1000 lx", "sun", HOURS), ("sight angle", "view", ""))
WITHOUT_MEAN = ("distance of the view",)
DIGITS = {"sr": 2, "": 2}  # behind the point; 1 for other units


def shown(verdict, known):
    """The cells of a Verdict. known: whether there are errors."""
    unit, factor = ("%", 100) if verdict.share else (" h", 1)
    met = "" if math.isnan(verdict.least) else "yes" if verdict.met() else "!no"
    return [verdict.rule, verdict.asked, f"{factor * verdict.value:.1f}{unit}", f"{factor * verdict.error:.1f}" if known else "",
            met + (", noise could turn it" if verdict.hangs() else ""), str(verdict.unsure) if known and verdict.share else ""]


class Report:
    def __init__(self, year, verdicts, notes):
        """notes: sentences on what was computed."""
        self.year, self.verdicts, self.notes = year, verdicts, notes
        self.known = len(year.lux) > 1
        self.quantities = quantities_of(year)
        self.windows = []  # rows of a table, the first its head
        self.eyes = None  # places and gazes, and their quantities

    def add(self, verdicts, quantities, *notes):
        self.verdicts += verdicts
        self.quantities.update(quantities)
        self.notes += notes

    @property
    def sources(self):
        return list(dict.fromkeys(v.source for v in self.verdicts))

    def rows(self, source):
        return [shown(v, self.known) for v in self.verdicts if v.source == source]

    def means(self):
        """Of the quantities: name, mean of the sensors or eyes, its standard error if it is known, and whose mean it is."""
        parts = [(self.quantities, self.year.weights, "sensors")]
        if self.eyes:
            parts.append((self.eyes[1], np.full(len(self.eyes[0]), 1 / len(self.eyes[0])), "eyes"))
        for quantities, weights, whose in parts:
            for name, (values, errors, unit) in quantities.items():
                if name in WITHOUT_MEAN:
                    continue
                factor, digits = 100 if unit == "%" else 1, DIGITS.get(unit, 1)
                mean, error = (f"{factor * float(np.nansum(weights * x) / weights[~np.isnan(x)].sum()):.{digits}f}" for x in (values, errors))
                yield [name, f"{mean}{'' if unit in ('%', '') else ' '}{unit}", error if self.known else "", whose]

    def text(self):
        rows = {s: list(self.rows(s)) for s in self.sources}
        head, *table_lines = aligned([HEAD, *(row for s in self.sources for row in rows[s])], (0, 1, 4))
        lines = [*self.notes, ""]
        for name, mean, error, whose in self.means():
            lines.append(f"{name}: {mean}{' +- ' + error if error else ''}, mean of the {whose}")
        lines += ["", head]
        for s in self.sources:
            lines += [f"{s}:", *table_lines[: len(rows[s])]]
            del table_lines[: len(rows[s])]
        if self.windows:
            lines += ["", *("\t".join(row) for row in self.windows)]
        return "\n".join(lines) + "\n"

    def write(self, folder, name, text):
        write_text(os.path.join(folder, name), text)

    def write_places(self, folder, file, places, quantities):
        """A line for each sensor or eye: its place, what it has and the standard errors."""
        names = [word for name in quantities for word in (name, "+-")]
        lines = ["# " + "\t".join([*("x", "y", "z", "dx", "dy", "dz")[: places.shape[1]], *names])]
        for i, place in enumerate(places):
            cells = [f"{x:.5g}" for values, errors, unit in quantities.values() for x in np.array([values[i], errors[i]]) * (100 if unit == "%" else 1)]
            lines.append("\t".join([*(f"{x:.9g}" for x in place), *cells]))
        self.write(folder, file, "\n".join(lines) + "\n")

    def write_page(self, given, planes, sensors, polygons):
        """planes: the names of the work planes, and the indexes of their sensors; none of sensors of a file."""
        page = Page(given.title or "Daylight of a year")
        for note in self.notes:
            page.note(note)
        for source in self.sources:
            page.heading(source)
            page.add(table(HEAD, self.rows(source), 2))
        page.note("+-: standard error of what the room has. Unsure sensors are those that are within two standard errors of their limit.")
        if self.windows:
            page.heading("Sunlight")
            page.add(table(self.windows[0], self.windows[1:], 2))
        page.heading("Means")
        page.add(table(["quantity", "mean", "+-", "of"], list(self.means())))
        for quantity, file, hours in DRAWN if len(polygons) else ():
            if quantity not in self.quantities:
                continue
            values, _, unit = self.quantities[quantity]
            values = values * (100 if unit == "%" else 1)
            for name, chosen in planes or [("sensors", slice(None))]:
                path = os.path.join(given.output, f"{file}_{name}.svg" if len(planes) > 1 else f"{file}.svg")
                title = f"{quantity}{hours} ({unit}): {name}"
                page.figure(draw(given, name, values[chosen], unit, title, path) if planes else draw_points(sensors, polygons, values, unit, title, path))
        self.write(given.output, "page.html", page.html())
