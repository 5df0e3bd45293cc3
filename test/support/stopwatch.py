"""Times the stages of the chain on walks."""

import time
from collections.abc import Callable

from pdr_core.eskf import ZuptFilter
from pdr_core.intake import Ingestion
from pdr_core.params import Params
from pdr_core.pipeline import FootInertial
from pdr_core.records import ImuBlock, joined, length
from pdr_core.stance import StanceDetection
from pdr_core.warmup import warm_up


class Stopwatch:
    """Adds up the processor time that each name took: other programs on the machine hardly change it."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}

    def __call__(self, name: str, work: Callable, *arguments: object):
        begin = time.process_time()
        result = work(*arguments)
        self.seconds[name] = self.seconds.get(name, 0.0) + time.process_time() - begin
        return result


def timed(walk: ImuBlock, watch: Stopwatch) -> int:
    """Take a walk through the stages one by one, then through all together; return how many estimates came out."""
    params = Params()
    stance = StanceDetection(params.stance, params.place)
    trusted = watch("intake", Ingestion(params.intake).run, walk)
    judged = watch("stance", lambda: joined([stance.run(trusted), stance.finish()]))
    nav, _ = watch("filter", ZuptFilter(params.filter, params.place).run, judged)
    chain = FootInertial(params)
    watch("all together", lambda: (chain.run(walk), chain.finish()))
    return length(nav)


def samples_per_s(walks: list[ImuBlock], rounds: int) -> dict[str, float]:
    """Return the best of several rounds."""
    warm_up()
    best: dict[str, float] = {}
    for _ in range(rounds):
        watch = Stopwatch()
        samples = sum(timed(walk, watch) for walk in walks)
        best = {name: max(best.get(name, 0.0), samples / s) for name, s in watch.seconds.items()}
    return best
