"""Converts a scene from dicts to the text of a scene file, and its meshes to arrays that the text names.

Packages that write TOML do not accept numpy's numbers and do not name the field that they cannot write.
"""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import DataTypeError, InputError

_OF_CLOTH = ("positions", "faces", "edges", "rest_positions")
_OF_BODY = ("positions", "faces", "frames")


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
    if place.endswith(".vertices"):
        value = _vertices(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(entry, f"{place}[{index}]") for index, entry in enumerate(value)) + "]"
    raise DataTypeError(f"{place}: a scene consists of text, numbers, lists and tables, not {type(value).__name__}")


def _vertices(value: Any) -> Any:
    """Converts a mask, one bool for each vertex of the cloth, to numbers of vertices."""
    is_array = hasattr(value, "dtype") and value.dtype == np.bool_ and value.ndim == 1
    is_list = isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(entry, bool) for entry in value)
    return np.flatnonzero(value) if is_array or is_list else value


def _mesh(table: Any, keys: tuple[str, ...], place: str, meshes: list[dict[str, Any]]) -> Any:
    """Takes the arrays out of the table of a cloth or a body, and names them there."""
    if not isinstance(table, Mapping) or not any(key in table for key in keys):
        return table
    if "shape" in table:
        raise InputError(f"{place}: a mesh of arrays has no `shape`")
    missing = "faces" if keys is _OF_BODY or "edges" not in table else None
    if missing is not None and missing not in table:
        raise InputError(f"{place}: a mesh of arrays needs `faces`")
    if "positions" not in table and "frames" not in table:
        raise InputError(f"{place}: a mesh of arrays needs `positions`")
    meshes.append({"name": place} | {key: table[key] for key in keys if key in table})
    rest = {key: value for key, value in table.items() if key not in keys}
    return {"shape": "mesh", "mesh": place} | rest


def _meshes(tables: Any, keys: tuple[str, ...], place: str, meshes: list[dict[str, Any]]) -> Any:
    if isinstance(tables, (list, tuple)):
        return [_mesh(table, keys, f"{place}[{index}]", meshes) for index, table in enumerate(tables)]
    return _mesh(tables, keys, place, meshes)


def _without(effects: Any, name: str) -> Any:
    return {key: value for key, value in effects.items() if key != name} if isinstance(effects, Mapping) else effects


def text_of(scene: Mapping[str, Any]) -> tuple[str, list[dict[str, Any]]]:
    """Returns the text of a scene, and the meshes that it names."""
    if not isinstance(scene, Mapping):
        raise DataTypeError(f"a scene is a dict, not {type(scene).__name__}")
    scene, meshes = dict(scene), list[dict[str, Any]]()
    if not len(scene.get("body", ())):
        # So code need not build the scene by cases.
        scene.pop("body", None)
        cloths = scene.get("cloth")
        if isinstance(cloths, (list, tuple)):
            scene["cloth"] = [_without(cloth, "body_contact") for cloth in cloths]
        elif cloths is not None:
            scene["cloth"] = _without(cloths, "body_contact")
        if "effects" in scene:
            scene["effects"] = _without(scene["effects"], "body_contact")
    for name, keys in (("cloth", _OF_CLOTH), ("body", _OF_BODY)):
        if name in scene:
            scene[name] = _meshes(scene[name], keys, name, meshes)
    return "".join(f"{_key(key)} = {_value(value, str(key))}\n" for key, value in scene.items()), meshes
