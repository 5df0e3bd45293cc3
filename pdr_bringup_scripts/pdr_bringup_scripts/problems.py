"""What went wrong, in one sentence."""

import signal
import sys
from collections.abc import Callable

ENDS = (signal.SIGTERM, signal.SIGHUP)  # what was started ends with us


class Problem(Exception):  # noqa: N818  (what a person meets)
    """Something that the user can mend; the text says what to do next, of several things a line each."""


def told(main: Callable[[], object]) -> None:
    """Call `main`; tell problems on stderr and exit with 2, Ctrl-C with 130, also while it still imports."""
    try:
        _listen_to_signals()
        main()
    except KeyboardInterrupt:
        print("pdr: stopped", file=sys.stderr)
        sys.exit(130)
    except OSError as error:
        print(f"pdr: {error.filename or 'a file'}: {error.strerror or error}", file=sys.stderr)
        sys.exit(2)
    except Exception as problem:
        if not isinstance(problem, _problems()):
            raise
        print(*(f"pdr: {line}" for line in str(problem).splitlines()), sep="\n", file=sys.stderr)
        sys.exit(2)


def _listen_to_signals() -> None:
    """Be interrupted by what ends a program, unless somebody wants it ignored; the launcher has kept Ctrl-C waiting."""
    for number in ENDS:
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def _problems() -> tuple[type[Exception], ...]:
    """Return what a user can mend; imported late, for a Ctrl-C at the start."""
    from pdr_core.parameter import ParameterError
    from pdr_core.recording import RecordingError

    return Problem, ParameterError, RecordingError
