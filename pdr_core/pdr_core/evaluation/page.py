"""Pages that need nothing else, neither a network nor a folder beside them."""

from importlib.resources import files
from typing import Any


def page(template: str, **content: Any) -> str:
    """Return a page as text: a template of this package, which extends `page.html.j2`, filled with its content."""
    from jinja2 import Environment, FunctionLoader
    from plotly.offline import get_plotlyjs

    loader = FunctionLoader(lambda name: files("pdr_core.evaluation").joinpath(name).read_text(encoding="utf-8"))
    made = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, loader=loader).get_template(template)
    return made.render(plotly_js=get_plotlyjs(), **content)
