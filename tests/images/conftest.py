"""What shows SVG files: one Chromium for all of them."""

from concurrent.futures import ThreadPoolExecutor
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from tools.browser import chromium


@pytest.fixture(scope="session")
def browser():
    """`browser(file, width, height)`: the pixels (h, w, 3) of a file in a window of that size.

    In a thread of its own: Playwright has one browser in a thread, and the tests of the interactive page have theirs.
    """
    with ThreadPoolExecutor(1) as thread:
        manager = chromium()
        running = thread.submit(manager.__enter__).result()

        def shown(file, width, height):
            page = running.new_page(viewport={"width": width, "height": height})
            try:
                page.set_default_timeout(90_000)  # of a machine whose processors are all busy
                page.goto(file.as_uri())
                return np.asarray(Image.open(BytesIO(page.screenshot())).convert("RGB"))
            finally:
                page.close()

        yield lambda *given: thread.submit(shown, *given).result()
        thread.submit(manager.__exit__, None, None, None).result()
