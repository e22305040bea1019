"""Reads photometric files of all formats."""
import os
import warnings

from ..fault import fault, lines_of
from .eulumdat import read_eulumdat
from .gldf import read_gldf
from .ies import read_ies
from .tm33 import read_tm33

ZIP = b"PK\3\4"


def begins(file, count):
    """The first bytes of a file, or none if it cannot be read: the readers say why."""
    try:
        with open(file, "rb") as stream:
            return stream.read(count)
    except OSError:
        return b""


def read_luminaire(file, intensity=None, variant=None, emitter=None):
    """The Photometry of a file, as read_any() has it. Warns of what is unlikely in it."""
    read = read_any(file, intensity, variant, emitter)
    for doubt in read.doubts():
        warnings.warn(f"{file}: {doubt}", stacklevel=2)
    return read


def read_any(file, intensity, variant, emitter):
    """The Photometry of a file: GLDF if it is a zip, TM-33 if it is XML, EULUMDAT if its name ends with .ldt, or IES if it has a line TILT=.

    intensity: the unit of an IES file that does not say it (cd, W/sr, mW/sr, uW/sr). variant, emitter: ids in a GLDF file.
    """
    if os.path.exists(file) and not os.path.isdir(file) and not os.path.isfile(file):  # a pipe might never end
        raise fault(file, None, "is a pipe or a device, and a luminaire is read twice; write it to a file")
    ending = file.lower().rsplit(".", 1)[-1]
    first = begins(file, 64).removeprefix(b"\xef\xbb\xbf").lstrip()
    gldf = ending == "gldf" or first.startswith(ZIP)
    for given, name in ((variant, "variant"), (emitter, "emitter")):
        if given is not None and not gldf:
            raise fault(file, None, f"is not a GLDF file, which alone has a {name}")
    ies = not gldf and ending not in ("xml", "ldt", "eul") and not first.startswith(b"<")
    if intensity is not None and not ies:
        raise fault(file, None, "is not an IES file, which alone may leave out its unit (--intensity)")
    if gldf:
        return read_gldf(file, variant, emitter)
    if ending == "xml" or first.startswith(b"<"):
        return read_tm33(file)
    if ending in ("ldt", "eul"):
        return read_eulumdat(file)
    if ending == "ies" or any(line.strip().upper().startswith("TILT=") for line in lines_of(file)):
        return read_ies(file, intensity)
    raise fault(file, None, "is neither an IES file, which has a line TILT=, nor EULUMDAT (.ldt), GLDF (.gldf) or TM-33 (.xml)")
