"""Keeps in git what an update changed, so that it can be undone: a commit that one ref leads to."""

import json
from dataclasses import dataclass

from errors import CourseError
from updating import trees
from updating.git import asked, git, somebody
from updating.trees import Tree

_REF = "refs/worktree/course/update"
_UNDONE = "refs/worktree/course/undone"  # keeps git from clearing it away
_TREES = ("files_before", "files_after", "index_before", "index_after")


@dataclass(frozen=True)
class Record:
    branch: str  # refs/heads/main; empty: a commit was checked out
    commit_before: str
    commit_after: str
    release_before: str
    release_after: str
    files_before: Tree  # of all that was touched
    files_after: Tree
    index_before: Tree
    index_after: Tree


def keep(record: Record) -> None:
    facts = {name: value for name, value in vars(record).items() if name not in _TREES}
    parts = "".join(f"040000 tree {trees.write(getattr(record, name))}\t{name}\n" for name in _TREES)
    tree = git("mktree", given=parts.encode())
    commit = git("commit-tree", tree, "-p", record.commit_before, "-p", record.commit_after,
                 given=json.dumps(facts).encode(), more=somebody())
    git("update-ref", _REF, commit)


def is_half_way() -> bool:
    """Returns True if an update changed files and then did not move the branch."""
    return bool(_facts()) and _facts()["commit_before"] == git("rev-parse", "HEAD")


def last() -> Record:
    if not (facts := _facts()):
        raise CourseError("there is no update to undo")
    return Record(**facts, **{name: trees.read(f"{_REF}:{name}") for name in _TREES})


def forget() -> None:
    """Drops the record of an update that did not begin."""
    git("update-ref", "-d", _REF)


def close() -> None:
    git("update-ref", _UNDONE, _REF)
    git("update-ref", "-d", _REF)


def _facts() -> dict[str, str]:
    """Reads the record's message; empty if there is no update to undo."""
    return json.loads(asked("show", "--no-patch", "--format=%B", _REF) or "{}")
