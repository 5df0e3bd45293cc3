"""Counts the operations on floats of both methods while they run (Zhou Table 8), and times them without a compiler.

    NUMBA_DISABLE_JIT=1 python -m pdr_bringup_scripts.benches.zhou_count 200 26 count  # rate [Hz], length [m]

The sources of the stages are rewritten as they are imported: every `a + b`, `a * b`, `a @ b`, `a += b` counts what it
does if its outcome is a float or an array of them: one for each number; a product of matrices m n p (Zhou eq. 24); the
common functions of numpy the size of their argument, and what solves equations the cube of their number. Comparisons,
whole numbers and copies count nothing. Python runs what numba would have compiled, so both methods are in one language,
as they are in Zhou's Matlab. What both remember is kept in plain objects, for Python looks up a field of a numpy record
fifty times as slowly, and that would be most of what is timed.
"""

import ast
import json
import operator
import sys
import time
from importlib.abc import MetaPathFinder
from importlib.machinery import PathFinder, SourceFileLoader
from typing import Any

STAGES = tuple(f"pdr_core.{stage}" for stage in ("stance", "strapdown", "eskf", "maths", "gait", "pipeline"))
CUBED = {"solve", "inv", "eigvalsh"}
SIZED = {
    "sum", "mean", "cumsum", "diff", "sqrt", "cbrt", "sin", "cos", "tan", "arctan2", "atan2", "hypot", "exp", "log",
    "norm", "abs", "fabs", "square", "outer", "median", "std", "var", "dot", "cross", "max", "min", "interp",
}  # fmt: skip
NAMES = {
    "Add": "add", "Sub": "sub", "Mult": "mul", "Div": "truediv", "Pow": "pow", "Mod": "mod", "FloorDiv": "floordiv",
    "MatMult": "matmul", "BitAnd": "and_", "BitOr": "or_", "BitXor": "xor", "LShift": "lshift", "RShift": "rshift",
}  # fmt: skip
total = 0


def floats(value: Any) -> int:
    """Return how many floats a value has; none of whole numbers and flags."""
    if isinstance(value, float):
        return 1
    return int(value.size) if getattr(getattr(value, "dtype", None), "kind", "") == "f" else 0


def operated(name: str, left: Any, right: Any) -> Any:
    """Do an operation, the name of a function of `operator`, and count it."""
    global total
    result = getattr(operator, name)(left, right)
    inner = left.shape[-1] if name == "matmul" else 1
    total += floats(result) * inner
    return result


def called(name: str, function: Any, *arguments: Any, **options: Any) -> Any:
    """Call a function, and count the largest of its arguments, or of what it is a method of."""
    global total
    sizes = [floats(value) for value in (*arguments, getattr(function, "__self__", None))]
    total += round(max(sizes) ** 1.5) if name in CUBED else max(sizes)
    return function(*arguments, **options)


class Counting(ast.NodeTransformer):
    """Rewrites a module so that it counts."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        """Count a binary operation."""
        self.generic_visit(node)
        return ast.copy_location(counted("operated", NAMES[type(node.op).__name__], node.left, node.right), node)

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
        """Count an operation in place: the target is evaluated twice, which changes nothing."""
        self.generic_visit(node)
        loaded = ast.parse(ast.unparse(node.target), mode="eval").body
        in_place = f"i{NAMES[type(node.op).__name__]}".rstrip("_")
        done = counted("operated", in_place, loaded, node.value)
        return ast.copy_location(ast.Assign([node.target], done), node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        """Count a call of one of the functions whose size counts."""
        self.generic_visit(node)
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        if name not in SIZED | CUBED:
            return node
        call = counted("called", name, node.func, *node.args)
        call.keywords = node.keywords
        return ast.copy_location(call, node)


def counted(function: str, name: str, *arguments: ast.expr) -> ast.Call:
    """Return the call of one of the functions above."""
    return ast.Call(ast.Name(f"{function}_counted", ast.Load()), [ast.Constant(name), *arguments], [])


class CountingLoader(SourceFileLoader):
    """Loads a module that counts."""

    def get_code(self, fullname: str) -> Any:
        """Return the code of the rewritten source, without looking for code that was compiled before."""
        path = self.get_filename(fullname)
        tree = ast.fix_missing_locations(Counting().visit(ast.parse(self.get_data(path))))
        return compile(tree, path, "exec")

    def exec_module(self, module: Any) -> None:
        """Run the module with what it counts by."""
        vars(module).update(operated_counted=operated, called_counted=called)
        super().exec_module(module)


class CountingFinder(MetaPathFinder):
    """Finds the stages."""

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        """Return how a stage is loaded; None: as usual."""
        spec = PathFinder.find_spec(name, path, target) if name.startswith(STAGES) else None
        if spec and spec.origin and name != "pdr_core.maths.compiled" and spec.origin.endswith(".py"):
            spec.loader = CountingLoader(name, spec.origin)
            return spec
        return None


def counts(rate_hz: int, length_m: float, counting: bool) -> dict[str, dict[str, float]]:
    """Return operations and time of a step by each method; without counting the operations are none."""
    if counting:
        sys.meta_path.insert(0, CountingFinder())
    from pdr_core.bench.plain_memory import remember_plainly  # before the others: they keep the functions they import

    remember_plainly()
    from pdr_core.bench.zhou_steps import METHODS, prepared

    found, walk = {}, prepared(rate_hz, length_m)
    for name, method in METHODS.items():
        take = method(walk)
        before, start_s = total, time.process_time()
        take()
        taken_s = time.process_time() - start_s
        found[name] = {"operations": (total - before) / walk.strides, "ms": 1e3 * taken_s / walk.strides}
    return found


if __name__ == "__main__":
    sys.stdout.write(json.dumps(counts(int(sys.argv[1]), float(sys.argv[2]), sys.argv[3] == "count")))
