"""Reads what a report is about: the tasks in a room with its luminaires, its walls, its ceiling, and where eyes are."""
from dataclasses import dataclass, field

import numpy as np

from ..fault import fault
from .design import Eye, Statements
from .limits import SURROUNDING_WIDTH, activities_named
from .room import Polygon, names_matching, polygons_named, surface_of, upward

LIMITS = {"illuminance": (0, 1e6), "uniformity": (0, 1), "ugr": (5, 40), "cylindrical": (0, 1e6), "walls": (0, 1e6), "ceiling": (0, 1e6)}


@dataclass
class Task:
    surface: object  # of room.Surface
    activity: object
    around: float  # width of the surrounding area, units of the scene


@dataclass
class Lamps:
    """Luminaires by the modifiers of their light."""

    pattern: str
    watts: float  # of all of them together, at full light; 0 if that is not known
    factor: float  # their light is dimmed to
    place: tuple


@dataclass
class Tasks:
    file: str
    units: float = 1.0
    maintenance: float = 1.0
    lamps: list = field(default_factory=list)
    tasks: list = field(default_factory=list)
    walls: list = field(default_factory=list)  # of room.Surface
    ceiling: list = field(default_factory=list)
    floor: list = field(default_factory=list)  # polygons
    eyes: list = field(default_factory=list)  # of design.Eye
    height: float = 1.2  # m: of the grid of eyes above the floor
    spacing: float = None  # of the grid, units of the scene
    place: tuple = None  # file and line of the grid


class TaskReader(Statements):
    ONCE = {*Statements.ONCE, "eyes"}

    def __init__(self, file, polygons):
        super().__init__(file, polygons)
        self.found = Tasks(file)

    def read(self):
        self.take_lines()
        if not self.found.tasks:
            raise fault(self.file, None, "there is no task SURFACE ACTIVITY")
        if not self.found.floor:
            up = upward(self.polygons)
            if not up:
                raise fault(self.file, None, "no polygon faces up; name the floor: floor NAME")
            self.found.floor = [max(up, key=lambda p: p.vector()[2])]
        return self.found

    def read_units(self, w):
        if self.found.tasks or self.found.walls or self.found.ceiling:
            raise w.fault("units must be above all surfaces")
        self.found.units = self.units(w)

    def read_maintenance(self, w):
        self.found.maintenance = w.number("the maintenance factor", 0.01, 1)

    def read_luminaire(self, w):
        pattern, found = w.text("the modifier of the light, or a pattern"), w.options({"watts": (0, 1e9), "factor": (0, 1)})
        self.found.lamps.append(Lamps(pattern, found.get("watts", 0.0), found.get("factor", 1.0), w.place))

    def names(self, w):
        name = w.text("the name of a surface")
        names = names_matching(self.polygons, name)
        return names or polygons_named(self.polygons, name, w.place)  # which raises the fault with names that are similar

    def read_task(self, w):
        options = {"height": (-1e9, 1e9), "margin": (0, 1e9), "spacing": (1e-9, 1e9), "surrounding": (0, 1e9), **LIMITS}
        names, activity = self.names(w), self.activity(w, {"back", *options})
        found = w.options(options, ["back"])
        back = found.pop("back", False)
        activity = activity.changed({key: value for key, value in found.items() if key in LIMITS})
        around = found.get("surrounding", SURROUNDING_WIDTH * self.found.units)
        for name in names:
            raised = [Polygon(name, p.modifier, p.corners + found.get("height", 0.0) * (-1 if back else 1) * p.vector() / np.linalg.norm(p.vector()))
                      for p in polygons_named(self.polygons, name, w.place)]
            if any(name == t.surface.name for t in self.found.tasks):
                raise w.fault(f"a second task on {name}")
            self.near(w, raised[0].corners.mean(axis=0), f'the task on "{name[:40]}"')
            surface = surface_of(raised, name, w.place, self.found.units, back, found.get("spacing"), found.get("margin", 0.0))
            self.found.tasks.append(Task(surface, activity, around))

    def activity(self, w, options):
        """The activity of a number, or of the words before the next option."""
        words = w.text("the number or the name of an activity")
        while not words[0].isdigit() and w.more() and not w.more_number() and w.words[w.next] not in options:
            words += " " + w.text("an option")
        activities = activities_named(words)
        if not activities:
            raise w.fault(f'there is no activity "{words[:40]}"; rsphere-layout --activities lists them')
        if len(activities) > 1:
            raise w.fault(f'"{words}" is part of {" and of ".join(f"{a.number} ({a.name})" for a in activities[:4])}: give the number')
        return activities[0]

    def facing_room(self, w):
        """A surface for each polygon of a statement, its side that faces the middle of the scene."""
        middle, found = (self.low + self.high) / 2, []
        while w.more() or not found:
            for p in (p for name in self.names(w) for p in polygons_named(self.polygons, name, w.place)):
                back = (middle - p.corners.mean(axis=0)) @ p.vector() < 0
                found.append(surface_of([p], p.name, w.place, self.found.units, back))
        return found

    def read_walls(self, w):
        self.found.walls += self.facing_room(w)

    def read_ceiling(self, w):
        self.found.ceiling += self.facing_room(w)

    def read_floor(self, w):
        for name in self.names(w):
            self.found.floor += upward(polygons_named(self.polygons, name, w.place))
        if not self.found.floor:
            raise w.fault("the floor does not face up")

    def read_eye(self, w):
        name = w.text("a name")
        self.found.eyes.append(Eye(name, self.near(w, w.vector("the place"), f'"{name[:40]}"')))

    def read_eyes(self, w):
        found = w.options(dict.fromkeys(("height", "spacing"), (1e-9, 1e9)))
        if found.get("height", 0) > self.high[2] - self.low[2]:
            raise w.fault(f"eyes at {found['height']:g} are above the scene, whose height is {self.high[2] - self.low[2]:.5g}; is it in the units of the scene?")
        self.found.place = w.place
        self.found.height = found["height"] / self.found.units if "height" in found else self.found.height
        self.found.spacing = found.get("spacing", self.found.spacing)


def read_tasks(file, polygons):
    """The Tasks of a file, for a room of these polygons. Raises Fault with its line."""
    return TaskReader(file, polygons).read()
