// Sweeps on several threads for ThreadSanitizer, which sees accesses of memory in code that is compiled with it: the
// student's solve_in_colours, and the two functions that it calls, which are here. See tools/course/races.py.
#include <thread>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

/// Reads and writes what an update does, by no law: λ, and the velocities of the bodies.
template <int Dof>
double update_pack(Pack<Dof>& pack, std::vector<Twist<Dof>>& V) {
  for (LaneRows<Dof>& row : pack.rows)
    for (int lane = 0; lane < lane_count; ++lane) {
      row.lambda[lane] += 1;
      for (const int body : {pack.i[lane], pack.j[lane]})
        if (body >= 0) V[body][0] += row.lambda[lane];
    }
  return 1;
}

template double update_pack<3>(Pack<3>&, std::vector<Twist<3>>&);
template double update_pack<6>(Pack<6>&, std::vector<Twist<6>>&);

void in_rounds(int threads, const std::function<void(int thread)>& work, const std::function<bool()>& next) {
  do {
    std::vector<std::thread> others;
    for (int thread = 1; thread < threads; ++thread) others.emplace_back([&work, thread] { work(thread); });
    work(0);
    for (std::thread& other : others) other.join();
  } while (next());
}

}  // namespace spook

using namespace spook;

int main() {
  const int packs = 7;  // no multiple of the numbers of threads
  Colour<6> colour(packs);
  int body = 0;
  for (Pack<6>& pack : colour) {
    pack.rows.resize(3);
    for (int lane = 0; lane < lane_count; ++lane) pack.i[lane] = body++, pack.j[lane] = body++;
  }
  // The next colour has the same pairs in reverse order. So each thread meets bodies of another thread's last colour.
  const std::vector<Colour<6>> colours = {colour, {colour.rbegin(), colour.rend()}};
  for (const int threads : {2, 3}) {
    std::vector<Colour<6>> own = colours;
    std::vector<Twist<6>> V(static_cast<std::size_t>(body), Twist<6>::Zero());
    solve_in_colours(own, V, {.max_sweeps = 3, .tolerance = 0}, threads);
  }
}
