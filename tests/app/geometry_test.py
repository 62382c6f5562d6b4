"""Geometry from real data, end to end: check, cut, run and plot of each kind; bad files. Usage: geometry_test.py EDDA"""
import csv
import json
import math
import pathlib
import re
import shutil
import unittest

from program import Program

BASE = """[materials.rock]
density = 2600
young = "5 GPa"
poisson = 0.25
[joints.rough]
friction_angle = 35
[joints.bedding]
friction_angle = 25
[contact]
joint = "rough"
[solver]
duration = 0.002
"""
DOMAIN = "[domain]\noutline = [[0, 0], [30, 0], [30, 20], [0, 20]]\n"
BOTTOM = '[[boundary]]\nsides = ["bottom"]\n'
SETS = "[[joint_set]]\nangle = 17\nspacing = 2\n[[joint_set]]\nangle = 77\nspacing = 2.3\n"

SLOPE = BASE + SETS + """[slope]
toe = [20, 5]
height = 12
face_angle = 65
base_y = 0
extent = [0, 50]
benches = 2
bench_width = 3
""" + BOTTOM
SHAPES = BASE + SETS + "[domain]\noutline = [[-40, -12], [40, -12], [40, 16], [-40, 16]]\n" + BOTTOM + """
[[opening]]
shape = { kind = "arch", at = [-30, -4], width = 10, height = 8 }
[[opening]]
shape = { kind = "circle", at = [-12, 0], width = 9 }
[[opening]]
shape = { kind = "rectangle", at = [7, -4], width = 8, height = 6 }
[[opening]]
shape = { kind = "horseshoe", at = [27, -4], width = 10, height = 10 }
"""
MAPPED = BASE + DOMAIN + BOTTOM + """[section]
azimuth = 90
[[joint_set]]
name = "J1"
dip = 60
dip_direction = 250
spacing = 1.5
trace_length = 10
gap = 1
deviation = { angle = 4, spacing = 0.4, trace_length = 3, gap = 0.5 }
seed = 7
[[joint_set]]
name = "J2"
dip = 30
dip_direction = 80
spacing = 2
trace_length = 12
gap = 1
deviation = { angle = 5, distribution = "normal" }
seed = 7
"""
NETWORK = BASE + DOMAIN + BOTTOM + """[[fracture_network]]
p21 = 1.0
angle = { mean = 60, deviation = 8 }
length = { mean = 10, deviation = 4 }
seed = 3
[[fracture_network]]
count = 60
angle = { mean = -20, deviation = 30, distribution = "uniform" }
length = { distribution = "power", exponent = 2.2, min = 4, max = 40 }
"""
VORONOI = BASE + DOMAIN + BOTTOM + "[voronoi]\nsize = 2\nseed = 5\n"
REGION = BASE.replace("[joints.rough]", '[materials.weak]\ndensity = 2000\nyoung = "1 GPa"\npoisson = 0.3\n[joints.rough]') + SETS + \
    DOMAIN + 'material = "rock"\n' + BOTTOM + """
[[region]]
material = "weak"
polygon = [[-5, 8], [45, 12], [45, 16], [-5, 11]]
[[contact_pair]]
between = ["rock", "weak"]
joint = "bedding"
"""
ARCH = BASE + """[[arch]]
radius = 5
thickness = 0.8
count = 15
[[block]]
fixed = true
polygon = [[4.4, -1], [5.6, -1], [5.6, 0], [4.4, 0]]
[[block]]
fixed = true
polygon = [[-5.6, -1], [-4.4, -1], [-4.4, 0], [-5.6, 0]]
"""
GEO = BASE + '[[import]]\nfile = "squares.geo"\nlayers = { 1 = "rough", 2 = "bedding" }\n'
SQUARES = "0.01\n5 4\n0\n0\n1\n0 0 0\n0 0 2 0 1\n2 0 2 1 1\n2 1 0 1 1\n0 1 0 0 1\n1 0 1 1 2\n0.2 0.5 0.8 0.5\n"
DXF = BASE + DOMAIN + BOTTOM + '[[import]]\nfile = "d.dxf"\nunits = "mm"\n'


def entity(name, layer, *pairs):
    return f"0\n{name}\n8\n{layer}\n" + "".join(f"{code}\n{value}\n" for code, value in pairs)


DRAWING = "0\nSECTION\n2\nENTITIES\n" + \
    entity("LINE", "bedding", (10, -1000), (20, 5000), (11, 31000), (21, 7000)) + \
    entity("LWPOLYLINE", "J1", (90, 3), (70, 0), (10, 5000), (20, -100), (42, 0.3), (10, 12000), (20, 9000), (10, 16000), (20, 21000)) + \
    entity("TEXT", "notes", (1, "hello")) + "0\nENDSEC\n0\nEOF\n"


class Geometry(Program):
    def edda(self, *args, code=0, **more):
        done = super().edda(*args, **more)
        self.assertEqual(done.returncode, code, " ".join(args) + "\n" + done.stdout + done.stderr)
        return done

    def write(self, text, name="m.toml"):
        (self.dir / name).write_text(text)

    def through_all(self, text):
        """check, cut with a picture, run, plot; the cut's corners by block, and the summary."""
        self.write(text)
        self.edda("check", "m.toml")
        report = self.edda("cut", "m.toml", "-o", "c.png").stdout
        self.assertGreater((self.dir / "c.png").stat().st_size, 1000)
        self.edda("cut", "m.toml", "-o", "c.csv")
        blocks = {}
        with open(self.dir / "c.csv", newline="") as file:
            for row in csv.DictReader(file):
                blocks.setdefault(row["block"], []).append(row)
        self.edda("run", "m.toml", "-o", "out", "--quiet")
        self.edda("plot", "out", "-o", "p.png")
        summary = json.loads((self.dir / "out/summary.json").read_text())
        self.assertEqual(summary["status"], "completed")
        self.assertEqual(summary["blocks"], len(blocks))
        # The written model cuts into the same blocks.
        shutil.copy(self.dir / "out/model.toml", self.dir / "again.toml")
        self.edda("cut", "again.toml", "-o", "again.csv")
        self.assertEqual((self.dir / "again.csv").read_text(), (self.dir / "c.csv").read_text())
        return blocks, summary, report

    def area(self, report):
        return float(next(line for line in report.splitlines() if line.startswith("blocks")).split()[-2])

    def test_slope(self):
        _, _, report = self.through_all(SLOPE)
        face = 12 / math.tan(math.radians(65))
        crest = 20 + face + 3
        expected = 50 * 5 + (50 - crest) * 12 + face * 6 + 3 * 6
        self.assertAlmostEqual(self.area(report), expected, delta=1e-2)

    def test_shapes(self):
        _, _, report = self.through_all(SHAPES)
        self.assertIn("inside openings", report)

    def test_mapped_joints(self):
        blocks, _, report = self.through_all(MAPPED)
        self.assertGreater(len(blocks), 40)
        self.assertAlmostEqual(self.area(report), 600.0, delta=1e-3)

    def test_fracture_network(self):
        _, _, report = self.through_all(NETWORK)
        self.assertIn("60 fractures", report)
        reached = next(line for line in report.splitlines() if "fracture network: " in line).split(", ")[-1]
        self.assertAlmostEqual(float(reached.split()[0]), 1.0, delta=0.02)

    def test_voronoi(self):
        blocks, _, _ = self.through_all(VORONOI)
        self.assertGreater(len(blocks), 140)

    def test_region_and_pair(self):
        blocks, _, _ = self.through_all(REGION)
        self.assertEqual({rows[0]["material"] for rows in blocks.values()}, {"rock", "weak"})
        material = {block: rows[0]["material"] for block, rows in blocks.items()}
        with open(self.dir / "out/joints.csv", newline="") as file:
            contacts = list(csv.DictReader(file))
        mixed = [c for c in contacts if material[c["block_i"]] != material[c["block_j"]]]
        self.assertGreater(len(mixed), 20)
        self.assertEqual({c["joint"] for c in mixed}, {"bedding"})
        self.assertEqual({c["joint"] for c in contacts if c not in mixed}, {"rough"})
        tables = {c["table"] for c in contacts}
        self.assertEqual({t.split(".")[0] for t in tables}, {"joint_set", "region"})

    def test_arch(self):
        blocks, _, _ = self.through_all(ARCH)
        self.assertEqual(len(blocks), 17)

    def test_geo(self):
        self.write(SQUARES, "squares.geo")
        blocks, summary, report = self.through_all(GEO)
        self.assertEqual(len(blocks), 2)
        self.assertIn("2 (1 fixed)", report)
        self.assertEqual([pathlib.Path(i["file"]).name for i in summary["inputs"]], ["m.toml", "squares.geo"])

    def test_drawing(self):
        self.write(DRAWING, "d.dxf")
        blocks, _, report = self.through_all(DXF)
        self.assertEqual(len(blocks), 4)
        self.assertIn("left out: 1 TEXT", report)

    def test_rounded_traces_and_what_nearly_meets(self):
        # A fault and joints that end on it, to 1 mm; the last one stops 5 mm above it.
        self.write("FID,START_X,START_Y,END_X,END_Y\n1,0,3.333,30,13.333\n2,7.7,5.9,7.7,20\n3,15.1,8.366,15.1,20\n"
                   "4,23.1,11.038,23.1,20\n", "t.csv")
        blocks, _, report = self.through_all(BASE + DOMAIN + BOTTOM + '[[import]]\nfile = "t.csv"\n')
        self.assertEqual(len(blocks), 4)
        self.assertIn('left out: 1 column "FID"', report)
        self.assertIn("import.0: 2 corners moved by up to 0.00", report)
        for command in (("check", "m.toml"), ("run", "m.toml", "-o", "again")):
            done = self.edda(*command)
            self.assertIn("import.0: 1 end of its lines stops in the rock less than 0.005 m short", done.stdout + done.stderr)
        self.assertIn("blocks           5 ", self.edda("cut", "m.toml", "--set", "import.0.snap=0.005").stdout)
        message = self.edda("cut", "m.toml", "--set", "import.0.snap=1", code=2).stderr
        self.assertIn("1 m is too coarse for a domain of 30 m: give at most 0.3", message)

    def test_sets_that_lose_much_of_their_length(self):
        self.write(BASE + DOMAIN + BOTTOM + """[[joint_set]]
name = "bed"
angle = 0
spacing = 1
[[joint_set]]
name = "cross"
angle = 90
spacing = 2
trace_length = 1.8
gap = 0.2
""")
        for command in (("check", "m.toml"), ("run", "m.toml", "-o", "again")):
            done = self.edda(*command)
            self.assertRegex(done.stdout + done.stderr, r"joint_set.cross: [\d.]+ m of its [\d.]+ m end inside blocks")
        bound = self.edda("cut", "m.toml", "--set", 'joint_set.cross={angle=90, spacing=2, bounded_by="bed", stagger=1}')
        self.assertIn("blocks           310 ", bound.stdout)
        for wrong, message in (('"bad"', 'did you mean "bed"?'), ('"cross"', "no other joint set is called")):
            done = self.edda("cut", "m.toml", "--set", f"joint_set.cross={{name=\"cross\", angle=90, spacing=2, bounded_by={wrong}}}", code=2)
            self.assertIn(message, done.stderr)

    def test_walls_drawn_with_mortar(self):
        stones = "".join(f"[[block]]\nfixed = {'true' if y < 0 else 'false'}\npolygon = [[0, {y}], [1, {y}], [1, {y + 0.99}], [0, {y + 0.99}]]\n"
                         for y in (-1, 0, 1))
        self.write(BASE + stones + '[fos]\nvary = "kh"\n')
        self.assertIn("close_gaps: 4 edges of 3 blocks moved by up to 0.005 m",
                      self.edda("check", "m.toml", "--set", "contact.close_gaps=0.01").stdout)
        done = self.edda("limit", "m.toml", "--set", "contact.close_gaps=10 mm")
        self.assertIn("kh 0.50", done.stdout)

    def test_seeds(self):
        self.write(MAPPED)
        texts = []
        for seed in ("7", "7", "8"):
            self.edda("cut", "m.toml", "--set", f"joint_set.J1.seed={seed}", "-o", "c.csv")
            texts.append((self.dir / "c.csv").read_text())
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])

    def test_slivers(self):
        text = BASE + DOMAIN + SETS + "[[joint_set]]\nangle = 137\nspacing = 2.1\n" + BOTTOM
        self.write(text)
        slivers = ["--set", "quality.min_edge=0.1", "--set", "quality.min_area=0.05"]
        first = self.edda("cut", "m.toml", *slivers, "--set", "quality.action=report").stdout
        stay = int(first.split("; ")[-1].split()[0]) if "; " in first else 0
        self.assertGreater(stay, 3)
        # All joints run through: nothing is merged.
        kept = self.edda("cut", "m.toml", *slivers).stdout
        self.assertRegex(kept, rf"quality +0 slivers joined to a neighbour, 0 m2 in all; {stay} stay")
        self.assertEqual(len(re.findall(r"(?m)^sliver +stays: [\d.e-]+ m2 at \(", kept)), stay)
        # Traces that end on one another: the poor blocks that they leave are merged.
        self.write(text.replace("spacing = 2.1\n", "spacing = 2.1\ntrace_length = 7\ngap = 1\n"))
        merged = self.edda("cut", "m.toml", *slivers).stdout
        count = int(re.search(r"quality +(\d+) sliver", merged)[1])
        self.assertGreater(count, 0)
        line = r"(?m)^sliver +merged: [\d.e-]+ m2 at \(.*\); joint_set\.\d lost a face of [\d.e-]+ m$"
        self.assertEqual(len(re.findall(line, merged)), count)
        self.assertEqual(self.area(first), self.area(merged))
        checked = json.loads(self.edda("check", "m.toml", "--json", *slivers).stdout)
        self.assertEqual(len(checked["merged_slivers"]), count)
        self.write(text)
        fault = self.edda("cut", "m.toml", *slivers, "--set", "quality.action=error", code=2).stderr
        self.assertEqual(len(fault.strip().splitlines()), 1)
        self.assertIn("quality.min_area", fault)

    def test_bad_files(self):
        for name, text, part in [
            ("squares.geo", "nonsense", "squares.geo:1:1: "),
            ("squares.geo", SQUARES.replace("5 4", "500 4"), "squares.geo:2:1: "),
            ("squares.geo", SQUARES.replace("0.2 0.5 0.8 0.5", "9 9 9 9"), "meets no block"),
            ("d.dxf", DRAWING[:90], "d.dxf:"),
            ("d.dxf", "\x00\x01\x02", "not a group code"),
            ("d.dxf", "", "no section of entities"),
        ]:
            self.write(text, name)
            self.write(GEO if name == "squares.geo" else DXF)
            for command in ("check", "cut", "run"):
                done = self.edda(command, "m.toml", code=2)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
                self.assertIn(part, done.stderr)
            (self.dir / name).unlink()
            self.assertIn("no such file", self.edda("check", "m.toml", code=2).stderr)
        self.assertFalse((self.dir / "m").exists())

    def test_bad_entities(self):
        self.write(DRAWING.replace("5000\n", "x\n", 1), "d.dxf")
        self.write(DXF)
        for command in (("check", "m.toml"), ("run", "m.toml", "-o", "out")):
            done = self.edda(*command)
            self.assertIn('1 part of the drawing has a fault and is left out; d.dxf, line 12: "x" is not a length',
                          done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
