"""Says what an update changes."""

import re
from collections.abc import Iterable

from paths import ROOT
from terminal import fold, paint
from updating import trees
from updating.exercises import Homes, Pair, in_place_of
from updating.plan import Plan
from updating.trees import Tree


def files(plan: Plan) -> str:
    """Counts the course's files: `12 changed, 3 new, 1 removed`."""
    new = sum(path not in plan.before or path in plan.aside for path in plan.writes)
    parts = [(len(plan.writes) - new, "changed"), (new, "new"), (len(plan.removals), "removed")]
    counts = ", ".join(f"{count} {what}" for count, what in parts if count)
    return f"Files of the course: {counts or 'none changes'}."


def yours(plan: Plan, paired: dict[str, Pair], base: Tree, target: Tree, homes: Homes, dry: bool) -> list[str]:
    """Lists what happens to the student's files, most important first."""
    lines = []
    answers = [path for path in (*plan.kept, *plan.moves) if path in homes]
    stay = [pair.old.label for pair in sorted((paired[path] for path in plan.kept), key=_in_order)]
    if stay:
        lines += [fold(f"Your files stay as they are: {', '.join(stay)}.")]
    lines += _moved(plan, dry)
    lines += [f"{path} includes {folder}/, which is {new} now: change that line."
              for path, folder, new in _old_includes(plan, homes)]
    lines += [_gone(paired[path], path, target) for path in plan.kept if homes[path] is None]
    lines += [f"{old}: you and the release have changed it; yours {'would be' if dry else 'is'} kept as {new}"
              for old, new in plan.aside.items()]
    changed = [(paired[path], what) for path in sorted(answers, key=lambda path: _in_order(paired[path])) if homes[path]
               and (what := _changes(paired[path], path, homes[path], base, target))]
    if changed:
        lines += ["What is new about exercises that you have begun; check them again:"]
        lines += [f"  {paint(pair.new.label, 'bold')}: {'; '.join(what)}" for pair, what in changed]
    renewed = [pair.new.id for pair, what in changed if "stub" in what]
    if renewed:
        lines += [f"A new stub comes by ./course reset {renewed[0]}, which keeps your file beside it."]
    return lines


def _in_order(pair: Pair) -> tuple[int, int]:
    return pair.old.chapter, pair.old.number


def _moved(plan: Plan, dry: bool) -> list[str]:
    return [f"{old} {'would move' if dry else 'has moved'} to {new}" for old, new in plan.moves.items()]


def _old_includes(plan: Plan, homes: Homes) -> Iterable[tuple[str, str, str]]:
    """Finds moved answers that include a header by its folder's old name."""
    folders = {old.split("/")[1]: new.split("/")[1] for old, new in homes.items() if new}
    for old, new in plan.moves.items():
        text = (ROOT / old).read_text(encoding="utf-8", errors="replace") if old in homes else ""
        for folder in re.findall(r'^#include "([^"/]+)/', text, re.MULTILINE):
            if folders.get(folder, folder) != folder:
                yield new, folder, folders[folder]


def _gone(pair: Pair, path: str, target: Tree) -> str:
    instead = in_place_of(pair, target)
    now = f"; {instead.id} is {instead.function} now" if instead else ""
    return f"{pair.old.label} is no longer an exercise{now}. Your file stays: {path}"


def _changes(pair: Pair, old: str, new: str, base: Tree, target: Tree) -> list[str]:
    """Lists what the release has changed about an exercise, file by file."""
    before, after = pair.old.folder, pair.new.folder
    headers = (_differing(base, target, f"chapters/{before}/", f"chapters/{after}/", ".hpp")
               + _differing(base, target, "chapters/common/", "chapters/common/", ".hpp"))
    tests = [name for name in _differing(base, target, f"tests/{before}/", f"tests/{after}/", ".cpp")
             if _tests(pair, base.get(f"tests/{before}/{name}"), target.get(f"tests/{after}/{name}"))]
    tests += _differing(base, target, f"tests/{before}/", f"tests/{after}/", ".hpp")
    stub = ["stub"] if base.get(old) != target.get(new) else []
    files = [f"{what} {', '.join(names)}" for what, names in (("header", headers), ("tests", tests)) if names]
    return files + stub


def _differing(base: Tree, target: Tree, before: str, after: str, ending: str) -> list[str]:
    """Lists the names of files that differ between both folders."""
    old = {path.removeprefix(before): entry.blob for path, entry in base.items()
           if path.startswith(before) and path.endswith(ending)}
    new = {path.removeprefix(after): entry.blob for path, entry in target.items()
           if path.startswith(after) and path.endswith(ending)}
    return sorted(name for name in old.keys() | new.keys() if old.get(name) != new.get(name))


def _tests(pair: Pair, *entries: trees.Entry | None) -> bool:
    """Returns True if a file of tests, before or after, names the exercise's suite."""
    return any(entry and re.search(rf"\b{pair.old.suite}\b", trees.text(entry)) for entry in entries)
