"""The interactive page: the kernel in the browser, one file without a server or a network, and a widget of notebooks.

`web` writes the page; `GlobeWidget` is its globe in a notebook, and comes with the extra ``jupyter``.
"""

from typing import Any

from stereodel.web.assemble import web

__all__ = ["GlobeWidget", "web"]


def __getattr__(name: str) -> Any:
    """The widget, whose library is loaded with it."""
    if name == "GlobeWidget":
        from stereodel.web.widget import GlobeWidget

        return GlobeWidget
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
