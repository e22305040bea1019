"""XML of files that nobody has checked: strictly read, without entities, of a bounded size, and with the lines of its elements."""
import xml.etree.ElementTree as ElementTree
from xml.parsers import expat

from ..fault import fault, number

MOST_BYTES = 16 << 20
MOST_ELEMENTS, DEEPEST = 300_000, 100  # a TM-33 file by degrees has 65,000; each takes some 300 bytes of memory


class Element(ElementTree.Element):
    """An element that knows its line. Its tag is the name alone, without a namespace."""

    line = None

    def fault(self, file, text):
        return fault(file, self.line, text)


def root_of(data, file):
    """The root of a document, an Element. Raises Fault with its line; also if it declares a type, by which entities could grow without bound."""
    if len(data) > MOST_BYTES:
        raise fault(file, None, f"is larger than {MOST_BYTES >> 20} MB")
    scan, tree = expat.ParserCreate(namespace_separator="}"), ElementTree.TreeBuilder(Element)
    scan.buffer_text = True

    def refuse(*_):
        raise fault(file, scan.CurrentLineNumber, "a document type (<!DOCTYPE) is not read; take it out")

    open_now, count = 0, 0

    def begin(name, attributes):
        nonlocal open_now, count
        open_now, count = open_now + 1, count + 1
        if count > MOST_ELEMENTS or open_now > DEEPEST:
            raise fault(file, scan.CurrentLineNumber, f"has more than {MOST_ELEMENTS} elements, or more than {DEEPEST} in each other")
        tree.start(name.rsplit("}", 1)[-1].replace(" ", ""), attributes).line = scan.CurrentLineNumber

    def end(name):
        nonlocal open_now
        open_now -= 1
        tree.end(name)

    scan.StartDoctypeDeclHandler, scan.CharacterDataHandler = refuse, tree.data
    scan.StartElementHandler, scan.EndElementHandler = begin, end
    try:
        scan.Parse(data, True)
        return tree.close()
    except expat.ExpatError as error:
        raise fault(file, error.lineno, f"is not well-formed XML: {str(error).split(':')[0]}") from None
    except (ValueError, LookupError) as error:
        raise fault(file, None, f"is not XML: {error}") from None


def only(element, path, file):
    """The element inside of another, or None. Raises Fault if there are two, of which neither can be known to hold."""
    found = element.findall(path)
    if len(found) > 1:
        raise found[1].fault(file, f"{element.tag} has two {path}; take one out")
    return found[0] if found else None


def text_of(element, path, default=""):
    found = element.find(path)
    return default if found is None or found.text is None else found.text.strip()


def number_of(element, path, file, least, most, default=None):
    """The number of an element inside of another. Raises Fault if it is none, or not there although there is no default."""
    text, found = text_of(element, path), only(element, path, file)
    if not text and default is not None:
        return default
    if found is None:
        raise element.fault(file, f"{element.tag} has no {path}, which is needed: a number from {least:g} to {most:g}")
    return number(text, file, found.line, path.replace("/", " "), least, most)
