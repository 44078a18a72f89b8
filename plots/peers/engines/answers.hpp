#pragma once
// Errors of a run, from positions and orientations only, by the same code for every engine.
//
// The right answers are those of rigid bodies, contacts and joints. Our own contacts and joints have a stiffness. Their
// deflection counts as an error here, as that of any other engine does.
#include <functional>
#include <memory>

#include "peers/engines/engine.hpp"

namespace spook::peers {

class Judge {
 public:
  virtual ~Judge() = default;
  virtual void look(const Engine& engine, double time) = 0;  ///< at the start, and after each step
  virtual double error() const = 0;                          ///< relative; 1 or more: lost
};

using MakeJudge = std::function<std::unique_ptr<Judge>(const Problem& problem)>;

/// The error of bodies that should stay at rest: the largest displacement of a body at the end, over the size of the
/// first.
std::unique_ptr<Judge> stays_in_place(const Problem& problem);

/// The error of bodies on ball joints: the largest distance at the end between the two points that a joint holds
/// together, over the length of the first link.
std::unique_ptr<Judge> holds_its_joints(const Problem& problem);

/// The error of a wire: its largest stretch in the second half of `time`, over its initial length.
std::unique_ptr<Judge> keeps_its_length(const Problem& problem, double time);

/// The error of the last body of a plane chain of rods: the largest distance from its right position, over the chain's
/// length. The answer integrates the angles of the rods to round-off.
std::unique_ptr<Judge> swings_as_rods(const Problem& problem);

/// The error of a thrown block: |distance - v0²/(2 μ g)| at the end, over v0²/(2 μ g).
std::unique_ptr<Judge> stops_by_coulomb(const Problem& problem, double v0);

/// The error of a sphere that slides, then rolls: the largest error along its path, over the length of the sliding
/// part.
std::unique_ptr<Judge> slides_then_rolls(const Problem& problem, double v0);

/// The error of a free top about its middle axis: the largest angle from the orientation by Euler's equations [rad].
std::unique_ptr<Judge> turns_by_euler(const Problem& problem, const Vec3& omega);

/// The error of a ball dropped from h0: the largest error of the first five peaks, over h0. A peak is that of the
/// parabola through the three highest points of a flight.
std::unique_ptr<Judge> bounces_to(const Problem& problem, double h0);

/// The error of bodies dropped into a box: the mean depth of overlapping contacts at the end, over a body's size. 1 if
/// a body has left the box, or if bodies still move by more than their size in a second on average.
std::unique_ptr<Judge> lies_without_overlap(const Problem& problem);

}  // namespace spook::peers
