"""Reads luminaires of ANSI/IES TM-33 (IES XML): angles and intensities of one emitter, luminous or radiant."""
from dataclasses import dataclass

import numpy as np

from ..fault import fault, number
from .ies import MOST_ANGLES, all_round
from .intensities import Photometry, checked_candela
from .xml_file import number_of, only, root_of, text_of

ROOTS = ("IESTM33", "IESTM33-22", "LuminaireOpticalData")
INTENSITIES = (("LuminousData/LuminousIntensity", False), ("RadiantData/RadiantIntensity", True))
SMALLEST = 0.001  # m


@dataclass
class Place:
    """Where faults are."""

    file: str
    line: int


def read_tm33(file):
    """The Photometry of a TM-33 file. Raises Fault."""
    try:
        with open(file, "rb") as stream:
            root = root_of(stream.read((16 << 20) + 1), file)
    except OSError as error:
        raise fault(file, None, f"cannot be read: {error.strerror}") from None
    if root.tag not in ROOTS:
        raise root.fault(file, f'the XML is of a "{root.tag[:40]}", not of a TM-33 luminaire, whose root is {ROOTS[0]}')
    emitters = root.findall("Emitter")
    if len(emitters) != 1:
        where = emitters[1] if emitters else root
        raise where.fault(file, f"there are {len(emitters)} emitters; one is read: give each a file of its own")
    emitter = emitters[0]
    if number_of(emitter, "Quantity", file, 0, 1e6, 1.0) != 1:
        raise emitter.find("Quantity").fault(file, "the luminaire has several emitters of this kind; one is read: give it the light of all, and Quantity 1")
    element, radiant = next(((found, radiant) for path, radiant in INTENSITIES if (found := only(emitter, path, file)) is not None), (None, False))
    if element is None:
        raise emitter.fault(file, f"the emitter has neither {INTENSITIES[0][0]} nor {INTENSITIES[1][0]}; its intensities are needed")
    for tag in ("AbsolutePhotometry", "Absolute"):
        if text_of(element, tag).lower() in ("false", "0"):
            raise element.find(tag).fault(file, "intensities are relative; absolute ones (cd) are read")
    planes, gammas, values = grid_of(element, file)
    planes, values = all_round(Place(file, element.line), planes, values)
    values = checked_candela(values * number_of(element, "Multiplier", file, 1e-9, 1e9, 1.0), file, element.line)
    shape, size = opening_of(root, emitter, file)
    name = f"{text_of(root, 'Header/Manufacturer')} {text_of(root, 'Header/Description')}".strip() or file
    watts = number_of(emitter, "InputWattage", file, 0, 1e6, 0.0)
    return Photometry(file, name, planes, gammas, values, shape, size, watts, axis="y", radiant=radiant)


def grid_of(element, file):
    """Horizontal and vertical angles, and intensities (horizontal, vertical). Each pair of angles has one."""
    found, line = {}, element.line
    for data in element.iter("IntData"):
        at = tuple(number(data.get(key) or "", file, data.line, f"the angle {key} of IntData", 0, 360 if key == "h" else 180) for key in "hv")
        if at in found:
            raise data.fault(file, f"there are two intensities for h={at[0]:g}, v={at[1]:g}; take one out")
        found[at] = number((data.text or "").strip(), file, data.line, "an intensity", 0, 1e9)
    horizontal, vertical = ([*sorted({at[i] for at in found})] for i in range(2))
    if len(vertical) < 2 or max(len(horizontal), len(vertical)) > MOST_ANGLES:
        raise fault(file, line, f"there are {len(horizontal)} horizontal and {len(vertical)} vertical angles; 1 and 2 are the least, and {MOST_ANGLES} the most")
    if len(found) != len(horizontal) * len(vertical):
        h, v = next((h, v) for h in horizontal for v in vertical if (h, v) not in found)
        raise fault(file, line, f"there are {len(found)} intensities for {len(horizontal)} x {len(vertical)} angles; the first without one is h={h:g}, v={v:g}")
    values = np.array([[found[h, v] for v in vertical] for h in horizontal])
    if not values.any():
        raise fault(file, line, "all intensities are 0")
    return np.array(horizontal), np.array(vertical), values


def opening_of(root, emitter, file):
    """The shape and the size (m) of the luminous area below, or else of the luminaire. Its length is across C0."""
    area, deep = only(emitter, "EmissionAreas/BottomFace/BottomArea", file), 0.0
    if area is None:
        area = only(root, "Luminaire/Dimensions", file)
    if area is None:
        return "point", (SMALLEST,) * 3
    length, width = (number_of(area, tag, file, 0, 100) for tag in ("Length", "Width"))
    if not min(length, width) > 0:
        return "point", (SMALLEST,) * 3
    if text_of(area, "Circular").lower() in ("true", "1"):
        return "cylinder", (length, length, deep)
    return "box", (width, length, deep)
