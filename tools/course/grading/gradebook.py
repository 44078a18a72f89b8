"""The class: grades.csv, tests.csv, summary.md and its histogram, all from the results of the submissions."""

import csv
import statistics
from pathlib import Path

from grading.judge import VERDICTS
from grading.results import tampered
from grading.text import markdown, one_line


def write_gradebook(folder: Path, results: list[dict]) -> None:
    results = sorted(results, key=lambda result: result["submission"])
    _write_grades(folder / "grades.csv", results)
    counts = _count_tests(results)
    _write_tests(folder / "tests.csv", counts)
    figure = _draw(folder / "histogram.png", results)
    (folder / "summary.md").write_text(_summary(results, counts, figure), encoding="utf-8")


def statistics_line(results: list[dict]) -> str:
    shares = _percents(results)
    return (f"{len(results)} submission{'s' if len(results) != 1 else ''}: median {statistics.median(shares):.0f} %, "
            f"mean {statistics.fmean(shares):.0f} %, from {min(shares):.0f} to {max(shares):.0f} %")


def _percents(results: list[dict]) -> list[float]:
    return [100 * result["score"] / result["max_score"] if result["max_score"] else 0.0 for result in results]


def _write_grades(file: Path, results: list[dict]) -> None:
    chapters = sorted({exercise["chapter"] for result in results for exercise in result["exercises"]})
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(["submission", "score", "max_score", "percent", "done", "wrong", "not started", *chapters,
                         "look"])
        for result, percent in zip(results, _percents(results)):
            states = [exercise["state"] for exercise in result["exercises"]]
            scores = [sum(exercise["score"] for exercise in result["exercises"] if exercise["chapter"] == chapter)
                      for chapter in chapters]
            look = "; ".join((["tampered"] if tampered(result) else []) + result["notes"])
            writer.writerow([cell(result["submission"]), f"{result['score']:g}", f"{result['max_score']:g}",
                             f"{percent:.2f}", *(states.count(state) for state in ("done", "wrong", "not started")),
                             *(f"{score:g}" for score in scores), cell(look)])


def cell(text: str) -> str:
    """A spreadsheet takes a cell that begins like a formula for one."""
    text = one_line(text)
    return "'" + text if text[:1] in ("=", "+", "-", "@") else text


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
    """Whether there is a figure: without matplotlib there is none, and the marks are the same."""
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


def _summary(results: list[dict], counts: dict[str, dict[str, int]], figure: bool) -> str:
    settings = results[0]
    lines = ["# The class\n", statistics_line(results) + ".\n",
             f"Seed {settings['seed']}; {settings['seconds_a_test']} s of processor time a test; isolation: "
             f"{', '.join(sorted({result['isolation'] for result in results}))}.\n"]
    if figure:
        lines.append("![Histogram of the points](histogram.png)\n")
    looks = [(result["submission"], ["**tampered**"] * tampered(result) + [markdown(note) for note in result["notes"]])
             for result in results]
    looks = [(name, notes) for name, notes in looks if notes]
    if looks:
        lines.append("## To look at\n")
        lines += [f"- {markdown(name)}: {'; '.join(notes)}" for name, notes in looks] + [""]
    shown = [verdict for verdict in VERDICTS if any(verdicts[verdict] for verdicts in counts.values())]
    lines += ["## Each test\n", "| test | " + " | ".join(shown) + " |", "|---|" + "---|" * len(shown)]
    for test, verdicts in counts.items():
        lines.append(f"| {test} | " + " | ".join(str(verdicts[verdict]) for verdict in shown) + " |")
    return "\n".join(lines) + "\n"
