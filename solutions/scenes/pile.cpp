// Spheres or cubes dropped into a box: a scene without a closed form, which must come to rest.
//
// At rest the floor carries all the weight, since the walls are smooth. The final positions are unknown, but the forces
// of the overlaps must balance the weight of each body: balance.hpp.
#include "engine/bodies/conserved_quantities.hpp"
#include "scenes/balance.hpp"
#include "scenes/jitter.hpp"
#include "scenes/load.hpp"
#include "scenes/registry.hpp"

namespace spook {

namespace {

/// Without restitution there are no impacts: rows of contacts stop the bodies.
std::optional<ImpactLaw> impacts_of(const Parameters& p) {
  if (p.number("restitution") == 0) return std::nullopt;
  return ImpactLaw{
      .restitution = p.number("restitution"), .friction = p.number("mu"), .threshold = p.number("threshold")};
}

class Pile : public WorldScene<6> {
 public:
  Pile(const Parameters& p, const Method& method)
      : WorldScene({.gravity = Vec3(0, 0, -p.number("g")),
                    .k = p.number("k"),
                    .d = p.number("d"),
                    .friction = p.number("mu"),
                    .viscosity = p.number("viscosity"),
                    .impacts = impacts_of(p)},
                   method),
        radius_(p.number("radius")),
        weight_(p.number("m") * p.number("g")),
        all_(p.count("bodies") * weight_) {
    const int n = p.count("bodies");
    // Layers of side × side bodies; the stack is as high as wide, or a little higher.
    const int side = std::max(1, static_cast<int>(std::cbrt(n)));
    const double cell = 2.5 * radius_, half = side * cell / 2;
    floor_ = world_.add_plane(Vec3::UnitZ(), 0);
    for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
      world_.set_material(world_.add_plane(inwards, -half), {.friction = 0});

    const double m = p.number("m");
    Jitter jitter(static_cast<unsigned>(p.count("seed")));
    for (int i = 0; i < n; ++i) {
      const int column = i % (side * side), layer = i / (side * side);
      const Vec3 place(column % side + 0.5 - side / 2.0, column / side + 0.5 - side / 2.0, layer + 0.5);
      Vec3 off;
      for (double& component : off) component = 0.2 * radius_ * jitter.next();
      if (p.choice("shape") == "sphere") {
        world_.add({.x = cell * place + off,
                    .mass = m,
                    .radius = radius_,
                    .principal = solid_sphere_moments(m, radius_)});
      } else {
        // A cube that fits into its cell in any orientation.
        const Vec3 half_sides = Vec3::Constant(0.6 * radius_);
        Quat q(jitter.next(), jitter.next(), jitter.next(), jitter.next());
        world_.add({.x = cell * place + off,
                    .mass = m,
                    .q = q.norm() > 0 ? q.normalized() : Quat::Identity(),
                    .principal = solid_box_moments(m, half_sides),
                    .half_sides = half_sides});
      }
    }
  }

  void observe() override {}
  double error() const override { return relative(largest_unbalanced(world_, radius_, h_), weight_); }

  std::vector<std::string> columns() const override {
    return {"time [s]",
            "deepest overlap [m]",
            "kinetic energy [J]",
            "fastest centre [m/s]",
            "floor's load over the weight",
            "contacts",
            "impacts"};
  }
  std::vector<double> sample() const override {
    return {time(),
            deepest(),
            kinetic_energy(world_.bodies()),
            fastest(),
            relative(load_on(floor_, world_, h_), all_),
            static_cast<double>(world_.contacts().size()),
            static_cast<double>(world_.report().impacts)};
  }

 private:
  /// The largest overlap of contacts, at the start of the last step [m].
  double deepest() const {
    double depth = 0;
    for (const Contact& contact : world_.contacts()) depth = larger(depth, -contact.gap);
    return depth;
  }

  double fastest() const {
    double v = 0;
    for (const Twist<6>& W : world_.bodies().motion.W) v = larger(v, W.head<3>().norm());
    return v;
  }

  double radius_, weight_, all_;  // radius [m]; weight of a body, and of all bodies [N]
  int floor_ = 0;
};

}  // namespace

SceneDescription pile() {
  // With ten times the stiffness, fifty sweeps a step leave the pile jittering.
  Parameter k = parameter::stiffness();
  k.value = 1e5;
  return {
      .name = "pile",
      .summary = "Spheres or cubes are dropped into a box, and come to rest.",
      .answer =
          "There is no closed form. But at rest the floor carries the whole weight, whatever mu, and k times "
          "the overlaps, with friction, balance each body. (While it falls they do not.)",
      .error_name = "largest unbalanced force or torque on a body, by its overlaps, over its weight",
      .error_unit = "relative",
      .parameters = {parameter::bodies(20, 100000),
                     {.name = "shape", .meaning = "of the bodies", .choices = {"sphere", "box"}},
                     parameter::friction(),
                     parameter::restitution(0.2),
                     parameter::threshold(),
                     {.name = "seed",
                      .meaning = "of the jitter that they start with",
                      .value = 1,
                      .limits = {.low = 0, .high = 1e9, .whole = true}},
                     parameter::mass(),
                     parameter::radius(0.1),
                     parameter::gravity(),
                     k,
                     parameter::relaxation(),
                     parameter::viscosity()},
      .h = 0.01,
      .time = 4,
      .solves = true,
      .build = build_as<Pile>,
      .solver = "auto",
      .chaotic = true};
}

}  // namespace spook
