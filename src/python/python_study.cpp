// SPDX-License-Identifier: MIT
#include "python/python_study.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "python/python_monitor.h"
#include "python/python_values.h"
#include "risorius/core/data_folder.h"
#include "risorius/study/run_study.h"
#include "risorius/study/sampled_rigs.h"
#include "risorius/study/study_description.h"
#include "risorius/study/study_results.h"

namespace py = pybind11;

namespace risorius::python {

namespace {

struct PythonStudy {
    explicit PythonStudy(const JsonCursor& json)
        : description(study::read_study(json)), rigs(description) {}

    const study::StudyDescription description;
    const study::SampledRigs rigs;
    study::StudyResults results;

    py::ssize_t faces() const { return static_cast<py::ssize_t>(rigs.runs().size()); }
    py::ssize_t poses() const { return static_cast<py::ssize_t>(description.poses.size()); }
    py::ssize_t landmarks() const { return static_cast<py::ssize_t>(description.landmarks.size()); }
    py::ssize_t parameters() const {
        return static_cast<py::ssize_t>(description.parameters.size());
    }
};

struct StudyArguments {
    std::optional<std::filesystem::path> rig;
    py::object poses, vary, landmarks;
    int samples;
    std::string method;
    long long seed;
    bool indices;
    int replicates;
    std::string quality;
};

/// The arguments as the file of a study has them.
JsonCursor study_json(const StudyArguments& a) {
    Json json = {{"format", "risorius-study"}, {"version", 1}, {"name", "study"}};
    json["rig"] = (a.rig ? *a.rig : data_folder() / "rigs/adult/rig.json").generic_string();
    json["quality"] = a.quality;
    json["poses"] = json_of(a.poses);
    if (!a.landmarks.is_none()) json["landmarks"] = json_of(a.landmarks);
    json["vary"] = json_of(a.vary);
    json["sample"] = {{"method", a.method},
                      {"count", a.samples},
                      {"seed", a.seed},
                      {"indices", a.indices},
                      {"replicates", a.replicates}};
    return JsonCursor::from_json(std::move(json), "study");
}

std::unique_ptr<PythonStudy> run(const StudyArguments& arguments, int threads,
                                 const py::object& progress) {
    auto out = std::make_unique<PythonStudy>(study_json(arguments));
    const ProgressMonitor monitor = monitor_for(progress);
    const py::gil_scoped_release free;
    out->results = study::simulate_study(out->description, out->rigs, threads, monitor);
    return out;
}

std::vector<std::string> names_of_matrices(const PythonStudy& self) {
    std::vector<std::string> out;
    for (const study::Run& run : self.rigs.runs()) out.push_back(self.rigs.matrix_name(run));
    return out;
}

py::array rows_of_faces(const PythonStudy& self) {
    py::array_t<int> out(self.faces());
    for (py::ssize_t r = 0; r < self.faces(); ++r) {
        const study::Run& run = self.rigs.runs()[static_cast<std::size_t>(r)];
        out.mutable_at(r) = run.matrix == study::Matrix::kNominal ? -1 : run.row;
    }
    return std::move(out);
}

py::array samples_of(const PythonStudy& self) {
    py::array_t<double> out({self.faces(), self.parameters()});
    for (py::ssize_t r = 0; r < self.faces(); ++r)
        for (py::ssize_t p = 0; p < self.parameters(); ++p)
            out.mutable_at(r, p) = self.rigs
                                       .values(self.rigs.runs()[static_cast<std::size_t>(r)],
                                               static_cast<std::size_t>(p))
                                       .mean();
    return std::move(out);
}

// The matrix of the results is faces x (poses x landmarks x 3), with its columns one after the other.
py::array displacements(const py::object& owner) {
    const auto& self = owner.cast<const PythonStudy&>();
    const py::ssize_t number = sizeof(double), column = number * self.faces();
    py::array_t<double> out({self.faces(), self.poses(), self.landmarks(), py::ssize_t{3}},
                            {number, column * 3 * self.landmarks(), column * 3, column},
                            self.results.moved_mm.data(), owner);
    out.attr("flags").attr("writeable") = false;
    return std::move(out);
}

py::array in_equilibrium(const py::object& owner) {
    const auto& self = owner.cast<const PythonStudy&>();
    py::array_t<bool> out({self.faces(), self.poses()}, {py::ssize_t{1}, self.faces()},
                          self.results.in_equilibrium.data(), owner);
    out.attr("flags").attr("writeable") = false;
    return std::move(out);
}

py::dict spread_of(const PythonStudy& self) {
    py::dict out;
    for (const auto& [name, number] : {std::pair{"rig_mm", &study::Spread::rig},
                                       {"mean_mm", &study::Spread::mean},
                                       {"sd_mm", &study::Spread::deviation},
                                       {"p5_mm", &study::Spread::low},
                                       {"p95_mm", &study::Spread::high},
                                       {"away_p95_mm", &study::Spread::away}}) {
        py::array_t<double> values({self.poses(), self.landmarks()});
        double* next = values.mutable_data();
        for (const study::Output& output : self.results.landmarks) *next++ = output.spread.*number;
        out[name] = std::move(values);
    }
    return out;
}

using Index = sensitivity::Estimate sensitivity::SobolIndices::*;

/// Estimate and interval of one kind of index, outputs x parameters x 3, reshaped.
py::array indices_of(const PythonStudy& self, const std::vector<study::Output>& outputs,
                     Index index, std::vector<py::ssize_t> shape) {
    shape.push_back(self.description.indices ? self.parameters() : 0);
    shape.push_back(3);
    py::array_t<double> out(shape);
    double* next = out.mutable_data();
    for (const study::Output& output : outputs)
        for (const sensitivity::SobolIndices& one : output.indices)
            for (const double value : {(one.*index).value, (one.*index).low, (one.*index).high})
                *next++ = value;
    return std::move(out);
}

void add_results(py::module_& module) {
    py::class_<PythonStudy> results(
        module, "Study",
        "What a study has found. The first axis of samples, displacements_mm and in_equilibrium "
        "has the faces; face 0 is the unchanged rig.");
    const auto landmarks = [](Index index) {
        return [index](const PythonStudy& self) {
            return indices_of(self, self.results.landmarks, index,
                              {self.poses(), self.landmarks()});
        };
    };
    const auto poses = [](Index index) {
        return [index](const PythonStudy& self) {
            return indices_of(self, self.results.poses, index, {self.poses()});
        };
    };
    const Index first = &sensitivity::SobolIndices::first;
    const Index total = &sensitivity::SobolIndices::total;
    results
        .def_property_readonly(
            "parameters",
            [](const PythonStudy& self) {
                std::vector<std::string> names;
                for (const auto& one : self.description.parameters) names.push_back(one.name);
                return names;
            },
            "Names of the parameters.")
        .def_property_readonly(
            "poses",
            [](const PythonStudy& self) {
                std::vector<std::string> names;
                for (const auto& one : self.description.poses) names.push_back(one.name);
                return names;
            },
            "Names of the poses.")
        .def_property_readonly(
            "landmarks", [](const PythonStudy& self) { return self.description.landmarks; },
            "Names of the landmarks.")
        .def_property_readonly(
            "matrix", &names_of_matrices,
            "For each face: \"rig\" (unchanged), \"A\" or \"B\" (the two independent samples), or "
            "the name of a parameter (A with this parameter from B).")
        .def_property_readonly("row", &rows_of_faces,
                               "For each face: its row of A and B, from 0; -1 for the unchanged "
                               "rig.")
        .def_property_readonly("samples", &samples_of,
                               "Values of the parameters, faces x parameters. Of a parameter with "
                               "\"each\", the mean; NaN where the unchanged rig has no one value.")
        .def_property_readonly(
            "displacements_mm", &displacements,
            "Displacements from the head at rest, faces x poses x landmarks x 3, "
            "mm: to the subject's left, up, forwards. No copy.")
        .def_property_readonly("in_equilibrium", &in_equilibrium,
                               "Whether the face came to rest, faces x poses. No copy.")
        .def_property_readonly(
            "spread", &spread_of,
            "A dict of arrays, poses x landmarks, mm: length of the displacement on the unchanged "
            "rig (rig_mm); mean_mm, p5_mm and p95_mm of the lengths; sd_mm in space; away_p95_mm, "
            "the distance from the unchanged rig within which 95 % of the faces lie.")
        .def_property_readonly("first", landmarks(first),
                               "First-order Sobol indices, poses x landmarks x parameters x 3: "
                               "estimate, and its 95 % interval. No parameters without indices.")
        .def_property_readonly("total", landmarks(total),
                               "Total Sobol indices, poses x landmarks x parameters x 3.")
        .def_property_readonly("first_of_pose", poses(first),
                               "First-order indices of all landmarks together, poses x parameters "
                               "x 3.")
        .def_property_readonly("total_of_pose", poses(total),
                               "Total indices of all landmarks together, poses x parameters x 3.");
}

}  // namespace

void add_study(py::module_& module) {
    add_results(module);
    module.def(
        "study",
        [](const std::optional<std::filesystem::path>& rig, const py::object& poses,
           const py::object& vary, const py::object& landmarks, int samples,
           const std::string& method, long long seed, bool indices, int replicates,
           const std::string& quality, int threads, const py::object& progress) {
            return run(
                {rig, poses, vary, landmarks, samples, method, seed, indices, replicates, quality},
                threads, progress);
        },
        py::arg("rig") = py::none(), py::kw_only(), py::arg("poses"), py::arg("vary"),
        py::arg("landmarks") = py::none(), py::arg("samples") = 64, py::arg("method") = "sobol",
        py::arg("seed") = 1, py::arg("indices") = true, py::arg("replicates") = 400,
        py::arg("quality") = "preview", py::arg("threads") = 2, py::arg("progress") = py::none(),
        "Varies numbers of a rig, and returns how far the landmarks of its face depend on them. "
        "The arguments are the keys of a study file, and the values are those of `risorius "
        "study`.\n\n"
        "rig: the path of a rig; default: the adult that comes with Risorius\n"
        "poses: names (\"AU12\"), or dicts {\"name\", \"activation\": {muscle: value}}\n"
        "vary: a dict {name: {\"of\": path, \"factor\": {\"log_uniform\": [0.5, 2]}}}; \"add\" or "
        "\"set\" in place of \"factor\"; \"uniform\", \"normal\", \"log_normal\"\n"
        "landmarks: names; default: brows, eyes, nose, cheeks, mouth, chin\n"
        "samples: rows of the sample. With indices, samples x (parameters + 2) faces are made\n"
        "method: \"sobol\", \"latin_hypercube\" or \"random\"; seed: of sample and bootstrap\n"
        "threads: 0: as many as the machine has; results do not depend on it\n"
        "progress: called with the fraction done, 0 to 1, and what is done. Ctrl-C stops.");
}

}  // namespace risorius::python
