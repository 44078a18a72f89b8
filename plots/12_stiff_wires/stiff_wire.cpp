// A wire that swings under a load, at steps for which leapfrog alone is unstable: h²K in three places.
//
//   change     M̃ (v⁺ - v) = h f + Gᵀλ                      Eq. (12.6), stiff_solve
//   velocity   M̃ v⁺ = M v + h f + Gᵀλ                      Eq. (12.8), Tournier and others
//   quarter    the first, with h²K/4
//   none       K = 0
//
//   energy   over time, of the wire of 100 links and 1000:1
//   step     loss of energy and error of the load's path, against h
//   ratio    largest error of a link, against the load
//
// N links, 10 m and 1 kg in all; a load of `ratio` points in place of the last; released straight at 30°, for 5 s, with
// half a step first. The energy is kinetic energy plus energy of the weight at the time of x, with the mean of the two
// neighbouring v. Its change since the start is given over the energy released on the way down. The error of the path
// is the load's largest at any step, compared with leapfrog without K in steps far below 2/ω.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "12_stiff_wires/stiff_wires.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double g = 9.81, length = 10, k = 1e12, d = 3, angle = std::numbers::pi / 6, seconds = 5;

struct Wire {
  std::string form;
  int links;
  double ratio;
  int rate;  ///< steps per second

  double h() const { return 1.0 / rate; }
  double link() const { return length / links; }
  double mass(int point) const { return (point < links ? 1 : ratio) / links; }
};

struct Swing {
  double link_error = 0;
  std::vector<double> energy;
  std::vector<Vec3> path;
  bool lost = false;  ///< the error of a link exceeds its length, or a number is not finite

  double loss() const { return lost ? infinity : -energy.back(); }
};

bool solve_step(const Wire& wire, std::vector<spook::Row<3>>& rows, const Motion<3>& motion,
                const std::vector<Stiffness>& stiffness, std::vector<Twist<3>>& V, Factors& factors) {
  if (wire.form == "none") return saddle_solve(rows, motion.inverse_mass, V, factors);
  if (wire.form != "velocity") return stiff_solve(rows, motion, stiffness, wire.h(), V, factors);
  Motion<3> whole = motion;  // the rows have their B; K acts on the rest of W_f
  for (std::size_t point = 0; point < whole.W.size(); ++point) whole.Wf[point] += whole.W[point];
  return stiff_solve(rows, whole, stiffness, wire.h(), V, factors);
}

Swing swing(const Wire& wire) {
  const double h = wire.h(), l = wire.link(), share = wire.form == "quarter" ? 0.25 : 1;
  const int N = wire.links;
  const SpookParameters spook = spook_parameters(h, k, d);
  Motion<3> motion;
  std::vector<Vec3> x;
  for (int point = 0; point <= N; ++point) {
    x.push_back(point * l * Vec3(std::sin(angle), 0, -std::cos(angle)));
    motion.inverse_mass.push_back({.linear = point == 0 ? 0 : 1 / wire.mass(point)});
  }
  motion.W.assign(N + 1, Vec3::Zero());
  motion.Wf = motion.W;
  std::vector<double> tension(N);  // initial tension: the component along the wire of the weight below
  double hanging = 0, scale = 0;
  for (int link = N - 1; link >= 0; --link) {
    hanging += wire.mass(link + 1);
    tension[link] = std::cos(angle) * hanging * g;
    scale += wire.mass(link + 1) * g * l * (link + 1) * (1 - std::cos(angle));
  }

  Swing result;
  Factors factors;
  std::vector<Twist<3>> V(N + 1, Vec3::Zero());
  for (int n = 0; n < static_cast<int>(seconds * wire.rate) && !result.lost; ++n) {
    const double part = n == 0 ? 0.5 : 1;
    for (int point = 1; point <= N; ++point) motion.Wf[point] = Vec3(0, 0, -part * h * g);
    std::vector<spook::Row<3>> rows;
    std::vector<Stiffness> stiffness;
    for (int i = 0; i < N; ++i) {
      const Attachment from{.body = i, .x = x[i]}, to{.body = i + 1, .x = x[i + 1]};
      rows.push_back(make_row(distance_constraint<3>(from, to, l, spook), motion));
      const Mat3 K = geometric_stiffness((x[i + 1] - x[i]).normalized(), l, tension[i]);
      stiffness.push_back({.i = i, .j = i + 1, .K = share * K});
    }
    result.lost = !solve_step(wire, rows, motion, stiffness, V, factors);
    double energy = scale * std::cos(angle) / (1 - std::cos(angle));  // minus the initial energy
    for (int point = 1; point <= N; ++point) {
      const Vec3 before = motion.W[point];
      motion.W[point] += motion.Wf[point] + V[point];
      const Vec3 v = n == 0 ? Vec3(Vec3::Zero()) : Vec3((before + motion.W[point]) / 2);
      energy += wire.mass(point) * (v.squaredNorm() / 2 + g * x[point].z());
      x[point] = drift(x[point], motion.W[point], h);
    }
    for (int i = 0; i < N; ++i) {
      tension[i] = -rows[i].lambda / (part * h);
      const double error = std::abs((x[i + 1] - x[i]).norm() / l - 1);
      if (!(error < 1)) result.lost = true;
      result.link_error = std::max(result.link_error, error);
    }
    result.energy.push_back(energy / scale);
    result.path.push_back(x[N]);
  }
  return result;
}

/// Returns the largest distance of the load from its position with finer steps.
double path_error(const Swing& coarse, const Swing& fine, int times) {
  if (coarse.lost || fine.lost) return infinity;
  double largest = 0;
  for (std::size_t n = 0; n < coarse.path.size(); ++n)
    largest = std::max(largest, (coarse.path[n] - fine.path[times * (n + 1) - 1]).norm());
  return largest;
}

Experiment experiment(Size size) {
  const bool quick = size == Size::quick;
  Experiment e;
  e.columns = {"what", "form", "links", "ratio", "h", "value", "path or time", "highest or lost"};
  for (const std::string form : {"change", "velocity", "none"})
    e.points.push_back({"energy " + form, [=] {
                          const Wire wire{form, 100, 1000, 60};
                          const Swing found = swing(wire);
                          std::vector<Row> rows;
                          for (std::size_t n = 0; n < found.energy.size(); ++n)
                            rows.push_back({"energy", form, 100.0, 1000.0, wire.h(), found.energy[n],
                                            double(n) / wire.rate, double(found.lost)});
                          return rows;
                        }});
  for (const double ratio : quick ? std::vector<double>{1e3} : std::vector<double>{1e3, 1e5})
    e.points.push_back({"step " + std::to_string(int(ratio)), [=] {
                          const int fine_rate = quick ? 960 : 15360;
                          const Swing fine = swing({"none", 100, ratio, fine_rate});
                          std::vector<Row> rows;
                          for (const std::string form : {"change", "velocity"})
                            for (int rate = 30; rate <= (quick ? 120 : 480); rate *= 2) {
                              const Wire wire{form, 100, ratio, rate};
                              const Swing found = swing(wire);
                              const double highest =
                                  *std::max_element(found.energy.begin(), found.energy.end());
                              rows.push_back({"step", form, 100.0, ratio, wire.h(), found.loss(),
                                              path_error(found, fine, fine_rate / rate), highest});
                            }
                          return rows;
                        }});
  for (const auto& [form, links] :
       {std::pair<std::string, int>{"change", 100}, {"change", 10}, {"quarter", 100}})
    for (double ratio = 1; ratio < 2e6; ratio *= quick ? 10 : std::sqrt(10))
      e.points.push_back(
          {"ratio " + form + " " + std::to_string(links) + " " + std::to_string(std::lround(ratio)),
           [form = form, links = links, ratio]() -> std::vector<Row> {
             const Wire wire{form, links, ratio, 60};
             const Swing found = swing(wire);
             return {{"ratio", form, double(links), double(std::lround(ratio)), wire.h(),
                      found.lost ? infinity : found.link_error, 0.0,
                      *std::max_element(found.energy.begin(), found.energy.end())}};
           }});
  e.check = [quick](const Table& table, Claims& claims) {
    const Table ratios = table.where("what", "ratio"),
                long_wire = ratios.where("form", "change").where("links", 100);
    double link = 0, highest = -infinity;
    for (const double ratio : {1e3, 1e4, 1e5, 1e6}) {
      link = std::max(link, long_wire.where("ratio", ratio).number("value"));
      highest = std::max(highest, long_wire.where("ratio", ratio).number("highest or lost"));
    }
    claims.at_most(
        "with loads of 1000:1 to 10⁶:1 at h = 1/60 a swinging wire of 100 links has an error of at most 3·10⁻⁴ "
        "of a link",
        link, 3e-4);
    claims.at_most("its energy never exceeds the energy at the start, up to round-off of 10⁻⁹", highest, 1e-9);
    const double law = std::pow(1.0 / 60, 2) * 2 * g * (1 - std::cos(angle)) / length * (1 + 2 * d) / 4;
    claims.near(
        "with ten links and 10⁶:1 the error is that of a turning rod, h²ω²(1+2d)/4 of chapter 06, to 2 per "
        "cent",
        ratios.where("form", "change").where("links", 10).where("ratio", 1e6).number("value") / law, 1, 0.02);

    const auto slope = [&](const std::string& form, const std::string& column) {
      double worst = 0, expected = form == "change" ? 2 : 1;
      for (const double ratio : quick ? std::vector<double>{1e3} : std::vector<double>{1e3, 1e5}) {
        const Table some = table.where("what", "step").where("form", form).where("ratio", ratio);
        const double off = log_log_slope(some.numbers("h"), some.numbers(column)) - expected;
        if (!(std::abs(off) <= std::abs(worst))) worst = off;
      }
      return expected + worst;
    };
    claims.near("the energy lost in 5 s falls with h²: slope 2.0 ± 0.1", slope("change", "value"), 2, 0.1);
    claims.near("the error of the load's path falls with h²: slope 2.0 ± 0.1", slope("change", "path or time"),
                2, 0.1);
    claims.near("if K acts on the new velocity, the energy lost falls with h: slope 1.0 ± 0.1",
                slope("velocity", "value"), 1, 0.1);
    const auto loss = [&](const std::string& form) {
      const Table some = table.where("what", "step").where("ratio", 1e3).where("form", form);
      return some.where("h", 1.0 / 60).number("value");
    };
    claims.near("at h = 1/60 this loss is 67 ± 1 times as large", loss("velocity") / loss("change"), 67, 1);
    const auto times = table.where("what", "energy").where("form", "none").numbers("path or time");
    claims.at_most("without K the wire of 1000:1 is lost in a third of a second", times.back(), 1.0 / 3);
    claims.at_least("with h²K/4 the wire of 10⁵:1 is lost",
                    ratios.where("form", "quarter").where("ratio", 1e5).number("value"), 1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
