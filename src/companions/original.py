"""RADIANCE's rtrace, which runs as a child process."""
import os
import re
from array import array

from .command_line import rsphere
from .program import Fault, MemoryFile, run, system_fault

HELP = "put the folder of RADIANCE's programs on PATH, or set RTRACE=/path/to/rtrace"
# Sections of rsphere's options that affect rays, and single options of others.
OF_RAYS = ("Direct light", "Highlights", "Indirect light", "Limits of a path", "Medium")
MORE_OF_RAYS = ("-I", "-i", "-ld", "-u", "-bv", "-f", "-e")
LARGEST_HEADER = 1 << 16


def programs_named(name):
    """The paths of all programs of this name, in the order of PATH. A name that contains a slash is already a path."""
    if "/" in name:
        return [name]
    paths = (os.path.join(folder or ".", name) for folder in os.environ.get("PATH", "/usr/local/bin:/usr/bin:/bin").split(":"))
    return [path for path in paths if os.access(path, os.X_OK) and os.path.isfile(path)]


def first_line(data):
    return data.decode(errors="surrogateescape").split("\n")[0]


def result_of(words, data=b"", descriptors=()):
    """What a program answers. Raises Fault if it fails."""
    ended = run(words, data, descriptors)
    if ended.status != 0:
        status = ended.status if ended.status > 0 else 128 - ended.status
        raise Fault(f"{words[0]} ends with status {status}: {first_line(ended.errors)}", "system")
    return ended


def find_original():
    """Path and version of the original: $RTRACE, a path or a name on PATH, if it is set; otherwise the first rtrace on PATH whose
    -version does not name rsphere. Raises Fault if there is none, with advice on how to set it."""
    asked = os.environ.get("RTRACE")
    ours = ""
    for path in programs_named(asked or "rtrace"):
        try:
            os.stat(path)
        except OSError as error:
            raise system_fault(f'$RTRACE: cannot run "{path}"', error) from None
        if not os.access(path, os.X_OK):
            raise Fault(f'$RTRACE: cannot run "{path}": Permission denied', "system")
        version = first_line(result_of([path, "-version"]).output)
        if "rsphere " not in version:
            return path, version
        ours = ours or path
    why = (f"{ours} is rsphere" if ours else f'$RTRACE names "{asked}", which is not on PATH' if asked else
           "there is none on PATH")
    raise Fault(f"no original rtrace: {why}; {HELP}", "system")


def original_options(line):
    """The options with which the original computes the quantities of a command line: those that affect rays rather than records, and
    in sphere mode those whose defaults differ from rtrace's. In a spectral run it writes bands (-co), otherwise red, green and blue."""
    words = []
    if line.settings.sphere_mode:
        of_rays = set(line.defaults(["-S-"]))
        for text in line.defaults([]):
            if text not in of_rays and not text.startswith("-S"):
                words += text.split("#", 1)[0].split()
    for used in line.used:
        if used.group in OF_RAYS or used.name in MORE_OF_RAYS and not (used.name == "-e" and not re.search("[=:]", used.words[1])):
            words += used.words
    if line.settings.bands:
        words += ["-cs", *line.settings.values["-cs"], "-cw", *line.settings.values["-cw"], "-co+"]
    return words


def is_octree(scene):
    """Whether the words of a scene are an octree, or a command that writes one; otherwise scene files."""
    if len(scene) != 1:
        return False
    if scene[0].startswith("!"):
        head = run(["/bin/sh", "-c", scene[0][1:]]).output[:LARGEST_HEADER]
    else:
        with open(scene[0], "rb") as stream:
            head = stream.read(LARGEST_HEADER)
    return head.startswith(b"#?") and b"\nFORMAT=Radiance_octree\n" in head.split(b"\n\n")[0] + b"\n"


class Original:
    """seconds: of CPU time, of all calls of answers(); octree_seconds: of oconv, None if the scene is an octree."""

    def __init__(self, path, scene, options):
        self.path, self.options, self.seconds = path, options, 0.0
        self.octree_seconds, self.descriptors, self.octree = None, (), scene[0]
        if is_octree(scene):
            return
        oconv = os.path.join(os.path.dirname(path), "oconv")
        if not os.access(oconv, os.X_OK):
            oconv = next(iter(programs_named("oconv")), None)
        if oconv is None:
            raise Fault(f"no oconv beside {path} or on PATH: give an octree as the scene", "system")
        ended = result_of([oconv, *scene])
        self.file, self.octree_seconds = MemoryFile(ended.output), ended.seconds
        self.octree, self.descriptors = self.file.path, (self.file.descriptor,)

    def run(self, options, rays, *more):
        """rays: array of six numbers for each."""
        return result_of([self.path, *options, "-h-", "-w-", *more, self.octree], rays.tobytes(), self.descriptors)

    def answers(self, rays, letters, per_ray):
        """per_ray numbers for each ray, selected by letters of -o. All come from a single run, so that equal rays get different
        random numbers."""
        ended = self.run(self.options, rays, "-fdd", "-o" + letters)
        self.seconds += ended.seconds
        wanted, found = len(rays) // 6 * per_ray, len(ended.output) // 8
        if len(ended.output) != 8 * wanted:
            raise Fault(f"{self.path} answered {found} numbers, not {wanted}", "system")
        numbers = array("d")
        numbers.frombytes(ended.output)
        return numbers

    def surfaces(self, rays):
        """The names of the surfaces hit by rays. -i needs an output of values."""
        options = [word for word in self.options if not re.fullmatch("-i.?", word)]
        return names_in(self.run(options, rays, "-fda", "-os").output, len(rays) // 6)


def names_in(output, count):
    names = [line.split("\t")[0] for line in output.decode(errors="surrogateescape").splitlines()][:count]
    return names + ["?"] * (count - len(names))


def rsphere_surfaces(words, scene, rays):
    """As Original.surfaces(), by rsphere."""
    return names_in(rsphere([*words, "-h-", "-w-", "-fda", "-os", *scene], rays.tobytes()).output, len(rays) // 6)
