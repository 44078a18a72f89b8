"""./course update: installs another release of the course, and keeps everything that the student has written."""

from dataclasses import dataclass

from errors import BadInput, CourseError
from updating import record, releases, repository, told, trees
from updating.apply import apply
from updating.exercises import homes, pairs
from updating.git import asked, git, holds, somebody
from updating.plan import Plan, merged, plan
from updating.record import Record
from updating.releases import Source
from updating.trees import Tree
from version import stated_in

_UNDO = "./course update --undo"


def update(arguments) -> int:
    if arguments.undo:
        if arguments.release or arguments.from_:
            raise BadInput(f"update: --undo takes no {_given(arguments)}; leave it out")
        return _undo(arguments.dry_run)
    return _update(arguments)


def _given(arguments) -> str:
    return f"release {arguments.release!r}" if arguments.release else f"--from {arguments.from_!r}"


def _update(arguments) -> int:
    releases.check(arguments.release)
    if not repository.has_history():
        if not arguments.from_ or arguments.dry_run:
            raise repository.refuse_without_history()
        place = releases.source(arguments.from_)
        repository.adopt(place)
    repository.refuse_what_is_begun()
    if record.is_half_way():
        raise CourseError(f"the last update stopped half-way; first  {_UNDO}")
    place = releases.source(arguments.from_)
    versions = releases.offered(place)
    version = releases.chosen(arguments.release, versions, place)
    now = stated_in(asked("show", "HEAD:CMakeLists.txt"))
    target = releases.fetch(version, place)
    base = _base(target, now, place, versions)
    if base == target or now and releases.order(version) < releases.order(now):
        print(f"The course is {now} already" + (f", and {version} is no newer." if version != now else "."))
        return 0
    step = _Step(now, version, base, target)
    step.say(place, arguments.dry_run)
    if arguments.dry_run:
        print("Nothing was changed: this was a dry run.")
    else:
        step.take()
        print(f"CHANGELOG.md has what is new. To go back:  {_UNDO}")
    return 0


def _base(target: str, now: str, place: Source, versions: list[str]) -> str:
    """Finds the commit that both the student's work and the release come from."""
    base = asked("merge-base", "HEAD", target)
    if not base and asked("rev-parse", "--is-shallow-repository") == "true":
        asked("fetch", "--unshallow", "--no-tags", "--quiet", "--", place.place)
        base = asked("merge-base", "HEAD", target)
    if base:
        return base
    # A copy that began with one commit of its own, such as one made from a template.
    if now not in versions:
        raise CourseError(f"this course's history and that of {place} have no commit in common, and {place} has no "
                          f"release {now or 'of this version'} to compare with (nothing was changed)")
    return releases.fetch(now, place, f"fetching {now} to compare with")


@dataclass
class _Step:
    """Takes the course from one release to the next."""
    before: str
    after: str
    base: str  # commits
    target: str

    def __post_init__(self):
        self._base, self._target = trees.read(self.base), trees.read(self.target)
        self._pairs = pairs(self._base, self._target)
        self._homes = homes(self._pairs)
        self._plan = plan(self._base, self._target, self._homes)

    def say(self, place: Source, dry: bool) -> None:
        print(f"The course {'would go' if dry else 'goes'} from {self.before} to {self.after}, by {place}.\n"
              f"{told.files(self._plan)}", flush=True)
        for line in told.yours(self._plan, self._pairs, self._base, self._target, self._homes, dry):
            print(line)

    def take(self) -> None:
        head = git("rev-parse", "HEAD")
        index = trees.read(git("write-tree"))
        new_index = merged(self._base, self._target, index, self._homes)
        commit = self._commit(head)
        students = _students(self._plan)
        trees.on_disk(students, store=True)
        before = self._plan.before | trees.on_disk(students, store=True, exact=True)
        record.keep(Record(
            branch=asked("symbolic-ref", "-q", "HEAD"), commit_before=head, commit_after=commit,
            release_before=self.before, release_after=self.after,
            files_before={path: before[path] for path in self._plan.touched() if path in before},
            files_after=self._plan.after(), index_before=index, index_after=new_index))
        if saved := self._plan.saved_since():
            record.forget()
            raise CourseError(f"{saved[0]} was saved during the update; update again (nothing was changed)")
        apply(self._plan, f"It is undone by  {_UNDO}")
        _set(commit, new_index, f"course update: {self.after}")

    def _commit(self, head: str) -> str:
        """Returns the release's commit if the student has committed nothing; else makes one that follows both."""
        if holds("merge-base", "--is-ancestor", head, self.target):
            return self.target
        tree = trees.write(merged(self._base, self._target, trees.read(head), self._homes))
        return git("commit-tree", tree, "-p", head, "-p", self.target,
                   given=f"Update the course to {self.after}\n".encode(), more=somebody())


def _students(made: Plan) -> set[str]:
    """Lists the files that only the student may have a copy of."""
    return {*made.aside, *made.moves} | {path for path in made.removals | set(made.writes) if path in made.before}


def _set(commit: str, index: Tree, why: str) -> None:
    """Moves the branch, or the commit that is checked out, and git's index."""
    git("read-tree", trees.write(index))
    git("update-ref", "-m", why, "HEAD", commit)
    asked("update-index", "-q", "--refresh")  # it says which files the student has changed, and that is fine


def _undo(dry: bool) -> int:
    if not repository.has_history():
        raise CourseError("there is no update to undo: this folder has no history in git")
    repository.refuse_what_is_begun()
    done = record.last()
    branch, head = asked("symbolic-ref", "-q", "HEAD"), git("rev-parse", "HEAD")
    if branch != done.branch or head not in (done.commit_before, done.commit_after):
        raise CourseError(f"the update to {done.release_after} cannot be undone: there are commits since, or another "
                          f"branch is checked out. With git, go back to {done.commit_before[:12]}, the commit before "
                          f"it (nothing was changed)")
    back = {new: old for old, new in homes(pairs(trees.read(done.commit_before), trees.read(done.commit_after))).items()
            if new}
    made = plan(done.files_after, done.files_before, {path: back[path] for path in back if path in done.files_after})
    print(f"The course {'would go' if dry else 'goes'} back from {done.release_after} to {done.release_before}.\n"
          f"{told.files(made)}", flush=True)
    for old, new in made.aside.items():
        print(f"{old}: you have changed it since; yours {'would be' if dry else 'is'} kept as {new}")
    if dry:
        return 0
    if saved := made.saved_since():
        raise CourseError(f"{saved[0]} was saved at this moment; undo again (nothing was changed)")
    apply(made, f"Begin again with  {_UNDO}")
    index = trees.read(git("write-tree"))
    _set(done.commit_before, merged(done.index_after, done.index_before, index, back), "course update: undone")
    record.close()
    return 0
