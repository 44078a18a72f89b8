"""./course test: every test there is."""

import re
from dataclasses import dataclass

from install import install
from needs import NEEDS, TEST_NEEDS
from paths import shown
from process import stream
from terminal import paint
from tree import Tree, jobs

_TOTAL = re.compile(r"^\d+% tests passed, (\d+) tests? failed out of (\d+)")
_FAILED = re.compile(r"^\t? *\d+ - (\S+) \((.+)\)")


@dataclass(frozen=True)
class Outcome:
    preset: str
    total: int
    failed: list[str]
    ok: bool


def test(arguments) -> int:
    install(NEEDS + TEST_NEEDS, arguments.yes)
    trees = [Tree("check"), Tree("sanitize")]
    for tree in trees:
        print(f"Building {shown(tree.path)}.", flush=True)
        built = tree.build([], f"building {tree.preset}")
        if not built.ok:
            raise tree.own_failure(built)
    outcomes = [_run(tree) for tree in trees]
    print()
    for outcome in outcomes:
        passed = outcome.total - len(outcome.failed)
        print(f"{outcome.preset + ':':<10} {passed} of {outcome.total} tests passed")
        for name in outcome.failed:
            print(f"  {paint('failed', 'red')} {name}")
    return 0 if all(outcome.ok for outcome in outcomes) else 1


def _run(tree: Tree) -> Outcome:
    """Passes on what ctest prints, as it prints it."""
    print(f"\nTesting {shown(tree.path)}.", flush=True)
    command = ["ctest", "--test-dir", str(tree.path), "--output-on-failure", "--no-tests=error",
               "-j", str(jobs())]
    log = tree.path / "course-test.log"
    code, output = stream(command, lambda line: print(line, end="", flush=True), log)
    lines = output.splitlines()
    closing = next((k for k, line in enumerate(lines) if _TOTAL.match(line)), len(lines))
    total = int(_TOTAL.match(lines[closing])[2]) if closing < len(lines) else 0
    failed = [f"{found[1]} ({found[2]})" for line in lines[closing:] if (found := _FAILED.match(line))]
    return Outcome(tree.preset, total, failed, code == 0)
