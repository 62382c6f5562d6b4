"""edda plot and edda cut, end to end: what is drawn, and what is refused. Usage: pictures_test.py EDDA"""
import math
import re
import unittest

from program import read_rows
from ramp import RAMP, RampProgram


class Pictures(RampProgram):
    def test_cut_in_every_format(self):
        for ending in ("svg", "png", "vtu", "csv"):
            self.expect(0, "cut", "m.toml", "-o", "cut." + ending)
            self.assertGreater((self.dir / ("cut." + ending)).stat().st_size, 100)
        rows = read_rows(self.dir / "cut.csv")
        self.assertEqual(list(rows[0]), "block material ring x y joint table".split())
        self.assertEqual(len(rows), 8)

    def test_plot_of_results_and_models(self):
        self.expect(0, "run", "m.toml")
        self.expect(0, "plot", "m")
        self.assertEqual((self.dir / "m.png").read_bytes()[:4], b"\x89PNG")
        for field in "id material displacement velocity rotation stress principal_stress normal_force shear_force opening slip state normal_stress shear_stress none".split():
            self.expect(0, "plot", "m", "--field", field, "--time", "0.005", "-o", "p.svg", "--forces", "--vectors", "velocity")
        self.expect(0, "plot", "m.toml", "-o", "model.png")

    def test_a_model_shows_its_linings_and_zones(self):
        model = "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[materials.concrete]\ndensity = 2400\nyoung = 1e10\npoisson = 0.2\n" \
                "[joints.j]\nfriction_angle = 30\n[contact]\njoint = 'j'\n[domain]\noutline = [[0, 0], [4, 0], [4, 4], [0, 4]]\nmaterial = 'rock'\n" \
                "[[opening]]\nname = 'o'\nshape = { kind = 'circle', at = [2, 2], width = 2, segments = 12 }\n" \
                "[[lining]]\nopening = 'o'\nmaterial = 'concrete'\nthickness = 0.1\n[solver]\nduration = 0.01\n"
        (self.dir / "l.toml").write_text(model)
        (self.dir / "z.toml").write_text(model + "[zones]\nsize = 0.5\n")
        for name in ("l", "z"):
            said = self.expect(0, "cut", name + ".toml", "-o", name + "-cut.svg").stdout
            self.assertRegex(said, r"blocks +1 \(0 fixed\), 13\b")
            self.assertRegex(said, r"linings +1\n")
            self.expect(0, "plot", name + ".toml", "-o", name + ".svg")
            for picture in (name + "-cut.svg", name + ".svg"):
                self.assertIn(">concrete</text>", (self.dir / picture).read_text(encoding="utf-8"))
            self.expect(0, "cut", name + ".toml", "-o", name + ".csv")
            self.assertEqual({row["material"] for row in read_rows(self.dir / (name + ".csv"))}, {"rock", "concrete"})

    def lined_ring(self):
        """A ring in vacuum under pressure, whose concrete hardens in the second stage."""
        line = ", ".join(f"[{4 * math.cos(k * math.pi / 8)}, {4 * math.sin(k * math.pi / 8)}]" for k in [*range(16), 0])
        damped = "duration = 0.05\ndamping = { local = 0.5 }\n"
        (self.dir / "r.toml").write_text(
            "gravity = [0, 0]\n[joints.j]\nfriction_angle = 30\n"
            + "".join(f"[materials.{name}]\ndensity = 2500\nyoung = {e}e9\npoisson = 0.2\nstrength = {{ ucs = {ucs}e6, tension = 1e6 }}\n"
                      for name, e, ucs in (("young", 10, 5), ("old", 30, 20)))
            + f"[[lining]]\nname = 'shell'\nalong = [{line}]\nthickness = 0.3\nsize = 2\nmaterial = 'young'\n[[load]]\nalong = [{line}]\npressure = 1e5\n"
            + f"[[stage]]\nname = 'soft'\n{damped}[[stage]]\nname = 'hard'\n{damped}change = [{{ material = 'young', to = 'old' }}]\n")
        self.expect(0, "run", "r.toml", "--quiet")

    def test_thrust_over_moment_within_the_strength_of_each_stage(self):
        self.lined_ring()
        self.expect(0, "plot", "r", "--nm", "-o", "nm.csv")
        rows = read_rows(self.dir / "nm.csv")
        self.assertEqual(list(rows[0]), ["lining", "at", "of", "thrust", "moment"])
        for stage, ucs in (("soft", 5e6), ("hard", 20e6)):
            of = lambda what: [(float(r["thrust"]), float(r["moment"])) for r in rows if r["at"] == stage and r["of"] == what]
            self.assertEqual(len(of("section")), 32)
            for thrust, _ in of("section"):
                self.assertAlmostEqual(thrust / 4e5, 1, delta=0.05)
            self.assertAlmostEqual(max(n for n, _ in of("strength")), 0.3 * ucs, delta=1)
            self.assertAlmostEqual(min(n for n, _ in of("strength")), -0.3 * 1e6, delta=1)
            exact = (ucs + 1e6) * 0.3 ** 2 / 8
            self.assertTrue(exact <= max(m for _, m in of("strength")) < 1.01 * exact)
        self.expect(0, "plot", "r", "--nm", "shell", "-o", "nm.svg")
        picture = (self.dir / "nm.svg").read_text(encoding="utf-8")
        for text in ("soft", "hard", "thrust (MN)", "shell"):
            self.assertIn(f">{text}</text>", picture)
        self.assertNotIn(">residual</text>", picture)
        text = (self.dir / "r.toml").read_text(encoding="utf-8").replace("name = 'shell'", "name = 'shell'\nresidual = { tensile_strength = 0 }")
        (self.dir / "weak.toml").write_text(text, encoding="utf-8")
        self.expect(0, "run", "weak.toml", "--quiet")
        self.expect(0, "plot", "weak", "--nm", "-o", "weak.svg")
        for text in ("strength", "residual"):
            self.assertIn(f">{text}</text>", (self.dir / "weak.svg").read_text(encoding="utf-8"))
        self.expect(0, "plot", "r", "--nm", "--time", "0.05", "-o", "t.csv")
        self.assertEqual({r["at"] for r in read_rows(self.dir / "t.csv")}, {"t = 0.05 s"})
        rows = read_rows(self.dir / "r/linings.csv")
        for row in rows:
            stage = "old" if float(row["time"]) > 0.0501 else "young"
            self.assertTrue(row["material"] == stage or abs(float(row["time"]) - 0.05) < 1e-4, row)
        self.assertAlmostEqual(float(rows[-1]["utilisation"]), 4e5 / (0.3 * 20e6), delta=0.01)
        # A run that goes on from the end of the first stage hardens alike.
        whole = (self.dir / "r/linings.csv").read_bytes()
        self.expect(0, "run", "r.toml", "--quiet", "--from", "soft")
        self.assertEqual((self.dir / "r/linings.csv").read_bytes(), whole)

    def test_thrust_over_moment_refuses_what_is_not_there(self):
        self.lined_ring()
        self.expect(0, "run", "m.toml", "--quiet")
        for words, said in ((["r", "--nm", "floor"], 'no lining "floor"'), (["m", "--nm"], "no linings.csv"),
                            (["r", "--nm", "--window", "0,0,1,1"], "leave out --scale")):
            self.assertIn(said, self.expect(2, "plot", *words, "-o", "x.svg").stderr)
        self.expect(2, "plot", "r", "--nm", "--field", "stress", "-o", "x.svg")
        self.assertFalse((self.dir / "x.svg").exists())
        for what in ("thrust", "moment", "shear", "utilisation"):
            self.expect(0, "plot", "r", "--lining", what, "-o", "x.svg")

    def test_plot_compares_times(self):
        self.expect(0, "run", "m.toml")
        self.expect(0, "plot", "m", "--compare", "0,0.01", "--field", "displacement.x", "-o", "c.svg")
        picture = (self.dir / "c.svg").read_text(encoding="utf-8")
        self.assertIn(">t = 0 s</text>", picture)
        self.assertIn(">t = 0.01 s</text>", picture)
        self.assertEqual(picture.count(">y (m)</text>"), 1)
        self.expect(0, "plot", "m", "--before", "--time", "0.005", "-o", "b.svg")
        self.assertIn(">t = 0.005 s</text>", (self.dir / "b.svg").read_text(encoding="utf-8"))

    def test_plot_draws_histories(self):
        self.expect(0, "run", "m.toml")
        self.expect(0, "plot", "m", "--history", "M.ux,energy", "-o", "h.svg", "--title", "A <b>")
        picture = (self.dir / "h.svg").read_text(encoding="utf-8")
        for text in ("M.ux", "kinetic", "displacement (mm)", "time (s)", "A &lt;b&gt;"):
            self.assertIn(f">{text}</text>", picture)
        self.expect(0, "plot", "m", "--history", "M", "-o", "h.pdf")
        self.assertEqual((self.dir / "h.pdf").read_bytes()[:5], b"%PDF-")

    def along(self, folder, line, fields):
        self.expect(0, "plot", folder, "--along", line, "--field", fields, "-o", "line.csv")
        rows = read_rows(self.dir / "line.csv")
        self.assertEqual(list(rows[0]), ["distance", "x", "y", "length", "block", *fields.split(",")])
        return [{name: float(value) for name, value in row.items()} for row in rows]

    def test_plot_along_a_column_has_the_weight_above(self):
        rock = "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.0\n[joints.j]\nfriction_angle = 30\n[contact]\njoint = 'j'\n"
        rest = "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-4\n"
        blocks = "".join(f"[[block]]\npolygon = [[0, {y}], [2, {y}], [2, {y + 1}], [0, {y + 1}]]\n" for y in range(6))
        floor = "[[block]]\nfixed = true\npolygon = [[-1, -1], [3, -1], [3, 0], [-1, 0]]\n"
        (self.dir / "w.toml").write_text(rock + floor + blocks + rest)
        self.expect(0, "run", "w.toml", "--quiet")
        rows = self.along("w", "1,6.5,1,0", "stress.yy,displacement.y")
        self.assertEqual([row["block"] for row in rows], [6, 5, 4, 3, 2, 1])
        for k, row in enumerate(rows):
            self.assertAlmostEqual(row["distance"], k + 1, delta=0.01)
            self.assertAlmostEqual(row["stress.yy"] / (2500 * 9.81 * (k + 0.5)), -1, delta=5e-3)
        zones = "[domain]\noutline = [[0, 0], [2, 0], [2, 6], [0, 6]]\n[zones]\nsize = 0.5\n" \
                "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n"
        (self.dir / "z.toml").write_text(rock + zones + rest)
        self.expect(0, "run", "z.toml", "--quiet")
        rows = self.along("z", "0.9,6,0.9,0", "stress.yy")
        self.assertGreater(len(rows), 15)
        self.assertAlmostEqual(sum(row["length"] for row in rows), 6, delta=0.01)
        for row in rows:
            self.assertAlmostEqual(row["stress.yy"], -2500 * 9.81 * row["distance"], delta=2500 * 9.81 * 0.3)
        mean = sum(row["length"] * row["stress.yy"] for row in rows) / 6
        self.assertAlmostEqual(mean / (2500 * 9.81 * 3), -1, delta=0.02)

    def test_plot_along_the_springline_has_kirschs_stresses(self):
        model = "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e10\npoisson = 0.2\n[joints.j]\nfriction_angle = 30\n[contact]\njoint = 'j'\n" \
                "[domain]\noutline = [[-12, -12], [12, -12], [12, 12], [-12, 12]]\n" \
                "[[opening]]\nname = 'o'\nshape = { kind = 'circle', at = [0, 0], width = 2, segments = 48 }\n" \
                "[initial_stress]\nstress = [-10e6, -10e6, 0]\n[[boundary]]\nsides = ['left', 'right', 'bottom', 'top']\ntype = 'roller'\n" \
                "[zones]\nsize = 0.1\ngrowth = 0.2\n[[stage]]\nuntil = 'equilibrium'\n"
        (self.dir / "k.toml").write_text(model)
        self.expect(0, "run", "k.toml", "--quiet")
        rows = self.along("k", "1,0,5,0", "stress.yy,stress.xx")
        self.assertGreater(len(rows), 15)
        exact = {"stress.yy": lambda r: -10e6 * (1 + 1 / r**2), "stress.xx": lambda r: -10e6 * (1 - 1 / r**2)}
        for name, stress in exact.items():
            off = [(row["length"], row[name] / stress(row["x"]) - 1 if name == "stress.yy" else (row[name] - stress(row["x"])) / 10e6) for row in rows]
            self.assertLess(max(abs(error) for _, error in off), 0.1, name)  # of a zone that the line cuts at a corner
            self.assertLess(sum(length * error**2 for length, error in off) / sum(length for length, _ in off), 0.02**2, name)
        self.expect(0, "plot", "k", "--along=-5,0,5,0", "--field", "stress.yy,stress.xx,strength_factor", "-o", "line.svg")
        picture = (self.dir / "line.svg").read_text(encoding="utf-8")
        for text in ("stress.yy", "stress.xx", "strength_factor", "stress (MPa)", "strength factor", "distance from (\u22125, 0) towards (5, 0) (m)"):
            self.assertIn(f">{text}</text>", picture)

    def test_plot_along_refuses_what_no_line_has(self):
        self.expect(0, "run", "m.toml", "--quiet")
        for line, field, said in (("0,0,0,0", "stress", "has no length"), ("100,0,200,0", "stress", "meets no block"),
                                  ("0,0,9,0", "slip", "contacts"), ("0,0,9,0", "none", "nothing to draw"), ("0,0,9,0", "stress.yy,up", "no field")):
            self.assertIn(said, self.expect(2, "plot", "m", "--along", line, "--field", field, "-o", "line.svg").stderr)
        self.assertIn("no folder", self.expect(2, "plot", "m.toml", "--along", "0,0,9,0").stderr)
        self.expect(2, "plot", "m", "--along", "0,0,9,0", "--history", "energy")
        self.expect(2, "plot", "m", "--field", "stress", "-o", "line.csv")
        self.assertFalse((self.dir / "line.svg").exists())

    def test_plot_draws_every_crack_however_wide(self):
        """A row of blocks is pulled apart and one of them is pushed off sideways: all that has broken is recorded and drawn."""
        model = "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e10\npoisson = 0.2\n" \
                "[joints.j]\nfriction_angle = 30\ncohesion = 2e5\ntensile_strength = 1e5\nfracture_energy = 5\nshear_fracture_energy = 5\n[contact]\njoint = 'j'\n" \
                "[[block]]\nfixed = true\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n" \
                "[[block]]\nvelocity = [3, 0]\npolygon = [[1, 0], [2, 0], [2, 1], [1, 1]]\n" \
                "[[block]]\nvelocity = [0, -3]\npolygon = [[0, -1], [1, -1], [1, 0], [0, 0]]\n" \
                "[solver]\nduration = 0.2\n[output]\nevery = 0.1\n"
        (self.dir / "c.toml").write_text(model)
        self.expect(0, "run", "c.toml", "--quiet")
        last = read_rows(self.dir / "c/history.csv")[-1]
        rows = read_rows(self.dir / "c/joints.csv")
        for mode in ("tension", "shear"):
            self.assertEqual(sum(row["broken_by"] == mode for row in rows), int(last["cracks_" + mode]), mode)
        self.assertEqual(int(last["cracks_tension"]), 2)
        self.assertEqual(len(rows), 2)
        self.assertGreater(min(float(row["opening"]) for row in rows), 0.3)
        self.expect(0, "plot", "c", "--cracks", "--field", "none", "-o", "c.svg")
        lines = re.findall('<path [^>]*stroke(?:: *|=")rgb\\(85%, ?20%, ?5%\\)[^>]*>', (self.dir / "c.svg").read_text())
        self.assertEqual(len(lines), 3)  # and one in the legend

    def test_the_mechanism_of_zones_shows_what_slides(self):
        self.expect(0, "example", "clay-slope")
        self.expect(0, "fos", "clay-slope.toml", "--set", "zones.size=2", "--set", "fos.tolerance=0.1", "-o", "clay-slope", "--quiet")
        picture = (self.dir / "clay-slope/mechanism.svg").read_text(encoding="utf-8")
        fills = re.findall('<path [^>]*fill-rule(?:: *|=")evenodd[^>]*?fill(?:: *|=")rgb\\(([^)]*)\\)', picture)
        self.assertGreater(len(fills), 100)
        self.assertGreater(len(set(fills)), 50)
        factor = float(re.search("displacements drawn ([0-9.]+) times", picture)[1])
        self.assertLess(factor * max(float(row["displacement"]) for row in read_rows(self.dir / "clay-slope/mechanism.csv")), 2)

    def test_plot_keeps_bolts_apart_whatever_their_names(self):
        self.expect(0, "run", "m.toml", "--quiet")
        for names in (("1", "2"), ("0", "B"), ("B", "0")):
            rows = [f"0.01,{name},{x},{y},1e4,0,0" for name, x in zip(names, (0.5, 1.5)) for y in (0.2, 0.8)]
            head = "time,bolt,x,y,axial_force,yielded,ruptured"
            (self.dir / "m/bolts.csv").write_text("\n".join([head, *rows, ""]))
            self.expect(0, "plot", "m", "-o", "p.svg", "--field", "none")
            lines = re.findall('<path [^>]*stroke(?:: *|=")rgb\\(5%, ?25%, ?65%\\)[^>]*>', (self.dir / "p.svg").read_text())
            self.assertEqual(len(lines), 2, names)

    def test_plot_takes_its_size_from_paper_and_pixels(self):
        for more, wide in (((), 1600), (("--width", "80mm"), 800), (("--width", "300px"), 300), (("--dpi", "127"), 800)):
            self.expect(0, "plot", "m.toml", "-o", "p.png", "--field", "material", *more)
            self.assertEqual(int.from_bytes((self.dir / "p.png").read_bytes()[16:20], "big"), wide, more)

    def test_plot_keeps_its_width_where_the_model_is_tall(self):
        tall = RAMP.replace("[-1, -1], [4, -1], [4, 0], [-1, 0]", "[0, -20], [2, -20], [2, 0], [0, 0]")
        (self.dir / "tall.toml").write_text(tall)
        for more, wide in ((("--width", "80mm"), 800), (("--width", "300px"), 300)):
            self.expect(0, "plot", "tall.toml", "-o", "p.png", *more)
            self.assertEqual(int.from_bytes((self.dir / "p.png").read_bytes()[16:20], "big"), wide, more)

    def test_plot_names_its_picture_after_the_whole_folder(self):
        self.expect(0, "run", "m.toml", "-o", "slope-1.5", "--quiet")
        for given in ("slope-1.5", "slope-1.5/", "./slope-1.5/../slope-1.5"):
            self.expect(0, "plot", given)
            (self.dir / "slope-1.5.png").unlink()

    def test_plot_refuses_with_one_message(self):
        self.expect(0, "run", "m.toml")
        for more in (("--field", "nope"), ("--history", "nope"), ("--history", "M.nope"), ("--range", "2,1"), ("--window", "0,0,0,1"),
                     ("--compare", "1"), ("--compare", "1,2,3,4,5"), ("--bolts",), ("-o", "x.gif")):
            done = self.expect(2, "plot", "m", *more)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertEqual(done.stdout, "")
        for more in (("--history", "energy"), ("--before",), ("--principal",), ("--bolts",)):
            self.assertEqual(self.expect(2, "plot", "m.toml", *more).stderr.count("\n"), 1)
        for more in (("--time", "nan"), ("--compare", "0,inf"), ("--scale", "inf"), ("--range=-inf,1",), ("--window", "0,0,nan,1"),
                     ("--set", "title='x'"), ("--width", "800px", "--dpi", "100"), ("--width", "800px", "-o", "x.svg"),
                     ("--history", "M", "--scale", "2"), ("--history", "M", "--set", "title='x'")):
            done = self.expect(2, "plot", "m", *more)
            self.assertEqual((done.stderr.count("\n"), done.stdout), (1, ""), done.stderr)
        for more in (("--time", "0"), ("--forces",), ("--field", "opening")):
            self.assertIn("is a model", self.expect(2, "plot", "m.toml", *more).stderr)
        for more in (("--range", "1"), ("--width", "9mm"), ("--width", "x"), ("--history", "M", "--forces"), ("--vectors", "up")):
            self.expect(2, "plot", "m", *more)
        self.assertEqual(self.names(), ["m", "m.toml"])

    def test_plot_says_which_window_and_time_it_cannot_show(self):
        self.expect(0, "run", "m.toml", "--quiet")
        for window in ("0,0,1e-310,1e-310", "0,0,1e-9,1", "100,100,120,120", "-1e12,-1e12,1e12,1e12"):
            for source in ("m", "m.toml"):
                done = self.expect(2, "plot", source, "--window=" + window, "-o", "w.svg")
                self.assertRegex(done.stderr, "^--window: .* the model: give a part of -1.15,-1.*,4.15,", window)
        self.assertEqual(self.names(), ["m", "m.toml"])
        self.assertEqual(self.expect(0, "plot", "m", "--window=3.9,-1,9,1", "-o", "w.svg").stderr, "")
        late = self.expect(0, "plot", "m", "--time", "99", "-o", "w.svg")
        self.assertEqual(late.stderr, "note: 99 s lies beyond the frames, which go from 0 to 0.01 s: drawn is 0.01 s\n")
        self.assertIn("use one of M", self.expect(2, "plot", "m", "--relative-to", "N").stderr)
        self.assertEqual(self.expect(0, "plot", "m", "--compare=-1,0.003,2", "-o", "w.svg").stderr.count("note: "), 2)

    def test_cut_says_what_it_took_out_and_what_it_cannot_do(self):
        self.expect(0, "example", "cavern")
        out = self.expect(0, "cut", "cavern.toml").stdout
        self.assertRegex(out, r"inside openings  \d+ blocks, not part of the model")
        self.assertRegex(out, r"cut area         .* m2 \(difference")
        (self.dir / "two.toml").write_text(RAMP.replace("[2, 0], [2, 1]", "[2, -0.5], [2, 1]"))
        self.assertIn("two.toml", self.expect(2, "cut", "two.toml").stderr)
        self.assertIn("none/cut.svg", self.expect(1, "cut", "m.toml", "-o", "none/cut.svg").stderr)
        self.assertIn("none/p.png", self.expect(1, "plot", "m.toml", "-o", "none/p.png").stderr)

    def test_plot_wants_the_folder_of_a_run(self):
        (self.dir / "empty").mkdir()
        done = self.expect(2, "plot", "empty")
        self.assertIn("give a folder that edda run has written, or a model file", done.stderr)


if __name__ == "__main__":
    unittest.main()
