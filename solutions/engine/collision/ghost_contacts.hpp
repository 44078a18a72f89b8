#pragma once
// Contacts with inner edges: flush boxes side by side make one surface, and what slides over it must not trip.
#include <vector>

#include "engine/collision/contacts.hpp"

namespace spook {

/// Returns which contacts are ghosts; nothing if none is. A body that already rests on a face or a plane, with normal
/// m, cannot be stopped by a box that is not higher along m: of such a box only contacts along m are real. Not higher
/// means by at most 1/1000 of the smaller size of body and box, and twice the depth of the body in what it rests on,
/// since a loaded neighbour sinks; altogether at most 1/25 of that size. `placed` are the solids, grown by `grown` [m].
std::vector<bool> ghost_contacts(const Shapes& shapes, const std::vector<PlacedSolid>& placed, double grown,
                                 std::size_t bodies, const std::vector<Contact>& contacts);

}  // namespace spook
