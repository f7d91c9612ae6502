// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/fit_target.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "risorius/blendshapes/shape_player.h"
#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/core/rotations.h"
#include "risorius/face/surfaces.h"
#include "risorius/inverse/detail/foreign_shapes.h"
#include "risorius/inverse/measured_shapes.h"
#include "risorius/io/gltf_shapes.h"
#include "risorius/io/read_mesh.h"
#include "risorius/scene/expression_score.h"
#include "risorius/signal/recording.h"

namespace risorius::inverse {

namespace fs = std::filesystem;

namespace {

// Weight of a vertex of eyes, teeth and tongue, relative to the mean of the skin
constexpr double kOtherParts = 0.2;
constexpr double kMoves_m = 1e-5;  // a part is ignored when all of its vertices move less
// Landmarks that no muscle moves farther determine the motion of the head
constexpr double kOnTheSkull_m = 1e-3;

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

FitTarget given_landmarks(const fs::path& file, int fps, const scene::LandmarkPoints& points,
                          const std::vector<double>& max_m, long vertices) {
    const auto table = signal::Recording::read_file(file);
    const std::string place = file.string();
    const int time = table.find("time_s");
    if (time < 0) throw Error(place, "a column time_s", "none");
    const std::vector<double> times = table.samples(time);
    const std::vector<std::string> ids = points.ids();
    FitTarget out;
    std::vector<std::size_t> known;
    std::vector<Points> rows(times.size());
    std::vector<std::array<std::vector<double>, 3>> numbers;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        std::array<int, 3> columns{};
        int found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            columns[k] = table.find(ids[i] + "." + "xyz"[k] + "_mm");
            found += columns[k] >= 0;
        }
        if (found == 0) continue;
        if (found < 3)
            throw Error(place, "the columns " + ids[i] + ".x_mm, .y_mm and .z_mm",
                        "only some of them");
        known.push_back(i);
        auto& of = numbers.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) {
            signal::Recording::Bridged bridged = table.bridged_samples(columns[k], times);
            of[k] = std::move(bridged.samples);
            out.notes.insert(out.notes.end(), bridged.notes.begin(), bridged.notes.end());
        }
    }
    if (known.size() < 4 || times.empty())
        throw Error(place, "rows of at least four landmarks, as prn.x_mm, prn.y_mm, prn.z_mm",
                    times.empty() ? "no rows" : std::to_string(known.size()) + " of them");
    for (std::size_t t = 0; t < times.size(); ++t) {
        if (t > 0 && times[t] <= times[t - 1])
            throw Error(place, "times that rise from row to row",
                        format_number(times[t]) + " s after " + format_number(times[t - 1]));
        rows[t].resize(static_cast<long>(known.size()), 3);
        for (std::size_t i = 0; i < known.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                rows[t](static_cast<long>(i), static_cast<long>(k)) = 1e-3 * numbers[i][k][t];
    }
    std::vector<long> on_skull;
    for (std::size_t i = 0; i < known.size(); ++i)
        if (max_m[known[i]] < kOnTheSkull_m) on_skull.push_back(static_cast<long>(i));
    out.weight = Eigen::VectorXd::Zero(vertices);
    for (const std::size_t i : known) out.weight[points.vertex(ids[i])] = 1;
    double next_s = times[0];
    for (std::size_t t = 0; t < times.size(); ++t) {
        if (times[t] < next_s - 1e-9) continue;
        next_s = std::max(next_s + 1.0 / fps, times[t]);
        Points moved = rows[t];
        if (on_skull.size() >= 3) {
            const Rigid back =
                nearest_motion(rows[t](on_skull, Eigen::all), rows[0](on_skull, Eigen::all));
            for (long i = 0; i < moved.rows(); ++i)
                moved.row(i) = (back * Vec3(moved.row(i).transpose())).transpose();
        }
        Points& field = out.fields.emplace_back(Points::Zero(vertices, 3));
        for (std::size_t i = 0; i < known.size(); ++i)
            field.row(points.vertex(ids[known[i]])) =
                moved.row(static_cast<long>(i)) - rows[0].row(static_cast<long>(i));
        out.times_s.push_back(times[t] - times[0]);
        out.names.push_back("frame " + std::to_string(t));
    }
    return out;
}

}  // namespace risorius::inverse
