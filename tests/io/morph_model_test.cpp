// SPDX-License-Identifier: MIT
// Blend shapes survive a glTF file: names, numbers, the order of vertices, weights over time.
#include "risorius/io/morph_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/error.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius::io {
namespace {

/// Two quads side by side with a common edge and two materials. The texture of the second has a seam.
MorphModel two_quads() {
    MorphModel model;
    model.name = "quads";
    model.vertices.resize(7, 3);
    model.vertices << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 9, 9,
        9;  // the last one is unused
    MorphPart skin;
    skin.name = "skin";
    skin.triangles.resize(2, 3);
    skin.triangles << 0, 1, 4, 0, 4, 3;
    skin.colour = Vec3(0.8, 0.6, 0.5);
    MorphPart eye;
    eye.name = "eye";
    eye.triangles.resize(2, 3);
    eye.triangles << 1, 2, 5, 1, 5, 4;
    eye.texcoords.resize(6, 2);
    eye.texcoords << 0, 0, 1, 0, 1, 1, 0.25, 0, 1, 1, 0, 1;  // vertex 1 occurs twice
    eye.tint = Points::Ones(7, 3);
    model.parts = {skin, eye};
    Points lift(2, 3);
    lift << 0, 0, 0.25, 0, 0, 0.5;
    Points push(1, 3);
    push << 0.125, 0, 0;
    model.targets = {{"lift", {4, 5}, lift}, {"nothing", {}, Points(0, 3)}, {"push", {1}, push}};
    MorphAnimation animation;
    animation.name = "hello";
    animation.fps = 50;
    animation.weights.resize(2, 3);
    animation.weights << 0, 0.5, 1, 1, 0.25, 0;
    model.animations = {animation};
    model.extras = {{"risorius", {{"set", "arkit52"}, {"weights", {0.5, 1}}}}};
    return model;
}

/// The two chunks of a .glb file.
std::pair<Json, std::string> chunks(const std::string& bytes) {
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2u);
    EXPECT_EQ(number(8), bytes.size());
    const std::uint32_t length = number(12);
    return {Json::parse(bytes.substr(20, length)), bytes.substr(20 + length + 8)};
}

TEST(MorphModel, ReadsBackWhatWasWritten) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "quads.glb";
    MorphModel model = two_quads();
    model.whole_numbers = false;
    const std::string bytes = glb_bytes(model);
    EXPECT_EQ(bytes, glb_bytes(model));
    std::ofstream(file, std::ios::binary) << bytes;
    const MorphModel back = read_glb(file);
    ASSERT_EQ(back.vertices.rows(), 6);  // without the unused one
    EXPECT_EQ(back.vertices, model.vertices.topRows(6));
    ASSERT_EQ(back.targets.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t) {
        EXPECT_EQ(back.targets[t].name, model.targets[t].name);
        EXPECT_EQ(back.targets[t].vertex, model.targets[t].vertex);
        EXPECT_EQ(back.targets[t].delta, model.targets[t].delta);
    }
    EXPECT_EQ(back.extras, model.extras);
    ASSERT_EQ(back.parts.size(), 2u);
    EXPECT_EQ(back.parts[0].name, "skin");
    EXPECT_EQ(back.parts[0].triangles, model.parts[0].triangles);
    EXPECT_EQ(back.parts[1].triangles, model.parts[1].triangles);
    ASSERT_EQ(back.animations.size(), 1u);
    EXPECT_NEAR(back.animations[0].fps, 50, 1e-5);
    EXPECT_EQ(back.animations[0].weights, model.animations[0].weights);
}

TEST(MorphModel, NormalsOfTargetsStandOnWhatTurnsAlone) {
    // A strip of twelve quads; the shapes move all of it, but bend only its left end. three.js would keep normals for all of it.
    constexpr int kQuads = 12;
    MorphModel model;
    model.name = "strip";
    model.vertices.resize(2 * (kQuads + 1), 3);
    MorphPart skin;
    skin.name = "skin";
    skin.triangles.resize(2 * kQuads, 3);
    std::vector<int> all;
    Points up = Points::Zero(2 * (kQuads + 1), 3), aside = up;
    for (int i = 0; i <= kQuads; ++i)
        for (int k = 0; k < 2; ++k) {
            model.vertices.row(2 * i + k) << i, k, 0;
            up(2 * i + k, 2) = i == 0 ? 1.5 : 0.5;
            aside(2 * i + k, 0) = 0.25;
            all.push_back(2 * i + k);
        }
    for (int i = 0; i < kQuads; ++i) {
        skin.triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
        skin.triangles.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
    }
    model.parts = {skin};
    model.targets = {{"up", all, up}, {"aside", all, aside}};
    const Json json = chunks(glb_bytes(model)).first;
    const Json& primitives = json["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 2u);
    EXPECT_EQ(primitives[0]["material"], primitives[1]["material"]);
    for (const Json& target : primitives[0]["targets"])
        EXPECT_TRUE(target.contains("POSITION") && target.contains("NORMAL"));
    for (const Json& target : primitives[1]["targets"])
        EXPECT_TRUE(target.contains("POSITION") && !target.contains("NORMAL"));
    const auto count = [&](const Json& primitive) {
        return json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"]
            .get<int>();
    };
    // Vertices 0 to 3 turn. The triangles that have them reach as far as vertex 5.
    EXPECT_EQ(count(primitives[0]), 6);
    EXPECT_EQ(count(primitives[1]), 2 * (kQuads + 1) - 4);
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "strip.glb", std::ios::binary) << glb_bytes(model);
    const MorphModel back = read_glb(folder.path() / "strip.glb");
    EXPECT_EQ(back.vertices, model.vertices);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(back.targets[t].delta, model.targets[t].delta);

    model.parts[0].normals_turn = false;
    const Json plain = chunks(glb_bytes(model)).first;
    ASSERT_EQ(plain["meshes"][0]["primitives"].size(), 1u);
    EXPECT_FALSE(plain["meshes"][0]["primitives"][0]["targets"][0].contains("NORMAL"));
}

TEST(MorphModel, IsReadWithPicturesInIt) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "quads.glb";
    const std::string bytes = glb_bytes(two_quads());
    auto [json, binary] = chunks(bytes);
    // A picture in the buffer, and the material that shows it; nothing here can decode it.
    json["images"] = {{{"mimeType", "image/png"}, {"bufferView", 0}}};
    json["textures"] = {{{"source", 0}}};
    json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string changed =
        bytes.substr(0, 20) + text + bytes.substr(bytes.size() - binary.size() - 8);
    for (const auto& [at, value] : {std::pair{8, changed.size()}, std::pair{12, text.size()}}) {
        const auto number = static_cast<std::uint32_t>(value);
        std::memcpy(changed.data() + at, &number, 4);
    }
    std::ofstream(file, std::ios::binary) << changed;
    const MorphModel back = read_glb(file);
    EXPECT_EQ(back.vertices, two_quads().vertices.topRows(6));
    ASSERT_EQ(back.targets.size(), 3u);
    EXPECT_EQ(back.targets[0].delta, two_quads().targets[0].delta);
}

/// The quads as a hierarchy: a face that two joints carry, and an eye below the second joint that turns.
MorphModel jointed_quads() {
    MorphModel model = two_quads();
    model.nodes = {{.name = "Face"},
                   {.name = "quads", .extras = {{"unit", "m"}}},
                   {.name = "Neck", .parent = 1},
                   {.name = "Head", .parent = 1, .place = {1, 0, 0}},
                   {.name = "Eye", .parent = 3, .place = {1, 0.5, 0}}};
    model.nodes[4].animate_shapes = false;
    model.parts[1].node = 4;
    model.pictures = {{"dots", "image/png", "\x89PNG not a whole one"}};
    model.parts[1].picture = 0;
    model.skin = {0, {2, 3}, Eigen::MatrixXd::Zero(7, 2)};
    for (long v = 0; v < 7; ++v) model.skin.weights.row(v) << 1 - v / 10.0, v / 10.0;
    NodeMotion turn{3, {Eigen::Quaterniond::Identity(), {0, 0, 1, 0}}, {{0, 0, 0}, {0, 0.5, 0}}};
    model.animations[0].motions = {turn};
    return model;
}

TEST(MorphModel, NodesJointsAndPicturesAreWrittenAndReadBack) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "quads.glb";
    for (const bool whole_numbers : {false, true}) {
        MorphModel model = jointed_quads();
        model.whole_numbers = whole_numbers;
        const std::string bytes = glb_bytes(model);
        std::ofstream(file, std::ios::binary) << bytes;
        const MorphModel back = read_glb(file);
        ASSERT_EQ(back.vertices.rows(), 6);
        // Half a step of the largest coordinate, 2 m
        EXPECT_LT((back.vertices - model.vertices.topRows(6)).cwiseAbs().maxCoeff(),
                  whole_numbers ? 4e-5 : 1e-6);
        ASSERT_EQ(back.targets.size(), 3u);
        for (std::size_t t = 0; t < 3; ++t) {
            EXPECT_EQ(back.targets[t].name, model.targets[t].name);
            ASSERT_EQ(back.targets[t].vertex, model.targets[t].vertex);
            if (model.targets[t].vertex.empty()) continue;
            EXPECT_LT((back.targets[t].delta - model.targets[t].delta).cwiseAbs().maxCoeff(),
                      whole_numbers ? 4e-5 : 1e-12);
        }
        EXPECT_EQ(back.extras, model.extras);
        ASSERT_EQ(back.animations.size(), 1u);
        EXPECT_LE((back.animations[0].weights - model.animations[0].weights).cwiseAbs().maxCoeff(),
                  whole_numbers ? 0.5f / 65535 + 1e-7f : 0.0f);

        const auto [json, binary] = chunks(bytes);
        // The first mesh has all names, others those that move them; what moves nothing costs nothing there.
        EXPECT_EQ(json["meshes"][0]["extras"]["targetNames"], Json({"lift", "nothing", "push"}));
        EXPECT_EQ(json["meshes"][1]["extras"]["targetNames"], Json({"lift", "push"}));
        // Places are relative to the parent, and joints lead back to the vertices.
        EXPECT_EQ(json["nodes"][4]["translation"], Json({0.0, 0.5, 0.0}));
        EXPECT_EQ(json["nodes"][3]["children"], Json({4}));
        EXPECT_EQ(json["scenes"][0]["nodes"], Json({0, 1}));
        EXPECT_EQ(json["nodes"][1]["extras"]["unit"], "m");
        EXPECT_EQ(json["skins"][0]["joints"], Json({2, 3}));
        EXPECT_EQ(json["nodes"][0]["skin"], 0);
        EXPECT_FALSE(json["nodes"][0].contains("scale"));
        EXPECT_EQ(json["nodes"][4].contains("scale"), whole_numbers);
        // Shares of a vertex in 65535ths, or 255ths, that sum to one, and no joint without a share
        const Json& face = json["meshes"][0]["primitives"][0]["attributes"];
        const auto start = [&](const char* name) {
            const Json& accessor = json["accessors"][face[name].get<std::size_t>()];
            return json["bufferViews"][accessor["bufferView"].get<std::size_t>()].value(
                "byteOffset", 0u);
        };
        for (std::size_t v = 0; v < 4; ++v) {
            std::array<std::uint16_t, 4> shares{};
            std::array<std::uint8_t, 4> joints{};
            if (whole_numbers)
                for (std::size_t k = 0; k < 4; ++k)
                    shares[k] = static_cast<std::uint8_t>(binary[start("WEIGHTS_0") + 4 * v + k]);
            else
                std::memcpy(shares.data(), binary.data() + start("WEIGHTS_0") + 8 * v, 8);
            std::memcpy(joints.data(), binary.data() + start("JOINTS_0") + 4 * v, 4);
            EXPECT_EQ(shares[0] + shares[1] + shares[2] + shares[3], whole_numbers ? 255 : 65535);
            for (std::size_t k = 0; k < 4; ++k) EXPECT_TRUE(shares[k] > 0 || joints[k] == 0);
        }
        // Weights of the face, turn and shift of the head, and nothing that moves the eye a second time
        std::vector<std::string> moved;
        for (const Json& channel : json["animations"][0]["channels"])
            moved.push_back(channel["target"]["path"].get<std::string>() +
                            channel["target"]["node"].dump());
        EXPECT_EQ(moved, (std::vector<std::string>{"weights0", "rotation3", "translation3"}));
        EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
        EXPECT_EQ(json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
        EXPECT_NE(binary.find("\x89PNG not a whole one"), std::string::npos);
    }
}

TEST(MorphModel, WholeNumbersAreWithinHalfAStepAndWhatTheirExtensionAsksFor) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "quads.glb";
    MorphModel model = two_quads();
    model.whole_numbers = true;
    const std::string bytes = glb_bytes(model);
    std::ofstream(file, std::ios::binary) << bytes;
    // 0.5 is the maximum displacement
    const double step = std::max(0.5, model.vertices.topRows(6).cwiseAbs().maxCoeff()) / 32767;
    const MorphModel back = read_glb(file);
    EXPECT_LE((back.vertices - model.vertices.topRows(6)).cwiseAbs().maxCoeff(), 0.501 * step);
    for (std::size_t t = 0; t < 3; ++t) {
        ASSERT_EQ(back.targets[t].vertex, model.targets[t].vertex);
        for (long v = 0; v < model.targets[t].delta.rows(); ++v)
            EXPECT_LE((back.targets[t].delta.row(v) - model.targets[t].delta.row(v))
                          .cwiseAbs()
                          .maxCoeff(),
                      0.501 * step);
    }
    const Json json = chunks(bytes).first;
    EXPECT_EQ(json["extensionsRequired"], Json({"KHR_mesh_quantization"}));
    EXPECT_EQ(json["extensionsUsed"], Json({"KHR_mesh_quantization"}));
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(json["nodes"][0]["scale"][k].get<double>(), step, 1e-12);
    const Json& lift = json["meshes"][0]["primitives"][0]["targets"][0];
    const auto accessor = [&](const char* name) {
        return json["accessors"][lift[name].get<std::size_t>()];
    };
    EXPECT_EQ(accessor("POSITION")["componentType"], 5122);
    EXPECT_FALSE(accessor("POSITION").value("normalized", false));
    EXPECT_EQ(accessor("NORMAL")["componentType"], 5126);
    // Readers that need zeros under sparse accessors do not know the extension.
    EXPECT_FALSE(accessor("POSITION").contains("bufferView"));
    // Attributes lie on four bytes, as the extension asks for: places of 16 bits, normals of 8.
    const Json& base = json["meshes"][0]["primitives"][0]["attributes"];
    for (const char* name : {"POSITION", "NORMAL"}) {
        const Json& of = json["accessors"][base[name].get<std::size_t>()];
        const bool is_place = name == std::string("POSITION");
        EXPECT_EQ(of["componentType"], is_place ? 5122 : 5120) << name;
        EXPECT_EQ(of.value("normalized", false), std::string(name) == "NORMAL") << name;
        EXPECT_EQ(json["bufferViews"][of["bufferView"].get<std::size_t>()]["byteStride"],
                  is_place ? 8 : 4)
            << name;
    }
}

TEST(MorphModel, TargetsThatMoveTheSameVerticesShareTheList) {
    MorphModel model = two_quads();
    model.animations.clear();  // it has weights for three targets
    const std::size_t before = chunks(glb_bytes(model)).first["bufferViews"].size();
    model.targets.push_back(model.targets[0]);
    model.targets.back().name = "again";
    model.targets.back().delta *= -0.5;
    const Json json = chunks(glb_bytes(model)).first;
    const auto indices = [&](std::size_t target) {
        const Json& list = json["meshes"][0]["primitives"][0]["targets"][target]["POSITION"];
        return json["accessors"][list.get<std::size_t>()]["sparse"]["indices"]["bufferView"];
    };
    EXPECT_EQ(indices(0), indices(3));
    EXPECT_GT(json["bufferViews"].size(), before);  // its displacements are its own
}

TEST(MorphModel, IsWhatTheSpecificationOfGlTfAsksFor) {
    MorphModel model = two_quads();
    const auto read = chunks(glb_bytes(model));
    const Json& json = read.first;
    const std::string& binary = read.second;
    // Metres, which any reader understands
    EXPECT_FALSE(json.contains("extensionsRequired"));
    EXPECT_FALSE(json["nodes"][0].contains("scale"));
    EXPECT_EQ(json["asset"]["version"], "2.0");
    const Json& mesh = json["meshes"][0];
    EXPECT_EQ(mesh["extras"]["targetNames"], Json({"lift", "nothing", "push"}));
    EXPECT_EQ(mesh["weights"].size(), 3u);
    EXPECT_EQ(json["buffers"][0]["byteLength"], binary.size());
    for (const Json& view : json["bufferViews"])
        EXPECT_LE(view.value("byteOffset", 0u) + view["byteLength"].get<std::size_t>(),
                  binary.size());
    const auto count = [&](const Json& index) {
        return json["accessors"][index.get<std::size_t>()]["count"].get<int>();
    };
    const std::array<int, 2> vertices{4, 5};  // the seam's vertex occurs twice
    for (std::size_t p = 0; p < 2; ++p) {
        const Json& primitive = mesh["primitives"][p];
        for (const auto& [name, index] : primitive["attributes"].items())
            EXPECT_EQ(count(index), vertices[p]) << name;
        EXPECT_EQ(primitive["targets"].size(), 3u);
        for (const Json& target : primitive["targets"])
            for (const auto& [name, index] : target.items()) {
                EXPECT_EQ(count(index), vertices[p]) << name;
                const Json& accessor = json["accessors"][index.get<std::size_t>()];
                if (name == "POSITION") {
                    EXPECT_EQ(accessor["min"].size(), 3u);
                }
                // Zero except for the listed entries, with zeros under them: Godot 3 needs a view.
                ASSERT_TRUE(accessor.contains("sparse") && accessor.contains("bufferView"));
                const Json& zeros = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
                EXPECT_EQ(zeros["byteStride"], 12);
                EXPECT_GE(zeros["byteLength"].get<int>(), 12 * vertices[p]);
                EXPECT_EQ(binary
                              .substr(zeros.value("byteOffset", 0u),
                                      zeros["byteLength"].get<std::size_t>())
                              .find_first_not_of('\0'),
                          std::string::npos);
            }
    }
    // Only "lift" moves corner 4 of the first quad, and nothing else of it.
    const Json& moved =
        json["accessors"][mesh["primitives"][0]["targets"][0]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(moved["sparse"]["count"], 1);
    EXPECT_EQ(moved["max"][2], 0.25);
    // Linear light: less than half of an sRGB of 0.8.
    EXPECT_NEAR(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(),
                0.6038, 1e-3);
}

constexpr const char* kThree = "/usr/share/javascript/three";  // of Debian's libjs-three

/// What three.js says about a file, in headless Chromium if there is one, else in node; empty without either.
std::string loaded_in_three(const std::filesystem::path& file, const std::string& bytes,
                            const std::filesystem::path& folder) {
    const std::string script = std::string(RISORIUS_SOURCE_DIR) + "/tests/io/load_in_three.js";
    if (std::system("command -v chromium >/dev/null 2>&1") == 0) {
        const std::filesystem::path page = folder / "page.html";
        std::ofstream out(page);
        for (const std::string& source :
             {std::string(kThree) + "/build/three.js",
              std::string(kThree) + "/examples/js/loaders/GLTFLoader.js", script})
            out << "<script src=\"file://" << source << "\"></script>\n";
        out << "<pre id=said></pre><script>const bytes = new Uint8Array([";
        for (const char byte : bytes)
            out << static_cast<int>(static_cast<unsigned char>(byte)) << ',';
        out << "]);\nload(bytes.buffer, (what) => document.getElementById('said').textContent = "
               "'[[[' + JSON.stringify(what) + ']]]');</script>\n";
        out.close();
        const std::string dom =
            run_shell(
                "chromium --headless --no-sandbox --disable-gpu --virtual-time-budget=20000 "
                "--user-data-dir='" +
                (folder / "profile").string() + "' --dump-dom 'file://" + page.string() +
                "' 2>/dev/null")
                .output;
        const std::size_t from = dom.find("[[["), to = dom.find("]]]", from);
        return to == std::string::npos ? "nothing said" : dom.substr(from + 3, to - from - 3);
    }
    if (std::system("command -v node >/dev/null 2>&1") == 0)
        return run_shell("node '" + script + "' " + kThree + " '" + file.string() + "'").output;
    return {};
}

TEST(MorphModel, ThreeJsLoadsItsNamesNumbersAndAnimation) {
    if (!std::filesystem::exists(kThree)) GTEST_SKIP() << "libjs-three is not installed";
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "quads.glb";
    for (const bool whole_numbers : {true, false}) {
        MorphModel model = two_quads();
        model.whole_numbers = whole_numbers;
        const std::string bytes = glb_bytes(model);
        std::ofstream(file, std::ios::binary) << bytes;
        const std::string said = loaded_in_three(file, bytes, folder.path());
        if (said.empty()) GTEST_SKIP() << "neither chromium nor node is installed";
        const Json json = Json::parse(said, nullptr, false);
        ASSERT_TRUE(json.is_object() && json.contains("meshes")) << said;
        ASSERT_EQ(json["meshes"].size(), 2u);
        const std::array<int, 2> vertices{4, 5};
        const double near = whole_numbers ? 3.1e-5 : 1e-5;  // half a step of 2 m
        for (std::size_t p = 0; p < 2; ++p) {
            const Json& mesh = json["meshes"][p];
            EXPECT_EQ(mesh["vertices"], vertices[p]);
            EXPECT_EQ(mesh["names"], Json({"lift", "nothing", "push"}));
            EXPECT_EQ(mesh["normals"], 3);
            EXPECT_NEAR(mesh["largest"]["lift"].get<double>(), p == 0 ? 0.25 : 0.5, near);
            EXPECT_EQ(mesh["largest"]["nothing"], 0);
            EXPECT_NEAR(mesh["largest"]["push"].get<double>(), 0.125, near);
            EXPECT_NEAR(mesh["box"][0][0].get<double>(), p == 0 ? 0 : 1, near);
            EXPECT_NEAR(mesh["box"][1][0].get<double>(), p == 0 ? 1 : 2, near);
        }
        ASSERT_EQ(json["animations"].size(), 1u);
        EXPECT_EQ(json["animations"][0]["name"], "hello");
        EXPECT_NEAR(json["animations"][0]["duration"].get<double>(), 0.02, 1e-6);
        for (const Json& track : json["animations"][0]["tracks"]) {
            EXPECT_NE(track[0].get<std::string>().find("morphTargetInfluences"), std::string::npos);
            EXPECT_EQ(track[1], 2);
            EXPECT_EQ(track[2], 6);
        }
    }
}

TEST(MorphModel, OtherFilesAreRefusedWithWhatIsWrong) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& bytes) {
        const std::filesystem::path file = folder.path() / "other.glb";
        std::ofstream(file, std::ios::binary) << bytes;
        try {
            read_glb(file);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("nothing was thrown");
    };
    EXPECT_NE(message("solid head").find("expected a binary glTF file, found another kind of file"),
              std::string::npos);
    const std::string whole = glb_bytes(two_quads());
    EXPECT_NE(message(whole.substr(0, whole.size() - 40)).find("other.glb: expected"),
              std::string::npos);
    EXPECT_THROW(read_glb(folder.path() / "none.glb"), Error);
}

}  // namespace
}  // namespace risorius::io
