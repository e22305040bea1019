"""What the goals get from the luminaires as built: light traced forward, by rtrace's rules (-I), with standard errors.

Each value is the mean of repeats with other random numbers; its standard error follows from their spread.
"""
import numpy as np

from ..progress import PROGRESS
from .wanted import Answer, receiver_of, uniformity

REPEATS = 6
BEYOND = 1e12  # cd/m2


class Forward:
    def __init__(self, transfer, scene, divisions, repeats=REPEATS):
        """scene: an rsphere.Scene of the room with its luminaires lit."""
        self.t, self.scene, self.repeats = transfer, scene, repeats
        # One reflection more than importance: there, the first surface is not yet a reflection.
        self.options = dict(ambient_bounces=transfer.bounces + 1, aa=0, ad=divisions, dj=1, dt=0, ds=0.05, lw=0.64 / max(divisions, 1))
        self.directions = min(16 * divisions, 2048)  # of spheres
        self.lux = transfer.rsphere.photometric

    def points(self, i):
        """The illuminance of each point of a receiver: (repeats, points)."""
        receiver = self.t.receivers[i]
        found = []
        PROGRESS.begin(f"Light traced forward to {len(receiver.points)} points of {receiver.name}", self.repeats)
        for repeat in range(1, self.repeats + 1):
            if receiver.kind == "cylinder":
                a = self.scene.sphere(receiver.points, ambient_bounces=self.t.bounces, outputs="C", rotation=repeat, directions=self.directions)
                found.append(self.lux(a.cylindrical_irradiance))
            else:
                options = dict(self.options, rotation=repeat)
                rays = np.hstack([receiver.points, receiver.normals])
                found.append(self.lux(self.scene.trace(rays, irradiance_at_origin=True, **options).value))
            PROGRESS.advance()
        PROGRESS.clear()
        return np.array(found)

    def answers(self, goals):
        """The Answer of each goal."""
        found, known = [], {}
        for goal in goals:
            if goal.kind == "ugr":
                found.append(self.glare(goal))
                continue
            i = receiver_of(self.t, goal.target, ("cylinder",) if goal.kind == "cylindrical" else ("plane",))
            if i not in known:
                known[i] = self.points(i)
            values = known[i].mean(axis=1)
            if goal.kind == "uniformity":
                found.append(uniformity(goal, np.array([self.t.receivers[i].cell_means(v) for v in known[i]]), self.t.receivers[i]))
            else:
                found.append(Answer(goal, float(values.mean()), self.error(values)))
        return found

    def error(self, values):
        return float(values.std(ddof=1) / np.sqrt(len(values)))

    def glare(self, goal):
        """UGR by rsphere -Su, of luminaires alone (CIE 117): no other surface is as bright as BEYOND."""
        eye = self.t.design.eyes[goal.target]
        PROGRESS.begin(f"Glare at {goal.target}")
        a = self.scene.glare([eye.position], [eye.gaze], ambient_bounces=self.t.bounces, directions=self.directions, Sub=BEYOND)
        PROGRESS.clear()
        return Answer(goal, float(a.ugr[0]), float(a.ugr_standard_error[0]))


def daylight_of(transfer, scene, divisions, repeats=REPEATS):
    """The illuminance (points, 1) of each receiver from the sky and the sun, as the direct part of a Light."""
    forward = Forward(transfer, scene, divisions, repeats)
    return [forward.points(i).mean(axis=0)[:, None] for i in range(len(transfer.receivers))]
