"""MP4: H.264 by ffmpeg, which the extra `video` brings; it plays in every browser."""

from __future__ import annotations

import subprocess
import tempfile
from fractions import Fraction
from pathlib import Path
from typing import Any, Final

import numpy as np

from stereodel._arrays import FloatArray
from stereodel._extras import optional
from stereodel.film.reels import Pixels, Reel, frames_of

QUALITY: Final = 17
"""Constant rate factor: the eye sees no loss at 17 or 18."""

THREADS: Final = 4
"""Of the encoder: the file depends on their number, so it is the same on every machine."""

COLORS: Final = (
    "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact,format=yuv420p,"
    "setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=iec61966-2-1"
)
"""Matrix and range written out: left alone, ffmpeg takes those of standard television and players those of HD."""

EXACT: Final = ("-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1")
"""No version and no date in the file."""


def require_ffmpeg() -> str:
    """Path of ffmpeg; an ImportError that names the extra where there is none."""
    library: Any = optional("imageio_ffmpeg", "video")
    return str(library.get_ffmpeg_exe())


def write_mp4(reel: Reel, path: Path, seconds: FloatArray) -> None:
    """Write frames as an MP4.

    Its rows and columns are even in number: the last one is repeated where they are not.

    Raises
    ------
    ValueError
        When the frames are not shown equally long.
    ImportError
        When ffmpeg is missing.
    RuntimeError
        When ffmpeg fails, with what it said.
    """
    if np.ptp(seconds) > 0:
        raise ValueError("seconds differ, but all frames of an .mp4 are shown equally long; repeat a frame to hold it")
    height, width = _even(reel[0]).shape[:2]
    rate = Fraction(1 / float(seconds[0])).limit_denominator(1001)
    command = [require_ffmpeg(), "-nostdin", "-y", "-v", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{width}x{height}", "-r", str(rate), "-i", "-", "-an", "-vf", COLORS]
    command += ["-c:v", "libx264", "-preset", "medium", "-crf", str(QUALITY), "-threads", str(THREADS), *EXACT]
    command += ["-movflags", "+faststart", "-f", "mp4", str(path)]
    # A session of its own: Ctrl-C is for this process, which then ends ffmpeg.
    with tempfile.TemporaryFile() as said, _started(command, said) as process:
        try:
            _feed(process, reel)
        except BaseException:
            process.kill()
            raise
        if process.wait():
            said.seek(0)
            raise RuntimeError(f"ffmpeg could not write {path.name}: {said.read().decode('utf-8', 'replace').strip()}")


def _started(command: list[str], said: Any) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said, start_new_session=True
    )


def _feed(process: subprocess.Popen[bytes], reel: Reel) -> None:
    assert process.stdin is not None
    try:
        for picture in frames_of(reel):
            process.stdin.write(_even(picture).tobytes())
        process.stdin.close()
    except BrokenPipeError:
        return  # it has ended: its exit code and its words tell why


def _even(picture: Pixels) -> Pixels:
    """The picture with its last row and column repeated where their number is odd: colours are kept for 2 by 2."""
    height, width = picture.shape[:2]
    return np.pad(picture, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
