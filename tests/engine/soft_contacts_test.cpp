// The layout of contacts in soft steps: the same updates as on chapter 04's rows, by the functions of chapters 09 and 10.
#include <gtest/gtest.h>

#include "10_convergence/convergence.hpp"
#include "engine/constraints/contact_rows.hpp"
#include "engine/constraints/soft_contacts.hpp"
#include "random_input.hpp"

namespace spook::soft_contacts {
namespace {

constexpr double h = 1.0 / 240;
constexpr SoftSpring spring{.frequency = 0.2, .damping = 5};

/// Bodies, contacts between them, and their rows with any λ inside the cone.
struct Heap {
  Motion<6> motion;
  std::vector<Contact> contacts;
  ConstraintSet<6> constraints;

  explicit Heap(testing::Random& random, double mu) {
    const int bodies = 8;
    for (int i = 0; i < bodies; ++i) {
      const double mass = random.log_uniform(0.1, 10);
      InverseMass<6> inverse{.linear = 1 / mass, .angular = Mat3::Zero()};
      inverse.angular.diagonal() = random.vector(0.5, 5) / mass;
      if (i == 0) inverse = {.linear = 0, .angular = Mat3::Zero()};
      motion.inverse_mass.push_back(inverse);
      motion.W.push_back(i == 0 ? Twist<6>(Twist<6>::Zero()) : random.twist());
      motion.Wf.push_back(Twist<6>::Zero());
    }
    for (int c = 0; c < 20; ++c) {
      const int i = random.integer(0, bodies - 2);
      const int j = random.integer(i + 1, bodies - 1);
      const Vec3 n = random.unit_vector(), r_i = random.vector(), r_j = random.vector();
      contacts.push_back({.i = i, .j = j, .n = n, .gap = random.uniform(-0.02, 0.01), .r_i = r_i, .r_j = r_j});
    }
    const Materials materials({.friction = mu, .restitution = 0, .k = 1e6, .d = 3});
    set_contact_rows<6>(contacts, h, materials, {.model = FrictionModel::cone}, motion, 1, constraints);
    std::vector<Row<6>>& rows = constraints.rows;
    for (Row<6>& row : rows) row.B = 0;
    const std::size_t each = constraints.rows_per_contact;
    for (std::size_t k = 0; k < rows.size(); k += each) {
      rows[k].lambda = std::max(0.0, random.uniform(-0.5, 1));
      for (std::size_t t = 1; t < each; ++t)
        rows[k + t].lambda = random.uniform(-0.5, 0.5) * mu * rows[k].lambda;
    }
  }

  std::vector<double> impulses() const {
    std::vector<double> all;
    for (const Row<6>& row : constraints.rows) all.push_back(row.lambda);
    return all;
  }
};

void expect_same(const std::vector<Twist<6>>& got, const std::vector<Twist<6>>& expected) {
  // Twenty contacts add some 60 impulses of at most 10 N s, over masses of 0.1 kg and more.
  for (std::size_t i = 0; i < got.size(); ++i)
    EXPECT_LE((got[i] - expected[i]).norm(), 60 * 1e-15 * 1e3)
        << "body " << i << ", seed " << testing::Random::seed();
}

TEST(SoftContacts, AreUpdatedAsRowsOfChaptersNineAndTenAre) {
  testing::Random random;
  for (int trial = 0; trial < 20; ++trial) {
    const double mu = trial % 2 ? 0.6 : 0;
    Heap heap(random, mu);
    SoftContacts<6> packed;
    packed.assign(heap.contacts, heap.constraints, heap.impulses());
    std::vector<Twist<6>> W = heap.motion.W, expected = W;

    packed.warm_start(W);
    for (const Row<6>& row : heap.constraints.rows) apply_impulse(row, row.lambda, expected);
    expect_same(W, expected);

    // ω = 2π f of a substep, so in Hz the frequency is f/h.
    const SoftParameters soft = soft_parameters(h, spring.frequency / h, spring.damping);
    const auto sweep_rows = [&](const SoftParameters& how) {
      for (const FrictionContact& contact : heap.constraints.friction)
        update_friction(contact, heap.constraints.rows, expected);
      for (std::size_t c = 0; c < heap.contacts.size(); ++c)
        update_soft_row(h, how, heap.contacts[c].gap, heap.constraints.rows[heap.constraints.normal_row(c)],
                        expected);
    };
    packed.sweep_friction(W);
    packed.sweep_soft(spring, infinity, h, W);
    sweep_rows(soft);
    expect_same(W, expected);

    packed.move_gaps(h, W);
    for (std::size_t c = 0; c < heap.contacts.size(); ++c) {
      const Row<6>& row = heap.constraints.rows[heap.constraints.normal_row(c)];
      heap.contacts[c].gap += h * (row.Gi.dot(expected[row.i]) + row.Gj.dot(expected[row.j]));
      EXPECT_EQ(packed.pressed(c), row.lambda > 0);
    }
    packed.sweep_friction(W);
    packed.sweep_rigid(h, W);
    sweep_rows({});
    expect_same(W, expected);

    ConstraintSet<6> returned = heap.constraints;
    for (Row<6>& row : returned.rows) row.lambda = -1;
    packed.return_rows(h, returned);
    for (std::size_t k = 0; k < returned.rows.size(); ++k)
      EXPECT_NEAR(returned.rows[k].lambda, heap.constraints.rows[k].lambda, 60 * 1e-15 * 1e3)
          << testing::Random::seed();
  }
}

// Each contact once: those of even stripes, of odd ones, and the rest.
TEST(SoftContacts, AreSweptStripeByStripe) {
  testing::Random random;
  Heap heap(random, 0.6);
  const Stripes stripes = {{1, 4, 7, 9}, {0, 2, 3, 11, 12}, {5, 6, 8, 10, 13}, {14, 15, 16, 17, 18, 19}};
  SoftContacts<6> packed;
  packed.assign(heap.contacts, heap.constraints, heap.impulses(), stripes);
  std::vector<Twist<6>> W = heap.motion.W, expected = W;
  packed.sweep_friction(W);
  packed.sweep_rigid(h, W);
  const auto in_order = [&](const auto& update) {
    for (const int stripe : {0, 2, 1, 3})
      for (const int c : stripes[static_cast<std::size_t>(stripe)]) update(static_cast<std::size_t>(c));
  };
  std::vector<Row<6>>& rows = heap.constraints.rows;
  in_order([&](std::size_t c) { update_friction(heap.constraints.friction[c], rows, expected); });
  in_order([&](std::size_t c) {
    update_soft_row(h, SoftParameters{}, heap.contacts[c].gap, rows[heap.constraints.normal_row(c)], expected);
  });
  expect_same(W, expected);
}

// The rows that are returned are those of the relaxing sweep, which solves a single contact: closed or open, it may
// approach as fast as its gap allows.
TEST(SoftContacts, ReturnRowsThatTheRelaxingSweepHasSolved) {
  testing::Random random;
  for (const double gap : {-1e-3, 0.0, 1e-3}) {
    Heap heap(random, 0);
    heap.contacts.resize(1);
    heap.contacts[0].gap = gap;
    heap.constraints.rows.resize(1);
    heap.constraints.friction.clear();
    SoftContacts<6> packed;
    packed.assign(heap.contacts, heap.constraints, heap.impulses());
    std::vector<Twist<6>> W = heap.motion.W;
    packed.sweep_rigid(h, W);
    packed.return_rows(h, heap.constraints);
    EXPECT_LE(residual_on_cones({}, heap.constraints.rows, W), 1e-12) << gap << "; " << testing::Random::seed();
    const Row<6>& row = heap.constraints.rows[0];
    EXPECT_GE(row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j]), -std::max(gap, 0.0) / h - 1e-12) << gap;
  }
}

// An overlap is moved apart with the closing speed at most.
TEST(SoftContacts, CloseAnOverlapWithTheClosingSpeedAtMost) {
  testing::Random random;
  Heap heap(random, 0);
  heap.contacts.resize(1);
  heap.contacts[0].gap = -100;
  heap.constraints.rows.resize(1);
  SoftContacts<6> packed;
  heap.constraints.friction.clear();
  packed.assign(heap.contacts, heap.constraints, heap.impulses());
  std::vector<Twist<6>> W = heap.motion.W;
  for (int sweep = 0; sweep < 400; ++sweep) packed.sweep_soft({.frequency = 100, .damping = 0.1}, 3, h, W);
  const Row<6>& row = heap.constraints.rows[0];
  // So stiff a row leaves Σ λ, 1e-6 of S λ.
  EXPECT_NEAR(row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j]), 3, 1e-4) << testing::Random::seed();
}

}  // namespace
}  // namespace spook::soft_contacts
