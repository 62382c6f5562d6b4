"""What a picture colours: a number per drawn block."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import UnknownName
from .results import Frame

_COMPONENTS = {
    "displacement": ("x", "y"),
    "velocity": ("x", "y"),
    "centroid": ("x", "y"),
    "stress": ("xx", "yy", "zz", "xy"),
    "principal_stress": ("major", "minor", "out_of_plane"),
}
_UNITS = {
    "displacement": "m",
    "velocity": "m/s",
    "centroid": "m",
    "stress": "Pa",
    "principal_stress": "Pa",
    "rotation": "rad",
    "omega": "rad/s",
    "area": "m2",
    "mass": "kg",
}
_WHOLE_NAMES = {"stress": "mean stress in the plane", "principal_stress": "most compressive stress"}
_OF_SIMULATIONS = ("centroid", "displacement", "rotation", "velocity", "omega", "stress", "overstress")
_CONSTANTS = ("id", "material", "fixed", "area", "mass")
_OF_CUTS = ("id", "material", "fixed", "area")
KINDS = ("id", "material", "fixed")


def label_of(field: ArrayLike) -> str:
    """Name and unit, empty for an array."""
    if not isinstance(field, str):
        return ""
    unit = _UNITS.get(field.split(".")[0])
    name = _WHOLE_NAMES.get(field, field)
    return f"{name} ({unit})" if unit else name


def is_of_motion(source: Any, field: ArrayLike) -> bool:
    """Whether it says nothing about blocks that are fixed."""
    return isinstance(field, str) and not hasattr(source, "blocks") and field not in _CONSTANTS


def values_of(source: Any, field: ArrayLike, ids: NDArray[np.int64]) -> NDArray[np.float64]:
    """A number per block of `ids`. source: a Frame, a
    Simulation or a Cut; field: a name as of edda plot, or an array with a number per block."""
    if not isinstance(field, str):
        return _per_block(source, np.asarray(field, dtype=np.float64), ids)
    name, _, component = field.partition(".")
    values = np.asarray(_array(source, name, ids), dtype=np.float64)
    known = _COMPONENTS.get(name, ())
    if values.ndim == 1 or not component:
        if component:
            raise UnknownName(f"component of {name}", component, ())
        return values if values.ndim == 1 else _whole(name, values)
    if component not in known:
        raise UnknownName(f"component of {name}", component, known)
    return values[:, known.index(component)]


def _whole(name: str, values: NDArray[np.float64]) -> NDArray[np.float64]:
    """What the name alone stands for, as in edda plot."""
    if name == "stress":
        return 0.5 * (values[:, 0] + values[:, 1])
    if name == "principal_stress":
        return values[:, 1]
    if name in ("displacement", "velocity"):
        return np.hypot(values[:, 0], values[:, 1])
    known = _COMPONENTS.get(name, tuple(map(str, range(values.shape[1]))))
    raise ValueError(f'"{name}" has components: give {" or ".join(f"{name}.{c}" for c in known)}')


def _array(source: Any, name: str, ids: NDArray[np.int64]) -> NDArray[Any]:
    """(n,) or (n, components)"""
    if isinstance(source, Frame):
        if name not in source.cell_fields:
            raise UnknownName("field of frames", name, source.cell_fields)
        return source[name]
    if name == "id" and name in _OF_CUTS:
        return ids
    if hasattr(source, "blocks"):
        if name not in _OF_CUTS:
            raise UnknownName("field of a cut", name, _OF_CUTS)
        return np.array([getattr(block, name) for block in source.blocks])
    if name in _CONSTANTS:
        return np.asarray(getattr(source, name))[ids]
    if name == "principal_stress":
        return _principal(source.field("stress")[ids])
    if name not in _OF_SIMULATIONS:
        raise UnknownName("field", name, (*_OF_SIMULATIONS, "principal_stress", *_CONSTANTS))
    return np.asarray(source.field(name)[ids])


def _principal(stress: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, 4) xx yy zz xy -> (n, 3) major, minor, out of plane; Pa."""
    xx, yy, zz, xy = stress.T
    mean, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    return np.column_stack([mean + radius, mean - radius, zz])


def fixed_blocks(source: Any, ids: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Which of the drawn blocks are fixed."""
    if isinstance(source, Frame):
        if "fixed" not in source:
            return np.zeros(len(ids), dtype=bool)
        return np.asarray(source["fixed"] != 0)
    if hasattr(source, "blocks"):
        return np.array([block.fixed for block in source.blocks], dtype=bool)
    return np.asarray(source.fixed[ids] != 0)


def _per_block(source: Any, given: NDArray[np.float64], ids: NDArray[np.int64]) -> NDArray[np.float64]:
    """Of an array with a number per block those that are drawn."""
    least = int(ids.max(initial=-1)) + 1
    if isinstance(source, Frame):  # which knows the blocks that are left alone
        fits = given.ndim == 1 and len(given) >= least
    else:
        least = source.block_count if hasattr(source, "block_count") else len(source.blocks)
        fits = given.shape == (least,)
    if not fits:
        raise ValueError(f"the array has the shape {given.shape}: give one number per block, ({least},)")
    return np.asarray(given[ids])
