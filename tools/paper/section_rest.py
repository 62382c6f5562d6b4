"""Equilibrium: the implicit method without dynamics against the explicit one with local damping."""
import numpy as np

from paper import figures, models
from paper.report import digits, percent, plain, times

BALANCED = 1e-3       # mean unbalanced force over mean contact force
DAMPING = (0.8, 0.5)
ROWS = 400
STATIC_STEPS = 40     # of the static variant, at most


def balanced_from(run):
    """Time from which the unbalanced ratio stays under BALANCED; None if it never does."""
    over = np.nonzero(run.history["unbalanced"] > BALANCED)[0]
    if len(over) == 0:
        return float(run.time[0])
    return float(run.time[over[-1] + 1]) if over[-1] + 1 < len(run.time) else None


def _explicit(side, damping, duration, rows):
    return models.Square(side).model(duration, rows, damping={"local": damping})


def _static(side, step, steps):
    return models.Square(side).model(step * steps, steps, method="dda", dynamic=False, time_step=step)


def _to_rest(program, side, settings):
    """Timed runs that end at rest: name -> (Results, seconds simulated), None where rest was not reached."""
    longest = settings.rest_periods * models.period(side)
    explicit = program.run_all([dict(name=f"rest-{side}-{d:g}", model=_explicit(side, d, longest, ROWS)) for d in DAMPING])
    found = {}
    for damping, run in zip(DAMPING, explicit):
        at = balanced_from(run)
        name = f"explicit, local damping {damping:g}"
        found[name] = at and program.run(name.replace(" ", "-"), _explicit(side, damping, at, 10), timed=True)
    static = program.run_all([dict(name=f"rest-{side}-static-{h:g}", model=_static(side, h, STATIC_STEPS))
                              for h in settings.rest_tries])
    tries = []
    for step, run in zip(settings.rest_tries, static):
        at = balanced_from(run)
        if at:
            steps = max(1, round(at / step))
            tries.append((step, program.run(f"rest-static-{step:g}", _static(side, step, steps), timed=True)))
    return found, tries, explicit[0]


def write(report, program, settings):
    """The section, from its runs."""
    report.heading("Equilibrium")
    report.text(
        "The squares are the same, but now only the state of equilibrium is wanted. The implicit method has a variant for",
        "this, which drops all velocities at every step (`dynamic = false`); the explicit method has local damping.",
        f"Equilibrium is reached when the mean unbalanced force stays below {plain(BALANCED)} of the mean contact force. For the",
        f"static variant {len(settings.rest_tries)} steps were tried, and the table has the one that reached equilibrium in the",
        "shortest wall time.")
    rows, ratios, points = [], [], {"matched": [], "dda": []}
    for side in settings.rest_sides:
        found, tries, settled = _to_rest(program, side, settings)
        report.expect(bool(tries), f"rest: {side}: the static variant never came to rest")
        report.expect(any(found.values()), f"rest: {side}: the explicit method never came to rest")
        if not tries or not any(found.values()):
            continue
        step, best = min(tries, key=lambda item: item[1].stepping)
        blocks = best.blocks
        apart = _apart(best, settled)
        for name, run in found.items():
            rows.append([f"{blocks:,}", name, digits(run.summary["time"]) if run else "not reached",
                         run.steps if run else "-", digits(run.stepping) if run else "-", "-"])
        rows.append([f"{blocks:,}", f"implicit, static, step {plain(step)} s", digits(best.summary["time"]), best.steps,
                     digits(best.stepping), percent(apart)])
        quickest = min(run.stepping for run in found.values() if run)
        ratios.append((blocks, quickest / best.stepping))
        points["matched"].append((blocks, quickest))
        points["dda"].append((blocks, best.stepping))
    report.table(["blocks", "method", "simulated (s)", "steps", "wall seconds to equilibrium",
                  "difference of displacements from the explicit ones"], rows)
    if ratios:
        _draw(report, points)
        _verdict(report, ratios)


def _apart(run, other):
    """Largest difference of the last displacements of any monitor, over the largest displacement."""
    a, b = run.displacements()[-1], other.displacements()[-1]
    return float(np.linalg.norm(a - b, axis=1).max() / np.linalg.norm(b, axis=1).max())


def _draw(report, points):
    drawing, axes = figures.panels(1, 1, width=4.6, height=3.0)
    axis = axes[0, 0]
    for method, label in (("matched", "explicit, the better local damping"), ("dda", "implicit, static")):
        x, y = zip(*points[method])
        figures.line(axis, method, x, y, marker="o", markersize=3.5, label=label)
    figures.logarithmic(axis)
    axis.set_xlabel("blocks")
    axis.set_ylabel("wall seconds to equilibrium")
    axis.legend(loc="upper left")
    drawing.tight_layout()
    report.figure("rest", drawing, "Wall seconds until a square of jointed rock is in equilibrium.")


def _verdict(report, ratios):
    low, high = min(r for _, r in ratios), max(r for _, r in ratios)
    if low > 1.0:
        text = (f"Here the implicit method wins at every size, by a factor of {digits(low)} to {digits(high)}: it need not follow"
                " the waves, and its large steps lead to equilibrium directly.")
    elif high < 1.0:
        text = f"Here, too, the explicit method is quicker, by a factor of {digits(1 / high)} to {digits(1 / low)}."
    else:
        text = "Which method is quicker depends on the size: " + "; ".join(
            f"{n:,} blocks, {'implicit' if r > 1 else 'explicit'} by {times(max(r, 1 / r))}" for n, r in ratios) + "."
    report.verdict("Equilibrium: " + text[0].lower() + text[1:])
    report.text(text, "Where joints slide, the equilibrium depends on the way to it, so the two methods need not find the same one.")
