"""The position index of glare sources: how much brighter a source may be at its place than on the line of sight."""
import numpy as np


def position_index(gaze, directions):
    """Guth's index of unit directions (..., 3) from the eye; infinite behind it. The formulas of rsphere -Su.

    On and above the line of sight that of Levin 1975 for Guth's data, as in the IES Lighting Handbook; below it that of
    Iwata and Osterhaus 2010. At most 16, as in evalglare.
    """
    up = np.array([0, 0, 1.0]) - gaze * gaze[2]
    up /= np.linalg.norm(up)
    ahead, height, aside = directions @ gaze, directions @ up, np.abs(directions @ np.cross(gaze, up))
    tau = np.arctan2(aside, height)
    sigma, degrees = np.degrees(np.arctan2(np.hypot(height, aside), ahead)), np.degrees(tau)
    above = ((35.2 - 0.31889 * degrees - 1.22 * np.exp(-2 * degrees / 9)) * sigma / 1e3
             + (21 + 0.26667 * degrees - 0.002963 * degrees**2) * sigma**2 / 1e5)
    beta = np.degrees(np.arctan2(np.hypot(height, aside) * np.sqrt(1 + 0.3225 * np.cos(tau) ** 2), ahead))
    below = 6.49 * beta / 1e3 + 21 * beta**2 / 1e5
    index = np.minimum(np.exp(np.minimum(np.where(height >= 0, above, below), 10)), 16)
    return np.where(ahead > 0, index, np.inf)
