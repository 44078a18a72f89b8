// The lessons' examples with numbers, in the order of each lesson.
#include <Eigen/Dense>
#include <cmath>

#include "11_direct/direct.hpp"
#include "13_mechanisms/mechanisms.hpp"
#include "numbers.hpp"

namespace spook::lessons {

namespace {

void say_all(const std::string& name, const Eigen::VectorXd& values) {
  for (const double value : values) say(name, value);
}

void say_all(const std::string& name, const Quat& q) {
  say_all(name, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
}

/// Chapter 02: a turned body spins about the vertical.
void quaternion_update() {
  const Quat q(0.8, 0.6, 0, 0);
  const Vec3 omega(0, 0, 6);
  const double h = 1.0 / 60;
  const std::string name = "quaternion_update.";
  say(name + "q", q.w());
  say(name + "q", q.x());
  const Quat rate = quaternion_rate(q, omega);
  say(name + "rate", rate.y());
  say(name + "rate", rate.z());
  Quat stepped = q;
  stepped.coeffs() += h * rate.coeffs();
  say_all(name + "step", stepped);
  say(name + "length", stepped.norm());
  const Quat first = update_first_order(q, omega, h), exact = update_exponential(q, omega, h);
  say_all(name + "first_order", first);
  say_all(name + "exponential", exact);
  say(name + "angle", (first * q.conjugate()).angularDistance(Quat::Identity()));
  say(name + "angle", (exact * q.conjugate()).angularDistance(Quat::Identity()));
}

/// Chapter 03: a ball a millimetre deep in the floor, still falling; then the spring and the damper by themselves.
void one_row() {
  const double h = 1.0 / 60, k = 1e4, d = 3, mass = 1, gap = -0.001, u = -0.1, u_f = -9.81 * h;
  const std::string name = "one_row.";
  say(name + "gap", gap);
  say(name + "u", u);
  const SpookParameters spook = spook_parameters(h, k, d);
  say(name + "a", spook.a);
  say(name + "b", spook.b);
  say(name + "Sigma", spook.Sigma);
  say(name + "u_f", u_f);
  say(name + "wants_gap", -spook.a * gap);
  say(name + "wants_velocity", -spook.b * u);
  say(name + "wants_force", -u_f);
  say(name + "S", 1 / mass + spook.Sigma);
  const double lambda = contact_impulse(spook, 1 / mass, gap, u, u_f);
  say(name + "lambda", lambda);
  const double after = u + u_f + lambda / mass;
  say(name + "u_after", after);
  say(name + "gap_before", gap - h * u);
  say(name + "gap", gap);
  say(name + "gap_after", gap + h * after);
  const double mean = (gap - h * u + 2 * gap + gap + h * after) / 4;
  say(name + "mean", mean);
  say(name + "spring", -h * k * mean);
  say(name + "damper", -h * (d * h * k) * after);
  say(name + "sum", -h * k * mean - h * (d * h * k) * after);
}

/// Chapter 04: three bodies of 1, 2 and 3 kg on each other, swept twice from the ground up.
void three_rows() {
  const double h = 1.0 / 60, g = 9.81;
  const Twist<3> up(0, 0, 1);
  Motion<3> motion{.inverse_mass = {{.linear = 0}}, .W = {Twist<3>::Zero()}, .Wf = {Twist<3>::Zero()}};
  for (const double mass : {1.0, 2.0, 3.0}) {
    motion.inverse_mass.push_back({.linear = 1 / mass});
    motion.W.push_back(Twist<3>::Zero());
    motion.Wf.push_back(-h * g * up);
  }
  std::vector<Row<3>> rows;
  for (int k = 0; k < 3; ++k)
    rows.push_back(make_row<3>(
        {.i = k, .j = k + 1, .Gi = -up, .Gj = up, .gap = 0, .spook = {.a = 0, .b = 1, .Sigma = 0}}, motion));
  for (const Row<3>& row : rows) say("three_rows.diagonal", row.diagonal);
  say("three_rows.B", rows[0].B);
  say("three_rows.exact", 6 * h * g);
  say("three_rows.exact", 5 * h * g);
  say("three_rows.exact", 3 * h * g);
  std::vector<Twist<3>> V(4, Twist<3>::Zero());
  for (int sweeps = 0; sweeps < 2; ++sweeps)
    for (Row<3>& row : rows) {
      // In the order of the lesson's table: the row's residual, its new λ, and the velocities of its two bodies.
      say("three_rows.lacks", row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]));
      update_row(row, V);
      say("three_rows.lambda", row.lambda);
      for (int body = 1; body <= 3; ++body) say("three_rows.V", V[body].z());
    }
  say("three_rows.residual", residual(rows, V));
}

/// Chapter 11: two rows with bounds 0 and 1, the first step from the start.
void interior() {
  const std::string name = "interior.";
  SparseMatrix S(2, 2);
  S.insert(0, 0) = 1;
  S.insert(1, 0) = 0.6;
  S.insert(1, 1) = 1;
  S.makeCompressed();
  const Vector B = Eigen::Vector2d(1.45, 0.85), lo = Vector::Zero(2), hi = Vector::Ones(2);
  say(name + "S", 0.6);
  say_all(name + "B", B);
  const Interior start = interior_start(S, B, lo, hi, Vector::Zero(2));
  say(name + "E", start.room_lo[0] * start.push_lo[0]);
  say(name + "room", start.room_lo[0]);
  say(name + "push", start.push_lo[0]);
  const SparseMatrix barrier = barrier_matrix(S, start);
  say(name + "diagonal", barrier.coeff(0, 0));
  Factors factors;
  factorise(barrier, factors);
  const Target none{.lo = Vector::Zero(2), .hi = Vector::Zero(2)};
  const Vector lacks = B - S.selfadjointView<Eigen::Lower>() * start.lambda;
  say_all(name + "lacks", lacks);
  const Interior straight = newton_step(S, B, start, none, factors);
  say_all(name + "straight", straight.lambda);
  say_all(name + "straight_push_lo", straight.push_lo);
  say_all(name + "straight_push_hi", straight.push_hi);
  const double alpha = longest_step(start, straight);
  say(name + "alpha", alpha);
  const auto part = [&](const Vector& now, const Vector& step) -> Vector { return now + alpha * step; };
  const double mu = start.room_lo.dot(start.push_lo) / 2;
  const double reached = (part(start.room_lo, straight.room_lo).dot(part(start.push_lo, straight.push_lo)) +
                          part(start.room_hi, straight.room_hi).dot(part(start.push_hi, straight.push_hi))) /
                         4;
  say(name + "mu", mu);
  say(name + "mu_reached", reached);
  say(name + "tau", std::pow(reached / mu, 3) * mu);
  const Interior next = interior_step(S, B, lo, hi, start, factors);
  say_all(name + "lambda", next.lambda);
  say(name + "mu_next", (next.room_lo.dot(next.push_lo) + next.room_hi.dot(next.push_hi)) / 4);
}

/// Chapter 08: a cube on a cube, pushed aside and turned by 30° about the vertical.
void boxes() {
  const std::string name = "boxes.";
  const double turn = std::acos(-1.0) / 6;
  const Box i{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(0.5)};
  const Box j{.body = 1,
              .x = Vec3(0.5, 0.2, 0.98),
              .axes = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix(),
              .half_sides = Vec3::Constant(0.5)};
  say_all(name + "x", j.x);
  const auto gap = [&](const Vec3& n) {
    return std::abs(n.dot(j.x)) - (0.5 * n.cwiseAbs()).sum() - 0.5 * (j.axes.transpose() * n).cwiseAbs().sum();
  };
  for (int k = 0; k < 3; ++k) say(name + "gap_i", gap(i.axes.col(k)));
  for (int k = 0; k < 2; ++k) say(name + "gap_j", gap(j.axes.col(k)));
  say(name + "best", separating_axis(i, j).gap);
  std::vector<Vec3> face;
  for (const auto& [s, t] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}})
    face.push_back(j.x + j.axes * Vec3(0.5 * s, 0.5 * t, -0.5));
  for (const Vec3& corner : face) say_all(name + "incident", corner.head<2>());
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)})
    face = clip(face, n, 0.5);
  for (const Vec3& corner : face) say_all(name + "clipped", corner.head<2>());
  std::vector<Contact> contacts;
  box_box(i, j, contacts);
  double least = infinity, low = infinity, high = -infinity;  // depth and heights: equal for all
  for (const Contact& contact : contacts) {
    least = std::min(least, -contact.gap);
    low = std::min(low, contact.r_i.z()), high = std::max(high, contact.r_i.z());
  }
  say(name + "depth", contacts.size() == 5 ? least : 0);
  say(name + "height", (low + high) / 2);
}

/// Chapter 13: a hinge that is slightly open.
void open_hinge() {
  const std::string name = "open_hinge.";
  const Quat turned(Eigen::AngleAxisd(1, Vec3::UnitZ())), opened(Eigen::AngleAxisd(0.02, Vec3::UnitX()));
  const JointFrame i{{.body = 0, .x = Vec3::Zero()}, Quat::Identity()},
      j{{.body = 1, .x = Vec3::Zero()}, opened * turned};
  say(name + "turned", 1);
  say(name + "opened", 0.02);
  say_all(name + "Q", i.axes.conjugate() * j.axes);
  const std::array<Coordinate, 3> apart = turned_apart(i, j);
  for (int k = 0; k < 2; ++k) say(name + "gap", apart[k].value);
  say(name + "opening", std::hypot(apart[0].value, apart[1].value));
  for (int k = 0; k < 2; ++k) say_all(name + "a", apart[k].Gj.tail<3>());
  say(name + "angle", hinge_angle(i, j, 0).value);
  say(name + "speed", 1);
  for (int k = 0; k < 2; ++k) say(name + "rate", apart[k].Gj[3]);
}

}  // namespace

void worked_examples() {
  quaternion_update();
  one_row();
  three_rows();
  boxes();
  interior();
  open_hinge();
}

}  // namespace spook::lessons
