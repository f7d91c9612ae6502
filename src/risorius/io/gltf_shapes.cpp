// SPDX-License-Identifier: MIT
#include "risorius/io/gltf_shapes.h"

#include <algorithm>
#include <map>

#include "risorius/core/error.h"
#include "risorius/io/detail/gltf_file.h"
#include "risorius/io/detail/gltf_nodes.h"
#include "risorius/io/detail/mesh_limits.h"

namespace risorius::io {

namespace {

using detail::GltfFile;
using Matrix4 = Eigen::Matrix4d;

class ShapesOfGltf {
  public:
    explicit ShapesOfGltf(const std::filesystem::path& file)
        : file_(file), from_(file, "a glTF file") {}

    GltfShapes read() {
        for (const detail::PlacedMesh& placed : detail::placed_meshes(from_))
            add_mesh(placed.mesh, placed.place);
        if (out_.targets.empty())
            throw Error(file_.string(), "blend shapes with names (extras.targetNames)", "none");
        out_.positions.resize(static_cast<long>(positions_.size()), 3);
        for (std::size_t v = 0; v < positions_.size(); ++v)
            out_.positions.row(static_cast<long>(v)) = positions_[v].transpose();
        if (!numbered_) out_.vertex.clear();
        for (std::size_t t = 0; t < out_.targets.size(); ++t) {
            Points& delta = out_.targets[t].delta;
            delta.resize(static_cast<long>(deltas_[t].size()), 3);
            for (std::size_t i = 0; i < deltas_[t].size(); ++i)
                delta.row(static_cast<long>(i)) = deltas_[t][i].transpose();
        }
        return std::move(out_);
    }

  private:
    void add_mesh(const JsonCursor& mesh, const Matrix4& place) {
        std::vector<std::string> names;
        if (const auto extras = mesh.find("extras"); extras && extras->is_object()) {
            out_.by_risorius = out_.by_risorius || extras->has("risorius");
            if (const auto listed = extras->find("targetNames"))
                for (const JsonCursor& name : listed->items()) names.push_back(name.string());
        }
        const std::vector<JsonCursor> primitives = mesh.at("primitives").items();
        from_.spend(mesh, names.size() + primitives.size());
        // What is worn is no part of the mesh.
        if (out_.by_risorius && numbered_ && !out_.vertex.empty() && detail::is_worn(primitives))
            return;
        for (const JsonCursor& primitive : primitives) add_primitive(primitive, names, place);
    }

    std::size_t target_named(const std::string& name) {
        const auto [entry, is_new] = target_at_.try_emplace(name, deltas_.size());
        if (is_new) {
            out_.targets.push_back({name, {}, {}});
            deltas_.emplace_back();
        }
        return entry->second;
    }

    void add_primitive(const JsonCursor& primitive, const std::vector<std::string>& names,
                       const Matrix4& place) {
        const JsonCursor attributes = primitive.at("attributes");
        const auto reference = attributes.find("POSITION");
        if (!reference) return;
        const JsonCursor& accessor = from_.item("accessors", *reference);
        const detail::Rows at = from_.rows(accessor, 3);
        if (!at.allFinite()) accessor.fail("finite positions", "others");
        const auto first = static_cast<int>(positions_.size());
        if (positions_.size() + static_cast<std::size_t>(at.rows()) > detail::kMostVertices)
            accessor.fail(detail::kFewerVertices, "more");
        for (long v = 0; v < at.rows(); ++v)
            positions_.push_back(place.topLeftCorner<3, 3>() * at.row(v).transpose() +
                                 place.topRightCorner<3, 1>());
        std::vector<std::uint32_t> numbers;
        if (const auto given = attributes.find("_VERTEX"))
            numbers = from_.indices(from_.item("accessors", *given));
        numbered_ = numbered_ && static_cast<long>(numbers.size()) == at.rows();
        for (const std::uint32_t number : numbers)
            out_.vertex.push_back(
                static_cast<int>(std::min<std::uint32_t>(number, detail::kMostVertices)));
        const auto targets = primitive.find("targets");
        if (!targets) return;
        const std::vector<JsonCursor> listed = targets->items();
        from_.spend(*targets, listed.size());
        if (names.size() != listed.size())
            primitive.fail("a name for each of its " + std::to_string(listed.size()) +
                               " targets in the mesh's extras.targetNames",
                           std::to_string(names.size()));
        for (std::size_t t = 0; t < listed.size(); ++t)
            if (const auto moved = listed[t].find("POSITION"))
                add_target(target_named(names[t]), from_.item("accessors", *moved), at.rows(),
                           first, place);
    }

    void add_target(std::size_t target, const JsonCursor& accessor, long vertices, int first,
                    const Matrix4& place) {
        if (static_cast<long>(from_.count(accessor)) != vertices)
            accessor.fail(
                "a displacement for each of its " + std::to_string(vertices) + " vertices",
                std::to_string(from_.count(accessor)));
        const detail::SparseRows delta = from_.some_rows(accessor, 3);
        if (!delta.values.allFinite()) accessor.fail("finite displacements", "others");
        for (std::size_t i = 0; i < delta.row.size(); ++i) {
            const Vec3 by = delta.values.row(static_cast<long>(i)).transpose();
            if (by.isZero(0.0)) continue;
            out_.targets[target].vertex.push_back(first + static_cast<int>(delta.row[i]));
            deltas_[target].push_back(place.topLeftCorner<3, 3>() * by);
        }
    }

    std::filesystem::path file_;
    GltfFile from_;
    GltfShapes out_;
    std::vector<Vec3> positions_;
    std::vector<std::vector<Vec3>> deltas_;  ///< by target
    std::map<std::string, std::size_t> target_at_;
    bool numbered_ = true;
};

}  // namespace

GltfShapes read_gltf_shapes(const std::filesystem::path& file) { return ShapesOfGltf(file).read(); }

}  // namespace risorius::io
