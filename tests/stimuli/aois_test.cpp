// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/aois.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "risorius/stimuli/detail/clip.h"

namespace risorius::stimuli {
namespace {

/// Landmarks of eyes, brows and mouth in a face of 100 px in a picture of 200 x 200; `gap_px`: from the eye to the brow.
animate::FrameRows face_with(double gap_px, double half_width_px = 50) {
    animate::FrameRows rows;
    rows.cells.emplace_back();
    const auto add = [&](const std::string& id, double right_px, double down_px) {
        rows.names.push_back(id + ".u_px");
        rows.names.push_back(id + ".v_px");
        rows.cells[0].push_back(std::to_string(100 + right_px * half_width_px / 50));
        rows.cells[0].push_back(std::to_string(100 + down_px));
    };
    const std::map<std::string, std::pair<double, double>> eye{
        {"en", {10, 0}}, {"ulm", {15, -4}}, {"ps", {20, -5}}, {"ull", {25, -4}},
        {"ex", {30, 0}}, {"lll", {25, 4}},  {"pi", {20, 5}},  {"llm", {15, 4}}};
    for (const auto& [side, sign] : std::map<std::string, double>{{"_l", 1}, {"_r", -1}}) {
        for (const auto& [id, at] : eye) add(id + side, sign * at.first, at.second);
        for (const auto& [id, x] :
             std::map<std::string, double>{{"bm", 8}, {"bc", 16}, {"bp", 24}, {"bl", 32}})
            add(id + side, sign * x, -5 - gap_px);
    }
    return rows;
}

bool contains(const std::vector<Vec2>& polygon, const Vec2& point) {
    bool in = false;
    for (std::size_t i = 0, k = polygon.size() - 1; i < polygon.size(); k = i++)
        if ((polygon[i].y() > point.y()) != (polygon[k].y() > point.y()) &&
            point.x() < (polygon[k].x() - polygon[i].x()) * (point.y() - polygon[i].y()) /
                                (polygon[k].y() - polygon[i].y()) +
                            polygon[i].x())
            in = !in;
    return in;
}

std::vector<Aoi> eyes_and_brows(const animate::FrameRows& rows, double margin_px) {
    return aois_of(rows, 0, {"eye_l", "eye_r", "brow_l", "brow_r"}, 100, margin_px, 200, 200);
}

TEST(Aois, GoThroughTheirLandmarksAndGrowByTheMargin) {
    const std::vector<Aoi> plain = eyes_and_brows(face_with(15), 0),
                           more = eyes_and_brows(face_with(15), 2);
    ASSERT_EQ(plain[0].polygon.size(), 8u);
    EXPECT_NEAR(plain[0].area_px, plain[1].area_px, 1e-9);
    EXPECT_NEAR(plain[0].area_px, 20.0 * 10 - 4 * (0.5 * 5 * 1 + 0.5 * 5 * 4) - 4 * 5 * 1, 1e-4);
    EXPECT_TRUE(contains(plain[0].polygon, {120, 100})) << "the person's left is on the right";
    EXPECT_TRUE(contains(plain[1].polygon, {80, 100}));
    EXPECT_NEAR(plain[2].area_px, 24 * 6, 1e-4) << "a band of 3 px above and below";
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_GT(more[i].area_px, plain[i].area_px + 2 * 2 * 20);
        for (const Vec2& corner : plain[i].polygon) EXPECT_TRUE(contains(more[i].polygon, corner));
    }
    EXPECT_NEAR(more[2].area_px, 28 * 10, 1e-4);
}

TEST(Aois, NeverMeet) {
    for (const double gap_px : {12.0, 6.0, 4.0}) {
        const std::vector<Aoi> grown = eyes_and_brows(face_with(gap_px), 6);
        int both = 0, any = 0;
        for (double y = 60; y < 120; y += 0.5)
            for (double x = 60; x < 140; x += 0.5) {
                int in = 0;
                for (const Aoi& aoi : grown) in += contains(aoi.polygon, {x, y});
                any += in > 0;
                both += in > 1;
            }
        EXPECT_GT(any, 1000);
        EXPECT_EQ(both, 0) << gap_px;
    }
}

TEST(Aois, AreNotVisibleFromBehindOrOutsideThePicture) {
    for (const Aoi& aoi : eyes_and_brows(face_with(15, -50), 2)) EXPECT_TRUE(aoi.polygon.empty());
    EXPECT_TRUE(aois_of(face_with(15), 0, {"eye_l"}, 100, 0, 100, 200)[0].polygon.empty());
    EXPECT_FALSE(aois_of(face_with(15), 0, {"eye_r"}, 100, 0, 100, 200)[0].polygon.empty());
    EXPECT_TRUE(aois_of(face_with(15), 0, {"mouth"}, 100, 0, 200, 200)[0].polygon.empty())
        << "a rig without these landmarks";
}

/// Browsers take an element of SVG without an end for the parent of the next one, and draw the first alone.
TEST(Aois, EachIsAnElementOfItsOwnInThePage) {
    ClipPlan plan;
    plan.frames = 2;
    plan.width_px = plan.height_px = 10;
    plan.clips.aois = {"eye_l", "eye_r"};
    std::string table = "onset\tduration\tframe\taoi\tvisible\tarea_px\tpolygon\n";
    for (const char* frame : {"0", "1"})
        for (const char* name : {"eye_l", "eye_r"})
            table += std::string("0\t0\t") + frame + "\t" + name + "\t1\t4\t1,1 3,1 3,3\n";
    report::HtmlWriter html;
    draw_aois(table, plan, html);
    const auto count = [&](const std::string& what) {
        int n = 0;
        for (std::size_t at = html.html().find(what); at != std::string::npos;
             at = html.html().find(what, at + 1))
            ++n;
        return n;
    };
    EXPECT_EQ(count("<polygon "), 10) << "two in each of five frames of the strip";
    EXPECT_EQ(count("></polygon>"), 10);
}

}  // namespace
}  // namespace risorius::stimuli
