"""Cost: seconds and bytes to reach the same time at the same accuracy, against the number of blocks."""
import math

from paper import accuracy, figures, models
from paper.accuracy import TARGET, power_law
from paper.report import bytes_of, digits, listed, percent, plain, times

TARGET_POWER = 1.1
SMALL = 900         # blocks below which one period is over too soon to be timed:
SMALL_PERIODS = 4   # then so many are
NOTICED = 1.05      # a ratio of times below this is none


def write(report, program, settings):
    """The section, from its runs."""
    found = accuracy.measure(program, settings)
    step_of, law = accuracy.implicit_steps(found)
    report.heading("Cost")
    _problem(report, settings)
    _accuracy(report, found, law)
    timed, starts = _time(program, settings, step_of), _time_starts(program, settings)
    _whole_periods(report, timed, settings)
    _starts(report, starts, timed, settings)
    _draw(report, timed, starts, settings)
    _slivers(report, program, settings, step_of)


def _problem(report, settings):
    rock = models.ROCK
    report.text(
        f"A square of rock is cut by two joint sets {rock['spacing']:g} m apart, inclined by",
        f"{digits(math.degrees(models.TILT), 3)}°, stands on rollers at its base and between rollers at its sides, and",
        f"gravity acts at once. Young's modulus is {digits(rock['young'] / 1e9)} GPa, contact springs are",
        f"{digits(0.5 * rock['joint'] * rock['spacing'] / rock['young'])} times that, friction is {rock['friction']:g}°, no",
        "cohesion, no damping. The outline is parallel to the joints, so that all blocks are equal: only the number of",
        "blocks grows with the size. Joints that cut the outline at random leave slivers, whose cost is given below.",
        "One period is the time that a wave takes to cross the square four times,",
        f"{digits(1e3 * models.period(10), 3)} ms for 100 blocks.")


def _accuracy(report, found, law):
    report.heading("The same accuracy", 3)
    report.text(
        f"The error of a run is the root mean square of the difference of seven monitors' displacements over a period from",
        "those of an explicit run with a small step, over the root mean square of the displacements. Explicit steps are",
        "the largest that the program takes with `time_step = \"auto\"`; the table has their errors. For the implicit method several steps were",
        f"tried; the table has the one at which the error is {percent(TARGET)}, by interpolation. All have this program's faces;",
        "\"covering\" has of the paper's method the lumping on a covering triangle, without contact activation.")
    rows = []
    for f in found:
        rows.append([f"{f.blocks:,}", digits(f.explicit_step), percent(f.errors["matched"]), percent(f.errors["consistent"]),
                     percent(f.errors["covering"]), percent(f.fine_error), digits(f.step) if f.step else "-",
                     digits(f.step / f.explicit_step) if f.step else "-"])
        report.expect(f.errors["matched"] < TARGET, f"cost: {f.blocks} blocks, explicit error {f.errors['matched']:.3g}")
        report.expect(f.step is not None, f"cost: {f.blocks} blocks, no implicit step reaches {TARGET}")
    report.table(["blocks", "explicit step (s)", "error, matched", "consistent", "covering",
                  "covering, fine step", f"implicit step for {percent(TARGET)} (s)", "over the explicit one"], rows)
    better = all(f.fine_error < 0.5 * f.errors["covering"] for f in found)
    report.text(
        "The explicit step is limited by stability, and is well below the step that accuracy needs: its error is between",
        f"{percent(min(f.errors['matched'] for f in found))} and {percent(max(f.errors['matched'] for f in found))}.",
        "The covering triangle " + ("converges to the same motion." if better else
                                  "converges to another motion: a finer step leaves an error of "
                                  f"{percent(min(f.fine_error for f in found))} to {percent(max(f.fine_error for f in found))}."
                                  " It is left out below."),
        "The implicit method has numerical damping, which increases with the step; this damping is its error. Its step for",
        f"{percent(TARGET)} grows with the number of blocks to the power {digits(law[1])}, because the motion of a larger",
        "square is slower. Beyond the sizes of the table the steps below follow that law, in favour of the implicit method.")


def _time(program, settings, step_of):
    """Timed runs over whole periods: method -> side -> Results."""
    runs = {"matched": {}, "dda": {}}
    for side in settings.period_sides:
        periods = 1 if side * side >= SMALL else SMALL_PERIODS
        square, duration = models.Square(side), periods * models.period(side)
        for method, keys in (("matched", {}), ("dda", {"method": "dda", "time_step": step_of(side)})):
            rows = max(1, min(10, round(duration / step_of(side))))
            runs[method][side] = program.run(f"cost-{side}-{method}", square.model(duration, rows, **keys), timed=True)
    return runs


def _time_starts(program, settings):
    """Timed runs over the start of the motion, explicit methods: method -> side -> Results."""
    runs = {"matched": {}, "consistent": {}}
    for side in settings.start_sides:
        square, duration = models.Square(side), settings.start * models.period(side)
        for method in runs:
            if method == "matched" or side <= settings.consistent_up_to:
                runs[method][side] = program.run(f"start-{side}-{method}", square.model(duration, 1, mass=method), timed=True)
    return runs


def _law(runs, value, settings):
    """(a, b) of value(run) = a blocks^b over the large squares."""
    large = [r for side, r in runs.items() if side * side >= 0.9 * settings.large]
    return power_law([r.blocks for r in large], [value(r) for r in large])


def _per_second(run):
    return run.per_second


def _whole_periods(report, timed, settings):
    report.heading("Seconds and bytes", 3)
    rows = []
    for side, run in timed["matched"].items():
        dda = timed["dda"][side]
        rows.append([f"{run.blocks:,}", digits(run.per_second), digits(dda.per_second), digits(dda.per_second / run.per_second),
                     bytes_of(run.peak), bytes_of(dda.peak), digits(run.summary["open_close"]["mean"]),
                     digits(dda.summary["open_close"]["mean"]), dda.summary["step_cuts"]])
    report.table(["blocks", "EDDA (s/s)", "DDA (s/s)", "DDA over EDDA", "EDDA, peak", "DDA, peak",
                  "EDDA: passes per step in which a contact opens or closes", "DDA: iterations per step", "DDA: cuts"], rows)
    power = {m: _law(runs, _per_second, settings)[1] for m, runs in timed.items()}
    memory = {m: _law(runs, lambda r: r.peak, settings)[1] for m, runs in timed.items()}
    report.text(
        f"The table has wall seconds of stepping per simulated second, over a whole period ({SMALL_PERIODS} periods below",
        f"{SMALL} blocks), and the largest memory of the process. \"Passes\" are those of the contact activation, \"iterations\"",
        "those of the open-close iteration. From",
        f"{settings.large:,} blocks on, seconds grow with the number of blocks to the power {digits(power['matched'], 3)} (EDDA) and",
        f"{digits(power['dda'], 3)} (DDA), bytes with the power {digits(memory['matched'], 3)} and {digits(memory['dda'], 3)}.",
        _crossing(timed))
    report.verdict("Cost at the same accuracy, over a period: " + _crossing(timed)[0].lower() + _crossing(timed)[1:])


def _starts(report, starts, timed, settings):
    rows = []
    for side, run in starts["matched"].items():
        consistent, whole = starts["consistent"].get(side), timed["matched"].get(side)
        rows.append([f"{run.blocks:,}", digits(run.per_second), digits(consistent.per_second) if consistent else "-",
                     bytes_of(run.peak), digits(run.summary["open_close"]["switched"] / (run.steps * run.blocks)),
                     digits(whole.per_second / run.per_second) if whole else "-"])
    report.text(
        f"For larger squares only the first 1/{round(1 / settings.start)} of a period is timed, the same part of the same motion at",
        "every size. It is an expensive part: most of the rock still falls freely, and its joints are just about closed.")
    report.table(["blocks", "EDDA, matched (s/s)", "consistent (s/s)", "peak", "contacts that open or close, per block and step",
                  "whole period over start"], rows)
    power = {m: _law(runs, _per_second, settings)[1] for m, runs in starts.items()}
    first, *_, last = [r.blocks for r in starts["matched"].values()]
    met = power["matched"] <= TARGET_POWER
    report.text(
        f"From {first:,} to {last:,} blocks the explicit method's seconds per simulated second grow with the number of blocks to",
        f"the power {digits(power['matched'], 3)}; the aim of at most {TARGET_POWER} is",
        "met." if met else "not met.", f"The consistent mass has {digits(power['consistent'], 3)}.", _consistent(starts))
    report.verdict(
        f"Cost: from {first:,} to {last:,} blocks the explicit method's seconds per simulated second grow with the power"
        f" {digits(power['matched'], 3)} of the blocks ({'within' if met else 'beyond'} the {TARGET_POWER} asked for).")


def _consistent(starts):
    """What lumping saves against Mikola and Sitar's block masses."""
    ratios = [run.per_second / starts["matched"][side].per_second for side, run in starts["consistent"].items()]
    mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
    text = f"It takes {digits(mean, 3)} times as long as the lumped mass"
    if mean > NOTICED:
        return text + ": the saving that the paper claims is small."
    return text + ": the saving that the paper claims is not measurable, because a 3 x 3 matrix per block is inverted only once."


def _crossing(timed):
    """Which method is cheaper where."""
    ratios = [(run.blocks, timed["dda"][side].per_second / run.per_second) for side, run in timed["matched"].items()]
    for (n0, r0), (n1, r1) in zip(ratios, ratios[1:]):
        if (r0 - 1.0) * (r1 - 1.0) < 0.0:
            part = -math.log(r0) / (math.log(r1) - math.log(r0))
            cross = math.exp(math.log(n0) + part * (math.log(n1) - math.log(n0)))
            return f"Below about {digits(cross)} blocks the {'im' if r0 < 1.0 else 'ex'}plicit method is cheaper, above it the other."
    low, high = min(r for _, r in ratios), max(r for _, r in ratios)
    text = "There is no crossing: the "
    if low > 1.0:
        text += f"explicit method is cheaper at every size, by a factor of {digits(low)} to {digits(high)}"
    else:
        text += f"implicit method is cheaper at every size, by a factor of {digits(1 / high)} to {digits(1 / low)}"
    change = ratios[-1][1] / ratios[0][1] if low > 1.0 else ratios[0][1] / ratios[-1][1]
    return text + (", and the gap widens." if change > 1.2 else ", and the gap narrows." if change < 1 / 1.2 else ".")


def _dots(axis, method, found, value):
    points = [(run.blocks, value(run)) for run in found.values()]
    figures.line(axis, method, [x for x, _ in points], [y for _, y in points], marker="o", markersize=3.5)


def _draw(report, timed, starts, settings):
    drawing, axes = figures.panels(1, 3, height=3.0)
    for axis, title, runs in ((axes[0, 0], "a whole period", timed), (axes[0, 1], "its start", starts)):
        for k, (method, found) in enumerate(runs.items()):
            power = digits(_law(found, _per_second, settings)[1], 3)
            _dots(axis, method, found, _per_second)
            axis.text(0.98, 0.03 + 0.08 * k, f"power {power}", color=figures.METHODS[method]["color"], ha="right",
                      fontsize=8, transform=axis.transAxes)
        axis.set_title(title)
    axes[0, 1].sharey(axes[0, 0])
    axes[0, 0].set_ylabel("wall seconds per simulated second")
    for method, found in (("matched", {**timed["matched"], **starts["matched"]}), ("dda", timed["dda"])):
        _dots(axes[0, 2], method, found, lambda r: r.peak / 1e6)
    axes[0, 2].set_title("memory")
    axes[0, 2].set_ylabel("peak (MB)")
    for axis in axes[0]:
        figures.logarithmic(axis)
        axis.set_xlabel("blocks")
    _dots(axes[0, 1], "dda", {}, _per_second)
    figures.legend_below(drawing, axes[0, 1], 3)
    report.figure("cost", drawing, "Cost against the number of blocks, with the powers of the number of blocks from "
                                   f"{settings.large:,} on.")


def _slivers(report, program, settings, step_of):
    report.heading("What slivers cost", 3)
    side = settings.sliver_side
    regular = models.Square(side, tilted=False, spacing=5.0 / math.sqrt(26.0))
    duration = models.period(side)
    step = step_of(side)
    equal = models.Square(side)
    found = {}
    for name, square in (("equal", equal), ("slivers", regular)):
        for method, keys in (("matched", {}), ("dda", {"method": "dda", "time_step": step})):
            found[name, method] = program.run(f"slivers-{name}-{method}", square.model(duration, 5, **keys), timed=True)
    sizes = [s for s in settings.period_sides if s <= 100]
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
        "block is the same at every size. With a random cut it is not, and neither is the critical step:",
        f"{listed(digits(c['critical_step']) + ' s' for c in random_steps)} for {listed(format(c['blocks'], ',') for c in random_steps)}",
        f"blocks of an upright square with joints {plain(models.ROCK['spacing'])} m apart.",
        f"The smallest of these is {times(found['equal', 'matched'].summary['critical_time_step'] / least)} smaller than that of equal",
        "blocks, which is the cost of slivers for the explicit method where they are not merged.")
    report.verdict(
        f"Slivers: along the outline of an upright square they make the cost of a block {times(explicit)} as large with the explicit"
        f" method, {times(implicit)} with the implicit one.")
