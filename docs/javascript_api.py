"""The page `api/generated/javascript`: what the npm package offers, from the comments of its sources."""

import re
from pathlib import Path

KERNEL = Path(__file__).resolve().parent.parent / "stereodel" / "web" / "script" / "kernel"
PAGE = Path(__file__).resolve().parent / "api" / "generated" / "javascript.md"

MODULES = {"stereodel": ["index.ts", "api.ts"], "stereodel/inline": ["inline.ts"]} | {
    f"stereodel/{name}": [f"{name.replace('-', '_')}.ts"] for name in ("d3", "delaunator", "d3-delaunay")
}
"""Files of the modules that users import."""

HEADING = (
    "# JavaScript, name by name\n\n{doc}`/javascript` says how to begin. Members of base classes are theirs, too.\n"
)


def modules_of(files):
    """Files from which something is exported, with the names, all those of the file itself for None."""
    for file in files:
        text = (KERNEL / file).read_text(encoding="utf-8")
        yield file, None
        for names, other in re.findall(r'^export (?:type )?\{([^}]+)\} from "\./(\w+\.ts)"', text, re.MULTILINE):
            yield other, {name.split()[-1] for name in names.split(",") if name.strip()}


def comment(lines):
    """Markdown of a comment in the manner of JSDoc."""
    text = "\n".join(re.sub(r"^\s*(/\*\*|\*/|\*)? ?|\s*\*/$", "", line) for line in lines).strip()
    text, *example = re.split(r"@example\n", text)
    text = re.sub(r"@param (\w+)", r"\n`\1`:", text).replace("@returns", "\nReturns:")
    return text.strip() + "".join(f"\n\n```js\n{code.strip()}\n```" for code in example)


def declarations(file):
    """(signature, comment, whether it is a member) of what a file exports and of its public members, in order."""
    lines = iter((KERNEL / file).read_text(encoding="utf-8").splitlines())
    said, is_open = [], False
    for line in lines:
        if re.match(r" *(/\*\*)", line):
            said = [line]
            while "*/" not in said[-1]:
                said.append(next(lines))
            continue
        is_member = is_open and re.match(r"  (?!private|protected|override|readonly forKernel)[\w*$(]", line)
        if is_member or re.match(r"export (?!\{|type \{|\*)", line):
            signature = [line.strip()]
            while not re.search(r"[{;]$", signature[-1]):
                signature.append(next(lines).strip())
            if "@internal" not in " ".join(said):
                text = re.sub(r"^export (default )?|!(?=:)| [{]$|;$", "", " ".join(signature))
                yield text, comment(said), bool(is_member)
            is_open = bool(is_member) or bool(re.search(r"\b(class|interface)\b.*\{$", signature[0] + signature[-1]))
        is_open = is_open and line != "}"
        said = [] if line.strip() else said


def javascript_api():
    """The page."""
    page, told = [HEADING], set()
    for module, files in MODULES.items():
        opening = re.match(r"/\*\*.*?\*/", (KERNEL / files[0]).read_text(encoding="utf-8"), re.DOTALL)
        page.append(f"## `{module}`\n\n{comment(opening[0].splitlines())}\n")
        for file, names in modules_of(files):
            is_told = False
            for signature, text, is_member in declarations(file):
                if is_member and is_told:
                    page.append(f"`{signature}`\n" + f": {text}\n".replace("\n\n", "\n\n  ") * bool(text))
                if is_member:
                    continue
                name = re.sub(r"^(abstract )?\w+ |[^\w$].*", "", signature)
                # Classes that others extend are not exported, but what they have is.
                is_wanted = names is None or name in names or signature.startswith("abstract")
                is_told = is_wanted and (file, name) not in told
                if is_told:
                    told.add((file, name))
                    page.append(f"### {name}\n\n```ts\n{signature}\n```\n\n{text}\n")
    return "\n".join(page)


def write_javascript_api(_app):
    """Before Sphinx reads."""
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(javascript_api(), encoding="utf-8")
