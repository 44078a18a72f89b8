// The numbers that the lessons ask their readers to predict, computed by the reference: see chapters/predictions.ini.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "12_stiff_wires/stiff_wires.hpp"
#include "13_mechanisms/mechanisms.hpp"
#include "14_fast_rows/fast_rows.hpp"
#include "numbers.hpp"

namespace spook::lessons {

namespace {

const double pi = std::acos(-1.0);
const Vec3 up(0, 0, 1);

void leapfrog() {
  const double h = 0.01, g = 9.81, time = 5;
  Particles ball{.x = {Vec3::Zero()}, .v = {Vec3::Zero()}, .inverse_mass = {1}};
  for (int n = 0; n < 500; ++n)
    leapfrog_step(
        ball, [&](auto, const auto&) -> Vec3 { return -g * up; }, h);
  say("1.fall_without_start", std::abs(ball.x[0].z() / (-g * time * time / 2) - 1));

  // The largest stable step of a spring, by bisection.
  const auto grows = [](double step) {
    Particles mass{.x = {up}, .v = {Vec3::Zero()}, .inverse_mass = {1}};
    for (int n = 0; n < 20'000; ++n)
      leapfrog_step(
          mass, [](auto, const auto& x) -> Vec3 { return -100 * x[0]; }, step);
    return !(mass.x[0].norm() < 1e6);
  };
  double safe = 0.1, lost = 0.3;
  while (lost - safe > 1e-6) (grows((safe + lost) / 2) ? lost : safe) = (safe + lost) / 2;
  say("1.largest_step", safe);
}

void rotations() {
  const Quat turned = update_first_order(Quat::Identity(), 60 * up, 1.0 / 60);
  say("2.wheel_short", (1 - turned.angularDistance(Quat::Identity())) * 180 / pi);
  const Mat3 pencil = world_inertia(Quat::Identity(), Vec3(1, 1, 0.01));
  say("2.pencil", gyroscopic_torque(pencil, 7 * up).norm());
}

void single_contact() {
  const double h = 1.0 / 60, g = 9.81;
  const auto depth = [&](double share_of_Sigma) {
    SpookParameters spook = spook_parameters(h, 1e5, 3);
    spook.Sigma *= share_of_Sigma;
    double gap = 0, v = 0;
    for (int n = 0; n < 2000; ++n) gap += h * (v += -h * g + contact_impulse(spook, 1, gap, v, -h * g));
    return -gap;
  };
  say("3.half_Sigma", depth(0.5) / depth(1));
  const InverseMass<6> sphere{.linear = 1, .angular = 2.5 * Mat3::Identity()};
  say("3.two_spheres", up.dot(collision_matrix(sphere, up, sphere, -up) * up));
  for (const double d : {3.0, 0.0})
    say("3.early_" + std::to_string(int(d)),
        contact_impulse(spook_parameters(h, 1e6, d), 1, 0.001, -1, -h * g) > 0);
}

/// Bodies on each other, at rest under gravity with h g = 1, on the ground: rows from the ground up.
struct Stack {
  Motion<3> motion;
  std::vector<Row<3>> rows;
  std::vector<Twist<3>> V;
};

Stack stack(int bodies) {
  Stack s;
  s.motion = {.inverse_mass = {{.linear = 0}}, .W = {Vec3::Zero()}, .Wf = {Vec3::Zero()}};
  for (int k = 0; k < bodies; ++k) {
    s.motion.inverse_mass.push_back({.linear = 1});
    s.motion.W.push_back(Vec3::Zero());
    s.motion.Wf.push_back(-up);
  }
  for (int k = 0; k < bodies; ++k)
    s.rows.push_back(make_row<3>(
        {.i = k, .j = k + 1, .Gi = -up, .Gj = up, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = 0}}, s.motion));
  s.V.assign(bodies + 1, Vec3::Zero());
  return s;
}

/// The position at which two contradictory rows leave a point mass along z, with stiffnesses k1 and k2.
double between(double want_1, double k1, double want_2, double k2) {
  const double h = 1.0 / 60;
  Motion<3> motion;
  motion.inverse_mass = {{.linear = 0}, {.linear = 1}};
  motion.W = motion.Wf = {Vec3::Zero(), Vec3::Zero()};
  double z = 0;
  for (int n = 0; n < 500; ++n) {
    std::vector<Row<3>> rows;
    for (const auto& [want, k] : {std::pair(want_1, k1), std::pair(want_2, k2)})
      rows.push_back(make_row<3>({.i = 0,
                                  .j = 1,
                                  .Gi = -up,
                                  .Gj = up,
                                  .gap = z - want,
                                  .spook = spook_parameters(h, k, 3),
                                  .lo = -infinity,
                                  .hi = infinity},
                                 motion));
    std::vector<Twist<3>> V(2, Vec3::Zero());
    solve(rows, V, {.max_sweeps = 2000, .tolerance = 1e-14});
    motion.W[1] += V[1];
    z += h * motion.W[1].z();
  }
  return z;
}

void many_contacts() {
  Stack s = stack(3);
  sweep(s.rows, s.V);
  say("4.top_after_one_sweep", s.rows[2].lambda);
  // Wall 1 requires z >= 0, wall 2 z <= -4 mm: the ball's depth in wall 1, in millimetres.
  say("4.depth_in_wall_1", -1000 * between(0, 3e4, -0.004, 1e4));
  Stack down = stack(3);
  for (int sweeps = 0; sweeps < 2; ++sweeps) sweep_in_order({2, 1, 0}, down.rows, down.V);
  say("10.middle_after_two_down", down.rows[1].lambda);
  int sweeps = 1;
  while (1 - std::pow(0.99, sweeps) <= 0.25) ++sweeps;
  say("10.sweeps_to_be_safe", sweeps);
}

/// The distance of a block that slides at 45° to its tangents, with a box of friction or with a disc, for μg = 1 and v0
/// = 1.
double way_to_a_stop(bool box) {
  const double h = 1e-4;
  const Tangents t = tangents(up);
  Vec3 u = (t.t1 + t.t2).normalized(), way = Vec3::Zero();
  for (int n = 0; n < 20'000; ++n) {
    const Vec3 J = friction_impulse(Mat3::Identity(), u, t, 0, box ? h : infinity);
    u += box ? J
             : onto_disc({t.t1.dot(J), t.t2.dot(J)}, h).x() * t.t1 +
                   onto_disc({t.t1.dot(J), t.t2.dot(J)}, h).y() * t.t2;
    way += h * u;
  }
  return way.norm();
}

void friction_and_joints() {
  say("5.between_boxes", 60 * friction_bound(0.5, representative_mass(1.0 / 100, 1, 1), 9.81, 1.0 / 60));
  say("9.farther", std::round(100 * way_to_a_stop(false) / way_to_a_stop(true)) / 100);
  say("6.link", -10.0 / 60);
  say("6.two_rods", between(1, 1e4, 1.1, 1e4));
}

void impacts() {
  double peak = 1, time = std::sqrt(2 / 9.81);
  int bounces = 0;
  for (; peak >= 0.01; ++bounces) {
    if (bounces > 0) time += 2 * std::sqrt(2 * peak / 9.81);
    peak *= 0.81;
  }
  say("7.bounces", bounces);
  say("7.time", time);
  const InverseMass<6> floor, ball{.linear = 1, .angular = 2.5 * Mat3::Identity()};
  const Mat3 K = collision_matrix(floor, Vec3::Zero(), ball, -up);
  const Vec3 J = impact_impulse(K, Vec3(3, 0, -1), up, 1, 0.5);
  say("7.rim_speed", 2.5 * (-up).cross(J).norm());
}

void pairs() {
  for (const auto& [turn, depth, name] :
       {std::tuple(0.001, 0.003, "8.slightly_turned"), {0.01, 0.0049, "8.turned"}}) {
    const Mat3 axes = Eigen::AngleAxisd(turn, Vec3::UnitY()).toRotationMatrix();
    const double lowest = (axes.cwiseAbs() * Vec3::Constant(0.5)).z();
    std::vector<Contact> contacts;
    plane_box({.body = 0, .x = Vec3::Zero(), .n = up, .offset = 0},
              {.body = 1, .x = (lowest - depth) * up, .axes = axes, .half_sides = Vec3::Constant(0.5)},
              contacts);
    say(name, double(contacts.size()));
  }
  const double c = std::sqrt(0.5);
  std::vector<Vec3> face = {Vec3(c, 0, 0), Vec3(0, c, 0), Vec3(-c, 0, 0), Vec3(0, -c, 0)};
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)})
    face = clip(face, n, 0.5);
  say("8.corners", double(face.size()));
  say("8.all_pairs", 64'000.0 * 63'999 / 2 * 2e-9);
}

void matrices() {
  const int joints = 100;
  std::vector<Row<6>> rows;
  for (int k = 0; k < joints; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      Row<6> row{};
      row.i = k, row.j = (k + 1) % joints;
      row.Gi = row.Gj = row.MinvGi = row.MinvGj = Twist<6>::Ones();
      rows.push_back(row);
    }
  say("11.ring", double(schur_complement(rows).nonZeros()));
  SparseMatrix twice(2, 2);
  twice.insert(0, 0) = twice.insert(1, 1) = 1.1;
  twice.insert(1, 0) = 1;
  twice.makeCompressed();
  Factors factors;
  factorise(twice, factors);
  say("11.second_pivot", factors.ldlt.vectorD()[1]);
  say("12.half_the_links", transverse_frequency(1e4, 0.01, 0.1) / transverse_frequency(1e4, 0.02, 0.2));
  say("12.heavier_load", transverse_frequency(1e7, 0.01, 0.1) / transverse_frequency(1e4, 0.01, 0.1));
}

JointFrame frame(int body, const Vec3& x, double angle) {
  return {{.body = body, .x = x}, Quat(Eigen::AngleAxisd(angle, up))};
}

void mechanisms() {
  const JointFrame post = frame(0, Vec3::Zero(), 0), door = frame(1, Vec3::Zero(), 0);
  const std::size_t a_hinge = ball_joint_constraints<6>(post.at, door.at, {}).size() + 2, needed = a_hinge;
  say("13.rows_too_many", double(3 * a_hinge - needed));

  const double h = 0.001, I = 2;
  Motion<6> wheel{.inverse_mass = {{}, {.linear = 1, .angular = Mat3::Identity() / I}},
                  .W = {Twist<6>::Zero(), Twist<6>::Zero()},
                  .Wf = {Twist<6>::Zero(), Twist<6>::Zero()}};
  const Coordinate angle = hinge_angle(post, door, 0);
  double time = 0;
  for (; wheel.W[1][5] < 20 * (1 - 1e-9); time += h) {
    const Row<6> row = motor_row(angle, {.speed = 20, .strength = 5}, h, wheel);
    wheel.W[1] += std::clamp(row.B / row.diagonal, row.lo, row.hi) * row.MinvGj;
  }
  say("13.flywheel", time);

  // A bead after a push out along a rod, each of 1 kg or 1 kg m²: the row across the rod, solved in each step.
  double turned = 0, omega = 5;
  Vec3 x = Vec3::Zero(), v(1, 0, 0);
  while (x.norm() < 1) {
    const Coordinate across = shift_along(frame(0, Vec3::Zero(), turned), frame(1, x, turned), 1);
    const double arm = across.Gi[5];
    const Vec3 n = across.Gj.head<3>();
    const double lambda = -(across.value / h + arm * omega + n.dot(v)) / (arm * arm + 1);
    omega += arm * lambda;
    v += lambda * n;
    turned += h * omega;
    x += h * v;
  }
  say("13.slower", omega);
}

/// The block S of the rod of (9.8), and its right-hand side.
int updates_of_the_rod(double mu) {
  const Mat3 S = (Mat3() << 1.6, -1.2, 0, -1.2, 3.4, 0, 0, 0, 4).finished();
  const Vec3 q(0.16, -3, 0);
  Vec3 lambda = Vec3::Zero();
  for (int updates = 0;; ++updates) {
    const Vec3 next = solve_on_cone(S, q, mu);
    if ((next - lambda).norm() <= 1e-12) return updates;
    lambda = next;
  }
}

void fast_rows() {
  std::vector<Pair> links;
  for (int k = 0; k < 99; ++k) links.emplace_back(k, k + 1);
  const std::vector<int> colours = colour_pairs(links, 100);
  say("14.colours_of_a_chain", 1 + *std::max_element(colours.begin(), colours.end()));
  say("14.from_memory", double(sizeof(LaneRows<6>)) / lane_count / 10);
  say("14.updates_of_the_rod", updates_of_the_rod(2));
}

}  // namespace

void predicted_numbers() {
  leapfrog();
  rotations();
  single_contact();
  many_contacts();
  friction_and_joints();
  impacts();
  pairs();
  matrices();
  mechanisms();
  fast_rows();
}

}  // namespace spook::lessons
