"""Every command of docs/command-line.md and docs/pictures.md runs, and the pages leave no command or option out.
Usage: doc_commands_test.py EDDA"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EDDA = pathlib.Path(sys.argv.pop(1)).resolve()


def run_page(page):
    return subprocess.run([sys.executable, "-B", ROOT / "tools/doc-commands", page, EDDA], text=True, capture_output=True)


def help_of(*command):
    return subprocess.run([EDDA, *command, "--help"], text=True, capture_output=True, check=True).stdout


class Pages(unittest.TestCase):
    def test_commands_run(self):
        for page in ("command-line.md", "pictures.md"):
            done = run_page(ROOT / "docs" / page)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_command_that_fails_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text("```sh\nedda example ramp\nedda check none.toml\n```\n")
            done = run_page(page)
        self.assertEqual(done.returncode, 2)
        self.assertIn("edda check none.toml", done.stderr)

    def test_every_command_has_its_section(self):
        text = (ROOT / "docs/command-line.md").read_text(encoding="utf-8")
        for command in re.findall(r"^  (\w+) ", help_of().split("Subcommands:")[1], re.M):
            self.assertIn(f"\n## edda {command}\n", text)

    def test_every_option_of_plot_is_explained(self):
        text = (ROOT / "docs/pictures.md").read_text(encoding="utf-8")
        for option in re.findall(r"^  .*?(--[a-z-]+)", help_of("plot").split("Options:")[1], re.M):
            if option not in ("--help", "--output", "--set"):
                self.assertIn(option, text)


if __name__ == "__main__":
    unittest.main()
