// Sweeps by colour, on any number of threads: the same numbers.
#include <algorithm>

#include "14_fast_rows/fast_rows.hpp"
#include "exercise_test.hpp"
#include "packs.hpp"
#include "random_input.hpp"
#include "regions.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SolveInColours, "14.5 solve_in_colours");

/// The result of a solve: impulses in the rows, velocities, and the history.
struct Solved {
  Heap heap;
  SolveReport report;
};

Solved solved(Heap heap, const StopRule& stop, int threads) {
  std::vector<Colour<6>> colours = packed(heap.rows, heap.V.size());
  const SolveReport report = solve_in_colours(colours, heap.V, stop, threads);
  unpack(colours, heap.rows);
  return {heap, report};
}

EXERCISE_TEST(SolveInColours, GoesColourByColour) {
  Random random;
  const Heap heap(random, 20, 60);
  std::vector<Colour<6>> by_hand = packed(heap.rows, heap.V.size());
  std::vector<Twist<6>> V = heap.V;
  std::vector<double> history, last_colour;
  for (int n = 0; n < 4; ++n) {
    history.push_back(0);
    last_colour.push_back(0);
    for (Colour<6>& colour : by_hand) {
      last_colour.back() = 0;
      for (Pack<6>& pack : colour) last_colour.back() = std::max(last_colour.back(), update_pack(pack, V));
      history.back() = std::max(history.back(), last_colour.back());
    }
  }
  const Solved got = solved(heap, {.max_sweeps = 4}, 1);
  expect_true("four sweeps make a history of four, and not of " + std::to_string(got.report.history.size()),
              "Eq. (4.9)", got.report.history.size() == 4, "Append one entry a sweep, not one a colour.");
  for (std::size_t n = 0; n < std::min<std::size_t>(4, got.report.history.size()); ++n)
    expect_near("entry " + std::to_string(n) + " of the history [m/s]", "Eq. (4.9)", got.report.history[n],
                history[n], {0, "the same updates"},
                {{last_colour[n], "This is the largest of the last colour: include the others."},
                 {*std::max_element(history.begin(), history.begin() + static_cast<std::ptrdiff_t>(n) + 1),
                  "This is the largest of all sweeps so far, not of this sweep: begin with 0 in each."}},
                "Append the largest value that any pack of this sweep returned.");
  expect_true("V equals that of one pack after the other, to the last bit", "Eq. (14.10)",
              same_bits(got.heap.V, V), "Update all packs of a colour, then the next colour, in order.");
}

EXERCISE_TEST(SolveInColours, HasAnyNumberOfColoursAndPacks) {
  // Body 1 is a table that carries a hundred bodies, and so is in a hundred colours. Twelve hundred pairs without
  // common bodies all have one colour, in three hundred packs.
  Random random;
  Heap heap(random, 2502, 0);
  for (int k = 0; k < 100; ++k) heap.rows.push_back(some_row(random, 1, 2 + k, heap.motion));
  for (int k = 51; k < 1251; ++k) heap.rows.push_back(some_row(random, 2 * k, 2 * k + 1, heap.motion));
  std::vector<Colour<6>> by_hand = packed(heap.rows, heap.V.size());
  expect_true("(of this test) there are 100 colours, and 301 packs in the first", "Eq. (14.7)",
              by_hand.size() == 100 && by_hand[0].size() == 301);
  std::vector<Twist<6>> V = heap.V;
  for (int n = 0; n < 2; ++n)
    for (Colour<6>& colour : by_hand)
      for (Pack<6>& pack : colour) update_pack(pack, V);
  for (const int threads : {1, 2})
    expect_true(
        "on " + std::to_string(threads) +
            " threads, V after two sweeps in 100 colours, with 301 packs in the first, is that of one pack "
            "after the other",
        "Eq. (14.10)", same_bits(solved(heap, {.max_sweeps = 2}, threads).heap.V, V),
        "All colours, and all packs of each, however many there are.");
  for (const int place : {0, 50, 100}) {
    std::vector<Colour<6>> with_gap = packed(heap.rows, heap.V.size());
    with_gap.insert(with_gap.begin() + place, Colour<6>{});
    std::vector<Twist<6>> U = heap.V;
    const SolveReport report = solve_in_colours(with_gap, U, {.max_sweeps = 2}, 1);
    expect_true(
        "with a colour without packs at place " + std::to_string(place) +
            " there are two sweeps, and the same V",
        "Eq. (14.10)", report.history.size() == 2 && same_bits(U, V),
        "A colour may have no packs. It ends neither the sweep nor the solve: go on with the next colour.");
  }
}

// If two threads share a number, the order of their accesses is random, and so is the result of the same work. All
// other mistakes give the same wrong result each time, and other tests find them.
EXERCISE_TEST(SolveInColours, HasNoDataRace) {
  Random random;
  const Heap crowd(random, 30, 150);  // many colours: each begins when the last is done
  Heap apart(random, 2 * lane_count * many + 1,
             0);  // one colour with many packs: do they write to a common place?
  for (int k = 1; k < 2 * lane_count * many; k += 2)
    for (int row = 0; row < 3; ++row) {
      apart.rows.push_back(some_row(random, k, k + 1, apart.motion));
      apart.rows.back().lo = -infinity, apart.rows.back().hi = infinity;
    }
  struct Work {
    const Heap& heap;
    int sweeps, times;
  };
  for (const Work& work : {Work{crowd, 2, 4}, Work{apart, 20, 6}}) {
    const StopRule stop{.max_sweeps = work.sweeps, .tolerance = 0};
    const Solved alone = solved(work.heap, stop, 1), once = solved(work.heap, stop, 8);
    if (!same_bits(solved(work.heap, stop, 1).heap, alone.heap)) return;  // then threads are not the cause
    for (int n = 1; n < work.times; ++n) {
      const Solved again = solved(work.heap, stop, 8);
      if (same_bits(again.heap, once.heap) && again.report.history == once.report.history) continue;
      this_failure_explains();
      report_failure(
          "the same work on one thread, twice, and on eight threads, " + std::to_string(n + 1) + " times",
          "Eq. (14.10)",
          "  expected  the same each time\n  got       the same on one thread, but not on eight\n",
          "This is a data race: two threads use one number at the same time, and one of them writes it. Do all "
          "threads keep their largest in one variable? Does a colour begin before all threads are done with "
          "the last one? Is a pack in two shares?");
      return;
    }
  }
}

EXERCISE_TEST(SolveInColours, IsTheSameOnAnyNumberOfThreads) {
  Random random;
  // Few rounds suffice: on a busy machine threads wait for a core in each.
  for (int trial = 0; trial < 3 && !::testing::Test::HasFailure(); ++trial) {
    const Heap heap(random, 40, 150);
    const Solved alone = solved(heap, {.max_sweeps = 5}, 1);
    expect_true("5 sweeps have been made", "Eq. (4.9)", alone.report.history.size() == 5);
    for (const int threads : {2, 3, 8}) {
      const Solved together = solved(heap, {.max_sweeps = 5}, threads);
      const std::string on = "on " + std::to_string(threads) + " threads ";
      expect_true(on + "λ and V are the same as on one thread, to the last bit", "Eq. (14.10)",
                  same_bits(alone.heap, together.heap),
                  "Has every pack been updated once? Does each colour wait for the end of the last one?");
      expect_true(on + "the history is the same as on one", "Eq. (4.9)",
                  alone.report.history == together.report.history,
                  "Append the largest of all threads, and of this sweep only.");
    }
  }
}

EXERCISE_TEST(SolveInColours, HasThreadsWithNothingToDo) {
  Random random;
  const Heap heap(random, 3, 2);
  const Solved alone = solved(heap, {.max_sweeps = 3}, 1), many = solved(heap, {.max_sweeps = 3}, 16);
  expect_true("16 threads for a pack or two give the same result", "Eq. (14.10)",
              same_bits(alone.heap, many.heap) && alone.report.history == many.report.history,
              "A share may be empty.");
}

EXERCISE_TEST(SolveInColours, CombinesTheResidualsOfAllThreads) {
  // A hundred packs of one colour, so that each of a hundred threads has one. The last pack has the largest residual.
  Random random;
  Heap heap(random, 2 * lane_count * many + 2, 0);
  for (int k = 1; k <= lane_count * many; ++k)
    heap.rows.push_back(some_row(random, 2 * k, 2 * k + 1, heap.motion));
  heap.rows.back().lo = -infinity, heap.rows.back().hi = infinity, heap.rows.back().B = 1000;
  const StopRule stop{.max_sweeps = 3, .tolerance = 1e-9};
  const std::vector<double> alone = solved(heap, stop, 1).report.history,
                            together = solved(heap, stop, many).report.history;
  expect_true(
      "on a hundred threads, the last of which has the pack with the largest residual, the history is that of "
      "one thread",
      "Eq. (4.9), (14.10)", alone == together,
      "Append the largest of all threads, however many there are. In the next sweep each begins at 0.");
}

// From here on the tests use one thread: the tests above compare several.
EXERCISE_TEST(SolveInColours, HasChapter04sSolution) {
  Random random;
  for (int trial = 0; trial < 2; ++trial) {
    Heap heap(random, 12, 20), plain = heap;
    const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-12};
    const Solved got = solved(heap, stop, 1);
    const SolveReport slow = solve(plain.rows, plain.V, stop);
    expect_true("it converged, as chapter 04's does", "Eq. (4.9)", got.report.converged && slow.converged);
    expect_at_most("residual of what is left [m/s]", "Eq. (4.8)", residual(got.heap.rows, got.heap.V), 1e-10,
                   "the tolerance, times the coupling of the rows", "V and λ must belong together.");
    for (std::size_t body = 0; body < plain.V.size(); ++body)
      expect_near_vector("V of body " + std::to_string(body), "Eq. (4.1)", got.heap.V[body], plain.V[body],
                         {1e-8, "the tolerance, times the condition"}, {},
                         "In another order the sweeps converge to the same solution.");
  }
}

EXERCISE_TEST(SolveInColours, StopsByTheRule) {
  Random random;
  const Heap heap(random, 10, 25);
  const auto anew = [&](const StopRule& stop) { return solved(heap, stop, 1).report; };
  expect_stops_by_the_rule("Eq. (4.9)", 8, anew);
}

EXERCISE_TEST(SolveInColours, GoesOnWhenASweepReturnsMore) {
  Random random;
  Regions regions({"a sweep returns more than the one before"}, 5);
  while (regions.lack_draws()) {
    const Heap heap(random, 10, 25);
    std::vector<Colour<6>> packs = packed(heap.rows, heap.V.size());
    std::vector<Twist<6>> V = heap.V;
    std::vector<double> by_hand;
    for (int n = 0; n < 10; ++n) {
      by_hand.push_back(0);
      for (Colour<6>& colour : packs)
        for (Pack<6>& pack : colour) by_hand.back() = std::max(by_hand.back(), update_pack(pack, V));
    }
    const bool more = one_returns_more(by_hand);
    regions.draw({{"a sweep returns more than the one before", more}});
    const auto anew = [&](const StopRule& stop) { return solved(heap, stop, 1).report; };
    if (more) expect_goes_on_when_one_returns_more("Eq. (4.9)", by_hand, anew);
  }
}

EXERCISE_TEST(SolveInColours, DoesNothingWithoutPacks) {
  std::vector<Colour<6>> none, empty(2);
  std::vector<Twist<6>> V(1, Twist<6>::Constant(3));
  for (std::vector<Colour<6>>* colours : {&none, &empty}) {
    const SolveReport report = solve_in_colours(*colours, V, {.max_sweeps = 5}, 2);
    expect_true("without packs there is no sweep, and it has converged", "Eq. (4.9)",
                report.converged && report.history.empty());
  }
}

EXERCISE_TEST(SolveInColours, RefusesBadRules) {
  Random random;
  const Heap heap(random, 4, 4);
  expect_rejects("a rule of no sweeps", "max_sweeps", [&] { solved(heap, {.max_sweeps = 0}, 1); });
  expect_rejects("a negative tolerance", "tolerance", [&] { solved(heap, {.tolerance = -1}, 1); });
  expect_rejects("a tolerance of NaN", "tolerance", [&] { solved(heap, {.tolerance = std::nan("")}, 1); });
  for (const int bad : {0, -1, 257})
    expect_rejects(std::to_string(bad) + " threads", "threads", [&] { solved(heap, {}, bad); });
  std::vector<Colour<6>> none;
  std::vector<Twist<6>> V;
  expect_rejects("no threads, where there is nothing to do either", "threads",
                 [&] { solve_in_colours(none, V, {}, 0); });
  expect_true("256 threads are allowed", "Eq. (14.10)", solve_in_colours(none, V, {}, 256).converged);
}

EXERCISE_TEST(SolveInColours, KeepsANaN) {
  Random random;
  for (const int threads : {1, 2}) {
    Heap heap(random, 20, 60);
    heap.rows[0].B = std::nan("");
    const Solved got = solved(heap, {.max_sweeps = 2, .tolerance = 1}, threads);
    expect_true("a NaN is in the history, and it has not converged", "Eq. (4.9)",
                !got.report.converged && !got.report.history.empty() && std::isnan(got.report.history[0]),
                "std::max drops a NaN.");
  }
}

}  // namespace
