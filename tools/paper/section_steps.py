"""Fig. 6 of the paper: three steps, and the effect of the contact stiffness, which it does not state."""
import numpy as np

from paper import exact, figures, models
from paper.report import digits, listed, percent, plain, times
from paper.section_ramp import DURATION, FIRST, METHODS, ROWS, mean_error, relative_error

ANGLE, FRICTION = 30.0, 15.0
STEPS = (1e-5, 1e-4, 1e-3)
STIFFNESSES = (1.0, 10.0, 100.0)   # over young
STIFF_SPRINGS = 10.0               # over young, where the rock itself is stiffer
SAME = 1.1                         # errors within this ratio are the same
BOTH = ("matched", "covering")
NAMES = {"matched": "With faces and matched mass", "covering": "As printed"}


def write(report, program, settings):
    """The section, from its runs."""
    jobs, notes = [], {}
    for factor in STIFFNESSES:
        for method in BOTH:
            default = models.ramp(ANGLE, FRICTION, factor * models.RAMP_YOUNG, DURATION, ROWS, **METHODS[method])
            notes[factor, method] = program.check("steps", default)["critical_step"]
        for step in STEPS:
            for method in BOTH:
                model = models.ramp(ANGLE, FRICTION, factor * models.RAMP_YOUNG, DURATION, ROWS, time_step=step,
                                    allow_unstable=True, **METHODS[method])
                jobs.append(dict(name=f"steps-{factor:g}-{step:g}-{method}", model=model, may_fail=True))
    runs = iter(program.run_all(jobs))
    found = {(factor, step, method): next(runs)
             for factor in STIFFNESSES for step in STEPS for method in BOTH}

    report.heading("Steps: Fig. 6")
    report.text(
        f"The pair ({ANGLE:g}°, {FRICTION:g}°) with steps of {listed(plain(s) for s in STEPS)} s. The contact stiffness",
        "decides which of them are stable. The paper does not state it, so three values are used here. The program refuses",
        "steps above the critical one; for this figure they were run nevertheless",
        "(`solver.allow_unstable = true`), to show what happens.")
    _draw(report, found)
    _table(report, found, notes)
    stiff = program.run("steps-stiff", models.ramp(ANGLE, FRICTION, STIFF_SPRINGS * 100 * models.RAMP_YOUNG, DURATION, ROWS,
                                                   time_step=STEPS[0]), [f"materials.rock.young={100 * models.RAMP_YOUNG}"])
    _sentences(report, found, notes, float(relative_error(stiff, ANGLE, FRICTION)[1][-1]))


def _draw(report, found):
    drawing, axes = figures.panels(2, 3, height=2.3, sharex=True, sharey=True)
    for row, method in zip(axes, BOTH):
        for axis, factor in zip(row, STIFFNESSES):
            for step, look in zip(STEPS, figures.STEP_LINES):
                time, error = relative_error(found[factor, step, method], ANGLE, FRICTION)
                keep = np.isfinite(error) & (error < 10.0)
                axis.plot(time[keep], np.maximum(error[keep], 1e-5), label=f"step {plain(step)} s", **look)
            axis.set_yscale("log")
        row[0].set_ylabel(f"error of s (-)\n{'faces' if method == 'matched' else 'as printed'}")
    for axis, factor in zip(axes[0], STIFFNESSES):
        axis.set_title(f"contact springs of {factor:g} E")
    for axis in axes[1]:
        axis.set_xlabel("time (s)")
    figures.legend_below(drawing, axes[0, 0], 3)
    report.figure("steps", drawing, "Relative error of the sliding distance for three steps and three contact "
                                    "stiffnesses: faces and matched mass, and as printed. The paper's Fig. 6.")


def _table(report, found, notes):
    rows = []
    for factor in STIFFNESSES:
        for step in STEPS:
            cells = [f"{factor:g} E", plain(step)]
            for method in BOTH:
                run = found[factor, step, method]
                time, error = relative_error(run, ANGLE, FRICTION)
                cells.append(digits(notes[factor, method], 3))
                cells += [percent(float(error[-1]), 3), percent(mean_error(time, error), 3)] if run.completed else \
                    [f"diverged at {digits(run.summary['time'])} s", "-"]
            rows.append(cells)
    report.table(["contact springs", "step (s)", "faces, matched: critical step (s)", "end", "mean",
                  "as printed: critical step (s)", "end", "mean"], rows)


def _sentences(report, found, notes, stiff):
    report.text("The paper reports that the error decreases with the step. The errors in this list are means from",
                f"{FIRST} s on.")
    report.points(f"{NAMES[method]}. " + " ".join(_sentence(found, notes, factor, method) for factor in STIFFNESSES)
                  for method in BOTH)
    end = {method: [_growth(_ends(found, notes, factor, method)) for factor in STIFFNESSES] for method in BOTH}
    mean = {method: [_growth(_means(found, notes, factor, method)) for factor in STIFFNESSES] for method in BOTH}
    text = (f"Over the stable steps, as printed, the error at the end falls with the step by {_fall(end['covering'])}, in the mean by"
            f" {_fall(mean['covering'])}; with faces and matched mass by {_fall(end['matched'])} and {_fall(mean['matched'])}.")
    report.text(text)
    report.verdict("Steps: " + text[0].lower() + text[1:])
    late = [s / DURATION for s in STEPS]
    report.text(
        "An error that is proportional to the step comes from the start. A leapfrog whose first velocity at the",
        "half step is v_0 + a_0 h, and not v_0 + a_0 h/2, has slid too far by the part h/t at time t: at",
        f"{DURATION} s this is {listed(percent(p) for p in late)} for the three steps. This program starts half a step",
        "back. The error that remains at the smallest step does not come from the step: it is",
        f"{listed(_smallest(found, f) for f in STIFFNESSES)}, and {percent(stiff)} with a rock a hundred times as stiff (and",
        f"springs of {STIFF_SPRINGS:g} times that), because the block starts without stress, and a softer block",
        "oscillates for longer.")
    report.expect(stiff < min(_end(found, f) for f in STIFFNESSES[1:]), "steps: a stiffer rock does not slide more exactly")
    report.expect(all(found[f, STEPS[0], "matched"].completed for f in STIFFNESSES), "steps: the smallest step diverged")


def _stable(found, notes, factor, method):
    """Errors over time at the stable steps, from small to large."""
    return [relative_error(found[factor, s, method], ANGLE, FRICTION) for s in STEPS if s <= notes[factor, method]]


def _means(found, notes, factor, method):
    return [mean_error(*error) for error in _stable(found, notes, factor, method)]


def _ends(found, notes, factor, method):
    return [float(error[-1]) for _, error in _stable(found, notes, factor, method)]


def _growth(errors):
    """Largest of the errors at stable steps over that at the smallest."""
    return max(errors) / errors[0]


def _fall(ratios):
    """1.1 to 13 times, or up to 5 %."""
    low, high = times(min(ratios)), times(max(ratios))
    if max(ratios) <= SAME:
        return f"up to {percent(max(ratios) - 1.0)}"
    return high if low == high else f"{low.removesuffix(' times')} to {high}"


def _sentence(found, notes, factor, method):
    """What the step does to the error with these contact springs."""
    means = _means(found, notes, factor, method)
    text = f"{factor:g} E: "
    if len(means) < 2:
        text += f"{percent(means[0])} at the one stable step"
    elif max(means) <= SAME * min(means):
        text += f"{percent(means[0])}, the same at all {len(means)} stable steps within {percent(max(means) / min(means) - 1)}"
    elif all(a <= b * 1.01 for a, b in zip(means, means[1:])):
        text += f"it falls with the step, {listed(percent(m) for m in means[::-1])} from the largest stable one to the smallest"
    else:
        text += f"it does not fall steadily with the step, {listed(percent(m) for m in means)} from small to large"
    for step in STEPS:
        run = found[factor, step, method]
        if not run.completed:
            text += f"; a step of {plain(step)} s diverges"
        elif step > notes[factor, method]:
            error = mean_error(*relative_error(run, ANGLE, FRICTION))
            text += f"; a step of {plain(step)} s is above the critical one and gives {percent(error)}"
    return text + "."


def _end(found, factor):
    return float(relative_error(found[factor, STEPS[0], "matched"], ANGLE, FRICTION)[1][-1])


def _smallest(found, factor):
    return f"{percent(_end(found, factor))} at {factor:g} E"
