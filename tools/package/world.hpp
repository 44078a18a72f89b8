#pragma once
// What a program includes: the world, its solvers, and whether a run is sound.
#include "spook/engine/soundness.hpp"
#include "spook/engine/world.hpp"
