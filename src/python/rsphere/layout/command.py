"""Where should the lamps hang? From goals to the layout of luminaires that meets them with the least watts."""
import argparse
import os
import time

import rsphere

from ..command import Options
from ..fault import Fault, make_folder
from .kinds import explained
from .limits import ACTIVITIES
from .report import Report
from .steps import Steps

TEXT = """\
GOALS is a text that says what is wanted, which luminaires there are, and where they may hang: rsphere-layout(1).
The room has no luminaires that are lit. The layout, its luminaires as .rad, a table of what was planned and of what light
traced forward finds, plans and a page for the browser (page.html) go into the folder of -o.
With --report, GOALS says which tasks are in a room with its luminaires; report.html and report.txt compare it with EN 12464-1."""


class Activities(argparse.Action):
    """Prints the activities whose limits are known, and ends."""

    def __call__(self, parser, *_):
        for a in ACTIVITIES.values():
            room = f"at eyes {a.cylindrical:g} lx, walls {a.walls:g} lx, ceiling {a.ceiling:g} lx"
            print(f"{a.title()}: {a.illuminance:g} lx, U_o {a.uniformity:.2f}, UGR {a.ugr:g}; {room}")
        parser.exit()


def arguments():
    parser = Options("goals scene...", TEXT)
    parser.add_argument("goals")
    parser.add_argument("room", nargs="+", metavar="scene")
    parser.add_argument("-o", "--output", default="layout", metavar="FOLDER", help="for the results")
    parser.add_argument("-t", "--title", default="", metavar="TEXT", help="of the page")
    parser.add_argument("-b", "--bounces", type=int, default=5, metavar="N", help="reflections that are followed")
    parser.add_argument("-d", "--directions", type=int, default=2048, metavar="N", help="of importance, at each place")
    parser.add_argument("-s", "--seconds", type=float, default=30, metavar="S", help="that the search may take")
    parser.add_argument("-g", "--gap", type=float, default=0.01, metavar="X", help="more watts than the least, as a share, end the search")
    parser.add_argument("-c", "--check", type=int, default=128, metavar="N", help="rays to hemispheres (-ad) in each of six checks; 0: none")
    parser.add_argument("-p", "--plan", metavar="NAME", help="polygon or modifier above which plans are drawn: the floor")
    parser.add_argument("--height", type=float, metavar="H", help="of plans above it: that of the goals, or .75 m")
    parser.add_argument("--no-plan", action="store_true", help="no falsecolor plans")
    parser.add_argument("--polish", action="store_true", help="look for better places and aims between the candidates")
    parser.add_argument("--judge", default="", metavar="LAYOUT", help="check this layout, such as layout.txt of -o, instead of finding one")
    parser.add_argument("--report", action="store_true", help="on a room with its luminaires, by EN 12464-1")
    parser.add_argument("--accuracy", type=float, default=0.02, metavar="X", help="of the report: standard error of a point")
    parser.add_argument("--activities", action=Activities, nargs=0, help="with their limits, for the report")
    given = parser.parse_args()
    parser.limit(given, ("bounces", 0, 50), ("directions", 64, 65536), ("seconds", 0.1, 1e6), ("gap", 0, 1), ("check", 0, 65536), ("accuracy", 1e-4, 0.5),
                 ("height", -1e6, 1e6))
    if sum(map(bool, (given.polish, given.judge, given.report))) > 1:
        raise Fault("--polish, --judge and --report exclude each other")
    for unused, names, why in (
            (given.report, ("directions", "seconds", "gap", "check", "plan", "height"), "is that of a layout, not of --report"),
            (given.judge, ("seconds", "gap"), "is that of a search, instead of --judge"),
            (given.no_plan, ("plan", "height"), "is that of plans, without --no-plan"),
            (not given.report, ("accuracy",), "needs --report")):
        if unused:
            parser.refuse(names, why)
    return given


def main():
    given = arguments()
    make_folder(given.output)
    begin = time.monotonic()
    try:
        steps = (Report if given.report else Steps)(rsphere, given)
        steps.run()
    except Fault as error:
        raise explained(given, error) from None
    print(f"{os.path.join(given.output, 'report.html' if given.report else 'page.html')}: the page ({time.monotonic() - begin:.0f} s in all)")
    return 0 if steps.met() else 2
