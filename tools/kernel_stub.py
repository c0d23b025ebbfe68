"""Write the type stubs of the kernel, or check that they are those that the compiled kernel gives.

python tools/kernel_stub.py [--check]
"""

from __future__ import annotations

import ast
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STUBS = ROOT / "stereodel" / "_kernel"
"""A folder, as the kernel has submodules; Python takes the compiled module, which is no folder."""
SPACE = "space.pyi"
"""What plane and sphere have in common, as protocols; a module for those who check types alone."""
HEAD = '''"""What `plane` and `sphere` have in common, for points (n, 2) and for directions (n, 3)."""

from typing import Protocol

import numpy
from numpy.typing import NDArray

'''


def generated() -> dict[str, str]:
    """The stubs as nanobind writes them, formatted like other code, by the name of the file."""
    with tempfile.TemporaryDirectory() as folder:
        _run("nanobind.stubgen", "-q", "-r", "-m", "stereodel._kernel", "-O", folder)
        plane, sphere = (next(Path(folder).rglob(f"{name}.pyi")) for name in ("plane", "sphere"))
        (plane.parent / SPACE).write_text(
            HEAD + in_common(plane.read_text("utf-8"), sphere.read_text("utf-8")), "utf-8"
        )
        _run("ruff", "format", "-q", "--config", str(ROOT / "pyproject.toml"), folder)
        return read(Path(folder))


def in_common(plane: str, sphere: str) -> str:
    """The functions and the class that stand in both stubs with the same arguments, as protocols."""
    one, other = ({node.name: node for node in plain(text).body if hasattr(node, "name")} for text in (plane, sphere))
    mesh = _alike(
        *({node.name: node for node in table["Mesh"].body if hasattr(node, "name")} for table in (one, other))
    )
    first = mesh.pop("__init__")
    first.name, first.returns = "Mesh", ast.Name("Mesh")
    shared = _alike(one, other)
    for node in shared.values():
        node.args.args.insert(0, ast.arg("self"))
    bodies = {"Mesh": mesh.values(), "Space": [first, *shared.values()]}
    made = [ast.ClassDef(name, [ast.Name("Protocol")], [], list(body), []) for name, body in bodies.items()]
    made[1].body.insert(0, ast.parse("@property\ndef stages(self) -> tuple[str, ...]: ...").body[0])
    return "\n".join(ast.unparse(ast.fix_missing_locations(node)) for node in made)


def plain(stub: str) -> ast.Module:
    """A stub without its docstrings and the shapes of arrays, in which plane and sphere differ."""

    class Plain(ast.NodeTransformer):
        def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
            self.generic_visit(node)
            return node.slice.elts[0] if ast.unparse(node.value) == "Annotated" else node

        def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
            self.generic_visit(node)
            node.body = [ast.Expr(ast.Constant(...))]
            return node

    return Plain().visit(ast.parse(stub))


def _alike(one: dict[str, ast.AST], other: dict[str, ast.AST]) -> dict[str, ast.FunctionDef]:
    """Functions of both; the other may take more arguments behind those of the one."""
    return {
        name: node
        for name, node in one.items()
        if isinstance(node, ast.FunctionDef)
        and name in other
        and ast.unparse(other[name].args).startswith(ast.unparse(node.args))
        and ast.dump(other[name].returns) == ast.dump(node.returns)
    }


def _run(module: str, *arguments: str) -> None:
    subprocess.run([sys.executable, "-m", module, *arguments], check=True)


def read(folder: Path) -> dict[str, str]:
    """Stubs in a folder and below it by their names."""
    return {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.pyi"))}


def main(*options: str) -> int:
    """Write or check, and return the exit code."""
    stubs = generated()
    if options != ("--check",):
        STUBS.mkdir(exist_ok=True)
        for name, text in stubs.items():
            (STUBS / name).write_text(text, encoding="utf-8")
        for old in set(read(STUBS)) - set(stubs):
            (STUBS / old).unlink()
        return 0
    if read(STUBS) == stubs:
        print("the stubs are those of the kernel")
        return 0
    print("the stubs in stereodel/_kernel are not those of the kernel: run make stub", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
