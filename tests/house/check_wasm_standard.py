#!/usr/bin/env python3
"""check_wasm_standard.py ROOT: what sources of the page without a server use of <ranges> and of the algorithms
on ranges stands in bindings/wasm/standard, for Emscripten's library has none of it. Needs no Emscripten.

Reads the rooms and the patterns of sources left out in bindings/wasm/CMakeLists.txt.
"""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
lists = (root / "bindings/wasm/CMakeLists.txt").read_text()
rooms = re.search(r"set\(rooms ([^)]+)\)", lists)[1].split()
left_out = [re.compile(p.replace("\\\\", "\\")) for p in re.findall(r'"(/[^"]*\\\\\.cpp\$|/[^"]*/)"', lists)]
if len(left_out) < 5:
    sys.exit("bindings/wasm/CMakeLists.txt: its patterns of sources that are left out are not found")

given = {name: set(re.findall(r"\b(\w+)\((?:const )?\w+&", (root / "bindings/wasm/standard" / file).read_text()))
         for name, file in [("ranges", "algorithm"), ("views", "ranges")]}
missing = []
for room in rooms:
    for file in sorted((root / "keyline" / room).rglob("*")):
        if file.suffix not in {".h", ".cpp"} or any(p.search(str(file)) for p in left_out):
            continue
        for number, line in enumerate(file.read_text().split("\n"), 1):
            for space, name in re.findall(r"std::(ranges|views)::(\w+)", line.split("//")[0]):
                if name not in given[space]:
                    missing.append(f"{file.relative_to(root)}:{number}: std::{space}::{name}")
if missing:
    print("\n".join(missing))
    sys.exit(f"{len(missing)} uses of what bindings/wasm/standard does not have: write it there")
