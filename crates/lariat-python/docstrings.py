"""Docstrings of the extension module, from the stubs: `python crates/lariat-python/docstrings.py` writes those of
`python/lariat_cables/_lariat.pyi` above the functions in `src`. `tests/test_stubs.py` fails where they differ."""

from __future__ import annotations

import ast
import re
import textwrap
from pathlib import Path

HERE = Path(__file__).parent
STUBS = HERE / "python" / "lariat_cables" / "_lariat.pyi"
WIDTH = 100


def of_stubs() -> dict[tuple[str, str], str]:
    """Returns docstrings by class and name; ("", name) of functions, (name, "") of classes, with that of their ``__new__`` behind."""
    found: dict[tuple[str, str], str] = {}
    for node in ast.parse(STUBS.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and (doc := ast.get_docstring(node)):
            found["", node.name] = doc
        if isinstance(node, ast.ClassDef) and (doc := ast.get_docstring(node)):
            found[node.name, ""] = doc
            for item in node.body:
                if isinstance(item, ast.FunctionDef) and (doc := ast.get_docstring(item)):
                    if item.name == "__new__":
                        found[node.name, ""] += "\n\n" + doc
                    else:
                        found[node.name, item.name] = doc
    return found


def comment(doc: str, indent: str) -> list[str]:
    """Returns a docstring as a doc comment of Rust; paragraphs and items of lists are wrapped."""
    lines: list[str] = []
    for block in re.split(r"\n(?=\n|- )", doc):
        head = "" if block.startswith("- ") else block[: len(block) - len(block.lstrip("\n"))]
        lines += [f"{indent}///"] * len(head)
        first, rest = f"{indent}/// ", f"{indent}///   " if block.startswith("- ") else f"{indent}/// "
        text = " ".join(block.split())
        lines += textwrap.wrap(text, WIDTH, initial_indent=first, subsequent_indent=rest, break_long_words=False, break_on_hyphens=False)
    return lines


def written(text: str, docs: dict[tuple[str, str], str]) -> str:
    """Returns a file of Rust with the docstrings of the stubs."""
    lines = text.split("\n")
    out: list[str] = []
    owner = ""
    for line in lines:
        if found := re.match(r"impl (\w+) \{", line):
            owner = found[1]
        elif line == "}":
            owner = ""
        key, above = None, len(out)
        # doc comment and attributes above an item
        while above and re.match(r"\s*(///|#\[|        \S.*\)\]$)", out[above - 1]):
            above -= 1
        attributes = [a for a in out[above:] if not a.lstrip().startswith("///")]
        joined = "\n".join(attributes)
        indent = line[: len(line) - len(line.lstrip())]
        if found := re.match(r"(?:pub )?struct (\w+)", line):
            key = (found[1], "") if "#[pyclass" in joined else None
        elif found := re.match(r"(?:pub )?fn (\w+)", line):
            key = ("", found[1]) if "#[pyfunction" in joined else None
        elif (found := re.match(r"    (?:pub )?fn (\w+)", line)) and owner and "#[setter" not in joined:
            name = re.search(r'#\[pyo3\(name = "(\w+)"', joined)
            key = (owner, name[1] if name else found[1])
        if key and "#[new]" in joined:
            out[above:] = attributes
        elif key in docs:
            out[above:] = comment(docs[key], indent) + attributes
        out.append(line)
    return "\n".join(out)


if __name__ == "__main__":
    docs = of_stubs()
    for path in sorted((HERE / "src").rglob("*.rs")):
        before = path.read_text(encoding="utf-8")
        after = written(before, docs)
        if after != before:
            path.write_text(after, encoding="utf-8")
