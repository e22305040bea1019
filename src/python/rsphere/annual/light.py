"""What sensors get of each patch of the sky and of the sun, in a room whose windows have shades: coefficients by passes of rays.

- The sky: patches of reinhart.cal, of radiance 1; all bounces.
- The sun: direct light by shadow rays to each of its positions in the hours, exact but for its width of half a degree;
  reflected light from positions on a grid of hours and seasons, between which it is interpolated, as fine as this asks for.
- Shades: each group of windows in either state, while all other groups are closed; what passes through closed ones is none.
"""
import os
import warnings
from dataclasses import replace

import numpy as np

import rsphere

from ..fault import Fault, write_text
from ..progress import PROGRESS
from .passes import FACTOR, FEW, SKY, SUN_SOLID_ANGLE, LoweredPass, Pass, product
from .shades import LOWERED, UP, states_by_rule
from .sky import daylight_of, with_sun
from .verdicts import FROM, SURE, UNTIL, Year, estimated

DECLINATION = 23.45  # degrees, the largest
DIM = 0.02  # of the mean light; darker sensors are inside of something
NEGLIGIBLE = 1e-3  # light with all groups closed, by that of the scene as it is drawn
LEFT_OUT = 0.005  # of the sun's light may come from positions that are not computed: a seventh of them
JUDGED = 192  # hours in which reflected sun is computed from the true position, too
REFLECTIONS = 2  # of the sun in these: they make most of what interpolation changes, and a fifth of the noise
JUDGES, MOST_JUDGES = 4, 32  # independent estimates of these: as many are added until it is sure whether interpolation changes more than
TOO_COARSE = 0.01  # of the light of an hour (rms); if it may, the grid is refined
ESTIMATES = 8  # independent sets of coefficients, from which standard errors follow


class SunGrid:
    """Positions of the sun on a grid of declinations and hour angles, and the weights by which directions lie between them."""

    def __init__(self, to_sun, latitude, seasons, hours, light=None):
        """seasons: the number of declinations; hours: between hour angles. light: of the directions. Positions that make little of it, such
        as those below the horizon, are left out, and their neighbors used instead."""
        north = np.radians(latitude)
        declination = np.arcsin(np.clip(np.sin(north) * to_sun[:, 2] + np.cos(north) * to_sun[:, 1], -1, 1))
        turn = np.arctan2(-to_sun[:, 0], np.cos(north) * to_sun[:, 2] - np.sin(north) * to_sun[:, 1])
        step = np.radians(2 * DECLINATION) / (seasons - 1), np.radians(15 * hours)
        u = np.clip((declination + np.radians(DECLINATION)) / step[0], 0, seasons - 1)
        v = turn / step[1]
        nodes, self.weights = {}, np.zeros((len(to_sun), 4))
        self.index = np.zeros((len(to_sun), 4), int)
        for k, (i, j) in enumerate((i, j) for i in (0, 1) for j in (0, 1)):
            a = np.minimum(np.floor(u).astype(int), seasons - 2) + i
            b = np.floor(v).astype(int) + j
            self.weights[:, k] = np.maximum(0, 1 - np.abs(u - a)) * np.maximum(0, 1 - np.abs(v - b))
            self.index[:, k] = [nodes.setdefault(key, len(nodes)) for key in zip(a, b)]
        d, t = np.array([(a * step[0] - np.radians(DECLINATION), b * step[1]) for a, b in nodes]).reshape(-1, 2).T
        up = np.maximum(0.002, np.sin(north) * np.sin(d) + np.cos(north) * np.cos(d) * np.cos(t))  # also beside a sun that is up
        across = np.stack([-np.cos(d) * np.sin(t), np.cos(north) * np.sin(d) - np.sin(north) * np.cos(d) * np.cos(t)])
        across *= np.sqrt(1 - up**2) / np.maximum(1e-12, np.hypot(*across))
        self.directions = np.stack([*across, up], axis=1)
        if light is not None and len(to_sun):
            self.leave_out(to_sun, np.bincount(self.index.ravel(), (self.weights * light[:, None]).ravel(), len(nodes)))
        self.exact = len(self.directions) >= len(to_sun)
        if self.exact:
            self.directions, self.index, self.weights = to_sun, np.arange(len(to_sun))[:, None], np.ones((len(to_sun), 1))

    def leave_out(self, to_sun, light):
        """Leaves out the positions with least light that together have LEFT_OUT of it."""
        order = np.argsort(light)
        kept = np.ones(len(light), bool)
        kept[order[np.cumsum(light[order]) < LEFT_OUT * light.sum()]] = False
        self.weights *= kept[self.index]
        sums = self.weights.sum(axis=1)
        self.directions = self.directions[kept]
        self.index = np.where(kept[self.index], np.cumsum(kept)[self.index] - 1, 0)
        near = sums > 0
        self.weights[near] /= sums[near, None]
        self.index[~near, 0], self.weights[~near, 0] = np.argmax(to_sun[~near] @ self.directions.T, axis=1), 1

    def between(self, coefficients):
        """Of coefficients (sensors, nodes): those of the directions, (sensors, directions)."""
        return sum(coefficients[:, index] * weights for index, weights in zip(self.index.T, self.weights.T))


def check_sky(files, polygons, folder):
    """Raises Fault if the scene has a sky: it would hide the one of the weather."""
    corners = np.concatenate([p.corners for p in polygons])
    low, high = corners.min(axis=0), corners.max(axis=0)
    away = 0.01 * np.linalg.norm(high - low)
    above = [[*(low + high)[:2] / 2, high[2] + away, 0, 0, 1]]
    path = write_text(os.path.join(folder, "sky.rad"), SKY)
    seen = rsphere.Scene([path, *files]).contributions(above, of=["rsphere_sky"], irradiance_at_origin=True, coefficients=True, ambient_bounces=1)
    rays = [[*(low + high)[:2] / 2, z, dx, dy, dz] for z, dz in ((high[2] + away, 1), (low[2] - away, -1)) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # there may be no light sources
        own = rsphere.Scene(files).trace(rays, outputs="vL", ambient_bounces=0)
    if not np.allclose(seen.value, np.pi, rtol=0.1) or (own.value.any(axis=1) & (own.first_length > 1e9)).any():
        raise Fault("the scene has a sky, or something above all of its polygons (or a file of blinds has it): leave it out; the sky is that of the weather")


def with_error(function, values):
    """The mean of function of values (estimates, sensors, hours), which gives (sensors, hours), and its standard error: by leaving out one
    estimate after the other, as all hours have the same paths (of squares that are hardly known, it is 1.4 times too large), and by the spread
    between hours, as far as it is no noise of single hours."""
    hours, n = function(values).mean(axis=0), len(values)
    parts = np.array([function(np.delete(values, i, axis=0)).mean(axis=0) for i in range(n)])
    together, alone = ((n - 1) / n * ((x - x.mean(axis=0)) ** 2).sum(axis=0) for x in (parts.mean(axis=1), parts))
    spread = (hours.var() / max(1, len(hours) - 1)) - alone.sum() / len(hours) ** 2
    return hours.mean(), np.sqrt(together + max(0, spread))


def square(values):
    """The square of the mean of independent values, without that of their noise: the mean product of two of them."""
    return (values.sum(axis=0) ** 2 - (values**2).sum(axis=0)) / (len(values) * (len(values) - 1))


def said(mean, error):
    """Words for the root of a mean square of relative changes that has a standard error."""
    most = np.sqrt(max(0, mean) + SURE * error)
    return f"{np.sqrt(mean):.2%} (rms; less than {most:.2%} by twice the noise)" if mean > 0 else f"less than {most:.2%} (rms, twice the noise)"


def by_states(parts, base, states):
    """All light: of Light.parts_of(), by states (hours, groups)."""
    return base + sum(np.where(states[:, g] == LOWERED, part[-1], part[UP]) for g, part in enumerate(parts))


def occupied_hours(rows):
    return int(((rows[:, 2] > FROM) & (rows[:, 2] < UNTIL)).sum())


class Light:
    """The light of a year at sensors, estimated again and again."""

    def __init__(self, files, sensors, weights, weather, groups, folder, settings, eyes=()):
        """files: the scene, without a sky. groups: of windows, of shades.group_of(). eyes: as sensors, for self.at_eyes."""
        self.settings = settings
        every = daylight_of(weather.hours, weather.place, FACTOR)
        lit = np.flatnonzero(every.luminance.any(axis=1))
        self.daylight = type(every)(*(part[lit] for part in every))
        self.dark_sun = every.dark
        rows = np.array(weather.hours, float).reshape(-1, 5)
        sunny = self.sunny = np.flatnonzero(self.daylight.sun)
        to_sun = self.daylight.to_sun[sunny]
        # Hours by which the grid is judged: each stands for an equal part of the sun's light.
        light = np.cumsum(self.daylight.sun[sunny])
        self.judged = np.searchsorted(light, (np.arange(JUDGED) + 0.5) / JUDGED * light[-1]) if len(sunny) else sunny
        self.year = Year(rows[lit, :3], None, None, None, self.daylight.diffuse, self.daylight.sun, weights, len(rows),
                         occupied_hours(rows))
        self.sums, self.counts, self.states = None, np.zeros(ESTIMATES, int), None
        self.idle = []  # names of groups whose blinds change nothing
        self.at_eyes = None  # lx by the observers of alpha_opic: (estimates, rows of by_observers(), hours), shades by the rule of LM-83
        self.open_at_eyes = None  # the same, shades up
        self.groups = groups
        seasons, step = settings.seasons, settings.hours
        while True:
            self.grid = SunGrid(to_sun, weather.place[0], seasons, step, self.daylight.sun[sunny])
            self.make_passes(files, folder, sensors, np.array(eyes), to_sun)
            self.changes = {}
            if self.grid.exact or settings.radiance or not self.too_coarse():
                break
            seasons, step = 2 * seasons - 1, step / 2

    def make_passes(self, files, folder, sensors, eyes, to_sun):
        settings, groups, n = self.settings, self.groups, len(self.groups)

        def made(kind, name, text, *of, files=files, own=settings):
            PROGRESS.advance()
            return kind(files, text, *of, folder, name, sensors, eyes, to_sun, self.grid.directions, own)

        def lowered(name, group, closed=""):
            """The group's blinds lowered, the other groups closed."""
            if group.parts is not None and (n > 1 or not self.base):
                return made(LoweredPass, name, closed, group)
            # Sun that blinds scatter is reflected sun: it makes nearly all of the noise behind them.
            own = replace(settings, sun_divisions=2 * settings.sun_divisions)
            return made(Pass, name, closed + group.lowered, files=[*group.files, *files], own=own)

        PROGRESS.begin("Direct sun", 2 * n + 1 + (n > 1))
        open_ = made(Pass, "open", "")
        self.base = made(Pass, "closed", "".join(g.closed for g in groups)) if n else None
        if n and self.base.sky(0, FEW).sum() < NEGLIGIBLE * open_.sky(0, FEW).sum():
            self.base = None  # there are no other windows
        self.passes = [[open_]]
        if n == 1:
            self.passes = [[open_, lowered("lowered", groups[0])]]
            self.base = None  # either pass has the light of the other windows
        elif n:
            closed = ["".join(g.closed for g in groups if g is not group) for group in groups]
            self.passes = [[made(Pass, f"open{i}", closed[i]), lowered(f"lowered{i}", g, closed[i])]
                           for i, g in enumerate(groups)]
        self.direct, self.base_direct = self.parts_of(lambda one: self.in_hours(one.direct))
        self.year.direct = (self.direct[:, UP].sum(axis=0) + self.base_direct)[: len(sensors)]

    def in_hours(self, coefficients):
        """lx of direct sun, from coefficients of the hours with sun."""
        lux = np.zeros((len(coefficients), len(self.daylight.sun)))
        lux[:, self.sunny] = coefficients * (self.daylight.sun[self.sunny] / SUN_SOLID_ANGLE)
        return lux

    def parts_of(self, light):
        """What comes through the windows of each group in each state, (groups, states, ...), and through all others. light: a function of a Pass."""
        base = light(self.base) if self.base else 0
        parts = np.array([[light(p) - (base if p.has_base else 0) for p in states] for states in self.passes])
        return parts, np.broadcast_to(base, parts.shape[2:])

    def lux_of(self, one, number):
        """One estimate of all light of a pass, but the direct sun: (sensors, hours)."""
        sky, sun = one.estimate(number)
        lux = product(sky, self.daylight.luminance)
        power = self.daylight.sun[self.sunny] / SUN_SOLID_ANGLE
        lux[:, self.sunny] += self.grid.between(sun) * power
        return lux

    def judge(self):
        """A function of numbers, that of one estimate of the judged hours: as of parts_of(), of lx of reflected sun from the true positions,
        and of what interpolation changes, (2, sensors, hours)."""
        hours = self.sunny[self.judged]
        nodes, index = np.unique(self.grid.index[self.judged], return_inverse=True)
        index, weights = len(hours) + index.reshape(-1, 4), self.grid.weights[self.judged]
        to_sun, power = np.concatenate([self.daylight.to_sun[hours], self.grid.directions[nodes]]), self.daylight.sun[hours] / SUN_SOLID_ANGLE
        together = {}  # by Pass

        def reflected(one, number):
            PROGRESS.advance()
            if one not in together:
                together[one] = one.reflected_together(to_sun)
            sun = together[one](number, min(REFLECTIONS, self.settings.bounces))
            exact = sun[:, : len(hours)] * power
            return np.array([exact, np.einsum("shk,hk->sh", sun[:, index], weights) * power - exact])

        return lambda number: self.parts_of(lambda one: reflected(one, number))

    def too_coarse(self):
        """Whether interpolation may change the light of hours with sun by more than TOO_COARSE. Finds by how much: self.changes."""
        hours, w, judge, found = self.sunny[self.judged], self.year.weights, self.judge(), []
        PROGRESS.begin("Positions of the sun", JUDGES * self.pass_count())
        direct, base_direct = self.direct[:, :, : len(w), hours], self.base_direct[: len(w), hours]
        sky, base_sky = self.parts_of(lambda one: product(one.first_sky[: len(w)], self.daylight.luminance[hours]))
        while len(found) < MOST_JUDGES:
            found += [judge(n) for n in range(len(found), len(found) + JUDGES)]
            (sun, off), (base_sun, base_off) = (np.moveaxis(np.array(light), -3, 0) for light in zip(*found))
            parts, base = sky + direct + sun.mean(axis=0), base_sky + base_direct + base_sun.mean(axis=0)
            states = {"": np.zeros((len(hours), len(parts)), int)}
            if len(self.passes[0]) > 1:
                states["with shades"] = states_by_rule(direct, np.einsum("i,gsih->gsh", w, parts), w)
            for how, of in states.items():
                lux = np.maximum(1e-9, by_states(parts, base, of))
                bright = lux.mean(axis=1) >= DIM * lux.mean()
                change = by_states(np.moveaxis(off, 0, -3), base_off, of)[:, bright]
                self.changes[how] = with_error(square, change / lux[bright]), with_error(lambda x: x.mean(axis=0), change / lux.mean())
            least, most = (max(mean + side * SURE * error for (mean, error), _ in self.changes.values()) for side in (-1, 1))
            if least > TOO_COARSE**2 or most <= TOO_COARSE**2:
                break
            PROGRESS.count += JUDGES * self.pass_count()
        return most > TOO_COARSE**2

    def add(self):
        """One more estimate, in Year's stacks."""
        number = int(self.counts.sum())
        parts, base = self.parts_of(lambda one: self.lux_of(one, number))
        parts, base = parts + self.direct, base + self.base_direct
        if number == 0:
            # By the light of the sky alone: reflected sun has more rays where blinds are lowered.
            self.idle = [g.name for g, (up, lowered) in zip(self.groups, self.passes) if np.array_equal(up.first_sky, lowered.first_sky)
                         or lowered.first_sky.sum() < NEGLIGIBLE * g.transmittance * up.first_sky.sum()] if self.groups else []
        if self.states is None and len(self.passes[0]) > 1:
            w = self.year.weights
            self.states = states_by_rule(self.direct[:, :, : len(w)], np.einsum("i,gsih->gsh", w, parts[:, :, : len(w)]), w)
        lux = up = base + parts[:, UP].sum(axis=0)
        if self.states is not None:
            lux = by_states(parts, base, self.states)
        if self.sums is None:
            self.sums = np.zeros((2, ESTIMATES, *lux.shape), np.float32)
        self.sums[:, number % ESTIMATES] += lux, up
        self.counts[number % ESTIMATES] += 1
        used = self.counts > 0
        (lux, up), n = self.sums[:, used] / self.counts[used, None, None], len(self.year.weights)
        self.year.lux, self.year.open, self.at_eyes, self.open_at_eyes = lux[:, :n], up[:, :n], lux[:, n:], up[:, n:]

    def keep(self, rows):
        """Leaves out all sensors but some, before the first estimate; there must be no eyes."""
        for one in [self.base] * bool(self.base) + [p for states in self.passes for p in states]:
            one.keep(rows)
        self.direct, self.base_direct, self.year.direct = self.direct[:, :, rows], self.base_direct[rows], self.year.direct[rows]
        self.year.weights = np.full(len(self.year.direct), 1 / max(1, len(self.year.direct)))

    def pass_count(self):
        return sum(map(len, self.passes)) + bool(self.base)

    def error(self):
        """Relative standard error of the light of the year at a sensor, rms of the sensors that have DIM of the mean or more."""
        light, error = estimated(lambda lux: lux.sum(axis=1), self.year.lux)
        bright = light > DIM * light.mean()
        return float(np.sqrt(((error[bright] / light[bright]) ** 2).mean())) if bright.any() else 0.0

    def notes(self):
        """Sentences on errors and shades."""
        yield f"{self.counts.sum()} independent estimates; the light of the year at a sensor has a standard error of {self.error():.2%} (rms)."
        if self.grid.exact and len(self.sunny):
            yield f"Direct and reflected sun come from the true positions of the sun, {len(self.grid.directions)} of them."
        elif self.changes:
            by = ", ".join(f"{how} by {said(*rms)}".strip() for how, (rms, _) in self.changes.items())
            (change, noise) = self.changes[""][1]
            yield (f"Direct sun is exact. Reflected sun is interpolated between {len(self.grid.directions)} positions, which changes the light of an "
                   f"hour with sun {by}, and that of all by {change:+.2%} +- {noise:.2%}.")
        if self.states is None:
            yield "There are no shades: name windows by --shades, so that the rule of LM-83 lowers blinds."
        else:
            lowered = self.states[self.year.occupied()].sum(axis=0)
            yield "Blinds are lowered, from 8 to 18 h: " + ", ".join(f"{n} h at {g.name}" for g, n in zip(self.groups, lowered)) + "."


def light_of_coefficients(coefficients, factor, weather):
    """The Year of given coefficients, whose patches have the light of the sun, too; and the hours as in Daylight.dark."""
    daylight = daylight_of(weather.hours, weather.place, factor)
    lit = np.flatnonzero(daylight.luminance.any(axis=1))
    rows = np.array(weather.hours, float).reshape(-1, 5)[:, :3]
    lux = (coefficients @ with_sun(daylight, factor)[lit].T)[None]
    return Year(rows[lit], lux, lux, None, daylight.diffuse[lit], daylight.sun[lit], np.full(len(coefficients), 1 / len(coefficients)),
                len(rows), occupied_hours(rows)), daylight.dark
