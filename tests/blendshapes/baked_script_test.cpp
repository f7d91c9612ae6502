// SPDX-License-Identifier: MIT
// A script in the files of blend shapes: the glTF animation and the vertex cache are the same motion, and every weight is one that
// other programs take.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "paths.h"
#include "risorius/blendshapes/bake_shapes.h"
#include "risorius/core/read_file.h"
#include "risorius/face/face.h"
#include "risorius/face/surfaces.h"
#include "risorius/io/morph_model.h"
#include "shell.h"
#include "temporary_folder.h"

namespace risorius::blendshapes {
namespace {

namespace fs = std::filesystem;

const fs::path kRigOfScript = fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json";

/// The displacements of a cache from the mesh at rest, one list of vertices a frame: head frame, m.
std::vector<Points> cached(const fs::path& file, const scene::RigFiles& files,
                           const rig::Head& head) {
    const std::string bytes = read_file(file, {"a cache", 500 * kMegabyte});
    std::vector<float> numbers(bytes.size() / sizeof(float));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(float));
    const long count = head.vertices.rows();
    std::vector<Points> out;
    for (std::size_t at = 0; at + 1 < numbers.size(); at += 3 * static_cast<std::size_t>(count)) {
        Points& moved = out.emplace_back(count, 3);
        for (long v = 0; v < count; ++v) {
            Vec3 by;
            for (long k = 0; k < 3; ++k)
                by[k] = static_cast<double>(numbers[at + static_cast<std::size_t>(3 * v + k)]) -
                        files.mesh.positions(v, k);
            moved.row(v) = (head.frame.metres_per_unit * (head.frame.rotation * by)).transpose();
        }
    }
    return out;
}

/// Largest distance in m of the glTF animation, played with its own weights alone, from a cache.
double farthest_m(const io::MorphModel& model, const std::vector<Points>& cache) {
    const io::MorphAnimation& animation = model.animations.at(0);
    double worst = 0;
    for (long f = 0; f < animation.weights.rows(); ++f) {
        Points moved = Points::Zero(model.vertices.rows(), 3);
        for (std::size_t t = 0; t < model.targets.size(); ++t)
            for (std::size_t i = 0; i < model.targets[t].vertex.size(); ++i)
                moved.row(model.targets[t].vertex[i]) +=
                    static_cast<double>(animation.weights(f, static_cast<long>(t))) *
                    model.targets[t].delta.row(static_cast<long>(i));
        worst = std::max(
            worst, (moved - cache.at(static_cast<std::size_t>(f))).rowwise().norm().maxCoeff());
    }
    return worst;
}

/// What the add-on makes of a face in Blender; null where it is not installed.
Json played_in_blender(const fs::path& glb, const fs::path& out) {
    if (std::system("command -v blender >/dev/null 2>&1") != 0) return {};
    const fs::path source = RISORIUS_SOURCE_DIR;
    const ShellResult said =
        run_shell("blender -b --factory-startup --python '" +
                  (source / "tests/io/play_in_blender.py").string() + "' -- '" +
                  (source / "tools/blender/risorius_faces.py").string() + "' '" + glb.string() +
                  "' '" + out.string() + "' 2>&1");
    EXPECT_TRUE(fs::exists(out)) << said.output;
    EXPECT_EQ(said.output.find("Error"), std::string::npos) << said.output;
    return Json::parse(std::ifstream(out), nullptr, false);
}

// Correctives are driven by the rule in the file, not by its keys, and the face is the one of the cache.
void expect_same_in_blender(const Json& blender, const io::MorphModel& model,
                            const std::vector<Points>& cache) {
    ASSERT_TRUE(blender.is_object());
    EXPECT_EQ(blender["fps"], 20);
    EXPECT_EQ(blender["last_frame"], 7);
    EXPECT_EQ(blender["note"], "");
    EXPECT_TRUE(blender["whole_frames"].get<bool>());
    EXPECT_GT(blender["drivers"].get<int>(), 0);
    for (const char* name :
         {"Face", "EyeLeft", "EyeRight", "TeethUpper", "TeethLower", "Tongue", "Lashes"}) {
        ASSERT_TRUE(blender["meshes"].contains(name)) << name << " of " << blender["meshes"].dump();
        EXPECT_EQ(blender["meshes"][name]["scale"], Json({1, 1, 1})) << name;
    }
    EXPECT_GE(blender["least_value"].get<double>(), 0);
    EXPECT_LE(blender["greatest_value"].get<double>(), 1);
    EXPECT_EQ(blender["pictures"], 6);
    EXPECT_EQ(blender["pictures_in_srgb"], 6);
    for (const auto& [name, has_picture] : blender["materials"].items())
        EXPECT_TRUE(has_picture.get<bool>()) << name;
    const std::array<double, 3> size{0.2640, 0.2410, 0.3073};
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(blender["meshes"]["Face"]["size_m"][k].get<double>(), size[k], 1e-4);
    ASSERT_EQ(blender["points"].size(), cache.size());
    const std::vector<int> vertices = blender["vertices"];
    double worst = 0;
    for (std::size_t f = 0; f < cache.size(); ++f) {
        ASSERT_EQ(blender["points"][f].size(), vertices.size());
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const Json& at = blender["points"][f][i];
            const Vec3 there(at[0].get<double>(), at[1].get<double>(), at[2].get<double>());
            worst = std::max(worst, (there - model.vertices.row(vertices[i]).transpose() -
                                     cache[f].row(vertices[i]).transpose())
                                        .norm());
        }
    }
    EXPECT_LT(worst, 0.01e-3);
    // The script that is baked back has the curves of the shapes, and is read back as they are.
    const Json& script = blender["script"];
    EXPECT_TRUE(script["channels"].contains("jawOpen")) << script.dump();
    EXPECT_EQ(script["fps"], 20);
    for (const auto& [name, channel] : script["channels"].items()) {
        EXPECT_FALSE(name.starts_with("corrective")) << name;
        EXPECT_NEAR(channel["keys"].back()[1].get<double>(),
                    blender["weights"].back()[name].get<double>(), 1e-4);
        EXPECT_NEAR(blender["weights_of_script"][name].get<double>(),
                    blender["weights"].back()[name].get<double>(), 1e-4);
    }
}

constexpr const char* kThreeOfDebian = "/usr/share/javascript/three";

/// What three.js in headless Chromium draws of a face with the jaw open; null where either is not installed.
Json drawn_in_three(const fs::path& glb, const fs::path& folder) {
    if (!fs::exists(kThreeOfDebian) || std::system("command -v chromium >/dev/null 2>&1") != 0)
        return {};
    const fs::path page = folder / "page.html";
    {
        std::ofstream out(page);
        for (const std::string& source :
             {std::string(kThreeOfDebian) + "/build/three.js",
              std::string(kThreeOfDebian) + "/examples/js/loaders/GLTFLoader.js",
              std::string(RISORIUS_SOURCE_DIR) + "/tests/io/draw_in_three.js"})
            out << "<script src=\"file://" << source << "\"></script>\n";
        out << "<body><pre id=said></pre><script>const bytes = new Uint8Array([";
        for (const char byte : read_file(glb, {"a face", 100 * kMegabyte}))
            out << static_cast<int>(static_cast<unsigned char>(byte)) << ',';
        out << "]);\ndrawMouth(bytes.buffer, 256, (what) => "
               "document.getElementById('said').textContent = "
               "'[[[' + JSON.stringify(what) + ']]]');</script></body>\n";
    }
    const std::string dom = run_shell(
                                "chromium --headless --no-sandbox --use-angle=swiftshader "
                                "--enable-unsafe-swiftshader --allow-file-access-from-files "
                                "--virtual-time-budget=60000 --user-data-dir='" +
                                (folder / "profile").string() + "' --dump-dom 'file://" +
                                page.string() + "' 2>/dev/null")
                                .output;
    const std::size_t from = dom.find("[[["), to = dom.find("]]]", from);
    EXPECT_NE(to, std::string::npos)
        << dom.substr(dom.size() - std::min<std::size_t>(500, dom.size()));
    if (to == std::string::npos) return {};
    return Json::parse(dom.substr(from + 3, to - from - 3), nullptr, false);
}

// Programs that light the mouth as they light the face must show it dark, too.
void expect_dark_mouth_in_three(const Json& three) {
    ASSERT_TRUE(three.is_object() && three.contains("mouth")) << three.dump().substr(0, 500);
    const Json& mouth = three["mouth"];
    EXPECT_GT(mouth["pixels"][0].get<int>(), 300);
    EXPECT_GT(mouth["pixels"][1].get<int>(), 300);
    EXPECT_GT(mouth["lips"].get<double>(), 40);
    EXPECT_LT(mouth["inside"].get<double>(), 0.5 * mouth["lips"].get<double>());
    EXPECT_EQ(three["names"], Json({"Face", "LeftEye"}));
    EXPECT_EQ(three["withMap"], three["meshes"]);
    EXPECT_LE(three["calls"].get<int>(), 13);
}

// The smile and the open mouth overlap, so that there is a corrective with a weight.
TEST(BakedScript, TheAnimationHasWeightsFromZeroToOneAndIsTheCache) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "script.json") << R"({"format": "risorius-script", "version": 1,
        "rig": ")" << kRigOfScript.generic_string()
                                                 << R"(", "fps": 20, "duration_s": 0.4,
        "channels": {"AU12": {"keys": [[0, 0], [0.1, 1]]}, "jaw_open": {"keys": [[0, 0], [0.3, 1]]},
                     "head_yaw_deg": {"keys": [[0, 0], [0.3, 20]]}}})";
    ShapesOptions options{.rig = kRigOfScript,
                          .out = folder.path() / "shapes",
                          .only = {"mouthSmile", "jawOpen"},
                          .formats = {"glb", "cache", "csv"},
                          .pictures = false,
                          .pairs = 1,
                          .test_frames = 0,
                          .script = folder.path() / "script.json",
                          .threads = 2};
    options.texture_px = 256;
    const ShapesReport report = bake_shapes(options);
    const io::MorphModel model = io::read_glb(options.out / "shapes.glb");
    ASSERT_EQ(model.animations.size(), 1u);
    const Eigen::MatrixXf& weights = model.animations[0].weights;
    EXPECT_EQ(weights.rows(), 8);
    EXPECT_GE(weights.minCoeff(), 0.f);
    EXPECT_LE(weights.maxCoeff(), 1.f);
    EXPECT_GT(weights.rightCols(weights.cols() - 3).maxCoeff(), 0.1f);  // of the correctives
    const scene::RigFiles files = scene::read_rig_files(kRigOfScript);
    const face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    const std::vector<Points> cache = cached(options.out / "cache.f32", files, face.head());
    ASSERT_EQ(cache.size(), 8u);
    ASSERT_EQ(model.vertices.rows(), face.head().vertices.rows());
    EXPECT_LT(farthest_m(model, cache), 0.01e-3);
    EXPECT_GT(cache[7].rowwise().norm().maxCoeff(), 3e-3);
    if (const Json blender =
            played_in_blender(options.out / "shapes.glb", folder.path() / "blender.json");
        !blender.is_null())
        expect_same_in_blender(blender, model, cache);
    if (const Json three = drawn_in_three(options.out / "shapes.glb", folder.path());
        !three.is_null())
        expect_dark_mouth_in_three(three);
    for (const MadeShape& made : report.shapes.list)
        EXPECT_LT(made.certificate.rigid_part_m, 0.1e-3) << made.goal.name;

    // With the turn of the head the cache is what the pose of a video is.
    options.out = folder.path() / "turned";
    options.head_turns = true;
    options.correctives = false;
    options.formats = {"cache"};
    bake_shapes(options);
    const std::vector<Points> turned = cached(options.out / "cache.f32", files, face.head());
    const std::vector<double>& share = face.surfaces().head_fractions();
    const Vec3 pivot = face.surfaces().head_pivot();
    const Mat3 yaw(Eigen::AngleAxisd(20 * 3.14159265358979 / 180, Vec3::UnitY()));
    double top = 0;
    int compared = 0;
    for (long v = 0; v < model.vertices.rows(); ++v) {
        if (share[static_cast<std::size_t>(v)] < 1 || model.vertices(v, 1) < 0.08) continue;
        const Vec3 at = face.head().vertices.row(v), to = pivot + yaw * (at - pivot);
        top = std::max(top, (turned.at(7).row(v).transpose() - (to - at)).norm());
        ++compared;
    }
    EXPECT_GT(compared, 100);
    EXPECT_LT(top, 0.1e-3);
}

}  // namespace
}  // namespace risorius::blendshapes
