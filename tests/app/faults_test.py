"""Faults of long runs: stopped, killed, disk full, damaged checkpoints, a folder in use, memory at an end.
Each must end in a clear message, lose nothing already written, and go on to the same bytes.
Usage: faults_test.py EDDA [--kills N]"""
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

from program import LIBC, Program, content, lasting

KILLS = 5
if "--kills" in sys.argv:
    at = sys.argv.index("--kills")
    KILLS = int(sys.argv[at + 1])
    del sys.argv[at:at + 2]

# Blocks tumbling into a corner: impacts, sliding, bonds that break, many searches.
HEAP = """
[materials.rock]
density = 2600.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 25.0
cohesion = 1e4
[joints.bare]
friction_angle = 25.0
[contact]
joint = "bare"
[[block]]
name = "floor"
fixed = true
polygon = [[-20, -1], [20, -1], [20, 0], [-20, 0]]
[[brick_wall]]
columns = 4
rows = 5
brick = [1.0, 0.5]
joint = "j"
[[block]]
name = "ball"
velocity = [-12.0, 3.0]
angular_velocity = 4.0
polygon = [[5, 1], [6, 1.2], [6.4, 2], [5.6, 2.5], [4.8, 1.8]]
[[monitor]]
name = "M"
point = [5.5, 1.7]
[[load]]
point = [5.5, 1.7]
force = [-3e3, 0]
history = "push.csv"
[[water]]
table = [[-20, 0.3], [20, 0.3]]
[solver]
duration = 0.6
[output]
every = 0.05
history_every = 0.005
checkpoint_every = 0.0005
"""


def obey_permissions():
    """Root may write anywhere, by CAP_DAC_OVERRIDE: dropped from what the next program may have."""
    drop_from_bounding_set, dac_override = 24, 1
    if os.geteuid() == 0 and LIBC.prctl(drop_from_bounding_set, dac_override, 0, 0, 0) != 0:
        raise OSError("cannot drop a capability")


class Faults(Program):
    seconds = 300

    def setUp(self):
        super().setUp()
        (self.dir / "m.toml").write_text(HEAP)
        (self.dir / "push.csv").write_text("time,factor\n0,0\n0.2,1\n0.5,-1\n")

    def run_into(self, folder, *args):
        return self.start("run", "m.toml", "--quiet", "-o", folder, *args, stderr=subprocess.PIPE)

    def whole(self, *args):
        self.expect(0, "run", "m.toml", "--quiet", "-o", "whole", *args)
        return content(self.dir / "whole"), lasting(self.dir / "whole")

    def killed_and_resumed(self, kills, *args):
        expected, summary = self.whole(*args)
        start = time.monotonic()
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r", *args)
        length = time.monotonic() - start
        chance = random.Random(7)
        landed = 0
        for _ in range(20 + 5 * kills):
            if landed >= kills:
                return
            shutil.rmtree(self.dir / "r", ignore_errors=True)
            start, before, patience = time.monotonic(), landed, length
            process = self.run_into("r", *args)
            while True:
                try:
                    process.wait(chance.uniform(0.02, 0.9 * patience))
                    break
                except subprocess.TimeoutExpired:
                    process.kill()
                    landed += 1
                    patience *= 1.2  # a machine that has become slower gets to the end, too
                    process.communicate(timeout=self.seconds)
                    resumes = (self.dir / "r/checkpoint.h5").exists() or (self.dir / "r/checkpoint.previous.h5").exists()
                    more = ("--resume", "--threads", str(chance.choice((1, 2, 3)))) if resumes else ()
                    process = self.run_into("r", *more, *args)
            _, errors = process.communicate(timeout=self.seconds)
            self.assertEqual(process.returncode, 0, errors)
            self.assertEqual(content(self.dir / "r"), expected)
            self.assertEqual(lasting(self.dir / "r"), summary)
            if landed == before:
                length = min(length, time.monotonic() - start)
        self.fail(f"{landed} of {kills} kills came before the end of a run")

    def test_killed_at_random_goes_on_to_the_same_bytes(self):
        self.killed_and_resumed(KILLS)

    def test_implicit_method_goes_on_to_the_same_bytes(self):
        self.killed_and_resumed(max(2, KILLS // 10), "--set", "solver.method=dda", "--set", "solver.time_step=2e-4")

    def test_stages_go_on_to_the_same_bytes(self):
        """The wall reaches equilibrium, is hit, and reaches it again: killed in any of the three."""
        stages = """[[stage]]
until = "equilibrium"
ratio = 1e-3
[[stage]]
name = "hit"
duration = 0.2
reset_displacements = true
damping = { contact = 0.1 }
[[stage]]
until = "equilibrium"
ratio = 1e-3
duration = 2.0
[solver]"""
        (self.dir / "m.toml").write_text(HEAP.replace("[solver]\nduration = 0.6", stages))
        self.killed_and_resumed(max(3, KILLS // 10))
        self.assertIn("equilibrium", (self.dir / "r/summary.json").read_text())
        self.assertEqual(len((self.dir / "r/stages.csv").read_text().splitlines()), 4)

    def test_interrupted_by_either_signal(self):
        expected, summary = self.whole()
        for number in (signal.SIGINT, signal.SIGTERM):
            shutil.rmtree(self.dir / "r", ignore_errors=True)
            self.assertEqual(self.stop_early(number=number), 130)
            self.assertEqual(json.loads((self.dir / "r/summary.json").read_text())["status"], "interrupted")
            self.expect(0, "run", "m.toml", "--quiet", "-o", "r", "--resume")
            self.assertEqual(content(self.dir / "r"), expected)
            self.assertEqual(lasting(self.dir / "r"), summary)

    def test_resume_may_make_a_run_longer(self):
        self.expect(0, "run", "m.toml", "--quiet", "-o", "whole", "--set", "solver.duration=0.8")
        self.stop_early()
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r", "--resume", "--set", "solver.duration=0.8")
        self.assertEqual(content(self.dir / "r"), content(self.dir / "whole"))
        # From its own model.toml, which has the longer duration by now.
        self.expect(0, "run", "r/model.toml", "--quiet", "-o", "r", "--resume", "--set", "solver.duration=0.9")
        self.assertIn("duration = 0.9", (self.dir / "r/model.toml").read_text())
        self.assertEqual([os.path.basename(i["file"]) for i in json.loads((self.dir / "r/summary.json").read_text())["inputs"]][0], "m.toml")

    def test_resume_refuses_what_it_cannot_go_on_with(self):
        done = self.expect(2, "run", "m.toml", "-o", "nothing", "--resume")
        self.assertIn("holds no checkpoint", done.stderr)
        self.assertFalse((self.dir / "nothing").exists())
        self.stop_early()
        before = content(self.dir / "r")
        done = self.expect(2, "run", "m.toml", "-o", "r", "--resume", "--set", "joints.j.friction_angle=26")
        self.assertRegex(done.stderr, r"joints\.j\.friction_angle: \S+ there, 26(\.0)? here")
        self.assertIn("not the one of the checkpoint", done.stderr)
        done = self.expect(2, "run", "m.toml", "-o", "r", "--resume", "--set", "output.every=0.123")
        self.assertRegex(done.stderr, r": output\.every: \S+ there, 0\.123 here")
        done = self.expect(2, "run", "m.toml", "-o", "r", "--resume", "--set", "solver.duration=1e-3")
        self.assertIn("longer solver.duration", done.stderr)
        push = (self.dir / "push.csv").read_text()
        (self.dir / "push.csv").write_text(push.replace("0.5,-1", "0.5,-2"))
        done = self.expect(2, "run", "m.toml", "-o", "r", "--resume")
        self.assertIn("load.0.history, row 0.5,-2", done.stderr)
        (self.dir / "push.csv").write_text(push)
        self.assertEqual(content(self.dir / "r"), before)

    def test_damaged_checkpoints_are_refused_and_the_one_before_is_used(self):
        expected, _ = self.whole()
        self.stop_early(until="checkpoint.previous.h5")
        shutil.copytree(self.dir / "r", self.dir / "kept")
        good = (self.dir / "r/checkpoint.h5").read_bytes()
        chance = random.Random(3)

        def flipped():
            at, bit = chance.randrange(len(good)), 1 << chance.randrange(8)
            return good[:at] + bytes([good[at] ^ bit]) + good[at + 1:]

        damages = [b"", good[:100], good[:600], good[:-1], good + b"x", b"nonsense" * 1000] + [flipped() for _ in range(6)]
        damages += [good[:k] + bytes([good[k] ^ 1]) + good[k + 1:] for k in (0, 20, 40, 500)]
        for damage in damages:
            shutil.rmtree(self.dir / "r")
            shutil.copytree(self.dir / "kept", self.dir / "r")
            (self.dir / "r/checkpoint.h5").write_bytes(damage)
            done = self.expect(0, "run", "m.toml", "--quiet", "-o", "r", "--resume")
            self.assertIn("is damaged", done.stderr)
            self.assertIn("continuing from r/checkpoint.previous.h5", done.stderr)
            self.assertEqual(content(self.dir / "r"), expected)
        (self.dir / "r/checkpoint.h5").write_bytes(good[:-1])
        (self.dir / "r/checkpoint.previous.h5").write_bytes(good[:-2])
        done = self.expect(2, "run", "m.toml", "-o", "r", "--resume")
        self.assertEqual(done.stderr.count("is damaged"), 2)

    def test_two_runs_into_one_folder(self):
        first = self.run_into("r", "--set", "solver.duration=2000")
        self.wait_for("r/history.csv", first)
        for more in ((), ("--resume",)):
            done = self.edda("run", "m.toml", "-o", "r", *more)
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stderr, "another run is writing to it|holds no checkpoint")
        first.send_signal(signal.SIGINT)
        first.communicate(timeout=self.seconds)
        self.assertEqual(first.returncode, 130)
        self.assertGreater(len((self.dir / "r/history.csv").read_text().splitlines()), 1)

    def test_a_disk_too_full_for_checkpoints_does_not_end_the_run(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))
        expected, _ = self.whole()
        done = self.expect(0, "run", "m.toml", "--quiet", "-o", "r", preexec_fn=limit)
        self.assertIn("no checkpoint: r/checkpoint.h5: cannot be written", done.stderr)
        self.assertEqual(content(self.dir / "r"), expected)

    def test_a_full_disk_ends_the_run_and_keeps_what_is_there(self):
        disk = self.dir / "disk"
        disk.mkdir()
        if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(disk)],
                                               capture_output=True).returncode != 0:
            self.skipTest("needs root, to mount a small disk")
        try:
            done = self.expect(1, "run", "m.toml", "--quiet", "-o", "disk/r")
            self.assertIn("No space left on device", done.stderr)
            self.assertIn("free some disk space", done.stderr)
            self.assertGreater(len((disk / "r/history.csv").read_text().splitlines()), 2)
            self.assertTrue((disk / "r/frames/blocks_000000.vtu").exists())
            self.assertFalse(list((disk / "r").rglob("*.part")))
        finally:
            subprocess.run(["umount", str(disk)], check=True)

    def test_a_folder_that_may_not_be_written_to(self):
        try:
            subprocess.run(["true"], preexec_fn=obey_permissions, check=True)
        except subprocess.SubprocessError:
            self.skipTest("root here may not give up a capability")
        (self.dir / "r").mkdir()
        (self.dir / "r").chmod(0o555)
        done = self.edda("run", "m.toml", "-o", "r", preexec_fn=obey_permissions)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("may be written to", done.stderr)

    def test_memory_at_an_end(self):
        big = HEAP.replace("columns = 4", "columns = 400").replace("rows = 5", "rows = 400").replace("polygon = [[5, 1]", "polygon = [[5, -9]")
        big = big.replace("[6, 1.2], [6.4, 2], [5.6, 2.5], [4.8, 1.8]]", "[6, -9], [6, -8], [5, -8]]").replace("[5.5, 1.7]", "[5.5, -8.5]")
        (self.dir / "big.toml").write_text(big)

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20))
        done = self.edda("run", "big.toml", "-o", "r", "--quiet", "--threads", "1", preexec_fn=limit)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("out of memory", done.stderr)

    def test_the_clock_set_back_changes_nothing(self):
        """Wall time is measured by a clock that never goes back; no file carries a date."""
        a = self.expect(0, "run", "m.toml", "--quiet", "-o", "a")
        os.utime(self.dir / "a", (0, 0))
        for path in (self.dir / "a").rglob("*"):
            os.utime(path, (4e9, 4e9))  # files from the future
        self.expect(0, "run", "m.toml", "--quiet", "-o", "b")
        self.assertEqual(content(self.dir / "a"), content(self.dir / "b"))
        self.expect(0, "run", "m.toml", "--quiet", "-o", "a")
        self.assertEqual(content(self.dir / "a"), content(self.dir / "b"))


if __name__ == "__main__":
    unittest.main()
