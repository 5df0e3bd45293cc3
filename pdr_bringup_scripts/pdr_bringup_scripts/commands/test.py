"""`pdr test`: runs all tests."""

import os
import subprocess
import sys
from pathlib import Path

import typer


def test(
    context: typer.Context,
    full: bool = typer.Option(False, "--full", help="also the long figures of test/benchmark"),
) -> None:
    """Run all tests; further arguments go to pytest.

    Example: `pdr test`, or only some of them: `pdr test -k stance`
    """
    from pdr_bringup_scripts.problems import Problem

    checkout = Path(__file__).resolve().parents[3]
    if not (checkout / "test").is_dir():
        raise Problem(f"there are no tests beside {checkout}; `pdr test` needs a checkout")
    environment = os.environ | ({"PDR_FULL": "1"} if full else {})
    patience = ["-o", "faulthandler_timeout=0"] if full else []  # a long figure is no test that hangs
    command = [sys.executable, "-m", "pytest", *patience, *context.args]
    sys.exit(subprocess.run(command, cwd=checkout / "test", env=environment).returncode)
