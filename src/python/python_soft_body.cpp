// SPDX-License-Identifier: MIT
#include "python/python_soft_body.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "python/python_values.h"
#include "risorius/core/error.h"
#include "risorius/core/output_set.h"
#include "risorius/softbody/body_description.h"
#include "risorius/softbody/feb_text.h"
#include "risorius/softbody/mesh_body.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace py = pybind11;

namespace risorius::python {

namespace {

const std::map<std::string, solve::Method>& methods() {
    static const std::map<std::string, solve::Method> kMethods{
        {"euler", solve::Method::kEuler},
        {"verlet", solve::Method::kVerlet},
        {"runge_kutta_4", solve::Method::kRungeKutta4},
        {"implicit_euler", solve::Method::kImplicitEuler},
        {"quasi_static", solve::Method::kQuasiStatic}};
    return kMethods;
}

softbody::SoftBody built(const JsonCursor& json) {
    return softbody::is_mesh_body(json) ? softbody::build_mesh_body(softbody::read_mesh_body(json))
                                        : softbody::build_body(softbody::read_body(json));
}

class PythonSoftBody {
  public:
    PythonSoftBody(const py::dict& description, const std::string& method, double step_s)
        : body_(built(JsonCursor::from_json(json_of(description), "body"))), state_(body_.start()) {
        const auto found = methods().find(method);
        if (found == methods().end()) {
            std::string expected = "one of";
            for (const auto& [name, value] : methods()) expected += " \"" + name + "\"";
            throw Error("method", expected, "\"" + method + "\"");
        }
        if (!(step_s > 0)) throw Error("step_s", "more than 0 s", format_number(step_s));
        integrator_ = solve::make_integrator(
            {.method = found->second, .step_s = step_s, .length_scale_m = body_.length_scale_m});
    }

    void advance(double t_s) {
        if (!(t_s >= state_.t_s))
            throw Error("t_s", "a time from " + format_number(state_.t_s) + " s on",
                        format_number(t_s));
        integrator_->advance(body_.system, state_, t_s);
    }

    void set_activation(const std::vector<double>& activation) {
        if (activation.size() != body_.muscles.size())
            throw Error("activation", std::to_string(body_.muscles.size()) + " numbers",
                        std::to_string(activation.size()));
        for (std::size_t m = 0; m < activation.size(); ++m) {
            if (!(activation[m] >= 0 && activation[m] <= 1))
                throw Error("activation", "numbers in [0, 1]", format_number(activation[m]));
            body_.muscles[m]->set_activation([a = activation[m]](double) { return a; });
        }
    }

    const softbody::SoftBody& body() const { return body_; }
    const solve::MotionState& state() const { return state_; }

  private:
    softbody::SoftBody body_;
    solve::MotionState state_;
    std::unique_ptr<solve::Integrator> integrator_;
};

}  // namespace

void add_soft_body(py::module_& module) {
    py::class_<PythonSoftBody>(
        module, "SoftBody",
        "A soft solid, surface or curve of the thesis, or a mesh of tetrahedra.\n\n"
        "body: a dict as \"body\" of an experiment file, or of the kind \"mesh\"\n"
        "method: euler, verlet, runge_kutta_4, implicit_euler or quasi_static")
        .def(py::init<const py::dict&, const std::string&, double>(), py::arg("body"),
             py::arg("method") = "implicit_euler", py::arg("step_s") = 1.0 / 60)
        .def("advance", &PythonSoftBody::advance, py::arg("t_s"),
             py::call_guard<py::gil_scoped_release>(), "Advances to the time t_s, s.")
        .def("set_activation", &PythonSoftBody::set_activation, py::arg("activation"),
             "Sets the activation of each muscle of a mesh, 0..1; the next advance() uses it.")
        .def_property_readonly(
            "fibre_stretch",
            [](const PythonSoftBody& self) {
                std::vector<double> out;
                for (const auto& muscle : self.body().muscles)
                    out.push_back(muscle->mean_stretch(self.state().x));
                return out;
            },
            "Mean length of the fibres of each muscle of a mesh over their optimal length.")
        .def_property_readonly(
            "holding_n",
            [](const PythonSoftBody& self) {
                Points out(static_cast<Eigen::Index>(self.body().supports.size()), 3);
                for (Eigen::Index k = 0; k < out.rows(); ++k)
                    out.row(k) = self.body()
                                     .holding_n(self.body().supports[static_cast<std::size_t>(k)],
                                                self.state().x)
                                     .transpose();
                return out;
            },
            "Force with which each entry of \"fixed\" holds a mesh at rest, K x 3, N.")
        .def_property_readonly(
            "time_s", [](const PythonSoftBody& self) { return self.state().t_s; }, "Time, s.")
        .def_property_readonly(
            "nodes",
            [](const py::object& self) {
                const Points& x = self.cast<const PythonSoftBody&>().state().x;
                return Points(x);
            },
            "Positions of the nodes, N x 3, m, a copy.")
        .def_property_readonly(
            "rest", [](const PythonSoftBody& self) { return self.body().rest; },
            "Positions at rest, N x 3, m, a copy.")
        .def_property_readonly(
            "surface", [](const PythonSoftBody& self) { return self.body().surface; },
            "Triangles of the boundary, F x 3 node indices, a copy.")
        .def_property_readonly(
            "tets",
            [](const PythonSoftBody& self) {
                return self.body().tets ? self.body().tets->body().tets : Tets(0, 4);
            },
            "Tetrahedra of a mesh, T x 4 node indices, a copy; none for grids.")
        .def_property_readonly(
            "grid",
            [](const PythonSoftBody& self) {
                return std::array<int, 3>{self.body().grid.m, self.body().grid.n,
                                          self.body().grid.o};
            },
            "Number of nodes along each material axis; 0 for a mesh.")
        .def_property_readonly(
            "volume_m3",
            [](const PythonSoftBody& self) { return self.body().volume(self.state().x); },
            "Volume of a solid, m^3.")
        .def_property_readonly(
            "energy_j",
            [](const PythonSoftBody& self) {
                return self.body().system.energy(self.state().t_s, self.state().x);
            },
            "Potential energy, J.");
    module.def(
        "write_feb",
        [](const py::dict& body, const std::filesystem::path& file) {
            const JsonCursor json = JsonCursor::from_json(json_of(body), "body");
            if (!softbody::is_mesh_body(json))
                throw Error("body", "a body of the kind \"mesh\"", "one on a grid");
            write_file(file, softbody::feb_text(softbody::read_mesh_body(json)));
        },
        py::arg("body"), py::arg("file"),
        "Writes a body of the kind \"mesh\" as a model of FEBio 4 (.feb): its mesh, materials, "
        "supports and\n"
        "weight.");
}

}  // namespace risorius::python
