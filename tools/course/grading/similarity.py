"""Finds works in a class that have more in common than chance explains, and copies of the reference.

For each work the fingerprints count that are in no stub and not in the reference. Rare ones count more: the logarithm
of the class size over the number of works that have them. The sum over all exercises is the likeness of a pair. A pair
is shown when its likeness stands out: above the median of all pairs by six times their spread (from the median up to
84 % of the pairs), and worth at least five fingerprints that nobody else has. A small class has no usual likeness, so a
pair is also shown when it shares more than 60 per cent of its rare fingerprints. (Works written independently shared
12 to 44.) The result is a reason to read, and proves nothing.
"""

import itertools
import math
from collections import Counter, defaultdict
from dataclasses import dataclass, field

from grading.fingerprints import K, Token, fingerprints, tokens_of

_SPREADS, _ALONE = 6, 5
_OF_REFERENCE = 0.85  # share of a work's fingerprints
_ENOUGH = 12  # fingerprints, of a work that is compared by shares
MOST_ALONE = 0.6  # share of them that two works have in common
_MOST_SHOWN = 50
_WORTH_SHOWING = 0.1  # of a pair's likeness, for an exercise to be shown


@dataclass
class Work:
    source: str
    tokens: list[Token] = field(default_factory=list)
    prints: dict[int, int] = field(default_factory=dict)

    def __post_init__(self):
        self.tokens = tokens_of(self.source)
        self.prints = fingerprints(self.tokens)

    def spans(self, shared: set[int]) -> list[tuple[int, int]]:
        """Returns the pieces of the source with these fingerprints; adjacent ones are joined."""
        joined: list[tuple[int, int]] = []
        for at in sorted(self.prints[one] for one in shared):
            start, end = self.tokens[at].start, self.tokens[min(at + K, len(self.tokens)) - 1].end
            if joined and start <= joined[-1][1] + 1:
                joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
            else:
                joined.append((start, end))
        return joined


@dataclass
class Pair:
    first: str
    second: str
    likeness: float
    shared: dict[str, set[int]]  # fingerprints by exercise


@dataclass
class Similarity:
    pairs: list[Pair]
    threshold: float
    references: list[tuple[str, str, int]]  # who, exercise, percent of the work that is the reference's
    works: dict[str, dict[str, Work]]  # by exercise and submission


def similar(works: dict[str, dict[str, str]], given: dict[str, list[str]]) -> Similarity:
    """Finds similar pairs. `works` are sources by exercise and submission; `given` are each exercise's stub and
    reference, in this order."""
    read = {exercise: {name: Work(source) for name, source in of.items()} for exercise, of in works.items()}
    likeness: Counter = Counter()
    parts: Counter = Counter()  # by pair and exercise
    shared: dict[tuple[str, str], dict[str, set[int]]] = defaultdict(dict)
    own: Counter = Counter()  # how many fingerprints of somebody few others have
    references = []
    for exercise, of in read.items():
        stub, reference = (Work(text) for text in given[exercise])
        references += _references(exercise, of, stub, reference)
        known = stub.prints.keys() | reference.prints.keys()
        have: dict[int, list[str]] = defaultdict(list)
        for name, work in of.items():
            for one in work.prints.keys() - known:
                have[one].append(name)
        for one, names in have.items():
            if len(names) <= max(2, len(of) / 4):
                own.update(names)
                for pair in itertools.combinations(sorted(names), 2):
                    worth = math.log(len(of) / len(names)) if len(of) > 2 else 1.0
                    likeness[pair] += worth
                    parts[pair, exercise] += worth
                    shared[pair].setdefault(exercise, set()).add(one)
    people = {name for of in read.values() for name in of}
    threshold = _threshold(likeness, len(people))
    pairs = [Pair(*pair, value, {exercise: prints for exercise, prints in shared[pair].items()
                                 if parts[pair, exercise] >= _WORTH_SHOWING * value})
             for pair, value in likeness.most_common()
             if value > threshold or _mostly_one(shared[pair], min(own[name] for name in pair))][:_MOST_SHOWN]
    return Similarity(pairs, threshold, references, read)


def _mostly_one(shared: dict[str, set[int]], own: int) -> bool:
    return own >= _ENOUGH and sum(map(len, shared.values())) > MOST_ALONE * own


def _threshold(likeness: Counter, people: int) -> float:
    """Returns the threshold. Most pairs may have nothing in common, and are in no list."""
    count = max(people * (people - 1) // 2, 1)
    values = sorted(likeness.values())

    def quantile(share: float) -> float:
        at = math.ceil(share * count) - 1 - (count - len(values))
        return values[at] if at >= 0 else 0.0
    median = quantile(0.5)
    return max(median + _SPREADS * (quantile(0.84) - median), _ALONE * (math.log(people / 2) if people > 2 else 1.0))


def _references(exercise: str, of: dict[str, Work], stub: Work, reference: Work) -> list[tuple[str, str, int]]:
    """Returns works that share more with the reference than independent work is likely to."""
    found = []
    for name, work in of.items():
        own = work.prints.keys() - stub.prints.keys()
        share = len(own & reference.prints.keys()) / len(own) if own else 0.0
        if len(own) >= _ENOUGH and share >= _OF_REFERENCE:
            found.append((name, exercise, round(100 * share)))
    return found
