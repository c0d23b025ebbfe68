"""Sphinx configuration. The gallery runs the figure scripts through the library's own rendering; nothing is fetched."""

import os
import re
import sys
import warnings
from html import escape
from pathlib import Path

from docutils import nodes
from sphinx.util.images import get_image_size

import stereodel
from stereodel.web import web

# Of joblib, which starts a process of the gallery anew where one has grown.
warnings.filterwarnings("ignore", message="A worker stopped while some jobs were given")

sys.path.insert(0, str(Path(__file__).resolve().parent))  # for figure_gallery and javascript_api
from javascript_api import write_javascript_api  # noqa: E402

project = "stereodel"
author = "The stereodel developers"
copyright = "the stereodel developers, MIT licence"
# The workflow builds a tag, as v1.2.0, or "dev", to lie beside other versions on one site.
among_others = os.environ.get("STEREODEL_DOCUMENTATION", "").removeprefix("v")
version = release = among_others or stereodel.__version__

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "myst_parser",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build"]
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
html_context = {"default_mode": "auto"}
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {
    "logo": {"text": f"stereodel {release}"},
    "navigation_with_keys": False,
    "show_prev_next": False,
    "navbar_align": "left",
    "header_links_before_dropdown": 5,
    "navigation_depth": 2,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": {"**": ["page-toc"], "index": [], "paper": []},
}
if among_others:  # tools/documentation_versions.sh writes the list
    html_theme_options |= {
        "switcher": {"json_url": "../versions.json", "version_match": release},
        "check_switcher": False,
        "navbar_end": ["version-switcher", "theme-switcher", "navbar-icon-links"],
        "show_version_warning_banner": True,
    }
html_sidebars = {
    "**": ["sidebar-nav-bs"],
    # The first page has no section; the widest tables want its room.
    **{page: [] for page in ("index", "paper", "names", "benchmarks")},
}

sphinx_gallery_conf = {
    "examples_dirs": "../figures",
    "gallery_dirs": "gallery",
    "filename_pattern": r"/(fig\d\d|claim|globe|earth|sky|anim)_",
    "ignore_pattern": r"^_",
    "within_subsection_order": "figure_gallery.FiguresFirst",
    "reset_argv": "figure_gallery.script_arguments",
    "reset_modules": (),
    "parallel": True,  # as many scripts at once as Sphinx has processes
    "image_scrapers": ("figure_gallery.written_pictures",),
    "capture_repr": (),
    "abort_on_example_error": True,
    "min_reported_time": 10_000,
    "show_memory": False,
    "show_signature": False,
    "download_all_examples": False,
    "remove_config_comments": True,
    "write_computation_times": False,
}


def escape_bars(_app, _what, _name, _obj, _options, lines):
    """Docstrings write |x| for an absolute value, which reStructuredText would take for a substitution."""
    for number, line in enumerate(lines):
        if "``" not in line and not line.lstrip().startswith(">>>"):
            lines[number] = line.replace("|", r"\|")


def write_interactive_page(app, problem):
    """Put the page itself beside the one that describes it."""
    if problem is None:
        web(Path(app.outdir) / "interactive.html")


def break_between_words(_app, _page, _template, context, _doctree):
    """Long names, as of files and tests, break after a slash, colon or underscore; copied they are as before.

    The corner of a table heads nothing.
    """
    if "body" in context:
        context["body"] = re.sub(r'<th class="head[^"]*"><p></p></th>', "<td></td>", context["body"])
        context["body"] = re.sub(
            r'(?<=<span class="pre">)[^<]{16,}',
            lambda name: re.sub(r"(/|::|_(?=[^_<]))(?=\w)", r"\1<wbr>", name[0]),
            context["body"],
        )


def describe_page(_app, _page, _template, context, doctree):
    """What a search engine says of a page: its first paragraph."""
    paragraphs = doctree.findall(nodes.paragraph) if doctree else ()
    first = next((each.astext() for each in paragraphs if not isinstance(each.parent, nodes.Admonition)), "")
    if first:
        text = escape(" ".join(first.split()))
        context["metatags"] = context.get("metatags", "") + f'<meta name="description" content="{text}"/>'


def size_pictures(app, _page, _template, context, _doctree):
    """Room is kept for pictures until they come, and those below come when they are near."""
    sources = {name: source for source, name in app.builder.images.items()}

    def sized(picture):
        source = sources.get(picture[1], f"gallery/images/{picture[1]}")  # the gallery has a way of its own
        width, height = get_image_size(Path(app.srcdir, source)) or (0, 0)
        first = picture.start() == context["body"].index("<img ")
        room = f'width="{width}" height="{height}" ' if width else ""
        return picture[0].replace("<img ", f"<img {room}" + ("" if first else 'loading="lazy" '))

    if "body" in context:
        context["body"] = re.sub(r'<img [^>]*src="[^"]*_images/([^"]+)"', sized, context["body"])


def setup(app):
    """After numpydoc, which listens at the default priority."""
    app.connect("builder-inited", write_javascript_api)
    for change in (break_between_words, describe_page, size_pictures):
        app.connect("html-page-context", change)
    app.connect("autodoc-process-docstring", escape_bars, priority=900)
    app.connect("build-finished", write_interactive_page)
