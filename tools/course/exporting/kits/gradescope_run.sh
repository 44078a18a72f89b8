#!/usr/bin/env bash
# Runs for each submission. Results are written after every exercise: what is known when the time is up is not lost.
set -uo pipefail
root=${AUTOGRADER_ROOT:-/autograder}
chmod -R go-rwx "$root/source" "$root/submission"
exec "$root/source/course/course" grade "$root/submission" --jobs 1 --out "$root/results/course" \
  --gradescope "$root/results/results.json" @OPTIONS@
