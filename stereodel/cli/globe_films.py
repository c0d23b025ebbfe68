"""Films of `stereodel globe`: motion and output."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from stereodel import MoebiusMap
from stereodel.cli.globe_aim import Aim, Place
from stereodel.cli.globe_options import Projection
from stereodel.conformal import path_between
from stereodel.film import Film, Flight, FrameError, Morph, Spin, Stop
from stereodel.film.shots import Motion
from stereodel.globe import Globe

FILM_SPACING = 15.0  # of the graticule, in degrees: a spacing adapted to each frame would flicker
KEPT = "interrupted; the same command draws the missing frames"


def motion_of(aim: Aim, *, spin: bool, stops: Sequence[Place], seconds: float) -> Motion:
    """A flight if there are stops, a turn if requested or if nothing is magnified, otherwise a growing lens."""
    if spin and stops:
        raise ValueError("--spin and --fly cannot be combined; choose one")
    if aim.projection == Projection.hemispheres or (aim.projection != Projection.globe and (spin or stops)):
        raise ValueError(f"--projection {aim.projection.value} cannot move; --spin and --fly are for the globe")
    if stops:
        return Flight([Stop(place, aim.magnification) for place in (aim.place, *stops)])
    if spin or aim.magnification == 1:
        lon, lat = aim.middle or aim.place
        return Spin(aim.lens, seconds=seconds, lon=lon, lat=lat)
    return Morph(path_between(MoebiusMap.identity(), aim.lens), aim.views[0], seconds=seconds, back=True)


def save_film(globe: Globe, motion: Motion, path: Path, *, size: int, fps: float, kept: bool) -> None:
    """Draw the frames and write the file; after an interruption, finished frames may be kept next to it."""
    try:
        Film.of_globe(globe, motion, size=(size, size), fps=fps).save(path, progress=sys.stderr.isatty())
    except FrameError as error:
        raise OSError(str(error)) from error
    except KeyboardInterrupt:
        raise KeyboardInterrupt(KEPT if kept else "") from None
