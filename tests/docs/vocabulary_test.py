"""The sources and the manual say nothing that docs/vocabulary.md replaces by a term.

Usage: vocabulary_test.py
"""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "vocabulary.md"


def replaced():
    """Each expression in the last column, and the term that stands for it."""
    found = {}
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if line.startswith("|") and len(cells) == 3 and cells[0] != "term" and set(cells[0]) != {"-"}:
            found.update({words.strip(): cells[0] for words in cells[2].split(",") if words.strip()})
    return found


def faults_of(text, expressions):
    """Expressions that occur in a text, also across the lines of a comment."""
    plain = re.sub(r"\s*\n\s*(///?<?)?\s*", " ", text)
    return [f"{words}: say {term}" for words, term in expressions.items() if re.search(rf"\b{re.escape(words)}\b", plain)]


class Vocabulary(unittest.TestCase):
    def test_says_what_the_page_says(self):
        expressions = replaced()
        self.assertGreater(len(expressions), 15)
        faults = []
        for path in sorted([*(ROOT / "src").rglob("*.[ch]pp"), *(ROOT / "docs").rglob("*.md")]):
            if path != PAGE:
                faults += [f"{path.relative_to(ROOT)}: {fault}" for fault in faults_of(path.read_text(), expressions)]
        self.assertEqual(faults, [], "\n" + "\n".join(faults))

    def test_sees_what_is_replaced(self):
        self.assertEqual(faults_of("/// Blocks hang in the\n/// air.", {"in the air": "unsupported"}), ["in the air: say unsupported"])
        self.assertEqual(faults_of("in the airy hall", {"in the air": "unsupported"}), [])


if __name__ == "__main__":
    unittest.main()
