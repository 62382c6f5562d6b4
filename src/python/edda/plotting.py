"""Pictures with Matplotlib, which is imported when one is asked for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .results import Frame, Results

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._edda import Cut, Simulation

_COMPONENTS = {
    "displacement": ("x", "y"),
    "velocity": ("x", "y"),
    "centroid": ("x", "y"),
    "stress": ("xx", "yy", "zz", "xy"),
}
_UNITS = {"displacement": "m", "velocity": "m/s", "centroid": "m", "stress": "Pa", "rotation": "rad", "omega": "rad/s"}


def plot_blocks(
    source: Simulation | Results | Frame | Cut,
    field: str | NDArray[Any] | None = None,
    ax: Axes | None = None,
    *,
    whole_range: bool = False,
    **options: Any,
) -> Axes:
    """Draws the blocks, coloured by a field.

    source: a Simulation as it stands, a Frame, Results (their last frame) or a Cut. field: a name
    as of Simulation.field() or of a frame ("displacement" and "velocity" give sizes,
    "displacement.x" and "stress.yy" components), or an array (nb,) with a number per block.
    whole_range: the colours reach as far as the values, even where few blocks come near; else a few that lie
    far beyond have the colour of the bar's end, which is then a point (as in edda plot). options go to
    Matplotlib's PathCollection; clim or norm among them says what the colours are.
    """
    import matplotlib.pyplot as plt
    from matplotlib.collections import PathCollection

    paths, ids = _outlines(source)
    if ax is None:
        ax = plt.subplots()[1]
    style: dict[str, Any] = {"edgecolors": "black", "linewidths": 0.4, "facecolors": "0.85"}
    if field is not None:
        del style["facecolors"]
    drawn = PathCollection(paths, **{**style, **options})
    if field is not None:
        values = np.asarray(_values(source, field, ids), dtype=np.float64)
        drawn.set_array(values)
        extend = "neither"
        is_kind = isinstance(field, str) and field in ("id", "material", "fixed")
        if not is_kind and not whole_range and not {"clim", "norm"} & set(options):
            extend = _limit_colours(drawn, values, _weights(source, paths, ids))
        label = field if isinstance(field, str) else ""
        unit = _UNITS.get(label.split(".")[0])
        ax.figure.colorbar(drawn, ax=ax, extend=extend, label=f"{label} ({unit})" if unit else label)
    ax.add_collection(drawn)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_xlabel("x (m)")
    ax.set_ylabel("y (m)")
    return ax


def plot_history(results: Results, columns: str | Sequence[str], ax: Axes | None = None, **options: Any) -> Axes:
    """Draws columns of history.csv over time, one or several; options go to Axes.plot()."""
    import matplotlib.pyplot as plt

    if ax is None:
        ax = plt.subplots()[1]
    history = results.history
    for column in [columns] if isinstance(columns, str) else columns:
        if column not in (history.dtype.names or ()):
            raise ValueError(f'history.csv has no column "{column}": it has {", ".join(history.dtype.names or ())}')
        ax.plot(history["time"], history[column], **{"label": column, **options})
    ax.set_xlabel("time (s)")
    ax.legend()
    return ax


def _outlines(source: Any) -> tuple[list[Any], NDArray[np.int64]]:
    """Closed paths, and the block that each belongs to."""
    from matplotlib.path import Path

    def path_of(rings: Sequence[NDArray[np.float64]]) -> Path:
        return Path.make_compound_path(*(Path(np.vstack([r, r[:1]]), closed=True) for r in rings))

    if isinstance(source, Results):
        source = source.frames[-1]
    if isinstance(source, Frame):
        return [path_of([p]) for p in source.polygons()], np.asarray(source["id"], dtype=np.int64)
    if hasattr(source, "polygons"):
        alive = np.flatnonzero(source.alive)
        polygons = source.polygons()
        return [path_of(polygons[i]) for i in alive], alive
    return [path_of(block.rings) for block in source.blocks], np.arange(len(source.blocks))


def _weights(source: Any, paths: list[Any], ids: NDArray[np.int64]) -> NDArray[np.float64]:
    """How much each path counts where a few may lie beyond the colours: its area, of held blocks nothing."""
    areas = np.array([abs(sum(_area(ring) for ring in path.to_polygons(closed_only=False))) for path in paths])
    if isinstance(source, Results):
        source = source.frames[-1]
    if isinstance(source, Frame):
        fixed = source["fixed"] if "fixed" in source.cell_fields else np.zeros(len(areas))
    elif hasattr(source, "fixed"):
        fixed = source.fixed[ids]
    else:
        fixed = np.array([block.fixed for block in source.blocks])
    return np.where(np.asarray(fixed) != 0, 0.0, areas)


def _area(ring: NDArray[np.float64]) -> float:
    x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def _limit_colours(drawn: Any, values: NDArray[np.float64], weights: NDArray[np.float64]) -> str:
    """Ends the colours where nearly all values do; where values lie beyond, in the words of a colorbar.

    The rule of the program's pictures (src/report/drawn_range.cpp), from the values beyond which 1 % of the area lie.
    """
    counts = np.isfinite(values) & (weights > 0.0)
    if not counts.any():
        return "neither"
    order = np.argsort(values[counts])
    v, w = values[counts][order], weights[counts][order]
    rest = 0.01 * w.sum()
    inner_high = v[np.searchsorted(-(np.cumsum(w[::-1])[::-1] - w), -rest)]
    inner_low = v[len(v) - 1 - np.searchsorted(-(np.cumsum(w) - w)[::-1], -rest)]
    size = max(abs(inner_low), abs(inner_high))
    if size <= 1e-6 * max(abs(v[0]), abs(v[-1])):
        return "neither"
    below, above = bool(v[0] < inner_low - size), bool(v[-1] > inner_high + size)
    if not below and not above:
        return "neither"
    drawn.set_clim(inner_low - 0.5 * size if below else v[0], inner_high + 0.5 * size if above else v[-1])
    return "both" if below and above else "min" if below else "max"


def _values(source: Any, field: str | NDArray[Any], ids: NDArray[np.int64]) -> NDArray[Any]:
    """A number per path."""
    if not isinstance(field, str):
        return _per_block(source, np.asarray(field), ids)
    name, _, component = field.partition(".")
    if isinstance(source, Results):
        source = source.frames[-1]
    if isinstance(source, Frame):
        if name not in source.cell_fields:
            raise ValueError(f'frames have no field "{name}": they have {", ".join(source.cell_fields)}')
        values = source[name]
    elif hasattr(source, "field"):
        values = source.field(name)[ids]
    else:
        values = np.array([getattr(block, name) for block in source.blocks])
    if values.ndim == 1:
        return values
    if component:
        known = _COMPONENTS.get(name, ())
        if component not in known:
            raise ValueError(f'"{name}" has no component "{component}": it has {", ".join(known)}')
        return values[:, known.index(component)]
    if name in ("displacement", "velocity"):
        return np.hypot(values[:, 0], values[:, 1])
    raise ValueError(f'"{name}" has components: give "{name}.{_COMPONENTS.get(name, ("0",))[0]}"')


def _per_block(source: Any, given: NDArray[Any], ids: NDArray[np.int64]) -> NDArray[Any]:
    """Of an array with a number per block those of the paths."""
    least = int(ids.max(initial=-1)) + 1
    if isinstance(source, (Results, Frame)):  # which know the blocks that are left alone
        fits = given.ndim == 1 and len(given) >= least
    else:
        least = source.block_count if hasattr(source, "block_count") else len(source.blocks)
        fits = given.shape == (least,)
    if not fits:
        raise ValueError(f"the array has the shape {given.shape}: give one number per block, ({least},)")
    return given[ids]
