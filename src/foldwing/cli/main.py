"""Entry point: arguments in, exit status out, never a traceback."""

import io
import os
import re
import sys
from collections.abc import Sequence

from foldwing.errors import ComputationError, FoldwingError

DONE, FAILED, BAD_INPUT = 0, 1, 2

INTERRUPTED = 130
"""Exit status with which the parser reports Ctrl-C."""

_HINGE_OPTION = re.compile(r"--fold(\d+)(?:=(.*))?")
_ANOTHER_OPTION = re.compile(r"-[^\d.].*")


def main() -> None:
    """Run foldwing and exit: 0 done, 1 a computation failed, 2 bad input."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a terminal without a degree sign shows "?"
    sys.exit(run(sys.argv[1:]))


def run(arguments: Sequence[str]) -> int:
    """Run foldwing with the given arguments and return its exit status."""
    # The matrices are small: threads of the linear algebra library only get in each other's way.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    try:
        status = _run(arguments)
    except KeyboardInterrupt:
        status = INTERRUPTED
    if status == INTERRUPTED:
        return _failed("Interrupted: nothing was written.")
    return status


def _run(arguments: Sequence[str]) -> int:
    from foldwing.cli.app import app

    try:
        app(args=with_hinge_options(arguments), prog_name="foldwing")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else DONE
    except FoldwingError as problem:
        _failed(f"Error: {problem}")
        return FAILED if isinstance(problem, ComputationError) else BAD_INPUT
    except OSError as problem:
        return _failed(f"Error: the output cannot be written ({problem.strerror or problem}).")
    except Exception as problem:
        return _failed(
            f"Internal error: {type(problem).__name__}: {problem}\n"
            "This is a defect of foldwing. Please report it with the model file and the command."
        )
    return DONE


def _failed(message: str) -> int:
    print(message, file=sys.stderr)
    return FAILED


def with_hinge_options(arguments: Sequence[str]) -> list[str]:
    """Return the arguments with ``--foldI VALUE`` rewritten as ``--fold-of I=VALUE``.

    A wing may have any number of hinges, and the parser wants to know its options beforehand.
    """
    result: list[str] = []
    pending = list(arguments)
    while pending:
        argument = pending.pop(0)
        match = _HINGE_OPTION.fullmatch(argument)
        if match is None:
            result.append(argument)
            continue
        value = match[2]
        if value is None:
            missing = not pending or _ANOTHER_OPTION.fullmatch(pending[0])
            value = "" if missing else pending.pop(0)
        result += ["--fold-of", f"{match[1]}={value}"]
    return result
