"""What the tests of the program from end to end share: a folder for each test, the program run in it, what it wrote."""
import csv
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

EDDA = pathlib.Path(sys.argv.pop(1)).resolve()


def read_rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def content(folder):
    """Every file but the summary (it tells of wall time) and the checkpoints."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*"))
            if p.is_file() and not p.name.startswith("checkpoint") and p.name != "summary.json"}


class Program(unittest.TestCase):
    seconds = 120  # that a command may take

    def setUp(self):
        self.dir = pathlib.Path(tempfile.mkdtemp(prefix="edda_test_"))
        self.addCleanup(shutil.rmtree, self.dir, True)

    def edda(self, *args, cwd=None, **more):
        return subprocess.run([str(EDDA), *args], cwd=cwd or self.dir, text=True, capture_output=True, timeout=self.seconds, **more)

    def expect(self, code, *args, **more):
        done = self.edda(*args, **more)
        self.assertEqual(done.returncode, code, f"{args}: {done.stdout}{done.stderr}")
        return done

    def rows(self, name):
        return read_rows(self.dir / name)
