// Three rows of a contact at once, in a system of others.
#include "../09_better_friction/friction_systems.hpp"
#include "14_fast_rows/fast_rows.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdateContact, "14.2 update_contact");

/// Some contacts and joints among a few bodies, with impulses on entry.
System<6> busy_system(Random& random) {
  System<6> s = random_system(random, 4, 4, 0.6);
  for (const FrictionContact& contact : s.contacts) s.begin_with(contact.normal, random.uniform(0.2, 1));
  for (const FrictionContact& contact : s.contacts) s.begin_with(contact.normal + 1, random.uniform(-0.1, 0.1));
  return s;
}

/// The block of a contact, taken from all of S.
Mat3 block_of(const System<6>& s, const FrictionContact& contact) {
  const auto k = static_cast<Eigen::Index>(contact.normal);
  return dense_S(s.rows).block<3, 3>(k, k);
}

Vec3 impulses_of(const System<6>& s, const FrictionContact& contact) {
  return {s.rows[contact.normal].lambda, s.rows[contact.normal + 1].lambda, s.rows[contact.normal + 2].lambda};
}

Vec3 lacks_of(const System<6>& s, const FrictionContact& contact) {
  return {s.lacks(contact.normal), s.lacks(contact.normal + 1), s.lacks(contact.normal + 2)};
}

EXERCISE_TEST(UpdateContact, SolvesTheThreeRowsTogether) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = busy_system(random);
    for (const FrictionContact& contact : s.contacts) {
      const Mat3 S = block_of(s, contact);
      const Vec3 before = impulses_of(s, contact), r = lacks_of(s, contact);
      Mat3 of_i = S, of_j = S, without_softness = S, alone = S.diagonal().asDiagonal();
      Mat3 without_mass = S, subtracted = S;
      Vec3 r_of_i = r, r_of_j = r, r_hard = r, r_added = r, r_of_i_twice = r, r_without_B = r;
      for (int k = 0; k < 3; ++k) {
        const Row<6>& row = s.rows[contact.normal + k];
        for (int l = 0; l < 3; ++l) {
          const Row<6>& other = s.rows[contact.normal + l];
          of_i(k, l) -= row.Gj.dot(other.MinvGj);
          of_j(k, l) -= row.Gi.dot(other.MinvGi);
          if (k == l) continue;
          without_mass(k, l) = row.Gi.dot(other.Gi) + row.Gj.dot(other.Gj);
          subtracted(k, l) -= 2 * row.Gj.dot(other.MinvGj);
        }
        without_softness(k, k) -= row.Sigma;
        r_of_i[k] += row.Gj.dot(s.V[row.j]), r_of_j[k] += row.Gi.dot(s.V[row.i]);
        r_hard[k] += row.Sigma * row.lambda, r_added[k] += 2 * row.Gj.dot(s.V[row.j]);
        r_of_i_twice[k] += row.Gj.dot(s.V[row.j] - s.V[row.i]), r_without_B[k] -= row.B;
      }
      const auto beside_the_diagonal = [&](Mat3 block) {
        block.diagonal() = S.diagonal();
        return block;
      };
      const auto with = [&](const Mat3& block, const Vec3& q) { return solve_on_cone(block, q, contact.mu); };
      const Vec3 after = with(S, r + S * before);
      update_contact(contact, s.rows, s.V);
      expect_near_vector(
          "λ of a contact between two dynamic bodies, after its update [N s]", "Eq. (14.1), (14.2)",
          impulses_of(s, contact), after, roundings(1e4, 5),
          {{with(S, r), "q is the residual only: S_cc λ, the effect of the old λ, is missing."},
           {before, "This is the old λ: the new one replaces it."},
           {Vec3(before + after), "The new λ is added to the old one: it replaces that."},
           {Vec3(after[0], after[2], after[1]), "The two tangents are swapped."},
           {Vec3(S.inverse() * (r + S * before)), "The cone is missing, or is wider than |λ_t| <= μ λ_n."},
           {with(S, r - S * before), "The sign of S_cc λ: q = r + S_cc λ."},
           {with(S, r_hard + S * before), "In r the term Σ λ is missing: r = B - G V - Σ λ."},
           {with(S, r_without_B + S * before), "In r the term B is missing: r = B - G V - Σ λ."},
           {with(S, r_added + S * before),
            "In r the sign of G_j V_j: both bodies are subtracted, r = B - G V - Σ λ."},
           {with(S, r_of_i_twice + S * before),
            "In r the velocity of body i stands in place of body j's, too."},
           {with(without_mass, r + without_mass * before),
            "The entries beside the diagonal of your S_cc lack the masses: S_cc is G M⁻¹ Gᵀ."},
           {with(subtracted, r + subtracted * before),
            "Beside the diagonal of S_cc the part of body j is subtracted: both parts are added."},
           {Vec3(before + with(S, r)), "This adds the λ of the residual, on its cone, to the old λ."},
           {with(of_j, r + of_j * before), "S_cc has the part of body j only."},
           {with(of_i, r + of_i * before), "S_cc has the part of body i only: that of body j is left out."},
           {with(beside_the_diagonal(of_j), r + beside_the_diagonal(of_j) * before),
            "Beside its diagonal S_cc has the part of body j only."},
           {with(beside_the_diagonal(of_i), r + beside_the_diagonal(of_i) * before),
            "Beside its diagonal S_cc has the part of body i only: that of body j is left out."},
           {with(S, r_of_i + S * before),
            "In r the velocity of body j is left out: r = B - G V - Σ λ has both."},
           {with(S, r_of_j + S * before),
            "In r the velocity of body i is left out: r = B - G V - Σ λ has both."},
           {with(without_softness, r + without_softness * before), "S_cc is without Σ and Γ on its diagonal."},
           {with(alone, r + alone * before),
            "S_cc has its diagonal only: the coupling of the rows is missing."},
           {with(S, r + alone * before),
            "In q, too, the rows are coupled: this has the diagonal of S_cc there."}},
          "q = r + S_cc λ, on the cone of μ.");
    }
  }
}

EXERCISE_TEST(UpdateContact, ScattersWhatHasChanged) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    System<6> s = busy_system(random);
    const Eigen::VectorXd V = all_V(s.V);
    System<6> of_i = s, of_j = s;  // with Δλ scattered to one body only
    System<6> backwards = s, without_mass = s, of_normal = s, all_of_it = s;
    for (const FrictionContact& contact : s.contacts) update_contact(contact, s.rows, s.V);
    for (std::size_t k = 0; k < s.rows.size(); ++k) {
      const Row<6>& row = s.rows[k];
      const double change = row.lambda - of_i.rows[k].lambda;
      of_i.V[row.i] += change * row.MinvGi, of_j.V[row.j] += change * row.MinvGj;
      backwards.V[row.i] -= change * row.MinvGi, backwards.V[row.j] -= change * row.MinvGj;
      without_mass.V[row.i] += change * row.Gi, without_mass.V[row.j] += change * row.Gj;
    }
    for (const FrictionContact& contact : s.contacts) {
      of_normal.begin_with(contact.normal, s.rows[contact.normal].lambda);
      for (std::size_t k = contact.normal; k <= contact.normal + 2; ++k) {
        const Row<6>& row = s.rows[k];
        all_of_it.V[row.i] += row.lambda * row.MinvGi, all_of_it.V[row.j] += row.lambda * row.MinvGj;
      }
    }
    expect_true("an update of every contact changes V", "Eq. (4.5)", all_V(s.V) != V, "Nothing was scattered.");
    expect_near_vector(
        "V after an update of every contact", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, s.V.size()),
        roundings(1e4, 10),
        {{all_V(of_i.V), "Body j is left out: Δλ changes the velocities of both bodies."},
         {all_V(of_j.V), "Body i is left out: Δλ changes the velocities of both bodies."},
         {all_V(all_of_it.V), "This scatters λ: scatter Δλ, and not λ."},
         {all_V(backwards.V), "The sign: V changes by +M⁻¹ Gᵀ Δλ."},
         {all_V(without_mass.V), "This is Gᵀ Δλ: V changes by M⁻¹ Gᵀ Δλ."},
         {all_V(of_normal.V), "Only Δλ of the normal row is scattered: the friction rows' change V, too."}},
        "V = M⁻¹ Gᵀ λ, always: scatter Δλ of all three rows.");
  }
}

// Old impulses, in λ and in V, and a contact with μ = 0, or one that has separated since.
EXERCISE_TEST(UpdateContact, TakesOldImpulsesOff) {
  Random random;
  for (const int kind : {0, 1, 2}) {
    const bool on_ice = kind == 0;
    System<6> s = busy_system(random);
    const FrictionContact& contact = s.contacts[1];
    if (on_ice) s.contacts[1].mu = 0;
    for (std::size_t k = contact.normal + 1; kind == 2 && k <= contact.normal + 2; ++k) {
      apply_impulse(s.rows[k], -s.rows[k].lambda, s.V);
      s.rows[k].lambda = 0;
    }
    Row<6>& normal = s.rows[contact.normal];
    normal.B += on_ice ? 1000 : -1000;  // larger than all other terms
    const Vec3 before = impulses_of(s, contact);
    const double alone = before[0] + s.lacks(contact.normal) / normal.diagonal;
    const Mat3 S = block_of(s, contact);
    const Vec3 q = lacks_of(s, contact) + S * before;
    update_contact(contact, s.rows, s.V);
    const std::string where = on_ice      ? "with μ = 0"
                              : kind == 1 ? "that separates"
                                          : "that separates, and had no friction";
    expect_near_vector("λ of a contact " + where + ", after an update; " + show(before) + " N s on entry [N s]",
                       "Eq. (14.3), (14.4)", impulses_of(s, contact),
                       on_ice ? Vec3(q[0] / S(0, 0), 0, 0) : Vec3::Zero(), roundings(1e4, 1e3),
                       {{before, "It has not been updated: the old λ is unchanged."},
                        {Vec3(on_ice ? alone : 0, before[1], before[2]),
                         "The old friction stays at a contact " + where + ": λ_t goes to 0, and V with it."},
                        {Vec3(q[0] / S(0, 0), before[1], before[2]),
                         "The old friction stays at a contact " + where + ": λ_t goes to 0, and V with it."}},
                       "A cone without width allows no friction.");
    expect_near_vector("V after it", "Eq. (4.5)", all_V(s.V), V_of_lambda(s.rows, s.V.size()),
                       roundings(1e4, 1e4), {}, "V = M⁻¹ Gᵀ λ, always: remove the old λ from V, too.");
  }
}

EXERCISE_TEST(UpdateContact, ReturnsTheVelocityChange) {
  Random random;
  System<6> s = busy_system(random);
  for (const FrictionContact& contact : s.contacts) {
    const Mat3 S = block_of(s, contact);
    const Vec3 before = impulses_of(s, contact), lacks = lacks_of(s, contact),
               change = solve_on_cone(S, lacks_of(s, contact) + S * before, contact.mu) - before;
    const double got = update_contact(contact, s.rows, s.V);
    expect_near(
        "what update_contact returned [m/s]", "Eq. (14.2)", got, (S * change).norm(), roundings(1e3, 5),
        {{lacks.norm(), "This is |r|, what was missing before the update. Return what it changed: |S_cc Δλ|."},
         {change.norm(), "This is |Δλ|, an impulse. Return a velocity: |S_cc Δλ|."},
         {(S * change).cwiseAbs().maxCoeff(),
          "This is the largest entry of S_cc Δλ. Return its length, |S_cc Δλ|."},
         {S.diagonal().cwiseProduct(change).cwiseAbs().maxCoeff(),
          "This is the largest S_kk |Δλ_k|, of three rows by themselves. Treat the contact as one: |S_cc Δλ|."},
         {S.diagonal().cwiseProduct(change).norm(),
          "This is for the diagonal of S_cc alone. All nine entries count: |S_cc Δλ|."}},
        "|S_cc Δλ|.");
    const double again = update_contact(contact, s.rows, s.V);
    expect_at_most("what a second update of it returned [m/s]", "Eq. (14.2)", again, 1e-11,
                   "one update solves it, up to round-off", "One update did not solve it.");
  }
}

EXERCISE_TEST(UpdateContact, SolvesTheDraggedRodAtOnce) {
  for (const double mu : {0.5, 1.0, 2.0}) {
    System<6> s = leaning_rod(mu, 3, 0.16);
    update_contact(s.contacts[0], s.rows, s.V);
    expect_near(
        "λ_n of a rod that is dragged, μ = " + show(mu) + " [N s]", "Eq. (9.8)", s.rows[0].lambda,
        0.16 / (rod_Knn - rod_Knx * mu), roundings(100, 1),
        {{0.16 / rod_Knn, "This is the one without friction."}},
        "λ_n = q_n/(n·Kn (1 - ρ)), by one update. Row by row it takes many updates, or never converges.");
  }
}

EXERCISE_TEST(UpdateContact, FindsItsRows) {
  Random random;
  System<6> s = busy_system(random);
  const Eigen::VectorXd before = all_lambda(s.rows);
  const FrictionContact& second = s.contacts[1];
  update_contact(second, s.rows, s.V);
  for (std::size_t k = 0; k < s.rows.size(); ++k) {
    if (k >= second.normal && k <= second.normal + 2) continue;
    expect_near("λ of row " + std::to_string(k) + ", of another contact or a joint [N s]", "Eq. (14.2)",
                s.rows[k].lambda, before[static_cast<Eigen::Index>(k)], {0, "unchanged"}, {},
                "Its rows are contact.normal and the two after it.");
  }
}

EXERCISE_TEST(UpdateContact, DoesNotLookAtBounds) {
  Random random;
  const System<6> s = busy_system(random);
  for (const FrictionContact& contact : s.contacts) {
    System<6> free = s, bounded_too = s;
    for (std::size_t k = contact.normal + 1; k <= contact.normal + 2; ++k)
      bounded_too.rows[k].lo = bounded_too.rows[k].hi = 0;
    update_contact(contact, free.rows, free.V);
    update_contact(contact, bounded_too.rows, bounded_too.V);
    expect_near_vector("λ where the friction rows have bounds of 0 [N s]", "Eq. (14.5)",
                       impulses_of(bounded_too, contact), impulses_of(free, contact), {0, "the same value"}, {},
                       "The limit is μ times the present λ_n, not the rows' bounds.");
  }
}

EXERCISE_TEST(UpdateContact, KeepsANaN) {
  Random random;
  System<6> start = busy_system(random);
  const FrictionContact& contact = start.contacts[0];
  for (const bool separated : {false, true})
    for (std::size_t k = 0; k < 3; ++k) {
      System<6> s = start;
      if (separated) {
        for (Twist<6>& body : s.V) body.setZero();
        for (Row<6>& row : s.rows) row.lambda = 0;
        s.rows[contact.normal].B = -1;
      }
      s.rows[contact.normal + k].B = std::nan("");
      expect_true("B = NaN in row " + std::to_string(k) + " of " +
                      (separated ? "a separated contact, λ = 0," : "a contact") + " makes it return NaN",
                  "Eq. (14.2)", std::isnan(update_contact(contact, s.rows, s.V)),
                  separated
                      ? "The NaN was lost. A contact with q_n <= 0 and λ = 0 needs no update, but only if all "
                        "of q are numbers."
                      : "The NaN was lost.");
    }
}

}  // namespace
