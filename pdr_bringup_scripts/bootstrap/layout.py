"""Where the set-up keeps what it makes, all of it below one checkout."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

STAMP_NAME = "pdr_stamp.json"
SOURCE_PACKAGES = ("pdr_core", "pdr_nodes", "pdr_bringup_scripts")


@dataclass(frozen=True)
class Layout:
    """The folders and files of one checkout."""

    checkout: Path

    @property
    def venv(self) -> Path:
        """The environment everything runs in."""
        return self.checkout / ".venv"

    @property
    def python(self) -> Path:
        """The interpreter of that environment."""
        return self.venv / "bin" / "python"

    @property
    def stamp(self) -> Path:
        """What the finished set-up was made from."""
        return self.venv / STAMP_NAME

    @property
    def log(self) -> Path:
        """Everything the set-up's programs printed."""
        return self.venv / "setup.log"

    @property
    def build(self) -> Path:
        """The build folder of the message packages."""
        return self.venv / "build"

    @property
    def generated(self) -> Path:
        """Sources that the set-up writes itself: the fallback for tf2_msgs."""
        return self.build / "generated" / "tf2_msgs"

    @property
    def messages(self) -> Path:
        """The sources of our messages."""
        return self.checkout / "pdr_msgs"

    @property
    def bootstrap(self) -> Path:
        """The folder of this file in that checkout, with the requirements."""
        return self.checkout / "pdr_bringup_scripts" / "bootstrap"

    @property
    def site_packages(self) -> Path:
        """The environment's folder of Python packages; the folder itself may not exist yet."""
        found = sorted((self.venv / "lib").glob("python3.*/site-packages"))
        return found[0] if found else self.venv / "lib" / "site-packages"


def this_checkout() -> Layout:
    """Give the layout of the checkout this file lies in."""
    return Layout(Path(__file__).resolve().parents[2])
