// SPDX-License-Identifier: MIT
#include "risorius/io/write_usda.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <set>
#include <string_view>

namespace risorius::io {

namespace {

/// Text with indented blocks.
class UsdaText {
  public:
    void line(const std::string& text) { out_ += std::string(4 * depth_, ' ') + text + "\n"; }
    void open(const std::string& head) {
        line(head + " {");
        ++depth_;
    }
    /// A prim that is bound to the skeleton.
    void open_bound(const std::string& head) {
        line(head + " (");
        line("    prepend apiSchemas = [\"SkelBindingAPI\"]");
        open(")");
    }
    void close() {
        --depth_;
        line("}");
    }
    std::string take() { return std::move(out_); }

  private:
    std::string out_;
    std::size_t depth_ = 0;
};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value == 0 ? 0.0 : value);
    return text;
}

/// "[a, b, c]" of `count` texts.
template <class Text>
std::string list(std::size_t count, const Text& text) {
    std::string out = "[";
    for (std::size_t i = 0; i < count; ++i) out += (i == 0 ? "" : ", ") + text(i);
    return out + "]";
}

template <class Vector>
std::string tuple(const Vector& of) {
    return "(" + number(of[0]) + ", " + number(of[1]) + ", " + number(of[2]) + ")";
}

std::string usd_string(const std::string& name) { return "\"" + name + "\""; }

/// A name of a prim: letters, digits and underscores, not taken by another one in `taken`.
std::string prim_name(const std::string& name, std::set<std::string>& taken) {
    std::string made;
    for (const char c : name) made += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (made.empty() || std::isdigit(static_cast<unsigned char>(made[0])) != 0) made = "_" + made;
    std::string out = made;
    for (int n = 2; !taken.insert(out).second; ++n) out = made + "_" + std::to_string(n);
    return out;
}

/// The parts of one node as one mesh: its vertices, and where each vertex of the model is among them.
struct NodeMesh {
    std::vector<int> vertex;  ///< ascending, of the model
    std::vector<int> of_model;
    std::vector<const MorphPart*> parts;

    NodeMesh(const MorphModel& model, int node)
        : of_model(static_cast<std::size_t>(model.vertices.rows()), -1) {
        for (const MorphPart& part : model.parts) {
            if (part.node != node) continue;
            parts.push_back(&part);
            for (const int v : part.triangles.reshaped()) of_model[static_cast<std::size_t>(v)] = 0;
        }
        for (std::size_t v = 0; v < of_model.size(); ++v)
            if (of_model[v] == 0) {
                of_model[v] = static_cast<int>(vertex.size());
                vertex.push_back(static_cast<int>(v));
            }
    }
};

class UsdaWriter {
  public:
    explicit UsdaWriter(const MorphModel& model) : model_(model) {
        std::set<std::string> taken;
        for (const MorphTarget& target : model.targets)
            token_.push_back(prim_name(target.name, taken));
    }

    std::string text() {
        const MorphAnimation* const animation =
            model_.animations.empty() ? nullptr : &model_.animations.front();
        text_.line("#usda 1.0");
        text_.line("(");
        text_.line("    defaultPrim = " + usd_string(root_));
        text_.line("    metersPerUnit = 1");
        text_.line("    upAxis = \"Y\"");
        if (animation) {
            text_.line("    startTimeCode = 0");
            text_.line("    endTimeCode = " + std::to_string(animation->weights.rows() - 1));
            text_.line("    timeCodesPerSecond = " + number(animation->fps));
        }
        text_.line(")");
        text_.line("");
        text_.open("def SkelRoot " + usd_string(root_));
        add_skeleton(animation);
        std::set<std::string> taken{"Skeleton", "Animation"};
        const std::size_t nodes = std::max<std::size_t>(1, model_.nodes.size());
        for (std::size_t n = 0; n < nodes; ++n) {
            const NodeMesh mesh(model_, static_cast<int>(n));
            if (mesh.vertex.empty()) continue;
            const std::string name = model_.nodes.empty() ? model_.name : model_.nodes[n].name;
            add_mesh(mesh, prim_name(name, taken));
        }
        text_.close();
        return text_.take();
    }

  private:
    /// Blend shapes of UsdSkel need a skeleton that their animation is bound to; it has one joint that rests.
    void add_skeleton(const MorphAnimation* animation) {
        text_.open_bound("def Skeleton \"Skeleton\"");
        text_.line("uniform token[] joints = [\"Root\"]");
        const std::string still = "[( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )]";
        text_.line("uniform matrix4d[] bindTransforms = " + still);
        text_.line("uniform matrix4d[] restTransforms = " + still);
        if (animation) text_.line("rel skel:animationSource = </" + root_ + "/Animation>");
        text_.close();
        if (!animation) return;
        text_.open("def SkelAnimation \"Animation\"");
        text_.line("uniform token[] blendShapes = " +
                   list(token_.size(), [&](std::size_t t) { return usd_string(token_[t]); }));
        text_.open("float[] blendShapeWeights.timeSamples =");
        for (long f = 0; f < animation->weights.rows(); ++f)
            text_.line(std::to_string(f) + ": " +
                       list(token_.size(),
                            [&](std::size_t t) {
                                return number(static_cast<double>(
                                    animation->weights(f, static_cast<long>(t))));
                            }) +
                       ",");
        text_.close();
        text_.close();
    }

    void add_mesh(const NodeMesh& mesh, const std::string& name) {
        std::vector<std::size_t> targets;
        for (std::size_t t = 0; t < model_.targets.size(); ++t)
            if (std::any_of(model_.targets[t].vertex.begin(), model_.targets[t].vertex.end(),
                            [&](int v) { return mesh.of_model[static_cast<std::size_t>(v)] >= 0; }))
                targets.push_back(t);
        text_.open_bound("def Mesh " + usd_string(name));
        text_.line("uniform token subdivisionScheme = \"none\"");
        std::vector<int> corners;
        for (const MorphPart* part : mesh.parts)
            for (long t = 0; t < part->triangles.rows(); ++t)
                for (int k = 0; k < 3; ++k)
                    corners.push_back(
                        mesh.of_model[static_cast<std::size_t>(part->triangles(t, k))]);
        text_.line("int[] faceVertexCounts = " +
                   list(corners.size() / 3, [](std::size_t) { return std::string("3"); }));
        text_.line("int[] faceVertexIndices = " +
                   list(corners.size(), [&](std::size_t c) { return std::to_string(corners[c]); }));
        text_.line("point3f[] points = " + list(mesh.vertex.size(), [&](std::size_t v) {
                       return tuple(model_.vertices.row(mesh.vertex[v]));
                   }));
        add_texcoords(mesh);
        text_.line("rel skel:skeleton = </" + root_ + "/Skeleton>");
        if (!targets.empty()) {
            text_.line("uniform token[] skel:blendShapes = " +
                       list(targets.size(),
                            [&](std::size_t i) { return usd_string(token_[targets[i]]); }));
            text_.line("rel skel:blendShapeTargets = " + list(targets.size(), [&](std::size_t i) {
                           return "</" + root_ + "/" + name + "/" + token_[targets[i]] + ">";
                       }));
        }
        for (const std::size_t t : targets) add_shape(mesh, t);
        text_.close();
    }

    void add_texcoords(const NodeMesh& mesh) {
        if (std::any_of(mesh.parts.begin(), mesh.parts.end(),
                        [](const MorphPart* part) { return part->texcoords.rows() == 0; }))
            return;
        std::vector<std::array<double, 2>> at;
        for (const MorphPart* part : mesh.parts)
            for (long c = 0; c < part->texcoords.rows(); ++c)
                at.push_back({part->texcoords(c, 0), part->texcoords(c, 1)});
        text_.line("texCoord2f[] primvars:st = " +
                   list(at.size(),
                        [&](std::size_t c) {
                            return "(" + number(at[c][0]) + ", " + number(at[c][1]) + ")";
                        }) +
                   " (interpolation = \"faceVarying\")");
    }

    void add_shape(const NodeMesh& mesh, std::size_t t) {
        const MorphTarget& target = model_.targets[t];
        std::vector<std::size_t> moved;
        for (std::size_t i = 0; i < target.vertex.size(); ++i)
            if (mesh.of_model[static_cast<std::size_t>(target.vertex[i])] >= 0) moved.push_back(i);
        text_.open("def BlendShape " + usd_string(token_[t]));
        text_.line("uniform vector3f[] offsets = " + list(moved.size(), [&](std::size_t i) {
                       return tuple(target.delta.row(static_cast<long>(moved[i])));
                   }));
        text_.line("uniform int[] pointIndices = " + list(moved.size(), [&](std::size_t i) {
                       return std::to_string(
                           mesh.of_model[static_cast<std::size_t>(target.vertex[moved[i]])]);
                   }));
        text_.close();
    }

    const MorphModel& model_;
    std::vector<std::string> token_;  ///< by target
    std::string root_ = "Head";
    UsdaText text_;
};

}  // namespace

std::string usda_text(const MorphModel& model) { return UsdaWriter(model).text(); }

}  // namespace risorius::io
