"""What ./course run has besides the options of the engine's program: --mine, --plot and --sweep."""

from dataclasses import dataclass

from errors import BadInput

HELP = """
Of the course:
  --mine                  With what you have written so far, right or wrong
  --plot NAME[,NAME ...]  Draw what --csv has over time: a column, or all whose
                          names begin with this word
  --sweep NAME=A,B,...    A run for each value of an option or a parameter, and
                          the table of errors and observed orders
"""


@dataclass(frozen=True)
class Extras:
    mine: bool
    plot: tuple[str, ...]  # names of columns
    sweep: tuple[str, tuple[str, ...]] | None  # a name and its values


def taken(arguments: list[str]) -> tuple[Extras, list[str]]:
    """The extras, and the words that are left for the engine."""
    words = [word for word in arguments if word != "--mine"]
    plot, words = _taken("--plot", words)
    sweep, words = _taken("--sweep", words)
    names = tuple(plot.split(",")) if plot is not None else ()
    if not all(names):
        raise BadInput(f"run: --plot must be names of columns, but is {plot!r}")
    return Extras("--mine" in arguments, names, None if sweep is None else _values(sweep)), words


def _taken(option: str, words: list[str]) -> tuple[str | None, list[str]]:
    places = [k for k, word in enumerate(words) if word == option or word.startswith(f"{option}=")]
    if not places:
        return None, words
    if len(places) > 1:
        raise BadInput(f"run: {option} is given twice; leave one out")
    k = places[0]
    _, equals, value = words[k].partition("=")
    if equals:
        return value, words[:k] + words[k + 1:]
    if k + 1 == len(words) or words[k + 1].startswith("-"):
        raise BadInput(f"run: {option} needs a value")
    return words[k + 1], words[:k] + words[k + 2:]


def _values(text: str) -> tuple[str, tuple[str, ...]]:
    name, _, values = text.partition("=")
    each = tuple(values.split(","))
    if not name or not all(each):
        raise BadInput(f"run: --sweep must be NAME=VALUE,VALUE, but is {text!r}")
    if len(each) != len(set(each)):
        raise BadInput(f"run: --sweep has one of {values} twice")
    return name, each
