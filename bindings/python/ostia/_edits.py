"""An edit as the line of JSON that the libraries read (docs/methods/editing.md)."""

from __future__ import annotations

import json
from typing import Any


def _plain(value: Any) -> Any:
    """What json does not know: arrays and numbers of NumPy's."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"an edit's fields are numbers, words and places, not {type(value).__name__}")


def line(op: Any, /, **fields: Any) -> str:
    """`from_` is the field `from`, which is a word of Python's own."""
    if not fields and isinstance(op, str) and op.lstrip().startswith("{"):
        return op
    if isinstance(op, dict):
        fields = {**op, **fields}
        op = fields.pop("op", None)
    named = {name.rstrip("_"): value for name, value in fields.items()}
    if op == "pressure.inputs" and isinstance(named.get("inputs"), dict):
        named["inputs"] = [{"key": key, "value": value} for key, value in named["inputs"].items()]
    return json.dumps({"v": 1, "op": op, **named}, default=_plain)
