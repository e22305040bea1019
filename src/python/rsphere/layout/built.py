"""The luminaires as built: scene text that rsphere, rtrace and RADIANCE's programs read."""
import os
import re

import numpy as np

from ..fault import write_text
from ..photometry.lamp_rad import pattern_text, surfaces_text, turning_words, word, write_data


FACTOR = "maintenance factor of"  # and the number, in the first line of such a file
HEAD = 300  # bytes, more than its first line


def maintenance_in(file):
    """The maintenance factor that the luminaires of a file have in their light already; 1 if write_lamps() did not write it."""
    try:
        with open(file, encoding="utf-8", errors="replace") as stream:
            found = re.search(rf"\A# Luminaires by rsphere-layout\..* {FACTOR} ([0-9.]+)", stream.read(HEAD))
    except OSError:
        return 1.0  # what reads the scene says why
    return float(found[1]) if found else 1.0


def write_lamps(design, candidates, chosen, levels, folder, name):
    """Writes the chosen luminaires at their levels into FOLDER/NAME.rad, and their data files beside it."""
    text = (f"# Luminaires by rsphere-layout. The {FACTOR} {design.maintenance:g} and the levels of the scene are in their light: a report on\n"
            "# them has \"maintenance 1\". Their data files are in the folder of this file, which RADIANCE needs in RAYPATH, as .:layout.\n")
    materials = {}
    for number, (j, level) in enumerate(zip(chosen, levels)):
        c = candidates[j]
        luminaire = design.luminaires[c.luminaire]
        if level < 1e-4:
            continue
        data = write_data(luminaire.photometry, folder, luminaire.name)
        tilt = np.degrees(np.arccos(np.clip(-c.aim[2], -1, 1)))
        factor = luminaire.factor * design.maintenance * luminaire.photometry.tilt_factor(tilt) * level
        key = (c.luminaire, tuple(c.aim), c.turn, f"{factor:.6g}")
        if key not in materials:
            materials[key] = f"{luminaire.name}_{name}{len(materials) + 1}"
            text += pattern_text(luminaire.photometry, materials[key], data, float(key[3]), turning_words(c.aim, c.turn))
        text += f"# {number + 1}: {luminaire.name} at {level:.0%}\n"
        text += surfaces_text(luminaire.photometry, f"{word(luminaire.name)}.{number + 1}", materials[key], c.matrix(),
                              c.position, design.units)
    return write_text(os.path.join(folder, f"{name}.rad"), text)


def outline(design, candidate):
    """The corners (4, 2) of a luminaire from above, in units of the scene."""
    x, y, _ = (candidate.matrix() * candidate_size(design, candidate)).T
    signs = np.array([[-1, -1], [-1, 1], [1, 1], [1, -1]]) / 2 * design.units
    return candidate.position[:2] + signs @ np.stack([x[:2], y[:2]])


def candidate_size(design, candidate):
    return np.maximum(design.luminaires[candidate.luminaire].photometry.size, 0.05)
