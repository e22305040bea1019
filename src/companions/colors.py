"""How red, green and blue, or the bands of a spectrum, make brightness and the colors of a picture."""
import math
from operator import mul
from typing import NamedTuple

from .command_line import rsphere
from .program import MemoryFile

LUMENS_PER_WATT = 179  # as rsphere and RADIANCE convert
MID_BRIGHT = .21404114  # the linear value whose sRGB value is .5
# RADIANCE's red, green and blue of CIE X, Y, Z: primaries .640 .330, .290 .600, .150 .060, white 1/3 1/3.
RGB_OF_XYZ = ((2.565313, -1.166850, -.398463), (-1.022108, 1.978287, .043822), (.074724, -.251940, 1.177215))


class Colors(NamedTuple):
    """photopic: the part of each channel in brightness. tristimulus: X, Y and Z of each band; None for red, green and blue."""

    names: list
    photopic: list
    tristimulus: list = None

    def shown(self, channels):
        """Red, green and blue; those outside the gamut are mixed with gray of the same Y until none is negative."""
        if self.tristimulus is None:
            return channels
        xyz = [sum(map(mul, channels, weights)) for weights in self.tristimulus]
        rgb = [sum(map(mul, row, xyz)) for row in RGB_OF_XYZ]
        gray, least = max(xyz[1], 0.0), min(rgb)
        share = gray / (gray - least) if least < 0 else 1
        return [share * channel + (1 - share) * gray for channel in rgb]


RGB = Colors(["red", "green", "blue"], [.265105820, .670105820, .064788360])


def bands_of_spectrum(count, shortest, longest):
    """The colors of a spectral run. What a band looks like is what rsphere answers to a ray that meets light of that band."""
    step, lights, rays = 2 * math.pi / count, [], []
    for k in range(count):
        direction = f"{math.cos(k * step):.9f} {math.sin(k * step):.9f} 0"
        values = " ".join("01"[i == k] for i in range(count))
        lights.append(f"void spectrum s{k} 0 0 {count + 2} {longest} {shortest} {values} s{k} glow g{k} 0 0 4 1 1 1 0 "
                      f"g{k} source d{k} 0 0 4 {direction} {180 / count:.6f}\n")
        rays.append(f"0 0 0 {direction}\n")
    scene = MemoryFile("".join(lights).encode())
    ended = rsphere(["-S-", "-h-", "-w-", "-pXYZ", "-cs", str(count), "-cw", str(shortest), str(longest), scene.path],
                    "".join(rays).encode(), (scene.descriptor,))
    xyz = [[float(x) / LUMENS_PER_WATT for x in line.split()] for line in ended.output.splitlines()]
    width = (longest - shortest) / count
    names = [f"{longest - (k + .5) * width:.0f} nm" for k in range(count)]
    return Colors(names, [y for _, y, _ in xyz], list(zip(*xyz)))


def srgb(x):
    """The sRGB value, 0 to 1, of a linear value; values beyond are clipped. Source: IEC 61966-2-1."""
    return 12.92 * max(x, 0.0) if x <= .0031308 else 1.055 * min(x, 1.0) ** (1 / 2.4) - .055
