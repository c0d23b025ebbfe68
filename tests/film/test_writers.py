"""Each format read back by another program: frames, sizes, times, loops, colours; and what is refused."""

import subprocess
import sys

import av
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from stereodel.film import Film
from stereodel.film.writers import FORMATS, frame_seconds, whole_ticks
from tests.examples import examples

LOOPING = ("gif", "png", "apng", "webp")


def disc(x, size=(48, 64)):
    """A red disc on white, with a still blue bar."""
    rows, columns = np.mgrid[: size[0], : size[1]]
    picture = np.full((*size, 3), 255, dtype=np.uint8)
    picture[-6:] = (0, 60, 200)
    picture[(rows - 20) ** 2 + (columns - x) ** 2 < 100] = (200, 20, 30)
    return picture


REEL = [disc(x) for x in (10, 20, 20, 40, 55)]


def read(path):
    """Frames as Pillow sees them, and how long it shows each, in milliseconds."""
    with Image.open(path) as image:
        frames, times = [], []
        for number in range(image.n_frames):
            image.seek(number)
            frames.append(np.asarray(image.convert("RGB")))
            times.append(image.info["duration"])
        return np.stack(frames), times, image.info["loop"]


def save(reel, path, **how):
    """The file of a film of these pictures."""
    return Film.of_pictures(reel, **how).save(path, progress=False)


def decoded(path):
    """All frames of a file as FFmpeg sees them, and when each is shown, in seconds."""
    with av.open(str(path)) as file:
        frames = list(file.decode(video=0))
    return np.stack([frame.to_ndarray(format="rgb24") for frame in frames]), [float(frame.time) for frame in frames]


@pytest.mark.parametrize("ending", LOOPING)
def test_frames_times_and_loop(tmp_path, ending):
    file = save(REEL, tmp_path / f"moving.{ending}", seconds=(0.1, 0.2, 0.04, 0.5, 1.0))
    frames, times, loop = read(file)
    assert loop == 0
    if ending == "webp":  # equal neighbours become one frame
        frames, times = frames[[0, 1, 1, 2, 3]], [times[0], 200, times[1] - 200, *times[2:]]
    assert times == [100, 200, 40, 500, 1000]
    assert [path.name for path in tmp_path.iterdir()] == [file.name]
    apart = np.abs(frames.astype(int) - np.stack(REEL))
    assert apart.mean() < 2 if ending == "webp" else apart.max() == 0
    with Image.open(save(REEL[:1], tmp_path / f"still.{ending}", seconds=1.0)) as image:  # a film too
        assert np.abs(np.asarray(image.convert("RGB")).astype(int) - REEL[0]).mean() < 2


def test_mp4(tmp_path):
    file = save(REEL * 4, tmp_path / "moving.mp4", seconds=1 / 12.5)
    with av.open(str(file)) as video:
        (stream,) = video.streams
        found = stream.codec_context
        assert (found.name, found.pix_fmt, stream.average_rate) == ("h264", "yuv420p", 12.5)
        # Limited range; matrix and primaries of HD television, sRGB's curve: FFmpeg's numbers for them.
        assert (found.color_range, found.colorspace, found.color_primaries, found.color_trc) == (1, 1, 1, 13)
        assert float(stream.duration * stream.time_base) == pytest.approx(1.6)
    frames, _ = decoded(file)
    assert len(frames) == 20
    # Half the colour of a pixel is that of its neighbours, so edges are off, but the fills are not.
    assert np.abs(frames[7, 20, 20].astype(int) - (200, 20, 30)).max() <= 6
    assert np.abs(frames[7, -3, 30].astype(int) - (0, 60, 200)).max() <= 6


def test_each_frame_of_an_mp4_has_its_time(tmp_path):
    file = save(REEL, tmp_path / "moving.mp4", seconds=(0.1, 0.2, 0.04, 0.5, 1.0))
    frames, times = decoded(file)
    assert len(frames) == 5
    assert times == pytest.approx([0.0, 0.1, 0.3, 0.34, 0.84])
    with av.open(str(file)) as video:
        assert video.duration / av.time_base == pytest.approx(1.84, abs=2e-3)


def test_mp4_has_even_sizes_and_begins_with_its_index(tmp_path):
    file = save([disc(x, (47, 63)) for x in (10, 30)], tmp_path / "odd.mp4")
    frames, _ = decoded(file)
    assert frames.shape == (2, 48, 64, 3)
    assert np.abs(frames[0, -1].astype(int) - frames[0, -2]).max() <= 4
    data = file.read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


def test_an_mp4_has_the_same_bytes_each_time(tmp_path):
    """Of pictures large and restless enough that x264 uses all its code; with trees of macroblocks it fails."""
    y, x = np.mgrid[:180, :240]
    noise = np.random.default_rng(0).integers(0, 40, (180, 240, 3))
    waves = [100 * np.sin((x + 3 * k) / 30) * np.cos((y + 2 * k) / 25) for k in range(24)]
    reel = [np.clip(110 + wave[..., None] + noise, 0, 255).astype(np.uint8) for wave in waves]
    files = {save(reel, tmp_path / f"{k}.mp4", fps=25).read_bytes() for k in range(4)}
    assert len(files) == 1


@pytest.mark.parametrize("ending", ["gif", "png"])
@examples(0.5)
@given(data=st.data())
def test_whatever_changes_is_seen(tmp_path_factory, ending, data):
    """Random pictures of few colours: each frame comes back, whichever rectangle changed; in a GIF to a rounding."""
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32)))
    height, width, count = (data.draw(st.integers(1, 20)) for _ in range(3))
    colors = rng.integers(0, 256, (5, 3), dtype=np.uint8)
    reel = [colors[rng.integers(0, 5, (height, width))]]
    for _ in range(count):
        rows, columns = (slice(*sorted(rng.integers(0, side + 1, 2))) for side in (height, width))
        now = reel[-1].copy()
        now[rows, columns] = colors[rng.integers(0, 5, now[rows, columns].shape[:2])]
        reel.append(now)
    file = save(reel, tmp_path_factory.mktemp("film") / f"film.{ending}")
    frames, _, _ = read(file)
    assert np.abs(frames.astype(int) - reel).max() <= (2 if ending == "gif" else 0)


def test_what_a_gif_shows_long_has_its_colours(tmp_path):
    """A still among hundreds of frames that move keeps its tints, wherever it stands."""
    rows, columns = np.mgrid[:16, :16]
    moving = [
        np.stack([rows * 16, columns * 16, np.full((16, 16), 2 * k)], axis=-1).astype(np.uint8) for k in range(90)
    ]
    still = np.stack([np.full((16, 16), 250), 6 * rows + 90, 6 * columns], axis=-1).astype(np.uint8)
    errors = []
    for place in (7, 41, 80):
        reel = [*moving[:place], still, *moving[place:]]
        seconds = [0.04] * place + [2.5] + [0.04] * (90 - place)
        frames, _, _ = read(save(reel, tmp_path / f"{place}.gif", seconds=seconds))
        errors.append(np.abs(frames[place].astype(float) - still).mean())
    assert max(errors) < 8, errors


@given(st.integers(1, 400), st.floats(1, 200), st.sampled_from([100, 1000]))
def test_times_add_up(count, rate, per_second):
    ticks = whole_ticks(frame_seconds(1 / rate, count), per_second)
    assert np.abs(np.cumsum(ticks) / per_second - np.arange(1, count + 1) / rate).max() <= 0.5 / per_second + 1e-9


@pytest.mark.parametrize("ending", [*LOOPING, "mp4"])
def test_bad_reels_and_times_leave_no_file(tmp_path, ending):
    target = tmp_path / f"moving.{ending}"
    shapes = REEL[0][..., 0], np.zeros((4, 4, 4), np.uint8), np.zeros((0, 4, 3), np.uint8)
    for reel, seconds, message in [
        ([], None, "shots is empty"),
        ([REEL[0], REEL[0][:40]], None, "frame 1 has 64 by 40 pixels and differs from the first with 64 by 48"),
        (REEL, (0.1, 0.2), "seconds has 2 entries for 5 frames"),
        *((REEL, wrong, "must be positive") for wrong in (0.0, -1.0)),
        *((REEL, wrong, "seconds") for wrong in (np.nan, "x")),
        ([1.0 * REEL[0]], None, r"pictures\[0\] must be of uint8, not float64; scale"),
        *(([REEL[0], wrong], None, r"frame 1 must have shape \(h, w, 3\)") for wrong in shapes),
    ]:
        with pytest.raises((ValueError, TypeError), match=message):
            save(reel, target, seconds=seconds)
    assert list(tmp_path.iterdir()) == []


def test_what_a_format_cannot_hold_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"fast\.gif would be shown for 0\.0100 s each.*at most 50 frames a second"):
        save(REEL, tmp_path / "fast.gif", seconds=0.01)
    with pytest.raises(ValueError, match=r"size of wide\.webp is 16384 pixels, but the format has at most 16383"):
        save([np.zeros((1, 16384, 3), dtype=np.uint8)], tmp_path / "wide.webp")
    save(REEL, tmp_path / "fifty.gif", seconds=1 / 50)


@pytest.mark.parametrize("ending", [*LOOPING, "mp4"])
def test_a_full_disk_is_an_error(tmp_path, ending):
    full = tmp_path / f"full.{ending}"
    full.symlink_to("/dev/full")
    with pytest.raises(OSError, match=r"full\.\w+ cannot be written: .*No space left|No space left"):
        FORMATS[full.suffix].write(REEL, full, np.full(5, 0.1))


@pytest.mark.parametrize(
    ("ending", "most", "megabytes"),
    [
        ("gif", 300, 15),
        pytest.param("gif", 1000, 30, marks=pytest.mark.thorough),
        pytest.param("mp4", 1000, 30, marks=pytest.mark.thorough),
        pytest.param("apng", 1000, 30, marks=pytest.mark.large),
    ],
)
def test_a_film_of_any_length_needs_the_memory_of_some_frames(tmp_path, ending, most, megabytes):
    """What FFmpeg holds is seen from outside only: peaks of processes that write many more frames, of 0.12 MB each.

    Not by getrusage, which counts the memory of the process that started them.
    """
    code = r"""
import re, sys
import numpy as np
from pathlib import Path
from stereodel.film import Film
class Noise:
    def __init__(self, count): self.count = count
    def __len__(self): return self.count
    def __getitem__(self, k): return np.random.default_rng(k).integers(0, 256, (200, 200, 3), dtype=np.uint8) // 64 * 64
Film.of_pictures(Noise(int(sys.argv[2]))).save(Path(sys.argv[1]), progress=False)
print(int(re.search(r"VmHWM:\s*(\d+)", open("/proc/self/status").read())[1]) / 1024)
"""
    peaks = []
    for count in (most // 10, most):
        command = [sys.executable, "-c", code, str(tmp_path / f"noise.{ending}"), str(count)]
        peaks.append(float(subprocess.run(command, capture_output=True, text=True, check=True).stdout))
    assert peaks[1] - peaks[0] < megabytes
