"""Animations: a looping GIF of the frames, in true colours, whole or not at all."""

import imageio.v3 as iio
import numpy as np
import pytest
from PIL import Image

from stereodel.drawing.page import Dots, Label, Page
from stereodel.film import animation as animate
from stereodel.film.animation import Animation, save_gif

RED = (0.8, 0.1, 0.1, 1.0)


def page(x, width=2.0):
    return Page(
        (0.0, width, 0.0, 1.0), (Dots(np.array([[x, 0.5]]), 10.0, RED), Label("x", (0.2, 0.8), size=30.0)), width=120.0
    )


def frames():
    return (page(x) for x in (0.5, 1.0, 1.5))


@pytest.fixture
def animation():
    return Animation("moving", frames, seconds=0.1, size=120)


def test_save_writes_a_looping_gif(animation, tmp_path):
    record = animation.save(tmp_path / "new")
    file = tmp_path / "new" / "moving.gif"
    assert [path.name for path in file.parent.iterdir()] == ["moving.gif"]
    assert (record["figure"], record["files"], record["frames"], record["size"]) == ("moving", ["moving.gif"], 3, 120)
    with Image.open(file) as gif:
        assert (gif.n_frames, gif.info["loop"], gif.info["duration"]) == (3, 0, 100)


def test_frames_keep_their_colours(animation, tmp_path):
    animation.save(tmp_path)
    stored = iio.imread(tmp_path / "moving.gif")[..., :3].astype(int)
    drawn = np.stack(animation.pictures()).astype(int)
    assert np.abs(stored - drawn).max() <= 8
    assert np.array_equal(stored[drawn.min(axis=-1) == 255], drawn[drawn.min(axis=-1) == 255])


def test_each_frame_may_have_its_time(tmp_path):
    Animation("moving", frames, seconds=(0.1, 0.2, 1.0), size=60).save(tmp_path)
    with Image.open(tmp_path / "moving.gif") as gif:
        times = [gif.seek(k) or gif.info["duration"] for k in range(3)]
    assert times == [100, 200, 1000]
    with pytest.raises(ValueError, match="seconds of 'moving' has 2 entries for 3 frames"):
        Animation("moving", frames, seconds=(0.1, 0.2), size=60).save(tmp_path)


def test_the_same_frames_give_the_same_bytes(animation, tmp_path):
    for folder in ("a", "b"):
        animation.save(tmp_path / folder)
    assert (tmp_path / "a/moving.gif").read_bytes() == (tmp_path / "b/moving.gif").read_bytes()


def test_as_a_script_it_takes_folder_size_and_text(animation, tmp_path, capsys):
    animation.main(["--out", str(tmp_path), "--size", "60", "--no-text"])
    assert "moving.gif" in capsys.readouterr().out
    stored = iio.imread(tmp_path / "moving.gif")[..., :3]
    assert stored.shape == (3, 30, 60, 3)
    assert (stored[0, :12, :10] == 255).all()
    animation.main(["--out", str(tmp_path), "--size", "60"])
    assert (iio.imread(tmp_path / "moving.gif")[0, :12, :10, :3] < 128).any()


def test_a_folder_that_cannot_be_made_is_a_message(animation, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(SystemExit, match=r"moving: .*file"):
        animation.main(["--out", str(tmp_path / "file" / "out")])


def test_no_frames_and_unlike_frames_are_refused(tmp_path):
    with pytest.raises(ValueError, match="gave no page"):
        Animation("none", list).save(tmp_path)
    with pytest.raises(ValueError, match="differ in shape"):
        Animation("unlike", lambda: [page(0.5), page(0.5, 3.0)], size=60).save(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_would_be_too_large_takes_fewer_colours(monkeypatch, tmp_path):
    noise = list(np.random.default_rng(0).integers(0, 256, (3, 40, 40, 3), dtype=np.uint8))
    seconds = [0.1] * 3
    sizes = [save_gif(noise, tmp_path / "a.gif", seconds).stat().st_size]
    monkeypatch.setattr(animate, "LARGEST_FILE", sizes[0] - 1)
    sizes.append(save_gif(noise, tmp_path / "a.gif", seconds).stat().st_size)
    assert sizes[1] < sizes[0]
    monkeypatch.setattr(animate, "LARGEST_FILE", 100)
    with pytest.raises(ValueError, match=r"a\.gif would have \d+ bytes; give fewer frames"):
        save_gif(noise, tmp_path / "a.gif", seconds)
    assert [path.name for path in tmp_path.iterdir()] == ["a.gif"]
