"""One look for all figures, and files that come out the same for the same numbers."""
import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot, ticker  # noqa: E402

# One colour and one line for each method, throughout; the colours are told apart by the colour-blind, too.
METHODS = {
    "exact": {"color": "#000000", "linestyle": (0, (1, 1.5)), "label": "exact"},
    "matched": {"color": "#0072B2", "linestyle": "-", "linewidth": 2.6, "alpha": 0.6, "zorder": 2,
                "label": "EDDA, matched"},
    "covering": {"color": "#D55E00", "linestyle": (0, (5, 1.5)), "label": "EDDA, as printed"},
    "dda": {"color": "#009E73", "linestyle": (0, (4, 1.5, 1, 1.5)), "label": "DDA, implicit"},
    "consistent": {"color": "#CC79A7", "linestyle": (0, (2, 1)), "label": "EDDA, consistent"},
}
STEP_LINES = ({"color": "#56B4E9", "linestyle": "-", "linewidth": 3.2},
              {"color": "#E69F00", "linestyle": (0, (5, 1.5)), "linewidth": 1.8},
              {"color": "#000000", "linestyle": (0, (1, 1.5)), "linewidth": 1.4})

STYLE = {
    "svg.hashsalt": "edda", "svg.fonttype": "none", "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "sans-serif"], "font.size": 9, "axes.titlesize": 9, "axes.linewidth": 0.8,
    "axes.grid": True, "grid.color": "#dddddd", "grid.linewidth": 0.6, "legend.frameon": False,
    "legend.fontsize": 8, "lines.linewidth": 1.4,
    "axes.spines.top": False, "axes.spines.right": False,
}


def panels(rows, columns, width=7.2, height=2.7, **keys):
    """A figure with its axes, [rows, columns]."""
    pyplot.rcParams.update(STYLE)
    return pyplot.subplots(rows, columns, figsize=(width, height * rows), squeeze=False, **keys)


def line(axes, method, x, y, **keys):
    """A curve in the look of its method."""
    axes.plot(x, y, **{**METHODS[method], **keys})


def logarithmic(axes):
    """Both axes, with numbers at the powers of ten alone."""
    for axis, scale in ((axes.xaxis, axes.set_xscale), (axes.yaxis, axes.set_yscale)):
        scale("log")
        axis.set_minor_formatter(ticker.NullFormatter())


def legend_below(figure, axes, columns):
    """One legend for all panels, under them, where it covers nothing."""
    handles, labels = axes.get_legend_handles_labels()
    lines = -(-len(labels) // columns)
    figure.tight_layout(rect=(0, (0.06 + 0.2 * lines) / figure.get_figheight(), 1, 1))
    figure.legend(handles, labels, loc="lower center", ncols=columns, borderaxespad=0.2)


def save(figure, file):
    """As SVG, without date."""
    figure.savefig(file, metadata={"Date": None, "Creator": None})
    pyplot.close(figure)
