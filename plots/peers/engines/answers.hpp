#pragma once
// How far a run is from what is right: from positions and orientations alone, by the same lines for every engine.
//
// What is right is rigid: nothing gives way, nothing sinks in. Our own contacts and joints have a stiffness, and
// what they give way by counts as an error here, as another engine's does.
#include <functional>
#include <memory>

#include "peers/engines/engine.hpp"

namespace spook::peers {

class Judge {
 public:
  virtual ~Judge() = default;
  virtual void look(const Engine& engine, double time) = 0;  ///< at the start, and after each step
  virtual double error() const = 0;                          ///< relative; 1 and more is lost
};

using MakeJudge = std::function<std::unique_ptr<Judge>(const Problem& problem)>;

/// Of bodies that touch at the start, and have no reason to move: the farthest that one has gone, at the end, over the
/// size of the first.
std::unique_ptr<Judge> stays_in_place(const Problem& problem);

/// Of a wire: how much longer it is than at the start, over that; the most of the second half of `time`.
std::unique_ptr<Judge> keeps_its_length(const Problem& problem, double time);

/// Of the last body of a chain of rods in a plane, the farthest from where it should be, over the chain's length. The
/// answer is that of the rods' angles, integrated to roundings.
std::unique_ptr<Judge> swings_as_rods(const Problem& problem);

/// Of a thrown block: how far from v0²/(2 μ g) it lies at the end, over that.
std::unique_ptr<Judge> stops_by_coulomb(const Problem& problem, double v0);

/// Of a sphere that slides, then rolls: the farthest along its way, over the part on which it should slide.
std::unique_ptr<Judge> slides_then_rolls(const Problem& problem, double v0);

/// Of a free top about its middle axis: the farthest angle from its orientation by Euler's equations [rad].
std::unique_ptr<Judge> turns_by_euler(const Problem& problem, const Vec3& omega);

/// Of a ball dropped from h0: the largest error of the first five peaks, over h0. A peak is that of the parabola through
/// the three highest points of a flight.
std::unique_ptr<Judge> bounces_to(const Problem& problem, double h0);

/// Of what was dropped into a box: the mean depth of those contacts that overlap, at the end, over a body's size. 1
/// where a body has left the box, or where they still go farther than their size in a second on average.
std::unique_ptr<Judge> lies_without_overlap(const Problem& problem);

}  // namespace spook::peers
