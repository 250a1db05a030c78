"""How the site of the Python package is built: ``sphinx-build -W --keep-going -j auto python/docs site``.

Every page that holds code is executed, and a page that fails ends the build.
"""

import os
import re
from importlib import metadata
from pathlib import Path
from typing import Any

project = "givens"
author = "The givens developers"
copyright = author
try:
    version = release = metadata.version("givens")
except metadata.PackageNotFoundError:
    # run from the source tree
    version = release = "0.1.0"

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
]
exclude_patterns = ["_build", "_jupyter", "README.md"]

# Pages are run afresh each time: a page that was right once is no proof.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 60
nb_execution_excludepatterns = ["index.md", "api/*", "guide/index.md", "examples/index.md"]
nb_merge_streams = True
# Our kernel logs errors only: the usual one warns for each page that what it says to this machine is not encrypted.
os.environ["JUPYTER_PATH"] = os.pathsep.join(
    [str(Path(__file__).parent / "_jupyter"), *filter(None, [os.environ.get("JUPYTER_PATH")])]
)
nb_render_markdown_format = "myst"
nb_number_source_lines = False
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3

autosummary_generate = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_default_options = {"members": True, "show-inheritance": True}
napoleon_google_docstring = False
napoleon_use_ivar = False
napoleon_use_rtype = False
add_module_names = False
python_use_unqualified_type_names = True
default_role = "py:obj"

html_theme = "pydata_sphinx_theme"
html_title = "givens"
html_static_path = ["_static"]
html_css_files = ["givens.css"]
html_show_sourcelink = False
html_sidebars = {"start": [], "index": []}
html_theme_options = {
    "show_nav_level": 1,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": ["theme-version"],
}


def already_told(app: Any, what: str, name: str, obj: object, skip: bool, options: Any) -> bool | None:
    """Leaves out a property that its class lists among its attributes, lest it be documented twice."""
    getter = obj.fget if isinstance(obj, property) else getattr(obj, "func", None)
    owner = getattr(getter, "__qualname__", "").partition(".")[0]
    cls = getattr(__import__("givens"), owner, None) if owner else None
    section = (cls.__doc__ or "").partition("Attributes\n")[2].partition("Examples\n")[0] if cls else ""
    listed = ", ".join(re.findall(r"^ {4}([a-z_0-9, ]+?)(?: :.*)?$", section, re.M)).split(", ")
    return True if name in listed else None


def setup(app: Any) -> None:
    """Sphinx calls this."""
    app.connect("autodoc-skip-member", already_told)
