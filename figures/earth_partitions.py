"""
Partitions, and bubbles that reach out of them
==============================================

How `stereodel.partitioned` triangulates more points than memory holds, shown with 28 298 airports in 16 partitions.
Cut: planes halve the points again and again; of the partitions that they leave one is followed, with 1769 airports in
the south of South America (blue). Ask: its own points are read, and a single one (gray) of each of 512 boxes, which are
as small as their points allow. Triangles are final whose empty bubble meets no box that is still unread; 222 bubbles
meet one. Drawn are twelve of them (vermilion), and of the 34 boxes that all of them meet those that these reach
(green). Answer: the points of all these boxes are read, too (green), and the last 184 of its own points get their
triangles (blue). They are those that the airports of the whole Earth have together.

Chosen by us: the partition, how often points are halved, and the bubbles that are drawn. Of a box its part of the
sphere is drawn, which arcs of circles bound.
"""

from collections.abc import Iterator
from itertools import pairwise, product

import numpy as np

from stereodel import SphereCircle, SphericalDelaunay, data, lonlat_to_xyz
from stereodel.drawing import Page, View, with_legend
from stereodel.drawing.page.style import BLUE, DARK_GRAY, GREEN, VERMILION, DotStyle, LineStyle, with_opacity
from stereodel.globe import Globe, Panel, panels
from stereodel.render import Figure
from stereodel.sphere import SphereArc, xyz_to_lonlat

VIEW = View(-62, -22)
PLACE = (-58.4, -34.6)  # in the partition that is followed: Buenos Aires
PARTITIONS, BOXES = 4, 5  # how often all points are halved, and then those of a partition
SPACE = np.array([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])  # low and high corner
STEPS = 33  # points of an arc
SAME = 1e-9  # distance of two computed ends of arcs that are one
SHOWN, WIDEST = 12, 24.0  # of the bubbles that meet a box, and the largest angular radius of these, degrees
OCEAN, LAND, COAST = (0.965, 0.975, 0.983, 1.0), (0.915, 0.915, 0.905, 1.0), LineStyle((0.68, 0.70, 0.72, 1.0), 0.3)
SEAM, EDGE = LineStyle(DARK_GRAY, 0.6), LineStyle(BLUE, 0.3)
BUBBLE, BOX = LineStyle(VERMILION, 0.8), LineStyle(GREEN, 0.7)
OTHERS = DotStyle(with_opacity(DARK_GRAY, 0.22), 0.42)  # where they are dense, a gray tint
ALONE, OWN, READ = DotStyle(DARK_GRAY, 0.42), DotStyle(BLUE, 0.36), DotStyle(GREEN, 0.42)
TINT = with_opacity(BLUE, 0.16)
LEGEND = {
    "one partition, and its triangles": DotStyle(BLUE, 1.6),
    "bubbles that reach into boxes": BUBBLE,
    "these boxes, and their points": BOX,
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
        "shown": chosen(first["planes"]),
        "new": np.concatenate([members[box] for box in np.flatnonzero(first["touched"])]),
        "last": second["pending"],
        "triangles": np.concatenate([first["final"], second["final"]]),
    }


def chosen(planes: np.ndarray) -> np.ndarray:
    """Rows of some bubbles in sight, far from one another: each the one farthest from all before it."""
    rows = np.flatnonzero((VIEW.depth(planes[:, :3]) > 0.2) & (planes[:, 3] > np.cos(np.radians(WIDEST))))
    found = [int(np.argmin(planes[rows, 3]))]
    while len(found) < SHOWN:
        found.append(int(np.argmin((planes[rows, :3] @ planes[rows[found], :3].T).max(axis=1))))
    return rows[found]


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
    cut, ask, answer = (ground(own) for _ in range(3))
    add_outlines(cut, g["rooms"], SEAM, "seams")
    cut.add_points(np.delete(points, g["own"], axis=0), style=OTHERS, name="airports")
    planes = g["planes"][g["shown"]]
    add_outlines(ask, g["boxes"][meet(planes, g["boxes"]).any(axis=0)], BOX, "boxes")
    ask.add_circles([SphereCircle(plane[:3], plane[3]) for plane in planes], color=None, style=BUBBLE, name="bubbles")
    ask.add_points(points[np.setdiff1d(g["alone"], g["own"])], style=ALONE, name="one_of_a_box")
    pairs = np.unique(np.sort(g["triangles"][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    answer.add_great_circles(points[pairs[:, 0]], points[pairs[:, 1]], style=EDGE, name="triangles")
    answer.add_points(points[g["new"]], style=READ, name="read")
    for globe in (cut, ask, answer):
        globe.add_points(points[g["own"]], style=OWN, name="own")
    titles = (f"Cut: {len(g['rooms'])} partitions", "Ask: bubbles of one", "Answer: points of the boxes")
    globes = zip((cut, ask, answer), titles, strict=True)
    page = panels([Panel(globe, view=VIEW, title=title) for globe, title in globes])
    return with_legend(page, LEGEND, columns=3, indent=12.0)


def add_outlines(globe: Globe, boxes: np.ndarray, style: LineStyle, name: str) -> None:
    """What bounds the parts of the sphere of boxes."""
    steps = np.array([arc.sample(STEPS) for box in boxes for arc in outline(box)])
    globe.add_great_circles(steps[:, :-1].reshape(-1, 3), steps[:, 1:].reshape(-1, 3), style=style, name=name)


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
