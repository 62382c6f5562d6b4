"""Blocks that rotate, which the paper does not show. Rocking and toppling against the exact answer."""
import math

from paper import exact, figures, inertia, models
from paper.report import digits, listed, percent, plain

ROCKING = (1.0, 3.0)               # m
TOPPLING = (1.0, 4.0)              # m
START = math.radians(2.0)          # beyond the balance
END = math.radians(45.0)           # of the centre beyond the corner
FLAT = 88.0                        # degrees: figures end here
BOUND = 5e-3                       # row 5 of docs/validation.md
METHODS = {"covering": models.PAPER, "matched": {"mass": "matched"},
           "consistent": {"mass": "consistent"}, "dda": {"method": "dda"}}
NAMES = {"covering": "as printed", "matched": "matched", "consistent": "consistent", "dda": "DDA, implicit"}


class Case:
    """One block on its corner: its model, and when its tilt passes `level`."""

    def __init__(self, name, size, tilt, level, exact_time):
        self.name, self.size, self.tilt, self.level, self.exact = name, size, tilt, level, exact_time
        self.theory = exact.Standing(*size, models.GRAVITY)
        polygon = [(0, 0), (size[0], 0), size, (0, size[1])]
        self.radius2 = inertia.covering_radius(polygon) ** 2
        self.excess = self.radius2 / self.theory.gyration2
        self.slower = self.theory.slower(self.radius2)
        self.duration = round(1.15 * self.slower * exact_time, 2)

    def job(self, method, keys, step):
        """Arguments of Program.run()."""
        rows = round(self.duration / 1e-3)
        given = {**keys, **({"time_step": step} if method == "dda" else {})}
        return dict(name=f"{self.name}-{method}", model=models.standing_block(*self.size, self.tilt, self.duration, rows,
                                                                              **given))

    def tilts(self, run):
        """Tilt over time, rad."""
        return models.tilt_of(run, self.size[1], self.tilt)

    def time_of(self, run):
        """When the tilt passes the level; None if it never does."""
        return exact.crossing(run.time, self.tilts(run), self.level)


def cases():
    """Rocking from half the critical tilt to flat; toppling from a little beyond balance."""
    rocking = exact.Standing(*ROCKING, models.GRAVITY)
    toppling = exact.Standing(*TOPPLING, models.GRAVITY)
    half = 0.5 * rocking.balance
    return [Case("rocking", ROCKING, half, 0.0, rocking.quarter_period(half)),
            Case("toppling", TOPPLING, toppling.balance + START, toppling.balance + END,
                 toppling.toppling_time(START, END))]


def write(report, program, settings):
    """The section, from its runs."""
    both = cases()
    jobs = [case.job(method, keys, settings.rotation_step) for case in both for method, keys in METHODS.items()]
    runs = iter(program.run_all(jobs))
    found = {(case.name, method): next(runs) for case in both for method in METHODS}

    rocking, toppling = both
    report.heading("Rocking and toppling: blocks that rotate")
    report.text(
        "The blocks of the paper's two examples hardly rotate. Where the mass is lumped on a triangle that covers the block",
        "it lies far outside the block, whose moment of inertia is then too large:",
        f"{digits(rocking.excess, 3)} times for a block of {ROCKING[0]:g} m x {ROCKING[1]:g} m,",
        f"{digits(toppling.excess, 3)} times for one of {TOPPLING[0]:g} m x {TOPPLING[1]:g} m. For rotation about a corner",
        f"the same term, for the distance to the corner, is added to both, and motions take {digits(rocking.slower, 3)} and",
        f"{digits(toppling.slower, 3)} times as long. Two problems with an exact answer show this:")
    report.points([
        f"rocking: the {ROCKING[0]:g} m x {ROCKING[1]:g} m block is released on its corner at half its critical tilt"
        f" ({digits(math.degrees(rocking.tilt), 3)}°); the time until it lies flat is a quarter of its period. Exact:"
        f" {digits(rocking.exact, 5)} s.",
        f"toppling: the {TOPPLING[0]:g} m x {TOPPLING[1]:g} m block is released {math.degrees(START):g}° beyond its balance; the"
        f" time is that until its centre is {math.degrees(END):g}° beyond it. Exact: {digits(toppling.exact, 5)} s."])
    _draw(report, both, found)
    _table(report, both, found, settings)


def _draw(report, both, found):
    drawing, axes = figures.panels(1, 2, height=2.9)
    for axis, case in zip(axes[0], both):
        for method in ("covering", "matched", "dda"):
            run = found[case.name, method]
            tilts = [math.degrees(t) for t in case.tilts(run)]
            last = next((k for k, t in enumerate(tilts) if not 0.0 < t < FLAT), len(tilts))
            figures.line(axis, method, run.time[:last:10], tilts[:last:10])
        until = [k * case.exact / 60.0 for k in range(61)]
        figures.line(axis, "exact", until, [math.degrees(t) for t in case.theory.path(case.tilt, until)], linewidth=2.4)
        axis.set_title(f"{case.name}, {case.size[0]:g} m x {case.size[1]:g} m")
        axis.set_xlabel("time (s)")
        axis.set_ylabel("tilt (degrees)")
    figures.legend_below(drawing, axes[0, 0], 4)
    report.figure("rotation", drawing, "Tilt of a block released on its corner; the exact curve ends where the time is"
                                        " measured.")


def _table(report, both, found, settings):
    rows, errors = [], {}
    for case in both:
        for method in METHODS:
            at = case.time_of(found[case.name, method])
            report.expect(at is not None, f"{case.name}, {method}: never gets there")
            if at is None:
                continue
            ratio = at / case.exact
            predicted = case.slower if method == "covering" else 1.0
            errors[case.name, method] = ratio / predicted - 1.0
            if method != "dda":
                report.expect(abs(ratio / predicted - 1.0) < BOUND,
                              f"{case.name}, {method}: {ratio:.5g} times the exact time, predicted {predicted:.5g}")
            rows.append([case.name, NAMES[method], digits(at, 5), f"{ratio:.4f}", f"{predicted:.4f}"])
    report.table(["problem", "method", "time (s)", "over the exact time", "predicted"], rows)
    worst = max(abs(e) for (_, m), e in errors.items() if m in ("matched", "consistent"))
    lumped = max(abs(e) for (_, m), e in errors.items() if m == "covering")
    implicit = max(abs(e) for (_, m), e in errors.items() if m == "dda")
    report.text(
        f"With the matched and the consistent mass the error of the times is {percent(worst)}, with the implicit method",
        f"(step {plain(settings.rotation_step)} s) {percent(implicit)}. The times with the paper's lumping are those predicted from",
        f"its inertia, to {percent(lumped)}. With this lumping a slope of slender blocks would appear to fail more slowly than it",
        "does.")
    report.verdict(
        f"Rocking and toppling: the paper's method as printed takes {listed(digits(c.slower, 3) for c in both)} times as long"
        f" as it should; with matched mass the error is {percent(worst)}.")
