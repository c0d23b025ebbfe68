"""Films of `stereodel globe`: what moves, and how it is written."""

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

FILM_SPACING = 15.0  # of the graticule, degrees: one that suited each frame would come and go
KEPT = "interrupted; the same command goes on with the frames that are missing"


def motion_of(aim: Aim, *, spin: bool, stops: Sequence[Place], seconds: float) -> Motion:
    """A flight where there are stops, a turn where it is asked for or nothing is magnified, else a lens that grows."""
    if spin and stops:
        raise ValueError("--spin and --fly are two films; choose one")
    if aim.projection == Projection.hemispheres or (aim.projection != Projection.globe and (spin or stops)):
        raise ValueError(f"--projection {aim.projection.value} stands still; --spin and --fly are for the globe")
    if stops:
        return Flight([Stop(place, aim.magnification) for place in (aim.place, *stops)])
    if spin or aim.magnification == 1:
        lon, lat = aim.middle or aim.place
        return Spin(aim.lens, seconds=seconds, lon=lon, lat=lat)
    return Morph(path_between(MoebiusMap.identity(), aim.lens), aim.views[0], seconds=seconds, back=True)


def save_film(globe: Globe, motion: Motion, path: Path, *, size: int, fps: float, kept: bool) -> None:
    """Draw the frames and write the file; after an interruption those that are finished may be kept beside it."""
    try:
        Film.of_globe(globe, motion, size=(size, size), fps=fps).save(path, progress=sys.stderr.isatty())
    except FrameError as error:
        raise OSError(str(error)) from error
    except KeyboardInterrupt:
        raise KeyboardInterrupt(KEPT if kept else "") from None
