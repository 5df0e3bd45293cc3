"""The development recordings, read once and held in memory, and what the chain makes of them with given parameters."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from pdr_bringup_scripts.run.offline import run_foot
from pdr_bringup_scripts.run.run_options import RunOptions
from pdr_core.evaluation.result import Result
from pdr_core.params import Params
from pdr_core.recording import Sensor, Session, open_recording
from pdr_core.records import ImuBlock, joined

VICON, TILES, XIO = "pyshoe_vicon", "tile_walks_marg", "xio_ngimu"
PATTERNS = {VICON: "*.mat", TILES: "*.csv", XIO: "*.csv"}
Held = dict[str, Session]  # by file stem


def held(recordings: Path, folder: str, names: Sequence[str] = ()) -> Held:
    """Read the recordings of a folder, each of one sensor; no names: all of them."""
    paths = sorted((recordings / folder).glob(PATTERNS[folder]))
    wanted = [path for path in paths if not names or path.stem in names]
    assert len(wanted) >= max(len(names), 1), f"{folder} lacks some of {names}: of them nothing would be asked"
    return {path.stem: with_samples(open_recording(path), lambda samples: samples) for path in wanted}


def with_samples(session: Session, change: Callable[[ImuBlock], ImuBlock]) -> Session:
    """Return the session with its samples in memory, changed."""
    (sensor,) = session.sensors.values()
    samples = change(joined(list(sensor.pieces())))
    return replace(session, sensors={sensor.name: replace(sensor, read=lambda _: iter([samples]))})


def only(session: Session) -> Sensor:
    """Return the one sensor of a session."""
    (sensor,) = session.sensors.values()
    return sensor


def results(walks: Held, params: Params | None = None) -> dict[str, Result]:
    """Run every recording as `pdr run` does; no parameters: the defaults."""
    run = {name: (session, only(session)) for name, session in walks.items()}
    return {name: run_foot(*pair, params or Params(), RunOptions()) for name, pair in run.items()}


def ate2_m(walks: Held, params: Params | None = None) -> dict[str, float]:
    """Return the ATE2 [m] of every recording whose truth is known."""
    return {name: result.truth.ate2_m for name, result in results(walks, params).items()}
