#pragma once
// The world: bodies, what holds them together, and the step that moves them.
//
//   find contacts -> resolve impacts -> build rows -> solve -> integrate
//
//   contacts    at x_n, where gap <= margin                                        Eq. (3.1), (8.1)-(8.10)
//   impacts     of what approaches fast: W changes at once                         Eq. (7.1)-(7.10)
//   rows        S λ = B, with W = v_{n-1/2} and the forces at x_n                  Eq. (3.7), (4.4)
//   solve       λ and V = M⁻¹ Gᵀ λ; once more where overlaps would leave a speed   Eq. (4.6), (4.7), (7.17)
//   integrate   W += h M⁻¹ f + V, then x += h v and q turns by h ω                 Eq. (1.3), (1.4), (2.4)-(2.11)
//
// Each stage calls the functions of the chapters. One for which a scene has nothing does not run: no shapes, no search;
// no restitution, no impacts; no friction, one row a contact; no rows, no solve; point masses, nothing that turns.
//
// A step is divided into parts where joints need it: engine/constraints/step_parts.hpp.
//
// Where forces and joints are all there is, a step can be composed of five to be of order four: engine/integration/rattle.hpp.
#include <cstdint>
#include <optional>
#include <vector>

#include "07_impacts/impacts.hpp"
#include "engine/bodies/materials.hpp"
#include "engine/collision/contacts.hpp"
#include "engine/constraints/contact_rows.hpp"
#include "engine/constraints/default_stiffness.hpp"
#include "engine/constraints/joint_rows.hpp"
#include "engine/constraints/step_parts.hpp"
#include "engine/constraints/warm_start_cache.hpp"
#include "engine/integration/rattle.hpp"
#include "engine/integration/rotation.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/support/abi_check.hpp"
#include "engine/world/simulation_diverged.hpp"
#include "engine/world/step_timer.hpp"

namespace spook {

/// Force and torque on body i [N, N m], from all bodies as they are and the time [s]. Positions are those of x_n; leapfrog's
/// velocities are half a step older, so that what depends on them is of first order.
template <int Dof>
using Wrench = std::function<Twist<Dof>(std::size_t i, const Bodies<Dof>& bodies, double time)>;

template <int Dof>
class World;

/// A step of another engine: moves the bodies of a world by `h` [s], velocities from t_{n-1/2} to t_{n+1/2}.
template <int Dof>
using Stepper = std::function<void(const World<Dof>& world, double h, Bodies<Dof>& bodies)>;

template <int Dof>
struct Settings {
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s²]
  ForceField force = nullptr;        ///< on each body, beside its weight [N]. Default: none
  Wrench<Dof> wrench = nullptr;      ///< more forces, and torques [N, N m]. Default: none
  /// Stiffness of contacts and joints [N/m]. If k is set, contacts are springs, and an overlap may throw its bodies. Default:
  /// all forces of a step together compress one contact by a ten-thousandth of the smallest size, and joints are nearly
  /// rigid, engine/constraints/default_stiffness.hpp; an overlap leaves no speed, engine/solvers/recovery.hpp.
  std::optional<double> k = {};
  /// Relaxation of contacts and joints [steps]: a larger d dissipates more energy, see chapter 06. Default: 3 for contacts,
  /// which settle, and 1/4 for joints, which swing.
  std::optional<double> d = {};
  double friction = 0;      ///< μ; 0: no friction rows
  double viscosity = 1e12;  ///< c of Eq. (5.4), by which a stuck contact creeps [N s/m]; may be infinite
  /// Restitution and friction of impacts. To the threshold |gravity| h is added, since gravity changes a speed by as much
  /// in a step. Default: no impacts.
  std::optional<ImpactLaw> impacts = {};
  bool sliding_tangents = false;  ///< friction along the slip, Eq. (9.2)
  /// One of engine/solvers/registry.hpp, or one of your own. The solver also selects the friction model. Default: each
  /// island of bodies by factors or sweeps, with friction on Coulomb's cones.
  Solver<Dof> solver = automatic<Dof>();
  /// Rows begin with the impulses of the last step. This is stable where a step solves the part 1/(1 + d) of what a row
  /// lacks, Eq. (10.12).
  bool warm_start = false;
  /// Largest gap of a contact [m]: within it a slightly open contact keeps its row and its impulse. Default: the distance
  /// that a body falls from rest in a step, |gravity| h², or a hundredth of the smallest shape's size where that is less;
  /// and 1e-9 of that size more, so that round-off cannot drop a touching contact.
  std::optional<double> contact_margin = {};
  [[no_unique_address]] RotationRule<Dof> rotation = {};  ///< how rigid bodies turn
  /// Order of the integrator: 2, leapfrog, or 4, composed of five leapfrogs, engine/integration/rattle.hpp. With 4
  /// velocities are at the time of the positions, joints are rigid, and the solver is not used.
  int integrator_order = 2;
  /// Largest number of parts of a step. Steps are divided where bodies on joints turn by too much in one, or a load is heavy
  /// for a joint, engine/constraints/step_parts.hpp; not those of a world or joint with a given k. Default: 32; 1: never.
  int max_parts = 32;
  int threads =
      1;  ///< worker threads for contact search, rows, sweeps; the result does not depend on their number
  /// When the solver stops. It stops at the latest when a sweep changes less than four roundings of |gravity| h.
  StopRule solver_limits = {};
  /// Replaces the stages of the step, whose contacts, rows and report are empty then. Default: none
  Stepper<Dof> stepper = nullptr;
};

/// The relaxation of contacts and joints, unless another is set [steps].
inline constexpr double relaxation_of_contacts = 3, relaxation_of_joints = 0.25;

/// What the last step did.
struct StepReport {
  int pairs = 0;  ///< pairs of shapes that were looked at
  int contacts = 0;
  int impacts = 0;
  int rows = 0;
  int iterations = 0;   ///< sweeps, factorisations, whatever the solver makes
  double residual = 0;  ///< how far λ is from a solution [m/s], Eq. (4.8) or (9.7); 0 when there are no rows
  std::string trouble;  ///< fallback reason of the solver; empty if none
};

/// A copy has a copy of all, its solver included: it goes on as the first would have, and shares nothing with it.
template <int Dof>
class World {
 public:
  /// Throws std::invalid_argument, naming the parameter, unless gravity is finite, k > 0, d >= 0, friction >= 0,
  /// viscosity > 0, and the impact law, the solver and its stop rule are sound; and for the friction box, whose bound
  /// is of gravity, Eq. (5.7), where `force` is all that presses. With steps that are composed also for d > 0
  /// and another rotation than splitting, which are not symmetric in time; from then on whatever would let two bodies
  /// touch is refused, and in the first step a wrench that sees velocities.
  explicit World(Settings<Dof> settings);

  /// Adds a body and returns its index; see Bodies::add for what is refused.
  int add(const Body<Dof>& body);

  /// Adds a static body with a sphere of that radius [m], or without a shape for 0.
  int add_fixed(const Vec3& x, double radius = 0);

  /// Adds a static body with a shape, such as Capsule{.radius = 0.1, .half_length = 0.5}. Throws std::invalid_argument for
  /// a shape that is not sound, and for points, which planes alone stop.
  int add_fixed(const Vec3& x, const Shape& shape, const Quat& q) requires(Dof == 6);

  /// Adds a static box.
  int add_fixed_box(const Vec3& x, const Vec3& half_sides, const Quat& q = Quat::Identity()) requires(Dof == 6);

  /// Adds the half-space n·x < offset as a fixed body. Throws std::invalid_argument unless |n| = 1.
  int add_plane(const Vec3& n, double offset);

  /// Adds a joint and returns its index.
  /// Throws std::invalid_argument, naming the parameter, for an index that is no body's, a body joined to itself,
  /// two fixed bodies, a point beside the centre of a point mass, a bad k or d, a length that is not positive, a
  /// distance whose two points coincide, and a hinge, slider or weld of point masses, or whose axis or rest is not of unit
  /// length; for an empty range of limits, a bad motor, and a motor or limit on a joint without a free axis.
  int add_joint(const Joint& joint);

  /// Drives a hinge or slider otherwise from now on, or with {} no longer. Throws std::invalid_argument as add_joint.
  void set_motor(int joint, const std::optional<Motor>& motor) requires(Dof == 6);

  /// Sets the material of a body, or of a pair of bodies, where it touches; engine/bodies/materials.hpp says how those of two are put together.
  /// An impact law's own restitution and friction are then those of pairs of which nothing was said.
  void set_material(int body, const Material& material);
  void set_material(int i, int j, const Material& material);

  /// Puts a body somewhere, and lets it move and turn: velocities as leapfrog has them, half a step behind.
  void place(int body, const Vec3& x, const Vec3& v);
  void turn(int body, const Quat& q, const Vec3& omega) requires(Dof == 6);

  /// Another force and torque from now on, in place of `wrench` in the settings; none for null. Throws as the settings'
  /// would.
  void set_wrench(Wrench<Dof> wrench);

  /// Takes a body out, with its joints; those after it move up by one. What the last step did is forgotten.
  void remove_body(int body);

  /// Takes a joint out; those after it move up by one. What the last step did is forgotten, as its rows are numbered
  /// otherwise.
  void remove_joint(int joint);

  /// Puts a fixed body elsewhere. Throws std::invalid_argument for a body that moves, and for a plane.
  void move_fixed(int body, const Vec3& x);

  /// Moves a static body from now on with a velocity [m/s], and turns it with an angular velocity [rad/s], both about its
  /// centre and in world coordinates: a kinematic body, such as a platform. Contacts, friction and joints see its motion, and
  /// nothing changes it. Zero stops it. Throws std::invalid_argument for a body that is not static, a plane, a velocity that
  /// is not finite, and with integrator_order 4.
  void set_velocity(int body, const Vec3& v);
  void set_velocity(int body, const Vec3& v, const Vec3& omega) requires(Dof == 6);

  /// Moves the surface of a static body, and not the body, with a velocity [m/s]: a conveyor belt. Throws as set_velocity, but
  /// takes a plane.
  void set_surface_velocity(int body, const Vec3& v);

  /// Whether static bodies have been given a velocity.
  bool has_kinematic_bodies() const { return !kinematic_.empty(); }

  /// Gives a body an impulse through its centre [N s].
  void apply_central_impulse(int body, const Vec3& impulse);

  /// Copies positions and velocities from `other` for the bodies that move in both; its time goes on,
  /// and where there are as many joints, rows begin with its impulses.
  void take_state_from(const World& other);

  /// Takes every velocity half a step back, to where leapfrog wants it: Eq. (1.5). Once, before the first step. Steps that
  /// are composed want them where they are. Ignores constraint forces. Throws std::invalid_argument the
  /// second time, and after a step.
  void start_half_step_back(double h);

  /// The same, with what contacts and joints hold against: positions and velocities are those of time 0 then, the start of
  /// second order that constraints want. Found by solving for the accelerations that G v = 0 asks for, contacts and
  /// friction within their bounds.
  void start_consistently(double h);

  /// Moves the world on by `h` [s]. Throws std::invalid_argument unless h is positive and finite, and SimulationDiverged when a
  /// body is not finite afterwards, or the two points of a distance coincide before, or are infinitely far apart.
  void step(double h);

  const Settings<Dof>& settings() const { return settings_; }
  const Shapes& shapes() const { return shapes_; }
  const Materials& materials() const { return materials_; }
  const Bodies<Dof>& bodies() const { return bodies_; }
  std::int64_t steps() const { return steps_; }  ///< taken so far
  double time() const { return time_; }          ///< [s]

  /// The stiffness of contacts whose bodies have none of their own, in the last step [N/m].
  double contact_stiffness() const { return materials_.stiffness(); }

  /// Where a body's numbers are in bodies(). Throws std::invalid_argument for an index that is no body's.
  std::size_t index(int body) const;

  const Vec3& x(int body) const { return bodies_.x[index(body)]; }                     ///< [m]
  Vec3 v(int body) const { return bodies_.motion.W[index(body)].template head<3>(); }  ///< [m/s]

  /// How far velocities are behind positions [s]: half a step of `h`, and not at all where steps are composed.
  double velocity_lag(double h) const { return settings_.integrator_order == 4 ? 0 : h / parts_ / 2; }

  /// Parts of the last step: engine/constraints/step_parts.hpp. Contacts, rows, forces and impulses are those of its last part.
  int parts() const { return parts_; }

  /// The velocity at the time of the position, from one that is half a step of `h` behind [m/s].
  Vec3 synchronized_velocity(int body, double h) const;

  /// The same of what turns [rad/s]: by the gyroscopic torque, where the rule takes it for one.
  Vec3 synchronized_angular_velocity(int body, double h) const requires(Dof == 6);

  /// The contacts of the last step, the impulse of each along its normal [N s], and all of it on body j, friction
  /// included.
  const std::vector<Contact>& contacts() const { return contacts_; }
  double lambda(int contact) const;
  Vec3 impulse(int contact) const;

  /// The joints, and the impulse of one row of a joint in the last step [N s].
  const std::vector<Joint>& joints() const { return joints_; }
  double joint_lambda(int joint, int row = 0) const;

  /// The angle of a hinge, its turns counted [rad], or the shift of a slider [m]; and how fast it changes, half a step
  /// before [rad/s, m/s]. Both are of j as i sees it.
  double joint_position(int joint) const requires(Dof == 6);
  double joint_speed(int joint) const requires(Dof == 6);

  /// What a hinge's or slider's motor, and its limit, did to body j in the last step, along what is free [N m or N]; zero
  /// before, and for what is not there.
  double motor_force(int joint) const requires(Dof == 6);
  double limit_force(int joint) const requires(Dof == 6);

  /// The work of all motors and kinematic bodies in the last step, that of impacts left out [J].
  double work_of_drives() const { return work_of_drives_; }

  /// Beside its force, the torque of a joint on body j in the last step [N m]: about the point where the force acts.
  Vec3 joint_torque(int joint) const requires(Dof == 6);

  /// A row of a joint as the last step had it; null before.
  const Row<Dof>* joint_row(int joint, int row) const;

  /// What a joint, or a contact with its friction, did to body j in the last step, as a force [N]; zero before.
  Vec3 joint_force(int joint) const;
  Vec3 contact_force(int contact) const;

  /// The force on each body in the last step [N], the mean of it where steps are composed, its rows, and what the solver says of them; none of them before.
  const std::vector<Vec3>& forces() const { return forces_; }
  const std::vector<Vec3>& torques() const { return torques_; }  ///< with a wrench only [N m]
  const std::vector<Row<Dof>>& rows() const { return rows_; }
  const SolveReport& solved() const { return solved_; }

  /// What the last step did. The residual is computed here, not in the step.
  StepReport report() const;

  /// Rows that were updated so far, each as often as it was: a cost that is the same on every machine.
  std::int64_t row_updates() const { return row_updates_; }

  /// Starts stage timing.
  void time_stages() { clock_.start(); }
  const StageTimes& stage_times() const { return clock_.times(); }

 private:
  void step_part(double h);
  void divide_steps(double h);
  void find_joint_forces(double h);
  void find_contacts(double h);
  double margin(double h) const;
  void evaluate_forces(double h);
  void shift_to_step(double h);
  void add_wrenches();
  Vec3 turned_by_torques(std::size_t i, const Vec3& omega, double h) const;
  void resolve_impacts(double h);
  void set_default_stiffness(double h);
  void build_rows(double h);
  void solve_rows(double h);
  SolverInput<Dof> solver_input(double h, const StopRule& stop);
  void warm_start_rows(double h);
  StopRule stop_rule(double h) const;
  void take_out_recovery(double h);
  void add_work_of_drives();
  void move_kinematic(double h);
  std::size_t static_body(int body) const;
  void require_not_a_plane(int body) const;
  void drive(std::size_t i, const Twist<Dof>& W, bool moves);
  void integrate(double h);
  Vec3 turned(std::size_t i, Vec3 omega, double h) requires(Dof == 6);
  void end_step(double h);
  void step_composed(double h);
  void step_elsewhere(double h);
  void kick_all(double h, double time);
  void require_smooth() const;
  void require_smooth(const Joint& joint) const;
  void require_no_relaxation(double d) const;
  void require_wrench_of_places() const;

  Vec3 force(std::size_t i) const;
  void begin_half_a_step_back(const char* how, double h);
  void forget_the_last_step();
  void prepare_motion(double h);
  void require_directions(double h) const;
  void count_turns();
  void complete(Joint& joint) const;
  const Joint& free_joint(int joint) const;
  double along_free(int joint, int row) const;
  void require_finite_bodies() const;
  std::size_t first_row(int contact) const;
  std::size_t joint_index(int joint) const;

  Settings<Dof> settings_;
  Bodies<Dof> bodies_;
  Shapes shapes_;
  ContactFinder finder_;
  Materials materials_;
  std::vector<Joint> joints_;            // with k and d
  std::vector<std::size_t> joint_rows_;  // the first row of each joint
  std::size_t next_joint_row_ = 0;
  std::vector<std::size_t> hinges_;  // which joints they are
  std::vector<Vec3> forces_;         // on each body at x_n [N]
  std::vector<Vec3> torques_;        // with a wrench only [N m]
  std::vector<Contact> contacts_;    // of the last step
  std::vector<Row<Dof>> rows_;       // of the joints, then of the contacts
  std::size_t first_contact_row_ = 0;
  std::vector<FrictionContact> rubbing_;  // where friction follows what presses
  std::vector<Twist<Dof>> V_;             // what the rows add to each velocity
  std::vector<Twist<Dof>> recovered_;     // what is taken out of each velocity again, Eq. (7.17)
  WarmStartCache start_;                  // for the rows of the next step
  SolveReport solved_;
  StepTimer clock_;
  std::int64_t steps_ = 0;
  double time_ = 0;
  double largest_load_ = 0;     // sum of the forces on all dynamic bodies [N]
  double h_ = 0;                // of the last step [s]
  double work_of_drives_ = 0;   // in the last step [J]
  std::vector<int> kinematic_;  // static bodies with a velocity
  std::vector<int> carried_;    // those of them that move with it
  int parts_ = 1, calm_steps_ = 0;
  int pairs_ = 0;
  int impacts_ = 0;
  bool half_step_back_ = false;
  std::int64_t row_updates_ = 0;
  ScratchCache<RattleJoints<Dof>> rattle_joints_;  // joints of steps that are composed
  std::vector<Vec3> impulses_;                     // of the forces, in one of them [N s]
  std::vector<Vec3> spins_;                        // of the torques [N m s]
};

/// Orientation, and angular velocity in world coordinates [rad/s], of a rigid body.
inline const Quat& orientation(const World<6>& world, int body) {
  return world.bodies().orientations.q[world.index(body)];
}
inline Vec3 angular_velocity(const World<6>& world, int body) {
  return world.bodies().motion.W[world.index(body)].tail<3>();
}

}  // namespace spook
