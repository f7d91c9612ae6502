// SPDX-License-Identifier: MIT
/// \file
/// The Python function risorius.study() and the class of its results.
#pragma once

#include <pybind11/pybind11.h>

namespace risorius::python {

void add_study(pybind11::module_& module);

}  // namespace risorius::python
