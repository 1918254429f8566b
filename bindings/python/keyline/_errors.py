"""What goes wrong, by the codes of the public interface."""

from __future__ import annotations


class Error(Exception):
    """There is no answer: `code`, `message`, and where they are known `path` and `hint`."""

    code = "internal"

    def __init__(self, message: str, path: str = "", hint: str = "") -> None:
        place = f"{path}: " if path else ""
        advice = f"; {hint}" if hint else ""
        super().__init__(place + message + advice)
        self.message = message
        self.path = path
        self.hint = hint


class BadInput(Error, ValueError):
    """The request is wrong; `path` names the place."""

    code = "bad-input"


class Undrawable(Error):
    """No such curve exists; `hint` names the nearest that does."""

    code = "undrawable"


class NotConverged(Error):
    """The tolerance was not reached."""

    code = "not-converged"


class Unsupported(Error, NotImplementedError):
    """This cannot be done, or not by this build."""

    code = "unsupported"


class Cancelled(Error):
    """Somebody asked to stop."""

    code = "cancelled"


class FileFailure(Error, OSError):
    """A file could not be read or written."""

    code = "io"

    def __str__(self) -> str:
        return str(self.args[0])


_KINDS = {k.code: k for k in (BadInput, Undrawable, NotConverged, Unsupported, Cancelled, FileFailure)}


def error_of(code: str, message: str, path: str, hint: str) -> Error:
    """The exception of a failure."""
    return _KINDS.get(code, Error)(message, path, hint)
