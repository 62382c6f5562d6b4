"""The command line, end to end: exit codes, what is written and what is not. Usage: cli_test.py EDDA"""
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from program import content, lasting, read_rows
from ramp import RAMP, RampProgram

RESULTS = {"summary.json", "history.csv", "blocks.csv", "joints.csv", "columns.csv", "blocks.pvd", "contacts.pvd", "frames", "model.toml"}
SUMMARY = """version title method mass status message blocks contacts time steps time_step critical_time_step governed_by
open_close step_changes step_cuts max_penetration energy wall_seconds block_steps_per_second threads checks inputs""".split()


def read_cells(path):
    with open(path, newline="") as file:
        return list(csv.reader(file))


def without_progress(text):
    """Lines of a search without those that say every two seconds how far it is."""
    progress = ("trying ", "before the trials: ", "limit of rigid blocks: ")
    return "\n".join(line for line in text.splitlines() if not line.strip().startswith(progress))


class Cli(RampProgram):
    def test_run_writes_every_file_of_the_promise(self):
        done = self.expect(0, "run", "m.toml")
        self.assertEqual({p.name for p in (self.dir / "m").iterdir()}, RESULTS)
        summary = json.loads((self.dir / "m/summary.json").read_text())
        self.assertEqual([k for k in SUMMARY if k not in summary], [])
        self.assertEqual(summary["status"], "completed")
        self.assertEqual(summary["title"], 'Ramp "quoted"')
        self.assertEqual(set(summary["time_step"]), {"min", "max", "mean"})
        self.assertLess(abs(summary["energy"]["drift"]), 1e-3)
        for check in summary["checks"]:
            self.assertEqual(set(check), {"name", "value", "limit", "pass"})
        rows = read_rows(self.dir / "m/history.csv")
        self.assertEqual([r["time"] for r in rows], ["0"] + [f"0.00{k}" for k in range(1, 10)] + ["0.01"])
        self.assertEqual(list(rows[0])[1:10], ["M." + n for n in "ux uy vx vy ax ay sxx syy sxy".split()])
        self.assertEqual(
            list(rows[0])[10:],
            "kinetic strain contact gravity friction damping fracture external step_change drift unbalanced transfer "
            "cracks_tension cracks_shear".split())
        blocks = read_cells(self.dir / "m/blocks.csv")
        self.assertEqual(" ".join(blocks[0]), "id name material x y area ux uy rotation vx vy omega sxx syy szz sxy overstress")
        self.assertEqual([b[1] for b in blocks[1:]], ["ramp", "slider"])
        joints = read_cells(self.dir / "m/joints.csv")
        self.assertEqual(" ".join(joints[0]),
                         "block_i block_j joint x y normal_force shear_force opening slip state ever_slipped ever_opened mobilised "
                         "length closed_length x_a y_a x_b y_b normal_stress normal_stress_a normal_stress_b shear_stress table "
                         "damage broken_by aperture discharge water_pressure_a water_pressure_b")
        self.assertEqual(done.stdout.splitlines()[0][:9], "completed")

    def test_input_hash_is_that_of_the_file(self):
        import hashlib
        self.expect(0, "run", "m.toml", "--quiet")
        inputs = json.loads((self.dir / "m/summary.json").read_text())["inputs"]
        self.assertEqual(inputs, [{"file": "m.toml", "sha256": hashlib.sha256(RAMP.encode()).hexdigest()}])

    def test_bad_models_exit_2_and_write_nothing(self):
        for text in ("nonsense = 1\n" + RAMP, RAMP.replace("2e8", "-2e8"), "= not toml", RAMP.replace("[1.0, 0.5]", "[9, 9]"),
                     RAMP.replace("duration = 0.01", "duration = 0.01\ntime_step = 0.1")):
            (self.dir / "bad.toml").write_text(text)
            before = self.names()
            done = self.expect(2, "run", "bad.toml")
            self.assertEqual(self.names(), before)
            self.assertEqual(done.stdout, "")
            lines = done.stderr.splitlines()
            self.assertTrue(lines and all(line.startswith("bad.toml:") for line in lines), done.stderr)
            self.expect(2, "check", "bad.toml")
        self.expect(2, "run", "none.toml")

    def test_fos_writes_every_file_of_the_promise(self):
        model = RAMP.replace("[-1, -1], [4, -1], [4, 0], [-1, 0]", "[-9, -1], [9, -1], [9, 0], [-9, 0]") \
            .replace("velocity = [1.0, 0.0]\n", "")
        push = '[[load]]\nname = "push"\npoint = [0, 0.1]\nforce = [2000, 0]\n'
        (self.dir / "m.toml").write_text(model + push)
        args = ["fos", "m.toml", "--set", "fos.vary=load:push", "--set", "fos.tolerance=0.01", "--set", "fos.bracket=[5, 9]"]
        done = self.expect(0, *args)
        files = "summary.json columns.csv fos.csv mechanism.csv mechanism_joints.csv mechanism.png mechanism.svg model.toml".split()
        self.assertEqual(sorted(p.name for p in (self.dir / "m-fos").iterdir()), sorted(files))
        summary = json.loads((self.dir / "m-fos/summary.json").read_text())
        exact = 2 * 2750 * 9.81 * 0.2679492 / 2000
        self.assertAlmostEqual(summary["factor_of_safety"], exact, delta=0.1)
        self.assertLess(summary["holds"], exact)
        self.assertGreater(summary["fails"], exact)
        self.assertEqual(summary["status"], "found")
        self.assertGreater(summary["criterion"]["fails_displacement"], 0)
        self.assertIn("sliding", summary["mechanism"]["text"])
        rows = read_rows(self.dir / "m-fos/fos.csv")
        self.assertEqual(" ".join(rows[0]), "factor outcome displacement block time velocity unbalanced steps reason")
        self.assertEqual({r["outcome"] for r in rows}, {"holds", "fails"})
        block, = read_rows(self.dir / "m-fos/mechanism.csv")
        self.assertEqual((block["name"], block["motion"]), ("slider", "slides"))
        joint, = read_rows(self.dir / "m-fos/mechanism_joints.csv")
        self.assertEqual(joint["joint"], "ramp")
        self.assertIn("multiplier of the load", done.stdout)
        # Threads and the folder of an earlier run change nothing; files that are no results remain.
        before = (self.dir / "m-fos/fos.csv").read_bytes()
        quiet = self.expect(0, *args, "--threads", "2", "--quiet")
        self.assertEqual((self.dir / "m-fos/fos.csv").read_bytes(), before)
        self.assertEqual(quiet.stderr, "")
        self.assertEqual(quiet.stdout.count("\n"), 1)
        self.assertEqual(quiet.stdout, f"{summary['message']}\n")
        self.assertTrue(quiet.stdout.startswith("multiplier of the load "))
        (self.dir / "m-fos/notes.txt").write_text("mine")
        self.expect(2, *args)
        self.expect(2, "fos", "m.toml", "--set", "fos.vary=load:pull")
        self.expect(2, "fos", "m.toml", "--set", "solver.method=dda")

    def test_threads_change_nothing_of_a_search(self):
        self.expect(0, "example", "toppling")
        told = []
        for threads in ("1", "2", "3", "4"):
            folder = "t" + threads
            done = self.expect(0, "fos", "toppling.toml", "--set", "fos.tolerance=0.02", "--threads", threads, "-o", folder)
            self.assertEqual(sorted(content(self.dir / folder)), sorted(content(self.dir / "t1")))
            told.append((without_progress(done.stderr), done.stdout.replace(folder, "t1").split("\n")[:-2], content(self.dir / folder), lasting(self.dir / folder)))
        self.assertEqual(told[0][0].count("\nfactor ") + 1, len(read_rows(self.dir / "t1/fos.csv")))
        for other in told[1:]:
            self.assertEqual(other, told[0])

    def test_a_search_can_be_interrupted(self):
        self.expect(0, "example", "toppling")
        for threads in ("1", "3"):
            run = self.start("fos", "toppling.toml", "--set", "fos.tolerance=1e-12", "--threads", threads, "-o", "t" + threads,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            with self.soon("the first trials"):
                for _ in range(3):
                    line = run.stderr.readline()
                    while not without_progress(line.decode()):
                        line = run.stderr.readline()
                    self.assertIn(b"factor ", line)
            run.send_signal(signal.SIGINT)
            run.communicate(timeout=self.seconds)
            self.assertEqual(run.returncode, 130)
            summary = json.loads((self.dir / ("t" + threads) / "summary.json").read_text())
            self.assertEqual(summary["status"], "interrupted")
            self.assertGreaterEqual(summary["holds"], 1.0)
            self.assertGreaterEqual(len(read_rows(self.dir / ("t" + threads) / "fos.csv")), 3)

    def test_only_what_runs_needs_a_duration(self):
        model = RAMP.replace("[-1, -1], [4, -1], [4, 0], [-1, 0]", "[-9, -1], [9, -1], [9, 0], [-9, 0]") \
            .replace("velocity = [1.0, 0.0]\n", "").replace("[solver]\nduration = 0.01\n", "")
        push = '[[load]]\nname = "push"\npoint = [0, 0.1]\nforce = [2000, 0]\n[fos]\nvary = "load:push"\n'
        (self.dir / "m.toml").write_text(model + push)
        for command in ("run", "verify"):
            self.assertEqual(self.expect(2, command, "m.toml").stderr,
                             'm.toml:1:1: solver.duration: is missing: give a time above 0 such as 0.1 or "100 ms" for a '
                             'run; edda fos needs none\n')
        checked = self.expect(0, "check", "m.toml").stdout
        for line in ("blocks          2 (1 fixed)", "contacts        1 closed", "step            ",
                     "duration        no solver.duration is given: edda run needs one, edda fos does not", "warnings        none"):
            self.assertIn("\n" + line, "\n" + checked)
        self.assertNotIn("\nsteps", checked)
        found = json.loads(self.expect(0, "check", "m.toml", "--json").stdout)
        self.assertEqual([found[key] for key in ("duration", "steps", "seconds")], [None] * 3)
        self.assertGreater(found["steps_per_second"], 0)
        self.expect(0, "check", "m.toml", "--set", "solver.method=dda")
        fixed = self.expect(0, "check", "m.toml", "--set", "block.slider.fixed=true", "--set", "load=[]", "--set", "fos.vary=strength")
        self.assertIn("\nstep            1 s ", fixed.stdout)
        self.expect(0, "cut", "m.toml")
        self.expect(0, "plot", "m.toml", "-o", "drawn.png")
        self.assertEqual((self.dir / "drawn.png").read_bytes()[:4], b"\x89PNG")
        self.expect(0, "fos", "m.toml", "--quiet", "--set", "fos.tolerance=0.1", "--set", "fos.bracket=[5, 9]")
        self.assertNotIn("duration", (self.dir / "m-fos/model.toml").read_text())
        self.expect(0, "fos", "m-fos/model.toml", "-o", "again", "--quiet", "--set", "fos.tolerance=0.1")
        self.assertEqual((self.dir / "again/fos.csv").read_bytes(), (self.dir / "m-fos/fos.csv").read_bytes())

    def test_words_that_are_no_commands_get_a_hint(self):
        for args, hint in ((("runn", "m"), '"runn" is no command: did you mean: edda run?'),
                           (("m.toml",), '"m.toml" is a model, not a command: to run it: edda run m.toml'),
                           (("m",), "to run the model m.toml: edda run m.toml"), (("help",), "write: edda --help"),
                           (("solve", "m.toml"), "write: edda run"), (("PLOT", "m"), "did you mean: edda plot?"),
                           (("nonsense",), "commands are "), (("run", "m"), "did you mean m.toml?")):
            done = self.expect(2, *args)
            self.assertEqual((hint in done.stderr, done.stdout), (True, ""), done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
        self.expect(0, "run", "m.toml", "--quiet")
        self.assertIn("to see them: edda plot m, or edda view m", self.expect(2, "m").stderr)
        self.assertIn("did you mean m.toml?", self.expect(2, "check", "m").stderr)

    def test_joints_and_materials_that_nothing_uses_are_reported(self):
        (self.dir / "m.toml").write_text(RAMP.replace("[[block]]", """[joints.rock]
friction_angle = 5
[materials.clay]
density = 2000
young = 1e8
poisson = 0.3
[contact]
joint = "ramp"
[[block]]
material = "rock"
""", 1).replace('"slider"', '"slider"\nmaterial = "rock"'))
        warnings = json.loads(self.expect(0, "check", "m.toml", "--json").stdout)["warnings"]
        unused = [w.split(":")[1] for w in warnings if "is not used" in w]
        self.assertEqual(unused, [' joint "rock" is not used', ' material "clay" is not used'])
        used = self.expect(0, "check", "m.toml", "--json", "--set", "contact.joint=rock", "--set", "block.ramp.material=clay")
        unused = [w for w in json.loads(used.stdout)["warnings"] if "is not used" in w]
        self.assertEqual([w.split(":")[0] for w in unused], ["joints.ramp"])

    def test_bad_usage_exits_2(self):
        for args in ((), ("nonsense",), ("run",), ("run", "m.toml", "--nonsense"), ("run", "m.toml", "--threads", "0"),
                     ("cut", "m.toml", "-o", "x.doc"), ("plot", "m.toml", "-o", "x.doc"), ("plot", "none"),
                     ("plot", "m.toml", "--field", "nonsense"), ("example", "nonsense"), ("run", "m.toml", "--set", "solver.nonsense=1")):
            before = self.names()
            done = self.expect(2, *args)
            self.assertTrue(done.stderr, args)
            self.assertEqual(self.names(), before)

    def test_help_and_version(self):
        self.assertRegex(self.expect(0, "--version").stdout, r"^edda \d+\.\d+")
        self.assertIn("edda example ramp", self.expect(0, "--help").stdout)
        for command in ("run", "check", "cut", "plot", "example"):
            self.assertIn("Example", self.expect(0, command, "--help").stdout)

    def test_set_changes_a_key(self):
        self.expect(0, "run", "m.toml", "--set", "solver.duration=0.002", "--set", "block.slider.velocity=[2.0, 0.0]", "-o", "o")
        rows = read_rows(self.dir / "o/history.csv")
        self.assertEqual(rows[-1]["time"], "0.002")
        self.assertAlmostEqual(float(rows[0]["M.vx"]), 2.0, delta=1e-14)
        done = self.expect(2, "run", "m.toml", "--set", "solver.duration=0.002", "--set", "solver.duratoin=1")
        self.assertTrue(done.stderr.startswith("--set:2:1"), done.stderr)

    def test_model_as_run_gives_the_same_run(self):
        self.expect(0, "run", "m.toml")
        (self.dir / "again.toml").write_bytes((self.dir / "m/model.toml").read_bytes())
        self.expect(0, "run", "again.toml")
        self.assertEqual((self.dir / "m/blocks.csv").read_bytes(), (self.dir / "again/blocks.csv").read_bytes())

    def test_model_as_run_finds_its_history_from_anywhere(self):
        import hashlib
        curve = "time,factor\n0,0\n0.01,1\n"
        (self.dir / "sub").mkdir()
        (self.dir / "sub/push.csv").write_text(curve)
        (self.dir / "sub/h.toml").write_text(RAMP + '[[load]]\npoint = [1.0, 0.5]\nforce = ["1 kN", 0]\nhistory = "push.csv"\n')
        self.expect(0, "run", "sub/h.toml", "--quiet", "-o", "r")
        (self.dir / "else").mkdir()
        self.expect(0, "run", "../r/model.toml", "--quiet", "-o", "r", cwd=self.dir / "else")
        self.assertEqual((self.dir / "r/blocks.csv").read_bytes(), (self.dir / "else/r/blocks.csv").read_bytes())
        self.assertRegex(self.expect(0, "check", "sub/h.toml").stdout, r"load 0 on block \d+ .*: \(1000, 0\) N, times 0 to 1 over 0.01 s")
        inputs = json.loads((self.dir / "r/summary.json").read_text())["inputs"]
        self.assertEqual([i["sha256"] for i in inputs][1:], [hashlib.sha256(curve.encode()).hexdigest()])

    def test_folder_rule(self):
        self.expect(0, "run", "m.toml", "--set", "output.every=0.001")
        self.expect(0, "run", "m.toml")
        self.assertEqual(len(list((self.dir / "m/frames").glob("blocks_*"))), 3)
        (self.dir / "m/notes.txt").write_text("mine")
        history = (self.dir / "m/history.csv").read_bytes()
        done = self.expect(2, "run", "m.toml", "--set", "solver.duration=0.002")
        self.assertIn("notes.txt", done.stderr)
        self.assertEqual((self.dir / "m/history.csv").read_bytes(), history)
        (self.dir / "model.toml").write_text(RAMP)
        self.expect(2, "run", "model.toml", "-o", ".")
        self.assertEqual((self.dir / "model.toml").read_text(), RAMP)

    def interrupted(self, *sent):
        run = self.start("run", "m.toml", "--set", "solver.duration=100000", "--set", "output.history_every=0.5",
                         "--set", "output.every=1000", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.wait_for("m/frames/contacts_000000.vtu", run)
        time.sleep(0.3)
        for one in sent:
            run.send_signal(one)
            time.sleep(0.01)
        run.communicate(timeout=self.seconds)
        self.assertEqual(run.returncode, 130)
        self.assertEqual({p.name for p in (self.dir / "m").iterdir()}, RESULTS | {"checkpoint.h5"})
        summary = json.loads((self.dir / "m/summary.json").read_text())
        self.assertEqual(summary["status"], "interrupted")
        self.assertEqual(read_rows(self.dir / "m/history.csv")[-1]["time"], repr(summary["time"]))

    def test_interrupt_writes_everything(self):
        self.interrupted(signal.SIGINT)

    def test_termination_writes_everything(self):
        self.interrupted(signal.SIGTERM)

    def test_terminal_that_closes_writes_everything(self):
        self.interrupted(signal.SIGHUP, signal.SIGHUP)  # from the terminal and from its shell

    def test_reader_that_goes_away_stops_no_run(self):
        (self.dir / "m.toml").write_text(RAMP.replace("duration = 0.01", "duration = 0.5"))
        for more in (["--json"], []):
            with self.subTest(more=more):
                shutil.rmtree(self.dir / "m", ignore_errors=True)
                read, written = os.pipe()
                os.close(read)
                run = self.edda("run", "m.toml", *more, stdout=written, stderr=written)
                os.close(written)
                self.assertEqual(run.returncode, 0)
                self.assertEqual(json.loads((self.dir / "m/summary.json").read_text())["status"], "completed")

    def test_stage_without_a_name_is_refused(self):
        self.expect(0, "run", "m.toml")
        before = (self.dir / "m/summary.json").read_bytes()
        self.assertIn("--from", self.expect(2, "run", "m.toml", "--from", "").stderr)
        self.assertEqual((self.dir / "m/summary.json").read_bytes(), before)

    def test_divergence_fails_and_keeps_what_was_computed(self):
        (self.dir / "m.toml").write_text(RAMP.replace("duration = 0.01", "duration = 1.0\ntime_step = 2e-3\nallow_unstable = true")
                                        .replace("poisson", "damping = 0\npoisson")
                                        .replace("every = 0.005\n", "every = 0.5\n").replace("history_every = 0.001", "history_every = 0.05"))
        done = self.expect(1, "run", "m.toml")
        self.assertRegex(done.stderr, r"diverged at \(.*\), t = .* s: .*block 1 \(slider\).*critical step")
        summary = json.loads((self.dir / "m/summary.json").read_text())
        self.assertEqual(summary["status"], "failed")
        self.assertGreater(len((self.dir / "m/history.csv").read_text().splitlines()), 1)

    def test_full_disk_exits_1_and_keeps_earlier_files(self):
        import resource
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (6000, 6000))
        done = self.edda("run", "m.toml", "--set", "output.history_every=1e-4", preexec_fn=limit)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("cannot be written", done.stderr)
        self.assertTrue((self.dir / "m/frames/blocks_000000.vtu").exists())
        self.assertFalse(list((self.dir / "m").rglob("*.part")))

    def test_bytes_do_not_depend_on_threads(self):
        self.expect(0, "example", "cavern")
        results = []
        for n in (1, 2, 7):
            self.expect(0, "run", "cavern.toml", "--quiet", "-o", f"t{n}", "--threads", str(n), "--set", "solver.duration=0.0005",
                        "--set", "output.history_every=0.00025")
            results.append([(self.dir / f"t{n}" / f).read_bytes() for f in ("blocks.csv", "joints.csv", "history.csv")])
        self.assertEqual(results[0], results[1])
        self.assertEqual(results[0], results[2])

    def test_examples_are_sound_and_never_overwrite(self):
        listed = [line.split()[0] for line in self.expect(0, "example").stdout.splitlines()[1:]]
        for name in ("ramp", "ramp-30-10", "ramp-45-10", "ramp-45-15", "cavern", "slope", "bolted-slope", "arch", "wall"):
            self.assertIn(name, listed)
        for name in listed:
            self.expect(0, "example", name)
            self.assertIn("critical step", self.expect(0, "check", name + ".toml").stdout)
        (self.dir / "ramp.toml").write_text("mine")
        self.expect(2, "example", "ramp")
        self.assertEqual((self.dir / "ramp.toml").read_text(), "mine")
        # Two models may have one table, but not another one of its name.
        (self.dir / "quake-cavern.toml").unlink()
        (self.dir / "quake-cavern-record.csv").write_text("mine")
        self.expect(2, "example", "quake-cavern")
        self.assertFalse((self.dir / "quake-cavern.toml").exists())
        self.assertEqual((self.dir / "quake-cavern-record.csv").read_text(), "mine")

    def test_ramp_slides_as_it_should(self):
        import math
        for name, a, f in (("ramp", 30, 15), ("ramp-30-10", 30, 10), ("ramp-45-10", 45, 10), ("ramp-45-15", 45, 15)):
            self.expect(0, "example", name)
            self.expect(0, "run", name + ".toml")
            last = read_rows(self.dir / name / "history.csv")[-1]
            a, f = math.radians(a), math.radians(f)
            slid = float(last["centre.ux"]) * math.cos(a) - float(last["centre.uy"]) * math.sin(a)
            exact = 0.5 * 9.8 * 0.01 * (math.sin(a) - math.tan(f) * math.cos(a))
            self.assertLess(abs(slid / exact - 1.0), 2e-3, name)

    def test_check_writes_nothing(self):
        before = self.names()
        out = self.expect(0, "check", "m.toml").stdout
        for word in ("blocks", "contacts", "critical step", "governed by", "steps", "time to expect", "warnings"):
            self.assertIn(word, out)
        self.assertEqual(self.names(), before)

    def test_check_and_run_name_the_step_of_the_first_stage(self):
        stages = '[[stage]]\nuntil = "equilibrium"\n[[stage]]\nduration = 0.001\n'
        chip = "[[block]]\npolygon = [[0.5, 1], [0.6, 1], [0.6, 1.1], [0.5, 1.1]]\n"
        (self.dir / "s.toml").write_text(RAMP[:RAMP.index("[solver]")].replace("velocity = [1.0, 0.0]\n", "") + chip + stages)
        checked = re.search(r"step +about (\S+) s in stages with scaled masses.*; (\S+) s in others", self.expect(0, "check", "s.toml").stdout)
        run = self.expect(0, "run", "s.toml").stderr
        self.assertIn(f"; step about {checked[1]} s with scaled masses; with masses as given critical step ", run)
        self.assertGreater(float(checked[1]), 2 * float(checked[2]))
        longest = json.loads((self.dir / "s/summary.json").read_text())["time_step"]["max"]
        self.assertAlmostEqual(longest / float(checked[1]), 1, delta=0.1)

    def test_verify_puts_bars_on_every_monitor(self):
        done = self.expect(0, "verify", "m.toml")
        for words in ("after 0.01 s", "M  ", " step, +- ", " stiffness, +- ", " order", "energy error"):
            self.assertIn(words, done.stdout)
        self.assertEqual(done.stderr.count("run: "), 4)
        for threads in ("1", "2", "3", "4"):
            other = self.expect(0, "verify", "m.toml", "--threads", threads)
            self.assertEqual((other.stderr, other.stdout), (done.stderr, done.stdout), threads)
        self.assertEqual(self.expect(0, "verify", "m.toml", "--quiet").stderr, "")
        as_json = self.expect(0, "verify", "m.toml", "--json")
        summary = json.loads(as_json.stdout)
        self.assertEqual((as_json.stderr, len(as_json.stdout.splitlines())), ("", 1))
        self.assertEqual((summary["time"], summary["failed"]), (0.01, ""))
        self.assertEqual([m["name"] for m in summary["monitors"]], ["M"])
        self.assertGreater(summary["monitors"][0]["step"], 0)
        self.assertEqual(self.names(), ["m.toml"])
        self.expect(2, "verify", "m.toml", "--set", "joints.ramp.friction_angle=-1")
        self.expect(2, "verify", "m.toml", "--set", "solver.time_step=0.1")
        lost = self.expect(1, "verify", "m.toml", "--set", "materials.rock.damping=0", "--set", "solver.time_step=2e-3", "--set", "solver.allow_unstable=true",
                           "--set", "solver.duration=1", "--set", "output.every=0.5", "--set", "output.history_every=0.05")
        self.assertIn("diverged", lost.stderr)

    def test_verify_can_be_interrupted(self):
        run = self.start("verify", "m.toml", "--set", "solver.duration=100000", "--set", "output.history_every=100",
                         "--set", "output.every=10000", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        with self.soon("the first run of edda verify"):
            self.assertIn(b"run: ", run.stderr.readline())
        run.send_signal(signal.SIGINT)
        run.communicate(timeout=self.seconds)
        self.assertEqual(run.returncode, 130)

    def test_progress_is_a_bar_on_a_terminal_and_silent_when_quiet(self):
        self.assertEqual(self.expect(0, "run", "m.toml", "--quiet").stderr, "")
        self.assertNotIn("\r", self.expect(0, "run", "m.toml").stderr)
        text = self.on_terminal("run", "m.toml")
        self.assertIn("100 %", text)
        self.assertIn("steps/s", text)


if __name__ == "__main__":
    unittest.main()
