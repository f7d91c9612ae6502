// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "risorius/blendshapes/detail/corrective_drivers.h"
#include "risorius/blendshapes/detail/morph_hair.h"
#include "risorius/blendshapes/detail/morph_head.h"
#include "risorius/blendshapes/detail/mouth_shade.h"
#include "risorius/blendshapes/detail/point_cache.h"
#include "risorius/blendshapes/detail/shape_correctives.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/face/surfaces.h"
#include "risorius/io/read_mesh.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/folder_name.h"
#include "risorius/rig/expression_drive.h"

namespace risorius::blendshapes {

namespace {

// Displacement of a vertex of a shape, mesh units.
Vec3 in_mesh_units(const rig::Head& head, const blendshapes::SparseShape& shape, std::size_t i) {
    return head.frame.rotation.transpose() * shape.delta.row(static_cast<long>(i)).transpose() /
           head.frame.metres_per_unit;
}

// Weights of correctives of many terms stay below: they are scaled for four times what is seen.
constexpr double kUsualWeight = 0.5;

// With four digits: there are thousands of them.
double shortened(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return std::strtod(text, nullptr);
}

}  // namespace

io::MorphModel morph_model(const scene::RigFiles& files, const face::Face& face,
                           const MadeShapes& shapes, const std::string& set,
                           const blendshapes::BlendShapeRig& linear,
                           const ShapeAnimation* animation, int texture_px, EyesBy eyes,
                           bool hair) {
    const rig::Head& head = face.head();
    io::MorphModel model = morph_head(files, face, texture_px, eyes);
    for (const MadeShape& made : shapes.list)
        model.targets.push_back({made.goal.name, made.shape.vertex, made.shape.delta});
    shade_mouth(head, model);
    describe_jaw(model);
    const auto names_of = [&](const std::vector<int>& indices) {
        Json out = Json::array();
        for (const int i : indices)
            out.push_back(shapes.list[static_cast<std::size_t>(i)].goal.name);
        return out;
    };
    Json drivers = Json::array(), correctives = Json::array();
    for (const blendshapes::Driver& driver : linear.drivers) {
        Json& rule = drivers.emplace_back(json_object({{"name", driver.name},
                                                       {"drivers", names_of(driver.shapes)},
                                                       {"value", weight_rule(driver)}}));
        if (driver.shapes.size() == 1) rule["part"] = driver.part;
        if (!driver.fades_with.empty()) rule["fades_with"] = names_of(driver.fades_with);
    }
    for (const blendshapes::Corrective& corrective : linear.correctives) {
        model.targets.push_back({corrective.name, corrective.shape.vertex, corrective.shape.delta,
                                 corrective.follows() ? 1 : kUsualWeight});
        Json& listed = correctives.emplace_back(json_object({{"name", corrective.name}}));
        if (const std::optional<long> driver = corrective.follows()) {
            listed["term"] = linear.drivers[static_cast<std::size_t>(*driver)].name;
            continue;
        }
        listed["of_terms"] = Json::array();
        for (const double fraction : corrective.of_drivers)
            listed["of_terms"].push_back(fraction == 0 ? Json(0) : Json(shortened(fraction)));
    }
    if (hair) add_hair(files, head, model);
    Json on_top = Json::object();
    for (const MadeShape& made : shapes.list)
        if (made.goal.on_top_of >= 0)
            on_top[made.goal.name] =
                shapes.list[static_cast<std::size_t>(made.goal.on_top_of)].goal.name;
    model.extras = json_object({{"risorius", json_object({{"rig", files.rig.name},
                                                          {"set", set},
                                                          {"unit", "m"},
                                                          {"up", "+Y"},
                                                          {"front", "+Z"},
                                                          {"vertices", head.vertices.rows()},
                                                          {"on_top_of", on_top},
                                                          {"terms", drivers},
                                                          {"correctives", correctives}})}});
    if (animation) {
        model.extras["risorius"]["fps"] = animation->fps;
        io::MorphAnimation& out = model.animations.emplace_back();
        out.name = animation->name;
        out.fps = animation->fps;
        out.weights.resize(animation->weights.rows(), static_cast<long>(model.targets.size()));
        for (long f = 0; f < animation->weights.rows(); ++f)
            out.weights.row(f) =
                linear.all_weights(animation->weights.row(f).transpose()).transpose().cast<float>();
        out.motions = node_motions(model, face, animation->drives);
    }
    return model;
}

std::vector<std::string> write_shape_table(const scene::RigFiles& files, const rig::Head& head,
                                           const MadeShapes& shapes,
                                           const std::filesystem::path& folder) {
    const track::ChannelTable channels = files.rig.channels();
    const long vertices = head.vertices.rows();
    Json json = json_object({{"format", "risorius-shapes"},
                             {"version", 1},
                             {"shape", {shapes.list.size(), vertices, 3}},
                             {"dtype", "<f4"},
                             {"layout", "[shape][vertex][xyz]"},
                             {"names", Json::array()},
                             {"file", "shapes.f32"},
                             {"units_per_metre", 1 / head.frame.metres_per_unit},
                             {"excitations", Json::object()},
                             {"on_top_of", Json::object()},
                             {"source", "risorius shapes, rig " + files.rig.name}});
    std::string numbers;
    for (const MadeShape& made : shapes.list) {
        json["names"].push_back(made.goal.name);
        json["excitations"][made.goal.name] = rig::drive_json(made.goal.drive, channels);
        if (made.goal.on_top_of >= 0)
            json["on_top_of"][made.goal.name] =
                shapes.list[static_cast<std::size_t>(made.goal.on_top_of)].goal.name;
        std::vector<float> field(3 * static_cast<std::size_t>(vertices), 0.f);
        for (std::size_t i = 0; i < made.shape.vertex.size(); ++i) {
            const Vec3 delta = in_mesh_units(head, made.shape, i);
            for (std::size_t k = 0; k < 3; ++k)
                field[3 * static_cast<std::size_t>(made.shape.vertex[i]) + k] =
                    static_cast<float>(delta[static_cast<long>(k)]);
        }
        numbers.append(reinterpret_cast<const char*>(field.data()), field.size() * sizeof(float));
    }
    write_file(folder / "shapes.f32", numbers);
    report::write_text(folder / "shapes.json", json_text(json, 1) + "\n");
    return {"shapes.json", "shapes.f32"};
}

std::vector<std::string> write_vertex_cache(const scene::RigFiles& files, const face::Face& face,
                                            const blendshapes::BlendShapeRig& linear,
                                            const ShapeAnimation& animation,
                                            const std::vector<std::string>& formats,
                                            bool head_turns, const std::filesystem::path& folder) {
    const rig::Head& head = face.head();
    PointCache cache{
        head.vertices.rows(), animation.weights.rows(), static_cast<double>(animation.fps), {}};
    std::vector<float> frame(3 * static_cast<std::size_t>(head.vertices.rows()));
    for (long f = 0; f < animation.weights.rows(); ++f) {
        Points moved = Points::Zero(head.vertices.rows(), 3);
        linear.add_to(moved, animation.weights.row(f).transpose());
        if (head_turns)
            moved = face.surfaces()
                        .posed(head.vertices + moved, animation.drives[static_cast<std::size_t>(f)])
                        .vertices -
                    head.vertices;
        for (long v = 0; v < moved.rows(); ++v) {
            const Vec3 at = files.mesh.positions.row(v).transpose() +
                            head.frame.rotation.transpose() * moved.row(v).transpose() /
                                head.frame.metres_per_unit;
            for (long k = 0; k < 3; ++k)
                frame[static_cast<std::size_t>(3 * v + k)] = static_cast<float>(at[k]);
        }
        cache.positions.insert(cache.positions.end(), frame.begin(), frame.end());
    }
    std::vector<std::string> written;
    for (const std::string& format : formats) {
        if (format != "pc2" && format != "mdd") continue;
        written.push_back("cache." + format);
        write_file(folder / written.back(), format == "pc2" ? pc2_bytes(cache) : mdd_bytes(cache));
    }
    if (std::find(formats.begin(), formats.end(), "cache") == formats.end()) return written;
    write_file(folder / "cache.f32",
               std::string(reinterpret_cast<const char*>(cache.positions.data()),
                           cache.positions.size() * sizeof(float)));
    const Json json = json_object({{"format", "risorius-vertex-cache"},
                                   {"version", 1},
                                   {"shape", {animation.weights.rows(), head.vertices.rows(), 3}},
                                   {"dtype", "<f4"},
                                   {"layout", "[frame][vertex][xyz]"},
                                   {"file", "cache.f32"},
                                   {"fps", animation.fps},
                                   {"units_per_metre", 1 / head.frame.metres_per_unit}});
    report::write_text(folder / "cache.json", json_text(json, 1) + "\n");
    written.insert(written.end(), {"cache.json", "cache.f32"});
    return written;
}

std::vector<std::string> write_shape_objs(const scene::RigFiles& files, const rig::Head& head,
                                          const MadeShapes& shapes,
                                          const std::filesystem::path& folder) {
    std::vector<std::string> written;
    std::set<std::string> taken;
    std::filesystem::create_directories(folder / "obj");
    geom::PolygonMesh mesh = files.mesh;
    const auto write = [&](const std::string& name) {
        written.push_back("obj/" + report::folder_name(name, taken) + ".obj");
        io::write_obj(mesh, folder / written.back());
    };
    write("neutral");
    for (const MadeShape& made : shapes.list) {
        mesh.positions = files.mesh.positions;
        for (std::size_t i = 0; i < made.shape.vertex.size(); ++i)
            mesh.positions.row(made.shape.vertex[i]) +=
                in_mesh_units(head, made.shape, i).transpose();
        write(made.goal.name);
    }
    return written;
}

}  // namespace risorius::blendshapes
