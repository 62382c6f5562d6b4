"""Every built-in model, run as its first lines state: it shows what it is meant to show.
Usage: examples_test.py EDDA"""
import csv
import json
import math
import unittest

from program import Program


class Examples(Program):
    seconds = 300

    def ran(self, name, *args, out=None):
        """Writes the model if it is not there yet, runs it; its summary and folder."""
        out = out or name
        if not (self.dir / f"{name}.toml").exists():
            self.assertEqual(self.edda("example", name).returncode, 0)
        done = self.edda("run", f"{name}.toml", "-o", out, "--quiet", *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads((self.dir / out / "summary.json").read_text())
        # As it is shipped, a model passes all of its checks.
        self.assertEqual([c for c in summary["checks"] if not c["pass"] and
                          (not args or "overlap" in c["name"] or "chattered" in c["name"])], [])
        return summary, self.dir / out

    def rows(self, path):
        with open(path, newline="") as file:
            return list(csv.DictReader(file))

    def moved(self, folder, name):
        row = self.rows(folder / "history.csv")[-1]
        return float(row[name + ".ux"]), float(row[name + ".uy"])

    def factor(self, name, *args):
        self.assertEqual(self.edda("example", name).returncode, 0)
        done = self.edda("fos", f"{name}.toml", "-o", name, "--quiet", *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.dir / name / "summary.json").read_text())["factor_of_safety"], self.dir / name

    def test_tunnel_from_stress_to_support(self):
        summary, folder = self.ran("tunnel")
        self.assertEqual(summary["status"], "equilibrium")
        checks = {c["name"]: c for c in summary["checks"]}
        self.assertLess(checks["boundary reactions against weight"]["value"], 1e-3)
        self.assertLess(checks["initial stress: unbalanced forces at the start"]["value"], 1e-3)
        stages = self.rows(folder / "stages.csv")
        self.assertEqual([s["name"] for s in stages], ["in-situ", "heading", "support", "bench", "bench-support"])
        self.assertTrue(all(s["reached"] == "1" for s in stages))
        self.assertLess(abs(float(stages[0]["span.convergence"])), 1e-6)
        _, bare = self.ran("tunnel", "--set", "bolt_pattern=[]", "--set", "stage.support.install=[]", "--set",
                           "stage.bench-support.install=[]", out="bare")
        last, without = stages[-1], self.rows(bare / "stages.csv")[-1]
        for closure in ("span.convergence", "height.convergence"):
            self.assertTrue(0 < float(last[closure]) < float(without[closure]), closure)

    def test_tunnel_closes_as_kirsch_says(self):
        _, folder = self.ran("tunnel-closure")
        last = self.rows(folder / "stages.csv")[-1]
        self.assertAlmostEqual(float(last["height.convergence"]) / 22.73e-3, 1, delta=0.015)
        self.assertAlmostEqual(float(last["span.convergence"]) / 4.19e-3, 1, delta=0.1)
        _, folder = self.ran("tunnel-closure", "--set", "deformation=uniform", out="uniform")
        self.assertLess(float(self.rows(folder / "stages.csv")[-1]["height.convergence"]), 0.7 * 22.73e-3)

    def test_roof_of_voussoirs_arches(self):
        _, folder = self.ran("voussoir-roof")
        self.assertAlmostEqual(-self.moved(folder, "mid-span")[1] / 9.8e-3, 1, delta=0.03)
        thrust = sum(float(j["normal_force"]) for j in self.rows(folder / "joints.csv") if abs(float(j["x"])) < 0.02)
        self.assertAlmostEqual(thrust / 0.43e6, 1, delta=0.05)

    def test_slope_slides_unless_its_beds_are_rough(self):
        _, folder = self.ran("slope")
        self.assertLess(self.moved(folder, "crest")[0], -3.0)
        _, folder = self.ran("slope", "--set", "joints.bedding.friction_angle=45", out="rough")
        self.assertLess(math.hypot(*self.moved(folder, "crest")), 0.01)

    def test_slope_has_a_factor_of_safety_below_one(self):
        factor, folder = self.factor("slope", "--set", "fos.bracket=[0.5, 0.7]", "--set", "fos.tolerance=0.03")
        # A block on the beds alone has tan 20/tan 32 = 0.582; blocks that topple on the face reduce it a little.
        self.assertLess(abs(factor / (math.tan(math.radians(20)) / math.tan(math.radians(32))) - 1), 0.07)
        self.assertTrue((folder / "mechanism.png").exists())

    def test_toppling_slope_goes_as_goodman_and_bray_say(self):
        factor, folder = self.factor("toppling")
        at_limit = math.degrees(math.atan(math.tan(math.radians(40)) / factor))
        self.assertLess(abs(at_limit - 38.15), 1.5)
        motion = {int(row["name"]): row["motion"] for row in self.rows(folder / "mechanism.csv")}
        for n in range(1, 14):
            self.assertEqual(motion[n], "slides" if n < 4 else "topples", n)

    def test_arch_stands(self):
        summary, _ = self.ran("arch")
        self.assertEqual(summary["status"], "equilibrium")
        self.assertLess(summary["energy"]["kinetic"], 1.0)

    def test_wall_is_hit(self):
        summary, folder = self.ran("wall")
        self.assertEqual(summary["status"], "completed")
        self.assertLess(abs(summary["energy"]["drift"]), 1e-4)
        self.assertGreater(max(math.hypot(float(b["ux"]), float(b["uy"])) for b in self.rows(folder / "blocks.csv")), 0.05)

    def test_pushover_collapses_where_rigid_blocks_do(self):
        summary, folder = self.ran("pushover")
        self.assertEqual(summary["status"], "completed")
        ramp = summary["ramps"]["push"]
        self.assertLessEqual(ramp["holds"], math.tan(math.radians(33)))
        self.assertGreaterEqual(ramp["fails"], math.tan(math.radians(33)) - 1e-3)
        self.assertAlmostEqual(ramp["fails"] - ramp["holds"], 0.005)
        self.assertEqual(len(self.rows(folder / "curve.csv")), round(ramp["fails"] / 0.005) + 1)
        self.assertTrue((folder / "curve.png").exists() and (folder / "curve.svg").exists())

    def test_roof_wedge_hangs_on_its_bolts(self):
        summary, folder = self.ran("roof-wedge")
        self.assertEqual(summary["status"], "equilibrium")
        # Smooth flanks carry nothing: each bolt carries half the weight of 4 x 2.4/2 m2, 1.5 m apart.
        force = 0.5 * 4.8 * 27e3 * 1.5
        for row in self.rows(folder / "bolts.csv")[-4:]:
            self.assertLess(abs(float(row["axial_force"]) / force - 1.0), 1e-3)
        loose, folder = self.ran("roof-wedge", "--set", "bolt=[]", out="loose")
        self.assertEqual(loose["status"], "collapsed")
        # The run ends when it has left its place: by a tenth of the square root of its 4.8 m2.
        self.assertLess(self.moved(folder, "wedge")[1], -0.2)

    def test_newmark_slides_by_the_closed_form(self):
        _, folder = self.ran("newmark")
        slid = math.hypot(*self.moved(folder, "block"))
        self.assertLess(abs(slid / (4 * 0.078405) - 1.0), 0.01)
        _, folder = self.ran("newmark", "--set", "shaking.quake.scale=0.3", out="weak")
        self.assertLess(math.hypot(*self.moved(folder, "block")), 1e-3)

    def test_dam_slides_when_water_is_high_enough(self):
        _, folder = self.ran("dam")
        stages = self.rows(folder / "stages.csv")
        start, rows = float(stages[0]["end"]), self.rows(folder / "history.csv")
        # gw h^2/2 = (W - U) tan 28, U under the submerged part of the base; h rises by 11.9 m in 9 s.
        weight, t = 72 * 24e3, math.tan(math.radians(28))
        limit = math.sqrt(weight * t / (9810 / 2 * (1 + 10 / 11.9 * t)))
        gone = next(float(r["time"]) - start for r in rows if float(r["crest.ux"]) > 0.005)
        self.assertLess(abs(gone * 11.9 / 9 / limit - 1.0), 0.05)
        _, folder = self.ran("dam", "--set", "joints.rock.friction_angle=35", out="rough")
        self.assertLess(self.moved(folder, "crest")[0], 0.005)

    def test_squeezing_is_held_back_by_bolts(self):
        _, folder = self.ran("squeezing")
        _, bare = self.ran("squeezing", "--set", "bolt_pattern=[]", "--set", "stage.support.install=[]", out="bare")
        face, last = self.rows(folder / "stages.csv")
        without = self.rows(bare / "stages.csv")[-1]
        for closure in ("span.convergence", "height.convergence"):
            self.assertLess(3 * float(face[closure]), float(last[closure]))
            self.assertAlmostEqual(float(last[closure]) / float(without[closure]), 0.87, delta=0.03)

    def loads(self, folder):
        return [-float(row["load.fy"]) for row in self.rows(folder / "reactions.csv")]

    def test_pillar_spalls(self):
        _, folder = self.ran("pillar")
        loads = self.loads(folder)
        self.assertGreater(max(loads) / 6, 20e6)    # N/m2
        self.assertLess(loads[-1], 0.85 * max(loads))

    def test_paste_carries_its_weight(self):
        _, folder = self.ran("stopes")
        stages = self.rows(folder / "stages.csv")
        history = self.rows(folder / "history.csv")

        def stress(stage):  # mean vertical stress of paste 1 at the end of a stage, Pa
            end = float(stages[stage]["end"])
            return [float(row["paste 1.mean_syy"]) for row in history if float(row["time"]) <= end + 1e-9][-1]
        self.assertTrue(all(stage["reached"] == "1" for stage in stages))
        self.assertLess(-stress(2), 15 * 2000 * 9.81)
        self.assertGreater(-stress(2), 0.3 * 15 * 2000 * 9.81)

    def test_crest_settles_least(self):
        _, folder = self.ran("dam-lifts")
        lake = float(self.rows(folder / "stages.csv")[5]["end"])
        before = [row for row in self.rows(folder / "history.csv") if float(row["time"]) <= lake + 1e-9][-1]
        self.assertLess(float(before["half-way.uy"]), 2.0 * float(before["crest.uy"]))
        self.assertLess(float(before["crest.uy"]), 0.0)

    def test_drains_take_the_uplift(self):
        _, folder = self.ran("dam-seepage")
        self.assertTrue(all(stage["reached"] == "1" for stage in self.rows(folder / "stages.csv")))

        def uplift(stage):  # N, of the base of the dam at the end of a stage
            rows = self.rows(folder / f"joints_{stage}.csv")
            return sum(0.5 * (float(r["water_pressure_a"]) + float(r["water_pressure_b"])) * float(r["length"])
                       for r in rows if r["joint"] == "base")
        drained, clogged = uplift(3), uplift(4)
        self.assertLess(drained, 0.75 * clogged)
        # Linear from reservoir to tailwater, if the rock below conducted nothing.
        self.assertAlmostEqual(clogged / (9810 * 25 * 0.5 * (28 + 2)), 1.0, delta=0.25)
        flows = {}
        for row in self.rows(folder / "flow.csv"):
            flows.setdefault(row["time"], []).append(float(row["inflow"]))
        for inflow in flows.values():
            self.assertLess(abs(sum(inflow)), 1e-9 * max(map(abs, inflow), default=0) + 1e-15)

    def test_joints_fill_and_drain(self):
        _, folder = self.ran("rain-slope")
        self.assertTrue(all(row["holds"] == "1" for row in self.rows(folder / "curve.csv")))

        def water(stage):  # N, of all joints at the end of a stage
            return sum(0.5 * (float(r["water_pressure_a"]) + float(r["water_pressure_b"])) * float(r["length"])
                       for r in self.rows(folder / f"joints_{stage}.csv") if r["water_pressure_a"])
        dry, storm, after = water(1), water(2), water(3)
        self.assertGreater(storm, 1.2 * dry)
        self.assertLess(after, 0.5 * (storm + dry))
        rain = [float(row["inflow"]) for row in self.rows(folder / "flow.csv") if row["water"] == "rain"]
        # No more than falls on 90 m of ground.
        self.assertGreater(max(rain), 0.3 * 90 * 3e-3 / 3600)
        self.assertLess(max(rain), 90 * 3e-3 / 3600 * (1 + 1e-6))

    def thrusts(self, folder, time):
        """Thrusts of each lining (N), and the largest utilisation, at the frame nearest to a time."""
        rows = self.rows(folder / "linings.csv")
        frame = min({row["time"] for row in rows}, key=lambda t: abs(float(t) - time))
        found = {}
        for row in rows:
            if row["time"] == frame:
                found.setdefault(row["lining"], []).append(float(row["thrust"]))
        return found, max(float(row["utilisation"]) for row in rows if row["time"] == frame)

    def test_horseshoe_closes_its_ring(self):
        _, folder = self.ran("horseshoe-tunnel")
        stages = self.rows(folder / "stages.csv")
        self.assertTrue(all(stage["reached"] == "1" and stage["loose"] == "0" for stage in stages))
        closed = [0.5 * (float(s["span.convergence"]) + float(s["height.convergence"])) for s in stages]
        linings, used = self.thrusts(folder, float(stages[-1]["end"]))
        mean = {name: sum(n) / len(n) for name, n in linings.items()}
        # All have thrust, less than if they followed the walls all round: 10 m wide, E/(1 - nu^2) t.
        self.assertTrue(all(min(n) > 0 for n in linings.values()))
        young, hard, concrete = (e / 0.96 * t for e, t in ((5e9, 0.25), (15e9, 0.25), (25e9, 0.4)))
        crown = (young * (closed[2] - closed[1]) + hard * (closed[-1] - closed[2])) / 10
        self.assertTrue(0.4 * crown < mean["crown"] < 0.8 * crown)
        invert = concrete * (closed[-1] - closed[-2]) / 10
        self.assertTrue(0.6 * invert < mean["invert"] < invert)
        self.assertTrue(0.2 < used < 0.7)
        last = {row["lining"]: row["material"] for row in self.rows(folder / "linings.csv")}
        self.assertEqual(last["left wall"], "hard shotcrete")

    def test_lined_cavern_stands_an_earthquake(self):
        # Blocks twice as large, and the first waves.
        summary, folder = self.ran("lined-cavern-quake", "--set", "joint_set.steep.spacing=5", "--set",
                                   "joint_set.flat.spacing=5.6", "--set", "stage.earthquake.duration=2.8")
        self.assertEqual(summary["status"], "completed")
        self.assertLess(abs(summary["energy"]["drift"]), 1e-4)
        stages = self.rows(folder / "stages.csv")
        self.assertTrue(all(stage["loose"] == "0" for stage in stages))
        before, _ = self.thrusts(folder, float(stages[2]["end"]))
        mean = sum(before["shotcrete"]) / len(before["shotcrete"])
        closed = float(stages[2]["span.convergence"]) - float(stages[1]["span.convergence"])
        self.assertAlmostEqual(mean / (15e9 / 0.96 * 0.2 * closed / 12), 1, delta=0.3)
        after, used = self.thrusts(folder, float(stages[3]["end"]))
        self.assertTrue(max(after["shotcrete"]) > 1.1 * max(before["shotcrete"]) and used < 0.5)
        done = self.edda("spectra", "lined-cavern-quake", "--between", "base,crown", "--periods", "0.1,2,30", "-o", "spectra")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(max(float(r["amplification"]) for r in self.rows(self.dir / "spectra/amplification.csv")), 1.3)

    def test_disc_splits(self):
        # Grains of 4.5 in place of 2.7 mm.
        _, folder = self.ran("brazilian-disc", "--set", "voronoi.size=4.5 mm")
        force = [float(row["base.fy"]) for row in self.rows(folder / "reactions.csv")]
        self.assertAlmostEqual(2 * max(force) / (math.pi * 0.054) / 10e6, 1, delta=0.1)
        self.assertLess(force[-1], 0.75 * max(force))
        rows = self.rows(folder / "history.csv")
        self.assertGreater(max(float(row["middle.mean_sxx"]) for row in rows), 6.5e6)
        self.assertLess(float(rows[-1]["middle.mean_sxx"]), 1e6)
        self.assertLess(max(abs(float(row["drift"])) for row in rows), 1e-5)
        self.assertGreater(int(rows[-1]["cracks_tension"]), 15)
        # Its halves move apart.
        for block in self.rows(folder / "blocks.csv"):
            if abs(float(block["x"])) > 0.01 and abs(float(block["y"])) < 0.015:
                self.assertGreater(float(block["ux"]) * math.copysign(1, float(block["x"])), 2e-5)

    def test_footing_breaks_through(self):
        _, folder = self.ran("footing")
        _, intact = self.ran("footing", "--set", "joint_set=[]", out="intact")
        self.assertTrue(0.5 < self.loads(folder)[-1] / self.loads(intact)[-1] < 0.8)

    def test_clay_slope_is_as_safe_as_taylor_says(self):
        factor, _ = self.factor("clay-slope")
        self.assertAlmostEqual(factor / 1.199, 1, delta=0.02)

    def test_rockfall_stops(self):
        summary, folder = self.ran("rockfall")
        self.assertLess(summary["energy"]["kinetic"], 1.0)
        heights = [float(b["y"]) for b in self.rows(folder / "blocks.csv") if b["name"]]
        for y in heights:
            self.assertTrue(any(0.2 < y - level < 1.2 for level in (0, 8, 16, 24)), heights)
        self.assertLess(min(heights), 20)

    def test_cavern_stands_an_earthquake(self):
        summary, folder = self.ran("quake-cavern")
        self.assertEqual(summary["status"], "completed")
        self.assertLess(abs(summary["energy"]["drift"]), 1e-4)
        history = [r for r in self.rows(folder / "history.csv")]
        peak = {m: max(abs(float(r[m + ".vx"])) for r in history) for m in ("base", "surface")}
        self.assertGreater(peak["surface"], 1.2 * peak["base"])


if __name__ == "__main__":
    unittest.main()
