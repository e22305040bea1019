"""The command lines of rsphere-compare and rsphere-trade: options of their own, and those of rsphere, which rsphere reads."""
import errno
import math
import os
import re
import shlex
from array import array
from typing import NamedTuple

from .program import Fault, MemoryFile, program_beside, read_file, run, write_output

SWITCHED = dict.fromkeys("+1yYtT", True) | dict.fromkeys("-0nNfF", False)
MOST_EXPANDED = 4096  # words; it also ends a file that names itself
# Options that choose what is written, and how.
OF_OUTPUT = ("-o*", "-f*", "-co", "-h", "-x", "-y", "-t", "-Sd", "-Sf", "-Sl", "-Sz", "-Szb", "-Szn", "-Si", "-Siw", "-Siv", "-Sih", "-Sie")
# Nothing is computed in it: for runs of rsphere that only read records.
LAMP = b"void light l 0 0 3 1 1 1 l sphere s 0 0 4 0 0 0 1\n"


class Own(NamedTuple):
    """An option of a companion. Its default has the type of its value."""

    name: str
    argument: str
    remark: str  # of a switch "on|off"
    default: object
    lowest: float = -math.inf
    highest: float = math.inf
    unit: str = ""
    points_only: bool = False

    def help_line(self):
        is_switch = isinstance(self.default, bool)
        use = self.name + ("[+|-]" if is_switch else f" {self.argument}")
        value = ("off", "on")[self.default] if is_switch else short(self.default)
        return f"  {use:<20} {self.remark.split(' on|')[0]}" + (f" [{value}]" if value else "") + "\n"

    def line(self, value):
        """The line of -defaults."""
        if isinstance(value, bool):
            return f"{self.name}{'-+'[value]}\t\t\t\t# {self.remark.split('|')[not value]}\n"
        if value == "":
            return ""
        text = f"{value:<9}\t" if isinstance(value, int) else f"{value:f}\t" if isinstance(value, float) else value
        return f"{self.name} {text}\t\t# {self.remark}\n"


class Companion(NamedTuple):
    program: str
    usage: str
    needs: str  # what has to be on the command line besides options
    sphere_mode: bool  # without -S
    own: list


class Used(NamedTuple):
    """An option of rsphere on a command line. group: its section in "rsphere -help all"."""

    name: str
    group: str
    words: list


def short(value):
    return f"{value:.15g}" if isinstance(value, float) else str(value)


def shell_line(words):
    """A command line for a POSIX shell: words in single quotes unless all of their characters are ordinary."""
    return " ".join(w if re.fullmatch(r"[-\w./,:=@%+]+", w, re.ASCII) else "'" + w.replace("'", "'\\''") + "'" for w in words)


def line_error(at, why):
    return Fault(f"command line error at '{at}': {why}; see -help")


def rsphere(words, data=b"", descriptors=()):
    return run([program_beside("rsphere"), *words], data, descriptors)


def option_table():
    """The options of rsphere: name, number of words behind it, and group, from the list that rsphere prints."""
    table, group = {}, ""
    for line in rsphere(["-help", "all"]).output.decode().splitlines():
        if line.endswith(":"):
            group = line[:-1]
        elif found := re.match(r"  (-[A-Za-z]+)(\[\+\|-\])?((?: \S+)*?)  ", line):
            name = found[1]
            if name == "-fio" or name == "-ospec":  # the value is in the same word
                name = name[:2] + "*"
            table[name] = len(found[3].split()), group
    return table


def find(table, word):
    """The name in the table of an option, which may end with its value or the state of a switch."""
    if word in table:
        return word
    if word[:2] + "*" in table:
        return word[:2] + "*"
    return next((word[:n] for n in range(len(word), 1, -1) if word[:n] in table), word)


def number_of(option, word):
    """The number that a word is, within the option's range. Raises Fault."""
    whole = isinstance(option.default, int)
    bounds = f" from {short(option.lowest)} to {short(option.highest)}"
    try:
        if not re.fullmatch(r"[+-]?\d+" if whole else r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", word, re.ASCII):
            raise ValueError
        value = int(word) if whole else float(word)
    except ValueError:
        raise line_error(option.name, f'"{word}" is not a {"whole " if whole else ""}number{bounds}') from None
    if not option.lowest <= value <= option.highest:
        hint = f": {short(value)}% is written {short(value / 100)}" if option.highest == 1 and value > 1 else ""
        raise line_error(option.name, f"{short(value)} is not{bounds}{hint}")
    return value


def take_own(option, word, rest):
    """The value of a companion's option, whose words are taken from rest."""
    if isinstance(option.default, bool):
        return SWITCHED.get(word[len(option.name):], not option.default)
    if not rest or not rest[0].strip():
        raise line_error(word, f"its value is missing ({option.name} {option.argument}): the command line ends")
    value = rest.pop(0)
    return value if isinstance(option.default, str) else number_of(option, value)


def expand(words, expanded):
    """Replaces @file and $VARIABLE at the beginning of words by what is in them. Returns the number of words so far."""
    while words and words[0][:1] in ("@", "$"):
        name = words[0]
        try:
            if name[0] == "@":
                with open(name[1:], "rb") as stream:
                    text = os.fsdecode(stream.read())
            else:
                text = os.environ[name[1:]]
            inside = shlex.shlex(text, posix=True, punctuation_chars="")
            inside.whitespace_split, inside.commenters, inside.escape = True, "", ""
            words[:1] = inside
        except (OSError, KeyError):
            raise Fault(f"cannot expand '{name}': {os.strerror(errno.ENOENT)}", "system") from None
        except ValueError as error:  # an unclosed quote
            raise Fault(f"cannot expand '{name}': {error}") from None
        expanded += len(words)
        if expanded > MOST_EXPANDED:
            raise Fault(f"cannot expand '{name}': too many words")
    return expanded


class CommandLine:
    """A command line, read. own: the values of the companion's options by name; used: the options of rsphere; scene: its files;
    records: the file of records; settings: what rsphere says by -defaults with these options. Raises Fault."""

    def __init__(self, companion, words, messages):
        self.companion, self.messages = companion, messages
        self.own = {option.name: option.default for option in companion.own}
        self.own_given = []
        self.given, self.request, self.table = list(words), None, option_table()
        if words[:1] == ["-features"]:
            self.request = words
            return
        self.used, rest = self.split(words, companion.own)
        self.scene = rest
        self.settings = Settings(self.defaults(self.words()))
        error_file = next((u.words[1] for u in self.used if is_error_file(u)), "")
        messages.use(self.settings.on("-w"), error_file, " ".join([companion.program, *words]))
        if self.request:
            return
        for option in self.own_given:
            if option.points_only and not self.settings.sphere_mode:
                raise line_error(option.name, "needs sphere mode (-S+): it has no effect on rays")
        for word in rest:
            if word.startswith("-") and len(word) > 1:
                raise line_error(rest[0], f"the scene begins here, but '{word}' follows; options come before the scene")
        if len(rest) < 2:
            raise Fault(f"missing argument: {companion.needs} are needed; see -help")
        self.records = rest.pop()

    def split(self, words, own=()):
        """The options of rsphere at the beginning of words, and the words behind them. own: options of the companion, which are set."""
        used, rest = [], list(words)
        expanded = expand(rest, 0)
        while rest and rest[0].startswith("-") and not self.request:
            word = rest.pop(0)
            option = next((o for o in own if word == o.name or
                           isinstance(o.default, bool) and word[:-1] == o.name and word[-1] in SWITCHED), None)
            if word.lstrip("-") in ("help", "version", "defaults"):
                self.request = [word.replace("--", "-")]
            elif option:
                self.own[option.name] = take_own(option, word, rest)
                self.own_given.append(option)
            else:
                name = find(self.table, word)
                count, group = self.table.get(name, (0, ""))
                if word != name:  # the value, or the state of a switch, is in the word itself
                    count = 0
                used.append(Used(name, group, [word, *rest[:count]]))
                del rest[:count]
            expanded = expand(rest, expanded)
        return used, rest

    def words(self, *without):
        """The words of rsphere's options, but for some by name. They begin with the mode of the companion."""
        mode = [] if self.companion.sphere_mode else ["-S-"]
        return mode + [w for u in self.used if u.name not in without and not is_error_file(u) for w in u.words]

    def words_of_answers(self, *without):
        """Those that affect answers, but for some by name."""
        return self.words(*without, *OF_OUTPUT, *(u.name for u in self.used if u.name.startswith("-p")))

    def gave(self, name):
        return any(u.name == name for u in self.used)

    def defaults(self, words):
        """The lines of -defaults with these options. Raises Fault for options that rsphere refuses."""
        ended = rsphere([*words, "-defaults"])
        self.messages.of_rsphere(ended.errors)
        return ended.output.decode(errors="surrogateescape").splitlines()

    def answer_request(self):
        """Prints what -help and the like ask for. Returns the exit status."""
        companion = self.companion
        if self.request[0] == "-help":
            write_output(f"usage: {companion.program} {companion.usage}\n\n" + "".join(o.help_line() for o in companion.own) +
                         f"\nThe other options are those of rsphere: see rsphere -help and {companion.program}(1).\n")
        elif self.request[0] == "-defaults":
            write_output("".join(line + "\n" for line in self.settings.lines) +
                         "".join(option.line(self.own[option.name]) for option in companion.own))
        else:
            ended = rsphere(self.request)
            write_output(os.fsdecode(ended.output))
            for line in ended.errors.decode(errors="surrogateescape").splitlines():
                self.messages.report(line.split(": ", 1)[-1])
            return ended.status
        return 0

    def rsphere_version(self):
        return os.fsdecode(rsphere(["-version"]).output).split()[-1]

    def given_line(self):
        return shell_line([self.companion.program, *self.given])


def is_error_file(used):
    """Whether this is -e with a file of messages; with an expression, it defines a variable or a function."""
    return used.name == "-e" and len(used.words) > 1 and not re.search("[=:]", used.words[1])


class Settings:
    """Values of rsphere's options, from the lines of -defaults."""

    def __init__(self, lines):
        self.lines, self.values = lines, {}
        for line in lines:
            name, *values = line.split("#", 1)[0].split()
            self.values[name] = values
            if name[:2] == "-f" and not values:
                self.input_format = name[2]
        self.sphere_mode = self.on("-S")
        bands = int(self.values.get("-cs", ["3"])[0])
        self.bands = bands if bands > 3 else 0  # of a spectral run; otherwise 0

    def on(self, name):
        return name + "+" in self.values

    def number(self, name):
        return float(self.values[name][0])

    @property
    def per_record(self):
        return 3 if self.sphere_mode else 6


def read_records(name, settings, messages):
    """The numbers of all records in a file, in the format of -f. rsphere itself reads them first, and refuses what it would."""
    data = read_file(name)
    shown = "stdin" if name == "-" else name
    lamp = MemoryFile(LAMP)
    mode = "-S+" if settings.sphere_mode else "-S-"
    ended = rsphere([mode, f"-f{settings.input_format}d", "-h-", "-oo", lamp.path], data, (lamp.descriptor,))
    try:
        messages.of_rsphere(ended.errors, shown)
    except Fault as fault:
        # The first word is none of the numbers: the file may be the scene.
        if ended.output or fault.kind != "fatal" or not str(fault).endswith('"'):
            raise
        raise Fault(f"{fault}; the file of records is the last argument, after the scene") from None
    if b"printable characters" in ended.errors:
        raise Fault(f"{shown}: the first record of -f{settings.input_format} consists of printable characters: "
                    "use -fa to read text")
    if settings.input_format == "a":
        numbers = array("d", map(float, data.removeprefix(b"\xef\xbb\xbf").split()))
    else:
        numbers = array(settings.input_format)
        numbers.frombytes(data)
        numbers = array("d", numbers)
    if not numbers:
        raise Fault(f"{shown}: no records")
    return numbers
