"""Which step each method needs for the same accuracy, on squares of jointed rock."""
import dataclasses
import math

import numpy as np

from paper import models, results

TARGET = 0.01      # of the displacement, root mean square over monitors and rows
ROWS = 100
FINE = 0.2         # safety of the fine run with the covering triangle
COVERING = {"mass": "covering", "switching": "plain"}  # of the paper, but with faces


@dataclasses.dataclass
class Accuracy:
    """What was found on one square over one period."""

    side: int
    blocks: int
    explicit_step: float
    errors: dict        # of the explicit variants at their own largest step
    fine_error: float   # with the covering triangle, at a fifth of its critical step
    tries: list         # implicit: (mean step, error)
    step: float         # implicit: for TARGET; None where no try brackets it


def power_law(x, y):
    """(a, b) of y = a x^b, least squares in the logarithms."""
    b, a = np.polyfit(np.log(x), np.log(y), 1)
    return float(math.exp(a)), float(b)


def step_for(target, tries):
    """Step at which the error is `target`, straight between tries in the logarithms; beyond them along the last pair."""
    tries = sorted(tries)
    if len(tries) < 2:
        return None
    pairs = list(zip(tries, tries[1:]))
    (h0, e0), (h1, e1) = next((pair for pair in pairs if pair[0][1] <= target <= pair[1][1]),
                              pairs[0] if tries[0][1] > target else pairs[-1])
    if e1 <= e0:
        return None
    part = (math.log(target) - math.log(e0)) / (math.log(e1) - math.log(e0))
    return math.exp(math.log(h0) + min(max(part, -1.0), 2.0) * (math.log(h1) - math.log(h0)))


def _variants(settings):
    """Explicit runs: name and solver keys."""
    return {"reference": {"safety": settings.reference_safety}, "matched": {}, "consistent": {"mass": "consistent"},
            "covering": COVERING, "fine": {**COVERING, "safety": FINE}}


def measure(program, settings):
    """One Accuracy per side."""
    jobs = []
    for side in settings.accuracy_sides:
        square, period = models.Square(side), models.period(side)
        for name, keys in _variants(settings).items():
            jobs.append(dict(name=f"accuracy-{side}-{name}", model=square.model(period, ROWS, **keys)))
        for step in settings.accuracy_tries:
            rows = max(1, round(period / max(step, period / ROWS)))
            jobs.append(dict(name=f"accuracy-{side}-dda-{step:g}",
                             model=square.model(period, rows, method="dda", time_step=step)))
    runs = iter(program.run_all(jobs))
    return [_one(side, {name: next(runs) for name in _variants(settings)}, [next(runs) for _ in settings.accuracy_tries])
            for side in settings.accuracy_sides]


def _one(side, explicit, implicit):
    reference = explicit["reference"]
    errors = {name: results.mean_difference(explicit[name], reference) for name in ("matched", "consistent", "covering")}
    tries = [(run.mean_step, results.mean_difference(run, reference)) for run in implicit]
    return Accuracy(side, reference.blocks, explicit["matched"].mean_step, errors,
                    results.mean_difference(explicit["fine"], reference), tries, step_for(TARGET, tries))


def implicit_steps(found):
    """side -> step for TARGET: as measured, else along the power law through what was measured. And that law."""
    known = [f for f in found if f.step]
    law = power_law([f.blocks for f in known], [f.step for f in known]) if len(known) > 1 else (known[0].step, 0.0)
    measured = {f.side: f.step for f in known}
    return (lambda side: measured.get(side, law[0] * float(side * side) ** law[1])), law
