"""Fig. 6 of the paper: three steps, and what the contact stiffness, which it does not print, changes."""
import numpy as np

from paper import exact, figures, models
from paper.report import digits, listed, percent, plain
from paper.section_ramp import DURATION, FIRST, METHODS, ROWS, mean_error, relative_error

ANGLE, FRICTION = 30.0, 15.0
STEPS = (1e-5, 1e-4, 1e-3)
STIFFNESSES = (1.0, 10.0, 100.0)   # over young
STIFF_SPRINGS = 10.0               # over young, where the rock itself is stiffer
SAME = 1.1                         # errors within this ratio are the same


def write(report, program, settings):
    """The section, from its runs."""
    jobs, notes = [], {}
    for factor in STIFFNESSES:
        default = models.ramp(ANGLE, FRICTION, factor * models.RAMP_YOUNG, DURATION, ROWS)
        notes[factor] = program.check("steps", default)["critical_step"]
        for step in STEPS:
            for method in ("matched", "covering"):
                model = models.ramp(ANGLE, FRICTION, factor * models.RAMP_YOUNG, DURATION, ROWS, time_step=step,
                                    allow_unstable=True, **METHODS[method])
                jobs.append(dict(name=f"steps-{factor:g}-{step:g}-{method}", model=model, may_fail=True))
    runs = iter(program.run_all(jobs))
    found = {(factor, step, method): next(runs)
             for factor in STIFFNESSES for step in STEPS for method in ("matched", "covering")}

    report.heading("Steps: Fig. 6")
    report.text(
        f"The pair ({ANGLE:g}°, {FRICTION:g}°) with steps of {listed(plain(s) for s in STEPS)} s. The contact stiffness",
        "decides which of them are stable, and the paper does not print it, so here are three. Steps above the",
        "critical one are refused by the program; for this figure they were run all the same",
        "(`solver.allow_unstable = true`), to show what happens.")
    _draw(report, found)
    _table(report, found, notes)
    stiff = program.run("steps-stiff", models.ramp(ANGLE, FRICTION, STIFF_SPRINGS * 100 * models.RAMP_YOUNG, DURATION, ROWS,
                                                   time_step=STEPS[0]), [f"materials.rock.young={100 * models.RAMP_YOUNG}"])
    _sentences(report, found, notes, float(relative_error(stiff, ANGLE, FRICTION)[1][-1]))


def _draw(report, found):
    drawing, axes = figures.panels(1, 3, height=2.7, sharey=True)
    for axis, factor in zip(axes[0], STIFFNESSES):
        for step, look in zip(STEPS, figures.STEP_LINES):
            run = found[factor, step, "matched"]
            time, error = relative_error(run, ANGLE, FRICTION)
            keep = np.isfinite(error) & (error < 10.0)
            axis.plot(time[keep], np.maximum(error[keep], 1e-5), label=f"step {plain(step)} s", **look)
        axis.set_yscale("log")
        axis.set_title(f"contact springs of {factor:g} E")
        axis.set_xlabel("time (s)")
    axes[0, 0].set_ylabel("relative error of s (-)")
    figures.legend_below(drawing, axes[0, 0], 3)
    report.figure("steps", drawing, "Relative error of the sliding distance for three steps and three contact "
                                    "stiffnesses, matched mass. The paper's Fig. 6.")


def _table(report, found, notes):
    rows = []
    for factor in STIFFNESSES:
        for step in STEPS:
            cells = [f"{factor:g} E", digits(notes[factor], 3), plain(step)]
            for method in ("matched", "covering"):
                run = found[factor, step, method]
                time, error = relative_error(run, ANGLE, FRICTION)
                cells += [percent(float(error[-1]), 3), percent(mean_error(time, error), 3)] if run.completed else \
                    [f"diverged at {digits(run.summary['time'])} s", "-"]
            rows.append(cells)
    report.table(["contact springs", "critical step, matched (s)", "step (s)", "matched: end", "matched: mean",
                  "as printed: end", "as printed: mean"], rows)


def _sentences(report, found, notes, stiff):
    sentences, falls = [], 0
    for factor in STIFFNESSES:
        stable = [s for s in STEPS if s <= notes[factor]]
        lost = [s for s in STEPS if not found[factor, s, "matched"].completed]
        means = [mean_error(*relative_error(found[factor, s, "matched"], ANGLE, FRICTION)) for s in stable]
        text = f"With {factor:g} E the error, in the mean from {FIRST} s on, "
        if len(stable) < 2:
            text += f"is {percent(means[0])} at the one stable step."
        elif max(means) <= SAME * min(means):
            text += f"is the same at all {len(stable)} stable steps, to within {percent(max(means) / min(means) - 1)} of itself."
        elif all(a < b for a, b in zip(means, means[1:])):
            falls += 1
            text += f"falls with the step, from {percent(means[-1])} to {percent(means[0])}."
        else:
            text += f"does not fall steadily with the step: {listed(percent(m) for m in means)} from small to large."
        for step in STEPS:
            if step in lost:
                text += f" The step of {plain(step)} s diverges."
            elif step not in stable:
                error = mean_error(*relative_error(found[factor, step, "matched"], ANGLE, FRICTION))
                text += f" The step of {plain(step)} s is above the critical one; it got through, with {percent(error)}."
        sentences.append(text)
    report.text("The paper reports that the error falls with the step.", *sentences)
    report.verdict(
        f"Steps: that a smaller step makes the sliding more exact shows for {falls} of {len(STIFFNESSES)} contact stiffnesses;"
        " what is left is the unstressed start.")
    late = [s / DURATION for s in STEPS]
    report.text(
        "What does make an error that is proportional to the step is the start. A leapfrog whose first velocity at the",
        "half step is v_0 + a_0 h, and not v_0 + a_0 h/2, has slid too far by the part h/t at time t: at",
        f"{DURATION} s that is {listed(percent(p) for p in late)} for the three steps. This program starts half a step",
        "back. What is left at the smallest step is no error of the step: it is",
        f"{listed(_smallest(found, f) for f in STIFFNESSES)}, and {percent(stiff)} with a rock a hundred times as stiff (and",
        f"springs of {STIFF_SPRINGS:g} times that), because the block starts unstressed and the softer it is, the longer it",
        "rings.")
    report.expect(stiff < min(_end(found, f) for f in STIFFNESSES[1:]), "steps: a stiffer rock does not slide more exactly")
    report.expect(all(found[f, STEPS[0], "matched"].completed for f in STIFFNESSES), "steps: the smallest step diverged")


def _end(found, factor):
    return float(relative_error(found[factor, STEPS[0], "matched"], ANGLE, FRICTION)[1][-1])


def _smallest(found, factor):
    return f"{percent(_end(found, factor))} at {factor:g} E"
