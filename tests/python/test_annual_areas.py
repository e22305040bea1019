"""rsphere.annual: the area that each sensor of a work plane stands for, by shapes computed by hand, and the shares of verdicts that follow."""
import argparse
import unittest

import numpy as np

from rsphere.annual.areas import ROUND, areas_of
from rsphere.annual.sensors import sensors_on
from rsphere.annual.verdicts import Year, verdicts_of
from rsphere.layout.room import Polygon, read_polygons
from run_here import InAFolder

SQUARE = ((0, 0), (4, 0), (4, 4), (0, 4))
CORNER = ((0, 0), (4, 0), (4, 2), (2, 2), (2, 4), (0, 4))  # an L
SLANTED = ((0, 0), (10, 0), (6, 2), (0, 2))
CIRCLE = [(5 * np.cos(a), 5 * np.sin(a)) for a in 2 * np.pi * np.arange(64) / 64]
LOST = np.pi / 4 - ROUND / 8 * np.sin(2 * np.pi / ROUND)  # of a quarter of a circle of radius 1, where it is a polygon


def polygon(corners, z=0.0):
    corners = np.array(corners, float)
    return Polygon("plane", "wood", np.column_stack([corners, np.full(len(corners), z)]))


def sensors_at(*places):
    return np.array([[x, y, 0.8, 0, 0, 1] for x, y in places], float)


def areas(places, *polygons, margin=0.0):
    return areas_of(sensors_at(*places), [polygon(corners) for corners in polygons], margin)


class Areas(unittest.TestCase):
    def test_by_hand(self):
        for name, places, polygons, expected in (
                ("cells of a square", [(1, 1), (3, 1), (1, 3), (3, 3)], [SQUARE], [4, 4, 4, 4]),
                ("a triangle: a cell, and what is left by symmetry", [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5)], [((0, 0), (4, 0), (0, 4))], [1, 3.5, 3.5]),
                ("an L", [(1, 1), (3, 1), (1, 3)], [CORNER], [4, 4, 4]),
                ("an L that goes around clockwise", [(1, 1), (3, 1), (1, 3)], [CORNER[::-1]], [4, 4, 4]),
                ("a quadrilateral: 4 of 16 are to the left of x = 2", [(1, 1), (3, 1)], [SLANTED], [4, 12]),
                ("a hole by a seam", [(0.5, 0.5), (3.5, 0.5), (3.5, 3.5), (0.5, 3.5)], [(*SQUARE, (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1))], [3, 3, 3, 3]),
                ("a hole that goes around as the outline does", [(0.5, 0.5), (3.5, 3.5)], [(*SQUARE, (0, 0), (1, 1), (3, 1), (3, 3), (1, 3), (1, 1))], [6, 6]),
                ("triangles", [(1, 1), (3, 1), (1, 3), (3, 3)], [SQUARE[:3], (*SQUARE[2:], SQUARE[0])], [4, 4, 4, 4]),
                ("squares that overlap in 4 of 28", [(1, 1), (5, 5)], [SQUARE, ((2, 2), (6, 2), (6, 6), (2, 6))], [14, 14]),
                ("the same polygon twice", [(1, 2), (3, 2)], [SQUARE, SQUARE], [8, 8]),
                ("corners and places twice", [(1, 1), (3, 1), (1, 3)], [(*CORNER[:2], *CORNER[1:5], (1, 4), *CORNER[5:], CORNER[5])], [4, 4, 4]),
                ("edges that cross: 16/3 and 4/3, divided at x = 4/3", [(2, 1), (2 / 3, 1)], [((0, 0), (4, 4), (4, 0), (0, 2))], [16 / 3, 4 / 3]),
                ("one sensor has all", [(1, 1)], [CORNER], [12])):
            with self.subTest(name):
                np.testing.assert_allclose(areas(places, *polygons), expected, rtol=1e-12)

    def test_sensors_in_no_grid(self):
        """Three around one leave it a triangle of inradius .5; a fourth, farther away than all of its corners, cuts one of these at a height of .25."""
        turns = np.radians([90, 210, 330])
        places = [(0, 0), *np.stack([np.cos(turns), np.sin(turns)], axis=1), (0, -1.5)]
        found = areas(places, ((-3, -3), (3, -3), (3, 3), (-3, 3)))
        self.assertAlmostEqual(found[0], 0.75 * np.sqrt(3) - 0.25**2 / np.sqrt(3), 12)
        self.assertAlmostEqual(found.sum(), 36, 12)

    def test_margins_by_hand(self):
        for name, places, polygons, margin, expected in (
                ("a square", [(1, 1), (3, 1), (1, 3), (3, 3)], [SQUARE], 0.5, [2.25] * 4),
                ("an L: a round corner around the one that points inwards", [(1, 1), (3, 1), (1, 3)], [CORNER], 0.5, [2.25 - 0.25 * (np.pi / 4 - LOST), 1.5, 1.5]),
                ("its edges in parts", [(1, 1), (3, 1), (1, 3)], [((0, 0), (2, 0), (2, 2), (0, 2)), ((2, 0), (4, 0), (4, 2), (2, 2)), ((0, 2), (2, 2), (2, 4), (0, 4))], 0.5,
                 [2.25 - 0.25 * (np.pi / 4 - LOST), 1.5, 1.5]),
                ("a triangle: 3 4 5, in circle of radius 1", [(1, 1)], [((0, 0), (4, 0), (0, 3))], 0.5, [1.5]),
                ("squares that overlap: two corners point inwards", [(1, 1), (5, 5)], [SQUARE, ((2, 2), (6, 2), (6, 6), (2, 6))], 0.5, [8.75 - 0.25 * (np.pi / 4 - LOST)] * 2)):
            with self.subTest(name):
                np.testing.assert_allclose(areas(places, *polygons, margin=margin), expected, rtol=1e-12)

    def test_circle_of_64_corners(self):
        """Whole cells in it, all of it in sum, and the same from all sides."""
        along = np.arange(-4.75, 5, 0.5)
        places = np.array([(x, y) for y in along for x in along if np.hypot(x, y) < 4.7])
        for shift in (0, 5e5):  # as on a map
            for margin, size in ((0, 5), (0.5, 5 - 0.5 / np.cos(np.pi / 64))):
                found = areas(places + shift, np.array(CIRCLE) + shift, margin=margin)
                np.testing.assert_allclose(found.sum(), 32 * np.sin(2 * np.pi / 64) * size**2, rtol=1e-9)
                np.testing.assert_allclose(found, found[::-1], rtol=1e-7)
                np.testing.assert_allclose(found[np.hypot(*places.T) < 4], 0.25, rtol=1e-7)
        self.assertGreater(areas(places, CIRCLE).max(), 0.45, "cells at the edge, and what is beside them")

    def test_slope(self):
        """Areas are those of the plane, not of its plan."""
        corners = np.array([(x, y, y) for x, y in SLANTED], float)
        sensors = np.array([[1, 0.5, 1.5, 0, -0.7, 0.7], [3, 0.5, 1.5, 0, -0.7, 0.7]])
        np.testing.assert_allclose(areas_of(sensors, [Polygon("roof", "wood", corners)], 0), np.array([4, 12]) * np.sqrt(2), rtol=1e-12)


class Shares(InAFolder):
    def sensors_on(self, spacing, margin=0.0, text="void plastic wood 0 0 5 .5 .5 .5 0 0\n", **planes):
        for name, corners in planes.items():
            if not corners:
                continue  # text has it
            text += f"wood polygon {name} 0 0 {3 * len(corners)} " + " ".join(f"{x:.12g} {y:.12g} 0" for x, y in corners) + "\n"
        scene = [self.file(text, "room.rad")]
        given = argparse.Namespace(on=[*planes], height=0.8, spacing=spacing, margin=margin, scene=scene)
        return sensors_on(given, read_polygons(scene))

    def test_grids_of_plan(self):
        """The grid of the program plan: whole cells inside of an L, and more where an edge is slanted."""
        sensors, weights, _ = self.sensors_on(1, floor=CORNER)
        np.testing.assert_allclose((len(sensors), *weights), (12, *[1 / 12] * 12), rtol=1e-12)
        sensors, weights, _ = self.sensors_on(1, floor=SLANTED)
        expected = {(5.5, 1.5): 4 / 3, (6.5, 0.5): 17 / 12, (7.5, 0.5): 9 / 4}  # above y = x - 5 the upper row is nearer
        np.testing.assert_allclose(16 * weights, [expected.get((x, y), 1) for x, y in np.round(sensors[:, :2], 6)], rtol=1e-12)
        self.assertEqual(len(sensors), 14)

    def test_planes_count_by_their_areas_without_margins(self):
        sensors, weights, planes = self.sensors_on(1, 0.5, small=SQUARE, large=[(x + 9, 2 * y) for x, y in SQUARE])
        np.testing.assert_allclose([weights[rows].sum() for _, rows in planes], [9 / 30, 21 / 30], rtol=1e-12)

    def test_polygons_of_a_plane(self):
        """One is upside down, one has an alias of the modifier, and one has another modifier: plan takes the first three."""
        text = "void plastic wood 0 0 5 .5 .5 .5 0 0\nvoid plastic rug 0 0 5 .2 .2 .2 0 0\nvoid alias oak wood\n"
        text += "wood polygon a 0 0 12 0 0 0 2 0 0 2 2 0 0 2 0\nwood polygon b 0 0 12 2 0 0 2 2 0 4 2 0 4 0 0\n"
        text += "oak polygon c 0 0 12 4 0 0 6 0 0 6 2 0 4 2 0\nrug polygon d 0 0 12 6 0 0 8 0 0 8 2 0 6 2 0\n"
        sensors, weights, _ = self.sensors_on(1, text=text, wood=())
        np.testing.assert_allclose((len(sensors), *weights), (12, *[1 / 12] * 12), rtol=1e-12)

    def test_verdicts_at_their_limits(self):
        """Three quarters of a slanted plane have 300 lx: sDA of 75% is met. With less of it, it is not."""
        for corners, value, met in ((SLANTED, 0.75, True), (((0, 0), (9.9, 0), (6, 2), (0, 2)), 11.9 / 15.9, False)):
            weights = areas([(1, 1), (3, 1)], corners)
            lux = np.array([[[299.0], [300.0]]])
            year = Year(rows=np.array([(6, 1, 12.5)]), lux=lux, open=lux, direct=lux[0] * 0, diffuse=np.ones(1), sun=np.zeros(1), weights=weights / weights.sum(),
                        all_hours=1, occupied_hours=1)
            verdict = next(v for v in verdicts_of(year) if v.rule.startswith("sDA 300") and v.asked.startswith("75%"))
            self.assertAlmostEqual(verdict.value, value, 12)
            self.assertEqual(verdict.met(), met)


if __name__ == "__main__":
    unittest.main()
