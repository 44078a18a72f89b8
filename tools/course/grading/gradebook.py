"""The class: grades.csv, tests.csv, summary.md and its histogram, all from the submissions' results."""

import csv
import re
import statistics
from dataclasses import dataclass, field
from pathlib import Path

from grading.feedback import write_feedback
from grading.judge import VERDICTS
from grading.report import RULE
from grading.results import tampered
from grading.roster import Roster
from grading.submission import A_GUESS, NOT_TAKEN, NOTHING_FOUND, UNREAD
from grading.text import markdown, one_line


_LONGEST = 300  # characters of a line on the terminal
_BEGINS_ONE = "=+\\-@\uff1d\uff0b\uff0d\uff20"  # the last four in their wide forms, as some spreadsheets read them
_FORMULA = re.compile(rf"""([;,]\s*["']?)([{_BEGINS_ONE}])""")


@dataclass
class Class:
    """Information about a class besides the results."""

    left_out: list[tuple[str, str]] = field(default_factory=list)  # what lay there and was not graded, and why
    roster: Roster | None = None

    def matched(self, results: list[dict]) -> tuple[list[tuple[dict[str, str], str]], list[str]]:
        """Returns the rows of students without a submission, with the reason, and submissions without a student."""
        if not self.roster:
            return [], []
        _, missing, strangers = self.roster.matched(results)
        claimed = self.roster.claimed(results)
        return [(row, "no submission is certain to be theirs" if id(row) in claimed else "nothing was handed in")
                for row in missing], strangers

    def numbers(self, results: list[dict]) -> dict[str, str]:
        """Returns the roster's number of each submission's student, by the submission's name."""
        found = self.roster.matched(results)[0] if self.roster else {}
        return {name: self.roster.number_of(row) for name, row in found.items()}


def write_gradebook(folder: Path, results: list[dict], of_class: Class) -> None:
    results = sorted(results, key=lambda result: result["submission"])
    _write_grades(folder / "grades.csv", results, of_class)
    counts = _count_tests(results)
    _write_tests(folder / "tests.csv", counts)
    figure = _draw(folder / "histogram.png", results)
    (folder / "summary.md").write_text(_summary(results, counts, figure, of_class), encoding="utf-8")
    write_feedback(folder, results)


def statistics_line(results: list[dict]) -> str:
    shares = _percents(results)
    return (f"{len(results)} submission{'s' if len(results) != 1 else ''}: median {statistics.median(shares):.0f} %, "
            f"mean {statistics.fmean(shares):.0f} %, from {min(shares):.0f} to {max(shares):.0f} %")


def not_graded(results: list[dict], of_class: Class) -> list[str]:
    """Returns a line for each student or file without a mark: nobody is lost."""
    missing, strangers = of_class.matched(results)
    why = {result["submission"]: of_class.roster.reason(result) for result in results
           if result["submission"] in strangers}
    return ([f"{one_line(what)}: {one_line(why)}" for what, why in of_class.left_out]
            + [f"{one_line(of_class.roster.name_of(row))}: on the roster, and {reason}" for row, reason in missing]
            + [f"{one_line(name)}: {one_line(why[name]) or 'graded, and not on the roster'}" for name in strangers])


def uncertain(results: list[dict]) -> list[str]:
    """Returns a line for each note about a file that was guessed, that cannot be read, or that has no exercise's name."""
    return [f"{one_line(result['submission'])}: {one_line(note)[:_LONGEST]}" for result in results
            for note in result["notes"]
            if A_GUESS in note or UNREAD in note or note.startswith((NOTHING_FOUND, NOT_TAKEN))]


def _percents(results: list[dict]) -> list[float]:
    return [100 * result["score"] / result["max_score"] if result["max_score"] else 0.0 for result in results]


def _write_grades(file: Path, results: list[dict], of_class: Class) -> None:
    chapters = sorted({exercise["chapter"] for result in results for exercise in result["exercises"]})
    exercises = [f"{exercise['id']} {exercise['function']}" for exercise in results[0]["exercises"]]
    missing, _ = of_class.matched(results)
    numbers = of_class.numbers(results)
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["submission", "score", "max_score", "percent", "done", "wrong", "not started", *chapters,
                         "student", "identifier", "late", "look", *exercises])
        for result, percent in zip(results, _percents(results)):
            states = [exercise["state"] for exercise in result["exercises"]]
            scores = [sum(exercise["score"] for exercise in result["exercises"] if exercise["chapter"] == chapter)
                      for chapter in chapters]
            look = "; ".join((["tampered"] if tampered(result) else []) + result["notes"])
            number = result["identifier"] or numbers.get(result["submission"], "")
            writer.writerow([cell(result["submission"]), f"{result['score']:g}", f"{result['max_score']:g}",
                             f"{percent:.2f}", *(states.count(state) for state in ("done", "wrong", "not started")),
                             *(f"{score:g}" for score in scores), cell(result["student"]), cell(number),
                             "late" if result["late"] else "", cell(look),
                             *(f"{exercise['score']:g}" for exercise in result["exercises"])])
        for row, reason in missing:
            name, number = of_class.roster.name_of(row), of_class.roster.number_of(row)
            writer.writerow([cell(name), "0", f"{results[0]['max_score']:g}", "0.00", 0, 0, len(exercises),
                             *("0" for _ in chapters), cell(name), cell(number), "", reason, *("0" for _ in exercises)])


def cell(text: str) -> str:
    """Protects a cell: a spreadsheet may treat its first letter as a formula, and `;` as the end of a cell."""
    text = _FORMULA.sub(r"\1'\2", one_line(text))
    return "'" + text if re.match(f"[{_BEGINS_ONE}]", text) else text


def _count_tests(results: list[dict]) -> dict[str, dict[str, int]]:
    counts: dict[str, dict[str, int]] = {}
    for result in results:
        for exercise in result["exercises"]:
            for test in exercise["tests"]:
                counts.setdefault(test["name"], dict.fromkeys(VERDICTS, 0))[test["verdict"]] += 1
    return counts


def _write_tests(file: Path, counts: dict[str, dict[str, int]]) -> None:
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["test", *VERDICTS])
        for test, verdicts in counts.items():
            writer.writerow([test, *verdicts.values()])


def _draw(file: Path, results: list[dict]) -> bool:
    """Draws the histogram. Returns false without matplotlib; the marks are the same."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        from matplotlib import pyplot
    except ImportError:
        return False
    figure, axes = pyplot.subplots(figsize=(7, 3.2))
    axes.hist(_percents(results), bins=range(0, 101, 5), color="#0072B2", edgecolor="white")
    axes.set(xlabel="points [% of all]", ylabel="submissions", xlim=(0, 100), title=statistics_line(results))
    axes.title.set_fontsize(10)
    axes.yaxis.get_major_locator().set_params(integer=True)
    axes.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(file, dpi=150, metadata={"Software": None})
    pyplot.close(figure)
    return True


def _summary(results: list[dict], counts: dict[str, dict[str, int]], figure: bool, of_class: Class) -> str:
    settings = results[0]
    lines = ["# The class\n", f"{statistics_line(results)}. {RULE[settings['points']]}\n",
             f"Seed {settings['seed']}{_of_hidden(results)}; {settings['seconds_a_test']} s of processor time a test; "
             f"isolation: {', '.join(sorted({result['isolation'] for result in results}))}.\n"]
    if figure:
        lines.append("![Histogram of the points](histogram.png)\n")
    if left_out := not_graded(results, of_class):
        lines += ["## Not graded, or not assigned to a student\n", *(f"- {markdown(line)}" for line in left_out), ""]
    looks = [(result["submission"], ["**tampered**"] * tampered(result) + [markdown(note) for note in result["notes"]])
             for result in results]
    looks = [(name, notes) for name, notes in looks if notes]
    if looks:
        lines.append("## To look at\n")
        lines += [f"- {markdown(name)}: {'; '.join(notes)}" for name, notes in looks] + [""]
    lines += _exercises(results)
    shown = [verdict for verdict in VERDICTS if any(verdicts[verdict] for verdicts in counts.values())]
    lines += ["## Each test\n", "| test | " + " | ".join(shown) + " |", "|---|" + "---|" * len(shown)]
    for test, verdicts in counts.items():
        lines.append(f"| {test} | " + " | ".join(str(verdicts[verdict]) for verdict in shown) + " |")
    return "\n".join(lines) + "\n"


def _of_hidden(results: list[dict]) -> str:
    """Names the other seed of tests that students do not see; results of before it was one have the same seed."""
    other = results[0].get("hidden_seed", results[0]["seed"])
    return f", seed of hidden tests {other}" if other != results[0]["seed"] else ""


def _exercises(results: list[dict]) -> list[str]:
    lines = ["## Each exercise\n",
             "| exercise | done | wrong | not started | points, the mean | of |", "|---|---|---|---|---|---|"]
    for k, exercise in enumerate(results[0]["exercises"]):
        all_of_it = [result["exercises"][k] for result in results]
        states = [one["state"] for one in all_of_it]
        lines.append(f"| {exercise['id']} {exercise['function']} | "
                     + " | ".join(str(states.count(state)) for state in ("done", "wrong", "not started"))
                     + f" | {statistics.fmean(one['score'] for one in all_of_it):.2f} | {exercise['max_score']:g} |")
    return lines + [""]
