"""An installed copy, used as a stranger would: the example is built against it out of tree, and run.

  installed_test.py BUILD SOURCE CXX
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from commands import run  # noqa: E402

BUILD, SOURCE, CXX = (pathlib.Path(a) for a in sys.argv[1:4])


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="edda_installed_")
        cls.top = pathlib.Path(cls.folder.name)
        cls.prefix = cls.top / "prefix"
        run("cmake", "--install", BUILD, "--prefix", cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_example_drives_a_simulation(self):
        build = self.top / "slide"
        run("cmake", "-G", "Ninja", "-S", self.prefix / "share/edda/examples/cpp", "-B", build,
            f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DCMAKE_CXX_COMPILER={CXX}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", build)
        out = run(build / "slide", self.prefix / "share/edda/models/ramp.toml")
        moved = [float(x) for x in re.findall(r"moved by \(([-0-9.]+),", out)]
        self.assertGreater(len(moved), 3)
        self.assertGreater(max(moved), moved[0])
        self.assertLess(moved[-1], max(moved))  # it was pushed back
        self.assertRegex(out, r"completed after 0\.2 s, energy balance error")
        bad = subprocess.run([str(build / "slide"), "nothing.toml"], capture_output=True, text=True)
        self.assertEqual(bad.returncode, 2)
        self.assertIn("nothing.toml", bad.stderr)

    def test_program_runs_from_there(self):
        self.assertIn("edda", run(self.prefix / "bin/edda", "--version"))

    def test_header_needs_nothing_but_the_standard_library(self):
        header = (self.prefix / "include/edda/edda.hpp").read_text()
        names = re.findall(r"#include\s*[<\"]([^>\"]+)", header)
        self.assertTrue(names)
        self.assertTrue(all(re.fullmatch(r"[a-z_]+", n) for n in names), names)

    def test_library_shows_its_interface_alone(self):
        library = next((self.prefix / "lib").rglob("libedda.so"))
        self.assertRegex(library.resolve().name, r"libedda\.so\.\d+\.\d+\.\d+")
        self.assertRegex(os.readlink(library), r"^libedda\.so\.(0\.\d+|[1-9]\d*)$")
        symbols = run("nm", "-DC", "--defined-only", library)
        self.assertIn("edda::api::Simulation::run()", symbols)
        own = [s for s in symbols.splitlines() if re.match(r"\w+ \w (typeinfo \w+ |vtable )?(for )?edda::", s)]
        self.assertTrue(own)
        self.assertEqual([s for s in own if "edda::api::" not in s], [])

    def test_licence_and_models_are_there(self):
        self.assertTrue((self.prefix / "share/doc/edda/LICENSE").is_file())
        self.assertTrue((self.prefix / "share/edda/models/cavern.toml").is_file())

    def test_zsh_finds_its_completion(self):
        self.assertTrue((self.prefix / "share/zsh/site-functions/_edda").is_file())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
