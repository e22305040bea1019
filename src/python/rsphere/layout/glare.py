"""Unified Glare Rating of luminaires (CIE 117): UGR = 8 log10(.25 / Lb sum L^2 w / P^2).

A limit of UGR is linear in what is switched on: sum L^2 w / P^2 <= 10^(UGR / 8) / .25 Lb, where the background
luminance Lb is the reflected vertical illuminance at the eye over pi. A dimmed luminaire has the square of its level
in the sum; the level itself, which is larger, stands for it, so that the limit is kept.
"""
import numpy as np

from ..photometry.position_index import position_index
from .surface_parts import surface_parts

FINE = 256  # parts of the luminous surfaces of a luminaire


def factor_of_limit(limit):
    return 10 ** (limit / 8) / 0.25


def rating(total, background):
    """UGR of sum L^2 w / P^2 and a background luminance (cd/m2)."""
    if not (total > 0 and background > 0):
        return 0.0
    return 8 * np.log10(0.25 * total / background)


def glare_terms(transfer, candidates, eye):
    """L^2 w / P^2 of each candidate at full power for an eye, from what is in front of it of the luminous opening."""
    design, terms = transfer.design, np.zeros(len(candidates))
    fine = [surface_parts(l.photometry, FINE) for l in design.luminaires]
    for j, (c, (parts, seen)) in enumerate(zip(candidates, transfer.points.parts_seen(transfer.index[eye.name, "eye"]))):
        surfaces = fine[c.luminaire]
        points = c.position + surfaces.points * design.units @ c.matrix().T
        if len(parts) == 0:
            continue
        seen = seen[((points[:, None] - parts) ** 2).sum(axis=-1).argmin(axis=1)]  # shadow rays went to these alone
        to_eye = (eye.position - points) / design.units
        distance = np.linalg.norm(to_eye, axis=1)
        away = to_eye / distance[:, None]
        ahead = (away @ eye.gaze < 0) / distance**2
        # Of a part that something hides no solid angle is left; a pane reduces the luminance.
        angle = surfaces.facing(away @ c.matrix()) * ahead * (seen > 0)
        light = transfer.light(c, away) * surfaces.shares(away @ c.matrix()) * ahead * seen
        if not light.sum() > 0 or not angle.sum() > 0:
            continue
        middle = -(light @ away)
        terms[j] = light.sum() ** 2 / angle.sum() / position_index(eye.gaze, middle / np.linalg.norm(middle)) ** 2
    return terms
