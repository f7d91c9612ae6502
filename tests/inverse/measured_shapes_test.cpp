// SPDX-License-Identifier: MIT
// Measured shapes: what belongs together is put together, in metres of the head frame, and a mistake in the file is told with its place.
#include "risorius/inverse/measured_shapes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "risorius/core/error.h"
#include "temporary_folder.h"

namespace risorius::inverse {
namespace {

namespace fs = std::filesystem;

const rig::RigDescription& adult() {
    static const rig::RigDescription kRig =
        rig::read_rig(fs::path(RISORIUS_SOURCE_DIR) / "rigs/adult/rig.json");
    return kRig;
}

/// Two vertices, in millimetres, turned by a quarter about z.
rig::Head small_head() {
    rig::Head head;
    head.vertices = Points::Zero(2, 3);
    head.frame.metres_per_unit = 1e-3;
    head.frame.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return head;
}

class MeasuredShapes : public testing::Test {
  protected:
    Json json(const std::vector<std::string>& names) const {
        Json out;
        out["shape"] = {names.size(), 2, 3};
        out["dtype"] = "<f4";
        out["layout"] = "[shape][vertex][xyz]";
        out["names"] = names;
        return out;
    }
    /// Shape s moves vertex v by (s + 1, 10 v, 0) of its units, unless other numbers are given.
    std::vector<MeasuredShape> read(const Json& description,
                                    const MeasuredShapesOptions& options = {},
                                    std::vector<float> numbers = {}) const {
        if (numbers.empty())
            for (std::size_t s = 0; s < description["names"].size(); ++s)
                for (int v = 0; v < 2; ++v)
                    for (const double x : {s + 1.0, 10.0 * v, 0.0})
                        numbers.push_back(static_cast<float>(x));
        std::ofstream(file()) << description.dump();
        std::ofstream(folder_ / "x.f32", std::ios::binary)
            .write(reinterpret_cast<const char*>(numbers.data()),
                   static_cast<std::streamsize>(numbers.size() * sizeof(float)));
        return read_measured_shapes(file(), options, adult(), small_head());
    }
    /// The message, with the folder taken out.
    std::string complaint(const Json& description, const MeasuredShapesOptions& options = {},
                          const std::vector<float>& numbers = {}) const {
        try {
            read(description, options, numbers);
        } catch (const Error& error) {
            std::string text = error.what();
            const std::string here = folder_.path().string() + "/";
            for (std::size_t at = text.find(here); at != std::string::npos; at = text.find(here))
                text.erase(at, here.size());
            return text;
        }
        return "accepted";
    }
    fs::path file() const { return folder_ / "x.json"; }
    static double of(const MeasuredShape& shape, const std::string& muscle, Side side) {
        return shape.drive.excitation[adult().channels().column(muscle, side)];
    }
    TemporaryFolder folder_;
};

TEST_F(MeasuredShapes, AreTurnedIntoTheHeadFrameAndIntoMetres) {
    const auto shapes = read(json({"jawOpen"}));
    ASSERT_EQ(shapes.size(), 1u);
    // (1, 10, 0) mm of the mesh is (-10, 1, 0) of the head
    EXPECT_LT((shapes[0].displacement.row(1).transpose() - Vec3(-0.010, 0.001, 0)).norm(), 1e-9);
    Json in_centimetres = json({"jawOpen"});
    in_centimetres["units_per_metre"] = 100;
    EXPECT_LT(
        (read(in_centimetres)[0].displacement.row(1).transpose() - Vec3(-0.10, 0.01, 0)).norm(),
        1e-8);
}

TEST_F(MeasuredShapes, LeftAndRightBecomeOne) {
    for (const auto& [left, right] :
         {std::pair{"mouthSmile_L", "mouthSmile_R"}, {"mouthSmileLeft", "mouthSmileRight"}}) {
        const auto shapes = read(json({"jawOpen", left, right}));
        ASSERT_EQ(shapes.size(), 2u);
        EXPECT_EQ(shapes[1].name, "mouthSmile");
        EXPECT_FALSE(shapes[1].sided);
        EXPECT_NEAR(shapes[1].displacement(0, 1), 0.005, 1e-9);  // 2 + 3 mm
        EXPECT_GT(of(shapes[1], "zygomaticus_major", Side::kLeft), 0.1);
        EXPECT_EQ(of(shapes[1], "zygomaticus_major", Side::kLeft),
                  of(shapes[1], "zygomaticus_major", Side::kRight));
    }
}

TEST_F(MeasuredShapes, ApartTheyStayTwo) {
    const auto shapes = read(json({"mouthSmile_L", "mouthSmile_R"}), {.separate_sides = true});
    ASSERT_EQ(shapes.size(), 2u);
    EXPECT_TRUE(shapes[0].sided);
    EXPECT_GT(of(shapes[0], "zygomaticus_major", Side::kLeft), 0.1);
    EXPECT_EQ(of(shapes[0], "zygomaticus_major", Side::kRight), 0);
}

TEST_F(MeasuredShapes, DirectionsAreNotHalves) {
    const auto shapes = read(json({"mouthLeft", "mouthRight", "jawLeft", "jawRight"}));
    ASSERT_EQ(shapes.size(), 4u);
    EXPECT_EQ(shapes[1].name, "mouthRight");
}

TEST_F(MeasuredShapes, AShapeOnTopOfAnotherIsAddedToIt) {
    const auto close = read(json({"jawOpen", "mouthClose"}));
    EXPECT_NEAR(close[1].displacement(0, 1), 0.003, 1e-9);  // 2 + 1 mm
    EXPECT_GT(close[1].drive.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)], 0);
    Json described = json({"jawOpen", "noseSneer_L", "noseSneer_R"});
    described["on_top_of"] = {{"noseSneer", "jawOpen"}};
    EXPECT_NEAR(read(described)[1].displacement(0, 1), 0.006, 1e-9);
}

TEST_F(MeasuredShapes, ExcitationsOfTheFileComeFirst) {
    Json described = json({"jawOpen", "grin_L", "grin_R"});
    described["excitations"] = {{"jawOpen", {{"jaw_open", 0.25}, {"AU12", 0.5}}},
                                {"grin", {{"risorius.l", 0.75}}}};
    const auto shapes = read(described);
    EXPECT_EQ(shapes[0].drive.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)],
              0.25);
    EXPECT_GT(of(shapes[0], "zygomaticus_major", Side::kRight), 0.1);
    EXPECT_EQ(shapes[1].name, "grin");
    EXPECT_EQ(of(shapes[1], "risorius", Side::kLeft), 0.75);
    EXPECT_EQ(of(shapes[1], "risorius", Side::kRight), 0);
}

TEST_F(MeasuredShapes, OnlyTheNamedOnesAreRead) {
    // "grin" has no activations, and is not asked for
    const auto shapes =
        read(json({"grin", "mouthSmile_L", "mouthSmile_R"}), {.only = {"mouthSmile"}});
    ASSERT_EQ(shapes.size(), 1u);
    EXPECT_EQ(complaint(json({"mouthSmile_L", "mouthSmile_R"}), {.only = {"mouthSmil"}}),
              "only: expected names of shapes in x.json (did you mean \"mouthSmile\"?), found "
              "\"mouthSmil\"");
}

TEST_F(MeasuredShapes, OfAnotherMeshAreRefused) {
    Json described = json({"jawOpen"});
    described["shape"] = {1, 3, 3};
    EXPECT_EQ(complaint(described),
              "x.json:/shape/1: expected the 2 vertices of the rig's mesh, found 3");
}

TEST_F(MeasuredShapes, ATruncatedFileIsRefused) {
    EXPECT_EQ(complaint(json({"jawOpen"}), {}, {1, 2, 3, 4, 5}),
              "x.f32: expected 24 bytes, as \"shape\" says, found 20");
    std::ofstream(file()) << json({"jawOpen"}).dump();
    fs::remove(folder_ / "x.f32");
    EXPECT_THROW(read_measured_shapes(file(), {}, adult(), small_head()), Error);
}

TEST_F(MeasuredShapes, NumbersThatAreNoneAreRefused) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(
        complaint(json({"jawOpen", "noseSneer_L"}), {}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, nan, 0}),
        "x.f32: \"noseSneer_L\", vertex 1: expected finite numbers, found NaN");
    EXPECT_EQ(complaint(json({"jawOpen"}), {}, {0, 0, 1 / 0.0F, 0, 0, 0}),
              "x.f32: \"jawOpen\", vertex 0: expected finite numbers, found infinity");
}

TEST_F(MeasuredShapes, ANameThatNothingKnowsIsRefused) {
    EXPECT_EQ(
        complaint(json({"jawOpen", "jawOpne"})),
        "x.json:/names/1: expected an ARKit shape, action unit or expression of the rig (did "
        "you mean \"jawOpen\"?), or its activations under \"excitations\", found \"jawOpne\"");
    EXPECT_EQ(complaint(json({"jawOpen", "jawOpen"})),
              "x.json:/names/1: expected each name once, found \"jawOpen\"");
    EXPECT_EQ(complaint(json({"gaze_yaw_deg"})),
              "x.json:/names/0: expected an ARKit shape, action unit or expression of the rig, or "
              "its activations under \"excitations\", found \"gaze_yaw_deg\"");
}

TEST_F(MeasuredShapes, MistakenExcitationsAreRefused) {
    Json described = json({"jawOpen"});
    described["excitations"] = {{"jawOpen", {{"zygomaticus_mayor", 1}}}};
    EXPECT_EQ(
        complaint(described),
        "x.json:/excitations/jawOpen/zygomaticus_mayor: expected a muscle of the rig (did you "
        "mean \"zygomaticus_major\"?), found \"zygomaticus_mayor\"");
    described["excitations"] = {{"jawOpen", {{"zygomaticus_major", 1.5}}}};
    EXPECT_EQ(complaint(described),
              "x.json:/excitations/jawOpen/zygomaticus_major: expected [0, 1], found 1.5");
    described["excitations"] = {{"jawOpne", {{"zygomaticus_major", 1}}}};
    EXPECT_EQ(complaint(described),
              "x.json:/excitations/jawOpne: expected one of the \"names\" (did you mean "
              "\"jawOpen\"?), found \"jawOpne\"");
    described.erase("excitations");
    described["on_top_of"] = {{"jawOpen", "nothing"}};
    EXPECT_EQ(complaint(described),
              "x.json:/on_top_of/jawOpen: expected one of the \"names\", found \"nothing\"");
    described.erase("on_top_of");
    described["excitation"] = Json::object();
    EXPECT_EQ(complaint(described),
              "x.json:/excitation: expected a known key (did you mean \"excitations\"?), found "
              "unknown key "
              "\"excitation\"");
}

}  // namespace
}  // namespace risorius::inverse
