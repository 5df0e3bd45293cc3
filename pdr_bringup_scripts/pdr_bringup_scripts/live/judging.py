"""Compares what the nodes said, as it was recorded, with the truth."""

from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

from pdr_bringup_scripts.live.cast import FUSION, Cast, below
from pdr_bringup_scripts.live.live_recording import body, chest_outputs, notices, outputs
from pdr_bringup_scripts.live.switched_recording import decided, switched_notices, switched_outputs
from pdr_bringup_scripts.run.body_book import BodyBook
from pdr_bringup_scripts.run.book import Book
from pdr_core.evaluation.result import CHEST, LIVE, Result, SensorsResult
from pdr_core.params import Params
from pdr_core.pipeline import BodySteps, FootOutput, HeadingFusion
from pdr_core.pipeline.both_feet import BODY
from pdr_core.recording import Sensor, Session, open_recording
from pdr_core.records import Level, Notice, length

PIPELINE, BODY_PIPELINE = f"foot_inertial{LIVE}", f"both_feet{LIVE}"
SWITCHED_PIPELINE, CHEST_PIPELINE = f"foot_adaptive{LIVE}", f"{CHEST}{LIVE}"
BAG = "recording"
RESTARTED = "imu_driver was killed and started again: its walk began anew, so there is no truth to compare with"


@dataclass(frozen=True)
class Run:
    """What there is of a live run."""

    session: Session
    bag: Path
    namespace: str
    seconds: float
    sources: Mapping[str, Sensor]  # of the feet whose truth is not in the recording
    restarts: int = 0  # of a driver, whose walk began anew each time

    def sensor(self, foot: str) -> Sensor:
        """Return the samples of a foot, with what is known of the truth."""
        recorded = replace(self.session.sensors[below(foot, "imu")], name=foot or "imu")
        if self.restarts:
            return replace(recorded, truth=None)
        return replace(recorded, truth=self.sources[foot].truth) if foot in self.sources else recorded

    @property
    def notices(self) -> list[Notice]:
        """What is to be known of the run itself."""
        return [Notice(Level.WARN, "driver_restarted", RESTARTED, self.restarts, 0)] if self.restarts else []


def judge(
    cast: Cast, out: Path, seconds: float, sources: Mapping[str, Sensor], namespace: str, restarts: int = 0
) -> Result | SensorsResult:
    """Compare what the nodes said with the truth, and write the files; of two feet and the body in a folder each."""
    run = Run(open_recording(out / BAG), out / BAG, namespace, seconds, sources, restarts)
    if cast.person and len(cast.feet) > 1:
        return judge_both(run, cast, cast.person, out)
    ((foot, params),) = cast.feet.items()
    if cast.adaptive:
        return judge_switched(run, foot, params, out)
    if cast.chest:
        return judge_chest(run, params, out)
    with ExitStack() as stack:
        book = Book(run.session, run.sensor(foot), out, stack)
        for output in outputs(run.bag, foot, params.node.odom_rate_hz):
            book.keep(output)
        return close(run, book, foot, params, f"{namespace}/")


def judge_chest(run: Run, params: Params, out: Path) -> Result:
    """Judge a card on the chest."""
    with ExitStack() as stack:
        book = Book(run.session, run.sensor(""), out, stack, BodySteps())
        for output in chest_outputs(run.bag):
            book.keep(output)
        return close(run, book, "", params, f"{run.namespace}/", CHEST_PIPELINE)


def judge_switched(run: Run, foot: str, params: Params, out: Path) -> Result:
    """Judge a foot whose gyro was switched."""
    with ExitStack() as stack:
        book = Book(run.session, run.sensor(foot), out, stack)
        for output in switched_outputs(run.bag, foot):
            book.keep(output)
        samples = sum(length(piece) for piece in run.sensor(foot).pieces())
        of_walk = decided(run.bag, foot)
        said = run.notices + switched_notices(run.bag, of_walk, run.namespace)
        return book.close(SWITCHED_PIPELINE, params, samples, run.seconds, said, saving=of_walk.saving)


def judge_both(run: Run, cast: Cast, person: Params, out: Path) -> SensorsResult:
    """Judge both feet and what was said of the body between them."""
    sensors, results = [run.sensor(foot) for foot in cast.feet], {}
    fusion = HeadingFusion(person, list(cast.feet))  # once more, for where it puts the feet
    with ExitStack() as stack:
        body_book = BodyBook(run.session, sensors, out / BODY, stack)
        for foot, params in cast.feet.items():
            book = Book(run.session, run.sensor(foot), out / foot, stack)
            for output in outputs(run.bag, foot, params.node.odom_rate_hz):
                book.keep(output)
                body_book.keep_foot(foot, output)
                tell(fusion, foot, output)
            results[foot] = close(run, book, foot, params, f"{below(run.namespace, foot)}/")
        for nav in body(run.bag):
            body_book.keep(nav)
        said = notices(run.bag, below(run.namespace, FUSION))
        of_body = body_book.close(BODY_PIPELINE, person, results, run.seconds, said, fusion.placed_m)
    together = SensorsResult(str(run.session.path), run.session.format, results, of_body)
    (out / "result.json").write_text(together.to_json() + "\n")
    return together


def close(run: Run, book: Book, foot: str, params: Params, speakers: str, pipeline: str = PIPELINE) -> Result:
    """Return the result of a sensor; the full names of the nodes that tell of it begin with `speakers`."""
    samples = sum(length(piece) for piece in run.sensor(foot).pieces())
    return book.close(pipeline, params, samples, run.seconds, notices(run.bag, speakers))


def tell(fusion: HeadingFusion, foot: str, output: FootOutput) -> None:
    """Tell the fusion what a foot has found."""
    for step in output.steps:
        fusion.step(foot, step)
    fusion.odometry(foot, output.nav)
