#pragma once
// The parts of the extension module _spook.
#include <pybind11/pybind11.h>

namespace spook {

namespace py = pybind11;

void bind_worlds(py::module_& module);
void bind_scenes(py::module_& module);

}  // namespace spook
