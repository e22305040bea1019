"""What tests of rsphere-compare and rsphere-trade share."""
import os
import re
import xml.etree.ElementTree as ET

from companions.command_line import CommandLine, Settings
from companions.program import Fault, Messages

MAN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../man")


def parsed(test, markup):
    """A page or a plot, read as XML, without name spaces; nothing in it asks for another file, and it has no script."""
    root = ET.fromstring(re.sub(' xmlns="[^"]*"', "", markup.removeprefix("<!DOCTYPE html>\n")))
    for element in root.iter():
        test.assertNotIn(element.tag, ("script", "link", "iframe", "object", "embed"))
        for name in ("src", "href"):
            test.assertTrue(element.get(name, "data:").startswith("data:"), element.get(name))
        if element.tag == "style":
            test.assertNotRegex(element.text, r"url\(|@import")
    return root


def texts(root, path):
    """The text of the elements that a path finds, with that of the elements in them."""
    return ["".join(element.itertext()) for element in root.findall(path)]


def line_of(companion, *words):
    return CommandLine(companion, list(words), Messages("test"))


def settings_of(*lines):
    return Settings(list(lines))


def fault_of(work):
    try:
        work()
    except Fault as fault:
        return str(fault)
    return "no fault"


def escaped(text):
    """For man(7): lines may not begin with a dot or a quote, and a hyphen is written as a minus."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def manual_of(test, companion):
    """man/NAME.1 as it must be: man/NAME.1.in with what the table of options and man/NAME.options say of each."""
    with open(f"{MAN}/{companion.program}.options", encoding="utf-8") as stream:
        texts_of = [part.strip().split("\n") for part in re.sub("(?m)^#.*\n", "", stream.read()).split("\n\n")]
    paragraphs = {lines[0]: " ".join(lines[1:]) for lines in texts_of if lines[0]}
    made = ""
    for option in companion.own:
        paragraph = paragraphs.pop(option.name)
        test.assertTrue(paragraph.endswith("."), option.name)
        argument = " [+|\\-]" if isinstance(option.default, bool) else f' " {option.argument}"'
        made += f".TP\n.BI {escaped(option.name)}{argument}\n{escaped(paragraph)}"
        facts = [f"Unit: {option.unit}."] if option.unit else []
        if isinstance(option.default, (int, float)) and not isinstance(option.default, bool):
            facts.append(f"From {option.lowest:.15g} to {option.highest:.15g}.")
        if option.default != "":
            facts.append(f"Default: {'off' if option.default is False else format(option.default, '.15g')}.")
        made += "\n" + escaped(" ".join(facts)) + "\n" if facts else "\n"
    test.assertEqual(paragraphs, {})
    with open(f"{MAN}/{companion.program}.1.in", encoding="utf-8") as stream:
        return stream.read().replace('.\\" @OPTIONS@\n', made)


class OwnOptions:
    """Tests of the options of a companion. A subclass has the companion, and the letter that its names begin with."""

    def test_manual_is_the_generated_one(self):
        with open(f"{MAN}/{self.companion.program}.1", encoding="utf-8") as stream:
            self.assertEqual(stream.read(), manual_of(self, self.companion))

    def test_are_its_own(self):
        """Neither rtrace nor rsphere uses their names, and all have a remark."""
        table = line_of(self.companion, "-defaults").table
        self.assertIn("-ab", table)
        for option in self.companion.own:
            self.assertEqual(option.name[:2], self.letter)
            self.assertTrue(option.remark, option.name)
            self.assertNotIn(option.name, table)
