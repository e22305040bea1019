"""Reads photometric files of either format."""
from ..fault import fault, lines_of
from .eulumdat import read_eulumdat
from .ies import read_ies


def read_luminaire(file):
    """The Photometry of a file: EULUMDAT if its name ends with .ldt, or IES if it has a line TILT=."""
    if file.lower().endswith((".ldt", ".eul")):
        return read_eulumdat(file)
    if file.lower().endswith(".ies") or any(line.strip().upper().startswith("TILT=") for line in lines_of(file)):
        return read_ies(file)
    raise fault(file, None, "is neither an IES file, which has a line TILT=, nor an EULUMDAT file, whose name ends with .ldt")
