"""tools/check_layers passes a tree that keeps to its table, and names every way not to."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "check_layers"

TABLE = """# Architecture

| folder | what enters -> what leaves | may include | libraries | files |
|---|---|---|---|---|
| `base/` | vectors | nothing | | |
| `lines/` | cutting | base | GEOS | yes |
| `blocks/` | blocks | base, lines | | |
| `results/` | files | base, `blocks/block_set.hpp` | Eigen | yes |
| `app/`, `python/` | the program | base, lines, blocks, results | CLI11 | yes |

Text after the table.
"""

SOUND = {
    "src/base/vec2.hpp": "// \"TODAY\" holds no note.\n#include <cmath>\n",
    "src/lines/cut.hpp": "#include \"base/vec2.hpp\"\n",
    "src/lines/cut.cpp": "#include \"lines/cut.hpp\"\n#include <geos/geom/Polygon.h>\n#include <fstream>\n",
    "src/blocks/block_set.hpp": "#include \"base/vec2.hpp\"\n",
    "src/blocks/nodes.cpp": "void f() { for (int k = 0; k < 3; ++k) g(k); }\n",
    "src/lines/side.cpp": "void f() { for (int k = 0; k < 3; ++k) g(k); }\n",
    "src/app/nodes.cpp": "void f() { for (int k = 0; k < nodes_per_block; ++k) g(k < 3); }\n",
    "src/blocks/build.hpp": "#include \"blocks/block_set.hpp\"\n#include \"lines/cut.hpp\"\n",
    "src/blocks/build.cpp": "#include \"blocks/build.hpp\"\n#include <cstdio>\n// #include \"results/table.hpp\"\n"
                            "char t[9]; int n = std::snprintf(t, 9, \"exit(1) cout\");  // never printf\n",
    "src/results/table.cpp": "#include \"blocks/block_set.hpp\"\n#include <Eigen/Dense>\n#include <fmt/format.h>\n",
    "src/app/main.cpp": "#include <CLI/CLI.hpp>\n#include \"blocks/build.hpp\"\nint main() { std::exit(0); }\n",
    "tests/base/vec2_test.cpp": "int x;\n" * 600,
    "src/blocks/long.cpp": "namespace edda {\nstruct Long {\n  int f() const {\n" + "    if (x) {\n    }\n" * 29 + "  }\n};\n" + "int x[] = {\n"
                           + "  1,\n" * 70 + "};\n}  // namespace edda\n",
}

# What is put into the sound tree, and what must then be said.
BROKEN = {
    "a folder above": ({"src/base/up.hpp": "#include \"lines/cut.hpp\"\n"}, "base must not include lines/cut.hpp"),
    "a folder beside": ({"src/lines/b.cpp": "\n#include \"blocks/build.hpp\"\n"}, "src/lines/b.cpp:2: lines must not include"),
    "a header that is not data": ({"src/results/b.cpp": "#include \"blocks/build.hpp\"\n"}, "results must not include blocks/build.hpp"),
    "spaced out": ({"src/base/up.hpp": "  #  include \"lines/cut.hpp\"\n"}, "base must not include lines/cut.hpp"),
    "a source file": ({"src/blocks/b.cpp": "#include \"blocks/build.cpp\"\n"}, "which is no header"),
    "no such file": ({"src/blocks/b.cpp": "#include \"build.hpp\"\n"}, "which is not below src"),
    "a folder without a row": ({"src/extra/a.cpp": "\n"}, "no row for extra"),
    "a library of another": ({"src/blocks/b.cpp": "#include <geos/geom/Point.h>\n"}, "blocks must not know GEOS"),
    "a library for none": ({"src/base/b.cpp": "#include <Eigen/Dense>\n"}, "base must not know Eigen"),
    "a stream": ({"src/blocks/b.cpp": "#include <iostream>\n"}, "blocks must not touch files or streams: <iostream>"),
    "a print": ({"src/blocks/b.cpp": "void f() { std::printf(\"x\"); }\n"}, "blocks must not touch files or streams: printf"),
    "an exit": ({"src/lines/b.cpp": "/* exit(1)\n*/\nvoid f() { exit(1); }\n"}, "src/lines/b.cpp:3: only app may end the process"),
    "a number of nodes": (
        {"src/app/b.cpp": "void f() {\n  for (std::size_t k = 0; k < 3; ++k) g(k);\n}\n"},
        "src/app/b.cpp:2: only blocks may know how many nodes a block has"),
    "modes": ({"src/app/b.cpp": "auto m = b.modes(i);\n"}, "src/app/b.cpp:1: only blocks, forces, implicit, integrate may know the modes"),
    "a circle of files": (
        {"src/lines/a.hpp": "#include \"lines/b.hpp\"\n", "src/lines/b.hpp": "#include \"lines/a.hpp\"\n"},
        "files include each other in a circle: lines/a.hpp -> lines/b.hpp -> lines/a.hpp"),
    "a file that includes itself": ({"src/lines/a.hpp": "#include \"lines/a.hpp\"\n"}, "lines/a.hpp -> lines/a.hpp"),
    "a circle of folders": (
        {"src/base/a.hpp": "#include \"lines/cut.hpp\"\n"}, "folders include each other in a circle: base -> lines -> base"),
    "a type in two headers": (
        {"src/base/a.hpp": "struct Pair {\n};\n", "src/lines/b.hpp": "\nclass Pair {\n};\n"},
        "src/lines/b.hpp:2: Pair is defined in src/base/a.hpp:1, too"),
    "a long file": ({"tests/base/long_test.cpp": "\n" * 601}, "tests/base/long_test.cpp:601: 601 lines"),
    "a long function": (
        {"bench/b.cpp": "namespace {\ntemplate <class T>\nvoid f(T x) {\n" + "  if (x) { g([] { return 1; }); }\n" * 58 + "}\n}\n"},
        "bench/b.cpp:2: a function of 61 lines"),
    "a note": ({"bench/b.cpp": "\n// TO" "DO: faster\n"}, "bench/b.cpp:2: TO" "DO"),
}


def run(files, table=TABLE):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {"docs/architecture.md": table, **files}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)


class CheckLayers(unittest.TestCase):
    def test_passes_a_sound_tree(self):
        result = run(SOUND)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_names_each_violation(self):
        for name, (files, message) in BROKEN.items():
            with self.subTest(name):
                result = run({**SOUND, **files})
                self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
                self.assertIn(message, result.stdout)

    def test_refuses_a_table_it_cannot_read(self):
        for table in ("# Architecture\n", TABLE.replace("base, lines |", "base, limes |"), TABLE.replace("GEOS", "GOES")):
            self.assertEqual(run(SOUND, table).returncode, 2)


if __name__ == "__main__":
    unittest.main()
