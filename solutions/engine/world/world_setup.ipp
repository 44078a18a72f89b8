// Construction of a world: its settings, bodies, materials and excluded contacts.
#include "common/require.hpp"

namespace spook {

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
  if (settings_.soft_steps) parts_ = settings_.soft_steps->substeps;
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

}  // namespace spook
