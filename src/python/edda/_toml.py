"""A model as a dict, written as TOML: the same keys then meet the same checks."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from ._errors import Fault, ModelError


def dumps(model: Mapping[str, Any]) -> str:
    """TOML that reads back to the same values, to the bit.

    Values may be str, bool, int, float, NumPy scalars and arrays, lists and tuples of these, and
    dicts; a list of dicts is a list of tables. A key whose value is None is left out.
    """
    faults: list[Fault] = []
    lines = [f"{_key(name)} = {_value(value, str(name), faults)}" for name, value in model.items() if value is not None]
    if faults:
        raise ModelError(faults)
    return "\n".join(lines) + "\n"


def _key(name: Any) -> str:
    return _string(name if isinstance(name, str) else str(name))


def _string(text: str) -> str:
    named = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    escaped = "".join(named.get(c, c if " " <= c != "\x7f" else f"\\u{ord(c):04x}") for c in text)
    return f'"{escaped}"'


def _label(item: Any, number: int) -> str:
    """As faults call an element of a list: its name, or its number."""
    return str(item["name"]) if isinstance(item, Mapping) and item.get("name") else str(number)


def _value(value: Any, key: str, faults: list[Fault]) -> str:
    if hasattr(value, "tolist"):  # NumPy's scalars and arrays
        value = value.tolist()
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            faults.append(Fault(key, "is a whole number beyond 64 bits", "give a smaller one, or a float"))
            return "0"
        return int.__repr__(value)  # of an IntEnum, too
    if isinstance(value, float):
        return float.__repr__(value)  # nan and inf are TOML's words, too
    if isinstance(value, (list, tuple)):
        items = [_value(item, f"{key}.{_label(item, n)}", faults) for n, item in enumerate(value)]
        return "[" + ", ".join(items) + "]"
    if isinstance(value, Mapping):
        items = [
            f"{_key(name)} = {_value(item, f'{key}.{name}', faults)}"
            for name, item in value.items()
            if item is not None
        ]
        return "{" + ", ".join(items) + "}"
    faults.append(Fault(key, f"is of type {type(value).__name__}", "give a number, a text, a list or a dict"))
    return "0"


def setting(key: str, value: Any) -> str:
    """The override "key=value"."""
    faults: list[Fault] = []
    text = f"{key}={_value(value, key, faults)}"
    if faults:
        raise ModelError(faults)
    return text
