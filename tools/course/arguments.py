"""The command line: one parser; an invalid call gives one line."""

import argparse
from datetime import datetime

from errors import BadInput
from grading.choices import ATTEMPTS, ISOLATIONS, RULES, TABLE
from paths import BUILD
from pick import near, pick_list

EPILOG = """\
N is a chapter (4), N.M an exercise (4.2). The name of an exercise's function
(update_row) may replace its number. LIST has several of them, and ranges:
1-5,6.1,8.1-8.4.

Without N, check tests every exercise that you have started, in order, and
explains the first wrong one. watch does the same at every save.

run and scenes pass all options to the engine: ./course run --help. After the
scene, view and play accept those of run's options that their --help names.
With --mine they use the exercises that you have written so far, right or
wrong, instead of the reference's. Arguments after -- are passed to plot's
experiment.

Exit codes: 0 success, 1 a wrong answer or a failure, 2 bad input.
"""


EXPORTS = ("gradescope", "github", "autolab", "junit", "csv", "canvas", "moodle", "weights", "students")


class Parser(argparse.ArgumentParser):
    def __init__(self, **options):
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str):
        raise BadInput(" ".join(message.split()) + f"; see {self.prog} --help")


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and int(text) < 2**64):
        raise argparse.ArgumentTypeError(f"must be a whole number from 0 to 2^64 - 1, but is {text!r}")
    return int(text)


def _count(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < int(text) < 10_000):
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 to 9999, but is {text!r}")
    return int(text)


def _time(text: str) -> datetime:
    try:
        return datetime.strptime(text, "%Y-%m-%dT%H:%M")
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a date and a time, as 2026-11-20T23:59, but is {text!r}") from None


def _shard(text: str) -> tuple[int, int]:
    first, _, count = text.partition("/")
    if not (text.isascii() and first.isdecimal() and count.isdecimal() and 1 <= int(first) <= int(count)):
        raise argparse.ArgumentTypeError(f"must be I/N with 1 <= I <= N, but is {text!r}")
    return int(first), int(count)


def _port(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < int(text) < 2**16):
        raise argparse.ArgumentTypeError(f"must be a port from 1 to 65535, but is {text!r}")
    return int(text)


def parse(words: list[str]) -> argparse.Namespace:
    """Reads `command` and its options. For run, scenes and python all words that follow belong to the engine or to
    Python."""
    parser, commands = _parsers()
    if words and not words[0].startswith("-") and words[0] not in commands:
        raise BadInput(f"unknown command {words[0]!r}{near(words[0], list(commands))}; see ./course --help")
    if words and words[0] in ("run", "scenes"):
        return argparse.Namespace(command=words[0], words=words[1:])
    if words and words[0] == "python" and words[1:2] not in (["-h"], ["--help"]):
        yes = words[1:2] == ["--yes"]
        return argparse.Namespace(command="python", yes=yes, words=words[1 + yes:])
    if words and words[0] in ("view", "play"):
        known, rest = commands[words[0]].parse_known_args(words[1:])
        return argparse.Namespace(**{**vars(known), "command": words[0], "words": rest})
    if words == ["--version"]:
        return argparse.Namespace(command="version")
    # Options alone belong to the board: ./course --json
    if not words or (words[0].startswith("-") and words[0] not in ("-h", "--help")):
        words = ["progress", *words]
    more: list[str] = []
    if words[0] == "plot" and "--" in words:
        words, more = words[: words.index("--")], words[words.index("--") + 1:]
    known, unknown = parser.parse_known_args(words)
    if unknown:
        options = [option for action in commands[words[0]]._actions for option in action.option_strings]
        what = "option" if unknown[0].startswith("-") else "argument"
        if words[0] == "plot" and what == "option" and not near(unknown[0], options, 0.75):
            raise BadInput(f"plot: unknown option {unknown[0]!r}; options of an experiment go after --: "
                           f"./course plot NAME -- {unknown[0]} ...")
        raise BadInput(f"{words[0]}: unknown {what} {unknown[0]!r}{near(unknown[0], options)}; "
                       f"see ./course {words[0]} --help")
    if more:
        known.more = _after_dashes(known, more)
    return known


def _parsers() -> tuple[Parser, dict[str, Parser]]:
    parser = Parser(prog="./course", epilog=EPILOG, usage="./course [COMMAND] ...",
                    description="Write a physics engine, one idea at a time.")
    parser.add_argument("--version", action="store_true", help="print the version of the course")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", title="commands")

    def add(name: str, text: str) -> Parser:
        return commands.add_parser(name, help=text, description=text, prog=f"./course {name}")

    add("progress", "show the board: finished exercises, and the next step (the default)").add_argument(
        "--json", action="store_true", help="print one JSON object")
    _choose(add("check", "test a chapter or an exercise; show the first failure"))
    _choose(add("watch", "check again at every save"))
    command = add("predict", "ask a chapter's questions, one at a time, before you write its code")
    command.add_argument("which", metavar="N", help="a chapter")
    command.add_argument("--again", action="store_true", help="ask answered questions again")
    command = add("try", "open a playground for one function: your program, run at every save")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--once", action="store_true", help="run it once, without watching")
    command = add("hint", "show the next hint")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--again", action="store_true", help="start from the first hint")
    command = add("solution", "show the reference, once your exercise passes")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--spoil", action="store_true", help="show it before your exercise passes")
    add("reset", "restore the stub; your file is kept beside it").add_argument("which", metavar="N.M")
    add("run", "run a scene: ./course run SCENE --set name=value --h 1/60 [--mine] ...")
    add("scenes", "list the scenes, their parameters and known answers")
    _add_view(add("view", "make a film of a scene: one page for any browser"))
    _add_play(add("play", "run a scene live in the browser: pull, push, change its parameters"))
    command = add("plot", "run an experiment, check its claims, draw it; without a name: list all")
    command.add_argument("which", nargs="?", metavar="NAME", help="an experiment, a topic, or all")
    command.add_argument("--mine", action="store_true", help="add a curve of your own functions")
    command.add_argument("--engine", choices=["mine"], help="add a curve of your own engine (work_precision only)")
    _add_experiment(command)
    command.add_argument("--merge", nargs="+", metavar="FOLDER", help="combine the results of shards")
    command.add_argument("--slurm", type=_count, metavar="N", help="compute as an array of N on an existing Slurm")
    command.add_argument("--publish", action="store_true", help="put the figure into plots/, where pages show it")
    command.add_argument("--format", choices=("png", "svg", "pdf"), help="format of the figure (default: png)")
    command.set_defaults(more=[])
    command = add("book", "make a site of the lessons and all pages, which opens without a server")
    command.add_argument("--out", metavar="DIR", help="output folder (default: build/book)")
    command.add_argument("--films", action="store_true", help="make films instead of live figures")
    command.add_argument("--mine", action="store_true",
                         help="run your own functions in the figures; without emscripten, in pages of ./course view")
    command.add_argument("--views", action="store_true", help="link each film to its page of ./course view")
    command.add_argument("--publish", metavar="REMOTE",
                         help="push the site to branch gh-pages of this git remote, as its only commit")
    command = add("slides", "make a chapter's slides from its lesson: one HTML file that prints, with notes")
    command.add_argument("which", metavar="N", help="a chapter")
    command.add_argument("--out", metavar="FILE", help="output file (default: build/slides/NN_topic.html)")
    command = add("exam", "print exam questions with numbers drawn by a seed; --answers adds the answers")
    command.add_argument("chapters", nargs="?", type=pick_list, metavar="LIST",
                         help="chapters and exercises: 1-5, or 1-7,8.1-8.4")
    command.add_argument("--seed", type=_seed, metavar="S", help="seed of numbers, signs and conventions (default: 1)")
    command.add_argument("--answers", action="store_true", help="print the answer below each question")
    command.add_argument("--objectives", action="store_true", help="print chapters/OBJECTIVES.md")
    command = add("import", "convert a model in MJCF, MuJoCo's format, to a scene file")
    command.add_argument("model", metavar="FILE.xml")
    command.add_argument("--out", metavar="FILE.json", help="output file (default: standard output)")
    command = add("python", "build the Python module, or run a file that imports spook")
    command.usage = "./course python [--yes] [FILE ...]"
    command.add_argument("--yes", action="store_true", help="install without asking")
    command.add_argument("words", nargs="*", metavar="FILE ...", help="arguments of Python; the file may import spook")
    _add_grade(add("grade", "grade a class: folders and zips that contain chapters/"))
    command = add("export", "make files for grading elsewhere, or a repository for students")
    command.add_argument("what", metavar="FORMAT", choices=EXPORTS, help=", ".join(EXPORTS))
    command.add_argument("results", nargs="*", metavar="RESULTS",
                         help="results.json of one submission, or a folder that grade has written")
    command.add_argument("--out", metavar="FILE", help="output file; a folder for autolab and students (default: text "
                                                       "is printed, a kit has its usual name)")
    command.add_argument("--chapters", type=pick_list, metavar="LIST",
                         help="chapters and exercises to export: 1-5, or 1-7,8.1-8.4 (default: all)")
    command.add_argument("--hidden", metavar="DIR", help="folder of hidden tests for the platform")
    command.add_argument("--seed", type=_seed, metavar="S", help="seed of random inputs on the platform")
    command.add_argument("--hidden-seed", type=_seed, metavar="S", help="seed of tests that students do not see there")
    command.add_argument("--weights", metavar="FILE", help="table of points, for a kit or to score results again")
    command.add_argument("--points", choices=RULES,
                         help="points for whole exercises, for each test, or for all exercises alike")
    command.add_argument("--time-limit", type=_count, metavar="SECONDS", help="time limit of a test on the platform")
    command.add_argument("--roster", metavar="FILE", help="for canvas and moodle: the table exported by the platform")
    command.add_argument("--assignment", metavar="TITLE",
                         help="for canvas: title of the column, Name (number) (default: Assignment)")
    _add_update(add("update", "change to another release of the course; your files are kept"))
    for name, text in (("start", "install, build, run real scenes, show the board"),
                       ("test", "test this checkout; --all: run every test")):
        command = add(name, text)
        command.add_argument("--yes", action="store_true", help="install without asking")
    command.add_argument("--all", action="store_true", help="add sanitizers, experiments, browsers and all mutants")
    command.add_argument("--strict", action="store_true", help="treat compiler warnings in the course's code as errors")
    return parser, commands.choices


def _add_experiment(command: Parser) -> None:
    """Adds the options that the programs of experiments have, too."""
    command.add_argument("--out", metavar="FOLDER", help="folder of table and figure (default: build/plots/NAME)")
    command.add_argument("--quick", action="store_true", help="use the small size of the tests")
    command.add_argument("--shard", metavar="I/N", help="compute only each N-th point, from the I-th")


def _after_dashes(known: argparse.Namespace, more: list[str]) -> list[str]:
    """Reads the options of plot that are given after --, where the program's own help lists them. Returns the others."""
    parser = Parser(prog="./course plot", add_help=False)
    _add_experiment(parser)
    own, rest = parser.parse_known_args(more)
    for name, value in vars(own).items():
        if value and getattr(known, name):
            raise BadInput(f"plot: --{name} is given twice; leave one out")
        setattr(known, name, value or getattr(known, name))
    return rest


def _add_update(command: Parser) -> None:
    command.add_argument("release", nargs="?", metavar="RELEASE", help="such as 1.2.0 (default: the newest)")
    command.add_argument("--dry-run", action="store_true", help="list the changes, and change nothing")
    command.add_argument("--undo", action="store_true", help="restore the state before the last update")
    command.add_argument("--from", dest="from_", metavar="WHERE",
                         help="a git remote, address or folder (default: the remote upstream, or origin)")


def _add_view(command: Parser) -> None:
    command.usage = "./course view SCENE [OPTION OF RUN ...] [OPTION ...]\n       ./course view FILE.jsonl ..."
    command.epilog = ("Also accepts the options of ./course run for a single run, except --record\n"
                      "and --restart. FILE.jsonl is the output of ./course run SCENE --record.")
    command.add_argument("--mine", action="store_true", help="use the exercises that you have written so far")
    command.add_argument("--beside", nargs="+", action="extend", metavar="WHAT",
                         help="add another run to the picture: mine, or a run with NAME=VALUE[,NAME=VALUE] "
                              "changed, an option of run or a parameter of the scene")
    command.add_argument("--fps", metavar="N",
                         help="frames per simulated second (default: 60, and at least 150 frames)")
    command.add_argument("--out", metavar="FILE", help="output file (default: build/views/SCENE.html)")
    command.set_defaults(back=None)  # the book's pages lead here, and back
    command.add_argument("--gltf", metavar="FILE",
                         help="write glTF for Blender instead of a page: moving bodies and rods")


def _add_play(command: Parser) -> None:
    command.usage = "./course play SCENE [OPTION OF RUN ...] [OPTION ...]"
    command.epilog = ("Also accepts --fps and the options of ./course run for scene and solver,\n"
                      "except --integrator-order. Only this machine can open the page; leaving the\n"
                      "page, or Ctrl-C, ends the run.")
    command.add_argument("--mine", action="store_true", help="use your exercises; a save restarts the run with the new code")
    command.add_argument("--port", type=_port, metavar="N", help="port of the local server (default: any free port)")
    command.add_argument("--no-open", action="store_true", help="print the address without opening a browser")


def _add_grade(command: Parser) -> None:
    command.add_argument("paths", nargs="*", metavar="PATH", help="a submission, or a folder of them")
    command.add_argument("--chapters", type=pick_list, metavar="LIST",
                         help="chapters and exercises to grade: 1-5, or 1-7,8.1-8.4 (default: all)")
    command.add_argument("--jobs", type=_count, default=2, metavar="N", help="number of parallel jobs (default: 2)")
    command.add_argument("--out", default=str(BUILD / "grades"), metavar="DIR",
                         help="output folder (default: build/grades)")
    command.add_argument("--seed", type=_seed, metavar="S",
                         help="seed of random inputs (default: 1), which is recorded")
    command.add_argument("--hidden-seed", type=_seed, metavar="S",
                         help="seed of tests that students do not see, which no report states (default: --seed)")
    command.add_argument("--hidden", metavar="DIR",
                         help="folder of further tests, NN_topic/*.cpp, and their weights.csv")
    command.add_argument("--weights", default=str(TABLE), metavar="FILE",
                         help="table of points, titles, hints, visibility (default: tests/weights.csv)")
    command.add_argument("--points", choices=RULES, default=RULES[0],
                         help="points for whole exercises (default), for each test, or for all exercises alike")
    command.add_argument("--attempt", choices=ATTEMPTS, default=ATTEMPTS[0],
                         help="which of a student's attempts on a platform counts (default: last); on-time: the last "
                              "that is not late, or if all are late the last")
    command.add_argument("--due", type=_time, metavar="TIME",
                         help="with --attempt on-time: 2026-11-20T23:59, on the clock of the platform; without it, an "
                              "attempt is late only if its name says so, as on Canvas")
    command.add_argument("--time-limit", type=_count, default=10, metavar="SECONDS",
                         help="processor time for each test (default: 10)")
    command.add_argument("--exercise-time", type=_count, default=20, metavar="SECONDS",
                         help="largest total of time-outs and slow work in an exercise; then its other tests are skipped "
                              "(default: 20)")
    command.add_argument("--submission-time", type=_count, default=120, metavar="SECONDS",
                         help="largest total of time-outs and slow work in a submission (default: 120)")
    command.add_argument("--isolation", choices=ISOLATIONS, metavar="NAME",
                         help=f"isolation of submissions (default: the first that works of {', '.join(ISOLATIONS)})")
    command.add_argument("--fresh", action="store_true",
                         help="grade everything again, ignoring earlier results; after an interruption continue "
                              "without --fresh")
    command.add_argument("--prepare", action="store_true",
                         help="only install missing packages, build, and test the reference")
    command.add_argument("--yes", action="store_true", help="install without asking")
    command.add_argument("--gradescope", metavar="FILE",
                         help="for one submission: write Gradescope's results after each exercise")
    command.add_argument("--shard", type=_shard, metavar="I/N", help="grade only each N-th submission, from the I-th")
    command.add_argument("--similarity", action="store_true", help="compare submissions: similarity.html")
    command.add_argument("--roster", metavar="FILE", help="list of the class from Canvas, Moodle or a CSV")
    command.add_argument("--slurm", type=_count, metavar="N", help="grade as an array of N on an existing Slurm")
    command.add_argument("--merge", nargs="+", metavar="DIR", help="combine the results of shards")


def _choose(command: Parser) -> None:
    command.add_argument("which", nargs="?", metavar="N | N.M", help="a chapter or an exercise")
    command.add_argument("--seed", type=_seed, metavar="S",
                         help="seed of random inputs, which a failure prints")
