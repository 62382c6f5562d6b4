"""Cost: seconds and bytes to reach the same time at the same accuracy, against the number of blocks."""
import math

from paper import accuracy, figures, models
from paper.accuracy import TARGET, power_law
from paper.report import bytes_of, digits, listed, percent, plain, times

LARGE = 1000      # blocks from which slopes are fitted
TARGET_POWER = 1.1
SMALL_PERIODS = 4  # timed below LARGE blocks, where the start alone is over too soon to be timed


def write(report, program, settings):
    """The section, from its runs."""
    found = accuracy.measure(program, settings)
    step_of, law = accuracy.implicit_steps(found)
    report.heading("Cost")
    _problem(report, settings)
    _accuracy(report, found, law)
    timed = _time(program, settings, step_of)
    _scaling(report, timed, settings)
    _whole_period(report, timed, _time(program, settings, step_of, whole=True))
    _slivers(report, program, settings, step_of)


def _problem(report, settings):
    rock = models.ROCK
    report.text(
        f"A square of rock is cut by two joint sets {rock['spacing']:g} m apart, inclined by",
        f"{digits(math.degrees(models.TILT), 3)}°, stands on rollers at its base and between rollers at its sides, and",
        f"gravity acts at once. Young's modulus is {digits(rock['young'] / 1e9)} GPa, contact springs are",
        f"{digits(0.5 * rock['joint'] * rock['spacing'] / rock['young'])} times that, friction is {rock['friction']:g}°, no",
        "cohesion, no damping. The outline is parallel to the joints, so that all blocks are equal: what grows with the",
        "size is the number of blocks and nothing else. Joints that cut the outline at random leave slivers; what they",
        "cost comes further down. One period is the time a wave takes to cross the square four times,",
        f"{digits(1e3 * models.period(10), 3)} ms for 100 blocks.")


def _accuracy(report, found, law):
    report.heading("The same accuracy", 3)
    report.text(
        f"The error of a run is the root mean square of the difference of seven monitors' displacements over a period from",
        "those of an explicit run with a small step, over the root mean square of the displacements. Explicit steps are",
        "the largest the program allows by itself; the table has their errors. For the implicit method several steps were",
        f"tried; the one in the table is where the error is {percent(TARGET)}, interpolated.")
    rows = []
    for f in found:
        rows.append([f"{f.blocks:,}", digits(f.explicit_step), percent(f.errors["matched"]), percent(f.errors["consistent"]),
                     percent(f.errors["covering"]), percent(f.fine_error), digits(f.step) if f.step else "-",
                     digits(f.step / f.explicit_step) if f.step else "-"])
        report.expect(f.errors["matched"] < TARGET, f"cost: {f.blocks} blocks, explicit error {f.errors['matched']:.3g}")
        report.expect(f.step is not None, f"cost: {f.blocks} blocks, no implicit step reaches {TARGET}")
    report.table(["blocks", "explicit step (s)", "error, matched", "consistent", "paper's lumping",
                  "paper's lumping, fine step", f"implicit step for {percent(TARGET)} (s)", "over the explicit one"], rows)
    better = all(f.fine_error < TARGET for f in found)
    report.text(
        "The explicit step is bounded by stability, and well below what accuracy needs: its error is between",
        f"{percent(min(f.errors['matched'] for f in found))} and {percent(max(f.errors['matched'] for f in found))}.",
        "The paper's lumping " + ("converges to the same motion." if better else
                                  "converges to another motion: a finer step leaves an error of "
                                  f"{percent(min(f.fine_error for f in found))} to {percent(max(f.fine_error for f in found))}."
                                  " It is left out of what follows."),
        "The implicit method damps by itself, the more the larger the step; that damping is its error. Its step for",
        f"{percent(TARGET)} grows with the number of blocks to the power {digits(law[1])}, because the motion of a larger",
        "square is slower. Beyond the sizes of the table the steps below follow that law, in favour of the implicit method.")


def _is_large(side):
    return side * side >= 0.9 * LARGE


def _time(program, settings, step_of, whole=False):
    """Timed runs: method -> side -> Results. Over the start of the motion, or the whole period of some large squares."""
    runs = {"matched": {}, "consistent": {}, "dda": {}}
    sides = [s for s in settings.accuracy_sides if _is_large(s)] if whole else settings.square_sides
    for side in sides:
        periods = 1.0 if whole else settings.window if _is_large(side) else SMALL_PERIODS
        square, duration = models.Square(side), periods * models.period(side)
        for method, keys, most in (("matched", {}, math.inf),
                                   ("consistent", {"mass": "consistent"}, settings.consistent_up_to),
                                   ("dda", {"method": "dda", "time_step": step_of(side)}, settings.implicit_up_to)):
            if side > most or (whole and method == "consistent"):
                continue
            rows = max(1, min(10, round(duration / step_of(side))))
            runs[method][side] = program.run(f"cost-{side}-{method}", square.model(duration, rows, **keys), timed=True)
    return runs


def _slope(runs, value):
    """Power of blocks with which `value(run)` grows from LARGE blocks on; None where there are not two sizes."""
    large = [r for side, r in runs.items() if _is_large(side)]
    large = large if len(large) > 1 else list(runs.values())
    return power_law([r.blocks for r in large], [value(r) for r in large]) if len(large) > 1 else None


def _scaling(report, timed, settings):
    report.heading("Seconds and bytes", 3)
    rows = []
    for side, run in timed["matched"].items():
        consistent, dda = timed["consistent"].get(side), timed["dda"].get(side)
        rows.append([f"{run.blocks:,}", digits(run.per_second), digits(consistent.per_second) if consistent else "-",
                     digits(dda.per_second) if dda else "-", digits(dda.per_second / run.per_second) if dda else "-",
                     bytes_of(run.peak), bytes_of(dda.peak) if dda else "-",
                     digits(run.summary["open_close"]["mean"]), digits(dda.summary["open_close"]["mean"]) if dda else "-",
                     dda.summary["step_cuts"] if dda else "-"])
    _draw(report, timed)
    report.table(["blocks", "EDDA, matched (s/s)", "consistent (s/s)", "DDA (s/s)", "DDA over EDDA", "EDDA, peak", "DDA, peak",
                  "EDDA: passes per switching step", "DDA: rounds per step", "DDA: cuts"], rows)
    report.text(
        "Wall seconds of stepping per simulated second, and the largest memory of the process. Timed is the first",
        f"1/{round(1 / settings.window)} of a period, the same part of the same motion at every size, and below {LARGE:,} blocks",
        f"{SMALL_PERIODS} periods.")
    slope = {m: _slope(runs, lambda r: r.per_second)[1] for m, runs in timed.items()}
    memory = {m: _slope(timed[m], lambda r: r.peak)[1] for m in ("matched", "dda")}
    largest = max(r.blocks for r in timed["matched"].values())
    start = min(r.blocks for side, r in timed["matched"].items() if _is_large(side) or settings.quick)
    met = slope["matched"] <= TARGET_POWER
    report.text(
        f"From {start:,} to {largest:,} blocks the explicit method's seconds per simulated second grow with the number of",
        f"blocks to the power {digits(slope['matched'], 3)}; not more than {TARGET_POWER} was asked for, which is",
        "met." if met else "not met.",
        f"The consistent mass has {digits(slope['consistent'], 3)}, the implicit method {digits(slope['dda'], 3)}. Memory grows with",
        f"the power {digits(memory['matched'], 3)} (explicit) and {digits(memory['dda'], 3)} (implicit).",
        _consistent(timed), _crossing(timed))
    report.verdict(
        f"Cost: from {start:,} to {largest:,} blocks the explicit method's seconds per simulated second grow with the power"
        f" {digits(slope['matched'], 3)} of the blocks ({'within' if met else 'beyond'} the {TARGET_POWER} asked for).")
    report.verdict("Cost at the same accuracy: " + _crossing(timed)[0].lower() + _crossing(timed)[1:])


def _consistent(timed):
    """What lumping saves against Mikola and Sitar's block masses."""
    ratios = [timed["consistent"][s].per_second / timed["matched"][s].per_second for s in timed["consistent"]
              if timed["matched"][s].blocks >= 300] or [1.0]
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    text = f"The consistent mass takes {digits(mean, 3)} times as long as the lumped one"
    if mean > 1.05:
        return text + ": the paper's saving is real, if small."
    return text + ": the paper's saving does not show, because inverting a 3 x 3 matrix per block once is next to nothing."


def _crossing(timed):
    """Which method is cheaper where."""
    sizes = sorted(timed["dda"])
    ratios = [(timed["dda"][s].blocks, timed["dda"][s].per_second / timed["matched"][s].per_second) for s in sizes]
    for (n0, r0), (n1, r1) in zip(ratios, ratios[1:]):
        if (r0 - 1.0) * (r1 - 1.0) < 0.0:
            part = -math.log(r0) / (math.log(r1) - math.log(r0))
            cross = math.exp(math.log(n0) + part * (math.log(n1) - math.log(n0)))
            cheaper = "implicit" if r0 < 1.0 else "explicit"
            return f"Below about {digits(cross)} blocks the {cheaper} method is cheaper, above it the other."
    low, high = min(r for _, r in ratios), max(r for _, r in ratios)
    if low > 1.0:
        text = f"There is no crossing: the explicit method is cheaper at every size, by a factor of {digits(low)} to {digits(high)}"
    else:
        text = (f"There is no crossing: the implicit method is cheaper at every size, by a factor of {digits(1 / high)} to"
                f" {digits(1 / low)}")
    return text + (", and the gap widens." if ratios[-1][1] > ratios[0][1] * 1.2 else
                   ", and the gap narrows." if ratios[-1][1] * 1.2 < ratios[0][1] else ".")


def _draw(report, timed):
    drawing, axes = figures.panels(1, 2, height=3.1)
    left, right = axes[0]
    for method in ("dda", "consistent", "matched"):
        runs = list(timed[method].values())
        fit = _slope(timed[method], lambda r: r.per_second)
        label = figures.METHODS[method]["label"] + (f": power {digits(fit[1], 3)}" if fit else "")
        figures.line(left, method, [r.blocks for r in runs], [r.per_second for r in runs], marker="o", markersize=3.5,
                     label=label)
        if method != "consistent":
            figures.line(right, method, [r.blocks for r in runs], [r.peak / 1e6 for r in runs], marker="o", markersize=3.5)
    for axis, what in ((left, "wall seconds per simulated second"), (right, "peak memory (MB)")):
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_xlabel("blocks")
        axis.set_ylabel(what)
    figures.legend_below(drawing, left, 3)
    report.figure("cost", drawing, "Cost against the number of blocks. Powers are fitted from 1,000 blocks on.")


def _whole_period(report, timed, whole):
    rows = []
    if not whole["matched"]:
        return
    for side, run in whole["matched"].items():
        dda = whole["dda"].get(side)
        window = timed["matched"].get(side)
        rows.append([f"{run.blocks:,}", digits(run.per_second), digits(dda.per_second) if dda else "-",
                     digits(dda.per_second / run.per_second) if dda else "-",
                     digits(dda.summary["open_close"]["mean"]) if dda else "-", dda.summary["step_cuts"] if dda else "-",
                     digits(run.per_second / window.per_second) if window else "-"])
    report.text(
        "At the start most of the rock still falls freely and its joints are just about closed. Over a whole period, joints",
        "carry load most of the time:")
    report.table(["blocks", "EDDA, matched (s/s)", "DDA (s/s)", "DDA over EDDA", "DDA: rounds per step", "DDA: cuts",
                  "EDDA, over the timed part"], rows)


def _slivers(report, program, settings, step_of):
    report.heading("What slivers cost", 3)
    side = settings.sliver_side
    regular = models.Square(side, tilted=False, spacing=5.0 / math.sqrt(26.0))
    duration = 0.25 * models.period(side)
    step = step_of(side)
    equal = models.Square(side)
    found = {}
    for name, square in (("equal", equal), ("slivers", regular)):
        for method, keys in (("matched", {}), ("dda", {"method": "dda", "time_step": step})):
            found[name, method] = program.run(f"slivers-{name}-{method}", square.model(duration, 5, **keys), timed=True)
    sizes = [s for s in settings.square_sides if s <= 100]
    random_steps = [program.check("random", models.Square(s, tilted=False).model(duration, 5)) for s in sizes]
    least = min(c["critical_step"] for c in random_steps)
    per_block = {k: r.per_second / r.blocks for k, r in found.items()}
    explicit = per_block["slivers", "matched"] / per_block["equal", "matched"]
    implicit = per_block["slivers", "dda"] / per_block["equal", "dda"]
    ratio = found["slivers", "dda"].per_second / found["slivers", "matched"].per_second
    report.text(
        f"The same joints in an upright square of {side} m leave triangles along the outline. The explicit step falls from",
        f"{digits(found['equal', 'matched'].mean_step)} s to {digits(found['slivers', 'matched'].mean_step)} s, and a block costs",
        f"{times(explicit)} as much; with the implicit method at the same step as before ({digits(step)} s), {times(implicit)}.",
        f"On that square, {found['slivers', 'matched'].blocks:,} blocks, the {'explicit' if ratio > 1 else 'implicit'} method is",
        f"{times(max(ratio, 1 / ratio))} cheaper than the other. With a pattern that repeats along the sides, as there, the smallest",
        "block is the same at every size. Cut at random it is not, and the critical step with it:",
        f"{listed(digits(c['critical_step']) + ' s' for c in random_steps)} for {listed(format(c['blocks'], ',') for c in random_steps)}",
        f"blocks of an upright square with joints {plain(models.ROCK['spacing'])} m apart.",
        f"The least of these is {times(found['equal', 'matched'].summary['critical_time_step'] / least)} smaller than that of equal",
        "blocks, and that is what the explicit method pays where slivers are not merged.")
    report.verdict(
        f"Slivers: along the outline of an upright square they make a block {times(explicit)} as dear for the explicit method,"
        f" {times(implicit)} for the implicit one.")
