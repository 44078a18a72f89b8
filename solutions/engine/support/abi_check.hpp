#pragma once
// Whether a program is compiled as the library was. Eigen aligns its numbers by what the compiler may ask of the
// processor (-march, -mavx), so with other flags a body has another layout, and a version of Eigen may have its own.
// Whoever includes this needs a symbol that names how it is compiled, and the library has only its own:
//
//   undefined reference to `spook::LibraryCompiledWith<EigenVersion<3, 4>, AlignedTo<32>, DebugContainers<false>>::found'
//
// says that the program wants Eigen 3.4 with 32 bytes, and the library is compiled otherwise.
#include <Eigen/Core>

namespace spook {

namespace compiled {

template <int world, int major>
struct EigenVersion;
template <int bytes>
struct AlignedTo;
template <bool debug>
struct DebugContainers;  // of the standard library, -D_GLIBCXX_DEBUG

#ifdef _GLIBCXX_DEBUG
using Containers = DebugContainers<true>;
#else
using Containers = DebugContainers<false>;
#endif

}  // namespace compiled

template <class Version, class Alignment, class Containers>
struct LibraryCompiledWith {
  static const char found;
};

using Layout = LibraryCompiledWith<compiled::EigenVersion<EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION>,
                                   compiled::AlignedTo<EIGEN_MAX_ALIGN_BYTES>, compiled::Containers>;
template <>
const char Layout::found;

namespace {
[[gnu::used]] const char* const layout = &Layout::found;
}

}  // namespace spook
