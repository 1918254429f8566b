"""Writes the package's stub: `python -m keyline._stubs __init__.pyi`. Every signature and every part
of a result comes from the declarations that the functions themselves are made from."""

from __future__ import annotations

import sys
from typing import Any

from ._operations import Declaration, declarations, is_number, is_numeric, python_name

HEAD = '''\
# Written by keyline._stubs from the operations' declarations.
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, Union

from numpy.typing import NDArray
import numpy as np

from ._errors import BadInput as BadInput, Cancelled as Cancelled, Error as Error
from ._errors import FileFailure as FileFailure, NotConverged as NotConverged
from ._errors import Undrawable as Undrawable, Unsupported as Unsupported
from ._values import Curve as Curve, Record as Record, Segments as Segments, Surface as Surface
from ._values import segments as _segments

__version__: str
Array = NDArray[np.float64]
Numbers = Union[Sequence[Any], NDArray[Any]]
CurveLike = Union[Curve, Mapping[str, Any]]
SurfaceLike = Union[Surface, Mapping[str, Any]]
Progress = Callable[[float, str], object]

def perform(name: str, fields: Mapping[str, Any], threads: int = ..., progress: Progress | None = ...) -> Any: ...
'''


def capitals(name: str) -> str:
    """lac.segment -> LacSegment."""
    return "".join(part[:1].upper() + part[1:] for part in name.replace("-", "_").replace(".", "_").split("_"))


class Stubs:
    """The text of the stub, class by class."""

    def __init__(self) -> None:
        self.classes: dict[str, str] = {}
        self.schemas: dict[str, Any] = {}

    def given(self, schema: dict[str, Any], defs: dict[str, Any]) -> str:
        """The type of a field of a request."""
        if "anyOf" in schema:
            return " | ".join(dict.fromkeys(self.given(s, defs) for s in schema["anyOf"]))
        name = schema.get("$ref", "").removeprefix("#/$defs/")
        if name in ("Curve", "Surface"):
            return name + "Like"
        if name in ("Point", "Point3") or is_numeric(schema, defs) and not is_number(schema):
            return "Numbers"
        if name:
            return "Mapping[str, Any]"
        if "enum" in schema:
            return "Literal[" + ", ".join(map(repr, schema["enum"])) + "]"
        kind = schema.get("type")
        if kind == "array":
            items = schema.get("items", {})
            return "Numbers" if is_numeric(items, defs) else f"Sequence[{self.given(items, defs)}]"
        return {"number": "float", "integer": "int", "boolean": "bool", "string": "str | os.PathLike[str]",
                "object": "Mapping[str, Any]", "null": "None"}.get(str(kind), "Any")  # fmt: skip

    def made(self, schema: dict[str, Any], defs: dict[str, Any], owner: str) -> str:
        """The type of a part of a result."""
        if "anyOf" in schema:
            return " | ".join(dict.fromkeys(self.made(s, defs, owner) for s in schema["anyOf"]))
        if "allOf" in schema:
            return self.made(schema["allOf"][0], defs, owner)
        name = schema.get("$ref", "").removeprefix("#/$defs/")
        if name in ("Curve", "Surface"):
            return name
        if name in ("Point", "Point3") or is_numeric(schema, defs) and not is_number(schema):
            return "Array"
        if name:
            return self.record(name, defs[name], defs, owner)
        if "enum" in schema:
            return "Literal[" + ", ".join(map(repr, schema["enum"])) + "]"
        kind = schema.get("type")
        if kind == "array":
            items = schema.get("items", {})
            return "Array" if is_numeric(items, defs) else f"list[{self.made(items, defs, owner)}]"
        return {"number": "float", "integer": "int", "boolean": "bool", "string": "str", "null": "None"}.get(
            str(kind), "Any"
        )

    def record(self, name: str, schema: dict[str, Any], defs: dict[str, Any], owner: str, base: str = "Record") -> str:
        """A class for a record of a result; two records of one name keep apart by their operation."""
        if schema.get("type") != "object" and "properties" not in schema:
            return self.made(schema, defs, owner)
        if name in self.schemas and self.schemas[name] != schema:
            name = capitals(owner) + name
        if name in self.schemas:
            return name
        self.schemas[name] = schema
        self.classes[name] = ""
        lines = [f"class {name}({base}):"]
        for field, part in schema.get("properties", {}).items():
            kind = self.made(part, defs, owner)
            if field not in schema.get("required", []) and "None" not in kind.split(" | "):
                kind += " | None"
            if base == "Record" or field not in ("curve", "surface", "length", "deviation", "result"):
                lines.append(f"    {python_name(field)}: {kind}")
        if len(lines) == 1:
            lines.append("    ...")
        self.classes[name] = "\n".join(lines)
        return name

    def answer(self, declaration: Declaration) -> str:
        """What the function gives back."""
        schema = declaration.result
        defs = schema.get("$defs", {})
        parts = schema.get("properties", {})
        base = "Record"
        for name in ("curve", "surface"):
            if parts.get(name, {}).get("$ref") == f"#/$defs/{name.capitalize()}":
                base = name.capitalize()
                break
        return self.record(capitals(declaration.name) + "Answer", {"type": "object", **schema}, defs, declaration.name, base)

    def function(self, declaration: Declaration, in_class: bool) -> str:
        """Its line in the stub."""
        defs = declaration.request.get("$defs", {})
        given = ["self"] if in_class else []
        optional = []
        for name, schema in declaration.fields.items():
            kind = self.given(schema, defs)
            if name == declaration.subject:
                wide = f"CurveLike | {kind}" if "curve" in declaration.fields and name != "curve" else kind
                given.append(f"{python_name(name)}: {wide} | None = ...")
            elif name in declaration.required:
                given.append(f"{python_name(name)}: {kind}")
            else:
                optional.append(f"{python_name(name)}: {kind} | None = ...")
        if declaration.long_running:
            optional.append("progress: Progress | None = ...")
        if optional:
            given += ["*", *optional]
        name = python_name(declaration.name.rpartition(".")[2])
        return f"def {name}({', '.join(given)}) -> {self.answer(declaration)}: ..."


def text() -> str:
    """The whole stub."""
    stubs = Stubs()
    plain, spaces = [], {}  # type: ignore[var-annotated]
    for declaration in declarations():
        space = declaration.name.rpartition(".")[0]
        if space:
            spaces.setdefault(space, []).append("    " + stubs.function(declaration, True))
        else:
            plain.append(stubs.function(declaration, False))
    if "lac" in spaces:
        spaces["lac"].append("    segments = staticmethod(_segments)")
    if "sketch" in spaces:
        spaces["sketch"].append("    def __call__(self, image: Any, **fields: Any) -> SketchTraceAnswer: ...")
    parts = [HEAD, *stubs.classes.values()]
    for space, functions in spaces.items():
        parts.append(f"class _{capitals(space)}:\n" + "\n".join(functions))
    parts += [f"{space}: _{capitals(space)}" for space in spaces]
    if "document" in spaces:
        parts.append("def read(file: str | os.PathLike[str], **fields: Any) -> DocumentReadAnswer: ...")
        parts.append("def write(file: str | os.PathLike[str], *shapes: Any, **fields: Any) -> DocumentWriteAnswer: ...")
    return "\n\n".join(parts + plain) + "\n"


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(text())
