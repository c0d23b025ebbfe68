"""Check how long functions, modules and the kernel's files are.

Half of the functions have at most 10 lines of code, nine tenths at most 30, none more than 60.

Lines of code count: no docstrings, comments or blank lines. A function's inner functions count as part of it and on
their own. Modules and files of the kernel have fewer than 400 lines, everything counted; lines of the kernel at most
120 characters, as those of the modules.

    python tools/code_sizes.py FOLDER…
"""

from __future__ import annotations

import ast
import io
import statistics
import sys
import tokenize
from collections.abc import Iterator
from pathlib import Path

MEDIAN, NINE_TENTHS, LONGEST, MODULE, COLUMNS = 10, 30, 60, 400, 120
_LAYOUT = {tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENDMARKER}
_Function = ast.FunctionDef | ast.AsyncFunctionDef
_Documented = _Function | ast.ClassDef | ast.Module


def code_lines(source: str, tree: ast.Module) -> set[int]:
    """Numbers of the lines that hold code."""
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in _LAYOUT:
            lines.update(range(token.start[0], token.end[0] + 1))
    for node in ast.walk(tree):
        if isinstance(node, _Documented) and ast.get_docstring(node, clean=False) is not None:
            docstring = node.body[0]
            lines.difference_update(range(docstring.lineno, (docstring.end_lineno or 0) + 1))
    return lines


def function_lengths(source: str) -> Iterator[tuple[str, int, int]]:
    """(name, first line, lines of code) of every function and method."""
    tree = ast.parse(source)
    lines = code_lines(source, tree)
    for node in ast.walk(tree):
        if isinstance(node, _Function):
            last = node.end_lineno or node.lineno
            yield node.name, node.lineno, len(lines.intersection(range(node.lineno, last + 1)))


def file_problems(sources: dict[str, str]) -> list[str]:
    """Which of the named sources are too long."""
    return [
        f"{name}: {text.count(chr(10))} lines, at most {MODULE - 1}"
        for name, text in sources.items()
        if text.count("\n") >= MODULE
    ]


def kernel_problems(sources: dict[str, str]) -> list[str]:
    """What breaks the rules in C++ sources: length of files and lines, tabs, spaces at the end."""
    return file_problems(sources) + [
        f"{name}:{number}: more than {COLUMNS} characters, a tab, or a space at the end"
        for name, text in sources.items()
        for number, line in enumerate(text.splitlines(), 1)
        if len(line) > COLUMNS or "\t" in line or line.endswith(" ")
    ]


def problems(sources: dict[str, str]) -> list[str]:
    """What breaks the rules in the named Python sources."""
    found = file_problems(sources)
    lengths = [
        (length, f"{name}:{line} {function}")
        for name, text in sources.items()
        for function, line, length in function_lengths(text)
    ]
    found += [f"{place}: {length} lines of code, at most {LONGEST}" for length, place in lengths if length > LONGEST]
    if lengths:
        ordered = sorted(length for length, _ in lengths)
        if (median := statistics.median(ordered)) > MEDIAN:
            found.append(f"half of the functions are longer than {median:g} lines of code, the median may be {MEDIAN}")
        if (long := sum(length > NINE_TENTHS for length in ordered)) > len(ordered) / 10:
            found.append(
                f"{long} of {len(ordered)} functions are over {NINE_TENTHS} lines of code, at most a tenth may be"
            )
    return found


def read(folders: list[str], *suffixes: str) -> dict[str, str]:
    """Sources in the folders by name."""
    paths = sorted(path for folder in folders for path in Path(folder).rglob("*") if path.suffix in suffixes)
    return {str(path): path.read_text(encoding="utf-8") for path in paths}


def main(folders: list[str]) -> int:
    """Report and return the exit code."""
    sources, kernel = read(folders, ".py"), read(folders, ".hpp", ".cpp")
    found = problems(sources) + kernel_problems(kernel)
    lengths = sorted(length for text in sources.values() for _, _, length in function_lengths(text))
    if lengths:
        nine_tenths = lengths[(9 * len(lengths)) // 10 - 1]
        print(
            f"{len(sources)} modules, {len(lengths)} functions: median {statistics.median(lengths):g} lines of code, "
            f"nine tenths up to {nine_tenths}, longest {lengths[-1]}; {len(kernel)} files of the kernel"
        )
    print(*found, sep="\n", end="\n" if found else "", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
