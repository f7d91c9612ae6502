// SPDX-License-Identifier: MIT
/// \file
/// risorius.Face: a face that moves, for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace risorius::python {

void add_face(pybind11::module_& module);

}  // namespace risorius::python
