"""edda limit, end to end: what it answers, what is written and what is not. Usage: limit_test.py EDDA"""
import json
import math
import signal
import subprocess
import time
import unittest

from program import Program, read_rows

BLOCK = """
[materials.stone]
density = 2000
young = "20 GPa"
poisson = 0.2
[joints.dry]
friction_angle = 30
[[block]]
fixed = true
polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]
[[block]]
name = "slab"
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
[fos]
vary = "kh"
"""


class Limit(Program):
    def test_writes_every_file_of_the_promise(self):
        (self.dir / "m.toml").write_text(BLOCK)
        done = self.expect(0, "limit", "m.toml")
        files = ("summary.json columns.csv limit_joints.csv mechanism.csv mechanism_joints.csv mechanism.png mechanism.svg "
                 "mechanism_other_end.csv mechanism_joints_other_end.csv mechanism_other_end.png mechanism_other_end.svg "
                 "thrust.png thrust.svg model.toml").split()
        self.assertEqual(sorted(p.name for p in (self.dir / "m-limit").iterdir()), sorted(files))
        exact = math.tan(math.radians(30))
        summary = json.loads((self.dir / "m-limit/summary.json").read_text())
        self.assertEqual((summary["status"], summary["vary"]), ("found", "kh"))
        self.assertAlmostEqual(summary["limit"]["lower"], exact, delta=1e-7)
        self.assertAlmostEqual(summary["limit"]["upper"], exact, delta=1e-7)
        self.assertAlmostEqual(summary["other_end"]["lower"], -exact, delta=1e-7)
        self.assertIn("sliding along dry", summary["mechanism"]["text"])
        self.assertIn("sliding along dry", summary["other_end"]["mechanism"]["text"])
        self.assertEqual([m["blocks"] for m in summary["mechanisms"]], [[1]])
        there, back = (read_rows(self.dir / f"m-limit/mechanism{end}.csv")[0]["ux"] for end in ("", "_other_end"))
        self.assertGreater(float(there), 0.0)
        self.assertLess(float(back), 0.0)
        self.assertTrue(done.stdout.startswith("seismic coefficient kh 0.57735"), done.stdout)
        joint, = read_rows(self.dir / "m-limit/limit_joints.csv")
        weight = 2000 * 9.81 * 4
        self.assertAlmostEqual(float(joint["normal_force"]), weight, delta=1e-3)
        self.assertAlmostEqual(abs(float(joint["fx"])), exact * weight, delta=1e-2)
        self.assertAlmostEqual(float(joint["mobilised"]), 1.0, delta=1e-6)
        # The thrust goes through the point that the moment of the slab asks for.
        self.assertAlmostEqual(float(joint["x"]), 2.0 + 0.5 * exact, delta=1e-5)
        block, = read_rows(self.dir / "m-limit/mechanism.csv")
        self.assertEqual((block["name"], block["motion"]), ("slab", "slides"))

    def test_an_earlier_folder_is_used_again_and_files_of_others_are_kept(self):
        (self.dir / "m.toml").write_text(BLOCK)
        self.expect(0, "limit", "m.toml")
        quiet = self.expect(0, "limit", "m.toml", "--quiet")
        self.assertEqual((quiet.stdout.count("\n"), quiet.stderr), (1, ""))
        as_json = self.expect(0, "limit", "m.toml", "--json")
        self.assertEqual(json.loads(as_json.stdout)["message"] + "\n", quiet.stdout)
        (self.dir / "m-limit/notes.txt").write_text("mine")
        self.expect(2, "limit", "m.toml")

    def test_other_answers(self):
        (self.dir / "m.toml").write_text(BLOCK)
        for vary, status, words in (("gravity", "unlimited", "no multiplier of gravity moves"), ("tilt", "found", "tilt in degrees 30")):
            done = self.expect(0, "limit", "m.toml", "-o", "f", "--set", f"fos.vary={vary}")
            self.assertEqual(json.loads((self.dir / "f/summary.json").read_text())["status"], status)
            self.assertIn(words, done.stdout)
        done = self.expect(0, "limit", "m.toml", "-o", "f", "--set", "block.slab.polygon=[[4,0],[9,0],[9,1],[4,1]]", "--set", "fos.vary=strength")
        self.assertEqual(json.loads((self.dir / "f/summary.json").read_text())["status"], "unstable", done.stdout)

    def test_faults_write_nothing(self):
        (self.dir / "m.toml").write_text(BLOCK)
        for what in ("fos.vary=push", "limit.crushing=true", "gravity=[0,0]", "block.slab.fixed=true", "contact.model=points"):
            done = self.expect(2, "limit", "m.toml", "--set", what)
            self.assertTrue(done.stderr, what)
            self.assertEqual([p.name for p in self.dir.iterdir()], ["m.toml"])
        shaking = BLOCK.replace('"kh"', '"shaking:quake"') + \
            '[[shaking]]\nname = "quake"\nacceleration = { amplitude = 1, frequency = 1 }\n'
        (self.dir / "m.toml").write_text(shaking)
        self.assertIn("vary \"kh\"", self.expect(2, "limit", "m.toml").stderr)

    def test_a_factor_of_safety_has_its_rigid_limit_beside_it(self):
        (self.dir / "m.toml").write_text(BLOCK)
        done = self.expect(0, "fos", "m.toml")
        summary = json.loads((self.dir / "m-fos/summary.json").read_text())
        exact = math.tan(math.radians(30))
        self.assertAlmostEqual(summary["factor_of_safety"], exact, delta=0.02 * exact)
        self.assertAlmostEqual(summary["rigid_limits"]["most"], exact, delta=1e-6)
        check, = summary["checks"]
        self.assertTrue(check["pass"])
        self.assertIn("rigid limit analysis: seismic coefficient kh 0.57735", done.stdout)

    def test_reports_its_progress_and_stops_within_a_second(self):
        wall = BLOCK.replace("[fos]", '[[brick_wall]]\norigin = [10, 0]\ncolumns = 60\nrows = 60\nbrick = [1, 0.5]\n[fos]').replace(
            "[5, 0], [-5, 0]", "[80, 0], [-5, 0]").replace("[5, -1]", "[80, -1]")
        (self.dir / "m.toml").write_text(wall)
        run = self.start("limit", "m.toml", "--threads", "1", "--set", "fos.vary=strength", stderr=subprocess.PIPE, text=True)
        line = run.stderr.readline()
        self.assertIn("limit of rigid blocks: the first mechanism, after ", line)
        asked = time.monotonic()
        run.send_signal(signal.SIGTERM)
        run.wait(timeout=30)
        self.assertLess(time.monotonic() - asked, 20.0)  # 0.1 s where nothing else is running, 2 to 8 s with sanitizers
        self.assertEqual(run.returncode, 130)
        self.assertIn("interrupted", run.stderr.read())
        self.assertEqual([p.name for p in self.dir.iterdir()], ["m.toml"])


if __name__ == "__main__":
    unittest.main()
