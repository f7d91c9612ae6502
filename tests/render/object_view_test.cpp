// SPDX-License-Identifier: MIT
#include "risorius/render/object_view.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "render/grid_objects.h"
#include "risorius/core/error.h"

namespace risorius::render {
namespace {

constexpr ObjectViewOptions kSmall{.width_px = 320, .height_px = 240};

Image drawn(const std::vector<Object>& objects, const ObjectViewOptions& options = kSmall) {
    return ObjectView(objects, options).draw();
}

/// Mean over the channels of a pixel, 0..255.
double brightness(const Image& image, const Vec2& at) {
    const std::uint8_t* p = image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()));
    return (p[0] + p[1] + p[2]) / 3.0;
}

/// The darkest pixel within a pixel of a place.
double darkest(const Image& image, const Vec2& at) {
    double min = 255;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) min = std::min(min, brightness(image, at + Vec2(dx, dy)));
    return min;
}

struct Covered {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1, pixels = 0;
};

Covered covered(const Image& image) {
    Covered box;
    for (int y = 0; y < image.height_px; ++y)
        for (int x = 0; x < image.width_px; ++x) {
            if (brightness(image, Vec2(x, y)) > 254) continue;
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x);
            box.top = std::min(box.top, y);
            box.bottom = std::max(box.bottom, y);
            ++box.pixels;
        }
    return box;
}

/// A square of 2 m facing -y, at distance `y`, in the colour of `shade`.
Object pane(double y, double shade) {
    Object object;
    object.positions.resize(4, 3);
    object.positions << -1, y, -1, 1, y, -1, 1, y, 1, -1, y, 1;
    object.surface.resize(2, 3);
    object.surface << 0, 1, 2, 0, 2, 3;
    object.shade.assign(4, shade);
    return object;
}

/// Both in one object, so that they are drawn in one order.
Object joined(const Object& a, const Object& b) {
    Object object = a;
    const auto first = static_cast<int>(a.positions.rows());
    object.positions.conservativeResize(first + b.positions.rows(), 3);
    object.positions.bottomRows(b.positions.rows()) = b.positions;
    object.surface.conservativeResize(a.surface.rows() + b.surface.rows(), 3);
    object.surface.bottomRows(b.surface.rows()) = b.surface.array() + first;
    object.shade.insert(object.shade.end(), b.shade.begin(), b.shade.end());
    return object;
}

TEST(ObjectView, TheSameObjectGivesTheSamePictureOnEveryThread) {
    const Image first = drawn({hanging_block(5)});
    EXPECT_EQ(drawn({hanging_block(5)}).rgba, first.rgba);
    Image there;
    std::thread([&] { there = drawn({hanging_block(5)}); }).join();
    EXPECT_EQ(there.rgba, first.rgba);
    ObjectView view({hanging_block(5)}, kSmall);
    view.draw();
    EXPECT_EQ(view.draw().rgba, first.rgba) << "the second picture of a view is as the first";
}

TEST(ObjectView, EveryVertexIsInThePictureAndThePictureIsFilled) {
    for (const Object& object : {hanging_block(4), cloth(), tube()})
        for (const auto& [width, height] : {std::pair(320, 240), std::pair(100, 300)}) {
            for (const double elevation : {-90.0, -30.0, 18.0, 90.0}) {
                const ObjectView view({object}, {.width_px = width,
                                                 .height_px = height,
                                                 .azimuth_deg = 200,
                                                 .elevation_deg = elevation});
                Vec2 low(1e9, 1e9), high(-1e9, -1e9);
                for (Eigen::Index v = 0; v < object.positions.rows(); ++v) {
                    const Vec2 px = view.project(0, object.positions.row(v).transpose());
                    low = low.cwiseMin(px);
                    high = high.cwiseMax(px);
                }
                const double margin = 0.05 * std::min(width, height);
                EXPECT_GT(low.minCoeff(), margin - 1e-6);
                EXPECT_LT(high.x(), width - margin + 1e-6);
                EXPECT_LT(high.y(), height - margin + 1e-6);
                // One of the two sides is used up.
                EXPECT_NEAR(std::max((high.x() - low.x()) / (width - 2 * margin),
                                     (high.y() - low.y()) / (height - 2 * margin)),
                            1, 1e-9);
            }
        }
}

TEST(ObjectView, WhatIsDrawnIsWhereItIsProjected) {
    const Object block = hanging_block(4);
    ObjectView view({block}, kSmall);
    const Covered box = covered(view.draw());
    Vec2 low(1e9, 1e9), high(-1e9, -1e9);
    for (Eigen::Index v = 0; v < block.positions.rows(); ++v) {
        low = low.cwiseMin(view.project(0, block.positions.row(v).transpose()));
        high = high.cwiseMax(view.project(0, block.positions.row(v).transpose()));
    }
    // Balls of the top layer reach up to nine pixels beyond their vertices, wires one.
    EXPECT_NEAR(box.left, low.x(), 10);
    EXPECT_NEAR(box.right, high.x(), 10);
    EXPECT_NEAR(box.top, low.y(), 10);
    EXPECT_NEAR(box.bottom, high.y(), 2);
    EXPECT_GT(box.pixels, 320 * 240 / 4);
}

TEST(ObjectView, ZIsUpAndTheSideTowardsTheCameraIsNear) {
    const ObjectView front({hanging_block(3)}, {.azimuth_deg = -90, .elevation_deg = 0});
    EXPECT_LT(front.project(0, {0, 0, 1}).y(), front.project(0, {0, 0, 0}).y());
    EXPECT_GT(front.project(0, {1, 0, 0}).x(), front.project(0, {0, 0, 0}).x());
    const auto width = [&](double y) {
        return (front.project(0, {1, y, -1}) - front.project(0, {-1, y, -1})).norm();
    };
    EXPECT_GT(width(-1.5), 1.05 * width(1.5));
    EXPECT_LT(width(-1.5), 1.4 * width(1.5));
}

TEST(ObjectView, WiresAreDarkerThanTheSurfaceAndTheSurfaceThanThePaper) {
    const Object object = cloth();
    ObjectView view({object}, {.width_px = 640, .height_px = 480, .elevation_deg = 50});
    const Image image = view.draw();
    const auto at = [&](int v) -> Vec3 { return object.positions.row(v).transpose(); };
    int wires = 0;
    for (int v = 13 * 8 + 2; v < 13 * 8 + 9; ++v) {
        const Vec2 wire = view.project(0, (at(v) + at(v + 1)) / 2);
        const Vec2 cell = view.project(0, (at(v) + at(v + 1) + at(v + 13) + at(v + 14)) / 4);
        EXPECT_LT(darkest(image, wire), brightness(image, cell) - 40) << v;
        EXPECT_LT(brightness(image, cell), 245) << v;
        ++wires;
    }
    EXPECT_EQ(wires, 7);
}

TEST(ObjectView, WiresPaleWithDistance) {
    Object lines = pane(-2, 0);
    lines.surface.resize(0, 3);
    lines.wires = {{0, 1}};
    Object far = pane(2, 0);
    far.surface.resize(0, 3);
    Object both = joined(lines, far);
    both.wires.push_back({7, 6});
    ObjectView view({both}, {.width_px = 640, .height_px = 480, .azimuth_deg = -90});
    const Image image = view.draw();
    EXPECT_LT(darkest(image, view.project(0, {0, -2, -1})) + 40,
              darkest(image, view.project(0, {0, 2, 1})));
}

TEST(ObjectView, TheNearerPaneColoursWhatIsSeenThroughBoth) {
    const ObjectViewOptions front{
        .width_px = 200, .height_px = 200, .azimuth_deg = -90, .elevation_deg = 0};
    // Blue is shade 0, orange shade 1; the order in the object must not matter.
    const auto redness = [&](const Object& object) {
        const Image image = drawn({object}, front);
        const std::uint8_t* p = image.pixel(100, 100);
        return p[0] - p[2];
    };
    const int blue_near = redness(joined(pane(-1, 0), pane(1, 1)));
    EXPECT_EQ(redness(joined(pane(1, 1), pane(-1, 0))), blue_near);
    const int orange_near = redness(joined(pane(-1, 1), pane(1, 0)));
    EXPECT_EQ(redness(joined(pane(1, 0), pane(-1, 1))), orange_near);
    EXPECT_GT(orange_near, blue_near + 30);
}

TEST(ObjectView, AFixedNodeIsARedBallAndStandsBeforeItsWires) {
    Object object = hanging_block(3);
    const int corner = object.fixed.front();
    ObjectView view({object}, {.width_px = 640, .height_px = 480});
    const Vec2 px = view.project(0, object.positions.row(corner).transpose());
    const Image image = view.draw();
    const std::uint8_t* p = image.pixel(static_cast<int>(px.x()), static_cast<int>(px.y()));
    EXPECT_GT(p[0], 2 * p[1]);
    EXPECT_GT(p[0], 2 * p[2]);
    object.fixed.clear();
    const Image without = drawn({object}, {.width_px = 640, .height_px = 480});
    const std::uint8_t* q = without.pixel(static_cast<int>(px.x()), static_cast<int>(px.y()));
    EXPECT_LT(q[0], 2 * q[1]);
}

TEST(ObjectView, ObjectsInARowHaveOneScaleAndDoNotTouch) {
    Object small = hanging_block(3);
    small.positions *= 0.5;
    const ObjectViewOptions wide{.width_px = 600, .height_px = 240};
    ObjectView view({hanging_block(3), small, cloth()}, wide);
    const auto height = [&](std::size_t object, double of) {
        return view.project(object, {0, 0, -of}).y() - view.project(object, {0, 0, 0}).y();
    };
    // The same metre, up to perspective about two different middles
    EXPECT_NEAR(height(0, 1) / height(1, 1), 1, 1e-9);
    const Image image = view.draw();
    int gaps = 0;
    bool ink_before = false;
    for (int x = 0; x < 600; ++x) {
        bool ink = false;
        for (int y = 0; y < 240; ++y) ink = ink || brightness(image, Vec2(x, y)) < 254;
        gaps += ink_before && !ink;
        ink_before = ink;
    }
    EXPECT_EQ(gaps, 3) << "paper after each of the three";
}

TEST(ObjectView, APictureLargerThanATileIsTheSamePicture) {
    // 1500 px of three samples are more than the 4096 of a tile.
    ObjectViewOptions options{.width_px = 1500, .height_px = 300, .supersampling = 3};
    const std::vector<Object> row{cloth(), tube(), cloth(), tube(), cloth()};
    const Image tiled = drawn(row, options);
    options.supersampling = 2;
    const Image whole = drawn(row, options);
    double sum = 0;
    for (int y = 0; y < 300; ++y)
        for (int x = 1300; x < 1430; ++x)
            sum += std::abs(brightness(tiled, Vec2(x, y)) - brightness(whole, Vec2(x, y)));
    EXPECT_LT(sum / (300 * 130), 2.0);
    EXPECT_EQ(covered(tiled).right > 1365, true);
}

TEST(ObjectView, WhatCannotBeDrawnIsNamed) {
    const auto message = [](const std::vector<Object>& objects,
                            const ObjectViewOptions& options = kSmall) -> std::string {
        try {
            const ObjectView view(objects, options);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_EQ(message({}), "objects: expected at least one, found none");
    EXPECT_EQ(message({Object{}}), "objects/0/positions: expected at least one vertex, found none");
    Object object = pane(0, 0);
    object.positions(2, 1) = NAN;
    EXPECT_EQ(message({pane(0, 0), object}),
              "objects/1/positions/2: expected finite coordinates, found one that is not");
    object = pane(0, 0);
    object.surface(1, 1) = 4;
    EXPECT_EQ(message({object}), "objects/0/surface: expected vertices 0..3, found 4");
    object = pane(0, 0);
    object.wires = {{0, -1}};
    EXPECT_EQ(message({object}), "objects/0/wires: expected vertices 0..3, found -1");
    object = pane(0, 0);
    object.fixed = {9};
    EXPECT_EQ(message({object}), "objects/0/fixed: expected vertices 0..3, found 9");
    object.fixed.clear();
    object.shade.pop_back();
    EXPECT_EQ(message({object}), "objects/0/shade: expected 4 values, found 3");
    EXPECT_EQ(message({cloth()}, {.width_px = 15}), "width_px: expected 16..8192, found 15");
    EXPECT_EQ(message({cloth()}, {.elevation_deg = 91}),
              "elevation_deg: expected [-90, 90], found 91");
    EXPECT_EQ(message({cloth()}, {.azimuth_deg = INFINITY}),
              "azimuth_deg: expected a number, found inf");
    EXPECT_EQ(message({cloth()}, {.supersampling = 0}), "supersampling: expected 1..4, found 0");
}

TEST(ObjectView, FlatAndTinyObjectsAreDrawnToo) {
    Object point;
    point.positions.resize(1, 3);
    point.positions << 1, 2, 3;
    point.fixed = {0};
    EXPECT_GT(covered(drawn({point})).pixels, 10);
    EXPECT_GT(covered(drawn({pane(0, 0)}, {.width_px = 200, .height_px = 200})).pixels, 1000);
    Object collapsed = pane(0, 0);
    collapsed.positions.setZero();
    collapsed.wires = {{0, 1}};
    EXPECT_EQ(drawn({collapsed}).width_px, 320);
}

}  // namespace
}  // namespace risorius::render
