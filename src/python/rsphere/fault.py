"""Faults in the input, and the numbers of text files, strictly read."""
import codecs
import contextlib
import os
import re
import warnings

from . import Error


class Fault(Error):
    """A fault in the input: one line that begins with the file and the line."""

    file = line = None
    cause = "input"


def fault(file, line, text):
    place = file if line is None else f"{file}:{line}"
    made = Fault("".join(c if c.isprintable() else "?" for c in f"{place}: {text}"))
    made.file, made.line = file, line
    return made


@contextlib.contextmanager
def needs_light(message):
    """Raises Fault with a message where rsphere warns of a scene without light sources."""
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message="no light sources")
        try:
            yield
        except UserWarning:
            raise Fault(message) from None


def fault_of(stderr):
    """The fault that a program of rsphere ended with, without the program's name."""
    return Fault(stderr.strip().split("\n")[-1].split(": fatal - ", 1)[-1])


def percent_hint(value, least, most):
    """What to write instead of a percentage where a share is asked for; nothing for other numbers."""
    return f"; {value:g}% is {value / 100:g}" if 0 <= least and most <= 1 and 1 < value <= 100 and least <= value / 100 <= most else ""


def warn_of_factor(value, name):
    """Warns of a factor on light that looks like a percentage."""
    if value > MOST_FACTOR:
        warnings.warn(f"{name} makes the light {value:g} times as bright{percent_hint(value, 0, 1)}", stacklevel=2)


# float() also reads nan, infinity, 1_000 and digits of other scripts.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
MOST_FACTOR = 10  # on light, before a warning: percentages are larger
LARGEST_FILE = 16 << 20  # bytes; photometric files have some 100 kB


def number(word, file, line, what, least=-1e12, most=1e12):
    """The number that a word is. Raises Fault if it is none, or beyond least or most."""
    shown = f'"{word[:40]}"'
    if not NUMBER.fullmatch(word):
        hint = "; decimals need a point" if re.fullmatch(r"[+-]?\d+,\d+", word, re.ASCII) else ""
        raise fault(file, line, f"{what} must be a number, not {shown}{hint}")
    value = float(word)
    if not least <= value <= most:
        raise fault(file, line, f"{what} must be from {least:g} to {most:g}, not {shown}{percent_hint(value, least, most)}")
    return value


def whole(word, file, line, what, least, most):
    value = number(word, file, line, what, least, most)
    if value != int(value):
        raise fault(file, line, f'{what} must be a whole number, not "{word[:40]}"')
    return int(value)


class Numbers:
    """Reads the numbers of a file in turn. A subclass has text(what): the next one's text, whose line is then self.line of self.file."""

    def number(self, what, least=-1e9, most=1e9):
        return number(self.text(what), self.file, self.line, what, least, most)

    def whole(self, what, least, most):
        return whole(self.text(what), self.file, self.line, what, least, most)

    def numbers(self, count, what, least, most):
        return [self.number(f"{what} {i + 1} of {count}", least, most) for i in range(count)]


def write_text(path, text, encoding="utf-8", errors="replace"):
    try:
        with open(path, "w", encoding=encoding, errors=errors) as stream:
            stream.write(text)
    except OSError as error:
        raise fault(path, None, f"cannot be written: {error.strerror}") from None
    return path


def make_folder(path):
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise fault(path, None, f"cannot be made: {error.strerror}") from None


def lines_of(file, encoding="latin-1", errors="strict"):
    """The lines of a text file without their ends, LF or CR LF, the mark of UTF-8 before them, and DOS's Ctrl-Z behind them."""
    try:
        with open(file, "rb") as stream:
            data = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise fault(file, None, f"cannot be read: {error.strerror}") from None
    if len(data) > LARGEST_FILE:
        raise fault(file, None, f"is larger than {LARGEST_FILE >> 20} MB")
    if b"\0" in data:
        raise fault(file, data[: data.index(b"\0")].count(b"\n") + 1, "is not a text file")
    data = data.removeprefix(codecs.BOM_UTF8).rstrip(b"\x1a")
    text = data.decode(encoding, errors).replace("\r\n", "\n").replace("\r", "\n")
    return text.split("\n")
