"""The font of tests that need characters beyond those of the fonts that matplotlib ships."""

from pathlib import Path

CJK = str(Path(__file__).resolve().parents[1] / "fixtures" / "fonts" / "noto-sans-cjk-subset.otf")
"""東京한국港 in the outlines of Noto Sans CJK TC; see tests/fixtures/README.md."""
