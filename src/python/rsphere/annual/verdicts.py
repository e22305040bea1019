"""Verdicts on the daylight of a year: what rules ask for, what a room has, and which sensors noise could move to the other side.

Rules are those that public texts state; the standards themselves are sold. Each verdict names its source and edition.
"""
import math
from dataclasses import dataclass

import numpy as np

from .sun import day_of_year

SURE = 2.0  # standard errors: a sensor that is nearer to a limit may be on either side of it
ROUNDING = 1e-9  # of sums of areas
DAYLIT = 0.5  # of the hours of a year: 4380 (EN 17037)
FROM, UNTIL = 8, 18  # h, IES LM-83
SUNNY, SUNNY_HOURS = 1000, 250  # lx of direct sun; hours that may have it (LM-83's ASE)
EQUINOXES = (80, 264)  # days of the year
CLEAR_DAYS = 15  # before and after an equinox, among which LEED takes the clearest
LM83 = "IES LM-83-12; what the edition of 2023 changed was not read"
EN17037 = "EN 17037:2018+A1:2021, table A.1, over the half of all hours that has the most diffuse light"
LEED = "LEED v4.1 BD+C, Daylight"
WELL = "WELL v2, Q2 2025"
BREEAM = "BREEAM Hea 01 (2018), education"


@dataclass
class Year:
    """What sensors get in the hours in which the sun is up. Stacks have independent estimates first, which are averaged."""

    rows: np.ndarray  # (hours, 3): month, day, middle of the hour
    lux: np.ndarray  # (estimates, sensors, hours), shades by the rule of LM-83
    open: np.ndarray  # the same, shades up
    direct: np.ndarray  # (sensors, hours), by the sun alone, shades up: exact; None if it is not known
    diffuse: np.ndarray  # (hours), lx outside by the sky
    sun: np.ndarray  # (hours), lx by the sun on a surface that faces it
    weights: np.ndarray  # of the sensors: the share of the area that each stands for
    all_hours: int  # of the file, also those of night
    occupied_hours: int  # of these, from FROM to UNTIL h

    def occupied(self):
        return (self.rows[:, 2] > FROM) & (self.rows[:, 2] < UNTIL)

    def daylit(self):
        """The hours with most diffuse light."""
        chosen = np.zeros(len(self.rows), bool)
        chosen[np.argsort(-self.diffuse, kind="stable")[: self.daylit_hours()]] = True
        return chosen

    def daylit_hours(self):
        return max(1, int(DAYLIT * self.all_hours))


@dataclass
class Verdict:
    rule: str
    asked: str
    value: float
    least: float  # that is asked for
    source: str
    error: float = 0.0  # standard error of the value
    low: float = math.nan  # what it would be if all sensors that may be on either side of their limit were below it
    high: float = math.nan
    unsure: int = 0  # these sensors
    most: bool = False  # the share must be at most this
    share: bool = True  # the value is a share of the area, not a number of hours

    def met(self):
        return self.reached_by(self.value)

    def reached_by(self, value):
        return value <= self.least + ROUNDING if self.most else value >= self.least - ROUNDING

    def hangs(self):
        """Whether noise could turn the verdict."""
        if math.isnan(self.low):
            return False
        return self.reached_by(self.low) != self.reached_by(self.high)


def estimated(function, stack):
    """function of the mean of a stack, and its standard error by leaving out one estimate after the other (jackknife)."""
    mean, n = stack.mean(axis=0), len(stack)
    value = function(mean)
    if n < 2:
        return value, np.zeros_like(value)
    parts = np.array([function((n * mean - one) / (n - 1)) for one in stack])
    return value, np.sqrt((n - 1) / n * ((parts - parts.mean(axis=0)) ** 2).sum(axis=0))


def hours_of(limit, chosen, count):
    """A function of illuminances: for each sensor the share of count hours that are chosen and have at least a limit (lx)."""
    return lambda lux: (lux[:, chosen] >= limit).sum(axis=1) / count


def share(year, function, stack, limit, **verdict):
    """The Verdict on the share of the area whose function is at least a limit."""
    value, error = estimated(function, stack)
    passes, apart = value >= limit, value - limit
    unsure = np.abs(apart) < SURE * error
    with np.errstate(divide="ignore", invalid="ignore"):
        side = np.where(error > 0, apart / error, np.where(passes, np.inf, -np.inf))
    chance = np.array([0.5 * (1 + math.erf(s / math.sqrt(2))) for s in side])
    w = year.weights
    return Verdict(value=float(w @ passes), error=float(np.sqrt((w**2 * chance * (1 - chance)).sum())), unsure=int(unsure.sum()),
                   low=float(w @ (passes & ~unsure)), high=float(w @ (passes | unsure)), **verdict)


def autonomy(year, lux, least, asked, rule="sDA", source=LM83):
    name = f"{rule} {lux:g} lx / 50% of {FROM} to {UNTIL} h"
    return share(year, hours_of(lux, year.occupied(), year.occupied_hours), year.lux, 0.5, rule=name, asked=asked, least=least, source=source)


def sunny(year):
    """ASE. The direct sun is exact: no sensor is unsure."""
    many = (year.direct[:, year.occupied()] >= SUNNY).sum(axis=1) > SUNNY_HOURS
    return Verdict(f"ASE {SUNNY} lx / {SUNNY_HOURS} h", "at most 10%", float(year.weights @ many), 0.1, LM83, most=True)


def daylit(year, lux, area, name, source=EN17037):
    return share(year, hours_of(lux, year.daylit(), year.daylit_hours()), year.open, 0.5, rule=f"{name}: {lux} lx in half of the daylight hours",
                 asked=f"{area:.0%} of the area", least=area, source=source)


def equinox_rows(year):
    """For 9 and 15 h, and for either equinox: the two rows around this time on the day nearby with most sun. None if there is none."""
    month, day, hour = year.rows.T
    date = np.array([day_of_year(int(m), int(d)) for m, d in zip(month, day)])
    found = []
    for time in (9, 15):
        for equinox in EQUINOXES:
            near = np.flatnonzero((np.abs(hour - time) < 1) & (np.abs(date - equinox) <= CLEAR_DAYS))
            if not len(near):
                return None
            light = {d: year.sun[near[date[near] == d]].sum() for d in date[near]}
            found.append(near[date[near] == max(light, key=light.get)])
    return found


def within(rows):
    """A function of illuminances: 1 or more for sensors that have 300 to 3000 lx at 9 and at 15 h, each the mean of both equinoxes."""
    def function(lux):
        at = [(lux[:, a].mean(axis=1) + lux[:, b].mean(axis=1)) / 2 for a, b in (rows[:2], rows[2:])]
        return np.min([np.minimum(e / 300, 3000 / np.maximum(e, 1e-9)) for e in at], axis=0)
    return function


def hours_count(function, stack, limit, **verdict):
    """The Verdict on how many hours a year a number of all sensors reaches a limit."""
    hours, error = estimated(lambda lux: float((function(lux) >= limit).sum()), stack)
    return Verdict(value=hours, error=float(error), low=hours - SURE * error, high=hours + SURE * error, least=2000, share=False, **verdict)


def verdicts_of(year):
    """All Verdicts on a Year."""
    yield autonomy(year, 300, 0.55, "55%: nominally accepted")
    yield autonomy(year, 300, 0.75, "75%: preferred")
    if year.direct is not None:
        yield sunny(year)
    for level, target, least in (("minimum", 300, 100), ("medium", 500, 300), ("high", 750, 500)):
        yield daylit(year, target, 0.5, f"target, {level}")
        yield daylit(year, least, 0.95, f"minimum target, {level}")
    for points, area in ((1, 0.4), (2, 0.55), (3, 0.75)):
        yield autonomy(year, 300, area, f"{area:.0%}: {points} point{'s' * (points > 1)}", "option 1, sDA", LEED)
    rows = equinox_rows(year)
    for points, area in ((1, 0.55), (2, 0.75), (3, 0.9)) if rows else ():
        yield share(year, within(rows), year.open, 1, rule="option 2: 300 to 3000 lx at 9 and 15 h of clear days at the equinoxes",
                    asked=f"{area:.0%}: {points} point{'s' * (points > 1)}", least=area, source=LEED)
    yield autonomy(year, 150, 0.3, "30%", "L01, sDA", WELL)
    yield daylit(year, 200, 0.3, "L01", WELL)
    yield autonomy(year, 300, 0.55, "55%", "L06, sDA", WELL)
    yield daylit(year, 300, 0.5, "L06", WELL)
    yield hours_count(lambda lux: year.weights @ lux, year.open, 300, rule="hours with a mean of 300 lx", asked="2000 h", source=BREEAM)
    yield hours_count(lambda lux: lux.min(axis=0), year.open, 90, rule="hours with 90 lx at the worst point", asked="2000 h", source=BREEAM)


def quantities_of(year):
    """What sensors get, from FROM to UNTIL h: for each name the values of sensors, their standard errors, and a unit."""
    chosen, count = year.occupied(), year.occupied_hours
    beyond = np.nextafter(3000.0, np.inf)  # 3000 lx are still useful
    bands = (("UDI below 100 lx", 0, 100), ("UDI 100 to 300 lx", 100, 300), ("UDI 300 to 3000 lx", 300, beyond),
             ("UDI above 3000 lx", beyond, np.inf))

    def between(low, high):
        return lambda lux: ((lux[:, chosen] >= low) & (lux[:, chosen] < high)).sum(axis=1) / count + (low == 0) * (1 - chosen.sum() / count)

    found = {"DA 300 lx": (*estimated(hours_of(300, chosen, count), year.lux), "%"),
             "cDA 300 lx": (*estimated(lambda lux: np.minimum(lux[:, chosen] / 300, 1).sum(axis=1) / count, year.lux), "%")}
    for name, low, high in bands:
        found[name] = (*estimated(between(low, high), year.lux), "%")
    if year.direct is not None:
        found["direct sun of 1000 lx"] = ((year.direct[:, chosen] >= SUNNY).sum(axis=1).astype(float), np.zeros(len(year.weights)), "h")
    found["light of the year"] = (*estimated(lambda lux: lux.sum(axis=1) / 1000, year.lux), "klx h")
    return found
