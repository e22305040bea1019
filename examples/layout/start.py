"""Finds NumPy and the module rsphere. Imported first."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
DEBIAN = "/usr/bin/python3"  # for which Debian's packages are, also where another Python is first on PATH


def other_python():
    """Starts again with Debian's Python, unless it runs already."""
    if os.path.exists(DEBIAN) and os.path.realpath(sys.executable) != os.path.realpath(DEBIAN):
        os.execv(DEBIAN, [DEBIAN] + sys.argv)


def need(module, package):
    try:
        __import__(module)
    except ImportError:
        other_python()
        sys.exit(f"{os.path.basename(sys.argv[0])}: Python's module {module} is missing; on Debian: apt install {package}")


need("numpy", "python3-numpy")


def need_rsphere():
    """For what computes: SciPy, and rsphere from where it is built, installed, or from PYTHONPATH."""
    need("scipy", "python3-scipy")
    sys.path.append(os.path.join(HERE, "../../build/python"))
    try:
        import rsphere
    except ImportError as error:
        other_python()
        sys.exit(f"{os.path.basename(sys.argv[0])}: the module rsphere cannot be loaded ({error}); `.ci/packages python` and the "
                 "build of examples/python/README.md make it")
    return rsphere
