"""What the commands of this package share: their options, messages and ends, and where the programs of rsphere are."""
import argparse
import difflib
import errno
import importlib
import os
import re
import sys
import warnings

HERE = os.path.dirname(os.path.abspath(__file__))
INTERRUPTED = 3  # the status after Ctrl-C


def program(name):
    """The path of a program of rsphere: from the folder that PROGRAMS names, the build, the installation, or PATH."""
    for folder in (os.environ.get("PROGRAMS"), *(os.path.join(HERE, "../..", f) for f in ("bin", "../../lib/rsphere/bin", "../../bin"))):
        if folder and os.access(os.path.join(folder, name), os.X_OK):
            return os.path.join(folder, name)
    return name


def noting(kind):
    """A kind of argparse's actions whose options are noted by Options."""
    class Noting(kind):
        def __call__(self, parser, namespace, values, option_string=None):
            if self.option_strings:
                parser.note(self, values, option_string)
            super().__call__(parser, namespace, values, option_string)
    return Noting


class Options(argparse.ArgumentParser):
    """The options of a command, with help as rsphere prints it. words: what follows the options; text: what is behind the list.

    As in rsphere, the last one holds of options of one value; a warning says so if they differ.
    """

    def __init__(self, words, text=""):
        from . import __version__

        super().__init__(prog=os.path.basename(sys.argv[0]), add_help=False, allow_abbrev=False)
        self.words, self.text, self.noted = words, text, {}
        for name in ("store", "store_const", "store_true", "append"):
            self.register("action", name, noting(self._registry_get("action", name)))
        self.register("action", None, self._registry_get("action", "store"))
        self.add_argument("-h", "-help", "--help", action="help", help="this list")
        self.add_argument("-version", "--version", action="version", version=f"rsphere {__version__}", help="of rsphere")

    def format_help(self):
        lines = [f"usage: {self.prog} [options] {self.words}".rstrip(), ""]
        for action in self._actions:
            if not action.option_strings:
                continue
            names = ", ".join(action.option_strings) + (f" {action.metavar}" if action.metavar else "")
            value = " ".join(action.default) if isinstance(action.default, list) else action.default
            default = f" [{value}]" if action.nargs != 0 and value not in (None, "") else ""
            lines.append(f"  {names:<24} {action.help}{default}")
        return "\n".join([*lines, "", self.text]).rstrip() + "\n"

    def parse_known_args(self, args=None, namespace=None):
        self.refuse_unknown(sys.argv[1:] if args is None else args)
        return super().parse_known_args(args, namespace)

    def parse_intermixed_args(self, args=None, namespace=None):  # calls parse_known_args() only before Python 3.13
        self.refuse_unknown(sys.argv[1:] if args is None else args)
        return super().parse_intermixed_args(args, namespace)

    def refuse_unknown(self, args):
        """Refuses unknown options at once, with the nearest name: argparse would read -time as -t ime."""
        for name in (word.split("=")[0] for word in (args[: args.index("--")] if "--" in args else args)):
            if re.match("--.|-[A-Za-z]{2}", name) and name not in self._option_string_actions:
                near = difflib.get_close_matches(name.lstrip("-"), [known.lstrip("-") for known in self._option_string_actions], 1, 0.65)
                hint = "".join(f'; the nearest is "{known}"' for known in self._option_string_actions if near == [known.lstrip("-")])
                self.fail(f"command line error at '{name}': there is no such option{hint}; see -help")

    def note(self, action, value, option):
        if action.dest in self.noted and self.noted[action.dest][1] != value and not isinstance(action, argparse._AppendAction):
            print(f"{self.prog}: warning - {option} is given twice; the last, {value}, holds", file=sys.stderr)
        self.noted[action.dest] = option, value

    def refuse(self, names, why):
        """Raises Fault if one of these options was given, which would change nothing."""
        for option, _ in (self.noted[name] for name in names if name in self.noted):
            self.fail(f"{option} {why}")

    def limit(self, given, *ranges):
        """Raises Fault for a number that is not within its range: name, least and most."""
        from .fault import percent_hint

        for name, least, most in ranges:
            value = getattr(given, name)
            if value is not None and not least <= value <= most:
                self.fail(f"--{name.replace('_', '-')} must be from {least:g} to {most:g}{percent_hint(value, least, most)}")

    def error(self, message):
        self.fail(f"command line error: {message}; see -help")

    def fail(self, text):
        from .fault import Fault

        raise Fault(text)


def need(module, package):
    try:
        importlib.import_module(module)
    except ImportError:
        sys.exit(f"{os.path.basename(sys.argv[0])}: fatal - Python's module {module} is missing; on Debian: apt install {package}")


def discard_output():
    """What Python would write when it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def run_program(main):
    """Runs main(), and prints a fault as one line. Warnings of the module rsphere are one line, too."""
    from . import Error
    from .progress import PROGRESS

    name = os.path.basename(sys.argv[0])

    shown = set()

    def show_warning(message, *_):
        if str(message) in shown:
            return  # several scenes are made of the same files
        shown.add(str(message))
        PROGRESS.clear()
        print(f"{name}: warning - {message}", file=sys.stderr)

    warnings.showwarning = show_warning
    try:
        if sys.stdout is None:  # it was closed; the next file opened would take its place
            raise OSError(errno.EBADF, os.strerror(errno.EBADF))
        sys.stdout.reconfigure(errors="replace")  # names in the room may be bytes of another encoding
        status = main()
        sys.stdout.flush()
        return status
    except Error as error:
        PROGRESS.clear()
        print(f"{name}: fatal - {error}", file=sys.stderr)
        return 2 if error.cause == "system" else 1
    except KeyboardInterrupt:
        PROGRESS.clear()
        print(f"{name}: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        discard_output()
        return 1
    except OSError as error:  # a full disk
        PROGRESS.clear()
        print(f"{name}: system - {error.filename or 'write error'}: {error.strerror}", file=sys.stderr)
        discard_output()
        return 2
    finally:
        PROGRESS.clear()


def run(part, *needs):
    """Runs the command of a part of the package."""
    need("numpy", "python3-numpy")
    for module, package in needs:
        need(module, package)
    sys.exit(run_program(importlib.import_module(f"rsphere.{part}.command").main))


def annual():
    run("annual")


def layout():
    run("layout", ("scipy", "python3-scipy"))


def luminaire():
    run("photometry")
