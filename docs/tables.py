#!/usr/bin/env python3
"""tables.py ROOT BUILD [--write]: tables of the documentation that the code makes.

A page holds them between <!-- table: NAME --> and <!-- end -->. Without --write nothing is changed and
a table that differs from what the code says is a failure; so is the guide's list of formats where its
extensions are not those the code reads and writes.
"""
import pathlib
import re
import sys

root, build = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
write = "--write" in sys.argv


def libraries():
    """Every room, the rooms it uses and what has to be installed for it (rooms.tsv of the build)."""
    rows = [line.split("\t") for line in (build / "rooms.tsv").read_text().splitlines()]
    return [
        "| room | uses the rooms | libraries of others (Debian's package) |",
        "|---|---|---|",
        *(f"| `{room}` | {uses or '—'} | {needs or '—'} |" for room, uses, needs in rows),
    ]


def errata(paper):
    """What is wrong in a paper, from the table of all of them."""
    text = (root / "docs/readings.md").read_text()
    rows = re.findall(rf"(?m)^\| \[{paper}\] ([^|]*)\| ([^|]*)\| ([^|]*)\|$", text)
    lines = [f"| {where.strip()} | {said.strip()} | {right.strip()} |" for where, said, right in rows]
    return ["| where | is | must be |", "|---|---|---|", *lines]


def blocks_of(page):
    text = page.read_text()

    def made(match):
        name, *of = match[1].split()
        return f"<!-- table: {match[1]} -->\n" + "\n".join(globals()[name](*of)) + "\n<!-- end -->"

    return text, re.sub(r"<!-- table: ([\w ]+) -->\n(?:.*?\n)?<!-- end -->", made, text, flags=re.S)


def code_formats():
    """Extensions that room exchange knows, and those it writes."""
    code = (root / "keyline/exchange/format/format.cpp").read_text()
    known = set(re.findall(r'^\s*\{"(\.\w+)", Format::', code, re.M))
    written = re.search(r"written_extensions\(\) \{(.*?)\}", code, re.S)[1]
    return known, set(re.findall(r'"(\.\w+)"', written))


def wrong_formats():
    known, written = code_formats()
    table = [r.split("|") for r in (root / "docs/guide/exchange.md").read_text().splitlines() if r.startswith("| `.")]
    read, out = set(), set()
    for row in table:
        extensions = set(re.findall(r"`(\.\w+)`", row[1]))
        read |= extensions if row[2].strip() else set()
        out |= extensions if row[3].strip() else set()
    texts = {".xyz", ".pts"}  # points under any name
    pages = {".pdf"}  # drawn by room presentation, like .png and .html
    differ = [f"reads {x}, which the guide's table leaves out" for x in sorted(known - read)]
    differ += [f"does not read {x}, which the guide's table names" for x in sorted(read - known - texts)]
    differ += [f"writes {x}, which the guide's table leaves out" for x in sorted(written - out)]
    differ += [f"does not write {x}, which the guide's table names" for x in sorted(out - written - texts - pages)]
    return ["docs/guide/exchange.md: the code " + d for d in differ]


failures = wrong_formats()
for page in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]:
    before, after = blocks_of(page)
    if before != after and write:
        page.write_text(after)
    elif before != after:
        failures.append(f"{page.relative_to(root)}: a table is not what the code says; docs/tables.py --write mends it")
print("\n".join(failures))
sys.exit(1 if failures else 0)
