"""Messages of check and run: on stages, on points in excavated rock, on checks that fail.

  words_test.py EDDA
"""
import json
import re
import subprocess
import unittest

from program import EDDA, Program

TUNNEL = """
[materials.rock]
density = 2700
young = "10 GPa"
poisson = 0.25
[joints.bedding]
friction_angle = 35
[domain]
outline = [[-8, -8], [8, -8], [8, 8], [-8, 8]]
[[joint_set]]
name = "bedding"
angle = 90
spacing = 2.0
origin = [1, 0]
[[opening]]
name = "heading"
shape = { kind = "rectangle", at = [0, 0], width = 3, height = 3 }
[initial_stress]
stress = ["-2 MPa", "-2 MPa", 0.0]
at_y = 0.0
[[boundary]]
name = "rim"
sides = ["left", "right", "top", "bottom"]
type = "fixed"
[[monitor]]
name = "wall"
point = [%s, 0.1]
[[convergence]]
name = "H"
between = [[-%s, 0.1], [1.7, 0.1]]
[[stage]]
name = "in situ"
until = "equilibrium"
[[stage]]
name = "heading"
until = "equilibrium"
excavate = ["heading"]
%s
"""

BLOCK = """
[materials.rock]
density = 2500
young = "1 GPa"
poisson = 0.2
[joints.bed]
friction_angle = 30
[contact]
normal_stiffness = %s
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
fixed = true
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[solver]
duration = 0.5
damping = { local = 0.8 }
"""


class Words(Program):
    def write(self, name, text):
        (self.dir / name).write_text(text, encoding="utf-8")
        return name

    def check(self, model):
        return json.loads(self.expect(0, "check", model, "--json").stdout)

    def test_check_counts_the_steps_of_static_masses(self):
        found = self.check(self.write("static.toml", TUNNEL % (1.7, 1.7, "")))
        self.assertTrue(found["at_most"])
        self.assertAlmostEqual(found["steps"] * found["static_time_step"] / found["duration"], 1.0, delta=0.02)
        self.expect(0, "run", "static.toml", "--quiet")
        summary = json.loads((self.dir / "static/summary.json").read_text())
        self.assertLess(summary["steps"], found["steps"])
        text = self.expect(0, "check", "static.toml").stdout
        self.assertIn("at most", text)
        mixed = self.check(self.write("mixed.toml", TUNNEL % (1.7, 1.7, 'masses = "as given"')))
        self.assertGreater(mixed["steps"], 1.2 * found["steps"])
        timed = self.check(self.write("block.toml", BLOCK % 1e10))
        self.assertFalse(timed["at_most"])
        self.assertNotIn("static_time_step", timed)

    def test_mass_scaling_that_changes_the_motion_is_refused(self):
        pebble = "[[block]]\npolygon = [[0.4, 1], [0.45, 1], [0.45, 1.05], [0.4, 1.05]]\n"
        model = self.write("pebble.toml", BLOCK % 1e10 + pebble)
        refused = self.expect(2, "check", model, "--set", "solver.mass_scaling=0.1").stderr
        self.assertRegex(refused, r"mass_scaling: 0\.1 s adds .* kg of inertia, .* % of the mass of all free blocks, more than 10 %")
        most = float(re.search(r"give at most ([\d.e-]+) s", refused).group(1))
        found = json.loads(self.expect(0, "check", model, "--json", "--set", f"solver.mass_scaling={most}").stdout)
        self.assertTrue(any("solver.mass_scaling: " in w for w in found["warnings"]), found["warnings"])
        self.expect(2, "check", model, "--set", f"solver.mass_scaling={1.3 * most}")
        stage = '[[stage]]\nuntil = "equilibrium"\n'
        static = self.write("static.toml", stage + (BLOCK % 1e10).replace("duration = 0.5\n", "") + pebble)
        self.expect(0, "check", static, "--set", "solver.mass_scaling=0.1")

    def test_mass_scaling_is_advised_where_it_raises_the_step(self):
        def advice(model, *args):
            found = json.loads(self.expect(0, "check", model, "--json", *args).stdout)
            told = [re.search(r"to 1/([\d.]+) of what the others need: solver.mass_scaling = (\S+) raises", w)
                    for w in found["warnings"]]
            return found["time_step"], next(filter(None, told), None)
        row = "".join(f"[[block]]\npolygon = [[{x}, 1], [{x + 1}, 1], [{x + 1}, 2], [{x}, 2]]\n" for x in range(-10, 14))
        pebble = "[[block]]\npolygon = [[0.4, 2], [0.45, 2], [0.45, 2.05], [0.4, 2.05]]\n"
        model = self.write("row.toml", BLOCK % 1e10 + row + pebble)
        step, told = advice(model)
        longer, _ = advice(model, "--set", f"solver.mass_scaling={told.group(2)}")
        self.assertAlmostEqual(longer / step / float(told.group(1)), 1, delta=0.1)
        # Slivers of the cut whose inertia is raised in any case.
        self.expect(0, "example", "lined-cavern-quake")
        self.assertIsNone(advice("lined-cavern-quake.toml", "--set", "joint_set.steep.origin=[0.5, 0]")[1])

    def test_points_in_excavated_rock_are_reported(self):
        model = self.write("lost.toml", TUNNEL % (1.4, 1.4, ""))
        warnings = self.check(model)["warnings"]
        for what in ("monitor wall", "an end of convergence H"):
            self.assertTrue(any(what in w and '"heading" excavates' in w for w in warnings), warnings)
        self.assertIn("monitor wall", self.expect(0, "run", model).stderr)
        kept = self.check(self.write("kept.toml", TUNNEL % (1.7, 1.7, "")))["warnings"]
        self.assertFalse(any("excavates" in w for w in kept), kept)

    def test_checks_that_fail_are_reported_at_the_end(self):
        run = self.expect(0, "run", self.write("soft.toml", BLOCK % 1e6))
        self.assertRegex(run.stdout, r"check does not hold: overlap over half width at the end is 0\.0\d+, more than 0\.02")
        lines = self.expect(0, "run", "soft.toml", "-o", "again", "--json").stdout.splitlines()
        self.assertEqual(len(json.loads(lines[-1])["failed_checks"]), 1)
        firm = self.expect(0, "run", self.write("firm.toml", BLOCK % 1e10))
        self.assertNotIn("does not hold", firm.stdout)

    def test_check_and_summary_say_what_the_damping_of_strain_takes(self):
        quake = (BLOCK % 1e10).replace("damping = { local = 0.8 }\n", "") + (
            '[[shaking]]\nname = "quake"\nacceleration = { amplitude = 1.0, frequency = 2.5 }\napply = "inertia"\n')
        text = self.expect(0, "check", self.write("quake.toml", quake)).stdout
        line = r"strain damping  ([\d.e-]+) of critical at 2\.5 Hz, the frequency of shaking quake \(in block 0"
        self.assertRegex(text, line)
        self.assertEqual(len(self.check("quake.toml")["strain_damping"]), 1)
        self.expect(0, "run", "quake.toml", "--quiet")
        found = json.loads((self.dir / "quake/summary.json").read_text())["strain_damping"]
        self.assertEqual((found[0]["of"], found[0]["frequency"]), ("shaking quake", 2.5))
        self.assertAlmostEqual(found[0]["fraction"] / float(re.search(line, text).group(1)), 1.0, delta=0.05)
        self.assertNotIn("strain damping", self.expect(0, "check", self.write("still.toml", BLOCK % 1e10)).stdout)

    def test_loose_blocks_may_end_a_run(self):
        stages = '[[stage]]\nuntil = "equilibrium"\n%s[[stage]]\nduration = 0.01\n'
        falls = "[[block]]\npolygon = [[9, 0], [9.5, 0], [9, 0.5]]\n"
        model = (BLOCK % 1e10).replace("duration = 0.5\n", "").replace("damping = { local = 0.8 }\n", "") + falls + stages
        goes_on = self.expect(0, "run", self.write("on.toml", model % ""))
        self.assertIn("completed:", goes_on.stdout)
        stops = self.edda("run", self.write("stop.toml", model % 'otherwise = "stop"\n'))
        failed = self.edda("run", self.write("fails.toml", model.replace('until = "equilibrium"', 'until = "equilibrium"\nratio = 1e-30\nduration = 0.01') % ""))
        self.assertEqual(stops.returncode, failed.returncode)
        self.assertRegex(stops.stdout, r"collapsed: the model is in equilibrium after [\d.e-]+ s, except for 1 block \(0\.125 m2\) that has come loose: .*\"stop\" of stage 1")

    def test_folders_that_cannot_be_made_are_refused(self):
        model = self.write("block.toml", BLOCK % 1e10)
        self.assertIn("cannot be made", self.expect(2, "run", model, "-o", "block.toml/below").stderr)

    def test_words_that_are_lost_are_a_failure(self):
        model = self.write("block.toml", BLOCK % 1e10)
        with open("/dev/full", "w", encoding="utf-8") as full:
            for command in (["check", model], ["example"], ["keys"], ["run", model, "--json"]):
                done = subprocess.run([str(EDDA), *command], cwd=self.dir, stdout=full, stderr=subprocess.PIPE, text=True, timeout=300)
                self.assertEqual((done.returncode, "No space left" in done.stderr), (1, True), command)
            done = subprocess.run([str(EDDA), "--version"], cwd=self.dir, stdout=full, stderr=subprocess.PIPE, text=True, timeout=300)
            self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
