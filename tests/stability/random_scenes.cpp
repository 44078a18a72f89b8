#include "random_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/run_check.hpp"
#include "engine/support/disjoint_sets.hpp"
#include "random_input.hpp"

namespace spook::testing {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double share_gained = 0.1;  // of the present energy
constexpr int steps = 120;
constexpr double reach = 3;  // largest distance from the origin, about [m]

template <int Dof>
Body<Dof> draw_body(Random& random, const Vec3& place, double room) {
  Body<Dof> body;
  body.x = place + random.vector(0.1 * room);
  body.v = random.vector(1 / std::sqrt(3));
  const double density = random.log_uniform(200, 5000);
  const double radius = random.uniform(0.5, 1) * room / 4;
  body.mass = density * 4 / 3 * std::numbers::pi * std::pow(radius, 3);
  if constexpr (Dof == 3) {
    body.radius = radius;
  } else {
    body.omega = random.vector(4 / std::sqrt(3));
    body.q = random.rotation();
    const int shape = random.integer(0, 2);
    if (shape < 2) body.radius = radius;
    if (shape == 1) {
      body.radius = radius / 2;
      body.half_length = radius / 2;
      body.mass *= 5.0 / 16;  // its volume is 5/12 π r³, and 4/3 π r³ that of the ball
    }
    if (shape == 2) {
      for (double& half : body.half_sides) half = random.uniform(0.5, 1) * room / 4;
      body.mass = density * 8 * body.half_sides.prod();
    }
  }
  return body;
}

/// Gives a hinge or slider limits around its start, a spring, a motor, or none of them.
void equip(Joint& joint, Random& random) {
  if (!joint.has_free_axis()) return;
  if (random.integer(0, 1)) joint.limits = JointLimits{-random.uniform(0, 0.5), random.uniform(0, 0.5)};
  if (random.integer(0, 2) == 0)
    joint.spring = Spring{.stiffness = random.log_uniform(1, 1e4), .damping = random.log_uniform(0.01, 100)};
  if (random.integer(0, 2) == 0)
    joint.motor = Motor{.speed = random.uniform(-3, 3), .strength = random.log_uniform(0.1, 1000)};
}

/// Between the points' initial positions: no joint is stretched at the start. Hinges, sliders and welds close no loop,
/// since one with random axes is locked: a motor in it has nothing to turn. `sets` are bodies that joints connect.
template <int Dof>
void join(World<Dof>& world, Random& random, DisjointSets& sets, int i, int j) {
  Joint joint{.i = i, .j = j};
  const Vec3 apart = world.x(j) - world.x(i);
  if (Dof == 3 || random.integer(0, 1)) {
    joint.length = apart.norm();
    joint.kind = random.integer(0, 1) ? JointKind::distance : JointKind::rope;
  } else if constexpr (Dof == 6) {
    const Vec3 middle = world.x(i) + random.uniform(0, 1) * apart;
    joint.p_i = orientation(world, i).conjugate() * (middle - world.x(i));
    joint.p_j = orientation(world, j).conjugate() * (middle - world.x(j));
    joint.axis = random.vector_of_length(1, 1);
    joint.kind = std::array{JointKind::ball, JointKind::hinge, JointKind::slider,
                            JointKind::weld}[static_cast<std::size_t>(random.integer(0, 3))];
    if (sets.find(i) == sets.find(j)) joint.kind = JointKind::ball;
    equip(joint, random);
  }
  sets.join(i, j);
  world.add_joint(joint);
}

template <int Dof>
struct RandomScene {
  World<Dof> world;
  double h;
  bool free;  ///< no body is static

  static RandomScene draw(Random& random) {
    Settings<Dof> settings;
    settings.gravity = Vec3(0, 0, random.integer(0, 3) ? -9.81 : 0);
    const bool by_default = random.integer(0, 1) == 1;
    if (!by_default) {
      settings.k = random.log_uniform(1e5, 1e9);
      if (random.integer(0, 1)) settings.d = random.uniform(1, 5);
    }
    if (random.integer(0, 3)) settings.friction = random.uniform(0, 1);
    if (random.integer(0, 1))
      settings.impacts = ImpactLaw{.restitution = random.uniform(0, 0.8), .friction = settings.friction};
    World<Dof> world(std::move(settings));
    const double h = random.log_uniform(1.0 / 480, by_default ? 1.0 / 30 : 1.0 / 120), room = 0.5;
    const bool floor = random.integer(0, 2) > 0;
    if (floor) world.add_plane(Vec3::UnitZ(), 0);

    // Each body in a cell of its own, side by side and above each other.
    const int first = static_cast<int>(world.bodies().size()), bodies = random.integer(1, 8);
    for (int b = 0; b < bodies; ++b) {
      const Vec3 cell(b % 2, b / 2 % 2, b / 4);
      world.add(draw_body<Dof>(random, room * (cell + Vec3(0, 0, 0.6)), room));
    }
    bool free = !floor;
    DisjointSets sets(first + bodies + 1);
    const int joints = random.integer(0, 1) ? random.integer(0, bodies) : 0;
    for (int n = 0; n < joints; ++n) {
      const int i = first + random.integer(0, bodies - 1), j = first + random.integer(0, bodies - 1);
      if (i != j) join(world, random, sets, i, j);
    }
    if (random.integer(0, 3) == 0) {
      const int anchor = world.add_fixed(room * Vec3(0.5, 0.5, 2.5));
      join(world, random, sets, anchor, first + random.integer(0, bodies - 1));
      free = false;
    }
    return {std::move(world), h, free};
  }
};

template <int Dof>
class Watch {
 public:
  explicit Watch(const RandomScene<Dof>& scene)
      : scene_(scene),
        before_(scene.world.bodies().motion.W),
        p0_(momentum(scene.world.bodies())),
        L_(angular_momentum(scene.world.bodies())) {
    run_check_.look(scene.world, scene.h);
    started_ = most_ = kinetic_energy(scene.world.bodies());
    for (const double mass : scene.world.bodies().mass) mass_ += mass;
  }

  Findings look() {
    divided_ = divided_ || world().parts() > 1;
    look_at_rows();
    look_at_momentum();
    look_at_energy();
    run_check_.look(world(), scene_.h);
    if (const Verdict& verdict = run_check_.verdict(); verdict.state != State::sound) {
      std::string& found = findings_.wrong[name_of(verdict.state)];
      if (found.empty()) found = "step " + std::to_string(verdict.step) + ": " + verdict.reason;
    }
    before_ = world().bodies().motion.W;
    return findings_;
  }

 private:
  const World<Dof>& world() const { return scene_.world; }

  void compare(const std::string& what, double value, double allowed) {
    if (allowed > 0) findings_.worst[what] = std::max(findings_.worst[what], value / allowed);
    std::ostringstream text;
    text << "step " << world().steps() << ": " << value << ", more than " << allowed;
    if (!(value <= allowed) && findings_.wrong[what].empty()) findings_.wrong[what] = text.str();
  }

  /// Checks that λ is within its bounds, and that the impulses explain the motion of each body.
  void look_at_rows() {
    const Bodies<Dof>& bodies = world().bodies();
    std::vector<Vec3> impulse(bodies.size(), Vec3::Zero());
    std::vector<double> size(bodies.size(), 0);
    for (const Row<Dof>& row : world().rows()) {
      compare("bounds", std::max(row.lo - row.lambda, row.lambda - row.hi), 0);
      const auto add = [&](int body, const Twist<Dof>& G) {
        impulse[world().index(body)] += row.lambda * G.template head<3>();
        size[world().index(body)] += std::abs(row.lambda) * G.template head<3>().norm();
      };
      add(row.i, row.Gi);
      add(row.j, row.Gj);
    }
    // Without a given k velocities go on with the impulses of a second solve.
    if (world().report().impacts > 0 || divided_ || !world().settings().k) return;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies.is_fixed(b)) continue;
      const Vec3 v = bodies.motion.W[b].template head<3>(), was = before_[b].template head<3>();
      const Vec3 kick = scene_.h * world().forces()[b] + impulse[b];
      // Each row adds some round-off of its own contribution. Rows of a direct solve had a contribution before.
      const double scale =
          bodies.mass[b] * (v.norm() + was.norm()) + scene_.h * world().forces()[b].norm() + size[b];
      compare("solve", (bodies.mass[b] * (v - was) - kick).norm(), 1000 * epsilon * scale);
    }
  }

  void look_at_momentum() {
    const Bodies<Dof>& bodies = world().bodies();
    for (std::size_t b = 0; b < bodies.size(); ++b) pushed_ += bodies.mass[b] * bodies.motion.W[b].norm();
    for (const Row<Dof>& row : world().rows()) pushed_ += world().parts() * std::abs(row.lambda);
    if (!scene_.free) return;
    // In parts of steps gravity acts at other times, and velocities have another lag.
    if (divided_ && !world().settings().gravity.isZero(0)) return;
    const Vec3 p = p0_ + mass_ * world().time() * world().settings().gravity;
    // The impulses of second solves, without a given k, are not known; those of a mechanism may be larger.
    const double roundings = world().settings().k ? 10 : 100;
    compare("momentum", (momentum(bodies) - p).norm(), roundings * epsilon * pushed_);
    // Gravity acts at the position of a body before its drift: at x_n, or where a late impact has put it.
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vec3 x = bodies.x[b] - scene_.h * bodies.motion.W[b].template head<3>();
      L_ += scene_.h * x.cross(world().forces()[b]);
    }
    if (keeps_angular_momentum())
      compare("angular momentum", (angular_momentum(bodies) - L_).norm(), 10 * epsilon * reach * pushed_);
  }

  /// Friction turns balls whose rotation is fixed, and a ball joint acts on two points that do not quite coincide.
  bool keeps_angular_momentum() const {
    const auto is_ball_joint = [](const Joint& joint) { return !joint.length; };
    const std::vector<Joint>& joints = world().joints();
    if (!world().settings().k) return false;  // positions move with a velocity that does not go on
    return Dof == 6 ||
           (world().settings().friction == 0 && std::none_of(joints.begin(), joints.end(), is_ball_joint));
  }

  void look_at_energy() {
    const Bodies<Dof>& bodies = world().bodies();
    double lift = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Vec3 way = scene_.h / 2 * (before_[b] + bodies.motion.W[b]).template head<3>();
      const Vec3 force = bodies.is_fixed(b) ? Vec3::Zero() : world().forces()[b];
      given_ += force.dot(way);
      lift += force.norm() * 0.1;  // by the width of the smallest body
    }
    given_ += world().work_of_drives();
    const double T = kinetic_energy(bodies);
    most_ = std::max(most_, T);
    if (world().steps() == 1)
      for (const Contact& contact : world().contacts())
        given_ += world().contact_stiffness() * std::pow(std::min(0.0, contact.gap), 2) / 2;
    // Joints change the speeds of motors and springs in the first steps, so that their work in them is not known.
    const auto is_driven = [](const Joint& joint) { return joint.motor || joint.spring; };
    const std::vector<Joint>& joints = world().joints();
    if (world().steps() <= 5 && std::any_of(joints.begin(), joints.end(), is_driven))
      given_ = std::max(given_, T - started_);
    compare("energy", T - started_ - given_, share_gained * (most_ + lift));
  }

  const RandomScene<Dof>& scene_;
  Findings findings_;
  RunCheck<Dof> run_check_;
  std::vector<Twist<Dof>> before_;
  Vec3 p0_, L_;           // the right values
  bool divided_ = false;  // the engine has divided a step
  double mass_ = 0, started_ = 0, given_ = 0, most_ = 0, pushed_ = 0;
};

template <int Dof>
Findings run(Random& random) {
  RandomScene<Dof> scene = RandomScene<Dof>::draw(random);
  Watch<Dof> watch(scene);
  Findings findings;
  try {
    for (int n = 0; n < steps; ++n) {
      scene.world.step(scene.h);
      findings = watch.look();
    }
  } catch (const SimulationDiverged& diverged) {
    findings.wrong["diverged"] = diverged.what();
  }
  return findings;
}

}  // namespace

Findings run_random_scene(std::uint64_t seed) {
  Random random(seed);
  return random.integer(0, 3) == 0 ? run<3>(random) : run<6>(random);
}

}  // namespace spook::testing
