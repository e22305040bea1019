"""What sensors get of each patch of the sky and of the sun, in a room whose windows have shades: coefficients by passes of rays.

- The sky: patches of reinhart.cal, of radiance 1; all bounces.
- The sun: direct light by shadow rays to each of its positions in the hours, exact but for its width of half a degree;
  reflected light from positions on a grid of hours and seasons, between which it is interpolated.
- Shades: each group of windows in either state, while all other groups are closed; what passes through closed ones is none.
"""
import os
import warnings
from dataclasses import replace

import numpy as np

import rsphere

from ..fault import Fault, write_text
from ..progress import PROGRESS
from .passes import FACTOR, SKY, SUN_SOLID_ANGLE, LoweredPass, Pass, product
from .shades import LOWERED, UP, states_by_rule
from .sky import daylight_of, with_sun
from .verdicts import FROM, SURE, UNTIL, Year, estimated

DECLINATION = 23.45  # degrees, the largest
DIM = 0.02  # of the mean light; darker sensors are inside of something
NEGLIGIBLE, FEW = 1e-3, 64  # light with all groups closed, by that of the scene as it is drawn; rays of a sensor by which it is known
LEFT_OUT = 0.005  # of the sun's light may come from positions that are not computed: a seventh of them
JUDGED = 48  # hours in which reflected sun is computed from the true position, too, by two estimates
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
        return sum(coefficients[:, self.index[:, k]] * self.weights[:, k] for k in range(4))


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


def over_hours(values):
    """The mean of values (sensors, hours), and its standard error by the spread between hours."""
    hours = values.mean(axis=0)
    return hours.mean(), hours.std() / np.sqrt(max(1, len(hours) - 1))


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
        grid = self.grid = SunGrid(to_sun, weather.place[0], settings.seasons, settings.hours, self.daylight.sun[sunny])
        # Hours by which the grid is judged: each stands for an equal part of the sun's light.
        light = np.cumsum(self.daylight.sun[sunny])
        self.judged = np.searchsorted(light, (np.arange(JUDGED) + 0.5) / JUDGED * light[-1]) if len(sunny) else sunny
        self.year = Year(rows[lit, :3], None, None, None, self.daylight.diffuse, self.daylight.sun, weights, len(rows),
                         occupied_hours(rows))
        self.sums, self.counts, self.states, self.off, self.judged_lux = None, np.zeros(ESTIMATES, int), None, None, []
        self.idle = []  # names of groups whose blinds change nothing
        self.at_eyes = None  # lx by the observers of alpha_opic: (estimates, rows of by_observers(), hours), shades by the rule of LM-83
        self.open_at_eyes = None  # the same, shades up

        self.groups, n = groups, len(groups)

        def made(kind, name, text, *of, files=files, own=settings):
            PROGRESS.advance()
            return kind(files, text, *of, folder, name, sensors, np.array(eyes), to_sun, grid.directions, own)

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
        self.base_direct = self.in_hours(self.base.direct) if self.base else 0
        self.direct = np.array([[self.direct_of(p) for p in states] for states in self.passes])
        self.year.direct = (self.direct[:, UP].sum(axis=0) + self.base_direct)[: len(sensors)]

    def in_hours(self, coefficients):
        """lx of direct sun, from coefficients of the hours with sun."""
        lux = np.zeros((len(coefficients), len(self.daylight.sun)))
        lux[:, self.sunny] = coefficients * (self.daylight.sun[self.sunny] / SUN_SOLID_ANGLE)
        return lux

    def direct_of(self, one):
        """lx of direct sun through the windows of a pass that are not closed in all."""
        return self.in_hours(one.direct) - (self.base_direct if one.has_base else 0)

    def lux_of(self, one, number):
        """One estimate of all light of a pass, but the direct sun: (sensors, hours)."""
        sky, sun = one.estimate(number)
        lux = product(sky, self.daylight.luminance)
        power = self.daylight.sun[self.sunny] / SUN_SOLID_ANGLE
        lux[:, self.sunny] += self.grid.between(sun) * power
        if one is self.passes[0][UP]:
            self.judged_lux.append(lux[: len(self.year.weights), self.sunny[self.judged]])
        return lux

    def judge(self):
        """Finds by how much interpolation changes the reflected sun (lx) in the judged hours: (estimates, sensors, hours)."""
        nodes, index = np.unique(self.grid.index[self.judged], return_inverse=True)
        to_sun = np.concatenate([self.grid.directions[nodes], self.daylight.to_sun[self.sunny[self.judged]]])
        sun = self.passes[0][UP].reflected_together(to_sun, 2)[:, : len(self.year.weights)]
        between = np.einsum("eshk,hk->esh", sun[:, :, index.reshape(-1, 4)], self.grid.weights[self.judged])
        self.off = (between - sun[:, :, len(nodes) :]) * self.daylight.sun[self.sunny[self.judged]] / SUN_SOLID_ANGLE

    def add(self):
        """One more estimate, in Year's stacks."""
        number = int(self.counts.sum())
        base = self.lux_of(self.base, number) if self.base else 0
        parts = np.array([[self.lux_of(p, number) - (base if p.has_base else 0) for p in states] for states in self.passes]) + self.direct
        base = base + self.base_direct
        if number == 0:
            if len(self.judged) and not self.settings.radiance:
                self.judge()
            # By the light of the sky alone: reflected sun has more rays where blinds are lowered.
            self.idle = [g.name for g, (up, lowered) in zip(self.groups, self.passes) if np.array_equal(up.first_sky, lowered.first_sky)
                         or lowered.first_sky.sum() < NEGLIGIBLE * g.transmittance * up.first_sky.sum()] if self.groups else []
        if self.states is None and len(self.passes[0]) > 1:
            w = self.year.weights
            self.states = states_by_rule(self.direct[:, :, : len(w)], np.einsum("i,gsih->gsh", w, parts[:, :, : len(w)]), w)
        lux = up = base + parts[:, UP].sum(axis=0)
        if self.states is not None:
            lux = base + sum(np.where(self.states[:, g] == LOWERED, part[LOWERED], part[UP]) for g, part in enumerate(parts))
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
        self.direct, self.year.direct = self.direct[:, :, rows], self.year.direct[rows]
        if self.base:
            self.base_direct = self.base_direct[rows]
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
        if self.off is not None:
            lux = np.maximum(1e-9, np.mean(self.judged_lux, axis=0))
            # Products of different estimates are free of the squared noise.
            square, noise = over_hours(np.prod(self.off, axis=0) / lux**2)
            by = f"{np.sqrt(square):.2%} (rms)" if square > SURE * noise else f"less than {np.sqrt(max(0, square) + SURE * noise):.1%} (rms, twice the noise)"
            change, noise = over_hours(self.off.mean(axis=0) / lux.mean())
            yield (f"Direct sun is exact. Reflected sun is interpolated between {len(self.grid.directions)} positions, which changes the light of an "
                   f"hour with sun by {by}, and that of all by {change:+.2%} +- {noise:.2%}.")
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
