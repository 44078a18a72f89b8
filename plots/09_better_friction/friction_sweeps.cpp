// Convergence of sweeps with each friction model, in single solves.
//
//   pile     thirty balls in a pyramid at rest, μ = 1: largest change in each sweep, over g h (two passes: the second)
//   rod      a rod that slides on one end, tan 2 steep, end behind or ahead: the same
//   five     the smallest μ with which a pyramid of five balls stays
//   answers  the pyramid of thirty, solved on cones from two starts: its final speed, and the residual
#include <numbers>

#include "09_better_friction/rough_system.hpp"
#include "machinery/experiment.hpp"

namespace spook::plots {
namespace {

constexpr double h = 1.0 / 60;
const Vec3 up = Vec3::UnitZ(), nothing = Vec3::Zero();

/// The first tangent points uphill, or outwards on the floor.
Tangents steepest(const Vec3& n, const Vec3& outwards) {
  const Vec3 along = n.cross(up).norm() > 1e-6 ? up : outwards.norm() > 1e-6 ? outwards : Vec3::UnitX();
  const Vec3 t1 = (along - n.dot(along) * n).normalized();
  return {.t1 = t1, .t2 = n.cross(t1)};
}

/// Balls of 1 kg, their positions, and all contacts between them and with the floor.
RoughSystem<6> balls(const std::vector<Vec3>& places, double radius, double mu) {
  RoughSystem<6> s;
  add_body<6>(s, {}, Twist<6>::Zero(), Twist<6>::Zero());
  const Twist<6> Wf = (Twist<6>() << -h * g * up, nothing).finished();
  for (std::size_t k = 0; k < places.size(); ++k)
    add_body<6>(s, {.linear = 1, .angular = Mat3::Identity() / (0.4 * radius * radius)}, Twist<6>::Zero(), Wf);
  const auto add = [&](int i, int j, const Vec3& n, const Vec3& outwards) {
    const double normal_gravity = std::abs(g * n.dot(up)), mass = representative_mass(i == 0 ? 0 : 1, 1, 1);
    add_contact(s, {.i = i, .j = j, .n = n, .gap = 0, .r_i = radius * n, .r_j = -radius * n},
                steepest(n, outwards), mu, friction_bound(mu, mass, normal_gravity, h));
  };
  for (int j = 1; j <= std::ssize(places); ++j) {
    const Vec3& x = places[j - 1];
    if (x.z() < 1.01 * radius) add(0, j, up, Vec3(x.x(), x.y(), 0));
    for (int i = 1; i < j; ++i) {
      const Vec3 apart = x - places[i - 1];
      if (apart.norm() < 2.01 * radius) add(i, j, apart.normalized(), nothing);
    }
  }
  return s;
}

/// Square layers of touching balls around the z-axis, with `side` balls along a side of the lowest.
RoughSystem<6> pyramid(int side, double mu) {
  const double radius = 0.5;
  std::vector<Vec3> places;
  for (int level = 0; level < side; ++level)
    for (int a = 0; a < side - level; ++a)
      for (int b = 0; b < side - level; ++b) {
        const double middle = (side - level - 1) / 2.0;
        places.push_back(2 * radius * Vec3(a - middle, b - middle, 0.5 + level * std::sqrt(0.5)));
      }
  return balls(places, radius, mu);
}

/// A rod of 1 kg and 2 m, its lower end on the floor, the other above it at x > 0; μ n·Kt/n·Kn is -0.75 μ for slip > 0.
RoughSystem<6> rod(double mu, double slip) {
  RoughSystem<6> s;
  add_body<6>(s, {}, Twist<6>::Zero(), Twist<6>::Zero());
  const Vec3 along = Vec3(1, 0, 2) / std::sqrt(5);
  add_body<6>(s, {.linear = 1, .angular = 3 * (Mat3::Identity() - along * along.transpose())},
              (Twist<6>() << slip, 0, 0, nothing).finished(), (Twist<6>() << -h * g * up, nothing).finished());
  add_contact(s, {.i = 0, .j = 1, .n = up, .gap = 0, .r_i = nothing, .r_j = -along},
              {.t1 = Vec3::UnitX(), .t2 = Vec3::UnitY()}, mu, friction_bound(mu, 1, g, h));
  return s;
}

/// Returns the results of the sweeps, over g h; of two passes those of the second.
std::vector<Row> history(const std::string& what, const std::string& which, Model model, RoughSystem<6> s,
                         int most) {
  const StopRule stop{.max_sweeps = most, .tolerance = 1e-12 * g * h};
  std::vector<double> all;
  if (model == Model::two_pass) {
    RoughSystem<6> first = s;
    for (FrictionContact& contact : first.contacts) contact.mu = 0;
    const std::size_t before = cone_solve(first.contacts, first.rows, first.V, stop).history.size();
    all = two_pass_solve(s.contacts, s.rows, s.V, stop).history;
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(before));
  } else {
    all = solve_by(model, s, stop).history;
  }
  std::vector<Row> rows;
  for (std::size_t n = 0; n < all.size(); ++n)
    rows.push_back({what, which, static_cast<double>(n + 1), all[n] / (g * h)});
  return rows;
}

double smallest_mu_of_five(Model model, int most) {
  double low = 0, high = 1;
  for (int n = 0; n < 16; ++n) {
    const double mu = (low + high) / 2;
    RoughSystem<6> s = pyramid(2, mu);
    solve_by(model, s, {.max_sweeps = most, .tolerance = 1e-13});
    (s.speed() > 1e-7 ? low : high) = mu;
  }
  return (low + high) / 2;
}

std::vector<Row> answer(bool from_two_passes) {
  const StopRule stop{.max_sweeps = 100000, .tolerance = 1e-10};
  RoughSystem<6> s = pyramid(4, 1);
  if (from_two_passes) two_pass_solve(s.contacts, s.rows, s.V, stop);
  cone_solve(s.contacts, s.rows, s.V, stop);
  const std::string start = from_two_passes ? "from two passes" : "from zero";
  return {{"answers", start + " speed", 0.0, s.speed()},
          {"answers", start + " residual", 0.0, residual_on_cones(s.contacts, s.rows, s.V)}};
}

constexpr Model compared[] = {Model::box, Model::two_pass, Model::cone};

Experiment experiment(Size size) {
  const int most = size == Size::quick ? 20000 : 200000;
  Experiment e;
  e.columns = {"what", "which", "sweep", "value"};
  for (const Model model : compared) {
    e.points.push_back(
        {"pile, " + name(model), [=] { return history("pile", name(model), model, pyramid(4, 1), 5000); }});
    e.points.push_back({"five, " + name(model), [=]() -> std::vector<Row> {
                          return {{"five", name(model), 0.0, smallest_mu_of_five(model, most)}};
                        }});
  }
  const auto add_rod = [&](const std::string& which, Model model, double mu, double slip) {
    e.points.push_back({"rod " + which, [=] { return history("rod", which, model, rod(mu, slip), 1000); }});
  };
  add_rod("cone -0.75", Model::cone, 1, 3);
  add_rod("cone 0.75", Model::cone, 1, -3);
  add_rod("cone -1.5", Model::cone, 2, 3);
  add_rod("two passes -1.5", Model::two_pass, 2, 3);
  for (const bool from_two_passes : {false, true})
    e.points.push_back({from_two_passes ? "answer from two passes" : "answer from zero",
                        [=] { return answer(from_two_passes); }});
  e.check = [](const Table& table, Claims& claims) {
    const auto values = [&](const std::string& what, const std::string& which) {
      return table.where("what", what).where("which", which).numbers("value");
    };
    double off = 0;
    for (const std::string which : {"cone -0.75", "cone 0.75"}) {
      const auto left = values("rod", which);
      for (std::size_t n = 2; n < 40; ++n) {
        const double wrong = std::abs(left[n] / left[n - 1] / 0.75 - 1);
        if (!(wrong <= off)) off = wrong;
      }
    }
    claims.at_most(
        "for a sliding rod with ρ = ±0.75 in Eq. (9.8), each sweep multiplies the error by 0.75, to 1e-6", off,
        1e-6);
    const auto round = values("rod", "cone -1.5");
    claims.near(
        "with ρ = -1.5 the sweeps on cones do not converge: the thousandth sweep changes as much as the first",
        round.back() / round.front(), 1, 1e-9);
    claims.at_most("with ρ = -1.5 the second of two passes converges in 3 sweeps",
                   static_cast<double>(values("rod", "two passes -1.5").size()), 3);
    const auto five = [&](Model model) { return values("five", name(model)).front(); };
    const double right = std::numbers::sqrt2 - 1;
    claims.near("with the cone five balls in a pyramid stand from μ = tan 22.5° = 0.414 on, to 1e-3",
                five(Model::cone) / right, 1, 1e-3);
    claims.near("with two passes they stand from μ = 0.366 on, to 1e-3",
                five(Model::two_pass) / (right * 5 / (4 * std::numbers::sqrt2)), 1, 1e-3);
    claims.near("with the box they stand from μ = 0.293 on, to 1e-3",
                five(Model::box) / (right / std::numbers::sqrt2), 1, 1e-3);
    claims.at_most("thirty balls with μ = 1 are at rest, to 1e-8 m/s, if a solve on cones starts from zero",
                   values("answers", "from zero speed").front(), 1e-8);
    claims.at_least("if it starts from the answer of two passes, some of them move at more than 1 cm/s",
                    values("answers", "from two passes speed").front(), 1e-2);
    claims.at_most("both answers satisfy Coulomb's law, to 1e-9 m/s",
                   std::max(values("answers", "from zero residual").front(),
                            values("answers", "from two passes residual").front()),
                   1e-9);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
