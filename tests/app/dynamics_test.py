"""Ground motion, moving and viscous boundaries and bolts, end to end: what is written, and the same bytes after a stop and with
any number of threads. Usage: dynamics_test.py EDDA"""
import json
import unittest

from program import Program, content

MODEL = """
[materials.rock]
density = 2600.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 25.0
[[block]]
name = "floor"
fixed = true
polygon = [[-20, -1], [20, -1], [20, 0], [-20, 0]]
[[brick_wall]]
columns = 4
rows = 5
brick = [1.0, 0.5]
[[boundary]]
name = "far"
along = [[4, 0], [4, 2.5]]
type = "viscous"
[[boundary]]
name = "ram"
along = [[0, 2.0], [0, 2.5]]
type = "velocity"
velocity = [0.05, 0.0]
stiffness = 1e8
[[boundary]]
name = "load"
along = [[0, 2.5], [4, 2.5]]
type = "stress"
traction = [0, -2e4]
history = "push.csv"
[[shaking]]
name = "quake"
acceleration = "quake.csv"
scale = 2.0
[[shaking]]
acceleration = { amplitude = 0.5, frequency = 8.0, direction = [0, 1] }
apply = "inertia"
[[shaking]]
acceleration = { amplitude = 1.0, frequency = 5.0 }
apply = "upgoing"
[[bolt]]
name = "B"
from = [1.3, 2.4]
to = [1.6, -0.8]
diameter = 0.02
yield_stress = 300e6
rupture_strain = 0.02
bond = { stiffness = 2e8, strength = 3e4 }
dowel = { stiffness = 2e7, strength = 1e4 }
[[bolt]]
name = "D"
from = [3.3, 2.4]
to = [3.5, -0.8]
diameter = 0.02
yield_stress = 300e6
rupture_strain = 0.05
bond = { stiffness = 2e8, strength = 3e4 }
dowel = { bearing_strength = 1e6 }
[[bolt]]
type = "end"
from = [2.7, 2.4]
to = [2.7, -0.5]
diameter = 0.02
pretension = 2e4
[solver]
duration = 0.4
[output]
every = 0.1
history_every = 0.01
checkpoint_every = 0.0005
"""


class Dynamics(Program):
    def setUp(self):
        super().setUp()
        (self.dir / "m.toml").write_text(MODEL)
        (self.dir / "push.csv").write_text("time,factor\n0,0\n0.2,1\n0.5,-1\n")
        (self.dir / "quake.csv").write_text("time,ax,ay\n0,0,0\n0.1,1.5,0.4\n0.2,-2,-0.3\n0.3,0,0\n")

    def test_tables_and_books(self):
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r")
        summary = json.loads((self.dir / "r/summary.json").read_text())
        self.assertEqual(summary["status"], "completed")
        self.assertLess(abs(summary["energy"]["drift"]), 1e-3)
        reactions = self.rows("r/reactions.csv")
        self.assertEqual(list(reactions[0]), ["time", "far.fx", "far.fy", "ram.fx", "ram.fy", "load.fx", "load.fy"])
        self.assertEqual([r["time"] for r in reactions], [r["time"] for r in self.rows("r/history.csv")])
        self.assertAlmostEqual(float(reactions[20]["load.fy"]), -8e4, delta=1.0)
        bolts = self.rows("r/bolts.csv")
        self.assertEqual(list(bolts[0]), "time bolt distance x y axial_force bond_force dowel_force utilisation yielded"
                                         " ruptured dowel_utilisation dowel_angle".split())
        self.assertEqual(sorted({r["bolt"] for r in bolts}), ["2", "B", "D"])
        turned = [r for r in bolts if r["bolt"] == "D" and float(r["dowel_angle"]) != 0.0]
        self.assertAlmostEqual(max(float(r["dowel_utilisation"]) for r in turned), 1.0, delta=1e-4)
        self.assertEqual(sorted({float(r["time"]) for r in bolts}), [0.0, 0.1, 0.2, 0.3, 0.4])
        self.assertEqual(float(bolts[-1]["axial_force"]), float(bolts[-2]["axial_force"]))
        for row in self.rows("r/bolt_summary.csv"):
            of = [r for r in bolts if r["bolt"] == row["bolt"]]
            largest = max(of, key=lambda r: abs(float(r["axial_force"])))
            self.assertEqual([row[c] for c in ("largest_force", "time", "distance", "x", "y")],
                             [largest[c] for c in ("axial_force", "time", "distance", "x", "y")])
            end = [r for r in of if r["time"] == bolts[-1]["time"]]
            for column in ("axial_force", "bond_force", "dowel_force", "utilisation", "dowel_utilisation"):
                self.assertEqual(row[column], max((r[column] for r in end), key=lambda cell: abs(float(cell))), column)
            self.assertEqual(row["yielded"], max(r["yielded"] for r in end))
            self.assertEqual(row["largest_dowel_force"], max((r["dowel_force"] for r in of), key=lambda cell: abs(float(cell))))
        self.assertEqual([r["bolt"] for r in self.rows("r/bolt_summary.csv")], list(dict.fromkeys(r["bolt"] for r in bolts)))
        start = [r for r in bolts if r["bolt"] == "2" and float(r["time"]) == 0.0]
        self.assertAlmostEqual(float(start[0]["axial_force"]), 2e4, delta=1e-6)

    def test_check_reports_them(self):
        out = self.expect(0, "check", "m.toml").stdout
        for part in ("shaking quake: time, ax and ay in m/s2, 4 rows to 0.3 s, peak", "its velocity ends at", "sine of 1 m/s2 and 5 Hz", "3 bolts of"):
            self.assertIn(part, out)

    def test_bytes_do_not_depend_on_threads_or_stops(self):
        self.expect(0, "run", "m.toml", "--quiet", "-o", "one", "--threads", "1")
        whole = content(self.dir / "one")
        self.expect(0, "run", "m.toml", "--quiet", "-o", "three", "--threads", "3")
        self.assertEqual(content(self.dir / "three"), whole)
        self.assertEqual(self.stop_early(), 130)
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r", "--resume", "--threads", "2")
        self.assertEqual(content(self.dir / "r"), whole)

    def test_a_run_goes_on_from_the_model_in_its_folder(self):
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r")
        history = (self.dir / "r/history.csv").read_bytes()
        again = ("run", "r/model.toml", "--quiet", "-o", "r")
        self.assertIn("the model file lies in it", self.expect(2, *again).stderr)
        self.expect(0, *again, "--resume", "--set", "solver.duration=0.5")
        self.assertTrue((self.dir / "r/history.csv").read_bytes().startswith(history))

    def test_resume_wants_the_same_record(self):
        self.assertEqual(self.stop_early(), 130)
        (self.dir / "quake.csv").write_text("time,ax,ay\n0,0,0\n0.1,1.5,0.5\n0.2,-2,-0.3\n0.3,0,0\n")
        self.assertIn("the model is not the one", self.expect(2, "run", "m.toml", "-o", "r", "--resume").stderr)

    def test_what_hits_nothing_is_refused(self):
        for old, new, key in (("along = [[4, 0], [4, 2.5]]", "along = [[5, 0], [5, 2.5]]", "boundary.far"),
                              ("along = [[0, 2.5], [4, 2.5]]", "along = [[0, 3], [4, 3]]", "boundary.load"),
                              ("from = [1.3, 2.4]\nto = [1.6, -0.8]", "from = [9, 2.4]\nto = [9, 1]", "bolt.B"),
                              ("from = [2.7, 2.4]", "from = [2.7, 2.6]", "bolt.2"),
                              ("bearing_strength = 1e6", "foundation_modulus = 1e9", "bolt.D.dowel.bearing_strength")):
            (self.dir / "bad.toml").write_text(MODEL.replace(old, new))
            done = self.expect(2, "check", "bad.toml")
            self.assertIn(key, done.stderr)


if __name__ == "__main__":
    unittest.main()
