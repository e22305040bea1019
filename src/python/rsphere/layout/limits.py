"""What EN 12464-1 asks for, by activity: the values of tables that manufacturers publish. The standard itself is not free.

Rows: number; name; maintained illuminance (lx), U_o, limit of UGR; mean cylindrical illuminance, illuminance of walls and of the
ceiling (lx), each with U_o of .10. Of the edition of 2011, the last three follow from its clauses on these surfaces and spaces,
as they are cited there: 50 50 30, or 150 75 50 where people work with each other, in offices, schools and health care.
"""
from dataclasses import dataclass, replace

EDITIONS = {"2021": """
34.1; Filing, copying; 300 .4 19; 100 100 75
34.2; Writing, typing, reading, data processing; 500 .6 19; 150 150 100
34.3; Technical drawing; 750 .7 16; 150 150 100
34.4; CAD work stations; 500 .6 19; 150 150 100
34.5; Conference and meeting rooms; 500 .6 19; 150 150 100
34.6; Reception desk; 300 .6 22; 100 100 75
34.7; Archiving; 200 .4 25; 75 75 50
44.1; Classroom, general activities; 500 .6 19; 150 150 100
""", "2011": """
5.1.1; Circulation areas and corridors; 100 .4 28; 50 75 50
5.1.2; Stairs, escalators, travolators; 100 .4 25; 50 75 50
5.1.3; Elevators, lifts; 100 .4 25; 50 50 30
5.1.4; Loading ramps and bays; 150 .4 25; 50 50 30
5.2.1; Canteens, pantries; 200 .4 22; 50 50 30
5.2.2; Rest rooms; 100 .4 22; 50 50 30
5.2.3; Rooms for physical exercise; 300 .4 22; 50 50 30
5.2.4; Cloakrooms, washrooms, bathrooms, toilets; 200 .4 25; 50 50 30
5.2.5; Sick bay; 500 .6 19; 50 75 50
5.2.6; Rooms for medical attention; 500 .6 16; 50 75 50
5.3.1; Plant rooms, switch gear rooms; 200 .4 25; 50 50 30
5.4.1; Store and stockrooms; 100 .4 25; 50 50 30
5.4.2; Dispatch packing handling areas; 300 .6 25; 50 50 30
5.26.1; Filing, copying; 300 .4 19; 150 75 50
5.26.2; Writing, typing, reading, data processing; 500 .6 19; 150 75 50
5.26.3; Technical drawing; 750 .7 16; 150 75 50
5.26.4; CAD work stations; 500 .6 19; 150 75 50
5.26.5; Conference and meeting rooms; 500 .6 19; 150 75 50
5.26.6; Reception desk; 300 .6 22; 150 75 50
5.26.7; Archives; 200 .4 25; 50 75 50
5.27.1; Sales area; 300 .4 22; 50 50 30
5.27.2; Till area; 500 .6 19; 50 50 30
5.28.1; Entrance halls; 100 .4 22; 50 75 50
5.28.3; Lounges; 200 .4 22; 50 50 30
5.29.1; Reception and cashier desk, porters desk; 300 .6 22; 50 50 30
5.29.2; Kitchen; 500 .6 22; 50 50 30
5.33.1; Library: bookshelves; 200 .4 19; 50 50 30
5.33.2; Library: reading area; 500 .6 19; 50 50 30
5.36.1; Classrooms, tutorial rooms; 300 .6 19; 150 75 50
5.36.2; Classrooms for evening classes and adults education; 500 .6 19; 150 75 50
5.36.3; Auditorium, lecture halls; 500 .6 19; 150 75 50
5.36.4; Black, green and white boards; 500 .7 19; 150 75 50
5.36.5; Demonstration table; 500 .7 19; 150 75 50
5.36.24; Sports halls, gymnasiums, swimming pools; 300 .6 22; 50 75 50
5.37.1; Waiting rooms of health care; 200 .4 22; 50 75 50
5.38.1; Staff office of health care; 500 .6 19; 150 75 50
5.39.1; Wards, general lighting; 100 .4 19; 50 75 50
5.40.1; Examination rooms, general lighting; 500 .6 19; 50 75 50
"""}
SURROUNDING = ((750, 500), (500, 300), (300, 200), (200, 150))  # lx on the task at least, and around it; else as on the task
SURROUNDING_UNIFORMITY, SPATIAL_UNIFORMITY = 0.4, 0.1
BACKGROUND_SHARE = 1 / 3  # of what the surrounding area needs
SURROUNDING_WIDTH, BACKGROUND_WIDTH = 0.5, 3.0  # m
MODELLING = 0.3, 0.6  # cylindrical over horizontal illuminance, where light comes from above in even rows


@dataclass(frozen=True)
class Activity:
    number: str
    name: str
    edition: str
    illuminance: float
    uniformity: float
    ugr: float
    cylindrical: float
    walls: float
    ceiling: float

    def title(self):
        return f"{self.number} {self.name} ({self.edition})"

    def surrounding(self):
        return next((around for least, around in SURROUNDING if self.illuminance >= least), self.illuminance)

    def background(self):
        return self.surrounding() * BACKGROUND_SHARE

    def changed(self, limits):
        """With other limits, by name."""
        edition = self.edition if not limits else f"{self.edition}, changed: {', '.join(limits)}"
        return replace(self, edition=edition, **limits)


ACTIVITIES = {}
for _edition, _rows in EDITIONS.items():
    for _row in _rows.strip().split("\n"):
        _number, _name, _task, _room = _row.split("; ")
        ACTIVITIES[_number] = Activity(_number, _name, f"EN 12464-1:{_edition}", *(float(v) for v in f"{_task} {_room}".split()))


def activities_named(words):
    """The activities of a number, of a whole name, or else of those with a part of it, in the latest edition that has any."""
    if words in ACTIVITIES:
        return [ACTIVITIES[words]]
    part = words.casefold()
    named = [a for a in ACTIVITIES.values() if part in a.name.casefold()]
    named = [a for a in named if a.name.casefold() == part] or named
    return [a for a in named if a.edition == named[0].edition]
