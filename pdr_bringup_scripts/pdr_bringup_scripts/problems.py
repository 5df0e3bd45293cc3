"""What went wrong, in one sentence."""

import sys
from collections.abc import Callable

from pdr_core.parameter import ParameterError
from pdr_core.recording import RecordingError


class Problem(Exception):  # noqa: N818  (what a person meets)
    """Something that the user can mend; the text says what to do next."""


def told(main: Callable[[], object]) -> None:
    """Call `main`; tell problems on stderr and exit with 2, Ctrl-C with 130."""
    try:
        main()
    except (Problem, ParameterError, RecordingError) as problem:
        print(f"pdr: {problem}", file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f"pdr: {error.filename or 'a file'}: {error.strerror or error}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        print("pdr: stopped", file=sys.stderr)
        sys.exit(130)
