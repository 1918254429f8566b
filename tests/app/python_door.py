"""Requests as lines of JSON in, what the Python package makes of them as lines of JSON out.

Every request goes through the function made for its operation, by name: what a person would call.
The natural objects it gives are turned back into the public interface's values."""

from __future__ import annotations

import json
import keyword
import sys
from functools import reduce
from typing import Any

import numpy as np

import keyline


def field_name(name: str) -> str:
    """lambda_ as the lambda it stands for."""
    return name[:-1] if name.endswith("_") and keyword.iskeyword(name[:-1]) else name


def plain(value: Any) -> Any:
    """A value of the public interface."""
    if isinstance(value, (keyline.Curve, keyline.Surface)):
        shown = dict(value.value)
        deviation = getattr(value, "deviation", None) if isinstance(value, keyline.Curve) else None
        return shown if deviation is None else {**shown, "deviation": deviation}
    if isinstance(value, keyline.Record):
        return {field_name(name): plain(value[name]) for name in value}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, list):
        return [plain(item) for item in value]
    return value


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """The answer to one request, as `keyline batch` forms it."""
    operation = reduce(getattr, (part + "_" * keyword.iskeyword(part) for part in request["op"].split(".")), keyline)
    fields = {k + "_" * keyword.iskeyword(k): v for k, v in request.items() if k != "op"}
    try:
        made = operation(**fields)
    except (keyline.Error, TypeError) as error:
        return {"ok": False, "message": str(error)}
    record = getattr(made, "result", None)
    return {"ok": True, "result": plain(record if isinstance(record, keyline.Record) else made)}


for line in sys.stdin:
    print(json.dumps(answer(json.loads(line))))
