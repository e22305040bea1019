"""The drawing of a layout from above (SVG), and the page for the browser: one file with everything in it."""
from html import escape

import numpy as np

from built import outline

STYLE = """
:root { color-scheme: light dark; }
body { font: 15px/1.5 sans-serif; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 1.8em; }
table { border-collapse: collapse; } td, th { padding: .2em .9em .2em 0; text-align: right; border-bottom: 1px solid #8884; }
td:first-child, th:first-child { text-align: left; } td.words, th.words { text-align: left; }
.good, .bad { padding: .6em 1em; border-left: 5px solid #2a2; background: #2a22; } .bad { border-color: #c22; background: #c222; }
.missed { color: #c22; font-weight: bold; } .note { opacity: .75; font-size: .9em; }
figure { margin: 1em 0; background: white; overflow-x: auto; } svg { max-width: 100%; height: auto; } code { white-space: pre-wrap; }
"""
COLORS = ("#e8a200", "#2277cc", "#bb3377", "#228855", "#775544")  # of kinds of luminaires


def at_height(text, size, across, down):
    return f'<text x="{across:.1f}" y="{down:.1f}" font-size="{size}" fill="#222">{escape(text)}</text>'


def shape(corners, style):
    return f'<path d="M{"L".join(f"{x:.1f} {y:.1f}" for x, y in corners)}Z" {style}/>'


def drawing(design, polygons, candidates, chosen, levels, title, context=()):
    """Outlines of the room and of what is wanted, candidates as dots, luminaires to scale with their levels in %."""
    flat = [p for p in polygons if abs(p.vector()[2]) > 0.9 * np.linalg.norm(p.vector()) > 0]
    room = max(flat, key=lambda p: abs(p.vector()[2]))
    low, high = room.corners[:, :2].min(axis=0), room.corners[:, :2].max(axis=0)
    scale = 660 / max(high[0] - low[0], 1e-9)
    height = (high[1] - low[1]) * scale
    to = lambda p: np.stack([(p[..., 0] - low[0]) * scale + 20, height - (p[..., 1] - low[1]) * scale + 40], axis=-1)  # noqa: E731
    parts = [at_height(title, 15, 20, 24), shape(to(room.corners), 'fill="#f6f4ef" stroke="#555" stroke-width="2"')]
    for p in (p for p in flat if p.name in context or p.modifier in context):
        parts.append(shape(to(p.corners), 'fill="none" stroke="#999"'))
    for surface in design.surfaces.values():
        for p in surface.polygons:
            parts.append(shape(to(p.corners), 'fill="#cfe3d2" stroke="#5a8a63"'))
    for eye in design.eyes.values():
        x, y = to(eye.position)
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="#36c"/>')
        if eye.gaze is not None:
            parts.append(f'<path d="M{x:.1f} {y:.1f}l{14 * eye.gaze[0]:.1f} {-14 * eye.gaze[1]:.1f}" stroke="#36c" stroke-width="2"/>')
    for x, y in to(np.unique(np.round([c.position for c in candidates], 6), axis=0)):
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="1.5" fill="#888"/>')
    for j, level in zip(chosen, levels):
        color = COLORS[candidates[j].luminaire % len(COLORS)]
        corners = to(outline(design, candidates[j]))
        parts.append(shape(corners, f'fill="{color}" fill-opacity="{0.15 + 0.7 * level:.2f}" stroke="#222"'))
        if level < 0.995:
            x, y = corners.mean(axis=0)
            parts.append(f'<text x="{x:.1f}" y="{y + 4:.1f}" font-size="11" text-anchor="middle">{level:.0%}</text>')
    names = [f"{l.name} {l.watts:g} W" for l in design.luminaires]
    for i, name in enumerate(names):
        parts.append(f'<rect x="{20 + 180 * i}" y="{height + 54:.0f}" width="22" height="12" fill="{COLORS[i % len(COLORS)]}" stroke="#222"/>')
        parts.append(at_height(name, 12, 48 + 180 * i, height + 64))
    parts.append(at_height("dots: where luminaires may hang; green: goals; blue: eyes", 12, 20, height + 86))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="700" height="{height + 100:.0f}" viewBox="0 0 700 {height + 100:.0f}" '
            f'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>{"".join(parts)}</svg>\n')


def table(head, rows, words=1):
    """rows: lists of cells; a cell that begins with ! is shown as missed. words: columns of text at the left."""
    def cell(tag, i, text):
        kinds = [k for k, there in (("words", i < words), ("missed", text.startswith("!"))) if there]
        return f'<{tag} class="{" ".join(kinds)}">{escape(text.removeprefix("!"))}</{tag}>'
    lines = ["".join(cell("th", i, h) for i, h in enumerate(head))]
    lines += ["".join(cell("td", i, c) for i, c in enumerate(row)) for row in rows]
    return "<table>" + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table>\n"


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
