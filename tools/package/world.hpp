#pragma once
// Includes for programs: the world, its solvers, the check of runs, contacts that begin and end, queries, handles.
#include "spook/engine/collision/queries.hpp"
#include "spook/engine/diagnostics/contact_events.hpp"
#include "spook/engine/diagnostics/run_check.hpp"
#include "spook/engine/world/handles.hpp"
#include "spook/engine/world/try_step.hpp"
#include "spook/engine/world/world.hpp"
#include "spook/version.hpp"
