#pragma once
// Detects a program whose compiler flags do not match the library's. Eigen aligns its numbers as the target processor
// allows (-march, -mavx). So with other flags, or another version of Eigen, a body has another layout. Every file that
// includes this header refers to a symbol named after its flags. The library defines only that of its own flags:
//
//   undefined reference to `spook::LibraryCompiledWith<EigenVersion<3, 4>, AlignedTo<32>, DebugContainers<false>>::found'
//
// means that the program uses Eigen 3.4 with an alignment of 32 bytes, unlike the library.
#include <Eigen/Core>

namespace spook {

namespace compiled {

template <int world, int major>
struct EigenVersion;
template <int bytes>
struct AlignedTo;
template <bool debug>
struct DebugContainers;  // containers of the standard library, -D_GLIBCXX_DEBUG

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
