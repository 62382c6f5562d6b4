"""Stress in the ground at the start, end to end: what is printed and written, and the same bytes after a stop and with
any number of threads. Usage: stress_test.py EDDA"""
import json
import unittest

from program import Program, content

MODEL = """
[materials.rock]
density = 2700.0
young = 20e9
poisson = 0.25
strength = { ucs = "60 MPa", tension = "4 MPa" }
[joints.j]
friction_angle = 35.0
cohesion = 2e6
tensile_strength = 1e6
[domain]
outline = [[-10, -10], [10, -10], [10, 10], [-10, 10]]
[[joint_set]]
angle = 25.0
spacing = 1.6
[[joint_set]]
angle = 110.0
spacing = 1.9
[[opening]]
name = "tunnel"
shape = { kind = "circle", at = [0, 0], width = 4.0, segments = 24 }
[[boundary]]
name = "sides"
sides = ["left", "right", "bottom"]
type = "roller"
[[boundary]]
name = "top"
sides = ["top"]
type = "stress"
[[water]]
table = [[-10, 4], [10, 4]]
[initial_stress]
stress = [-6e6, -5e6, 0]
gradient = [2e4, 26487.0, 0.0]
[[convergence]]
name = "H1"
between = [[-2.0, 0.0], [2.0, 0.0]]
[[convergence]]
name = "V1"
between = [[0.0, -2.0], [0.0, 2.0]]
[[stage]]
name = "rest"
until = "equilibrium"
ratio = 1e-3
duration = 0.5
[[stage]]
name = "after"
duration = 0.002
reset_displacements = true
[output]
every = 0.01
history_every = 0.001
checkpoint_every = 0.0005
"""


class Stress(Program):
    seconds = 240

    def setUp(self):
        super().setUp()
        (self.dir / "m.toml").write_text(MODEL)

    def test_check_compares_the_stress_with_weight_and_joints(self):
        out = self.expect(0, "check", "m.toml").stdout
        for part in ("syy increases by 26487 Pa per metre upwards; density times gravity of rock is 26487",
                     "joint j: largest tau/sigma_n", "the mean unbalanced force is", "convergence     H1 from block"):
            self.assertIn(part, out)
        self.assertNotIn("gradient and the weight", out)
        flat = self.expect(0, "check", "m.toml", "--set", "initial_stress.gradient=[0, 2e4, 0]").stdout
        self.assertIn("its gradient and the weight of rock differ by 24 %", flat)
        self.assertIn("give syy a gradient of 26487", flat)
        weak = self.expect(0, "check", "m.toml", "--set", "joints.j.cohesion=0", "--set", "joints.j.friction_angle=2").stdout
        self.assertIn("the shear stress exceeds the strength of joint j", weak)
        torn = self.expect(0, "check", "m.toml", "--set", "initial_stress.stress=[3e6, -5e6, 0]").stdout
        self.assertIn("in more tension than its strength", torn)

    def test_tables_and_checks(self):
        done = self.expect(0, "run", "m.toml", "-o", "r")
        self.assertIn("initial stress: joint j: largest tau/sigma_n", done.stderr)
        summary = json.loads((self.dir / "r/summary.json").read_text())
        self.assertEqual(summary["status"], "completed")
        checks = {c["name"]: c for c in summary["checks"]}
        self.assertTrue(checks["initial stress: gradient against density times gravity"]["pass"])
        self.assertTrue(checks["initial stress: part of joint j over its strength"]["pass"])
        # The tunnel's wall is free: unbalanced behind it, and nowhere else.
        self.assertGreater(checks["initial stress: unbalanced forces at the start"]["value"], 1e-3)
        self.assertLess(checks["initial stress: unbalanced forces within the ground"]["value"], 1e-6)
        self.assertIn("initial stress: largest tau over strength of joint j", checks)
        used = checks["largest part of the rock's strength used in a block"]["value"]
        blocks = self.rows("r/blocks.csv")
        self.assertEqual(list(blocks[0])[-1], "overstress")
        self.assertAlmostEqual(used, max(float(b["overstress"]) for b in blocks), delta=1e-6)
        self.assertGreater(used, 1e-3)
        history, stages = self.rows("r/history.csv"), self.rows("r/stages.csv")
        self.assertEqual(list(stages[0])[-2:], ["H1.convergence", "V1.convergence"])
        self.assertGreater(float(stages[0]["H1.convergence"]), 1e-4)
        self.assertGreater(float(stages[0]["V1.convergence"]), 1e-4)
        end = [r for r in history if r["time"] == stages[0]["end"]]
        self.assertEqual(end[0]["V1.convergence"], stages[0]["V1.convergence"])
        # Reset in the second stage.
        self.assertLess(abs(float(stages[1]["V1.convergence"])), 0.05 * float(stages[0]["V1.convergence"]))
        self.expect(0, "plot", "r", "--field", "overstress", "-o", "p.png")

    def test_bytes_do_not_depend_on_threads_or_stops(self):
        self.expect(0, "run", "m.toml", "--quiet", "-o", "one", "--threads", "1")
        whole = content(self.dir / "one")
        self.expect(0, "run", "m.toml", "--quiet", "-o", "three", "--threads", "3")
        self.assertEqual(content(self.dir / "three"), whole)
        self.assertEqual(self.stop_early(), 130)
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r", "--resume", "--threads", "2")
        self.assertEqual(content(self.dir / "r"), whole)


if __name__ == "__main__":
    unittest.main()
