#pragma once
// Links of point masses that get their geometric stiffness: chapter 12.
#include "12_stiff_wires/stiff_wires.hpp"
#include "engine/joints.hpp"

namespace spook {

/// The stiffness of each joint that was tight in the last step, from the impulses of the joints' rows in it [N s]:
/// Eq. (12.3), (12.4). None for a joint that is newer.
std::vector<Stiffness> link_stiffness(const std::vector<Joint>& joints, const std::vector<double>& impulses,
                                      const Bodies<3>& bodies, double h);

/// Which rows no contact has to do with: those of islands with rows of joints only, `first` in number.
std::vector<bool> free_of_contacts(const std::vector<Row<3>>& rows, std::size_t first, std::size_t bodies);

}  // namespace spook
