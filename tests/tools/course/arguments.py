"""The command line: one parser; whatever is wrong with it is said in one line."""

import argparse

from errors import BadInput
from pick import near

EPILOG = """\
N is a chapter (4), N.M an exercise (4.2). An exercise's function (update_row)
will do in place of its number.

Without N, check takes every exercise that you have started, in order, and
explains the first that is not right. watch does the same at every save.

run and scenes hand everything to the engine: ./course run --help. With --mine,
run takes the exercises that you have written so far, right or wrong, in place
of the reference's. What stands after -- goes to plot's experiment itself.

Exit codes: 0 fine, 1 a wrong answer or a failure, 2 bad input.
"""


class Parser(argparse.ArgumentParser):
    def __init__(self, **options):
        super().__init__(allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter, **options)

    def error(self, message: str):
        raise BadInput(" ".join(message.split()) + f"; see {self.prog} --help")


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and int(text) < 2**64):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 0 to 2^64 - 1")
    return int(text)


def parse(words: list[str]) -> argparse.Namespace:
    """`command` and its options; for run and scenes, `words` are what follows, untouched."""
    parser, commands = _parsers()
    if words and not words[0].startswith("-") and words[0] not in commands:
        raise BadInput(f"unknown command {words[0]!r}{near(words[0], list(commands))}; see ./course --help")
    if words and words[0] in ("run", "scenes"):
        return argparse.Namespace(command=words[0], words=words[1:])
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
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", title="commands")

    def add(name: str, text: str) -> Parser:
        return commands.add_parser(name, help=text, description=text, prog=f"./course {name}")

    add("progress", "the board: what is done, and the next step (the default)").add_argument(
        "--json", action="store_true", help="as one JSON object")
    _choose(add("check", "test a chapter or an exercise; the first failure first"))
    _choose(add("watch", "check at every save"))
    command = add("hint", "one more hint")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--again", action="store_true", help="from the first")
    command = add("solution", "the reference, once the exercise passes")
    command.add_argument("which", metavar="N.M")
    command.add_argument("--spoil", action="store_true", help="even before")
    add("reset", "put the stub back; your file is kept beside it").add_argument("which", metavar="N.M")
    add("run", "run a scene: ./course run SCENE --set name=value --h 1/60 [--mine] ...")
    add("scenes", "the scenes, their parameters, and the known answer of each")
    command = add("plot", "run an experiment, check its claims, draw it; without a name: list them")
    command.add_argument("which", nargs="?", metavar="NAME", help="an experiment, a topic, or all")
    command.add_argument("--mine", action="store_true", help="with a curve of your own functions beside ours")
    command.add_argument("--quick", action="store_true", help="the size that the tests run")
    command.add_argument("--shard", metavar="I/N", help="compute only each N-th point, from the I-th")
    command.add_argument("--merge", nargs="+", metavar="FOLDER", help="put together what shards have computed")
    command.add_argument("--publish", action="store_true", help="put the figure into plots/, where pages show it")
    command.set_defaults(more=[])
    for name, text in (("start", "install, build, run real scenes, show the board"),
                       ("test", "every test there is")):
        add(name, text).add_argument("--yes", action="store_true", help="install without asking")
    return parser, commands.choices


def _choose(command: Parser) -> None:
    command.add_argument("which", nargs="?", metavar="N | N.M", help="a chapter or an exercise")
    command.add_argument("--seed", type=_seed, metavar="S",
                         help="the seed of random inputs, as a failure prints it")
