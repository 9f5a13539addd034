"""A scene said in Python, as the text of a scene file.

Some twenty lines, as the packages that write TOML know neither numpy's numbers nor which field they cannot write.
"""

import json
from collections.abc import Mapping
from typing import Any

from .errors import DataTypeError


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise DataTypeError(f"a scene's names are text, not {key!r}")
    return json.dumps(key)


def _value(value: Any, place: str) -> str:
    # TOML's basic strings are JSON's, escapes included; numbers that numpy has are numbers.
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
    raise DataTypeError(f"{place}: a scene has text, numbers, lists and tables, not {type(value).__name__}")


def text_of(scene: Mapping[str, Any]) -> str:
    """Each entry of the outermost table on a line of its own, so that messages name the line."""
    return "".join(f"{_key(key)} = {_value(value, str(key))}\n" for key, value in scene.items())
