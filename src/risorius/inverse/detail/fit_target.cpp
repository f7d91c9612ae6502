// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/fit_target.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/face/surfaces.h"
#include "risorius/inverse/detail/foreign_shapes.h"
#include "risorius/inverse/measured_shapes.h"
#include "risorius/io/gltf_shapes.h"
#include "risorius/io/read_mesh.h"
#include "risorius/scene/expression_score.h"

namespace risorius::inverse {

namespace fs = std::filesystem;

namespace {

// Weight of a vertex of eyes, teeth and tongue, relative to the mean of the skin
constexpr double kOtherParts = 0.2;
constexpr double kMoves_m = 1e-5;  // a part is ignored when all of its vertices move less

// The area of skin vertices, and a weight for the vertices of other parts that any of the shapes moves.
Eigen::VectorXd weights_of(const face::Face& face, const std::vector<Points>& fields) {
    const rig::Head& head = face.head();
    Eigen::VectorXd weight = scene::vertex_areas(face.surfaces().simulated_skin(), head.vertices);
    const double mean = weight.sum() / static_cast<double>((weight.array() > 0).count());
    std::array<bool, 8> moves{};
    const auto part = [&](long v) {
        return static_cast<std::size_t>(head.carrier[static_cast<std::size_t>(v)]);
    };
    for (const Points& field : fields)
        for (long v = 0; v < field.rows(); ++v)
            if (field.row(v).norm() > kMoves_m) moves[part(v)] = true;
    for (long v = 0; v < weight.size(); ++v)
        if (head.carrier[static_cast<std::size_t>(v)] != rig::Carrier::kSkin &&
            head.carrier[static_cast<std::size_t>(v)] != rig::Carrier::kNone && moves[part(v)])
            weight[v] += kOtherParts * mean;
    return weight;
}

}  // namespace

namespace {

/// Shapes of a glTF file that another program has written.
FitTarget foreign_shapes(const io::GltfShapes& shapes, const fs::path& file,
                         const std::vector<std::string>& only, const face::Face& face) {
    std::vector<std::string> names;
    for (const io::MorphTarget& target : shapes.targets) names.push_back(target.name);
    for (const std::string& name : only) index_of_name(option_name("only"), name, names);
    const ForeignShapes placed = place_foreign_shapes(shapes, face.head(), file.string());
    FitTarget out;
    out.notes.push_back(placed.how);
    const auto jaw = std::find(names.begin(), names.end(), "jawOpen");
    for (std::size_t s = 0; s < names.size(); ++s) {
        if (!only.empty() && std::find(only.begin(), only.end(), names[s]) == only.end()) continue;
        out.names.push_back(names[s]);
        Points& field = out.fields.emplace_back(placed.fields[s]);
        // It is made for the open jaw.
        if (names[s] == "mouthClose" && jaw != names.end())
            field += placed.fields[static_cast<std::size_t>(jaw - names.begin())];
    }
    out.weight = weights_of(face, out.fields);
    for (long v = 0; v < out.weight.size(); ++v)
        if (!placed.known[static_cast<std::size_t>(v)]) out.weight[v] = 0;
    return out;
}

}  // namespace

FitTarget given_shapes(const fs::path& file, const std::vector<std::string>& only,
                       const scene::RigFiles& files, const face::Face& face) {
    const rig::Head& head = face.head();
    FitTarget out;
    const std::string ending = file.extension().string();
    if (ending == ".glb" || ending == ".gltf" || ending == ".vrm")
        if (const io::GltfShapes shapes = io::read_gltf_shapes(file); !shapes.by_risorius)
            return foreign_shapes(shapes, file, only, face);
    if (ending == ".glb") {
        const blendshapes::ShapesOfFile shapes =
            blendshapes::read_shapes_of_file(file, files, head);
        std::vector<std::string> names;
        for (const blendshapes::ShapeGoal& goal : shapes.goals) names.push_back(goal.name);
        for (const std::string& name : only) index_of_name(option_name("only"), name, names);
        for (std::size_t s = 0; s < shapes.goals.size(); ++s) {
            const blendshapes::ShapeGoal& goal = shapes.goals[s];
            if (!only.empty() && std::find(only.begin(), only.end(), goal.name) == only.end())
                continue;
            out.names.push_back(goal.name);
            Points& field =
                out.fields.emplace_back(shapes.rig.shapes[s].dense(head.vertices.rows()));
            if (goal.on_top_of >= 0)
                shapes.rig.shapes[static_cast<std::size_t>(goal.on_top_of)].add_to(field, 1);
        }
    } else {
        for (MeasuredShape& one :
             read_measured_shapes(file, {.only = only, .separate_sides = true}, files.rig, head)) {
            out.names.push_back(one.name);
            out.fields.push_back(std::move(one.displacement));
        }
    }
    out.weight = weights_of(face, out.fields);
    return out;
}

FitTarget given_meshes(const std::vector<fs::path>& meshes, const scene::RigFiles& files,
                       const face::Face& face, const std::function<bool()>& stopped) {
    const rig::Head& head = face.head();
    FitTarget out;
    for (const fs::path& file : meshes) {
        const geom::PolygonMesh mesh =
            io::read_mesh(file, {.metres_per_unit = 1, .stopped = stopped});
        if (mesh.vertex_count() != files.mesh.vertex_count())
            throw Error(file.string(),
                        "the " + std::to_string(files.mesh.vertex_count()) +
                            " vertices of the rig's mesh, in its order",
                        std::to_string(mesh.vertex_count()));
        out.names.push_back(file.stem().string());
        out.fields.push_back((mesh.positions - files.mesh.positions) *
                             head.frame.rotation.transpose() * head.frame.metres_per_unit);
    }
    out.weight = weights_of(face, out.fields);
    return out;
}

}  // namespace risorius::inverse
