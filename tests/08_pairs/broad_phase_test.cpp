// Both broad phases: against all pairs, on random scenes of every kind, and with a cost that grows more slowly than the
// number of pairs.
#include <algorithm>

#include "operations.hpp"
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

/// Describes the first difference between the pairs found and the true pairs.
bool expect_all(const std::string& equation, const std::string& scene, const std::vector<spook::Bounds>& bounds,
                const std::vector<Pair>& got, const std::vector<Pair>& want) {
  if (got == want) return true;
  const std::string of = " of " + std::to_string(bounds.size()) + " bounds, " + scene;
  const int count = static_cast<int>(bounds.size());
  for (const Pair& pair : got) {
    expect_true("the pair " + show_pair(pair) + of + ": are indices, the lower first", equation,
                0 <= pair.first && pair.first < pair.second && pair.second < count,
                pair.first == pair.second ? "A body and itself are not a pair."
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
    expect_true("the pair " + show_pair(*twice) + of + ", is there once", equation, false,
                "Bodies may share several cells, or meet several times in a sweep. Report each pair once.");
    return false;
  }
  std::vector<Pair> missing, wrong;
  std::set_difference(want.begin(), want.end(), sorted.begin(), sorted.end(), std::back_inserter(missing));
  std::set_difference(sorted.begin(), sorted.end(), want.begin(), want.end(), std::back_inserter(wrong));
  if (!missing.empty()) {
    const auto& [i, j] = missing[0];
    const auto &a = bounds[static_cast<std::size_t>(i)], &b = bounds[static_cast<std::size_t>(j)];
    const double width = (a.upper.cwiseMin(b.upper) - a.lower.cwiseMax(b.lower)).minCoeff();
    const double size_a = (a.upper - a.lower).maxCoeff(), size_b = (b.upper - b.lower).maxCoeff();
    const bool levels_differ = size_a > 2 * size_b || size_b > 2 * size_a;
    given() = "given " + both(missing[0]);
    expect_true(
        "the pair " + show_pair(missing[0]) + of + ", is found", equation, false,
        (width == 0 ? "They share only a point, a line or a face. Touching counts."
                    : "They overlap, so this pair is missing.") +
            (equation == "Eq. (8.14)"
                 ? (levels_differ ? " Their sizes are of different levels: a body is also looked for in the "
                                    "grids of all coarser levels."
                                  : "") +
                       std::string(" Of three cells along an axis the one in the middle counts, too.")
                 : ""));
  } else if (!wrong.empty()) {
    given() = "given " + both(wrong[0]);
    expect_true("the pair " + show_pair(wrong[0]) + of + ", does not touch, and is left out", equation, false,
                "They must overlap along all three axes. A shared cell, or an overlap along one axis, is not "
                "enough.");
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
      const std::string clue =
          "See require_all_finite in require.hpp. A single NaN makes any sorting "
          "meaningless.";
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

using Bodies = std::vector<spook::Bounds>;

double operations_for(BroadPhase find, const Bodies& bounds) {
  return operations_of([&] { find(bounds); });
}

/// Expects all pairs of `many` bodies, and at most `factor` times the operations that `few`, an eighth of them, take.
void expect_slow_growth(BroadPhase find, const std::string& equation, const std::string& scene,
                        const Bodies& few, const Bodies& many, double factor, const std::string& why,
                        const std::string& clue) {
  if (!expect_all(equation, scene, many, find(many), all_pairs(many))) return;
  expect_growth(std::to_string(many.size()) + " bounds, " + scene, equation, operations_for(find, few),
                operations_for(find, many), static_cast<double>(many.size()), factor, why, clue);
}

/// Largest growth of the operations for 8 times the bodies, if each body meets a few others, whatever their number.
constexpr double as_many_bodies = 16;
const std::string why_as_many = "a part for each body makes it 8, sorting 11, and all pairs 64";

EXERCISE_TEST(SweepAndPrune, FindsWhatAllPairsFind) {
  expect_all_pairs(sweep_and_prune, "Eq. (8.12)");
}
EXERCISE_TEST(SweepAndPrune, RefusesWhatIsNoBox) {
  expect_refusals(sweep_and_prune);
}

EXERCISE_TEST(SweepAndPrune, LeavesMostPairsOut) {
  Random random;
  const Bodies few = crowd(random, 1000), many = crowd(random, 8000);
  expect_slow_growth(
      sweep_and_prune, "Eq. (8.12)", "in a cube", few, many, 45,
      "a layer for each body, twice as wide and high, makes it 32, and all pairs 64",
      "Sorted by lower ends: if a body begins behind the end of another, neither it nor any later one is a "
      "neighbour. Stop there.");
}

EXERCISE_TEST(SweepAndPrune, SortsAlongTheLongestAxis) {
  // Any one axis fails in one of these: a tower along x, along y, along z. Where it stands does not say which it is;
  // nor, in a tower of boards of all lengths, how far their ends are spread.
  Random random;
  const auto tower = [&random](int axis, bool boards, int height) {
    const int across = (axis + 1) % 3;
    const Vec3 foot = 5000 * Vec3::Unit(across) - 3000 * Vec3::Unit((axis + 2) % 3);
    Bodies bounds;
    for (int n = 0; n < height; ++n) {
      Vec3 x = foot + random.vector(0.3), half = Vec3::Constant(0.35);
      x[axis] = n * 0.69;
      if (boards) half[across] = random.uniform(1, 30000);
      bounds.push_back(around(x, half));
    }
    return bounds;
  };
  for (int k = 0; k < 3; ++k)
    for (const bool boards : {false, true}) {
      const Bodies few = tower(k, boards, 250), many = tower(k, boards, 2000);
      expect_slow_growth(
          sweep_and_prune, "Eq. (8.12)",
          (boards ? "boards of all lengths, one upon another along " : "one upon another along ") +
              std::string(1, "xyz"[k]),
          few, many, as_many_bodies, why_as_many,
          "Along this axis they are apart, along the others they all overlap: sort along the axis in which "
          "their centres are spread farthest, around where they are on average. And stop at the first that "
          "begins behind the end of a body, since all later ones do, too.");
      if (::testing::Test::HasFailure()) return;
    }
}

/// Cubes of 0.7 m in layers of `side` times `side`, ten times as many layers: along each axis many begin alike.
Bodies layers(int side) {
  Bodies bounds;
  for (int x = 0; x < 10 * side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) bounds.push_back(around(Vec3(x, y, z), Vec3::Constant(0.35)));
  return bounds;
}

EXERCISE_TEST(SweepAndPrune, SortsManyThatBeginAlike) {
  expect_slow_growth(sweep_and_prune, "Eq. (8.12)", "of which a hundred begin alike", layers(5), layers(10), 45,
                     "a layer for each body, twice as wide and high, makes it 32, and all pairs 64",
                     "Many begin at the same place, so the sort must be fast with equal keys, too. std::sort "
                     "is.");
}

/// Returns the bounds of some bodies, scaled by a factor.
Bodies larger(Bodies bounds, double times) {
  for (spook::Bounds& one : bounds) one.lower *= times, one.upper *= times;
  return bounds;
}

/// Cubes of twice the size in cells of twice the size, and one large body among small ones: whoever takes the level
/// from elsewhere has a body in many cells here, and in more than there is memory for where sizes differ more.
bool hash_takes_each_bodys_own_level() {
  Random random;
  const Bodies cubes = crowd(random, 300);
  const double few = operations_for(spatial_hash, cubes);
  Bodies with_a_giant = cubes;
  with_a_giant.push_back(around(Vec3(200, 0, 0), Vec3::Constant(30)));
  const std::string own =
      "The level of a body comes from its own size, with 2^l not below it: 2 m for a side of 1.4 m, 1/2 m for "
      "one of 0.35 m. Here a body is in very many cells, or a cell holds very many bodies.";
  for (const auto& [scene, bodies] : {std::pair("cubes of 1.4 m in place of 0.7 m", larger(cubes, 2)),
                                      {"cubes of 0.35 m in place of 0.7 m", larger(cubes, 0.5)},
                                      {"cubes of 0.7 m, and one of 60 m apart from them", with_a_giant}}) {
    if (!expect_all("Eq. (8.13)", scene, bodies, spatial_hash(bodies), all_pairs(bodies))) return false;
    expect_at_most(std::string("operations for 300 ") + scene + ", over those for cubes of 0.7 m alone",
                   "Eq. (8.13)", operations_for(spatial_hash, bodies) / few, 4,
                   "each is in as many cells of its own level, and looks into one more grid at most", own);
    if (::testing::Test::HasFailure()) {
      this_failure_explains();
      return false;
    }
  }
  return true;
}

/// Boards, thin along one axis: whoever takes that for their size has a board in hundreds of cells, and a sheet in more
/// than can be counted. So this comes before sheets do.
bool hash_takes_the_longest_side() {
  if (!hash_takes_each_bodys_own_level()) return false;
  Random random;
  const Bodies cubes = crowd(random, 5000);
  for (int thin = 0; thin < 3; ++thin) {
    Bodies boards = cubes;
    for (spook::Bounds& one : boards) one.upper[thin] = one.lower[thin] + 0.04;
    const std::string scene = std::string("boards that are thin along ") + "xyz"[thin];
    if (!expect_all("Eq. (8.13)", scene, boards, spatial_hash(boards), all_pairs(boards))) return false;
    expect_at_most(
        "operations for 5,000 bounds, " + scene + ", over those for cubes", "Eq. (8.13)",
        operations_for(spatial_hash, boards) / operations_for(spatial_hash, cubes), 2,
        "a board lies in the cells of the cube that it was cut from",
        "A body's size is its longest side: in cells of 2^l that are not below it, it is in two along each "
        "axis, at most. Here its level seems to come from another side, so that it is in very many cells.");
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
  if (!hash_takes_each_bodys_own_level()) return;
  Random random;
  const Bodies few = crowd(random, 1000), many = crowd(random, 8000);
  expect_slow_growth(spatial_hash, "Eq. (8.14)", "in a cube", few, many, as_many_bodies, why_as_many,
                     "Only bodies that share a cell are compared, and a cell of their own size holds a few.");
}

EXERCISE_TEST(SpatialHash, TellsCellsApartByAllBits) {
  if (!hash_takes_each_bodys_own_level()) return;
  // Each is in a cell of its own, whose numbers end in the same twenty bits as those of all others.
  const auto lattice = [](int side) {
    Bodies bounds;
    for (int k = 0; k < side * side * side; ++k) {
      const Vec3 corner = std::ldexp(1, 20) * Vec3(k % side, k / side % side, k / (side * side));
      bounds.push_back(around(corner + Vec3::Constant(0.5), Vec3::Constant(0.35)));
    }
    return bounds;
  };
  expect_slow_growth(
      spatial_hash, "Eq. (8.14)", "each 2^20 m from the next", lattice(10), lattice(20), as_many_bodies,
      why_as_many,
      "Cells that are far from each other have the same index in the table, and its lists grow long: use all "
      "bits of the three numbers, not only the low ones.");
}

EXERCISE_TEST(SpatialHash, SeparatesBodiesOfZeroSize) {
  if (!hash_takes_each_bodys_own_level()) return;
  Random random;
  Bodies points;
  for (int k = 0; k < 6000; ++k)
    points.push_back(around(Vec3(0.5, 0.5, 0.5) + 1e-3 * random.vector(), Vec3::Zero()));
  const Bodies few(points.begin(), points.begin() + 750);
  expect_slow_growth(spatial_hash, "Eq. (8.13)", "points within a millimetre", few, points, as_many_bodies,
                     why_as_many,
                     "A point has no size, and no cell is too small for it. If the cell size is fixed, or if "
                     "the numbers of cells do not fit into their type, all points are in one cell.");
}

EXERCISE_TEST(SpatialHash, StaysFastBesideAVeryLargeBody) {
  if (!hash_takes_each_bodys_own_level()) return;
  Random random;
  const auto around_them = [&random](int count) {
    Bodies bounds = crowd(random, count);
    for (spook::Bounds& one : bounds) {
      one.lower *= 1e-3;
      one.upper *= 1e-3;
    }
    bounds.push_back(around(Vec3::Zero(), Vec3::Constant(100)));
    bounds.push_back(around(Vec3(1e4, 0, 0), Vec3::Constant(1)));
    return bounds;
  };
  const Bodies few = around_them(1000), many = around_them(8000);
  expect_slow_growth(
      spatial_hash, "Eq. (8.13)", "of 0.7 mm, and one of 200 m around them", few, many, as_many_bodies,
      why_as_many,
      "In cells of the size of the largest all others are in one. Each body has a level of its own, Eq. "
      "(8.13), and looks for others in its own level and the coarser ones.");
}

EXERCISE_TEST(SpatialHash, SortsSizesByLevels) {
  if (!hash_takes_each_bodys_own_level()) return;
  std::vector<spook::Bounds> nested;
  for (int k = -50; k < 50; ++k) nested.push_back(around(Vec3::Zero(), Vec3::Constant(std::ldexp(0.4, k))));
  if (!expect_all("Eq. (8.13)", "each twice as large as the one before, in a hundred levels", nested,
                  spatial_hash(nested), all_pairs(nested)))
    return;
  Random random;
  const auto of_all_sizes = [&random](int count) {
    Bodies bounds;
    for (int k = 0; k < count; ++k) {
      // Each level as crowded as the others, however many there are.
      const double size = random.log_uniform(1e-3, 1e3);
      bounds.push_back(around(40 * size * Vec3(1, 1, 1) + 0.24 * std::cbrt(count) * size * random.vector(),
                              Vec3::Constant(size / 2)));
    }
    return bounds;
  };
  const Bodies few = of_all_sizes(2000), many = of_all_sizes(16000);
  expect_slow_growth(
      spatial_hash, "Eq. (8.13)", "of sizes from 1 mm to 1 km", few, many, as_many_bodies, why_as_many,
      "A grid for each level of size: cells of 2^l, the smallest that are not below a body's size.");
}

}  // namespace
