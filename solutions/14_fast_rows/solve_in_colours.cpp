#include <algorithm>
#include <cmath>

#include "14_fast_rows/fast_rows.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport solve_in_colours(std::vector<Colour<Dof>>& colours, std::vector<Twist<Dof>>& V,
                             const StopRule& stop, int threads) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  if (threads < 1 || threads > 256) reject("threads", threads, "from 1 to 256");

  SolveReport report;
  report.converged =
      std::all_of(colours.begin(), colours.end(), [](const auto& colour) { return colour.empty(); });
  if (report.converged) return report;

  std::size_t now = 0;  // which colour
  std::vector<double> largest(static_cast<std::size_t>(threads), 0.0);
  const auto note = [](double lacked, double& most) {
    if (std::isnan(lacked) || lacked > most) most = lacked;
  };
  const auto share = [&](int thread) {
    Colour<Dof>& packs = colours[now];
    const std::size_t n = packs.size(), first = n * thread / threads, end = n * (thread + 1) / threads;
    double most = largest[thread];
    for (std::size_t k = first; k < end; ++k) note(update_pack(packs[k], V), most);  // Eq. (14.10)
    largest[thread] = most;
  };
  const auto next = [&] {
    if (++now < colours.size()) return true;
    now = 0;
    double most = 0;
    for (double& lacked : largest) {
      note(lacked, most);
      lacked = 0;
    }
    report.history.push_back(most);
    report.converged = most <= stop.tolerance;
    return !report.converged && std::ssize(report.history) < stop.max_sweeps;
  };
  in_rounds(threads, share, next);
  return report;
}

template SolveReport solve_in_colours<3>(std::vector<Colour<3>>&, std::vector<Twist<3>>&, const StopRule&, int);
template SolveReport solve_in_colours<6>(std::vector<Colour<6>>&, std::vector<Twist<6>>&, const StopRule&, int);

}  // namespace spook
