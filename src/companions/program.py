"""What rsphere-compare and rsphere-trade are as programs: their messages, signals, and the programs that they run."""
import ctypes
import errno
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
from typing import NamedTuple

# The class of an error, as rsphere names it, and its exit status.
STATUS = {"fatal": 1, "system": 2, "signal": 3}
# Signals that end a program, by rsphere's words.
SIGNALS = {signal.SIGINT: "Interrupt", signal.SIGHUP: "Hangup", signal.SIGTERM: "Terminate", signal.SIGALRM: "Alarm clock",
           signal.SIGXCPU: "CPU limit exceeded", signal.SIGXFSZ: "File size exceeded"}
LONGEST_WORD, LONGEST_MESSAGE = 500, 4000
PR_SET_PDEATHSIG = 1
# What rsphere says at the end of a run of its records, of which repeats are many.
SUMMARY = re.compile(r"(no light reaches |-Sa: )?\d+ of \d+ ")
NO_SOURCES = "no light sources found"
C_LIBRARY = ctypes.CDLL(None)


class Fault(Exception):
    """Ends the program with a message of this kind, a key of STATUS."""

    def __init__(self, text, kind="fatal"):
        super().__init__(text)
        self.kind = kind


def system_fault(what, error):
    return Fault(f"{what}: {error.strerror}", "system")


def printable(text):
    """One line that no terminal interprets as a command; what is not printable becomes \\x1b and the like."""
    def shown(c):
        return c if c.isprintable() or c == " " else "".join(f"\\x{byte:02x}" for byte in os.fsencode(c))
    words = ("".join(map(shown, text)).rstrip()).split(" ")
    half = (LONGEST_WORD - 3) // 2
    return " ".join(w if len(w) <= LONGEST_WORD else f"{w[:half]}...{w[-half:]}" for w in words)[:LONGEST_MESSAGE]


class Messages:
    """Lines on standard error, or in the file of -e, that begin with the program's name."""

    def __init__(self, program):
        self.program, self.descriptor, self.warns = program, 2, True
        self.warnings = []  # those that were written, each once

    def use(self, warns, error_file, command):
        self.warns = warns
        if not error_file:
            return
        try:
            self.descriptor = os.open(error_file, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o666)
        except OSError as error:
            raise system_fault(f'cannot open error file "{error_file}"', error) from None
        os.write(self.descriptor, os.fsencode(f"**************\n*** PID {os.getpid():5}: {command}\n\n"))

    def report(self, text):
        os.write(self.descriptor, os.fsencode(f"{self.program}: {printable(text)}\n"))

    def warning(self, text):
        if self.warns and text not in self.warnings:
            self.warnings.append(text)
            self.report(f"warning - {text}")

    def of_rsphere(self, lines, name="stdin", of_rays=False):
        """Passes the warnings of rsphere on. Raises its error. name: of the file that is its standard input. of_rays: leaves out
        rtrace's warning of scenes that only glow, which are not dark."""
        for line in lines.decode(errors="surrogateescape").splitlines():
            found = re.match(r"\S+: (warning|fatal|system|signal) - (.*)", line)
            if not found:
                continue
            text = re.sub(r"^stdin\b", lambda _: name, found[2])
            if found[1] != "warning":
                raise Fault(text, found[1])
            if not SUMMARY.match(text) and not (of_rays and text == NO_SOURCES):
                self.warning(text)


def catch_signals():
    """The first signal raises Fault; further ones, while the program reports what it has, do nothing."""
    caught = [number for number in SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]

    def end(number, _):
        for each in caught:
            signal.signal(each, signal.SIG_IGN)
        raise Fault(SIGNALS[number], "signal")
    for number in caught:
        signal.signal(number, end)


def run_program(program, body, fault_status=0):
    """Calls body(messages) and returns the exit status of the program. fault_status: of all errors except signals, if not 0."""
    messages = Messages(program)
    try:
        catch_signals()
        if sys.stdout is None:  # it was closed; the next file opened would take its place
            raise Fault(f"write error: {os.strerror(errno.EBADF)}", "system")
        return body(messages)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        return STATUS["signal"]  # as in rtrace
    except (Fault, MemoryError) as error:
        fault = error if isinstance(error, Fault) else Fault("out of memory", "system")
        messages.report(f"{fault.kind} - {fault}")
        return fault_status if fault_status and fault.kind != "signal" else STATUS[fault.kind]


def write_output(text):
    try:
        sys.stdout.buffer.write(os.fsencode(text))
        sys.stdout.buffer.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # Python would try again when it ends
        raise system_fault("write error", error) from None


def write_file(name, data):
    try:
        with open(name, "wb") as stream:
            stream.write(data.encode(errors="replace") if isinstance(data, str) else data)
    except OSError as error:
        raise system_fault(f'cannot write "{name}"', error) from None


def read_file(name):
    """The bytes of a file; "-": of standard input."""
    try:
        with open(0 if name == "-" else name, "rb", closefd=name != "-") as stream:
            return stream.read()
    except OSError as error:
        raise system_fault(f'cannot open "{name}"', error) from None


def program_beside(name):
    """rsphere and what belongs to it are where this program was called or is installed, or on PATH."""
    called = os.path.abspath(sys.argv[0])
    for folder in (os.path.dirname(called), os.path.dirname(os.path.realpath(called))):
        if os.access(os.path.join(folder, name), os.X_OK):
            return os.path.join(folder, name)
    return shutil.which(name) or name


def start(words, **streams):
    """Starts a program that is terminated if this one ends first."""
    try:
        return subprocess.Popen(words, stderr=subprocess.PIPE,
                                preexec_fn=lambda: C_LIBRARY.prctl(PR_SET_PDEATHSIG, signal.SIGTERM), **streams)
    except OSError as error:
        raise system_fault(f"cannot run {words[0]}", error) from None


class Ended(NamedTuple):
    """A program that has ended. seconds: of CPU time, with those of the programs that it ran."""

    status: int
    output: bytes
    errors: bytes
    seconds: float


def seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(words, data=b"", descriptors=()):
    """Runs a program to its end. data: its standard input; descriptors: further files that it may open."""
    before = seconds_of_children()
    child = start(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, pass_fds=descriptors)
    try:
        output, errors = child.communicate(data)
    except BaseException:
        child.kill()
        child.wait()
        raise
    return Ended(child.returncode, output, errors, seconds_of_children() - before)


class MemoryFile:
    """A file without a name, so that nothing remains if the program is killed. Programs that run() starts open its path."""

    def __init__(self, data):
        self.descriptor = os.memfd_create("rsphere")
        self.path = f"/proc/self/fd/{self.descriptor}"
        with open(self.descriptor, "wb", closefd=False) as stream:
            stream.write(data)


def cpu_seconds(process):
    """CPU time so far of a process that still runs: the clock of clock_getcpuclockid(3)."""
    return time.clock_gettime(~process << 3 | 2)


def date_and_time(when):
    """Local time with the name of its zone: "2026-11-23 14:05 CET"."""
    return time.strftime("%Y-%m-%d %H:%M %Z", time.localtime(when))
