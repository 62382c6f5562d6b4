"""The same model gives the same bits: with any number of threads, after a stop and --resume, at any optimisation.
Nothing is compared with a stored value, only builds of the same sources with each other. Compared are hashes of
  blocks.csv, joints.csv, history.csv, the last frames, and summary.json without what depends on the machine (program.py).
Usage: determinism_test.py EDDA [EDDA_O1]
EDDA_O1 is the same sources at -O1 with every loop shared among the threads (CMake's EDDA_O1_TWIN), so that small scenes
meet all of the threads' work; EDDA itself shares only long loops, which the last scene has."""
import hashlib
import json
import os
import pathlib
import sys
import unittest

from program import EDDA, Program, lasting

# The name of a test may follow the program, too.
TWIN = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 and os.path.isfile(sys.argv[1]) else None

STEPS = 10_000
THREADS = (1, 2, 3, 8, 16)


def steps_of(step, number=STEPS, frames=4, rows=50):
    """Settings for so many steps of one length."""
    duration = step * number
    return {"solver.time_step": step, "solver.duration": duration, "output.every": duration / frames,
            "output.history_every": duration / rows}


# Soft rock, so that 10,000 steps are long enough for walls to fall and slopes to tumble.
COLLAPSING_WALL = ("wall", {"materials.brick.young": 4e6, "joints.dry.cohesion": 2e3, "joints.dry.tensile_strength": 1e3,
                            **steps_of(1e-4)})
TUMBLING_SLOPE = ("slope", {"materials.rock.young": 5e7, "solver.damping.local": 0.02, **steps_of(1.2e-4)})
BONDED_CAVERN = ("cavern", {"joint_set.steep.spacing": 7.0, "joint_set.flat.spacing": 7.0, "joints.bare.cohesion": 2e5,
                            "joints.bare.tensile_strength": 1e5, "boundary.sides.stiffness": 1.9e11, **steps_of(1.5e-6)})
IMPLICIT_WALL = ("wall", {"solver.method": "dda", **steps_of(5e-4, 300)})
# Long enough loops for the release build to share them.
LARGE_WALL = ("wall", {"brick_wall.0.columns": 45, "brick_wall.0.rows": 60,
                       "block.floor.polygon": "[[-4, -0.5], [26, -0.5], [26, 0], [-4, 0]]", **steps_of(1.2e-5, 150)})


# More threads than cores must not busy-wait for each other.
ENVIRONMENT = {**os.environ, "OMP_WAIT_POLICY": "passive", "OMP_DYNAMIC": "false"}
ENVIRONMENT.pop("OMP_NUM_THREADS", None)  # the program's own choice is one of those compared


def given(settings, threads):
    options = [] if threads is None else ["--threads", str(threads)]  # None: as many as are quickest, now these, now those
    return [*options, *(word for key, value in settings.items() for word in ("--set", f"{key}={value}"))]


class Determinism(Program):
    seconds = 250

    def take(self, scene):
        name, settings = scene
        self.expect(0, "example", name)
        (self.dir / (name + ".toml")).rename(self.dir / "m.toml")
        return settings

    def prints(self, folder, steps):
        """Hash by file, and the summary."""
        folder = self.dir / folder
        summary = lasting(folder)
        self.assertEqual(summary["status"], "completed", summary["message"])
        self.assertGreaterEqual(summary["steps"], steps)
        files = [folder / name for name in ("blocks.csv", "joints.csv", "history.csv")]
        for kind in ("blocks", "contacts"):
            files.append(max((folder / "frames").glob(kind + "_*.vtu")))
        result = {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in files}
        result["summary.json"] = hashlib.sha256(json.dumps(summary).encode()).hexdigest()
        return result, summary

    def whole(self, program, folder, settings, threads, steps):
        self.expect(0, "run", "m.toml", "--quiet", "-o", folder, *given(settings, threads), program=program, env=ENVIRONMENT)
        return self.prints(folder, steps)

    def resumed(self, first, second, settings, threads, steps):
        """Stopped once its first checkpoint exists, and resumed by the other program."""
        often = {**settings, "output.checkpoint_every": 1e-4}
        self.assertEqual(self.stop_early(*given(often, threads[0]), program=first, env=ENVIRONMENT), 130)
        self.expect(0, "run", "m.toml", "--quiet", "-o", "r", "--resume", *given(often, threads[1]), program=second, env=ENVIRONMENT)
        return self.prints("r", steps)

    def hold(self, scene, steps=STEPS, threads=THREADS, twin_threads=(1, 2)):
        settings = self.take(scene)
        expected, summary = self.whole(EDDA, "reference", settings, threads[0], steps)
        for n in threads[1:]:
            self.assertEqual(self.whole(EDDA, f"t{n}", settings, n, steps)[0], expected, f"{n} threads")
        self.assertEqual(self.resumed(EDDA, EDDA, settings, (3, 2), steps)[0], expected, "resumed")
        self.assertEqual(self.whole(EDDA, "chosen", settings, None, steps)[0], expected, "threads by choice")
        if TWIN:
            for n in (*twin_threads, None):
                self.assertEqual(self.whole(TWIN, f"o1_{n}", settings, n, steps)[0], expected, f"-O1, {n} threads")
            self.assertEqual(self.resumed(EDDA, TWIN, settings, (2, 1), steps)[0], expected, "resumed at -O1")
        return summary

    def test_collapsing_wall(self):
        summary = self.hold(COLLAPSING_WALL, twin_threads=(1, 16))
        self.assertGreater(summary["energy"]["fracture"], 0.0)  # bonds broke
        self.assertGreater(summary["energy"]["friction"], 0.0)

    def test_tumbling_slope(self):
        summary = self.hold(TUMBLING_SLOPE)
        self.assertGreater(summary["energy"]["friction"], 0.0)
        self.assertGreater(summary["energy"]["damping"], 0.0)

    def test_cavern_with_bonds(self):
        summary = self.hold(BONDED_CAVERN)
        self.assertGreater(summary["energy"]["fracture"], 0.0)

    def test_implicit_wall(self):
        self.hold(IMPLICIT_WALL, steps=300)

    def test_loops_long_enough_to_be_shared(self):
        self.hold(LARGE_WALL, steps=150, twin_threads=(8,))


if __name__ == "__main__":
    unittest.main()
