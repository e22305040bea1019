"""Daylight glare at eyes over a year: DGP in each hour, from what an eye sees of sky, sun and lit surfaces.

Directions in front of the eye, evenly spread, are sensors of radiance: their coefficients give a picture of each hour. Bright directions near each
other are one glare source, as rsphere -Su and evalglare have them; the disk of the sun is another. The illuminance at the eye is that of
Light. DGP: Wienold and Christoffersen 2006, Energy and Buildings 38, 743-757.
"""
import warnings
from dataclasses import replace

import numpy as np

import rsphere

from ..photometry.position_index import position_index
from ..progress import PROGRESS
from .light import Light
from .passes import SUN_SOLID_ANGLE, VISIBLE
from .shades import LOWERED, UP
from .verdicts import FROM, SURE, UNTIL, Verdict, estimated

DIRECTIONS = 6000  # of the whole sphere: 2.6 degrees apart
THRESHOLD = 2000  # cd/m2, of glare sources: evalglare's and that of -Su
TOGETHER = 0.1  # rad: bright directions nearer than this are one source, as in evalglare
PEAK = 50000  # cd/m2: brighter ones are sources of their own
LOWEST = 0.16  # DGP without light
CLASSES = ((0.45, "minimum"), (0.40, "medium"), (0.35, "high"))  # EN 17037: DGP that may be exceeded in SELDOM of the hours
SELDOM = 0.05
ESTIMATES, DIVISIONS = 2, 64  # independent ones of the pictures, and rays of each direction; only what is bright needs to be known
FEW, SHORT = 16, 2  # rays and bounces by which directions are left out that are never bright: below half of THRESHOLD with all patches at their brightest
SOURCE = f"EN 17037:2018+A1:2021, protection from glare: DGP in {FROM} to {UNTIL} h with shades, at the worst eye"


def dgp(illuminance, weight):
    """illuminance: lx at the eye; weight: sum of L^2 omega / P^2 of the sources."""
    light = np.maximum(illuminance, 1e-9)
    return np.minimum(1, np.where(illuminance > 0, 5.87e-5 * light + 0.0918 * np.log10(1 + weight / light**1.87), 0) + LOWEST)


class Sources:
    """Directions in front of an eye, and the glare sources that bright ones of them are."""

    def __init__(self, gaze):
        self.gaze = np.asarray(gaze, float) / np.linalg.norm(gaze)
        directions = rsphere.zone_middles(DIRECTIONS)
        self.directions = directions[directions @ self.gaze > 0]
        self.solid_angle = 4 * np.pi / DIRECTIONS

    def keep(self, chosen):
        self.directions = self.directions[chosen]
        self.near = self.directions @ self.directions.T > np.cos(TOGETHER)

    def weight(self, luminance):
        """The sum of L^2 omega / P^2 in a picture (cd/m2 of the directions)."""
        bright, peaks = luminance >= THRESHOLD, luminance >= PEAK
        light, square = [], []
        for left in (bright & ~peaks, bright & peaks):
            while left.any():
                one = np.zeros(len(left), bool)
                new = [left.argmax()]
                while len(new):  # those near to the last ones
                    one[new] = True
                    left[new] = False
                    new = np.flatnonzero(self.near[new].any(axis=0) & left)
                light.append(luminance[one] @ self.directions[one])
                square.append(luminance[one].mean() * luminance[one].sum() * self.solid_angle)
        if not light:
            return 0.0
        middles = np.array(light) / np.linalg.norm(light, axis=1)[:, None]
        return float((np.array(square) / position_index(self.gaze, middles) ** 2).sum())


def sun_through(scene, eye, to_sun):
    """The transmittance between an eye and the sun, for each direction to_sun (n, 3). scene: with a sky of radiance 1."""
    if not len(to_sun):
        return np.zeros(0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the sky is no light source
        a = scene.trace(np.hstack([np.tile(eye, (len(to_sun), 1)), to_sun]), outputs="vX", ambient_bounces=0)
    return np.where(a.unmirrored_length > 1e9, a.value @ VISIBLE, 0)


def weights_of_hours(name, files, eye, weather, groups, folder, settings, states):
    """For an eye (x y z dx dy dz): the sums of L^2 omega / P^2 in the lit hours of weather, with blinds up, and by states (hours, groups)."""
    sources = Sources(eye[3:])
    rays = np.hstack([np.tile(eye[:3], (len(sources.directions), 1)), sources.directions])
    light = Light(files, rays, np.full(len(rays), 1 / len(rays)), weather, groups, folder, settings)
    brightest = light.daylight.luminance.max(axis=0, initial=0)  # of each patch
    bound = sum(np.max([p.sky(0, FEW, SHORT) @ brightest for p in group], axis=0) for group in light.passes) + light.direct.max(axis=(1, 3)).sum(axis=0)
    sun = light.daylight.sun.max(initial=0) / SUN_SOLID_ANGLE
    bound += sum(p.brightest_sun(FEW, SHORT) * sun for group in light.passes for p in group)
    chosen = np.flatnonzero(bound > THRESHOLD / 2)  # that may be bright in some hour
    light.keep(chosen)
    sources.keep(chosen)
    light.states = states
    PROGRESS.begin(name, 2 * ESTIMATES * light.pass_count())
    for _ in range(ESTIMATES):
        light.add()
    to_sun = light.daylight.to_sun[light.sunny]
    base = sun_through(light.base.by_sky, eye[:3], to_sun) if light.base else 0
    parts = [[sun_through(p.by_sky, eye[:3], to_sun) - base for p in states_] for states_ in light.passes]
    power = light.daylight.sun[light.sunny]
    inside = np.maximum(0, to_sun @ sources.gaze) > 0
    found = []
    for lux, lowered in ((light.year.open, None), (light.year.lux, states))[: 1 if states is None else 2]:
        luminance = lux.mean(axis=0)
        total = np.array([sources.weight(luminance[:, h]) for h in range(luminance.shape[1])])
        seen = base + sum(part[UP] if lowered is None else np.where(lowered[light.sunny, g] == LOWERED, part[-1], part[UP]) for g, part in enumerate(parts))
        bright = seen * power / SUN_SOLID_ANGLE
        total[light.sunny] += np.where(inside & (bright >= THRESHOLD), bright**2 * SUN_SOLID_ANGLE / position_index(sources.gaze, to_sun) ** 2, 0)
        found.append(total)
    return found if len(found) == 2 else found * 2


class Glare:
    """DGP of eyes in the hours from FROM to UNTIL."""

    def __init__(self, files, eyes, weather, groups, folder, light):
        """light: a Light with these eyes, whose estimates are done. Ctrl-C leaves the eyes that are done."""
        self.year, chosen = light.year, light.year.occupied()
        hours = weather._replace(hours=[row for row in weather.hours if FROM < row[2] < UNTIL])
        settings = replace(light.settings, divisions=DIVISIONS, sun_divisions=DIVISIONS // 4, radiance=True)
        states = None if light.states is None else light.states[chosen]
        self.weights = []  # for each eye: of weights_of_hours()
        try:
            for i, eye in enumerate(eyes):
                self.weights.append(weights_of_hours(f"Glare at eye {i + 1} of {len(eyes)}", files, eye, hours, groups, folder, settings, states))
        except KeyboardInterrupt:
            if not self.weights:
                raise
        n = len(self.weights)
        self.lux = [part[:, :n, chosen] for part in (light.open_at_eyes, light.at_eyes)]  # illuminances are the first rows

    def share_above(self, limit, shades):
        """The share of hours in which DGP is above a limit: of each eye, and its standard error. shades: 1 by the rule, 0 up."""
        weights = np.array([w[shades] for w in self.weights])
        return estimated(lambda lux: (dgp(lux, weights) > limit).sum(axis=1) / self.year.occupied_hours, self.lux[shades])

    def verdicts(self):
        for limit, level in CLASSES:
            shares, errors = self.share_above(limit, 1)
            share, error = (float(x[np.argmax(shares)]) for x in (shares, errors))
            yield Verdict(f"DGP above {limit:.2f}: {level}", f"at most {SELDOM:.0%} of the hours", share, SELDOM, SOURCE, error, share - SURE * error,
                          share + SURE * error, most=True)

    def quantities(self):
        found = {}
        for shades, how in ((1, ""), (0, ", shades up")):
            weights = np.array([w[shades] for w in self.weights])
            dark = self.year.occupied_hours - weights.shape[1]  # hours of night
            at = int(np.ceil((1 - SELDOM) * self.year.occupied_hours)) - 1 - dark
            found[f"DGP exceeded in 5% of the hours{how}"] = (*estimated(lambda lux, w=weights, k=at: np.sort(dgp(lux, w), axis=1)[:, max(0, k)], self.lux[shades]), "")
            for limit, _ in CLASSES:
                found[f"DGP above {limit:.2f}{how}"] = (*self.share_above(limit, shades), "%")
        return found
