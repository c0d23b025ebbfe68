"""
Partitions, and bubbles that reach out of them
==============================================

How `stereodel.partitioned` triangulates more points than memory holds, shown with 28 298 airports in 16 partitions.
Left: planes halve the points again and again; of the partitions that they leave one is followed, with 1769 airports in
the south of South America (blue). Middle, its first round: its own points are read, and a single one (gray) of each of
512 boxes, which are as small as their points allow. Triangles are final whose empty bubble meets no box that is still
unread; drawn are the 222 bubbles that meet one, and the 34 boxes that they meet (orange). Right, its second round: the
points of these boxes are read, too (vermilion), and the last 184 of its own points get their triangles. They are those
that the airports of the whole Earth have together.

Chosen by us: the partition, and how often points are halved. Of a box its part of the sphere is drawn, which arcs of
circles bound.
"""

from collections.abc import Iterator
from itertools import pairwise, product

import numpy as np

from stereodel import SphereCircle, SphericalDelaunay, data, lonlat_to_xyz
from stereodel.drawing import Page, View, with_legend
from stereodel.drawing.page.style import BLUE, DARK_GRAY, ORANGE, VERMILION, DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe, Panel, panels
from stereodel.render import Figure
from stereodel.sphere import SphereArc, xyz_to_lonlat

VIEW = View(-62, -22)
PLACE = (-58.4, -34.6)  # in the partition that is followed: Buenos Aires
PARTITIONS, BOXES = 4, 5  # how often all points are halved, and then those of a partition
SPACE = np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])  # low and high corner
STEPS = 33  # points of an arc
SAME = 1e-9  # distance of two computed ends of arcs that are one
OCEAN, LAND, COAST = (0.955, 0.968, 0.978, 1.0), (0.895, 0.895, 0.885, 1.0), LineStyle((0.6, 0.63, 0.66, 1.0), 0.3)
SEAM, EDGE, BUBBLE = LineStyle(DARK_GRAY, 0.6), LineStyle(BLUE, 0.25), LineStyle(VERMILION, 0.3)
ALL, FAR = DotStyle(DARK_GRAY, 0.36), DotStyle(DARK_GRAY, 0.6)
OWN, NEW = DotStyle(BLUE, 0.42), DotStyle(VERMILION, 0.42)
TINT, BOX, RIM = with_opacity(BLUE, 0.16), with_opacity(ORANGE, 0.4), LineStyle(with_opacity(ORANGE, 0.9), 0.3)
LEGEND = {
    "its own points": DotStyle(BLUE, 1.4),
    "one point of a box": DotStyle(DARK_GRAY, 1.4),
    "points read next": DotStyle(VERMILION, 1.4),
    "its triangles": LineStyle(BLUE, 0.6),
    "bubbles that meet a box": LineStyle(VERMILION, 0.8),
    "boxes that they meet": BOX,
}


def halved(points: np.ndarray, rows: np.ndarray, room: np.ndarray, times: int) -> list[tuple[np.ndarray, np.ndarray]]:
    """Rows of points and the box (2, 3) that is theirs, halved so often, each time across the widest axis."""
    if times == 0:
        return [(rows, room)]
    axis = int(np.argmax(np.ptp(points[rows], axis=0)))
    along = points[rows, axis]
    middle = np.sort(along)[(len(rows) - 1) // 2]
    low, high = room.copy(), room.copy()
    low[1, axis] = high[0, axis] = middle
    below, above = rows[along <= middle], rows[along > middle]
    return halved(points, below, low, times - 1) + halved(points, above, high, times - 1)


def bubbles(corners: np.ndarray) -> np.ndarray:
    """The planes n·x = d (m, 4) of the empty bubbles n·x ≥ d of triangles, whose corners are (m, 3, 3)."""
    a, b, c = np.moveaxis(corners, 1, 0)
    normal = np.cross(b - a, c - a)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return np.column_stack([normal, np.sum(normal * a, axis=1)])


def meet(planes: np.ndarray, boxes: np.ndarray) -> np.ndarray:
    """Which bubbles may hold points of which boxes (k, 2, 3): (m, k).

    A bubble lies in its half-space and, if it is no larger than a hemisphere, in the ball about the middle of its rim.
    """
    normal, offset, (low, high) = planes[:, None, :3], planes[:, 3, None], np.moveaxis(boxes, 1, 0)
    ahead = np.maximum(normal * low, normal * high).sum(axis=-1) >= offset
    middle = offset[..., None] * normal
    away = np.linalg.norm(np.clip(middle, low, high) - middle, axis=-1)
    return ahead & ((offset <= 0) | (away**2 <= 1 - offset**2))


def rounds(points: np.ndarray, members: list[np.ndarray], read: np.ndarray) -> Iterator[dict]:
    """Each round of a partition whose boxes are read, given the points of all boxes.

    Triangles about points that are not done, planes of those bubbles that meet unread boxes, these boxes, and which of
    the triangles are final.
    """
    boxes = np.array([[points[rows].min(axis=0), points[rows].max(axis=0)] for rows in members])
    alone, read = np.array([rows[0] for rows in members]), read.copy()
    pending = np.concatenate([members[box] for box in np.flatnonzero(read)])
    while len(pending):
        known = np.unique(np.concatenate([alone, *(members[box] for box in np.flatnonzero(read))]))
        triangles = known[SphericalDelaunay(points[known]).simplices]
        triangles = triangles[np.isin(triangles, pending).any(axis=1)]
        planes = bubbles(points[triangles])
        met = meet(planes, boxes) & ~read
        open_ = met.any(axis=1)
        touched = met.any(axis=0)
        done = np.setdiff1d(pending, triangles[open_])
        final = triangles[np.isin(triangles, done).any(axis=1)]
        yield {"planes": planes[open_], "boxes": boxes[touched], "touched": touched, "final": final, "pending": pending}
        pending, read = np.setdiff1d(pending, done), read | touched


def geometry() -> dict:
    """The partitions, and the two rounds of the one that is followed."""
    points = lonlat_to_xyz(data.airports().lonlat)
    partitions = halved(points, np.arange(len(points)), SPACE, PARTITIONS)
    rooms = np.array([room for _, room in partitions])
    home = lonlat_to_xyz(PLACE)
    (followed,) = np.flatnonzero(((rooms[:, 0] < home) & (home <= rooms[:, 1])).all(axis=1))
    members = [box for rows, room in partitions for box, _ in halved(points, rows, room, BOXES)]
    first, second = rounds(points, members, np.arange(len(members)) // 2**BOXES == followed)
    return {
        "points": points,
        "rooms": rooms,
        "room": rooms[followed],
        "own": partitions[followed][0],
        "alone": np.array([rows[0] for rows in members]),
        "planes": first["planes"],
        "boxes": first["boxes"],
        "new": np.concatenate([members[box] for box in np.flatnonzero(first["touched"])]),
        "last": second["pending"],
        "triangles": np.concatenate([first["final"], second["final"]]),
    }


def outline(room: np.ndarray) -> list[SphereArc]:
    """The arcs that bound a box's part of the sphere, which is on their left."""
    found = []
    for axis, side in product(range(3), (0, 1)):
        value = room[side, axis]
        if abs(value) < 1:
            normal = np.eye(3)[axis] * (1 - 2 * side)
            found += within(SphereCircle(normal, value * (1 - 2 * side)), axis, room)
    return found


def within(circle: SphereCircle, axis: int, room: np.ndarray) -> list[SphereArc]:
    """The arcs of a circle across an axis that are within a box."""
    center, u, v, _ = SphereArc.whole(circle).frame()
    cuts = [0.0]
    for other, side in product({0, 1, 2} - {axis}, (0, 1)):
        reach = np.hypot(u[other], v[other])
        if abs(room[side, other]) < reach:
            middle, half = np.arctan2(v[other], u[other]), np.arccos(room[side, other] / reach)
            cuts += [middle - half, middle + half]
    angles = np.unique(np.mod(cuts, 2 * np.pi))
    ends = np.append(angles, angles[0] + 2 * np.pi)
    arcs = []
    for start, stop in pairwise(ends):
        at, first, last = (center + np.cos(t) * u + np.sin(t) * v for t in ((start + stop) / 2, start, stop))
        others = np.delete(np.arange(3), axis)
        if ((room[0] <= at) & (at <= room[1]))[others].all():
            arcs.append(SphereArc(circle, first, last, stop - start))
    return arcs


def polygons(arcs: list[SphereArc]) -> list[list[np.ndarray]]:
    """Rings of points, degrees, of arcs that follow one another; all that is cut out is cut out of the longest."""
    left, parts, holes = list(arcs), [], []
    while left:
        chain = [left.pop(0)]
        while np.linalg.norm(chain[-1].end - chain[0].start) > SAME:
            following = min(left, key=lambda arc: np.linalg.norm(arc.start - chain[-1].end))
            left.remove(following)
            chain.append(following)
        ring = np.concatenate([arc.sample(STEPS)[:-1] for arc in chain])
        turn = np.cross(ring, np.roll(ring, -1, axis=0)).sum(axis=0) @ ring.sum(axis=0)
        (parts if turn > 0 else holes).append(xyz_to_lonlat(ring))
    longest, *others = sorted(parts, key=len, reverse=True)
    return [[longest, *holes], *([part] for part in others)]


def draw(g: dict) -> Page:
    """Three globes: all partitions, and the two rounds of one."""
    own, points = polygons(outline(g["room"])), g["points"]
    cut, first, second = (ground(own) for _ in range(3))
    for room in g["rooms"]:
        for arc in outline(room):
            steps = arc.sample(STEPS)
            cut.add_great_circles(steps[:-1], steps[1:], style=SEAM, name="seams")
    cut.add_points(np.delete(points, g["own"], axis=0), style=ALL, name="airports")
    first.add_polygons(
        [polygon for box in g["boxes"] for polygon in polygons(outline(box))], color=BOX, outline=RIM, name="boxes"
    )
    circles = [SphereCircle(plane[:3], plane[3]) for plane in g["planes"]]
    first.add_circles(circles, color=None, style=BUBBLE, name="bubbles")
    first.add_points(points[np.setdiff1d(g["alone"], g["own"])], style=FAR, name="one_of_a_box")
    pairs = np.unique(np.sort(g["triangles"][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    second.add_great_circles(points[pairs[:, 0]], points[pairs[:, 1]], style=EDGE, name="triangles")
    second.add_points(points[g["new"]], style=NEW, name="read")
    for globe in (cut, first, second):
        globe.add_points(points[g["own"]], style=OWN, name="own")
    titles = {f"{len(g['rooms'])} partitions": cut, "first round of one": first, "its second round": second}
    page = panels([Panel(globe, view=VIEW, title=title) for title, globe in titles.items()])
    return with_legend(page, LEGEND, columns=3, indent=40.0)


def ground(own: list[list[np.ndarray]]) -> Globe:
    """The land, and the partition that is followed."""
    globe = Globe(ocean=OCEAN)
    globe.add_land(color=LAND)
    globe.add_coastlines(style=COAST)
    globe.add_polygons(own, color=TINT, outline=LineStyle(BLUE, 0.8), name="partition")
    return globe


FIGURE = Figure("earth_partitions", geometry, draw)

if __name__ == "__main__":
    FIGURE.main()
