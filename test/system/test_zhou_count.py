"""How the operations of a step are counted: a rewritten source does the same, and counts what it does with floats."""

import ast
import json
import os
import subprocess
import sys

import numpy as np

from pdr_bringup_scripts.benches import zhou_count

SOURCE = """
import numpy as np
def walk(a, B, n):
    n += 1            # a whole number
    c = a * 2.0 + 1.0     # 2 of a scalar
    v = B @ B[:, 0]       # 9 of a matrix of 3 by 3 and a vector
    v -= c                # 3
    B[0, 0] += c          # 1
    flag = n > 3 | 0      # none
    return np.linalg.solve(B, v).sum(), v, B, n  # 27, and a sum of 3
"""


def run(source, *arguments):
    names = {"operated_counted": zhou_count.operated, "called_counted": zhou_count.called}
    exec(compile(source, "toy", "exec"), names)
    return names["walk"](*arguments)


def test_a_rewritten_source_does_the_same_and_counts_what_it_does():
    matrix = np.diag([2.0, 3.0, 4.0])
    counting = ast.fix_missing_locations(zhou_count.Counting().visit(ast.parse(SOURCE)))
    before = zhou_count.total
    told = run(counting, 0.5, matrix.copy(), 3)
    assert zhou_count.total - before == 2 + 9 + 3 + 1 + 27 + 3
    plain = run(ast.parse(SOURCE), 0.5, matrix.copy(), 3)
    assert all(np.array_equal(a, b) for a, b in zip(told, plain, strict=True))


def test_a_process_without_a_compiler_counts_and_times_a_step():
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-m", "pdr_bringup_scripts.benches.zhou_count", "20", "10", "count"],
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    found = json.loads(run.stdout)
    zupt, ours = found["ZUPT-KF"], found["ours"]
    assert 0.0 < ours["ms"] < 0.5 * zupt["ms"]
    assert zupt["operations"] > 2.0 * ours["operations"] > 1000.0
