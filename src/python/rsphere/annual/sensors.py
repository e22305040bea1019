"""Where light is computed: sensors of a file, or a grid over work planes of the scene."""
import os
import subprocess

import numpy as np

from ..command import program
from ..fault import Fault, fault, lines_of, number
from ..layout.room import polygons_named

WORDS = ("x", "y", "z", "the direction along x", "the direction along y", "the direction along z")


def read_sensors(path, kind="a sensor"):
    """Rows of a place and the direction that a sensor, or an eye, faces."""
    rows = []
    for line, text in enumerate(lines_of(path), 1):
        words = text.split()
        if not words:
            continue
        if len(words) != 6:
            raise fault(path, line, f"{kind} is a place and the direction that it faces, x y z dx dy dz, not {len(words)} words")
        rows.append([number(word, path, line, what) for word, what in zip(words, WORDS)])
        if not any(rows[-1][3:]):
            raise fault(path, line, f"the direction of {kind} must not be 0 0 0")
    if not rows:
        raise fault(path, None, "has no sensors" if kind == "a sensor" else "has no eyes")
    return np.array(rows)


def plan_command(given, name):
    return [program("plan"), "-s", name, "-h", f"{given.height:.9g}", "-d", f"{given.spacing:.9g}", "-m", f"{given.margin:.9g}"]


def sensors_on(given, polygons):
    """The sensors of a grid over each of the work planes, by the rules of the program plan; the share of the area of each; and, for each
    work plane, its name and which of the sensors are on it."""
    rows, areas, planes = [], [], []
    for name in given.on:
        area = sum(np.linalg.norm(p.vector()) for p in polygons_named(polygons, name, ("--on " + name, None)))
        run = subprocess.run([*plan_command(given, name), "-p", *given.scene], capture_output=True, text=True, check=False)
        if run.returncode:
            raise Fault(run.stderr.strip().split("\n")[-1].removeprefix("plan: fatal - "))
        found = [[float(word) for word in line.split()] for line in run.stdout.splitlines()]
        planes.append((name, slice(len(rows), len(rows) + len(found))))
        rows += found
        areas += [area / len(found)] * len(found)
    return np.array(rows), np.array(areas) / sum(areas), planes


def draw(given, name, values, unit, title, path):
    """A plan of values of the sensors on a work plane, as SVG."""
    with open(path + ".txt", "w", encoding="ascii") as stream:
        stream.writelines(f"{v:.6g}\n" for v in values)
    levels = ["-l", "10,20,30,40,50,60,70,80,90"] if unit == "%" else []
    command = [*plan_command(given, name), *levels, "-q", unit, "-i", path + ".txt", "-o", path, "-t", title, *given.scene]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    os.remove(path + ".txt")
    if run.returncode:
        raise Fault(run.stderr.strip().split("\n")[-1].removeprefix("plan: fatal - "))
    with open(path, encoding="utf-8", errors="replace") as stream:
        return stream.read()
