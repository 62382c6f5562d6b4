"""Formulas as MathML, which browsers draw themselves: no script, no fonts, no network.

KaTeX (Debian's package katex) translates them, all of a build's new ones in one go.
"""
import json
import os
import re
import subprocess
import unicodedata

from docutils import nodes
from sphinx.errors import ExtensionError

TRANSLATE = """
const katex = require("katex");
const formulas = JSON.parse(require("fs").readFileSync(0, "utf8"));
console.log(JSON.stringify(formulas.map(([text, display]) =>
  katex.renderToString(text, {output: "mathml", displayMode: display, throwOnError: true}))));
"""

known = {}


def bold(found):
    """A letter or digit of a vector or matrix as a bold character: browsers leave mathvariant="bold" out."""
    tag, text = found.group(1), found.group(2)
    kinds = {"LATIN CAPITAL LETTER": "CAPITAL", "LATIN SMALL LETTER": "SMALL", "GREEK CAPITAL LETTER": "CAPITAL",
             "GREEK SMALL LETTER": "SMALL", "DIGIT": "DIGIT"}
    letters = []
    for letter in text:
        name = unicodedata.name(letter)
        kind = next((k for k in kinds if name.startswith(k + " ")), None)
        letters.append(unicodedata.lookup(f"MATHEMATICAL BOLD {kinds[kind]} {name[len(kind) + 1:]}") if kind else letter)
    return f'<{tag} mathvariant="normal">{"".join(letters)}</{tag}>'


def translate(formulas):
    """MathML of each (text, whether it stands on a line of its own)."""
    paths = os.pathsep.join(filter(None, [os.environ.get("NODE_PATH"), "/usr/share/nodejs"]))
    run = subprocess.run(["node", "-e", TRANSLATE], input=json.dumps(formulas), env={**os.environ, "NODE_PATH": paths},
                         capture_output=True, text=True, check=False)
    if run.returncode != 0:
        raise ExtensionError(f"a formula is not understood, or katex is missing:\n{run.stderr[:2000]}")
    return [re.sub(r'<(m[in]) mathvariant="bold(?:-italic)?">([^<]+)</\1>', bold, mathml) for mathml in json.loads(run.stdout)]


def collect(app, doctree):
    """Translates the formulas of a page that are new."""
    del app
    found = {(node.astext(), isinstance(node, nodes.math_block)) for node in doctree.findall(lambda n: isinstance(n, (nodes.math, nodes.math_block)))}
    new = sorted(found - known.keys())
    if new:
        known.update(zip(new, translate(new)))


def visit(self, node):
    display = isinstance(node, nodes.math_block)
    key = (node.astext(), display)
    if key not in known:  # the page was read in an earlier build
        known[key] = translate([key])[0]
    tag = "div" if display else "span"
    self.body.append(f'<{tag} class="math">{known[key]}</{tag}>')
    raise nodes.SkipNode


def setup(app):
    app.connect("doctree-read", collect)
    app.add_html_math_renderer("mathml", inline_renderers=(visit, None), block_renderers=(visit, None))
    app.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
