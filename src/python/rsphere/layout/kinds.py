"""Which kind of file was given where another one belongs: goals, tasks of a report, a layout, or a scene."""
from ..fault import Fault, lines_of
from .design import Reader
from .tasks import TaskReader

ORDERS = {"goals": "goals.txt room.rad", "tasks": "--report tasks.txt room.rad", "layout": "--judge layout.txt goals.txt room.rad"}
HELD = {"goals": "goals", "tasks": "tasks of a report", "layout": "a layout", "scene": "a scene"}


def statements(reader):
    return {name.removeprefix("read_") for name in dir(reader) if name.startswith("read_")}


GOALS, TASKS = statements(Reader), statements(TaskReader)


def kind_of(file):
    """goals, tasks, layout or scene; None if the text does not show it."""
    try:
        lines = lines_of(file, "utf-8", "surrogateescape")
    except Fault:
        return None
    if lines[0].startswith("# luminaire, x y z"):
        return "layout"
    words = [line.split()[0] for line in lines if line.strip() and not line.lstrip().startswith("#")]
    if words and (words[0] in ("void", "inherit") or words[0].startswith("!") or lines[0].startswith("#?RADIANCE")):
        return "scene"
    for kind, own, other in ("goals", GOALS, TASKS), ("tasks", TASKS, GOALS):
        if any(w in own - other for w in words) and sum(w in own for w in words) > len(words) / 2:
            return kind
    return None


def explained(given, error):
    """A fault of the files of a command line: of their order, if that is wrong; else the fault as it is."""
    expected = "tasks" if given.report else "layout" if given.judge else "goals"
    order = f"the order is: rsphere-layout {ORDERS[expected]}"
    for file in given.room:
        if kind_of(file) in ORDERS:
            return Fault(f"{file}: is not a scene but holds {HELD[kind_of(file)]}; {order}")
    kind = kind_of(given.goals)
    if kind == "tasks" and not given.report:
        return Fault(f"{given.goals}: holds tasks of a report, not goals; add --report")
    if kind not in (None, "tasks" if given.report else "goals"):
        return Fault(f"{given.goals}: holds {HELD[kind]}, not {'tasks' if given.report else 'goals'}; {order}")
    if given.judge and kind_of(given.judge) not in (None, "layout"):
        return Fault(f"{given.judge}: is not a layout; {order}")
    return error
