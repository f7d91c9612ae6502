// SPDX-License-Identifier: MIT
// Levels of detail keep the shapes: vertices that stay move as before, and what was left out is near them.
#include "risorius/io/coarser_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace risorius::io {
namespace {

constexpr int kSide = 21;

/// A sheet of 10 cm with two parts that meet in the middle, and a shape that bulges it.
MorphModel sheet() {
    MorphModel model;
    model.name = "sheet";
    model.vertices.resize(kSide * kSide, 3);
    MorphTarget bulge{"bulge", {}, Points(kSide * kSide, 3)};
    std::vector<int> corners[2];
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const int v = i * kSide + j;
            const double x = 0.1 * i / (kSide - 1), y = 0.1 * j / (kSide - 1);
            model.vertices.row(v) << x, y, 0;
            bulge.vertex.push_back(v);
            bulge.delta.row(v) << 0, 0, 0.01 * std::sin(31.4159 * x) * std::sin(31.4159 * y);
            if (i + 1 < kSide && j + 1 < kSide)
                for (const int corner : {v, v + kSide, v + kSide + 1, v, v + kSide + 1, v + 1})
                    corners[2 * i >= kSide - 1].push_back(corner);
        }
    for (std::vector<int>& list : corners) {
        MorphPart part;
        part.triangles = Eigen::Map<Triangles>(list.data(), static_cast<long>(list.size()) / 3, 3);
        part.texcoords.resize(static_cast<long>(list.size()), 2);
        for (long c = 0; c < part.texcoords.rows(); ++c)
            part.texcoords.row(c) =
                10 * model.vertices.row(list[static_cast<std::size_t>(c)]).head<2>();
        model.parts.push_back(part);
    }
    model.targets = {bulge};
    return model;
}

TEST(CoarserModel, HasFewerTrianglesAndTheSameShapes) {
    const MorphModel fine = sheet();
    const MorphModel coarse = coarser_model(fine, 0.5);
    const LevelError error = level_error(fine, coarse);
    EXPECT_LT(error.triangles, 560);
    EXPECT_GT(error.triangles, 200);
    EXPECT_LT(error.surface_m, 1e-6);  // the sheet is flat
    // Known by the bulge: between vertices that are some cells apart it bends by less
    EXPECT_GT(error.shape_max_m, 1e-5);
    EXPECT_LT(error.shape_max_m, 5e-3);
    EXPECT_LT(error.shape_rms_m, error.shape_max_m);
    EXPECT_EQ(coarse.targets[0].delta, fine.targets[0].delta);
    // Every corner keeps its place in the picture.
    for (const MorphPart& part : coarse.parts)
        for (long c = 0; c < part.texcoords.rows(); ++c)
            EXPECT_LT((part.texcoords.row(c) -
                       10 * coarse.vertices.row(part.triangles(c / 3, c % 3)).head<2>())
                          .norm(),
                      1e-6);
}

TEST(CoarserModel, LeavesTheBorderBetweenPartsAlone) {
    const MorphModel fine = sheet();
    const MorphModel coarse = coarser_model(fine, 0.25);
    const auto on_border = [](const MorphModel& model, std::size_t part) {
        std::set<int> out;
        for (const int v : model.parts[part].triangles.reshaped())
            if (std::abs(model.vertices(v, 0) - 0.05) < 1e-9) out.insert(v);
        return out;
    };
    EXPECT_EQ(on_border(coarse, 0), on_border(fine, 0));
    EXPECT_EQ(on_border(coarse, 1), on_border(fine, 1));
}

TEST(CoarserModel, IsExactWhereNothingIsLeftOut) {
    const LevelError error = level_error(sheet(), sheet());
    EXPECT_EQ(error.shape_max_m, 0);
    EXPECT_EQ(error.surface_m, 0);
    EXPECT_EQ(error.triangles, 800);
}

}  // namespace
}  // namespace risorius::io
