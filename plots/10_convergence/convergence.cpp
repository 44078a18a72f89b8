// Convergence on the same rows: orders of Gauss-Seidel, a warm start, and conjugate gradients.
//
// One step of four scenes at rest under gravity, h = 1/60, gaps 0, k = 1e9, d = 3. Bodies are numbered at random; rows
// come in the order of their pairs of bodies ("given").
//
//   stack   20 point masses of 1 kg, one on the other
//   wire    20 points of 1 kg on a wire, and 100 kg at its end
//   pile    55 smooth balls as a pyramid between two walls
//   wall    27 bricks in six layers, with friction
//
// The residual of Eq. (4.8) over that of λ = 0, against the cost in sweeps. An iteration of conjugate gradients counts
// as five, by its operations (3.5 to 6.5). Methods:
//
//   given, up, down   Gauss-Seidel in that order, up from the lowest contact
//   random            a new order for each sweep; the median over seeds, and quartiles
//   warm              up, from the impulses of a step in which gravity was 1 % less
//   nonlinear         conjugate gradients on sweeps, Silcowitz-Hansen, Niebe and Erleben (2010); counts as sweeps
//   conjugate         conjugate_solve
//
// And the time of a sweep and of an iteration [us].
#include <cmath>
#include <map>
#include <numeric>

#include "10_convergence/convergence.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, iteration_cost = 5;

/// Rows, their velocities at λ = 0, and the heights of their points.
template <int Dof>
struct Scene {
  std::vector<spook::Row<Dof>> rows;
  std::vector<Twist<Dof>> V;
  std::vector<double> heights;
};

SpookParameters stiff() {
  return spook_parameters(h, 1e9, 3);
}

/// Body 0 is the ground, and keeps its number.
std::vector<int> random_numbers(int bodies) {
  std::mt19937_64 generator(10);
  std::vector<int> number = {0};
  for (const int k : random_order(bodies, generator)) number.push_back(k + 1);
  return number;
}

template <int Dof>
Motion<Dof> at_rest(int bodies, const InverseMass<Dof>& each) {
  Motion<Dof> motion;
  motion.inverse_mass.assign(static_cast<std::size_t>(bodies) + 1, each);
  motion.inverse_mass[0] = {};
  motion.W.assign(motion.inverse_mass.size(), Twist<Dof>::Zero());
  motion.Wf = motion.W;
  for (std::size_t k = 1; k < motion.Wf.size(); ++k) motion.Wf[k].z() = -h * g;
  return motion;
}

/// Builds rows from constraints with their heights, in the order of their pairs.
template <int Dof>
Scene<Dof> in_given_order(std::vector<std::pair<Constraint<Dof>, double>> all, const Motion<Dof>& motion) {
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.i, a.first.j) < std::pair(b.first.i, b.first.j);
  });
  Scene<Dof> scene;
  for (const auto& [constraint, height] : all) {
    scene.rows.push_back(make_row(constraint, motion));
    scene.heights.push_back(height);
  }
  scene.V.assign(motion.W.size(), Twist<Dof>::Zero());
  return scene;
}

Constraint<3> smooth(const Contact& c) {
  return {.i = c.i, .j = c.j, .Gi = -c.n, .Gj = c.n, .gap = 0, .spook = stiff()};
}

Scene<3> stack() {
  const int n = 20;
  const auto number = random_numbers(n);
  std::vector<std::pair<Constraint<3>, double>> all;
  for (int k = 0; k < n; ++k) {
    const Vec3 zero = Vec3::Zero();
    all.emplace_back(smooth({number[k], number[k + 1], Vec3::UnitZ(), 0, zero, zero}), k);
  }
  return in_given_order(all, at_rest<3>(n, {.linear = 1}));
}

Scene<3> wire() {
  const int n = 21;
  const auto number = random_numbers(n);
  Motion<3> motion = at_rest<3>(n, {.linear = 1});
  motion.inverse_mass[number[n]] = {.linear = 0.01};
  std::vector<std::pair<Constraint<3>, double>> all;
  for (int k = 0; k < n; ++k) {
    const Attachment above{number[k], Vec3(0, 0, -k)}, below{number[k + 1], Vec3(0, 0, -k - 1)};
    all.emplace_back(distance_constraint<3>(above, below, 1, stiff()), -k - 0.5);
  }
  return in_given_order(all, motion);
}

Scene<3> pile() {
  const int base = 10;
  const double radius = 0.5, touching = 1e-9;
  std::vector<Ball> balls;
  const auto number = random_numbers(base * (base + 1) / 2);
  for (int level = 0; level < base; ++level)
    for (int k = 0; k < base - level; ++k)
      balls.push_back({number[balls.size() + 1], Vec3(k + 0.5 * level, 0, radius + level * std::sqrt(0.75)),
                       radius + touching});
  std::vector<Contact> contacts;
  const auto keep = [&](const std::optional<Contact>& c) {
    if (c) contacts.push_back(*c);
  };
  std::map<int, Vec3> centre;
  for (std::size_t a = 0; a < balls.size(); ++a) {
    keep(plane_ball({0, Vec3::Zero(), Vec3::UnitZ(), 0}, balls[a]));
    keep(plane_ball({0, Vec3::Zero(), Vec3::UnitX(), -radius}, balls[a]));
    keep(plane_ball({0, Vec3::Zero(), -Vec3::UnitX(), -(base - radius)}, balls[a]));
    for (std::size_t b = 0; b < a; ++b) keep(ball_ball(balls[a], balls[b]));
    centre[balls[a].body] = balls[a].x;
  }
  std::vector<std::pair<Constraint<3>, double>> all;
  for (const Contact& c : contacts) all.emplace_back(smooth(c), centre[c.j].z() + c.r_j.z());
  return in_given_order(all, at_rest<3>(static_cast<int>(balls.size()), {.linear = 1}));
}

/// Bricks of 1 kg, shifted by half a brick in every other layer, and three rows a contact: μ = 0.5.
Scene<6> wall() {
  const double touching = 1e-9, mu = 0.5;
  const Vec3 half(0.5, 0.25, 0.25);
  std::vector<Vec3> places;
  for (int layer = 0; layer < 6; ++layer)
    for (int k = 0; k < 5 - layer % 2; ++k)
      places.emplace_back(1.02 * (k + 0.5 * (layer % 2)), 0, 0.25 + 0.5 * layer);
  const int n = static_cast<int>(places.size());
  const auto number = random_numbers(n);
  std::vector<Box> bricks;
  for (int k = 0; k < n; ++k)
    bricks.push_back({number[k + 1], places[k], Mat3::Identity(), half + touching * Vec3::UnitZ()});

  std::vector<std::pair<Constraint<6>, double>> all;
  const auto add = [&](const std::vector<Contact>& contacts, double inverse_mass, double z) {
    for (const Contact& c : contacts) {
      const ContactJacobian G = contact_jacobian(c);
      const double height = z + c.r_j.z();
      all.push_back({{.i = c.i, .j = c.j, .Gi = G.Gi, .Gj = G.Gj, .gap = 0, .spook = stiff()}, height});
      const double mass = representative_mass(inverse_mass, 1, static_cast<int>(contacts.size()));
      const auto friction = friction_constraints<6>(c, tangents(c.n), friction_bound(mu, mass, g, h),
                                                    friction_parameters(h, 1e9));
      for (const auto& constraint : friction) all.emplace_back(constraint, height);
    }
  };
  for (int a = 0; a < n; ++a) {
    std::vector<Contact> contacts;
    plane_box({0, Vec3::Zero(), Vec3::UnitZ(), 0}, bricks[a], contacts);
    add(contacts, 0, places[a].z());
    for (int b = 0; b < a; ++b) {
      contacts.clear();
      box_box(bricks[b], bricks[a], contacts);
      if (!contacts.empty()) add(contacts, 1, places[contacts[0].j == number[a + 1] ? a : b].z());
    }
  }
  const Vec3 moment =
      (Vec3(half.y(), half.x(), half.x()).cwiseAbs2() + Vec3(half.z(), half.z(), half.y()).cwiseAbs2()) / 3;
  return in_given_order(all, at_rest<6>(n, {.linear = 1, .angular = moment.cwiseInverse().asDiagonal()}));
}

/// Returns 1, 2, 3, 4, 6, 8, 11, 16 ... up to `most`.
std::vector<int> counts(int most) {
  std::vector<int> all;
  for (double next = 1; std::lround(next) <= most; next *= std::sqrt(2.0))
    if (const int n = static_cast<int>(std::lround(next)); all.empty() || n > all.back()) all.push_back(n);
  return all;
}

/// Returns the residuals after so many calls of `advance`, over `first`.
template <int Dof, class Advance>
std::vector<double> residuals(Scene<Dof> s, double first, const std::vector<int>& when,
                              const Advance& advance) {
  std::vector<double> found;
  for (int n = 1; n <= when.back(); ++n) {
    advance(n, s);
    if (n == when[found.size()]) found.push_back(residual(s.rows, s.V) / first);
  }
  return found;
}

template <int Dof>
void nonlinear(int n, Scene<Dof>& s, std::vector<double>& p, double& squares) {
  std::vector<double> change(s.rows.size());
  for (std::size_t k = 0; k < change.size(); ++k) change[k] = -s.rows[k].lambda;
  sweep(s.rows, s.V);
  for (std::size_t k = 0; k < change.size(); ++k) change[k] += s.rows[k].lambda;
  const double now = std::inner_product(change.begin(), change.end(), change.begin(), 0.0);
  const double beta = n == 1 ? 0 : now / std::exchange(squares, now);
  if (n == 1) squares = now;
  p.resize(change.size(), 0);
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double along = beta <= 1 ? beta * p[k] : 0;
    s.rows[k].lambda += along;
    apply_impulse(s.rows[k], along, s.V);
    p[k] = beta <= 1 ? along + change[k] : 0;
  }
}

template <int Dof>
class Comparison {
 public:
  Comparison(std::string name, const Scene<Dof>& start, Size size)
      : name_(std::move(name)),
        start_(start),
        quick_(size == Size::quick),
        first_(residual(start.rows, start.V)),
        up_(order_along(start.heights)),
        down_(up_.rbegin(), up_.rend()) {}

  std::vector<Row> rows(const std::string& method) const {
    if (method == "random") return random_rows();
    const auto when = counts(method == "conjugate" ? 512 : most());
    const std::vector<double> found = method == "conjugate" ? conjugate(when) : swept(method, when);
    std::vector<Row> rows;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double sweeps = when[k] * (method == "conjugate" ? iteration_cost : 1);
      rows.push_back({name_, method, double(when[k]), sweeps, found[k], found[k], found[k]});
    }
    return rows;
  }

  std::vector<Row> times() const {
    Scene<Dof> s = start_;
    const int count = 20;
    const Timing of_sweep = time_each(count, 9, [&] {
      for (int n = 0; n < count; ++n) sweep(s.rows, s.V);
    });
    const Timing of_iteration = time_each(count, 9, [&] {
      s = start_;
      conjugate_solve(s.rows, s.V, {.max_sweeps = count, .tolerance = 0});
    });
    std::vector<Row> rows;
    for (const auto& [what, t] : {std::pair("sweep", of_sweep), std::pair("iteration", of_iteration)})
      rows.push_back(
          {name_, std::string("time of a ") + what, 1.0, 1.0, t.median / 1000, t.low / 1000, t.high / 1000});
    return rows;
  }

 private:
  int most() const { return quick_ ? 1024 : 4096; }

  std::vector<double> swept(const std::string& method, const std::vector<int>& when) const {
    if (method == "nonlinear") {
      std::vector<double> p;
      double squares = 0;
      return residuals(start_, first_, when, [&](int n, Scene<Dof>& s) { nonlinear(n, s, p, squares); });
    }
    std::vector<int> order(start_.rows.size());
    std::iota(order.begin(), order.end(), 0);
    if (method != "given") order = method == "down" ? down_ : up_;
    Scene<Dof> start = start_;
    if (method == "warm") {
      // Right-hand sides are proportional to gravity, and so is the solution.
      std::vector<double> impulses;
      for (spook::Row<Dof>& row : start.rows) row.B *= 0.99;
      solve(start.rows, start.V, {.max_sweeps = quick_ ? 10000 : 100000, .tolerance = 1e-10});
      for (const spook::Row<Dof>& row : start.rows) impulses.push_back(row.lambda);
      start = start_;
      warm_start(impulses, start.rows, start.V);
    }
    return residuals(start, first_, when, [&](int, Scene<Dof>& s) { sweep_in_order(order, s.rows, s.V); });
  }

  std::vector<double> conjugate(const std::vector<int>& when) const {
    std::vector<double> found;
    for (const int n : when) {
      Scene<Dof> s = start_;
      const SolveReport report = conjugate_solve(s.rows, s.V, {.max_sweeps = n, .tolerance = 1e-12});
      found.push_back(residual(s.rows, s.V) / first_);
      if (report.converged) break;
    }
    return found;
  }

  std::vector<Row> random_rows() const {
    const auto when = counts(most());
    std::vector<std::vector<double>> by_count(when.size());
    for (int seed = 1; seed <= (quick_ ? 5 : 21); ++seed) {
      std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
      const auto found = residuals(start_, first_, when, [&](int, Scene<Dof>& s) {
        sweep_in_order(random_order(static_cast<int>(s.rows.size()), generator), s.rows, s.V);
      });
      for (std::size_t k = 0; k < found.size(); ++k) by_count[k].push_back(found[k]);
    }
    std::vector<Row> rows;
    for (std::size_t k = 0; k < when.size(); ++k) {
      std::vector<double>& all = by_count[k];
      std::sort(all.begin(), all.end());
      rows.push_back({name_, "random", double(when[k]), double(when[k]), all[all.size() / 2],
                      all[all.size() / 4], all[all.size() * 3 / 4]});
    }
    return rows;
  }

  std::string name_;
  Scene<Dof> start_;
  bool quick_;
  double first_;
  std::vector<int> up_, down_;
};

template <int Dof>
void add(Experiment& e, const std::string& name, const Scene<Dof>& scene, Size size) {
  const Comparison<Dof> comparison(name, scene, size);
  for (const std::string method : {"given", "up", "down", "random", "warm", "nonlinear", "conjugate"})
    e.points.push_back({name + " " + method, [=] { return comparison.rows(method); }});
  e.points.push_back({name + " time", [=] { return comparison.times(); }});
}

/// Returns the cost until the residual was at most `goal`; infinity if it never was.
double cost_to(const Table& table, const std::string& scene, const std::string& method, double goal) {
  const Table some = table.where("scene", scene).where("method", method);
  const auto sweeps = some.numbers("sweeps"), found = some.numbers("residual");
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k] <= goal) return sweeps[k];
  return infinity;
}

double residual_at(const Table& table, const std::string& scene, const std::string& method, double count) {
  return table.where("scene", scene).where("method", method).where("count", count).number("residual");
}

void check(const Table& table, Claims& claims) {
  const auto rate = [&](const std::string& scene, const std::string& method) {
    return std::log(residual_at(table, scene, method, 512) / residual_at(table, scene, method, 1024)) / 512;
  };
  double worst = 0;
  for (const char* scene : {"stack", "wire"})
    for (const char* order : {"given", "down"})
      worst = std::max(worst, std::abs(rate(scene, order) / rate(scene, "up") - 1));
  claims.at_most(
      "in a stack and in a wire every fixed order converges at the same rate: the logarithms agree to 1 per "
      "cent",
      worst, 0.01);
  claims.near("from λ = 0 a sweep up a stack leaves half the residual of a sweep down",
              residual_at(table, "stack", "up", 1) / residual_at(table, "stack", "down", 1), 0.5, 0.01);
  claims.near("after 1024 sweeps both orders leave the same residual, to 2 per cent",
              residual_at(table, "stack", "up", 1024) / residual_at(table, "stack", "down", 1024), 1, 0.02);
  claims.near("with a new random order in each sweep, the stack needs 1.25 ± 0.1 times as many sweeps",
              rate("stack", "up") / rate("stack", "random"), 1.25, 0.1);
  double fixed = infinity;
  for (const char* order : {"given", "up", "down"})
    fixed = std::min(fixed, residual_at(table, "wall", order, 512));
  claims.at_most(
      "after 512 sweeps of the wall a random order leaves at most half the residual of the best fixed order",
      residual_at(table, "wall", "random", 512) / fixed, 0.5);
  double first = 0;
  for (const char* scene : {"stack", "wire", "pile", "wall"})
    first = std::max(first, residual_at(table, scene, "warm", 1));
  claims.at_most("a start from 99 per cent of the answer begins with at most 1.1 per cent of the residual",
                 first, 0.011);
  claims.at_most(
      "conjugate gradients solve the stack to 1e-6 for the cost of at most 160 sweeps, and the wire for the "
      "cost of 80",
      std::max(cost_to(table, "stack", "conjugate", 1e-6), 2 * cost_to(table, "wire", "conjugate", 1e-6)), 160);
  const auto ratio = [&](const std::string& scene, double goal) {
    return cost_to(table, scene, "conjugate", goal) / cost_to(table, scene, "up", goal);
  };
  claims.near(
      "to reduce the residual of the pile and the wall to a tenth, they cost 3 ± 1 times as much as sweeps",
      std::sqrt(ratio("pile", 0.1) * ratio("wall", 0.1)), 3, 1);
  claims.near("to reduce it to 1e-3, they cost as much as sweeps, within a factor of 2",
              std::log2(ratio("pile", 1e-3) * ratio("wall", 1e-3)) / 2, 0, 1);
  claims.at_most("applied to sweeps, they solve the pile to 1e-3 for less than half the cost of sweeps alone",
                 cost_to(table, "pile", "nonlinear", 1e-3) / cost_to(table, "pile", "up", 1e-3), 0.5);
}

Experiment experiment(Size size) {
  Experiment e;
  e.columns = {"scene", "method", "count", "sweeps", "residual", "low", "high"};
  e.timed = true;
  add(e, "stack", stack(), size);
  add(e, "wire", wire(), size);
  add(e, "pile", pile(), size);
  add(e, "wall", wall(), size);
  e.check = check;
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
