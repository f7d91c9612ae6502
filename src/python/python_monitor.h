// SPDX-License-Identifier: MIT
/// \file
/// Progress and Ctrl-C of a long call from Python.
#pragma once

#include <pybind11/pybind11.h>

#include "risorius/core/progress_monitor.h"

namespace risorius::python {

/// Calls `progress`, a Python function or None, and stops on Ctrl-C. Python sees Ctrl-C only on its main thread, which makes the call; the other
/// threads of the run stop after it. `progress` has to outlive the monitor.
ProgressMonitor monitor_for(const pybind11::object& progress);

}  // namespace risorius::python
