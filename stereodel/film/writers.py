"""Film files, by file extension: GIF, APNG, WebP or MP4, with one frame in memory at a time.

GIF, APNG and MP4 are encoded by FFmpeg's libraries through PyAV: of imageio's plugins, ``pyav`` passes no options to
the encoder, and ``ffmpeg`` ignores the exit code of the program, so that a full disk yields half a film and no error.
WebP is written by Pillow, as FFmpeg's encoder loses the duration of the last frame; its writers of GIF and APNG would
hold all frames, and its palettes lose 3 to 5 dB of signal-to-noise ratio on a softly lit globe.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any, Final, Protocol

import numpy as np

from stereodel._arrays import FloatArray, Pixels, as_floats, as_frame
from stereodel._extras import optional
from stereodel.constants import FRAME_ROUNDING


class Reel(Protocol):
    """Frames (h, w, 3) by number, such as a list, or a folder of image files read on access."""

    def __len__(self) -> int: ...
    def __getitem__(self, number: int, /) -> Pixels: ...


Writer = Callable[[Reel, Path, FloatArray], None]


@dataclass(frozen=True)
class Format:
    """A file format: its writer and its limits.

    largest: largest width or height in pixels.
    shortest: shortest duration of a frame in seconds.
    library: module of the extra ``film`` that encodes.
    """

    write: Writer
    largest: int
    shortest: float
    library: str = "av"

    def check(self, name: str, sides: Sequence[int], seconds: FloatArray) -> None:
        """Raise ValueError or ImportError if frames of these sides and durations cannot be written to `name`."""
        optional(self.library, "film")
        if max(sides) > self.largest:
            raise ValueError(f"size of {name} is {max(sides)} pixels, but the format has at most {self.largest}")
        if seconds.min() < self.shortest * (1 - FRAME_ROUNDING):
            raise ValueError(
                f"frames of {name} would be shown for {seconds.min():.4f} s each, but the format has at least "
                f"{self.shortest:g} s: at most {1 / self.shortest:g} frames a second"
            )


def format_of(path: str | os.PathLike[str]) -> Format:
    """The format for a path's extension; ValueError lists the supported extensions for any other."""
    ending = Path(path).suffix.lower()
    if ending not in FORMATS:
        raise ValueError(f"path must end in {', '.join(FORMATS)}, got {Path(path).name!r}")
    return FORMATS[ending]


def frames_of(reel: Reel) -> Iterator[Pixels]:
    """All frames in order, one in memory at a time; ValueError if the size of one differs from the first."""
    shape: tuple[int, ...] = ()
    for number in range(len(reel)):
        picture = as_frame(reel[number], f"frame {number}")
        shape = shape or picture.shape
        if picture.shape != shape:
            raise ValueError(
                f"frame {number} has {picture.shape[1]} by {picture.shape[0]} pixels and differs from the first with "
                f"{shape[1]} by {shape[0]}; give all frames one size"
            )
        yield picture


def frame_seconds(seconds: float | Sequence[float], count: int) -> FloatArray:
    """Positive durations of `count` frames in seconds, (count,), from one number for all or one for each."""
    times = as_floats(seconds, "seconds")
    if times.ndim and times.shape != (count,):
        raise ValueError(f"seconds has {times.size} entries for {count} frames; give one number, or one for each")
    if (times <= 0).any():
        raise ValueError(f"seconds must be positive, got {times.min()}")
    return np.broadcast_to(times, (count,))


def whole_ticks(seconds: FloatArray, per_second: int) -> list[int]:
    """Durations in whole clock ticks, such that the sum of the first n is rounded correctly for every n."""
    ends = np.floor(np.cumsum(seconds) * per_second + 0.5).astype(np.int64)
    return np.diff(ends, prepend=0).tolist()


# By FFmpeg's libraries

SAMPLED: Final = 24
"""Number of moments from which the palette of a GIF is computed."""


@dataclass(frozen=True)
class _Encoder:
    """Settings of FFmpeg's libraries for a format: FFmpeg's names of it, the encoder, and its pixel format.

    filters: filters applied to each frame before encoding: their names and options.
    options, muxing: options of the encoder and of the file format.
    """

    container: str
    codec: str
    pixels: str
    filters: Sequence[tuple[str, str]] = ()
    options: dict[str, str] = field(default_factory=dict)
    muxing: dict[str, str] = field(default_factory=dict)
    threads: int = 1

    def write(
        self,
        pictures: Iterator[Pixels],
        path: Path,
        ticks: Sequence[int],
        tick: Fraction,
        *,
        muxing: dict[str, str] | None = None,
        palette: Any = None,
    ) -> None:
        """Write frames shown for `ticks` ticks of a clock each."""
        av = optional("av", "film")
        try:
            with av.open(str(path), "w", self.container, container_options=self.muxing | (muxing or {})) as file:
                # The mean rate: how many bits the MP4 encoder spends on a frame depends on its duration.
                stream = file.add_stream(self.codec, len(ticks) / (sum(ticks) * tick), self.options)
                # Frame threading: slice threading, PyAV's default, makes files up to 7 % larger.
                stream.pix_fmt, stream.thread_count, stream.thread_type = self.pixels, self.threads, "FRAME"
                stream.time_base = stream.codec_context.time_base = tick
                chain, now = None, 0
                for picture, shown in zip(pictures, ticks, strict=True):
                    frame = av.VideoFrame.from_ndarray(picture, format="rgb24")
                    frame.time_base, frame.pts, frame.duration = tick, now, shown
                    now += shown
                    if chain is None:
                        stream.width, stream.height = frame.width, frame.height
                        chain = _Chain(frame, self.filters, palette)
                    for filtered in chain(frame):
                        file.mux(stream.encode(filtered))
                for filtered in chain(None) if chain else ():
                    file.mux(stream.encode(filtered))
                file.mux(stream.encode(None))
        except av.FFmpegError as error:
            raise OSError(f"{path.name} cannot be written: {error}") from error


class _Chain:
    """A chain of FFmpeg's filters for frames like `first`; `palette` is the second input of the last filter."""

    def __init__(self, first: Any, filters: Sequence[tuple[str, str]], palette: Any = None) -> None:
        av = optional("av", "film")
        self._ends = av.BlockingIOError, av.EOFError
        self._graph = av.filter.Graph()  # the filters hold no reference to it
        self._source = self._buffer(first)
        chain = [self._source, *(self._graph.add(name, options) for name, options in filters)]
        self._sink = self._graph.add("buffersink")
        for one, other in pairwise([*chain, self._sink]):
            one.link_to(other)
        second = None if palette is None else self._buffer(palette)
        if second is not None:
            second.link_to(chain[-1], 0, 1)
        self._graph.configure()
        if second is not None:
            second.push(palette)
            second.push(None)

    def _buffer(self, like: Any) -> Any:
        sides = {"width": like.width, "height": like.height}
        return self._graph.add_buffer(**sides, format=like.format, time_base=like.time_base)

    def __call__(self, frame: Any) -> Iterator[Any]:
        """Frames that come out after `frame` goes in; None marks the end of the input."""
        self._source.push(frame)
        while True:
            try:
                yield self._sink.pull()
            except self._ends:
                return


_GIF_ENCODER = _Encoder(
    "gif",
    "gif",
    "pal8",
    # No dithering, so that still parts stay still: only the rectangle that changed is stored of each frame.
    filters=[("format", "bgra"), ("paletteuse", "dither=none:diff_mode=rectangle")],
    muxing={"loop": "0"},
)

_APNG_ENCODER = _Encoder("apng", "apng", "rgb24", options={"pred": "mixed"}, muxing={"plays": "0"})

_MP4_ENCODER = _Encoder(
    "mp4",
    "libx264",
    "yuv420p",
    # Matrix and range are set explicitly: by default FFmpeg takes those of standard definition and players those of HD.
    filters=[
        ("scale", "out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int+bitexact"),
        ("format", "yuv420p"),
    ],
    # At a rate factor of 17 or 18 no loss is visible. The file holds no version and no date. Without x264's tree of
    # macroblocks, whose fast code gives other bits each time; that also makes files smaller and takes less time.
    options={
        "crf": "17",
        "preset": "medium",
        "mbtree": "0",
        "flags": "+bitexact+frame_duration",
        "color_range": "tv",
        "colorspace": "bt709",
        "color_primaries": "bt709",
        "color_trc": "iec61966-2-1",
    },
    muxing={"movflags": "+faststart", "fflags": "+bitexact"},
    threads=4,  # the file depends on their number, so it is the same on every machine
)


def write_gif(reel: Reel, path: Path, seconds: FloatArray) -> None:
    """Write frames as a GIF of 255 colours that loops forever; durations are rounded to hundredths of a second."""
    ticks = whole_ticks(seconds, 100)
    last = {"final_delay": str(ticks[-1])}
    _GIF_ENCODER.write(
        frames_of(reel), path, ticks, Fraction(1, 100), muxing=last, palette=_shared_palette(reel, seconds)
    )


def _shared_palette(reel: Reel, seconds: FloatArray) -> Any:
    """255 colours chosen from moments spread over the whole film, as an FFmpeg frame; the last entry is transparent.

    Moments rather than frames, so that a picture shown for seconds counts fully, however many short frames surround it.
    """
    av = optional("av", "film")
    chain = None
    for now, number in enumerate(_sampled_frames(seconds)):
        frame = av.VideoFrame.from_ndarray(as_frame(reel[number], f"frame {number}"), format="rgb24")
        frame.time_base, frame.pts = Fraction(1, 100), now
        chain = chain or _Chain(frame, [("palettegen", "stats_mode=full")])
        list(chain(frame))  # nothing comes out before the input ends
    assert chain is not None
    (palette,) = chain(None)
    palette.time_base, palette.pts = Fraction(1, 100), 0
    return palette


def _sampled_frames(seconds: FloatArray) -> list[int]:
    """Indices of all frames of a short film; of a long one, those shown at the midpoints of equal parts, each once."""
    if len(seconds) <= SAMPLED:
        return list(range(len(seconds)))
    ends = np.cumsum(seconds)
    middles = (np.arange(SAMPLED) + 0.5) / SAMPLED * ends[-1]
    return [int(number) for number in np.unique(np.searchsorted(ends, middles))]


def write_apng(reel: Reel, path: Path, seconds: FloatArray) -> None:
    """Write frames losslessly as an APNG that loops forever; durations are rounded to milliseconds."""
    ticks = whole_ticks(seconds, 1000)
    last = {"final_delay": f"{ticks[-1]}/1000"}
    _APNG_ENCODER.write(frames_of(reel), path, ticks, Fraction(1, 1000), muxing=last)


def write_mp4(reel: Reel, path: Path, seconds: FloatArray) -> None:
    """Write frames as H.264 in an MP4, which plays in every browser; odd widths and heights are made even."""
    even = (_even(picture) for picture in frames_of(reel))
    if np.ptp(seconds):
        # With B-frames the film would end before the last frame has been shown for its full duration.
        encoder = replace(_MP4_ENCODER, options=_MP4_ENCODER.options | {"bf": "0"})
        encoder.write(even, path, whole_ticks(seconds, 1000), Fraction(1, 1000))
    else:
        rate = Fraction(1 / float(seconds[0])).limit_denominator(1001)
        _MP4_ENCODER.write(even, path, [1] * len(reel), 1 / rate)


def _even(picture: Pixels) -> Pixels:
    """The picture, its last row or column repeated if their number is odd: chroma is stored for blocks of 2 by 2."""
    height, width = picture.shape[:2]
    return np.pad(picture, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")


# By Pillow

WEBP_QUALITY: Final = 90
"""WebP quality, of 100: high enough for thin coloured lines to keep their colour."""


def write_webp(reel: Reel, path: Path, seconds: FloatArray) -> None:
    """Write frames as an animated WebP that loops forever; durations are rounded to milliseconds."""
    options = {"duration": whole_ticks(seconds, 1000), "loop": 0, "quality": WEBP_QUALITY, "method": 4}
    with path.open("wb") as file:
        _one_at_a_time(reel).save(file, format="webp", save_all=True, **options)


def _one_at_a_time(reel: Reel) -> Any:
    """A multi-frame image for Pillow, which reads the frames in order and keeps none."""
    pillow = optional("PIL.Image", "film")

    class Frames(pillow.Image):  # type: ignore[name-defined, misc]
        def __init__(self) -> None:
            super().__init__()
            self.n_frames = len(reel)
            self._frames = frames_of(reel)
            self._number = -1
            self.seek(0)

        def seek(self, frame: int) -> None:
            """Go to the next frame; earlier frames are gone, and Pillow's return to the first has no effect."""
            if frame > self._number:
                shown = pillow.fromarray(next(self._frames))
                self.im, self._mode, self._size, self._number = shown.im, shown.mode, shown.size, frame

    return Frames()


_APNG: Final = Format(write_apng, 2**31 - 1, 0.001)

FORMATS: Final = {
    # Browsers show frames shorter than 2/100 s five times as long.
    ".gif": Format(write_gif, 65535, 0.02),
    ".png": _APNG,
    ".apng": _APNG,
    ".webp": Format(write_webp, 16383, 0.001, library="PIL"),
    ".mp4": Format(write_mp4, 16384, 0.001),
}
