// SPDX-License-Identifier: MIT
// The text of USD, read back by a parser that takes nothing but what the grammar allows.
#include "risorius/io/write_usda.h"

#include <gtest/gtest.h>

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace risorius::io {
namespace {

/// A value: a number, a text in quotes, a path in angle brackets, or a list of values (of [] or of ()).
struct UsdValue {
    char kind = ' ';  ///< 'n', '"', '<', '[' or '('
    double number = 0;
    std::string text;
    std::vector<UsdValue> list;
};

struct UsdPrim {
    std::string type, name;
    std::map<std::string, UsdValue> metadata, values;
    std::map<std::string, std::string> types;  ///< of values: "uniform token[]", "rel"
    std::map<int, UsdValue> samples;           ///< of the one property with samples
    std::string sampled;
    std::vector<UsdPrim> children;

    const UsdPrim& child(const std::string& wanted) const {
        for (const UsdPrim& one : children)
            if (one.name == wanted) return one;
        throw std::runtime_error("no prim " + wanted);
    }
};

/// Reads the subset of the grammar of USD text that a layer of meshes needs. Throws what is wrong.
class UsdParser {
  public:
    explicit UsdParser(std::string text) : text_(std::move(text)) {}

    UsdPrim layer() {
        if (text_.rfind("#usda 1.0\n", 0) != 0) fail("#usda 1.0");
        at_ = 10;
        UsdPrim out;
        metadata(out);
        while (skip(), at_ < text_.size()) out.children.push_back(prim());
        return out;
    }

  private:
    [[noreturn]] void fail(const std::string& wanted) const {
        throw std::runtime_error("expected " + wanted + " at \"" + text_.substr(at_, 30) + "\"");
    }
    void skip() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
            ++at_;
    }
    bool is_next(char c) {
        skip();
        return at_ < text_.size() && text_[at_] == c;
    }
    void take(char c) {
        if (!is_next(c)) fail(std::string(1, c));
        ++at_;
    }
    std::string word(const char* more = "") {
        skip();
        std::string out;
        while (at_ < text_.size() &&
               (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_' ||
                std::string(more).find(text_[at_]) != std::string::npos))
            out += text_[at_++];
        if (out.empty()) fail("a word");
        return out;
    }
    std::string until(char end) {
        ++at_;
        const std::size_t from = at_;
        while (at_ < text_.size() && text_[at_] != end && text_[at_] != '\n') ++at_;
        if (at_ >= text_.size() || text_[at_] != end) fail(std::string(1, end));
        return text_.substr(from, at_++ - from);
    }
    UsdValue value() {
        skip();
        UsdValue out;
        const char c = at_ < text_.size() ? text_[at_] : ' ';
        if (c == '"' || c == '<') {
            out.kind = c;
            out.text = until(c == '<' ? '>' : '"');
        } else if (c == '[' || c == '(') {
            out.kind = c;
            const char end = c == '[' ? ']' : ')';
            ++at_;
            while (!is_next(end)) {
                if (!out.list.empty()) take(',');
                out.list.push_back(value());
            }
            take(end);
        } else {
            out.kind = 'n';
            std::size_t used = 0;
            const std::string rest = text_.substr(at_, 40);
            out.number = std::stod(rest, &used);
            at_ += used;
        }
        return out;
    }
    void metadata(UsdPrim& prim) {
        if (!is_next('(')) return;
        take('(');
        while (!is_next(')')) {
            std::string key = word();
            if (key == "prepend") key += " " + word();
            take('=');
            prim.metadata[key] = value();
        }
        take(')');
    }
    UsdPrim prim() {
        if (word() != "def") fail("def");
        UsdPrim out;
        out.type = word();
        skip();
        if (text_[at_] != '"') fail("a name in quotes");
        out.name = until('"');
        for (const char c : out.name)
            if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') fail("a plain name");
        metadata(out);
        take('{');
        while (!is_next('}')) {
            const std::size_t before = at_;
            const std::string first = word("[]");
            if (first == "def") {
                at_ = before;
                out.children.push_back(prim());
            } else {
                property(first, out);
            }
        }
        take('}');
        return out;
    }
    void property(std::string type, UsdPrim& out) {
        if (type == "uniform") type += " " + word("[]");
        std::string name = word(":.");
        take('=');
        if (name.ends_with(".timeSamples")) {
            out.sampled = name.substr(0, name.size() - 12);
            take('{');
            while (!is_next('}')) {
                const int time = std::stoi(word());
                take(':');
                out.samples[time] = value();
                take(',');
            }
            take('}');
            return;
        }
        if (!out.values.emplace(name, value()).second) fail("a property once");
        out.types[name] = type;
        if (is_next('(')) {
            UsdPrim of_property;
            metadata(of_property);
        }
    }

    std::string text_;
    std::size_t at_ = 0;
};

MorphModel triangles_with_shapes() {
    MorphModel model;
    model.name = "two";
    model.vertices.resize(6, 3);
    model.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1;
    model.nodes = {{.name = "Face"}, {.name = "Eye Left"}};
    MorphPart skin, eye;
    skin.name = "skin";
    skin.triangles.resize(1, 3);
    skin.triangles << 0, 1, 2;
    skin.texcoords.resize(3, 2);
    skin.texcoords << 0, 0, 1, 0, 0.5, 1;
    eye.name = "eye";
    eye.node = 1;
    eye.triangles.resize(1, 3);
    eye.triangles << 3, 5, 4;
    model.parts = {skin, eye};
    Points both(2, 3), one(1, 3);
    both << 0, 0, 0.25, 0.125, 0, -0.5;
    one << 1e-5, 0, 0;
    model.targets = {{"jawOpen", {1, 5}, both}, {"AU12.l", {2}, one}, {"AU12_l", {0}, one}};
    MorphAnimation animation;
    animation.fps = 50;
    animation.weights.resize(2, 3);
    animation.weights << 0, 0.5f, 1, 1, 0.25f, 0;
    model.animations = {animation};
    return model;
}

TEST(Usda, HoldsMeshesShapesAndAnimation) {
    const MorphModel model = triangles_with_shapes();
    const std::string text = usda_text(model);
    EXPECT_EQ(text, usda_text(model));
    const UsdPrim layer = UsdParser(text).layer();
    EXPECT_EQ(layer.metadata.at("upAxis").text, "Y");
    EXPECT_EQ(layer.metadata.at("metersPerUnit").number, 1);
    EXPECT_EQ(layer.metadata.at("timeCodesPerSecond").number, 50);
    EXPECT_EQ(layer.metadata.at("endTimeCode").number, 1);
    ASSERT_EQ(layer.children.size(), 1u);
    const UsdPrim& root = layer.child(layer.metadata.at("defaultPrim").text);
    EXPECT_EQ(root.type, "SkelRoot");

    const UsdPrim &face = root.child("Face"), &eye = root.child("Eye_Left");
    for (const UsdPrim* mesh : {&face, &eye}) {
        EXPECT_EQ(mesh->metadata.at("prepend apiSchemas").list.at(0).text, "SkelBindingAPI");
        EXPECT_EQ(mesh->values.at("skel:skeleton").text, "/Head/Skeleton");
        EXPECT_EQ(mesh->types.at("skel:skeleton"), "rel");
        EXPECT_EQ(mesh->values.at("points").list.size(), 3u);
    }
    const auto names = [](const UsdValue& list) {
        std::vector<std::string> out;
        for (const UsdValue& one : list.list) out.push_back(one.text);
        return out;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names(face.values.at("skel:blendShapes")), (Names{"jawOpen", "AU12_l", "AU12_l_2"}));
    EXPECT_EQ(names(eye.values.at("skel:blendShapes")), (Names{"jawOpen"}));
    EXPECT_EQ(names(eye.values.at("skel:blendShapeTargets")), (Names{"/Head/Eye_Left/jawOpen"}));
    EXPECT_EQ(face.values.at("primvars:st").list.size(), 3u);
    EXPECT_EQ(eye.values.count("primvars:st"), 0u);

    // The eye's vertices are 3, 4 and 5 of the model; its triangle keeps its order.
    const auto numbers = [](const UsdValue& list) {
        std::vector<double> out;
        for (const UsdValue& one : list.list) out.push_back(one.number);
        return out;
    };
    using Numbers = std::vector<double>;
    EXPECT_EQ(numbers(eye.values.at("faceVertexIndices")), (Numbers{0, 2, 1}));
    EXPECT_EQ(numbers(eye.values.at("points").list[2]), (Numbers{0, 1, 1}));
    const UsdPrim& open = eye.child("jawOpen");
    EXPECT_EQ(open.type, "BlendShape");
    EXPECT_EQ(numbers(open.values.at("pointIndices")), (Numbers{2}));
    EXPECT_EQ(numbers(open.values.at("offsets").list.at(0)), (Numbers{0.125, 0, -0.5}));
    EXPECT_EQ(numbers(face.child("AU12_l").values.at("offsets").list.at(0)), (Numbers{1e-5, 0, 0}));

    const UsdPrim& animation = root.child("Animation");
    EXPECT_EQ(root.child("Skeleton").values.at("skel:animationSource").text, "/Head/Animation");
    EXPECT_EQ(names(animation.values.at("blendShapes")), (Names{"jawOpen", "AU12_l", "AU12_l_2"}));
    EXPECT_EQ(animation.sampled, "blendShapeWeights");
    ASSERT_EQ(animation.samples.size(), 2u);
    EXPECT_EQ(numbers(animation.samples.at(0)), (Numbers{0, 0.5, 1}));
    EXPECT_EQ(numbers(animation.samples.at(1)), (Numbers{1, 0.25, 0}));
}

TEST(Usda, TheParserTakesNoOtherText) {
    const std::string text = usda_text(triangles_with_shapes());
    const auto without = [&](const std::string& part) {
        std::string out = text;
        return out.erase(out.find(part), part.size());
    };
    for (const char* part : {"#usda 1.0", "(", "\"", "]", "}", " = ", "def "})
        EXPECT_ANY_THROW(UsdParser(without(part)).layer()) << part;
}

}  // namespace
}  // namespace risorius::io
