// SPDX-License-Identifier: MIT
/// \file
/// risorius.SoftBody: a volume-preserving solid, a surface or a curve, for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace risorius::python {

void add_soft_body(pybind11::module_& module);

}  // namespace risorius::python
