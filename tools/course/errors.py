"""What goes wrong, as the user sees it: one line, and an exit code."""


class CourseError(Exception):
    """Something that the user can act on. Printed as one line; details may follow it."""

    code = 1

    def __init__(self, message: str, details: str = ""):
        super().__init__(message)
        self.details = details


class BadInput(CourseError):
    """An argument that makes no sense."""

    code = 2
