"""check_using.py ROOT: no source uses a name before it says where the name is from.

`./dev` compiles twenty sources as one, in which the using-declaration of one serves the next; compiled file by file, as
everybody else does, the name is unknown. Prints one line per fault and ends with 1 if there is any.
"""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
DECLARED = re.compile(r"^using (?:enum )?[\w:]+::(\w+);", re.M)
NOT_CODE = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"|^#[^\n]*', re.M)


def faults_of(text):
    code = NOT_CODE.sub("", text)
    for declared in DECLARED.finditer(code):
        name = declared[1]
        used = re.search(rf"(?<![\w:.>]){name}\b(?=::|[ &*>({{,])", code[: declared.start()])
        if used:
            yield code.count("\n", 0, used.start()) + 1, name


faults = [
    f"{path.relative_to(root)}:{line}: {name} is used before it is declared by using"
    for folder in ("keyline", "apps", "bindings", "tests", "bench", "fuzz")
    for path in sorted((root / folder).rglob("*.cpp"))
    for line, name in faults_of(path.read_text())
]
print("\n".join(faults))
sys.exit(bool(faults))
