"""edda spectra end to end: what it prints, writes and refuses. Usage: spectra_test.py EDDA"""
import csv
import math
import unittest

from program import Program, read_rows

# A block that is glued to a base, which shakes for two seconds after one at rest.
MODEL = """
title = "Glued"
[materials.rock]
density = 2500.0
young = 5e9
poisson = 0.2
[joints.j]
type = "glued"
[[block]]
fixed = true
polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]
[[block]]
polygon = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[monitor]]
name = "base"
point = [0.5, -0.5]
[[monitor]]
name = "block"
point = [0.5, 0.25]
[[shaking]]
name = "quake"
acceleration = "record.csv"
[[stage]]
until = "equilibrium"
duration = 1.0
[[stage]]
name = "earthquake"
duration = 2.0
activate = ["quake"]
reset_displacements = true
damping = { contact = 0.3 }
[output]
history_every = "record"
every = 0.5
"""
W = 2.0 * math.pi * 2.0
RECORD = "time,ax,ay\n" + "".join(f"{0.01 * k:.2f},{3.0 * math.sin(W * 0.01 * k):.17g},0\n" for k in range(201))


class Spectra(Program):
    def run_model(self, text=MODEL):
        (self.dir / "m.toml").write_text(text)
        (self.dir / "record.csv").write_text(RECORD)
        self.expect(0, "run", "m.toml", "--quiet")

    def test_measures_spectra_and_amplification(self):
        self.run_model()
        done = self.expect(0, "spectra", "m", "--between", "base,block", "-o", "s", "--periods", "0.1,5,40")
        self.assertIn("stage 2, earthquake", done.stdout)
        motions = {(r["monitor"], r["direction"]): r for r in read_rows(self.dir / "s/motions.csv")}
        self.assertEqual(len(motions), 6)
        base = motions["base", "x"]
        self.assertEqual(base["stage"], "2")
        self.assertAlmostEqual(float(base["peak_acceleration"]), 3.0, delta=1e-2)
        # v = A/w (1 - cos wt), u = A/w (t - sin(wt)/w)
        self.assertAlmostEqual(float(base["peak_velocity"]), 6.0 / W, delta=2e-3)
        self.assertAlmostEqual(float(base["permanent_displacement"]), 3.0 / W * 2.0, delta=2e-3)
        self.assertAlmostEqual(float(base["arias"]), math.pi / (2 * 9.80665) * 4.5 * 2.0, delta=1e-2)
        self.assertAlmostEqual(float(base["arias_duration"]), 1.8, delta=0.05)
        self.assertLess(float(motions["block/base", "x"]["peak_displacement"]), 1e-5)
        rows = read_rows(self.dir / "s/spectra.csv")
        self.assertEqual(len(rows), 2 * 2 * 40)
        self.assertEqual({float(r["period"]) for r in rows} >= {0.1, 5.0}, True)
        # Four cycles at resonance: S = A (1 - exp(-zeta w t))/(2 zeta).
        most = max(float(r["pseudo_acceleration"]) for r in rows if (r["monitor"], r["direction"]) == ("base", "x"))
        self.assertAlmostEqual(most, 3.0 * (1 - math.exp(-0.05 * W * 2.0)) / 0.1, delta=1.5)
        for row in read_rows(self.dir / "s/amplification.csv"):
            if row["direction"] == "x" and float(row["period"]) > 0.2:
                self.assertAlmostEqual(float(row["amplification"]), 1.0, delta=0.02)
            if row["direction"] == "y":
                self.assertEqual(row["amplification"], "")
        relative = read_rows(self.dir / "s/relative.csv")
        self.assertEqual(list(relative[0]), ["stage", "time", "ux", "uy"])
        self.assertGreater(len(relative), 200)
        with open(self.dir / "s/columns.csv", newline="", encoding="utf-8") as table:
            listed = {row["file"] for row in csv.DictReader(table)}
        self.assertEqual(listed, {"motions.csv", "spectra.csv", "amplification.csv", "relative.csv", "columns.csv"})
        for name in ("spectra.png", "spectra.svg", "relative.png", "relative.svg"):
            self.assertGreater((self.dir / "s" / name).stat().st_size, 1000)
        svg = (self.dir / "s/spectra.svg").read_text(encoding="utf-8")
        for text in ("period (s)", "Glued: pseudo-acceleration (PSA), damping 5 %", "amplification", "block/base.x", ">0.1<", ">5<"):
            self.assertIn(text, svg)
        # Once more without a comparison: its tables and pictures go.
        self.expect(0, "spectra", "m", "-o", "s")
        self.assertEqual({p.name for p in (self.dir / "s").iterdir()},
                         {"motions.csv", "spectra.csv", "columns.csv", "spectra.png", "spectra.svg"})

    def test_rows_at_the_interval_of_the_record_and_coarser(self):
        self.run_model()
        self.assertIn("history_every = 0.01\n", (self.dir / "m/model.toml").read_text(encoding="utf-8"))
        done = self.expect(0, "spectra", "m", "--periods", "0.1,5,9")
        self.assertNotIn("rows up to", done.stderr)
        self.assertIn("rows up to 0.01 s apart", self.expect(0, "spectra", "m").stderr)
        self.assertEqual({p.name for p in self.dir.iterdir()}, {"m.toml", "record.csv", "m"})

    def test_a_run_without_ground_motion_is_taken_as_a_whole(self):
        text = MODEL.replace('[[shaking]]\nname = "quake"\nacceleration = "record.csv"\n', "")
        text = text.replace('activate = ["quake"]\n', "").replace('history_every = "record"\n', "")
        self.run_model(text)
        self.assertIn("the whole run, 0 to ", self.expect(0, "spectra", "m").stdout)

    def test_what_it_refuses(self):
        self.run_model()
        for arguments, said in ((["nowhere"], "holds no history.csv"),
                                (["m", "--damping", "100"], "--damping: is not from 0 to below 100"),
                                (["m", "--damping", "nan"], "--damping: is not from 0"),
                                (["m", "--periods", "0,5,9"], "--periods: holds no range"),
                                (["m", "--periods", "1,1,9"], "--periods: holds no range"),
                                (["m", "--periods", "1,inf,9"], "--periods: holds no range"),
                                (["m", "--periods", "1,2,1.5"], "--periods: has no number of periods"),
                                (["m", "--between", "base"], "--between: names no two monitors"),
                                (["m", "--between", "base,base"], "--between: names no two monitors"),
                                (["m", "--between", "base,top"], "name two of base, block"),
                                (["m", "-o", "m"], "holds the results of a run")):
            done = self.expect(2, "spectra", *arguments)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stdout, "")
        text = MODEL
        for name in ("base", "block"):
            at = text.index(f'[[monitor]]\nname = "{name}"')
            text = text[:at] + text[text.index("[[", at + 4):]
        self.run_model(text)
        self.assertIn("holds no monitor", self.expect(2, "spectra", "m").stderr)


ROCK = """
[materials.rock]
density = 2500.0
young = 5e9
poisson = 0.2
[joints.j]
friction_angle = 20.0
[[block]]
fixed = true
polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]
[[monitor]]
name = "base"
point = [0.0, -0.5]
[[monitor]]
name = "block"
point = [0.0, 0.25]
"""


class Accelerations(Program):
    """NAME.ax and NAME.ay: the mean since the row before, in a frame at rest."""

    def rows(self, text, *more):
        (self.dir / "m.toml").write_text(ROCK + text)
        self.expect(0, "run", "m.toml", "--quiet", *more)
        return [{k: float(v) for k, v in row.items()} for row in read_rows(self.dir / "m/history.csv")]

    def block(self, above=0.0, left=-0.5, right=0.5):
        low, high = above, above + 0.5
        return f"[[block]]\npolygon = [[{left}, {low}], [{right}, {low}], [{right}, {high}], [{left}, {high}]]\n"

    def shaken(self, apply, amplitude, more):
        return (f"[[shaking]]\nname = 'quake'\nacceleration = {{ amplitude = {amplitude}, frequency = 2 }}\n"
                f"apply = '{apply}'\n[output]\n" + more)

    def test_of_gravity_in_free_fall_and_none_at_rest(self):
        for method in ("", "method = 'dda'\n"):
            falls = self.rows(self.block(1.0) + "[output]\nhistory_every = 0.02\n[solver]\nduration = 0.2\n" + method,
                              "--set", "monitor.block.point=[0, 1.25]")
            self.assertEqual(falls[0]["block.ay"], 0.0)
            for row in falls[1:]:
                self.assertAlmostEqual(row["block.ay"], -9.81, delta=1e-6)
                self.assertAlmostEqual(row["block.ax"], 0.0, delta=1e-6)
            rest = self.rows(self.block() + "[output]\nhistory_every = 0.05\n[solver]\nduration = 0.5\n"
                             "damping = { mass = 100 }\n" + method)
            self.assertAlmostEqual(rest[-1]["block.ay"], 0.0, delta=5e-3)

    def test_is_the_ground_s_however_it_is_applied(self):
        means = {}
        for apply in ("base", "inertia"):
            rows = self.rows(self.block() + self.shaken(
                apply, 3.0, "history_every = 0.02\n[solver]\nduration = 1\ndamping = { contact = 0.3 }\n"))
            for last, row in zip(rows, rows[1:]):
                exact = 3.0 / W * (math.cos(W * last["time"]) - math.cos(W * row["time"])) / (row["time"] - last["time"])
                self.assertAlmostEqual(row["base.ax"], exact, delta=1e-3)
                if row["time"] > 0.5:
                    self.assertAlmostEqual(row["block.ax"], exact, delta=0.1)
                if apply == "base":  # the acceleration integrates to the velocity
                    self.assertAlmostEqual(row["block.vx"] - last["block.vx"], row["block.ax"] * (row["time"] - last["time"]), delta=1e-12)
            means[apply] = [row["block.ax"] for row in rows if row["time"] > 0.5]
        for a, b in zip(*means.values()):
            self.assertAlmostEqual(a, b, delta=0.05)

    def test_of_a_sliding_block_is_that_of_friction(self):
        """Newmark (1965): mu g, however strong the shaking is."""
        limit = math.tan(math.radians(20.0)) * 9.81
        for apply in ("base", "inertia"):
            rows = self.rows(self.block() + self.shaken(
                apply, 12.0, "history_every = 0.01\n[solver]\nduration = 0.2\n"))
            slides = [row["block.ax"] for row in rows if row["time"] > 0.1]
            self.assertAlmostEqual(sum(slides) / len(slides), limit, delta=0.02 * limit)

    def test_begins_anew_with_each_stage(self):
        """Where a stage deactivates the motion, the velocity of the ground goes at once, which is no acceleration."""
        text = self.block() + self.shaken("base", 3.0, "history_every = 0.01\nevery = 0.05\n"
                                          "[[stage]]\nduration = 0.25\nactivate = ['quake']\n"
                                          "[[stage]]\nduration = 0.1\ndeactivate = ['quake']\n")
        rows = self.rows(text)
        end = max(k for k, row in enumerate(rows) if row["time"] < 0.25 + 1e-9)
        self.assertGreater(rows[end]["base.vx"], 0.4)
        for key in ("base.vx", "base.ax"):
            self.assertAlmostEqual(rows[end + 1][key], 0.0, delta=1e-15)
        before = (self.dir / "m/history.csv").read_bytes()
        self.rows(text, "--from", "1")
        self.assertEqual((self.dir / "m/history.csv").read_bytes(), before)

    def test_an_event_begins_without_the_velocity_that_the_one_before_left(self):
        weak = "[[shaking]]\nname = 'weak'\nacceleration = { amplitude = 0.1, frequency = 2 }\napply = 'base'\n"
        self.rows(self.block() + weak + self.shaken(
            "base", 3.0, "history_every = 0.01\nevery = 0.05\n[[stage]]\nduration = 0.25\nactivate = ['quake']\n"
            "[[stage]]\nduration = 0.5\ndeactivate = ['quake']\nactivate = ['weak']\n"))
        self.expect(0, "spectra", "m", "-o", "s", "--periods", "0.1,3,12")
        base = [r for r in read_rows(self.dir / "s/motions.csv") if (r["monitor"], r["direction"]) == ("base", "x")]
        self.assertEqual([r["stage"] for r in base], ["1", "2"])
        self.assertAlmostEqual(float(base[0]["peak_velocity"]), 6.0 / W, delta=1e-3)
        self.assertAlmostEqual(float(base[1]["peak_velocity"]), 0.2 / W, delta=1e-4)
        self.assertAlmostEqual(float(base[1]["arias"]), math.pi / (2 * 9.80665) * 0.1 ** 2 * 0.25, delta=1e-6)

    def test_goes_on_when_resumed(self):
        text = self.block() + self.shaken("base", 3.0, "every = 0.01\nhistory_every = 0.001\ncheckpoint_every = 1e-9\n[solver]\nduration = 0.01\n")
        first = len(self.rows(text))
        rows = self.rows(text.replace("duration = 0.01", "duration = 0.02"), "--resume")
        self.assertGreater(len(rows), first + 5)
        for last, row in zip(rows, rows[1:]):
            self.assertAlmostEqual(row["base.ax"], (row["base.vx"] - last["base.vx"]) / (row["time"] - last["time"]), delta=1e-9)

    def test_spectra_do_not_depend_on_the_interval_of_rows(self):
        """Blocks that knock at each other: from five rows a period on the spectra are the same."""
        pile = "".join(self.block(y, x, x + 0.49) for x in (-1.0, -0.5, 0.0, 0.5) for y in (0.0, 0.5))
        for x in (-1.5, 1.0):
            pile += self.block(0.0, x, x + 0.49).replace("[[block]]", "[[block]]\nfixed = true")
        self.rows(pile + self.shaken("base", 8.0, "history_every = 0.001\nevery = 1\n[solver]\nduration = 3\n"),
                  "--set", "monitor.block.point=[0.2, 0.75]")
        fine, peaks = self.spectra_of_block()
        self.thin(20)
        coarse, smoothed = self.spectra_of_block()
        self.assertGreater(peaks, 5.0 * smoothed)
        for key, value in fine.items():
            self.assertAlmostEqual(coarse[key], value, delta=0.02 * value, msg=key)

    def spectra_of_block(self):
        """Its spectral and peak acceleration along the shaking."""
        self.expect(0, "spectra", "m", "-o", "s", "--periods", "0.1,3,12")
        of_block = [[r for r in read_rows(self.dir / "s" / name) if (r["monitor"], r["direction"]) == ("block", "x")]
                    for name in ("spectra.csv", "motions.csv")]
        return {r["period"]: float(r["pseudo_acceleration"]) for r in of_block[0]}, float(of_block[1][0]["peak_acceleration"])

    def thin(self, every):
        """Leaves one in so many rows of history.csv, as a run with longer intervals of rows has them."""
        path = self.dir / "m/history.csv"
        with open(path, newline="", encoding="utf-8") as table:
            reader = csv.DictReader(table)
            names, rows = reader.fieldnames, list(reader)[::every]
        for last, row in zip(rows, rows[1:]):
            between = float(row["time"]) - float(last["time"])
            for of in ("base.{}x", "base.{}y", "block.{}x", "block.{}y"):
                row[of.format("a")] = (float(row[of.format("v")]) - float(last[of.format("v")])) / between
        with open(path, "w", newline="", encoding="utf-8") as table:
            writer = csv.DictWriter(table, names)
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    unittest.main()
