"""docs/command-line.md leaves no command out, docs/pictures.md no option of edda plot. Usage: options_test.py EDDA"""
import pathlib
import re
import shlex
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

    def test_overrides_that_help_and_examples_show_are_keys_of_their_models(self):
        lines = [line for command in re.findall(r"^  (\w+) ", help_of().split("Subcommands:")[1], re.M)
                 for line in help_of(command).splitlines()]
        for model in sorted((DOCS.parent / "examples").glob("*.toml")):
            lines += [line.lstrip("# ") for line in model.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
        shown = 0
        for line in lines:
            # The keys of studies are those of their own files.
            if "--set" not in line or not line.strip().startswith("edda ") or line.strip().startswith("edda study"):
                continue
            words = shlex.split(line.split("   ")[0] if line.startswith("edda") else line)
            model = next(word for word in words if word.endswith(".toml"))
            sets = [word for k, word in enumerate(words) if k > 0 and words[k - 1] == "--set"]
            done = subprocess.run([EDDA, "check", DOCS.parent / "examples" / model, *[f"--set={s}" for s in sets]],
                                  text=True, capture_output=True)
            self.assertEqual(done.returncode, 0, f"{line}\n{done.stderr}")
            shown += len(sets)
        self.assertGreater(shown, 12)


if __name__ == "__main__":
    unittest.main()
