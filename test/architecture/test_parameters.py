"""One source for every parameter: declared, documented and read, or it is not there."""

import ast
import dataclasses

import pytest
from source_tree import CHECKOUT, modules, tree

from pdr_core import params_file
from pdr_core.parameter import meta
from pdr_core.params import GROUPS

FIELDS = {f"{group}.{field.name}": field for group, cls in GROUPS.items() for field in dataclasses.fields(cls)}


def test_the_configuration_holds_the_defaults():
    config = CHECKOUT / "pdr_bringup_scripts" / "config" / "foot.yaml"
    assert config.read_text(encoding="utf-8") == params_file.default_file(), "make it anew: pdr params > " + config.name


def test_the_table_in_the_documentation_is_the_declaration():
    page = CHECKOUT / "pdr_core" / "docs" / "parameters.md"
    assert page.read_text(encoding="utf-8") == params_file.markdown(), "make it anew: pdr params --markdown"


@pytest.mark.parametrize("field", FIELDS.values(), ids=list(FIELDS))
def test_a_parameter_says_what_it_is(field):
    known = meta(field)
    assert len(known.doc) > 5
    if isinstance(field.default, float | int) and not isinstance(field.default, bool):
        assert known.bounds, "a number needs bounds"
        assert known.bounds[0] < known.bounds[1]
        assert known.bounds[0] <= field.default <= known.bounds[1]
    if known.choices:
        assert field.default in known.choices
    if field.name.endswith(("_s", "_rad", "_radps", "_mps", "_mps2", "_m", "_hz", "_deg")):
        assert known.unit, "the name says a unit, the declaration does not"


def readers(group):
    """The files that hold a group's parameters in their hands: they name its class or take it from all parameters."""
    cls = GROUPS[group].__name__
    for module, path in modules().items():
        nodes = list(ast.walk(tree(path)))
        named = any(isinstance(n, ast.Name) and n.id == cls for n in nodes)
        taken = any(isinstance(n, ast.Attribute) and n.attr == group for n in nodes)
        if (named or taken) and module != "pdr_core.params":
            yield nodes


@pytest.mark.parametrize("group", GROUPS)
def test_no_parameter_is_dead(group):
    read = {n.attr for nodes in readers(group) for n in nodes if isinstance(n, ast.Attribute)}
    assert {field.name for field in dataclasses.fields(GROUPS[group])} - read == set()
