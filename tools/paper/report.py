"""The page as it grows: text, tables, figures, and what was expected and did not hold."""
import pathlib

from paper import figures


def digits(value, count=2):
    """A number with so many digits, for tables and sentences."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = f"{value:.{count}g}"
        if "e" in text:
            return f"{float(text):,.0f}"
        return text
    mantissa, exponent = f"{value:.{count - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def plain(value):
    """A given number as it would be written by hand: 1e-5, 0.01, 100."""
    mantissa, mark, exponent = f"{value:g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if mark else mantissa


def percent(value, count=2):
    """A part of one as percent."""
    return digits(100.0 * value, count) + " %"


def times(value):
    """A ratio: 1.0 times, 2.7 times, 31 times."""
    return (f"{value:.1f}" if 0.95 <= value < 9.95 else digits(value, 2 if value < 100 else 3)) + " times"


def bytes_of(value):
    """Bytes in MB."""
    return f"{value / 1e6:,.0f} MB"


def listed(words):
    """a, b and c."""
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


class Report:
    """Collects the page; nothing is written before write()."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.parts = []
        self.figures = []
        self.broken = []
        self.verdicts = []

    def heading(self, text, level=2):
        self.parts.append("#" * level + " " + text)

    def text(self, *sentences):
        """A paragraph."""
        self.parts.append(wrapped(" ".join(sentence.strip() for sentence in sentences if sentence)))

    def points(self, items):
        """A list."""
        self.parts.append("\n".join(wrapped(item, first="- ", rest="  ") for item in items))

    def table(self, head, rows):
        lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
        self.parts.append("\n".join(lines))

    def figure(self, name, drawing, caption):
        """Keeps a matplotlib figure as figures/paper-NAME.svg and shows it."""
        file = self.folder / "figures" / f"paper-{name}.svg"
        self.figures.append((file, drawing))
        self.parts.append(f"![{caption}](figures/{file.name})")
        self.parts.append(wrapped(f"*{caption}*"))

    def verdict(self, text):
        """A sentence for the list at the head of the page."""
        self.verdicts.append(text)

    def expect(self, holds, what):
        """A bound of sanity: where it does not hold, the tool ends with 1."""
        if not holds:
            self.broken.append(what)

    def write(self):
        """The page and its figures. The path of the page."""
        (self.folder / "figures").mkdir(parents=True, exist_ok=True)
        for file, drawing in self.figures:
            figures.save(drawing, file)
        page = self.folder / "paper.md"
        page.write_text("\n\n".join(self.parts) + "\n", encoding="utf-8")
        return page

    def in_short(self, place):
        """Puts the verdicts before part number `place`."""
        if self.verdicts:
            text = "\n".join(wrapped(verdict, first="- ", rest="  ") for verdict in self.verdicts)
            self.parts[place:place] = ["## In short", text]


def wrapped(text, width=120, first="", rest=""):
    """Text in lines of at most `width`, broken at spaces alone."""
    lines, line = [], first
    for word in text.split():
        start = line in (first, rest) and not line.strip("- ")
        if not start and len(line) + 1 + len(word) > width:
            lines.append(line)
            line, start = rest, True
        line += word if start else " " + word
    return "\n".join([*lines, line])
