"""Which photometric files are radiant: of watts instead of lumens, as those of lamps for UV."""
import re

# A unit in the text of the file, and words that say that intensities are not those of light, without saying their unit.
UNIT = re.compile(r"(?<![A-Za-z])(m|u|\xb5|\xc2\xb5|milli|micro)?w(?:atts?)?(?:\s*/\s*|\s+per\s+)(?:sr\b|ster)", re.IGNORECASE)
WORDS = re.compile(r"radiometric|radiant\s+(?:intensit|flux|power|watt)|germicidal|\bUV-?C\b|far-?UV|\b(?:207|222|254|265|275)\s*nm\b", re.IGNORECASE)
FACTORS = {"": 1.0, "m": 1e-3, "milli": 1e-3}  # W/sr; all others are micro
UNITS = {"cd": (False, 1.0), "W/sr": (True, 1.0), "mW/sr": (True, 1e-3), "uW/sr": (True, 1e-6)}


def unit_in(text):
    """Of the text of a file: whether its intensities are radiant, and their factor; None if it says so, but not in which unit."""
    found = UNIT.search(text)
    if found:
        return True, FACTORS.get((found[1] or "").lower(), 1e-6)
    return None if WORDS.search(text) else (False, 1.0)
