"""Reads luminaires of ANSI/IES TM-33 (IES XML): angles and intensities of one emitter, luminous or radiant."""
import numpy as np

from ..fault import fault, number
from .ies import MOST_ANGLES, all_round
from .intensities import Photometry, checked_angles, checked_candela
from .xml_file import number_of, root_of, text_of

ROOTS = ("IESTM33", "IESTM33-22", "LuminaireOpticalData")
INTENSITIES = (("LuminousData/LuminousIntensity", False), ("RadiantData/RadiantIntensity", True))
SMALLEST = 0.001  # m


class Place:
    """Where faults are: the file alone."""

    line = None

    def __init__(self, file):
        self.file = file


def read_tm33(file):
    """The Photometry of a TM-33 file. Raises Fault."""
    try:
        with open(file, "rb") as stream:
            root = root_of(stream.read((16 << 20) + 1), file)
    except OSError as error:
        raise fault(file, None, f"cannot be read: {error.strerror}") from None
    if root.tag not in ROOTS:
        raise fault(file, None, f'the XML is of a "{root.tag[:40]}", not of a TM-33 luminaire')
    emitters = root.findall("Emitter")
    if len(emitters) != 1:
        raise fault(file, None, f"has {len(emitters)} emitters; a luminaire of one emitter is read")
    emitter = emitters[0]
    element, radiant = next(((emitter.find(path), radiant) for path, radiant in INTENSITIES if emitter.find(path) is not None), (None, False))
    if element is None:
        raise fault(file, None, "the emitter has neither LuminousIntensity nor RadiantIntensity")
    for tag in ("AbsolutePhotometry", "Absolute"):
        if text_of(element, tag).lower() in ("false", "0"):
            raise fault(file, None, "intensities are relative; absolute ones are read")
    planes, gammas, values = grid_of(element, file)
    planes, values = all_round(Place(file), planes, values)
    values = checked_candela(values * number_of(element, "Multiplier", file, 1e-9, 1e9, 1.0), file, None)
    shape, size = opening_of(root, emitter, file)
    name = f"{text_of(root, 'Header/Manufacturer')} {text_of(root, 'Header/Description')}".strip() or file
    watts = number_of(emitter, "InputWattage", file, 0, 1e6, 0.0)
    return Photometry(file, name, planes, gammas, values, shape, size, watts, axis="y", radiant=radiant)


def grid_of(element, file):
    """Horizontal and vertical angles, and intensities (horizontal, vertical). Each pair of angles has one."""
    found = {}
    for data in element.iter("IntData"):
        at = tuple(number(data.get(key) or "", file, None, f"the angle {key} of IntData", 0, 360 if key == "h" else 180) for key in "hv")
        if at in found:
            raise fault(file, None, f"there are two intensities for h={at[0]:g}, v={at[1]:g}")
        found[at] = number((data.text or "").strip(), file, None, "an intensity", 0, 1e9)
    horizontal, vertical = ([*sorted({at[i] for at in found})] for i in range(2))
    if len(vertical) < 2 or max(len(horizontal), len(vertical)) > MOST_ANGLES:
        raise fault(file, None, f"there are {len(horizontal)} horizontal and {len(vertical)} vertical angles")
    if len(found) != len(horizontal) * len(vertical):
        raise fault(file, None, f"there are {len(found)} intensities for {len(horizontal)} x {len(vertical)} angles")
    values = np.array([[found[h, v] for v in vertical] for h in horizontal])
    if not values.any():
        raise fault(file, None, "all intensities are 0")
    return checked_angles(horizontal, file, None, "horizontal angles"), checked_angles(vertical, file, None, "vertical angles"), values


def opening_of(root, emitter, file):
    """The shape and the size (m) of the luminous area below, or else of the luminaire. Its length is across C0."""
    area, deep = emitter.find("EmissionAreas/BottomFace/BottomArea"), 0.0
    if area is None:
        area = root.find("Luminaire/Dimensions")
    if area is None:
        return "point", (SMALLEST,) * 3
    length, width = (number_of(area, tag, file, 0, 100) for tag in ("Length", "Width"))
    if not min(length, width) > 0:
        return "point", (SMALLEST,) * 3
    if text_of(area, "Circular").lower() in ("true", "1"):
        return "cylinder", (length, length, deep)
    return "box", (width, length, deep)
