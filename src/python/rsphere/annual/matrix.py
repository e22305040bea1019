"""Reads coefficient matrices, as rcontrib and rfluxmtx write them."""
import math

import numpy as np

from ..fault import fault
from .passes import VISIBLE

FORMATS = {b"ascii": None, b"float": "f4", b"double": "f8"}
LARGEST_SUM = 1.1 * math.pi  # the sum of a sensor without noise is at most pi
HEADER = "coefficients are the output of rcontrib -y N or of rfluxmtx, with its header"


def header_of(path, data):
    """The words of the header, and what is behind it."""
    header, end, numbers = data.partition(b"\n\n")
    words = dict(line.strip().split(b"=", 1) for line in header.split(b"\n") if b"=" in line)
    if not end or words.get(b"FORMAT") not in FORMATS:
        raise fault(path, None, f"has no header with FORMAT=ascii, float or double: {HEADER}")
    return words, numbers


def numbers_of(path, words, data, count):
    """The numbers behind the header."""
    kind = FORMATS[words[b"FORMAT"]]
    if kind is None:
        try:
            numbers = np.array(data.replace(b"_", b"?").split(), float)  # float() reads 1_000
        except ValueError as error:
            word = str(error).partition(": b")[2].strip("'")[:40]
            raise fault(path, None, f'has a coefficient that is not a number: "{word}"') from None
        if len(numbers) != count:
            raise fault(path, None, f"has {len(numbers)} coefficients, not {count}")
        return numbers
    if words.get(b"BigEndian", b"0") not in (b"0", b"1"):
        raise fault(path, None, "its BigEndian= must be 0 or 1")
    size = np.dtype(kind).itemsize * count
    if len(data) != size:
        raise fault(path, None, f"has {len(data)} bytes of coefficients, not {size}")
    return np.frombuffer(data, (">" if words.get(b"BigEndian") == b"1" else "<") + kind)


def read_coefficients(path):
    """Illuminances for radiance 1, sensors by bins, and the factor of reinhart.cal. Raises Fault."""
    try:
        with open(path, "rb") as file:
            words, data = header_of(path, file.read())
    except OSError as error:
        raise fault(path, None, f"cannot be read: {error.strerror}") from None
    shape = []
    for name in (b"NROWS", b"NCOLS", b"NCOMP"):
        word = words.get(name, b"")
        if not word.isdigit() or not 0 < len(word) < 10 or not int(word):
            raise fault(path, None, f"its header lacks {name.decode()}=, a whole number: {HEADER}")
        shape.append(int(word))
    sensors, bins, channels = shape
    if channels not in (1, 3):
        raise fault(path, None, f"has coefficients of NCOMP={channels}, not of red, green and blue (3) or of one channel (1)")
    factor = round(math.sqrt(max(1, (bins - 2) / 144)))
    if bins != 144 * factor * factor + 2:
        raise fault(path, None, f"has {bins} bins, but reinhart.cal has 146, 578, 1298, 2306 and so on")
    coefficients = numbers_of(path, words, data, sensors * bins * channels).reshape(shape)
    if not np.isfinite(coefficients).all():
        raise fault(path, None, "has a coefficient that is not a finite number")
    if (coefficients < 0).any():
        raise fault(path, None, "has a coefficient below 0")
    visible = coefficients @ (VISIBLE if channels == 3 else np.ones(1))
    most = visible.sum(axis=1).max()
    if most > LARGEST_SUM:
        raise fault(path, None, f"has a sensor whose coefficients add up to {most:.3g}, more than pi: they must be irradiances for a radiance of 1 (rcontrib -I)")
    return visible, factor
