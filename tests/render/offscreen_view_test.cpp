#include "render/offscreen_view.h"

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

#include "core/error.h"
#include "render/gl_choice.h"
#include "render/round_head.h"

namespace risorius::render {
namespace {

ViewOptions small(const std::string& camera = "front") {
    return {.width_px = 192, .height_px = 192, .camera = camera};
}

/// Mean of the pixels within `reach` of a place, 0..255.
std::array<double, 3> mean_colour(const Image& image, const Vec2& at, int reach) {
    std::array<double, 3> sum{0, 0, 0};
    int count = 0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const std::uint8_t* p =
                image.pixel(static_cast<int>(at.x()) + dx, static_cast<int>(at.y()) + dy);
            for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
            ++count;
        }
    for (double& s : sum) s /= count;
    return sum;
}

double brightness(const std::array<double, 3>& rgb) { return (rgb[0] + rgb[1] + rgb[2]) / 3; }

std::uint64_t fingerprint(const Image& image) {
    std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
    for (const std::uint8_t byte : image.rgba) hash = (hash ^ byte) * 1099511628211ULL;
    return hash;
}

template <class Call>
std::string message_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

/// The fingerprint drawn by a fresh process, in which the driver has made no choice of threads yet.
/// 0 where the back end has no context, 1 where it is a graphics processor's.
std::uint64_t fingerprint_of_a_fresh_process(int threads, const char* gl = "osmesa") {
    int ends[2];
    if (pipe(ends) != 0) return 0;
    const pid_t child = fork();
    if (child == 0) {
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

// First in the file: it forks before this process has a driver.
TEST(OffscreenView, APictureIsTheSameForEveryRunAndNumberOfThreads) {
    const std::uint64_t alone = fingerprint_of_a_fresh_process(0);
    ASSERT_NE(alone, 0U);
    EXPECT_EQ(fingerprint_of_a_fresh_process(0), alone);
    EXPECT_EQ(fingerprint_of_a_fresh_process(1), alone);
    EXPECT_EQ(fingerprint_of_a_fresh_process(2), alone);
}

TEST(OffscreenView, EglWithoutAGraphicsProcessorDrawsTheSameAsOsmesa) {
    const std::uint64_t in_memory = fingerprint_of_a_fresh_process(0);
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
    RoundHead head;
    OffscreenView view(head.scene, small());
    const std::uint64_t first = fingerprint(view.draw(head.pose));
    Pose moved = head.pose;
    moved.positions.col(0).array() += 0.02;
    moved.jaw_open = 1.0;
    EXPECT_NE(fingerprint(view.draw(moved)), first);
    EXPECT_EQ(fingerprint(view.draw(head.pose)), first);
}

TEST(OffscreenView, AnotherThreadDrawsTheSame) {
    RoundHead head;
    OffscreenView view(head.scene, small());
    const std::uint64_t here = fingerprint(view.draw(head.pose));
    std::uint64_t there = 0;
    std::thread([&] { there = fingerprint(view.draw(head.pose)); }).join();
    EXPECT_EQ(there, here);
}

TEST(OffscreenView, TwoViewsShareAThread) {
    RoundHead head;
    OffscreenView front(head.scene, small());
    const std::uint64_t before = fingerprint(front.draw(head.pose));
    OffscreenView profile(head.scene, small("profile"));
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
        for (int round = 0; round < 3; ++round)
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
    RoundHead head;
    std::map<std::string, Vec2> shown;  // a place in the cameras of the right its mirror image
    for (const std::string& camera : camera_names()) {
        OffscreenView view(head.scene, small(camera));
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
        options.background.rgb = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
        const Image image = OffscreenView(head.scene, options).draw(head.pose);
        for (const auto& [x, y] : {std::pair{0, 0}, {191, 0}, {0, 191}, {191, 191}, {3, 100}}) {
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
            int most = 0;
            for (const int dx : {-1, 1})
                if (image.pixel(x + dx, y)[3] == 255)
                    most = std::max<int>(most, image.pixel(x + dx, y)[0]);
            if (most > 0) {
                EXPECT_GT(p[0], most / 2) << x << ", " << y;
            }
        }
    EXPECT_GT(edges, 100);
}

TEST(OffscreenView, LipsAreRedderThanTheCheek) {
    RoundHead head;
    OffscreenView view(head.scene, small());
    const Image image = view.draw(head.pose);
    const auto redness = [&](const Vec3& p) {
        const std::array<double, 3> c = mean_colour(image, view.project(p), 2);
        return c[0] / (c[1] + 1);
    };
    EXPECT_GT(redness(RoundHead::on_skin(0, -0.047)),
              1.08 * redness(RoundHead::on_skin(-0.045, -0.035)));
}

TEST(OffscreenView, HairOfSomeLengthStandsOffTheScalpAndOnlyThere) {
    RoundHead head;
    head.scene.landmarks["tr"] = RoundHead::on_skin(0, 0.06);
    head.scene.landmarks["fht_l"] = RoundHead::on_skin(0.05, 0.04);
    head.scene.landmarks["fht_r"] = RoundHead::on_skin(-0.05, 0.04);
    ViewOptions options = small();
    options.background.transparent = true;
    options.width_px = options.height_px = 64;
    options.supersampling = 1;
    /// Beside the crown and beside the chin
    const auto opacities = [&] {
        OffscreenView view(head.scene, options);
        const Image image = view.draw(head.pose);
        std::array<int, 2> sum{0, 0};
        for (const int end : {0, 1}) {
            const Vec2 p = view.project(Vec3(0, (end == 0 ? 1 : -1) * (kHeadRadius_m + 0.006), 0));
            for (int dx = -2; dx <= 2; ++dx)
                sum[static_cast<std::size_t>(end)] +=
                    image.pixel(static_cast<int>(p.x()) + dx, static_cast<int>(p.y()))[3];
        }
        return sum;
    };
    EXPECT_EQ(opacities(), (std::array<int, 2>{0, 0}));
    head.scene.look.hair_length_mm = 15;
    const std::array<int, 2> hairy = opacities();
    EXPECT_GT(hairy[0], 2 * 255);
    EXPECT_EQ(hairy[1], 0);
}

TEST(OffscreenView, TheWhiteOfTheEyeIsBrighterThanTheIrisAndThatThanThePupil) {
    RoundHead head;
    ViewOptions options = small();
    options.width_px = options.height_px = 384;
    OffscreenView view(head.scene, options);
    const Image image = view.draw(head.pose);
    const Vec3 eye = head.scene.eyes[0].centre;
    // Below the middle, away from the mirrored lamps
    const auto at = [&](double x, double y) {
        return brightness(mean_colour(image, view.project(eye + Vec3(x, y, 0.0105)), 1));
    };
    const double white = at(0.0, -0.0083), iris = at(0.0, -0.0038), pupil = at(0.0, 0.0);
    EXPECT_GT(white, 1.2 * iris);  // of an iris where the cornea gathers light
    EXPECT_GT(iris, 1.25 * pupil);
}

TEST(OffscreenView, TheIrisIsBrighterOnTheSideAwayFromTheLamp) {
    RoundHead head;
    ViewOptions options = small();
    options.width_px = options.height_px = 384;
    OffscreenView view(head.scene, options);
    const Image image = view.draw(head.pose);
    const Vec3 eye = head.scene.eyes[0].centre;
    const auto at = [&](double x, double y) {
        return brightness(mean_colour(image, view.project(eye + Vec3(x, y, 0.0105)), 1));
    };
    // The key light comes from the subject's right and above; the mirrored lamps lie on that side.
    EXPECT_GT(at(0.0030, -0.0024), 1.2 * at(-0.0036, -0.0014));
}

TEST(OffscreenView, ThePupilTurnsWithTheEye) {
    RoundHead head;
    ViewOptions options = small();
    options.width_px = options.height_px = 384;
    OffscreenView view(head.scene, options);
    const Eye& eye = head.scene.eyes[0];
    const Mat3 turn = Eigen::AngleAxisd(0.45, Vec3::UnitY()).toRotationMatrix();
    for (Eigen::Index i = 0; i < head.scene.rest.rows(); ++i) {
        const Vec3 arm = head.scene.rest.row(i).transpose() - eye.centre;
        if (arm.norm() < eye.radius_m + 1e-6)
            head.pose.positions.row(i) = (eye.centre + turn * arm).transpose();
    }
    head.pose.eye_rotation[0] = turn;
    const Image image = view.draw(head.pose);
    // The pupil lies behind the surface, so look along its direction at the depth of the iris.
    const Vec3 pupil = eye.centre + turn * Vec3(0, 0, 0.0104);
    const double there = brightness(mean_colour(image, view.project(pupil), 1));
    const double ahead =
        brightness(mean_colour(image, view.project(eye.centre + Vec3(-0.002, -0.003, 0.0104)), 1));
    EXPECT_LT(there, 0.6 * ahead);
}

TEST(OffscreenView, ALidThatHasUnrolledIsNotShadedByTheCreaseItCameFrom) {
    // A groove across the skin above the left eye, gone when the eye is shut
    RoundHead head;
    for (const auto& [id, y] : {std::pair{"ps_l", 0.026}, {"pi_l", 0.014}})
        head.scene.landmarks[id] = RoundHead::on_skin(0.03, y);
    head.scene.landmarks["en_l"] = RoundHead::on_skin(0.018, 0.02);
    head.scene.landmarks["ex_l"] = RoundHead::on_skin(0.042, 0.02);
    const Points flat = head.scene.rest;
    const Vec3 groove = RoundHead::on_skin(0.03, 0.040);
    for (Eigen::Index v = 0; v < flat.rows(); ++v)
        if (std::abs(flat(v, 1) - groove.y()) < 0.003 && std::abs(flat(v, 0) - 0.03) < 0.015 &&
            flat.row(v).norm() > 0.999 * kHeadRadius_m && flat(v, 2) > 0)
            head.scene.rest.row(v) *= 0.86;
    Pose shut;
    shut.positions = flat;
    // The margins meet
    const auto nearest = [&](const Vec3& p) {
        Eigen::Index best = 0;
        for (Eigen::Index v = 0; v < flat.rows(); ++v)
            if ((flat.row(v).transpose() - p).norm() < (flat.row(best).transpose() - p).norm())
                best = v;
        return best;
    };
    shut.positions.row(nearest(RoundHead::on_skin(0.03, 0.026))) =
        flat.row(nearest(RoundHead::on_skin(0.03, 0.014)));

    OffscreenView as_at_rest(head.scene, small());
    const auto brightness_at = [&](OffscreenView& view) {
        return brightness(mean_colour(view.draw(shut), view.project(groove), 1));
    };
    const double shaded = brightness_at(as_at_rest);
    head.scene.shut = flat;
    OffscreenView told(head.scene, small());
    EXPECT_GT(brightness_at(told), shaded + 10);
    Pose open;
    open.positions = head.scene.rest;
    EXPECT_EQ(fingerprint(told.draw(open)), fingerprint(as_at_rest.draw(open)));
}

TEST(OffscreenView, AClosedSurfaceHidesTheTeeth) {
    RoundHead with, without;
    without.scene.surfaces.pop_back();
    const Image a = OffscreenView(with.scene, small()).draw(with.pose);
    const Image b = OffscreenView(without.scene, small()).draw(without.pose);
    EXPECT_EQ(fingerprint(a), fingerprint(b));
}

TEST(OffscreenView, AMouthThatOpensLetsLightOnTheTeeth) {
    // Teeth in front of the skin, so that only the light changes with the lips.
    RoundHead head;
    for (Eigen::Index i = 0; i < head.scene.rest.rows(); ++i)
        if ((head.scene.rest.row(i).transpose() - Vec3(0, -0.045, 0.06)).norm() < 0.0125)
            head.scene.rest(i, 2) += 0.04;
    head.pose.positions = head.scene.rest;
    OffscreenView view(head.scene, small());
    const Vec2 place = view.project(Vec3(0, -0.045, 0.111));
    const double closed = brightness(mean_colour(view.draw(head.pose), place, 2));
    const Eigen::Index lower = [&] {
        Eigen::Index best = 0;
        (head.scene.rest.rowwise() - head.scene.landmarks.at("li").transpose())
            .rowwise()
            .squaredNorm()
            .minCoeff(&best);
        return best;
    }();
    head.pose.positions(lower, 1) -= 0.03;
    const double open = brightness(mean_colour(view.draw(head.pose), place, 2));
    EXPECT_GT(open, closed + 20);
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
              "\"profile_right\", found \"side\"");
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
    RoundHead head;
    OffscreenView view(head.scene, small());
    head.pose.positions.conservativeResize(7, 3);
    EXPECT_EQ(
        message_of([&] { view.draw(head.pose); }),
        "pose/positions: expected " + std::to_string(head.scene.rest.rows()) + " rows, found 7");
}

}  // namespace
}  // namespace risorius::render
