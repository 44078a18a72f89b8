// Number of comparisons and time of three broad phases. Spheres of radius 0.35 m are at random positions, one in each
// cubic metre, so the number of neighbours of a sphere does not depend on N.
//
//   all pairs         N (N - 1)/2 comparisons
//   sweep and prune   pairs that overlap along one axis: N (N - 1)/2 times 2·0.7/L in a cube of side L = N^(1/3),
//                     so N^(5/3); Eq. (8.12)
//   spatial hash      pairs that share a cell of 1 m: a sphere's bounds are in 1.7 cells along each axis, so a cell
//                     has μ = 1.7³ of them, and μ²/2 pairs: 12 N, except near the surface; Eq. (8.13), (8.14)
//
// Comparisons are counted from these equations, so they are the same on every machine. Times are those of the
// functions.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "08_pairs/pairs.hpp"
#include "machinery/experiment.hpp"
#include "machinery/timing.hpp"

namespace spook::plots {
namespace {

constexpr double radius = 0.35, ns_in_a_ms = 1e6;

std::vector<Bounds> spheres(int count) {
  std::mt19937_64 engine(1);
  const double side = std::cbrt(count);
  // std::uniform_real_distribution's numbers are not the same on every machine.
  const auto next = [&] { return side * std::ldexp(static_cast<double>(engine() >> 11), -53); };
  std::vector<Bounds> bounds;
  for (int k = 0; k < count; ++k) {
    Vec3 x;
    for (double& coordinate : x) coordinate = next();
    bounds.push_back({.lower = x - Vec3::Constant(radius), .upper = x + Vec3::Constant(radius)});
  }
  return bounds;
}

bool touch(const Bounds& a, const Bounds& b) {
  bool all = true;
  for (int k = 0; k < 3; ++k) all &= (a.lower[k] <= b.upper[k]) & (b.lower[k] <= a.upper[k]);
  return all;
}

std::vector<Pair> all_pairs(const std::vector<Bounds>& bounds) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < bounds.size(); ++i)
    for (std::size_t j = i + 1; j < bounds.size(); ++j)
      if (touch(bounds[i], bounds[j])) pairs.emplace_back(static_cast<int>(i), static_cast<int>(j));
  return pairs;
}

double pairs_of(double count) {
  return count * (count - 1) / 2;
}

/// Returns the number of pairs that overlap along x.
double overlapping_along_x(const std::vector<Bounds>& bounds) {
  std::vector<double> lower;
  for (const Bounds& one : bounds) lower.push_back(one.lower.x());
  std::sort(lower.begin(), lower.end());
  double count = 0;
  for (auto one = lower.begin(); one != lower.end(); ++one)
    count += static_cast<double>(std::upper_bound(one, lower.end(), *one + 2 * radius) - one - 1);
  return count;
}

/// Returns the number of pairs that share a cell of 1 m, counted in each shared cell.
double sharing_a_cell(const std::vector<Bounds>& bounds) {
  std::map<std::tuple<double, double, double>, double> cells;
  for (const Bounds& one : bounds) {
    const Vec3 first = one.lower.array().floor(), last = one.upper.array().floor();
    for (double a = first.x(); a <= last.x(); ++a)
      for (double b = first.y(); b <= last.y(); ++b)
        for (double c = first.z(); c <= last.z(); ++c) ++cells[{a, b, c}];
  }
  double count = 0;
  for (const auto& [cell, members] : cells) count += pairs_of(members);
  return count;
}

/// Returns the expected number. Along an axis of length L the cells contain 0.35, 1.35, 1.7, …, 1.7, 1.35, 0.35 spheres
/// in the mean. The sum of their squares is 2.89 L - 1.89, and the same along the other axes.
double sharing_a_cell_in_the_mean(double count) {
  return count * std::pow(2.89 - 1.89 / std::cbrt(count), 3) / 2;
}

template <class Find>
std::vector<Row> measured(const std::string& way, const std::vector<Bounds>& bounds, double compared,
                          const Find& find) {
  const auto found = static_cast<double>(find(bounds).size());
  const Timing time = time_each(ns_in_a_ms, 5, [&] { find(bounds); });
  return {{way, double(bounds.size()), compared, found, time.median, time.low, time.high}};
}

Experiment experiment(Size size) {
  Experiment e;
  e.timed = true;
  e.columns = {"way", "bodies", "compared", "pairs", "time [ms]", "quartile below", "quartile above"};
  const int most = size == Size::quick ? 8000 : 64000;
  for (int count = 1000; count <= most; count *= 2) {
    const std::string of = " of " + std::to_string(count);
    if (count <= 8000)
      e.points.push_back({"all pairs" + of,
                          [=] { return measured("all pairs", spheres(count), pairs_of(count), all_pairs); }});
    e.points.push_back({"sweep and prune" + of, [=] {
                          const auto bounds = spheres(count);
                          return measured("sweep and prune", bounds, overlapping_along_x(bounds),
                                          sweep_and_prune);
                        }});
    e.points.push_back({"spatial hash" + of, [=] {
                          const auto bounds = spheres(count);
                          return measured("spatial hash", bounds, sharing_a_cell(bounds), spatial_hash);
                        }});
  }
  e.check = [](const Table& table, Claims& claims) {
    const auto slope = [&](const std::string& way) {
      const Table some = table.where("way", way);
      return log_log_slope(some.numbers("bodies"), some.numbers("compared"));
    };
    claims.near("all pairs are N²/2 comparisons: slope 2.00 ± 0.01", slope("all pairs"), 2, 0.01);
    claims.near(
        "sweep and prune compares the pairs that overlap along one axis, and their number grows with N^(5/3): "
        "slope 1.67 ± 0.03",
        slope("sweep and prune"), 5.0 / 3, 0.03);
    claims.near(
        "the hash compares the pairs that share a cell, and their number grows with N: slope 1.00 ± 0.05",
        slope("spatial hash"), 1, 0.05);
    double worst = 0;
    const Table hash = table.where("way", "spatial hash");
    const auto bodies = hash.numbers("bodies"), compared = hash.numbers("compared");
    for (std::size_t k = 0; k < bodies.size(); ++k)
      worst = std::max(worst, std::abs(compared[k] / sharing_a_cell_in_the_mean(bodies[k]) - 1));
    claims.at_most(
        "in a cube of L cells a side the hash makes (2.89 - 1.89/L)³/2 comparisons for each sphere, to 5 per "
        "cent",
        worst, 0.05);
    double different = 0;
    for (const double count : {1000, 2000, 4000, 8000}) {
      const auto pairs = table.where("bodies", count).numbers("pairs");
      different +=
          *std::max_element(pairs.begin(), pairs.end()) - *std::min_element(pairs.begin(), pairs.end());
    }
    claims.near("all three find the same number of pairs", different, 0, 0);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  return spook::plots::run_experiment(argc, argv, spook::plots::experiment);
}
