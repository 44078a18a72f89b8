// Does: includes the tests.
// Verdict: does not compile
#include "../../tests/01_leapfrog/kick_drift_start_test.cpp"
