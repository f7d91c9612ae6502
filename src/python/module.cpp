// SPDX-License-Identifier: MIT
// The Python module risorius._core. The package risorius (__init__.py) adds nothing but names and the place of the data.
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/python_face.h"
#include "python/python_monitor.h"
#include "python/python_soft_body.h"
#include "python/python_study.h"
#include "python/python_values.h"
#include "risorius/animate/animate.h"
#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/core/version.h"

namespace py = pybind11;

namespace risorius::python {

namespace {

py::dict render(const py::object& script, const std::filesystem::path& out,
                const std::optional<std::filesystem::path>& rig,
                const std::optional<std::pair<int, int>>& size, std::optional<int> fps,
                const std::optional<std::string>& quality, std::optional<double> still_s,
                bool draft, int threads, const py::object& progress) {
    animate::RenderRequest request;
    if (py::isinstance<py::dict>(script)) {
        request.script = "script.json";
        request.script_in_memory = JsonCursor::from_json(json_of(script), "script");
    } else {
        request.script = script.cast<std::filesystem::path>();
    }
    request.out = out;
    request.rig = rig;
    if (size) request.size = {size->first, size->second};
    request.fps = fps;
    request.quality = quality;
    request.still_s = still_s;
    request.draft = draft;
    request.threads = threads;
    const ProgressMonitor monitor = monitor_for(progress);
    std::optional<animate::RunRecord> record;
    {
        const py::gil_scoped_release free;
        record = animate::animate(request, monitor);
    }
    return object_of(record->json()).cast<py::dict>();
}

void add_errors(py::module_& module) {
    const auto describe = [](py::object error, const char* text) {
        error.attr("__module__") = "risorius";
        error.attr("__doc__") = text;
    };
    describe(py::register_exception<Error>(module, "Error", PyExc_ValueError),
             "Wrong input. The message names the place, what was expected, and what was found.");
    describe(py::register_exception<RunError>(module, "RunError", PyExc_RuntimeError),
             "A run failed although the input was correct, for instance because of a full disk.");
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Interrupted&) {
            if (!PyErr_Occurred()) PyErr_SetNone(PyExc_KeyboardInterrupt);
        }
    });
}

}  // namespace

}  // namespace risorius::python

PYBIND11_MODULE(_core, module) {
    using namespace risorius;
    using namespace risorius::python;
    module.doc() = "Facial animation by muscles.";
    add_errors(module);
    add_face(module);
    add_soft_body(module);
    add_study(module);
    module.attr("__version__") = std::string(kVersion);
    module.def("set_data_folder", &set_data_folder, py::arg("folder"),
               "Sets the folder that holds rigs, models and samples.");
    module.def("data_folder", &data_folder, "The folder that holds rigs, models and samples.");
    module.def("render", &render, py::arg("script"), py::arg("out"), py::kw_only(),
               py::arg("rig") = py::none(), py::arg("size") = py::none(),
               py::arg("fps") = py::none(), py::arg("quality") = py::none(),
               py::arg("still_s") = py::none(), py::arg("draft") = false, py::arg("threads") = 2,
               py::arg("progress") = py::none(),
               "Renders a script to a video, a folder of frames (\"frames/\") or a still (.png), "
               "and returns the record of the "
               "run.\n\n"
               "script: the path of a script, or the script as a dict; its rig is then a path from "
               "the working folder\n"
               "size: (width, height) in pixels; still_s: time of a still, s\n"
               "progress: called with the fraction done, 0 to 1, and what is done. Ctrl-C stops "
               "and leaves nothing.");
}
