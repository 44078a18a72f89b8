// The direct solver on a hanging wire, compared with sweeps: error against time, growth, and the cost of bounds.
//
//   sweeps    100 links, largest relative error of an impulse after n sweeps from λ = 0, and their time
//   direct    the same for a single call of direct_solve
//   links     times of one sweep and of direct_solve, and the entries of L, against the number of links
//   bounds    factorisations for towers of boxes with friction and random velocities, the top one `ratio` times as
//             heavy; and the number of rows at a bound: several draws
//
// The wire hangs at equilibrium, each link stretched by T/k: λ is exactly -h T, Eq. (6.8).
//
// If no row is at a bound, one factorisation suffices. This holds for tall towers under 10⁶:1 from which the load does
// not lift off: n boxes are a beam with a sideways compliance of Σ n³/3. This is much larger than 1/M, so the load
// bends the tower and moves on. To stop the load within the step, friction and weight would not suffice.
#include <algorithm>
#include <cmath>
#include <random>

#include "05_friction_box/friction_box.hpp"
#include "11_direct/direct.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, h = 1.0 / 60;
constexpr StopRule to_roundings{.max_sweeps = 100, .tolerance = 0};

struct Wire {
  std::vector<spook::Row<3>> rows;
  std::vector<Twist<3>> V;
  std::vector<double> exact;
};

Wire hang(int links, double ratio) {
  constexpr double k = 1e8;
  const Twist<3> up(0, 0, 1);
  Motion<3> motion;
  motion.inverse_mass.push_back({.linear = 0});
  motion.Wf.push_back(Twist<3>::Zero());
  for (int point = 1; point <= links; ++point) {
    motion.inverse_mass.push_back({.linear = point == links ? 1 / ratio : 1});
    motion.Wf.push_back(-h * g * up);
  }
  motion.W.assign(motion.Wf.size(), Twist<3>::Zero());
  Wire wire{.rows = {}, .V = motion.W, .exact = {}};
  for (int link = 0; link < links; ++link) {
    const double tension = (ratio + links - 1 - link) * g;
    wire.exact.push_back(-h * tension);
    wire.rows.push_back(make_row<3>({.i = link,
                                     .j = link + 1,
                                     .Gi = up,
                                     .Gj = -up,
                                     .gap = tension / k,
                                     .spook = spook_parameters(h, k, 2),
                                     .lo = -infinity,
                                     .hi = infinity},
                                    motion));
  }
  return wire;
}

double error(const Wire& wire) {
  double largest = 0;
  for (std::size_t k = 0; k < wire.rows.size(); ++k) {
    const double one = std::abs(wire.rows[k].lambda / wire.exact[k] - 1);
    if (!(one <= largest)) largest = one;
  }
  return largest;
}

Timing time_sweep(Wire& wire) {
  return time_each(1, 20, [&] { sweep(wire.rows, wire.V); });
}

Timing time_direct(Wire& wire, Factors& factors) {
  return time_each(1, 20, [&] { direct_solve(wire.rows, wire.V, to_roundings, factors); });
}

struct Held {
  double factorisations;  // infinite if not solved
  double rows;            // number of rows at a bound
};

/// A column of boxes of 1 kg and 1 m, with four contacts of three rows between two boxes. Each box has a random
/// velocity and angular velocity of up to 0.3 m/s and rad/s along each axis.
Held hold(int boxes, double ratio, int draw) {
  Motion<6> motion;
  for (int body = 0; body <= boxes; ++body) {
    const double mass = body == boxes ? ratio : 1;
    motion.inverse_mass.push_back(
        body == 0 ? InverseMass<6>{}
                  : InverseMass<6>{.linear = 1 / mass, .angular = 6 / mass * Mat3::Identity()});
    motion.Wf.push_back((Twist<6>() << 0, 0, body == 0 ? 0 : -h * g, 0, 0, 0).finished());
  }
  motion.W.assign(motion.Wf.size(), Twist<6>::Zero());
  std::mt19937_64 generator(static_cast<std::uint64_t>(draw));
  std::uniform_real_distribution<double> kick(-0.3, 0.3);
  for (auto W = motion.W.begin() + 1; W != motion.W.end(); ++W)
    *W = Twist<6>::NullaryExpr([&] { return kick(generator); });
  std::vector<spook::Row<6>> rows;
  const SpookParameters normal{.a = 0, .b = 1, .Sigma = 1e-8}, friction{.a = 0, .b = 1, .Sigma = 1e-10};
  for (int below = 0; below < boxes; ++below)
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const Contact contact{.i = below,
                              .j = below + 1,
                              .n = Vec3(0, 0, 1),
                              .gap = 0,
                              .r_i = Vec3(x, y, 0.5),
                              .r_j = Vec3(x, y, -0.5)};
        const ContactJacobian G = contact_jacobian(contact);
        rows.push_back(make_row<6>(
            {.i = below, .j = below + 1, .Gi = G.Gi, .Gj = G.Gj, .gap = 0, .spook = normal}, motion));
        const double bound = 0.3 * h * g * (ratio + boxes - 1 - below) / 4;
        for (const Constraint<6>& one :
             friction_constraints<6>(contact, {Vec3(1, 0, 0), Vec3(0, 1, 0)}, bound, friction))
          rows.push_back(make_row(one, motion));
      }
  std::vector<Twist<6>> V(motion.W.size());
  Factors factors;
  constexpr double tolerance = 1e-6;
  const SolveReport report = direct_solve(rows, V, {.max_sweeps = 100, .tolerance = tolerance}, factors);
  const auto held = std::count_if(rows.begin(), rows.end(), [&](const spook::Row<6>& row) {
    const double residual = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    return !(std::abs(residual) <= tolerance);
  });
  const bool solved = report.converged && report.trouble.empty();
  return {solved ? static_cast<double>(report.history.size()) : infinity, static_cast<double>(held)};
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.timed = true;
  e.columns = {"what", "size", "ratio", "sweeps", "value", "us", "held"};
  for (const double ratio : {1e3, 1e5}) {
    const std::string name = std::to_string(static_cast<int>(ratio));
    e.points.push_back({"sweeps " + name, [=] {
                          Wire timed = hang(100, ratio), wire = hang(100, ratio);
                          const double us = time_sweep(timed).median / 1000;
                          std::vector<Row> rows;
                          double done = 0;
                          for (double n = 1; n <= (quick ? 1e3 : 1e7); n = std::ceil(1.5 * n)) {
                            for (; done < n; ++done) sweep(wire.rows, wire.V);
                            rows.push_back({"sweeps", 100.0, ratio, n, error(wire), n * us, 0.0});
                            if (error(wire) < 1e-12) break;
                          }
                          return rows;
                        }});
    e.points.push_back({"direct " + name, [=]() -> std::vector<Row> {
                          Wire wire = hang(100, ratio);
                          Factors factors;
                          const double us = time_direct(wire, factors).median / 1000;
                          return {{"direct", 100.0, ratio, 0.0, error(wire), us, 0.0}};
                        }});
  }
  for (int links = 100; links <= (quick ? 1000 : 100000); links *= 10)
    for (const int times : {1, 3}) {
      const int n = times * links;
      if (n > (quick ? 1000 : 100000)) continue;
      e.points.push_back({"links " + std::to_string(n), [=]() -> std::vector<Row> {
                            Wire wire = hang(n, 1000);
                            Factors factors;
                            const double swept = time_sweep(wire).median / 1000;
                            const double direct = time_direct(wire, factors).median / 1000;
                            const auto entries = factors.ldlt.matrixL().nestedExpression().nonZeros();
                            return {{"a sweep", double(n), 1000.0, 1.0, 0.0, swept, 0.0},
                                    {"direct by links", double(n), 1000.0, 0.0, double(entries), direct, 0.0}};
                          }});
    }
  for (const int boxes : quick ? std::vector<int>{1, 10, 50} : std::vector<int>{1, 2, 5, 10, 20, 50, 100})
    for (const double ratio : {1.0, 1e3, 1e6}) {
      e.points.push_back(
          {"bounds " + std::to_string(boxes) + " " + std::to_string(static_cast<int>(ratio)), [=] {
             std::vector<Row> rows;
             for (int draw = 1; draw <= 11; ++draw) {
               const Held held = hold(boxes, ratio, draw);
               rows.push_back({"bounds", double(boxes), ratio, 0.0, held.factorisations, 0.0, held.rows});
             }
             return rows;
           }});
    }
  e.check = [quick](const Table& table, Claims& claims) {
    double gain = infinity;
    for (const double ratio : {1e3, 1e5}) {
      const Table swept = table.where("what", "sweeps").where("ratio", ratio);
      const auto n = swept.numbers("sweeps"), errors = swept.numbers("value");
      double after_twenty = 1;
      for (std::size_t k = 0; k < n.size(); ++k)
        if (n[k] <= 20) after_twenty = errors[k];
      gain = std::min(gain, after_twenty / table.where("what", "direct").where("ratio", ratio).number("value"));
    }
    claims.at_least(
        "on 100 links the error of the direct solver is more than 10¹⁰ times smaller than that of 20 sweeps",
        gain, 1e10);
    if (!quick) {
      double longest = 0;
      for (const double ratio : {1e3, 1e5}) {
        const Table swept = table.where("what", "sweeps").where("ratio", ratio);
        const double one = swept.numbers("us").front() / swept.numbers("sweeps").front();
        longest = std::max(longest, table.where("what", "direct").where("ratio", ratio).number("us") / one);
      }
      claims.at_most("the direct solver takes at most the time of 20 sweeps", longest, 20);
    }
    const Table grown = table.where("what", "direct by links");
    const auto links = grown.numbers("size"), entries = grown.numbers("value");
    double off = 0;
    for (std::size_t k = 0; k < links.size(); ++k) off = std::max(off, std::abs(entries[k] - (links[k] - 1)));
    claims.near("below its diagonal L has one entry less than the wire has links: nothing is filled in", off, 0,
                0);
    const Table towers = table.where("what", "bounds");
    const auto found = towers.numbers("value"), held = towers.numbers("held");
    const auto boxes = towers.numbers("size"), ratio = towers.numbers("ratio");
    claims.at_most(
        "for 1 to 100 boxes and mass ratios to 10⁶, a solve with bounded friction reaches 10⁻⁶ m/s in at "
        "most 40 factorisations",
        *std::max_element(found.begin(), found.end()), 40);
    int unlike = 0, free = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      unlike += (found[k] == 1) != (held[k] == 0);
      free += held[k] == 0 && (boxes[k] <= 10 || ratio[k] <= 1e3);
    }
    claims.near("one factorisation is enough if and only if no row is at a bound", unlike, 0, 0);
    claims.near("all draws without a row at a bound have more than ten boxes and a mass ratio above 1000:1",
                free, 0, 0);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
