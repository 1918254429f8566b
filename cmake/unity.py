"""Writes one source that holds several: unity.py OUT SOURCE…

Headers are then read once for all of them. What a source keeps to itself (its anonymous namespaces) gets
the source's name behind its own while that source is read, so that it meets no neighbour's; the sources
stay as they are. Left alone are names that the source also uses of others (`x.name`, `room::name`), what
others find by its name (`choices`), the types of sources that describe some and the names of tests, for those
tell their name: where such a name meets another, the compiler says so.

The sources are named from OUT's folder, so that what is written, and a compiler's cache of it, is the same in
every copy of the tree.
"""

import os
import re
import sys
from pathlib import Path

DECLARED = re.compile(r"[^({=;]*?(?<![:\w~])(\w+)\s*[(=\[{;]")
TYPE = re.compile(r"(?:(?:struct|class|enum class|enum)\s+(\w+)\b|using\s+(\w+)\s*=)")
NOT_A_NAME = {"operator", "Handle"}  # Handle(Type) is OCCT's macro
FOUND_BY_ARGUMENT = {"choices", "jet", "evaluate", "breakpoints", "sign_of"}  # other rooms' templates call them
NO_DECLARATION = ("using", "template", "static_assert", "namespace", "struct", "class", "enum", "friend", "}", "#")


def bare(text):
    """The text without comments and what quotes hold, line for line."""
    text = re.sub(r'R"(\w*)\((.*?)\)\1"', lambda raw: '""' + "\n" * raw[0].count("\n"), text, flags=re.S)
    return "\n".join(
        re.sub(r"//.*", "", re.sub(r"'(\\.|[^'\\])'", "' '", re.sub(r'"(\\.|[^"\\])*"', '""', line)))
        for line in text.split("\n"))


def own_names(text):
    """What the anonymous namespaces alone declare; `text` is bare and formatted by clang-format."""
    described = "describe()" in text or "choices(" in text
    own, shared, depth, inside = set(), set(), 0, None
    for line in text.split("\n"):
        if inside is None and re.match(r"namespace\s*\{", line):
            inside = depth
        elif line[:1].strip() and (inside is None or depth == inside + 1):
            found = DECLARED.match(line)
            if found and not line.startswith(NO_DECLARATION) and line[: found.start(1)].strip():
                (shared if inside is None else own).add(found[1])
            found = TYPE.match(line)
            if found and inside is not None and not described:
                own.add(found[1] or found[2])
        depth += line.count("{") - line.count("}")
        if inside is not None and depth <= inside:
            inside = None
    used_of_others = set(re.findall(r"(?:\.|->|::)\s*(?:template\s+)?(\w+)", text))
    told = {name for names in re.findall(r"TEST\w*\((\w+),\s*(\w+)", text) for name in names}
    return own - shared - used_of_others - told - NOT_A_NAME - FOUND_BY_ARGUMENT


def includes(text, folder, seen_from):
    """The source's #include lines that no #if decides about; headers beside it are named from `seen_from`."""
    depth, lines = 0, []
    for line in text.split("\n"):
        depth += line.startswith("#if") - line.startswith("#endif")
        if depth == 0 and line.startswith("#include"):
            beside = re.match(r'#include "([^"]+)"', line)
            if beside and (folder / beside[1]).exists():
                line = f'#include "{os.path.relpath(folder / beside[1], seen_from)}"'
            lines.append(line)
    return lines


def unity(sources, folder):
    headers, bodies = [], []
    for source in (Path(source).resolve() for source in sources):
        text = source.read_text(encoding="utf-8")
        headers += [line for line in includes(text, source.parent, folder) if line not in headers]
        mark = re.sub(r"\W", "_", source.stem)
        names = sorted(own_names(bare(text)))
        bodies += [f"#define {name} {name}_of_{mark}" for name in names]
        bodies.append(f'#include "{os.path.relpath(source, folder)}"')
        bodies += [f"#undef {name}" for name in names]
    return "\n".join(headers + bodies) + "\n"


if __name__ == "__main__":
    target = Path(sys.argv[1])
    made = unity(sys.argv[2:], target.resolve().parent)
    if not target.exists() or target.read_text(encoding="utf-8") != made:
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(made, encoding="utf-8")
