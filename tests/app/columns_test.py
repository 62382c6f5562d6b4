"""columns.csv of a results folder against the headers of all its tables, and the page docs/results.md against the program.
Usage: columns_test.py EDDA"""
import csv
import pathlib
import shutil
import unittest

from program import Program, content

SOURCE = pathlib.Path(__file__).resolve().parents[2]
MODEL = """title = "Bolted block"
[materials.rock]
density = 2600.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 25.0
[[block]]
name = "floor"
fixed = true
polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]
[[block]]
name = "slab"
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[block]]
name = "lid"
polygon = [[0, 1], [2, 1], [2, 2], [0, 2]]
[[boundary]]
name = "top"
along = [[0, 2], [2, 2]]
type = "stress"
traction = [1e3, -2e4]
[[boundary]]
along = [[2, 0], [2, 1]]
type = "viscous"
[[bolt]]
name = "B"
from = [1.0, 1.9]
to = [1.2, -0.8]
diameter = 0.02
bond = { stiffness = 2e8, strength = 3e4 }
[[monitor]]
name = "crown"
point = [1.0, 1.5]
[[monitor]]
name = "side, left"
point = [0.1, 0.5]
[[measurement]]
name = "M"
polygon = [[0.4, 0.4], [1.6, 0.4], [1.0, 1.8]]
[[convergence]]
name = "H1"
between = [[0.5, 1.9], [0.5, 0.1]]
[[stage]]
name = "first"
duration = 0.01
[[stage]]
duration = 0.01
[output]
every = 0.01
history_every = 0.002
checkpoint_every = 0.0005
"""
FOS = """[materials.rock]
density = 2750.0
young = 2e8
poisson = 0.25
[joints.ramp]
friction_angle = 15.0
[[block]]
fixed = true
polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]
[[block]]
name = "slider"
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[load]]
name = "push"
point = [0, 0.1]
force = [2000, 0]
[fos]
vary = "load:push"
bracket = [5, 9]
tolerance = 0.1
"""
OF_MONITOR = ("ux", "uy", "vx", "vy", "ax", "ay", "sxx", "syy", "sxy")


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


class Columns(Program):
    def check_folder(self, folder, *files):
        """Every table of the folder has its columns in columns.csv, in the order of its header, and there are no others."""
        head, *rows = table(folder / "columns.csv")
        self.assertEqual(head, ["file", "column", "unit", "meaning"])
        self.assertTrue(all(cell for row in rows for cell in row), rows)
        listed = {}
        for file, column, _, _ in rows:
            listed.setdefault(file, []).append(column)
        written = sorted(p.name for p in folder.glob("*.csv"))
        self.assertEqual(sorted(listed), written)
        self.assertEqual(written, sorted((*files, "columns.csv")))
        for file in written:
            header, *cells = table(folder / file)
            self.assertEqual(listed[file], header, file)
            self.assertEqual(len(set(header)), len(header), file)
            self.assertEqual([row for row in cells if len(row) != len(header)], [], file)
        return {(file, column): (unit, meaning) for file, column, unit, meaning in rows}

    def test_a_run_lists_the_columns_of_its_tables(self):
        (self.dir / "m.toml").write_text(MODEL)
        self.expect(0, "run", "m.toml", "-o", "r", "--quiet")
        tables = ("history.csv", "reactions.csv", "bolts.csv", "stages.csv", "joints_1.csv", "joints_2.csv", "bolt_summary.csv",
                  "blocks.csv", "joints.csv")
        columns = self.check_folder(self.dir / "r", *tables)
        for name in ("crown", "side, left"):
            self.assertEqual([columns["history.csv", f"{name}.{of}"][0] for of in OF_MONITOR],
                             ["m", "m", "m/s", "m/s", "m/s2", "m/s2", "Pa", "Pa", "Pa"])
        self.assertEqual([columns["history.csv", f"M.mean_{of}"][0] for of in ("sxx", "syy", "szz", "sxy", "exx", "eyy", "exy")],
                         ["Pa"] * 4 + ["1"] * 3)
        self.assertEqual(columns["history.csv", "H1.convergence"], columns["stages.csv", "H1.convergence"])
        self.assertEqual([c for f, c in columns if f == "reactions.csv"], ["time", "top.fx", "top.fy", "1.fx", "1.fy"])
        self.assertIn("positive in compression", columns["joints_2.csv", "normal_stress"][1])
        self.assertEqual(columns["joints_2.csv", "normal_stress"], columns["joints.csv", "normal_stress"])
        # A model without all of that, in the same folder.
        (self.dir / "m.toml").write_text(FOS)
        self.expect(0, "run", "m.toml", "-o", "r", "--quiet", "--set", "solver.duration=0.001")
        self.check_folder(self.dir / "r", "history.csv", "blocks.csv", "joints.csv")

    def test_a_run_that_goes_on_ends_with_the_same_list(self):
        (self.dir / "m.toml").write_text(MODEL)
        self.expect(0, "run", "m.toml", "-o", "whole", "--quiet")
        whole = content(self.dir / "whole")
        self.assertEqual(self.stop_early(), 130)
        self.check_folder(self.dir / "r", *[p.name for p in (self.dir / "r").glob("*.csv") if p.name != "columns.csv"])
        (self.dir / "r/columns.csv").unlink()  # as of a run by a version without it
        self.expect(0, "run", "m.toml", "-o", "r", "--quiet", "--resume")
        self.assertEqual(content(self.dir / "r"), whole)
        self.expect(0, "run", "m.toml", "-o", "r", "--quiet", "--from", "1")
        self.assertEqual(content(self.dir / "r"), whole)
        # It belongs to an earlier run.
        (self.dir / "only").mkdir()
        shutil.copy(self.dir / "r/columns.csv", self.dir / "only")
        self.expect(0, "run", "m.toml", "-o", "only", "--quiet")
        self.assertEqual(content(self.dir / "only"), whole)

    def test_a_search_and_a_cut_have_theirs(self):
        (self.dir / "m.toml").write_text(FOS)
        self.expect(0, "fos", "m.toml", "--quiet", "-o", "f")
        columns = self.check_folder(self.dir / "f", "fos.csv", "mechanism.csv", "mechanism_joints.csv")
        self.assertEqual(columns["mechanism.csv", "rotation"][0], "rad")
        self.expect(0, "cut", "m.toml", "-o", "c.csv")
        header = table(self.dir / "c.csv")[0]
        printed = self.expect(0, "columns", "F.csv").stdout.splitlines()
        self.assertEqual([line.split("`")[1] for line in printed if line.startswith("| `")], header)

    def test_one_table_is_printed(self):
        joints = self.expect(0, "columns", "joints").stdout
        self.assertIn("| `normal_stress` | Pa |", joints)
        self.assertEqual(joints.count("## "), 1)
        self.assertIn(joints, self.expect(0, "columns").stdout)
        done = self.expect(2, "columns", "joint")
        self.assertIn('did you mean "joints"', done.stderr)

    def test_normal_stress_has_the_sign_of_normal_force(self):
        (self.dir / "m.toml").write_text(MODEL)
        self.expect(0, "run", "m.toml", "-o", "r", "--quiet")
        pressed = [row for row in self.rows("r/joints.csv") if row["state"] != "open"]
        self.assertGreaterEqual(len(pressed), 2)
        for row in pressed:
            force, length = float(row["normal_force"]), float(row["length"])
            self.assertGreater(force, 0.0)
            self.assertAlmostEqual(float(row["normal_stress"]), force / length, delta=1e-9 * force)
            self.assertGreaterEqual(min(float(row["normal_stress_a"]), float(row["normal_stress_b"])), 0.0)

    def test_the_page_of_results_names_every_file(self):
        (self.dir / "m.toml").write_text(MODEL)
        self.expect(0, "run", "m.toml", "-o", "r", "--quiet")
        page = (SOURCE / "docs/results.md").read_text(encoding="utf-8")
        for path in (self.dir / "r").iterdir():
            name = path.name
            for digit in "12":
                name = name.replace(f"_{digit}.", "_N.")
            self.assertIn(f"`{name}", page)


if __name__ == "__main__":
    unittest.main()
