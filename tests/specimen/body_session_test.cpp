// SPDX-License-Identifier: MIT
// A soft body under a hand: it hangs as the figure of the thesis, follows a pull, and comes back.
#include "risorius/specimen/body_session.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/json_text.h"
#include "risorius/view/pose_frame.h"

namespace risorius::specimen {
namespace {

JsonCursor figure(const std::string& id) {
    return JsonCursor::read_file(data_folder() / "samples/figures" / id / "experiment.json");
}

std::string message(const Json& json) { return json_text(json); }

Json state_of(const BodySession& session) { return Json::parse(session.state()); }

void settle(BodySession& session, int most = 3000) {
    for (int i = 0; i < most && !state_of(session)["resting"].get<bool>(); ++i) session.tick();
    EXPECT_TRUE(state_of(session)["resting"].get<bool>()) << session.state();
}

/// Distance of the lowest plane of nodes from the fixed one, over that at rest.
double length_ratio(const BodySession& session) {
    const auto& body = session.body();
    const auto height = [&](const Points& x, int k) {
        double sum = 0;
        for (int i = 0; i < body.grid.m; ++i)
            for (int j = 0; j < body.grid.n; ++j) sum += x(body.grid.index(i, j, k), 2);
        return sum / (body.grid.m * body.grid.n);
    };
    const int last = body.grid.o - 1;
    return (height(session.positions(), last) - height(session.positions(), 0)) /
           (height(body.rest, last) - height(body.rest, 0));
}

/// The middle of the lowest plane.
int lowest(const BodySession& session) {
    const auto& grid = session.body().grid;
    return grid.index(grid.m / 2, grid.n / 2, 0);
}

TEST(BodySession, TheCubeOfFigure8eHangsAsItsFigure) {
    BodySession session(figure("8e"));
    settle(session);
    // What samples/figures/8e measures at equilibrium
    EXPECT_GE(length_ratio(session), 1.258);
    EXPECT_LE(length_ratio(session), 1.268);
}

TEST(BodySession, APullMovesTheCubeAndNothingIsLeftOfIt) {
    BodySession session(figure("8e"));
    settle(session);
    const Points hanging = session.positions();
    const int node = lowest(session);
    // On the page, the cube is 150 mm wide; 20 mm there are 0.4 m.
    const Vec3 at = session.positions().row(node).transpose();
    const Vec3 middle =
        0.5 * (session.body().rest.colwise().minCoeff() + session.body().rest.colwise().maxCoeff())
                  .transpose();
    const Vec3 p = 0.05 * (at - middle), shown(p.x(), p.z(), -p.y());  // z is up, y on the page
    const Vec3 aim = shown + Vec3(0.02, -0.01, 0);
    EXPECT_TRUE(session
                    .receive(message({{"type", "pull"},
                                      {"pull", 1},
                                      {"vertex", node},
                                      {"stiffness_n_per_m", 500},
                                      {"point_m", {shown.x(), shown.y(), shown.z()}}}))
                    .empty());
    session.receive(
        message({{"type", "pull_to"}, {"pull", 1}, {"point_m", {aim.x(), aim.y(), aim.z()}}}));
    EXPECT_TRUE(session.tick()) << "it moves at once";
    settle(session);
    const Json held = state_of(session)["pulls"][0];
    const Vec3 moved = session.positions().row(node).transpose() - at;
    EXPECT_GT(moved.x(), 0.1) << "of 0.4 m";
    EXPECT_LT(moved.x(), 0.4);
    EXPECT_LT(moved.z(), -0.05) << "of -0.2 m";
    EXPECT_NEAR(held["moved_mm"].get<double>(), 1e3 * moved.norm(), 1e-6);
    const Vec3 stretch = Vec3(0.4, 0, -0.2) - moved;
    EXPECT_NEAR(held["force_n"].get<double>(), 500 * stretch.norm(), 1e-6);
    session.receive(message({{"type", "pull_end"}, {"pull", 1}}));
    EXPECT_TRUE(state_of(session)["pulls"].empty());
    settle(session);
    EXPECT_LT((session.positions() - hanging).rowwise().norm().maxCoeff(),
              1e-4 * session.body().length_scale_m);
}

TEST(BodySession, TheSameMessagesGiveTheSamePoses) {
    const auto play = [] {
        BodySession session(figure("8e"));
        std::string poses;
        const int node = lowest(session);
        for (int tick = 0; tick < 40; ++tick) {
            if (tick == 5)
                session.receive(message({{"type", "pull"},
                                         {"pull", 3},
                                         {"vertex", node},
                                         {"stiffness_n_per_m", 100},
                                         {"point_m", {0.03, 0.01, -0.1}}}));
            if (tick == 20) session.receive(message({{"type", "pull_end"}, {"pull", 3}}));
            session.tick();
            poses += session.pose();
        }
        return poses;
    };
    EXPECT_TRUE(play() == play());
}

TEST(BodySession, PausesAndBeginsAgain) {
    BodySession session(figure("8e"));
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(session.tick());
    session.receive(message({{"type", "pause"}}));
    EXPECT_FALSE(session.tick());
    session.receive(message({{"type", "seek"}, {"t_s", 0}}));
    EXPECT_TRUE(session.positions() == session.body().start().x);
    session.receive(message({{"type", "play"}}));
    EXPECT_TRUE(session.tick());
}

TEST(BodySession, EveryFigureWithABodyThatHasASurfaceCanBePulled) {
    for (const char* id : {"5", "8a", "8c", "8f", "9a", "belly", "cells", "mesh"}) {
        BodySession session(figure(id));
        for (int i = 0; i < 3; ++i) session.tick();
        EXPECT_TRUE(session.events().empty()) << id;
        EXPECT_TRUE(session.positions().allFinite()) << id;
    }
}

TEST(BodySession, SaysWhatIsWrong) {
    BodySession session(figure("8e"));
    const auto error = [&](const Json& json) {
        const auto replies = session.receive(message(json));
        return replies.empty() ? "none" : Json::parse(replies[0])["message"].get<std::string>();
    };
    EXPECT_EQ(error({{"type", "override"}, {"channel", "AU12"}, {"value", 1}}),
              "message:/type: expected what can be done with a soft body: pull, play, pause, seek "
              "to 0, found \"override\"");
    EXPECT_EQ(error({{"type", "seek"}, {"t_s", 1}}), "message:/t_s: expected [0, 0], found 1");
    EXPECT_EQ(error({{"type", "pull"},
                     {"pull", 1},
                     {"vertex", 999},
                     {"point_m", {0, 0, 0}},
                     {"stiffness_n_per_m", 100}}),
              "message:/vertex: expected an integer in [0, 342], found 999");
    EXPECT_EQ(error({{"type", "pull"},
                     {"pull", 1},
                     {"vertex", session.body().fixed[0]},
                     {"point_m", {0, 0, 0}},
                     {"stiffness_n_per_m", 100}}),
              "message:/vertex: expected a node that is not fixed, found " +
                  std::to_string(session.body().fixed[0]));
    try {
        BodySession(figure("twitch"));
        FAIL();
    } catch (const std::exception& wrong) {
        EXPECT_NE(
            std::string(wrong.what())
                .find("expected an experiment with a \"body\", which can be pulled, found none"),
            std::string::npos)
            << wrong.what();
    }
}

}  // namespace
}  // namespace risorius::specimen
