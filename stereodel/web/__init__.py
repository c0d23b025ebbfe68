"""The interactive page: the kernel in the browser, as one file without server or network, and a notebook widget.

`web` writes the page; `GlobeWidget` is its globe in a notebook and needs the extra ``jupyter``.
"""

from typing import Any

from stereodel.web.assemble import web

__all__ = ["GlobeWidget", "web"]


def __getattr__(name: str) -> Any:
    """Load the widget and its library on first use."""
    if name == "GlobeWidget":
        from stereodel.web.widget import GlobeWidget

        return GlobeWidget
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
