"""A page for the browser: one file with everything in it."""
from html import escape

STYLE = """
:root { color-scheme: light dark; }
body { font: 15px/1.5 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 1.8em; }
table { border-collapse: collapse; } td, th { padding: .2em .9em .2em 0; text-align: right; border-bottom: 1px solid #8884; }
td:first-child, th:first-child { text-align: left; } td, th { white-space: nowrap; }
td.words, th.words { text-align: left; white-space: normal; }
.good, .bad { padding: .6em 1em; border-left: 5px solid #2a2; background: #2a22; } .bad { border-color: #c22; background: #c222; }
.missed { color: #c22; font-weight: bold; } .note { opacity: .75; font-size: .9em; }
figure { margin: 1em 0; background: white; overflow-x: auto; } svg { max-width: 100%; height: auto; } code { white-space: pre-wrap; }
@page { size: A4; margin: 16mm; }
@media print { :root { color-scheme: light; } body { font-size: 9pt; max-width: none; margin: 0; padding: 0; }
  .good, .bad { print-color-adjust: exact; -webkit-print-color-adjust: exact; } h2 { break-after: avoid; } tr, figure { break-inside: avoid; } }
"""


def table(head, rows, words=1):
    """rows: lists of cells; a cell that begins with ! is shown as missed. words: columns of text at the left; a last column without a head is text, too."""
    def cell(tag, i, text):
        kinds = [k for k, there in (("words", i < words or i == len(head) - 1 and not head[-1]), ("missed", text.startswith("!"))) if there]
        return f'<{tag} class="{" ".join(kinds)}">{escape(text.removeprefix("!"))}</{tag}>'
    first, *lines = ["".join(cell("th", i, h) for i, h in enumerate(head)), *("".join(cell("td", i, c) for i, c in enumerate(row)) for row in rows)]
    # A browser repeats what is in thead on each printed page.
    return f"<table><thead><tr>{first}</tr></thead>\n<tbody>" + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</tbody></table>\n"


def aligned(rows, left):
    """Lines of text, a cell with ! without it. left: the columns whose text is at the left."""
    rows = [[c.removeprefix("!") for c in row] for row in rows]
    widths = [max(len(r[i]) for r in rows if i < len(r)) for i in range(max(map(len, rows)))]
    return ["  ".join(c.ljust(w) if i in left else c.rjust(w) for i, (c, w) in enumerate(zip(r, widths))).rstrip() for r in rows]


class Page:
    def __init__(self, title):
        self.title, self.body = title, ""

    def heading(self, text):
        self.body += f"<h2>{escape(text)}</h2>\n"

    def note(self, text):
        self.body += f'<p class="note">{escape(text)}</p>\n'

    def banner(self, good, text):
        self.body += f'<p class="{"good" if good else "bad"}">{escape(text)}</p>\n'

    def add(self, markup):
        self.body += markup

    def figure(self, svg):
        self.body += f"<figure>{svg[svg.find('<svg'):]}</figure>\n"

    def html(self):
        return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"/><title>{escape(self.title)}</title>'
                f"<style>{STYLE}</style></head>\n<body><h1>{escape(self.title)}</h1>\n{self.body}</body></html>\n")
