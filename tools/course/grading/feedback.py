"""feedback.zip: the report of each student, as Moodle takes it under "Upload multiple feedback files in a zip".

Moodle finds the student by the number in the name of a folder, Name_NUMBER_assignsubmission_file_, and splits that name
at each _.
"""

import zipfile
from collections import Counter
from pathlib import Path

from grading.names import MOODLE, safe
from grading.results import folder_of

FEEDBACK = "feedback.zip"


def write_feedback(folder: Path, results: list[dict]) -> Path | None:
    """Writes the zip, if there are submissions from Moodle with a number of their own; else removes an older one."""
    file = folder / FEEDBACK
    count = Counter(result["identifier"] for result in results)
    known = [result for result in results if result.get("platform") == MOODLE and count[result["identifier"]] == 1
             and result["identifier"].isdecimal()]
    if not known:
        file.unlink(missing_ok=True)
        return None
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for result in sorted(known, key=lambda result: result["submission"]):
            report = folder_of(folder, result["submission"]) / "report.md"
            if report.exists():
                info = zipfile.ZipInfo(f"{_folder(result)}/report.md")  # with one date for all, so that equal
                info.compress_type = zipfile.ZIP_DEFLATED  # reports give an equal zip
                info.external_attr = 0o100644 << 16
                archive.writestr(info, report.read_bytes())
    return file


def _folder(result: dict) -> str:
    name = safe(result["student"]).replace("_", " ").strip() or "student"
    return f"{name}_{result['identifier']}_assignsubmission_file_"
