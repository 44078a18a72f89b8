"""./course test: checks that this checkout works; with --all by every test."""

import re
import subprocess
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

import machine
import mutants
import slowest_tests
from errors import CourseError
from install import install, is_offered
from manifest import read_chapters
from needs import BOOK_NEEDS, BROWSER_NEEDS, NEEDS, PEER_NEEDS, SLURM_NEEDS, TEST_NEEDS, Need
from paths import shown
from process import stream
from sources import need_sources
from terminal import fold, paint
from tree import Tree, jobs

_TOTAL = re.compile(r"^\d+% tests passed, (\d+) tests? failed out of (\d+)")
_FAILED = re.compile(r"^\t? *\d+ - (\S+) \((.+)\)")
_SKIPPED = re.compile(r"\.\.\. skipped (['\"])(.+)\1$", re.MULTILINE)
_NAME = re.compile(r"^ *Test +#\d+: (\S+)", re.MULTILINE)
# What the sandboxes of the tests need in the tree that ./course run uses; without it each would build it for itself.
_IN_RELEASE = ["spook", "plot_energy", "plot_work_precision"]


@dataclass(frozen=True)
class Outcome:
    preset: str
    total: int
    failed: list[str]
    skipped: list[str]  # for which reasons something was
    ok: bool


def test(arguments) -> int:
    need_sources("test")
    if machine.is_mac():
        return _on_mac(arguments)
    install(NEEDS + TEST_NEEDS, arguments.yes)
    _install_if_offered(BOOK_NEEDS, "book to test", arguments.yes)
    return _everything(arguments) if arguments.all else _fast(arguments.strict)


def _fast(strict: bool) -> int:
    """Runs tests with the label `fast`, and the mutants of changed chapters. The slowest tests are left out if their files
    are those of the last green run."""
    check, now = Tree("check"), mutants.digests()
    slowest = slowest_tests.now(strict or _is_strict(check))
    _build(Tree("release"), _IN_RELEASE, strict)
    chapters = mutants.changed(check, now)
    labels = ["fast", *(f"mutants.{chapter}" for chapter in chapters)]
    _build(check, [*labels, *_graded(1)], strict)
    unchanged = slowest_tests.unchanged(check, slowest)
    chosen = selection(labels, unchanged)
    outcome = _run(check, chosen)
    if outcome.ok:
        mutants.remember(check, now)
        slowest_tests.remember(check, slowest)
    code = _report([outcome])
    print(fold(left_out(names(check), names(check, chosen), unchanged)))
    return code


def _on_mac(arguments) -> int:
    """Runs the tests of compiled code. Mutants, the grader, and the tests of the tools need Linux."""
    if arguments.all:
        machine.require_linux("./course test --all")
    install(NEEDS, arguments.yes)
    check = Tree("check")
    _build(Tree("release"), ["spook"], arguments.strict)
    _build(check, ["fast"], arguments.strict)
    code = _report([_run(check, [*selection(["fast"]), "-E", r"^tools\."])])
    print("Left out: mutant.*, plot.*, tools.*, and all tests under sanitizers, which need Linux.")
    return code


def _everything(arguments) -> int:
    _install_if_offered(BROWSER_NEEDS, "browser for the tests", arguments.yes)
    _install_if_offered(SLURM_NEEDS, "Slurm for the tests", arguments.yes)
    _install_if_offered(PEER_NEEDS, "other engines to compare with", arguments.yes)
    check, release, sanitize = Tree("check"), Tree("release"), Tree("sanitize")
    now, slowest = mutants.digests(), slowest_tests.now(arguments.strict or _is_strict(check))
    for tree, targets in ((release, [*_IN_RELEASE, "experiments", "spook_package"]), (check, ["all", *_graded()]),
                          (sanitize, [])):
        _build(tree, targets, arguments.strict)
    outcomes = [_run(tree) for tree in (check, sanitize)]
    if outcomes[0].ok:
        mutants.remember(check, now)
        slowest_tests.remember(check, slowest)
    return _report(outcomes)


def _is_strict(tree: Tree) -> bool:
    """Tells whether warnings are errors in this tree: after a run with --strict they stay so."""
    return tree.setting("SPOOK_WERROR") == "ON"


def _graded(chapters: int | None = None) -> list[str]:
    """Builds what the grader needs for the first chapters, or for all."""
    return [f"{side}_{chapter.folder}" for chapter in read_chapters()[:chapters] for side in ("grade", "answer")]


def selection(labels: list[str], without: Collection[str] = ()) -> list[str]:
    """Returns ctest's arguments for tests with one of the labels, without those of these names."""
    chosen = ["-L", f"^({'|'.join(map(re.escape, labels))})$"]
    return [*chosen, "-E", f"^({'|'.join(map(re.escape, without))})$"] if without else chosen


def names(tree: Tree, chosen: list[str] | None = None) -> list[str]:
    """Returns the names of the tests that ctest would run."""
    listing = subprocess.run(["ctest", "--test-dir", str(tree.path), "-N", *(chosen or [])],
                             capture_output=True, text=True).stdout
    return _NAME.findall(listing)


def left_out(every: list[str], run: list[str], unchanged: Collection[str] = ()) -> str:
    """Returns a line such as `Left out: 14 mutant.* (nothing changed), 31 plot.*, tools.slurm, ...`"""
    there = set(run)
    rest = [name for name in every if name not in there]
    said = []
    kinds = {"mutant.": " (nothing changed)", "hidden.": " (likewise)", "plot.": "", "seeds.": ""}
    for kind, why in kinds.items():
        count = sum(name.startswith(kind) for name in rest)
        said += [f"{count} {kind}*{why}"] if count else []
    said += [f"{name} (nothing changed)" for name in rest if name in unchanged]
    said += [name for name in rest if not name.startswith(tuple(kinds)) and name not in unchanged]
    return f"Left out: {', '.join([*said, 'all tests under sanitizers'])}. ./course test --all runs them."


def _install_if_offered(needs: tuple[Need, ...], what: str, yes: bool) -> None:
    """Installs a package if the system offers it; otherwise its tests report that they are skipped."""
    if not all(need.there() or is_offered(need.package) for need in needs):
        return
    try:
        install(needs, yes)
    except CourseError as error:
        print(f"No {what}: {error}")


def _build(tree: Tree, targets: list[str], strict: bool) -> None:
    print(f"Building {shown(tree.path)}.", flush=True)
    if strict and not _is_strict(tree):
        tree.configure("-DSPOOK_WERROR=ON")
    built = tree.build(targets, f"building {tree.preset}")
    if not built.ok:
        raise tree.own_failure(built)


def _run(tree: Tree, chosen: list[str] | None = None) -> Outcome:
    """Prints ctest's output as it comes."""
    print(f"\nTesting {shown(tree.path)}.", flush=True)
    command = ["ctest", "--test-dir", str(tree.path), "--output-on-failure", "--no-tests=error",
               "-j", str(jobs()), *(chosen or [])]
    log = tree.path / "course-test.log"
    code, output = stream(command, lambda line: print(line, end="", flush=True), log)
    lines = output.splitlines()
    closing = next((k for k, line in enumerate(lines) if _TOTAL.match(line)), len(lines))
    total = int(_TOTAL.match(lines[closing])[2]) if closing < len(lines) else 0
    failed = [f"{found[1]} ({found[2]})" for line in lines[closing:] if (found := _FAILED.match(line))]
    return Outcome(tree.preset, total, failed, _skipped(tree.path / "Testing/Temporary/LastTest.log"), code == 0)


def _skipped(log: Path) -> list[str]:
    """Returns each reason for skipped tests once, in the tests' words."""
    try:
        text = log.read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return []
    return list(dict.fromkeys(reason for _, reason in _SKIPPED.findall(text)))


def _report(outcomes: list[Outcome]) -> int:
    print()
    for outcome in outcomes:
        passed = outcome.total - len(outcome.failed)
        print(f"{outcome.preset + ':':<10} {passed} of {outcome.total} tests passed")
        for name in outcome.failed:
            print(f"  {paint('failed', 'red')} {name}")
        for reason in outcome.skipped:
            print(f"  skipped: {reason}")
    return 0 if all(outcome.ok for outcome in outcomes) else 1
