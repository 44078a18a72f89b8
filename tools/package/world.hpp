#pragma once
// What a program includes: the world, its solvers, and whether a run is sound.
#include "spook/engine/diagnostics/run_check.hpp"
#include "spook/engine/world/world.hpp"
