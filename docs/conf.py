# The manual, for sphinx: tools/manual builds it.
import pathlib
import re
import sys

here = pathlib.Path(__file__).parent
sys.path.insert(0, str(here / "_ext"))

project = "edda"
author = "the edda developers"
version = release = re.search(r"project\(edda VERSION ([\d.]+)", (here.parent / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)

extensions = ["myst_parser", "mathml", "repository_links"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
root_doc = "index"
nitpicky = True

html_theme = "furo"
html_title = f"edda {version}"
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_copy_source = False
html_show_sphinx = False
# Fonts and scripts are the page's own; nothing is fetched from elsewhere.
html_theme_options = {"source_repository": "", "footer_icons": []}
pygments_style = "friendly"
pygments_dark_style = "native"
