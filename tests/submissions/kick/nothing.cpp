// Does: nothing at all; the linker would fill in the reference.
// Verdict: does not compile: function not defined
#include "01_leapfrog/leapfrog.hpp"
