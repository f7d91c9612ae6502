// SPDX-License-Identifier: MIT
// A scanned head, where there is one: what the round head of the other tests cannot tell.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "paths.h"
#include "risorius/core/json_cursor.h"
#include "risorius/render/offscreen_view.h"

namespace risorius::render {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(RISORIUS_SHARED_DIR) / "data/heads/ict";

struct MeasuredHead {
    Scene scene;
    Points jaw_open;  ///< displacement, m
};

/// Polygons by region of ict_regions.csv, pitched by 6.61 degrees into the head frame, cm to m.
MeasuredHead read_head() {
    MeasuredHead head;
    std::vector<Vec3> vertices;
    std::vector<std::vector<int>> faces;
    std::ifstream mesh(kFolder / "ict_neutral.obj");
    for (std::string line; std::getline(mesh, line);) {
        std::istringstream words(line);
        std::string key, corner;
        words >> key;
        if (key == "v") {
            Vec3 p;
            words >> p.x() >> p.y() >> p.z();
            vertices.push_back(p);
        } else if (key == "f") {
            faces.emplace_back();
            while (words >> corner) faces.back().push_back(std::stoi(corner) - 1);
        }
    }
    const Mat3 pitch =
        Eigen::AngleAxisd(6.61 * std::numbers::pi / 180, Vec3::UnitX()).toRotationMatrix();
    const JsonCursor marks = JsonCursor::read_file(kFolder / "landmarks.json").at("landmarks");
    const auto vertex = [&](const std::string& id) {
        return static_cast<std::size_t>(marks.at(id).at("vertex").integer(0, 1000000));
    };
    const Vec3 origin = pitch * (vertices[vertex("t_l")] + vertices[vertex("t_r")]) / 2;
    Scene& scene = head.scene;
    scene.rest.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        scene.rest.row(static_cast<Eigen::Index>(v)) =
            0.01 * (pitch * vertices[v] - origin).transpose();
    for (const std::string& id : marks.keys())
        scene.landmarks[id] = scene.rest.row(static_cast<Eigen::Index>(vertex(id))).transpose();

    const std::map<std::string, std::pair<Material, int>> materials{
        {"face", {Material::kSkin, -1}},          {"head_neck", {Material::kSkin, -1}},
        {"mouth_socket", {Material::kMouth, -1}}, {"eye_socket_l", {Material::kSkin, -1}},
        {"eye_socket_r", {Material::kSkin, -1}},  {"gums_tongue", {Material::kGums, -1}},
        {"teeth", {Material::kTeeth, -1}},        {"eyeball_l", {Material::kEye, 0}},
        {"eyeball_r", {Material::kEye, 1}},       {"lashes_l", {Material::kLashes, -1}},
        {"lashes_r", {Material::kLashes, -1}}};
    std::ifstream regions(kFolder / "ict_regions.csv");
    std::string line;
    std::getline(regions, line);
    while (std::getline(regions, line)) {
        std::array<std::string, 5> cell;
        std::istringstream cells(line);
        for (std::string& c : cell) std::getline(cells, c, ',');
        const auto material = materials.find(cell[0]);
        if (material == materials.end()) continue;
        std::vector<std::array<int, 3>> triangles;
        for (int f = std::stoi(cell[3]); f <= std::stoi(cell[4]); ++f) {
            const std::vector<int>& face = faces[static_cast<std::size_t>(f)];
            for (std::size_t k = 1; k + 1 < face.size(); ++k)
                triangles.push_back({face[0], face[k], face[k + 1]});
        }
        Surface surface;
        surface.material = material->second.first;
        surface.eye = material->second.second;
        surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
        for (std::size_t f = 0; f < triangles.size(); ++f)
            for (int k = 0; k < 3; ++k)
                surface.triangles(static_cast<Eigen::Index>(f), k) =
                    triangles[f][static_cast<std::size_t>(k)];
        if (surface.eye >= 0) {
            Eye& eye = scene.eyes[static_cast<std::size_t>(surface.eye)];
            const auto ball = scene.rest.middleRows(std::stoi(cell[1]),
                                                    std::stoi(cell[2]) - std::stoi(cell[1]) + 1);
            const Vec3 low = ball.colwise().minCoeff(), high = ball.colwise().maxCoeff();
            eye.radius_m = (high.x() - low.x()) / 2;
            eye.centre = {(low.x() + high.x()) / 2, (low.y() + high.y()) / 2,
                          low.z() + eye.radius_m};
            eye.forward = pitch * Vec3::UnitZ();
        }
        scene.surfaces.push_back(surface);
    }

    // Shape 26 of ict_expr53.f32 is jawOpen.
    std::ifstream shapes(kFolder / "ict_expr53.f32", std::ios::binary);
    std::vector<float> displacement(3 * vertices.size());
    const auto bytes = static_cast<std::streamsize>(displacement.size() * sizeof(float));
    shapes.seekg(26 * bytes);
    shapes.read(reinterpret_cast<char*>(displacement.data()), bytes);
    head.jaw_open.resize(scene.rest.rows(), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        head.jaw_open.row(static_cast<Eigen::Index>(v)) =
            0.01 *
            (pitch * Vec3(displacement[3 * v], displacement[3 * v + 1], displacement[3 * v + 2]))
                .transpose();
    return head;
}

class MeasuredHeadTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(kFolder / "ict_neutral.obj"))
            GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
        head_ = read_head();
        pose_.positions = head_.scene.rest;
    }

    std::array<double, 3> mean_colour(const Image& image, const OffscreenView& view, const Vec3& at,
                                      int reach) const {
        const Vec2 px = view.project(at);
        std::array<double, 3> sum{0, 0, 0};
        for (int dy = -reach; dy <= reach; ++dy)
            for (int dx = -reach; dx <= reach; ++dx)
                for (std::size_t k = 0; k < 3; ++k)
                    sum[k] += image.pixel(static_cast<int>(px.x()) + dx,
                                          static_cast<int>(px.y()) + dy)[k];
        for (double& s : sum) s /= (2 * reach + 1) * (2 * reach + 1);
        return sum;
    }

    MeasuredHead head_;
    Pose pose_;
};

TEST_F(MeasuredHeadTest, HasRedLipsDarkNostrilsAndBrowsDarkerThanTheForehead) {
    OffscreenView view(head_.scene, {.width_px = 512, .height_px = 512});
    const Image image = view.draw(pose_);
    const auto& marks = head_.scene.landmarks;
    const auto at = [&](const Vec3& p, int reach) { return mean_colour(image, view, p, reach); };
    const auto lip = at((marks.at("li") + marks.at("sto")) / 2, 2), cheek = at(marks.at("mc_r"), 3);
    EXPECT_GT(lip[0] / lip[1], 1.1 * cheek[0] / cheek[1]);
    const auto brow = at(marks.at("bc_r"), 2), forehead = at(marks.at("fml_r"), 3);
    EXPECT_LT(brow[1], 0.75 * forehead[1]);
    // The nostril opens somewhere above the base of the wing.
    double darkest = 255;
    for (double up = 0; up < 0.010; up += 0.0005)
        darkest = std::min(darkest, at(marks.at("sbal_r") + Vec3(0.001, up, 0), 0)[1]);
    EXPECT_LT(darkest, 0.4 * cheek[1]);
}

TEST_F(MeasuredHeadTest, LipsTuckIntoShadeAtTheCornersOfTheMouth) {
    OffscreenView view(head_.scene, {.width_px = 512, .height_px = 512});
    const Image image = view.draw(pose_);
    const Vec3 corner = head_.scene.landmarks.at("ch_r");
    const auto beside = mean_colour(image, view, corner + Vec3(-0.0015, 0, 0), 1),
               farther = mean_colour(image, view, corner + Vec3(-0.010, 0, 0), 1);
    // In shade, but without a smudge
    EXPECT_LT(beside[1], 0.80 * farther[1]);
    EXPECT_GT(beside[1], 0.70 * farther[1]);
}

TEST_F(MeasuredHeadTest, ShowsItsMouthDarkWhenTheJawOpens) {
    OffscreenView view(head_.scene, {.width_px = 512, .height_px = 512});
    const Vec3 gap = head_.scene.landmarks.at("sto") + Vec3(0, -0.012, 0);
    const auto closed = mean_colour(view.draw(pose_), view, gap, 2);
    pose_.positions += head_.jaw_open;
    pose_.jaw_open = 1.0;
    const auto open = mean_colour(view.draw(pose_), view, gap, 2);
    EXPECT_LT(open[0], 0.75 * closed[0]);
    EXPECT_GT(open[0], 0.5 * closed[0]);  // mucosa that reads, not a black hole
    EXPECT_GT(open[0], 1.3 * open[1]);
}

TEST_F(MeasuredHeadTest, FillsThePictureFromCrownToChin) {
    for (const char* camera :
         {"front", "three_quarter", "three_quarter_right", "profile", "profile_right"}) {
        OffscreenView view(head_.scene, {.width_px = 512, .height_px = 512, .camera = camera});
        const double height = view.project(head_.scene.landmarks.at("me")).y() -
                              view.project(head_.scene.landmarks.at("v")).y();
        EXPECT_GT(height, 0.6 * 512) << camera;
        EXPECT_LT(height, 0.9 * 512) << camera;
    }
}

TEST_F(MeasuredHeadTest, CloseUpsAndTheViewFromAboveShowWhatTheyAreNamedAfter) {
    std::map<std::string, OffscreenView> views;  // by camera
    const auto shown = [&](const char* camera, const char* landmark) {
        if (!views.contains(camera))
            views.emplace(
                std::piecewise_construct, std::forward_as_tuple(camera),
                std::forward_as_tuple(
                    head_.scene, ViewOptions{.width_px = 64, .height_px = 64, .camera = camera}));
        return views.at(camera).project(head_.scene.landmarks.at(landmark));
    };
    for (const auto& [camera, landmarks] : {std::pair("eye", std::array{"en_l", "ex_l"}),
                                            {"nose", std::array{"prn", "sn"}},
                                            {"mouth", std::array{"sto", "sto"}},
                                            {"ear", std::array{"sa_l", "sba_l"}}}) {
        const Vec2 middle = (shown(camera, landmarks[0]) + shown(camera, landmarks[1])) / 2;
        EXPECT_LT((middle - Vec2(32, 32)).norm(), 2) << camera;
    }
    const double wide = (shown("eye", "en_l") - shown("eye", "ex_l")).norm();
    EXPECT_GT(wide, 0.35 * 64);
    EXPECT_LT(wide, 0.75 * 64);
    // From above the nose points down in the picture, and left is on the right
    EXPECT_GT(shown("top", "prn").y(), shown("top", "op").y() + 30);
    EXPECT_GT(shown("top", "t_l").x(), shown("top", "t_r").x() + 20);
}

}  // namespace
}  // namespace risorius::render
