"""Converts arrays that the native library does not take as they are. Other arrays never come here."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .errors import DataTypeError, InputError

# Whole numbers up to this one are exact in float64.
_EXACT = 2**53


def _refuse_masked(value: object, name: str) -> None:
    if isinstance(value, np.ma.MaskedArray):
        raise InputError(f"{name}: this is a masked array, whose masked entries have no value; pass a plain array, such as {name}.filled(...)")


def _array(value: object, name: str) -> NDArray[Any]:
    _refuse_masked(value, name)
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name}: the rows have different lengths, or this is not an array of numbers ({error})") from None
    if array.dtype.kind not in "fiu":
        raise DataTypeError(f"{name}: expected numbers, not {array.dtype}")
    return array


def _rows(array: NDArray[Any], name: str, columns: int) -> NDArray[Any]:
    if array.size == 0 and array.ndim <= 2:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise InputError(f"{name}: expected an array of shape (n, {columns}), not {array.shape}")
    return array


def positions(value: object, name: str, single: bool) -> NDArray[Any]:
    """Returns an aligned array of shape (n, 3) in C order and native byte order: float32 if ``single`` allows it and the array is
    float32, otherwise float64."""
    array = _rows(_array(value, name), name, 3)
    if array.dtype.kind == "f" and array.dtype.itemsize > 8:
        raise DataTypeError(f"{name}: {array.dtype} would have to be rounded; convert it to float64 if you want that")
    if array.dtype.kind != "f" and array.dtype.itemsize == 8 and array.size:
        if int(array.max()) > _EXACT or int(array.min()) < -_EXACT:
            raise DataTypeError(f"{name}: whole numbers beyond 2^53 would have to be rounded; convert them to float64 if you want that")
    is_single = single and array.dtype.kind == "f" and array.dtype.itemsize == 4
    return np.require(array, np.float32 if is_single else np.float64, ["C", "A"])


def indices(value: object, name: str, columns: int) -> NDArray[np.uint32]:
    """Returns an array of uint32 of shape (n, columns) in C order; (n,) becomes (n, 1)."""
    array = _array(value, name)
    if array.dtype.kind == "f" and array.size:
        raise DataTypeError(f"{name}: expected whole numbers, not {array.dtype}")
    if columns == 1 and array.ndim == 1:
        array = array.reshape(-1, 1)
    array = _rows(array, name, columns)
    if array.size:
        least, most = int(array.min()), int(array.max())
        if least < 0:
            raise InputError(f"{name}: {least} is negative; indices start at 0")
        if most > 0xFFFF_FFFF:
            raise InputError(f"{name}: {most} is larger than 2^32 - 1, the largest index")
    return np.require(array, np.uint32, ["C", "A"])


def flags(value: object, name: str) -> NDArray[np.bool_]:
    """Returns an array of bool of shape (n,)."""
    _refuse_masked(value, name)
    array = np.asarray(value)
    if array.dtype != np.bool_ or array.ndim != 1:
        raise DataTypeError(f"{name}: expected an array of bool of shape (n,), not {array.dtype} of shape {array.shape}")
    return np.require(array, np.bool_, ["C", "A"])
