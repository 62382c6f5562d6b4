"""docs/verification.md from rows and records: a table of all rows, then a section for each."""
import math
import re

from paper import figures
from paper.report import digits, listed, wrapped
from verification import figures_motion as motion
from verification import figures_rest as rest
from verification.rows import ROWS

FIGURES = {
    1: (motion.ramp, "Distance slid at friction of 10 and 15 degrees, large markers for E 200 MPa, small ones for 20 GPa,"
        " and its relative error."),
    2: (motion.preloaded, "Distance slid less v0 t, large markers for E 200 MPa, small ones for 20 GPa, and its relative"
        " error."),
    3: (motion.threshold, "A tenth of a degree either side of the threshold."),
    4: (motion.cohesion, "Below and above the critical cohesion, springs per contact."),
    5: (motion.rocking, "Tilt over time with the three mass matrices."),
    6: (motion.spin, "Growth of the area over the first oscillations; change of angular momentum over ten turns."),
    7: (motion.frequencies, "Strain of a free block in its three modes."),
    8: (motion.bounce, "The first bounces at 0.4 of the critical step; the energy balance error over twenty of them at all steps."),
    9: (rest.column, "Stress over depth."),
    10: (motion.pulse, "Time at which the pulse passes, and the velocity of each block then; its mirror image meets it at the free end."),
    11: (rest.critical_step, "The bound of the step over the stiffness of the joints."),
    12: (rest.snap_through, "Load and sag until the beam snaps through."),
    13: (rest.arch, "The arches that stand and collapse; how far their voussoirs sink, and the bounds on it."),
    14: (rest.dam, "The dam as it overturns, and how far its crest moves at other depths of water."),
    15: (rest.overhang, "The stacks that stand and collapse; how far the top brick sinks, and the bounds on it."),
    16: (motion.corner, "Model, paths of the two squares, and change of the contact force per step while in touch."),
    17: (motion.ten_pieces, "Distance slid, and the largest sums of normal forces over time."),
    18: (rest.wall, "Kinetic energy and energy balance error, the largest over short intervals of time."),
    19: (motion.heap, "The heap at its start and end; what changes of its momentum; how far the same motion is apart."),
    20: (rest.box, "Model, and the stress in one block as the box closes on it."),
    21: (motion.dissipation, "Energy dissipated by friction and by damping."),
    38: (rest.opening, "Stress along the two axes, by rings of blocks; the first ring is left out."),
}


STUDIES = {
    "fos_study": (
        "Study: factors of safety",
        "`tools/study-fos`: ten slopes with an exact factor: the least over all paths along joints (dynamic programming),"
        " Sarma's slices, Goodman and Bray's columns. The search ends within 0.01 of the factor; time is of one thread."),
    "slope_study": (
        "Study: slopes as joint statistics cut them",
        "`tools/study-slopes`: slopes of 30 m at 60 degrees, bedding 38 degrees, spacing 2.0 m ± 0.8 m, cross joints"
        " -62 degrees, 2.5 m ± 1.0 m; deviations normal, uniform and exponential by turns, every other slope bonded. Every"
        " block is compared with every other by points in polygons: faces may be closed no deeper than blocks lie in each"
        " other, nothing may overlap without a contact; as drawn, and after 400 steps. The largest of each group. A slope is"
        " bad, too, where a face as drawn pushes with more than four thousandths of the heavier block's weight: between slivers of"
        " square decimetres and less, with edges of millimetres, the rounding of coordinates may close a face by that much."),
}


def small(value):
    """An error or a bound: 2e-3, 0.7, 1.5."""
    if value == 0.0 or 0.1 <= abs(value) < 1e3 or not math.isfinite(value):
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa.removesuffix('.0')}e{int(exponent)}"


def amount(value, unit):
    """A quantity in its unit."""
    if value is None:
        return "-"
    return (f"{digits(value, 6)} {unit}" if math.isfinite(value) else f"{value}").strip()


def case(check):
    """Which of the row's cases, long numbers with commas."""
    return re.sub(r"\d{5,}", lambda found: f"{int(found[0]):,}", check.which)


def bound(check):
    """What is asserted."""
    if math.isinf(check.low):
        return "at most " + f"{small(check.high)} {check.unit}".strip()
    if math.isinf(check.high):
        return "at least " + f"{small(check.low)} {check.unit}".strip()
    return f"±{small(check.high)}" if check.low == -check.high else f"{small(check.low)} to {small(check.high)}"


def error(check):
    """The part that the bound is about."""
    return f"{small(check.error)} {check.unit}".strip() if check.exact is None else small(check.error)


class Page:
    """Collects sections; `broken` is what should make the tool fail."""

    def __init__(self, folder, records, tables):
        self.folder = folder
        self.tables = tables
        self.records = records
        self.broken = []
        self.written = 0

    def write(self):
        """The page and its figures. The path of the page."""
        (self.folder / "figures").mkdir(parents=True, exist_ok=True)
        sections = [self._section(row) for row in ROWS]
        page = self.folder / "verification.md"
        parts = [*_opening(), self._summary(), *(part for section in sections for part in section),
                 *self._studies(page)]
        page.write_text("\n\n".join(parts) + "\n", encoding="utf-8")
        return page

    def _studies(self, page):
        """Sections of the studies; a table that is not given stays as it is on the page."""
        before = page.read_text(encoding="utf-8") if page.is_file() else ""
        parts = []
        for name, (title, text) in STUDIES.items():
            table = self.tables.get(name)
            if table is None:
                kept = re.search(rf"^## {re.escape(title)}$.*?^(\|.*?\|)\n(?!\|)", before, re.M | re.S)
                table = kept[1] if kept else "Not run yet."
            parts += [f"## {title}", wrapped(text), table]
        return parts

    def _summary(self):
        lines = ["| row | problem | closest to its bound | error | bound | all bounds |", "|---|---|---|---|---|---|"]
        for row in ROWS:
            checks = self.records.checks_of(row.number)
            if not checks:
                lines.append(f"| {row.number} | {_link(row)} | - | - | - | **none** |")
                continue
            worst = max(checks, key=lambda check: math.inf if math.isnan(check.part) else check.part)
            held = sum(check.holds for check in checks)
            verdict = f"{held} of {len(checks)} hold" if held == len(checks) else f"**{held} of {len(checks)} hold**"
            which = f"{worst.what} ({case(worst)})" if worst.which else worst.what
            lines.append(f"| {row.number} | {_link(row)} | {which} | {error(worst)} | {bound(worst)} | {verdict} |")
        return "\n".join(lines)

    def _section(self, row):
        checks = self.records.checks_of(row.number)
        parts = [f"## {row.number}. {row.title}", wrapped(f"**Model.** {row.model}"),
                 wrapped(f"**Exact.** {row.exact}")]
        if not checks:
            self.broken.append(f"row {row.number} has no record")
            return [*parts, "No test has recorded it."]
        self.broken += [f"row {row.number}: {check.what} ({case(check) or row.title}): {error(check)}, not {bound(check)}"
                        for check in checks if not check.holds]
        facts = _facts(self.records.models_of(row.number), row.leave_out)
        parts[1] = wrapped(f"**Model.** {row.model} {facts}")
        return [*parts, _table(checks), *([wrapped(row.note)] if row.note else []), *self._figure(row), _tests(checks)]

    def _figure(self, row):
        if row.number not in FIGURES:
            return []
        draw, caption = FIGURES[row.number]
        drawing = draw(self.records)
        file = self.folder / "figures" / f"verification-{row.number:02}.svg"
        figures.save(drawing, file)
        self.written += 1
        return [f"![{caption}](figures/{file.name})", wrapped(f"*{caption}*")]


def _opening():
    return [
        "# Verification: computed answers",
        wrapped(
            "The rows of [validation.md](validation.md), computed. Every number here was recorded by the test that asserts"
            " the bound beside it; `tools/verification-page` runs the tests, puts this page together and draws the figures."
            " An error is relative, computed/exact - 1, unless it has a unit or the bound is one-sided. Numbers at the"
            " level of rounding, about 1e-12 and below, differ from one machine to the next. In figures the exact answer is"
            " a black line and markers are computed; of models, fixed blocks are grey, dashed outlines are the start, filled"
            " ones the end."),
    ]


def _link(row):
    kept = "".join(c for c in f"{row.number}. {row.title}".lower() if c.isalnum() or c in " -")
    return f"[{row.title}](#{kept.replace(' ', '-')})"


def _table(checks):
    lines = ["| case | quantity | exact | computed | error | bound |", "|---|---|---|---|---|---|"]
    for check in checks:
        exact = amount(check.exact, check.unit)
        computed = amount(check.computed, check.unit) if check.exact is not None else error(check)
        off = error(check) if check.exact is not None else "-"
        lines.append(f"| {case(check) or '-'} | {check.what} | {exact} | {computed} | {off} | {bound(check)} |")
    return "\n".join(lines)


def _tests(checks):
    """Where the numbers come from."""
    files = {}
    for check in checks:
        files.setdefault(check.file or "tools/rest-study wall", set()).add(check.test)
    parts = [f"`{file}`" + (f" ({', '.join(sorted(tests))})" if file.startswith("tests/") else "")
             for file, tests in sorted(files.items())]
    return wrapped("Recorded by " + ", ".join(parts) + ".")


def _facts(models, leave_out):
    """Key numbers of the models as they were run, where several differ all of them."""
    def of(key, show):
        values = {value for model in models for value in (model[key] if isinstance(model[key], list) else [model[key]])}
        return listed(show(value) for value in sorted(values))

    if not models:
        return ""
    free = {model["fixed"].count(0) for model in models}
    held = {model["fixed"].count(1) for model in models}
    gravity = {math.hypot(*model["gravity"]) for model in models}
    facts = [_count(free, "free block"), _count(held, "fixed one") if held != {0} else "",
             "density " + of("density", lambda v: f"{v:g} kg/m3"),
             "E " + of("young", _pascal), "nu " + of("poisson", lambda v: f"{v:g}")]
    if any(model["friction"] for model in models):
        facts.append("friction " + of("friction", lambda v: f"{v:g}°"))
        facts.append("p_n " + of("normal_stiffness", lambda v: f"{small(v)} N/m"))
        facts.append("p_t " + of("shear_stiffness", lambda v: f"{small(v)} N/m"))
    if "gravity" not in leave_out:
        facts.append("g " + listed(f"{g:g} m/s2" for g in sorted(gravity)) if gravity != {0.0} else "no gravity")
    steps = [model["steps"] for model in models]
    if max(steps) > 0:
        facts.append((f"{min(steps):,}" if min(steps) == max(steps) else f"{min(steps):,} to {max(steps):,}") + " steps")
    return f"As run: {'; '.join(fact for fact in facts if fact)}."


def _count(numbers, what):
    text = " or ".join(str(number) for number in sorted(numbers))
    return f"{text} {what}" + ("s" if numbers != {1} else "")


def _pascal(value):
    return f"{value / 1e9:,.4g} GPa" if value >= 1e9 else f"{value / 1e6:g} MPa"
