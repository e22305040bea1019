"""A luminaire as a RADIANCE scene, from an IES LM-63 or EULUMDAT file."""
import os

from ..command import Options
from ..fault import fault
from .lamp_rad import UNITS, pattern_text, surfaces_text, word, write_data
from .luminaire_file import read_luminaire

TEXT = """\
Writes the luminaire at the origin, aimed down; `xform -t 2 3 2.9 panel.rad` moves it. The intensities are in panel.dat,
which is written beside its formulas, lamp.cal, into the folder of -o; rsphere and rtrace look there if the folder is in
RAYPATH. C0 is along +x, and C90 along +y."""


def main():
    parser = Options("FILE.ies | FILE.ldt", TEXT)
    parser.add_argument("file")
    parser.add_argument("-u", "--units", choices=UNITS, default="m", metavar="UNIT", help=f"of the scene: {', '.join(UNITS)}")
    parser.add_argument("-f", "--factor", type=float, default=1.0, metavar="X", help="on the light, such as a maintenance factor")
    parser.add_argument("-o", "--output", default=".", metavar="FOLDER", help="for the data file")
    given = parser.parse_args()
    photometry = read_luminaire(given.file)
    name = word(os.path.splitext(os.path.basename(given.file))[0])
    try:
        os.makedirs(given.output, exist_ok=True)
        data = write_data(photometry, given.output, name)
    except OSError as error:
        raise fault(error.filename or given.output, None, f"cannot be written: {error.strerror}") from None
    print(f"# {word(photometry.name)} from {word(os.path.basename(given.file))}: {photometry.lumens():.0f} lm, {photometry.watts:g} W")
    factor = given.factor * photometry.tilt_factor(0)
    print(pattern_text(photometry, name, data, factor) + surfaces_text(photometry, name, name, units=UNITS[given.units]), end="")
