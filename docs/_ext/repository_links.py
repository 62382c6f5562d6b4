"""Links from the manual to files of the repository that are no pages of it: shown as their path, since the built manual
travels without them. A path that is not there is a warning, and so an error."""
import pathlib

from docutils import nodes
from sphinx.util import logging

logger = logging.getLogger(__name__)


def show_path(app, env, node, contnode):
    del app
    target = node.get("reftarget", "").split("#")[0]
    if not target.startswith("../"):
        return None
    page = pathlib.Path(env.doc2path(env.docname if env.docname else node["refdoc"]))
    path = (page.parent / target).resolve()
    root = pathlib.Path(env.srcdir).parent
    if not path.exists():
        logger.warning("no such file: %s", target, location=node)
    shown = path.relative_to(root)
    return nodes.literal("", str(shown)) if contnode.astext() in (target, str(shown)) else nodes.inline("", contnode.astext())


def setup(app):
    app.connect("missing-reference", show_path)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
