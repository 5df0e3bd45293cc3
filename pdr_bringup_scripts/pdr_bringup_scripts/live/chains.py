"""Several chains that run together."""

from collections.abc import Collection, Sequence
from contextlib import ExitStack
from types import TracebackType

from pdr_bringup_scripts.live.chain import Chain


class Chains:
    """A context manager: all processes start at once."""

    def __init__(self, chains: Sequence[Chain]) -> None:
        self._chains = chains
        self._stack = ExitStack()

    def __enter__(self) -> "Chains":
        """Start all nodes; where one cannot be started, none stays."""
        with ExitStack() as stack:
            for chain in self._chains:
                stack.enter_context(chain)
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End them as Ctrl-C would."""
        for chain in self._chains:
            chain.interrupt()
        self._stack.close()

    def end(self, namespaces: Collection[str]) -> None:
        """Ask chains to end: what waits for a foot need wait no longer."""
        for chain in self._chains:
            if chain.namespace in namespaces:
                chain.interrupt()

    @property
    def drivers_are_done(self) -> bool:
        """Drivers were started, have delivered everything and ended."""
        done = [chain.driver_is_done for chain in self._chains if chain.has_driver]
        return bool(done) and all(done)

    @property
    def restarts(self) -> int:
        """How often a node was killed and started again."""
        return sum(chain.restarts for chain in self._chains)

    @property
    def pids(self) -> dict[str, int]:
        """The process of each node, by its full name."""
        return {f"{chain.namespace}/{name}": pid for chain in self._chains for name, pid in chain.pids.items()}

    def check(self) -> None:
        """Start again what is to be kept; raise a Problem if another node has died."""
        for chain in self._chains:
            chain.check()
