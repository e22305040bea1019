"""Shades: groups of windows, each with its blinds up or lowered, and the rule of IES LM-83 by which they are lowered."""
import os
import re
import subprocess
import warnings
from dataclasses import dataclass
from itertools import product

import numpy as np

import rsphere

from ..command import program
from ..fault import NUMBER, Fault, fault, lines_of, number, write_text
from .outside import panes_of
from .verdicts import SUNNY

TRANSMITTANCE, REFLECTANCE = 0.02, 0.5  # of lowered blinds (the first by LM-83), both diffuse
PANE = 0.1  # reflectance of windows that are closed, about that of panes: while the light of other groups is computed
ALLOWED = 0.02  # of the sensors may have SUNNY lx of direct sun (LM-83)
MOST_COMBINED = 6  # groups of which all combinations are tried
GAP, OVERLAP = 1e-4, 1e-3  # of a blind from its pane, and beyond its edges, by the pane's size: what passes beside it is negligible
SET_OFF, LEAST = 1e-3, 2e-4  # instead of GAP, and in units of the scene, where sensors are on blinds: their rays miss nearer panes
BEHIND = 0.25  # by their size: how far windows may be apart that are panes of one opening
ACROSS = 0.1, 0.5, 0.9  # of the way from the middle of a pane to its corners: where rays cross it
OPAQUE = 1e-3  # transmittance below which a polygon is no window
MOST_PARTS, ALONG = 400, 6  # of blinds, and of one along its longer edge: the light of each is taken as even
UP, LOWERED = 0, 1


@dataclass
class Group:
    """Windows of one modifier."""

    name: str
    windows: list  # of polygons
    lowered: str  # scene text of the blinds
    files: list  # or their files
    closed: str  # scene text that closes the windows
    transmittance: float = 0.0  # of blinds that are not of files
    further: str = ""  # scene text of these blinds, opaque and SET_OFF from their panes
    parts: np.ndarray = None  # corners of the blinds' parts (n, 4, 3), if all panes are convex and have four
    outwards: np.ndarray = None  # (n, 3): to their sides away from the sensors, as long as the blinds are away from their panes
    set_off: np.ndarray = None  # (n, 1), by this length

    def part_names(self):
        return [f"rsphere_part{i}" for i in range(len(self.parts))]

    def part_text(self):
        """Scene text of the sides of the parts towards the sensors, each of its own modifier."""
        return "".join(f"{opaque(REFLECTANCE, name)}\n" + polygon_text(name, name, corners) for name, corners in zip(self.part_names(), self.parts))

    def rays_outwards(self, u, v):
        """Places of sensors at the outer sides of the parts of further, and their directions. u, v: where on each (n, 1), from 0 to 1."""
        places = between(self.parts.swapaxes(0, 1), u, v) + self.outwards * (1 - self.set_off)
        return np.hstack([places, self.outwards / np.linalg.norm(self.outwards, axis=1)[:, None]])

    def radiance_of(self, irradiance):
        """Of the parts, towards the sensors, for irradiances on their outer sides."""
        return irradiance * (self.transmittance / np.pi)


def between(corners, u, v):
    """A place between four corners; u, v: from 0 to 1."""
    a, b, c, d = corners
    return (1 - u) * ((1 - v) * a + v * d) + u * ((1 - v) * b + v * c)


def some(names):
    return ", ".join(names[:4]) + f" and {len(names) - 4} more" * (len(names) > 4)


def opaque(reflectance, name):
    return f"void plastic {name} 0 0 5 {reflectance} {reflectance} {reflectance} 0 0"


def polygon_text(modifier, name, corners):
    return f"{modifier} polygon {name}\n0\n0\n{corners.size} {' '.join(f'{v:.12g}' for v in corners.ravel())}\n"


def size_of(p):
    return np.sqrt(np.linalg.norm(p.vector()))


def set_off(p):
    """How far, by its size, blinds are from a pane where sensors are on them."""
    return max(SET_OFF, LEAST / size_of(p))


def cover(p, sensors, gap=GAP):
    """The corners of what covers a polygon on its side of the sensors, and the way from the polygon to it."""
    normal = p.vector() / np.linalg.norm(p.vector())
    side = np.sign((sensors - p.corners[0]) @ normal).sum() or 1
    middle = p.corners.mean(axis=0)
    way = np.sign(side) * normal * gap * size_of(p)
    return middle + (p.corners - middle) * (1 + OVERLAP) + way, way


def covers(polygons, sensors, material, name, gap=lambda _: GAP):
    """Scene text of a material on polygons, on their side of the sensors."""
    text = f"{material}\n"
    for i, p in enumerate(polygons):
        text += polygon_text(name, f"{name}.{i + 1}", cover(p, sensors, gap(p))[0])
    return text


def divided(polygons, sensors):
    """The parts of covers(), as in Group, the ways outwards and set_off; None if a polygon is not convex with four corners."""
    along = max(1, min(ALONG, int(np.sqrt(MOST_PARTS / len(polygons)))))
    parts, outwards, off = [], [], []
    for p in polygons:
        corners, way = cover(p, sensors)
        edges = np.roll(corners, -1, axis=0) - corners
        if len(corners) != 4 or (np.cross(edges, np.roll(edges, -1, axis=0)) @ p.vector() <= 0).any():
            return None, None, None
        long = np.linalg.norm(edges, axis=1)
        u, v = (np.linspace(0, 1, 1 + max(1, round(along * max(long[k], long[k + 2]) / long.max()))) for k in (0, 1))
        for i in range(len(u) - 1):
            for j in range(len(v) - 1):
                parts.append([between(corners, u[k], v[m]) for k, m in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))])
                outwards.append(-way)
                off.append([set_off(p) / GAP])
    return np.array(parts), np.array(outwards), np.array(off)


def group_of(word, polygons, sensors):
    """The Group of an argument of --shades: MODIFIER, MODIFIER=TRANSMITTANCE or MODIFIER=FILE of scene text."""
    name, _, state = word.partition("=")
    windows = panes_of(name, polygons)
    if not windows:
        known = ", ".join(sorted({p.modifier for p in polygons})[:8])
        raise Fault(f'--shades {word}: the scene has no polygon with the modifier "{name}"; it has {known}')
    if "=" in word and not state:
        raise Fault(f"--shades {word}: there is nothing behind =: a transmittance, or a file of blinds")
    lowered, files, t, parts = "", [], 0.0, ("", None, None, None)
    if state and not (NUMBER.fullmatch(state) or (state[0] in "+-.0123456789" and not os.path.exists(state))):
        files = [state]
        if not any(line.strip() and not line.lstrip().startswith("#") for line in lines_of(state)):
            raise fault(state, None, "has nothing that could be lowered")
    else:
        t = number(state, "--shades " + word, None, "what is behind =", 0, 0.5) if state else TRANSMITTANCE
        color = REFLECTANCE + t
        parts = covers(windows, sensors, opaque(REFLECTANCE, "rsphere_blind"), "rsphere_blind", set_off), *divided(windows, sensors)
        lowered = covers(windows, sensors, f"void trans rsphere_blind 0 0 7 {color} {color} {color} 0 0 {t / color:.9g} 0", "rsphere_blind")
    closed = covers(windows, sensors, opaque(PANE, "rsphere_closed"), "rsphere_closed")
    return Group(name, windows, lowered, files, closed, t, *parts)


def behind_others(windows):
    """Names of two windows of which one lies behind the other, as the panes of double glazing do, or None."""
    vectors = np.array([p.vector() for p in windows])
    size, middle = np.sqrt(np.linalg.norm(vectors, axis=1)), np.array([p.corners.mean(axis=0) for p in windows])
    for i, normal in enumerate(vectors / size[:, None] ** 2):
        parallel = np.abs(vectors[i + 1 :] @ normal) > 0.99 * size[i + 1 :] ** 2
        near = np.linalg.norm(middle[i + 1 :] - middle[i], axis=1) < BEHIND * np.minimum(size[i], size[i + 1 :])
        for j in np.flatnonzero(parallel & near):
            return windows[i].name, windows[i + 1 + j].name
    return None


def check_shapes(groups, files):
    """Raises Fault if a pane of a group is a sphere or the like, and warns of panes behind others."""
    run = subprocess.run([program("rsphere"), "-h", "-w-", "-Sl", *files], capture_output=True, check=False, stdin=subprocess.DEVNULL,
                         encoding="utf-8", errors="replace")
    for place, shape, name, modifier in re.findall(r'^(.+): (\w+) "(.*?)"\t\w+ "(.*?)"', run.stdout, re.MULTILINE):
        for group in groups:
            if modifier == group.name and shape != "polygon":
                raise Fault(f'{place}: {shape} "{name}" has the modifier of --shades {group.name}, but only polygons can have blinds')
    for group in groups:
        found = behind_others(group.windows)
        if found:
            warnings.warn(f"--shades {group.name}: {found[0]} and {found[1]} are panes of one window, and both get blinds; name one of them", stacklevel=1)


def lightless(windows, files, inside, folder):
    """Whether no light passes through polygons: by rays across each to a light on the side of the places inside."""
    covered = [cover(p, inside, set_off(p)) for p in windows]
    names = [f"rsphere_lit{i}" for i in range(len(windows))]
    path = write_text(os.path.join(folder, "lit.rad"), "".join(
        f"void glow {name} 0 0 4 1 1 1 0\n" + "".join(polygon_text(name, name, c) for c in (corners, corners[::-1])) for name, (corners, _) in zip(names, covered)))
    rays = [[*(p.corners.mean(axis=0) * (1 - t) + corner * t - way), *way / np.linalg.norm(way)]
            for p, (_, way) in zip(windows, covered) for corner in p.corners for t in ACROSS]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the scene has warnings of its own, which come later
        lit = rsphere.Scene([path, *files]).contributions(rays, of=names, irradiance_at_origin=True, coefficients=True, ambient_bounces=3, ambient_divisions=64)
    of = np.repeat(np.arange(len(windows)), [len(ACROSS) * len(p.corners) for p in windows])
    light = lit.value.reshape(len(of), len(names), -1)[np.arange(len(of)), of].mean(axis=1)
    return np.bincount(of, light) < OPAQUE * np.pi * np.bincount(of)


def refuse_walls(groups, files, inside, folder):
    """Raises Fault if no light passes through the windows of a group, and warns of single ones."""
    dark = lightless([p for group in groups for p in group.windows], files, inside, folder)
    for group in groups:
        names, dark = [p.name for p, d in zip(group.windows, dark) if d], dark[len(group.windows) :]
        if len(names) == len(group.windows):
            raise Fault(f"--shades {group.name}: no light passes through {some(names)}: is this the modifier of panes?")
        if names:
            warnings.warn(f"--shades {group.name}: no light passes through {some(names)}, which gets blinds, too", stacklevel=1)


def groups_of(words, polygons, sensors):
    """The Groups of all --shades. No window may be in two of them: each is closed while the light of the others is computed."""
    groups = [group_of(word, polygons, sensors) for word in words]
    for i, group in enumerate(groups):
        for other in groups[:i]:
            if any(a is b for a in group.windows for b in other.windows):
                raise Fault(f"--shades {group.name}: has windows that --shades {other.name} has already")
    return groups


def states_by_rule(direct, means, weights):
    """The state of each group in each hour: (hours, groups).

    direct: lx of direct sun (groups, 2, sensors, hours), means: lx of all light, the mean of the sensors (groups, 2, hours). The
    chosen state lets in most light of those in which at most ALLOWED of the sensors have SUNNY lx of direct sun; if there is none,
    all blinds are lowered. Of more than MOST_COMBINED groups, that which brings most sensors this sun is lowered first.
    """
    groups, _, _, hours = direct.shape
    sunny = lambda states: weights @ (sum(direct[g, s] for g, s in enumerate(states)) >= SUNNY) > ALLOWED  # noqa: E731
    chosen = np.full((hours, groups), LOWERED)
    if groups <= MOST_COMBINED:
        best = np.full(hours, -np.inf)
        for states in product((UP, LOWERED), repeat=groups):
            light = sum(means[g, s] for g, s in enumerate(states))
            better = ~sunny(states) & (light > best)
            best[better], chosen[better] = light[better], states
        return chosen
    order = np.argsort(-np.array([weights @ (direct[g, UP] >= SUNNY) for g in range(groups)]), axis=0, kind="stable")
    for h in range(hours):
        states, now = np.full(groups, UP), slice(h, h + 1)
        for g in order[:, h]:
            if not (weights @ (sum(direct[k, s, :, now] for k, s in enumerate(states)) >= SUNNY) > ALLOWED).any():
                break
            states[g] = LOWERED
        chosen[h] = states
    return chosen
