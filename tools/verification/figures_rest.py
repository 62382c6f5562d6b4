"""Figures of the rows in which something stands, settles or gives way."""
import numpy as np

from verification import drawing as draw


def column(records):
    drawing, (left, right) = draw.panels(1, 2, height=3.0)
    draw.blocks(left, records.model(9, "explicit"), start=False)
    for index, (which, stress) in enumerate(sorted(records.series_of(9).items())):
        draw.exact_line(right, stress["depth"], 1e-3 * stress["exact"])
        draw.marks(right, stress["depth"], 1e-3 * stress["computed"], index, which, markersize=3.0 + 2.0 * index)
    draw.labels(right, "depth of the block's middle (m)", "vertical stress (kPa)")
    draw.legend(right, loc="upper right")
    return draw.finish(drawing)


def critical_step(records):
    drawing, (axis,) = draw.panels(1)
    formula, steps = records.series_of(11)["formula"], records.series_of(11)["critical step"]
    axis.fill_between(formula["kappa"], 0.7 * formula["exact"], formula["exact"], color="#dddddd", label="allowed")
    draw.exact_line(axis, formula["kappa"], formula["exact"])
    draw.marks(axis, steps["kappa"], steps["computed"], 0, "the program's bound", markersize=5)
    axis.set_xscale("log")
    axis.set_yscale("log")
    draw.labels(axis, "kappa = K L/(E A) (-)", "critical step (s)")
    draw.legend(axis, loc="lower left")
    return draw.finish(drawing)


def snap_through(records):
    drawing, (left, right) = draw.panels(1, 1.2)
    draw.blocks(left, records.model(12, ""), window=(-0.6, 4.6, -1.2, 1.4), end=False)
    path = records.series_of(12)["load and sag"]
    balance = records.series_of(12)["balance"]
    draw.exact_line(right, 1e3 * balance["sag"], 1e-3 * balance["exact"], "exact")
    right.axhline(1e-3 * records.checks_of(12)[0].exact, label="exact peak", **draw.BOUND)
    draw.marks(right, 1e3 * path["sag"], 1e-3 * path["computed"], 0, "computed", count=60)
    right.set_xlim(0.0, 150.0)
    right.set_ylim(0.0, 1.3e-3 * records.checks_of(12)[0].exact)
    draw.labels(right, "sag at midspan (mm)", "weight of the beam (kN)")
    draw.legend(right, loc="lower center")
    return draw.finish(drawing)


def _sinking(axis, series, limit):
    for index, (which, sinking) in enumerate(series.items()):
        draw.curve(axis, sinking["time"], np.maximum(sinking["computed"], 1e-8), index, which)
    for value in limit:
        draw.bound(axis, value)
    axis.set_yscale("log")


def arch(records):
    drawing, (left, middle, right) = draw.panels(1, 1, 1.15, height=2.6)
    for axis, which in ((left, "t/R = 0.1085"), (middle, "t/R = 0.107")):
        draw.blocks(axis, records.model(13, which), window=(-7.0, 7.0, -1.3, 6.5))
        axis.set_title(which)
    series = {which: columns for which, columns in sorted(records.series_of(13).items())}
    _sinking(right, series, [c.low if np.isinf(c.high) else c.high for c in records.checks_of(13)])
    right.set_ylim(1e-11, 1e3)
    draw.labels(right, "time (s)", "largest sinking (m)")
    draw.legend(right, loc="lower right")
    return draw.finish(drawing)


def dam(records):
    drawing, (left, right) = draw.panels(1, 1.3)
    draw.blocks(left, records.models_of(14)[0])
    for crest in records.series_of(14).values():
        draw.marks(right, crest["h"], np.maximum(crest["crest"], 1e-9), 0, "computed", count=40)
    right.axvline(records.checks_of(14)[0].exact, label="exact limit", **draw.EXACT)
    right.set_yscale("log")
    draw.labels(right, "depth of water (m)", "displacement of the crest (m)")
    draw.legend(right, loc="upper left")
    return draw.finish(drawing)


def overhang(records):
    drawing, (left, middle, right) = draw.panels(1, 1, 1.15, height=2.4)
    for axis, which in ((left, "0.99 of the limit"), (middle, "1.01 of the limit")):
        draw.blocks(axis, records.model(15, which), window=(-1.2, 1.5, -0.8, 1.2))
        axis.set_title(which)
    _sinking(right, records.series_of(15), [c.low if np.isinf(c.high) else c.high for c in records.checks_of(15)])
    right.set_ylim(1e-9, 1e5)
    draw.labels(right, "time (s)", "top brick sinks by (m)")
    draw.legend(right, loc="upper left")
    return draw.finish(drawing)


def wall(records):
    drawing, (left, middle, right) = draw.panels(1.15, 1.0, 1.0, height=2.6)
    draw.blocks(left, records.models_of(18)[0], start=False)
    series = records.series_of(18)
    longest = {}
    for which, books in series.items():
        longest.setdefault(which.split(",")[0], []).append(books)
    for index, (which, runs) in enumerate(sorted(longest.items())):
        books = max(runs, key=lambda columns: columns["time"][-1])
        middle.semilogy(*draw.highest(books["time"], np.maximum(books["kinetic"], 1e-18), 160), linewidth=1.0,
                        color=draw.COLORS[index], label=which)
        right.semilogy(*draw.highest(books["time"], np.maximum(books["drift"], 1e-17), 160), linewidth=1.0,
                       color=draw.COLORS[index], label=which)
    for check in records.checks_of(18):
        if "energy balance" in check.what:
            draw.bound(right, check.high, "bounds")
        if check.unit == "J":
            draw.bound(middle, check.high, "bound, settled")
    middle.set_ylim(1e-18, 1e7)
    right.set_ylim(1e-18, 1e0)
    draw.labels(middle, "time (s)", "kinetic energy (J)")
    draw.labels(right, "time (s)", "energy balance error (-)")
    draw.legend(middle, loc="upper right")
    draw.legend(right, loc="upper right")
    return draw.finish(drawing)


def box(records):
    drawing, (left, right) = draw.panels(1, 1.4, height=2.8)
    draw.blocks(left, records.model(20, ""), start=False)
    stress = records.series_of(20)["stress"]
    first = stress["time"] < 0.05
    for index, which in enumerate(("xx", "yy")):
        draw.exact_line(right, 1e3 * stress["time"][first], 1e-6 * stress[f"exact {which}"][first])
        draw.marks(right, 1e3 * stress["time"][first], 1e-6 * stress[which][first], index, f"stress {which}, one block",
                   count=60)
    draw.labels(right, "time (ms)", "stress (MPa)")
    draw.legend(right, loc="upper right")
    return draw.finish(drawing)


def opening(records):
    drawing, (left, right) = draw.panels(1, 1)
    which, stress = min(records.series_of(38).items())  # the smallest blocks
    for axis, along, title in ((left, "x", "along x"), (right, "y", "vertical")):
        for index, (part, name) in enumerate((("rr", "radial"), ("tt", "hoop"))):
            draw.exact_line(axis, stress["r"], 1e-6 * stress[f"{part} {along} exact"], "exact" if index == 0 else None)
            draw.marks(axis, stress["r"], 1e-6 * stress[f"{part} {along}"], index, f"{name}, {which}")
        axis.set_title(title)
        draw.labels(axis, "distance from the centre (radii)", "stress (MPa)")
    draw.legend(left, loc="best")
    return draw.finish(drawing)
