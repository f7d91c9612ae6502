// SPDX-License-Identifier: MIT
#include "risorius/io/animation_tracks.h"

#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_file.h"

namespace risorius::io {

namespace {

using detail::GltfFile;

std::string name_or_empty(const JsonCursor& item) {
    const auto name = item.find("name");
    return name ? name->string() : std::string();
}

/// Names of the morph targets of a mesh: in its extras, or in those of its first primitive.
std::vector<std::string> target_names(const JsonCursor& mesh) {
    std::vector<std::string> out;
    const auto take = [&](const JsonCursor& item) {
        const auto extras = item.find("extras");
        if (!out.empty() || !extras || !extras->is_object()) return;
        if (const auto names = extras->find("targetNames"))
            for (const JsonCursor& name : names->items()) out.push_back(name.string());
    };
    take(mesh);
    for (const JsonCursor& primitive : mesh.at("primitives").items()) take(primitive);
    return out;
}

long target_count(const JsonCursor& mesh) {
    for (const JsonCursor& primitive : mesh.at("primitives").items())
        if (const auto targets = primitive.find("targets"))
            return static_cast<long>(targets->items().size());
    return 0;
}

AnimationTrack read_track(const GltfFile& from, const JsonCursor& node, int node_index,
                          const std::string& path, const JsonCursor& sampler) {
    AnimationTrack out;
    out.node = node_index;
    out.node_name = name_or_empty(node);
    out.path = path;
    long width = path == "rotation" ? 4 : 3;
    if (const auto rest = node.find("rotation"); rest && rest->items().size() == 4)
        for (std::size_t k = 0; k < 4; ++k)
            out.at_rest[static_cast<long>(k)] = rest->items()[k].number();
    if (path == "weights") {
        const JsonCursor& mesh = from.item("meshes", node.at("mesh"));
        from.spend(mesh, mesh.at("primitives").items().size());
        out.targets = target_names(mesh);
        from.spend(mesh, out.targets.size());
        width = target_count(mesh);
        if (width == 0) node.at("mesh").fail("a mesh with morph targets", "one without");
        // Some programs list names of more targets than there are.
        if (static_cast<long>(out.targets.size()) > width)
            out.targets.resize(static_cast<std::size_t>(width));
    }
    const JsonCursor& input = from.item("accessors", sampler.at("input"));
    const JsonCursor& output = from.item("accessors", sampler.at("output"));
    const detail::Rows times = from.rows(input, 1);
    const detail::Rows numbers = from.rows(output, path == "weights" ? 1 : static_cast<int>(width));
    if (!times.allFinite() || !numbers.allFinite())
        output.fail("finite times and values", "others");
    const auto interpolation = sampler.find("interpolation");
    const std::string kind =
        interpolation ? interpolation->one_of({"LINEAR", "STEP", "CUBICSPLINE"}) : "LINEAR";
    out.stepped = kind == "STEP";
    // A cubic spline has a value between two tangents at each key.
    const long keys = times.rows(), parts = kind == "CUBICSPLINE" ? 3 : 1,
               per_key = path == "weights" ? width : 1, middle = parts == 3 ? per_key : 0;
    if (numbers.rows() != keys * per_key * parts)
        output.fail(std::to_string(keys * per_key * parts) + " elements for its " +
                        std::to_string(keys) + " times",
                    std::to_string(numbers.rows()));
    out.values.resize(keys, width);
    for (long k = 0; k < keys; ++k) {
        out.times_s.push_back(times(k, 0));
        if (k > 0 && !(times(k, 0) > times(k - 1, 0))) input.fail("times that rise", "others");
        const long first = k * per_key * parts + middle;
        if (path == "weights")
            for (long t = 0; t < width; ++t) out.values(k, t) = numbers(first + t, 0);
        else
            out.values.row(k) = numbers.row(first);
    }
    return out;
}

void read_vrm(const GltfFile& from, AnimationTracks& out) {
    const auto extensions = from.json().find("extensions");
    if (!extensions) return;
    const auto vrm = extensions->find("VRMC_vrm_animation");
    if (!vrm) return;
    const auto node_of = [&](const JsonCursor& item) {
        return static_cast<int>(&from.item("nodes", item.at("node")) - from.list("nodes").data());
    };
    if (const auto expressions = vrm->find("expressions"))
        for (const char* group : {"preset", "custom"})
            if (const auto named = expressions->find(group))
                for (const std::string& name : named->keys())
                    out.vrm.push_back({"expression", name, node_of(named->at(name))});
    if (const auto humanoid = vrm->find("humanoid"))
        if (const auto bones = humanoid->find("humanBones"))
            for (const std::string& name : bones->keys())
                out.vrm.push_back({"bone", name, node_of(bones->at(name))});
    if (const auto look = vrm->find("lookAt"); look && look->has("node"))
        out.vrm.push_back({"look_at", "", node_of(*look)});
}

}  // namespace

AnimationTracks read_animation_tracks(const std::filesystem::path& file) {
    const GltfFile from(file, "a glTF file");
    const std::vector<JsonCursor>& animations = from.list("animations");
    AnimationTracks out;
    out.animations = static_cast<int>(animations.size());
    if (animations.empty()) throw Error(file.string(), "an animation", "none");
    out.name = name_or_empty(animations[0]);
    const std::vector<JsonCursor> samplers = animations[0].at("samplers").items();
    for (const JsonCursor& channel : animations[0].at("channels").items()) {
        const JsonCursor target = channel.at("target");
        const auto node = target.find("node"), path = target.find("path");
        if (!node || !path) continue;  // of an extension
        const std::string what = path->string();
        if (what != "weights" && what != "rotation" && what != "translation") continue;
        const auto index = static_cast<std::size_t>(channel.at("sampler").integer(0, 1 << 30));
        if (index >= samplers.size())
            channel.at("sampler").fail("one of the " + std::to_string(samplers.size()) +
                                       " samplers");
        const JsonCursor& item = from.item("nodes", *node);
        const int node_index = static_cast<int>(&item - from.list("nodes").data());
        out.tracks.push_back(read_track(from, item, node_index, what, samplers[index]));
    }
    read_vrm(from, out);
    return out;
}

}  // namespace risorius::io
