// SPDX-License-Identifier: MIT
// A session on the adult: what is played is what is rendered, and the same messages give the same poses.
#include "risorius/view/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "face/adult_face.h"
#include "risorius/core/json_text.h"
#include "risorius/track/timeline.h"
#include "risorius/view/scene_frame.h"

namespace risorius::view {
namespace {

Json smile() {
    return Json::parse(R"({"format": "risorius-script", "version": 1, "rig": "rig.json",
        "duration_s": 0.5, "channels": {"AU12": {"keys": [[0, 0], [0.2, 0.8]]},
        "jaw_open": {"keys": [[0, 0], [0.3, 0.3]]}}, "events": [{"blink": {}, "start_s": 0.1}]})");
}

SessionInputs inputs(const Json& script) {
    auto files = std::make_shared<scene::RigFiles>();
    files->file = rig::adult_rig_file();
    files->rig = rig::adult().rig;
    files->mesh = rig::adult().mesh;
    return {files, JsonCursor::from_json(script, "script.json"), "preview",
            [files](const JsonCursor& json) {
                return track::read_script(json, files->rig.channels(), files->rig.facs,
                                          files->rig.expressions);
            }};
}

std::string message(const Json& json) { return json_text(json); }

Json state_of(const Session& session) { return Json::parse(session.state()); }

Vec3 point_of(const Session& session, int vertex) {
    const Points all = session.drawn_scene().rest;
    return all.row(vertex).transpose();
}

// Nothing else drives the muscle: what is shown of the recording is what drives it.
TEST(Session, ShowsRecordedActivityAsTheFaceGetsIt) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "studio_emg.tsv";
    {
        std::ofstream out(file);
        out << "t\tZYG\n";
        for (int i = 0; i <= 50; ++i) out << i / 100.0 << '\t' << 2.0 * std::min(i, 25) << '\n';
    }
    Json script = smile();
    script["channels"] = Json::object();
    script["events"] = Json::array();
    script["emg"] = {{"file", file.string()},
                     {"time_column", "t"},
                     {"envelope", true},
                     {"maximum", {{"ZYG", 100}}},
                     {"channels", {{"zygomaticus_major.l", "ZYG"}}}};
    const SessionInputs made = inputs(script);
    Session session(made);
    const Json document = Json::parse(session.document());
    ASSERT_EQ(document["recorded"].size(), 1u);
    const auto samples = document["recorded"]["zygomaticus_major.l"].get<std::vector<double>>();
    const auto names = Json::parse(session.welcome())["columns"].get<std::vector<std::string>>();
    const auto column = std::find(names.begin(), names.end(), "zygomaticus_major.l");
    ASSERT_NE(column, names.end());
    const auto read = made.read(JsonCursor::from_json(script, "script.json"));
    const track::Timeline timeline(read, rig::adult().rig.channels());
    const std::size_t last = samples.size() - 1;
    for (std::size_t i = 0; i < last; i += 40)
        EXPECT_NEAR(samples[i],
                    timeline.at(0.5 * static_cast<double>(i) / static_cast<double>(last))
                        .excitation[column - names.begin()],
                    1e-4)
            << i;
    EXPECT_NEAR(*std::max_element(samples.begin(), samples.end()), 0.5, 1e-3);
    EXPECT_TRUE(Json::parse(Session(inputs(smile())).document())["recorded"].empty());
}

// A quad and a triangle: three triangles in two groups, for the page that landmarks are put on.
TEST(SceneFrame, MeshHasItsGroupsAsRangesOfTriangles) {
    geom::PolygonMesh mesh;
    mesh.positions.resize(5, 3);
    mesh.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0.5;
    mesh.face_begin = {0, 3, 7};
    mesh.corner_vertex = {1, 4, 2, 0, 1, 2, 3};
    mesh.face_group = {1, 0};
    mesh.group_names = {"skin", "eye"};
    const std::string bytes = encode_mesh(mesh, {.file = "a/b.obj",
                                                 .rig = "a/b.rig.json",
                                                 .roles = {"skin", "eye_l"},
                                                 .role_of_group = {"skin", ""}});
    std::uint32_t numbers[2];
    std::memcpy(numbers, bytes.data(), sizeof numbers);
    EXPECT_EQ(numbers[0], 5u);
    const Json head = Json::parse(bytes.substr(8, numbers[1]));
    EXPECT_EQ(head["file"], "a/b.obj");
    EXPECT_EQ(head["rig"], "a/b.rig.json");
    EXPECT_EQ(head["groups"],
              Json::parse(R"([{"name": "skin", "from": 0, "count": 2, "role": "skin"},
                                              {"name": "eye", "from": 2, "count": 1, "role": ""}])"));
    EXPECT_EQ(head["roles"], Json::parse(R"(["skin", "eye_l"])"));
    const std::size_t data = 8 + numbers[1];
    float last[3];
    std::memcpy(last, bytes.data() + data + head["vertices"]["at"].get<std::size_t>() + 48, 12);
    EXPECT_EQ(last[2], 0.5f);
    std::uint32_t eye[3];
    std::memcpy(eye, bytes.data() + data + head["triangles"]["at"].get<std::size_t>() + 24, 12);
    EXPECT_EQ(std::vector<std::uint32_t>(eye, eye + 3), (std::vector<std::uint32_t>{1, 4, 2}));
}

TEST(Session, PlaysWhatTheScriptIs) {
    Session session(inputs(smile()));
    session.receive(message({{"type", "play"}}));
    for (int i = 0; i < 200 && state_of(session)["t_s"].get<double>() < 0.4 - 1e-9; ++i)
        session.tick();
    const PoseFrame shown = decode_pose(session.pose(), session.unit_m());

    face::Face face = face::adult_face();
    const auto script = inputs(smile()).read(JsonCursor::from_json(smile(), "script.json"));
    const track::Timeline timeline(script, rig::adult().rig.channels());
    const auto drive = [&](double t) { return timeline.at(t); };
    face.start(drive);
    face.set_gravity(script.header.gravity_m_s2);
    const face::FacePose pose = face.pose_at(0.4, drive);
    const DrawnVertices drawn = drawn_vertices(session.drawn_scene());
    EXPECT_LE((drawn.of(pose.vertices) - shown.vertices).cwiseAbs().maxCoeff(), 0.005e-3 + 1e-9);
    EXPECT_GT((drawn.of(session.drawn_scene().rest) - shown.vertices).cwiseAbs().maxCoeff(), 3e-3);
    // Seeking back shows the same moment again, without simulation.
    session.receive(message({{"type", "pause"}}));
    const std::string before = session.pose();
    session.receive(message({{"type", "seek"}, {"t_s", 0.1}}));
    EXPECT_TRUE(session.tick());
    EXPECT_NE(session.pose().substr(48), before.substr(48));
    session.receive(message({{"type", "seek"}, {"t_s", 0.4}}));
    session.tick();
    EXPECT_EQ(session.pose().substr(48), before.substr(48));
}

TEST(Session, APullMovesTheSkinAndIsRecordedForRender) {
    Session session(inputs(smile()));
    const int vertex = rig::adult().vertex("ch_l");
    const Vec3 p = point_of(session, vertex);
    session.receive(message({{"type", "pull"},
                             {"pull", 1},
                             {"vertex", vertex},
                             {"record", true},
                             {"point_m", {p.x(), p.y(), p.z()}},
                             {"stiffness_n_per_m", 500}}));
    for (int i = 1; i <= 20; ++i) {
        session.receive(message(
            {{"type", "pull_to"}, {"pull", 1}, {"point_m", {p.x() + 5e-4 * i, p.y(), p.z()}}}));
        EXPECT_TRUE(session.tick());
    }
    const Json pulls = state_of(session)["pulls"];
    ASSERT_EQ(pulls.size(), 1u);
    EXPECT_GT(pulls[0]["moved_mm"], 6);
    EXPECT_GT(pulls[0]["force_n"], 0.1);
    const auto replies = session.receive(message({{"type", "pull_end"}, {"pull", 1}}));
    ASSERT_EQ(replies.size(), 1u);
    const Json script = Json::parse(replies[0])["script"];
    ASSERT_EQ(script["pulls"].size(), 1u);
    EXPECT_EQ(script["pulls"][0]["vertex"], vertex);
    EXPECT_EQ(script["pulls"][0]["keys_mm"].size(), 2u);  // the hand moved straight
    for (int i = 0; i < 200 && session.tick(); ++i) {
    }
    EXPECT_TRUE(state_of(session)["resting"]);
    EXPECT_LT((decode_pose(session.pose(), session.unit_m()).vertices -
               drawn_vertices(session.drawn_scene()).of(session.drawn_scene().rest))
                  .cwiseAbs()
                  .maxCoeff(),
              0.5e-3);
    // The recorded pull belongs to the script now: it plays.
    session.receive(message({{"type", "edit"}, {"edits", Json::array({{{"path", "/channels"}}})}}));
    session.receive(message({{"type", "seek"}, {"t_s", 0.3}}));
    for (int i = 0; i < 100 && !session.tick(); ++i) {
    }
    EXPECT_GT((decode_pose(session.pose(), session.unit_m()).vertices -
               drawn_vertices(session.drawn_scene()).of(session.drawn_scene().rest))
                  .col(0)
                  .maxCoeff(),
              6e-3);
    session.receive(message({{"type", "undo"}}));
    session.receive(message({{"type", "undo"}}));
    EXPECT_FALSE(Json::parse(session.document())["script"].contains("pulls"));
}

TEST(Session, OverridesBecomeKeysAndEditsInvalidateOnlyWhatFollows) {
    Session session(inputs(smile()));
    session.receive(message({{"type", "seek"}, {"t_s", 0.5}}));
    for (int i = 0; i < 100 && !session.tick(); ++i) {
    }
    EXPECT_NEAR(state_of(session)["computed_s"].get<double>(), 0.5, 1e-9);
    session.receive(message({{"type", "override"}, {"channel", "AU4"}, {"value", 0.6}}));
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(session.tick());
    EXPECT_EQ(state_of(session)["overrides"]["AU4"], 0.6);
    session.receive(message({{"type", "seek"}, {"t_s", 0.25}}));
    session.receive(message({{"type", "key"}, {"channel", "AU4"}}));
    EXPECT_TRUE(state_of(session)["overrides"].empty());
    Json document = Json::parse(session.document());
    EXPECT_EQ(document["script"]["channels"]["AU4"]["keys"], Json::parse("[[0.25, 0.6]]"));
    EXPECT_EQ(state_of(session)["computed_s"], 0);  // one key holds from the start
    session.receive(message({{"type", "undo"}}));
    session.receive(message({{"type", "seek"}, {"t_s", 0.5}}));
    for (int i = 0; i < 100 && !session.tick(); ++i) {
    }
    session.receive(message(
        {{"type", "edit"},
         {"edits", Json::array({{{"path", "/channels/AU12/keys/2"}, {"value", {0.4, 0.1}}}})}}));
    EXPECT_NEAR(state_of(session)["computed_s"].get<double>(), 0.2, 0.02);
}

TEST(Session, AnEditGoesOnFromAMomentBeforeIt) {
    Json script = smile();
    script["duration_s"] = 1.0;
    script["channels"]["AU12"]["keys"] = Json::parse("[[0, 0], [0.2, 0.6], [0.7, 0.6], [0.9, 0]]");
    const auto compute = [](Session& session, double t_s) {
        session.receive(message({{"type", "seek"}, {"t_s", t_s}}));
        int ticks = 1;
        while (!session.tick() && ticks < 200) ++ticks;
        return ticks;
    };
    Session session(inputs(script));
    EXPECT_GT(compute(session, 0.95), 10) << "58 steps, five a tick";
    session.receive(message(
        {{"type", "edit"},
         {"edits", Json::array({{{"path", "/channels/AU12/keys/3"}, {"value", {0.9, 0.4}}}})}}));
    EXPECT_NEAR(state_of(session)["computed_s"].get<double>(), 0.7, 0.02);
    EXPECT_LE(compute(session, 0.95), 6) << "28 steps from the moment at 0.5 s";
    script["channels"]["AU12"]["keys"][3][1] = 0.4;
    Session fresh(inputs(script));
    compute(fresh, 0.95);
    EXPECT_TRUE(session.pose().substr(8) ==
                fresh.pose().substr(8));  // the number of the tick differs
}

// While a key is dragged, the face is held with the drive of the playhead. Then it is what the script makes of it.
TEST(Session, AnEditShowsTheHeldMomentAndThenTheScript) {
    Json script = smile();
    script["duration_s"] = 1.0;
    script["channels"]["AU12"]["keys"] =
        Json::parse("[[0, 0], [0.2, 0.6], [0.5, 0.6], [0.7, 0.6], [0.9, 0]]");
    const auto key = [](int number, double value) {
        const std::string path = "/channels/AU12/keys/" + std::to_string(number) + "/1";
        return message(
            {{"type", "edit"}, {"edits", Json::array({{{"path", path}, {"value", value}}})}});
    };
    const auto compute = [](Session& session) {
        session.receive(message({{"type", "seek"}, {"t_s", 0.3}}));
        for (int i = 0; i < 100 && !session.tick(); ++i) {
        }
    };
    Session session(inputs(script));
    compute(session);
    const std::string former = session.pose();
    session.receive(key(1, 0.9));
    EXPECT_TRUE(session.tick()) << "it moves at once";
    EXPECT_FALSE(state_of(session)["resting"].get<bool>());
    for (int i = 0; i < 300 && !state_of(session)["resting"].get<bool>(); ++i) session.tick();
    EXPECT_TRUE(state_of(session)["resting"].get<bool>()) << session.state();
    EXPECT_NEAR(state_of(session)["computed_s"].get<double>(), 0.3, 1e-9);
    script["channels"]["AU12"]["keys"][1][1] = 0.9;
    Session fresh(inputs(script));
    compute(fresh);
    const std::string now = session.pose();
    EXPECT_TRUE(now.substr(8) == fresh.pose().substr(8));
    EXPECT_FALSE(now.substr(8) == former.substr(8));
    // An edit after the playhead changes nothing here. The slope at a key depends on its neighbours.
    session.receive(key(4, 0.5));
    session.tick();
    EXPECT_TRUE(state_of(session)["resting"].get<bool>());
    EXPECT_TRUE(session.pose().substr(8) == now.substr(8));
}

// Whatever was edited and however fast: once it rests, the face is that of the script at the playhead.
TEST(Session, FastEditsAndSeeksEndInThePoseOfThePlayhead) {
    std::mt19937 random(5);
    const auto one_of = [&](int count) {
        return static_cast<int>(random() % static_cast<unsigned>(count));
    };
    Json script = smile();
    script["duration_s"] = 1.0;
    Session session(inputs(script));
    for (int round = 0; round < 6; ++round) {
        for (int i = 0; i < 12; ++i) {
            const double t_s = 0.1 * one_of(11);
            const char* channel = one_of(2) ? "AU12" : "AU2";
            const Json messages[]{
                {{"type", "seek"}, {"t_s", t_s}},
                {{"type", "override"}, {"channel", channel}, {"value", 0.25 * one_of(5)}},
                {{"type", "key"}, {"channel", channel}},
                {{"type", "release"}, {"channel", channel}},
                {{"type", "undo"}},
                {{"type", "redo"}}};
            session.receive(message(messages[one_of(6)]));
            for (int tick = one_of(5); tick > 0; --tick) session.tick();
        }
        session.receive(message({{"type", "release"}}));
        for (int i = 0; i < 600 && !state_of(session)["resting"].get<bool>(); ++i) session.tick();
        ASSERT_TRUE(state_of(session)["resting"].get<bool>()) << session.state();
        Session fresh(inputs(Json::parse(session.document())["script"]));
        fresh.receive(message({{"type", "seek"}, {"t_s", state_of(session)["t_s"]}}));
        for (int i = 0; i < 200 && !state_of(fresh)["resting"].get<bool>(); ++i) fresh.tick();
        EXPECT_TRUE(session.pose().substr(8) == fresh.pose().substr(8))
            << "round " << round << " " << session.document();
    }
}

TEST(Session, SaysWhatIsWrongAndGoesOn) {
    Session session(inputs(smile()));
    const auto error = [&](const Json& json) {
        const auto replies = session.receive(message(json));
        return replies.empty() ? "none" : Json::parse(replies[0])["message"].get<std::string>();
    };
    EXPECT_EQ(error({{"type", "play_"}}),
              "message:/type: expected a message of the studio (did you mean \"play\"?), found "
              "\"play_\"");
    EXPECT_EQ(error({{"type", "pull"}, {"pull", 1}, {"vertex", -4}, {"point_m", {0, 0, 0}}}),
              "message:/vertex: expected an integer in [0, " +
                  std::to_string(rig::adult().mesh.vertex_count() - 1) + "], found -4");
    EXPECT_EQ(
        error({{"type", "edit"},
               {"edits", Json::array({{{"path", "/channels/AU12/keys"}, {"value", {{0, 7}}}}})}}),
        "script.json:/channels/AU12/keys/0/1: expected [0, 1], found 7");
    EXPECT_EQ(session.receive("{").size(), 1u);
    EXPECT_EQ(session.receive("[1]").size(), 1u);
    EXPECT_EQ(Json::parse(session.document())["script"], smile());
}

TEST(Session, TheSameMessagesGiveTheSamePoses) {
    std::mt19937 random(11);
    Session session(inputs(smile()));
    const std::vector<int> vertices{rig::adult().vertex("ch_l"), rig::adult().vertex("li"),
                                    rig::adult().vertex("g")};
    const auto number = [&] { return (random() >> 8) * 0x1p-24; };
    for (int i = 0; i < 40; ++i) {
        const int hand = static_cast<int>(random() % 2);
        const int vertex = vertices[random() % vertices.size()];
        const Vec3 p = point_of(session, vertex) + Vec3(number(), number(), number()) * 8e-3;
        switch (random() % 7) {
            case 0:
            case 1:
                session.receive(message({{"type", "pull"},
                                         {"pull", hand},
                                         {"vertex", vertex},
                                         {"record", random() % 3 == 0},
                                         {"point_m", {p.x(), p.y(), p.z()}}}));
                break;
            case 2:
                session.receive(message({{"type", "pull_end"}, {"pull", hand}}));
                break;
            case 3:
                session.receive(
                    message({{"type", "override"}, {"channel", "AU2"}, {"value", number()}}));
                break;
            case 4:
                session.receive(message({{"type", random() % 2 ? "undo" : "redo"}}));
                break;
            case 5:
                session.receive(message({{"type", "play"}}));
                break;
            default:
                session.receive(message(
                    {{"type", "edit"},
                     {"edits",
                      Json::array({{{"path", "/channels/AU12/keys/1/1"}, {"value", number()}}})}}));
        }
        for (unsigned step = random() % 4; step > 0; --step) session.tick();
    }
    Session again(inputs(smile()));
    replay(session.log(), again);
    while (again.ticks() < session.ticks()) again.tick();
    EXPECT_EQ(again.script_text(), session.script_text());
    EXPECT_EQ(again.pose(), session.pose());
    // What has been saved is a script.
    EXPECT_NO_THROW(inputs(smile()).read(
        JsonCursor::from_json(Json::parse(session.script_text()), "saved.json")));
}

}  // namespace
}  // namespace risorius::view
