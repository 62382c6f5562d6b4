"""Names that the manual and the README give in backticks are there: files of the repository, C++ and Python identifiers, tests.

A span of code is looked at if it looks like one of these; all else (keys, columns, commands, values) is passed over:

  src/contacts/face.hpp, tools/manual, face_*.cpp    a file or folder of the repository, or a pattern of some
  Outcome::drift, wakes(), edda.load(...), StepControl    an identifier of the sources
  EccentricLoad.StressesOfAJoint, FactorOfSafety/Slopes    a test, or an instance of a suite
Usage: names_test.py
"""
import fnmatch
import functools
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "docs").glob("*/*.md"))]
# Where identifiers may stand, and what is no source there.
SOURCES = ("src", "tests", "bench", "tools", "page", "fuzz", "examples", "cmake")
SKIPPED = {"node_modules", "built", "__pycache__", "corpus"}
TEXTS = {".cpp", ".hpp", ".py", ".pyi", ".ts", ".mjs", ".cmake", ".in", ".txt", ".toml", ""}
# Suffixes of files that only the repository has.
OWN = (".cpp", ".hpp", ".ts", ".mjs", "_test.py")
# Functions and classes of others, which the manual mentions.
FOREIGN = {"ParaView", "Float64Array"}


@functools.cache
def files():
    """Every file of the repository's sources and pages, as paths from its root."""
    found = [p for p in ROOT.iterdir() if p.is_file()]
    for folder in (*SOURCES, "docs"):
        found += [p for p in (ROOT / folder).rglob("*") if not SKIPPED & set(p.relative_to(ROOT).parts) and p.is_file()]
    return sorted(str(p.relative_to(ROOT)) for p in found)


@functools.cache
def sources():
    """The text of each source but this one."""
    texts = []
    for name in files():
        path = ROOT / name
        if name.startswith("docs/") or path == pathlib.Path(__file__).resolve() or path.suffix not in TEXTS:
            continue
        try:
            texts.append(path.read_text(encoding="utf-8"))
        except UnicodeDecodeError:
            continue
    return texts


@functools.cache
def words():
    """All words of each source."""
    return [set(re.findall(r"\w+", text)) for text in sources()]


def known(*parts):
    """Whether one source has all of these words."""
    return any(set(parts) <= found for found in words())


@functools.cache
def tests():
    """Suite and name of every test, prefix and suite of every instance."""
    text = "\n".join(t for t in sources() if "TEST" in t)
    return set(re.findall(r"\bTEST(?:_[FP])?\(\s*(\w+),\s*(\w+)", text)), \
        set(re.findall(r"\bINSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)", text))


def in_repository(path):
    """Whether a path or pattern names something: from the root, or as the sources include it, with or without a suffix."""
    stem = path.rstrip("/")
    for base in ("", "src/", "tests/", "docs/", "page/"):
        for name in (base + stem, base + stem + ".?pp"):
            if (ROOT / name).exists() or fnmatch.filter(files(), name):
                return True
    return False


def fault_of(span):
    """What is wrong with a span of code, or None."""
    first = span.split(" ")[0].rstrip(",;:")
    if re.fullmatch(r"[\w.*-]+(/[\w.*-]+)+/?", first):
        top = first.split("/")[0]
        ours = (ROOT / top).is_dir() and top != "build" or (ROOT / "src" / top).is_dir()
        if ours or first.endswith(OWN):
            return None if in_repository(first) else "no such file"
    if re.fullmatch(r"[\w*-]+(\.[\w*-]+)+", span) and span.endswith(OWN):
        return None if any(fnmatch.fnmatch(name.rsplit("/", 1)[-1], span) for name in files()) else "no such file"
    if match := re.fullmatch(r"([A-Z]\w*)([./])([A-Z]\w*)", span):
        left, sign, right = match.groups()
        if all(re.search("[a-z]{2}", part) for part in (left, right)):
            return None if (left, right) in tests()[sign == "/"] else "no such test"
    if match := re.fullmatch(r"((?:\w+::)+\w+)(?:\(.*\))?", span):
        return None if match[1].startswith("std::") or known(*match[1].split("::")) else "no such name"
    if match := re.fullmatch(r"([A-Za-z_][\w.]*)\(.*\)", span):
        return None if known(match[1].split(".")[-1]) else "no such function"
    if re.fullmatch(r"[A-Z][a-z0-9]+([A-Z][a-z0-9]+)+", span) and span not in FOREIGN:
        return None if known(span) else "no such name"
    return None


def spans_of(text):
    """Spans of code of a page, and their lines: those in single backticks, which may go over the end of a line."""
    text = re.sub(r"^( *)```.*?^ *```$", lambda m: "\n" * m[0].count("\n"), text, flags=re.M | re.S)
    for match in re.finditer(r"(?<!`)`(?!`)((?:[^`\n]|\n(?!\s*\n))+)`(?!`)", text):
        yield text.count("\n", 0, match.start()) + 1, re.sub(r"\s+", " ", match[1]).strip()


def faults_of(text):
    return [(line, span, fault) for line, span in spans_of(text) if (fault := fault_of(span))]


class Names(unittest.TestCase):
    def test_names_of_every_page_are_there(self):
        faults, looked = [], 0
        for page in PAGES:
            text = page.read_text(encoding="utf-8")
            looked += sum(1 for _ in spans_of(text))
            faults += [f"{page.relative_to(ROOT)}:{line}: `{span}`: {fault}" for line, span, fault in faults_of(text)]
        self.assertEqual(faults, [], "\n" + "\n".join(faults))
        self.assertGreater(looked, 1000)

    def test_names_that_are_there_pass(self):
        self.assertEqual(faults_of(
            "`src/contacts/face.hpp`, `contacts/face.hpp`, `src/contacts/face_*.cpp`, `tools/manual`, `tools/fuzz 600 import`,\n"
            "`flutter_test.cpp`, `src/contacts/`, `EccentricLoad.StressesOfAJoint`, `FactorOfSafety/Slopes`, `FacePair`,\n"
            "`LawTable::resolve`, `evaluate_face()`, `edda.load(\"hillside.toml\")`, `joints.csv`, `GPa/m`, `stages/joints_0.csv`,\n"
            "`kn`, `solver.time_step = \"auto\"`, `a span\nof two lines`"), [])

    def test_invented_names_are_found(self):
        invented = ["src/contacts/invented.hpp", "contacts/invented.hpp", "src/contacts/invented_*.cpp", "tools/invented",
                    "invented_test.cpp", "nowhere/face.hpp", "src/invented/", "EccentricLoad.Invented", "Invented/Slopes",
                    "InventedName", "LawTable::invented", "invented_function()", "edda.invented(1)"]
        for name in invented:
            self.assertEqual([span for _, span, _ in faults_of(f"text `{name}` and\nmore")], [name])
        self.assertEqual(faults_of("one\n\n`kn` and\n`contacts/invented.hpp`")[0][0], 4)
        self.assertEqual(faults_of("```sh\n`contacts/invented.hpp`\n```\n"), [])


if __name__ == "__main__":
    unittest.main()
