// Does: includes a file of the machine.
// Verdict: does not compile
#include "/etc/passwd"
