"""How sphinx-gallery runs the figure scripts and finds the pictures that they write."""

import os
import shutil
from pathlib import Path

from PIL import Image
from sphinx_gallery.scrapers import figure_rst

WRITE_TO = Path(__file__).resolve().parent / "_build" / "gallery-figures"

SHOWN = (".png", ".gif")
"""Endings of what is shown of the files of a script."""

WIDTH = 1200
"""Pixels across a figure; print size would only make pages heavy."""


def script_arguments(gallery_conf, script_vars):
    """What a script is told on its command line."""
    script = Path(script_vars["src_file"])
    arguments = ["--out", os.path.relpath(WRITE_TO, script.parent)]  # scripts run in their own folder
    if not script.name.startswith("anim_"):
        arguments += ["--size", str(WIDTH)]
    return arguments


def written_pictures(block, block_vars, gallery_conf):
    """Take the picture that a script, after which it is named, has written and return the markup that shows it.

    It is moved, so that it is shown after the block of code that wrote it and no other.
    """
    targets = []
    for source in (WRITE_TO / f"{Path(block_vars['src_file']).stem}{kind}" for kind in SHOWN):
        if source.is_file():
            target = Path(next(block_vars["image_path_iterator"])).with_suffix(source.suffix)
            shutil.move(source, target)
            if target.suffix == ".gif":  # in the overview stands a picture of the film: five films would be 10 MB
                with Image.open(target) as film:
                    film.seek(film.n_frames // 2)
                    film.convert("RGB").save(target.with_suffix(".png"))
            targets.append(str(target))
    return figure_rst(targets, gallery_conf["src_dir"])


class FiguresFirst:
    """Order of the gallery: figures by number, claims beside them, globes through lenses, real data, animations."""

    def __init__(self, src_dir):
        self.src_dir = src_dir

    def __call__(self, filename):
        """Sort key of a script."""
        return [not filename.startswith(kind) for kind in ("fig", "claim_", "globe_", "earth_", "sky_")], filename
