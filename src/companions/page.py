"""Reports as a web page: a single self-contained file, without scripts. Pages follow the reader's system in using light or dark
colors, and are printable. All arguments are plain text, which is escaped here, except `svg`, which is markup."""
import base64
import html
import os
import re
from typing import NamedTuple


def escaped(text):
    """Text as the content of an element or the value of an attribute, in HTML and in XML. What is not allowed in either (bytes that
    are not UTF-8, control characters except tab and line feed, U+FFFE and U+FFFF) becomes U+FFFD."""
    return html.escape(re.sub("[^\t\n -~\x80-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "\ufffd", text)).replace("&#x27;", "&#39;")


def with_options_whole(text):
    """Text that may be broken before an option, but neither within an option nor between an option and its value."""
    parts = re.split("(?<=.)(?= -)", text)
    return "".join(re.sub("^( ?)(-.*)$", r"\1<span>\2</span>", escaped(part), flags=re.DOTALL) for part in parts)


class Table(NamedTuple):
    """rows: lists of cells. chosen: the number of the row that is emphasized. text_columns: number of text columns at the left; the
    other columns are numbers, aligned at the right. last_is_text: whether the last column is text, too."""

    head: list
    rows: list
    chosen: int = -1
    text_columns: int = 1
    last_is_text: bool = False

    def markup(self):
        def line(cells, tag):
            made = ""
            for i, cell in enumerate(cells):
                is_text = i < self.text_columns or self.last_is_text and i + 1 == len(cells)
                made += (f'<{tag} class="text">{with_options_whole(cell)}</{tag}>' if is_text
                         else f"<{tag}>{escaped(cell)}</{tag}>")
            return made + "</tr>\n"
        rows = "".join(('<tr class="chosen">' if i == self.chosen else "<tr>") + line(row, "td") for i, row in enumerate(self.rows))
        return (f'<div class="wide"><table>\n<thead><tr>{line(self.head, "th")}</thead><tbody>\n{rows}</tbody></table></div>\n')


class Page:
    """title: also of the window. above: small text on a line above the title."""

    def __init__(self, title, above):
        self.title, self.above, self.body = escaped(title), escaped(above), ""

    def heading(self, text):
        self.body += f"<h2>{escaped(text)}</h2>\n"

    def note(self, text):
        """An explanation, in smaller text."""
        self.body += f'<p class="note">{escaped(text)}</p>\n'

    def banner(self, tone, text):
        """A conspicuous sentence. tone: good, open or bad."""
        self.body += f'<p class="banner {tone}">{escaped(text)}</p>\n'

    def command(self, line):
        """A command line to be copied."""
        self.body += f'<pre class="command">{escaped(line)}</pre>\n'

    def lines(self, text):
        """Lines in a fixed-pitch font."""
        self.body += f"<pre>{escaped(text)}</pre>\n"

    def facts(self, pairs):
        """Names and values, one pair per line."""
        rows = "".join(f"<tr><td>{escaped(name)}</td><td>{escaped(value)}</td></tr>\n" for name, value in pairs)
        self.body += f'<table class="facts">\n{rows}</table>\n'

    def table(self, table):
        self.body += table.markup()

    def folded_table(self, summary, table):
        """The table is hidden until the reader opens it."""
        self.body += f"<details><summary>{escaped(summary)}</summary>\n{table.markup()}</details>\n"

    def figure(self, svg, caption):
        self.body += f'<figure><div class="plot">\n{svg}</div><figcaption>{escaped(caption)}</figcaption></figure>\n'

    def pictures(self, pictures):
        """pictures: the bytes of a PNG file, and the caption, of each."""
        figures = "".join(f'<figure><img src="data:image/png;base64,{base64.b64encode(png).decode()}" alt="{escaped(caption)}"/>'
                          f"<figcaption>{escaped(caption)}</figcaption></figure>\n" for png, caption in pictures)
        self.body += f'<div class="pictures">\n{figures}</div>\n'

    def html(self):
        """The page as HTML that is also well-formed XML; the style has no < and &, which would need different escapes in both."""
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "page.css"), encoding="utf-8") as stream:
            style = stream.read()
        return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8"/>\n'
                '<meta name="viewport" content="width=device-width, initial-scale=1"/>\n'
                f"<title>{self.title}</title>\n<style>\n{style}</style>\n</head>\n<body>\n"
                f'<p class="above">{self.above}</p>\n<h1>{self.title}</h1>\n{self.body}</body>\n</html>\n')
