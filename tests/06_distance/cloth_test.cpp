// A cloth: places and masses of its points, its links, and the load on its supports.
#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <utility>

#include "exercise_test.hpp"
#include "regions.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Cloth, "6.4 cloth");

/// More cells one way than the other, and u and v at any angle but a small one.
struct ClothInput {
  Random random;
  Vec3 corner = random.vector(2);
  Vec3 u = random.vector_of_length(0.5, 2), across = u.cross(random.unit_vector());
  Vec3 v = across + random.uniform(-0.5, 0.5) * u;
  int cells_u = random.integer(2, 5), cells_v = cells_u + random.integer(1, 3);
  double mass = random.uniform(0.5, 5);

  explicit ClothInput(bool exchanged = false, const Random& stream = Random()) : random(stream) {
    if (exchanged) std::swap(cells_u, cells_v);
    tell();
  }

  /// Returns the next random cloth: of one cell or more, heavy or light, long or square.
  static ClothInput any(const Random& stream) {
    ClothInput in(false, stream);
    in.cells_u = in.random.integer(0, 9) ? in.random.integer(1, 4) : in.random.integer(300, 400);
    in.cells_v = in.random.integer(0, 9) ? in.random.integer(1, 4) : in.random.integer(300, 400);
    if (in.cells_u > 4 && in.cells_v > 4) in.cells_v = 2;
    in.mass = in.random.log_uniform(1e-3, 1e3);
    in.u *= in.random.log_uniform(1e-2, 1e2);
    in.tell();
    return in;
  }

  void tell() const {
    given() = "given a cloth of " + std::to_string(cells_u) + " × " + std::to_string(cells_v) + " cells and " +
              show(mass) + " kg, corner = " + show(corner) + ", u = " + show(u) + ", v = " + show(v) + " m";
  }
  Net net() const { return cloth(corner, u, v, cells_u, cells_v, mass); }
  int points() const { return (cells_u + 1) * (cells_v + 1); }
  int index(int a, int b) const { return a + b * (cells_u + 1); }
  int sides() const { return cells_u * (cells_v + 1) + (cells_u + 1) * cells_v; }
  static std::string name(int a, int b) { return "(" + std::to_string(a) + ", " + std::to_string(b) + ")"; }
};

bool has_its_points(const Net& net, const ClothInput& in) {
  const double cells = in.cells_u * in.cells_v;
  expect_near("points of the cloth", "Eq. (6.11)", static_cast<double>(net.x.size()), in.points(),
              {0, "a count"},
              {{cells, "This is the number of cells. A side of n cells has n + 1 points."},
               {4 * cells, "This is four points for each cell. Neighbours share their corners."},
               {cells + in.cells_v, "The last row along v is missing: b goes from 0 to cells_v."},
               {cells + in.cells_u, "The last point of each row is missing: a goes from 0 to cells_u."}},
              "(cells_u + 1)(cells_v + 1) points.");
  expect_near("masses of the cloth", "Eq. (6.11)", static_cast<double>(net.mass.size()), in.points(),
              {0, "a count"}, {}, "A mass for each point.");
  return !::testing::Test::HasFailure();
}

EXERCISE_TEST(Cloth, LiesFlat) {
  for (const bool exchanged : {false, true}) {
    const ClothInput in(exchanged);
    const Net net = in.net();
    if (!has_its_points(net, in)) return;
    const auto place = [&](double a, double b) -> Vec3 {
      return in.corner + a / in.cells_u * in.u + b / in.cells_v * in.v;
    };
    for (int b = 0; b <= in.cells_v; ++b)
      for (int a = 0; a <= in.cells_u; ++a) {
        const int k = in.index(a, b), other_a = k / (in.cells_v + 1), other_b = k % (in.cells_v + 1);
        const int truncated_a = a < in.cells_u ? 0 : a, truncated_b = b < in.cells_v ? 0 : b;
        expect_near_vector(
            "point " + in.name(a, b) + ", index " + std::to_string(k) + " [m]", "Eq. (6.11)",
            net.x[static_cast<std::size_t>(k)], place(a, b), roundings(32, 10),
            {{place(truncated_a, truncated_b),
              "a/cells_u of two integers loses the fraction, and is 0 before the far side: divide as double."},
             {place(other_a, other_b),
              "The index is a + b (cells_u + 1): a, along u, runs fastest. Here b does."},
             {in.corner + a * in.u + b * in.v, "u and v are whole sides: divide by the number of cells."},
             {place(a, b) - in.corner, "The corner is missing: this cloth begins at the origin."},
             {in.corner + a * in.u / in.cells_v + b * in.v / in.cells_u, "cells_u and cells_v are exchanged."},
             {in.corner + a * in.u / (in.cells_u + 1) + b * in.v / (in.cells_v + 1),
              "The side is divided among the cells, not among the points."},
             {in.corner + a * in.v / in.cells_u + b * in.u / in.cells_v, "a counts along u and b along v."}},
            "corner + (a/cells_u) u + (b/cells_v) v.");
        if (::testing::Test::HasFailure()) return;
      }
  }
}

EXERCISE_TEST(Cloth, PutsAQuarterOfEachCellOnEachCorner) {
  const ClothInput in;
  const Net net = in.net();
  if (!has_its_points(net, in)) return;
  const double cell = in.mass / in.cells_u / in.cells_v;
  const Eigen::VectorXd got = Eigen::VectorXd::Map(net.mass.data(), in.points());
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(in.points());
  Eigen::VectorXd cells_beside(in.points()), near_corners(in.points()), whole_cells(in.points());
  Eigen::VectorXd far_inside(in.points()), near_inside(in.points()), like_hem(in.points());
  for (int b = 0; b <= in.cells_v; ++b)
    for (int a = 0; a <= in.cells_u; ++a) {
      cells_beside[in.index(a, b)] = (a == 0 || a == in.cells_u ? 1 : 2) * (b == 0 || b == in.cells_v ? 1 : 2);
      near_corners[in.index(a, b)] = a < in.cells_u && b < in.cells_v ? 1 : 0;
      const bool inside = 0 < a && a < in.cells_u && 0 < b && b < in.cells_v;
      whole_cells[in.index(a, b)] = inside ? 1 : 0;
      like_hem[in.index(a, b)] = inside ? 4 : 2;
      far_inside[in.index(a, b)] = (a == 0 ? 1 : 2) * (b == 0 ? 1 : 2);
      near_inside[in.index(a, b)] = (a == in.cells_u ? 1 : 2) * (b == in.cells_v ? 1 : 2);
    }
  // Returns the cloth's result with the index `a_adds` a + `b_adds` b for (a, b).
  const auto misplaced = [&](int a_adds, int b_adds) {
    Eigen::VectorXd mass = 0 * ones;
    for (int b = 0; b < in.cells_v; ++b)
      for (int a = 0; a < in.cells_u; ++a)
        for (const int corner : {0, a_adds, b_adds, a_adds + b_adds})
          mass[a * a_adds + b * b_adds + corner] += cell / 4;
    return mass;
  };
  const double area = in.u.cross(in.v).norm();
  const bool all_equal = (got.array() - got[0]).abs().maxCoeff() <= 1e-12 * in.mass;
  const auto distance = [](const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
    return (one - other).norm();
  };
  const std::string clue = explain<Eigen::VectorXd>(
      got,
      {{0 * ones, "All masses are 0: in C++ 1/n and 1/4 of integers are 0. Divide doubles."},
       {cell * whole_cells,
        "1/4 and 2/4 of integers are 0: only points inside have any mass. Divide as double."},
       {in.mass * ones, "Every point has the whole cloth's mass."},
       {in.mass / 4 * cells_beside, "Every cell has the whole cloth's mass. Divide it by the number of cells."},
       {area * cell / 4 * cells_beside,
        "This takes `mass` for the mass of 1 m². It is the mass of the whole cloth."},
       {cell / 4 * far_inside,
        "The far edge, at a = cells_u and b = cells_v, is as heavy as the inside. No cells lie beyond it."},
       {cell / 4 * near_inside,
        "The near edge, at a = 0 and b = 0, is as heavy as the inside. No cells lie before it."},
       {misplaced(1, in.cells_u),
        "b -> b + 1 adds cells_u + 1 to the index, the number of points in a row. Here it adds cells_u."},
       {misplaced(in.cells_v + 1, 1),
        "The index is a + b (cells_u + 1): a, along u, runs fastest. Here b does."},
       {cell / 4 * like_hem,
        "The corners are as heavy as the edges. A corner has one cell, an edge point two."},
       {in.mass / in.points() * ones,
        "The mass is divided evenly among the points. It belongs to the cells, and fewer "
        "of them meet at an edge."},
       {cell * ones, "Every point is as heavy as one inside. At an edge fewer cells meet."},
       {cell / 4 * ones, "Every point has one quarter. Where several cells meet, each adds a quarter."},
       {cell * cells_beside, "All of each cell's mass is on each of its corners: four times the cloth."},
       {cell / 2 * cells_beside, "Half of each cell's mass is on each of its four corners: twice the cloth."},
       {cell * near_corners, "All of each cell's mass is on one of its corners."}},
      distance, 1e-9 * in.mass,
      all_equal ? "All points are equally heavy. A corner has one cell, an edge point two, an inner point four."
                : "A quarter of the mass of each cell on each of its corners.");
  for (int b = 0; b <= in.cells_v; ++b)
    for (int a = 0; a <= in.cells_u; ++a) {
      const int k = in.index(a, b), beside = static_cast<int>(cells_beside[k]);
      expect_near("mass of point " + in.name(a, b) + ", a corner of " + std::to_string(beside) +
                      (beside == 1 ? " cell [kg]" : " cells [kg]"),
                  "Eq. (6.11)", got[k], beside * cell / 4, roundings(16, in.mass), {}, clue);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(Cloth, KeepsItsMassAndCentre) {
  const ClothInput in;
  const Net net = in.net();
  if (!has_its_points(net, in)) return;
  double mass = 0;
  Vec3 moment = Vec3::Zero();
  for (std::size_t k = 0; k < net.x.size(); ++k) {
    mass += net.mass[k];
    moment += net.mass[k] * net.x[k];
  }
  expect_near("mass of all points [kg]", "Eq. (6.11)", mass, in.mass, roundings(200, in.mass), {},
              "The points weigh as much as the cloth: each quarter of a cell counts once.");
  expect_near_vector("centre of mass [m]", "Eq. (6.11)", Vec3(moment / mass),
                     Vec3(in.corner + (in.u + in.v) / 2), roundings(200, 10), {},
                     "The middle of the cloth: no edge weighs more than the opposite one.");
}

// Returns true if the index may belong to a neighbour, for this number of points in a row.
bool are_neighbours(const Link& link, int per_row) {
  const auto [low, high] = std::minmax(link.i, link.j);
  return high - low == per_row || (high - low == 1 && high % per_row != 0);
}

// Returns true if every link joins neighbours. A wrong index function joins other points, in the right number.
bool joins_neighbours(const Net& net, const ClothInput& in) {
  const int per_row = in.cells_u + 1;
  const auto inside = [&](const Link& link) {
    return 0 <= std::min(link.i, link.j) && std::max(link.i, link.j) < in.points();
  };
  const auto wrong = [&](const Link& link) { return !inside(link) || !are_neighbours(link, per_row); };
  const auto leaps = [&](const Link& link) { return wrong(link) && std::abs(link.j - link.i) != 1; };
  auto found = std::find_if(net.links.begin(), net.links.end(), leaps);
  if (found == net.links.end()) found = std::find_if(net.links.begin(), net.links.end(), wrong);
  if (found == net.links.end()) return true;

  const bool transposed = std::all_of(net.links.begin(), net.links.end(), [&](const Link& link) {
    return inside(link) && are_neighbours(link, in.cells_v + 1);
  });
  const int added = std::abs(found->j - found->i);
  const bool run_on = added == 1 && inside(*found);
  const std::string same_as = added == in.cells_v + 1 ? ", cells_v + 1"
                              : added == in.cells_u   ? ", cells_u"
                              : added == in.cells_v   ? ", cells_v"
                                                      : "";
  const auto name = [&](int k) {
    return "point " + std::to_string(k) +
           (0 <= k && k < in.points() ? ", " + in.name(k % per_row, k / per_row) : ", which does not exist");
  };
  expect_true(
      "a link from " + name(found->i) + ", to " + name(found->j) + ", joins neighbours", "Eq. (6.11)", false,
      transposed   ? "The index is a + b (cells_u + 1): a, along u, runs fastest. Here b does."
      : added == 0 ? "A link joins two different points."
      : run_on     ? "Here the last point of a row is joined to the first of the next row: leave that link out."
      : added == 1 ? "Such points do not exist."
                   : "b -> b + 1 adds cells_u + 1 to the index, the number of points in a row. Here it adds " +
                         std::to_string(added) + same_as + ".");
  return false;
}

EXERCISE_TEST(Cloth, JoinsTheCornersOfEachCellAlongItsSides) {
  for (const bool exchanged : {false, true}) {
    const ClothInput in(exchanged);
    const Net net = in.net();
    if (!has_its_points(net, in)) return;
    const double cells = in.cells_u * in.cells_v;
    expect_near(
        "links of the cloth", "Eq. (6.11)", static_cast<double>(net.links.size()), in.sides(), {0, "a count"},
        {{4 * cells,
          "This is four links for each cell. Two neighbouring cells share a side, which is one link."},
         {2 * cells,
          "This is two links for each cell. The last row and column have one more side, at the far "
          "edges."},
         {2 * cells + in.cells_u, "The far edge at b = cells_v is there; the one at a = cells_u is missing."},
         {2 * cells + in.cells_v, "The far edge at a = cells_u is there; the one at b = cells_v is missing."},
         {in.sides() + cells, "This is one more for each cell. Diagonals are not links."},
         {in.sides() + 2 * cells, "This is two more for each cell. Diagonals are not links."},
         {in.sides() + in.cells_v + 0.0,
          "Here the last point of a row is joined to the first of the next row: leave that link out."},
         {2.0 * in.sides(), "Each side has two links: one is enough."}},
        "cells_u (cells_v + 1) along u, (cells_u + 1) cells_v along v.");
    if (::testing::Test::HasFailure() || !joins_neighbours(net, in)) return;
    std::map<std::pair<int, int>, int> count;
    for (const Link& link : net.links) ++count[std::minmax(link.i, link.j)];
    const auto expect_once = [&](int a, int b, int next_a, int next_b) {
      const int found = count[{in.index(a, b), in.index(next_a, next_b)}];
      expect_true("one link from point " + in.name(a, b) + " to " + in.name(next_a, next_b) + "; here " +
                      std::to_string(found),
                  "Eq. (6.11)", found == 1,
                  found > 1 ? "Two cells that meet share a side." : "Every side of every cell is a link.");
    };
    for (int b = 0; b <= in.cells_v && !::testing::Test::HasFailure(); ++b)
      for (int a = 0; a <= in.cells_u && !::testing::Test::HasFailure(); ++a) {
        if (a > 0) expect_once(a - 1, b, a, b);
        if (b > 0) expect_once(a, b - 1, a, b);
      }
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(Cloth, IsOfAnyCellsMassAndSize) {
  Regions regions({"one cell", "one cell wide along u", "one cell wide along v", "more cells along u",
                   "more cells along v", "as many both ways", "hundreds of cells along u",
                   "hundreds of cells along v", "cells lighter than 10 g", "cells heavier than 10 kg",
                   "u much longer than v", "v much longer than u"});
  ClothInput in;
  while (regions.lack_draws()) {
    in = ClothInput::any(in.random);
    const double cell = in.mass / in.cells_u / in.cells_v, u = in.u.norm(), v = in.v.norm();
    const std::string numbers = given();
    regions.draw({{"one cell", in.cells_u == 1 && in.cells_v == 1},
                  {"one cell wide along u", in.cells_u == 1 && in.cells_v > 1},
                  {"one cell wide along v", in.cells_v == 1 && in.cells_u > 1},
                  {"more cells along u", in.cells_u > in.cells_v},
                  {"more cells along v", in.cells_v > in.cells_u},
                  {"as many both ways", in.cells_u == in.cells_v && in.cells_u > 1},
                  {"hundreds of cells along u", in.cells_u > 255},
                  {"hundreds of cells along v", in.cells_v > 255},
                  {"cells lighter than 10 g", cell < 0.01},
                  {"cells heavier than 10 kg", cell > 10},
                  {"u much longer than v", u > 10 * v},
                  {"v much longer than u", v > 10 * u}});
    given() = numbers + "\n" + given();
    const Net net = in.net();
    if (!has_its_points(net, in)) return;
    const double size = in.corner.norm() + u + v;
    for (int b = 0; b <= in.cells_v; ++b)
      for (int a = 0; a <= in.cells_u && !::testing::Test::HasFailure(); ++a) {
        const auto k = static_cast<std::size_t>(in.index(a, b));
        const int cells = (a == 0 || a == in.cells_u ? 1 : 2) * (b == 0 || b == in.cells_v ? 1 : 2);
        expect_near_vector("point " + in.name(a, b) + " [m]", "Eq. (6.11)", net.x[k],
                           Vec3(in.corner + a * in.u / in.cells_u + b * in.v / in.cells_v), roundings(32, size),
                           {}, "corner + (a/cells_u) u + (b/cells_v) v.");
        expect_near("mass of point " + in.name(a, b) + " [kg]", "Eq. (6.11)", net.mass[k], cells * cell / 4,
                    roundings(32, cell), {}, "A quarter of the mass of each cell on each of its corners.");
      }
    if (::testing::Test::HasFailure()) return;
    expect_near("links of the cloth", "Eq. (6.11)", static_cast<double>(net.links.size()), in.sides(),
                {0, "a count"}, {}, "cells_u (cells_v + 1) along u, (cells_u + 1) cells_v along v.");
    if (!joins_neighbours(net, in)) return;
    for (const Link& link : net.links) {
      const bool along_u = std::abs(link.i - link.j) == 1;
      const double side = along_u ? u : v;
      const int own = along_u ? in.cells_u : in.cells_v, other = along_u ? in.cells_v : in.cells_u;
      const std::string whole = "This is the whole side: divide it by the number of cells along it.";
      const std::string exchanged = "This is the side over the number of cells along the other one";
      expect_near("length of the link from point " + std::to_string(link.i) + " to point " +
                      std::to_string(link.j) + " [m]",
                  "Eq. (6.11)", link.length, side / own, roundings(64, size),
                  {{side, other == 1 ? exchanged + ", which is 1, or the whole side." : whole},
                   {side / other, exchanged + "."}},
                  "The length is the distance of the two points, since the cloth is at rest as it lies.");
    }
  }
}

EXERCISE_TEST(Cloth, IsAtRestAsItLies) {
  const ClothInput in;
  const Net net = in.net();
  if (!has_its_points(net, in)) return;
  const double along_u = in.u.norm() / in.cells_u, along_v = in.v.norm() / in.cells_v;
  for (const Link& link : net.links) {
    const bool sound =
        0 <= link.i && link.i < in.points() && 0 <= link.j && link.j < in.points() && link.i != link.j;
    expect_true("a link from point " + std::to_string(link.i) + " to point " + std::to_string(link.j) + " of " +
                    std::to_string(in.points()),
                "Eq. (6.11)", sound, "A link joins two different points of the cloth.");
    if (!sound) return;
    const double distance =
        (net.x[static_cast<std::size_t>(link.j)] - net.x[static_cast<std::size_t>(link.i)]).norm();
    expect_near("length of the link from point " + std::to_string(link.i) + " to point " +
                    std::to_string(link.j) + " [m]",
                "Eq. (6.11)", link.length, distance, roundings(64, 10),
                {{0, "1/n of two integers is 0: divide doubles."},
                 {in.u.norm(), "This is the whole side, along u."},
                 {in.v.norm(), "This is the whole side, along v."},
                 {along_u, "This is a cell's side along u. The link lies along v."},
                 {along_v, "This is a cell's side along v. The link lies along u."}},
                "The length is the distance of the two points, since the cloth is at rest as it lies.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(Cloth, OfOneCellIsItsFourCorners) {
  const Net net = cloth(Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 3, 0), 1, 1, 8);
  expect_near("points of one cell", "Eq. (6.11)", static_cast<double>(net.x.size()), 4, {0, "a count"});
  expect_near("masses of one cell", "Eq. (6.11)", static_cast<double>(net.mass.size()), 4, {0, "a count"});
  expect_near("links of one cell", "Eq. (6.11)", static_cast<double>(net.links.size()), 4, {0, "a count"},
              {{2, "The far edges are missing."}, {5, "No diagonals."}, {6, "No diagonals."}});
  if (::testing::Test::HasFailure()) return;
  const std::vector<Vec3> corners = {Vec3(1, 0, 0), Vec3(3, 0, 0), Vec3(1, 3, 0), Vec3(3, 3, 0)};
  double around = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    expect_near_vector("point " + std::to_string(k) + " [m]", "Eq. (6.11)", net.x[k], corners[k],
                       roundings(8, 4));
    expect_near("mass of point " + std::to_string(k) + ", of 8 kg [kg]", "Eq. (6.11)", net.mass[k], 2,
                roundings(8, 8));
    around += net.links[k].length;
  }
  expect_near("length of all links of a cell of 2 m × 3 m [m]", "Eq. (6.11)", around, 10, roundings(16, 10));
}

// The cloth hangs by its four corners, which are closer to each other than its sides are long. Air drag brings
// it to rest.
EXERCISE_TEST(Cloth, HangsOnItsCornersWithAllItsWeight) {
  const double h = 1.0 / 60, mass = 0.9;
  const Net net = cloth(Vec3(-0.5, -0.4, 0), Vec3(1, 0, 0), Vec3(0, 0.8, 0), 3, 3, mass);
  const std::vector<std::size_t> corners = {0, 3, 12, 15};
  expect_near("points of a cloth of 3 × 3 cells", "Eq. (6.11)", static_cast<double>(net.x.size()), 16,
              {0, "a count"});
  expect_near("masses of a cloth of 3 × 3 cells", "Eq. (6.11)", static_cast<double>(net.mass.size()), 16,
              {0, "a count"});
  if (::testing::Test::HasFailure()) return;

  Points points{.drag = 8};
  const auto is_corner = [&](int k) {
    return std::find(corners.begin(), corners.end(), static_cast<std::size_t>(k)) != corners.end();
  };
  for (int k = 0; k < 16; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Vec3 sag = is_corner(k) ? Vec3::Zero() : Vec3(0, 0, -0.1);
    points.add(0.8 * net.x[at] + sag, is_corner(k) ? 0 : 1 / net.mass[at]);
  }
  double carried = 0, fastest = 1;
  for (int n = 0; n < 2000 && fastest > 1e-8; ++n) {
    std::vector<Constraint<3>> constraints;
    for (const Link& link : net.links)
      constraints.push_back(distance_constraint<3>(points.at(link.i), points.at(link.j), link.length,
                                                   spook_parameters(h, 1e4, 2)));
    const std::vector<double> lambda = points.step(constraints, h, {.max_sweeps = 50, .tolerance = 1e-12});
    // A support carries its own share of the mass, and the downward pulls of the links that end there.
    carried = 0;
    for (const std::size_t k : corners) carried += net.mass[k] * gravity;
    for (std::size_t k = 0; k < lambda.size(); ++k) {
      if (is_corner(constraints[k].i)) carried -= lambda[k] / h * constraints[k].Gi.z();
      if (is_corner(constraints[k].j)) carried -= lambda[k] / h * constraints[k].Gj.z();
    }
    fastest = points.fastest();
  }
  expect_at_most("largest speed of a point after 2000 steps of 1/60 s with drag [m/s]", "Eq. (6.14)", fastest,
                 1e-8, "at rest");
  expect_near(
      "force on the four supports of a cloth of 0.9 kg [N]", "Eq. (6.14)", carried, mass * gravity,
      {1e-6, "0.9 kg times 1e-8 m/s over h, what the points may still gain or lose in a step"},
      {{mass * gravity * 4, "Four times its weight: all of each cell's mass is on each of its corners."},
       {mass * gravity * 16, "Sixteen times its weight: the whole cloth's mass is on each of its points."}},
      "At rest the supports carry the weight of the cloth, with that of their own points.");
}

EXERCISE_TEST(Cloth, RejectsWhatIsNoCloth) {
  const Vec3 corner(1, 2, 3), u(1, 0, 0), v(0, 2, 0);
  cloth(corner, u, v, 2, 3, 1);
  for (const int cells : {0, -3}) {
    const std::string clue = "See reject in require.hpp. A count has no helper of its own.";
    expect_rejects(
        "cells_u = " + std::to_string(cells), "cells_u", [&] { cloth(corner, u, v, cells, 3, 1); }, clue);
    expect_rejects(
        "cells_v = " + std::to_string(cells), "cells_v", [&] { cloth(corner, u, v, 2, cells, 1); }, clue);
  }
  for (const double mass : {0.0, -1.0, std::nan(""), HUGE_VAL})
    expect_rejects(
        "mass = " + show(mass), "mass", [&] { cloth(corner, u, v, 2, 3, mass); },
        "See require_positive in require.hpp.");
  for (const double x : {std::nan(""), HUGE_VAL}) {
    const Vec3 nowhere(0, x, 0);
    const std::string text = " = (0, " + show(x) + ", 0)";
    const std::string clue = "See require_all_finite in require.hpp; before anything is calculated with it.";
    expect_rejects(
        "corner" + text, "corner", [&] { cloth(nowhere, u, v, 2, 3, 1); }, clue);
    expect_rejects(
        "u" + text, "u", [&] { cloth(corner, nowhere, v, 2, 3, 1); }, clue);
    expect_rejects(
        "v" + text, "v", [&] { cloth(corner, u, nowhere, 2, 3, 1); }, clue);
  }
  const std::string clue =
      "See require_positive in require.hpp. Without an area |u × v| it is a line, or a point.";
  expect_rejects(
      "u and v along each other", "area", [&] { cloth(corner, u, 2 * u, 2, 3, 1); }, clue);
  expect_rejects(
      "u = 0", "area", [&] { cloth(corner, Vec3::Zero(), v, 2, 3, 1); }, clue);
}

}  // namespace
