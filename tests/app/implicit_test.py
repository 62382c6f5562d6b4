"""The implicit method, end to end: the same model, the same bytes with any number of threads. Usage: implicit_test.py EDDA"""
import json
import unittest

from program import Program


class Implicit(Program):
    def test_implicit_method_runs_the_same_model(self):
        self.expect(0, "example", "cavern")
        self.assertNotIn("critical step", self.expect(0, "check", "cavern.toml", "--set", "solver.method=dda").stdout)
        results = []
        for n in (1, 2, 7):
            self.expect(0, "run", "cavern.toml", "--quiet", "-o", f"d{n}", "--threads", str(n), "--set", "solver.method=dda",
                        "--set", "solver.duration=0.01", "--set", "output.history_every=0.001")
            results.append([(self.dir / f"d{n}" / f).read_bytes() for f in ("blocks.csv", "joints.csv", "history.csv")])
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])
        summary = json.loads((self.dir / "d1/summary.json").read_text())
        self.assertEqual((summary["method"], summary["status"]), ("dda", "completed"))
        self.assertGreater(summary["open_close"]["mean"], 0)
        self.expect(0, "run", "cavern.toml", "--quiet", "-o", "s", "--set", "solver.method=dda", "--set", "solver.dynamic=false",
                    "--set", "solver.duration=0.05", "--set", "output.history_every=0.05", "--set", "output.every=0.05")
        self.assertEqual(json.loads((self.dir / "s/summary.json").read_text())["energy"]["kinetic"], 0)


if __name__ == "__main__":
    unittest.main()
