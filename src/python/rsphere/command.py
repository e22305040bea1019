"""What the commands of this package share: their options, messages and ends, and where the programs of rsphere are."""
import argparse
import importlib
import os
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


class Options(argparse.ArgumentParser):
    """The options of a command, with help as rsphere prints it. words: what follows the options; text: what is behind the list."""

    def __init__(self, words, text=""):
        from . import __version__

        super().__init__(prog=os.path.basename(sys.argv[0]), add_help=False, allow_abbrev=False)
        self.words, self.text = words, text
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

    def error(self, message):
        from .fault import Fault

        raise Fault(f"command line error: {message}; see -help")


def need(module, package):
    try:
        importlib.import_module(module)
    except ImportError:
        sys.exit(f"{os.path.basename(sys.argv[0])}: fatal - Python's module {module} is missing; on Debian: apt install {package}")


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
    sys.stdout.reconfigure(errors="replace")  # names in the room may be bytes of another encoding
    try:
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
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # what Python writes when it ends
        return 1
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
