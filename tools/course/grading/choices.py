"""The choices of the grading options. Every command parses the options of all, so this file imports little."""

from paths import ROOT

ISOLATIONS = ("bubblewrap and a uid", "bubblewrap", "uid", "limits")
RULES = ("exercises", "tests", "equal")  # what counts: a right exercise, each test, or right exercises alike
ON_TIME = "on-time"
ATTEMPTS = ("last", "first", "best", ON_TIME)  # of several on a platform, the one that counts
TABLE = ROOT / "tests" / "weights.csv"
