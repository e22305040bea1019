"""Unified Glare Rating of luminaires (CIE 117): UGR = 8 log10(.25 / Lb sum L^2 w / P^2).

A limit of UGR is linear in what is switched on: sum L^2 w / P^2 <= 10^(UGR / 8) / .25 Lb, where the background
luminance Lb is the reflected vertical illuminance at the eye over pi. A dimmed luminaire has the square of its level
in the sum; the level itself, which is larger, stands for it, so that the limit is kept.
"""
import numpy as np

LEAST_AREA = 1e-6  # m2, seen from the eye


def position_index(gaze, directions):
    """Guth's index of directions (..., 3) from the eye, above the line of sight; below it, that of Iwata and others.

    Sources: CIE 117 (1995); Iwata, Shukuya, Somekawa, Kimura 1992. Infinite behind the eye.
    """
    up = np.array([0, 0, 1.0]) - gaze * gaze[2]
    up = up / np.linalg.norm(up) if np.linalg.norm(up) > 1e-9 else np.array([0, 1.0, 0])
    ahead, height = directions @ gaze, directions @ up
    side = np.abs(directions @ np.cross(gaze, up))
    beta = np.degrees(np.arccos(np.clip(ahead, -1, 1)))
    alpha = np.degrees(np.arctan2(side, np.maximum(height, 0)))
    above = np.exp((35.2 - 0.31889 * alpha - 1.22 * np.exp(-2 * alpha / 9)) * 1e-3 * beta
                   + (21 + 0.26667 * alpha - 0.002963 * alpha**2) * 1e-5 * beta**2)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.minimum(np.hypot(height, side) / ahead, 3)
    below = 1 + np.where(ratio < 0.6, 0.8, 1.2) * ratio
    return np.where(ahead > 0, np.where(height >= 0, above, below), np.inf)


def factor_of_limit(limit):
    return 10 ** (limit / 8) / 0.25


def rating(total, background):
    """UGR of sum L^2 w / P^2 and a background luminance (cd/m2)."""
    if not (total > 0 and background > 0):
        return 0.0
    return max(0.0, 8 * np.log10(0.25 * total / background))


def glare_terms(transfer, candidates, eye, seen):
    """L^2 w / P^2 of each candidate at full power for an eye. seen: the share of its light that arrives."""
    units, terms = transfer.design.units, np.zeros(len(candidates))
    for j, c in enumerate(candidates):
        to_eye = (eye.position - c.position) / units
        distance = np.linalg.norm(to_eye)
        direction = to_eye / distance
        photometry = transfer.design.luminaires[c.luminaire].photometry
        area = photometry.projected_area(direction @ c.matrix())
        if area < LEAST_AREA:
            continue
        luminance = transfer.light(c, direction) / area * seen[j]
        terms[j] = luminance**2 * area / distance**2 / position_index(eye.gaze, -direction) ** 2
    return terms
