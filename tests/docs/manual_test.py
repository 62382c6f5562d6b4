"""Every model and command of the manual, and of the README, is run. Usage: manual_test.py EDDA [PAGE ...]

A block ```toml that begins with a comment "# NAME.toml" is a model: it is written under that name and must pass
edda check. Any other is a piece of a model: with tests/docs/around/PAGE.toml, which has what the piece names (or
PAGE-N.toml for the N-th piece of the page), it must pass, too. A block ```sh is run line by line, in one folder per page.
Blocks without a language are shown, not run.
"""
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
                    if language == "toml" and re.match(r"# \S+\.toml\n", text):
                        self.check_model(folder, text)
                    elif language == "toml":
                        pieces += 1
                        self.check_piece(folder, page.stem, pieces, text)
                    elif language == "sh":
                        self.run_lines(folder, text)
    return test


for path in PAGES:
    if FENCE.search(path.read_text(encoding="utf-8")):
        setattr(Manual, f"test_{path.stem.replace('-', '_')}", test_of(path))

if __name__ == "__main__":
    unittest.main()
