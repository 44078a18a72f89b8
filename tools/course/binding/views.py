"""Each film as a page of ./course view, which one can turn and scrub."""

import contextlib
import io
from pathlib import Path

from films import films, words

_FOLDER = Path("views")


def page_of_film(source: Path) -> Path:
    """Where the film of a page's source is viewed: that of its chapter, or README's."""
    return _FOLDER / f"{source.parent.name or 'README'}.html"


def film_pages(folder: Path) -> None:
    """Runs what is filmed, and writes the pages into the site."""
    from arguments import parse
    from terminal import Bar
    from view import view

    (folder / _FOLDER).mkdir()
    bar = Bar("views", len(films()))
    for name, film in films().items():
        with contextlib.redirect_stdout(io.StringIO()):
            view(parse([*words(film), "--out", str(folder / _FOLDER / f"{name}.html")]))
        bar.step(name)
    bar.done()
