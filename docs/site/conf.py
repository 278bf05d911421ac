"""Configuration of Sphinx; `make docs` gathers the pages first (``build.py``) and then runs it on
them."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from docstrings import marked_up  # noqa: E402
from inventories import written  # noqa: E402
from thumbnails import make_legible  # noqa: E402

import asperity  # noqa: E402

project = "asperity"
author = "The asperity developers"
copyright = author
version = release = asperity.__version__
language = "en"

extensions = [
    "mathml",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.intersphinx",
    "sphinx_copybutton",
]
exclude_patterns = ["**/README.md", "gallery/**/*.ipynb", "gallery/**/*.py"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}

# Pages
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_dmath_double_inline = True
myst_heading_anchors = 3
suppress_warnings = ["config.cache", "ref.python"]  # fields of several records have one name

# Names
autosummary_generate = False
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_default_options = {"exclude-members": "__init__, __new__, citation_keys"}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
add_module_names = False
toc_object_entries_show_parents = "hide"
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True

# Names of other libraries are found without the network: the few that signatures use are kept in
# inventories.toml.
intersphinx_mapping = written(HERE / "inventories.toml")
intersphinx_disabled_reftypes = ["*"]

# Commands are copied without the prompt and the output.
copybutton_prompt_text = r"\$ |>>> |\.\.\. "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_title = f"asperity {version}"
html_math_renderer = "mathml"
html_static_path = [str(HERE / "static")]
html_css_files = ["asperity.css"]
html_search_scorer = str(HERE / "scorer.js")
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
pygments_style = "friendly"
pygments_dark_style = "monokai"


def setup(app):
    """Read docstrings as plain text with numpydoc sections; build the gallery where there are
    examples."""
    app.connect("autodoc-process-docstring", marked_up, priority=100)
    # after the gallery, which has the usual priority of 500
    app.connect("builder-inited", lambda app: make_legible(Path(app.srcdir) / "gallery"), priority=900)


examples = HERE.parents[1] / "build" / "docs" / "examples"
if any(examples.glob("*/*.py")):
    from sphinx_gallery.sorting import ExplicitOrder, FileNameSortKey

    levels = [name for name in ("beginner", "intermediate", "advanced", "expert") if (examples / name).is_dir()]
    extensions.append("sphinx_gallery.gen_gallery")
    sphinx_gallery_conf = {
        "examples_dirs": str(examples),
        "gallery_dirs": "gallery",
        "subsection_order": ExplicitOrder([*(f"../examples/{name}" for name in levels), "*"]),
        "within_subsection_order": FileNameSortKey,
        "filename_pattern": r"\.py$",
        "ignore_pattern": r"(__init__|conftest)\.py$",
        "abort_on_example_error": True,
        "download_all_examples": False,
        "capture_repr": (),
        "show_memory": False,
        "show_signature": False,
        "remove_config_comments": True,
        "reset_modules": ("matplotlib",),
        "plot_gallery": True,
        "min_reported_time": 10,
        "write_computation_times": False,  # its page would load scripts from the network
        "copyfile_regex": r".*\.toml",
    }
