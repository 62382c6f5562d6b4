"""Models far too large: each ends soon, with exit code 2 and one clear line, and without filling the memory.
Usage: limits_test.py EDDA"""
import math
import resource
import unittest

from program import Program
MEMORY = 3 << 30  # bytes, of addresses

HEAD = """[materials.rock]
density = 2600
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 30
[solver]
duration = 1
"""
BLOCK = "[[block]]\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
WALL = "[[brick_wall]]\nbrick = [1, 0.5]\n"
DOMAIN = "[domain]\noutline = [[0, 0], [100, 0], [100, 100], [0, 100]]\n"


def joint_set(angle, spacing):
    return f"[[joint_set]]\nangle = {angle}\nspacing = {spacing}\n"


def ring(n):
    turn = 2 * math.pi / n
    return "[" + ",".join(f"[{100 * math.cos(turn * i)!r},{100 * math.sin(turn * i)!r}]" for i in range(n)) + "]"


class Limits(Program):
    def run_limited(self, text, *more):
        (self.dir / "m.toml").write_text(text)

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        return self.edda("run", "m.toml", "--threads", "1", *more, preexec_fn=limit)

    def refused(self, text, *words):
        done = self.run_limited(text)
        self.assertEqual(done.returncode, 2, done.stderr[:500])
        self.assertEqual(done.stdout, "")
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 1, lines[:3])
        self.assertTrue(lines[0].startswith("m.toml:"), lines[0])
        self.assertLess(len(lines[0]), 400)
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual([p.name for p in self.dir.iterdir()], ["m.toml"])

    def test_walls(self):
        self.refused(HEAD + WALL + "columns = 1000000000\nrows = 3\n", "brick_wall.0.columns", "out of range", "at most 5000000")
        self.refused(HEAD + WALL + "columns = 3\nrows = 1e9\n", "brick_wall.0.rows", "at most 5000000")
        self.refused(HEAD + WALL + "columns = 5000000\nrows = 5000000\n", "brick_wall.0.columns", "2.50e+13 bricks, more than 5000000")
        self.refused(HEAD + 9 * (WALL + "columns = 1000\nrows = 1000\n"), "brick_wall.5.columns", "6000000 bricks")

    def test_joint_sets(self):
        for sets in (joint_set(30, 1e-12), joint_set(30, 1e-12) + joint_set(120, 1e-12),
                     "".join(joint_set(0.1 * i, 1.0) for i in range(1000))):
            self.refused(HEAD + DOMAIN + sets, "spacing", "blocks would be cut, more than domain.max_blocks = 300000")
        self.refused(HEAD + DOMAIN + joint_set(30, 1e-300), "joint_set.0.spacing", "too small")
        far = "region = [[200, 200], [300, 200], [300, 300]]\n"
        self.refused(HEAD + DOMAIN + joint_set(30, 1e-9) + far, "joint_set.0.spacing", "larger spacing")

    def test_memory_of_this_machine(self):
        many = DOMAIN + "max_blocks = 2000000000\n" + joint_set(30, 1e-7)
        self.refused(HEAD + many, "domain.max_blocks", "need at least 2.73e+03 GB", "this machine has")

    def test_traces(self):
        crossed = "".join(f"[[trace]]\npoints = [[0, {y}], [100, {y}]]\n[[trace]]\npoints = [[{y}, 0], [{y}, 100]]\n"
                          for y in (0.02 * i + 0.001 for i in range(1, 4000)))
        self.refused(HEAD + DOMAIN + crossed, "domain.max_blocks", "the lines cross about 1.6", "e+07 times")

    def test_corners(self):
        self.refused(HEAD + f"[[block]]\npolygon = {ring(200_000)}\n", "block.0.polygon", "has 200000 corners, more than 10000")
        self.refused(HEAD + f"[domain]\noutline = {ring(200_000)}\n", "domain.outline", "a block cut from it has", "corners, more than 10000")

    def test_polygon_of_a_million_corners(self):
        self.refused(HEAD + f"[[block]]\npolygon = {ring(1_000_000)}\n", "block.0.polygon", "has 1000000 corners")

    def test_joint_laws(self):
        laws = "".join(f"[joints.a{i}]\nfriction_angle = 20\n" for i in range(65_535))
        self.refused(HEAD + laws + BLOCK, "joints: has 65536 laws, more than 65535")

    def test_file(self):
        self.refused(HEAD + BLOCK + "#" * (65 << 20), "larger than 64 MiB")

    def test_output(self):
        for key, most in (("every", "1e+05"), ("history_every", "1e+07")):
            self.refused(HEAD + BLOCK + f"[output]\n{key} = 1e-12\n", "output." + key, "1.0e+12 times, more than " + most)
            self.refused(HEAD + BLOCK + f"[output]\n{key} = 1e-300\n", "output." + key, "too small")
        monitors = "".join(f'[[monitor]]\nname = "m{i}"\npoint = [0.5, 0.5]\n' for i in range(20_000))
        self.refused(HEAD + BLOCK + monitors + "[output]\nhistory_every = 1e-7\n", "output.history_every", "the files would take")

    def test_steps(self):
        self.refused(HEAD.replace("duration = 1", "duration = 1\ntime_step = 1e-100") + BLOCK, "solver.time_step", "would take 1.0e+100 steps")
        self.refused(HEAD.replace("duration = 1", "duration = 1e300") + BLOCK, "solver.duration", "too large")

    def test_what_is_large_but_sound_is_taken(self):
        for text in (BLOCK + WALL + "origin = [5, 0]\ncolumns = 60\nrows = 50\n", f"[[block]]\npolygon = {ring(9_000)}\n"):
            (self.dir / "m.toml").write_text(HEAD + text)
            self.expect(0, "check", "m.toml")


if __name__ == "__main__":
    unittest.main()
