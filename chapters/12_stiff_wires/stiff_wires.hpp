#pragma once
// Chapter 12 · Stiff wires
//
// A tight link is also a transverse spring: its tension resists rotation. Leapfrog is stable for this spring only while
// h is below 2/ω. If h²K is added to the mass matrix, the spring is stable for any step.
//
//   frequency    ω = √(4T/(m l)), the fastest of a tight wire                      Eq. (12.1)   not in the notes
//   limit        h < 2/ω                                                           Eq. (12.2)   not in the notes
//   stiffness    K = (T/l) (1 - n nᵀ): force -K δ if x_j - x_i changes by δ        Eq. (12.3)   not in the notes
//   tension      T = -λ/h of the last step, 0 for a link that pushes               Eq. (12.4)   not in the notes
//   mass matrix  M̃ = M + h²K, with K on (i,i) and (j,j), -K on (i,j) and (j,i)     Eq. (12.5)   not in the notes
//   step         M̃ (V + W_f) = M W_f + Gᵀλ,  G V + Σ λ = B                         Eq. (12.6)   not in the notes
//
//   T   tension [N]      m   mass of a point [kg]      M   mass matrix
//   l   length [m]       n   direction of the link     V, λ, W_f, B as in chapter 04
//
// Tournier et al., "Stable constrained dynamics" (2015), apply M̃ to the new velocity. This damps: a loss of order h.
// Here M̃ applies to the change of velocity. This does not damp, and the order is 2.
#include "11_direct/direct.hpp"

namespace spook {

/// Exercise 12.1. The fastest frequency of a wire of equal points under tension, across it [rad/s]: Eq. (12.1).
/// Throws std::invalid_argument, naming the parameter, unless tension [N] is finite and >= 0, and mass [kg] of a
/// point and length [m] of a link are positive and finite.
double transverse_frequency(double tension, double mass, double length);

/// Exercise 12.2. K of a link with unit direction `n` [N/m]: Eq. (12.3), (12.4). Zero for a tension [N] of zero or
/// less.
Mat3 geometric_stiffness(const Vec3& n, double length, double tension);

/// A spring between two bodies, in all directions.
struct Stiffness {
  int i, j;  ///< body indices, i ≠ j
  Mat3 K;    ///< symmetric [N/m]
};

/// Exercise 12.3. The saddle-point matrix of Eq. (11.2) with M̃ of Eq. (12.5) in place of M: its lower triangle,
/// compressed, in the same layout. Springs may share bodies, and add up. A spring to a static body adds h²K to the
/// block of the dynamic body only: neither the block of the static one nor that of the pair gets anything. A spring has its entries even where they are 0, so that a wire that goes slack keeps its pattern.
SparseMatrix stiffened_matrix(const std::vector<Row<3>>& rows, const std::vector<InverseMass<3>>& inverse_mass,
                              const std::vector<Stiffness>& stiffness, double h);

/// Exercise 12.4. Solves rows as if they had no bounds, with M̃, Eq. (12.6). Writes λ into the rows, and the velocity
/// changes into `V`; their old values are not used. `motion` is the one from which the rows were made. Static bodies
/// have W_f = 0, and get V = 0. Returns false when the factorisation fails; rows and V are then as before.
bool stiff_solve(std::vector<Row<3>>& rows, const Motion<3>& motion, const std::vector<Stiffness>& stiffness,
                 double h, std::vector<Twist<3>>& V, Factors& factors);

}  // namespace spook
