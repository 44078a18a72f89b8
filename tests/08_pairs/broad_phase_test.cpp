// Both broad phases: against all pairs, on random scenes of every kind, and against the time that all pairs take.
#include <algorithm>

#include "processor_time.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SweepAndPrune, "8.10 sweep_and_prune");
EXERCISE(SpatialHash, "8.11 spatial_hash");

using BroadPhase = std::vector<Pair> (*)(const std::vector<spook::Bounds>&);

bool touch(const spook::Bounds& a, const spook::Bounds& b) {
  for (int k = 0; k < 3; ++k)
    if (a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k]) return false;
  return true;
}

std::vector<Pair> all_pairs(const std::vector<spook::Bounds>& bounds) {
  std::vector<Pair> pairs;
  const int count = static_cast<int>(bounds.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      if (touch(bounds[static_cast<std::size_t>(i)], bounds[static_cast<std::size_t>(j)]))
        pairs.emplace_back(i, j);
  return pairs;
}

std::string show_pair(const Pair& pair) {
  return "(" + std::to_string(pair.first) + ", " + std::to_string(pair.second) + ")";
}

std::string show_bounds(const spook::Bounds& one) {
  return "from " + show(one.lower) + " to " + show(one.upper);
}

/// The first difference between what was found and what there is, in words.
bool expect_all(const std::string& equation, const std::string& scene, const std::vector<spook::Bounds>& bounds,
                const std::vector<Pair>& got, const std::vector<Pair>& want) {
  if (got == want) return true;
  const std::string of = " of " + std::to_string(bounds.size()) + " bounds, " + scene;
  const int count = static_cast<int>(bounds.size());
  for (const Pair& pair : got) {
    expect_true("the pair " + show_pair(pair) + of + ": are indices, the lower first", equation,
                0 <= pair.first && pair.first < pair.second && pair.second < count,
                pair.first == pair.second ? "No body makes a pair with itself."
                                          : "Pairs are of indices in `bounds`, the lower first.");
    if (::testing::Test::HasFailure()) return false;
  }
  std::vector<Pair> sorted = got;
  std::sort(sorted.begin(), sorted.end());
  const auto both = [&](const Pair& pair) {
    return "\n  " + std::to_string(pair.first) + " " +
           show_bounds(bounds[static_cast<std::size_t>(pair.first)]) + "\n  and " +
           std::to_string(pair.second) + " " + show_bounds(bounds[static_cast<std::size_t>(pair.second)]);
  };
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) {
    expect_true(
        "the pair " + show_pair(*twice) + of + ", is there once", equation, false,
        "Bodies may share several cells, or meet several times in a sweep: one of those tells of the pair.");
    return false;
  }
  std::vector<Pair> missing, wrong;
  std::set_difference(want.begin(), want.end(), sorted.begin(), sorted.end(), std::back_inserter(missing));
  std::set_difference(sorted.begin(), sorted.end(), want.begin(), want.end(), std::back_inserter(wrong));
  if (!missing.empty()) {
    const auto& [i, j] = missing[0];
    const auto &a = bounds[static_cast<std::size_t>(i)], &b = bounds[static_cast<std::size_t>(j)];
    const double width = (a.upper.cwiseMin(b.upper) - a.lower.cwiseMax(b.lower)).minCoeff();
    given() = "given " + both(missing[0]);
    expect_true("the pair " + show_pair(missing[0]) + of + ", is found", equation, false,
                (width == 0 ? "They share no more than a point, a line or a face: touching counts."
                            : "They overlap, and no pair may be missed.") +
                    (equation == "Eq. (8.14)"
                         ? std::string(" Of three cells along an axis the one in the middle counts, too.")
                         : ""));
  } else if (!wrong.empty()) {
    given() = "given " + both(wrong[0]);
    expect_true("the pair " + show_pair(wrong[0]) + of + ", does not touch, and is left out", equation, false,
                "All three axes have to overlap: sharing a cell, or an interval of one axis, is not enough.");
  } else {
    expect_true("the pairs" + of + ", are sorted", equation, false, "std::sort, at the end.");
  }
  return false;
}

/// A kind of scene, in words, and one of its bounds.
struct Kind {
  std::string what;
  std::function<spook::Bounds(Random&, const std::vector<spook::Bounds>&)> next;
};

spook::Bounds around(const Vec3& x, const Vec3& half) {
  return {.lower = x - half, .upper = x + half};
}

std::vector<Kind> all_kinds() {
  const auto some = [](Random& random, const std::vector<spook::Bounds>& before) {
    return before[static_cast<std::size_t>(random.integer(0, static_cast<int>(before.size()) - 1))];
  };
  return {{"of like sizes",
           [](Random& random, const auto&) {
             const Vec3 x = random.vector(2);
             return around(x, random.vector(0.3, 0.5));
           }},
          {"on a grid, face to face, or less by a thousandth of a nanometre",
           [=](Random& random, const auto&) {
             const Vec3 lower = random.integers(-3, 3);
             const Vec3 less =
                 random.integer(0, 1) ? Vec3(1e-12 * Vec3::Unit(random.integer(0, 2))) : Vec3(Vec3::Zero());
             const int wide = random.integer(1, 2), deep = random.integer(1, 2);
             return spook::Bounds{lower, lower + Vec3(wide, deep, 1) - less};
           }},
          {"of sizes from 1e-6 to 1e6 m",
           [](Random& random, const auto&) {
             const double size = random.log_uniform(1e-6, 1e6), away = size * random.log_uniform(1e-3, 3);
             const Vec3 x = away * random.unit_vector();
             return around(x, size * random.vector(0.2, 1));
           }},
          {"within each other, or the same",
           [=](Random& random, const auto& before) {
             if (before.empty()) return around(random.vector(), Vec3::Constant(1));
             const spook::Bounds one = some(random, before);
             return random.integer(0, 2) ? around((one.lower + one.upper) / 2,
                                                  random.uniform(0.3, 1.1) * (one.upper - one.lower) / 2)
                                         : one;
           }},
          {"flat, thin, and points",
           [=](Random& random, const auto& before) {
             const Vec3 lower = before.empty() || random.integer(0, 1) ? Vec3(0.5 * random.integers(-2, 2))
                                                                       : some(random, before).upper;
             const int x = random.integer(0, 1), y = random.integer(0, 2), z = random.integer(0, 1);
             return spook::Bounds{lower, lower + 0.5 * Vec3(x, y, z)};
           }},
          {"1e12 m from the origin",
           [=](Random& random, const auto&) {
             const double apart = random.uniform(0, 1), size = random.log_uniform(1e-5, 2);
             const Vec3 lower = 1e12 * Vec3(1, -1, 1) + apart * random.integers(-3, 3);
             return spook::Bounds{lower, lower + size * Vec3(random.integer(0, 1), 1, 1)};
           }},
          {"of powers of two, and a rounding more", [=](Random& random, const auto&) {
             const double cell = std::ldexp(1, random.integer(-2, 2));
             const Vec3 lower = cell * random.integers(-2, 2);
             const Vec3 less = random.integer(0, 1) ? Vec3(Vec3::Constant(-1e-20)) : Vec3(Vec3::Zero());
             const Vec3 from = lower.cwiseEqual(0).select(less, lower);
             return spook::Bounds{from, lower + Vec3::Constant(cell)};
           }}};
}

void expect_all_pairs(BroadPhase find, const std::string& equation) {
  Random random;
  const std::vector<Kind> kinds = all_kinds();
  for (int trial = 0; trial < 10000; ++trial) {
    const Kind& kind = kinds[static_cast<std::size_t>(trial) % kinds.size()];
    const int count = random.integer(0, trial % 4 == 0 ? 60 : 20);
    std::vector<spook::Bounds> bounds;
    while (static_cast<int>(bounds.size()) < count) bounds.push_back(kind.next(random, bounds));
    given() = "given " + std::to_string(count) + " bounds, " + kind.what;
    const std::vector<Pair> got = find(bounds);
    given().clear();
    if (!expect_all(equation, kind.what, bounds, got, all_pairs(bounds))) return;
  }
}

void expect_refusals(BroadPhase find) {
  const spook::Bounds sound{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  find({sound});
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (int k = 0; k < 3; ++k) {
      spook::Bounds one = sound, other = sound;
      one.lower[k] = bad;
      other.upper[k] = bad;
      const std::string clue = "See require_all_finite in require.hpp. One NaN, and no order is an order.";
      expect_rejects(
          "a lower with " + show(bad), "lower",
          [&] {
            find({sound, one});
          },
          clue);
      expect_rejects(
          "an upper with " + show(bad), "upper",
          [&] {
            find({sound, other});
          },
          clue);
    }
  for (int k = 0; k < 3; ++k) {
    spook::Bounds turned_over = sound;
    turned_over.upper[k] = -1e-9;
    expect_rejects(
        "an upper below its lower along " + std::string(1, "xyz"[k]), "upper", [&] { find({turned_over}); },
        "See reject in require.hpp, and look along all three axes, whichever the boxes are sorted along.");
  }
}

/// Cubes of 0.7 m, one in each cubic metre.
std::vector<spook::Bounds> crowd(Random& random, int count) {
  std::vector<spook::Bounds> bounds;
  const double side = std::cbrt(count);
  for (int k = 0; k < count; ++k)
    bounds.push_back(around(side / 2 * Vec3::Ones() + random.vector(side / 2), Vec3::Constant(0.35)));
  return bounds;
}

/// Not how long it takes, but that it is another kind of method: with so many bodies all pairs take ten times as long.
void expect_faster(BroadPhase find, const std::string& equation, const std::string& scene,
                   const std::vector<spook::Bounds>& bounds, const std::string& clue) {
  std::vector<Pair> got, want;
  got = find(bounds);
  const double all = least_seconds(1, [&] { want = all_pairs(bounds); });
  if (!expect_all(equation, scene, bounds, got, want)) return;
  const double mine = least_seconds(3, [&] { got = find(bounds); });
  expect_at_most("time for " + std::to_string(bounds.size()) + " bounds, " + scene + ", over that of all pairs",
                 equation, mine / all, 0.25, "a quarter; ours takes less than a tenth", clue);
}

EXERCISE_TEST(SweepAndPrune, FindsWhatAllPairsFind) {
  expect_all_pairs(sweep_and_prune, "Eq. (8.12)");
}
EXERCISE_TEST(SweepAndPrune, RefusesWhatIsNoBox) {
  expect_refusals(sweep_and_prune);
}

EXERCISE_TEST(SweepAndPrune, LeavesMostPairsOut) {
  Random random;
  expect_faster(sweep_and_prune, "Eq. (8.12)", "in a cube", crowd(random, 10000),
                "In order of their lower ends, whoever begins behind the end of one, and all after it, are no "
                "neighbours of that one: stop there.");
}

EXERCISE_TEST(SweepAndPrune, SortsAlongTheLongestAxis) {
  // Any one axis fails in one of these: a tower along x, along y, along z. Where it stands does not say which it is; nor,
  // in a tower of boards of all lengths, how far their ends are spread.
  Random random;
  for (int k = 0; k < 3; ++k)
    for (const bool boards : {false, true}) {
      const int across = (k + 1) % 3;
      const Vec3 foot = 5000 * Vec3::Unit(across) - 3000 * Vec3::Unit((k + 2) % 3);
      std::vector<spook::Bounds> tower;
      for (int n = 0; n < 2000; ++n) {
        Vec3 x = foot + random.vector(0.3), half = Vec3::Constant(0.35);
        x[k] = n * 0.69;
        if (boards) half[across] = random.uniform(1, 30000);
        tower.push_back(around(x, half));
      }
      const std::string what =
          boards ? "boards of all lengths, one upon another along " : "one upon another along ";
      expect_faster(
          sweep_and_prune, "Eq. (8.12)", what + "xyz"[k], tower,
          "Along this axis they are apart, along the others they all overlap: sort along the axis in which "
          "their centres are spread farthest, around where they are on average. And stop at the first that "
          "begins "
          "behind the end of one: all after it do, too.");
      if (::testing::Test::HasFailure()) return;
    }
}

/// Cubes of 0.7 m in 100 layers of 100: along each axis many begin alike.
std::vector<spook::Bounds> layers() {
  std::vector<spook::Bounds> bounds;
  for (int k = 0; k < 10000; ++k)
    bounds.push_back(around(Vec3(k % 100, k / 100 % 10, k / 1000), Vec3::Constant(0.35)));
  return bounds;
}

EXERCISE_TEST(SweepAndPrune, SortsManyThatBeginAlike) {
  expect_faster(sweep_and_prune, "Eq. (8.12)", "of which a hundred begin alike", layers(),
                "Many begin at the same place: a sort has to be fast with equal keys, too. std::sort is.");
}

/// Boards, thin along one axis: whoever takes that for their size has a board in hundreds of cells, and a sheet in more
/// than can be counted. So this comes before sheets do.
bool hash_takes_the_longest_side() {
  Random random;
  for (int thin = 0; thin < 3; ++thin) {
    std::vector<spook::Bounds> boards = crowd(random, 5000);
    for (spook::Bounds& one : boards) one.upper[thin] = one.lower[thin] + 0.04;
    expect_faster(spatial_hash, "Eq. (8.13)", std::string("boards that are thin along ") + "xyz"[thin], boards,
                  "A body's size is its longest side: in cells of 2^l that are not below it, it is in two "
                  "along each axis, at "
                  "most. Here its level seems to come from another side, so that it is in very many.");
    if (::testing::Test::HasFailure()) return false;
  }
  return true;
}

EXERCISE_TEST(SpatialHash, TakesTheLongestSideForTheSize) {
  hash_takes_the_longest_side();
}
EXERCISE_TEST(SpatialHash, FindsWhatAllPairsFind) {
  if (hash_takes_the_longest_side()) expect_all_pairs(spatial_hash, "Eq. (8.14)");
}
EXERCISE_TEST(SpatialHash, RefusesWhatIsNoBox) {
  expect_refusals(spatial_hash);
}

EXERCISE_TEST(SpatialHash, LeavesMostPairsOut) {
  Random random;
  expect_faster(spatial_hash, "Eq. (8.14)", "in a cube", crowd(random, 10000),
                "Only bodies that share a cell are compared, and a cell of their own size holds a few.");
}

EXERCISE_TEST(SpatialHash, TellsCellsApartByAllBits) {
  // Each is in a cell of its own, whose numbers end in the same twenty bits as those of all others.
  std::vector<spook::Bounds> lattice;
  for (int k = 0; k < 8000; ++k) {
    const Vec3 corner = std::ldexp(1, 20) * Vec3(k % 20, k / 20 % 20, k / 400);
    lattice.push_back(around(corner + Vec3::Constant(0.5), Vec3::Constant(0.35)));
  }
  expect_faster(spatial_hash, "Eq. (8.14)", "each 2^20 m from the next", lattice,
                "Cells that are far from each other have the same index in the table, and its lists grow long: "
                "let all bits of the three numbers count, and not only the low ones.");
}

EXERCISE_TEST(SpatialHash, TellsPointsApart) {
  Random random;
  std::vector<spook::Bounds> points;
  for (int k = 0; k < 6000; ++k)
    points.push_back(around(Vec3(0.5, 0.5, 0.5) + 1e-3 * random.vector(), Vec3::Zero()));
  expect_faster(
      spatial_hash, "Eq. (8.13)", "points within a millimetre", points,
      "A point has no size, and no cell is too small for it. In cells of a size that has nothing to do "
      "with the points they are all in one, and so they are where the numbers of cells do not fit into their "
      "type.");
}

EXERCISE_TEST(SpatialHash, IsNotHeldUpByAGiant) {
  Random random;
  std::vector<spook::Bounds> bounds = crowd(random, 10000);
  for (spook::Bounds& one : bounds) {
    one.lower *= 1e-3;
    one.upper *= 1e-3;
  }
  bounds.push_back(around(Vec3::Zero(), Vec3::Constant(100)));
  bounds.push_back(around(Vec3(1e4, 0, 0), Vec3::Constant(1)));
  expect_faster(
      spatial_hash, "Eq. (8.13)", "of 0.7 mm, and one of 200 m around them", bounds,
      "In cells of the size of the largest all others are in one. Each body has a level of its own, Eq. "
      "(8.13), and looks for others in its own level and the coarser ones.");
}

EXERCISE_TEST(SpatialHash, SortsSizesByLevels) {
  std::vector<spook::Bounds> nested;
  for (int k = -50; k < 50; ++k) nested.push_back(around(Vec3::Zero(), Vec3::Constant(std::ldexp(0.4, k))));
  if (!expect_all("Eq. (8.13)", "each twice as large as the one before, in a hundred levels", nested,
                  spatial_hash(nested), all_pairs(nested)))
    return;
  Random random;
  std::vector<spook::Bounds> bounds;
  for (int k = 0; k < 16000; ++k) {
    // Each level as crowded as the others: a body of size s has its place within 8 s.
    const double size = random.log_uniform(1e-3, 1e3);
    bounds.push_back(around(40 * size * Vec3(1, 1, 1) + 6 * size * random.vector(), Vec3::Constant(size / 2)));
  }
  expect_faster(spatial_hash, "Eq. (8.13)", "of sizes from 1 mm to 1 km", bounds,
                "A grid for each level of size: cells of 2^l, the smallest that are not below a body's size.");
}

}  // namespace
