"""The Debian package of this build: what is in it, and that it runs from where it is unpacked.

  package_test.py BUILD
"""
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from commands import run  # noqa: E402

BUILD = pathlib.Path(sys.argv[1])


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="edda_package_")
        cls.top = pathlib.Path(cls.folder.name)
        run("cpack", "-G", "DEB", "-B", cls.top / "made", cwd=BUILD)
        (cls.package,) = (cls.top / "made").glob("*.deb")
        cls.root = cls.top / "root"
        run("dpkg", "-x", cls.package, cls.root)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_everything_is_in_its_place_and_nothing_else(self):
        listed = [line.split()[5].lstrip(".") for line in run("dpkg", "-c", self.package).splitlines()]
        files = [f for f in listed if not f.endswith("/")]
        for wanted in [r"/usr/bin/edda", r"/usr/include/edda/edda\.hpp", r"/usr/lib/[^/]+-linux-gnu[^/]*/libedda\.so\.0\.\d+",
                       r"/usr/lib/[^/]+/cmake/edda/edda-config\.cmake", r"/usr/lib/python3/dist-packages/edda/_edda\..*\.so",
                       r"/usr/lib/python3/dist-packages/edda/py\.typed", r"/usr/share/doc/edda/copyright",
                       r"/usr/share/doc/edda/changelog\.Debian\.gz", r"/usr/share/edda/models/cavern\.toml",
                       r"/usr/share/edda/examples/python/cavern_sweep\.py", r"/usr/share/zsh/vendor-completions/_edda"]:
            self.assertTrue(any(re.fullmatch(wanted, f) for f in files), wanted)
        for file in files:
            self.assertRegex(file, r"^/usr/(bin/|include/edda/|lib/|share/(edda|doc/edda|lintian|man|bash-completion|zsh|fish)/)")
            self.assertNotRegex(file, r"__pycache__|\.a$|test")

    def test_it_needs_what_it_links_to(self):
        needs = run("dpkg-deb", "-f", self.package, "Depends")
        for library in ("libc6", "libstdc++6", "libgeos", "libcairo2", "libhdf5", "libfmt"):
            self.assertIn(library, needs)

    def test_what_links_to_the_library_will_need_this_minor_version(self):
        run("dpkg-deb", "-e", self.package, self.top / "control")
        name, version, needed = (self.top / "control/shlibs").read_text().split(maxsplit=2)
        self.assertRegex(version, r"^0\.\d+$")
        self.assertEqual(needed.strip(), f"edda (>= {version}.0)")
        (library,) = [f for f in self.root.rglob(f"{name}.so.*") if not f.is_symlink()]
        self.assertIn(f"[{name}.so.{version}]", run("readelf", "-d", library))

    def test_program_and_module_run_from_there(self):
        model = self.root / "usr/share/edda/models/ramp.toml"
        run(self.root / "usr/bin/edda", "run", model, "-o", self.top / "one", "--quiet", "--set", "solver.duration=0.01")
        code = f"import edda; edda.run({str(model)!r}, {str(self.top / 'two')!r}, {{'solver.duration': 0.01}}); print(edda.__file__)"
        environment = {**os.environ, "PYTHONPATH": str(self.root / "usr/lib/python3/dist-packages"), "PYTHONDONTWRITEBYTECODE": "1"}
        where = run("/usr/bin/python3", "-c", code, env=environment)
        self.assertTrue(where.startswith(str(self.root)), where)
        one, two = ((self.top / n / "history.csv").read_bytes() for n in ("one", "two"))
        self.assertTrue(one and one == two)

    def test_nothing_in_it_remembers_where_it_was_built(self):
        for file in self.root.rglob("*"):
            if file.is_file() and not file.is_symlink():
                self.assertNotIn(str(BUILD).encode(), file.read_bytes(), file)


if __name__ == "__main__":
    missing = [tool for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps") if not shutil.which(tool)]
    if missing:
        print(f"{', '.join(missing)}: not here, skipped")
        sys.exit(77)
    unittest.main(argv=[sys.argv[0]])
