"""rsphere-compare: answers records with rsphere and with RADIANCE's rtrace, and tells how they differ."""
import math
import time
from array import array

from .colors import RGB, bands_of_spectrum
from .command_line import LAMP, CommandLine, Companion, Own, read_records, rsphere
from .comparison import Answers, Verdict, compare
from .compare_page import Subject, compare_page
from .compare_report import equal_error_text, figures_text, histogram_text, warnings_text, write_differences
from .original import Original, find_original, original_options, rsphere_surfaces
from .program import Fault, MemoryFile, run_program, write_file, write_output

# As with cmp(1), all errors are TROUBLE, except a signal.
TROUBLE = 2
STATUS = {Verdict.SAME: 0, Verdict.SMALL: 0, Verdict.DIFFERS: 1, Verdict.UNDECIDED: 4}
COMPANION = Companion("rsphere-compare", "[options] scene... records", "a scene and a file of records", False, [
    Own("-Ct", "frac", "tolerance of relative differences", .01, 0, 1),
    Own("-Cs", "frac", "fraction of records that may exceed it", .001, 0, 1),
    Own("-Cr", "N", "repeats with other random numbers", 8, 2, 10000, "repeats"),
    Own("-Cn", "N", "rays of the original per point", 128, 8, 1000000, "rays", True),
    Own("-Cw", "N", "worst records shown", 5, 0, 1000000, "records"),
    Own("-Cp", "pic", "picture of the differences", ""),
    Own("-Ch", "file", "report as an HTML page", "")])


def without_bogus(rays):
    """Removes rays whose direction is zero: they make rtrace flush its output, and have no answer to compare."""
    kept = array("d")
    for i in range(0, len(rays), 6):
        if any(rays[i + 3:i + 6]):
            kept += rays[i:i + 6]
    return kept


def numbers_of(data):
    numbers = array("d")
    numbers.frombytes(data)
    return numbers


class Comparing:
    """Both programs, and what they answer."""

    def __init__(self, line):
        self.line, self.settings, self.repeats = line, line.settings, line.own["-Cr"]
        self.words, self.colors = line.words_of_answers(), RGB
        if self.settings.bands:
            shortest, longest = map(float, self.settings.values["-cw"])
            self.colors = bands_of_spectrum(self.settings.bands, shortest, longest)
            self.words.append("-co+")
        self.seconds = 0.0  # CPU time of rsphere

    def answers(self, records, numbers):
        count = len(self.colors.names)
        return Answers(records, self.repeats, [numbers[c::count] for c in range(count)], self.colors)

    def ask_rsphere(self, numbers, *more):
        ended = rsphere([*self.words, *more, "-h-", "-fdd", "-ov", *self.line.scene], numbers.tobytes())
        self.line.messages.of_rsphere(ended.errors, of_rays=not self.settings.sphere_mode)
        self.seconds += ended.seconds
        return numbers_of(ended.output)

    def ours(self, numbers):
        """Rays get other random numbers by their place in one run, points by other rotations of their directions."""
        if not self.settings.sphere_mode:
            return self.answers(len(numbers) // 6, self.ask_rsphere(numbers * self.repeats, "-u+"))
        first, found = int(self.settings.number("-Sr")), array("d")
        for r in range(self.repeats):
            found += self.ask_rsphere(numbers, "-Sr", str(first + r), *(["-w-"] if r > 0 else []))
        return self.answers(len(numbers) // 3, found)

    def original(self, program, numbers):
        """Runs the original once for all repeats: within a run, equal records get different random numbers."""
        channels = len(self.colors.names)
        if not self.settings.sphere_mode:
            return self.answers(len(numbers) // 6, program.answers(numbers * self.repeats, "v", channels))
        # The mean irradiance of planes of all orientations is F/4, which is pi times the mean radiance F/4pi.
        count, rays = self.line.own["-Cn"], array("d")
        for r in range(self.repeats):
            facing = rotated_directions(count, int(self.settings.number("-Sr")) + r + 1)
            for i in range(0, len(numbers), 3):
                for k in range(0, len(facing), 3):
                    rays += numbers[i:i + 3] + facing[k:k + 3]
        irradiances, means = program.answers(rays, "v", channels), array("d")
        for at in range(0, len(irradiances), count * channels):
            means.extend(sum(irradiances[at + c:at + count * channels:channels]) / (math.pi * count) for c in range(channels))
        return self.answers(len(numbers) // 3, means)

    def original_options(self):
        """In sphere mode those for the irradiance of planes. Gathering at the plane itself is a bounce in addition to those of -ab.
        Each plane needs only a few rays, because there are many planes."""
        words = original_options(self.line)
        if self.settings.sphere_mode:
            words += ["-I+", "-ab", str(int(self.settings.number("-ab")) + 1), "-ad", "16", "-as", "0"]
        return words

    def worst_text(self, comparison, ours, original, numbers, program):
        per, settings = self.settings.per_record, self.settings
        worst = comparison.worst[:self.line.own["-Cw"]]
        if not worst:
            return ""
        records = [numbers[per * i:per * (i + 1)] for i in worst]
        names = [None] * len(worst)
        if not settings.sphere_mode and not settings.on("-I"):
            rays = array("d", [x for record in records for x in record])
            words = self.line.words_of_answers("-i")
            names = zip(rsphere_surfaces(words, self.line.scene, rays), program.surfaces(rays))
        text = "Worst records (brightness, means of the repeats)\n"
        for i, record, hit in zip(worst, records, names):
            difference, error = comparison.records[i]
            text += (f"{i + 1:>8}: {ours.brightness(i):.4e}, original {original.brightness(i):.4e}, {100 * difference:+.2f}% +- "
                     f"{100 * error:.2f}%  at" + "".join(f" {x:g}" for x in record))
            if hit:
                text += f"  hits {hit[0]}" + ("" if hit[0] == hit[1] else f", original {hit[1]}")
            text += "\n"
        return text


def rotated_directions(count, rotation):
    """Evenly spread directions: those of a point in rsphere."""
    scene = MemoryFile(LAMP)
    words = ["-S+", "-w-", "-h-", "-Sw", "h", "-Sk", "0", "-Sn", str(count), "-Sx", str(count), "-Sr", str(rotation), "-Sd+", "-fad", "-od"]
    return numbers_of(rsphere([*words, scene.path], b"0 0 0\n", (scene.descriptor,)).output)


def refuse_what_points_have(line):
    if line.gave("-Sg") or line.gave("-SG") or line.settings.on("-Sb"):
        raise Fault("-Sg and -Sb: the original does not compute importance")
    if line.settings.on("-Su"):
        raise Fault("-Su: rtrace does not compute glare")
    if not line.settings.on("-dv"):
        raise Fault("-dv-: the original's irradiance includes the light of sources; compare rays")


def records_to_compare(line, width, height):
    """The numbers of the records to compare."""
    numbers = read_records(line.records, line.settings, line.messages)
    if not line.settings.sphere_mode:
        numbers = without_bogus(numbers)
    records = len(numbers) // line.settings.per_record
    if records == 0:
        raise Fault(f"{line.records}: no record has a direction")
    if line.own["-Cp"] and not records == width * height > 0:
        raise Fault(f"-Cp: {records} records do not fill a picture of -x {width} times -y {height}")
    return numbers


def run_compare(line):
    settings, own, messages = line.settings, line.own, line.messages
    points = settings.sphere_mode
    if settings.on("-Sp"):
        raise Fault("-Sp: sums are compared, not the parts of contributors")
    if points:
        refuse_what_points_have(line)
    path, version = find_original()
    width, height = int(settings.number("-x")), int(settings.number("-y"))
    numbers = records_to_compare(line, width, height)
    if settings.number("-ab") > 0 and settings.number("-aa") > 0:
        messages.warning("the original keeps indirect light in a cache, whose error shows as bias, and repeats use it again: "
                         "use -aa 0 to compare without it")
    comparing = Comparing(line)
    ours = comparing.ours(numbers)
    program = Original(path, line.scene, comparing.original_options())
    original = comparing.original(program, numbers)
    comparison = compare(ours, original, own["-Ct"], own["-Cs"], not points)

    worst = comparing.worst_text(comparison, ours, original, numbers, program)
    times = (f"CPU time of all repeats, loading included: rsphere {comparing.seconds:.2f} s, "
             f"the original {program.seconds:.2f} s")
    times += "\n" if program.octree_seconds is None else f", oconv {program.octree_seconds:.2f} s\n"
    if points:
        times += equal_error_text(comparison.middle, own["-Cn"], comparing.seconds, program.seconds)
    write_output(f"{ours.records} {'points' if points else 'rays'}, {own['-Cr']} repeats, beside {path} ({version})\n" +
                 warnings_text(messages.warnings) + figures_text(comparison, own["-Ct"]) +
                 histogram_text(comparison.records, own["-Ct"]) + worst + times)
    if own["-Cp"]:
        write_differences(own["-Cp"], width, height, comparison.records, own["-Ct"])
    if own["-Ch"]:
        pictured = ours.records == width * height
        subject = Subject(
            " ".join(line.scene), line.records, line.given_line(), path, version, line.rsphere_version(), points,
            "W/m2" if not points and (settings.on("-I") or settings.on("-i")) else "W/sr/m2", own["-Ct"],
            width if pictured else 0, height if pictured else 0, worst, times, messages.warnings)
        write_file(own["-Ch"], compare_page(ours, original, comparison, subject, time.time()))
    return STATUS[comparison.verdict]


def main(words):
    def body(messages):
        line = CommandLine(COMPANION, words, messages)
        return line.answer_request() if line.request else run_compare(line)
    return run_program(COMPANION.program, body, TROUBLE)
