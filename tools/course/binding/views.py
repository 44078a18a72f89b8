"""Each film as a page of ./course view, to turn and scrub."""

import contextlib
import io
from pathlib import Path

from binding.outline import FRONT, pages
from films import films, words

_FOLDER = Path("views")


def page_of_film(source: Path) -> Path:
    """Returns the page for the film of a page's source: that of its chapter, or README's."""
    return _FOLDER / f"{source.parent.name or 'README'}.html"


def pages_of_films() -> list[Path]:
    return [_FOLDER / f"{name}.html" for name in films()]


def _way_back(name: str) -> tuple[str, str]:
    """Returns the address and title of the page that shows the film."""
    page = FRONT if name == "README" else next(page for page in pages() if page_of_film(page.source).stem == name)
    return f"../{page.target.as_posix()}", page.title


def film_pages(folder: Path, mine: bool = False) -> None:
    """Runs what is filmed, perhaps with the student's functions, and writes the pages into the site, which has their
    folder."""
    from arguments import parse
    from terminal import Bar
    from view import view

    bar = Bar("views", len(films()))
    for name, film in films().items():
        arguments = parse([*words(film), *(["--mine"] if mine else []), "--out", str(folder / _FOLDER / f"{name}.html")])
        arguments.back = _way_back(name)
        with contextlib.redirect_stdout(io.StringIO()):
            view(arguments)
        bar.step(name)
    bar.done()
