"""Fig. 8 of the paper: displacements of three points of a cavern, explicit against implicit."""
import re

import numpy as np

from paper import figures, models, results
from paper.report import digits, listed, percent, plain, times

PAPER_STEP = 1e-7         # s
PAPER_RATIO = 5e-6        # of the half-height in one step
ROWS = 100
AGREE = 0.02              # of the largest displacement
SOFT_SIDES = 190e9        # Pa
FINE_ENOUGH = 0.01        # difference from the fine result that a step may make
MONITORS = ("P1", "P2", "P3")


def _sets(duration, rows, **keys):
    sets = {"duration": duration, **keys}
    return [f"solver.{key}={value}" for key, value in sets.items()] + [
        f"output.every={duration!r}", f"output.history_every={duration / rows!r}"]


def write(report, program, settings):
    """The section, from its runs."""
    model, duration = models.cavern(), settings.cavern_duration
    fine = _sets(duration, ROWS, time_step=PAPER_STEP, max_displacement_ratio=PAPER_RATIO)
    edda, dda = program.run_all([dict(name="cavern-edda", model=model, sets=fine),
                                 dict(name="cavern-dda", model=model, sets=fine + ["solver.method=dda"])])
    difference = results.largest_difference(dda, edda)
    report.expect(difference < AGREE, f"cavern: the methods differ by {difference:.3g} at the paper's step")

    report.heading("The cavern: Fig. 8")
    speed = max(np.hypot(edda.history[m + ".vx"], edda.history[m + ".vy"]).max() for m in MONITORS)
    report.text(
        f"The cavern of `examples/cavern.toml`: {edda.blocks} blocks, with the paper's material, springs and friction on a",
        "geometry of our own, since the paper states none. Gravity acts at once on rock without stress. First both methods",
        f"run as in the paper: {duration:g} s, step {plain(PAPER_STEP)} s, no displacement beyond {plain(PAPER_RATIO)}",
        f"of the half-height in a step. That last bound is never reached: no monitor moves faster than {digits(speed)} m/s,"
        f" {digits(speed * PAPER_STEP)} m in a step.")
    _draw(report, edda, dda)
    _table(report, edda, dda, difference, duration)
    _as_printed(report, program, model, fine, edda)
    _own_steps(report, program, settings, model, edda)


def _magnitude(run, monitor):
    return np.linalg.norm(run.monitor(monitor), axis=1)


def _draw(report, edda, dda):
    drawing, axes = figures.panels(2, 3, height=2.1, sharex=True, sharey="row")
    largest = max(_magnitude(edda, m).max() for m in MONITORS)
    for column, monitor in enumerate(MONITORS):
        top, bottom = axes[0, column], axes[1, column]
        figures.line(top, "matched", 1e3 * edda.time, 1e3 * _magnitude(edda, monitor))
        figures.line(top, "dda", 1e3 * dda.time, 1e3 * _magnitude(dda, monitor))
        apart = np.linalg.norm(dda.monitor(monitor) - edda.monitor(monitor), axis=1)
        bottom.plot(1e3 * edda.time, 100.0 * apart / largest, color="#555555")
        top.set_title(monitor)
        bottom.set_xlabel("time (ms)")
    axes[0, 0].set_ylabel("displacement (mm)")
    axes[1, 0].set_ylabel("difference (%\nof the largest)")
    figures.legend_below(drawing, axes[0, 0], 2)
    report.figure("cavern", drawing,
                  f"Displacement of three points of the cavern, and the difference between the two methods; step {plain(PAPER_STEP)} s. "
                  "The paper's Fig. 8.")


def _table(report, edda, dda, difference, duration):
    largest = max(_magnitude(edda, m).max() for m in MONITORS)
    rows = []
    for m in MONITORS:
        apart = np.linalg.norm(dda.monitor(m) - edda.monitor(m), axis=1)
        rows.append([m, digits(1e3 * _magnitude(edda, m)[-1], 5), digits(1e3 * _magnitude(dda, m)[-1], 5),
                     percent(apart.max() / largest)])
    report.table(["point", f"EDDA at {duration:g} s (mm)", "DDA (mm)", "largest difference"], rows)
    report.text(
        f"The largest difference at any time is {percent(difference)} of the largest displacement.",
        f"The paper's \"agree well\" {'holds' if difference < AGREE else 'does not hold'} here, to "
        f"{percent(AGREE)}. Part of this agreement is trivial: undisturbed rock falls freely until a wave arrives. At the end",
        f"{listed(_from_free_fall(edda, m) for m in MONITORS)} away from free fall.")
    report.verdict(f"Cavern: EDDA and DDA agree to {percent(difference)} of the largest displacement.")


def _as_printed(report, program, model, fine, edda):
    """The paper's method, contacts and all, against this program's."""
    printed = program.run("cavern-printed", model, fine + ['contact.model="points"', "solver.mass=covering",
                                                           "materials.rock.damping=0"], may_fail=True)
    if printed is None:
        report.text("The paper's method as printed, with contacts of vertices on edges (`contact.model = \"points\"`), gives nothing here.")
        return
    until = printed.time[-1]
    difference = results.largest_difference(printed, edda)
    report.text(
        "Both have this program's faces. The paper's method as printed, with the covering triangle, contacts of vertices on",
        f"edges (`contact.model = \"points\"`), no contact activation and no damping, differs from EDDA by up to {percent(difference)}",
        f"of the largest displacement; at {digits(until)} s {listed(_apart(printed, edda, m) for m in MONITORS)}.",
        "" if printed.completed else "At that time the program ends the run, because contacts that open and close have created"
        f" {percent(printed.summary['energy']['drift'])} of all energy.")


def _apart(run, other, monitor):
    """How far a point has gone at the end of the one run, and by then in the other."""
    then = np.interp(run.time[-1], other.time, _magnitude(other, monitor))
    return f"{monitor} has moved {digits(1e3 * _magnitude(run, monitor)[-1], 4)} mm against {digits(1e3 * then, 4)} mm"


def _from_free_fall(run, monitor):
    """How far a point is from where free fall would have taken it."""
    fall = np.array([0.0, -0.5 * models.CAVERN_GRAVITY * run.time[-1] ** 2])
    return f"{monitor} is {percent(np.linalg.norm(run.monitor(monitor)[-1] - fall) / abs(fall[1]))}"


def _own_steps(report, program, settings, model, reference):
    duration = settings.cavern_duration
    tries = [s for s in settings.cavern_tries if s <= duration / 2]
    jobs = [dict(name="cavern-try", model=model,
                 sets=_sets(duration, max(1, round(duration / max(s, duration / ROWS))), time_step=s, method="dda"))
            for s in tries]
    rows, best = [], None
    for step, run in zip(tries, program.run_all(jobs)):
        error = results.largest_difference(run, reference)
        rows.append([f"DDA, {plain(step)} s asked", digits(run.mean_step), run.summary["step_cuts"],
                     digits(run.summary["open_close"]["mean"]), percent(error), "-"])
        if error <= FINE_ENOUGH and (best is None or run.mean_step > best[1]):
            best = (step, run.mean_step)
    explicit = program.run("cavern-auto", model, _sets(duration, ROWS), timed=True)
    error = results.largest_difference(explicit, reference)
    rows.append(["EDDA, auto", digits(explicit.mean_step), explicit.summary["step_cuts"],
                 digits(explicit.summary["open_close"]["mean"]), percent(error), digits(explicit.stepping)])
    soft = program.run("cavern-soft", model, _sets(duration, ROWS) + [f"boundary.sides.stiffness={SOFT_SIDES}"], timed=True)
    rows.append(["EDDA, auto, softer sides", digits(soft.mean_step), soft.summary["step_cuts"],
                 digits(soft.summary["open_close"]["mean"]), percent(results.largest_difference(soft, reference)),
                 digits(soft.stepping)])
    report.text(
        f"The next table has each method at its own best step, for the same {duration:g} s. Differences are from EDDA at",
        f"{plain(PAPER_STEP)} s. The best step of DDA is the longest with a difference of at most {percent(FINE_ENOUGH)}. A cut is",
        "a step that is made again with half its length;",
        f"\"softer sides\" has springs of {digits(SOFT_SIDES / 1e9)} GPa at the sides, as at the contacts, in place of 1,000 E.",
        "\"Rounds\" are those of the open-close iteration for DDA and the passes of the contact activation for EDDA.")
    if best:
        sets = _sets(duration, max(1, round(duration / max(best[0], duration / ROWS))), time_step=best[0], method="dda")
        implicit = program.run("cavern-best", model, sets, timed=True)
        rows.append([f"DDA, {plain(best[0])} s, timed", digits(implicit.mean_step), implicit.summary["step_cuts"],
                     digits(implicit.summary["open_close"]["mean"]),
                     percent(results.largest_difference(implicit, reference)), digits(implicit.stepping)])
    report.table(["run", "mean step (s)", "cuts", "iterations per step", "difference", "wall seconds"], rows)
    report.expect(error < AGREE, f"cavern: EDDA at its own step differs by {error:.3g}")
    report.expect(best is not None, "cavern: no implicit step reaches the fine result")
    if best:
        as_given, softer = _faster(explicit, implicit), _faster(soft, implicit)
        report.text(
            f"At its own best step {as_given} faster here. The explicit step is governed by",
            f"{_governed_by(explicit)}. The springs at the sides are the paper's, 1,000 E; with the softer ones {softer} faster.")
        report.verdict(f"Cavern, each method at its own best step: {as_given} faster.")


def _faster(explicit, implicit):
    """Which method is how many times faster."""
    ratio = explicit.stepping / implicit.stepping
    return f"DDA is {times(ratio)}" if ratio > 1.0 else f"EDDA is {times(1.0 / ratio)}"


def _governed_by(run):
    """What governs the critical step: the contacts (7 %) and so on."""
    shares = re.search(r": (\d+ % .*?)(;|$)", run.summary["governed_by"])
    if not shares:
        return run.summary["governed_by"]
    parts = (part.split(" % ", 1) for part in shares.group(1).split(", "))
    return listed(f"the {what.replace('its own elasticity', 'elasticity of the block')} ({part} %)" for part, what in parts)
