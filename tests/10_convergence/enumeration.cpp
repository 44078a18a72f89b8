// The enumeration of chapter 04, for these tests as well.
#include "../04_gauss_seidel/problems.cpp"
