"""Options of ./course run beyond those of the engine's program: --mine, --engine mine, --plot, --sweep, and more."""

from collections.abc import Callable
from dataclasses import dataclass, field

from errors import BadInput
from mine import own_engine

HELP = """
Of the course:
  --mine                  With what you have written so far, right or wrong
  --engine mine           A third choice: the plain engine with your own step
  --plot NAME[,NAME ...]  Draw what --csv has over time: a column, or all whose
                          names begin with this word
  --sweep NAME=A,B,... ...
                          A run for each combination of values of options and
                          parameters, and a table of errors; with observed
                          orders in h, d or k, and means over seed. A list
                          after --set is swept, too. --csv FILE has the table
  --shard I/N             With --sweep: only every N-th run, from the I-th on
  --merge FILE ...        In place of --shard: joins its tables, made by --csv
  --slurm N               With --sweep: as an array of N on an existing Slurm
"""


@dataclass(frozen=True)
class Extras:
    mine: bool
    plot: tuple[str, ...] = ()  # names of columns
    sweep: dict[str, tuple[str, ...]] = field(default_factory=dict)  # values by name
    shard: tuple[int, int] = (1, 1)
    slurm: int = 0
    merge: tuple[str, ...] = ()  # tables of shards


def taken(arguments: list[str]) -> tuple[Extras, list[str]]:
    """Returns the extras, and the remaining words for the engine."""
    own, words = own_engine([word for word in arguments if word != "--mine"])
    plot, words = _taken("--plot", words)
    shard, words = _taken("--shard", words)
    slurm, words = _taken("--slurm", words)
    merged, words = taken_lists("--merge", words)
    swept, words = taken_lists("--sweep", words)
    listed, words = taken_lists("--set", words, lambda word: "," in word.partition("=")[2])
    names = tuple(plot.split(",")) if plot is not None else ()
    if not all(names):
        raise BadInput(f"run: --plot must be names of columns, but is {plot!r}")
    axes: dict[str, tuple[str, ...]] = {}
    for text in listed + swept:
        name, values = axis_of(text)
        if name in axes:
            raise BadInput(f"run: {name} is swept twice")
        axes[name] = values
    for option, given in (("--shard", shard), ("--slurm", slurm), ("--merge", merged)):
        if given and not axes:
            raise BadInput(f"run: {option} needs --sweep")
        if given and merged and option != "--merge":
            raise BadInput(f"run: --merge makes no runs: leave out {option}")
    if merged and plot:
        raise BadInput("run: --merge makes no runs: leave out --plot")
    extras = Extras(own or "--mine" in arguments, names, axes, _shard(shard) if shard else (1, 1),
                    _count(slurm) if slurm else 0, tuple(merged))
    return extras, words


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


def taken_lists(option: str, words: list[str],
                is_list: Callable[[str], bool] = lambda word: True) -> tuple[list[str], list[str]]:
    """Separates the values of options that take several words and may be repeated from all other words."""
    lists: list[str] = []
    left: list[str] = []
    k = 0
    while k < len(words):
        if words[k] != option and not words[k].startswith(f"{option}="):
            left.append(words[k])
            k += 1
            continue
        given = [words[k].partition("=")[2]] if words[k] != option else []
        k += 1
        while k < len(words) and not words[k].startswith("-"):
            given.append(words[k])
            k += 1
        if option in ("--sweep", "--merge") and not given:
            raise BadInput(f"run: {option} needs a value")
        found = [word for word in given if is_list(word)]
        lists += found
        kept = [word for word in given if word not in found]
        if kept or not given:
            left += [option, *kept]
    return lists, left


def axis_of(text: str) -> tuple[str, tuple[str, ...]]:
    """Returns the name and the values of NAME=VALUE,VALUE."""
    name, _, values = text.partition("=")
    each = tuple(values.split(","))
    if not name or not all(each):
        raise BadInput(f"run: --sweep must be NAME=VALUE,VALUE, but is {text!r}")
    if len(each) != len(set(each)):
        raise BadInput(f"run: --sweep {text} has a value twice; leave one out")
    return name, each


def _shard(text: str) -> tuple[int, int]:
    index, _, count = text.partition("/")
    if not (index.isdecimal() and count.isdecimal() and 1 <= int(index) <= int(count)):
        raise BadInput(f"run: --shard must be I/N with 1 <= I <= N, but is {text!r}")
    return int(index), int(count)


def _count(text: str) -> int:
    if not (text.isdecimal() and 0 < int(text) < 10_000):
        raise BadInput(f"run: --slurm must be a whole number from 1 to 9999, but is {text!r}")
    return int(text)
