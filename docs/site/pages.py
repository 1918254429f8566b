#!/usr/bin/env python3
"""pages.py ROOT KEYLINE: gathers the site's pages in build/site/pages.

Pages of the tree come under their own names, so that links between them hold; links to files that are no
pages become plain text. The reference of operations is printed by the tool, that of the headers is read from
the contracts that stand beside the declarations.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

root, keyline = pathlib.Path(sys.argv[1]), sys.argv[2]
out = root / "build/site/pages"
OUTSIDE = ["README.md", "examples/README.md", "bench/README.md", "bindings/python/README.md",
           "bindings/wasm/README.md", "CHANGELOG.md"]
ROOMS = re.compile(r"IN ITEMS([a-z_\s]+)\)")


def place_of(page):
    """Where a page of the tree goes: pages of docs/ at the top, the README as the home page."""
    name = page.relative_to(root)
    if name == pathlib.Path("docs/README.md"):
        return pathlib.Path("contents.md")
    if name == pathlib.Path("README.md"):
        return pathlib.Path("index.md")
    return name.relative_to("docs") if name.parts[0] == "docs" else name


def taken():
    return [root / name for name in OUTSIDE] + sorted((root / "docs").rglob("*.md"))


def with_links(text, page, places):
    """The text with its links as the site has them."""

    def link(match):
        picture, words, target = match[1], match[2], match[3]
        path, _, anchor = target.partition("#")
        if "://" in target or not path:
            return match[0]
        there = (page.parent / path).resolve()
        if there.is_dir():
            there = there / "README.md"
        if there not in places:
            return words  # a source, a folder: not of the site
        relative = os.path.relpath(places[there], places[page].parent)
        return f"{picture}[{words}]({relative}{'#' + anchor if anchor else ''})"

    # a picture within a link, then the rest
    text = re.sub(r"\[(!\[[^\]]*\]\([^)]*\))\]\(([^)\s]+)\)", r"\1 [more](\2)", text)
    text = re.sub(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)", link, text)
    return re.sub(r"<!--.*?-->\n?", "", text, flags=re.S)


def with_lists(text):
    """A list directly under a paragraph, as GitHub takes it, gets the empty line the site needs."""
    return re.sub(r"(?m)^((?!\s|[-*] |\d+\. |#|\|).+)\n( ?- )", r"\1\n\n\2", text)


def gather():
    shutil.rmtree(out, ignore_errors=True)
    pages = taken()
    pictures = [p for p in (root / "docs").rglob("*") if p.suffix in {".svg", ".png", ".json"}]
    places = {p.resolve(): place_of(p) for p in pages + pictures}
    for page in pages:
        target = out / place_of(page)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(with_lists(with_links(page.read_text(), page.resolve(), places)))
    for picture in pictures:
        target = out / place_of(picture)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(picture, target)
    shutil.copyfile(root / "docs/site/keyline.css", out / "keyline.css")


def operations():
    """A page for every operation, and one that lists them."""
    text = subprocess.run([keyline, "operations", "--format", "markdown"], capture_output=True, text=True, check=True)
    folder = out / "reference"
    folder.mkdir(parents=True, exist_ok=True)
    listed = ["# Operations", "", "What every door performs, from the declarations in the code; [kinds](kinds.md) of fields.", ""]
    for page in re.split(r"(?m)^(?=# )", text.stdout):
        if page.strip():
            name, summary = re.match(r"# (\S+)\n\n(.*)", page).groups()
            (folder / f"{name}.md").write_text(page)
            listed.append(f"- [{name}]({name}.md): {summary}")
    (folder / "operations.md").write_text("\n".join(listed) + "\n")
    kinds = subprocess.run([keyline, "operations", "--format", "typescript"], capture_output=True, text=True, check=True)
    about = "# Kinds\n\nWhat stands in the columns *kind* of the operations, as TypeScript has it.\n"
    (folder / "kinds.md").write_text(f"{about}\n```ts\n{kinds.stdout}```\n")


def declarations(header):
    """(comment, declaration) of everything in a header that has a contract."""
    lines = header.read_text().splitlines()
    i = 0
    while i < len(lines):
        if not lines[i].startswith("///"):
            i += 1
            continue
        comment = []
        while i < len(lines) and lines[i].startswith("///"):
            comment.append(lines[i][4:])
            i += 1
        declared, depth = [], 0
        while i < len(lines) and lines[i].strip():
            declared.append(lines[i])
            code = lines[i].split("//")[0]
            depth += code.count("{") + code.count("(") - code.count("}") - code.count(")")
            i += 1
            if depth <= 0 and code.rstrip().endswith((";", "}")):
                break
            if depth > 0 and len(declared) == 1 and code.startswith("namespace"):
                break
            if 'R"' in code:  # a whole file in a string: a page's style or script
                declared[-1] = code[:code.index('R"')] + '"…";'
                depth = 0
                break
        if depth > 0 and declared and not declared[0].startswith("namespace"):
            declared.append("  …")
        yield comment, declared


def in_words(comment, keys):
    """A contract as text: paragraphs, and code where all lines of one stand in from the margin."""
    paragraphs = re.split(r"\n[ \t]*\n", "\n".join(comment))
    return "\n\n".join(f"```cpp\n{textwrap.dedent(p)}\n```" if re.fullmatch(r"(?: {2,}.*\n?)+", p) else paragraph(p, keys)
                       for p in paragraphs)


def paragraph(text, keys):
    """Its parts (Units:, Fails:) on lines of their own, its sources as links."""
    pieces = re.split(r"(`[^`]*`)", text)
    for i in range(0, len(pieces), 2):  # between pieces of code
        pieces[i] = re.sub(r"([\\*_|])", r"\\\1", pieces[i]).replace("<", "&lt;")
        pieces[i] = re.sub(r"\[([^\]\[]+)\]", lambda m: keys.get(m[1], "\\" + m[0]), pieces[i])
    text = re.sub(r"(?m)^([A-Z][a-z]+): +", r"\n**\1** ", "".join(pieces))
    return with_lists(re.sub(r"(?m)^ {2,}", "", text))


def sources():
    """[Key] of the bibliography as a link from a page of the headers."""
    text = (root / "docs/bibliography.md").read_text()
    found = re.findall(r'<a id="([^"]+)"></a>\*\*\[([^\]]+)\]', text)
    return {key: f"[[{key}]](../../bibliography.md#{anchor})" for anchor, key in found}


def header_section(header, keys):
    """What a header declares, or nothing if it is the room's own affair."""
    told = list(declarations(header))
    if any(d and d[0].startswith("namespace") and c[0].startswith("Internals") for c, d in told):
        return []
    place = header.relative_to(root / "keyline").parts[1:]
    section = [f"## {'/'.join(place)}", "", "```cpp", f'#include "{header.relative_to(root)}"', "```", ""]
    for comment, declared in told:
        if declared and not declared[0].startswith("namespace"):
            section += ["```cpp", *declared, "```", ""]
        section += [in_words(comment, keys), ""]
    return section if told else []


def headers():
    """A page for every room: its headers with their contracts."""
    order = ROOMS.search((root / "keyline/CMakeLists.txt").read_text())[1].split()
    keys = sources()
    folder = out / "reference/headers"
    folder.mkdir(parents=True, exist_ok=True)
    about = "The library room by room, from the bottom up. What is a room's own affair is left out."
    listed = ["# Headers", "", about, "", "| room | holds |", "|---|---|"]
    told = dict(re.findall(r"(?m)^\| `(\w+)` \| ([^|]*) \|", (root / "docs/design/layout.md").read_text()))
    for room in order:
        page = [f"# Room {room}", "", told[room], ""]
        for header in sorted((root / "keyline" / room).rglob("*.h")):
            page += header_section(header, keys)
        (folder / f"{room}.md").write_text("\n".join(page) + "\n")
        listed.append(f"| [{room}](headers/{room}.md) | {told[room]} |")
    (folder.parent / "headers.md").write_text("\n".join(listed) + "\n")


def torn(site):
    """Paragraphs meant as tables or lists, and stars of a formula taken for emphasis, a line each."""
    for page in sorted(site.rglob("*.html")):
        text = re.sub(r"<(pre|code)>.*?</\1>", "", page.read_text(), flags=re.S)
        for found in re.findall(r"<p>(.*?)</p>", text, re.S):
            if re.search(r"(?m)^\|.* \| |^ *- |\]\(|<em>[\s,;=)]", found):
                yield f"{page.relative_to(site)}: {found[:80]}"


def check(site):
    """Pages that would ask the network for something, a line each."""
    asks = re.compile(r"<(?:script|link|img|iframe)[^>]*(?:src|href)=[\"'](?:https?:)?//[^\"']*", re.I)
    for page in sorted(site.rglob("*.html")):
        for found in asks.findall(page.read_text()):
            if 'rel="canonical"' not in found:
                yield f"{page.relative_to(site)}: {found}"
    for sheet in site.rglob("*.css"):
        for found in re.findall(r"url\([\"']?https?://[^)]*|@import [\"']?http[^;]*", sheet.read_text()):
            yield f"{sheet.relative_to(site)}: {found}"


if len(sys.argv) > 3:
    found = [*check(pathlib.Path(sys.argv[3])), *torn(pathlib.Path(sys.argv[3]))]
    print("\n".join(found))
    sys.exit(1 if found else 0)
gather()
operations()
headers()
