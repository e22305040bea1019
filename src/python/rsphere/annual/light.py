"""What sensors get of each patch of the sky and of the sun, in a room whose windows have shades: coefficients by passes of rays.

- The sky: patches of reinhart.cal, of radiance 1; all bounces.
- The sun: direct light by shadow rays to each of its positions in the hours, exact but for its width of half a degree;
  reflected light from positions on a grid of hours and seasons, between which it is interpolated.
- Shades: each group of windows in either state, while all other groups are closed; what passes through closed ones is none.
"""
import os
import warnings
from dataclasses import dataclass, replace

import numpy as np

import rsphere

from ..fault import Fault
from ..progress import PROGRESS
from .alpha_opic import BANDS, OBSERVERS, by_observers
from .shades import LOWERED, UP, states_by_rule
from .sky import daylight_of, with_sun
from .verdicts import FROM, UNTIL, Year, estimated

VISIBLE = np.array([0.265, 0.670, 0.065])  # shares of red, green and blue in what the eye sees
SUN_WIDTH = 0.533  # degrees, RADIANCE's
SUN_SOLID_ANGLE = 2 * np.pi * (1 - np.cos(np.radians(SUN_WIDTH / 2)))
FACTOR = 3  # of reinhart.cal: Tregenza's patches are divided into 3 x 3; light through narrow windows errs by .2% (rms of hours)
SKY = "void glow rsphere_sky 0 0 4 1 1 1 0\nrsphere_sky source rsphere_dome 0 0 4 0 0 1 360\n"
DECLINATION = 23.45  # degrees, the largest
SKY_WEIGHT, SUN_WEIGHT = 0.05, 0.3  # of a ray of a sensor, below which Russian roulette ends paths: least time for equal noise
DIM = 0.02  # of the mean light; darker sensors are inside of something
NEGLIGIBLE = 1e-3  # light with all groups closed, by that of the scene as it is drawn
MOST_AT_ONCE = 1 << 21  # coefficients
JUDGED = 16  # hours in which reflected sun is computed from the true position, too
ESTIMATES = 8  # independent sets of coefficients, from which standard errors follow


def sun_text(directions):
    return "".join(f"void light rsphere_sun{i} 0 0 3 1 1 1\nrsphere_sun{i} source rsphere_sun{i} 0 0 4 {x:.9g} {y:.9g} {z:.9g} {SUN_WIDTH}\n"
                   for i, (x, y, z) in enumerate(directions))


class SunGrid:
    """Positions of the sun on a grid of declinations and hour angles, and the weights by which directions lie between them."""

    def __init__(self, to_sun, latitude, seasons, hours):
        """seasons: the number of declinations; hours: between hour angles."""
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

    def between(self, coefficients):
        """Of coefficients (sensors, nodes): those of the directions, (sensors, directions)."""
        return sum(coefficients[:, self.index[:, k]] * self.weights[:, k] for k in range(4))


@dataclass
class Settings:
    """Of the rays."""

    bounces: int = 8
    divisions: int = 256  # for the sky
    sun_divisions: int = 32  # for reflected sun, whose rays take ten times as long
    seasons: int = 13  # declinations of the sun, and hours between its positions: by these the light of single hours errs by 1% in
    hours: float = 0.5  # a classroom with windows to the south
    threads: int = 0
    radiance: bool = False  # of rays instead of illuminance: cd/m2, without the disk of the sun


def check_sky(files, polygons, folder):
    """Raises Fault if the scene has a sky: it would hide the one of the weather."""
    corners = np.concatenate([p.corners for p in polygons])
    low, high = corners.min(axis=0), corners.max(axis=0)
    away = 0.01 * np.linalg.norm(high - low)
    above = [[*(low + high)[:2] / 2, high[2] + away, 0, 0, 1]]
    path = os.path.join(folder, "sky.rad")
    with open(path, "w", encoding="ascii") as stream:
        stream.write(SKY)
    seen = rsphere.Scene([path, *files]).contributions(above, of=["rsphere_sky"], irradiance_at_origin=True, coefficients=True, ambient_bounces=1)
    rays = [[*(low + high)[:2] / 2, z, dx, dy, dz] for z, dz in ((high[2] + away, 1), (low[2] - away, -1)) for dx in (-1, 0, 1) for dy in (-1, 0, 1)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # there may be no light sources
        own = rsphere.Scene(files).trace(rays, outputs="vL", ambient_bounces=0)
    if not np.allclose(seen.value, np.pi, rtol=0.1) or (own.value.any(axis=1) & (own.first_length > 1e9)).any():
        raise Fault("the scene has a sky, or something above all of its polygons (or a file of blinds has it): leave it out; the sky is that of the weather")


class Pass:
    """Light in a scene with some of its windows closed."""

    def __init__(self, files, text, folder, name, sensors, eyes, to_sun, reflected_from, settings):
        """to_sun: all directions of direct light; reflected_from: those of reflected light."""
        def scene(light, directions):
            path = os.path.join(folder, f"{name}_{light}.rad")
            with open(path, "w", encoding="latin-1") as stream:
                stream.write(text + (SKY if light == "sky" else sun_text(directions)))
            return rsphere.Scene([path, *files])

        self.sensors, self.eyes, self.reflected_from, self.settings = sensors, eyes, reflected_from, settings
        exact = np.concatenate([to_sun, reflected_from])
        self.by_sky = scene("sky", ())
        self.bins = {"files": "reinhart.cal", "parameters": f"MF={FACTOR}", "expression": "rbin", "count": "Nrbins"}
        self.by_sun = scene("sun", reflected_from) if len(exact) else None
        found = self.contributions(scene("direct", exact), exact, ambient_bounces=0) if len(exact) else np.zeros((len(sensors) + len(OBSERVERS) * len(eyes), 0))
        self.direct, self.direct_beside = found[:, : len(to_sun)], found[:, len(to_sun) :]

    def contributions(self, scene, suns=None, bins=None, **options):
        """Coefficients, illuminance for radiance 1: (rows, suns or bins). Rows are the sensors, and the eyes by each observer."""
        of = ["rsphere_sky"] if suns is None else [f"rsphere_sun{i}" for i in range(len(suns))]
        options = dict(dict(irradiance_at_origin=not self.settings.radiance, coefficients=True, samples=1, dt=0, dj=0, dv=suns is None or not
                            self.settings.radiance, threads=self.settings.threads), **options)
        chunks = np.array_split(self.sensors, -(-len(self.sensors) * (len(suns) if bins is None else 0) // MOST_AT_ONCE) or 1)
        rows = np.vstack([(scene.contributions(part, of=of, bins=bins, **options).value @ VISIBLE).reshape(len(part), -1) for part in chunks])
        if not len(self.eyes):
            return rows
        bands = scene.contributions(self.eyes, of=of, bins=bins, cs=BANDS, **options).value
        return np.vstack([rows, by_observers(bands.reshape(len(self.eyes), -1, BANDS))])

    def sky(self, number, divisions=None, bounces=None):
        """One estimate of the light of all patches."""
        divisions = divisions or self.settings.divisions
        return self.contributions(self.by_sky, bins=self.bins, ambient_bounces=bounces or self.settings.bounces, ambient_divisions=divisions,
                                  limit_weight=SKY_WEIGHT / divisions, rotation=number)

    def estimate(self, number):
        """One estimate of the light of all patches, and of the reflected light of the sun. number: of the estimate."""
        s = self.settings
        sky = self.sky(number)
        if number == 0:
            self.first_sky = sky
        PROGRESS.advance()
        sun = self.direct_beside
        if self.by_sun:
            sun = self.contributions(self.by_sun, self.reflected_from, ambient_divisions=s.sun_divisions,
                                     limit_weight=SUN_WEIGHT / s.sun_divisions, ambient_bounces=s.bounces, rotation=number) - sun
        PROGRESS.advance()
        return sky, sun


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
        grid = self.grid = SunGrid(to_sun, weather.place[0], settings.seasons, settings.hours)
        # Hours by which the grid is judged: each stands for an equal part of the sun's light.
        light = np.cumsum(self.daylight.sun[sunny])
        self.judged = np.searchsorted(light, (np.arange(JUDGED) + 0.5) / JUDGED * light[-1]) if len(sunny) else sunny
        reflected_from = np.concatenate([grid.directions, to_sun[self.judged]])
        self.year = Year(rows[lit, :3], None, None, None, self.daylight.diffuse, self.daylight.sun, weights, len(rows),
                         occupied_hours(rows))
        self.sums, self.counts, self.states, self.off = None, np.zeros(ESTIMATES, int), None, []
        self.idle = []  # names of groups whose blinds change nothing
        self.at_eyes = None  # lx by the observers of alpha_opic: (estimates, rows of by_observers(), hours), shades by the rule of LM-83
        self.open_at_eyes = None  # the same, shades up

        def made(name, *texts, blinds=()):
            PROGRESS.advance()
            # Sun that blinds scatter is reflected sun: it makes nearly all of the noise behind them.
            own = replace(settings, sun_divisions=2 * settings.sun_divisions) if name.startswith("lowered") else settings
            return Pass([*blinds, *files], "".join(texts), folder, name, sensors, np.array(eyes), to_sun, reflected_from, own)

        self.groups, n = groups, len(groups)
        PROGRESS.begin("Direct sun", max(1, 2 * n) + (n > 1))
        self.base, self.passes = None, [[made("open")]]
        if n == 1:
            self.passes = [[self.passes[0][0], made("lowered", groups[0].lowered, blinds=groups[0].files)]]
        elif n:
            closed = ["".join(g.closed for g in groups if g is not group) for group in groups]
            self.base = made("closed", *(g.closed for g in groups))
            if self.base.sky(0).sum() < NEGLIGIBLE * self.passes[0][0].sky(0).sum():
                self.base = None  # there are no other windows
            self.passes = [[made(f"open{i}", closed[i]), made(f"lowered{i}", closed[i], g.lowered, blinds=g.files)] for i, g in enumerate(groups)]
        direct = np.array([[self.direct_of(p) for p in states] for states in self.passes])
        self.direct = direct
        up = direct[:, UP].sum(axis=0) + (self.direct_of(self.base) if self.base else 0)
        self.year.direct = up[: len(sensors)]

    def direct_of(self, one):
        lux = np.zeros((len(one.direct), len(self.daylight.sun)))
        lux[:, self.sunny] = one.direct * (self.daylight.sun[self.sunny] / SUN_SOLID_ANGLE)
        return lux if one is self.base or not self.base else lux - self.direct_of(self.base)

    def lux_of(self, one, number):
        """One estimate of all light of a pass, but the direct sun: (sensors, hours)."""
        sky, sun = one.estimate(number)
        lux = sky.astype(np.float32) @ self.daylight.luminance.T
        power = self.daylight.sun[self.sunny] / SUN_SOLID_ANGLE
        reflected = self.grid.between(sun) * power
        lux[:, self.sunny] += reflected
        if one is self.passes[0][UP]:
            off = reflected[:, self.judged] - sun[:, len(self.grid.directions) :] * power[self.judged]
            n = len(self.year.weights)
            self.off.append((off[:n], lux[:n, self.sunny[self.judged]]))
        return lux

    def add(self):
        """One more estimate, in Year's stacks."""
        number = int(self.counts.sum())
        base = self.lux_of(self.base, number) if self.base else 0
        parts = np.array([[self.lux_of(p, number) - base for p in states] for states in self.passes]) + self.direct
        base = base + self.direct_of(self.base) if self.base else 0
        if number == 0:
            # By the light of the sky alone: reflected sun has more rays where blinds are lowered.
            self.idle = [g.name for g, (up, lowered) in zip(self.groups, self.passes)
                         if np.array_equal(up.first_sky, lowered.first_sky)] if self.groups else []
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
            one.sensors, one.direct, one.direct_beside = one.sensors[rows], one.direct[rows], one.direct_beside[rows]
        self.direct, self.year.direct = self.direct[:, :, rows], self.year.direct[rows]
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
        if self.off:
            off, lux, n = np.array([o for o, _ in self.off]), np.mean([lux for _, lux in self.off], axis=0), len(self.off)
            # Products of different estimates are free of the squared noise.
            square = (off.sum(axis=0) ** 2 - (off**2).sum(axis=0)) / max(1, n * (n - 1))
            rms = np.sqrt(max(0.0, (square / np.maximum(lux, 1e-9) ** 2)[lux > 0].mean()))
            yield (f"Direct sun is exact. Reflected sun is interpolated between {len(self.grid.directions)} positions, which changes the light of an "
                   f"hour with sun by {rms:.2%} (rms), and that of all by {off.mean(axis=0).sum() / max(lux.sum(), 1e-9):+.2%}.")
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
