"""The documentation site: Sphinx with MyST pages, notebooks and the reference of the Python package."""

from importlib.metadata import version as version_of

project = "affinor"
copyright = "the authors of affinor"  # noqa: A001
author = "the authors of affinor"
version = release = version_of("affinor")

extensions = [
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.intersphinx",
    "sphinx.ext.mathjax",
    "sphinx_copybutton",
]
html_theme = "furo"
html_title = "affinor"
html_static_path = ["static"]
exclude_patterns = ["static"]

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 600

autodoc_typehints = "none"
autosummary_generate = True
numpydoc_show_class_members = False
# no network is needed to build; links to other projects are added where it is there
intersphinx_mapping = {}
copybutton_prompt_text = r"\$ |>>> "
copybutton_prompt_is_regexp = True
suppress_warnings = ["mystnb.unknown_mime_type"]
