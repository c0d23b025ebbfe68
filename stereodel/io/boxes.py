"""Closing chains of points along the sides of a rectangle: the map of the whole Earth, or a frame in the plane."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stereodel._arrays import BoolArray, FloatArray


@dataclass(frozen=True)
class Box:
    """A rectangle, its border measured counterclockwise from the lower right corner."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def width(self) -> float:
        """Length of the lower side."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Length of the right side."""
        return self.top - self.bottom

    def corners(self) -> FloatArray:
        """Lower right, upper right, upper left, lower left, (4, 2)."""
        return np.array(
            [(self.right, self.bottom), (self.right, self.top), (self.left, self.top), (self.left, self.bottom)]
        )

    def holds(self, points: FloatArray) -> BoolArray:
        """Whether points (..., 2) lie in the inside."""
        x, y = points[..., 0], points[..., 1]
        inside: BoolArray = (self.left < x) & (x < self.right) & (self.bottom < y) & (y < self.top)
        return inside

    def clipped(self, points: FloatArray) -> FloatArray:
        """Points (..., 2), those outside moved onto the border."""
        return np.clip(points, [self.left, self.bottom], [self.right, self.top])

    def same_side(self, a: FloatArray, b: FloatArray) -> BoolArray:
        """Whether pairs of points (k, 2) lie on one side of the border."""
        low, high = np.array([self.left, self.bottom]), np.array([self.right, self.top])
        return np.asarray((((a == low) & (b == low)) | ((a == high) & (b == high))).any(axis=1))

    def nearest(self, points: FloatArray) -> FloatArray:
        """Points (k, 2) moved onto the nearest side."""
        low, high = np.array([self.left, self.bottom]), np.array([self.right, self.top])
        moved = self.clipped(points)
        gaps = np.concatenate([moved - low, high - moved], axis=1)
        side, row = np.argmin(gaps, axis=1), np.arange(len(moved))
        moved[row, side % 2] = np.concatenate([low, high])[side]
        return moved

    def place(self, point: FloatArray) -> float:
        """Where on the border a point is, from 0 up to the circumference; of one off the border, the nearest side's."""
        x, y = float(point[0]), float(point[1])
        w, h = self.width, self.height
        rise, run = min(max(y - self.bottom, 0.0), h), min(max(x - self.left, 0.0), w)
        sides = [
            (abs(x - self.right), rise),
            (abs(y - self.top), h + (w - run)),
            (abs(x - self.left), h + w + (h - rise)),
            (abs(y - self.bottom), (2 * h + w + run) % (2 * (w + h))),
        ]
        return min(sides)[1]

    def between(self, start: float, end: float) -> FloatArray:
        """The corners that a walk counterclockwise from one place to another passes, (k, 2)."""
        around = 2 * (self.width + self.height)
        marks = np.array([0.0, self.height, self.height + self.width, 2 * self.height + self.width])
        ahead = (marks - start) % around
        passed = np.flatnonzero((ahead > 0) & (ahead < (end - start) % around))
        return self.corners()[passed[np.argsort(ahead[passed])]]


def close_along(box: Box, chains: list[FloatArray]) -> list[FloatArray]:
    """Closed rings of chains (k, 2) that run from border to border, the region on the left of each.

    From the end of a chain the ring follows the border counterclockwise to the nearest beginning of a chain. Chains
    that do not close so, as of a region narrower than rounding, make no ring.
    """
    begins = np.array([box.place(chain[0]) for chain in chains])
    around = 2 * (box.width + box.height)
    free = set(range(len(chains)))
    rings = []
    while free:
        first = current = min(free)
        pieces: list[FloatArray] = []
        while current in free:
            free.discard(current)
            end = box.place(chains[current][-1])
            following = int(np.argmin((begins - end) % around))
            pieces += [chains[current], box.between(end, float(begins[following]))]
            current = following
        if current == first:
            rings.append(np.concatenate(pieces))
    return rings
