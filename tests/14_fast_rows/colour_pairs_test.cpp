// Colours: pairs of one colour share no dynamic body.
#include <map>
#include <set>

#include "14_fast_rows/fast_rows.hpp"
#include "exercise_test.hpp"
#include "packs.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ColourPairs, "14.3 colour_pairs");

std::vector<Pair> random_pairs(Random& random, int bodies, int count) {
  std::vector<Pair> pairs;
  for (int k = 0; k < count; ++k) {
    const int i = random.integer(0, bodies - 1), j = (i + random.integer(1, bodies - 1)) % bodies;
    pairs.emplace_back(random.integer(0, 4) == 0 ? -1 : i, j);
  }
  return pairs;
}

/// Δ: the largest number of pairs of any body.
int most_on_a_body(const std::vector<Pair>& pairs) {
  std::map<int, int> on;
  int most = 0;
  for (const Pair& pair : pairs)
    for (const int body : {pair.first, pair.second})
      if (body >= 0) most = std::max(most, ++on[body]);
  return most;
}

void expect_colours(const std::string& what, const std::vector<Pair>& pairs, std::size_t bodies,
                    const std::vector<int>& expected, const std::string& clue) {
  const std::vector<int> got = colour_pairs(pairs, bodies);
  std::string list;
  for (const int colour : got) list += " " + std::to_string(colour);
  expect_true(what + ", here" + list, "Eq. (14.7)", got == expected, clue);
}

EXERCISE_TEST(ColourPairs, NoTwoOfAColourShareABody) {
  Random random;
  Regions regions({"up to 8 pairs on a body", "more than 64 pairs on a body", "more than 256 pairs on a body"});
  while (regions.lack_draws()) {
    // Few bodies with many pairs: a table that carries hundreds of bodies.
    const int bodies = random.integer(2, 12);
    const std::vector<Pair> pairs = random_pairs(random, bodies, static_cast<int>(random.log_uniform(1, 1500)));
    const int most = most_on_a_body(pairs);
    regions.draw({{"up to 8 pairs on a body", most <= 8},
                  {"more than 64 pairs on a body", most > 64},
                  {"more than 256 pairs on a body", most > 256}});
    const std::vector<int> colour = colour_pairs(pairs, static_cast<std::size_t>(bodies));
    expect_true(
        std::to_string(pairs.size()) + " pairs have one colour each, and not " + std::to_string(colour.size()),
        "Eq. (14.7)", colour.size() == pairs.size(), "Return one for each, in the order of the pairs.");
    if (colour.size() != pairs.size()) return;
    const std::string any_number =
        most > 64
            ? " Here a body is in " + std::to_string(most) +
                  " pairs: is there a mask of 64 bits, or a list that is too short? Any number is possible."
            : "";
    std::set<std::pair<int, int>> seen;  // colour and body
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      expect_at_least("colour of pair " + std::to_string(k), "Eq. (14.7)", colour[k], 0,
                      "colours are 0, 1, 2 ...");
      for (const int body : {pairs[k].first, pairs[k].second})
        if (body >= 0)
          expect_true("colour " + std::to_string(colour[k]) + " has body " + std::to_string(body) + " once",
                      "Eq. (14.7)", seen.insert({colour[k], body}).second,
                      "Two pairs of one colour share a body: both would write its velocity." + any_number);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

EXERCISE_TEST(ColourPairs, TakesTheSmallestThatIsFree) {
  expect_colours("a chain of four links has colours 0 1 0 1", {{0, 1}, {1, 2}, {2, 3}, {3, 4}}, 5, {0, 1, 0, 1},
                 "Two colours suffice: the third link shares no body with the first.");
  expect_colours("three around one body, then a separate one: 0 1 2 0", {{0, 1}, {0, 2}, {0, 3}, {4, 5}}, 6,
                 {0, 1, 2, 0}, "A pair that shares no body begins at 0 again.");
  expect_colours("a gap is filled: 0 1 1 0 2", {{0, 1}, {1, 2}, {0, 3}, {2, 3}, {1, 3}}, 4, {0, 1, 1, 0, 2},
                 "Take the smallest number that neither body has, not one more than the largest.");
}

EXERCISE_TEST(ColourPairs, TheFloorDoesNotCount) {
  expect_colours("four bodies on the floor have colours 0 0 0 0", {{-1, 0}, {-1, 1}, {2, -1}, {-1, 3}}, 4,
                 {0, 0, 0, 0},
                 "-1 is static: no update writes its velocity, and it may be in all pairs of a colour.");
  expect_colours("a stack on one of them: 0 1 0", {{-1, 0}, {0, 1}, {-1, 1}}, 2, {0, 1, 0},
                 "The second shares body 0 with the first, and the third body 1 with the second.");
}

EXERCISE_TEST(ColourPairs, NeedsFewerColoursThanTwiceTheMostOnABody) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const int bodies = random.integer(2, 12);
    const std::vector<Pair> pairs = random_pairs(random, bodies, random.integer(1, 60));
    int largest = 0;
    for (const int colour : colour_pairs(pairs, static_cast<std::size_t>(bodies)))
      largest = std::max(largest, colour);
    const int most = most_on_a_body(pairs);
    expect_at_most("number of colours of " + std::to_string(pairs.size()) + " pairs, at most " +
                       std::to_string(most) + " on a body",
                   "Eq. (14.8)", largest + 1, 2 * most - 1, "2 Δ - 1",
                   "When a pair gets its colour, each of its bodies has been in at most Δ - 1 others.");
  }
}

EXERCISE_TEST(ColourPairs, MayNeedAsManyAsTheBound) {
  // Body 0 has colours 0 and 1, body 1 has 2 and 3, and then they meet. Δ = 3, with five colours.
  const std::vector<Pair> pairs = {{0, 2}, {0, 3}, {4, 5},  {4, 6}, {1, 4},
                                   {7, 8}, {7, 9}, {7, 10}, {1, 7}, {0, 1}};
  const std::vector<int> expected = {0, 1, 0, 1, 2, 0, 1, 2, 3, 4};
  expect_colours("an unlucky order of ten pairs takes five colours: 0 1 0 1 2 0 1 2 3 4", pairs, 11, expected,
                 "Greedy means that a pair keeps its colour.");
}

EXERCISE_TEST(ColourPairs, HasNothingToDoWithoutPairs) {
  expect_true("no pairs have no colours", "Eq. (14.7)", colour_pairs({}, 3).empty());
}

EXERCISE_TEST(ColourPairs, SweepsAreTheSameInAnyOrderWithinAColour) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    const Heap heap(random, 12, 30);
    std::vector<Pair> pairs;
    for (const Row<6>& row : heap.rows) pairs.emplace_back(row.i == 0 ? -1 : row.i, row.j == 0 ? -1 : row.j);
    const std::vector<int> colour = colour_pairs(pairs, heap.V.size());
    expect_true("each row has a colour", "Eq. (14.7)", colour.size() == pairs.size());
    if (colour.size() != pairs.size()) return;
    std::vector<int> forth, back;
    for (int c = 0; c < static_cast<int>(pairs.size()); ++c)
      for (int k = 0; k < std::ssize(colour); ++k)
        if (colour[k] == c) forth.push_back(k);
    for (int c = 0; c < static_cast<int>(pairs.size()); ++c)
      for (int k = static_cast<int>(colour.size()) - 1; k >= 0; --k)
        if (colour[k] == c) back.push_back(k);
    Heap one = heap, other = heap;
    for (int n = 0; n < 5; ++n) {
      sweep_in_order(forth, one.rows, one.V);
      sweep_in_order(back, other.rows, other.V);
    }
    expect_true("five sweeps, each colour forwards or backwards, give the same λ and V to the last bit",
                "Eq. (14.7)", same_bits(one, other),
                "Rows of one colour are not coupled: their order cannot matter.");
  }
}

}  // namespace
