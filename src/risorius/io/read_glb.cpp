// SPDX-License-Identifier: MIT
// Reads binary glTF as written by write_glb.cpp.
#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_file.h"
#include "risorius/io/detail/gltf_nodes.h"
#include "risorius/io/detail/mesh_limits.h"
#include "risorius/io/morph_model.h"

namespace risorius::io {

namespace {

using detail::GltfFile;

// Writes the displacements of each target, in the order of vertices.
void write_targets(const std::vector<std::map<int, Vec3>>& deltas, MorphModel& out) {
    for (std::size_t t = 0; t < deltas.size(); ++t) {
        MorphTarget& target = out.targets[t];
        target.delta.resize(static_cast<long>(deltas[t].size()), 3);
        for (const auto& [v, delta] : deltas[t]) {
            target.delta.row(static_cast<long>(target.vertex.size())) = delta.transpose();
            target.vertex.push_back(v);
        }
    }
}

// Reads the weights of all shapes over time.
MorphAnimation read_animation(const GltfFile& from, const JsonCursor& animation,
                              const JsonCursor& channel, std::size_t targets) {
    const JsonCursor samplers = animation.at("samplers");
    const std::vector<JsonCursor> listed = samplers.items();
    const auto index = channel.at("sampler").integer(0, 1 << 30);
    if (static_cast<std::size_t>(index) >= listed.size())
        channel.at("sampler").fail("one of the " + std::to_string(listed.size()) + " samplers");
    const JsonCursor& sampler = listed[static_cast<std::size_t>(index)];
    const JsonCursor& output = from.item("accessors", sampler.at("output"));
    const detail::Rows times = from.rows(from.item("accessors", sampler.at("input")), 1),
                       weights = from.rows(output, 1);
    MorphAnimation made;
    if (const auto name = animation.find("name")) made.name = name->string();
    if (!times.allFinite() || !weights.allFinite())
        output.fail("finite times and weights", "others");
    // The file holds times as floats; their difference is that of floats too.
    if (times.rows() > 1)
        made.fps = 1.0 / static_cast<double>(static_cast<float>(times(1, 0)) -
                                             static_cast<float>(times(0, 0)));
    if (!(made.fps > 0) || !std::isfinite(made.fps))
        sampler.at("input").fail("times that increase", "others");
    const long count = static_cast<long>(targets);
    if (weights.rows() != times.rows() * count)
        output.fail("a weight for every shape and frame", std::to_string(weights.rows()));
    made.weights.resize(times.rows(), count);
    for (long i = 0; i < weights.rows(); ++i) made.weights(i / count, i % count) = weights(i, 0);
    return made;
}

// Number of the mesh's vertex for each vertex of a primitive.
std::vector<int> vertex_numbers(const GltfFile& from, const JsonCursor& accessor, long count) {
    std::vector<int> out;
    for (const std::uint32_t number : from.indices(accessor)) {
        if (number >= detail::kMostVertices)
            accessor.fail(detail::kFewerVertices, "vertex " + std::to_string(number));
        out.push_back(static_cast<int>(number));
    }
    if (static_cast<long>(out.size()) != count || out.empty())
        accessor.fail("a vertex number for each of its " + std::to_string(count) + " vertices",
                      std::to_string(out.size()));
    return out;
}

// Adds a primitive to the one list of vertices. Those at seams occur several times, at the same position. `of_target`: index in
// `deltas` of each target.
void add_primitive(const GltfFile& from, const JsonCursor& primitive, const Eigen::Matrix4d& place,
                   const std::vector<std::size_t>& of_target,
                   std::vector<std::map<int, Vec3>>& deltas, MorphModel& out) {
    const JsonCursor attributes = primitive.at("attributes");
    if (!attributes.has("_VERTEX") || !attributes.has("POSITION"))
        attributes.fail("the attributes POSITION and _VERTEX, as risorius shapes writes them",
                        "neither or one");
    const auto named = primitive.find("targets");
    const std::vector<JsonCursor> targets = named ? named->items() : std::vector<JsonCursor>{};
    from.spend(primitive, targets.size());
    if (targets.size() != of_target.size())
        primitive.fail("a target for each of its " + std::to_string(of_target.size()) + " names",
                       std::to_string(targets.size()));
    const JsonCursor& positions = from.item("accessors", attributes.at("POSITION"));
    const detail::Rows at = from.rows(positions, 3);
    if (!at.allFinite()) positions.fail("finite positions", "others");
    const std::vector<int> vertex =
        vertex_numbers(from, from.item("accessors", attributes.at("_VERTEX")), at.rows());
    const long max = 1 + *std::max_element(vertex.begin(), vertex.end());
    if (max > out.vertices.rows()) {
        const long before = out.vertices.rows();
        out.vertices.conservativeResize(max, 3);
        out.vertices.bottomRows(max - before).setZero();
    }
    for (long i = 0; i < at.rows(); ++i)
        out.vertices.row(vertex[static_cast<std::size_t>(i)]) =
            (place.topLeftCorner<3, 3>() * at.row(i).transpose() + place.topRightCorner<3, 1>())
                .transpose();
    MorphPart part;
    if (const auto material = primitive.find("material"))
        if (const auto name = from.item("materials", *material).find("name"))
            part.name = name->string();
    const std::vector<std::uint32_t> corners =
        from.indices(from.item("accessors", primitive.at("indices")));
    part.triangles.resize(static_cast<long>(corners.size() / 3), 3);
    for (long c = 0; c < 3 * part.triangles.rows(); ++c) {
        const std::uint32_t corner = corners[static_cast<std::size_t>(c)];
        if (corner >= vertex.size())
            primitive.at("indices").fail("triangles of its vertices", "one beyond them");
        part.triangles(c / 3, c % 3) = vertex[corner];
    }
    out.parts.push_back(std::move(part));
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const auto moved = targets[t].find("POSITION");
        if (!moved) continue;
        const JsonCursor& accessor = from.item("accessors", *moved);
        if (from.count(accessor) != vertex.size())
            accessor.fail(
                "a displacement for each of its " + std::to_string(vertex.size()) + " vertices",
                std::to_string(from.count(accessor)));
        const detail::SparseRows delta = from.some_rows(accessor, 3);
        if (!delta.values.allFinite()) accessor.fail("finite displacements", "others");
        for (std::size_t i = 0; i < delta.row.size(); ++i)
            if (const Vec3 by = delta.values.row(static_cast<long>(i)).transpose(); !by.isZero(0.0))
                deltas[of_target[t]][vertex[delta.row[i]]] = place.topLeftCorner<3, 3>() * by;
    }
}

// The names of a mesh's targets.
std::vector<std::string> names_of_targets(const JsonCursor& mesh) {
    std::vector<std::string> names;
    if (const auto extras = mesh.find("extras"); extras && extras->is_object())
        if (const auto listed = extras->find("targetNames"))
            for (const JsonCursor& name : listed->items()) names.push_back(name.string());
    return names;
}

MorphModel read_model(const std::filesystem::path& file) {
    const GltfFile from(file, "a binary glTF file", /*binary_only=*/true);
    const std::vector<detail::PlacedMesh> meshes = detail::placed_meshes(from);
    if (meshes.empty())
        throw Error(file.string(), "a mesh with blend shapes, as risorius shapes writes it",
                    "no mesh");
    // The first mesh has the names of all shapes.
    const JsonCursor& first = meshes[0].mesh;
    MorphModel out;
    if (const auto name = first.find("name")) out.name = name->string();
    const auto extras = first.find("extras");
    if (!extras || !extras->is_object() || !extras->has("targetNames"))
        first.fail("the names of its shapes in the mesh's extras", "none");
    out.extras = extras->json();
    out.extras.erase("targetNames");
    std::map<std::string, std::size_t> index;
    for (const std::string& name : names_of_targets(first)) {
        index.emplace(name, out.targets.size());
        out.targets.push_back({name, {}, {}});
    }
    std::vector<std::map<int, Vec3>> deltas(out.targets.size());
    for (const detail::PlacedMesh& placed : meshes) {
        std::vector<std::size_t> of_target;
        const std::vector<std::string> names = names_of_targets(placed.mesh);
        const std::vector<JsonCursor> primitives = placed.mesh.at("primitives").items();
        from.spend(placed.mesh, names.size() + primitives.size());
        if (!out.parts.empty() && detail::is_worn(primitives)) continue;
        for (const std::string& name : names) {
            const auto known = index.find(name);
            if (known == index.end())
                placed.mesh.at("extras")
                    .at("targetNames")
                    .fail("names that the first mesh has", "\"" + name + "\"");
            of_target.push_back(known->second);
        }
        for (const JsonCursor& primitive : primitives)
            add_primitive(from, primitive, placed.place, of_target, deltas, out);
    }
    write_targets(deltas, out);
    for (const JsonCursor& animation : from.list("animations"))
        for (const JsonCursor& channel : animation.at("channels").items()) {
            const JsonCursor target = channel.at("target");
            const auto path = target.find("path"), node = target.find("node");
            if (out.targets.empty() || !path || path->string() != "weights" || !node) continue;
            if (from.item("nodes", *node).place() != from.list("nodes")[meshes[0].node].place())
                continue;
            out.animations.push_back(read_animation(from, animation, channel, out.targets.size()));
            break;
        }
    return out;
}

}  // namespace

MorphModel read_glb(const std::filesystem::path& file) {
    try {
        return read_model(file);
    } catch (const std::bad_alloc&) {
        throw Error(file.string(), "a file that fits into memory", "a larger one");
    }
}

}  // namespace risorius::io
