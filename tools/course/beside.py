"""Handles --beside: further runs of a scene, each with a change."""

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass

from errors import BadInput
from pick import near

# Options of run that may differ, unless the scene has a parameter of this name; any other name is a parameter.
_OPTIONS = ("h", "time", "solver", "iterations", "tolerance", "substeps", "integrator-order", "row-order",
            "seed", "contact-margin", "friction-model", "tangents", "max-parts", "threads", "engine",
            "soft-steps", "accuracy")
_FLAG = "warm-start"
_SWITCHED = {"on": True, "true": True, "yes": True, "1": True, "off": False, "false": False, "no": False, "0": False}


@dataclass(frozen=True)
class Run:
    words: tuple[str, ...]  # of spook run
    mine: bool
    changed: tuple[tuple[str, str], ...] = ()  # name, value


def variations(words: list[str], arguments, parameters: Callable[[str], set[str]] = lambda scene: set()) -> list[Run]:
    """Returns the requested run and those beside it. `parameters` gives the names of a scene's parameters."""
    if "--record" in words:
        raise BadInput("view: --record is an option of ./course run; leave it out")
    words = [*words, "--fps", arguments.fps] if arguments.fps else words
    runs = [Run(tuple(words), arguments.mine)]
    for what in arguments.beside or ():
        if what == "mine" and arguments.mine:
            raise BadInput("view: --beside mine and --mine are the same run; leave one of them out")
        runs.append(Run(runs[0].words, True) if what == "mine" else _changed(runs[0], what, parameters(words[0])))
    return runs


def _changed(run: Run, what: str, parameters: set[str]) -> Run:
    words, changed = list(run.words), []
    for part in what.split(","):
        name, equals, value = part.partition("=")
        if not (name and equals and value):
            raise BadInput(f"view: --beside must be mine or NAME=VALUE, but is {what!r}")
        words = with_changed(words, name, value, parameters)
        changed.append((name, value))
    return Run(tuple(words), run.mine, tuple(changed))


def with_changed(words: list[str], name: str, value: str, parameters: Collection[str] = ()) -> list[str]:
    """Returns a run's words with one of the scene's parameters, or an option of run, replaced."""
    option = name.replace("_", "-")
    if name in parameters:
        return [*_without_parameter(words, name), "--set", f"{name}={value}"]
    if option == _FLAG:
        return _flagged(words, value)
    if option in _OPTIONS:
        return [*without(words, f"--{option}"), f"--{option}", value]
    if parameters:
        known = sorted(parameters) + sorted({*_OPTIONS, _FLAG})
        raise BadInput(f"{name!r} is neither a parameter of {words[0]} nor an option of run"
                       f"{near(name, known) or '; there are: ' + ', '.join(known)}")
    return [*_without_parameter(words, name), "--set", f"{name}={value}"]


def require_single(words: list[str]) -> None:
    """Refuses a list as the value of an option, which the program would take for a number or a name."""
    for name in _OPTIONS:
        value = value_of(f"--{name}", words)
        if value is not None and "," in value:
            raise BadInput(f'run: {name} must be one value, but is "{value}": a sweep of {name} takes a list')


def require_distinct(names: Iterable[str], parameters: Collection[str]) -> None:
    """Refuses a name that is swept twice, also an option that is spelled once with - and once with _."""
    typed: dict[str, str] = {}
    for name in names:
        option = name.replace("_", "-")
        meant = option if name not in parameters and option in (*_OPTIONS, _FLAG) else name
        if meant in typed:
            also = "" if typed[meant] == name else f", also as {typed[meant]}"
            raise BadInput(f"run: {name} is swept twice{also}")
        typed[meant] = name


def require_free(words: list[str], name: str, parameters: Collection[str]) -> None:
    """Refuses a value of what is swept, which would have no effect."""
    option = f"--{name.replace('_', '-')}"
    if name in parameters:
        given = next((word for word in words if word.startswith((f"{name}=", f"--set={name}="))), None)
    else:
        given = option if option in words or value_of(option, words) is not None else None
    if given:
        raise BadInput(f"run: {name} is swept, so {given} has no effect: leave one of them out")


def value_of(option: str, words: Sequence[str]) -> str | None:
    """Returns the value of an option in a command line; None if it is missing."""
    for k, word in enumerate(words):
        if word.startswith(f"{option}="):
            return word.partition("=")[2]
        if word == option and k + 1 < len(words):
            return words[k + 1]
    return None


def _flagged(words: list[str], value: str) -> list[str]:
    if value not in _SWITCHED:
        raise BadInput(f"{_FLAG} must be on or off, but is {value!r}")
    return [word for word in words if word != f"--{_FLAG}"] + [f"--{_FLAG}"] * _SWITCHED[value]


def _without_parameter(words: list[str], name: str) -> list[str]:
    """Removes a parameter, since the program refuses one that is set twice."""
    kept = [word for word in words if not word.startswith((f"{name}=", f"--set={name}="))]
    return [word for k, word in enumerate(kept)
            if word != "--set" or k + 1 < len(kept) and not kept[k + 1].startswith("-")]


def without(words: list[str], option: str) -> list[str]:
    """Removes an option, since the program refuses one that is given twice."""
    kept: list[str] = []
    skip = False
    for word in words:
        if not skip and word != option and not word.startswith(f"{option}="):
            kept.append(word)
        skip = not skip and word == option
    return kept


def label_of(index: int, runs: list[Run], headers: list[dict]) -> str:
    """Returns the name of a run in the picture; empty if it is alone."""
    if len(runs) == 1:
        return ""
    run = runs[index]
    if run.changed:
        return ", ".join(f"{name} = {value}" for name, value in run.changed)
    if run.mine or any(other.mine != run.mine for other in runs):
        return "yours" if run.mine else "reference"
    names = dict.fromkeys(name for other in runs for name, _ in other.changed)
    return ", ".join(f"{name} = {_value(headers[index], name)}" for name in names)


def _value(header: dict, name: str) -> str:
    plain = name.replace("-", "_")
    for place in (header.get("parameters", {}), header.get("method", {}), header):
        if plain in place:
            value = place[plain]
            if isinstance(value, bool):
                return "on" if value else "off"
            return f"{value:.4g}" if isinstance(value, float) else str(value)
    return "as it is"
