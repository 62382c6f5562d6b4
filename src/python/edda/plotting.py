"""Pictures with Matplotlib, which is imported when one is asked for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import UnknownName
from ._fields import KINDS, fixed_blocks, is_of_motion, label_of, values_of
from .results import Frame, Results

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._edda import Cut, Simulation

_HELD = (0.8, 0.8, 0.8)
_places_of_bars: WeakKeyDictionary[Axes, Axes] = WeakKeyDictionary()  # of axes that hold blocks


def plot_blocks(
    source: Simulation | Results | Frame | Cut,
    field: ArrayLike | None = None,
    ax: Axes | None = None,
    *,
    whole_range: bool = False,
    **options: Any,
) -> Axes:
    """Draws the blocks with their outlines, coloured by a field.

    source: a Simulation as it stands, a Frame, Results (their last frame) or a Cut.
    field: a name as of `edda plot`, or an array (nb,) with a number per block. Of a Simulation or a frame
    "displacement" (m) and "velocity" (m/s), which are sizes, or their ".x" and ".y"; "stress" (Pa),
    the mean in the plane, or its ".xx", ".yy", ".zz", ".xy"; "principal_stress.major" (most tensile), ".minor"
    (most compressive, also without a component) and ".out_of_plane"; "rotation" (rad), "omega" (rad/s),
    "overstress"; "id", "material", "fixed". Of a Simulation also "area" (m2) and "mass" (kg), of a Cut "area",
    "id", "material" and "fixed".
    whole_range: the colours reach as far as the values, even where few blocks come near; else a few that lie
    far beyond have the colour of the bar's end, which is then a point. Held blocks do not count: by name they are
    grey (as in edda plot), by an array, and of a Cut, they have the colour of the nearest end.
    options go to Matplotlib's PathCollection; clim or norm among them says what the colours are.
    ax: the axes to draw in. Axes that are drawn in again (after ax.clear(), for a film) keep their one colour bar.
    """
    import matplotlib.pyplot as plt
    from matplotlib.collections import PathCollection

    if isinstance(source, Results):
        source = source.frames[-1]
    paths, ids = _outlines(source)
    values = None if field is None else values_of(source, field, ids)
    if ax is None:
        ax = plt.subplots()[1]
    style: dict[str, Any] = {"edgecolors": "black", "linewidths": 0.4, "facecolors": "0.85"}
    if field is not None:
        del style["facecolors"]
    drawn = PathCollection(paths, **{**style, **options})
    if field is not None and values is not None:
        extend = _set_colours(drawn, source, field, values, ids, whole_range, {"clim", "norm"} & set(options))
        _add_colorbar(ax, drawn, extend, label_of(field))
    ax.add_collection(drawn)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_xlabel("x (m)")
    ax.set_ylabel("y (m)")
    return ax


def plot_history(
    results: Results, columns: str | Sequence[str], ax: Axes | Sequence[Axes] | None = None, **options: Any
) -> Axes:
    """Draws columns of history.csv over time (s), one or several, named with their units.

    Columns of one unit share an axes; where there are several units each has one of its own, below each other in the
    order in which they are first named. ax: the axes to draw in, one for each unit. options go to Axes.plot().
    Returns the first axes; all of them are in its figure.axes.
    """
    import matplotlib.pyplot as plt

    history = results.history
    panels: dict[str, list[str]] = {}
    for column in [columns] if isinstance(columns, str) else columns:
        if column not in (history.dtype.names or ()):
            raise UnknownName("column of history.csv", column, history.dtype.names or ())
        label, unit = _kind_of(column)
        panels.setdefault(unit or label, []).append(column)
    if not panels:
        raise ValueError("no column is named: give one or more")
    if ax is None:
        width, height = plt.rcParams["figure.figsize"]
        several = {"figsize": (width, 0.6 * height * len(panels)), "layout": "constrained"} if len(panels) > 1 else {}
        axes = list(plt.subplots(len(panels), sharex=True, squeeze=False, **several)[1][:, 0])
    else:
        axes = list(np.ravel(np.asarray(ax, dtype=object)))
    if len(axes) != len(panels):
        units = ", ".join(panels)
        raise ValueError(f"{len(axes)} axes for columns in {units}: give {len(panels)}, one for each, or none")
    for one, named in zip(axes, panels.values()):
        for column in named:
            one.plot(history["time"], history[column], **{"label": column, **options})
        one.set_ylabel(_history_label(named))
        one.legend()
    axes[-1].set_xlabel("time (s)")
    return axes[0]


_ENERGIES = (
    "kinetic",
    "strain",
    "contact",
    "gravity",
    "friction",
    "damping",
    "fracture",
    "external",
    "step_change",
    "transfer",
)
_ENDINGS = {
    "ux": ("displacement", "m"),
    "uy": ("displacement", "m"),
    "vx": ("velocity", "m/s"),
    "vy": ("velocity", "m/s"),
    "ax": ("acceleration", "m/s2"),
    "ay": ("acceleration", "m/s2"),
    "sxx": ("stress", "Pa"),
    "syy": ("stress", "Pa"),
    "sxy": ("stress", "Pa"),
    "convergence": ("convergence", "m"),
}


def _kind_of(column: str) -> tuple[str, str]:
    """What a column of history.csv holds, and its unit."""
    if column in _ENERGIES:
        return "energy", "J"
    own = {"time": ("time", "s"), "drift": ("energy balance error", ""), "unbalanced": ("unbalanced force ratio", "")}
    name, _, ending = column.rpartition(".")
    return own.get(column) or (name and _ENDINGS.get(ending)) or (column, "")


def _history_label(columns: Sequence[str]) -> str:
    """"displacement (m)"; of one column its name."""
    kinds = [_kind_of(column) for column in columns]
    names = ", ".join(dict.fromkeys(label for label, _ in kinds)) if len(columns) > 1 else columns[0]
    return f"{names} ({kinds[0][1]})" if kinds[0][1] else names


def _outlines(source: Any) -> tuple[list[Any], NDArray[np.int64]]:
    """A closed path per block, and the number of each."""
    from matplotlib.path import Path

    def path_of(rings: Sequence[NDArray[np.float64]]) -> Path:
        return Path.make_compound_path(*(Path(np.vstack([r, r[:1]]), closed=True) for r in rings))

    if isinstance(source, Frame):
        if "id" not in source:
            raise ValueError("this frame holds no blocks: give one of Results.frames")
        return [path_of(rings) for rings in source.rings()], np.asarray(source["id"], dtype=np.int64)
    if hasattr(source, "polygons"):
        alive = np.flatnonzero(source.alive)
        polygons = source.polygons()
        return [path_of(polygons[i]) for i in alive], alive
    return [path_of(block.rings) for block in source.blocks], np.arange(len(source.blocks))


def _add_colorbar(ax: Axes, drawn: Any, extend: str, label: str) -> None:
    """In the place of the one that an earlier picture in these axes has left there."""
    place = _places_of_bars.get(ax)
    if place is None or place.figure is not ax.figure or place not in ax.figure.axes:
        _places_of_bars[ax] = ax.figure.colorbar(drawn, ax=ax, extend=extend, label=label).ax
    else:
        place.clear()
        ax.figure.colorbar(drawn, cax=place, extend=extend, label=label)


def _set_colours(
    drawn: Any,
    source: Any,
    field: ArrayLike,
    values: NDArray[np.float64],
    ids: NDArray[np.int64],
    whole_range: bool,
    is_given: set[str],
) -> str:
    """Colours the paths; where values lie beyond the colours, in the words of a colorbar."""
    is_fixed = fixed_blocks(source, ids)
    if is_of_motion(source, field) and is_fixed.any():
        values = np.where(is_fixed, np.nan, values)
        if drawn.get_cmap().get_bad()[3] == 0.0:
            drawn.set_cmap(drawn.get_cmap().with_extremes(bad=_HELD))
    drawn.set_array(values)
    shown = values[np.isfinite(values)]
    if is_given:
        return "neither"
    if isinstance(field, str) and field in KINDS or whole_range:
        low, high = (shown.min(), shown.max()) if len(shown) else (0.0, 1.0)
    else:
        low, high = _drawn_range(values, np.where(is_fixed, 0.0, _areas(drawn.get_paths())), shown)
    drawn.set_clim(low, high)
    below, above = bool(np.any(shown < low)), bool(np.any(shown > high))
    return "both" if below and above else "min" if below else "max" if above else "neither"


def _areas(paths: Sequence[Any]) -> NDArray[np.float64]:
    return np.array([abs(sum(_area(ring) for ring in path.to_polygons(closed_only=False))) for path in paths])


def _area(ring: NDArray[np.float64]) -> float:
    x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def _drawn_range(
    values: NDArray[np.float64], weights: NDArray[np.float64], shown: NDArray[np.float64]
) -> tuple[float, float]:
    """From where to where the colours go: where nearly all values do that weigh something.

    The rule of the program's pictures (src/report/drawn_range.cpp), from the values beyond which 1 % of the area lie.
    """
    counts = np.isfinite(values) & (weights > 0.0)
    if not counts.any():
        return (float(shown.min()), float(shown.max())) if len(shown) else (0.0, 1.0)
    order = np.argsort(values[counts])
    v, w = values[counts][order], weights[counts][order]
    rest = 0.01 * w.sum()
    inner_high = v[np.searchsorted(-(np.cumsum(w[::-1])[::-1] - w), -rest)]
    inner_low = v[len(v) - 1 - np.searchsorted(-(np.cumsum(w) - w)[::-1], -rest)]
    size = max(abs(inner_low), abs(inner_high))
    low, high = float(v[0]), float(v[-1])
    if size > 1e-6 * max(abs(low), abs(high)):
        low = float(inner_low - 0.5 * size) if low < inner_low - size else low
        high = float(inner_high + 0.5 * size) if high > inner_high + size else high
    if high - low <= 1e-9 * max(abs(low), abs(high)):  # rounding is no range to paint
        low, high = min(low, 0.0), max(high, 0.0)
    return low, high
