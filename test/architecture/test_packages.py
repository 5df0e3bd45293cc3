"""What the packages say of themselves agrees, and nothing of one developer's machine is in them."""

import re
import runpy
import subprocess
from pathlib import Path

import pytest
from source_tree import CHECKOUT, modules

from pdr_core import __version__

PACKAGES = ("pdr_core", "pdr_msgs", "pdr_nodes", "pdr_bringup_scripts")
# not matched by its own source; `/home/somebody` is a made-up user of a test
MACHINE_PATH = re.compile(r"(?<![\w.}>)-])/(?:work|root|home/(?!somebody\b)\w+|Users/\w+)(?:/|\b(?=[\"'\s]))")


@pytest.mark.parametrize("package", PACKAGES)
def test_version_and_licence(package):
    manifest = (CHECKOUT / package / "package.xml").read_text(encoding="utf-8")
    assert f"<name>{package}</name>" in manifest
    assert f"<version>{__version__}</version>" in manifest
    assert "<license>Apache-2.0</license>" in manifest


@pytest.mark.parametrize("package", [package for package in PACKAGES if package != "pdr_msgs"])
def test_set_up_agrees_with_the_manifest(package):
    text = (CHECKOUT / package / "setup.py").read_text(encoding="utf-8")
    assert f'version="{__version__}"' in text
    assert 'license="Apache-2.0"' in text


@pytest.mark.parametrize("package", [package for package in PACKAGES if package != "pdr_msgs"])
def test_what_lies_beside_the_modules_is_installed(package, monkeypatch):
    asked = {"package_data": {}}
    monkeypatch.setattr("setuptools.setup", lambda **what: asked.update(what))
    monkeypatch.chdir(CHECKOUT / package)
    runpy.run_path("setup.py")
    homes = {Path(*name.split(".")): patterns for name, patterns in asked["package_data"].items()}
    installed = {path for home, patterns in homes.items() for pattern in patterns for path in home.glob(pattern)}
    there = {path for path in Path(package).rglob("*") if path.is_file() and path.suffix not in (".py", ".pyc")}
    assert there - installed == set()


def test_the_changelog_knows_the_version():
    text = (CHECKOUT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\S+)", text, re.MULTILINE)[0] == __version__
    assert "Scientific changes" in text


def test_the_licence_is_apache():
    text = (CHECKOUT / "LICENSE").read_text(encoding="utf-8")
    assert text.split()[:6] == ["Apache", "License", "Version", "2.0,", "January", "2004"]
    assert "END OF TERMS AND CONDITIONS" in text


def test_every_message_that_the_code_names_exists():
    named = set()
    for path in modules().values():
        text = path.read_text(encoding="utf-8")
        for kind, names in re.findall(r"from pdr_msgs\.(msg|srv) import ([^\n]+)", text):
            named |= {f"{kind}/{name.split()[0]}.{kind}" for name in names.split(",")}
        named |= {f"msg/{name}.msg" for name in re.findall(r"pdr_msgs/(?:msg/)?([A-Z]\w+)", text)}
    assert len(named) >= 6
    assert {name for name in named if not (CHECKOUT / "pdr_msgs" / name).is_file()} == set()


def test_no_path_of_a_developers_machine():
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=CHECKOUT, capture_output=True, text=True, check=True)
    wrong = []
    for name in filter(None, listed.stdout.split("\0")):
        path = CHECKOUT / name
        content = path.read_bytes() if path.is_file() else b""
        if b"\0" not in content:
            lines = enumerate(content.decode("utf-8").splitlines(), 1)
            wrong += [f"{name}:{number}: {line.strip()}" for number, line in lines if MACHINE_PATH.search(line)]
    assert wrong == []
