#pragma once
// Includes for programs: the world, its solvers, the check of runs, energies, contacts that begin and end, queries,
// handles, states as bytes.
#if __cplusplus <= 201703L
#error "spook needs C++20: compile with -std=c++20"
#endif
#include "spook/engine/bodies/conserved_quantities.hpp"
#include "spook/engine/collision/queries.hpp"
#include "spook/engine/diagnostics/contact_events.hpp"
#include "spook/engine/diagnostics/run_check.hpp"
#include "spook/engine/support/state_stream.hpp"
#include "spook/engine/world/handles.hpp"
#include "spook/engine/world/try_step.hpp"
#include "spook/engine/world/world.hpp"
#include "spook/version.hpp"
