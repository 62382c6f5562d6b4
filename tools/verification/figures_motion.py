"""Figures of the rows in which something slides, swings, falls or spins."""
import numpy as np

from verification import drawing as draw


def _slide(records, row, where, model, floor):
    """Model, distance slid, and its relative error over time."""
    drawing, (left, middle, right) = draw.panels(1.25, 1.0, 1.0)
    draw.blocks(left, records.model(row, model))
    ways = [(which, way) for which, way in records.series_of(row, where).items() if "implicit" not in which]
    for index, pair in enumerate(sorted({which.split(",")[0] for which, _ in ways})):
        for which, way in ways:
            if not which.startswith(pair + ","):
                continue
            soft = "MPa" in which
            draw.exact_line(middle, way["time"], 1e3 * way["exact"])
            draw.marks(middle, way["time"], 1e3 * way["computed"], index, pair if soft else None, count=9 if soft else 11,
                       markersize=4.2 if soft else 2.2)
            good = way["exact"] > 1e-6
            error = way["computed"][good] / way["exact"][good] - 1.0
            draw.errors(right, way["time"][good], error, floor, color=draw.COLORS[index],
                        linestyle="-" if soft else (0, (2, 1.2)))
    draw.labels(middle, "time (s)", "distance slid (mm)")
    draw.labels(right, "time (s)", "relative error (-)")
    right.plot([], [], color="#444444", label="E 200 MPa")
    right.plot([], [], color="#444444", linestyle=(0, (2, 1.2)), label="E 20 GPa")
    draw.legend(middle, loc="upper left")
    draw.legend(right, loc="upper right" if row == 1 else "best")
    return draw.finish(drawing)


def ramp(records):
    return _slide(records, 1, r"/1[05],", "30/15, E 200 MPa", 1e-8)


def preloaded(records):
    return _slide(records, 2, r"/1[05],", "30/15, E 200 MPa", 1e-15)


def threshold(records):
    drawing, (left, right) = draw.panels(1, 1)
    slides = records.series_of(3, r"/\d+\.9,")
    for index, (which, way) in enumerate(slides.items()):
        draw.exact_line(left, way["time"], 1e3 * way["exact"])
        draw.marks(left, way["time"], 1e3 * way["computed"], index, which.split(",")[0])
    for index, (which, way) in enumerate(records.series_of(3, r"/\d+\.1,").items()):
        draw.exact_line(right, way["time"], 1e6 * way["exact"])
        draw.marks(right, way["time"], 1e6 * way["computed"], index, which.split(",")[0])
    right.set_ylim(0.0, None)
    draw.labels(left, "time (s)", "distance slid (mm)", "0.1° less friction than slope: slides")
    draw.labels(right, "time (s)", "offset of the corner (µm)", "0.1° more: holds")
    draw.legend(left, loc="upper left")
    draw.legend(right, loc="lower right", ncols=3)
    return draw.finish(drawing)


def cohesion(records):
    drawing, (left, right) = draw.panels(1, 1.3)
    draw.blocks(left, records.model(4, "0.99"))
    way = records.series_of(4, "^0.99, springs per contact")["0.99, springs per contact"]
    held = records.series_of(4, "^1.01, springs per contact")["1.01, springs per contact"]
    draw.exact_line(right, way["time"], 1e3 * way["exact"], "exact, from the break on")
    draw.marks(right, way["time"], 1e3 * way["computed"], 0, "0.99 of the critical cohesion")
    draw.marks(right, held["time"], 1e3 * held["computed"], 1, "1.01 of it", count=6)
    draw.labels(right, "time (s)", "distance slid (mm)")
    draw.legend(right, loc="upper left")
    return draw.finish(drawing)


def rocking(records):
    drawing, (left, right) = draw.panels(1, 1.6, height=2.8)
    draw.blocks(left, records.model(5, "matched"), window=(-1.0, 3.0, -1.0, 3.4), end=False)
    for index, (mass, tilt) in enumerate(records.series_of(5).items()):
        draw.exact_line(right, tilt["time"], np.degrees(tilt["exact"]))
        draw.marks(right, tilt["time"], np.degrees(tilt["computed"]), index, mass, count=12 + 3 * index,
                   markersize=4.2 + 2.0 * (mass == "matched"))
    right.set_ylim(bottom=0.0)
    draw.labels(right, "time (s)", "tilt (degrees)")
    draw.legend(right, loc="lower left")
    return draw.finish(drawing)


def spin(records):
    drawing, (left, right) = draw.panels(1.3, 1)
    area = records.series_of(6)["area"]
    draw.exact_line(left, 1e3 * area["time"], 1e4 * area["exact"])
    draw.marks(left, 1e3 * area["time"], 1e4 * area["computed"], 0, "computed", count=60)
    mean = records.checks_of(6)[0]
    left.axhline(1e4 * mean.exact, label="exact mean", **draw.BOUND)
    turning = records.series_of(6)["angular momentum"]
    draw.errors(right, *draw.highest(turning["turns"], np.abs(turning["error"])), color=draw.COLORS[0])
    draw.bound(right, records.checks_of(6)[1].high)
    left.set_ylim(top=1.32 * 2e4 * mean.exact)
    draw.labels(left, "time (ms)", "growth (1e-4 of it)", "area")
    draw.labels(right, "turns", "change over its value (-)", "angular momentum")
    draw.legend(left, loc="upper center", ncols=3, columnspacing=1.0)
    draw.legend(right, loc="center right")
    return draw.finish(drawing)


def frequencies(records):
    modes = records.series_of(7)
    drawing, axes = draw.panels(*[1] * len(modes), height=2.3)
    for axis, (mode, strain) in zip(axes, modes.items()):
        draw.exact_line(axis, 1e3 * strain["time"], strain["exact"])
        draw.marks(axis, 1e3 * strain["time"], strain["computed"], 0, "computed", count=40)
        axis.set_ylim(-1.15, 1.75)
        axis.set_yticks((-1, 0, 1))
        draw.labels(axis, "time (ms)", "", mode)
        draw.legend(axis, loc="upper center", ncols=2, columnspacing=1.0)
    axes[0].set_ylabel("strain over its amplitude (-)")
    return draw.finish(drawing)


def bounce(records):
    drawing, (left, right) = draw.panels(1.2, 1)
    path = records.series_of(8, "^step 0.4 of")["step 0.4 of the critical one"]
    draw.exact_line(left, 1e3 * path["time"], -1e3 * path["exact"])
    draw.marks(left, 1e3 * path["time"], -1e3 * path["computed"], 0, "computed", count=70)
    left.axhline(0.0, color="#666666", linewidth=0.6)
    left.set_ylim(top=0.22)
    for index, (which, books) in enumerate(records.series_of(8, "ledger").items()):
        draw.errors(right, books["time"], books["drift"], 1e-16, color=draw.COLORS[index], label=which.split()[2])
    draw.bound(right, next(c.high for c in records.checks_of(8) if "energy" in c.what))
    right.set_ylim(1e-16, 1e1)
    draw.labels(left, "time (ms)", "height of the lower edge (mm)")
    draw.labels(right, "time (s)", "energy balance error (-)")
    draw.legend(left, loc="upper right", ncols=2)
    draw.legend(right, loc="upper center", ncols=3, title="step over the critical one", title_fontsize=8,
                columnspacing=1.0)
    return draw.finish(drawing)


def pulse(records):
    drawing, (left, right) = draw.panels(1, 1)
    for index, (which, pulses) in enumerate(records.series_of(10).items()):
        clear = pulses["block"] <= 180  # where the hump has not met its mirror image yet
        draw.exact_line(left, pulses["block"][clear], 1e3 * pulses["exact time"][clear])
        draw.marks(left, pulses["block"][clear], 1e3 * pulses["time"][clear], index, which)
        if index == 1:
            draw.exact_line(right, pulses["block"], 1e3 * pulses["exact speed"])
            draw.marks(right, pulses["block"], 1e3 * pulses["speed"], index, which, count=36)
    right.set_ylim(bottom=0.0)
    draw.labels(left, "block", "pulse passes after (ms)")
    draw.labels(right, "block (200: free end)", "largest speed (mm/s)")
    draw.legend(left, loc="upper left")
    draw.legend(right, loc="lower left")
    return draw.finish(drawing)


def corner(records):
    drawing, (left, middle, right) = draw.panels(0.9, 1.1, 1.1)
    draw.blocks(left, records.model(16, "right"))
    paths = records.series_of(16, "path")
    one, other = paths["path, right"], paths["path, left"]
    middle.plot(*draw.thinned(-1e3 * one["x"], 1e3 * one["y"]), label="mirror image of \"right\"", **draw.EXACT)
    draw.marks(middle, 1e3 * other["x"], 1e3 * other["y"], 0, "1 nm to the left", count=24)
    draw.marks(middle, 1e3 * one["x"], 1e3 * one["y"], 1, "1 nm to the right", count=24)
    jumps = records.series_of(16, "change of force, right")["change of force, right"]
    draw.marks(right, 1e3 * jumps["time"], jumps["computed"], 1, "computed", count=120, markersize=3)
    draw.bound(right, next(c.high for c in records.checks_of(16) if "force" in c.what))
    right.set_ylim(0.0, 2.0)
    draw.labels(middle, "centre: x (mm)", "centre: y (mm)")
    middle.set_ylim(top=75.0)
    draw.labels(right, "time (ms)", "change of force / p v h (-)")
    draw.legend(middle, loc="upper center")
    draw.legend(right, loc="upper right")
    return draw.finish(drawing)


def ten_pieces(records):
    drawing, (left, middle, right) = draw.panels(1.15, 1.0, 1.1)
    draw.blocks(left, records.model(17, "30/15, E 20 GPa"))
    ways = records.series_of(17, "^[0-9]+/1[05], E 20 GPa$")
    for index, (which, way) in enumerate(ways.items()):
        pair = which.split(",")[0]
        draw.exact_line(middle, way["time"], 1e3 * way["exact"])
        draw.marks(middle, way["time"], 1e3 * way["computed"], index, pair)
    sums = records.series_of(17, "normal forces")
    for index, which in enumerate(ways):
        press = sums[f"normal forces, {which}"]
        right.plot(*draw.highest(press["time"], press["computed"], 60), color=draw.COLORS[index], linewidth=1.0)
        damped = sums[f"normal forces, {which}, contact damping 0.02"]
        right.plot(*draw.highest(damped["time"], damped["computed"], 60), color=draw.COLORS[index], linewidth=1.0,
                   linestyle=(0, (2, 1.2)))
    right.plot([], [], color="#444444", label="as it is")
    right.plot([], [], color="#444444", linestyle=(0, (2, 1.2)), label="contact damping 0.02")
    draw.bound(right, next(c.high for c in records.checks_of(17) if "sum" in c.what))
    right.set_ylim(0.8, 3.1)
    draw.labels(middle, "time (s)", "distance slid (mm)")
    draw.labels(right, "time (s)", "sum of N over W cos a (-)")
    draw.legend(middle, loc="upper left")
    draw.legend(right, loc="upper right")
    return draw.finish(drawing)


def heap(records):
    drawing, (left, middle, right) = draw.panels(1.0, 1.0, 1.0)
    draw.blocks(left, records.model(19, ""))
    for index, (which, changes) in enumerate(records.series_of(19, "^heap").items()):
        draw.errors(middle, changes["time"], changes["linear"], color=draw.COLORS[index], label=which)
        draw.errors(middle, changes["time"], changes["angular"], color=draw.COLORS[index], linestyle=(0, (2, 1.2)))
    middle.plot([], [], color="#444444", label="linear")
    middle.plot([], [], color="#444444", linestyle=(0, (2, 1.2)), label="angular")
    apart = records.series_of(19, "^(turned|mirrored|renumbered)$")
    for index, (which, far) in enumerate(apart.items()):
        draw.errors(right, far["time"], far["computed"], color=draw.COLORS[index], label=which)
    for axis in (middle, right):
        draw.bound(axis, records.checks_of(19)[0].high)
        axis.set_ylim(1e-17, 1e-1)
    draw.legend(middle, loc="upper center", ncols=2, columnspacing=1.0)
    draw.legend(right, loc="upper right")
    draw.labels(middle, "time (s)", "change of momentum (-)")
    draw.labels(right, "time (s)", "largest distance apart (m)")
    return draw.finish(drawing)


def dissipation(records):
    cases = records.series_of(21)
    drawing, (left, middle, right) = draw.panels(0.7, 1.1, 1.1)
    draw.blocks(left, records.model(21, "friction alone"), window=(-2.0, 3.0, -1.2, 9.0))
    for index, (which, taken) in enumerate(cases.items()):
        middle.plot(*draw.thinned(taken["time"], 1e-3 * taken["friction"]), color=draw.COLORS[index], label=which)
        right.plot(*draw.thinned(taken["time"], 1e-3 * taken["damping"]), color=draw.COLORS[index], label=which)
    draw.labels(middle, "time (s)", "dissipated by friction (kJ)")
    draw.labels(right, "time (s)", "dissipated by damping (kJ)")
    middle.set_ylim(top=245.0)
    draw.legend(middle, loc="upper left")
    return draw.finish(drawing)
