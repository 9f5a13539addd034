"""Converts a scene from dicts to the text of a scene file.

Packages that write TOML do not accept numpy's numbers and do not name the field that they cannot write.
"""

import json
from collections.abc import Mapping
from typing import Any

from .errors import DataTypeError


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise DataTypeError(f"the names in a scene must be text, not {key!r}")
    return json.dumps(key)


def _value(value: Any, place: str) -> str:
    # TOML's basic strings are those of JSON, with the same escapes. A numpy number becomes a number of Python.
    if hasattr(value, "item") and getattr(value, "shape", None) == ():
        value = value.item()
    if isinstance(value, (bool, str)):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Mapping):
        entries = (f"{_key(key)} = {_value(of_key, f'{place}.{key}')}" for key, of_key in value.items())
        return "{" + ", ".join(entries) + "}"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(entry, f"{place}[{index}]") for index, entry in enumerate(value)) + "]"
    raise DataTypeError(f"{place}: a scene consists of text, numbers, lists and tables, not {type(value).__name__}")


def text_of(scene: Mapping[str, Any]) -> str:
    """Returns the text of a scene. Each entry of the outermost table has its own line, so that messages can name it."""
    return "".join(f"{_key(key)} = {_value(value, str(key))}\n" for key, value in scene.items())
