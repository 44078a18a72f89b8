// Gain by blocks, colours, lanes and threads, as counts; and, in full size, as times.
//
//   rod       a rod with slope tan 2 that is dragged at 3 m/s, (9.8) with ρ = -3/4 μ: sweeps to 1e-9 m/s
//   sweeps    to 1e-6 m/s on the first step of contact problems: row by row on the cone, x = 0; as blocks, 1; row by
//             row, each contact three times before the next, 3
//   waiting   longest chain of updates in a sweep, each of which depends on the one before. An update depends on the
//             last update that wrote a velocity of its two bodies
//   colours   number of colours, largest number of pairs on a body, filled fraction of the lanes, and the possible
//             speed-up by threads, from the largest share of each colour
//   time      of a row update [ns], in order, in packs, and in packs on two threads; the time of its bytes from memory,
//             and of its operations; the lower quartile
#include <cmath>
#include <map>
#include <numeric>

#include "14_fast_rows/fast_rows.hpp"
#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

constexpr double mu = 0.5, h = 1.0 / 60, side = 0.2;

World<6> on_a_floor(const Solver<6>& solver, double friction = mu) {
  World<6> world({.k = 1e6, .friction = friction, .solver = solver, .solver_limits = {.max_sweeps = 1}});
  world.add_plane(Vec3::UnitZ(), 0);
  return world;
}

/// Spheres at slightly less than the touching distance, so that all contacts are found.
World<6> grid(int across, int high, bool boxes, const Solver<6>& solver, double friction = mu) {
  World<6> world = on_a_floor(solver, friction);
  const double apart = 0.995 * side;
  for (int z = 0; z < high; ++z)
    for (int x = 0; x < across; ++x)
      for (int y = 0; y < across; ++y) {
        const Vec3 at(x * apart, y * apart, (z + 0.5) * apart), v(std::sin(7.0 * x + z), std::cos(5.0 * y), 0);
        if (boxes)
          world.add({.x = at,
                     .v = v,
                     .mass = 1,
                     .principal = Vec3::Constant(side * side / 6),
                     .half_sides = Vec3::Constant(side / 2)});
        else
          world.add({.x = at, .v = v, .mass = 1, .radius = side / 2});
      }
  world.step(h);
  return world;
}

/// Thin boxes of 2 m that stand on an edge and slide.
World<6> leaning_boxes(const Solver<6>& solver) {
  World<6> world = on_a_floor(solver, 1);
  for (int k = 0; k < 30; ++k) {
    const double lean = 0.9 + 0.3 * std::sin(3.0 * k);
    world.add({.x = Vec3(2 * k, 0, std::cos(lean) + 0.05 * std::sin(lean) - 0.001),
               .v = Vec3(3 * std::sin(5.0 * k), std::cos(7.0 * k), -1),
               .mass = 1,
               .q = Quat(Eigen::AngleAxisd(lean, Vec3::UnitY())),
               .principal = Vec3(1 / 3.0, 1 / 3.0, 0.01),
               .half_sides = Vec3(0.05, 0.05, 1)});
  }
  world.step(h);
  return world;
}

/// Builds three rows per contact, starting from λ = 0.
struct OnCones {
  std::vector<spook::Row<6>> rows;
  std::vector<FrictionContact> contacts;
  std::vector<Twist<6>> V;

  OnCones(const std::vector<spook::Row<6>>& from, std::size_t bodies, double friction)
      : rows(from), V(bodies, Twist<6>::Zero()) {
    for (spook::Row<6>& row : rows) row.lambda = 0;
    for (std::size_t k = 0; k < rows.size(); k += 3) contacts.push_back({.normal = k, .mu = friction});
  }
  double by_rows(const StopRule& stop) {
    return static_cast<double>(cone_solve(contacts, rows, V, stop).history.size());
  }
  double by_blocks(const StopRule& stop) {
    return sweeps_of(stop, [&](const FrictionContact& contact) { return update_contact(contact, rows, V); });
  }
  /// Sweeps row by row, with each contact's three rows updated so often before the next contact; returns the change of
  /// the first update.
  double by_repeats(int repeats, const StopRule& stop) {
    return sweeps_of(stop, [&](const FrictionContact& contact) {
      double first = 0;
      for (int n = 0; n < repeats; ++n) {
        spook::Row<6>& normal = rows[contact.normal];
        const double pressed = normal.diagonal * std::abs(update_row(normal, V)),
                     rubbed = update_friction(contact, rows, V);
        if (n == 0) first = std::max(pressed, rubbed);
      }
      return first;
    });
  }

 private:
  template <class Update>
  double sweeps_of(const StopRule& stop, const Update& update) {
    int sweeps = 0;
    for (double largest = infinity; sweeps < stop.max_sweeps && !(largest <= stop.tolerance); ++sweeps) {
      largest = 0;
      for (const FrictionContact& contact : contacts) largest = std::max(largest, update(contact));
    }
    return sweeps;
  }
};

OnCones dragged_rod(double friction) {
  const Vec3 along = Vec3(1, 0, 2) / std::sqrt(5), zero = Vec3::Zero();
  Motion<6> motion{
      .inverse_mass = {{}, {.linear = 1, .angular = 3 * (Mat3::Identity() - along * along.transpose())}},
      .W = {Twist<6>::Zero(), (Twist<6>() << 3, 0, -0.16, zero).finished()},
      .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  std::vector<spook::Row<6>> rows;
  for (const Vec3& n : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const ContactJacobian G = contact_jacobian({.i = 0, .j = 1, .n = n, .gap = 0, .r_i = zero, .r_j = -along});
    rows.push_back(make_row<6>(
        {.i = 0, .j = 1, .Gi = G.Gi, .Gj = G.Gj, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = 0}}, motion));
  }
  return {rows, 2, friction};
}

/// Returns the longest chain of updates, each of which depends on the one before.
int chain(const std::vector<int>& order, const std::vector<spook::Row<6>>& rows, std::size_t bodies) {
  std::vector<int> ready(bodies, 0);
  int longest = 0;
  for (const int k : order) {
    const spook::Row<6>& row = rows[k];
    const bool i = !row.MinvGi.isZero(0), j = !row.MinvGj.isZero(0);
    const int now = 1 + std::max(i ? ready[row.i] : 0, j ? ready[row.j] : 0);
    if (i) ready[row.i] = now;
    if (j) ready[row.j] = now;
    longest = std::max(longest, now);
  }
  return longest;
}

std::vector<Row> counts(const std::string& name, const World<6>& world) {
  const std::vector<spook::Row<6>>& rows = world.rows();
  const std::vector<Colour<6>> colours = packed(rows, world.bodies().size());
  std::vector<int> given(rows.size()), by_colour;
  std::iota(given.begin(), given.end(), 0);
  std::map<int, std::map<int, int>> pairs;
  double lanes = 0, one = 0, shares[3] = {0, 0, 0};
  const int threads[3] = {2, 4, 8};
  for (const Colour<6>& colour : colours) {
    double all = 0;
    std::vector<double> before = {0};
    for (const Pack<6>& pack : colour) {
      for (int lane = 0; lane < lane_count; ++lane) {
        if (pack.first[lane] < 0) continue;
        ++pairs[pack.i[lane]][pack.j[lane]], ++pairs[pack.j[lane]][pack.i[lane]];
        for (std::size_t m = 0; m < pack.rows.size(); ++m)
          by_colour.push_back(pack.first[lane] + static_cast<int>(m));
      }
      all += static_cast<double>(pack.rows.size());
      before.push_back(all);
    }
    lanes += lane_count * all;
    one += all;
    for (int t = 0; t < 3; ++t) {
      double largest = 0;
      for (int k = 0; k < threads[t]; ++k)
        largest = std::max(
            largest, before[colour.size() * (k + 1) / threads[t]] - before[colour.size() * k / threads[t]]);
      shares[t] += largest;
    }
  }
  int most = 0;
  for (const auto& [body, others] : pairs) {
    int on = 0;
    for (const auto& [other, count] : others) on += count;
    if (body >= 0) most = std::max(most, on);
  }
  const double count = static_cast<double>(rows.size());
  std::vector<Row> table = {
      {"rows", name, 0.0, count},
      {"in order", name, 0.0, double(chain(given, rows, world.bodies().size()))},
      {"in turn", name, 0.0, double(chain(interleaved_order(rows.size()), rows, world.bodies().size()))},
      {"by colour", name, 0.0, double(chain(by_colour, rows, world.bodies().size()))},
      {"colours", name, 0.0, double(colours.size())},
      {"most pairs", name, 0.0, double(most)},
      {"filled", name, 0.0, count / lanes}};
  for (int t = 0; t < 3; ++t) table.push_back({"threads", name, double(threads[t]), one / shares[t]});
  return table;
}

/// Operations of (14.9) for a row in a pack, and its bytes from memory if nothing is in the cache.
constexpr double operations = 24 + 7 + 24, bytes = sizeof(LaneRows<6>) / lane_count;

std::vector<Row> times(int across, int high) {
  const World<6> world = grid(across, high, false, gauss_seidel<6>());
  std::vector<spook::Row<6>> rows = world.rows();
  for (spook::Row<6>& row : rows) row.lambda = 0;
  std::vector<Twist<6>> V(world.bodies().size(), Twist<6>::Zero());
  std::vector<Colour<6>> colours = packed(rows, V.size());
  const double n = double(rows.size()), sweeps = std::max(4.0, std::floor(1e6 / n));
  const StopRule stop{.max_sweeps = static_cast<int>(sweeps)};
  const auto in_packs = [&](int threads) {
    return time_each(sweeps * n, 15, [&] { solve_in_colours(colours, V, stop, threads); }).low;
  };
  return {{"time", "in order", n, time_each(sweeps * n, 15, [&] { solve(rows, V, stop); }).low},
          {"time", "in packs", n, in_packs(1)},
          {"time", "two threads", n, in_packs(2)}};
}

/// Measures the machine's limits: reading from memory, and arithmetic in registers [ns per row].
std::vector<Row> floors() {
  const std::vector<double> large(1 << 24, 1.0);
  double sink = 0;
  const double a_byte = time_each(8.0 * double(large.size()), 40, [&] {
                          Eigen::Array<double, 32, 1> sum = Eigen::Array<double, 32, 1>::Zero();
                          for (std::size_t k = 0; k < large.size(); k += 32)
                            sum += Eigen::Map<const Eigen::Array<double, 32, 1>>(&large[k]);
                          sink += sum.sum();
                        }).low;
  const double an_operation = time_each(2e6 * 16, 40, [&] {
                                Eigen::Array<double, 16, 1> x = Eigen::Array<double, 16, 1>::Constant(sink > 0);
                                for (int k = 0; k < 1'000'000; ++k) x = x * 0.999 + 0.001;
                                sink += x.sum();
                              }).low;
  return {{"time", "memory", 0.0, bytes * a_byte},
          {"time", "operations", 0.0, operations * an_operation + (sink < 0 ? 1 : 0)}};
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"what", "case", "x", "value"};
  e.timed = size == Size::full;
  const StopRule sharp{.max_sweeps = 1000, .tolerance = 1e-9}, fair{.max_sweeps = 100'000, .tolerance = 1e-6};
  for (int k = 1; k <= 8; ++k)
    e.points.push_back({"rod " + std::to_string(k), [=]() -> std::vector<Row> {
                          const double friction = 0.25 * k;
                          return {{"rod", "rows", friction, dragged_rod(friction).by_rows(sharp)},
                                  {"rod", "repeats", friction, dragged_rod(friction).by_repeats(3, sharp)},
                                  {"rod", "blocks", friction, dragged_rod(friction).by_blocks(sharp)}};
                        }});
  const auto sweeps = [&e, fair](const std::string& name, double friction,
                                 const std::function<World<6>()>& make) {
    e.points.push_back({"sweeps " + name, [=]() -> std::vector<Row> {
                          const World<6> world = make();
                          OnCones rows(world.rows(), world.bodies().size(), friction), repeats = rows,
                                                                                       blocks = rows;
                          return {{"sweeps", name, 0.0, rows.by_rows(fair)},
                                  {"sweeps", name, 1.0, blocks.by_blocks(fair)},
                                  {"sweeps", name, 3.0, repeats.by_repeats(3, fair)}};
                        }});
  };
  sweeps("balls", 0.2, [] { return grid(4, 3, false, cone_gauss_seidel<6>(), 0.2); });
  sweeps("tower", 0.2, [] { return grid(1, 4, true, cone_gauss_seidel<6>(), 0.2); });
  sweeps("leaning boxes", 1, [] { return leaning_boxes(cone_gauss_seidel<6>()); });

  const std::vector<int> across = size == Size::quick ? std::vector<int>{4, 8} : std::vector<int>{4, 8, 16};
  for (const int n : across)
    for (const bool boxes : {false, true}) {
      const std::string name = std::to_string(n * n * n) + (boxes ? " boxes" : " balls");
      if (boxes && n > 8) continue;
      e.points.push_back(
          {"counts " + name, [=] { return counts(name, grid(n, n, boxes, gauss_seidel<6>())); }});
    }
  e.points.push_back(
      {"counts tower", [] { return counts("tower of 20", grid(1, 20, true, gauss_seidel<6>())); }});
  if (size == Size::full) {
    e.points.push_back({"floors", [] { return floors(); }});
    for (const auto& [n, high] : {std::pair(3, 2), {5, 4}, {10, 5}, {16, 8}, {24, 12}, {32, 20}})
      e.points.push_back({"time " + std::to_string(n), [n = n, high = high] { return times(n, high); }});
  }

  e.check = [across, fair](const Table& table, Claims& claims) {
    const auto value = [&](const std::string& what, const std::string& which, double x = 0) {
      return table.where("what", what).where("case", which).where("x", x).number("value");
    };
    const auto of_rod = [&](const std::string& which) {
      return table.where("what", "rod").where("case", which).numbers("value");
    };
    const std::vector<double> blocks = of_rod("blocks");
    claims.at_most("as a block of rows the rod takes one update for any μ: the second sweep changes nothing",
                   *std::max_element(blocks.begin(), blocks.end()), 2);
    claims.at_least("row by row the rod takes more than 50 sweeps at μ = 1", value("rod", "rows", 1), 50);
    claims.at_least("row by row it does not converge at μ = 3/2 and more", value("rod", "rows", 1.5), 1000);
    const auto fewer = [&, most = double(fair.max_sweeps)](const std::string& name) {
      const double rows = value("sweeps", name, 0), together = value("sweeps", name, 1);
      return rows < most && together < most ? together / rows : std::nan("");
    };
    claims.near("on a grid of balls, blocks need as many sweeps as rows, to 2 per cent", fewer("balls"), 1,
                0.02);
    claims.near("on a tower of boxes they need as many sweeps, too, to 2 per cent", fewer("tower"), 1, 0.02);
    claims.at_most("on boxes that lean and slide they need less than half as many", fewer("leaning boxes"),
                   0.5);
    claims.near(
        "if a contact's rows are updated three times before the next contact, the rod at μ = 1 needs as many "
        "updates as row by row, to 10 per cent",
        3 * value("rod", "repeats", 1) / value("rod", "rows", 1), 1, 0.1);
    claims.at_least(
        "if each contact's rows are updated three times, the leaning boxes need more updates than row by row",
        3 * value("sweeps", "leaning boxes", 3) / value("sweeps", "leaning boxes", 0), 1.1);
    const std::string large = std::to_string(across.back() * across.back() * across.back()) + " balls";
    claims.near("a cubic grid of balls has six colours, whatever its size",
                std::max(value("colours", large), value("colours", "64 balls")), 6, 0);
    claims.near(
        "by colour the longest chain of dependent updates is 18, in the smallest grid and in the largest",
        std::max(value("by colour", large), value("by colour", "64 balls")), 18, 0);
    claims.at_least("in the order of the pairs the chain of 64 balls is at least four times as long",
                    value("in order", "64 balls") / value("by colour", "64 balls"), 4);
    claims.near("in a tower every update depends on the one before",
                value("in order", "tower of 20") / value("rows", "tower of 20"), 1, 0);
    claims.near("if the updates of two halves of the tower alternate, the chain is half as long",
                value("in turn", "tower of 20") / value("in order", "tower of 20"), 0.5, 0);
    claims.at_least("512 balls fill more than 99 per cent of the lanes", value("filled", "512 balls"), 0.99);
    claims.at_least("on 512 balls eight threads could be more than 7 times as fast as one",
                    value("threads", "512 balls", 8), 7);
    claims.at_most("on a tower of 20 they could be no more than 3 times as fast",
                   value("threads", "tower of 20", 8), 3);
    claims.near("an update has 0.23 ± 0.01 operations for each byte of its row", operations / bytes, 0.23,
                0.01);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
