"""From a scene and a weather file to verdicts on daylight."""
import math
import os
import sys
import tempfile

import numpy as np

import rsphere

from ..command import Options
from ..fault import Fault, fault, make_folder
from ..layout.room import polygons_named, read_polygons
from ..progress import PROGRESS
from . import outside
from .alpha_opic import melanopic_year, quantities_of_eyes, verdicts_of_eyes
from .glare import Glare
from .light import DIM, ESTIMATES, Light, check_sky, light_of_coefficients, occupied_hours
from .matrix import read_coefficients
from .passes import Settings
from .report import Report
from .sensors import read_sensors, scene_files, sensors_on
from .shades import check_shapes, groups_of, lightless, refuse_walls, some
from .sky import SOLAR_CONSTANT
from .sun import sun_position
from .verdicts import FROM, UNTIL, verdicts_of
from .weather import read_weather

HOURS_OF_YEAR, HOURS_OF_LEAP_YEAR = 8760, 8784
LATE, TOO_LATE = 0.05, 0.25  # of the light may be at hours when the sun is down: the first and the last hour of a day
MOST_ESTIMATES = 512
SUN_SHARE = 16  # of --divisions for reflected sun, whose rays take longer: for the noise of a year 20 were best, for that of single hours 8
QUARTER_HOUR = 3.75  # degrees of longitude
HIGH, FEW, SELDOM, DARK = math.radians(10), 8, 0.02, 0.05  # altitudes and numbers of hours by which units are judged, shares of hours and of light
OFTEN, MANY = 0.1, 100  # share and number of hours from which on weather is surely wrong
FACES_DOWN = 0.99  # of a normal along -z
TINY = 1e-6  # sum of a sensor's coefficients: nothing, or of the other byte order

TEXT = """\
The weather may also come first, before a scene or coefficients alone: rsphere-annual town.epw room.rad.
The scene has no sky; the weather (.epw or .wea) brings it. Verdicts are printed with their sources. They, what each sensor has,
plans and a page for the browser (page.html) go into the folder of -o. rsphere-annual(1) describes the method."""


def arguments():
    parser = Options("scene...", TEXT)
    parser.add_argument("scene", nargs="*")
    parser.add_argument("--weather", metavar="FILE", help="the hours of a year: .epw or .wea")
    parser.add_argument("--sensors", metavar="FILE", help="x y z dx dy dz, one a line; otherwise a grid")
    parser.add_argument("--on", action="append", metavar="NAME", help="polygon or modifier with a grid of sensors [floor]")
    parser.add_argument("--height", type=float, default=0.85, metavar="H", help="of the grid above it")
    parser.add_argument("--spacing", type=float, default=0.5, metavar="D", help="largest, of the grid")
    parser.add_argument("--margin", type=float, default=0, metavar="M", help="without sensors, along edges")
    parser.add_argument("--shades", action="append", default=[], metavar="NAME[=X]", help="windows with blinds: modifier; transmittance or file")
    parser.add_argument("--sunlight", metavar="NAME", help="windows whose hours of sun are counted (EN 17037): modifier, or file of points")
    parser.add_argument("--day", default="3-21", metavar="M-D", help="of these hours, from 2-1 to 3-21")
    parser.add_argument("--sun-altitude", type=float, default=outside.LOWEST_SUN, metavar="A", help="lowest that counts, degrees: your country's")
    parser.add_argument("--view", type=float, metavar="H", help="view out (EN 17037) of eyes this high above the floor: 1.2")
    parser.add_argument("--landscape", action="append", default=[], metavar="NAME", help="modifier of what is landscape or city in views")
    parser.add_argument("--ground", action="append", default=["ground"], metavar="NAME", help="of the ground outside")
    parser.add_argument("--eyes", metavar="FILE", help="x y z dx dy dz, one a line: melanopic and other light (CIE S 026) at eyes")
    parser.add_argument("--glare", action="store_true", help="daylight glare probability at these eyes; takes seconds for each")
    parser.add_argument("--coefficients", metavar="FILE", help="of rcontrib or rfluxmtx, instead of a scene")
    parser.add_argument("-b", "--bounces", type=int, default=8, metavar="N", help="reflections that are followed")
    parser.add_argument("-d", "--divisions", type=int, default=384, metavar="N", help="rays of a sensor (-ad) in each estimate")
    parser.add_argument("-e", "--estimates", type=int, default=ESTIMATES, metavar="N", help="independent ones, averaged")
    parser.add_argument("--accuracy", type=float, metavar="X", help="estimates are added until noise turns no verdict, or to this error")
    parser.add_argument("-n", "--threads", type=int, default=0, metavar="N", help="0: one for each core")
    parser.add_argument("-t", "--title", default="", metavar="TEXT", help="of the page")
    parser.add_argument("-o", "--output", default="annual", metavar="FOLDER", help="for the results")
    given = parser.parse_intermixed_args()  # scene files may be before and behind options
    parser.limit(given, ("bounces", 1, 50), ("divisions", 16, 65536), ("estimates", 2, MOST_ESTIMATES), ("threads", 0, 4096), ("spacing", 1e-6, 1e6),
                 ("margin", 0, 1e6), ("height", -1e6, 1e6), ("accuracy", 1e-5, 1), ("sun_altitude", 0, 45), ("view", 0, 100))
    weather = [*filter(None, [given.weather]), *(file for file in given.scene if file.lower().endswith((".epw", ".wea")))]
    if len(weather) > 1:
        raise Fault(f"{weather[0]} and {weather[1]} are weather, of which there is one")
    if weather and not given.weather:
        given.weather, given.scene = weather[0], [file for file in given.scene if file != weather[0]]
        if len(given.scene) == 1 and not given.scene[0].lower().endswith((".rad", ".oct")):
            given.coefficients, given.scene = given.scene[0], []
    if not given.weather:
        raise Fault("needs --weather FILE, the hours of a year: .epw or .wea")
    for name in ("sensors", "sunlight", "eyes", "coefficients"):
        if getattr(given, name) == "":
            raise Fault(f"--{name} has no name")
    real = [*map(os.path.realpath, given.scene)]
    for word in given.shades:
        if "=" in word and os.path.realpath(word.partition("=")[2]) in real:
            raise Fault(f"--shades {word}: is a file of the scene, which is always there; blinds need a file of their own")
    if bool(given.scene) == bool(given.coefficients):
        raise Fault("needs scene files, or --coefficients alone")
    given.day = outside.day_of(given.day)
    outdoors = given.sunlight or given.view is not None
    for unused, names, why in (
            (given.coefficients, ("sensors", "on", "height", "spacing", "margin", "shades", "sunlight", "view", "eyes", "bounces", "divisions", "estimates",
                                  "accuracy"), "needs scene files instead of --coefficients"),
            (not given.eyes, ("glare",), "needs --eyes FILE"),
            (not given.sunlight, ("day", "sun_altitude"), "needs --sunlight NAME"),
            (given.view is None, ("landscape", "ground"), "needs --view H"),
            (given.sensors, ("spacing", "margin"), "belongs to a grid of sensors, instead of --sensors"),
            (given.sensors and not outdoors, ("height",), "is that of a grid instead of --sensors, or of these above the floor for --sunlight and --view")):
        if unused:
            parser.refuse(names, why)
    if given.on and given.sensors:
        raise Fault("sensors are those of --sensors, or a grid --on a surface, not both")
    both = set(given.landscape) & set(given.ground)
    if both:
        raise Fault(f"--landscape {min(both)}: is ground, too")
    given.on = list(dict.fromkeys(given.on or [])) or ([] if given.sensors or given.coefficients else ["floor"])
    return given


def warn(file, text):
    PROGRESS.clear()
    print(f"rsphere-annual: warning - {file}: {text}", file=sys.stderr)


def doubt(file, line, text, sure, weather):
    """Raises Fault if weather of many hours is surely wrong, and warns otherwise."""
    if sure and len(weather.hours) >= MANY:
        raise fault(file, line, text)
    warn(file, text)


def check_weather(file, weather, dark_sun):
    """Warns of what a year lacks. Raises Fault if its sun is elsewhere."""
    n, missing = len(weather.hours), weather.missing
    if n + missing > HOURS_OF_LEAP_YEAR:
        raise fault(file, None, f"has {n + missing} rows, more than a year has hours: each must be an hour")
    light = np.array([row[3:] for row in weather.hours])
    shares = light[dark_sun].sum(axis=0) / np.maximum(light.sum(axis=0), 1e-9)
    kind = np.argmax(shares)
    late = shares[kind]
    if late > LATE:
        at = np.flatnonzero(dark_sun & (light[:, kind] > 0))[0]
        first = weather.hours[at]
        when = f"such as {first[0]}-{first[1]} at {first[2]:g} h"
        up = light[dark_sun & (light[:, 1] > 0)].sum(axis=0) / np.maximum(light.sum(axis=0), 1e-9)
        if (up <= LATE).all():  # the file itself says that it was night
            doubt(file, weather.lines[at], f"{late:.0%} of the direct light is at hours without diffuse light, {when}, and left out", late > TOO_LATE, weather)
        else:
            doubt(file, weather.lines[at], f"{late:.0%} of the {('direct', 'diffuse')[kind]} light is at hours without a sun or without diffuse light, {when}; are its latitude, "
                  "longitude and time zone right?", late > TOO_LATE, weather)
    if missing:
        warn(file, f"{missing} of {n + missing} hours have no irradiance (9999) and are left out")
    if n + missing < HOURS_OF_YEAR:
        warn(file, f"has {n + missing} hours, fewer than a year's {HOURS_OF_YEAR}; shares are of these hours")


def check_units(file, weather):
    """Warns of irradiances that are too small or too large for W/m2, and of a time zone in hours. Raises Fault if they surely are."""
    if abs(weather.place[2] / QUARTER_HOUR - round(weather.place[2] / QUARTER_HOUR)) > 1e-6:
        warn(file, f"the meridian of the time zone, {weather.place[2]:g} degrees, is at no quarter of an hour (3.75 degrees); is it in hours?")
    rows = [(row, sun_position(*row[:3], *weather.place)[0], line) for row, line in zip(weather.hours, weather.lines) if row[3] + row[4] > 0]
    above = [(row[3] * math.sin(a) + row[4]) / (SOLAR_CONSTANT * math.sin(a)) for row, a, _ in rows if a > HIGH]
    lines = [line for *_, a, line in rows if a > HIGH]
    beyond = np.array([share > 1 for share in above])
    if len(above) >= FEW and beyond.mean() > SELDOM:
        doubt(file, lines[np.argmax(beyond)], f"{beyond.sum()} of {len(above)} hours with a high sun have more irradiance than there is outside of the "
              "atmosphere; is it in W/m2, first direct normal, then diffuse?", beyond.mean() > OFTEN, weather)
    if len(above) >= FEW and max(above) < DARK:
        doubt(file, None, f"no hour has more than {DARK:.0%} of the irradiance outside of the atmosphere; is it in W/m2?", True, weather)


def estimates(light, given):
    """Adds estimates until there are enough. Ctrl-C leaves those that are there."""
    PROGRESS.begin("Light of sky and sun", 2 * given.estimates * light.pass_count())
    while True:
        light.add()
        n = light.counts.sum()
        if n < given.estimates or (given.accuracy and n % ESTIMATES):
            continue
        if not given.accuracy or n >= MOST_ESTIMATES or light.error() <= given.accuracy:
            return
        if not any(v.hangs() for v in verdicts_of(light.year)):
            return
        PROGRESS.count += 2 * ESTIMATES * light.pass_count()


def add_eyes(eyes, light, glare, report):
    """Adds what eyes get to a Report. glare: a Glare or None."""
    quantities = quantities_of_eyes(light.year, light.at_eyes)
    report.add(verdicts_of_eyes(melanopic_year(light.year, light.at_eyes)), {})
    if glare:
        n = len(glare.weights)
        if n < len(eyes):
            report.notes.append(f"Interrupted: glare at {n} of {len(eyes)} eyes.")
        quantities.update({name: (*(np.append(x, np.full(len(eyes) - n, np.nan)) for x in values), unit) for name, (*values, unit) in glare.quantities().items()})
        report.add(glare.verdicts(), {})
    report.eyes = eyes, quantities


def add_outside(given, polygons, sensors, weights, place, report):
    """Adds sunlight and view out to a Report."""
    scene = rsphere.Scene(given.scene)
    through = [word.partition("=")[0] for word in given.shades] + [given.sunlight] * bool(given.sunlight)
    floor = sensors[:, 2].min() - given.height
    if given.sunlight:
        windows = outside.windows_of(given.sunlight, polygons, sensors[:, :3], floor)
        panes = outside.panes_of(given.sunlight, polygons)
        with tempfile.TemporaryDirectory() as folder:
            dark = [p.name for p, d in zip(panes, lightless(panes, given.scene, sensors[:, :3], folder) if panes else ()) if d]
        if dark:
            warn(f"--sunlight {given.sunlight}", f"no light passes through {some(dark)}")
        verdicts, report.windows = outside.sunlight_verdicts(scene, windows, given.day, place, given.sun_altitude, through)
        report.add(verdicts, {}, f"Sunlight counts from an altitude of {given.sun_altitude:g} degrees (--sun-altitude): the table of the standard "
                                 "was not read. Hours are those in which it shines on any of the windows.")
    if given.view is not None:
        PROGRESS.begin("View out", len(sensors))
        view = outside.View(scene, sensors[:, :3] + [0, 0, given.view - given.height], given.landscape, given.ground, through)
        lacks = [f"No surface is landscape (--landscape {', '.join(given.landscape) or 'NAME'}): no view is met."] * (not view.solid_angles[:, 1].any())
        for name in view.unseen(given.landscape + given.ground[1:]):
            warn("--landscape and --ground", f"no eye sees {name}")
        report.add(view.verdicts(weights), view.quantities(), *lacks)


def check_grid(given, polygons, sensors, planes):
    """Warns of work planes whose sensors are hardly meant. Raises Fault if two planes have a polygon in common."""
    scene, had = rsphere.Scene(given.scene), {}
    for name, rows in planes:
        for p in polygons_named(polygons, name, ("--on " + name, None)):
            if had.setdefault(id(p), name) != name:
                raise Fault(f"--on {name}: has {p.name}, which --on {had[id(p)]} has already")
        places, normals = sensors[rows, :3], sensors[rows, 3:]
        if (normals[:, 2] < -FACES_DOWN).all():
            warn("--on " + name, "faces down, and so do its sensors")
        if len(places) == 1:
            warn("--on " + name, "has one sensor; is --spacing in the units of the scene?")
        lift = 1e-3 * given.height
        rays = np.hstack([places + (lift - given.height) * normals, math.copysign(1, given.height) * normals])
        between = scene.trace(rays, outputs="L", ambient_bounces=0).first_length < abs(given.height - lift) if given.height else np.zeros(1)
        if between.mean() > 0.5:
            warn("--on " + name, f"something is between it and the sensors, {given.height:g} away (--height)")


def outside_of(polygons, places):
    """Which places are farther from the scene than it is large."""
    corners = np.concatenate([p.corners for p in polygons])
    low, high = corners.min(axis=0), corners.max(axis=0)
    return np.linalg.norm(np.maximum(low - places[:, :3], places[:, :3] - high).clip(0), axis=1) > np.linalg.norm(high - low)


def light_of_scene(given, weather, polygons, notes):
    """The Light, the sensors, for each work plane its name and which of them are on it, the eyes, and their Glare or None."""
    if given.on:
        sensors, weights, planes = sensors_on(given, polygons)
        check_grid(given, polygons, sensors, planes)
    else:
        sensors, planes = read_sensors(given.sensors), []
        weights = np.full(len(sensors), 1 / len(sensors))
    eyes = read_sensors(given.eyes, "an eye") if given.eyes else np.zeros((0, 6))
    if given.glare and (np.hypot(eyes[:, 3], eyes[:, 4]) < 1e-6 * np.abs(eyes[:, 5])).any():
        raise fault(given.eyes, None, "has a gaze straight up or down, where glare is not defined")
    for option, places in (("--eyes", eyes),) + (("--sensors", sensors),) * bool(given.sensors):
        beyond = outside_of(polygons, places)
        if beyond.any():
            warn(option, f"{beyond.sum()} of {len(places)} are farther from the scene than it is large; are they in its units?")
    groups = groups_of(given.shades, polygons, sensors[:, :3])
    if groups:
        check_shapes(groups, given.scene)
    with tempfile.TemporaryDirectory() as folder:
        check_sky([*(file for group in groups for file in group.files), *given.scene], polygons, folder)
        if groups:
            refuse_walls(groups, given.scene, sensors[:, :3], folder)
        light = Light(given.scene, sensors, weights, weather, groups, folder,
                      Settings(given.bounces, given.divisions, max(16, given.divisions // SUN_SHARE), threads=given.threads), eyes)
        check_weather(given.weather, weather, light.dark_sun)
        try:
            estimates(light, given)
        except KeyboardInterrupt:
            if light.counts.sum() < 2:
                raise
            PROGRESS.clear()
            notes.append(f"Interrupted after {light.counts.sum()} estimates.")
        try:
            glare = Glare(given.scene, eyes, weather, groups, folder, light) if given.glare else None
        except KeyboardInterrupt:
            PROGRESS.clear()
            glare = None
            notes.append("Interrupted: there is no glare.")
    for name in light.idle:
        warn("--shades " + name, "lowered, they change the light at no sensor: is this the window, and are its blinds in front of it?")
    received = light.year.open.sum(axis=(0, 2))
    dim = np.flatnonzero(received <= DIM * received.mean())
    if len(dim):
        x, y, z = sensors[dim[len(dim) // 2]][:3]
        light_there = f"less than {DIM:.0%} of the mean light" if received[dim].any() else "no light"
        warn("sensors", f"{len(dim)} of {len(sensors)} get {light_there} in the whole year, such as at {x:g} {y:g} {z:g}: "
             "they may be inside of something; a list of the others (--sensors) leaves them out")
    notes += light.notes()
    return light, sensors, planes, eyes, glare


def main():
    given = arguments()
    weather = read_weather(given.weather)
    if not occupied_hours(np.array(weather.hours, float)):
        raise fault(given.weather, None, f"has no hour from {FROM} to {UNTIL} h")
    if not any(row[4] for row in weather.hours):
        raise fault(given.weather, None, "has no hour with diffuse light")
    check_units(given.weather, weather)
    make_folder(given.output)
    notes, polygons = [], []
    if given.coefficients:
        coefficients, factor = read_coefficients(given.coefficients)
        dark = int((coefficients.sum(axis=1) < TINY).sum())
        if dark == len(coefficients):
            raise fault(given.coefficients, None, "all sensors have coefficients of 0 alone, or nearly so; is BigEndian= right?")
        year, dark_sun = light_of_coefficients(coefficients, factor, weather)
        check_weather(given.weather, weather, dark_sun)
        if dark:
            warn(given.coefficients, f"{dark} of {len(coefficients)} sensors have coefficients of 0 alone")
        notes.append("The sun is spread over patches of the sky: there is no ASE, no shade is lowered, and errors are not known.")
        lux_hours = year.lux.mean(axis=0)[:, year.occupied()].sum(axis=1).mean()
        notes.append(f"Light from {FROM} to {UNTIL} h: {lux_hours / 1e6:.3f} Mlx h, mean of the sensors.")
        sensors, planes = np.zeros((len(coefficients), 0)), []
    else:
        given.scene = [file for path in given.scene for file in scene_files(path)]
        polygons = read_polygons(given.scene)
        light, sensors, planes, eyes, glare = light_of_scene(given, weather, polygons, notes)
        year = light.year
    notes.insert(0, f"{len(sensors)} sensors; {year.all_hours} hours of {os.path.basename(given.weather)}, {year.occupied_hours} from 8 to 18 h.")
    report = Report(year, list(verdicts_of(year)), notes)
    if given.scene:
        if len(eyes):
            add_eyes(eyes, light, glare, report)
        add_outside(given, polygons, sensors, year.weights, weather.place, report)
    text = report.text()  # printed when all is in files: who reads it may have gone
    report.write(given.output, "table.txt", text)
    report.write_places(given.output, "sensors.txt", sensors[:, :3], report.quantities)
    if report.eyes:
        report.write_places(given.output, "eyes.txt", *report.eyes)
    report.write_page(given, planes, sensors, polygons)
    print(text, end="")
    print(f"{os.path.join(given.output, 'page.html')}: the page")
    return 0
