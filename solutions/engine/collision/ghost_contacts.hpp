#pragma once
// Ghost contacts: flush boxes side by side make one surface, and its inner edges must not stop a sliding body.
#include <vector>

#include "engine/collision/contacts.hpp"

namespace spook {

/// Marks the contacts that are ghosts; returns an empty list if there are none. `placed` are the solids.
///
/// A body that rests on a face or a plane, with normal m, cannot be stopped by a box with a face along m, too, that is
/// not higher. So only contacts along m are real with such a box: within 0.02 rad if the box moves and touches the body
/// on a face, since boxes tilt where they sag. A face counts as not higher within a tolerance, the smallest size of
/// body and box being s: s/1000 plus twice the body's penetration in its support, since a loaded neighbour sinks, but
/// at most s/25. A body that is deeper in its support than a quarter of its own size has no ghosts, since a part of it
/// is below the face. Nor do tilted boxes make any: in a heap of boxes one that is lower may well carry another.
std::vector<bool> ghost_contacts(const Shapes& shapes, const std::vector<PlacedSolid>& placed,
                                 std::size_t bodies, const std::vector<Contact>& contacts);

}  // namespace spook
