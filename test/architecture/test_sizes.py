"""Files and functions stay small enough to be read at once."""

import ast

from source_tree import python_files, shown, tree

FILE_LINES = 300
FUNCTION_LINES = 40


def test_no_file_is_too_long():
    lines = {shown(path): len(path.read_text(encoding="utf-8").splitlines()) for path in python_files()}
    assert len(lines) > 50
    assert {name: count for name, count in lines.items() if count > FILE_LINES} == {}


def test_no_function_is_too_long():
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    functions = [(p, node) for p in python_files() for node in ast.walk(tree(p)) if isinstance(node, kinds)]
    lines = {f"{shown(path)}:{node.name}": node.end_lineno - node.lineno + 1 for path, node in functions}
    assert len(lines) > 200
    assert {name: count for name, count in lines.items() if count > FUNCTION_LINES} == {}
