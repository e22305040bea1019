"""What calls of a Scene return."""
from types import SimpleNamespace

import numpy as np


class Answers(SimpleNamespace):
    """Arrays by name, with a row for each record; None for what was not asked for. vars() lists all."""

    def __repr__(self):
        arrays = {name: value for name, value in vars(self).items() if value is not None}
        shown = ", ".join(f"{name} {value.shape}" if isinstance(value, np.ndarray) else f"{name} [{len(value)}]" for name, value in arrays.items())
        return f"rsphere.Answers: {shown}"


Answers.__module__ = "rsphere"
