"""A luminaire as a RADIANCE scene, or its UGR table, from an IES LM-63, EULUMDAT, GLDF or TM-33 file."""
import os

from ..command import Options
from ..fault import Fault, fault, warn_of_factor
from . import radiant
from .lamp_rad import UNITS, pattern_text, surfaces_text, word, write_data
from .luminaire_file import read_luminaire
from .ugr_table import SPACINGS, UgrTable
from .ugr_text import csv, svg, text

TEXT = """\
Writes the luminaire at the origin, aimed down: C0 is along +x, and C90 along +y. In a scene file, the line
!xform -t 2 3 2.9 panel.rad hangs it; rsphere has xform. The intensities are in panel.dat, which is written beside its
formulas, lamp.cal, into the folder of -o. rsphere finds both beside panel.rad; RADIANCE's rtrace needs the folder in RAYPATH.

With --ugr, prints the UGR table of CIE 117 and CIE 190 instead: 19 rooms by 5 reflectances, seen crosswise and endwise."""


def main():
    parser = Options("FILE.ies | FILE.ldt | FILE.gldf | FILE.xml", TEXT)
    parser.add_argument("file")
    parser.add_argument("-u", "--units", choices=UNITS, default="m", metavar="UNIT", help=f"of the scene: {', '.join(UNITS)}")
    parser.add_argument("-f", "--factor", type=float, default=1.0, metavar="X", help="on the light, such as a maintenance factor")
    parser.add_argument("-o", "--output", default=".", metavar="FOLDER", help="for panel.dat and lamp.cal; the scene goes to the standard output")
    parser.add_argument("--intensity", choices=radiant.UNITS, metavar="UNIT", help=f"of an IES file that does not say it: {', '.join(radiant.UNITS)}")
    parser.add_argument("--variant", metavar="ID", help="of a GLDF file: the first")
    parser.add_argument("--emitter", metavar="ID", help="of a variant that has several")
    parser.add_argument("--ugr", action="store_true", help="print the UGR table instead of a scene")
    parser.add_argument("--spacing", type=float, choices=SPACINGS, default=SPACINGS[0], metavar="S",
                        help="of luminaires in the rooms of the table, in heights above the eye: .25 or 1")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--csv", dest="form", action="store_const", const=csv, default=text, help="the table as comma-separated values")
    form.add_argument("--svg", dest="form", action="store_const", const=svg, help="the table as a drawing")
    given = parser.parse_args()
    parser.limit(given, ("factor", 1e-6, 1e6))
    warn_of_factor(given.factor, f"-f {given.factor:g}")
    parser.refuse(*((("units", "output"), "is that of a scene, without --ugr") if given.ugr else (("spacing", "form"), "needs --ugr")))
    photometry = read_luminaire(given.file, given.intensity, given.variant, given.emitter)
    if given.ugr:
        print(given.form(UgrTable(photometry, given.spacing, given.factor * photometry.tilt_factor(0))), end="")
        return
    name = word(os.path.splitext(os.path.basename(given.file))[0])
    if os.path.splitext(given.output)[1] in (".rad", ".dat") or os.path.isfile(given.output):
        raise Fault(f"-o {given.output}: this is the folder of the data file; the scene goes to the standard output, as in: "
                    f"rsphere-luminaire {given.file} > {name}.rad")
    try:
        os.makedirs(given.output, exist_ok=True)
        data = write_data(photometry, given.output, name)
    except OSError as error:
        raise fault(error.filename or given.output, None, f"cannot be written: {error.strerror}") from None
    flux = f"{photometry.lumens():.4g} W radiant (rsphere -pA has W/m2)" if photometry.radiant else f"{photometry.lumens():.0f} lm"
    print(f"# {word(photometry.name)} from {word(os.path.basename(given.file))}: {flux}, {photometry.watts:g} W")
    for note in photometry.notes:
        print(f"# {note}")
    factor = given.factor * photometry.tilt_factor(0)
    print(pattern_text(photometry, name, data, factor) + surfaces_text(photometry, name, name, units=UNITS[given.units]), end="")
