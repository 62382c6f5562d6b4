"""What edda prints for terminals, machines and shells: progress, JSON, completions, the manual page. Usage: terminal_test.py EDDA"""
import json
import os
import re
import shutil
import signal
import subprocess
import unittest

from program import EDDA, Program

STAGED = """title = "Two stages"
[materials.rock]
density = 2750.0
young = 2e8
poisson = 0.25
[joints.bed]
friction_angle = 30.0
[[block]]
name = "floor"
fixed = true
polygon = [[-1, -1], [4, -1], [4, 0], [-1, 0]]
[[block]]
name = "block"
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[stage]]
name = "settle"
until = "equilibrium"
duration = 5.0
[[stage]]
name = "wait"
until = "time"
duration = 0.02
[output]
every = 0.01
history_every = 0.01
"""


class Folder(Program):
    def setUp(self):
        super().setUp()
        (self.dir / "m.toml").write_text(STAGED)


class Progress(Folder):
    def test_bar_fits_the_terminal(self):
        for columns in (20, 40, 80, 200):
            text = self.on_terminal("run", "m.toml", columns=columns)
            bars = re.findall(r"\r\x1b\[K([^\r\n]*)", text)
            self.assertTrue(bars, text)
            for bar in bars:
                self.assertLess(len(bar), columns, bar)
                self.assertRegex(bar, r"\d+ %")
            self.assertIn("100 %", bars[-1])
        for words in ("[####", "stage 2 of 2 (wait)", "steps/s", "left", "velocity", "penetration"):
            self.assertIn(words, bars[-1])

    def test_quiet_says_nothing(self):
        self.assertEqual(self.on_terminal("run", "m.toml", "--quiet"), "")

    def test_no_bar_elsewhere(self):
        self.assertNotIn("\r", self.expect(0, "run", "m.toml").stderr)


class Lines(Folder):
    def lines(self, done):
        return [json.loads(line) for line in done.stdout.splitlines()]

    def test_run_reports_its_course_in_json(self):
        done = self.expect(0, "run", "m.toml", "--json")
        self.assertEqual(done.stderr, "")
        lines = self.lines(done)
        self.assertEqual(lines[0]["event"], "start")
        self.assertEqual(lines[0]["stages"], ["settle", "wait"])
        self.assertEqual(lines[0]["blocks"], 2)
        ends = [line for line in lines if line["event"] == "stage_end"]
        self.assertEqual([(e["stage"], e["name"], e["reached"]) for e in ends], [(1, "settle", True), (2, "wait", True)])
        self.assertAlmostEqual(ends[1]["end"] - ends[1]["start"], 0.02)
        progress = [line for line in lines if line["event"] == "progress"]
        self.assertEqual(progress[-1]["fraction"], 1.0)
        self.assertEqual(progress[-1]["stage_name"], "wait")
        summary = json.loads((self.dir / "m/summary.json").read_text())
        end = lines[-1]
        self.assertEqual((end["event"], end["status"], end["exit_code"]), ("end", "completed", 0))
        self.assertEqual((end["steps"], end["time"]), (summary["steps"], summary["time"]))
        quiet = self.lines(self.expect(0, "run", "m.toml", "--json", "--quiet"))
        self.assertNotIn("progress", [line["event"] for line in quiet])

    def test_warnings_and_faults_are_lines(self):
        done = self.expect(0, "run", "m.toml", "--json", "--set", "solver.damping.local=0.01", "--set", "contact.normal_stiffness=1e6")
        self.assertIn("warning", [line["event"] for line in self.lines(done)])
        for command in ("run", "check", "fos"):
            done = self.expect(2, command, "m.toml", "--json", "--set", "joints.bed.friction_angle=-1", "--set", "nonsense=1")
            self.assertEqual(done.stderr, "")
            faults = [line for line in self.lines(done) if line["event"] == "fault"]
            self.assertEqual({f["key"] for f in faults}, {"joints.bed.friction_angle", "nonsense"})
            self.assertEqual(set(faults[0]), {"event", "file", "line", "column", "key", "problem", "remedy"})
        end = self.lines(self.expect(2, "run", "none.toml", "--json"))[-1]
        self.assertEqual((end["event"], end["status"], end["exit_code"]), ("end", "refused", 2))

    def test_an_interrupted_run_says_so(self):
        run = self.start("run", "m.toml", "--json", "--set", "stage.wait.duration=1e6", "--set", "output.every=1e5",
                         "--set", "output.history_every=1e4", stdout=subprocess.PIPE)
        with self.soon("the end of the first stage"):
            for line in run.stdout:
                if json.loads(line)["event"] == "stage_end":
                    break
        run.send_signal(signal.SIGINT)
        with self.soon("the end of the run"):
            end = json.loads(run.stdout.read().splitlines()[-1])
        self.assertEqual(run.wait(self.seconds), 130)
        self.assertEqual((end["event"], end["status"], end["exit_code"]), ("end", "interrupted", 130))

    def test_check_is_one_object(self):
        done = self.expect(0, "check", "m.toml", "--json")
        self.assertEqual(done.stdout.count("\n"), 1)
        found = json.loads(done.stdout)
        self.assertEqual((found["blocks"], found["held"], found["vertices"]), (2, 1, 8))
        self.assertEqual(found["smallest"]["edge"]["value"], 1.0)
        self.assertLess(found["time_step"], found["critical_time_step"])
        self.assertGreater(found["steps_per_second"], 0.0)

    def test_fos_is_its_summary(self):
        push = '[[load]]\nname = "push"\npoint = [0, 0.1]\nforce = [5000, 0]\n[solver]\nduration = 0.1\n'
        (self.dir / "m.toml").write_text(STAGED.split("[[stage]]")[0] + push)
        done = self.expect(0, "fos", "m.toml", "--json", "--set", "fos.vary=load:push", "--set", "fos.tolerance=0.08", "--set",
                           "fos.bracket=[5, 8]")
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.count("\n"), 1)
        found = json.loads(done.stdout)
        self.assertEqual(found, json.loads((self.dir / "m-fos/summary.json").read_text()))
        self.assertAlmostEqual(found["factor_of_safety"], 2 * 2750 * 9.81 * 0.57735 / 5000, delta=0.5)


class Shells(Folder):
    def shell(self, *command):
        """Output of a shell that prints no warning, not even about the locale of the test."""
        done = subprocess.run(command, cwd=self.dir, text=True, capture_output=True, timeout=self.seconds,
                              env={**os.environ, "LC_ALL": "C.UTF-8", "HOME": str(self.dir)})
        self.assertEqual(done.stderr, "")
        return done.stdout.splitlines()

    def bash(self, line):
        """What bash offers for the last word of the line."""
        words = line.split(" ")
        quoted = " ".join(f"'{w}'" for w in words)
        script = (f'source <("{EDDA}" completion bash); COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _edda; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        return [word for word in self.shell("bash", "--norc", "-c", script) if word]

    def commands(self):
        listed = self.expect(0, "--help").stdout.split("Subcommands:")[1]
        return re.findall(r"^  (\w+) ", listed, re.M)

    def test_bash_completes_every_command_and_option_of_the_help(self):
        commands = self.commands()
        self.assertGreaterEqual(set(self.bash("edda ")), set(commands))
        self.assertEqual(self.bash("edda ver"), ["verify"])
        for command in commands:
            options = set(re.findall(r"^  .*?(--[a-z-]+)", self.expect(0, command, "--help").stdout.split("Options:")[1], re.M))
            self.assertGreaterEqual(set(self.bash(f"edda {command} -")), options, command)

    def test_bash_completes_values(self):
        self.assertEqual(self.bash("edda plot m --vectors "), ["displacement", "velocity"])
        self.assertEqual(self.bash("edda plot m --field stress.x"), ["stress.xx", "stress.xy"])
        self.assertEqual(self.bash("edda example ramp-45-1"), ["ramp-45-10", "ramp-45-15"])
        self.assertEqual(self.bash("edda keys sta"), ["stage"])
        self.assertEqual(self.bash("edda completion "), ["bash", "zsh", "fish"])

    def test_bash_completes_models_and_folders(self):
        (self.dir / "two words").mkdir()
        (self.dir / "notes.txt").write_text("")
        self.assertEqual(sorted(self.bash("edda run ")), ["m.toml", "two words"])
        self.assertEqual(self.bash("edda run m.toml -o "), ["two words"])
        self.assertIn("notes.txt", self.bash("edda plot m -o "))
        self.assertIn("notes.txt", self.bash("edda view m -o "))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not here")
    def test_zsh_reads_its_script(self):
        (self.dir / "_edda").write_text(self.expect(0, "completion", "zsh").stdout)
        script = "autoload -U compinit; compinit -D -u; fpath=(. $fpath); source ./_edda; print $_comps[edda]"
        self.assertEqual(self.shell("zsh", "-f", "-c", script), ["_edda"])

    @unittest.skipUnless(shutil.which("fish"), "fish is not here")
    def test_fish_completes(self):
        (self.dir / "edda.fish").write_text(self.expect(0, "completion", "fish").stdout)

        def offered(line):
            offered = self.shell("fish", "--no-config", "-c", f"source edda.fish; complete -C '{line}'")
            return [word.split("\t")[0] for word in offered]

        self.assertGreaterEqual(set(offered("edda ")), set(self.commands()))
        self.assertEqual(offered("edda plot m --vectors "), ["displacement", "velocity"])
        self.assertEqual(offered("edda example ramp-45-1"), ["ramp-45-10", "ramp-45-15"])
        self.assertIn("m.toml", offered("edda run "))
        self.assertIn("--principal", offered("edda plot m --p"))


class Manual(Folder):
    def test_page_has_every_command_and_option(self):
        page = self.expect(0, "man").stdout.replace("\\-", "-")
        for heading in ("NAME", "SYNOPSIS", "COMMANDS", "EXIT STATUS", "ENVIRONMENT", "FILES", "EXAMPLES"):
            self.assertIn(f".SH {heading}\n", page)
        listed = self.expect(0, "--help").stdout.split("Subcommands:")[1]
        for command in re.findall(r"^  (\w+) ", listed, re.M):
            section = page.split(f".SS edda {command}\n")[1].split(".SS ")[0]
            for option in re.findall(r"^  .*?(--[a-z-]+)", self.expect(0, command, "--help").stdout.split("Options:")[1], re.M):
                self.assertIn(f"\\fB{option}\\fR", section)

    @unittest.skipUnless(shutil.which("mandoc"), "mandoc is not here")
    def test_page_is_sound(self):
        (self.dir / "edda.1").write_text(self.expect(0, "man", "--date", "2026-01-31").stdout)
        done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", "edda.1"], cwd=self.dir, text=True, capture_output=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main()
