"""Functions made from the declarations of the operations: names, defaults and help are theirs."""

from __future__ import annotations

import difflib
import inspect
import keyword
from typing import Any, Callable, Mapping

import numpy as np

from . import _keyline
from ._values import Curve, Record, Surface


def python_name(field: str) -> str:
    """lambda is a word of Python's own."""
    return field + "_" if keyword.iskeyword(field) else field


class Declaration:
    """One operation as it is declared."""

    def __init__(self, declared: dict[str, Any]) -> None:
        self.name: str = declared["name"]
        self.summary: str = declared["summary"]
        self.long_running: bool = declared["long_running"]
        self.request: dict[str, Any] = declared["request"]
        self.result: dict[str, Any] = declared["result"]
        known = {k: v for k, v in self.request["properties"].items() if k not in ("op", "id")}
        order = [k for k in declared["order"] if k in known]
        self.required = [k for k in order if k in self.request.get("required", [])]
        self.fields = {k: known[k] for k in [*self.required, *order, *known]}
        # An operation that needs nothing by name is about what its first field holds.
        self.subject = None if self.required or not order else order[0]

    @property
    def examples(self) -> list[dict[str, Any]]:
        """Requests that succeed."""
        return [{k: v for k, v in e.items() if k != "op"} for e in self.request.get("examples", [])]


def declarations() -> list[Declaration]:
    """All operations."""
    return [Declaration(d) for d in _keyline.declared()]


def perform(name: str, fields: Mapping[str, Any], threads: int = 0, progress: Any = None) -> Any:
    """An operation by name, on fields of the public interface: what JSON would give.

    >>> import keyline
    >>> keyline.perform("lac.region", {"theta": 1.0, "alpha": -1.0})["psi"][0] > 0
    True
    """
    return _keyline.perform(name, dict(fields), threads, progress)


def shaped(value: Any, schema: dict[str, Any], defs: dict[str, Any]) -> Any:
    """A result by its schema: curves, surfaces, arrays and records in place of JSON's values."""
    for choice in schema.get("anyOf", []):
        if value is None:
            return None
        if choice.get("type") != "null":
            return shaped(value, choice, defs)
    for part in schema.get("allOf", []):
        return shaped(value, part, defs)
    name = schema.get("$ref", "").removeprefix("#/$defs/")
    if name == "Curve":
        return Curve(value)
    if name == "Surface":
        return Surface(value)
    if name:
        return shaped(value, defs[name], defs)
    if isinstance(value, dict) and "properties" in schema:
        known = schema["properties"]
        return Record({python_name(k): shaped(v, known.get(k, {}), defs) for k, v in value.items()})
    if isinstance(value, list):
        items = schema.get("items", {})
        if is_numeric(items, defs):
            return np.array(value, dtype=float)
        return [shaped(v, items, defs) for v in value]
    return value


def is_number(schema: dict[str, Any]) -> bool:
    """A number or a whole one."""
    return schema.get("type") in ("number", "integer")


def is_numeric(schema: dict[str, Any], defs: dict[str, Any]) -> bool:
    """Numbers, or lists of them: what an array holds."""
    name = schema.get("$ref", "").removeprefix("#/$defs/")
    if name in defs:
        schema = defs[name]
    if schema.get("type") == "array":
        return is_number(schema.get("items", {}))
    return is_number(schema)


def answer_of(declaration: Declaration, result: Any) -> Any:
    """A curve or surface that knows the rest of the result, or the result as a record."""
    schema = declaration.result
    record = shaped(result, schema, schema.get("$defs", {}))
    for name, kind in (("curve", Curve), ("surface", Surface)):
        if isinstance(record, Record) and name in record and isinstance(record[name], kind):
            made = record[name]
            made.result = record
            return made
    return record


def signature_of(declaration: Declaration) -> inspect.Signature:
    """Required fields first, by place or name; the rest by name with their defaults."""
    parameters = []
    for name, schema in declaration.fields.items():
        needed = name in declaration.required
        by_place = needed or name == declaration.subject
        parameters.append(
            inspect.Parameter(
                python_name(name),
                inspect.Parameter.POSITIONAL_OR_KEYWORD if by_place else inspect.Parameter.KEYWORD_ONLY,
                default=inspect.Parameter.empty if needed else schema.get("default"),
            )
        )
    if declaration.long_running:
        parameters.append(inspect.Parameter("progress", inspect.Parameter.KEYWORD_ONLY, default=None))
    return inspect.Signature(parameters)


def _bounds(schema: dict[str, Any]) -> str:
    words = {"minimum": "at least", "exclusiveMinimum": "above", "maximum": "at most", "exclusiveMaximum": "below"}
    said = [f"{word} {schema[key]:g}" for key, word in words.items() if key in schema]
    if "enum" in schema:
        said.append("one of " + ", ".join(map(repr, schema["enum"])))
    return ", ".join(said)


def _described(fields: dict[str, Any], required: list[str]) -> list[str]:
    lines = []
    for name, schema in fields.items():
        notes = [schema.get("description", ""), schema.get("x-unit", ""), _bounds(schema)]
        if name in required:
            notes.append("required")
        lines.append(f"    {python_name(name)}: " + "; ".join(n for n in notes if n))
    return lines


def documentation_of(declaration: Declaration) -> str:
    """Summary, fields, parts of the result, and examples that run."""
    lines = [declaration.summary, "", "Fields:", *_described(declaration.fields, declaration.required)]
    parts = declaration.result.get("properties", {})
    if parts:
        lines += ["", "Result:", *_described(parts, [])]
    if declaration.examples:
        lines += ["", "Examples:"]
    for example in declaration.examples:
        given = ", ".join(f"{python_name(k)}={v!r}" for k, v in example.items())
        lines.append(f"    >>> answer = keyline.{declaration.name}({given})")
    return "\n".join(lines)


def _unknown(named: dict[str, Any], signature: inspect.Signature) -> str:
    """"there is no field …; did you mean …?" of the first name that is none of the function's, or nothing."""
    for name in named:
        if name not in signature.parameters:
            near = difflib.get_close_matches(name, signature.parameters, 1)
            return f"there is no field {name!r}" + (f"; did you mean {near[0]!r}?" if near else "")
    return ""


def function_of(declaration: Declaration) -> Callable[..., Any]:
    """The operation as a function."""
    signature = signature_of(declaration)
    fields = {python_name(name): name for name in declaration.fields}

    def operation(*given: Any, **named: Any) -> Any:
        try:
            bound = signature.bind(*given, **named).arguments
        except TypeError as wrong:
            raise TypeError(f"keyline.{declaration.name}(): {_unknown(named, signature) or wrong}") from None
        progress = bound.pop("progress", None)
        request = {fields[k]: v for k, v in bound.items() if v is not None}
        subject = declaration.subject
        if subject != "curve" and "curve" in declaration.fields and isinstance(request.get(subject), Curve):
            request["curve"] = request.pop(subject)
        threads = request.pop("threads", 0)
        return answer_of(declaration, _keyline.perform(declaration.name, request, threads, progress))

    operation.__name__ = operation.__qualname__ = declaration.name.rpartition(".")[2]
    operation.__module__ = "keyline"
    operation.__doc__ = documentation_of(declaration)
    operation.__signature__ = signature  # type: ignore[attr-defined]
    return operation


class Namespace:
    """Operations that share the first part of their names."""

    def __init__(self, name: str) -> None:
        self.__name__ = name
        self.__doc__ = f"Operations {name}.…"

    def __repr__(self) -> str:
        return f"<operations keyline.{self.__name__}: {', '.join(sorted(k for k in vars(self) if k[0] != '_'))}>"


def build(target: dict[str, Any]) -> None:
    """Puts every operation into the package's names: "fair", or "segment" into "lac"."""
    for declaration in declarations():
        space, _, name = declaration.name.rpartition(".")
        function = function_of(declaration)
        if not space:
            target[name] = function
            continue
        target.setdefault(space, Namespace(space))
        setattr(target[space], python_name(name), function)
