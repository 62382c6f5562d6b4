"""edda study, end to end: exact probabilities, the same bytes whoever runs it, bad input. Usage: study_test.py EDDA"""
import json
import math
import os
import random
import re
import signal
import subprocess
import time
import unittest

from program import EDDA, Program, prepared, read_rows

# A slab of 2 x 18.475 m on a plane of 30 degrees.
SLIDE = """
[materials.rock]
density = 2600
young = "10 GPa"
poisson = 0.25
[joints.plane]
friction_angle = 25
cohesion = "10 kPa"
[[block]]
fixed = true
polygon = [[0, 0], [20, 0], [20, 11.547005383792516]]
[[block]]
name = "slab"
polygon = [[2, 1.154700538379252], [18, 10.392304845413264], [17, 12.124355652982141], [1, 2.886751345948129]]
"""
LENGTH, WEIGHT = 16 / math.cos(math.radians(30)), 2600 * 9.81 * 2 * 16 / math.cos(math.radians(30))
MEAN, SD = 10.0, 4.0  # kPa, of the cohesion


def in_slab(x, y):
    slope = math.radians(30)
    x, y = x - 2, y - 1.154700538379252
    along, across = x * math.cos(slope) + y * math.sin(slope), y * math.cos(slope) - x * math.sin(slope)
    return 0 <= along <= LENGTH and 0 <= across <= 2


def factor(cohesion, friction=25.0):
    """Of cohesion in kPa and friction in degrees."""
    slope = math.radians(30)
    return (1e3 * cohesion * LENGTH / WEIGHT + math.cos(slope) * math.tan(math.radians(friction))) / math.sin(slope)


def normal_below(x):
    return 0.5 * math.erfc(-x / math.sqrt(2))


def exact_probability():
    """That the lognormal cohesion is below what holds the slab."""
    slope = math.radians(30)
    least = 1e-3 * WEIGHT / LENGTH * (math.sin(slope) - math.cos(slope) * math.tan(math.radians(25)))
    sigma = math.sqrt(math.log1p((SD / MEAN) ** 2))
    return normal_below((math.log(least / MEAN) + 0.5 * sigma ** 2) / sigma)


def study(sampling, more=""):
    return f"""
title = "Plane slide"
model = "slide.toml"
[sampling]
{sampling}
[vary.cohesion]
key = "joints.plane.cohesion"
distribution = "lognormal"
mean = {MEAN}
sd = {SD}
unit = "kPa"
{more}
[ask.factor]
of = "limit"
[failure]
below = 1.0
"""


FRICTION = """[vary.friction]
key = "joints.plane.friction_angle"
distribution = "normal"
mean = 25
sd = 3
"""
OUTCOME = ("study.csv", "summary.json", "points.csv", "rows.csv", "study.toml", "model.toml", "report.html")


# A cut in ground under horizontal stress: it slips along flat beds as it is dug.
CUT = """
[materials.rock]
unit_weight = "26 kN/m3"
young = "10 GPa"
poisson = 0.25
[joints.beds]
friction_angle = 22
kn = "2 GPa/m"
[domain]
outline = [[0, 0], [40, 0], [40, 20], [0, 20]]
joint = "beds"
[[joint_set]]
name = "beds"
angle = 5
spacing = 4
origin = [20, 6]
[[joint_set]]
name = "cross"
angle = 110
spacing = 6
origin = [20, 6]
[[opening]]
name = "cut"
polygon = [[0, 8], [18, 8], [21, 20], [0, 20]]
[initial_stress]
k0 = 2.0
surface_y = 20
[[boundary]]
sides = ["left", "right", "bottom"]
type = "roller"
[[monitor]]
name = "a"
point = [20, 15]
[[monitor]]
name = "b"
point = [21.5, 19]
[[monitor]]
name = "c"
point = [19.2, 11]
[[monitor]]
name = "d"
point = [26, 19]
[[monitor]]
name = "e"
point = [10, 7.5]
[[stage]]
name = "rest"
until = "equilibrium"
[[stage]]
name = "dig25"
excavate = ["cut"]
relax = { cut = 0.25 }
until = "equilibrium"
[[stage]]
name = "dig50"
relax = { cut = 0.5 }
until = "equilibrium"
[[stage]]
name = "dig75"
relax = { cut = 0.75 }
until = "equilibrium"
[[stage]]
name = "dig100"
relax = { cut = 1.0 }
until = "equilibrium"
"""


def fit_of(measured, error):
    """A study that looks for three keys of CUT."""
    text = """
model = "cut.toml"
[vary.friction]
key = "joints.beds.friction_angle"
low = 12
high = 40
[vary.kn]
key = "joints.beds.kn"
low = 0.5
high = 8
scale = "log"
unit = "GPa/m"
[vary.k0]
key = "initial_stress.k0"
low = 1
high = 3
"""
    for column, value in measured.items():
        text += f"""[ask.{column.replace('.', '_')}]
of = "run"
value = "history.{column}"
measured = {value!r}
error = {error!r}
"""
    return text


class Study(Program):
    def setUp(self):
        super().setUp()
        (self.dir / "slide.toml").write_text(SLIDE)

    def write(self, *text):
        (self.dir / "s.toml").write_text(study(*text))

    def summary(self, folder="s"):
        return json.loads((self.dir / folder / "summary.json").read_text(encoding="utf-8"))

    def same_outcome(self, *folders):
        first, *others = folders
        for name in OUTCOME:
            for other in others:
                self.assertEqual((self.dir / first / name).read_bytes(), (self.dir / other / name).read_bytes(), f"{other}/{name}")

    def test_writes_every_file_of_the_promise(self):
        self.write('method = "monte-carlo"\nsamples = 60', FRICTION)
        done = self.expect(0, "study", "s.toml")
        files = {*OUTCOME, "columns.csv"}
        files |= {f"{name}.{ending}" for name in ("histogram_factor", "scatter", "tornado", "convergence") for ending in ("png", "svg")}
        self.assertEqual({p.name for p in (self.dir / "s").iterdir()}, files)
        rows = read_rows(self.dir / "s/study.csv")
        self.assertEqual(len(rows), 60)
        for row in rows:
            self.assertAlmostEqual(float(row["factor"]), factor(float(row["cohesion"]), float(row["friction"])), delta=2e-6)
            self.assertEqual(row["failed"], "1" if float(row["factor"]) < 1 else "0")
        summary = self.summary()
        failed = sum(row["failed"] == "1" for row in rows)
        self.assertEqual((summary["failure"]["failed"], summary["failure"]["of"]), (failed, 60))
        self.assertIn(f"probability of failure {100 * failed / 60:.3g} %", done.stdout)
        self.assertEqual(summary["worst"][0], min(range(60), key=lambda i: float(rows[i]["factor"])))
        page = (self.dir / "s/report.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("<svg"), 4)
        self.assertFalse(re.findall(r'(?:src|href)="(?!#)', page), "the page needs other files")

    def test_the_most_likely_failure_is_exact(self):
        for method in ("form", "sorm"):
            self.write(f'method = "{method}"')
            self.expect(0, "study", "s.toml", "-o", method)
            found = self.summary(method)["failure"]
            self.assertAlmostEqual(found["probability"] / exact_probability(), 1.0, delta=2e-3, msg=method)
            self.assertAlmostEqual(factor(found["design_point"]["cohesion"]), 1.0, delta=1e-4)

    def test_methods_agree_with_the_closed_integral(self):
        exact = exact_probability()
        for method, samples in (("monte-carlo", 400), ("latin-hypercube", 400), ("sobol", 400), ("subset", 300)):
            self.write(f'method = "{method}"\nsamples = {samples}')
            self.expect(0, "study", "s.toml", "-o", method)
            found = self.summary(method)["failure"]
            self.assertLessEqual(found["low"], exact, method)
            self.assertGreaterEqual(found["high"], exact, method)
            if method in ("latin-hypercube", "sobol"):  # one quantity, spread evenly
                self.assertAlmostEqual(found["probability"], exact, delta=0.003, msg=method)

    def test_the_indices_of_sobol_are_those_of_a_sum(self):
        uniform = '[vary.friction]\nkey = "joints.plane.friction_angle"\ndistribution = "uniform"\nlow = 20\nhigh = 30\n'
        self.write('method = "sobol-indices"\nsamples = 500', uniform)
        self.expect(0, "study", "s.toml")
        # The factor is a sum: each index is the part of its variance.
        of_cohesion = (factor(SD) - factor(0)) ** 2
        thousand = [factor(0, 20 + 10 * (i + 0.5) / 1000) for i in range(1000)]
        mean = sum(thousand) / 1000
        of_friction = sum((x - mean) ** 2 for x in thousand) / 1000
        part = of_cohesion / (of_cohesion + of_friction)
        found = self.summary()["sobol_indices"]
        for order in ("first", "total"):
            self.assertAlmostEqual(found[order]["cohesion"], part, delta=0.12)
            self.assertAlmostEqual(found[order]["friction"], 1 - part, delta=0.12)
            self.assertLess(found[order + "_low"]["cohesion"], part)
            self.assertGreater(found[order + "_high"]["cohesion"], part)
        self.assertEqual(self.summary()["samples"], 500 * 4)

    def test_grids_and_tables(self):
        grid = '[vary.friction]\nkey = "joints.plane.friction_angle"\nvalues = [20, 25, 30]\n'
        text = study('method = "grid"', grid).replace('distribution = "lognormal"\nmean = 10.0\nsd = 4.0', "values = [5, 10]")
        (self.dir / "s.toml").write_text(text)
        self.expect(0, "study", "s.toml")
        rows = read_rows(self.dir / "s/study.csv")
        self.assertEqual([(float(r["cohesion"]), float(r["friction"])) for r in rows],
                         [(c, f) for c in (5, 10) for f in (20, 25, 30)])
        for row in rows:
            self.assertAlmostEqual(float(row["factor"]), factor(float(row["cohesion"]), float(row["friction"])), delta=2e-6)
        (self.dir / "given.csv").write_text("friction,cohesion\n22,7\n33,9\n")
        text = text.replace('method = "grid"', 'method = "table"\ntable = "given.csv"')
        (self.dir / "t.toml").write_text(text)
        self.expect(0, "study", "t.toml")
        self.assertAlmostEqual(float(read_rows(self.dir / "t/study.csv")[1]["factor"]), factor(9, 33), delta=2e-6)
        (self.dir / "given.csv").write_text("friction\n22\n")
        self.assertIn("given.csv:1:1: cohesion: has no such column", self.expect(2, "study", "t.toml", "-o", "u").stderr)

    def test_a_run_in_time_is_asked_for_its_history_and_its_summary(self):
        (self.dir / "slide.toml").write_text(SLIDE + '[[monitor]]\nname = "toe"\npoint = [2, 2]\n[solver]\nduration = 0.2\n')
        text = study('method = "monte-carlo"\nsamples = 4').replace("mean = 10.0\nsd = 4.0", "mean = 2.0\nsd = 0.1")
        text = text.replace("[ask.factor]\nof = \"limit\"\n[failure]\nbelow = 1.0", """
[ask.slip]
of = "run"
value = "history.toe.ux"
[ask.worst]
of = "run"
value = "history.toe.ux"
take = "smallest"
[ask.friction_work]
of = "run"
value = "energy.friction"
[ask.nothing]
of = "run"
value = "energy.magic"
[failure]
ask = "slip"
below = -1e-3
""")
        (self.dir / "s.toml").write_text(text)
        self.expect(0, "study", "s.toml")
        rows = read_rows(self.dir / "s/study.csv")
        for row in rows:
            # The cohesion is lost: it slides by half of (sin - cos tan) g t^2.
            slope = math.radians(30)
            down = 9.81 * math.sin(slope) * (1 - factor(0))
            self.assertAlmostEqual(float(row["slip"]), -0.5 * down * 0.04 * math.cos(slope), delta=2e-3)
            self.assertLessEqual(float(row["worst"]), float(row["slip"]))
            self.assertEqual((row["nothing"], row["message"]), ("", "there is no energy.magic in the results"))
        self.assertEqual(list((self.dir / "s").glob("**/frames")), [])

    def test_a_run_in_time_is_asked_for_the_force_of_a_boundary_at_a_time(self):
        (self.dir / "ramp.csv").write_text("time,factor\n0,0\n0.1,1\n0.12,0.5\n")
        (self.dir / "pressed.toml").write_text("""
gravity = [0, 0]
[materials.rock]
density = 2600
young = "10 GPa"
poisson = 0.25
[joints.smooth]
friction_angle = 30
[contact]
joint = "smooth"
[[block]]
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[boundary]]
name = "base"
sides = ["bottom"]
type = "roller"
[[load]]
name = "press"
along = [[0, 1], [2, 1]]
pressure = "1 MPa"
history = "ramp.csv"
[solver]
duration = 0.12
[output]
history_every = 0.007
""")
        (self.dir / "p.toml").write_text("""
model = "pressed.toml"
[sampling]
method = "grid"
[vary.pressure]
key = "load.press.pressure"
values = [1e6, 3e6]
[ask.half]
of = "run"
value = "reactions.base.fy"
at = "50 ms"
[ask.peak]
of = "run"
value = "reactions.base.fy"
take = "largest"
[ask.last]
of = "run"
value = "reactions.base.fy"
[ask.never]
of = "run"
value = "reactions.base.fy"
at = "1 s"
""")
        self.expect(0, "study", "p.toml")
        for pressure, row in zip((1e6, 3e6), read_rows(self.dir / "p/study.csv")):
            for name, part in {"half": 0.5, "peak": 0.98, "last": 0.5}.items():
                self.assertAlmostEqual(float(row[name]) / (2 * pressure), part, delta=5e-3, msg=name)
            self.assertEqual((row["never"], row["message"]), ("", "there is no reactions.base.fy at 1 s in the results"))

    def test_how_often_a_place_belongs_to_a_key_block(self):
        (self.dir / "slide.toml").write_text(SLIDE + '[[monitor]]\nname = "toe"\npoint = [2, 2]\n')
        text = study('method = "monte-carlo"\nsamples = 40', FRICTION)
        text = text.replace("[failure]\nbelow = 1.0", '[ask.key]\nof = "keyblocks"\nvalue = "monitors.toe.key"\n[ask.area]\nof = "keyblocks"')
        (self.dir / "s.toml").write_text(text)
        self.expect(0, "study", "s.toml")
        rows = read_rows(self.dir / "s/study.csv")
        for row in rows:
            fails = float(row["factor"]) < 1
            self.assertEqual(float(row["key"]), fails)
            self.assertAlmostEqual(float(row["area"]), 2 * LENGTH if fails else 0, delta=1e-6)
        self.assertEqual(len({row["key"] for row in rows}), 2)

    def test_map_of_key_blocks(self):
        (self.dir / "slide.toml").write_text(SLIDE)
        text = study('method = "monte-carlo"\nsamples = 40', FRICTION)
        text = text.replace("[failure]\nbelow = 1.0", '[ask.area]\nof = "keyblocks"\n[map]\nspacing = 0.5\nregion = [[0, 0], [20, 0], [20, 13], [0, 13]]')
        (self.dir / "s.toml").write_text(text)
        self.assertIn("key blocks most often at", self.expect(0, "study", "s.toml").stdout)
        fail = sum(float(row["factor"]) < 1 for row in read_rows(self.dir / "s/study.csv"))
        places = read_rows(self.dir / "s/key_block_map.csv")
        self.assertEqual({int(p["key"]) for p in places}, {0, fail})
        self.assertEqual({int(p["rock"]) for p in places}, {40})
        for p in places:
            self.assertEqual(int(p["key"]) > 0, in_slab(float(p["x"]), float(p["y"])), p)
            self.assertAlmostEqual(float(p["part"]), int(p["key"]) / 40)
        self.assertEqual(self.summary()["map"]["most"], fail / 40)
        self.assertIn("Key blocks", (self.dir / "s/report.html").read_text())
        # The same bytes from parts, and the picture.
        for i in ("1/2", "2/2"):
            self.expect(0, "study", "s.toml", "--shard", i, "-o", i[0])
        self.expect(0, "study", "merge", "both", "1", "2")
        for name in ("key_block_map.csv", "key_block_map.png", "key_block_map.svg", "study.csv"):
            self.assertEqual((self.dir / "both" / name).read_bytes(), (self.dir / "s" / name).read_bytes(), name)

    def test_a_longer_study_goes_on(self):
        self.write('method = "monte-carlo"\nsamples = 150', FRICTION)
        self.expect(0, "study", "s.toml", "-o", "whole")
        self.expect(0, "study", "s.toml", "--set", "sampling.samples=60")
        before = read_rows(self.dir / "s/study.csv")
        self.expect(0, "study", "s.toml")
        self.assertEqual(read_rows(self.dir / "s/study.csv")[:60], before)
        self.same_outcome("whole", "s")
        # Fewer are those that came first.
        self.expect(0, "study", "s.toml", "--set", "sampling.samples=60")
        self.assertEqual(read_rows(self.dir / "s/study.csv"), before)
        self.assertEqual(self.summary()["samples"], 60)

    def test_a_search_without_end_says_so(self):
        # No cohesion is so small that the slab of little dip fails.
        (self.dir / "slide.toml").write_text(SLIDE.replace("friction_angle = 25", "friction_angle = 50"))
        self.write('method = "form"')
        self.assertIn("there is no failure near", self.expect(2, "study", "s.toml").stderr)

    def test_ends_once_the_interval_is_narrow_enough(self):
        self.write('method = "monte-carlo"\nsamples = 5000\nhalf_width = 0.05', FRICTION)
        for jobs in ("1", "3"):
            self.expect(0, "study", "s.toml", "-o", jobs, "--jobs", jobs)
        found = self.summary("1")
        self.assertTrue(found["ended_early"])
        self.assertLess(found["samples"], 1000)
        self.assertLessEqual(found["failure"]["high"] - found["failure"]["low"], 0.1)
        self.assertEqual(len(read_rows(self.dir / "1/study.csv")), found["samples"])
        for name in ("study.csv", "summary.json", "report.html"):
            self.assertEqual((self.dir / "1" / name).read_bytes(), (self.dir / "3" / name).read_bytes())

    def test_a_fit_finds_what_was_measured(self):
        (self.dir / "cut.toml").write_text(CUT)
        self.expect(0, "run", "cut.toml", "--quiet")
        last = read_rows(self.dir / "cut/history.csv")[-1]
        for seed in (1, 2, 3):
            noise = random.Random(seed)
            measured = {f"{m}.{c}": noise.gauss(float(last[f"{m}.{c}"]), 1e-6) for m in "abcde" for c in ("ux", "uy")}
            (self.dir / "f.toml").write_text(fit_of(measured, 1e-6))
            self.expect(0, "fit", "f.toml", "-o", f"f{seed}")
            summary = self.summary(f"f{seed}")
            found = summary["fit"]
            self.assertTrue(found["converged"])
            self.assertLessEqual(summary["samples"], 250)
            for name, truth in {"friction": 22, "kn": 2, "k0": 2}.items():
                self.assertAlmostEqual(found["values"][name] / truth, 1, delta=0.01)
                self.assertLess(abs(found["values"][name] - truth), 4 * found["errors"][name])
            self.assertLess(found["sum_of_squares"], 30)  # ten measurements less three values
            self.assertEqual((found["not_told_apart"], found["not_told"]), ([], []))

    def test_a_fit_says_what_the_measurements_do_not_tell(self):
        fit = """
model = "slide.toml"
[vary.cohesion]
key = "joints.plane.cohesion"
low = 1
high = 40
unit = "kPa"
[vary.friction]
key = "joints.plane.friction_angle"
low = 10
high = 45
"""
        ask = '[ask.{0}]\nof = "limit"\nvalue = "limit.{0}"\nmeasured = 1.2\nerror = 0.01\n'
        (self.dir / "f.toml").write_text(fit + ask.format("lower") + ask.format("upper"))
        done = self.expect(0, "fit", "f.toml")
        self.assertIn("the measurements do not tell cohesion and friction apart", done.stdout)
        found = self.summary("f")["fit"]
        self.assertAlmostEqual(factor(found["values"]["cohesion"], found["values"]["friction"]), 1.2, delta=1e-3)
        # The density of the slab matters where there is cohesion, and so does its stiffness not.
        young = '[vary.young]\nkey = "materials.rock.young"\nlow = 1e9\nhigh = 9e9\n'
        one = fit[:fit.index("[vary.friction]")] + young
        (self.dir / "g.toml").write_text(one + ask.format("lower") + ask.format("upper"))
        done = self.expect(0, "fit", "g.toml")
        self.assertIn("the measurements do not tell young", done.stdout)
        exact = 1e-3 * (1.2 - factor(0)) * math.sin(math.radians(30)) * WEIGHT / LENGTH
        self.assertAlmostEqual(self.summary("g")["fit"]["values"]["cohesion"], exact, delta=1e-3 * exact)

    def test_shows_a_sample_and_writes_its_model(self):
        self.write('method = "monte-carlo"\nsamples = 12', FRICTION)
        self.expect(0, "study", "s.toml")
        shown = self.expect(0, "study", "show", "s", "--run", "7", "-o", "seven.toml")
        row = read_rows(self.dir / "s/study.csv")[7]
        self.assertIn(f"factor: {row['factor']}", shown.stdout)
        again = json.loads(self.expect(0, "limit", "seven.toml", "--json").stdout)
        self.assertEqual(again["limit"]["lower"], float(row["factor"]))
        self.assertIn("give 0 to 11", self.expect(2, "study", "show", "s", "--run", "12").stderr)

    def test_samples_that_cannot_be_analysed_are_counted(self):
        # A friction angle of 90 degrees or more is bad input.
        wild = FRICTION.replace("mean = 25\nsd = 3", "mean = 80\nsd = 15\nat_least = 1")
        self.write('method = "monte-carlo"\nsamples = 40', wild)
        done = self.expect(0, "study", "s.toml")
        rows = read_rows(self.dir / "s/study.csv")
        lost = [r for r in rows if float(r["friction"]) >= 90]
        self.assertGreater(len(lost), 3)
        for row in lost:
            self.assertEqual((row["factor"], row["failed"]), ("", ""))
            self.assertIn("friction_angle", row["message"])
        self.assertIn(f"{len(lost)} gave no answer: it lies between", done.stdout)
        self.assertAlmostEqual(self.summary()["failure"]["at_most"], len(lost) / 40)

    def test_bad_input_writes_nothing(self):
        cases = (
            (study('method = "monte-carlo"'), "sampling.samples: is missing"),
            (study('method = "monte-carlo"\nsamples = 9').replace("slide.toml", "none.toml"), "none.toml"),
            (study('method = "monte-carlo"\nsamples = 9').replace("joints.plane.cohesion", "joints.plan.cohesion"), "joints.plan"),
            (study('method = "monte-carlo"\nsamples = 9').replace('"kPa"', '"kg"'), "kg"),
            (study('method = "monte-carlo"\nsamples = 9').replace("lognormal", "cauchy"), '"cauchy" is not known'),
            (study('method = "fit"'), "vary.cohesion.low: is missing"),
        )
        for text, says in cases:
            (self.dir / "s.toml").write_text(text)
            failed = self.expect(2, "study", "s.toml")
            self.assertIn(says, failed.stderr)
            self.assertFalse((self.dir / "s").exists(), says)
        self.write('method = "monte-carlo"\nsamples = 9')
        self.assertIn("write 2/8", self.expect(2, "study", "s.toml", "--shard", "3/2").stderr)
        (self.dir / "s").mkdir()
        (self.dir / "s/mine.txt").write_text("mine")
        self.assertIn("something other than a study", self.expect(2, "study", "s.toml").stderr)

    def test_the_same_bytes_whoever_runs_it(self):
        self.write('method = "monte-carlo"\nsamples = 400', FRICTION)
        for jobs in ("1", "2", "7"):
            self.expect(0, "study", "s.toml", "-o", f"jobs{jobs}", "--jobs", jobs)
        for part in ("1/2", "2/2"):
            done = self.expect(0, "study", "s.toml", "-o", "part" + part[0], "--shard", part)
            self.assertIn("others are not", done.stdout)
        self.expect(0, "study", "merge", "merged", "part1", "part2")
        # Two processes that begin at the same time, in one folder.
        both = [subprocess.Popen([EDDA, "study", "s.toml", "-o", "both", "--quiet"], cwd=self.dir, preexec_fn=prepared(None),
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(2)]
        for process in both:
            out, err = process.communicate(timeout=120)
            self.assertEqual((process.returncode, err), (0, ""), out)
        self.same_outcome("jobs1", "jobs2", "jobs7", "merged", "both", "killed" if self.killed() else "jobs1")

    def killed(self):
        """A study of which a hundred processes are killed: workers, and those that started them."""
        random.seed(1)
        kills = 0
        while kills < 100:
            process = subprocess.Popen([EDDA, "study", "s.toml", "-o", "killed", "--jobs", "2", "--quiet"], cwd=self.dir,
                                       preexec_fn=prepared(None), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for _ in range(random.randint(0, 4)):
                time.sleep(random.uniform(0.02, 0.06))
                found = subprocess.run(["pgrep", "-P", str(process.pid), "-f", "worker"], stdout=subprocess.PIPE, text=True)
                workers = found.stdout.split()
                if workers:
                    with self.lost_race():
                        os.kill(int(random.choice(workers)), signal.SIGKILL)
                        kills += 1
            process.kill()
            process.wait()
            kills += 1
            if (self.dir / "killed/summary.json").exists():  # begin anew, so that the kills hit something
                self.same_outcome("jobs1", "killed")
                subprocess.run(["rm", "-r", "killed"], cwd=self.dir, check=True)
        self.expect(0, "study", "s.toml", "-o", "killed")
        return True

    class lost_race:
        def __enter__(self):
            return self

        def __exit__(self, kind, value, trace):
            return kind is ProcessLookupError


if __name__ == "__main__":
    unittest.main()
