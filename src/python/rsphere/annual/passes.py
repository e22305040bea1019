"""Passes of rays that give coefficients: what sensors, and eyes by each observer, get of each patch of the sky and of suns."""
import os
from dataclasses import dataclass
from functools import cached_property

import numpy as np

import rsphere

from ..fault import write_text
from ..progress import PROGRESS
from .alpha_opic import BANDS, OBSERVERS, by_observers

VISIBLE = np.array([0.265, 0.670, 0.065])  # shares of red, green and blue in what the eye sees
SUN_WIDTH = 0.533  # degrees, RADIANCE's
SUN_SOLID_ANGLE = 2 * np.pi * (1 - np.cos(np.radians(SUN_WIDTH / 2)))
FACTOR = 3  # of reinhart.cal: Tregenza's patches are divided into 3 x 3; light through narrow windows errs by .2% (rms of hours)
SKY = "void glow rsphere_sky 0 0 4 1 1 1 0\nrsphere_sky source rsphere_dome 0 0 4 0 0 1 360\n"
SKY_WEIGHT, SUN_WEIGHT = 0.05, 0.3  # of a ray of a sensor, below which Russian roulette ends paths: least time for equal noise
SUN_GROUPS = 8  # of suns, each with paths of its own: the noise of a year has a seventh of the variance, in 1.3 to 1.5 times the time
# Behind parts of blinds nearly all of the noise is in the rays from the sensors to the parts: these rays by those of a sensor, and the
# weight at which Russian roulette ends their paths by SKY_WEIGHT; those of a sensor by the rays of a part. Least noise in two rooms.
INSIDE, INSIDE_WEIGHT, OUTSIDE = 4, 4, 8
FEW = 64  # rays of a sensor by which it is known whether light changes
MOST_AT_ONCE = 1 << 21  # coefficients
STEPS = 0.7548776662466927, 0.5698402909980532  # of places on parts of blinds, which fill a square evenly: 1/g and 1/g^2, g^3 = g + 1


def sun_text(directions):
    return "".join(f"void light rsphere_sun{i} 0 0 3 1 1 1\nrsphere_sun{i} source rsphere_sun{i} 0 0 4 {x:.9g} {y:.9g} {z:.9g} {SUN_WIDTH}\n"
                   for i, (x, y, z) in enumerate(directions))


@dataclass
class Settings:
    """Of the rays."""

    bounces: int = 8
    divisions: int = 384  # for the sky
    sun_divisions: int = 24  # for reflected sun, whose rays take ten times as long
    seasons: int = 13  # declinations of the sun, and hours between its positions: by these the light of single hours errs by .5% in
    hours: float = 1 / 3  # a classroom with windows to the south and the east (by half hours .7%)
    threads: int = 0
    radiance: bool = False  # of rays instead of illuminance: cd/m2, without the disk of the sun


def product(a, b):
    """a @ b.T of float32. NumPy's own sums take a quarter of the time of the BLAS that Debian installs."""
    return np.einsum("ij,kj->ik", np.ascontiguousarray(a, np.float32), np.ascontiguousarray(b, np.float32))


class Scenes:
    """Scenes of the same files and some text, and the coefficients of rays in them."""

    def __init__(self, files, folder, name, settings):
        self.files, self.folder, self.name, self.settings = files, folder, name, settings
        self.bins = {"files": "reinhart.cal", "parameters": f"MF={FACTOR}", "expression": "rbin", "count": "Nrbins"}

    def scene(self, kind, text):
        path = os.path.join(self.folder, f"{self.name}_{kind}.rad")
        return rsphere.Scene([write_text(path, text, "latin-1"), *self.files])

    def coefficients(self, scene, rays, of, bins=None, **options):
        """For radiance 1: (rays, modifiers or bins, red green blue, or bands with cs=)."""
        options = dict(dict(irradiance_at_origin=True, coefficients=True, samples=1, dt=0, dj=0, dv=True, threads=self.settings.threads), **options)
        chunks = np.array_split(rays, -(-len(rays) * (len(of) if bins is None else 0) // MOST_AT_ONCE) or 1)
        found = [scene.contributions(part, of=of, bins=bins, **options).value for part in chunks]
        return np.concatenate([v.reshape(len(v), -1, v.shape[-1]) for v in found])

    def sky_options(self, number, divisions=None, bounces=None):
        divisions = divisions or self.settings.divisions
        return dict(ambient_divisions=divisions, limit_weight=SKY_WEIGHT / divisions, ambient_bounces=bounces or self.settings.bounces, rotation=number)

    def sun_options(self, number, share=1, bounces=None):
        divisions = -(-self.settings.sun_divisions // share)
        return dict(ambient_divisions=divisions, limit_weight=SUN_WEIGHT / divisions, ambient_bounces=bounces or self.settings.bounces, rotation=number)


def names_of(suns):
    return [f"rsphere_sun{i}" for i in range(len(suns))]


class Pass:
    """Light in a scene with some of its windows closed. Rows are the sensors, and the eyes by each observer."""

    has_base = True  # whether light of windows that are never closed is in it

    def __init__(self, files, text, folder, name, sensors, eyes, to_sun, reflected_from, settings):
        """to_sun: all directions of direct light; reflected_from: those of reflected light."""
        self.sensors, self.eyes, self.reflected_from, self.settings = sensors, eyes, reflected_from, settings
        self.scenes, self.text, self.to_sun = Scenes(files, folder, name, settings), text, to_sun
        self.by_sky = self.scenes.scene("sky", text + SKY)

    @cached_property
    def by_sun(self):
        return self.scenes.scene("sun", self.text + sun_text(self.reflected_from))

    @cached_property
    def of_suns(self):
        """Direct light of the suns, exact: of to_sun, and behind these of reflected_from."""
        exact = np.concatenate([self.to_sun, self.reflected_from])
        if not len(exact):
            return np.zeros((len(self.sensors) + len(OBSERVERS) * len(self.eyes), 0))
        return self.contributions(self.scenes.scene("direct", self.text + sun_text(exact)), names_of(exact), ambient_bounces=0)

    @property
    def direct(self):
        return self.of_suns[:, : len(self.to_sun)]

    def keep(self, rows):
        """Leaves out all sensors but some; there must be no eyes."""
        self.sensors, self.of_suns = self.sensors[rows], self.of_suns[rows]

    def contributions(self, scene, suns=None, **options):
        """Coefficients, illuminance for radiance 1: (rows, suns or bins). suns: their names."""
        of, bins = (["rsphere_sky"], self.scenes.bins) if suns is None else (suns, None)
        options = dict(dict(irradiance_at_origin=not self.settings.radiance, dv=suns is None or not self.settings.radiance), **options)
        rows = self.scenes.coefficients(scene, self.sensors, of, bins, **options) @ VISIBLE
        if not len(self.eyes):
            return rows
        return np.vstack([rows, by_observers(self.scenes.coefficients(scene, self.eyes, of, bins, cs=BANDS, **options))])

    def sky(self, number, divisions=None, bounces=None):
        """One estimate of the light of all patches."""
        return self.contributions(self.by_sky, **self.scenes.sky_options(number, divisions, bounces))

    @cached_property
    def first_sky(self):
        return self.sky(0)

    def brightest_sun(self, divisions, bounces):
        """As of LoweredPass, beside `direct`: what a sun sends by reflections is never bright."""
        return 0

    def estimate(self, number):
        """One estimate of the light of all patches, and of the reflected light of the sun. number: of the estimate."""
        sky = self.sky(number) if number else self.first_sky
        PROGRESS.advance()
        sun, suns = -self.of_suns[:, len(self.to_sun) :], names_of(self.reflected_from)
        for k in range(min(SUN_GROUPS, len(suns))):
            sun[:, k::SUN_GROUPS] += self.contributions(self.by_sun, suns[k::SUN_GROUPS], **self.scenes.sun_options(number * SUN_GROUPS + k))
        PROGRESS.advance()
        return sky, sun

    def reflected_together(self, to_sun):
        """A function of numbers and bounces, that of the reflected light of any suns at the sensors, by paths that they share: (sensors, suns)."""
        scene, suns = self.scenes.scene("together", self.text + sun_text(to_sun)), names_of(to_sun)
        light = lambda **options: self.scenes.coefficients(scene, self.sensors, suns, dv=True, **options) @ VISIBLE  # noqa: E731
        direct = light(ambient_bounces=0)
        return lambda number, bounces=None: light(**self.scenes.sun_options(number, bounces=bounces)) - direct


class LoweredPass:
    """The light that enters through the lowered blinds of a group alone, while all other windows are closed.

    These blinds are diffuse, so that what arrives on their outer side is all that matters of sky and sun: rays of the sensors find the
    parts of the blinds, and rays of these parts the sky and the sun. Shadow rays inside of the room would end at the blinds.
    """

    has_base = False

    def __init__(self, files, text, group, folder, name, sensors, eyes, to_sun, reflected_from, settings):
        """As of Pass. group: with parts."""
        self.sensors, self.eyes, self.reflected_from, self.settings, self.group = sensors, eyes, reflected_from, settings, group
        self.scenes, self.text = Scenes(files, folder, name, settings), text + group.lowered
        self.inside = self.scenes.scene("parts", text + group.part_text())
        self.outside = self.scenes.scene("sky", text + group.further + SKY)
        self.by_sun = self.scenes.scene("sun", text + group.further + sun_text(reflected_from))
        self.direct = np.zeros((len(sensors) + len(OBSERVERS) * len(eyes), len(to_sun)))

    @cached_property
    def by_sky(self):
        return self.scenes.scene("view", self.text + SKY)

    def keep(self, rows):
        self.sensors, self.direct = self.sensors[rows], self.direct[rows]

    def through(self, number, divisions=None, bounces=None):
        """A function of what arrives at the parts, from a function of options: light of the rows."""
        n = len(self.group.parts)
        rays = self.group.rays_outwards(*np.outer(STEPS, number * n + np.arange(n))[..., None] % 1)
        rays_of_sensor = divisions or self.settings.divisions * (1 if self.settings.radiance else INSIDE)
        options = dict(self.scenes.sky_options(number, rays_of_sensor, bounces), irradiance_at_origin=not self.settings.radiance)
        options["limit_weight"] *= INSIDE_WEIGHT
        to_parts = lambda rays, **more: self.scenes.coefficients(self.inside, rays, self.group.part_names(), **options, **more)  # noqa: E731
        within = to_parts(self.sensors) * VISIBLE, to_parts(self.eyes, cs=BANDS) if len(self.eyes) else None

        def light(scene, of, bins, options):
            arriving = lambda **more: self.group.radiance_of(self.scenes.coefficients(scene, rays, of, bins, **options, **more))  # noqa: E731
            outside = np.moveaxis(arriving(), 1, 0)  # (suns or bins, parts, channels)
            rows = product(within[0].reshape(len(within[0]), -1), outside.reshape(len(outside), -1))
            if within[1] is None:
                return rows
            return np.vstack([rows, by_observers(np.einsum("ikb,kjb->ijb", within[1], arriving(cs=BANDS)))])

        return light

    def of_sky(self, light, number, divisions=None, bounces=None):
        of_part = divisions or -(-self.settings.divisions // OUTSIDE)
        return light(self.outside, ["rsphere_sky"], self.scenes.bins, self.scenes.sky_options(number, of_part, bounces))

    def sky(self, number, divisions=None, bounces=None):
        return self.of_sky(self.through(number, divisions, bounces), number, divisions, bounces)

    @cached_property
    def first(self):
        return self.through(0)

    @cached_property
    def first_sky(self):
        return self.of_sky(self.first, 0)

    def of_suns(self, light, number, **options):
        if not len(self.reflected_from):
            return np.zeros((len(self.direct), 0))
        return light(self.by_sun, names_of(self.reflected_from), None, dict(self.scenes.sun_options(number, OUTSIDE), **options))

    def reflected_together(self, to_sun):
        """As of Pass; by few rays from the sensors to the parts."""
        scene = self.scenes.scene("together", self.text + self.group.further + sun_text(to_sun))
        of = scene, names_of(to_sun), None
        return lambda number, bounces=None: self.through(number, FEW)(*of, self.scenes.sun_options(number, OUTSIDE, bounces))[: len(self.sensors)]

    def brightest_sun(self, divisions, bounces):
        """About the most that one sun of radiance 1 gives the rows."""
        light = self.through(0, divisions, bounces)
        return self.of_suns(light, 0, ambient_divisions=divisions, ambient_bounces=bounces).max(axis=1, initial=0)

    def estimate(self, number):
        light = self.through(number) if number else self.first
        sky = self.of_sky(light, number) if number else self.first_sky
        PROGRESS.advance()
        sun = self.of_suns(light, number)
        PROGRESS.advance()
        return sky, sun
