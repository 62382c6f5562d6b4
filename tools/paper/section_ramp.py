"""Figs. 4 and 5 of the paper: a block slides down a ramp, four pairs of angles, three methods."""
import numpy as np

from paper import exact, figures, models
from paper.report import digits, percent, plain

PAIRS = ((30.0, 10.0), (30.0, 15.0), (45.0, 10.0), (45.0, 15.0))
STEP = 1e-4           # s, as in the paper
DURATION = 0.1        # s, as in the paper
ROWS = 100
FIRST = 0.01          # s: errors are averaged from here on
STIFFNESS = 10.0      # contact springs over young; the paper does not state it
METHODS = {
    "covering": models.PAPER,
    "matched": {"mass": "matched"},
    "dda": {"method": "dda"},
}
SLIGHTLY = 1.5        # up to this ratio of errors a method is "slightly" better
BOUND = 2e-2          # row 1 of docs/validation.md, at the end


def relative_error(run, angle, friction):
    """|s/s_exact - 1| over time, without the row at t = 0."""
    time = run.time[1:]
    return time, np.abs(models.slid(run, angle)[1:] / exact.sliding(angle, friction, models.RAMP_GRAVITY, time) - 1.0)


def mean_error(time, error):
    """Over the rows from FIRST on: before that the exact distance is next to nothing."""
    return float(error[time >= FIRST * (1 - 1e-9)].mean())


def verdict(ours, theirs):
    """Which of two errors is smaller, in words."""
    if ours < theirs:
        return "slightly better" if theirs <= SLIGHTLY * ours else "better"
    if ours > theirs:
        return "slightly worse" if ours <= SLIGHTLY * theirs else "worse"
    return "equal"


def write(report, program, settings):
    """The section, from its runs."""
    stiffness = STIFFNESS * models.RAMP_YOUNG
    jobs = [dict(name=f"ramp-{a:g}-{f:g}-{method}",
                 model=models.ramp(a, f, stiffness, DURATION, ROWS, time_step=STEP, **keys))
            for a, f in PAIRS for method, keys in METHODS.items()]
    runs = iter(program.run_all(jobs))
    found = {(pair, method): relative_error(next(runs), *pair) for pair in PAIRS for method in METHODS}
    steps = [program.check("ramp", models.ramp(*PAIRS[0], stiffness, DURATION, ROWS, **METHODS[m]))["critical_step"]
             for m in ("covering", "matched")]

    report.heading("The ramp: Figs. 4 and 5")
    report.text(
        f"A block of 2 m x 1 m, initially without motion, slides down a ramp for {DURATION} s. The step is",
        f"{plain(STEP)} s, as in the paper. Material and gravity are the paper's. The paper does not state the stiffness of",
        f"the contact springs. Here it is {STIFFNESS:g} times Young's modulus, {digits(stiffness)} N/m per contact. The critical step is then",
        f"{digits(steps[1], 3)} s ({digits(steps[0], 3)} s as printed), so the paper's step is",
        ("allowed as it is." if STEP < min(steps) else "above it."),
        "The ramp itself is fixed: the paper puts it on springs and does not state its size, and its own settlement is",
        "not part of the sliding. \"As printed\" is the paper's method: the covering triangle, contacts of vertices on edges",
        "(`contact.model = \"points\"`), no contact activation (`solver.switching = \"plain\"`) and no damping. \"Faces,",
        "matched\" is the default of this program; DDA has its faces, too.")
    _draw(report, found)
    _table(report, found)


def _draw(report, found):
    drawing, axes = figures.panels(2, 2, height=2.3, sharex=True, sharey=True)
    for axis, pair in zip(axes.flat, PAIRS):
        for method in METHODS:
            time, error = found[pair, method]
            figures.line(axis, method, time, np.maximum(error, 1e-6))
        axis.set_yscale("log")
        axis.set_title(f"slope {pair[0]:g}°, friction {pair[1]:g}°")
    for axis in axes[1]:
        axis.set_xlabel("time (s)")
    for axis in axes[:, 0]:
        axis.set_ylabel("relative error of s (-)")
    figures.legend_below(drawing, axes[0, 0], 3)
    report.figure("ramp", drawing,
                  "Relative error of the sliding distance, |s/s_exact - 1|. The paper's Figs. 4 and 5.")


def _table(report, found):
    rows, wins = [], {(m, w): [] for m in ("covering", "matched") for w in ("end", "mean")}
    for pair in PAIRS:
        end = {m: float(found[pair, m][1][-1]) for m in METHODS}
        mean = {m: mean_error(*found[pair, m]) for m in METHODS}
        report.expect(end["matched"] < BOUND, f"ramp {pair}: error of {end['matched']:.3g} at the end")
        for method, where in wins:
            errors = end if where == "end" else mean
            wins[method, where].append(verdict(errors[method], errors["dda"]))
        rows.append([f"{pair[0]:g}°, {pair[1]:g}°"] + [percent(end[m], 3) for m in METHODS]
                    + [percent(mean[m], 3) for m in METHODS]
                    + [f"{wins[m, 'end'][-1]}, {wins[m, 'mean'][-1]}" for m in ("covering", "matched")])
    report.table(["slope, friction", "end: as printed", "end: faces, matched", "end: DDA", "mean: as printed",
                  "mean: faces, matched", "mean: DDA", "as printed against DDA: end, mean", "faces, matched against DDA"], rows)
    report.text(
        f"The errors are those at {DURATION} s, and means over the rows from {FIRST} s on.",
        f"\"Slightly\" means by a factor of at most {SLIGHTLY:g}. The paper states that its method is slightly better than",
        "traditional DDA. Pair by pair, with the paper's method as printed:")
    report.points(_pair(pair, found, wins, k) for k, pair in enumerate(PAIRS))
    report.text(_common(found))
    counts = {w: sum(v.endswith("better") for v in wins["covering", w]) for w in ("end", "mean")}
    ours = sum(v.endswith("better") for v in wins["matched", "end"])
    report.verdict(
        f"Ramp: the paper's method as printed is more accurate than DDA for {counts['end']} of {len(PAIRS)} pairs of"
        f" angles at the end and for {counts['mean']} in the mean; this program's faces and matched mass are for {ours} at the end.")


def _pair(pair, found, wins, k):
    """One pair of angles in a sentence."""
    end, mean = wins["covering", "end"][k], wins["covering", "mean"][k]
    errors = {m: percent(float(found[pair, m][1][-1]), 3) for m in METHODS}
    better = [v.endswith("better") for v in (end, mean)]
    if end == mean == "slightly better":
        held = "It holds."
    elif all(better):
        held = "It is better, and by more than slightly."
    else:
        held = "It holds in part." if any(better) else "It does not hold."
    return (f"({pair[0]:g}°, {pair[1]:g}°): {held} At the end it is {end} ({errors['covering']} against {errors['dda']}), in the"
            f" mean {mean}.")


def _common(found):
    """How much of the error all methods share: the block starts unstressed and settles on its springs."""
    spread = max(max(float(found[pair, m][1][-1]) for m in METHODS) - min(float(found[pair, m][1][-1]) for m in METHODS)
                 for pair in PAIRS)
    largest = max(float(found[pair, m][1][-1]) for pair in PAIRS for m in METHODS)
    return ("Most of the error at the end is common to all methods. The block starts without stress, drops on its springs and"
            " oscillates, and its contacts slide under oscillating normal forces. At the end the methods differ by at most"
            f" {percent(spread)} of the distance, and the largest error is {percent(largest)}."
            if spread < 0.5 * largest else
            "The block starts without stress, drops on its springs and oscillates, and its contacts slide under oscillating"
            f" normal forces. At the end the methods differ by up to {percent(spread)} of the distance; the largest error"
            f" is {percent(largest)}.")
