"""Reads a design: the file that says what is wanted, which luminaires there are, and where they may hang."""
import os
from dataclasses import dataclass, field

import numpy as np

from ..fault import Fault, fault, lines_of, number, warn_of_factor, whole
from ..photometry.intensities import Photometry
from ..photometry.lamp_rad import UNITS, rotation, word
from ..photometry.luminaire_file import read_luminaire
from .room import cells_of, names_matching, polygons_named, surface_of

MOST_CANDIDATES = 20000
MOST_SCENES = 100
FAR = 20  # times the size of the scene: what is farther away is in other units
MOST_OF_NAME = 100  # characters of names that become those of files
SCENE_SIZES = 0.3, 1e5  # m: others are those of a scene whose units are wrong


@dataclass
class Luminaire:
    name: str
    photometry: Photometry
    watts: float
    factor: float  # on the light


@dataclass
class Candidate:
    luminaire: int
    position: np.ndarray
    aim: np.ndarray
    turn: float
    row: tuple = None  # the number of its grid, and its row and column there

    def matrix(self):
        return rotation(self.aim, self.turn)


@dataclass
class Eye:
    name: str
    position: np.ndarray
    gaze: np.ndarray = None  # unit; None if only its place is known


@dataclass
class Sensor:
    name: str
    position: np.ndarray
    normal: np.ndarray


@dataclass
class Goal:
    kind: str  # illuminance, uniformity, most (an upper limit), cylindrical or ugr
    target: str  # the name of a surface, sensor or eye
    value: float
    place: tuple  # file and line


@dataclass
class Scene:
    name: str
    goals: list = field(default_factory=list)
    daylight: list = field(default_factory=list)  # scene files
    place: tuple = None


@dataclass
class Design:
    file: str
    units: float = 1.0  # of the scene, in a metre
    maintenance: float = 1.0
    luminaires: list = field(default_factory=list)
    candidates: list = field(default_factory=list)
    surfaces: dict = field(default_factory=dict)
    sensors: dict = field(default_factory=dict)
    eyes: dict = field(default_factory=dict)
    common: list = field(default_factory=list)  # goals of all scenes
    scenes: list = field(default_factory=list)
    dimming: bool = None
    rows: bool = False
    even: bool = True  # rows are evenly spaced
    apart: float = 0.0  # units of the scene
    mirrors: list = field(default_factory=list)  # (axis, coordinate)
    most: int = None

    def all_scenes(self):
        """Each scene with the goals that it shares with all others; one without a name if the file has no scenes."""
        if not self.scenes:
            return [Scene("", self.common, [], (self.file, 1))]
        return [Scene(s.name, self.common + s.goals, s.daylight, s.place) for s in self.scenes]

    def dims(self):
        return self.dimming if self.dimming is not None else bool(self.scenes)


class Words:
    """The words of a line, taken one after the other."""

    def __init__(self, words, file, line):
        self.words, self.place, self.next = words, (file, line), 0

    def fault(self, text):
        return fault(*self.place, text)

    def text(self, what):
        if self.next >= len(self.words):
            raise self.fault(f"{self.words[0]} needs {what}")
        self.next += 1
        return self.words[self.next - 1]

    def file_name(self):
        """A name that a part of the names of files will be."""
        name = self.text("a name")
        if len(name) > MOST_OF_NAME:
            raise self.fault(f'the name "{name[:20]}..." has more than {MOST_OF_NAME} characters')
        return word(name)

    def number(self, what, least=-1e9, most=1e9):
        return number(self.text(what), *self.place, what, least, most)

    def vector(self, what):
        return np.array([self.number(f"{axis} of {what}") for axis in "xyz"])

    def unit(self, what):
        vector = self.vector(what)
        if not np.linalg.norm(vector) > 0:
            raise self.fault(f"{what} must not be 0 0 0")
        return vector / np.linalg.norm(vector)

    def more(self):
        return self.next < len(self.words)

    def more_number(self):
        return self.more() and self.words[self.next][:1] in set("+-.0123456789")

    def options(self, ranges, flags=(), twice=()):
        """The options that follow, until the line ends: numbers within ranges, of which some may be two, and flags."""
        found, names = {}, [*ranges, *flags]
        while self.more():
            key = self.text(" or ".join(names) if len(names) == 2 else "an option")
            if key not in names:
                raise self.fault(f'"{key[:40]}" is ' + (f"neither {names[0]} nor {names[1]}" if len(names) == 2 else f"none of {', '.join(names)}"))
            if key in found:
                raise self.fault(f"{key} is given twice")
            found[key] = True if key in flags else self.number(f"the {key}", *ranges[key])
            if key in twice and self.more_number():
                found[key] = [found[key], self.number(f"the {key}", *ranges[key])]
        return found

    def end(self):
        if self.more():
            raise self.fault(f'"{self.words[self.next]}" is not expected here')


class Statements:
    """Reads the lines of a file about a room, one function for each first word."""

    ONCE = {"units", "maintenance"}  # first words of lines of which the last one would hold

    def __init__(self, file, polygons):
        self.file, self.folder = file, os.path.dirname(file)
        self.polygons = polygons
        corners = np.concatenate([p.corners for p in polygons]) if polygons else np.zeros((1, 3))
        self.low, self.high = corners.min(axis=0), corners.max(axis=0)

    def take_lines(self):
        lines = {}  # of those that are there once, their numbers
        for index, line in enumerate(lines_of(self.file, "utf-8", "surrogateescape")):
            words = line.split("#")[0].split()
            if not words:
                continue
            taken = Words(words, self.file, index + 1)
            taken.next = 1
            function = getattr(self, "read_" + words[0], None)
            if function is None:
                known = ", ".join(n[5:] for n in dir(self) if n.startswith("read_"))
                raise taken.fault(f'"{words[0][:40]}" is none of {known}')
            if words[0] in self.ONCE and lines.setdefault(words[0], index + 1) <= index:
                raise taken.fault(f"{words[0]} is in line {lines[words[0]]}, too; take one out")
            function(taken)
            taken.end()

    def units(self, w):
        """The units that a statement names, in a metre."""
        unit = w.text("one of " + " ".join(UNITS))
        if unit not in UNITS:
            raise w.fault(f'the unit must be one of {" ".join(UNITS)}, not "{unit[:40]}"')
        size = np.linalg.norm(self.high - self.low) / UNITS[unit]
        if not SCENE_SIZES[0] <= size <= SCENE_SIZES[1]:
            raise w.fault(f"in {unit} the scene would have a size of {size:.2g} m; units are those of its coordinates")
        return UNITS[unit]

    def near(self, w, position, what):
        """Raises Fault for a place that is far from the scene."""
        size = np.linalg.norm(self.high - self.low)
        if np.linalg.norm(np.maximum(self.low - position, position - self.high).clip(0)) > FAR * size:
            low, high = (" ".join(f"{v:.5g}" for v in at) for at in (self.low, self.high))
            raise w.fault(f"{what} is far from the scene, which reaches from {low} to {high}; is it in the units of the scene?")
        return position


class Reader(Statements):
    """Reads a design."""

    ONCE = {*Statements.ONCE, "dimming", "rows", "apart", "most"}

    def __init__(self, file, polygons):
        super().__init__(file, polygons)
        self.design = Design(file)

    def read(self):
        self.take_lines()
        self.check()
        return self.design

    def check(self):
        d = self.design
        for need, what in ((d.luminaires, "luminaire NAME FILE"), (d.candidates, "places: grid or place"), (d.common or d.scenes, "goals")):
            if not need:
                raise fault(d.file, None, f"there is no {what}")
        if len(d.candidates) > MOST_CANDIDATES:
            raise fault(d.file, None, f"{len(d.candidates)} candidates are more than {MOST_CANDIDATES}")
        for scene in d.all_scenes():
            if not scene.goals:
                raise fault(*scene.place, f"the scene {scene.name} has no goals")

    def read_units(self, w):
        if self.design.surfaces or self.design.candidates:
            raise w.fault("units must be above all surfaces and places")
        self.design.units = self.units(w)

    def read_maintenance(self, w):
        self.design.maintenance = w.number("the maintenance factor", 0.01, 1)

    def read_luminaire(self, w):
        name = w.file_name()
        try:
            photometry = read_luminaire(os.path.join(self.folder, w.text("a file .ies, .ldt, .gldf or .xml")))
        except Fault as text:
            raise w.fault(str(text)) from None
        found = w.options({"watts": (0.001, 1e6), "factor": (1e-6, 1e6)})
        watts, factor = found.get("watts", photometry.watts), found.get("factor", 1.0)
        warn_of_factor(factor, f"{w.place[0]}:{w.place[1]}: factor {factor:g}")
        if photometry.radiant:
            raise w.fault(f"{photometry.file} is radiant (W/sr); goals are of light")
        if any(name == l.name for l in self.design.luminaires):
            raise w.fault(f'there are two luminaires "{name}"')
        if not watts > 0:
            raise w.fault(f"{photometry.file} has no watts; write them behind the file: watts 36")
        self.design.luminaires.append(Luminaire(name, photometry, watts, factor))

    def luminaire(self, w):
        name = w.text("the name of a luminaire")
        for i, known in enumerate(self.design.luminaires):
            if known.name == word(name):
                return i
        raise w.fault(f'there is no luminaire "{name[:40]}" above this line')

    def orientation(self, w, options):
        """Reads aim, turn and the options; returns aims and turns, at least one of each."""
        aims, turns, found = [], [], {}
        while w.more():
            key = w.text("an option")
            if key == "aim":
                aims.append(w.unit("the aim"))
            elif key == "turn":
                turns.append(w.number("the turn", -360, 360))
            elif key in found:
                raise w.fault(f"{key} is given twice")
            elif key in options:
                found[key] = w.number(f"the {key}", *options[key])
                if key == "spacing":
                    found["across"] = w.number("the spacing", *options[key]) if w.more_number() else found[key]
            else:
                raise w.fault(f'"{key[:40]}" is none of aim, turn{"".join(", " + o for o in options)}')
        return aims or [np.array([0, 0, -1.0])], turns or [0.0], found

    def add(self, w, luminaire, position, aims, turns, row=None):
        self.near(w, position, "a luminaire")
        for aim in aims:
            for turn in turns:
                self.design.candidates.append(Candidate(luminaire, np.array(position), aim, turn, row))

    def read_place(self, w):
        luminaire = self.luminaire(w)
        position = w.vector("the place")
        aims, turns, _ = self.orientation(w, {})
        self.add(w, luminaire, position, aims, turns)

    def up(self, luminaire, row):
        """How far a luminaire reaches up from its middle (m), turned by a matrix with this last row."""
        photometry = self.design.luminaires[luminaire].photometry
        x, y, z = np.abs(row) * photometry.size / 2
        return z + (x + y if photometry.shape == "box" else np.hypot(x, y))

    def read_grid(self, w):
        luminaire = self.luminaire(w)
        name = w.text("the name of a polygon")
        polygons = polygons_named(self.polygons, name, w.place)
        aims, turns, found = self.orientation(w, {"spacing": (1e-6, 1e9), "margin": (0, 1e9), "drop": (-1e9, 1e9)})
        u = self.design.units
        spacing = np.array([found.get("spacing", 1.2 * u), found.get("across", found.get("spacing", 1.2 * u))])
        reach = max(self.up(luminaire, rotation(aim, turn)[2]) for aim in aims for turn in turns)
        drop = found.get("drop", (reach + 0.005) * u)
        grid = len({c.row[0] for c in self.design.candidates if c.row})
        before = len(self.design.candidates)
        for p in polygons:
            points, _, step = cells_of(p, spacing, found.get("margin", 0.0), w.place)
            for point in points:
                index = np.round(point / max(1e-9, min(x for x in np.ravel(step) if x > 0)) * 8).astype(int)
                self.add(w, luminaire, point - [0, 0, drop], aims, turns, (grid, index[1], index[0]))
        if len(self.design.candidates) == before:
            raise w.fault(f'no place fits on "{name}"; is the margin too wide?')

    def target(self, w):
        """The names of the sensor, eye or surfaces that a goal is about."""
        d, name = self.design, w.text("the name of a surface, sensor or eye")
        if name in d.sensors or name in d.eyes:
            return [name]
        names = names_matching(self.polygons, name)
        if not names:
            polygons_named(self.polygons, name, w.place)  # raises the fault with names that are similar
        return names

    def add_goal(self, w, kind, name, value):
        goals = self.design.scenes[-1].goals if self.design.scenes else self.design.common
        if any(g.kind == kind and g.target == name for g in goals):
            raise w.fault(f"a second goal of {kind} for {name}")
        goals.append(Goal(kind, name, value, w.place))

    def read_illuminance(self, w):
        names = self.target(w)
        value = w.number("the illuminance (lx)", 0, 1e7)
        options = {"uniformity": (0, 1), "most": (0, 1e7), "spacing": (1e-9, 1e9), "margin": (0, 1e9)}
        found = w.options(options, ["back"], ["spacing"])
        back = found.pop("back", False)
        if found.get("most", value) < value:
            raise w.fault("most is below the illuminance that is wanted")
        if "uniformity" in found and not value > 0:
            raise w.fault("a uniformity needs an illuminance above 0 lx: in the dark it has no value")
        for name in names:
            if name in self.design.eyes:
                raise w.fault(f"{name} is an eye; goals of eyes are cylindrical and ugr")
            if name in self.design.sensors:
                if "uniformity" in found:
                    raise w.fault("a sensor has no uniformity")
            else:
                self.surface(w, name, back, found)
            self.add_goal(w, "illuminance", name, value)
            for kind in ("uniformity", "most"):
                if kind in found:
                    self.add_goal(w, kind, name, found[kind])

    def surface(self, w, name, back, found):
        if name in self.design.surfaces and not (back or "spacing" in found or "margin" in found):
            return
        surface = surface_of(self.polygons, name, w.place, self.design.units, back, found.get("spacing"), found.get("margin", 0.0))
        if surface.polygons[0].modifier == "void":
            raise w.fault(f'the polygon "{name}" has no material')
        self.design.surfaces[name] = surface

    def named_place(self, w):
        name = w.text("a name")
        if name in self.design.sensors or name in self.design.eyes:
            raise w.fault(f'"{name}" is named twice')
        if any(name in (p.name, p.modifier) for p in self.polygons):
            raise w.fault(f'"{name[:40]}" is the name of a surface; goals could mean either')
        return name, self.near(w, w.vector("the place"), f'"{name[:40]}"')

    def read_sensor(self, w):
        name, position = self.named_place(w)
        self.design.sensors[name] = Sensor(name, position, w.unit("the direction that the sensor faces"))

    def read_eye(self, w):
        name, position = self.named_place(w)
        gaze = w.unit("the gaze") if w.more() else None
        if gaze is not None and np.hypot(*gaze[:2]) < 1e-6:
            raise w.fault("the gaze must not be vertical")
        self.design.eyes[name] = Eye(name, position, gaze)

    def eye(self, w):
        name = w.text("the name of an eye")
        if name not in self.design.eyes:
            raise w.fault(f'there is no eye "{name[:40]}" above this line')
        return self.design.eyes[name]

    def read_cylindrical(self, w):
        eye = self.eye(w)
        self.add_goal(w, "cylindrical", eye.name, w.number("the cylindrical illuminance (lx)", 0, 1e7))

    def read_ugr(self, w):
        eye = self.eye(w)
        if eye.gaze is None:
            raise w.fault(f'the eye "{eye.name}" needs a gaze: eye NAME x y z dx dy dz')
        self.add_goal(w, "ugr", eye.name, w.number("the limit of UGR", 5, 40))

    def read_scene(self, w):
        name = w.file_name()
        if any(name == s.name for s in self.design.scenes):
            raise w.fault(f'there are two scenes "{name}"')
        if len(self.design.scenes) == MOST_SCENES:
            raise w.fault(f"there are more than {MOST_SCENES} scenes")
        self.design.scenes.append(Scene(name, place=w.place))

    def read_daylight(self, w):
        if not self.design.scenes:
            raise w.fault("daylight belongs to a scene; write scene NAME above")
        while w.more():
            file = os.path.join(self.folder, w.text("scene files of the sky"))
            if not os.path.isfile(file):
                raise w.fault(f'there is no file "{file}"')
            self.design.scenes[-1].daylight.append(file)
        if not self.design.scenes[-1].daylight:
            raise w.fault("daylight needs the scene files of the sky")

    def read_dimming(self, w):
        value = w.text("yes or no")
        if value not in ("yes", "no"):
            raise w.fault(f'dimming must be yes or no, not "{value[:40]}"')
        self.design.dimming = value == "yes"

    def read_rows(self, w):
        self.design.rows = True
        if w.more():
            word_here = w.text("uneven")
            if word_here != "uneven":
                raise w.fault(f'rows are even, or "uneven", not "{word_here[:40]}"')
            self.design.even = False

    def read_apart(self, w):
        self.design.apart = w.number("the least distance between luminaires", 0, 1e9)

    def read_mirror(self, w):
        axis = w.text("x or y")
        if axis not in ("x", "y"):
            raise w.fault(f'mirror needs x or y, not "{axis[:40]}"')
        self.design.mirrors.append(("xy".index(axis), w.number("the coordinate of the axis")))

    def read_most(self, w):
        self.design.most = whole(w.text("a number of luminaires"), *w.place, "the number of luminaires", 1, 1e6)


def read_design(file, polygons):
    """The Design of a file, for a room of these polygons. Raises Fault with its line."""
    return Reader(file, polygons).read()
