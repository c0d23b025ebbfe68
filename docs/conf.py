"""Sphinx configuration. The gallery runs the figure scripts through the library's own rendering; nothing is fetched."""

import os
import shutil
import sys
from pathlib import Path

import stereodel
from stereodel.render import figure as rendering

HERE = Path(__file__).resolve().parent
BUILD = HERE / "_build"

project = "stereodel"
author = "The stereodel developers"
copyright = "the stereodel developers, MIT licence"
version = release = stereodel.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_parser",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "images/README.md"]
templates_path = ["_templates"]
root_doc = "index"

# A name in single backticks links where the name is documented and is set as code where it is not; explicit roles
# such as {py:class} must resolve.
default_role = "py:obj"
nitpicky = True
nitpick_ignore_regex = [("py:obj", ".*")]

autosummary_generate = True
autodoc_typehints = "none"  # the docstrings give shapes and units, which the annotations cannot
autodoc_member_order = "bysource"
numpydoc_show_class_members = False
numpydoc_xref_param_type = False

myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3

html_theme = "pydata_sphinx_theme"
html_static_path = ["_static"]
html_css_files = ["stereodel.css"]
html_title = "stereodel"
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "navigation_with_keys": False,
    "show_prev_next": False,
    "navbar_align": "left",
    "header_links_before_dropdown": 7,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
}
html_sidebars = {"index": [], "paper": [], "changelog": []}

GALLERY_WIDTH = 1200
"""Pixels across; print size would only make pages heavy."""


def script_arguments(_conf, script_vars):
    """What a figure script is told when the gallery runs it."""
    arguments = ["--out", str(BUILD / "gallery-figures")]
    if Path(script_vars["src_file"]).name.startswith("fig"):
        arguments += ["--size", str(GALLERY_WIDTH)]
    return arguments


class WrittenPictures:
    """Gallery scraper: the pictures that `Figure.save` and `Animation.save` wrote since the last block of code."""

    def __init__(self):
        self.shown = 0

    def __repr__(self):
        return "WrittenPictures()"  # part of the gallery's stored configuration: must not change between builds

    def __call__(self, block, block_vars, gallery_conf):
        """Copy the new pictures to where the gallery wants them and return the markup that shows them."""
        from sphinx_gallery.scrapers import figure_rst

        new, self.shown = rendering.WRITTEN[self.shown :], len(rendering.WRITTEN)
        targets = []
        for source, target in zip(new, block_vars["image_path_iterator"], strict=False):
            path = Path(target).with_suffix(source.suffix)
            shutil.copyfile(source, path)
            targets.append(str(path))
        return figure_rst(targets, gallery_conf["src_dir"])


sphinx_gallery_conf = {
    "examples_dirs": "../figures",
    "gallery_dirs": "gallery",
    "filename_pattern": r"/(fig\d\d|anim)_",
    "ignore_pattern": r"/_",
    "within_subsection_order": "FileNameSortKey",
    "reset_argv": script_arguments,
    "reset_modules": (),
    "image_scrapers": (WrittenPictures(),),
    "capture_repr": (),
    "abort_on_example_error": True,
    "min_reported_time": 10_000,
    "show_memory": False,
    "show_signature": False,
    "download_all_examples": False,
    "remove_config_comments": True,
    "write_computation_times": False,
}

# The scripts import their shared modules from their own folder.
sys.path.insert(0, str(HERE.parent / "figures"))
os.environ.setdefault("SOURCE_DATE_EPOCH", "0")
