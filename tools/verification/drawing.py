"""What all figures of the page share: the model at its start and end, exact lines under computed markers."""
import numpy as np
from matplotlib.collections import PolyCollection

from paper import figures

COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = ("o", "s", "^", "D", "v", "P")
EXACT = {"color": "#000000", "linewidth": 1.1, "zorder": 2}
BOUND = {"color": "#888888", "linewidth": 1.1, "linestyle": (0, (4, 2)), "zorder": 1}
MOST_POINTS = 240  # of a curve


def panels(*widths, height=2.6):
    """Axes side by side, of these relative widths."""
    drawing, axes = figures.panels(1, len(widths), height=height, gridspec_kw={"width_ratios": widths})
    return drawing, list(axes[0])


def blocks(axis, model, window=None, start=True, end=True, unit=True):
    """Held blocks grey, the others as they end, and dashed as they began. window: x0, x1, y0, y1."""
    held = [ring for ring, fixed in zip(model["start"], model["fixed"]) if fixed]
    free = [ring for ring, fixed in zip(model["start"], model["fixed"]) if not fixed]
    ends = [ring for ring, fixed in zip(model["end"], model["fixed"]) if not fixed]
    axis.add_collection(PolyCollection(held, facecolor="#d9d9d9", edgecolor="#666666", linewidth=0.6))
    if end:
        axis.add_collection(PolyCollection(ends, facecolor="#bcd9ea", edgecolor="#0072B2", linewidth=0.6))
    if start:
        axis.add_collection(PolyCollection(free, facecolor="none", edgecolor="#000000", linewidth=0.6,
                                           linestyle=(0, (3, 2)) if end else "-"))
    _frame(axis, held + free * start + ends * end, window)
    axis.grid(False)
    if unit:
        axis.set_xlabel("x (m)")
        axis.set_ylabel("y (m)")


def _frame(axis, rings, window):
    if window is None:
        points = np.array([point for ring in rings for point in ring])
        (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
        edge = 0.04 * max(x1 - x0, y1 - y0)
        window = (x0 - edge, x1 + edge, y0 - edge, y1 + edge)
    axis.set_aspect("equal", adjustable="box")
    axis.set_xlim(window[:2])
    axis.set_ylim(window[2:])


def thinned(*columns, most=MOST_POINTS):
    """Every so many rows of the columns, the last one included."""
    count = len(columns[0])
    if count <= most:
        return columns
    keep = np.unique(np.linspace(0, count - 1, most).round().astype(int))
    return tuple(column[keep] for column in columns)


def highest(x, y, bins=MOST_POINTS):
    """The largest y of every stretch of x: a cloud's upper edge."""
    if len(x) <= bins:
        return x, y
    parts = np.array_split(np.arange(len(x)), bins)
    tops = [part[np.argmax(y[part])] for part in parts]
    return x[tops], y[tops]


def exact_line(axis, x, y, label="exact"):
    axis.plot(*thinned(x, y), label=label, **EXACT)


def marks(axis, x, y, index=0, label=None, count=14, **keys):
    """Computed values: markers without a line, `count` of them at most."""
    x, y = thinned(x, y, most=count)
    axis.plot(x, y, **{"linestyle": "none", "marker": MARKERS[index], "markersize": 4.2, "color": COLORS[index],
                       "markerfacecolor": "none", "markeredgewidth": 1.1, "label": label, "zorder": 3, **keys})


def curve(axis, x, y, index=0, label=None, **keys):
    """A computed curve that has no exact one to be laid on."""
    x, y = thinned(x, y)
    axis.plot(x, y, **{"color": COLORS[index], "linewidth": 1.2, "label": label, "zorder": 3, **keys})


def bound(axis, value, label="bound"):
    axis.axhline(value, label=label, **BOUND)


def errors(axis, x, error, floor=1e-16, **keys):
    """The size of an error on a scale of powers of ten."""
    x, error = thinned(x, np.maximum(np.abs(error), floor))
    axis.semilogy(x, error, **{"linewidth": 1.0, **keys})


def labels(axis, x, y, title=None):
    axis.set_xlabel(x)
    axis.set_ylabel(y)
    if title:
        axis.set_title(title)


def legend(axis, **keys):
    """Each label once."""
    handles, names = axis.get_legend_handles_labels()
    first = dict(zip(reversed(names), reversed(handles)))
    ordered = [name for name in dict.fromkeys(names)]
    axis.legend([first[name] for name in ordered], ordered, **{"handlelength": 1.8, "borderaxespad": 0.2, **keys})


def finish(drawing):
    drawing.tight_layout(w_pad=1.2)
    return drawing
