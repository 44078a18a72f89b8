// The solver "spatial_decomposition": projected Gauss-Seidel on several threads.
//
//   stripes    n bodies are divided into ∛n/2 stripes side by side, a multiple of four from four on, with equal numbers
//              of rows: in a cube a stripe is two bodies wide
//   a row      belongs to the first stripe that contains one of its bodies; most rows reach at most into the next one
//   a sweep    updates all even stripes in parallel, then all odd stripes in parallel; then the rows that reach farther
//
// Rows that are swept in parallel share no dynamic body. So the result is the same to the last bit for any number of
// threads. With two rounds a sweep, threads wait less for each other than with a round for each colour of chapter 14.
// Within a stripe rows are interleaved, Eq. (14.13). A history entry is the result of a sweep. Has no cache.
#include <algorithm>
#include <cmath>
#include <utility>

#include "10_convergence/convergence.hpp"
#include "14_fast_rows/fast_rows.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/support/parallel_for.hpp"

namespace spook {

namespace {

struct Stripe {
  std::vector<int> rows;  ///< indices of the rows
  double lacked = 0;      ///< residual in the last sweep [m/s]
};

/// Returns the axis along which consecutive bodies are closest, relative to the extent of all bodies. So consecutive
/// rows, which are also close in memory, belong to one stripe.
template <int Dof>
int axis_across(const std::vector<int>& moving, const Bodies<Dof>& bodies) {
  Eigen::Array3d steps = Eigen::Array3d::Zero();
  Eigen::AlignedBox3d all;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    const Vec3& x = bodies.x[moving[k]];
    all.extend(x);
    if (k > 0) steps += (x - bodies.x[moving[k - 1]]).array().abs();
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (steps[other] * all.sizes()[axis] < steps[axis] * all.sizes()[other]) axis = other;
  return axis;
}

/// Returns the rank of each dynamic body along the axis; -1 for the others.
template <int Dof>
std::vector<int> places(const Bodies<Dof>& bodies) {
  std::vector<int> moving;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies.is_fixed(i)) moving.push_back(static_cast<int>(i));
  const int axis = axis_across(moving, bodies);
  std::stable_sort(moving.begin(), moving.end(),
                   [&](int a, int b) { return bodies.x[a][axis] < bodies.x[b][axis]; });
  std::vector<int> place(bodies.size(), -1);
  for (std::size_t n = 0; n < moving.size(); ++n) place[moving[n]] = static_cast<int>(n);
  return place;
}

/// The extent of a row: the ranks of its dynamic bodies, -1 if there is none.
struct Reach {
  int low, high;
};

template <int Dof>
std::vector<Reach> reaches(const SolverInput<Dof>& s, const std::vector<int>& place) {
  std::vector<Reach> all(s.rows().size());
  parallel_for(s.threads, all.size(), [&](std::size_t, std::size_t k, std::size_t end) {
    for (; k < end; ++k) {
      const auto [low, high] = std::minmax(place[s.rows()[k].i], place[s.rows()[k].j]);
      all[k] = {.low = low < 0 ? high : low, .high = high};
    }
  });
  return all;
}

/// Returns the stripe of each rank, such that stripes have nearly equal numbers of rows.
std::vector<int> stripes_of_places(const std::vector<Reach>& rows) {
  std::vector<std::size_t> begin;  // number of rows that start at each rank
  for (const Reach& row : rows) {
    if (row.high >= std::ssize(begin)) begin.resize(static_cast<std::size_t>(row.high) + 1, 0);
    if (row.low >= 0) ++begin[row.low];
  }
  auto count = static_cast<std::size_t>(std::max(1.0, std::cbrt(begin.size()) / 2));
  if (count > 4)
    count -= count % 4;  // so that two threads have equal numbers of even stripes, and of odd stripes
  std::vector<int> stripe;
  std::size_t before = 0;
  for (const std::size_t here : begin) {
    stripe.push_back(static_cast<int>((before + here / 2) * count / rows.size()));
    before += here;
  }
  return stripe;
}

/// Gives each stripe a static body of its own during its lifetime, so that no two stripes write to the same body.
template <int Dof>
class OwnGround {
 public:
  explicit OwnGround(const SolverInput<Dof>& s) : s_(s), bodies_(s.V.size()) {}
  OwnGround(const OwnGround&) = delete;
  OwnGround& operator=(const OwnGround&) = delete;
  ~OwnGround() {
    for (const auto& [body, was] : lent_) *body = was;
    s_.V.resize(bodies_);
  }

  void lend(int stripe, int& body) {
    const std::size_t own = bodies_ + apart * (static_cast<std::size_t>(stripe) + 1);
    if (s_.V.size() <= own) s_.V.resize(own + 1, Twist<Dof>::Zero());
    lent_.emplace_back(&body, std::exchange(body, static_cast<int>(own)));
  }

 private:
  static constexpr std::size_t apart = 4;  // no two stripes share a cache line
  const SolverInput<Dof>& s_;
  std::size_t bodies_;
  std::vector<std::pair<int*, int>> lent_;
};

/// Returns all rows by stripe; the last stripe has the rows that reach farther.
template <int Dof>
std::vector<Stripe> divided(const SolverInput<Dof>& s, const std::vector<int>& place, OwnGround<Dof>& ground) {
  const std::vector<Reach> reach = reaches(s, place);
  const std::vector<int> of_place = stripes_of_places(reach);
  const int rest = of_place.empty() ? 1 : of_place.back() + 1;
  const auto stripe_of = [&](const Reach& row) {
    if (row.low < 0) return 0;
    const int low = of_place[row.low], high = of_place[row.high];
    return high > low + 1 ? rest : low;
  };
  std::vector<std::vector<Stripe>> of_share(shares_of(s.threads, reach.size()));
  parallel_for(s.threads, reach.size(), [&](std::size_t share, std::size_t k, std::size_t end) {
    of_share[share].resize(static_cast<std::size_t>(rest) + 1);
    for (; k < end; ++k) of_share[share][stripe_of(reach[k])].rows.push_back(static_cast<int>(k));
  });
  std::vector<Stripe> stripes = std::move(of_share.front());
  for (std::size_t share = 1; share < of_share.size(); ++share)
    for (std::size_t n = 0; n < stripes.size(); ++n) {
      const std::vector<int>& more = of_share[share][n].rows;
      stripes[n].rows.insert(stripes[n].rows.end(), more.begin(), more.end());
    }
  for (Stripe& stripe : stripes) {
    std::vector<int> order = interleaved_order(stripe.rows.size());
    for (int& k : order) k = stripe.rows[k];
    stripe.rows = std::move(order);
  }
  for (std::size_t k = 0; k < reach.size(); ++k) {
    if (reach[k].low < reach[k].high) continue;  // two dynamic bodies
    for (int* body : {&s.rows()[k].i, &s.rows()[k].j})
      if (place[*body] < 0) ground.lend(stripe_of(reach[k]), *body);
  }
  return stripes;
}

template <int Dof>
SolverResult solve_in_stripes(const SolverInput<Dof>& s) {
  SolveReport report;
  report.converged = s.rows().empty();
  if (report.converged) return report;
  OwnGround<Dof> ground(s);
  std::vector<Stripe> stripes = divided(s, places(s.bodies), ground);
  const std::size_t rest = stripes.size() - 1, rounds = stripes[rest].rows.empty() ? 2 : 3;
  const std::size_t threads = std::clamp<std::size_t>((rest + 1) / 2, 1, shares_of(s.threads, s.rows().size()));

  std::size_t round = 0;
  const auto work = [&](std::size_t thread) {
    const auto sweep_one = [&](Stripe& stripe) { stripe.lacked = sweep_in_order(stripe.rows, s.rows(), s.V); };
    if (round == 2) {
      if (thread == 0) sweep_one(stripes[rest]);
      return;
    }
    const std::size_t n = (rest + 1 - round) / 2;  // even stripes, or odd stripes
    for (std::size_t k = n * thread / threads; k < n * (thread + 1) / threads; ++k)
      sweep_one(stripes[2 * k + round]);
  };
  const auto next = [&] {
    if (++round < rounds) return true;
    round = 0;
    double most = 0;
    for (const Stripe& stripe : stripes)
      if (std::isnan(stripe.lacked) || stripe.lacked > most) most = stripe.lacked;
    report.history.push_back(most);
    report.converged = most <= s.stop.tolerance;
    return !report.converged && std::ssize(report.history) < s.stop.max_sweeps;
  };
  in_rounds(static_cast<int>(threads), work, next);
  return report;
}

}  // namespace

template <int Dof>
Solver<Dof> spatial_decomposition() {
  return {.solve = solve_in_stripes<Dof>};
}

template Solver<3> spatial_decomposition<3>();
template Solver<6> spatial_decomposition<6>();

}  // namespace spook
