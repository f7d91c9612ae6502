// SPDX-License-Identifier: MIT
#include "risorius/render/offscreen_view.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "cache_setting.h"
#include "message_of.h"
#include "render/round_head.h"
#include "render/small_pictures.h"
#include "risorius/core/error.h"
#include "risorius/render/gl_choice.h"
#include "temporary_folder.h"

namespace risorius::render {
namespace {

/// The fingerprint drawn by a fresh process, in which the driver has made no choice of threads yet.
/// 0 where the back end has no context, 1 where it is a graphics processor's.
std::uint64_t fingerprint_of_a_fresh_process(int threads, const char* gl = "osmesa") {
    int ends[2];
    if (pipe(ends) != 0) return 0;
    const pid_t child = fork();
    if (child == 0) {
        const CacheSetting computed_anew("off");
        const RoundHead head;
        ViewOptions options = small();
        options.threads = threads;
        choose_gl(gl, "test");
        std::uint64_t hash = 0;
        try {
            hash = fingerprint(OffscreenView(head.scene, options).draw(head.pose));
            if (gl_in_use().find("llvmpipe") == std::string::npos) hash = 1;
        } catch (const RunError&) {
        }
        const bool written = write(ends[1], &hash, sizeof hash) == sizeof hash;
        _exit(written ? 0 : 1);
    }
    close(ends[1]);
    std::uint64_t hash = 0;
    const bool complete = read(ends[0], &hash, sizeof hash) == sizeof hash;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return complete ? hash : 0;
}

std::uint64_t fingerprint_in_memory() {
    static const std::uint64_t print = fingerprint_of_a_fresh_process(0);
    return print;
}

const RoundHead& plain_head() {
    static const RoundHead head;
    return head;
}

/// Views of the plain head, baked once for all tests that change nothing of it. Never taken down: the driver may be before.
OffscreenView& seen_from(const std::string& camera) {
    static auto& views = *new std::map<std::string, std::unique_ptr<OffscreenView>>;
    std::unique_ptr<OffscreenView>& view = views[camera];
    if (!view) view = std::make_unique<OffscreenView>(plain_head().scene, small(camera));
    return *view;
}

// First in the file: it forks before this process has a driver.
TEST(OffscreenView, APictureIsTheSameForEveryRunAndNumberOfThreads) {
    const std::uint64_t alone = fingerprint_in_memory();
    ASSERT_NE(alone, 0U);
    EXPECT_EQ(fingerprint_of_a_fresh_process(0), alone);
    EXPECT_EQ(fingerprint_of_a_fresh_process(1), alone);
    EXPECT_EQ(fingerprint_of_a_fresh_process(2), alone);
}

TEST(OffscreenView, APictureIsTheSameFromTheCache) {
    RoundHead head;
    head.scene.shut = head.scene.rest;
    const auto drawn_with = [&](const std::string& cache) {
        const CacheSetting place(cache);
        return OffscreenView(head.scene, small()).draw(head.pose).rgba;
    };
    TemporaryFolder folder;
    const auto computed = drawn_with("off"), kept = drawn_with(folder.path().string());
    EXPECT_EQ(folder.listing().size(), 3u);  // the folder, sky and paint
    EXPECT_EQ(kept, computed);
    EXPECT_EQ(drawn_with(folder.path().string()), computed);
}

TEST(OffscreenView, EglWithoutAGraphicsProcessorDrawsTheSameAsOsmesa) {
    const std::uint64_t in_memory = fingerprint_in_memory();
    const std::uint64_t by_egl = fingerprint_of_a_fresh_process(0, "egl");
    if (by_egl <= 1) GTEST_SKIP() << "no EGL, or one with a graphics processor";
    EXPECT_EQ(by_egl, in_memory);
    EXPECT_EQ(fingerprint_of_a_fresh_process(2, "egl"), in_memory);
}

TEST(OffscreenView, AnUnknownWayToDrawIsNamed) {
    EXPECT_EQ(message_of([] { choose_gl("eql", "--gl"); }),
              "--gl: expected one of \"auto\", \"osmesa\", \"egl\" (did you mean \"egl\"?), "
              "found \"eql\"");
}

TEST(OffscreenView, AFrameDoesNotDependOnTheFramesBefore) {
    const RoundHead& head = plain_head();
    OffscreenView& view = seen_from("front");
    const std::uint64_t first = fingerprint(view.draw(head.pose));
    Pose moved = head.pose;
    moved.positions.col(0).array() += 0.02;
    moved.jaw_open = 1.0;
    EXPECT_NE(fingerprint(view.draw(moved)), first);
    EXPECT_EQ(fingerprint(view.draw(head.pose)), first);
}

TEST(OffscreenView, AnotherThreadDrawsTheSame) {
    const RoundHead& head = plain_head();
    OffscreenView& view = seen_from("front");
    const std::uint64_t here = fingerprint(view.draw(head.pose));
    std::uint64_t there = 0;
    std::thread([&] { there = fingerprint(view.draw(head.pose)); }).join();
    EXPECT_EQ(there, here);
}

TEST(OffscreenView, TwoViewsShareAThread) {
    const RoundHead& head = plain_head();
    OffscreenView& front = seen_from("front");
    const std::uint64_t before = fingerprint(front.draw(head.pose));
    OffscreenView& profile = seen_from("profile");
    EXPECT_NE(fingerprint(profile.draw(head.pose)), before);
    EXPECT_EQ(fingerprint(front.draw(head.pose)), before);
}

TEST(OffscreenView, ViewsOfOneSceneDrawTheSameAtTheSameTimeOnSeveralThreads) {
    RoundHead head;
    auto first = std::make_unique<OffscreenView>(head.scene, small());
    std::vector<Pose> poses(6, head.pose);
    std::vector<std::uint64_t> alone;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i].positions.col(0).array() += 0.004 * static_cast<double>(i);
        alone.push_back(fingerprint(first->draw(poses[i])));
    }
    EXPECT_NE(alone.front(), alone.back());
    const auto draw_all = [&](OffscreenView& view, std::vector<std::uint64_t>& out) {
        for (int round = 0; round < 2; ++round)
            for (const Pose& pose : poses) out.push_back(fingerprint(view.draw(pose)));
    };
    std::array<std::vector<std::uint64_t>, 3> seen;
    {
        OffscreenView second(head.scene, *first), third(head.scene, *first);
        std::thread a([&] { draw_all(*first, seen[0]); }), b([&] { draw_all(second, seen[1]); });
        draw_all(third, seen[2]);
        a.join();
        b.join();
        first.reset();  // what they share stays with the last of them
        EXPECT_EQ(fingerprint(second.draw(poses[0])), alone[0]);
    }
    for (const std::vector<std::uint64_t>& prints : seen)
        for (std::size_t i = 0; i < prints.size(); ++i)
            EXPECT_EQ(prints[i], alone[i % poses.size()]);
}

TEST(OffscreenView, AProjectedPointIsWhereItIsDrawn) {
    // Two small octahedra well in front of a head of the same size in every camera
    const std::array<Vec3, 2> centres = {Vec3(0.06, 0.11, 0.05), Vec3(-0.05, -0.12, 0.03)};
    for (const std::string& camera : camera_names()) {
        RoundHead head;
        Surface& mark = head.scene.surfaces.back();
        mark.material = Material::kTeeth;
        mark.triangles.resize(16, 3);
        int face = 0;
        for (const Vec3& centre : centres) {
            const auto first = static_cast<int>(head.scene.rest.rows());
            head.scene.rest.conservativeResize(first + 6, 3);
            const double r = 0.004;
            head.scene.rest.bottomRows(6) << r, 0, 0, -r, 0, 0, 0, r, 0, 0, -r, 0, 0, 0, r, 0, 0,
                -r;
            head.scene.rest.bottomRows(6).rowwise() += centre.transpose();
            for (const int x : {0, 1})
                for (const int y : {2, 3})
                    for (const int z : {4, 5}) {  // counter-clockwise from outside
                        mark.triangles.row(face) << first + x, first + y, first + z;
                        const Vec3 a = head.scene.rest.row(first + x),
                                   b = head.scene.rest.row(first + y),
                                   c = head.scene.rest.row(first + z);
                        if ((a - centre).dot((b - centre).cross(c - centre)) < 0)
                            std::swap(mark.triangles(face, 1), mark.triangles(face, 2));
                        ++face;
                    }
        }
        head.scene.surfaces.front().triangles.conservativeResize(1,
                                                                 3);  // next to no head in the way
        head.scene.surfaces[1].triangles.resize(0, 3);
        head.scene.surfaces[2].triangles.resize(0, 3);
        head.pose.positions = head.scene.rest;
        ViewOptions options = small(camera);
        options.background.transparent = true;
        options.height_px = 256;
        OffscreenView view(head.scene, options);
        const Image image = view.draw(head.pose);
        for (const Vec3& centre : centres) {
            Vec2 sum = Vec2::Zero();
            double weight = 0;
            const Vec2 expected = view.project(centre);
            for (int y = 0; y < image.height_px; ++y)
                for (int x = 0; x < image.width_px; ++x) {
                    const double alpha = image.pixel(x, y)[3];
                    if ((Vec2(x, y) - expected).norm() > 20) continue;
                    sum += alpha * Vec2(x + 0.5, y + 0.5);
                    weight += alpha;
                }
            ASSERT_GT(weight, 0) << camera;
            // An octahedron is symmetric about its centre; perspective moves the mean by far less than this.
            EXPECT_NEAR((sum / weight - expected).norm(), 0, 0.25) << camera;
        }
    }
}

TEST(OffscreenView, EveryCameraStandsAMetreAwaySeesTheWholeHeadAndMirrorsItsCounterpart) {
    std::map<std::string, Vec2> shown;  // a place in the cameras of the right its mirror image
    for (const std::string& camera : camera_names()) {
        const OffscreenView& view = seen_from(camera);
        for (const Vec3& p : {Vec3(0, 0.1, 0), Vec3(0, -0.1, 0), Vec3(0.1, 0, 0), Vec3(0, 0, 0.1),
                              Vec3(-0.1, 0, 0)}) {
            const Vec2 px = view.project(p);
            EXPECT_GT(px.minCoeff(), 0) << camera;
            EXPECT_LT(px.maxCoeff(), 192) << camera;
        }
        // Perspective of a lens held at a metre: 0.1 m nearer is at most 1/0.9 larger.
        const double near =
            (view.project(Vec3(0, 0.01, 0.07)) - view.project(Vec3(0, 0, 0.07))).norm();
        const double far =
            (view.project(Vec3(0, 0.01, -0.07)) - view.project(Vec3(0, 0, -0.07))).norm();
        EXPECT_LT(near / far, 1.07 / 0.93) << camera;
        shown[camera] = view.project(Vec3(camera.ends_with("_right") ? -0.03 : 0.03, 0.02, 0.09));
    }
    for (const char* left : {"three_quarter", "profile"}) {
        const Vec2 a = shown.at(left), b = shown.at(left + std::string("_right"));
        EXPECT_NEAR(a.x(), 192 - b.x(), 1e-9) << left;
        EXPECT_NEAR(a.y(), b.y(), 1e-9) << left;
    }
}

TEST(OffscreenView, TheBackgroundKeepsItsColourExactly) {
    RoundHead head;
    for (const std::array<int, 3> rgb :
         {std::array<int, 3>{0, 1, 255}, {17, 128, 201}, {254, 66, 3}}) {
        ViewOptions options = small();
        options.width_px = options.height_px = 64;
        options.background.rgb = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
        const Image image = OffscreenView(head.scene, options).draw(head.pose);
        for (const auto& [x, y] : {std::pair{0, 0}, {63, 0}, {0, 63}, {63, 63}, {1, 33}}) {
            const std::uint8_t* p = image.pixel(x, y);
            EXPECT_EQ(p[0], rgb[0]);
            EXPECT_EQ(p[1], rgb[1]);
            EXPECT_EQ(p[2], rgb[2]);
            EXPECT_EQ(p[3], 255);
        }
    }
}

TEST(OffscreenView, AlphaIsZeroBesideTheHeadFullOnItAndCleanAtItsEdge) {
    RoundHead head;
    ViewOptions options = small();
    options.background.transparent = true;
    OffscreenView view(head.scene, options);
    const Image image = view.draw(head.pose);
    EXPECT_EQ(image.pixel(0, 0)[3], 0);
    const Vec2 middle = view.project(RoundHead::on_skin(0, 0));
    EXPECT_EQ(image.pixel(static_cast<int>(middle.x()), static_cast<int>(middle.y()))[3], 255);
    // Straight alpha: an edge pixel is as bright as the skin beside it, not mixed with black.
    int edges = 0;
    for (int y = 1; y < 191; ++y)
        for (int x = 1; x < 191; ++x) {
            const std::uint8_t* p = image.pixel(x, y);
            if (p[3] == 0 || p[3] == 255) continue;
            ++edges;
            int max = 0;
            for (const int dx : {-1, 1})
                if (image.pixel(x + dx, y)[3] == 255)
                    max = std::max<int>(max, image.pixel(x + dx, y)[0]);
            if (max > 0) {
                EXPECT_GT(p[0], max / 2) << x << ", " << y;
            }
        }
    EXPECT_GT(edges, 100);
}

TEST(OffscreenView, MoreSamplesSmoothTheOutlineWithoutMovingIt) {
    RoundHead head;
    ViewOptions options = small();
    options.background.transparent = true;
    std::array<double, 2> area{0, 0};
    std::array<int, 2> partial{0, 0};
    for (const int i : {0, 1}) {
        options.supersampling = i == 0 ? 1 : 3;
        const Image image = OffscreenView(head.scene, options).draw(head.pose);
        for (std::size_t p = 3; p < image.rgba.size(); p += 4) {
            area[static_cast<std::size_t>(i)] += image.rgba[p] / 255.0;
            partial[static_cast<std::size_t>(i)] += image.rgba[p] > 0 && image.rgba[p] < 255;
        }
    }
    EXPECT_EQ(partial[0], 0);
    EXPECT_GT(partial[1], 100);
    EXPECT_NEAR(area[0] / area[1], 1.0,
                0.005);  // an outline of 450 px, half a pixel uncertain, averages out
}

TEST(OffscreenView, APictureLargerThanATileHasNoSeams) {
    // At four samples per side a tile ends at 1024 px, across the face; at two the whole picture is one tile.
    RoundHead head;
    ViewOptions options = small();
    options.width_px = options.height_px = 1300;
    const Image whole = OffscreenView(head.scene, options).draw(head.pose);
    options.supersampling = 4;
    const Image tiled = OffscreenView(head.scene, options).draw(head.pose);
    const auto difference = [&](int from, int to) {
        double sum = 0;
        for (int y = 200; y < 1100; ++y)
            for (int x = from; x < to; ++x)
                sum += std::abs(whole.pixel(x, y)[0] - tiled.pixel(x, y)[0]) +
                       std::abs(whole.pixel(y, x)[0] - tiled.pixel(y, x)[0]);
        return sum / (2 * 900 * (to - from));
    };
    // A seam of one misplaced pixel would show the slope of the shading, more than the noise of sampling.
    EXPECT_LT(difference(1022, 1026), 1.5 * difference(1000, 1020) + 0.1);
}

TEST(OffscreenView, WrongOptionsAreNamed) {
    const RoundHead head;
    const auto message = [&](const ViewOptions& options) {
        return message_of([&] { OffscreenView view(head.scene, options); });
    };
    EXPECT_EQ(message({.width_px = 15}), "width_px: expected 16..8192, found 15");
    EXPECT_EQ(message({.height_px = 8193}), "height_px: expected 16..8192, found 8193");
    EXPECT_EQ(message({.supersampling = 5}), "supersampling: expected 1..4, found 5");
    EXPECT_EQ(message({.threads = -1}), "threads: expected 0..256, found -1");
    EXPECT_EQ(message({.camera = "side"}),
              "camera: expected one of \"front\", \"three_quarter\", \"three_quarter_right\", "
              "\"profile\", "
              "\"profile_right\", \"top\", \"eye\", \"nose\", \"mouth\", \"ear\", found \"side\"");
}

TEST(OffscreenView, ASceneThatCannotBeDrawnIsNamed) {
    RoundHead bare;
    bare.scene.surfaces.erase(bare.scene.surfaces.begin());
    EXPECT_EQ(message_of([&] { OffscreenView view(bare.scene, small()); }),
              "scene/surfaces: expected a skin surface, found none");
    RoundHead torn;
    const auto rows = torn.scene.rest.rows();
    torn.scene.surfaces[1].triangles(0, 0) = static_cast<int>(rows);
    EXPECT_EQ(message_of([&] { OffscreenView view(torn.scene, small()); }),
              "scene/surfaces/1/triangles: expected vertices 0.." + std::to_string(rows - 1) +
                  ", found " + std::to_string(torn.scene.surfaces[1].triangles.minCoeff()) + ".." +
                  std::to_string(rows));
}

TEST(OffscreenView, APoseOfAnotherHeadIsRefused) {
    const RoundHead& head = plain_head();
    Pose other = head.pose;
    other.positions.conservativeResize(7, 3);
    EXPECT_EQ(
        message_of([&] { seen_from("front").draw(other); }),
        "pose/positions: expected " + std::to_string(head.scene.rest.rows()) + " rows, found 7");
}

}  // namespace
}  // namespace risorius::render
