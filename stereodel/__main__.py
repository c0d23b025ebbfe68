"""The command `stereodel`, also as ``python -m stereodel``; without its libraries it says how to get them."""

from __future__ import annotations

from stereodel._extras import MissingExtraError


def main() -> None:
    """Run the command."""
    try:
        from stereodel.cli import app
    except MissingExtraError as error:
        raise SystemExit(f"error: {error}") from None
    app(prog_name="stereodel")


if __name__ == "__main__":
    main()
