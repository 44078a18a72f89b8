"""The choices of the grading options. Every command parses the options of all, so this file imports little."""

from paths import ROOT

ISOLATIONS = ("bubblewrap and a uid", "bubblewrap", "uid", "limits")
RULES = ("exercises", "tests")  # what counts: an exercise that is right, or each test
ATTEMPTS = ("last", "first", "best")  # of several on a platform, the one that counts
TABLE = ROOT / "tests" / "weights.csv"
