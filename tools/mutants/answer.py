"""An answer to an exercise, line by line, and its expected verdict."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from errors import CourseError
from paths import shown


@dataclass(frozen=True)
class Line:
    """A line, and its place."""

    file: Path
    number: int
    text: str

    @property
    def code(self) -> str:
        """Returns the line without indentation and comment."""
        return self.text.split("//")[0].strip()

    @property
    def shown(self) -> str:
        return shown(self.file)


@dataclass(frozen=True)
class Answer:
    file: Path
    line: int  # where it begins in the file
    name: str
    about: str  # what is wrong with it, or odd
    test: str  # must fail; empty for a right answer, with which all pass
    says: str  # the failure, somewhere
    lines: tuple[Line, ...]

    @property
    def is_right(self) -> bool:
        return not self.test

    @property
    def full_name(self) -> str:
        """Returns a name that is unique in the chapter, and chooses this answer in the chapter's program."""
        return f"{self.name}_of_{self.file.name.split('.')[0]}"

    @property
    def place(self) -> str:
        return f"{shown(self.file)}:{self.line}: {self.name}"

    def source(self) -> str:
        """Returns the text, with directives for the file and the line in a compiler's messages."""
        texts: list[str] = []
        inside, expected = False, None
        for line in self.lines:
            if inside and (line.file, line.number) != expected:
                texts.append(f'#line {line.number} "{line.file}"')
            texts.append(line.text)
            expected = (line.file, line.number + 1) if inside else None
            inside = inside or line.code == "namespace spook {"
        return "\n".join(texts) + "\n"


def code_of(lines: Iterable[Line]) -> list[str]:
    """Returns the compiled lines, without includes."""
    return [line.code for line in lines if line.code and not line.code.startswith("#include")]


def refused(file: Path, line: int, reason: str, name: str = "") -> CourseError:
    """Returns an error about a mutant, in the form of a compiler's."""
    return CourseError(f"{shown(file)}:{line}: {f'{name}: ' if name else ''}{reason}")
