// Setup of a world before its steps, and queries afterwards.
#include <algorithm>

#include "common/require.hpp"
#include "engine/support/parallel_for.hpp"
#include "engine/support/require_index.hpp"

namespace spook {

/// Throws std::invalid_argument if friction would have no bound although a force may press bodies together.
template <int Dof>
static void require_weight_in_box(const Settings<Dof>& settings, bool forced, bool rubs) {
  const bool boxed = rubs && settings.solver.friction == FrictionModel::box && !settings.soft_steps;
  if (boxed && forced && settings.gravity.isZero(0))
    throw std::invalid_argument(
        "gravity must not be 0 where force presses bodies together: the friction box takes its bound from it; "
        "solver cone_gauss_seidel() or two_pass() does not");
}

/// Throws std::invalid_argument for soft steps beside settings that they do not use.
template <int Dof>
static void require_soft_alone(const Settings<Dof>& settings) {
  if (!settings.soft_steps) return;
  require_sound(*settings.soft_steps);
  const auto refuse = [](const std::string& name, double value) {
    reject(name, value, "left out with soft_steps, whose springs follow from frequencies");
  };
  if (settings.k) refuse("k", *settings.k);
  if (settings.d) refuse("d", *settings.d);
  if (settings.integrator_order != 2)
    reject("integrator_order", settings.integrator_order, "2 with soft_steps");
}

template <int Dof>
World<Dof>::World(Settings<Dof> settings)
    : settings_(std::move(settings)),
      materials_({.friction = settings_.friction,
                  .restitution = settings_.impacts.value_or(ImpactLaw{}).restitution,
                  .k = settings_.k.value_or(1),  // until the first step
                  .d = settings_.d.value_or(relaxation_of_contacts)}) {
  require_all_finite("gravity", settings_.gravity);
  if (settings_.k) require_positive("k", *settings_.k);
  if (settings_.d) require_not_negative("d", *settings_.d);
  require_not_negative("friction", settings_.friction);
  if (settings_.contact_margin) require_not_negative("contact_margin", *settings_.contact_margin);
  if (!(settings_.viscosity > 0)) reject("viscosity", settings_.viscosity, "positive; it may be infinite");
  if (settings_.impacts) spook::resolve_impacts<Dof>({}, *settings_.impacts, bodies_.motion);
  require_positive("max_sweeps", settings_.solver_limits.max_sweeps);
  require_not_negative("tolerance", settings_.solver_limits.tolerance);
  if (settings_.max_parts < 1 || settings_.max_parts > 1024 ||
      (settings_.max_parts & (settings_.max_parts - 1)) != 0)
    reject("max_parts", settings_.max_parts, "a power of two from 1 to 1024");
  if (settings_.threads < 1 || settings_.threads > most_threads)
    reject("threads", settings_.threads, "from 1 to " + std::to_string(most_threads));
  if (!settings_.solver.solve) throw std::invalid_argument("solver must be one of solvers(), but is null");
  require_soft_alone(settings_);
  require_for_order_four();
  require_weight_in_box(settings_, settings_.force || settings_.wrench, settings_.friction > 0);
}

/// Returns the number of a body that was just added. If steps of order four do not allow the body, removes it and
/// throws.
template <int Dof>
int World<Dof>::keep_if_allowed(int body) {
  try {
    require_for_order_four();
  } catch (...) {
    bodies_.remove(index(body));
    shapes_.remove(body);
    throw;
  }
  return body;
}

template <int Dof>
int World<Dof>::add(const Body<Dof>& body) {
  const int i = bodies_.add(body);
  shapes_.add(i, shape_of(body), false);
  return keep_if_allowed(i);
}

template <int Dof>
int World<Dof>::add_fixed(const Vec3& x, double radius) {
  require_not_negative("radius", radius);
  const int i = bodies_.add_fixed(x);
  if (radius > 0) shapes_.add(i, Sphere{radius}, true);
  return keep_if_allowed(i);
}

// `if constexpr` below, though `requires` says the same: clang before 16 compiles these for point masses, too.
template <int Dof>
int World<Dof>::add_fixed_box(const Vec3& x, const Vec3& half_sides, const Quat& q) requires(Dof == 6) {
  int i = -1;
  if constexpr (Dof == 6) i = add_fixed(x, Cuboid{half_sides}, q);
  return i;
}

template <int Dof>
int World<Dof>::add_fixed(const Vec3& x, const Shape& shape, const Quat& q) requires(Dof == 6) {
  require_sound(shape);
  if (std::holds_alternative<PointSet>(shape))
    throw std::invalid_argument("shape of a static body must be another than points: planes alone stop them");
  require_unit_length("q", q.norm());
  const int i = bodies_.add_fixed(x);
  if constexpr (Dof == 6) bodies_.orientations.q.back() = q.normalized();
  shapes_.add(i, shape, true);
  return keep_if_allowed(i);
}

template <int Dof>
int World<Dof>::add_plane(const Vec3& n, double offset) {
  require_unit_length("n", n.norm());
  require_finite("offset", offset);
  const int i = bodies_.add_fixed(offset * n);
  shapes_.planes.push_back({.body = i, .x = offset * n, .n = n, .offset = offset});
  return keep_if_allowed(i);
}

template <int Dof>
void World<Dof>::remove_body(int body) {
  const std::size_t i = index(body);
  bodies_.remove(i);
  shapes_.remove(body);
  materials_.remove(body);
  std::erase_if(kinematic_, [&](const Kinematic<Dof>& one) { return one.body == body; });
  for (Kinematic<Dof>& other : kinematic_) other.body -= other.body > body;
  const auto is_of_it = [&](const Joint& joint) { return joint.i == body || joint.j == body; };
  joints_.erase(std::remove_if(joints_.begin(), joints_.end(), is_of_it), joints_.end());
  for (Joint& joint : joints_) {
    joint.i -= joint.i > body;
    joint.j -= joint.j > body;
  }
  ++removals_;
  forget_the_last_step();
}

static void require_no_spring(const Material& material) {
  if (material.k) reject("k", *material.k, "left out with soft_steps");
  if (material.d) reject("d", *material.d, "left out with soft_steps");
}

/// Throws for resistance to rolling or torsion in steps that have no rows of it.
template <int Dof>
static void require_no_resistance(const Settings<Dof>& settings, const Material& material) {
  if (Dof == 6 && !settings.soft_steps && settings.integrator_order == 2) return;
  const std::string why = Dof == 3              ? "a point mass does not turn"
                          : settings.soft_steps ? "soft steps have none"
                                                : "steps of order four have none";
  for (const auto& [name, length] : {std::pair("rolling_resistance", material.rolling_resistance),
                                     std::pair("torsional_resistance", material.torsional_resistance)})
    if (length.value_or(0) > 0) throw std::invalid_argument(std::string(name) + " must be 0: " + why);
}

template <int Dof>
void World<Dof>::set_material(int body, const Material& material) {
  if (settings_.soft_steps) require_no_spring(material);
  require_no_resistance(settings_, material);
  require_weight_in_box(settings_, settings_.force || settings_.wrench, material.friction.value_or(0) > 0);
  materials_.set(static_cast<int>(index(body)), material);
}

template <int Dof>
void World<Dof>::set_material(int i, int j, const Material& material) {
  if (index(i) == index(j)) reject("j", j, "another body than i");
  if (settings_.soft_steps) require_no_spring(material);
  require_no_resistance(settings_, material);
  require_weight_in_box(settings_, settings_.force || settings_.wrench, material.friction.value_or(0) > 0);
  materials_.set(i, j, material);
}

template <int Dof>
void World<Dof>::exclude_contacts(const std::vector<int>& bodies) {
  for (const int body : bodies) {
    index(body);
    if (std::count(bodies.begin(), bodies.end(), body) > 1) reject("body", body, "listed once");
  }
  if (bodies.size() < 2)
    reject("number of bodies", static_cast<double>(bodies.size()),
           "at least 2 to exclude contacts between them");
  shapes_.exclusions.add(bodies);
}

template <int Dof>
void World<Dof>::place(int body, const Vec3& x, const Vec3& v) {
  const std::size_t i = index(body);
  if (bodies_.is_fixed(i))
    throw std::invalid_argument("body " + std::to_string(body) + " is static: use move_fixed to move it");
  require_all_finite("x", x);
  require_all_finite("v", v);
  bodies_.x[i] = x;
  bodies_.motion.W[i].template head<3>() = v;
}

template <int Dof>
void World<Dof>::turn(int body, const Quat& q, const Vec3& omega) requires(Dof == 6) {
  const std::size_t i = index(body);
  if (bodies_.is_fixed(i))
    throw std::invalid_argument("body " + std::to_string(body) + " is static: it keeps its orientation");
  require_unit_length("q", q.norm());
  require_all_finite("omega", omega);
  if constexpr (Dof == 6) bodies_.orientations.q[i] = q.normalized();
  bodies_.motion.W[i].template tail<3>() = omega;
}

template <int Dof>
void World<Dof>::set_wrench(Wrench<Dof> wrench) {
  require_weight_in_box(settings_, settings_.force || wrench, materials_.rub());
  settings_.wrench = std::move(wrench);
  wrench_checked_ = false;
}

template <int Dof>
void World<Dof>::move_fixed(int body, const Vec3& x) {
  const std::size_t i = index(body);
  if (!bodies_.is_fixed(i)) reject("body", body, "a static body");
  require_not_a_plane(body);
  require_all_finite("x", x);
  bodies_.x[i] = x;
}

template <int Dof>
void World<Dof>::require_not_a_plane(int body) const {
  for (const Plane& plane : shapes_.planes)
    if (plane.body == body) reject("body", body, "another than a plane");
}

template <int Dof>
void World<Dof>::apply_central_impulse(int body, const Vec3& impulse) {
  const std::size_t i = index(body);
  require_all_finite("impulse", impulse);
  bodies_.motion.W[i].template head<3>() += bodies_.motion.inverse_mass[i].linear * impulse;
}

template <int Dof>
void World<Dof>::take_state_from(const World& other) {
  for (std::size_t i = 0; i < std::min(bodies_.size(), other.bodies_.size()); ++i) {
    const auto is_this = [&](const Kinematic<Dof>& one) { return one.body == static_cast<int>(i); };
    const bool is_static = bodies_.is_fixed(i) && std::none_of(kinematic_.begin(), kinematic_.end(), is_this);
    if (is_static || bodies_.is_fixed(i) != other.bodies_.is_fixed(i)) continue;
    bodies_.x[i] = other.bodies_.x[i];
    bodies_.motion.W[i] = other.bodies_.motion.W[i];
    if constexpr (Dof == 6) bodies_.orientations.q[i] = other.bodies_.orientations.q[i];
  }
  time_ = other.time_;
  if (settings_.integrator_order == other.settings_.integrator_order)
    h_ = other.h_;  // velocities lag by half of it
  place_on_keyframes();
  if (joints_.size() != other.joints_.size()) return;
  start_ = other.start_;
  for (const std::size_t hinge : hinges_) joints_[hinge].angle = other.joints_[hinge].angle;
  for (std::size_t n = 0; n < joints_.size(); ++n)
    joints_[n].recovered = !settings_.soft_steps && other.joints_[n].recovered;
}

template <int Dof>
Vec3 World<Dof>::force(std::size_t i) const {
  const Vec3 weight = bodies_.mass[i] * settings_.gravity;
  if (!settings_.force) return weight;
  return weight + settings_.force(i, bodies_.x);
}

template <int Dof>
std::size_t World<Dof>::index(int body) const {
  return require_index("body", body, bodies_.size());
}

template <int Dof>
std::size_t World<Dof>::first_row(int contact) const {
  return constraints_.normal_row(require_index("contact", contact, contacts_.size()));
}

template <int Dof>
double World<Dof>::lambda(int contact) const {
  return rows()[first_row(contact)].lambda;
}

template <int Dof>
Vec3 World<Dof>::impulse(int contact) const {
  Vec3 impulse = Vec3::Zero();
  const std::size_t first = first_row(contact);
  for (std::size_t row = first; row < first + constraints_.rows_per_contact; ++row)
    impulse += rows()[row].lambda * rows()[row].Gj.template head<3>();
  return impulse;
}

template <int Dof>
Vec3 World<Dof>::contact_force(int contact) const {
  return impulse(contact) / h_;
}

template <int Dof>
StepReport World<Dof>::report() const {
  return {.pairs = pairs_,
          .contacts = static_cast<int>(contacts_.size()),
          .impacts = static_cast<int>(impacts_.size()),
          .rows = static_cast<int>(rows().size()),
          .iterations = static_cast<int>(solved_.history.size()),
          .residual = settings_.stepper                 ? (solved_.history.empty() ? 0 : solved_.history.back())
                      : rows().empty()                  ? 0
                      : settings_.integrator_order == 4 ? solved_.history.back()
                      : settings_.soft_steps
                          ? residual_on_cones(constraints_.friction, rows(), bodies_.motion.W)
                      : settings_.solver.friction == FrictionModel::cone
                          ? residual_on_cones(constraints_.friction, rows(), V_)
                          : residual(rows(), V_),
          .trouble = solved_.trouble};
}

}  // namespace spook
