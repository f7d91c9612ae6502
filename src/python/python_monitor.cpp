// SPDX-License-Identifier: MIT
#include "python/python_monitor.h"

#include <pybind11/functional.h>

#include <atomic>
#include <memory>

namespace py = pybind11;

namespace risorius::python {

ProgressMonitor monitor_for(const py::object& progress) {
    ProgressMonitor monitor;
    if (!progress.is_none())
        monitor.progress = [&progress](double fraction, const std::string& what) {
            const py::gil_scoped_acquire lock;
            progress(fraction, what);
        };
    monitor.stopped = [is_stopped = std::make_shared<std::atomic<bool>>(false)] {
        if (*is_stopped) return true;
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) *is_stopped = true;
        return is_stopped->load();
    };
    return monitor;
}

}  // namespace risorius::python
