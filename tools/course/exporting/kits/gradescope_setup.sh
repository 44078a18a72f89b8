#!/usr/bin/env bash
# Runs once, when Gradescope makes the image: installs what the grader needs, builds the tests, and tries the reference.
set -euo pipefail
root=${AUTOGRADER_ROOT:-/autograder}
# Where there are no namespaces a submission runs as a user of its own, and must not read the answers.
chmod -R go-rwx "$root/source"
"$root/source/course/course" grade --prepare --yes @OPTIONS@
