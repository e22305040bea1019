"""What tests of the package share. Commands run in the process of a test: to load NumPy and SciPy takes longer than to find a fault."""
import contextlib
import io
import os
import runpy
import subprocess
import sys
import tempfile
import unittest
import unittest.mock


PROGRAMS = os.environ["PROGRAMS"]


class InAFolder(unittest.TestCase):
    """Tests that write files, each test in a folder of its own."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def file(self, data, name="lamp.ies"):
        path = os.path.join(self.folder.name, name)
        with open(path, "wb") as stream:
            stream.write(data if isinstance(data, bytes) else data.encode("latin-1"))
        return path


def built(name):
    """The path of a command of the build."""
    return os.path.join(PROGRAMS, name)


def run_here(words):
    """Runs the command words[0] as subprocess.run() would, its text captured."""
    with contextlib.redirect_stdout(io.TextIOWrapper(io.BytesIO())) as out, contextlib.redirect_stderr(io.StringIO()) as err:
        status = 0
        try:
            with unittest.mock.patch.multiple(sys, argv=words, path=["", *sys.path]):
                runpy.run_path(words[0], run_name="__main__")
        except SystemExit as end:
            status = end.code or 0
            if isinstance(status, str):
                err.write(status + "\n")
                status = 1
        out.seek(0)
        return subprocess.CompletedProcess(words, status, out.read(), err.getvalue())
