"""XML of files that nobody has checked: strictly read, without entities, and of a bounded size."""
import xml.etree.ElementTree as ElementTree
from xml.parsers import expat

from ..fault import fault, number

MOST_BYTES = 16 << 20
MOST_ELEMENTS, DEEPEST = 300_000, 100  # a TM-33 file by degrees has 65,000; each takes some 200 bytes of memory


def root_of(data, file):
    """The root of a document. Raises Fault with its line; also if it declares a type, by which entities could grow without bound."""
    if len(data) > MOST_BYTES:
        raise fault(file, None, f"is larger than {MOST_BYTES >> 20} MB")
    scan = expat.ParserCreate()

    def refuse(*_):
        raise fault(file, scan.CurrentLineNumber, "a document type (<!DOCTYPE) is not read; take it out")

    scan.StartDoctypeDeclHandler = refuse
    open_now, count = 0, 0

    def begin(*_):
        nonlocal open_now, count
        open_now, count = open_now + 1, count + 1
        if count > MOST_ELEMENTS or open_now > DEEPEST:
            raise fault(file, scan.CurrentLineNumber, f"has more than {MOST_ELEMENTS} elements, or more than {DEEPEST} in each other")

    def end(*_):
        nonlocal open_now
        open_now -= 1

    scan.StartElementHandler, scan.EndElementHandler = begin, end
    try:
        scan.Parse(data, True)
        root = ElementTree.fromstring(data)
    except (expat.ExpatError, ElementTree.ParseError) as error:
        raise fault(file, getattr(error, "lineno", None) or error.position[0], f"is not well-formed XML: {str(error).split(':')[0]}") from None
    except (ValueError, LookupError) as error:
        raise fault(file, None, f"is not XML: {error}") from None
    for element in root.iter():
        element.tag = element.tag.rsplit("}", 1)[-1].replace(" ", "")  # the names alone, without namespaces
    return root


def text_of(element, path, default=""):
    found = element.find(path)
    return default if found is None or found.text is None else found.text.strip()


def number_of(element, path, file, least, most, default=None):
    """The number of an element inside of another. Raises Fault if it is none, or not there although there is no default."""
    text = text_of(element, path)
    if not text and default is not None:
        return default
    return number(text, file, None, path.replace("/", " "), least, most)
