// SPDX-License-Identifier: MIT
#include "python/python_fields.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/face/calibration.h"
#include "risorius/face/fields.h"
#include "risorius/face/statics.h"
#include "risorius/rig/rig_description.h"
#include "risorius/study/rig_numbers.h"

namespace py = pybind11;

namespace risorius::python {

namespace {

constexpr double kStep = 1e-3;  // of ln p

void add_states(const std::vector<face::FibreState>& states, py::dict& out) {
    const auto count = static_cast<Eigen::Index>(states.size());
    Points direction(count, 3);
    Eigen::VectorXi column(count);
    Eigen::VectorXd activation(count), stretch(count), tension_n(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const face::FibreState& state = states[static_cast<std::size_t>(i)];
        column[i] = state.column;
        direction.row(i) = state.direction.transpose();
        activation[i] = state.activation;
        stretch[i] = state.stretch;
        tension_n[i] = state.tension_n;
    }
    out["column"] = column;
    out["direction"] = direction;
    out["activation"] = activation;
    out["stretch"] = stretch;
    out["tension_n"] = tension_n;
}

Eigen::VectorXd von_mises_of(const face::Tensors& stress_pa) {
    Eigen::VectorXd out(stress_pa.rows());
    for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = face::von_mises(stress_pa.row(i));
    return out;
}

void add_body(const auto& body, py::dict& out) {
    out["rest"] = body.rest;
    out["nodes"] = body.nodes;
    out["J"] = body.volume_ratio;
    out["stress_pa"] = body.stress_pa;
    out["von_mises_pa"] = von_mises_of(body.stress_pa);
}

/// Whether the numbers of a path leave the nodes of tissue and muscles where they are.
bool keeps_nodes(const std::string& path) {
    const bool of_solids = path.starts_with("anatomy/solids/") &&
                           (path.ends_with("/strength") || path.ends_with("_pa"));
    return of_solids || path.starts_with("tissue/") || path.starts_with("skin/") ||
           path.starts_with("anatomy/strength/");
}

/// The rig with all numbers of a path times `factor`.
rig::RigDescription scaled(const Json& rig, const std::vector<std::string>& numbers, double factor,
                           const std::string& place) {
    Json changed = rig;
    for (const std::string& pointer : numbers) {
        Json& number = changed[Json::json_pointer(pointer)];
        number = factor * number.get<double>();
    }
    return rig::read_rig(JsonCursor::from_json(std::move(changed), place));
}

}  // namespace

py::dict fields_dict(face::Face& face) {
    const face::FaceFields fields = face.fields().now();
    py::dict tissue, fibres, solids, out;
    add_body(fields.tissue, tissue);
    tissue["cells"] = fields.tissue.tets;
    tissue["contact_pa"] = fields.tissue.contact_pa;
    fibres["rest"] = fields.fibres.rest;
    fibres["nodes"] = fields.fibres.nodes;
    fibres["cells"] = py::array_t<int>(
        {fields.fibres.segments.size(), std::size_t{2}},
        fields.fibres.segments.empty() ? nullptr : fields.fibres.segments.front().data());
    add_states(fields.fibres.state, fibres);
    add_body(fields.solids, solids);
    solids["cells"] = fields.solids.cells;
    add_states(fields.solids.state, solids);
    out["tissue"] = tissue;
    out["fibres"] = fibres;
    out["solids"] = solids;
    return out;
}

Eigen::VectorXd rig_gradient(face::Face& face, const std::filesystem::path& rig,
                             const track::Drive& drive, const Points& vertex_gradient,
                             const std::vector<std::string>& paths) {
    const Json json = rig::resolved_rig(rig);
    const face::Statics statics = face.statics();
    const Points nodes = statics.nodes();
    Eigen::VectorXd out(static_cast<Eigen::Index>(paths.size()));
    for (std::size_t p = 0; p < paths.size(); ++p) {
        const std::string& path = paths[p];
        if (!keeps_nodes(path))
            throw Error(
                "rig_gradient",
                "numbers of \"tissue/\", \"skin/\" or \"anatomy/strength/\", or strength and "
                "moduli of \"anatomy/solids/\"",
                "\"" + path + "\"");
        const std::vector<std::string> numbers = study::rig_numbers(json, path, "rig_gradient");
        const auto variant_at = [&](double side) {
            return face::Variant(face, scaled(json, numbers, std::exp(side * kStep), rig.string()));
        };
        face::Variant less = variant_at(-1), more = variant_at(1);
        const Points moved = statics.solve(less.gradient(nodes, drive.excitation, drive) -
                                           more.gradient(nodes, drive.excitation, drive)) /
                             2;  // in a step of kStep
        const Points change = more.vertices(nodes + moved, drive.excitation, drive) -
                              less.vertices(nodes - moved, drive.excitation, drive);
        out[static_cast<Eigen::Index>(p)] =
            vertex_gradient.cwiseProduct(change).sum() / (2 * kStep);
    }
    return out;
}

}  // namespace risorius::python
