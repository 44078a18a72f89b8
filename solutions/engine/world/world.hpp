#pragma once
// The world: bodies, joints, and the step that moves them.
//
//   find contacts -> evaluate forces -> resolve impacts -> build rows -> solve -> integrate
//
//   contacts    at x_n, where gap <= margin                                        Eq. (3.1), (8.1)-(8.10)
//   forces      f and τ at x_n, and from them W_f = h M⁻¹ f                        Eq. (1.1), (4.4)
//   impacts     fast approaching contacts: W changes at once                       Eq. (7.1)-(7.10)
//   rows        S λ = B, with W = v_{n-1/2} and the forces at x_n                  Eq. (3.7), (4.4)
//   solve       λ and V = M⁻¹ Gᵀ λ; again if overlaps would leave a speed          Eq. (4.6), (4.7), (7.17)
//   integrate   W += h M⁻¹ f + V, then x += h v and q turns by h ω                 Eq. (1.3), (1.4), (2.4)-(2.11)
//
// Each stage calls the functions of the chapters. A stage that a scene does not need does not run: without shapes no
// contact search, without restitution no impacts, without friction one row per contact, without rows no solve. Point
// masses have no orientations.
//
// A step is divided into parts if joints need it: engine/constraints/step_parts.hpp.
//
// For scenes with forces and joints only, a step of order four composed of five: engine/integration/rattle.hpp.
#include <cstdint>
#include <optional>
#include <vector>

#include "07_impacts/impacts.hpp"
#include "engine/bodies/keyframes.hpp"
#include "engine/bodies/materials.hpp"
#include "engine/collision/contacts.hpp"
#include "engine/constraints/contact_rows.hpp"
#include "engine/constraints/default_stiffness.hpp"
#include "engine/constraints/joint_rows.hpp"
#include "engine/constraints/soft_contacts.hpp"
#include "engine/constraints/step_parts.hpp"
#include "engine/constraints/stripes.hpp"
#include "engine/constraints/warm_start_cache.hpp"
#include "engine/impacts/impacts.hpp"
#include "engine/integration/rattle.hpp"
#include "engine/integration/rotation.hpp"
#include "engine/solvers/recovery.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/support/abi_check.hpp"
#include "engine/world/simulation_diverged.hpp"
#include "engine/world/step_timer.hpp"

namespace spook {

/// Returns the force and torque on body i [N, N m], given the current bodies and the time [s]. Positions are x_n;
/// leapfrog's velocities are half a step older, so a force that depends on them is of first order.
template <int Dof>
using Wrench = std::function<Twist<Dof>(std::size_t i, const Bodies<Dof>& bodies, double time)>;

/// Returns the velocity of a kinematic body at a time [s]: v, then ω, in world coordinates [m/s, rad/s].
template <int Dof>
using VelocityFunction = std::function<Twist<Dof>(double time)>;

/// A static body with a velocity.
template <int Dof>
struct Kinematic {
  int body;
  bool moves = true;                         ///< with its velocity; else its surface alone
  VelocityFunction<Dof> velocity = nullptr;  ///< null: constant
  std::optional<Keyframes> keyframes = {};   ///< where it is, from which its velocity follows
};

template <int Dof>
class World;

/// A step of another engine: moves the bodies of a world by `h` [s], velocities from t_{n-1/2} to t_{n+1/2}. Returns
/// the report of its solver; without one, an empty report that has converged.
template <int Dof>
using Stepper = std::function<SolveReport(const World<Dof>& world, double h, Bodies<Dof>& bodies)>;

template <int Dof>
struct Settings {
  Vec3 gravity = Vec3(0, 0, -9.81);  ///< [m/s²]
  ForceField force = nullptr;        ///< on each body, in addition to its weight [N]. Default: none
  Wrench<Dof> wrench = nullptr;      ///< further forces, and torques [N, N m]. Default: none
  /// Stiffness of contacts and joints [N/m]. If k is set, contacts are springs, and an overlap may throw its bodies.
  /// Default: all forces of a step together compress one contact by a ten-thousandth of the smallest size, joints are
  /// nearly rigid, engine/constraints/default_stiffness.hpp, and overlaps and exceeded limits leave no speed,
  /// engine/solvers/recovery.hpp.
  std::optional<double> k = {};
  /// Relaxation of contacts and joints [steps]: a larger d dissipates more energy, see chapter 06. Default: 3 for
  /// contacts, which damps bouncing, and 1/4 for joints, which keeps swinging.
  std::optional<double> d = {};
  double friction = 0;      ///< μ; 0: no friction rows
  double viscosity = 1e12;  ///< of sticking contacts, c of Eq. (5.4) [N s/m]; may be infinite
  /// Restitution and friction of impacts. The threshold is increased by |gravity| h, which gravity adds in a step. If h
  /// is below √(2 m/k), it is increased by the larger one of two other speeds instead: |gravity| √(2 m/k), of a bounce
  /// as high as the sag of the contact, and F/√(k m), which a contact with the force F can give to its two bodies. Soft
  /// steps increase it by |gravity| h alone. Default: no impacts.
  std::optional<ImpactLaw> impacts = {};
  bool sliding_tangents = false;  ///< first tangent along the slip, Eq. (9.2)
  /// A solver of engine/solvers/registry.hpp, or your own. The solver also selects the friction model. Default: factors
  /// or sweeps for each island of bodies, with friction on Coulomb's cones.
  Solver<Dof> solver = automatic<Dof>();
  /// Starts rows with the impulses of the last step. This is stable if a solve removes more than the fraction 1/(1 + d)
  /// of the residual, Eq. (10.12).
  bool warm_start = false;
  /// Largest gap of a contact [m]: within it a slightly open contact keeps its row and its impulse. Default: |gravity|
  /// h², or a hundredth of the smallest shape's size if that is less; in soft steps what bodies can close in a step, or
  /// a tenth of that size if this is less. In all cases 1e-9 of the size is added, so that round-off cannot drop a
  /// touching contact.
  std::optional<double> contact_margin = {};
  [[no_unique_address]] RotationRule<Dof> rotation = {};  ///< update rule for orientations
  /// Order of the integrator: 2 is leapfrog; 4 is composed of five leapfrogs, engine/integration/rattle.hpp. At order 4
  /// velocities and positions belong to the same time, joints are rigid, and the solver is not used.
  int integrator_order = 2;
  /// Largest number of parts of a step. A step is divided if bodies on joints turn too far in it, or if a load is heavy
  /// for a joint: engine/constraints/step_parts.hpp. Worlds and joints with a given k do not divide steps. Default: 32;
  /// 1: never.
  int max_parts = 32;
  /// Soft steps, the method of today's game engines: fast, and accurate to a per cent or so. They have contacts on
  /// Coulomb's cones and warm starts, and do not use `solver`, `warm_start` and `max_parts`. Then the settings and
  /// materials must not have k and d, and `Joint::spring` and ropes are refused. A joint with a k of its own is a
  /// spring. Default: none
  std::optional<SoftSteps> soft_steps = {};
  int threads = 1;  ///< worker threads for contacts, rows, sweeps and bodies; they change no bit of the result
  /// Stop rule of the solver. A solver also stops when a sweep changes less than four rounding errors of |gravity| h.
  StopRule solver_limits = {};
  /// Replaces the stages of the step, whose contacts and rows are empty then. The report has its iterations, and the
  /// last entry of its history for a residual. Default: none
  Stepper<Dof> stepper = nullptr;
};

/// Default relaxation of contacts and of joints [steps].
inline constexpr double relaxation_of_contacts = 3, relaxation_of_joints = 0.25;

/// Counts and residual of the last step.
struct StepReport {
  int pairs = 0;  ///< pairs of shapes that may touch by their bounds
  int contacts = 0;
  int impacts = 0;
  int rows = 0;
  int iterations = 0;   ///< sweeps, factorisations, or other iterations of the solver
  double residual = 0;  ///< residual of λ [m/s], Eq. (4.8) or (9.7); 0 without rows
  std::string trouble;  ///< fallback reason of the solver; empty if none
};

/// A world of bodies and joints. A copy includes the solver's state: it continues as the original would, and shares
/// nothing with it. So `saved = world`, and later `world = saved`, go back to a step.
template <int Dof>
class World {
 public:
  /// Throws std::invalid_argument, naming the parameter, unless gravity is finite, k > 0, d >= 0, friction >= 0,
  /// viscosity > 0, and the impact law, the solver and its stop rule are valid. The friction box takes its bounds from
  /// gravity, Eq. (5.7). So also throws for a box without gravity, if `force` or `wrench` is set.
  ///
  /// Order 4 needs steps that are symmetric in time: it also throws for d > 0 and for rotation rules other than
  /// splitting. Later calls then throw for anything that could make two bodies touch, and the first step throws for a
  /// wrench that depends on velocities.
  explicit World(Settings<Dof> settings);

  /// Adds a body and returns its index; see Bodies::add for what is refused.
  int add(const Body<Dof>& body);

  /// Adds a static body with a sphere of that radius [m], or without a shape if the radius is 0.
  int add_fixed(const Vec3& x, double radius = 0);

  /// Adds a static body with a shape, such as Capsule{.radius = 0.1, .half_length = 0.5}. Throws std::invalid_argument
  /// for an invalid shape, and for a point set, which only planes can touch.
  int add_fixed(const Vec3& x, const Shape& shape, const Quat& q) requires(Dof == 6);

  /// Adds a static box.
  int add_fixed_box(const Vec3& x, const Vec3& half_sides, const Quat& q = Quat::Identity()) requires(Dof == 6);

  /// Adds the half-space n·x < offset as a static body. Throws std::invalid_argument unless |n| = 1.
  int add_plane(const Vec3& n, double offset);

  /// Adds a joint and returns its index. Throws std::invalid_argument, naming the parameter, for:
  /// - a body index out of range, a body joined to itself, two static bodies;
  /// - a point off the centre of a point mass, a bad k or d;
  /// - a length that is not positive, a distance whose two points coincide;
  /// - a hinge, slider or weld of point masses, or with an axis or rest that is not of unit length;
  /// - an empty range of limits, a bad motor or spring, and any of these on a joint without a free axis;
  /// - a spring or rope in soft steps.
  int add_joint(const Joint& joint);

  /// Replaces the motor of a hinge or slider; {} removes the motor. Throws std::invalid_argument as add_joint does.
  void set_motor(int joint, const std::optional<Motor>& motor) requires(Dof == 6);

  /// Replaces the spring of a hinge or slider; {} removes the spring. Throws std::invalid_argument as add_joint does.
  void set_spring(int joint, const std::optional<Spring>& spring) requires(Dof == 6);

  /// Sets the material of a body, or of the contact of two bodies. engine/bodies/materials.hpp combines the materials
  /// of two bodies. All other pairs have the restitution of the impact law. Once any material is set, impacts have
  /// `Settings::friction`, and not the friction of the impact law. Throws std::invalid_argument for numbers out of
  /// range, and for resistance to rolling or torsion of point masses, in soft steps, and with integrator_order 4.
  void set_material(int body, const Material& material);
  void set_material(int i, int j, const Material& material);

  /// Excludes contacts: no two of these bodies touch from now on. A world may have several such lists, and a body may
  /// be in more than one. By default two bodies may touch even if a joint connects them. Throws std::invalid_argument
  /// for an index out of range, a body that is there twice, and fewer than two bodies.
  void exclude_contacts(const std::vector<int>& bodies);

  /// Sets the position and velocity, or the orientation and angular velocity, of a dynamic body. Leapfrog's velocities
  /// are half a step older than its positions.
  void place(int body, const Vec3& x, const Vec3& v);
  void turn(int body, const Quat& q, const Vec3& omega) requires(Dof == 6);

  /// Replaces `wrench` of the settings from now on; null removes the wrench. Throws as the constructor does for the
  /// settings.
  void set_wrench(Wrench<Dof> wrench);

  /// Removes a body and its joints. The indices of later bodies and joints decrease. Clears the results of the last
  /// step.
  void remove_body(int body);
  /// The number of bodies removed so far. If it has changed, indices of bodies have changed.
  std::int64_t removals() const { return removals_; }

  /// Removes a joint. The indices of later joints decrease by one. Clears the results of the last step, whose rows were
  /// numbered with the joint.
  void remove_joint(int joint);

  /// Moves a static body to x. Throws std::invalid_argument for a dynamic body and for a plane.
  void move_fixed(int body, const Vec3& x);

  /// Moves a static body from now on with a velocity [m/s], and turns it with an angular velocity [rad/s], both about
  /// its centre and in world coordinates: a kinematic body, such as a platform. Rows of contacts, friction and joints
  /// contain its velocity, and nothing changes it. Zero stops it. Throws std::invalid_argument for a body that is not
  /// static, a plane, a velocity that is not finite, and with integrator_order 4.
  void set_velocity(int body, const Vec3& v);
  void set_velocity(int body, const Vec3& v, const Vec3& omega) requires(Dof == 6);

  /// Moves the surface of a static body, and not the body, with a velocity [m/s]: a conveyor belt. Throws as
  /// set_velocity, but takes a plane, whose velocity must have no part along the normal.
  void set_surface_velocity(int body, const Vec3& v);

  /// Makes a static body kinematic, with a velocity that depends on time; the body moves, as with set_velocity. A step
  /// takes the velocity at its middle, so that positions are of second order. A step throws std::invalid_argument,
  /// naming the velocity, if it is not finite.
  void set_velocity_function(int body, VelocityFunction<Dof> velocity);

  /// Moves a static body along keyframes, and places it where it is at the present time. After each step it is where
  /// the keyframes say, and rows of contacts and joints contain the velocity that takes it there. Throws as
  /// set_velocity.
  void set_keyframes(int body, Keyframes keyframes);

  /// Returns whether static bodies have been given a velocity.
  bool has_kinematic_bodies() const { return !kinematic_.empty(); }
  const std::vector<Kinematic<Dof>>& kinematic_bodies() const { return kinematic_; }

  /// Gives a body an impulse through its centre [N s].
  void apply_central_impulse(int body, const Vec3& impulse);

  /// Copies the time of `other`, and positions and velocities of the bodies that are dynamic in both worlds or
  /// kinematic in this one. If both worlds have as many joints, rows start with the impulses of `other`.
  void take_state_from(const World& other);

  /// Writes or reads all that steps change, so that a run continues with the same bits in another process. A reading
  /// world must have been built as the writing one was, by the same program. Throws std::invalid_argument for other
  /// masses, sizes, kinds or points of joints, gravity, friction, viscosity, k, d or integrator_order, and for a world
  /// with a stepper; std::runtime_error for a state that ends too early. engine/support/state_stream.hpp has
  /// bytes_of_state(world) and read_state(bytes, world).
  void state(StateStream& s);

  /// Moves every velocity half a step back, as leapfrog's start needs: Eq. (1.5). Call it once, before the first step.
  /// Ignores constraint forces. Does nothing at order 4. Throws std::invalid_argument on a second call, and after a
  /// step.
  void start_half_step_back(double h);

  /// Does the same with the forces of contacts and joints included: a start of second order. Before it, positions and
  /// velocities belong to time 0. Solves for the accelerations that keep G v = 0, with contacts and friction within
  /// bounds.
  void start_consistently(double h);

  /// Advances the world by `h` [s]. Throws std::invalid_argument unless h is positive and finite. Throws
  /// SimulationDiverged if a body is not finite afterwards, or if the two points of a distance joint coincide or are
  /// infinitely far apart before. A step that another exception ends, such as one of a velocity function, does not
  /// count in steps(), but may have moved bodies.
  void step(double h);

  const Settings<Dof>& settings() const { return settings_; }
  const Shapes& shapes() const { return shapes_; }
  const Materials& materials() const { return materials_; }
  const Bodies<Dof>& bodies() const { return bodies_; }
  std::int64_t steps() const { return steps_; }  ///< number of steps so far
  double time() const { return time_; }          ///< [s]

  /// The default stiffness of contacts in the last step [N/m]: that of bodies without a k of their own.
  double contact_stiffness() const { return materials_.stiffness(); }

  /// The index of a body in the arrays of bodies(). Throws std::invalid_argument for an index out of range.
  std::size_t index(int body) const;

  const Vec3& x(int body) const { return bodies_.x[index(body)]; }                     ///< [m]
  Vec3 v(int body) const { return bodies_.motion.W[index(body)].template head<3>(); }  ///< [m/s]

  /// The time from velocities to positions [s]: half a part of a step of `h`, and 0 at order 4. Throws
  /// std::invalid_argument, naming h, unless it is positive.
  double velocity_lag(double h) const;

  /// The number of parts of the last step: engine/constraints/step_parts.hpp. Contacts, rows, forces and impulses
  /// belong to its last part.
  int parts() const { return parts_; }

  /// The velocity at the time of the position [m/s], computed from the stored velocity, which is older by
  /// velocity_lag(h). Forces are those at the position; impulses of joints are half of those in the last step. If a
  /// contact acts on the body, it is the stored velocity. Throws std::invalid_argument if h is negative.
  Vec3 synchronized_velocity(int body, double h) const;

  /// The angular velocity at the time of the position [rad/s], in the same way. Includes the torque of `wrench`, and
  /// the gyroscopic torque if the rotation rule treats it as a torque.
  Vec3 synchronized_angular_velocity(int body, double h) const requires(Dof == 6);

  /// The contacts of the last step; the normal impulse of a contact [N s]; its whole impulse on body j, friction
  /// included [N s].
  const std::vector<Contact>& contacts() const { return contacts_; }
  double lambda(int contact) const;
  Vec3 impulse(int contact) const;

  /// The impacts of the last step: collisions with restitution, after which the contact may be open again, so that
  /// contacts() does not have it. A contact that bounces twice in a step is there twice.
  const std::vector<Impact>& impacts() const { return impacts_; }

  /// The changes of all velocities by the rows of the last part of a step, V of chapter 04, with which positions moved:
  /// velocities go on without the speed of recovery. Without rows, and in soft steps and steps of order four, they mean
  /// nothing.
  const std::vector<Twist<Dof>>& velocity_changes() const { return V_; }

  /// The joints; the impulse of one row of a joint in the last step [N s].
  const std::vector<Joint>& joints() const { return joints_; }
  double joint_lambda(int joint, int row = 0) const;

  /// The angle of a hinge, full turns included [rad], or the shift of a slider [m]; and its rate [rad/s, m/s], which is
  /// older by velocity_lag(h). Both are of j relative to i.
  double joint_position(int joint) const requires(Dof == 6);
  double joint_speed(int joint) const requires(Dof == 6);

  /// The torque or force of the motor, the limit, or the spring of a hinge or slider on body j in the last step, along
  /// the free coordinate [N m or N]. A motor that drives into its limit has its strength, and the limit has the
  /// remainder; if the strength is infinite, the motor has what brakes it. Zero before the first step, and without a
  /// motor, limit or spring.
  double motor_force(int joint) const requires(Dof == 6);
  double limit_force(int joint) const requires(Dof == 6);
  double spring_force(int joint) const requires(Dof == 6);

  /// The work of motors, springs and kinematic bodies in the last step, without that of impacts [J]: on the velocities
  /// with which bodies go on. Where bodies recover, the forces above also move them back; that work is not included.
  double work_of_drives() const { return work_of_drives_; }

  /// The torque of a joint on body j in the last step [N m], about the point where its force acts.
  Vec3 joint_torque(int joint) const requires(Dof == 6);

  /// A row of a joint in the last step; null before the first step.
  const Row<Dof>* joint_row(int joint, int row) const;

  /// The force of a joint, or of a contact with its friction, on body j in the last step [N]. That of a joint is zero
  /// before the first step, when there are no contacts.
  Vec3 joint_force(int joint) const;
  Vec3 contact_force(int contact) const;

  /// The force on each body in the last step [N], averaged over the step at order 4; the rows of the last step; the
  /// report of its solver. All are empty before the first step.
  const std::vector<Vec3>& forces() const { return forces_; }
  const std::vector<Vec3>& torques() const { return torques_; }  ///< with a wrench only [N m]
  const std::vector<Row<Dof>>& rows() const { return constraints_.rows; }
  const SolveReport& solved() const { return solved_; }

  /// Returns the stop rule of a step of `h` [s]: that of the settings, with a tolerance of at least four rounding
  /// errors of |gravity| h. Throws std::invalid_argument, naming h, unless it is positive.
  StopRule stop_rule(double h) const;

  /// Returns the report of the last step. Computes the residual here, not in the step.
  StepReport report() const;

  /// The number of row updates so far: a cost that is the same on every machine.
  std::int64_t row_updates() const { return row_updates_; }

  /// Starts stage timing.
  void time_stages() { clock_.start(); }
  const StageTimes& stage_times() const { return clock_.times(); }

 private:
  /// A contact that approaches fast, in soft steps.
  struct Approach {
    std::size_t contact;
    double speed;  ///< G W [m/s], negative
  };

  /// The state before a step, to which the step goes back if it needs more parts.
  struct BeforeStep {
    std::vector<Vec3> x;
    std::vector<Twist<Dof>> W, V;
    std::vector<Quat> q;
    std::vector<double> angles;   ///< of the hinges [rad]
    std::vector<bool> recovered;  ///< of the joints
    WarmStartCache last_impulses;
    double time = 0, h = 0, gap_step = 0, force_of_drives = 0;
  };

  void take_step(double h);
  void step_part(double h);
  void step_softly(double h);
  void find_contacts_on_the_way(double h);
  void build_soft_contacts(double h);
  void integrate_velocities();
  Stripes stripes_of_contacts() const;
  void build_soft_joints(double h);
  void sweep_soft_rows(double h);
  void sweep_rigid_rows(double h);
  template <class Normals>
  void sweep_all_rows(const Normals& sweep_normals);
  void integrate_positions(double h);
  void add_work_of_soft_drives(double h);
  void note_approaches(double h);
  void restitute();
  void divide_steps(double h, bool divides);
  bool may_divide_steps() const;
  bool divide_more(double h);
  void remember_state();
  double least_relaxation(double h) const;
  void go_back();
  double parts_needed_now(double h) const;
  double parts_needed_at_first(double h);
  void find_contacts(double h);
  double margin(double h) const;
  void evaluate_forces(double h);
  void shift_to_step(double h);
  void add_wrenches();
  Vec3 turned_by_torques(std::size_t i, const Vec3& omega, double h) const;
  std::optional<Twist<Dof>> half_change_by_joints(std::size_t i) const;
  ImpactLaw impact_law(const Contact& contact, double h) const;
  void add_last_impulses_of_joints(double h);
  void resolve_impacts(double h);
  void set_default_stiffness(double h);
  void build_rows(double h);
  void solve_rows(double h);
  SolverInput<Dof> solver_input(std::vector<Twist<Dof>>& V, double h, const StopRule& stop);
  void warm_start_rows(double h);
  void solve_again(double h);
  void add_work_of_drives(const std::vector<Twist<Dof>>& V);
  double force_of_drives(double h) const;
  void part_limits_from_motors(double h) requires(Dof == 6);
  void update_kinematic_velocities(double h);
  void move_kinematic(double h);
  void place_on_keyframes();
  std::size_t require_drivable(int body) const;
  void require_not_a_plane(int body) const;
  void drive(const Kinematic<Dof>& one, const Twist<Dof>& W);
  void integrate(double h);
  Vec3 turned(std::size_t i, Vec3 omega, double h);
  void end_step(double h);
  void step_composed(double h);
  void step_elsewhere(double h);
  void kick_all(double h, double time);
  void require_for_order_four() const;
  void require_for_order_four(const Joint& joint) const;
  void require_for_soft_steps(const Joint& joint) const;
  void require_no_relaxation(double d) const;
  void require_wrench_of_positions() const;

  Vec3 force(std::size_t i) const;
  void note_start(const char* how, double h);
  bool erase_separating_contacts();
  int keep_if_allowed(int body);
  void forget_the_last_step();
  void forget_contacts_and_rows();
  Twist<Dof> change_by_forces(std::size_t i, double h) const;
  void prepare_motion(double h);
  template <class Work>
  void for_each_body(const Work& work);
  void require_directions(std::int64_t step, double time) const;
  void count_turns();
  void complete(Joint& joint) const;
  const Joint& free_joint(int joint) const;
  double along_free(int joint, int row, double more = 0) const;
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
  std::vector<std::size_t> hinges_;    // indices of the hinges
  std::vector<Vec3> forces_;           // on each body at x_n [N]
  std::vector<Vec3> torques_;          // with a wrench only [N m]
  std::vector<Contact> contacts_;      // of the last step
  ConstraintSet<Dof> constraints_;     // the rows of joints_ and contacts_
  std::vector<Twist<Dof>> V_;          // what the rows add to each velocity
  std::vector<Twist<Dof>> recovered_;  // added to each velocity: it removes recovery, Eq. (7.17)
  FirstSolve first_solve_;             // during the second solve
  std::vector<SoftGap> soft_gaps_;     // of the rows of joints, in soft steps
  SoftContacts<Dof> soft_contacts_;    // in soft steps
  std::vector<Row<Dof>> soft_joints_;  // of the joints where they are now, in soft steps
  std::vector<Twist<Dof>> at_rest_;    // velocities that soft rows are built with
  std::vector<Approach> approaches_;   // of a soft step, for restitution
  WarmStartCache last_impulses_;       // for the rows of the next step
  SolveReport solved_;
  StepTimer clock_;
  std::int64_t steps_ = 0, removals_ = 0;
  double time_ = 0;
  double largest_load_ = 0;                // sum of the forces on all dynamic bodies [N]
  double h_ = 0;                           // of the last step [s]
  double work_of_drives_ = 0;              // in the last step [J]
  double force_of_drives_ = 0;             // of motors and springs in the last step [N]
  std::vector<Kinematic<Dof>> kinematic_;  // static bodies with a velocity
  int parts_ = 1, calm_steps_ = 0;
  double parts_per_second_ = 0;  // number of parts that the last part needed, over h [1/s]
  ScratchCache<BeforeStep> before_step_;
  double gap_step_ = 0;  // length of the parts that have left the gaps of joints [s]
  int pairs_ = 0;
  std::vector<Impact> impacts_;  // of the last step
  bool half_step_back_ = false;
  bool wrench_checked_ = false;  // that it does not depend on velocities, at order 4
  std::int64_t row_updates_ = 0;
  ScratchCache<RattleJoints<Dof>> rattle_joints_;  // joints of steps that are composed
  std::vector<Vec3> force_impulses_;               // of the forces, in one of them [N s]
  std::vector<Vec3> torque_impulses_;              // of the torques [N m s]
};

/// Orientation, and angular velocity in world coordinates [rad/s], of a rigid body.
inline const Quat& orientation(const World<6>& world, int body) {
  return world.bodies().orientations.q[world.index(body)];
}
inline Vec3 angular_velocity(const World<6>& world, int body) {
  return world.bodies().motion.W[world.index(body)].tail<3>();
}

}  // namespace spook
