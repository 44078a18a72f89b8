"""./course slides N: a chapter's lecture, made of its lesson, as one self-contained HTML file that prints."""

from pathlib import Path

from binding.outline import pages
from binding.reading import read
from binding.slide_page import slide_page
from errors import BadInput
from install import install
from needs import BOOK_NEEDS
from paths import BUILD, shown
from pick import pick_chapter


def slides(arguments) -> int:
    chapter = pick_chapter(arguments.which)
    file = Path(arguments.out) if arguments.out else BUILD / "slides" / f"{chapter.folder}.html"
    if arguments.out and not file.absolute().parent.is_dir():
        raise BadInput(f"slides: {file} cannot be written: {file.absolute().parent} is no folder")
    install(BOOK_NEEDS, yes=False)
    page, count = slide_page(chapter, [read(each) for each in pages()])
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(page, encoding="utf-8")
    print(f"{shown(file.absolute())}: {count} slides. Open it in a browser.\n"
          "Right and left go on and back, S opens the notes in a window of their own, N shows them below the slides.\n"
          "It prints a slide a page; with the notes, after N.")
    return 0
