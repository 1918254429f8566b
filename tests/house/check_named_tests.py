#!/usr/bin/env python3
"""check_named_tests.py ROOT: every `Suite.Name` that a table of docs/ names as a test is one.

Looks at rows of tables in the pages below docs/ whose code words have a test's form: two words in
CamelCase with a dot between them. Fails with the names that no file of tests/ declares.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
DECLARED = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)")
NAMED = re.compile(r"`([A-Z][A-Za-z0-9]+\.[A-Z][A-Za-z0-9]+)`")

declared = {".".join(m.groups()) for file in (root / "tests").rglob("*.cpp")
            for m in DECLARED.finditer(file.read_text())}
missing = [f"{page.relative_to(root)}:{number}: {name}" for page in sorted((root / "docs").rglob("*.md"))
           for number, line in enumerate(page.read_text().splitlines(), 1) if line.startswith("|")
           for name in NAMED.findall(line) if name not in declared]
if not declared:
    sys.exit("no test is declared below tests/")
print("\n".join(missing))
sys.exit(1 if missing else 0)
