"""edda view from the command line: exit codes, messages, the page's name, and how the server answers. What the page does in a
browser is in tests/view. Usage: view_test.py EDDA"""
import http.client
import json
import re
import shutil
import signal
import subprocess
import unittest

from program import Program

WALL = """title = "Wall"
[materials.rock]
density = 2000.0
young = 5e9
poisson = 0.2
[joints.mortar]
friction_angle = 30.0
[[block]]
fixed = true
polygon = [[-5, -1], [25, -1], [25, 0], [-5, 0]]
[[brick_wall]]
columns = {columns}
rows = {rows}
brick = [1.0, 0.5]
[solver]
duration = {duration}
[output]
every = {every}
history_every = 0.01
"""


class View(Program):
    def setUp(self):
        super().setUp()
        self.model(columns=2, rows=2, duration=0.02, every=0.01)

    def model(self, **numbers):
        (self.dir / "m.toml").write_text(WALL.format(**numbers))

    def serve(self, *args):
        """The port of a server that answers, and the server."""
        server = self.start("view", *args, "--serve", "--port", "0", stdout=subprocess.PIPE, text=True)
        with self.soon("the server's address"):
            return int(re.search(r"127\.0\.0\.1:(\d+)/", server.stdout.readline()).group(1)), server

    def ask(self, port, path, host=None):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
        connection.request("GET", path, headers={"Host": host} if host else {})
        reply = connection.getresponse()
        body = reply.read()
        connection.close()
        return reply.status, body

    def test_page_is_named_after_the_folder(self):
        for out in ("m", "slope-1.5"):
            self.expect(0, "run", "m.toml", "--quiet", "-o", out)
            done = self.expect(0, "view", out + "/")
            self.assertRegex(done.stdout, rf"^wrote {re.escape(out)}\.html: 3 frames, [\d.]+ MB\n$")
            self.assertTrue((self.dir / f"{out}.html").read_text(encoding="utf-8").startswith("<!doctype html>"))
        self.assertIn("wrote slope-1.5.html", self.expect(0, "view", ".", cwd=self.dir / "slope-1.5").stdout)
        self.expect(0, "view", "m", "-o", "x.HTML")
        self.assertTrue((self.dir / "x.HTML").exists())

    def test_what_cannot_be_shown_is_refused(self):
        self.expect(0, "run", "m.toml", "--quiet")
        self.assertIn("does not end in .html", self.expect(2, "view", "m", "-o", "x.pdf").stderr)
        (self.dir / "empty").mkdir()
        for folder in ("none", "empty", "m.toml"):
            for more in ((), ("--serve",)):
                self.assertIn("give a folder that edda run has written", self.expect(2, "view", folder, *more).stderr)
        self.assertIn("none/x.html", self.expect(1, "view", "m", "-o", "none/x.html").stderr)
        for more in (("--max-size", "0.1"), ("--port", "70000"), ("--nonsense",)):
            self.expect(2, "view", "m", *more)
        (self.dir / "m/frames/blocks_000001.vtu").write_text("no frame")
        self.assertIn("blocks_000001.vtu", self.expect(1, "view", "m").stderr)
        self.assertEqual([p.name for p in self.dir.glob("*.html")], [])

    def test_says_what_was_left_out(self):
        self.model(columns=20, rows=15, duration=0.15, every=0.001)
        self.expect(0, "run", "m.toml", "--quiet")
        done = self.expect(0, "view", "m", "--max-size", "1")
        kept, size = re.match(r"wrote m.html: (\d+) frames, ([\d.]+) MB\n", done.stdout).groups()
        self.assertIn(f"{151 - int(kept)} of the run's 151 frames were left out, evenly, to stay below 1 MB: --max-size", done.stdout)
        self.assertLessEqual((self.dir / "m.html").stat().st_size, 1e6)
        self.assertGreater((self.dir / "m.html").stat().st_size, 0.8e6)
        self.assertGreater(int(kept), 20)
        self.assertIn("1/65534", done.stdout)

    def test_a_port_is_served_once(self):
        self.expect(0, "run", "m.toml", "--quiet")
        port, server = self.serve("m")
        done = self.expect(2, "view", "m", "--serve", "--port", str(port))
        self.assertIn(f"port {port} is taken", done.stderr)
        self.assertEqual(done.stdout, "")
        server.send_signal(signal.SIGINT)
        self.assertEqual(server.wait(self.seconds), 0)

    def test_answers_this_machine_alone(self):
        self.expect(0, "run", "m.toml", "--quiet")
        port, _ = self.serve("m")
        for host in (None, f"localhost:{port}", f"[::1]:{port}", "127.0.0.1"):
            self.assertEqual(self.ask(port, "/run", host)[0], 200, host)
        for host in (f"example.org:{port}", "example.org", "localhost.example.org", "127.0.0.1.example.org:80", "x[::1]", ""):
            self.assertEqual(self.ask(port, "/run", host or " ")[0], 403, host)
            self.assertEqual(self.ask(port, "/", host or " ")[0], 403, host)

    def test_waits_for_the_first_frame(self):
        (self.dir / "m").mkdir()
        shutil.copy(self.dir / "m.toml", self.dir / "m/model.toml")
        port, _ = self.serve("m")
        self.assertIn("holds no blocks.pvd", self.waiting(port))
        self.assertEqual(self.ask(port, "/chunk/mesh"), (204, b""))
        shutil.rmtree(self.dir / "m")
        self.expect(0, "run", "m.toml", "--quiet")
        self.assertEqual(json.loads(self.ask(port, "/run")[1])["frames"], [0, 0.01, 0.02])

    def waiting(self, port):
        """Why there is nothing to show: no error, which browsers would log."""
        status, answer = self.ask(port, "/run")
        self.assertEqual(status, 200)
        self.assertEqual(list(json.loads(answer)), ["waiting"])
        return json.loads(answer)["waiting"]

    def test_a_run_that_is_cleared_bit_by_bit_is_no_error(self):
        self.expect(0, "run", "m.toml", "--quiet")
        port, _ = self.serve("m")
        run = json.loads(self.ask(port, "/run")[1])["run"]
        for name in ("frames/blocks_000002.vtu", "frames/blocks_000000.vtu", "model.toml", "blocks.pvd"):
            (self.dir / "m" / name).rename(self.dir / "away")
            self.assertEqual(self.ask(port, f"/chunk/frame-2?run={run}"), (204, b""), name)
            if name == "blocks.pvd":
                self.assertIn("holds no blocks.pvd", self.waiting(port))
            (self.dir / "away").rename(self.dir / "m" / name)
            status, _ = self.ask(port, f"/chunk/frame-2?run={run}")
            self.assertEqual(status, 204 if name == "blocks.pvd" else 200, "opened anew once it was found missing")
        (self.dir / "m/frames/blocks_000002.vtu").write_text("no frame")
        self.assertEqual(self.ask(port, "/run")[0], 500)

    def test_follows_a_folder_that_is_run_again(self):
        self.expect(0, "run", "m.toml", "--quiet")
        port, _ = self.serve("m")
        first = json.loads(self.ask(port, "/run")[1])
        self.assertEqual(json.loads(self.ask(port, "/run")[1])["run"], first["run"])
        self.assertEqual(self.ask(port, f"/chunk/frame-2?run={first['run']}")[0], 200)
        self.assertEqual(self.ask(port, f"/chunk/frame-3?run={first['run']}")[0], 404)
        self.model(columns=3, rows=1, duration=0.01, every=0.01)
        self.expect(0, "run", "m.toml", "--quiet", "--set", "title='Other'")
        self.assertEqual(self.ask(port, f"/chunk/frame-0?run={first['run']}")[0], 204)
        second = json.loads(self.ask(port, "/run")[1])
        self.assertNotEqual(second["run"], first["run"])
        self.assertEqual((second["title"], second["frames"]), ("Other", [0, 0.01]))
        self.assertEqual(self.ask(port, f"/chunk/frame-0?run={second['run']}")[0], 200)
        self.assertEqual(self.ask(port, f"/chunk/frame-0?run={first['run']}")[0], 204, "a page of the run before")


if __name__ == "__main__":
    unittest.main()
