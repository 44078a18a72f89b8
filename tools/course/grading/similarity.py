"""Finds works in a class that have more in common than chance explains, and copies of the reference.

For each work the fingerprints count that are in no stub and not in the reference. Rare ones count more: the logarithm
of the class size over the number of works that have them. Works that have most of their fingerprints in common are one
group. For rarity it counts as one work, so that a fingerprint of many copies is as rare as that of two.

The sum over all exercises is the likeness of a pair. A pair is shown when its likeness stands out: above the median of
all pairs by six times their spread (from the median up to 84 % of the pairs), and worth at least five fingerprints that
nobody else has. For median and spread two groups count as one pair, with the mean of theirs. A small class has no usual likeness, so a pair
is also shown when it shares more than 60 per cent of its rare fingerprints, or of many that at most half of the class
has. (Works written independently shared 12 to 44 per cent of their rare ones.) What most of a class has makes a group
only of works that are nearly equal, and what nearly all have makes none. The result is a reason to read, and proves
nothing.
"""

import itertools
import math
from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field

from grading.fingerprints import K, Token, fingerprints, tokens_of

_SPREADS, _ALONE = 6, 5
_OF_REFERENCE = 0.85  # share of a work's fingerprints
_ENOUGH = 12  # fingerprints, of a work that is compared by shares
MOST_ALONE = 0.6  # share of them that two works have in common
_MANY = 24  # fingerprints, of a work that may belong to a group
_NEARLY_EQUAL = 0.9  # share of the fingerprints of two works that both have
_NEARLY_ALL = 0.9  # share of the works
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
    references, own = [], {}
    for exercise, of in read.items():
        stub, reference = (Work(text) for text in given[exercise])
        references += _references(exercise, of, stub, reference)
        known = stub.prints.keys() | reference.prints.keys()
        own[exercise] = _Own({name: set(work.prints.keys() - known) for name, work in of.items()})
    in_all = _alike({(exercise, name): sets for exercise, one in own.items() for name, sets in one.compared().items()})
    likeness: Counter = Counter()
    parts: Counter = Counter()  # by pair and exercise
    shared: dict[tuple[str, str], dict[str, set[int]]] = defaultdict(dict)
    rare: Counter = Counter()  # how many fingerprints of somebody few others have
    one_group = set(in_all)
    for exercise, one in own.items():
        alike = in_all | _alike({(exercise, name): sets for name, sets in one.compared().items()})
        group = _groups(one.prints, alike)
        one_group |= _pairs_in(group)
        count = len(set(group.values()))
        for print_, names in one.rare(group).items():
            rare.update(names)
            worth = _worth(count, len({group[name] for name in names}))
            for pair in itertools.combinations(sorted(names), 2):
                likeness[pair] += worth
                parts[pair, exercise] += worth
                shared[pair].setdefault(exercise, set()).add(print_)
    people = {name for of in read.values() for name in of}
    threshold = _threshold(likeness, _groups(people, one_group))
    pairs = [Pair(*pair, value, {exercise: prints for exercise, prints in shared[pair].items()
                                 if parts[pair, exercise] >= _WORTH_SHOWING * value})
             for pair, value in likeness.most_common()
             if value > threshold or pair in in_all
             or _mostly_one(shared[pair], min(rare[name] for name in pair))][:_MOST_SHOWN]
    return Similarity(pairs, threshold, references, read)


class _Own:
    """The fingerprints of each work in an exercise that are in no stub and not in the reference."""

    def __init__(self, prints: dict[str, set[int]]):
        self.prints = prints
        self._having: dict[int, list[str]] = defaultdict(list)
        for name, some in prints.items():
            for one in some:
                self._having[one].append(name)
        self._written = sum(map(bool, prints.values()))

    def compared(self) -> dict[str, tuple[set[int], set[int]]]:
        """Returns of each work the fingerprints that at most half of the works have, and those that not nearly all
        have."""
        few = {one for one, names in self._having.items() if len(names) <= max(2, self._written / 2)}
        nearly_all = {one for one in self._having if self._is_of_nearly_all(one)}
        return {name: (some & few, some - nearly_all) for name, some in self.prints.items()}

    def rare(self, group: dict[str, int]) -> dict[int, list[str]]:
        """Returns the fingerprints that at most a quarter of the groups have, or two, with their works."""
        most = max(2, len(set(group.values())) / 4)
        return {one: names for one, names in self._having.items()
                if len({group[name] for name in names}) <= most and not self._is_of_nearly_all(one)}

    def _is_of_nearly_all(self, one: int) -> bool:
        return len(self._having[one]) > max(2, _NEARLY_ALL * self._written)


def _worth(groups: int, having: int) -> float:
    """Returns what a fingerprint counts that `having` of the groups have; one group counts as two works that share
    it."""
    return math.log(groups / max(2, having)) if groups > 2 else 1.0


def _alike(sets: dict[tuple[str, str], tuple[set[int], set[int]]]) -> set[tuple[str, str]]:
    """Returns the pairs that have most of their fingerprints in common. `sets` are those of `compared`, by exercise and
    work."""
    few: dict[str, set[tuple[str, int]]] = defaultdict(set)
    more: dict[str, set[tuple[str, int]]] = defaultdict(set)
    for (exercise, name), (of_few, of_more) in sets.items():
        few[name] |= {(exercise, one) for one in of_few}
        more[name] |= {(exercise, one) for one in of_more}
    found = set()
    for first, second in itertools.combinations(sorted(name for name, some in more.items() if len(some) >= _MANY), 2):
        least = min(len(few[first]), len(few[second]))
        both = len(more[first] & more[second])
        if (least >= _MANY and len(few[first] & few[second]) > MOST_ALONE * least
                or both >= max(_MANY, _NEARLY_EQUAL * (len(more[first]) + len(more[second]) - both))):
            found.add((first, second))
    return found


def _groups(names: Iterable[str], alike: set[tuple[str, str]]) -> dict[str, int]:
    """Returns the number of each work's group. A work joins a group if it is like more than half of its works."""
    like: dict[str, set[str]] = defaultdict(set)
    for first, second in alike:
        like[first].add(second)
        like[second].add(first)
    groups: list[list[str]] = []
    for name in sorted(names, key=lambda name: (-len(like[name]), name)):
        joined = next((group for group in groups if 2 * len(like[name].intersection(group)) > len(group)), None)
        if joined is None:
            groups.append([name])
        else:
            joined.append(name)
    return {name: number for number, group in enumerate(groups) for name in group}


def _pairs_in(group: dict[str, int]) -> set[tuple[str, str]]:
    members: dict[int, list[str]] = defaultdict(list)
    for name in sorted(group):
        members[group[name]].append(name)
    return {pair for names in members.values() for pair in itertools.combinations(names, 2)}


def _mostly_one(shared: dict[str, set[int]], own: int) -> bool:
    return own >= _ENOUGH and sum(map(len, shared.values())) > MOST_ALONE * own


def _threshold(likeness: Counter, group: dict[str, int]) -> float:
    """Returns the threshold, from the mean likeness of any two groups. Most may have nothing in common."""
    size, sums = Counter(group.values()), Counter()
    for (first, second), value in likeness.items():
        if group[first] != group[second]:
            sums[frozenset((group[first], group[second]))] += value
    people, count = len(group), math.comb(len(size), 2)
    values = sorted(total / math.prod(size[one] for one in two) for two, total in sums.items())

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
