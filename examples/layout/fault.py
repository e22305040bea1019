"""Faults in the input, and the numbers of text files, strictly read."""
import re
import sys


class Fault(Exception):
    """A fault in the input: one line that begins with the file and the line."""


def fault(file, line, text):
    place = file if line is None else f"{file}:{line}"
    return Fault("".join(c if c.isprintable() else "?" for c in f"{place}: {text}"))


# float() also reads nan, infinity, 1_000 and digits of other scripts.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
LARGEST_FILE = 16 << 20  # bytes; photometric files have some 100 kB


def number(word, file, line, what, least=-1e12, most=1e12):
    """The number that a word is. Raises Fault if it is none, or beyond least or most."""
    shown = f'"{word[:40]}"'
    if not NUMBER.fullmatch(word):
        hint = "; decimals need a point" if re.fullmatch(r"[+-]?\d+,\d+", word, re.ASCII) else ""
        raise fault(file, line, f"{what} must be a number, not {shown}{hint}")
    value = float(word)
    if not least <= value <= most:
        raise fault(file, line, f"{what} must be from {least:g} to {most:g}, not {shown}")
    return value


def whole(word, file, line, what, least, most):
    value = number(word, file, line, what, least, most)
    if value != int(value):
        raise fault(file, line, f'{what} must be a whole number, not "{word[:40]}"')
    return int(value)


def lines_of(file):
    """The lines of a text file without their ends, LF or CR LF. Characters beyond ASCII are taken for Latin-1."""
    try:
        with open(file, "rb") as stream:
            data = stream.read(LARGEST_FILE + 1)
    except OSError as error:
        raise fault(file, None, f"cannot be read: {error.strerror}") from None
    if len(data) > LARGEST_FILE:
        raise fault(file, None, f"is larger than {LARGEST_FILE >> 20} MB")
    if b"\0" in data:
        raise fault(file, data[: data.index(b"\0")].count(b"\n") + 1, "is not a text file")
    text = data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n")
    return text.split("\n")


def run_program(main):
    """Runs main(), and prints a fault as one line."""
    try:
        return main()
    except Fault as text:
        sys.exit(f"{sys.argv[0].rsplit('/', 1)[-1]}: {text}")
    except BrokenPipeError:
        sys.exit(1)
