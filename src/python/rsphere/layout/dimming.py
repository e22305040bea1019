"""Scene text whose light sources are dimmed, by the modifiers of their light."""
import fnmatch
import os
import re
import subprocess

from ..fault import fault, write_text

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
SOURCE = re.compile(rf"(?<!\S)(\S+\s+(?:light|spotlight|glow|illum)\s+)(\S+)(\s+(?:0|1\s+\S+)\s+0\s+[347]\s+)({NUMBER})\s+({NUMBER})\s+({NUMBER})(?!\S)")
COMMAND = re.compile(r"^[ \t]*!((?:[^\n\\]|\\.|\\\n)*)$", re.MULTILINE)


def text_of(file):
    """The text of a scene file, its commands replaced by what they print."""
    try:
        with open(file, "rb") as stream:
            data = stream.read()
    except OSError as error:
        raise fault(file, None, f"cannot be read: {error.strerror}") from None
    if data.startswith(b"#?"):
        raise fault(file, None, "is an octree; luminaires by modifiers need scene text")
    return COMMAND.sub(lambda found: printed(found[1], file), data.decode("utf-8", "surrogateescape"))


def printed(command, file):
    run = subprocess.run(command, shell=True, capture_output=True, check=False, encoding="utf-8", errors="surrogateescape")
    if run.returncode:
        raise fault(file, None, f"the command fails: {command.strip()[:60]}")
    return COMMAND.sub(lambda found: printed(found[1], file), run.stdout)


def dimmed(files, lamps, folder):
    """Files of the same scene with the light of lamps by their factors. Raises Fault for lamps that match no light source."""
    if not lamps:
        return list(files)
    matched = set()

    def source(found):
        factor = 1.0
        for i, l in enumerate(lamps):
            if fnmatch.fnmatchcase(found[2], l.pattern):
                matched.add(i)
                factor *= l.factor
        return found[1] + found[2] + found[3] + " ".join(f"{float(v) * factor:.9g}" for v in found.groups()[3:])

    path = os.path.join(folder, "dimmed.rad")
    text = "\n".join(SOURCE.sub(source, text_of(file)) for file in files)
    for i, l in enumerate(lamps):
        if i not in matched:
            known = sorted({found[2] for found in SOURCE.finditer(text)})[:6]
            raise fault(*l.place, f'no light source has the modifier "{l.pattern[:40]}"; there are {", ".join(known) or "none"}')
    return [write_text(path, text, errors="surrogateescape")]
