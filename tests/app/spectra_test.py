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


if __name__ == "__main__":
    unittest.main()
