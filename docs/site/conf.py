"""The documentation site: Sphinx with MyST pages, notebooks and the reference of the Python package."""

from importlib.metadata import version as version_of
from pathlib import Path

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.util import logging

logger = logging.getLogger(__name__)

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
    "sphinx_copybutton",
]
html_theme = "furo"
html_title = "affinor"
html_static_path = ["static"]
html_show_sourcelink = False
html_copy_source = False
templates_path = ["templates"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_math_renderer = "mathml"
# the page of web/, if it was built
html_extra_path = ["extra"] if (Path(__file__).parent / "extra").exists() else []
exclude_patterns = ["static", "extra", "templates"]

nitpicky = True
# types in signatures and docstrings that have no page
nitpick_ignore_regex = [("py:.*", ".*")]
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


REPAIRS = {
    ' role="heading">': ' role="heading" aria-level="2">',
    '<aside class="sidebar-drawer">': '<aside class="sidebar-drawer" aria-label="Pages">',
    '<aside class="toc-drawer': '<aside aria-label="On this page" class="toc-drawer',
    '<th class="head"><p></p></th>': "<td></td>",
    "<th></th>": "<td></td>",
}
"""Roles and names that the theme and tables leave out, for readers of screens."""


def repaired(app: Sphinx, exception: Exception | None) -> None:
    """Makes the pages accessible."""
    if exception is None:
        for page in Path(app.outdir).glob("**/*.html"):
            if "try" not in page.relative_to(app.outdir).parts:
                text = page.read_text(encoding="utf-8")
                for fault, repair in REPAIRS.items():
                    text = text.replace(fault, repair)
                page.write_text(text, encoding="utf-8")


def setup(app: Sphinx) -> None:
    """Formulas are MathML: they need no script and no network. Finished pages are made accessible."""

    def written(block: bool):
        def visit(translator, node: nodes.Element) -> None:
            try:
                formula = tex2mathml(node.astext(), as_block=block)
            except MathError as error:
                logger.warning("%s", error, location=node)
                raise nodes.SkipNode from error
            translator.body.append(f'<div class="formula">{formula}</div>' if block else formula)
            raise nodes.SkipNode

        return (visit, None)

    app.add_html_math_renderer("mathml", inline_renderers=written(False), block_renderers=written(True))
    app.connect("build-finished", repaired)
