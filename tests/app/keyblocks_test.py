"""edda keyblocks, end to end: what it prints, writes and refuses. Usage: keyblocks_test.py EDDA"""
import json
import math
import unittest

from program import Program, read_rows

# A roof wedge between two fixed blocks, and a slab on a plane of 35 degrees to the left.
MODEL = """
[materials.rock]
density = 2500
young = "10 GPa"
poisson = 0.25
[joints.j]
friction_angle = 30
[[block]]
fixed = true
polygon = [[-9, 10], [-2.5, 10], [-1.5, 12], [-9, 12]]
[[block]]
fixed = true
polygon = [[9, 10], [9, 12], [1.5, 12], [2.5, 10]]
[[block]]
name = "wedge"
polygon = [[-2.5, 10], [2.5, 10], [1.5, 12], [-1.5, 12]]
[[block]]
fixed = true
polygon = [[0, 0], [10, 0], [10, 7.002075]]
[[block]]
name = "slab"
polygon = [[2, 1.400415], [5, 3.501038], [4.426424, 4.320190], [1.426424, 2.219567]]
"""


class KeyBlocks(Program):
    def test_writes_every_file_of_the_promise(self):
        (self.dir / "m.toml").write_text(MODEL)
        done = self.expect(0, "keyblocks", "m.toml")
        files = {"summary.json", "columns.csv", "keyblocks.csv", "keyblocks.png", "keyblocks.svg", "model.toml"}
        self.assertEqual({p.name for p in (self.dir / "m-keyblocks").iterdir()}, files)
        wedge, slab = read_rows(self.dir / "m-keyblocks/keyblocks.csv")
        self.assertEqual((wedge["name"], wedge["class"], wedge["mode"]), ("wedge", "key", "falls"))
        self.assertAlmostEqual(float(wedge["support"]), 2500 * 9.81 * 8, delta=1)
        self.assertEqual((slab["name"], slab["class"], slab["mode"], slab["joints"]), ("slab", "key", "slides", "j"))
        exact = math.tan(math.radians(30)) / math.tan(math.radians(35))
        self.assertAlmostEqual(float(slab["factor"]), exact, delta=1e-5)
        summary = json.loads((self.dir / "m-keyblocks/summary.json").read_text())
        self.assertEqual((summary["key"], summary["held"], summary["generations"]), (2, 0, 1))
        self.assertEqual(done.stdout.splitlines()[0], summary["message"])
        self.assertIn("falls", done.stdout)

    def test_the_factor_asked_for(self):
        (self.dir / "m.toml").write_text(MODEL)
        steep = self.expect(0, "keyblocks", "m.toml", "--set", "joints.j.friction_angle=40", "--quiet")
        self.assertTrue(steep.stdout.startswith("1 key block of 8 m2"), steep.stdout)
        safer = self.expect(0, "keyblocks", "m.toml", "--set", "joints.j.friction_angle=40", "--factor", "1.3", "--json")
        self.assertEqual(json.loads(safer.stdout)["key"], 2)

    def test_bad_input(self):
        (self.dir / "m.toml").write_text("gravity = [0, 0]\n" + MODEL)
        self.assertIn("m.toml", self.expect(2, "keyblocks", "m.toml").stderr)
        self.expect(2, "keyblocks", "m.toml", "--factor", "-1")
        self.expect(2, "keyblocks", "none.toml")
        self.assertFalse((self.dir / "m-keyblocks").exists())


if __name__ == "__main__":
    unittest.main()
