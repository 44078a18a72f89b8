// A cloth of cells × cells, released flat and level, held by four corners or by two: cloth() of chapter 06.
//
// The cloth oscillates without damping. Momentum is balanced in every step, since the forces of links cancel:
//
//   h R = p_{n+1/2} - p_{n-1/2} - h m g        R force of the supports, p = Σ m v
//
// This holds to round-off for any error of the solver. Over a long time p/t goes to zero, and the mean of R to the
// weight: Eq. (6.14). So R does not show the solver's error. The lengths of the threads do:
//
//   l + T/k        under the tension T = -λ/h, as in Eq. (6.9)
//
// After an exact solve two errors remain while h √(T/(m l)) < 1, as in rope.cpp: the lag of a distance,
// h² A (1 + 2d)/(4 l), and a delay of λ of about d steps. For larger steps the threads are unstable with any solver.
//
// Ball joints hold the corners at fixed points; their λ are h R. With model=body the points are spheres, with the same
// distances between their centres. The spheres do not rotate, so their motion is the same at a higher cost.
#include "scenes/half_step_energy.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

template <int Dof>
class Cloth : public WorldScene<Dof> {
 public:
  Cloth(const Parameters& p, const Method& method)
      : WorldScene<Dof>({.gravity = Vec3(0, 0, -p.number("g")), .k = p.number("k"), .d = p.number("d")},
                        method),
        g_(p.number("g")),
        weight_(p.number("m") * p.number("g")),
        k_(p.number("k")) {
    const int cells = p.count("cells");
    const double side = p.number("side");
    const Net net =
        spook::cloth(Vec3::Zero(), side * Vec3::UnitX(), side * Vec3::UnitY(), cells, cells, p.number("m"));
    for (std::size_t i = 0; i < net.x.size(); ++i) {
      Body<Dof> body;
      body.x = net.x[i];
      body.mass = net.mass[i];
      if constexpr (Dof == 6) body.principal = solid_sphere_moments(body.mass, side / cells / 2);
      world_.add(body);
    }
    const int last = static_cast<int>(net.x.size()) - 1;
    std::vector<int> corners = {0, cells};
    if (p.choice("held") == "four_corners") corners.insert(corners.end(), {last - cells, last});
    supports_ = static_cast<int>(corners.size());
    for (const int corner : corners) {
      const int support = world_.add_fixed(world_.x(corner));
      world_.add_joint({.i = support, .j = corner});
    }
    for (const Link& link : net.links) world_.add_joint({.i = link.i, .j = link.j, .length = link.length});
    threads_end_ = static_cast<int>(world_.joints().size());
    if (p.choice("start") == "half_step") world_.start_half_step_back(h_);
    momentum_ = momentum(world_.bodies());
  }

  void observe() override {
    for (int joint = supports_; joint < threads_end_; ++joint)
      largest_error_ = larger(largest_error_, std::abs(strain(joint) - strain_of_pull(joint)));
    // The balance holds for a single step.
    const Vec3 p = momentum(world_.bodies());
    if (world_.steps() == observed_ + 1) balance_ = (p - momentum_) / h_ + weight_ * Vec3::UnitZ();
    momentum_ = p;
    observed_ = world_.steps();
  }
  double error() const override { return largest_error_; }

  void results(StateStream& s) override { s(balance_, momentum_, observed_, largest_error_); }

  std::vector<std::string> columns() const override {
    return {"time [s]", "support z [N]", "balance z [N]", "largest strain [-]", "lowest z [m]", "energy [J]"};
  }
  std::vector<double> sample() const override {
    return {this->time(),     support().z(), balance_.z(),
            largest_strain(), lowest(),      half_step_energy(world_.bodies(), g_, 2 * this->velocity_lag())};
  }

 private:
  using WorldScene<Dof>::world_;
  using WorldScene<Dof>::h_;

  /// The force of all supports in the last step [N].
  Vec3 support() const {
    Vec3 sum = Vec3::Zero();
    for (int joint = 0; joint < supports_; ++joint)
      for (int row = 0; row < 3; ++row) sum[row] += world_.joint_lambda(joint, row) / this->impulse_time();
    return sum;
  }

  double strain(int joint) const {
    const Joint& thread = world_.joints()[static_cast<std::size_t>(joint)];
    return distance(thread, world_.bodies()) / *thread.length - 1;
  }

  /// The length that a thread should have by its tension in the last step.
  double strain_of_pull(int joint) const {
    return -world_.joint_lambda(joint) /
           (this->impulse_time() * k_ * *world_.joints()[static_cast<std::size_t>(joint)].length);
  }

  double largest_strain() const {
    double most = 0;
    for (int joint = supports_; joint < threads_end_; ++joint) most = larger(most, std::abs(strain(joint)));
    return most;
  }

  double lowest() const {
    double z = 0;
    for (const Vec3& x : world_.bodies().x) z = std::min(z, x.z());
    return z;
  }

  double g_, weight_, k_;
  int supports_ = 0;             // number of supports, which are the first joints
  int threads_end_ = 0;          // number of supports and threads; a hand's joint comes after them
  Vec3 balance_ = Vec3::Zero();  // R by the change of momentum in the last step [N]
  Vec3 momentum_;
  std::int64_t observed_ = 0;  // step to which momentum_ belongs
  double largest_error_ = 0;
};

}  // namespace

SceneDescription cloth() {
  return {.name = "cloth",
          .summary = "A cloth is released flat and level, held by its corners.",
          .answer =
              "Threads keep their length, apart from T/k, with T their tension. In every step the supports "
              "give h R = Δp + h m g, the change of momentum and the weight's impulse. This holds to "
              "round-off, however few the sweeps; over a long time their mean is the weight.",
          .error_name = "largest deviation of a thread's length so far, over its length",
          .error_unit = "relative",
          .parameters = {{.name = "cells",
                          .meaning = "along each side",
                          .value = 20,
                          .limits = {.low = 1, .high = 200, .whole = true}},
                         {.name = "model",
                          .meaning = "point: point masses; body: spheres, with the same motion",
                          .choices = {"point", "body"}},
                         {.name = "held",
                          .meaning = "by which corners",
                          .choices = {"four_corners", "two_corners"}},
                         {.name = "side",
                          .meaning = "of the cloth",
                          .unit = "m",
                          .value = 1,
                          .limits = {.low = 0, .low_included = false}},
                         parameter::mass(),
                         parameter::weighing_gravity(),
                         parameter::stiffness(),
                         parameter::relaxation(),
                         parameter::start()},
          .h = 0.001,
          .time = 0.3,
          .solves = true,
          .build = build_model<Cloth>,
          .solver = "auto"};
}

}  // namespace spook
