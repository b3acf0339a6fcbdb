"""The exceptions that frisure raises."""

from __future__ import annotations

import errno
import os
from typing import Any


class FrisureError(Exception):
    """An error of frisure; its text is what the command line prints."""


class ArgumentError(FrisureError, ValueError):
    """A request that is impossible: the text names the argument, its value and what is allowed."""


class ArgumentTypeError(ArgumentError, TypeError):
    """A value of a type that is not taken: a `TypeError`, too."""


class FailedError(FrisureError, RuntimeError):
    """A possible request that failed for another reason, such as a full disk."""


class SceneError(FrisureError, ValueError):
    """Something in a scene is wrong.

    The text has the line of the scene, as on the command line. The parts are attributes: `problem` in one sentence,
    `file`, `line` and `column` from 1 (0 if there is no line), `key`, the `value` as it is written, what is `allowed`,
    and a `hint`; each text may be empty.
    """

    def __init__(
        self,
        text: str,
        *,
        problem: str = "",
        file: str = "",
        line: int = 0,
        column: int = 0,
        key: str = "",
        value: str = "",
        allowed: str = "",
        hint: str = "",
    ) -> None:
        super().__init__(text)
        self.problem = problem or text
        self.file = file
        self.line = line
        self.column = column
        self.key = key
        self.value = value
        self.allowed = allowed
        self.hint = hint

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), self.args, self.__dict__


class SceneNotFoundError(SceneError, FileNotFoundError):
    """There is no file of this scene; `file` and `filename` are its path."""

    def __init__(self, text: str, file: str) -> None:
        SceneError.__init__(self, text, file=file)
        self.errno, self.strerror, self.filename = errno.ENOENT, os.strerror(errno.ENOENT), file

    def __str__(self) -> str:
        return str(self.problem)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.problem, self.file)
