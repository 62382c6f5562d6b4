"""docs/command-line.md leaves no command out, docs/pictures.md no option of edda plot. Usage: options_test.py EDDA"""
import pathlib
import re
import subprocess
import sys
import unittest

DOCS = pathlib.Path(__file__).resolve().parents[2] / "docs"
EDDA = pathlib.Path(sys.argv.pop(1)).resolve()


def help_of(*command):
    return subprocess.run([EDDA, *command, "--help"], text=True, capture_output=True, check=True).stdout


class Pages(unittest.TestCase):
    def test_every_command_has_its_section(self):
        text = (DOCS / "command-line.md").read_text(encoding="utf-8")
        commands = re.findall(r"^  (\w+) ", help_of().split("Subcommands:")[1], re.M)
        self.assertIn("run", commands)
        for command in commands:
            self.assertIn(f"\n## edda {command}\n", text)

    def test_every_option_of_plot_is_explained(self):
        text = (DOCS / "pictures.md").read_text(encoding="utf-8")
        options = re.findall(r"^  .*?(--[a-z-]+)", help_of("plot").split("Options:")[1], re.M)
        self.assertIn("--principal", options)
        for option in options:
            if option not in ("--help", "--output", "--set"):
                self.assertIn(option, text)


if __name__ == "__main__":
    unittest.main()
