// Does: includes the reference.
// Verdict: does not compile
#include "../../solutions/01_leapfrog/kick.cpp"
