"""The command line: one parser; whatever is wrong with it is said in one line."""

import argparse

from errors import BadInput
from grading.isolation import NAMES
from grading.results import RULES
from grading.weights import TABLE
from paths import BUILD
from pick import near

EPILOG = """\
N is a chapter (4), N.M an exercise (4.2). An exercise's function (update_row)
will do in place of its number.

Without N, check takes every exercise that you have started, in order, and
explains the first that is not right. watch does the same at every save.

run and scenes hand everything to the engine: ./course run --help. view and
play take run's options, too, after the scene. With --mine they take the
exercises that you have written so far, right or wrong, in place of the
reference's. What stands after -- goes to plot's experiment itself.

Exit codes: 0 fine, 1 a wrong answer or a failure, 2 bad input.
"""


EXPORTS = ("gradescope", "github", "autolab", "junit", "csv", "canvas", "moodle", "weights", "students")


class Parser(argparse.ArgumentParser):
    def __init__(self, **options):
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str):
        raise BadInput(" ".join(message.split()) + f"; see {self.prog} --help")


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and int(text) < 2**64):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0 to 2^64 - 1")
    return int(text)


def _count(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < int(text) < 10_000):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1")
    return int(text)


def _shard(text: str) -> tuple[int, int]:
    first, _, count = text.partition("/")
    if not (text.isascii() and first.isdecimal() and count.isdecimal() and 1 <= int(first) <= int(count)):
        raise argparse.ArgumentTypeError(f"{text!r} is not I/N with 1 <= I <= N")
    return int(first), int(count)


def _port(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and 0 < int(text) < 2**16):
        raise argparse.ArgumentTypeError(f"{text!r} is not a port from 1 to 65535")
    return int(text)


def _chapters(text: str) -> set[int]:
    numbers: set[int] = set()
    for part in text.split(","):
        first, dash, last = part.partition("-")
        if not (text.isascii() and first.isdecimal() and (last.isdecimal() if dash else True)
                and 1 <= int(first) <= int(last or first) < 100):
            raise argparse.ArgumentTypeError(f"{text!r} is not a list of chapters such as 1-5 or 1,3,5-7")
        numbers |= set(range(int(first), int(last or first) + 1))
    return numbers


def parse(words: list[str]) -> argparse.Namespace:
    """`command` and its options. `words` are what belongs to the engine or to Python: for run, scenes, python all that
    follows."""
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
        raise BadInput(f"{words[0]}: unknown {what} {unknown[0]!r}{near(unknown[0], options)}; "
                       f"see ./course {words[0]} --help")
    if more:
        known.more = more
    return known


def _parsers() -> tuple[Parser, dict[str, Parser]]:
    parser = Parser(prog="./course", epilog=EPILOG, usage="./course [COMMAND] ...",
                    description="Write a physics engine, one idea at a time.")
    parser.add_argument("--version", action="store_true", help="say which version of the course this is")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", title="commands")

    def add(name: str, text: str) -> Parser:
        return commands.add_parser(name, help=text, description=text, prog=f"./course {name}")

    add("progress", "the board: what is done, and the next step (the default)").add_argument(
        "--json", action="store_true", help="as one JSON object")
    _choose(add("check", "test a chapter or an exercise; the first failure first"))
    _choose(add("watch", "check at every save"))
    command = add("predict", "a chapter's questions, one at a time, before you write its code")
    command.add_argument("which", metavar="N", help="a chapter")
    command.add_argument("--again", action="store_true", help="those that you have answered, too")
    command = add("try", "a playground for one function: a program of yours, run at every save")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--once", action="store_true", help="run it once, and do not watch")
    command = add("hint", "one more hint")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--again", action="store_true", help="from the first")
    command = add("solution", "the reference, once the exercise passes")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--spoil", action="store_true", help="even before")
    add("reset", "put the stub back; your file is kept beside it").add_argument("which", metavar="N.M")
    add("run", "run a scene: ./course run SCENE --set name=value --h 1/60 [--mine] ...")
    add("scenes", "the scenes, their parameters, and the known answer of each")
    _add_view(add("view", "a film of a scene, in one page for any browser"))
    _add_play(add("play", "a scene live in the browser: pull, push, turn its parameters"))
    command = add("plot", "run an experiment, check its claims, draw it; without a name: list them")
    command.add_argument("which", nargs="?", metavar="NAME", help="an experiment, a topic, or all")
    command.add_argument("--mine", action="store_true", help="with a curve of your own functions beside ours")
    command.add_argument("--quick", action="store_true", help="the size that the tests run")
    command.add_argument("--shard", metavar="I/N", help="compute only each N-th point, from the I-th")
    command.add_argument("--merge", nargs="+", metavar="FOLDER", help="put together what shards have computed")
    command.add_argument("--slurm", type=_count, metavar="N", help="compute as an array of N on an existing Slurm")
    command.add_argument("--publish", action="store_true", help="put the figure into plots/, where pages show it")
    command.add_argument("--format", choices=("png", "svg", "pdf"), help="of the figure; png unless given")
    command.set_defaults(more=[])
    command = add("book", "the lessons and all pages as a site, which opens from the file system")
    command.add_argument("--out", metavar="DIR", help="default: build/book")
    command.add_argument("--films", action="store_true", help="films alone, where emscripten would make live figures")
    command.add_argument("--views", action="store_true", help="with each film as a page of ./course view behind it")
    command.add_argument("--publish", metavar="REMOTE",
                         help="push it to branch gh-pages of this git remote, as its only commit")
    command = add("slides", "a chapter's lecture, made of its lesson, as one HTML file that prints; with notes")
    command.add_argument("which", metavar="N", help="a chapter")
    command.add_argument("--out", metavar="FILE", help="default: build/slides/NN_topic.html")
    command = add("exam", "exam questions on the objectives of chapters, drawn by a seed; with their answers")
    command.add_argument("chapters", nargs="?", type=_chapters, metavar="A-B", help="1-5, or 1,3,5-7")
    command.add_argument("--seed", type=_seed, metavar="S", help="of numbers, signs and conventions (default: 1)")
    command.add_argument("--answers", action="store_true", help="below each question")
    command.add_argument("--objectives", action="store_true", help="print chapters/OBJECTIVES.md")
    command = add("import", "a model in MJCF, MuJoCo's format, as a scene file")
    command.add_argument("model", metavar="FILE.xml")
    command.add_argument("--out", metavar="FILE.json", help="default: to standard output")
    command = add("python", "the Python module: build it, or run a file that imports spook")
    command.usage = "./course python [--yes] [FILE ...]"
    command.add_argument("--yes", action="store_true", help="install without asking")
    command.add_argument("words", nargs="*", metavar="FILE ...", help="what Python runs, with spook to import")
    _add_grade(add("grade", "marks for a class: folders and zips that hold chapters/"))
    command = add("export", "what another platform needs to grade, results in its form, or a repository for students")
    command.add_argument("what", metavar="FORMAT", choices=EXPORTS, help=", ".join(EXPORTS))
    command.add_argument("results", nargs="*", metavar="RESULTS",
                         help="results.json of one submission, or a folder that grade has written")
    command.add_argument("--out", metavar="FILE", help="where to write; without it, what is text is printed")
    command.add_argument("--chapters", type=_chapters, metavar="A-B", help="what the platform is to grade, or students are to write")
    command.add_argument("--hidden", metavar="DIR", help="hidden tests that the platform gets")
    command.add_argument("--seed", type=_seed, metavar="S", help="the seed with which it grades")
    command.add_argument("--weights", metavar="FILE", help="points by this table: of a kit, or of results once more")
    command.add_argument("--points", choices=RULES, help="what counts: exercises that are right, or each test")
    command.add_argument("--time-limit", type=_count, metavar="SECONDS", help="of a test, where the platform grades")
    command.add_argument("--roster", metavar="FILE", help="for canvas and moodle: the table that the platform gave")
    command.add_argument("--assignment", default="Assignment", metavar="TITLE",
                         help="of its column in Canvas: Name (number)")
    _add_update(add("update", "another release of the course; all that you have written is kept"))
    for name, text in (("start", "install, build, run real scenes, show the board"),
                       ("test", "whether this checkout works; --all: every test there is")):
        command = add(name, text)
        command.add_argument("--yes", action="store_true", help="install without asking")
    command.add_argument("--all", action="store_true", help="sanitizers, experiments, browsers and all mutants, too")
    command.add_argument("--strict", action="store_true", help="a compiler's warning in the course's code is an error")
    return parser, commands.choices


def _add_update(command: Parser) -> None:
    command.add_argument("release", nargs="?", metavar="RELEASE", help="such as 1.2.0 (default: the newest)")
    command.add_argument("--dry-run", action="store_true", help="say what would change, and change nothing")
    command.add_argument("--undo", action="store_true", help="go back to what was before the last update")
    command.add_argument("--from", dest="from_", metavar="WHERE",
                         help="a remote, an address or a folder of git (default: the remote upstream, or origin)")


def _add_view(command: Parser) -> None:
    command.usage = "./course view SCENE [OPTION OF RUN ...] [OPTION ...]\n       ./course view FILE.jsonl ..."
    command.epilog = "Any option of ./course run is taken, too. FILE.jsonl is what\n./course run SCENE --record writes."
    command.add_argument("--mine", action="store_true", help="with what you have written so far")
    command.add_argument("--beside", nargs="+", action="extend", metavar="WHAT",
                         help="another run in the same picture, in step: mine, or one with NAME=VALUE[,NAME=VALUE] "
                              "changed, an option of run or a parameter of the scene")
    command.add_argument("--fps", metavar="N",
                         help="frames a second of simulated time (default: 60, and at least 150 frames)")
    command.add_argument("--out", metavar="FILE", help="default: build/views/SCENE.html")
    command.set_defaults(back=None)  # the book's pages lead here, and back
    command.add_argument("--gltf", metavar="FILE", help="for Blender, in place of a page: bodies and rods as they move")


def _add_play(command: Parser) -> None:
    command.usage = "./course play SCENE [OPTION OF RUN ...] [OPTION ...]"
    command.epilog = ("Any option of ./course run is taken, too. Only this machine can open the page;\n"
                      "leaving it, or Ctrl-C, ends the run.")
    command.add_argument("--mine", action="store_true", help="with what you have written; a save goes on with it")
    command.add_argument("--port", type=_port, metavar="N", help="of the local server (default: any that is free)")
    command.add_argument("--no-open", action="store_true", help="print the address, and open no browser")


def _add_grade(command: Parser) -> None:
    command.add_argument("paths", nargs="*", metavar="PATH", help="a submission, or a folder of them")
    command.add_argument("--chapters", type=_chapters, metavar="A-B", help="1-5, or 1,3,5-7 (default: all)")
    command.add_argument("--jobs", type=_count, default=2, metavar="N", help="side by side (default: 2)")
    command.add_argument("--out", default=str(BUILD / "grades"), metavar="DIR", help="default: build/grades")
    command.add_argument("--seed", type=_seed, metavar="S", help="of random inputs (default: 1); it is recorded")
    command.add_argument("--hidden", metavar="DIR", help="further tests, NN_topic/*.cpp, and a weights.csv of theirs")
    command.add_argument("--weights", default=str(TABLE), metavar="FILE",
                         help="points, titles, hints, visibility (default: tests/weights.csv)")
    command.add_argument("--points", choices=RULES, default=RULES[0],
                         help="what counts: exercises that are right (default), or each test")
    command.add_argument("--time-limit", type=_count, default=10, metavar="SECONDS",
                         help="of processor time, for each test (default: 10)")
    command.add_argument("--exercise-time", type=_count, default=60, metavar="SECONDS",
                         help="that time-outs may cost of an exercise; then the rest is not run (default: 60)")
    command.add_argument("--submission-time", type=_count, default=600, metavar="SECONDS",
                         help="the same of a submission (default: 600)")
    command.add_argument("--isolation", choices=NAMES, metavar="NAME",
                         help=f"default: the first that works of {', '.join(NAMES)}")
    command.add_argument("--fresh", action="store_true", help="forget what was judged before; interrupted, the command without it goes on")
    command.add_argument("--prepare", action="store_true", help="install what is missing, build, try the reference")
    command.add_argument("--yes", action="store_true", help="install without asking")
    command.add_argument("--gradescope", metavar="FILE", help="of one submission: Gradescope's results, as they come")
    command.add_argument("--shard", type=_shard, metavar="I/N", help="only each N-th submission, from the I-th")
    command.add_argument("--similarity", action="store_true", help="compare the works: similarity.html")
    command.add_argument("--roster", metavar="FILE", help="the class as Canvas, Moodle or a CSV lists it")
    command.add_argument("--slurm", type=_count, metavar="N", help="grade as an array of N on an existing Slurm")
    command.add_argument("--merge", nargs="+", metavar="DIR", help="put together what shards have written")


def _choose(command: Parser) -> None:
    command.add_argument("which", nargs="?", metavar="N | N.M", help="a chapter or an exercise")
    command.add_argument("--seed", type=_seed, metavar="S",
                         help="the seed of random inputs, as a failure prints it")
