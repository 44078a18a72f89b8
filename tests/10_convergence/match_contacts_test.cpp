// Matches each present contact with the last step's.
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "relative_scales.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MatchContacts, "10.1 match_contacts");

Contact contact(int i, int j, const Vec3& r_j) {
  return {.i = i, .j = j, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3(7, 7, 7), .r_j = r_j};
}

void expect_matches(const std::string& what, const std::vector<int>& got, const std::vector<int>& expected,
                    std::initializer_list<Clue<Eigen::VectorXd>> clues, const std::string& otherwise) {
  expect_true(what + ": one index for each of " + std::to_string(expected.size()) + " contacts", "Eq. (10.1)",
              got.size() == expected.size(), "-1 for those that are new.");
  if (got.size() != expected.size()) return;
  expect_near_vector(what, "Eq. (10.1)", as_eigen(got), as_eigen(expected), {0, "indices"}, clues, otherwise);
}

// The four corners of two boxes that rest on the ground.
std::vector<Contact> eight_corners() {
  std::vector<Contact> contacts;
  for (const int box : {1, 2})
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) contacts.push_back(contact(0, box, Vec3(x, y, -0.5)));
  return contacts;
}

EXERCISE_TEST(MatchContacts, FindsThemInAnyOrder) {
  Random random;
  const std::vector<Contact> contacts = eight_corners();
  const std::vector<int> place = shuffled(random, 8);
  std::vector<OldContact> old(8);
  for (std::size_t k = 0; k < 8; ++k)
    old[static_cast<std::size_t>(place[k])] = {contacts[k].i, contacts[k].j, contacts[k].r_j};
  std::vector<int> same(8), by_pair(8), among_sorted;
  std::iota(same.begin(), same.end(), 0);
  std::iota(by_pair.begin(), by_pair.end(), 0);
  const auto pair_of = [&](int k) {
    return std::pair(old[static_cast<std::size_t>(k)].i, old[static_cast<std::size_t>(k)].j);
  };
  std::stable_sort(by_pair.begin(), by_pair.end(), [&](int a, int b) { return pair_of(a) < pair_of(b); });
  for (const int k : place)
    among_sorted.push_back(static_cast<int>(std::find(by_pair.begin(), by_pair.end(), k) - by_pair.begin()));
  for (const double reach : {0.1, 0.0})
    expect_matches(
        "old contacts of two boxes at rest, listed in another order; reach " + show(reach) + " m",
        match_contacts(contacts, old, reach), place,
        {{as_eigen(among_sorted),
          "These are places in a sorted list of old contacts. Return indices in `old`, as it was given."},
         {as_eigen(same), "These are the contacts' own indices. Lists come in any order: compare the points."},
         {Eigen::VectorXd::Constant(8, -1),
          reach > 0 ? "Nothing was found. Compare points by r_j, which is relative to body j."
                    : "Nothing was found. The points are the same, 0 m apart: that is within a reach of 0."}},
        "Both boxes have a corner at the same r_j: compare only those of the same pair (i, j).");
}

EXERCISE_TEST(MatchContacts, FollowsPointsThatMoved) {
  Random random;
  std::vector<OldContact> old;
  std::vector<Contact> contacts;
  std::vector<int> expected;
  const std::vector<int> place = shuffled(random, 25);
  old.resize(25);
  for (int k = 0; k < 25; ++k) {
    const Vec3 point(0.2 * (k % 5), 0.2 * (k / 5), 0);
    old[static_cast<std::size_t>(place[static_cast<std::size_t>(k)])] = {2, 5, point};
    contacts.push_back(contact(2, 5, point + random.vector(0.02)));
    expected.push_back(place[static_cast<std::size_t>(k)]);
  }
  expect_matches("old contacts on a grid of 0.2 m, each moved by less than 0.035 m",
                 match_contacts(contacts, old, 0.3), expected, {},
                 "Of those within reach, 0.3 m, the nearest is the one: the next is at least 0.16 m away.");
}

EXERCISE_TEST(MatchContacts, MarksNewContactsAndDropsLostOnes) {
  const std::vector<Contact> contacts = {contact(0, 1, Vec3(0, 0, 0)), contact(0, 1, Vec3(3, 0, 0)),
                                         contact(1, 2, Vec3(0, 0, 0)), contact(0, 2, Vec3(0.5, 0, 0))};
  const std::vector<OldContact> old = {
      {0, 2, Vec3(0, 0, 0)}, {0, 1, Vec3(1, 0, 0)}, {0, 1, Vec3(0, 0.1, 0)}, {2, 3, Vec3(0, 0, 0)}};
  expect_matches("four contacts, of which two are new; reach 0.5 m", match_contacts(contacts, old, 0.5),
                 {2, -1, -1, 0},
                 {{as_eigen(std::vector<int>{2, 1, -1, 0}),
                   "The second is 2 m from the remaining contact of its pair: out of reach, so it is new."},
                  {as_eigen(std::vector<int>{2, -1, -1, -1}),
                   "The last is exactly at the reach: at most `reach`, <= and not <."},
                  {as_eigen(std::vector<int>{2, -1, 0, -1}),
                   "Bodies 1 and 2 had no contact before: compare only those of the same pair (i, j)."}},
                 "The first and the last get an index into the old ones, the others -1.");
}

EXERCISE_TEST(MatchContacts, TakesThePairInItsOrder) {
  const std::vector<OldContact> old = {{5, 2, Vec3(0, 0, 0)}, {2, 5, Vec3(0.2, 0, 0)}};
  expect_matches(
      "a contact of bodies 2 and 5; the nearest old one is of 5 and 2, another of 2 and 5",
      match_contacts({contact(2, 5, Vec3(0, 0, 0))}, old, 1), {1},
      {{as_eigen(std::vector<int>{0}),
        "The pair (5, 2) is not (2, 5): its point is relative to the other body, and so is its impulse."}},
      "The same pair (i, j), in this order.");
}

EXERCISE_TEST(MatchContacts, GivesEachOldOneToTheNearest) {
  const std::vector<OldContact> old = {{0, 1, Vec3(0, 0, 0)}};
  const std::vector<Contact> far_first = {contact(0, 1, Vec3(0.2, 0, 0)), contact(0, 1, Vec3(0.1, 0, 0))};
  const std::vector<Contact> near_first = {far_first[1], far_first[0]};
  const auto twice = as_eigen(std::vector<int>{0, 0});
  const std::string once = "Both got the same impulse, which now counts twice. Each old one is used once.";
  expect_matches("two contacts with the same nearest old one, the farther listed first",
                 match_contacts(far_first, old, 1), {-1, 0},
                 {{twice, once},
                  {as_eigen(std::vector<int>{0, -1}),
                   "First come, first served is wrong here: the second contact is nearer."}},
                 "The nearer contact gets the old one; the other is new.");
  expect_matches("two contacts with the same nearest old one, the nearer listed first",
                 match_contacts(near_first, old, 1), {0, -1}, {{twice, once}},
                 "The nearer contact gets the old one; the other is new.");
  const auto at_one_place =
      match_contacts({contact(0, 1, Vec3(0, 0, 0)), contact(0, 1, Vec3(0, 0, 0))}, old, 1);
  expect_true("of two contacts at the point of an old one, one continues it", "Eq. (10.1)",
              at_one_place == std::vector<int>{0, -1} || at_one_place == std::vector<int>{-1, 0}, once);
}

EXERCISE_TEST(MatchContacts, MatchesNoNaN) {
  const Vec3 nowhere = Vec3::Constant(std::nan(""));
  const std::vector<Contact> contacts = {contact(0, 1, nowhere), contact(0, 1, Vec3(0.1, 0, 0))};
  const std::string clue =
      "A distance that is NaN is not at most the reach. Every comparison with NaN is false.";
  expect_matches("a contact at NaN, and one near an old one",
                 match_contacts(contacts, {{0, 1, Vec3::Zero()}}, 1), {-1, 0}, {}, clue);
  expect_matches("two contacts, of which the old one is at NaN", match_contacts(contacts, {{0, 1, nowhere}}, 1),
                 {-1, -1}, {}, clue);
}

EXERCISE_TEST(MatchContacts, TakesTheNearestOfTwo) {
  const std::vector<OldContact> old = {{0, 1, Vec3(0, 0, 0)}, {0, 1, Vec3(0.3, 0, 0)}};
  const std::vector<OldContact> turned = {old[1], old[0]};
  const std::vector<Contact> one = {contact(0, 1, Vec3(0.1, 0, 0))};
  const std::string has_one =
      "The contact has the nearer one already, with index 0. A farther one does not replace it.";
  expect_matches("one contact and two old ones within reach, the nearer listed first",
                 match_contacts(one, old, 0.5), {0}, {}, has_one);
  expect_matches("one contact and two old ones within reach, the farther listed first",
                 match_contacts(one, turned, 0.5), {1}, {}, "Take the nearer of the two.");
}

EXERCISE_TEST(MatchContacts, TakesTheNearestHoweverLittleItIsNearer) {
  for (const double part : relative_scales) {
    const std::vector<OldContact> old = {{0, 1, Vec3(-1 - part, 0, 0)}, {0, 1, Vec3(0, 1, 0)}};
    const std::vector<Contact> one = {contact(0, 1, Vec3::Zero())};
    const std::string of =
        "one contact and two old ones, of which the first is farther by " + show(part) + " of ";
    expect_matches(of + "that", match_contacts(one, old, 2), {1}, {}, small_is_dropped);
    expect_matches(of + "exactly the reach, and outside it", match_contacts(one, {old[0]}, 1), {-1}, {},
                   small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(MatchContacts, GivesTheNextNearestToAnUnmatchedContact) {
  const std::vector<OldContact> old = {{0, 1, Vec3(0, 0, 0)}, {0, 1, Vec3(0.6, 0, 0)}};
  const std::vector<Contact> contacts = {contact(0, 1, Vec3(0.2, 0, 0)), contact(0, 1, Vec3(0.1, 0, 0))};
  expect_matches("two contacts near an old one, and a second old one within reach",
                 match_contacts(contacts, old, 0.5), {1, 0},
                 {{as_eigen(std::vector<int>{-1, 0}),
                   "The first lost the nearest to the second, but another one is within reach."}},
                 "Match the nearest two first, then the nearest two of the remaining ones.");
}

void expect_nearest_pairs_first(Random& random, int count) {
  const double reach = 0.4;
  std::vector<OldContact> old;
  std::vector<Contact> contacts;
  const auto body = [&] { return random.integer(1, 3); };
  for (int k = 0; k < count; ++k) old.push_back({0, body(), random.vector(0.5)});
  for (int k = 0; k < count; ++k) contacts.push_back(contact(0, body(), random.vector(0.5)));
  const auto match = match_contacts(contacts, old, reach);
  expect_true("one index for each contact", "Eq. (10.1)", match.size() == contacts.size());
  if (match.size() != contacts.size()) return;

  const auto distance = [&](std::size_t c, std::size_t k) { return (contacts[c].r_j - old[k].point).norm(); };
  std::vector<double> to_contact(old.size(), infinity);
  std::vector<double> to_old(contacts.size(), infinity);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (match[c] < 0) continue;
    const auto k = static_cast<std::size_t>(match[c]);
    const bool sound = k < old.size() && old[k].j == contacts[c].j && distance(c, k) <= reach;
    expect_true("contact " + std::to_string(c) + " continues one of its own pair, within reach", "Eq. (10.1)",
                sound,
                "Both belong to one pair (i, j), and their distance is at most the reach: not its square.");
    if (!sound) return;
    expect_true("old contact " + std::to_string(k) + " is continued once", "Eq. (10.1)",
                to_contact[k] == infinity, "Each old one is used once.");
    to_contact[k] = to_old[c] = distance(c, k);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c)
    for (std::size_t k = 0; k < old.size(); ++k) {
      if (old[k].j != contacts[c].j || distance(c, k) > reach) continue;
      expect_true("of " + std::to_string(count) + ", contact " + std::to_string(c) + " and old contact " +
                      std::to_string(k) + ", " + show(distance(c, k)) +
                      " m apart: at least one of them has a match as near",
                  "Eq. (10.1)", to_old[c] <= distance(c, k) || to_contact[k] <= distance(c, k),
                  "These two are nearer to each other than their own matches, or have none. Match the nearest "
                  "two first. " +
                      ends_early);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(MatchContacts, MatchesTheNearestPairsFirst) {
  Random random;
  for (const int count : {40, 3 * many})
    if (!::testing::Test::HasFailure()) expect_nearest_pairs_first(random, count);
}

EXERCISE_TEST(MatchContacts, OfNothingIsNothing) {
  const std::vector<Contact> contacts = eight_corners();
  expect_true("no contacts: an empty list", "Eq. (10.1)",
              match_contacts({}, {{0, 1, Vec3::Zero()}}, 1).empty());
  expect_true("no old contacts: all are new", "Eq. (10.1)",
              match_contacts(contacts, {}, 1) == std::vector<int>(contacts.size(), -1));
}

EXERCISE_TEST(MatchContacts, TellsBodiesOfAnyNumbersApart) {
  for (const int many : {10, 16, 100, 256, 1000, 1024, 4096, 10000, 65536, 100000, 1000000}) {
    const Contact now{
        .i = 0, .j = many + 5, .n = Vec3::UnitZ(), .gap = 0, .r_i = Vec3::Zero(), .r_j = Vec3::Zero()};
    expect_true(
        "bodies 0 and " + std::to_string(many + 5) + " are not bodies 1 and 5, nor 5 and " +
            std::to_string(many),
        "Eq. (10.1)",
        match_contacts({now}, {{1, 5, Vec3::Zero()}, {5, many, Vec3::Zero()}}, 1) == std::vector<int>{-1},
        "There may be more bodies than here. A pair is two numbers: one number made of them may be that of "
        "another pair.");
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
