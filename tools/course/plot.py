"""./course plot: runs an experiment, checks its claims, and draws it."""

import contextlib
import re
import shutil
import subprocess
import sys
import textwrap
from dataclasses import dataclass
from pathlib import Path

import peers
from beside import require_distinct, require_free, value_of, with_changed
from engine import parameters_of, program
from errors import BadInput, CourseError
from extras import axis_of, taken_lists
from manifest import Exercise
from mine import begun, fast_program, told
from paths import BUILD, ROOT, shown
from pick import near
from process import stream, tail
from provenance import hashes_of, write_manifest
from slurm import run_array
from terminal import Live, fold, fold_lines, paint

PLOTS = ROOT / "plots"
_TITLE = re.compile(r'^TITLE = "(.+)"$', re.MULTILINE)
_PROGRESS = re.compile(r"^\[\d+/\d+\] ")


@dataclass(frozen=True)
class Experiment:
    source: Path  # plots/TOPIC/NAME.cpp

    @property
    def name(self) -> str:
        return self.source.stem

    @property
    def drawing(self) -> Path:
        return self.source.with_suffix(".py")

    @property
    def title(self) -> str:
        found = _TITLE.search(self.drawing.read_text(encoding="utf-8")) if self.drawing.exists() else None
        return found[1] if found else ""

    def folder(self, mine: bool, out: str | None) -> Path:
        """Returns the folder of the results. `out` is the chosen one."""
        folder = Path(out).absolute() if out else BUILD / "plots" / self.name
        return folder.with_name(folder.name + "-mine") if mine else folder


_OF_ENGINES = "work_precision"


def experiments() -> list[Experiment]:
    return [Experiment(path) for path in sorted(PLOTS.glob("*/*.cpp")) if path.parent.name != "machinery"]


def plot(arguments) -> int:
    if arguments.engine and arguments.which != _OF_ENGINES:
        raise BadInput(f"plot: only {_OF_ENGINES} has --engine; leave it out")
    arguments.mine |= arguments.engine is not None
    if arguments.which is None:
        _require_no_options(arguments)
        return _list()
    chosen = _pick(arguments.which)
    if arguments.mine and len(chosen) > 1:
        chosen = [experiment for experiment in chosen if experiment.name != peers.NAME]  # which has no curve of theirs
    if arguments.publish and arguments.format not in (None, "svg"):
        raise BadInput(f"plot: --publish needs the format svg, but --format is {arguments.format}")
    if len(chosen) > 1 and (arguments.more or arguments.merge or arguments.out):
        raise BadInput("plot: --merge, --out and options after -- are for one experiment")
    if "--help" in arguments.more:
        return subprocess.run([program(f"plot_{chosen[0].name}"), "--help"]).returncode
    if len(chosen) == 1 and chosen[0].name == _OF_ENGINES:
        arguments.more = without_sweep(arguments.more)
    codes = [_one(experiment, arguments) for experiment in chosen]
    return max(codes)


def without_sweep(more: list[str]) -> list[str]:
    """Returns the options of work_precision with --sweep NAME=A,B written as --NAME A,B or --set NAME=A,B. A parameter of
    the scene goes before an option of the same name."""
    try:
        swept, words = taken_lists("--sweep", more)
        axes = [axis_of(text) for text in swept]
        scene = value_of("--scene", words) or "stack"
        words = [scene, *words]
        parameters = parameters_of(scene) if axes else set()
        require_distinct((name for name, _ in axes), parameters)
        for name, _ in axes:
            require_free(words, name, parameters)
    except BadInput as error:
        raise BadInput(str(error).replace("run: ", "plot: ", 1)) from None
    for name, values in axes:
        if name.replace("_", "-") == "warm-start" and name not in parameters:
            words.append(f"--warm-start={','.join(values)}")
        else:
            words = with_changed(words, name, ",".join(values), parameters)
    return words[1:]


def _require_no_options(arguments) -> None:
    """Refuses options that have no effect without an experiment."""
    for name in ("mine", "quick", "shard", "merge", "slurm", "publish", "format", "out"):
        if getattr(arguments, name):
            raise BadInput(f"plot: --{name} needs the NAME of an experiment; ./course plot lists them")
    if arguments.more:
        raise BadInput("plot: options after -- need the NAME of an experiment; ./course plot lists them")


def _list() -> int:
    topic = None
    for experiment in experiments():
        if experiment.source.parent.name != topic:
            topic = experiment.source.parent.name
            print(paint(topic, "bold"))
        print(textwrap.fill(experiment.title, 80, initial_indent=f"  {experiment.name:<17} ", subsequent_indent=20 * " "))
    print("\n./course plot NAME runs one, checks its claims, and draws it; NAME may be all.")
    return 0


def _pick(word: str) -> list[Experiment]:
    known = experiments()
    if word == "all":
        if not peers.any_there():
            print(f"The experiment {peers.NAME} is left out, since no other engine is installed; ./course plot "
                  f"{peers.NAME} says how to install one.\n")
            known = [experiment for experiment in known if experiment.name != peers.NAME]
        return known
    chosen = [experiment for experiment in known if word in (experiment.name, experiment.source.parent.name)]
    if not chosen:
        names = [experiment.name for experiment in known]
        raise BadInput(f"there is no experiment {word!r}{near(word, names)}; ./course plot lists them")
    return chosen


def _one(experiment: Experiment, arguments) -> int:
    print(paint(experiment.name, "bold"), experiment.title, flush=True)
    if experiment.name == peers.NAME:
        if arguments.mine:
            raise BadInput(f"plot: {peers.NAME} compares engines, and has no --mine")
        peers.require()
    if arguments.slurm:
        _compute_on_slurm(experiment, arguments)
    code = _run(experiment, arguments, [])
    mine = begun() if arguments.mine else []
    if arguments.mine and not mine:
        print("You have written no exercise yet, so there is no curve of yours.", file=sys.stderr)
    if mine:
        print(fold(f"{told(mine)} Claims about your functions:"), flush=True)
        _run(experiment, arguments, mine)
    if arguments.shard and not arguments.shard.endswith("/1"):  # a part, which has no table
        return code
    figure = _draw(experiment, bool(mine), arguments.out, arguments.format or ("svg" if arguments.publish else "png"))
    if arguments.publish:
        if code != 0 or mine or arguments.quick:
            raise CourseError("plot: --publish needs the reference, in full size, with true claims: leave out --mine "
                              "and --quick")
        figure = Path(shutil.copy(figure, experiment.source.parent))
    print(f"figure: {shown(figure)}\n", flush=True)
    return code


def _run(experiment: Experiment, arguments, mine: list[Exercise]) -> int:
    target = f"plot_{experiment.name}"
    path = fast_program(f"{target}_mine", mine) if mine else program(target)
    folder = experiment.folder(bool(mine), arguments.out)
    folder.mkdir(parents=True, exist_ok=True)
    with _results_set_aside(folder):
        return _compute(experiment, arguments, path, folder, own_step=bool(mine and arguments.engine))


@contextlib.contextmanager
def _results_set_aside(folder: Path):
    """Moves the last results away. They are deleted once there are new ones, and restored otherwise: if the command is
    refused or stopped, or computes a shard."""
    results = [folder / name for name in ("table.csv", "claims.json")]
    aside = [result.with_name(f"{result.name}.before") for result in results]
    for result, kept in zip(results, aside):
        if result.exists():
            result.replace(kept)
    done = False
    try:
        yield
        done = any(result.exists() for result in results)
    finally:
        for result, kept in zip(results, aside):
            if done:
                kept.unlink(missing_ok=True)
            elif kept.exists():
                kept.replace(result)


def _compute(experiment: Experiment, arguments, path: Path, folder: Path, own_step: bool) -> int:
    for other in arguments.merge or []:
        _merge(Path(other), folder)
    command = [str(path), "--out", str(folder), *arguments.more]
    command += ["--engine", "plain"] if own_step else []
    command += ["--quick"] if arguments.quick else []
    command += ["--shard", arguments.shard] if arguments.shard else []
    hashes = hashes_of([path, *_scene_file(arguments.more)])
    live = Live(experiment.name, delay=0)  # the first point alone may take minutes
    held: list[str] = []  # the last line, which may be that of a refusal

    def print_held() -> None:
        live.done()
        while held:
            print(fold(held.pop().rstrip(), "  "), flush=True)

    def on_line(line: str) -> None:
        if _PROGRESS.match(line):
            live.update(line.strip())
        else:
            print_held()
            held.append(line)

    code, output = stream(command, on_line)
    if code == 2:
        live.done()
        raise BadInput(f"plot: {tail(output, 1).strip()}")
    print_held()
    if code not in (0, 1):
        raise CourseError(f"{experiment.name} ended with exit code {code}", tail(output))
    if code == 1 and not (folder / "claims.json").exists():
        raise CourseError(f"{experiment.name} failed", tail(output))
    if (folder / "table.csv").exists():
        write_manifest(folder / "table.csv", _typed(experiment, arguments), hashes)
    return code


def _typed(experiment: Experiment, arguments) -> list[str]:
    """Returns the command that computes a table again."""
    words = ["plot", experiment.name]
    words += ["--engine", "mine"] if arguments.engine else ["--mine"] if arguments.mine else []
    words += ["--quick"] if arguments.quick else []
    words += ["--out", arguments.out] if arguments.out else []
    words += ["--merge", *arguments.merge] if arguments.merge else []
    return words + (["--", *arguments.more] if arguments.more else [])


def _scene_file(more: list[str]) -> list[Path]:
    scene = value_of("--scene", more) or ""
    return [Path(scene)] if scene.endswith(".json") else []


def _compute_on_slurm(experiment: Experiment, arguments) -> None:
    """Computes each part in the experiment's own folder, and missing points here."""
    if arguments.mine or arguments.shard or arguments.merge:
        raise BadInput("plot: --slurm divides the experiment itself; leave out --mine, --shard and --merge")
    path, folder = program(f"plot_{experiment.name}"), experiment.folder(False, arguments.out)
    command = [str(path), "--out", str(folder), "--shard", f"@I@/{arguments.slurm}", *arguments.more]
    failed = run_array(command + (["--quick"] if arguments.quick else []), arguments.slurm, folder / "slurm",
                       f"{experiment.name} on Slurm")
    for part, why in failed.items():
        print(fold_lines(f"part {part} of {arguments.slurm} failed: {why}", "  "), file=sys.stderr)


def _merge(other: Path, folder: Path) -> None:
    """Copies the results of shards, computed here or on another machine."""
    parts = other / "parts" if (other / "parts").is_dir() else other
    found = sorted(parts.glob("[0-9]*.csv"))
    if not found:
        raise BadInput(f"merge: {other} has no parts of an experiment")
    if not (parts / "plan.txt").exists():
        raise BadInput(f"merge: {other} has no plan.txt, which names the experiment of its parts")
    (folder / "parts").mkdir(exist_ok=True)
    plan = folder / "parts" / "plan.txt"
    if plan.exists() and plan.read_bytes() != (parts / "plan.txt").read_bytes():
        raise BadInput(f"merge: the parts in {other} are of another experiment, or of another size, than those before")
    (folder / "parts" / "program.txt").unlink(missing_ok=True)  # of this build; others' parts are of others
    for part in [*found, parts / "plan.txt"]:
        shutil.copyfile(part, folder / "parts" / part.name)


def _draw(experiment: Experiment, mine: bool, out: str | None, kind: str) -> Path:
    folder = experiment.folder(False, out)
    figure = folder / f"{experiment.name}.{kind}"
    command = [sys.executable, str(experiment.drawing), "--data", str(folder)]
    command += ["--mine", str(experiment.folder(True, out))] if mine else []
    command += ["--out", str(figure)]
    code, output = stream(command, lambda line: None)
    if code != 0:
        raise CourseError(f"{experiment.name} could not be drawn", tail(output))
    return figure
