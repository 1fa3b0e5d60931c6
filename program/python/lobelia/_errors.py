"""Exceptions. Each has the sentence of the command line, and its exit code."""

from __future__ import annotations


class Error(Exception):
    """A failure of Lobelia: what is wrong, where, and what is allowed.

    `exit_code` is that of the command line. `lines` has a sentence for each fault, for example of a scene file.
    """

    exit_code: int = 70

    def __init__(self, *lines: str) -> None:
        super().__init__("\n".join(lines))
        self.lines = list(lines)


class UsageError(Error, ValueError):
    """An argument is wrong."""

    exit_code = 2


class InputError(Error, ValueError):
    """A file or an array cannot be read, is invalid, or does not match the other one."""

    exit_code = 3


class OutputError(Error, OSError):
    """An output cannot be written."""

    exit_code = 4


class EngineError(Error):
    """A reference engine is missing or failed."""

    exit_code = 5


class InternalError(Error):
    """A bug of Lobelia."""

    exit_code = 70


class NoResourcesError(Error, MemoryError):
    """The system gives no more memory, threads, processes or open files."""

    exit_code = 71


class Warning(UserWarning):  # noqa: A001
    """Something is allowed but odd. The work goes on."""


def error_of(exit_code: int, lines: list[str]) -> Error:
    """The exception of an exit code. The C++ module calls it."""
    kinds: list[type[Error]] = [
        UsageError, InputError, OutputError, EngineError, InternalError, NoResourcesError,
    ]
    for kind in kinds:
        if kind.exit_code == exit_code:
            return kind(*lines)
    return Error(*lines)


for _kind in (
    Error, UsageError, InputError, OutputError, EngineError, InternalError, NoResourcesError, Warning,
):
    _kind.__module__ = "lobelia"  # what users import, and tracebacks show
