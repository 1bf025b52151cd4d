"""How Sphinx builds the site: make docs."""

import logging
import os
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "_ext"))

# Pages run in a profile of their own, so that no setting of a user's changes what they show.
PROFILE = HERE.parent / "build" / "docs-ipython" / "profile_default"
PROFILE.mkdir(parents=True, exist_ok=True)
(PROFILE / "ipython_kernel_config.py").write_text("get_config().IPKernelApp.log_level = 40\n")
os.environ["IPYTHONDIR"] = str(PROFILE.parent)
logging.getLogger("traitlets").setLevel(logging.WARNING)

import cdcr  # noqa: E402 - after the path

project = "cdcr"
author = "The cdcr authors"
copyright = author
version = release = cdcr.__version__

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "numpydoc",
    "sphinx_copybutton",
    "breathe",
    "mathjax",
    "repository_pages",
    "thumbnails",
    "file_keys",
    "command_line",
    "cpp_reference",
    "docstrings",
]
exclude_patterns = ["_ext", "_static", "**/.ipynb_checkpoints"]
root_doc = "index"
html_theme = "furo"
html_title = f"cdcr {version}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
smartquotes = False  # a prime is a derivative
html_copy_source = False
html_show_sphinx = False
html_extra_path = []

myst_enable_extensions = ["amsmath", "deflist", "dollarmath", "fieldlist"]
myst_heading_anchors = 3

# Every cell runs at every build; an error in one is an error of the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True

default_role = "py:obj"  # `simulate` in a docstring leads to its place
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # numpydoc says the types, with shapes and units
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_validation_checks = set()

copybutton_exclude = ".linenos, .gp, .go"

breathe_default_project = "cdcr"
breathe_default_members = ("members", "undoc-members")

linkcheck_anchors = False  # pages that draw themselves have none
linkcheck_timeout = 20

# Every header says "namespace cdcr"; cells that do not run, for the check of links, have no lexer.
suppress_warnings = ["duplicate_declaration.cpp", "myst-nb.lexer"]
