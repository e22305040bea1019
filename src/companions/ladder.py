"""The settings to be measured, each a list of rsphere's options."""
from .program import Fault, read_file


def directions(weights, base):
    """-Sx is twice -Sn, like its default."""
    return f"-Sw {weights} -Sn {base} -Sx {2 * base}"


def lines_of_rays():
    lines = []
    for rays in (256, 1024, 4096):
        lines.append(f"-aa 0 -ad {rays} -as 0 -dj 1 -dt 0 -ds .05 -st 0 -lw 1e-4")
        lines.append(f"-aa .1 -ad {rays} -as {rays // 2} -dj 1 -dt 0 -ds .05 -st 0 -lw 1e-4")
    return lines + [f"-Sa {accuracy}" for accuracy in (.02, .01, .005)]


def lines_of_points(bounces, divisions):
    """bounces, divisions: -ab and -ad of the command line."""
    lines = [directions("c", base) for base in (128, 256, 512, 1024, 2048, 4096)]
    lines += [directions("h", base) for base in (512, 2048, 8192)]
    lines += [directions("v", base) for base in (512, 2048)]
    lines += [directions("c", base) + " -Sk 0" for base in (512, 2048)]
    lines.append(directions("c", 512) + " -Sk 4")
    if bounces > 0 and divisions > 0:
        lines += [directions("c", base) + " -ad 1" for base in (512, 2048, 4096)]
        lines += [directions("c", base) + " -ad 16" for base in (128, 512)]
    lines += [directions("c", base) + (" -ad 1 -Ss 1" if bounces > 0 else " -Ss 1") for base in (256, 1024, 4096)]
    if bounces > 0:
        lines += [directions("c", base) + " -ad 1 -Ss 2 -lw .5" for base in (512, 2048, 8192)]
    return lines + [f"-Sw c -Sn 256 -Sx 65536 -Sa {accuracy}" for accuracy in (.02, .005)]


def ladder(file, fewer_bounces, settings):
    """The settings in the file of -Tl, or else a default selection; with -Tb, also settings with fewer bounces. settings: of the
    command line."""
    bounces = int(settings.number("-ab"))
    if file:
        lines = read_file(file).decode(errors="surrogateescape").splitlines()
    else:
        lines = lines_of_points(bounces, settings.number("-ad")) if settings.sphere_mode else lines_of_rays()
    found = [words for words in (line.split("#", 1)[0].split() for line in lines) if words]
    if not found:
        raise Fault(f"{file}: no settings")
    if fewer_bounces:
        best = directions("c", 1024) if settings.sphere_mode else "-Sa .01"
        found += [f"{best} -ab {fewer}".split() for fewer in range(bounces)]
    return found


def reference_words(sphere_mode):
    """The options of the reference, with which the answers of all settings are compared."""
    return ("-Sw c -Sn 4096 -Sx 8192 -Sk 1" if sphere_mode else
            "-aa 0 -ad 4096 -as 0 -lw 1e-6 -dj 1 -dt 0 -ds .05 -st 0").split()
