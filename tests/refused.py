"""What is refused, a line each."""

import pytest


def refused(*rows, call=lambda make: make()):
    """A test of rows: arguments of a call, the words that refuse them, and the error where that is no ValueError."""

    cases = [row if isinstance(row[-1], type) else (*row, ValueError) for row in rows]

    @pytest.mark.parametrize("row", cases, ids=[words for *_, words, _ in cases])
    def test(row):
        *given, words, error = row
        with pytest.raises(error, match=words):
            call(*given)

    return test
