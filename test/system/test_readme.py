"""What the README says can be typed: every command of its bash blocks, in an empty folder."""

import os
import re
import shlex
import subprocess
from pathlib import Path

import pytest

from pdr_core.params_file import default_file

CHECKOUT = Path(__file__).resolve().parents[2]
README = (CHECKOUT / "README.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"(<!-- not run\b[^>]*-->\n+)?^```bash\n(.*?)^```", re.MULTILINE | re.DOTALL)
COMMANDS = [(line, mark) for mark, block in BLOCK.findall(README) for line in block.splitlines() if line.strip()]
THIS = "pdr_bringup_scripts/pdr test"  # it is running
TYPED = [line for line, marked in COMMANDS if not marked and line != THIS]
WITH_PARTS = ("calibrate",)  # commands that have commands of their own
OF_YOURS = [line for line, marked in COMMANDS if "is yours" in marked]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, ros_environment: int) -> Path:  # noqa: ARG001
    """An empty folder from which the commands are found as from a checkout."""
    folder = tmp_path_factory.mktemp("reader")
    (folder / "pdr_bringup_scripts").symlink_to(CHECKOUT / "pdr_bringup_scripts")
    return folder


def typed(command: str, folder: Path) -> subprocess.CompletedProcess:
    """Run a command as a shell does."""
    return subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, timeout=600)


def test_the_main_job_and_the_tests_are_one_command_each() -> None:
    assert "pdr_bringup_scripts/pdr demo" in TYPED
    assert (THIS, "") in COMMANDS


@pytest.mark.parametrize("command", TYPED)
def test_a_command_works(command: str, folder: Path) -> None:
    run = typed(command, folder)
    assert run.returncode == 0, run.stderr
    named = re.findall(r"Open (\S+) in a browser", run.stdout)
    assert all((folder / name).stat().st_size > 1000 for name in named)
    assert run.stdout.strip() or ">" in command, "it neither says anything nor writes a file"
    assert "demo" not in command or named


def test_the_demo_leaves_what_it_names(folder: Path) -> None:
    (out,) = (folder / "pdr_runs").iterdir()
    assert {path.name for path in out.iterdir()} >= {
        "recording",
        "trajectory.tum",
        "strides.csv",
        "result.json",
        "report.html",
    }


def test_the_parameter_file_is_one_to_start_from(folder: Path) -> None:
    assert (folder / "mine.yaml").read_text(encoding="utf-8") == default_file()


@pytest.mark.parametrize("command", OF_YOURS)
def test_a_command_on_your_files_has_these_options(command: str, folder: Path) -> None:
    program, name, *rest = shlex.split(command)
    path = f"{program} {name} {rest[0]}" if name in WITH_PARTS else f"{program} {name}"
    shown = typed(f"{path} --help", folder)
    assert shown.returncode == 0, shown.stderr
    options = [word for word in rest if word.startswith("--")]
    assert [word for word in options if not re.search(rf"{word}\b", shown.stdout)] == []
    listens = name == "live"  # until somebody ends it
    missing = typed(f"{command} --duration 1" if listens else command, folder)  # one sentence, no traceback
    assert missing.returncode == 2
    assert "Traceback" not in missing.stderr
    told = "no messages on /your/imu" if listens else r"pdr: (walk|turned)\.mcap does not exist"
    assert re.search(told, missing.stderr), missing.stderr


def test_links_lead_somewhere() -> None:
    links = [link for link in re.findall(r"\]\(([^)#]+)", README) if "://" not in link]
    assert links
    assert [link for link in links if not os.path.exists(CHECKOUT / link)] == []
