// Four friction models in scenes with a known answer by Coulomb's law.
//
//   push       the smallest force along a direction that moves a block at rest, over μ m g
//   distance   the sliding distance of a block thrown at v0 in that direction, over v0²/(2 μ g)
//   stack      the smallest μ with which n points, one on the other, stay on a slope, over tan θ
//   spin       the spin of a disc on its flat side, over its first; time over 3 R ω0/(4 μ g)
//
// Directions are from the first tangent of the models that have a fixed one. Thresholds are found by bisection.
#include <numbers>

#include "09_better_friction/rough_system.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double mu = 0.5, slope = 0.3;
constexpr Model models[] = {Model::box, Model::sliding_box, Model::two_pass, Model::cone};
constexpr StopRule sharp{.max_sweeps = 50000, .tolerance = 1e-13};
const Vec3 up = Vec3::UnitZ(), nothing = Vec3::Zero();

/// Returns the tangents for a slip u that includes the forces of this step.
Tangents tangents_of(Model model, const Vec3& u) {
  if (model == Model::sliding_box) return sliding_tangents(up, u, 1e-12);
  return {.t1 = Vec3::UnitX(), .t2 = Vec3::UnitY()};
}

/// Returns the velocity of a mass of 1 kg on a floor after a step.
Vec3 pushed(Model model, const Vec3& v, const Vec3& force, double h) {
  RoughSystem<3> s;
  const Vec3 Wf = h * (force - g * up);
  add_body<3>(s, {}, nothing, nothing);
  add_body<3>(s, {.linear = 1}, v, Wf);
  add_contact(s, {.i = 0, .j = 1, .n = up, .gap = 0, .r_i = nothing, .r_j = nothing},
              tangents_of(model, v + Wf), mu, friction_bound(mu, representative_mass(0, 1, 1), g, h));
  solve_by(model, s, {.max_sweeps = 100, .tolerance = 1e-14});
  return s.velocity(1);
}

/// Returns the argument at which `moving` changes.
template <class Moving>
double threshold(double low, double high, const Moving& moving) {
  const bool at_low = moving(low);
  for (int n = 0; n < 40; ++n) {
    const double middle = (low + high) / 2;
    (moving(middle) == at_low ? low : high) = middle;
  }
  return (low + high) / 2;
}

Vec3 direction(double phi) {
  return {std::cos(phi), std::sin(phi), 0};
}

double smallest_push(Model model, double phi) {
  return threshold(0, 2, [&](double share) {
    return pushed(model, nothing, share * mu * g * direction(phi), 0.01).norm() > 1e-12;
  });
}

/// Returns the distance from start to stop; v starts half a step early, with friction's own deceleration, so that the
/// order is 2.
double distance(Model model, double phi, double h) {
  const double v0 = 3;
  Vec3 x = nothing, v = v0 * direction(phi);
  v += (v - pushed(model, v, nothing, h)) / 2;
  for (int n = 0; n * h < 3 && v.norm() > 1e-9; ++n) {
    v = pushed(model, v, nothing, h);
    x += h * v;
  }
  return x.norm() / (v0 * v0 / (2 * mu * g));
}

double smallest_mu(Model model, int n) {
  const double h = 0.01;
  const auto slides = [&](double times) {
    const double friction = times * std::tan(slope);
    RoughSystem<3> s;
    add_body<3>(s, {}, nothing, nothing);
    for (int j = 1; j <= n; ++j) {
      const Vec3 Wf = h * g * Vec3(std::sin(slope), 0, -std::cos(slope));
      add_body<3>(s, {.linear = 1}, nothing, Wf);
      const double mass = representative_mass(j == 1 ? 0 : 1, 1, 1);
      add_contact(s, {.i = j - 1, .j = j, .n = up, .gap = 0, .r_i = nothing, .r_j = nothing},
                  tangents_of(model, Wf), friction, friction_bound(friction, mass, g * std::cos(slope), h));
    }
    solve_by(model, s, sharp);
    return s.speed() > 1e-9;
  };
  return threshold(0, 100, slides);
}

/// A disc of 1 kg, represented by 80 points of equal area, in 40 pairs of opposite points.
struct Disc {
  static constexpr double radius = 0.5, inertia = radius * radius / 2, h = 1.0 / 240, first = 20;
  static constexpr int pairs = 40;
  std::vector<Vec3> points;

  Disc() {
    for (int k = 0; k < pairs; ++k) {
      const Vec3 r = radius * std::sqrt((k + 0.5) / pairs) * direction(2.399963229728653 * k);
      points.push_back(r);
      points.push_back(-r);
    }
  }

  double next(Model model, double omega) const {
    RoughSystem<6> s;
    add_body<6>(s, {}, Twist<6>::Zero(), Twist<6>::Zero());
    const Vec3 inverse(2 / inertia, 2 / inertia, 1 / inertia), spin = omega * up, weight = -h * g * up;
    add_body<6>(s, {.linear = 1, .angular = inverse.asDiagonal()}, (Twist<6>() << nothing, spin).finished(),
                (Twist<6>() << weight, nothing).finished());
    const int count = 2 * pairs;
    const double bound = friction_bound(mu, representative_mass(0, 1, count), g, h);
    for (const Vec3& r : points)
      add_contact(s, {.i = 0, .j = 1, .n = up, .gap = 0, .r_i = r, .r_j = r}, tangents_of(model, spin.cross(r)),
                  mu, bound);
    for (const FrictionContact& contact : s.contacts) {  // the pressure is even: there are many others
      s.rows[contact.normal].lambda = h * g / count;
      apply_impulse(s.rows[contact.normal], h * g / count, s.V);
    }
    solve_by(model, s, {.max_sweeps = 500, .tolerance = 1e-12});
    return s.velocity(1)[5];
  }
};

std::vector<Row> spin_down(Model model) {
  const Disc disc;
  const double unit = 3 * Disc::radius * Disc::first / (4 * mu * g);
  std::vector<Row> rows;
  double omega = Disc::first;
  for (int n = 0; n * Disc::h < 1.5 * unit; ++n) {
    rows.push_back(
        {"spin", name(model), n * Disc::h / unit, omega / Disc::first, std::max(0.0, 1 - n * Disc::h / unit)});
    if (std::abs(omega) < 1e-6 * Disc::first) break;
    omega = disc.next(model, omega);
  }
  return rows;
}

double box_push(double phi) {
  return 1 / std::max(std::abs(std::cos(phi)), std::abs(std::sin(phi)));
}

double box_distance(double phi) {
  return std::hypot(std::cos(phi) * std::cos(phi), std::sin(phi) * std::sin(phi));
}

double worst(const Table& some) {
  const auto value = some.numbers("value"), predicted = some.numbers("predicted");
  double largest = 0;
  for (std::size_t n = 0; n < value.size(); ++n) {
    const double off = std::abs(value[n] / predicted[n] - 1);
    if (!(off <= largest)) largest = off;
  }
  return largest;
}

Experiment experiment(Size size) {
  const int directions = size == Size::quick ? 12 : 48, tallest = size == Size::quick ? 6 : 10;
  const double h = size == Size::quick ? 1.0 / 1000 : 1.0 / 4000;
  Experiment e;
  e.columns = {"what", "model", "at", "value", "predicted"};
  for (const Model model : models) {
    const bool fixed = model == Model::box || model == Model::two_pass;
    for (int n = 0; n < directions; ++n) {
      const double phi = 2 * std::numbers::pi * n / directions;
      e.points.push_back(
          {name(model) + ", direction " + std::to_string(n), [=]() -> std::vector<Row> {
             return {{"push", name(model), phi, smallest_push(model, phi), fixed ? box_push(phi) : 1},
                     {"distance", name(model), phi, distance(model, phi, h), fixed ? box_distance(phi) : 1}};
           }});
    }
    for (int n = 1; n <= tallest; ++n)
      e.points.push_back(
          {name(model) + ", stack of " + std::to_string(n), [=]() -> std::vector<Row> {
             const bool guessed = model == Model::box || model == Model::sliding_box;
             const double predicted = guessed ? std::max(n, 2 * (n - 1)) : 1;
             return {{"stack", name(model), static_cast<double>(n), smallest_mu(model, n), predicted}};
           }});
    e.points.push_back({name(model) + ", disc", [=] { return spin_down(model); }});
  }
  e.check = [](const Table& table, Claims& claims) {
    const auto all = [&](const std::string& what, const std::vector<Model>& some) {
      double largest = 0;
      for (const Model model : some)
        largest = std::max(largest, worst(table.where("what", what).where("model", name(model))));
      return largest;
    };
    claims.at_most(
        "the cone has the same strength in every direction, to 1e-9, and so has the box on sliding tangents",
        all("push", {Model::cone, Model::sliding_box}), 1e-9);
    claims.at_most("with either of them a block stops after v0²/(2μg) in every direction, to 1e-4",
                   all("distance", {Model::cone, Model::sliding_box}), 1e-4);
    claims.at_most("two passes have the strength of the box, Eq. (5.12), to 1e-9",
                   all("push", {Model::box, Model::two_pass}), 1e-9);
    claims.at_most(
        "with two passes or the cone, a stack stays on a slope of angle θ from μ = tan θ on, to 1e-6",
        all("stack", {Model::two_pass, Model::cone}), 1e-6);
    claims.at_most("with the box's estimate a stack of n spheres needs μ = max(n, 2(n-1)) tan θ, to 1e-6",
                   all("stack", {Model::box, Model::sliding_box}), 1e-6);
    const auto stops = [&](Model model) {
      return table.where("what", "spin").where("model", name(model)).numbers("at").back();
    };
    claims.near("with the cone a spinning disc stops after 3Rω0/(4μg), to 1 per cent", stops(Model::cone), 1,
                0.01);
    claims.near("with the box it stops after π/4 of that time, to 1 per cent",
                stops(Model::box) / (std::numbers::pi / 4), 1, 0.01);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
