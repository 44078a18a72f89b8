// A rope: places and masses of its points, its links, and the sweeps until it hangs.
#include <algorithm>
#include <numbers>

#include "algebra.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Rope, "6.3 rope");

struct RopeInput {
  Random random;
  Vec3 from = random.vector(2), to = random.vector(2);
  int links = random.integer(3, 12);
  double mass = random.uniform(0.5, 5);
  double length = (to - from).norm();

  explicit RopeInput(const Random& stream = Random()) : random(stream) { tell(); }

  /// Returns the next random rope: of one link or more, heavy or light, short or long.
  static RopeInput any(const Random& stream) {
    RopeInput in(stream);
    in.links = in.random.integer(0, 9) ? in.random.integer(1, 15) : in.random.integer(300, 3000);
    in.mass = in.random.log_uniform(1e-3, 1e3);
    in.to = in.from + in.random.log_uniform(1e-2, 1e2) * (in.to - in.from);
    in.length = (in.to - in.from).norm();
    in.tell();
    return in;
  }

  void tell() const {
    given() = "given a rope of " + std::to_string(links) + " links and " + show(mass) + " kg from " +
              show(from) + " to " + show(to) + " m";
  }
  Net net() const { return rope(from, to, links, mass); }
};

// Checks the numbers of points, masses and links. Later checks look at each of them.
bool has_its_parts(const Net& net, int links) {
  expect_near("points of a rope of " + std::to_string(links) + " links", "Eq. (6.10)",
              static_cast<double>(net.x.size()), links + 1, {0, "a count"},
              {{links - 0.0, "One too few: N links have N + 1 points, both ends among them."},
               {links + 2.0, "One too many: N links have N + 1 points."}});
  expect_near("masses of a rope of " + std::to_string(links) + " links", "Eq. (6.10)",
              static_cast<double>(net.mass.size()), links + 1, {0, "a count"}, {}, "A mass for each point.");
  expect_near("links of a rope of " + std::to_string(links) + " links", "Eq. (6.10)",
              static_cast<double>(net.links.size()), links, {0, "a count"},
              {{links + 1.0, "One too many: the last point has no next one."},
               {links - 1.0, "One too few: the last link ends at the last point."}});
  return !::testing::Test::HasFailure();
}

EXERCISE_TEST(Rope, LiesInAStraightLine) {
  const RopeInput in;
  const Net net = in.net();
  if (!has_its_parts(net, in.links)) return;
  for (int k = 0; k <= in.links && !::testing::Test::HasFailure(); ++k) {
    const double part = static_cast<double>(k) / in.links, short_of = static_cast<double>(k) / (in.links + 1);
    expect_near_vector(
        "point " + std::to_string(k) + " of 0 to " + std::to_string(in.links) + " [m]", "Eq. (6.10)",
        net.x[static_cast<std::size_t>(k)], Vec3(in.from + part * (in.to - in.from)), roundings(16, 4),
        {{in.to + part * (in.from - in.to), "The rope begins at `from`. This one begins at `to`."},
         {in.from + short_of * (in.to - in.from), "It ends too early: the last point is at `to`."},
         {in.from, "k/N of two integers is 0 except for the last: divide doubles."},
         {part * (in.to - in.from), "`from` is missing: this rope begins at the origin."}},
        "Equal steps from `from` to `to`.");
  }
}

EXERCISE_TEST(Rope, JoinsNeighbours) {
  const RopeInput in;
  const Net net = in.net();
  if (!has_its_parts(net, in.links)) return;
  const double each = in.length / in.links;
  for (int k = 0; k < in.links && !::testing::Test::HasFailure(); ++k) {
    const Link& link = net.links[static_cast<std::size_t>(k)];
    const std::string name = "link " + std::to_string(k);
    expect_true(name + " joins points " + std::to_string(k) + " and " + std::to_string(k + 1) + "; here " +
                    std::to_string(link.i) + " and " + std::to_string(link.j),
                "Eq. (6.10)", std::minmax(link.i, link.j) == std::minmax(k, k + 1),
                "Point k is joined to point k + 1 by link k.");
    expect_near("length of " + name + " [m]", "Eq. (6.10)", link.length, each, roundings(16, 4),
                {{in.length, "This is the whole rope's length."},
                 {in.length / (in.links + 1), "The rope is divided among its links, not among its points."},
                 {1, "A link has its own length, at rest as the rope lies."},
                 {0, "1/N of two integers is 0: divide doubles."}},
                "The length is the distance of the two points, since the rope is at rest as it lies.");
  }
}

EXERCISE_TEST(Rope, PutsHalfOfEachLinkOnEitherEnd) {
  const RopeInput in;
  const Net net = in.net();
  if (!has_its_parts(net, in.links)) return;
  const double link = in.mass / in.links;
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(in.links + 1);
  Eigen::VectorXd halves = 2 * ones, upper = ones, lower = ones;
  halves[0] = halves[in.links] = 1;
  upper[in.links] = lower[0] = 0;
  const std::string one_end = "All of each link's mass is on one of its ends: one end of the rope has none.";
  expect_near_vector(
      "masses of all points, from the first to the last [kg]", "Eq. (6.10)",
      Eigen::VectorXd(Eigen::VectorXd::Map(net.mass.data(), in.links + 1)), link / 2 * halves,
      roundings(64, in.mass),
      {{0 * ones, "All masses are 0: in C++ 1/N and 1/2 of integers are 0. Divide doubles."},
       {in.mass * ones, "Every point has the whole rope's mass."},
       {in.mass / 2 * halves, "Every link has the whole rope's mass. Its share is mass/N."},
       {in.length * link / 2 * halves,
        "This takes `mass` for the mass of 1 m. It is the mass of the whole rope."},
       {in.mass / (in.links + 1) * ones,
        "The mass is divided evenly among the points. It belongs to the links: an end has half a link's mass, "
        "any other point two halves."},
       {link * ones, "Every point is as heavy as a link. An end has one link beside it, so half of one."},
       {link / 2 * ones, "Every point has half a link. Where two links meet, each gives a half."},
       {link * halves, "All of each link's mass is on either of its ends: twice the rope."},
       {link * upper, one_end},
       {link * lower, one_end}},
      "Half of each link's mass on either of its ends.");
}

EXERCISE_TEST(Rope, IsOfAnyLinksMassAndLength) {
  Regions regions({"one link", "two links", "more than ten links", "more than a thousand links",
                   "links lighter than 10 g", "links heavier than 10 kg", "links shorter than 1 cm",
                   "links longer than 1 m", "upwards", "downwards"});
  RopeInput in;
  while (regions.lack_draws()) {
    in = RopeInput::any(in.random);
    const double link = in.mass / in.links, each = in.length / in.links;
    const std::string numbers = given();
    regions.draw({{"one link", in.links == 1},
                  {"two links", in.links == 2},
                  {"more than ten links", in.links > 10},
                  {"more than a thousand links", in.links > 1000},
                  {"links lighter than 10 g", link < 0.01},
                  {"links heavier than 10 kg", link > 10},
                  {"links shorter than 1 cm", each < 0.01},
                  {"links longer than 1 m", each > 1},
                  {"upwards", in.to.z() > in.from.z()},
                  {"downwards", in.to.z() < in.from.z()}});
    given() = numbers + "\n" + given();
    const Net net = in.net();
    if (!has_its_parts(net, in.links)) return;
    const double size = in.from.norm() + in.to.norm();
    for (int k = 0; k <= in.links && !::testing::Test::HasFailure(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      const bool end = k == 0 || k == in.links;
      expect_near_vector("point " + std::to_string(k) + " [m]", "Eq. (6.10)", net.x[at],
                         Vec3(in.from + k * (in.to - in.from) / in.links), roundings(16, size), {},
                         "Equal steps from `from` to `to`.");
      expect_near("mass of point " + std::to_string(k) + " [kg]", "Eq. (6.10)", net.mass[at],
                  end ? link / 2 : link, roundings(16, link), {},
                  "Half of each link's mass on either of its ends.");
      if (k == in.links || ::testing::Test::HasFailure()) break;
      const Link& joined = net.links[at];
      expect_true("link " + std::to_string(k) + " joins points " + std::to_string(k) + " and " +
                      std::to_string(k + 1) + "; here " + std::to_string(joined.i) + " and " +
                      std::to_string(joined.j),
                  "Eq. (6.10)", std::minmax(joined.i, joined.j) == std::minmax(k, k + 1),
                  "Point k is joined to point k + 1 by link k.");
      expect_near("length of link " + std::to_string(k) + " [m]", "Eq. (6.10)", joined.length, each,
                  roundings(32, size), {},
                  "The length is the distance of the two points, since the rope is at rest as it lies.");
    }
  }
}

EXERCISE_TEST(Rope, KeepsItsMassAndCentre) {
  const RopeInput in;
  const Net net = in.net();
  if (!has_its_parts(net, in.links)) return;
  double mass = 0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t k = 0; k < net.x.size(); ++k) {
    mass += net.mass[k];
    moment += net.mass[k] * net.x[k];
  }
  expect_near("mass of all points [kg]", "Eq. (6.10)", mass, in.mass, roundings(64, in.mass), {},
              "The points weigh as much as the rope: each half of a link counts once.");
  expect_near_vector("centre of mass [m]", "Eq. (6.10)", Vec3(moment / mass), Vec3((in.from + in.to) / 2),
                     roundings(64, 4), {}, "Half way between the ends: neither of them weighs more.");
}

EXERCISE_TEST(Rope, OfOneLinkIsItsTwoEnds) {
  const Net net = rope(Vec3(1, 0, 2), Vec3(1, 0, -1), 1, 5);
  if (!has_its_parts(net, 1)) return;
  const std::string whole = "This is all of the link's mass. For a single link, too, each end has a half.",
                    halves = "Each end has half the mass of the only link.";
  expect_near_vector("first point [m]", "Eq. (6.10)", net.x[0], Vec3(1, 0, 2), roundings(8, 2));
  expect_near_vector("last point [m]", "Eq. (6.10)", net.x[1], Vec3(1, 0, -1), roundings(8, 2));
  expect_near("mass of the first point, of 5 kg [kg]", "Eq. (6.10)", net.mass[0], 2.5, roundings(8, 5),
              {{5, whole}}, halves);
  expect_near("mass of the last point, of 5 kg [kg]", "Eq. (6.10)", net.mass[1], 2.5, roundings(8, 5),
              {{5, whole}}, halves);
  expect_near("length of the link [m]", "Eq. (6.10)", net.links[0].length, 3, roundings(8, 3));
}

// λ of the links of a hanging net, from zero, with Σ = 0 and a step of h; sweeps from the first row to the last.
struct Hanging {
  static constexpr double h = 0.01;
  std::vector<Row<3>> rows;
  std::vector<Twist<3>> V;

  Hanging(const Net& net, bool from_below) {
    Points points;
    for (std::size_t k = 0; k < net.x.size(); ++k) points.add(net.x[k], k == 0 ? 0 : 1 / net.mass[k]);
    std::vector<Constraint<3>> constraints;
    for (const Link& link : net.links)
      constraints.push_back(distance_constraint<3>(points.at(link.i), points.at(link.j), link.length,
                                                   {.a = 0, .b = 1, .Sigma = 0}));
    if (from_below) std::reverse(constraints.begin(), constraints.end());
    rows = rows_of(constraints, points.motion(h));
    V.assign(points.x.size(), Twist<3>::Zero());
  }
};

EXERCISE_TEST(Rope, CarriesWhatHangsBelowTheMiddleOfEachLink) {
  const int links = 8;
  const double mass = 4, weight = mass * gravity;
  const Net net = rope(Vec3::Zero(), Vec3(0, 0, -2), links, mass);
  if (!has_its_parts(net, links)) return;
  Hanging hanging(net, false);
  solve(hanging.rows, hanging.V, {.max_sweeps = 100000, .tolerance = 1e-15});
  for (int i = 1; i <= links && !::testing::Test::HasFailure(); ++i)
    expect_near(
        "tension -λ/h of link " + std::to_string(i) + " of 8, of a rope of 4 kg [N]", "Eq. (6.7), (6.10)",
        -hanging.rows[static_cast<std::size_t>(i - 1)].lambda / Hanging::h, weight * (links - i + 0.5) / links,
        {1e-9, "1e-15 m/s that a sweep may still change, times 4 N²/π² sweeps of 1/2 kg, over h"},
        {{weight * (links - i + 1) / links, "Half a link too heavy: the lower end has half a link's mass."},
         {weight * (links - i + 1) / (links + 1),
          "The mass is divided among the points. It belongs to the "
          "links, half on either end."}},
        "A link carries half of its own mass and all links below it.");
}

// The rate of Gauss-Seidel on a tridiagonal S is the square of Jacobi's, and that is the largest eigenvalue of
// 1 - D^-1/2 S D^-1/2.
double exact_rate(int links, double m, double M) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(links, links);
  for (Eigen::Index k = 0; k < links; ++k) {
    S(k, k) = (k > 0 ? 1 / m : 0) + 1 / (k + 1 < links ? m : M);
    if (k > 0) S(k - 1, k) = S(k, k - 1) = -1 / m;
  }
  const Eigen::VectorXd scale = S.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd jacobi =
      Eigen::MatrixXd::Identity(links, links) - Eigen::MatrixXd(scale.asDiagonal() * S * scale.asDiagonal());
  const double largest = eigenvalues(jacobi).maxCoeff();
  return largest * largest;
}

struct Count {
  double sweeps;
  double error;  // of λ after the last sweep, over the largest λ
  double rate;   // that error over the one before the last sweep
};

// Sweeps until the error is `epsilon`, for a rope whose links weigh 1 kg, hung by its first point, with a load of
// M kg in place of the last.
Count sweeps_to_hang(Net net, double M, double epsilon, bool from_below, int at_most) {
  net.mass.back() = M;
  Hanging hanging(net, from_below);
  const int links = static_cast<int>(net.links.size());
  const double top = (M + links - 1) * gravity * Hanging::h;
  double error = 1, before = 1;
  int sweeps = 0;
  while (!(error <= epsilon) && sweeps < at_most) {
    solve(hanging.rows, hanging.V, {.max_sweeps = 1, .tolerance = 0});
    ++sweeps;
    before = error;
    error = 0;
    for (int i = 1; i <= links; ++i) {
      const auto row = static_cast<std::size_t>(from_below ? links - i : i - 1);
      const double exact = -(M + links - i) * gravity * Hanging::h;  // Eq. (6.7), (6.8)
      error = larger(error, std::abs(hanging.rows[row].lambda - exact) / top);
    }
  }
  return {static_cast<double>(sweeps), error, error / before};
}

// Checks that it converged within twice the sweeps of Eq. (6.12).
bool hangs(const Count& count, double epsilon, const std::string& of) {
  expect_at_most(
      "error of λ after " + show(count.sweeps) + " sweeps," + of, "Eq. (6.8), (6.12)", count.error, epsilon,
      "twice as many sweeps as it takes",
      "It converges to other tensions than (M + (N - i) m) g, or more slowly. Is a point as heavy as a link, "
      "and is each joined to the next?");
  return !::testing::Test::HasFailure();
}

std::string wire_text(int links, double M, bool from_below) {
  return " for " + std::to_string(links) + " links of 1 kg and " + show(M) + " kg at the end, from the " +
         (from_below ? "bottom up" : "top down");
}

EXERCISE_TEST(Rope, NeedsSweepsLikeTheSquareOfItsLinks) {
  const double epsilon = 1e-6, pi = std::numbers::pi;
  for (const int links : {10, 20, 40}) {
    const Net net = rope(Vec3::Zero(), Vec3(0, 0, -1), links, links);
    if (!has_its_parts(net, links)) return;
    // The eigenvectors of Jacobi's matrix are λ_i = cos((i - 1) θ) with cos N θ = 0: its rate is cos π/(2N).
    const double rho = std::pow(std::cos(pi / (2 * links)), 2);
    // T falls linearly to the load. At the top, 8/π² of this is in the slowest of these modes.
    const double predicted = std::log(8 / (pi * pi) / epsilon) / std::log(1 / rho);
    const double lesson = 5.6 * links * links;
    for (const bool from_below : {false, true}) {
      const std::string of = wire_text(links, 1, from_below);
      const Count count = sweeps_to_hang(net, 1, epsilon, from_below, static_cast<int>(2 * lesson));
      if (!hangs(count, epsilon, of)) return;
      expect_near("error of λ after the last sweep, over that before it," + of, "Eq. (6.12)", count.rate, rho,
                  {1e-9, "roundings of λ over errors of 1e-6"});
      expect_near("sweeps to an error of 1e-6" + of, "Eq. (6.12)", count.sweeps, predicted,
                  {3, "rounded up, and a term of 1/N² beside 8/π² is 0.4 of a sweep"});
      expect_near("sweeps to an error of 1e-6, over 5.6 N²," + of, "Eq. (6.12)", count.sweeps / lesson, 1,
                  {0.025, "ln(π²/8)/ln(1e6) = 0.015, and as much again for the two digits of 5.6 and 1/N²"});
      if (::testing::Test::HasFailure()) return;
    }
  }
}

EXERCISE_TEST(Rope, NeedsSweepsLikeTheRatioOfTheLoad) {
  const double epsilon = 1e-6;
  for (const auto& [links, M] : std::vector<std::pair<int, double>>{{2, 200}, {5, 200}, {4, 1000}}) {
    const Net net = rope(Vec3::Zero(), Vec3(0, 0, -1), links, links);
    if (!has_its_parts(net, links)) return;
    const double lesson = (links - 1) * M * std::log(1 / epsilon);
    for (const bool from_below : {false, true}) {
      const std::string of = wire_text(links, M, from_below);
      const Count count = sweeps_to_hang(net, M, epsilon, from_below, static_cast<int>(2 * lesson));
      if (!hangs(count, epsilon, of)) return;
      expect_near("error of λ after the last sweep, over that before it," + of, "Eq. (6.12)", count.rate,
                  exact_rate(links, 1, M), {1e-9, "roundings of λ over errors of 1e-6"});
      expect_near("sweeps to an error of 1e-6, over (N - 1) (M/m) ln(1/ε)," + of, "Eq. (6.12)",
                  count.sweeps / lesson, 1, {links / M, "the next term, of the order of N m/M"});
      if (::testing::Test::HasFailure()) return;
    }
  }
}

EXERCISE_TEST(Rope, RejectsWhatIsNoRope) {
  const Vec3 from(0, 0, 1), to(0, 0, -1);
  rope(from, to, 3, 1);
  for (const int links : {0, -3})
    expect_rejects(
        "links = " + std::to_string(links), "links", [&] { rope(from, to, links, 1); },
        "See reject in require.hpp. A count has no helper of its own.");
  for (const double mass : {0.0, -1.0, std::nan(""), HUGE_VAL})
    expect_rejects(
        "mass = " + show(mass), "mass", [&] { rope(from, to, 3, mass); },
        "See require_positive in require.hpp.");
  for (const double x : {std::nan(""), HUGE_VAL}) {
    const Vec3 nowhere(0, x, 0);
    const std::string clue = "See require_all_finite in require.hpp; before anything is calculated with it.";
    expect_rejects(
        "from = (0, " + show(x) + ", 0)", "from", [&] { rope(nowhere, to, 3, 1); }, clue);
    expect_rejects(
        "to = (0, " + show(x) + ", 0)", "to", [&] { rope(from, nowhere, 3, 1); }, clue);
  }
  expect_rejects(
      "both ends at the same place", "length", [&] { rope(to, to, 3, 1); },
      "See require_positive in require.hpp. A rope without length has links without direction.");
}

}  // namespace
