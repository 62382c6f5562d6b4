"""Every model and command of the manual, and of the README, is run. Usage: manual_test.py EDDA [PAGE ...]

A block ```toml that begins with a comment "# NAME.toml" is a model: it is written under that name and must pass
edda check. One that begins with "# NAME.toml, a study" is
written alone. One that begins with "# at the end of NAME.toml" is added to that model. Any other is a piece of a model: with tests/docs/around/PAGE.toml, which has what the piece names (or
PAGE-N.toml for the N-th piece of the page), it must pass, too. A block ```sh is run line by line, in one folder per page.
Blocks without a language are shown, not run.
"""
import csv
import json
import math
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
AROUND = ROOT / "tests" / "docs" / "around"
EDDA = str(pathlib.Path(sys.argv.pop(1)).resolve()) if len(sys.argv) > 1 else ""
PAGES = [pathlib.Path(p) for p in sys.argv[1:]] or [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
del sys.argv[1:]

FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)
STUDY = re.compile(r"# (\S+\.toml), a study\n")
ADDED = re.compile(r"# at the end of (\S+\.toml)\n")
# What the program is called in the text.
NAMES = ("edda", "build/edda")


def run(command, folder):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240, check=False)


class Manual(unittest.TestCase):
    def expect(self, folder, *arguments):
        done = run([EDDA, *arguments], folder)
        self.assertEqual(done.returncode, 0, f"edda {shlex.join(arguments)}\n{done.stdout}{done.stderr}")

    def check_model(self, folder, text):
        name = re.match(r"# (\S+\.toml)", text).group(1)
        (folder / name).write_text(text, encoding="utf-8")
        self.expect(folder, "check", name)

    def add_to_model(self, folder, text):
        name = ADDED.match(text).group(1)
        with open(folder / name, "a", encoding="utf-8") as model:
            model.write(text)
        self.expect(folder, "check", name)

    def check_piece(self, folder, page, number, text):
        around = AROUND / f"{page}-{number}.toml"
        if not around.exists():
            around = AROUND / f"{page}.toml"
        self.assertTrue(around.exists(), f"{around} is missing: what stands round this piece")
        for table in [*AROUND.glob("*.csv"), *AROUND.glob("*.dxf")]:
            (folder / table.name).write_bytes(table.read_bytes())
        # Plain keys of the piece belong before any table.
        (folder / "piece.toml").write_text(text + "\n" + around.read_text(encoding="utf-8"), encoding="utf-8")
        self.expect(folder, "check", "piece.toml")

    def run_lines(self, folder, text):
        for line in text.replace("\\\n", " ").splitlines():
            words = shlex.split(line, comments=True)
            if not words:
                continue
            self.assertIn(words[0], NAMES, f"not a command of edda: {line}")
            self.expect(folder, *words[1:])


def test_of(page):
    def test(self):
        pieces = 0
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for language, text in FENCE.findall(page.read_text(encoding="utf-8")):
                with self.subTest(block=text.split("\n", 1)[0]):
                    if language == "toml" and STUDY.match(text):
                        (folder / STUDY.match(text).group(1)).write_text(text, encoding="utf-8")
                    elif language == "toml" and re.match(r"# \S+\.toml\n", text):
                        self.check_model(folder, text)
                    elif language == "toml" and ADDED.match(text):
                        self.add_to_model(folder, text)
                    elif language == "toml":
                        pieces += 1
                        self.check_piece(folder, page.stem, pieces, text)
                    elif language == "sh":
                        self.run_lines(folder, text)
            if page.stem in SAID:
                SAID[page.stem](self, folder, page.read_text(encoding="utf-8"))
    return test


def moved(results):
    """How far each block has moved, m."""
    with open(results / "blocks.csv", encoding="utf-8") as table:
        return [math.hypot(float(row["ux"]), float(row["uy"])) for row in csv.DictReader(table)]


def first_steps(test, folder, text):
    test.assertLess(max(moved(folder / "rough")), 1e-3)
    bare, bolted = moved(folder / "own-tunnel"), moved(folder / "bolted")
    wedge = bare.index(max(bare))
    test.assertGreater(bare[wedge], 0.1)
    test.assertLess(bolted[wedge], 5e-4)
    for name in ("own-tunnel", "rest"):
        summary = json.loads((folder / name / "summary.json").read_text(encoding="utf-8"))
        said = re.search(rf"^{summary['status']}: (.*)$", text, re.M).group(1)
        numbers = [re.findall(r"[\d.]+", line) for line in (said, summary["message"])]
        test.assertEqual(re.sub(r"[\d.]+", "", said), re.sub(r"[\d.]+", "", summary["message"]))
        for here, there in zip(*numbers):
            test.assertLess(abs(float(here.strip(".")) - float(there.strip("."))), 0.05 * float(there.strip(".")) + 1e-9)
    test.assertIn("Save it as `own-tunnel.toml`", text)
    model = (folder / "own-tunnel.toml").read_text(encoding="utf-8")
    (folder / "own-tunnel.toml").write_text(model.replace("friction_angle = 22", "friction = 22"), encoding="utf-8")
    test.assertIn(re.search(r"^own-tunnel\.toml:.*$", text, re.M).group(0),
                  run([EDDA, "check", "own-tunnel.toml"], folder).stderr.splitlines())


# What pages say of what they run.
SAID = {"first-steps": first_steps}


for path in PAGES:
    if FENCE.search(path.read_text(encoding="utf-8")):
        setattr(Manual, f"test_{path.stem.replace('-', '_')}", test_of(path))

if __name__ == "__main__":
    unittest.main()
