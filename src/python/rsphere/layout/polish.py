"""Places and aims between those of the candidates: what may hang there, the neighbours of a layout, and layouts that anybody made."""
import numpy as np

from ..fault import fault, lines_of
from ..photometry.lamp_rad import word
from .design import Candidate, Words
from .search import Program, arrange, mirror_of, too_near

STEPS = [0.5**n for n in range(5)]  # of the first one, in each round
SHARES = [0.25 * s for s in STEPS]  # of the distance between candidates: how far away neighbours are; together less than a half
TILTS = [6.0 * s for s in STEPS]  # degrees: of the aims of neighbours
LEVEL = 1e-3  # m: candidates at one height are neighbours of each other
SAME = 1e-3  # m, and of aims: a luminaire is where a candidate is
TILTED = 0.9999  # of the cosine to straight down: luminaires that are aimed lower have no other aims
MOST_TILT = 12.0  # degrees: how far aims may be from those of a candidate, which is as far as all steps of TILTS together reach
MOST_LUMINAIRES = 2000  # of a layout that is judged: each is compared with all others
AROUND = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]


def spaces(design, candidates):
    """Half the distances of each candidate to the next of its luminaire along x and along y (n, 2): how far it may be moved; 0 without."""
    found, tolerance = np.zeros((len(candidates), 2)), LEVEL * design.units
    position, kind = np.array([c.position for c in candidates]), np.array([c.luminaire for c in candidates])
    for i in range(len(candidates)):
        away = np.abs(position[kind == kind[i]] - position[i])
        for axis in (0, 1):
            line = away[(np.delete(away, axis, axis=1) < tolerance).all(axis=1) & (away[:, axis] > tolerance), axis]
            found[i, axis] = line.min() / 2 if len(line) else 0.0
    return found


def tilted(aim, around, degrees):
    """An aim turned by some degrees: (1, 0) up or down, (0, 1) to the sides."""
    side = np.cross(aim, [0, 0, 1.0])
    side /= np.linalg.norm(side)
    t = np.radians(degrees)
    return np.cos(t) * aim + np.sin(t) * (around[0] * np.cross(side, aim) + around[1] * side)


def neighbours(design, candidates, chosen, spaces_of, turn):
    """Candidates around the chosen ones, of a round of SHARES: each at other places, or with another aim. Their spaces are those of the chosen."""
    made, spaces_made = [], []
    for j in chosen:
        c, step = candidates[j], 2 * SHARES[turn] * spaces_of[j]
        moves = np.unique([[step[0] * a, step[1] * b, 0] for a, b in AROUND], axis=0)
        beside = [Candidate(c.luminaire, c.position + move, c.aim, c.turn) for move in moves if move.any()]
        if c.aim[2] > -TILTED:
            beside += [Candidate(c.luminaire, c.position, tilted(c.aim, at, TILTS[turn]), c.turn) for at in AROUND if 0 in at]
        made += beside
        spaces_made += [spaces_of[j]] * len(beside)
    return made, np.array(spaces_made).reshape(-1, 2)


def not_allowed(design, layout):
    """What keeps a layout, a list of Candidates, from being one of a design; none if it is one."""
    found, spaces_of = [], spaces(design, design.candidates)
    places = np.array([c.position for c in design.candidates])
    matched = []
    for number, c in enumerate(layout, 1):
        alike = np.array([o.luminaire == c.luminaire and abs(o.turn - c.turn) % 360 < 0.1 for o in design.candidates])
        aims = np.array([np.degrees(np.arccos(np.clip(o.aim @ c.aim, -1, 1))) for o in design.candidates])
        most = np.where([o.aim[2] > -TILTED for o in design.candidates], MOST_TILT, 0.1)
        away, tolerance = np.abs(places - c.position), SAME * design.units
        near = alike & (aims <= most) & (away[:, :2] <= spaces_of + tolerance).all(axis=1) & (away[:, 2] <= tolerance)
        exact = near & (away.max(axis=1) <= tolerance) & (aims < 0.1)
        if not near.any():
            found.append(f"{number} {design.luminaires[c.luminaire].name} hangs where none may, or is turned or aimed in another way")
        matched.append(int(np.flatnonzero(exact)[0]) if exact.any() else None)
    if len(layout) and too_near(design, layout).any():
        i, j = np.argwhere(too_near(design, layout))[0]
        found.append(f"{i + 1} and {j + 1} overlap or are too near to each other")
    if design.most is not None and len(layout) > design.most:
        found.append(f"there are more than {design.most}")
    for axis, coordinate in design.mirrors if len(layout) else ():
        if (mirror_of(design, layout, axis, coordinate) < 0).any():
            found.append(f"it is not symmetric about {'xy'[axis]} = {coordinate:g}")
    if design.rows and not found:
        program = Program()
        x = program.variables(len(design.candidates), integer=True)
        arrange(program, design, design.candidates, x)
        there = np.isin(np.arange(len(x)), [m for m in matched if m is not None]).astype(float)
        if None in matched or program.solve(30.0, 0.0, x, there).x is None:
            found.append("it is not in rows of the candidates")
    return found


def read_layout(file, design):
    """The Candidates of a layout, and their levels in each scene: lines of a luminaire's name, x y z, aim x y z, turn, levels."""
    names, layout, levels = [l.name for l in design.luminaires], [], []
    for index, line in enumerate(lines_of(file, "utf-8", "surrogateescape")):
        words = line.split("#")[0].split()
        if not words:
            continue
        taken = Words(words, file, index + 1)
        name = word(taken.text("a luminaire"))
        if name not in names:
            raise taken.fault(f'there is no luminaire "{name[:40]}" in the goals; there are {", ".join(names)}')
        place, aim, turn = taken.vector("the place"), taken.unit("the aim"), taken.number("the turn", -360, 360)
        layout.append(Candidate(names.index(name), place, aim, turn))
        scenes = design.all_scenes()
        levels.append([taken.number(f"the level{' in ' + s.name if s.name else ''}", 0, 1) for s in scenes])
        taken.end()
        if len(layout) > MOST_LUMINAIRES:
            raise taken.fault(f"there are more than {MOST_LUMINAIRES} luminaires")
        if not design.dims() and set(levels[-1]) != {1.0}:
            raise taken.fault("the luminaires of these goals are not dimmed: the level is 1")
    if not layout:
        raise fault(file, None, "there is no luminaire; lines are NAME x y z, aim x y z, turn, level")
    return layout, np.array(levels).T


def layout_text(design, candidates, chosen, levels):
    """The text that read_layout() reads."""
    scenes = " ".join(s.name for s in design.all_scenes() if s.name)
    text = f"# luminaire, x y z, aim x y z, turn, level{' in each of ' + scenes if scenes else ''}\n"
    for n, j in enumerate(chosen):
        c = candidates[j]
        numbers = [*c.position, *c.aim, c.turn, *(level[n] for level in levels)]
        text += f"{design.luminaires[c.luminaire].name} {' '.join(f'{v + 0.0:.6g}' for v in numbers)}\n"
    return text
