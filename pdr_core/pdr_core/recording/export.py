"""Writes recordings: complete under their final name, or not at all."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from pdr_core.recording.bag_export import write_bag
from pdr_core.recording.session import RecordingError, Sensor, Session, put_warning
from pdr_core.recording.text_export import truth_file, write_text
from pdr_core.records import Truth, TruthKind
from pdr_core.records_external import FixBlock

BARE, TEXT = ".mcap", ".csv"
OTHERS = {".bag", ".db3", ".mat", ".tsv", ".txt", ".tum", ".yaml"}  # files that look like a format of ours
OF_A_BAG = {".mcap", ".db3", ".yaml", ".zstd"}


def write_recording(session: Session, sensors: Sequence[Sensor], output: Path, overwrite: bool = False) -> None:
    """Write sensors of a session: a rosbag2 directory, a bare .mcap, or a .csv with its column map, as `output` ends.

    RecordingError says what stands in the way. What cannot be carried over becomes a notice of the session.
    """
    if output.suffix.lower() in OTHERS:
        raise RecordingError(f"{output}: choose a name ending in .mcap or .csv, or without an ending for a directory.")
    if output.suffix.lower() == TEXT and len(sensors) > 1:
        names = ", ".join(sensor.name for sensor in sensors)
        raise RecordingError(f"{output}: a CSV file holds one sensor; choose from {names}, or write a bag.")
    if output.suffix.lower() == TEXT and session.beside:
        raise RecordingError(f"{output}: a CSV file holds no topics of others; write a bag.")
    for target in _targets(output, sensors):
        _check_free(target, session.path, overwrite)
    output.parent.mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory(prefix=f".{output.name}.", dir=output.parent) as folder:
        try:
            made = _written(Path(folder) / output.name, sensors, session.beside)
        except OverflowError as error:
            raise RecordingError(f"{session.path} fits into no bag: {error}; write a .csv.") from error
        for new in made:
            _put(new, output.with_name(new.name), Path(folder))
    for sensor in sensors:
        if sensor.truth and not carries_truth(output, sensor.truth):
            what = "positions of strides" if sensor.truth.kind is TruthKind.STRIDES else "closed loop"
            text = f"the truth of {sensor.name} ({what}) is left out: a bag holds positions with stamps only"
            put_warning(session.notices, "truth_left_out", text, 1, 0)


def carries_truth(output: Path, truth: Truth) -> bool:
    """Tell whether the format that `output` names can hold this truth."""
    return output.suffix.lower() == TEXT or truth.kind is TruthKind.POSITION


def _targets(output: Path, sensors: Sequence[Sensor]) -> list[Path]:
    if output.suffix.lower() != TEXT:
        return [output]
    beside = truth_file(output, sensors[0].truth)
    return [output, output.with_suffix(".yaml"), *([beside] if beside else [])]


def _check_free(target: Path, source: Path, overwrite: bool) -> None:
    if target.exists() and target.resolve() == source.resolve():
        raise RecordingError(f"{target} is the recording itself: choose another name.")
    if target.exists() and not overwrite:
        raise RecordingError(f"{target} exists already: choose another name, or replace it with --force.")
    if target.is_dir() and any(entry.suffix not in OF_A_BAG for entry in target.iterdir()):
        raise RecordingError(f"{target} holds more than a bag, so it is not replaced: choose another name.")


def _written(path: Path, sensors: Sequence[Sensor], beside: Mapping[str, FixBlock]) -> list[Path]:
    """Write under a name that nobody sees yet; return the files or the directory to move."""
    if path.suffix.lower() == TEXT:
        return write_text(path, sensors[0])
    if path.suffix.lower() != BARE:
        write_bag(path, sensors, beside)
        return [path]
    write_bag(path.with_suffix(""), sensors, beside)
    (file,) = path.with_suffix("").glob("*.mcap")
    return [file.rename(path)]


def _put(new: Path, target: Path, aside: Path) -> None:
    """Move a file or directory to its name; what was there goes aside first."""
    if target.exists():
        target.rename(aside / f"old {target.name}")
    new.rename(target)
