#!/usr/bin/env python3
"""Illuminance on a horizontal grid of sensors, and at eye height above it.

sensor_grid.py sky.rad room.rad --corners 0.5 0.5 7.5 4.7 --height 0.75 --spacing 0.5 --output grid.npz

Prints the horizontal illuminance (lx), as a plan with north at the top, and its average and uniformity. Then the
cylindrical illuminance at eye height in the middle of the grid, with the standard error of the mean luminance there.
Writes all arrays into a file for NumPy.
"""
import argparse
import sys

import numpy as np

import rsphere

arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
arguments.add_argument("scene", nargs="+", help="scene files, or one octree")
arguments.add_argument("--corners", nargs=4, type=float, required=True, metavar=("X0", "Y0", "X1", "Y1"))
arguments.add_argument("--height", type=float, default=0.75, help="of the sensors (0.75)")
arguments.add_argument("--eyes", type=float, default=1.2, help="height of eyes (1.2)")
arguments.add_argument("--spacing", type=float, default=0.5, help="of the sensors (0.5)")
arguments.add_argument("--bounces", type=int, default=8, help="diffuse reflections (8)")
arguments.add_argument("--output", default="grid.npz")
given = arguments.parse_args()


def middles(low, high):
    """The middles of cells of about the spacing between two coordinates."""
    cells = max(1, round((high - low) / given.spacing))
    return low + (np.arange(cells) + 0.5) * (high - low) / cells


x0, y0, x1, y1 = given.corners
x, y = np.meshgrid(middles(x0, x1), middles(y0, y1))
sensors = np.zeros((x.size, 6))
sensors[:, 0], sensors[:, 1], sensors[:, 2] = x.ravel(), y.ravel(), given.height
sensors[:, 5] = 1  # they face up

try:
    scene = rsphere.Scene(given.scene)
    answers = scene.trace(
        sensors,
        irradiance_at_origin=True,
        ambient_bounces=given.bounces,
        ambient_divisions=1024,
        ambient_super_samples=512,
        ambient_accuracy=0.1,
        ambient_resolution=64,
        limit_weight=1e-4,
    )
    eyes = scene.sphere([[(x0 + x1) / 2, (y0 + y1) / 2, given.eyes]], ambient_bounces=given.bounces)
except rsphere.Error as error:
    sys.exit(f"sensor_grid.py: {error}")

lux = rsphere.photometric(answers.value).reshape(x.shape)
for row in lux[::-1]:
    print(" ".join(f"{value:7.0f}" for value in row))
print(f"average {lux.mean():.0f} lx, uniformity {lux.min() / lux.mean():.2f}")

luminance = rsphere.photometric(eyes.mean)[0]
# An upper bound, because the channels' errors go together: the error of luminance itself is that of -pY.
error = rsphere.photometric(eyes.mean_standard_error)[0]
cylindrical = rsphere.photometric(eyes.cylindrical_irradiance)[0]
print(f"eyes in the middle: cylindrical {cylindrical:.0f} lx, mean luminance {luminance:.1f} cd/m2, error {error:.1f}")

np.savez(given.output, sensors=sensors, lux=lux, cylindrical=cylindrical)
