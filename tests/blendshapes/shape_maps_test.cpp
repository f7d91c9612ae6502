// SPDX-License-Identifier: MIT
// Maps of shapes on the texture of the skin: strain as grey, wrinkles as normals.
#include "risorius/blendshapes/detail/shape_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "blendshapes/adult_suite.h"
#include "risorius/media/image_file.h"
#include "temporary_folder.h"

namespace risorius::blendshapes {
namespace {

constexpr int kSide_px = 512;

class ShapeMapsOfAdult : public AdultSuite {
  protected:
    /// A shape that scales the head by a factor along an axis.
    static MadeShape scaled(const std::string& name, long axis, double factor) {
        MadeShape out;
        out.goal.name = name;
        out.goal.drive.excitation = Eigen::VectorXd::Zero(face_->activation().size());
        const Points& rest = face_->head().vertices;
        out.shape.delta = Points::Zero(rest.rows(), 3);
        for (long v = 0; v < rest.rows(); ++v) out.shape.vertex.push_back(static_cast<int>(v));
        out.shape.delta.col(axis) = (factor - 1) * rest.col(axis);
        return out;
    }
    /// Pixels of a square around a landmark.
    static std::vector<Vec3> around(const Image& image, const std::string& landmark, int reach) {
        const Vec3 at = face_->head().landmark(landmark);
        long nearest = 0;
        double least = 1;
        const geom::PolygonMesh& mesh = files_->mesh;
        for (std::size_t c = 0; c < mesh.corner_vertex.size(); ++c) {
            const long v = mesh.corner_vertex[c];
            const double away = (face_->head().vertices.row(v).transpose() - at).norm();
            if (away < least) {
                least = away;
                nearest = static_cast<long>(c);
            }
        }
        const double u = mesh.corner_texcoord(nearest, 0), v = mesh.corner_texcoord(nearest, 1);
        std::vector<Vec3> out;
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const std::uint8_t* pixel = image.pixel(static_cast<int>(u * kSide_px) + x,
                                                        static_cast<int>((1 - v) * kSide_px) + y);
                out.emplace_back(pixel[0], pixel[1], pixel[2]);
            }
        return out;
    }
    static Vec3 deviation(const std::vector<Vec3>& pixels, const Vec3& from) {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& one : pixels) sum += (one - from).cwiseAbs2();
        return (sum / static_cast<double>(pixels.size())).cwiseSqrt();
    }
};

TEST_F(ShapeMapsOfAdult, AreTheStrainAndTheWrinklesOfEachShape) {
    MadeShapes shapes;
    shapes.list = {scaled("short", 1, 0.8), scaled("tall", 1, 1.1), scaled("still", 1, 1.001)};
    const TemporaryFolder folder;
    const MapsReport report =
        write_shape_maps(*files_, *face_, shapes, kSide_px, folder.path(), 2, {});
    ASSERT_EQ(report.shapes.size(), 3u);
    EXPECT_EQ(report.shapes[0].compression, "maps/short_compression.png");
    EXPECT_EQ(report.shapes[0].stretch, "");
    EXPECT_EQ(report.shapes[1].compression, "");
    EXPECT_EQ(report.shapes[1].stretch, "maps/tall_stretch.png");
    for (const std::string& file :
         {report.shapes[2].compression, report.shapes[2].stretch, report.shapes[2].normal})
        EXPECT_EQ(file, "");
    for (const std::string& file : report.files())
        EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
    // The forehead is upright: a fifth shorter is half of the strain at white, a tenth longer a quarter.
    const Image shorter = media::read_png(folder.path() / report.shapes[0].compression),
                longer = media::read_png(folder.path() / report.shapes[1].stretch);
    EXPECT_EQ(shorter.width_px, kSide_px);
    for (const Vec3& grey : around(shorter, "g", 2)) EXPECT_NEAR(grey[0], 127.5, 12);
    for (const Vec3& grey : around(longer, "g", 2)) EXPECT_NEAR(grey[0], 63.75, 8);
    // Its lines lie across the pull: normals nod, and hardly turn aside.
    ASSERT_EQ(report.shapes[0].normal, "maps/short_normal.png");
    const Image normals = media::read_png(folder.path() / report.shapes[0].normal);
    const Vec3 nods = deviation(around(normals, "tr", 20), Vec3(128, 128, 255));
    EXPECT_GT(nods[1], 8);
    EXPECT_LT(nods[0], 0.5 * nods[1]);
    for (const Vec3& pixel : around(normals, "tr", 20))
        EXPECT_NEAR((pixel / 127.5 - Vec3::Ones()).norm(), 1, 0.02);
}

TEST_F(ShapeMapsOfAdult, OfAShapeOnTopOfAnotherAreItsOwn) {
    MadeShapes shapes;
    shapes.list = {scaled("short", 1, 0.8), scaled("no change", 1, 1.0)};
    shapes.list[1].goal.on_top_of = 0;
    const TemporaryFolder folder;
    const MapsReport report =
        write_shape_maps(*files_, *face_, shapes, kSide_px, folder.path(), 1, {});
    EXPECT_NE(report.shapes[0].normal, "");
    EXPECT_EQ(report.shapes[1].compression, "");
    EXPECT_EQ(report.shapes[1].normal, "");
    EXPECT_EQ(report.json()["shapes"][1]["normal"], nullptr);
}

}  // namespace
}  // namespace risorius::blendshapes
