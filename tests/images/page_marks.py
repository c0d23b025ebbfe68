"""What a vector file of a page must show, made from the page alone, and how what it shows differs."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from stereodel.constants import FINEST_PLACE
from stereodel.drawing.page import FEW_COLORS, Dots, Fill, Label, Picture, Polygons, Polylines, Stroke
from stereodel.drawing.style import PRINT_DPI
from stereodel.render.light import ball_gradient
from stereodel.render.shapes import has_length
from tests.images.loops_boundary import LoopsBoundary, union_boundary
from tests.images.marks import PLACE, Light, Mark, Path, area, distances, tidy, together

WIDTH = 1e-5
"""Points by which a width or the length of a dash may differ: files hold six digits of a width."""

CORNER = 2e-3
"""Points by which a picture may lie elsewhere: each side is rounded to a thousandth, and so is its length."""


ROUNDED = 2e-4
"""Levels by which a colour may be nearer to another level: PDF holds six decimals of it."""

OFFSET = 1e-4
"""By which an offset of a gradient may differ: files hold four digits."""

LEVEL = 0.5001 / 255
"""The same of a colour of a gradient, which SVG rounds to whole levels."""


@dataclass(frozen=True, eq=False)
class Expected:
    """A mark, or what is known of one."""

    name: str
    mark: Mark
    check: Callable | None = None
    """(mark) → what is wrong, or nothing; in place of the comparison of paths."""


def differences(page, sheet, wanted):
    """What is wrong with what a file shows and tells, a line each; the type comes last and is not looked at.

    Parameters
    ----------
    page : Page
    sheet
        What was read of the file.
    wanted : list of Expected
        `expected` of the page.

    Returns
    -------
    list of str, list of Mark
        The second are the marks of the type.
    """
    whole = (page.width, page.height)
    wrong = [] if np.allclose(sheet.size, whole, rtol=0.0, atol=PLACE) else [f"size {sheet.size}, expected {whole}"]
    for what in ("title", "description"):
        if getattr(sheet, what) != getattr(page, what):
            wrong.append(f"{what} {getattr(sheet, what)!r}, expected {getattr(page, what)!r}")
    found, type_marks = _split(sheet.marks, wanted)
    if len(found) < len(wanted):
        wrong.append(f"{len(found)} marks, expected {len(wanted)}")
    for want, mark in zip(wanted, found, strict=False):
        wrong += [f"{want.name}: {what}" for what in _mark_difference(want, mark, whole)]
    return wrong, type_marks


def expected(page, pictures=()):
    """The marks of a page but for its type, in order."""
    return list(_merged(_marks(page, pictures)))


def _marks(page, pictures):
    yield Expected("ground", Mark("fill", levels_of(page.background), _rectangle(page.width, page.height)))
    rest = iter(pictures)
    place = _Place(page)
    for number, item in enumerate(page.items):
        name = f"{number} {type(item).__name__} {item.name}".rstrip()
        for mark, check in place.marks(item, rest):
            yield Expected(name, mark, check)


def _merged(wanted):
    """Neighbours that are opaque lines of one style as one mark: how many paths they are written as does not show."""
    for style, group in groupby(wanted, key=lambda want: _style(want.mark)):
        group = list(group)
        if style is None:
            yield from group
        else:
            path = together(want.mark.path for want in group)
            yield replace(group[0], name=f"{group[0].name} to {group[-1].name}", mark=replace(group[0].mark, path=path))


def _style(mark):
    if mark.kind != "stroke" or mark.color[3] != 255:
        return None
    return (mark.color, mark.width, mark.dash, mark.cap, mark.join)


class _Place:
    """A page in points."""

    def __init__(self, page):
        self.page = page
        self.corner = np.array([page.extent[0], page.extent[2]])
        self.scale = page.width / (page.extent[1] - page.extent[0])

    def __call__(self, points):
        return (np.asarray(points) - self.corner) * self.scale

    def marks(self, item, pictures):
        match item:
            case Stroke() if has_length(item, self.scale):
                path = self.path([item.path], item.closed)
                if item.cap == "round":  # its ends meet, and are as round as a join
                    path = replace(path, closed=np.zeros_like(path.closed))
                yield _stroke(item, path, item.dash or (), item.cap), None
            case Stroke():
                pass
            case Polylines():
                yield from self.lines(item)
            case Fill():
                path = self.path(item.paths, closed=True)
                yield Mark("fill", levels_of(item.color), path, light=self.light(item.ball, item.color)), None
            case Dots():
                yield from self.dots(item)
            case Polygons():
                yield from self.polygons(item, pictures)
            case Picture():
                yield self.picture(item), None
            case Label():
                pass
            case _:
                raise NotImplementedError(type(item).__name__)

    def path(self, runs, closed):
        """Runs of cubics, each closed by a straight piece where its ends differ."""
        parts = []
        for run in runs:
            pieces = self(run)
            if closed:
                pieces = np.concatenate([pieces, np.linspace(pieces[-1, 3], pieces[0, 0], 4)[None]])
            parts.append(tidy(pieces, np.zeros(len(pieces), np.intp), np.array([closed])))
        return together(parts)

    def lines(self, item):
        """Straight pieces, and discs for points alone."""
        points, sizes = self(item.points), np.diff(item.offsets)
        line = np.repeat(np.arange(len(sizes)), sizes)
        short = np.array([np.ptp(row, axis=0).max() <= FINEST_PLACE for row in np.split(points, item.offsets[1:-1])])
        begin = np.flatnonzero((line[1:] == line[:-1]) & ~short[line[1:]])
        if len(begin):
            pieces = np.linspace(points[begin], points[begin + 1], 4, axis=1)
            path = tidy(pieces, line[begin], np.zeros(len(sizes), dtype=bool))
            yield _stroke(item, path, (), "round"), None
        centers = points[item.offsets[:-1][short]]
        if len(centers):
            yield self.discs(centers, item.width / 2, item.color)

    def discs(self, centers, radius, color):
        return Mark("fill", levels_of(color)), lambda mark: _disc_difference(mark, centers, radius)

    def polygons(self, item, pictures):
        """A path for each colour in their order, or a picture that shows within all loops."""
        loops = np.split(self(item.points), item.offsets[1:-1])
        colors = item.colors[item.owner]
        distinct = np.unique(colors, axis=0)
        if len(distinct) > FEW_COLORS:
            pixels = np.dstack([picture := next(pictures), np.full(picture.shape[:2], 255, np.uint8)])
            place = (0.0, 0.0, self.page.width, self.page.height)
            yield Mark("image", place=place, pixels=pixels), union_boundary(loops).wrong
            return
        for color in distinct:
            own = [loop for loop, its in zip(loops, colors, strict=True) if (its == color).all()]
            yield Mark("fill", levels_of(color), light=self.light(item.ball, color)), LoopsBoundary(own).wrong

    def light(self, ball, color):
        """The gradient of the unit disc on a ball."""
        if ball is None:
            return None
        unit = ball_gradient()
        focus, center = (self(np.array(ball.center) + ball.radius * np.array(p)) for p in (unit.focus, unit.center))
        colors = np.array(unit.brightness)[:, None] * np.array(color[:3])
        return Light(focus, center, unit.radius * ball.radius * self.scale, np.array(unit.offsets), colors)

    def dots(self, item):
        """Discs, and smaller ones on top where there is a rim."""
        centers = self(item.centers)
        discs = [(item.radius, item.rim if item.rim_width else item.color)]
        if item.rim_width:
            discs.append((item.radius - item.rim_width, item.color))
        for radius, color in discs:
            yield self.discs(centers, radius, color)

    def picture(self, item):
        """Pixels of print on a grid from the upper left corner of the page, as many as the outline needs."""
        side = 72 / PRINT_DPI
        clip = self.path(item.outline, closed=True)
        left, bottom, right, top = clip.box() / side
        height = self.page.height / side
        columns = np.array([np.floor(left), np.ceil(right)])
        rows = np.array([np.floor(height - top), np.ceil(height - bottom)])
        size = side / self.scale
        corner = (self.page.extent[0] + columns[0] * size, self.page.extent[3] - rows[0] * size, size, size)
        pixels = item.painter.paint(corner, (int(np.ptp(columns)), int(np.ptp(rows))))
        place = side * np.array([columns[0], height - rows[1], columns[1], height - rows[0]])
        return Mark("image", place=tuple(place), pixels=pixels, clips=(clip,))


def _stroke(item, path, dash, cap):
    return Mark("stroke", levels_of(item.color), path, item.width, tuple(dash), cap, "round")


def _rectangle(width, height):
    corners = np.array([(0, 0), (width, 0), (width, height), (0, height), (0, 0)], dtype=float)
    return Path(np.linspace(corners[:-1], corners[1:], 4, axis=1), np.zeros(4, np.intp), np.array([True]))


def _split(marks, wanted):
    """Marks as they were expected, opaque lines of one style as one, and what is left: the type."""
    found, rest = [], list(marks)
    for want in wanted:
        if not rest:
            break
        group = [rest.pop(0)]
        if _style(want.mark) is not None:
            runs = len(want.mark.path.closed) - len(group[0].path.closed) if group[0].path else 0
            while rest and runs > 0 and _style(rest[0]) == _style(group[0]) is not None:
                runs -= len(rest[0].path.closed)
                group.append(rest.pop(0))
        found.append(group[0] if len(group) == 1 else replace(group[0], path=together(m.path for m in group)))
    return found, rest


def _mark_difference(want, mark, page):
    expected = want.mark
    if mark.kind != expected.kind:
        return [f"a {mark.kind}, expected a {expected.kind}"]
    if mark.kind == "image":
        found = _picture_difference(mark, expected, want.check)
        return [found] if found else []
    lit = [mark.light is not None, expected.light is not None]
    if lit[0] != lit[1]:
        return [f"is lit: {lit[0]}, expected {lit[1]}"]
    ours, theirs = ((*m.color[:3] * (not lit[0]), m.color[3]) for m in (mark, expected))
    wrong = [] if same_color(ours, theirs) else [f"colour {mark.color}, expected {expected.color}"]
    if lit[0]:
        wrong += _light_differences(mark.light, expected.light)
    if mark.kind == "stroke":
        for what in ("width", "dash"):
            ours, theirs = getattr(mark, what), getattr(expected, what)
            if np.shape(ours) != np.shape(theirs) or not np.allclose(ours, theirs, rtol=0.0, atol=WIDTH):
                wrong.append(f"{what} {ours}, expected {theirs}")
        if (mark.cap, mark.join) != (expected.cap, expected.join):
            wrong.append(f"{mark.cap} ends, {mark.join} joins, expected {expected.cap}, {expected.join}")
    if mark.clips:
        wrong.append("is clipped")
    if want.check is not None:
        found = want.check(mark)
    else:
        found = path_difference(mark.path, expected.path, filled=mark.kind == "fill", cap=mark.cap, page=page)
        if not found and mark.kind == "fill":
            found = _winding_difference(mark)
    return [*wrong, found] if found else wrong


def _light_differences(light, expected):
    """How a gradient differs from another."""
    wrong = []
    for what, limit in (("focus", PLACE), ("center", PLACE), ("radius", PLACE), ("offsets", OFFSET), ("colors", LEVEL)):
        ours, theirs = getattr(light, what), getattr(expected, what)
        if np.shape(ours) != np.shape(theirs) or np.abs(np.subtract(ours, theirs)).max() > limit:
            wrong.append(f"{what} of its light {ours}, expected {theirs}")
    return wrong


def same_color(found, expected):
    """Whether a colour in whole levels is the nearest one, as either of two may be."""
    return bool(np.all(np.abs(np.subtract(found, expected)) <= 0.5 + ROUNDED))


def levels_of(color):
    """A colour in levels of 1/255, which need not be whole."""
    return tuple(255.0 * value for value in color)


def path_difference(path, expected, *, filled=False, cap="butt", page=None):
    """How a path differs from the expected one; filled ones may run the other way round, others end beyond the page."""
    if len(path.closed) != len(expected.closed):
        return f"{len(path.closed)} runs, expected {len(expected.closed)}"
    shut = [_shut(p, cap) for p in (path, expected)]
    # Rounding may close or open a gap of no more than its steps.
    nearly = [_shut(p, cap, 3 * PLACE) for p in (path, expected)]
    differ = (shut[0] & ~nearly[1]) | (shut[1] & ~nearly[0])
    ours, theirs = path.runs(), expected.runs()
    if path.pieces.shape == expected.pieces.shape and (path.run == expected.run).all():
        apart = np.abs(path.pieces - expected.pieces).max(axis=(1, 2), initial=0.0)
        other = np.bincount(path.run[apart > PLACE], minlength=len(ours)) > 0
    else:
        other = np.ones(len(ours), dtype=bool)
    other |= differ & (not filled)
    for number in np.flatnonzero(other):
        leaves = not filled and page is not None and (_beyond(ours[number], page) or _beyond(theirs[number], page))
        if not leaves and not filled and differ[number]:
            return f"run {number} is closed or is open, and must not be"
        apart = _run_difference(ours[number], theirs[number], filled, page if leaves else None)
        if apart > PLACE:
            return f"run {number}, from {theirs[number][0, 0].round(1).tolist()} on, lies {apart:.4g} points off"
    return ""


def _beyond(run, page):
    """Whether a run leaves the page: a file may leave out what no one sees."""
    return bool((run < 0).any() or (run > np.array(page)).any())


def _on_page(chords, page):
    """The parts of chords (n, 2, 2) that lie on the page."""
    start, step = chords[:, 0], chords[:, 1] - chords[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        ways = np.stack([(0.0 - start) / step, (np.array(page) - start) / step])
    inside = (start >= 0) & (start <= np.array(page))
    enter = np.where(step == 0, np.where(inside, 0.0, 2.0), ways.min(axis=0)).max(axis=1).clip(min=0.0)
    leave = np.where(step == 0, 1.0, ways.max(axis=0)).min(axis=1).clip(max=1.0)
    kept = enter <= leave
    return np.stack([(start + s[:, None] * step)[kept] for s in (enter, leave)], axis=1)


def _shut(path, cap, within=PLACE):
    """Which runs look closed: a round end on a round beginning is a round join."""
    if cap != "round":
        return path.closed
    first = np.searchsorted(path.run, np.arange(len(path.closed)))
    last = np.append(first[1:], len(path.run)) - 1
    return path.closed | (np.abs(path.pieces[first, 0] - path.pieces[last, 3]).max(axis=1, initial=0.0) <= within)


def _run_difference(ours, theirs, filled, page):
    """Largest distance between two runs, or between what is seen of them on a page."""
    if ours.shape == theirs.shape:
        ways = [theirs, theirs[::-1, ::-1]] if filled else [theirs]
        apart = min(float(np.abs(ours - way).max()) for way in ways)
        if apart <= PLACE:
            return apart
    chords = [Path(run, np.zeros(len(run), np.intp), np.array([filled])).chords()[0] for run in (ours, theirs)]
    if page is not None:
        chords = [_on_page(both, page) for both in chords]
        if not all(map(len, chords)):
            return np.inf if any(map(len, chords)) else 0.0
    elif not filled:
        ends = [np.array([run[0, 0], run[-1, 3]]) for run in (ours, theirs)]
        if (apart := float(np.abs(ends[0] - ends[1]).max())) > PLACE:
            return apart
    return max(float(distances(a.reshape(-1, 2), b).max()) for a, b in (chords, chords[::-1]))


def _winding_difference(mark):
    """Whether the rule of the file fills what the even-odd rule does; runs do not cross."""
    if mark.even_odd or len(mark.path.closed) == 1:
        return ""
    chords, run = mark.path.chords(1e-2)
    signs = np.sign(area(mark.path))
    for number in range(len(signs)):
        start = mark.path.pieces[mark.path.run == number][0, 0]
        inside = [signs[k] for k in range(len(signs)) if k != number and _inside(start, chords[run == k])]
        around, within = sum(inside), sum(inside) + signs[number]
        if (around != 0) != (len(inside) % 2 == 1) or (within != 0) != (len(inside) % 2 == 0):
            return f"run {number} goes round the wrong way"
    return ""


def _inside(point, chords):
    (x0, y0), (x1, y1) = (chords[:, end].T - point[:, None] for end in (0, 1))
    crosses = (y0 > 0) != (y1 > 0)
    return np.count_nonzero((x0 + (x1 - x0) * -y0 / np.where(crosses, y1 - y0, 1.0) > 0) & crosses) % 2 == 1


def _disc_difference(mark, centers, radius):
    """Whether the runs are circles about the centres, each once round."""
    path = mark.path
    if len(path.closed) != len(centers):
        return f"{len(path.closed)} discs, expected {len(centers)}"
    chords, run = path.chords(PLACE)
    start, end = (chords[:, k] - centers[run] for k in (0, 1))
    off = np.abs(np.linalg.norm(chords[:, 0] - centers[run], axis=1) - radius)
    if off.max(initial=0.0) > PLACE:
        return f"disc {run[np.argmax(off)]} is {off.max():.4g} points off"
    turn = np.arctan2(start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0], (start * end).sum(axis=1))
    turns = np.bincount(run, weights=turn, minlength=len(centers)) / (2 * np.pi)
    return "" if np.allclose(np.abs(turns), 1.0, atol=1e-3) else "discs are not closed"


def _picture_difference(mark, expected, check):
    if not np.allclose(mark.place, expected.place, rtol=0.0, atol=CORNER):
        return f"place {mark.place}, expected {expected.place}"
    if mark.pixels.shape != expected.pixels.shape:
        return f"pixels {mark.pixels.shape}, expected {expected.pixels.shape}"
    seen = (mark.pixels[..., 3] > 0) | (expected.pixels[..., 3] > 0)
    if (mark.pixels != expected.pixels)[seen].any():
        return "other pixels"
    if len(mark.clips) != 1:
        return f"{len(mark.clips)} outlines, expected one"
    if check is not None:
        return check(Mark("fill", path=mark.clips[0]))
    return path_difference(mark.clips[0], expected.clips[0], filled=True)
