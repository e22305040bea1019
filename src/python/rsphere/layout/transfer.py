"""What each candidate gives to each receiver, by importance: the matrix of the search.

A receiver is a surface, a point on one, a sensor, or an eye (cylindrical, or vertical across its gaze). Its
illuminance is linear in the light of the luminaires:

    E = (1 / A) integral of I(d) W(d) over all directions d

where W is the importance that arrives at the luminaire when the goal, of area A, emits. rsphere gives W as means over
zones of directions. Within a zone I is averaged, which is right for light that has been reflected diffusely, because W
then varies slowly. Light that goes straight to the receiver does not: it is left out of W (-dv-), and computed by
shadow rays from points of the receiver to points of the luminaire, through panes as well. Light by mirrors alone is added:
what W has without -dv-, in zones from which nothing goes straight to the receiver.

As in the check, surfaces and sensors (-I) have lamps in flat mirrors alone, and not in polished metal, panes or balls (-Sgc-),
nor have the surfaces around them. Eyes (points of sphere mode) see lamps in all of these.
"""
from dataclasses import dataclass

import numpy as np

from ..fault import write_text
from ..progress import PROGRESS
from .room import LIFT, goal_text, mirrors_among
from .surface_parts import GOLDEN as GOLDEN_STEP
from .surface_parts import PART, surface_parts
from .zones import Zones

PROBE = 0.05  # m, the radius of the disks and cylinders that emit importance for sensors and eyes
SIDES = 8  # of the prism
APART = 0.3  # m: the least distance of disks and cylinders that are in the scene at once
GOLDEN = (GOLDEN_STEP, 0.7548776662)  # steps of points along the shorter sides, modulo 1
SPARK = 1e-4  # m, the radius of the lamps that shadow rays go to
MOST_PARTS = 12  # of a candidate
MOST_PARTS_BUILT = 96  # of a luminaire of the layout: the edges of its shadows show as steps of this share
MOST_PLACES_BUILT = 6  # of a luminaire of the layout, at which the importance of its goals is asked for
ALL_PLACES_BUILT = 120  # of all luminaires of the layout; each has at least one
MOST_SENSORS = 400  # of all cells; if four in each are more, there is one in the middle of each
LEAST_DIRECTIONS = 64
MOST_SHADOWS = 4_000_000  # shadow rays of one call
MOST_VALUES = 4_000_000  # of importance in one call
SETS = 4  # of directions, from whose spread standard errors follow
IMAGES = {"mirror", "prism1", "prism2"}  # materials that shadow rays find lamps in
CHEAP = dict(ds=0, dj=0)  # for the difference of two runs, in which direct light cancels: an eighth of the time
LEAST_OF_PLANES, LEAST_OF_SQUARES = 6, 12  # cells that a polynomial of degree one and two needs, twice its terms
WEIGHTS = np.array([0.265, 0.670, 0.065])  # of red, green and blue in brightness


@dataclass
class Receiver:
    """surface: the goal whose reflected light it has a share of, by the number of its column of importance."""

    name: str
    kind: str  # plane, cylinder or eye (vertical, across the gaze)
    points: np.ndarray  # (n, 3)
    normals: np.ndarray  # (n, 3)
    surface: int
    cell_of: np.ndarray = None  # (n,), the number of the cell of each point of a surface

    def cell_means(self, values):
        """Means over the cells of a surface of values at points (n, ...); of a single point, what it has."""
        if self.cell_of is None:
            return values
        cells, which, counts = np.unique(self.cell_of, return_inverse=True, return_counts=True)
        sums = np.zeros((len(cells), *values.shape[1:]))
        np.add.at(sums, which.ravel(), values)
        return sums / counts.reshape(-1, *[1] * (values.ndim - 1))


@dataclass
class Group:
    """Goals that emit importance in one scene, each into a column of importance."""

    scene: object
    goals: object  # names of modifiers, or an array of sensors
    areas: np.ndarray
    columns: np.ndarray
    points: list  # of each goal, spread over it; None if light by mirrors is not looked for
    caustics: bool  # whether this is also light by polished metal and balls


@dataclass
class Matrix:
    """Rows are receivers, columns candidates; lx for the luminaires at full power."""

    direct: np.ndarray
    sets: np.ndarray  # what comes on other ways, by each set of directions: (SETS, receivers, candidates)
    cells: dict  # the same for each cell of receivers that are to be even: (SETS, cells, candidates)

    def total(self):
        return self.direct + self.sets.mean(axis=0)

    def error(self):
        """The standard error, from the spread of the sets."""
        return self.sets.std(axis=0, ddof=1) / np.sqrt(len(self.sets))


def probe_text(modifier, receiver, units):
    """Scene text of a black disk, or of a cylinder, that emits importance for a sensor or an eye, and its area."""
    r = PROBE * units
    p, n = receiver.points[0], receiver.normals[0]
    text = f"void plastic {modifier} 0 0 5 0 0 0 0 0\n"
    if receiver.kind == "cylinder":
        return text + prism_text(modifier, p, r), SIDES * 2 * r * 2 * r * np.sin(np.pi / SIDES)
    shown = " ".join(f"{v:.9g}" for v in (*(p + n * LIFT * units), *n, 0, r))
    return text + f"{modifier} ring {modifier}.1 0 0 8 {shown}\n", np.pi * r * r


def prism_text(modifier, middle, r):
    """The sides of a prism that stands for a cylinder of radius r and height 2 r, as polygons that face outwards."""
    text, angles = "", 2 * np.pi * np.arange(SIDES + 1) / SIDES
    for i, (a, b) in enumerate(zip(angles, angles[1:])):
        corners = [middle + r * np.array([np.cos(t), np.sin(t), h]) for t, h in ((a, -1), (b, -1), (b, 1), (a, 1))]
        text += f"{modifier} polygon {modifier}.{i + 1} 0 0 12 " + " ".join(f"{v:.9g}" for v in np.ravel(corners)) + "\n"
    return text


def inner_points(photometry, most):
    """Points (n, 3) spread over the box around the luminous surfaces (m); a single one if it is small."""
    size = np.array([*photometry.size[:2], photometry.size[2] if all(photometry.shines()) else 0])
    count = int(min(np.prod(np.maximum(np.ceil(size / PART), 1)), most))
    step = np.zeros(3)
    step[np.argsort(-size, kind="stable")] = [1 / count, *GOLDEN]
    return (((np.arange(count) - (count - 1) / 2)[:, None] * step + 0.5) % 1 - 0.5) * size


def parts_of(photometry, most, as_built):
    """Points (n, 3) from which the light of a luminaire leaves (m), and a function from unit directions (..., n, 3) to shares.

    as_built: on its surfaces, since its body hides all else; as a luminaire that hides nothing, in the box around them.
    """
    if as_built or photometry.shines()[0] != photometry.shines()[1]:
        parts = surface_parts(photometry, most)
        return parts.points, parts.shares
    points = inner_points(photometry, most)
    return points, lambda directions: np.full(directions.shape[:-1], 1 / len(points))


def smoothed(sets, places):
    """Reflected light of cells (SETS, cells, candidates) with less noise: it varies slowly over a surface, as a polynomial of two coordinates.

    What differs from this is kept as far as it is more than noise, by the spread of the sets, and all candidates are treated alike.
    places: of the cells (cells, 3).
    """
    if len(places) < LEAST_OF_PLANES:
        return sets
    middle = places.mean(axis=0)
    u, v = np.linalg.svd(places - middle, full_matrices=False)[2][:2] @ (places - middle).T
    columns = [np.ones(len(places)), u, v]
    columns += [u * u, u * v, v * v] if len(places) >= LEAST_OF_SQUARES else []
    left, singular, _ = np.linalg.svd(np.stack(columns, axis=1) / np.linalg.norm(columns, axis=1).clip(1e-300), full_matrices=False)
    left = left[:, singular > 1e-6]  # cells in a line
    even = left @ np.einsum("ck,scj->skj", left, sets).transpose(1, 0, 2).reshape(left.shape[1], -1)
    even = even.reshape(len(places), len(sets), -1).transpose(1, 0, 2)
    all_on = sets.sum(axis=2)
    rest = ((all_on - even.sum(axis=2)).mean(axis=0) ** 2).sum()
    noise = (all_on.var(axis=0, ddof=1) / len(sets)).sum() * (1 - left.shape[1] / len(places))
    return even + max(0.0, 1 - noise / rest) * (sets - even) if rest > 0 else sets


def sees(directions, receiver_kind, normals):
    """The cosine, or for cylinders what takes its place, by which light from unit directions (..., 3) is weighted."""
    if receiver_kind == "cylinder":
        return np.hypot(directions[..., 0], directions[..., 1]) / np.pi
    return np.maximum((directions * normals).sum(axis=-1), 0)


class Transfer:
    """Computes matrices for a design. The scene may have luminaires already: bodies, which are dark.

    fine: with the reflected light of each cell of surfaces that are to be even, and MOST_PARTS_BUILT for shadows. Otherwise,
    matrix() leaves out points of the design's surfaces that lie inside of furniture or under it.
    """

    def __init__(self, rsphere, files, design, folder, bounces, fine=False):
        self.rsphere, self.files, self.design, self.folder, self.bounces = rsphere, list(files), design, folder, bounces
        self.fine, self.most_parts = fine, MOST_PARTS_BUILT if fine else MOST_PARTS
        self.receivers, self.groups = [], []
        self.index, self.cells = {}, {}
        kinds = mirrors_among(files)
        self.images, self.mirrors = bool(kinds & IMAGES), bool(kinds)
        for i, surface in enumerate(design.surfaces.values()):
            self.add(Receiver(surface.name, "plane", surface.points, surface.normals, i, surface.cell_of))
        self.probe_groups = self.probes()
        for receiver in (r for group in self.probe_groups for r in group):
            self.add(receiver)

    def add(self, receiver):
        self.index[receiver.name, receiver.kind] = len(self.receivers)
        self.receivers.append(receiver)

    def add_surfaces(self):
        """Surfaces emit importance, all in one scene."""
        text, areas = "", []
        for i, surface in enumerate(self.design.surfaces.values()):
            text += goal_text(surface, f"layout_goal{i}", self.design.units)
            areas.append(surface.area())
        if areas:
            names = [f"layout_goal{i}" for i in range(len(areas))]
            points = [s.fine_points() for s in self.design.surfaces.values()] if self.images else None
            self.groups.append(Group(self.scene_with(text, "goals"), names, np.array(areas), np.arange(len(areas)), points, False))

    def goal_count(self):
        return sum(len(g.areas) for g in self.groups)

    def probes(self):
        """Receivers of sensors and eyes, in groups of which the members hide little of each other: sensors apart from eyes."""
        receivers = [Receiver(s.name, "plane", s.position[None], s.normal[None], 0) for s in self.design.sensors.values()]
        for e in self.design.eyes.values():
            receivers.append(Receiver(e.name, "cylinder", e.position[None], np.array([[0, 0, 1.0]]), 0))
            if e.gaze is not None:
                receivers.append(Receiver(e.name, "eye", e.position[None], e.gaze[None], 0))
        groups = []
        for r in receivers:
            apart = [all(np.linalg.norm(r.points - o.points) > APART * self.design.units and (r.kind == "plane") == (o.kind == "plane") for o in group)
                     for group in groups]
            if True not in apart:
                groups.append([])
                apart.append(True)
            groups[apart.index(True)].append(r)
        return groups

    def add_probes(self):
        for group in self.probe_groups:
            text, areas, names = "", [], []
            first = self.goal_count()
            for receiver in group:
                receiver.surface = first + len(areas)
                name = f"layout_probe{receiver.surface}"
                part, area = probe_text(name, receiver, self.design.units)
                text += part
                names.append(name)
                areas.append(area)
            if group:
                eyes = group[0].kind != "plane"
                points = [r.points for r in group] if (self.mirrors if eyes else self.images) else None
                self.groups.append(Group(self.scene_with(text, f"goals{len(self.groups)}"), names, np.array(areas), first + np.arange(len(areas)), points, eyes))

    def add_cells(self):
        """Sensors on surfaces that are to be even: their points, or the middles of those of each cell."""
        even = {g.target for scene in self.design.all_scenes() for g in scene.goals if g.kind == "uniformity"}
        many = sum(len(s.points) for name, s in self.design.surfaces.items() if name in even) > MOST_SENSORS
        sensors, first = [], self.goal_count()
        for i, (name, surface) in enumerate(self.design.surfaces.items()):
            if name in even:
                begin, receiver = first + len(sensors), self.receivers[i]
                at = np.hstack([surface.points, surface.normals])
                sensors += list(receiver.cell_means(at) if many else at)
                self.cells[i] = np.arange(begin, first + len(sensors)), (lambda v: v) if many else receiver.cell_means
        if sensors:
            points = [s[None, :3] for s in sensors] if self.images else None
            self.groups.append(Group(self.rsphere.Scene(self.files), np.array(sensors), np.ones(len(sensors)), first + np.arange(len(sensors)), points, False))

    def scene_with(self, text, name):
        return self.rsphere.Scene([*self.files, write_text(f"{self.folder}/{name}.rad", text, errors="surrogateescape")])

    def zone_intensities(self, candidates, zones, most):
        """For each candidate the mean intensities (places, zones) in each zone (cd) of its light at places(), at full power."""
        samples, found = zones.samples(), {}
        for c in candidates:
            key = (c.luminaire, tuple(c.aim), c.turn)
            if key not in found:
                points, shares = self.parts(c, most)
                directions = np.broadcast_to(samples[:, :, None], (*samples.shape[:2], len(points), 3))
                found[key] = np.einsum("zs,zsp->pz", self.light(c, samples), shares(directions)) / samples.shape[1]
        return [found[c.luminaire, tuple(c.aim), c.turn] for c in candidates]

    def light(self, candidate, directions):
        """The intensity (cd) of a candidate in directions of the room, maintenance and tilt included."""
        luminaire = self.design.luminaires[candidate.luminaire]
        angle = np.degrees(np.arccos(np.clip(-candidate.aim[2], -1, 1)))
        factor = luminaire.factor * self.design.maintenance * luminaire.photometry.tilt_factor(angle)
        return luminaire.photometry.intensity(directions @ candidate.matrix()) * factor

    def matrix(self, candidates, directions, zone_count=500):
        """The Matrix of candidates. directions: of importance at each place (-Sn), in SETS sets. Points are those of the first call."""
        zones = Zones(self.rsphere.zone_middles(zone_count))
        self.prepare(candidates)
        self.importance = self.sets(candidates, zones, directions // SETS, self.groups)
        return Matrix(self.points.means(), self.importance[:, [r.surface for r in self.receivers]], {i: self.at_cells(i) for i in self.cells})

    def at_cells(self, i):
        """What is reflected to each cell of a receiver, as Matrix has it."""
        there, means = self.cells[i]
        return smoothed(np.array([means(values[there]) for values in self.importance]), self.receivers[i].cell_means(self.receivers[i].points))

    def with_more_directions(self, candidates, directions, more, receivers, zone_count=500):
        """What is reflected to each cell of some receivers after matrix(), with further directions for these cells alone."""
        there, group = np.concatenate([self.cells[i][0] for i in receivers]), self.groups[-1]
        here = there - group.columns[0]
        some = Group(group.scene, group.goals[here], group.areas[here], there, group.points and [group.points[i] for i in here], group.caustics)
        sets = self.sets(candidates, Zones(self.rsphere.zone_middles(zone_count)), more // SETS, [some], SETS)
        self.importance[:, there] += more / (directions + more) * (sets - self.importance)[:, there]
        return {i: self.at_cells(i) for i in receivers}

    def prepare(self, candidates):
        """Light straight from candidates, and before the first ones the points and the scenes of goals."""
        self.points = Direct(self, candidates)
        if self.groups:
            return
        if not self.fine:
            self.leave_out_covered(candidates)
        self.add_surfaces()
        self.add_probes()
        if self.fine:
            self.add_cells()

    def leave_out_covered(self, candidates):
        """Leaves out the points of surfaces that no candidate lights and something covers that is nearer than all candidates."""
        room, hang = self.rsphere.Scene(self.files), np.array([c.position for c in candidates])
        for i, surface in enumerate(self.design.surfaces.values()):
            covered = self.points.exact[i].max(axis=1) <= 0
            if not covered.any():
                continue
            at, normals = surface.points[covered], surface.normals[covered]
            away = ((hang[None] - at[:, None]) * normals[:, None]).sum(axis=-1)
            least = np.where(away > 0, away, np.inf).min(axis=1)
            covered[covered] = room.trace(np.hstack([at, normals]), outputs="L").first_length < least - LIFT * self.design.units
            if covered.any() and not covered.all():
                surface.leave_out(covered)
                r = self.receivers[i]
                r.points, r.normals, r.cell_of = surface.points, surface.normals, surface.cell_of
                self.points.exact[i] = self.points.exact[i][~covered]

    @staticmethod
    def beside(goal_points, places, zones):
        """By goal and place, the zones that hold no direction straight to the goal."""
        found = np.ones((len(goal_points), len(places), zones.count), dtype=bool)
        for i, points in enumerate(goal_points):
            for j, place in enumerate(places):
                to = points - place
                found[i, j, zones.at(to / np.linalg.norm(to, axis=1)[:, None])] = False
        return found

    def parts(self, candidate, most=None):
        """Points of a candidate in the room, and their shares of its light by direction in the room.

        most: where the importance that meets a candidate is asked for; None: where shadow rays go to.
        """
        photometry, matrix = self.design.luminaires[candidate.luminaire].photometry, candidate.matrix()
        if most is not None and not self.fine:
            return candidate.position[None], lambda directions: np.ones(directions.shape[:-1])
        points, shares = parts_of(photometry, most or self.most_parts, self.fine)
        return candidate.position + points * self.design.units @ matrix.T, lambda directions: shares(directions @ matrix)

    def sets(self, candidates, zones, directions, groups, rotation=0):
        """What the goals of some groups get by their importance: (SETS, all goals, candidates). rotation: of the first set."""
        most = min(max(ALL_PLACES_BUILT // len(candidates), 1), MOST_PLACES_BUILT)
        mean = self.zone_intensities(candidates, zones, most)
        spread = [self.parts(c, most)[0] for c in candidates]
        directions = max(directions // max(map(len, spread)), LEAST_DIRECTIONS)
        places, which = np.unique(np.round(np.concatenate(spread), 9), axis=0, return_inverse=True)
        which, light = which.ravel(), np.concatenate(mean)
        whose = np.repeat(np.arange(len(candidates)), [len(p) for p in spread])
        area = zones.solid_angle * self.design.units**2  # importance has no unit of length, areas have
        values = np.zeros((SETS, self.goal_count(), len(candidates)))
        steps = [max(1, MOST_VALUES // (len(group.areas) * zones.count)) for group in groups]
        PROGRESS.begin(f"Importance at {len(places)} places", SETS * sum(-(-len(places) // step) for step in steps))
        for group, step in zip(groups, steps):
            beside = self.beside(group.points, places, zones) if group.points else None
            for begin in range(0, len(places), step):
                here = np.flatnonzero((which >= begin) & (which < begin + step))  # parts
                for k in range(SETS):
                    # -dv-: goals are black to rays that meet them without a reflection by a diffuse surface.
                    def bins(bounces, dv, caustics=False, group=group, at=places[begin : begin + step], k=k, **options):
                        a = group.scene.importance(at, goals=group.goals, bins=zones.count, outputs="z", rotation=rotation + k,
                                                   ambient_bounces=bounces, directions=directions, dv=dv, Sgc=caustics, **options)
                        return a.bins.reshape(-1, len(group.areas), zones.count, 3) @ WEIGHTS / group.areas[:, None]

                    reflected = bins(self.bounces, False)
                    if group.points:
                        mirrored = bins(0, True, group.caustics, **CHEAP) - bins(0, False, group.caustics, **CHEAP)
                    for part in here:
                        at = which[part] - begin
                        w = reflected[at]
                        if group.points:
                            w = w + mirrored[at] * beside[:, begin + at]
                        values[k, group.columns, whose[part]] += w @ light[part] * area
                    PROGRESS.advance()
        PROGRESS.clear()
        return values


class Direct:
    """Light that goes straight from candidates to points of receivers, by shadow rays (panes let it pass)."""

    def __init__(self, transfer, candidates):
        self.t, self.candidates = transfer, candidates
        self.exact = [None] * len(transfer.receivers)  # (points, candidates)
        self.compute()

    def means(self):
        return np.array([e.mean(axis=0) for e in self.exact])

    def lamps(self):
        """The points that shadow rays go to, each once: (n, 3), and for each candidate those of its parts."""
        points, number, of = [], {}, []
        for c in self.candidates:
            mine = []
            for p in self.t.parts(c)[0]:
                key = tuple(np.round(p, 9))
                if key not in number:
                    number[key] = len(points)
                    points.append(p)
                mine.append(number[key])
            of.append(mine)
        return np.array(points), of

    def compute(self):
        """Shadow rays from all points of all receivers to all points of luminaires; an eye looks four ways and up."""
        self.lamp_points, self.of = self.lamps()
        lamps = self.lamp_points
        around = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1]], dtype=float)
        rays, ends = [], []
        for r in self.t.receivers:
            normals = r.normals if r.kind == "plane" else around
            rays += [[*p, *n] for p, n in zip(r.points if r.kind == "plane" else np.broadcast_to(r.points, (len(normals), 3)), normals)]
            ends.append(len(rays))
        rays, step = np.array(rays), max(1, MOST_SHADOWS // len(rays))
        seen = np.hstack([self.visibility(rays, lamps[i : i + step]) for i in range(0, len(lamps), step)])
        self.seen = np.split(seen, ends[:-1])
        for i, r in enumerate(self.t.receivers):
            if r.kind != "plane":
                self.seen[i] = self.seen[i].max(axis=0)[None]
            self.fill(i, r, lamps, self.of, self.seen[i])

    def parts_seen(self, i):
        """For each candidate its points on surfaces that face the single point of a receiver, and the shares of light that pass."""
        found = []
        for c, mine in zip(self.candidates, self.of):
            points, shares = self.lamp_points[mine], self.t.parts(c)[1]
            away = self.t.receivers[i].points - points
            faces = shares(away / np.linalg.norm(away, axis=1)[:, None]) > 0
            found.append((points[faces], self.seen[i][0, mine][faces]))
        return found

    def visibility(self, rays, lamps):
        t, radius = self.t, SPARK * self.t.design.units
        radiance = 1 / (179 * np.pi * radius**2)  # 1 cd
        text, names = "", [f"layout_spark{i}" for i in range(len(lamps))]
        for name, p in zip(names, lamps):
            at = " ".join(f"{v:.12g}" for v in p)
            text += f"void light {name} 0 0 3 {radiance:.9g} {radiance:.9g} {radiance:.9g}\n{name} sphere {name}.1 0 0 4 {at} {radius:.9g}\n"
        scene = t.scene_with(text, "sparks")
        answer = scene.contributions(rays, of=names, samples=1, irradiance_at_origin=True, ambient_bounces=0,
                                     dr=0, dt=0, dj=0, ds=0, lr=0, lw=0)
        lux = t.rsphere.photometric(answer.value).reshape(len(rays), len(lamps))
        to = lamps[None] - rays[:, None, :3]
        square = (to**2).sum(axis=-1)
        cosine = (to * rays[:, None, 3:]).sum(axis=-1) / np.sqrt(square)
        with np.errstate(divide="ignore", invalid="ignore"):
            seen = np.where(cosine > 1e-4, lux * square / cosine, 0)
        return np.clip(np.nan_to_num(seen), 0, 1)

    def fill(self, i, receiver, lamps, of, seen):
        points = len(receiver.points)
        self.exact[i] = np.zeros((points, len(of)))
        square = self.t.design.units**2
        for j, (candidate, mine) in enumerate(zip(self.candidates, of)):
            to = receiver.points[:, None] - lamps[mine][None]
            distance = (to**2).sum(axis=-1)
            away = to / np.sqrt(distance)[..., None]
            weight = sees(-away, receiver.kind, receiver.normals[:, None]) / distance * seen[:, mine] * square
            shares = self.t.parts(candidate)[1](away)
            self.exact[i][:, j] = (weight * self.t.light(candidate, away) * shares).sum(axis=1)
