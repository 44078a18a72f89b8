"""Errors as the user sees them: one line, and an exit code."""


class CourseError(Exception):
    """An error that the user can correct. Printed as one line; details may follow."""

    code = 1

    def __init__(self, message: str, details: str = ""):
        super().__init__(message)
        self.details = details


class BadInput(CourseError):
    """An invalid argument."""

    code = 2
