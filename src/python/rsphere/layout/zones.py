"""The zones of directions in which rsphere answers (ZONES in its manual): their rows, and intensities averaged over them."""
import numpy as np


class Zones:
    """A cap around +z, rows of zones that begin at the azimuth of +x, and a cap around -z, all of equal solid angle."""

    def __init__(self, middles):
        """middles: rsphere.zone_middles(N)."""
        height = np.round(middles[:, 2], 9)
        _, counts = np.unique(-height, return_counts=True)
        self.count = len(middles)
        self.first = np.concatenate([[0], np.cumsum(counts)])
        self.solid_angle = 4 * np.pi / self.count

    def at(self, directions):
        """The zones that unit vectors (..., 3) lie in."""
        z, azimuth = directions[..., 2], np.arctan2(directions[..., 1], directions[..., 0]) / (2 * np.pi) % 1
        row = np.searchsorted(self.first, (1 - z) * self.count / 2, side="right") - 1
        row = np.clip(row, 0, len(self.first) - 2)
        number = self.first[row + 1] - self.first[row]
        return self.first[row] + np.minimum((azimuth * number).astype(int), number - 1)

    def samples(self, side=4):
        """Directions spread evenly within each zone: (count, side * side, 3)."""
        part = (np.arange(side) + 0.5) / side
        found = []
        for begin, end in zip(self.first, self.first[1:]):
            number = end - begin
            z = 1 - 2 * (begin + number * part) / self.count
            azimuth = 2 * np.pi * (np.arange(number)[:, None] + part) / number
            z, azimuth = np.broadcast_arrays(z[None, :, None], azimuth[:, None, :])
            across = np.sqrt(1 - z * z)
            found.append(np.stack([across * np.cos(azimuth), across * np.sin(azimuth), z], axis=-1).reshape(number, -1, 3))
        return np.concatenate(found)
