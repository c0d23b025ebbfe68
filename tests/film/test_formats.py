"""Each format read back by another program: frames, sizes, times, loops, colours; and what is refused."""

import io
import subprocess

import imageio_ffmpeg
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from stereodel import _extras
from stereodel.film import save_pictures
from stereodel.film.gif import changed_box, write_gif
from stereodel.film.reels import frame_seconds, whole_ticks

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


def ffmpeg(*arguments):
    """What ffmpeg writes, and what it says."""
    ran = subprocess.run([imageio_ffmpeg.get_ffmpeg_exe(), "-nostdin", *arguments], capture_output=True)
    return ran.stdout, ran.stderr.decode()


def decoded(path, size):
    """All frames of a file as ffmpeg sees them, none repeated or left out."""
    output = ("-fps_mode", "passthrough", "-f", "rawvideo", "-pix_fmt", "rgb24", "-")
    pixels, said = ffmpeg("-v", "error", "-i", str(path), *output)
    assert said == ""
    return np.frombuffer(pixels, np.uint8).reshape(-1, *size, 3)


@pytest.mark.parametrize("ending", LOOPING)
def test_frames_times_and_loop(tmp_path, ending):
    file = save_pictures(REEL, tmp_path / f"moving.{ending}", seconds=(0.1, 0.2, 0.04, 0.5, 1.0))
    frames, times, loop = read(file)
    assert loop == 0
    if ending == "webp":  # equal neighbours become one frame
        frames, times = frames[[0, 1, 1, 2, 3]], [times[0], 200, times[1] - 200, *times[2:]]
    assert times == [100, 200, 40, 500, 1000]
    assert [path.name for path in tmp_path.iterdir()] == [file.name]
    apart = np.abs(frames.astype(int) - np.stack(REEL))
    assert apart.mean() < 2 if ending == "webp" else apart.max() == 0


def test_mp4(tmp_path):
    file = save_pictures(REEL * 4, tmp_path / "moving.mp4", seconds=1 / 12.5)
    _, about = ffmpeg("-i", str(file))
    assert "h264" in about
    assert "yuv420p(tv, bt709/bt709/iec61966-2-1" in about
    assert "12.50 fps" in about
    assert "Duration: 00:00:01.60" in about
    frames = decoded(file, (48, 64))
    assert len(frames) == 20
    # Half the colour of a pixel is that of its neighbours, so edges are off, but the fills are not.
    assert np.abs(frames[7, 20, 20].astype(int) - (200, 20, 30)).max() <= 6
    assert np.abs(frames[7, -3, 30].astype(int) - (0, 60, 200)).max() <= 6


def test_mp4_has_even_sizes_and_begins_with_its_index(tmp_path):
    file = save_pictures([disc(x, (47, 63)) for x in (10, 30)], tmp_path / "odd.mp4")
    frames = decoded(file, (48, 64))
    assert np.abs(frames[0, -1].astype(int) - frames[0, -2]).max() <= 4
    data = file.read_bytes()
    assert 0 < data.index(b"moov") < data.index(b"mdat")


@pytest.mark.parametrize("ending", [*LOOPING, "mp4"])
def test_the_same_frames_give_the_same_bytes(tmp_path, ending):
    first, second = (save_pictures(REEL, tmp_path / f"{name}.{ending}") for name in "ab")
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.parametrize("ending", LOOPING)
def test_one_frame_is_a_film_too(tmp_path, ending):
    with Image.open(save_pictures(REEL[:1], tmp_path / f"still.{ending}")) as image:
        assert np.abs(np.asarray(image.convert("RGB")).astype(int) - REEL[0]).mean() < 2


@pytest.mark.parametrize("ending", ["gif", "png"])
@settings(max_examples=15)
@given(data=st.data())
def test_whatever_changes_is_seen(tmp_path_factory, ending, data):
    """Random pictures of few colours: each frame comes back as it was, whichever rectangle changed."""
    rng = np.random.default_rng(data.draw(st.integers(0, 2**32)))
    height, width, count = (data.draw(st.integers(1, 20)) for _ in range(3))
    colors = rng.integers(0, 256, (5, 3), dtype=np.uint8)
    reel = [colors[rng.integers(0, 5, (height, width))]]
    for _ in range(count):
        rows, columns = (slice(*sorted(rng.integers(0, side + 1, 2))) for side in (height, width))
        now = reel[-1].copy()
        now[rows, columns] = colors[rng.integers(0, 5, now[rows, columns].shape[:2])]
        reel.append(now)
    file = save_pictures(reel, tmp_path_factory.mktemp("film") / f"film.{ending}")
    frames, _, _ = read(file)
    assert np.array_equal(frames, reel)


def test_a_gif_of_a_million_colours_is_near_them(tmp_path):
    y, x = np.mgrid[0:256, 0:256]
    reel = [np.stack([x, y, np.full_like(x, blue)], axis=-1).astype(np.uint8) for blue in (0, 100, 200)]
    frames, _, _ = read(save_pictures(reel, tmp_path / "many.gif"))
    assert np.abs(frames.astype(int) - reel).mean() < 14


def test_a_palette_may_be_smaller():
    files = [io.BytesIO() for _ in range(2)]
    noise = list(np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8))
    for file, colors in zip(files, (255, 16), strict=True):
        write_gif(noise, file, frame_seconds(0.1, 3), colors=colors)
    assert files[1].tell() < 0.7 * files[0].tell()


@given(st.integers(1, 400), st.floats(1, 200), st.sampled_from([100, 1000]))
def test_times_add_up(count, rate, per_second):
    ticks = whole_ticks(frame_seconds(1 / rate, count), per_second)
    assert np.abs(np.cumsum(ticks) / per_second - np.arange(1, count + 1) / rate).max() <= 0.5 / per_second + 1e-9


def test_a_box_holds_what_changed():
    before = np.zeros((6, 7, 3), dtype=np.uint8)
    assert changed_box(before, None) == (slice(0, 6), slice(0, 7))
    assert changed_box(before, before) == (slice(0, 1), slice(0, 1))


@pytest.mark.parametrize("ending", ["jpg", "", "avi"])
def test_other_endings_are_refused(tmp_path, ending):
    with pytest.raises(ValueError, match=r"path must end in \.gif, \.png, \.apng, \.webp, \.mp4"):
        save_pictures(REEL, tmp_path / f"moving.{ending}")


@pytest.mark.parametrize("ending", [*LOOPING, "mp4"])
def test_bad_reels_and_times_leave_no_file(tmp_path, ending):
    target = tmp_path / f"moving.{ending}"
    with pytest.raises(ValueError, match="would have no frames"):
        save_pictures([], target)
    with pytest.raises(ValueError, match="frame 1 has 64 by 40 pixels and differs from the first with 64 by 48"):
        save_pictures([REEL[0], REEL[0][:40]], target)
    with pytest.raises(ValueError, match="seconds has 2 entries for 5 frames"):
        save_pictures(REEL, target, seconds=(0.1, 0.2))
    for wrong, message in (
        (0.0, "must be positive"),
        (-1.0, "must be positive"),
        (np.nan, "seconds"),
        ("x", "seconds"),
    ):
        with pytest.raises((ValueError, TypeError), match=message):
            save_pictures(REEL, target, seconds=wrong)
    assert list(tmp_path.iterdir()) == []


def test_pictures_are_arrays_of_bytes(tmp_path):
    for wrong in (REEL[0].astype(float), REEL[0] / 255):
        with pytest.raises(TypeError, match=r"reel\[0\] must be of uint8, not float64; scale"):
            save_pictures([wrong], tmp_path / "moving.gif")
    for wrong in (REEL[0][..., 0], np.zeros((4, 4, 4), dtype=np.uint8), np.zeros((0, 4, 3), dtype=np.uint8)):
        with pytest.raises(ValueError, match=r"reel\[1\] must have shape \(h, w, 3\)"):
            save_pictures([REEL[0], wrong], tmp_path / "moving.png")
    assert list(tmp_path.iterdir()) == []


def test_what_a_format_cannot_hold_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"fast\.gif would be shown for 0\.0100 s each.*at most 50 frames a second"):
        save_pictures(REEL, tmp_path / "fast.gif", seconds=0.01)
    with pytest.raises(ValueError, match=r"size of wide\.webp is 16384 pixels, but the format has at most 16383"):
        save_pictures([np.zeros((1, 16384, 3), dtype=np.uint8)], tmp_path / "wide.webp")
    with pytest.raises(ValueError, match=r"seconds differ, but all frames of an \.mp4"):
        save_pictures(REEL[:2], tmp_path / "moving.mp4", seconds=(0.1, 0.2))
    save_pictures(REEL, tmp_path / "fifty.gif", seconds=1 / 50)


def test_without_ffmpeg_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(_extras, "import_module", lambda name: (_ for _ in ()).throw(ModuleNotFoundError(name=name)))
    with pytest.raises(ImportError, match=r"pip install 'stereodel\[video\]'"):
        save_pictures(REEL, tmp_path / "moving.mp4")
    assert list(tmp_path.iterdir()) == []


def test_what_ffmpeg_says_is_passed_on(tmp_path, monkeypatch):
    monkeypatch.setattr("stereodel.film.mp4.QUALITY", "nonsense")
    with pytest.raises(RuntimeError, match=r"(?s)ffmpeg could not write .*nonsense"):
        save_pictures(REEL, tmp_path / "moving.mp4")
    assert list(tmp_path.iterdir()) == []


def test_ffmpeg_reads_what_pillow_does_not_write(tmp_path):
    """GIF and APNG come from our own containers: another program than Pillow finds the same frames."""
    for ending in ("gif", "apng"):
        assert np.array_equal(decoded(save_pictures(REEL, tmp_path / f"moving.{ending}"), (48, 64)), REEL)
