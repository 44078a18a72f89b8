"""What one may choose when grading: in a file of its own, since every command reads the options of all."""

from paths import ROOT

ISOLATIONS = ("bubblewrap and a uid", "bubblewrap", "uid", "limits")
RULES = ("exercises", "tests")  # what counts: an exercise that is right, or each test
ATTEMPTS = ("last", "first", "best")  # of several on a platform, the one that counts
TABLE = ROOT / "tests" / "weights.csv"
