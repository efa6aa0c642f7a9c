"""Entry point: arguments in, exit status out, never a traceback."""

import os
import re
import sys
from collections.abc import Sequence

from foldwing.errors import ComputationError, FoldwingError

DONE, FAILED, BAD_INPUT = 0, 1, 2

_HINGE_OPTION = re.compile(r"--fold(\d+)(?:=(.*))?")


def main() -> None:
    """Run foldwing and exit: 0 done, 1 a computation failed, 2 bad input."""
    sys.exit(run(sys.argv[1:]))


def run(arguments: Sequence[str]) -> int:
    """Run foldwing with the given arguments and return its exit status."""
    # The matrices are small: threads of the linear algebra library only get in each other's way.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from foldwing.cli.app import app

    try:
        app(args=with_hinge_options(arguments), prog_name="foldwing")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else DONE
    except FoldwingError as problem:
        print(f"Error: {problem}", file=sys.stderr)
        return FAILED if isinstance(problem, ComputationError) else BAD_INPUT
    except Exception as problem:
        print(f"Internal error: {type(problem).__name__}: {problem}", file=sys.stderr)
        print(
            "This is a defect of foldwing. Please report it with the model file and the command.",
            file=sys.stderr,
        )
        return FAILED
    return DONE


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
        value = match[2] if match[2] is not None else (pending.pop(0) if pending else "")
        result += ["--fold-of", f"{match[1]}={value}"]
    return result
