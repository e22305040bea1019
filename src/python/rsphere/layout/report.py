"""The report of a room with its luminaires by EN 12464-1: light on tasks, around them, at eyes, on walls and ceiling, glare, power."""
import os
import tempfile
import warnings
from dataclasses import dataclass

import numpy as np

from ..fault import needs_light, write_text
from ..page import Page, aligned, table
from ..photometry.position_index import position_index
from ..progress import PROGRESS
from .built import maintenance_in
from .dimming import dimmed
from .forward import BEYOND
from .glare import rating
from .limits import BACKGROUND_WIDTH, MODELLING, SPATIAL_UNIFORMITY, SURROUNDING_UNIFORMITY, SURROUNDING_WIDTH
from .room import LIFT, cells_of, distance, frame_of, inside, plan_of, read_polygons, standard_spacing
from .steps import raypath
from .tasks import read_tasks

HEAD = 2.0  # m above the floor: nobody stands under what is lower
BEHIND = 0.1  # m: the surroundings of a board end with its wall
IN_FRONT = 0.5  # m: a wall behind furniture is not one that is seen
NOISE = 2.0  # standard errors: values nearer to their limit are neither met nor missed
MOST_AROUND = 200  # points along each side of a surrounding area
DARK = 1e-3  # of the mean: points below lie inside of furniture
GAZES = np.array([[np.cos(a), np.sin(a), 0] for a in np.pi / 4 * np.arange(8)])
WORST = 4  # places and gazes whose glare is computed with FINE directions, of those that COARSE directions find
COARSE, FINE = 128, 1024  # directions
LAST = 512  # directions at the worst of them, with all light: UGR is off by less than .1, also in a room with mirrors
AROUND = 256  # directions for cylindrical illuminance: its error is .4% in the open-plan office of the examples, 1.7% beside mirrors
LOW = 10.0  # UGR below is not a number of the standard


@dataclass
class Row:
    """A value with its standard error. limit: None if there is none; most: it is an upper limit."""

    of: str
    what: str
    limit: float
    value: float
    error: float
    unit: str = ""
    most: bool = False
    where: str = ""

    def verdict(self):
        if self.limit is None:
            return ""
        slack = (self.limit - self.value) if self.most else (self.value - self.limit)
        if abs(slack) < NOISE * self.error:
            return "within noise"
        return "met" if slack >= 0 else "not met"

    def shown(self, value, error=False):
        if self.unit == "UGR":
            return "<10" if value < LOW and not error else f"{value:.2f}" if error else f"{value:.1f}"
        if self.unit == "lx":
            return f"{value:.1f} lx" if error else f"{value:.0f} lx"
        return f"{value:.3f}" if error else f"{value:.2f}"

    def cells(self):
        limit = "" if self.limit is None else ("at most " if self.most else "") + self.shown(self.limit)
        verdict = self.verdict()
        error = self.shown(self.error, True) if self.error else ""
        return [self.of, self.what, limit, self.shown(self.value), error, "!" * (verdict == "not met") + verdict, self.where]


HEADS = ["of", "what", "limit", "found", "+-", "verdict", ""]


class Light:
    """Illuminances at points, with their standard errors, maintained."""

    def __init__(self, rsphere, scene, factor, accuracy):
        self.rsphere, self.scene, self.factor, self.accuracy = rsphere, scene, factor, accuracy

    def lux(self, power):
        return self.factor * self.rsphere.photometric(power)

    def on(self, points, normals):
        rays = np.hstack([points, np.broadcast_to(normals, points.shape)])
        with needs_light("the scene has no light sources; a report is on a room with its luminaires, such as lamps.rad of a layout"):
            warnings.filterwarnings("ignore", message="-Sa")  # the errors are in the report
            a = self.scene.trace(rays, irradiance_at_origin=True, outputs="ve", accuracy=self.accuracy)
        return self.lux(a.value), self.lux(a.standard_error)

    def free(self, points, directions):
        """How far it is from points to what is next in a direction."""
        return self.scene.trace(np.hstack([points, np.broadcast_to(directions, points.shape)]), outputs="L").first_length


class Report:
    def __init__(self, rsphere, given):
        self.rsphere, self.given = rsphere, given
        self.polygons = read_polygons(given.room)
        self.tasks = read_tasks(given.goals, self.polygons)
        self.title = given.title or f"Lighting of {', '.join(os.path.basename(f) for f in given.room)}"
        self.units, self.rows, self.notes = self.tasks.units, [], []
        for file in given.room:
            if self.tasks.maintenance != 1 and maintenance_in(file) != 1:
                warnings.warn(f"{file}: the luminaires have a maintenance factor of {maintenance_in(file):g} in their light, and the report multiplies it by "
                              f"{self.tasks.maintenance:g}; leave out maintenance in {self.tasks.file}", stacklevel=2)
        self.floor_level = max(p.corners[:, 2].max() for p in self.tasks.floor)

    def run(self):
        # Copies of the scene files are dimmed; what lies beside the files must be found.
        beside = dict.fromkeys(os.path.dirname(file) for file in self.given.room)
        with tempfile.TemporaryDirectory() as folder, raypath(*beside):
            files = dimmed(self.given.room, self.tasks.lamps, folder)
            self.light = Light(self.rsphere, self.rsphere.Scene(files), self.tasks.maintenance, self.given.accuracy)
            self.floor_points = self.floor_grid()
            horizontal = [self.task(task) for task in self.tasks.tasks]
            self.of_tasks = len(self.rows)
            self.eyes(max(t.activity.cylindrical for t in self.tasks.tasks))
            for name, surfaces in (("walls", self.tasks.walls), ("ceiling", self.tasks.ceiling)):
                if surfaces:
                    self.around(name, surfaces, max(getattr(t.activity, name) for t in self.tasks.tasks))
            self.glare(min(self.tasks.tasks, key=lambda t: t.activity.ugr).activity)
            self.power([h for h in horizontal if h])
            self.notes.append(f"Activities: {'; '.join(dict.fromkeys(t.activity.title() for t in self.tasks.tasks))}. Compare the limits with your "
                              "edition of the standard; those of the room are the strictest of its tasks.")
            self.tell()
            self.page(files)

    def met(self):
        return all(row.verdict() != "not met" for row in self.rows)

    def add(self, of, values, errors, limit, uniformity, where="", weights=None, what="E_m"):
        """Rows of the mean and of U_o, least over mean. Errors of points have signs in common: that of the mean is at most theirs."""
        weights = np.ones(len(values)) if weights is None else weights
        mean, error = np.average(values, weights=weights), np.average(errors, weights=weights)
        least = values.argmin()
        self.rows.append(Row(of, what, limit, mean, error, "lx", where=where))
        if mean > 0:
            ratio = values[least] / mean
            share = np.hypot(errors[least] / max(values[least], 1e-9), error / mean)
            self.rows.append(Row(of, "U_o", uniformity, ratio, ratio * share))
        return mean

    def lit(self, name, values, *others):
        """Values and others without those of points that no light reaches, since these lie inside of furniture."""
        lit = values > DARK * values.mean()
        if not lit.any():
            lit[:] = True  # it is dark
        if not lit.all():
            self.notes.append(f"{name}: {(~lit).sum()} of {len(lit)} points are left out, which no light reaches.")
        return values[lit], *(o[lit] for o in others)

    def under_nothing(self, points):
        """Whether nothing that is lower than HEAD is above each point."""
        return points[:, 2] + self.light.free(points, [0, 0, 1.0]) > self.floor_level + HEAD * self.units

    def on_floor(self, points):
        return np.any([inside(p.corners[:, :2], points[:, :2]) for p in self.tasks.floor], axis=0)

    def grid(self, margin, spacing=None):
        """Points on the floor by the grid of the standard."""
        sizes = [np.ptp(p.corners[:, :2], axis=0) / self.units for p in self.tasks.floor]
        spacing = spacing or max(standard_spacing(*size) for size in sizes) * self.units
        found = [cells_of(p, spacing, margin, self.tasks.place or (self.tasks.file, None))[0] for p in self.tasks.floor]
        return np.concatenate(found)

    def floor_grid(self):
        """Points on the floor with their illuminances and errors, under nothing."""
        points = self.grid(0.0) + [0, 0, 1.5 * LIFT * self.units]
        points = points[self.under_nothing(points)] if len(points) else points
        PROGRESS.begin(f"Light on {len(points)} points of the floor")
        return points, *(self.light.on(points, [0, 0, 1.0]) if len(points) else np.zeros((2, 0)))

    def task(self, task):
        """Rows of a task, of the area around it and of the background. The illuminance and the area if the task is horizontal."""
        surface, activity = task.surface, task.activity
        normal = surface.normals[0]
        points = surface.cells.mean(axis=1) + 1.5 * LIFT * self.units * normal
        PROGRESS.begin(f"Light on {len(points)} points of {surface.name}")
        values, errors = self.lit(surface.name, *self.light.on(points, normal))
        mean = self.add(surface.name, values, errors, activity.illuminance, activity.uniformity, f"{activity.number} {activity.name}")
        points = self.surrounding(task, normal)
        if len(points):
            values, errors = self.lit(f"around {surface.name}", *self.light.on(points, normal))
            self.add(f"around {surface.name}", values, errors, activity.surrounding(), SURROUNDING_UNIFORMITY)
        if normal[2] < 0.9:
            return None
        points, values, errors = self.floor_points
        away = self.away(surface, points[:, :2], lambda corners: corners[:, :2])
        there = (away > task.around) & (away <= task.around + BACKGROUND_WIDTH * self.units)
        if there.any():
            self.add(f"background of {surface.name}", values[there], errors[there], activity.background(), SPATIAL_UNIFORMITY)
        return mean, surface.area() / self.units**2

    @staticmethod
    def away(surface, points, flat):
        return np.min([distance(flat(corners), points) for corners, _ in surface.outlines], axis=0)

    def surrounding(self, task, normal):
        """Points in the band around a task, in its plane and in the room."""
        surface, along = task.surface, np.stack(frame_of(normal))
        flat = [corners @ along.T for corners, _ in surface.outlines]
        low, high = np.concatenate(flat).min(axis=0) - task.around, np.concatenate(flat).max(axis=0) + task.around
        if not task.around > 0:
            return np.zeros((0, 3))
        counts = np.ceil((high - low) / np.maximum(task.around / 2, (high - low) / MOST_AROUND)).astype(int)  # two rows of points
        u, v = (low[i] + (np.arange(counts[i]) + 0.5) * (high[i] - low[i]) / counts[i] for i in (0, 1))
        points = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
        away = self.away(surface, points, lambda corners: corners @ along.T)
        points = points[(away > 0) & (away <= task.around)]
        points = points @ along + (surface.outlines[0][0][0] @ normal + 1.5 * LIFT * self.units) * normal
        if not len(points):
            return points
        if normal[2] < 0.9:
            return points[self.light.free(points, -normal) < BEHIND * self.units]
        others = [c for t in self.tasks.tasks for c, n in t.surface.outlines if n[2] > 0.9 and t is not task]
        elsewhere = np.all([~inside(c[:, :2], points[:, :2]) for c in others], axis=0) if others else True
        return points[self.on_floor(points) & elsewhere & self.under_nothing(points)]

    def eyes(self, limit):
        """Cylindrical illuminance and modelling on a grid at the height of eyes, and the grid for glare."""
        above = [0, 0, self.tasks.height * self.units]
        narrow = min(np.ptp(p.corners[:, :2], axis=0).min() for p in self.tasks.floor)
        points = self.grid(min(SURROUNDING_WIDTH * self.units, narrow / 4), self.tasks.spacing) + above
        points = points[self.under_nothing(points)]
        self.places = [("", p) for p in points] + [(e.name, e.position) for e in self.tasks.eyes]
        if not len(points):
            self.notes.append("Eyes: no place is free.")
            return
        PROGRESS.begin(f"Cylindrical illuminance at {len(points)} places")
        a = self.light.scene.sphere(points, directions=AROUND, outputs="CeHe")
        values, errors, top, top_error, points = self.lit(
            "eyes", *(self.light.lux(v) for v in (a.cylindrical_irradiance, a.cylindrical_irradiance_standard_error,
                                                  a.face_irradiance[:, 4], a.face_irradiance_standard_error[:, 4])), points)
        name = f"eyes, {self.tasks.height:g} m"
        self.add(name, values, errors, limit, SPATIAL_UNIFORMITY, f"{len(points)} places", what="E_m,z")
        ratios = values / np.maximum(top, 1e-9)
        shares = ratios * np.hypot(errors / np.maximum(values, 1e-9), top_error / np.maximum(top, 1e-9))
        good = ((ratios >= MODELLING[0]) & (ratios <= MODELLING[1])).mean()
        self.rows.append(Row(name, "modelling", None, ratios.mean(), shares.mean(),
                             where=f"{MODELLING[0]:.2f} to {MODELLING[1]:.2f} at {good:.0%} of the places"))
        self.places[: len(self.places) - len(self.tasks.eyes)] = [("", p) for p in points]

    def around(self, name, surfaces, limit):
        """Rows of walls or of the ceiling, their parts by area, without those behind furniture."""
        values, errors, weights, names = [], [], [], []
        for surface in surfaces:
            points, normal = surface.cells.mean(axis=1) + 1.5 * LIFT * self.units * surface.normals[0], surface.normals[0]
            points = points[self.light.free(points, normal) > IN_FRONT * self.units]
            if len(points):
                PROGRESS.begin(f"Light on {len(points)} points of {surface.name}")
                value, error = self.light.on(points, normal)
                values, errors = [*values, *value], [*errors, *error]
                weights += [np.linalg.norm(np.cross(*(surface.cells[0, 1:3] - surface.cells[0, :1])))] * len(points)
                names += [surface.name] * len(points)
        if values:
            darkest = f"darkest: {names[int(np.argmin(values))]}"
            self.add(name, np.array(values), np.array(errors), limit, SPATIAL_UNIFORMITY, darkest, np.array(weights))

    def glare(self, activity):
        """The worst UGR of luminaires, at all places and in eight directions: coarsely at first, then the worst ones again.

        Luminaires look the same without indirect light, which takes nearly all of the time, and which the background has from
        the illuminance at the eye. Only the worst of all is computed with it.
        """
        if not self.places:
            return
        places = np.array([p for _, p in self.places])
        count, eight = len(places), len(GAZES)
        PROGRESS.begin(f"Glare at {count} places", 2)
        scene, found = self.light.scene, np.full((count, eight), -np.inf)
        across = [self.luminaires(places, gaze, COARSE) for gaze in ([1, 0, 0], [-1, 0, 0])]
        PROGRESS.advance()
        rays = np.hstack([np.repeat(places, eight, axis=0), np.tile(GAZES, (count, 1))])
        vertical, _ = self.light.on(rays[:, :3], rays[:, 3:])
        vertical = vertical.reshape(count, eight) / self.light.factor
        for i in range(count):
            for k, gaze in enumerate(GAZES):
                found[i, k] = self.ugr([a[i] for a in across], gaze, vertical[i, k])
        worst = [divmod(int(i), eight) for i in np.argsort(-found, axis=None)[:WORST]]
        finer = self.luminaires(places[[i for i, _ in worst]], GAZES[[k for _, k in worst]], FINE)
        i, k = max(zip(worst, finer), key=lambda w: self.ugr(w[1:], GAZES[w[0][1]], vertical[w[0]]))[0]
        a, maintained = scene.glare(places[[i]], GAZES[[k]], directions=LAST, Sub=BEYOND), 8 * np.log10(self.tasks.maintenance)
        looking = " ".join(f"{v:.2g}" for v in np.round(GAZES[k], 2) + 0.0)
        where = f"{self.places[i][0] or 'eye'} at {' '.join(f'{v:.2f}' for v in places[i])} looking to {looking}"
        self.rows.append(Row("glare", "worst UGR", activity.ugr, float(a.ugr[0]) + maintained, float(a.ugr_standard_error[0]), "UGR", True,
                             f"{where}; {self.blame(a.sources[0], places[i], GAZES[k])}"))
        self.notes.append(f"Glare: by the formula of CIE 117 for luminaires as they are seen at {count} places in eight directions, 45 degrees apart "
                          f"from +x on, also overhead, where tables of catalogues leave them out; the limit is that of {activity.number} {activity.name}.")

    def luminaires(self, places, gazes, directions):
        """The luminaires that are seen from places."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # half of the room may be dark
            return self.light.scene.glare(places, gazes, directions=directions, ambient_bounces=0, Sub=BEYOND).sources

    @staticmethod
    def ugr(views, gaze, vertical):
        """UGR by what is seen in some views, and by the illuminance at the eye (lx)."""
        directions, luminance, angle = (np.concatenate([getattr(v, k) for v in views]) for k in ("direction", "luminance", "solid_angle"))
        direct = luminance @ (angle * (directions @ gaze).clip(0))
        total = luminance**2 @ (angle / position_index(gaze, directions) ** 2)
        return rating(total, max(vertical - direct, 0) / np.pi)

    def blame(self, sources, place, gaze):
        """Which luminaire gives most of the glare."""
        if not len(sources.luminance):
            return "no luminaire is in view"
        terms = sources.luminance**2 * sources.solid_angle / position_index(gaze, sources.direction) ** 2
        first = int(terms.argmax())
        modifier = self.light.scene.trace([[*place, *sources.direction[first]]], outputs="m").modifier[0]
        return f"{terms[first] / terms.sum():.0%} by {sources.surface[first]} ({modifier})"

    def power(self, horizontal):
        """Power density, where watts are known."""
        lamps = [l for l in self.tasks.lamps if l.watts > 0]
        if not lamps:
            return
        area = sum(np.linalg.norm(p.vector()) for p in self.tasks.floor) / self.units**2
        watts = sum(l.watts * l.factor for l in lamps)
        self.rows.append(Row("power", "W/m2", None, watts / area, 0.0, where=f"{watts:.0f} W on {area:.1f} m2"))
        if horizontal:
            lux = np.average([e for e, _ in horizontal], weights=[a for _, a in horizontal])
            self.rows.append(Row("power", "W/m2/100 lx", None, 100 * watts / area / lux, 0.0, where=f"for {lux:.0f} lx, the mean of the horizontal tasks"))

    def verdict(self):
        verdicts = [row.verdict() for row in self.rows if row.limit is not None]
        missed, noise = verdicts.count("not met"), verdicts.count("within noise")
        text = f"{verdicts.count('met')} of {len(verdicts)} limits are met"
        return text + f", {missed} are not met" * bool(missed) + f", {noise} are within {NOISE:g} standard errors" * bool(noise) + "."

    def settings(self):
        lamps = [f"{l.pattern} at {l.factor:.0%}" for l in self.tasks.lamps if l.factor < 1]
        return (f"Maintenance factor {self.tasks.maintenance:g}{'; dimmed: ' + ', '.join(lamps) if lamps else ''}. Light by rsphere "
                f"{self.rsphere.__version__} with all reflections; {NOISE:g} standard errors decide whether a limit is met.")

    def tell(self):
        PROGRESS.clear()
        lines = aligned([HEADS, *(row.cells() for row in self.rows)], (0, 1, 5, 6))
        text = "".join(f"{line}\n" for line in (*lines, self.verdict(), self.settings(), *self.notes))
        print(text, end="")
        write_text(os.path.join(self.given.output, "report.txt"), text)

    def page(self, files):
        page = Page(self.title)
        page.banner(self.met(), self.verdict())
        for heading, rows in (("Tasks", self.rows[: self.of_tasks]), ("Room", self.rows[self.of_tasks :])):
            page.heading(heading)
            page.add(table(HEADS, [row.cells() for row in rows], 2))
        plan = self.plan(files)
        if plan:
            page.figure(plan)
        for line in (self.settings(), *self.notes):
            page.note(line)
        write_text(os.path.join(self.given.output, "report.html"), page.html())

    def plan(self, files):
        """A falsecolor plan at the height of the tasks."""
        if self.given.no_plan:
            return None
        level = [t.surface.points[0, 2] for t in self.tasks.tasks if t.surface.normals[0, 2] > 0.9]
        height = np.median(level) - self.floor_level if level else 0.75 * self.units
        floor, size = self.tasks.floor[0], max(np.ptp(p.corners[:, :2], axis=0).max() for p in self.tasks.floor)
        PROGRESS.begin("Plan in false colors")
        words = ["-h", f"{height:g}", "-d", f"{size / 28:g}", "-z", "-f", f"{self.tasks.maintenance:g}", "-t",
                 f"Illuminance {height / self.units:.2f} m above {floor.name} (lx)"]
        words += [word for p in self.tasks.floor for word in ("-s", p.name)]
        words += [word for name in list(dict.fromkeys(t.surface.name for t in self.tasks.tasks))[:60] for word in ("-c", name)]
        path = os.path.join(self.given.output, "plan.svg")
        return plan_of(path, [*words, *files, "--", "-ab", str(self.given.bounces + 1), "-ad", "512", "-as", "128"], os.environ.get("RAYPATH", "."))
