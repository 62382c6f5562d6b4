"""tools/mutants: its list fits the sources, and one that does not is refused with file and text."""
import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOADER = importlib.machinery.SourceFileLoader("mutants", str(ROOT / "tools" / "mutants"))
mutants = importlib.util.module_from_spec(importlib.util.spec_from_loader("mutants", LOADER))
LOADER.exec_module(mutants)

SOURCE = "double f(double a, double b) {\n  double sum = a + b;\n  sum *= 2.0;\n  return sum;\n}\n"


def mutant(number=1, **row):
    return mutants.Mutant(number, {"name": "sign", "file": "base/sum.cpp", "text": "a + b", "becomes": "a - b"} | row)


class List(unittest.TestCase):
    def test_fits_the_sources(self):
        rows, _ = mutants.read_list(ROOT / "tools" / "mutants.toml")
        self.assertGreaterEqual(len(rows), 45)
        by_file = {}
        for row in rows:
            by_file.setdefault(row.file, []).append(row)
        for name, here in by_file.items():
            self.assertIn("edda_mutant == ", mutants.mutated((ROOT / "src" / name).read_text(), here))

    def test_refuses_rows_that_mean_nothing(self):
        for row, said in (({"texts": "x"}, "unknown key texts"), ({"becomes": "a + b"}, "changes nothing"),
                          ({"text": "sum *= 2.0;", "becomes": "sum"}, "a statement becomes a statement"),
                          ({"becomes": "return a;"}, "an expression becomes an expression")):
            with self.assertRaisesRegex(mutants.Stale, said):
                mutant(**row)
        with self.assertRaisesRegex(mutants.Stale, "file, text missing"):
            mutants.Mutant(1, {"name": "sign", "becomes": "a"})

    def test_refuses_a_name_twice(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "list.toml"
            row = "[[mutant]]\nname = 'sign'\nfile = 'base/sum.cpp'\ntext = 'a'\nbecomes = 'b'\n"
            path.write_text(row + row)
            with self.assertRaisesRegex(mutants.Stale, "two mutants are called sign"):
                mutants.read_list(path)


class Source(unittest.TestCase):
    def test_has_a_switch_where_a_mutant_is(self):
        text = mutants.mutated(SOURCE, [mutant(7), mutant(8, name="one", becomes="a"),
                                        mutant(9, name="factor", text="sum *= 2.0;", becomes="")])
        self.assertIn("double sum = (edda_mutant == 8 ? (a) : ((edda_mutant == 7 ? (a - b) : (a + b))));", text)
        self.assertIn("{ if (edda_mutant == 9) {  } else { sum *= 2.0; } }", text)
        self.assertTrue(text.startswith('#include "base/mutant.hpp"\n'))

    def test_refuses_a_text_that_is_gone(self):
        with self.assertRaisesRegex(mutants.Stale, r"sign: src/base/sum.cpp: found 0 times, not once: a \* b"):
            mutants.mutated(SOURCE, [mutant(text="a * b")])

    def test_refuses_a_part_of_a_statement(self):
        with self.assertRaisesRegex(mutants.Stale, r"sign: src/base/sum.cpp: begins within a statement: a \+ b;"):
            mutants.mutated(SOURCE, [mutant(text="a + b;", becomes="a;")])

    def test_refuses_what_is_no_expression(self):
        for source, row, said in (("x.a + b;", {}, "within a name"), ("y = 2 * a + bc;", {}, "within a name"), ("y * a * 2.0;", {"text": "* a *"}, "an operator"),
                                  ("if (a > b) {", {"text": "if (a > b) {", "becomes": "if (false) {"}, "not closed"),
                                  ("y = a + b(2);", {}, "its arguments"), ("y -= a * b;", {"text": "y -= a", "becomes": "y += a"}, "what is assigned"),
                                   ("  constexpr double c = a + b;", {}, "a constant is needed")):
            with self.assertRaisesRegex(mutants.Stale, "sign: src/base/sum.cpp: .*" + said):
                mutants.mutated(source, [mutant(**row)])

    def test_refuses_a_text_that_is_there_twice(self):
        twice = mutant(text="sum", becomes="a")
        with self.assertRaisesRegex(mutants.Stale, "found 3 times, not once: sum"):
            mutants.mutated(SOURCE, [twice])
        self.assertIn("return (edda_mutant == 1", mutants.mutated(SOURCE, [mutant(text="sum", becomes="a", within="return sum;")]))

    def test_refuses_mutants_that_overlap(self):
        with self.assertRaisesRegex(mutants.Stale, "overlaps with another mutant"):
            mutants.mutated(SOURCE, [mutant(text="2.0", becomes="3.0"), mutant(2, name="whole", text="sum *= 2.0;", becomes="")])

    def test_refuses_a_declaration(self):
        with self.assertRaisesRegex(mutants.Stale, r"sign: src/base/sum.cpp: declares a variable: double sum = a \+ b;"):
            mutants.mutated(SOURCE, [mutant(text="double sum = a + b;", becomes="double sum = a;")])

    def test_refuses_a_file_that_is_gone(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "src").mkdir()
            with self.assertRaisesRegex(mutants.Stale, "there is no src/base/sum.cpp"):
                mutants.write_sources([mutant()], root, root / "scratch")


if __name__ == "__main__":
    unittest.main()
