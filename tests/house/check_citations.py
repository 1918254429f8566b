#!/usr/bin/env python3
"""check_citations.py ROOT: what the tree cites can be found in the tree.

- every [Key] in comments and pages stands in docs/bibliography.md;
- a "Source:" of a contract names a key or a page below docs/;
- pages link to headings and anchors that are there;
- the glossary is sorted and names each term once;
- nothing refers to papers that lie outside the tree (reading notes, a contract, an issue).
Prints a line per breach and fails if there is any.
"""
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(sys.argv[1])
KEY = re.compile(r"(?<![\w\]`\"'])\[((?:de )?[A-Z]+[a-z][A-Za-z]*(?: \d{4})?|QLAC)\](?![(\[:`\w])")
OUTSIDE = re.compile(r"\bNOTES\b|\bCONTRACT\b|\bthe issue\b|\bDESIGN (?:in|lists|says)\b|\bSTYLE\.md\b")
NOT_CITED = {"Unreleased"}  # headings of the changelog
COMMENT = {".h": "//", ".cpp": "//", ".ts": "//", ".py": "#", ".cmake": "#"}


def files():
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True, check=True)
        names = listed.stdout.splitlines()
    except (OSError, subprocess.CalledProcessError):  # a tree without its history
        names = [str(p.relative_to(root)) for p in root.rglob("*") if p.is_file()]
    skipped = ("build/", "web/node_modules/", "tests/house/check_citations")
    return [root / n for n in names if not n.startswith(skipped) and (root / n).is_file()]


def slug(heading):
    """The anchor of a heading, as pages of Markdown have it."""
    text = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return re.sub(r"[\s]+", "-", text).strip("-")


def anchors(page):
    text = page.read_text()
    return {slug(h) for h in re.findall(r"^#+ (.*)$", text, re.M)} | set(re.findall(r'<a id="([^"]+)"', text))


def without_code(text):
    return re.sub(r"```.*?```|`[^`\n]*`", lambda m: "\n" * m.group().count("\n"), text, flags=re.S)


def out_of_order(page):
    """The first term of the glossary that does not come after the one before it."""
    terms = [t.lower().replace("α", "alpha") for t in re.findall(r"^\*\*(.+?)\*\*", page.read_text(), re.M)]
    plain = [re.sub(r"[^a-z0-9 ]", "", t) for t in terms]
    return next((terms[i + 1] for i in range(len(plain) - 1) if not plain[i] < plain[i + 1]), None)


keys = set(re.findall(r"\*\*\[([^\]]+)\]\*\*", (root / "docs/bibliography.md").read_text()))
if not keys:
    sys.exit("docs/bibliography.md holds no key")
breaches = []
misplaced = out_of_order(root / "docs/glossary.md")
if misplaced:
    breaches.append(f"docs/glossary.md: {misplaced} is out of order, or there twice")
for file in files():
    if file.suffix not in {".md", *COMMENT}:
        continue
    text = file.read_text()
    shown = file.relative_to(root)
    lines = (without_code(text) if file.suffix == ".md" else text).splitlines()
    for number, line in enumerate(lines, 1):
        mark = COMMENT.get(file.suffix)
        said = line if not mark else line[line.index(mark) :] if mark in line else ""
        for key in KEY.findall(said):
            if key not in keys | NOT_CITED:
                breaches.append(f"{shown}:{number}: [{key}] does not stand in docs/bibliography.md")
        if OUTSIDE.search(said):
            breaches.append(f"{shown}:{number}: refers to something outside the tree: {said.strip()}")
    for match in re.finditer(r"/// Source:((?:.*\n)(?:///  +.*\n)*)", text):
        if not re.search(r"\[[^\]]+\]|docs/", match[1]):
            number = text.count("\n", 0, match.start()) + 1
            breaches.append(f"{shown}:{number}: this source names no key of the bibliography")
    if file.suffix == ".md":
        for target, anchor in re.findall(r"\]\(([^)#\s]*)#([^)\s]+)\)", without_code(text)):
            page = (file.parent / target).resolve() if target else file
            if page.suffix == ".md" and page.exists() and anchor not in anchors(page):
                breaches.append(f"{shown}: links to {target}#{anchor}, which is not there")
print("\n".join(breaches))
sys.exit(1 if breaches else 0)
