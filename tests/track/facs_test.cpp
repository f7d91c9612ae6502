// SPDX-License-Identifier: MIT
#include "risorius/track/facs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "paths.h"
#include "risorius/track/arkit_names.h"
#include "track/standard_tables.h"

namespace risorius::track {
namespace {

Expansion unit(const std::string& name) {
    const UnitUse use =
        unit_named(JsonCursor::from_json(Json::object(), "test"), name, tables().facs);
    return expand(*tables().facs.find(use.unit), use.side, tables().channels);
}

double excitation(const Expansion& expansion, const std::string& column) {
    return expansion.excitation[tables().column(column)];
}

double kinematic(const Expansion& expansion, Kinematic k) {
    return expansion.kinematic[static_cast<std::size_t>(k)];
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

TEST(Facs, StandardTablesHaveEveryMuscleUnitShapeAndExpression) {
    EXPECT_EQ(tables().channels.muscles.size(), 44u);
    EXPECT_EQ(tables().channels.column_count(), 84);  // 40 paired, 4 parts of orbicularis oris
    std::set<int> numbers;
    for (const ActionUnit& u : tables().facs.units) numbers.insert(std::stoi(u.id.substr(2)));
    EXPECT_EQ(numbers.size(), 58u);  // the codes of the manual; 28 and 30 have variants
    EXPECT_EQ(tables().facs.arkit.size(), 52u);
    for (std::size_t i = 0; i < arkit_names().size(); ++i)
        EXPECT_EQ(tables().facs.arkit[i].name, arkit_names()[i]);
    EXPECT_EQ(tables().facs.visemes.size(), 15u);
    for (const char* name : {"neutral", "happiness", "sadness", "anger", "fear", "disgust",
                             "surprise", "contempt", "pain", "embarrassment"})
        EXPECT_NE(tables().expressions.find(name), nullptr) << name;
}

TEST(Facs, EveryUnitDoesSomethingOrSaysWhyNot) {
    for (const ActionUnit& u : tables().facs.units) {
        const Expansion full = expand(u, std::nullopt, tables().channels);
        double sum = full.excitation.cwiseAbs().sum();
        for (double k : full.kinematic) sum += std::abs(k);
        EXPECT_EQ(sum == 0, !u.unsupported.empty()) << u.id;
    }
}

TEST(Facs, SmileUnitPullsBothCorners) {
    const Expansion au12 = unit("AU12");
    EXPECT_GT(excitation(au12, "zygomaticus_major.l"), 0.5);
    double sum = 0;
    for (const MuscleFraction& fraction : tables().facs.find("AU12")->muscles) {
        EXPECT_EQ(excitation(au12, fraction.muscle + ".l"), fraction.weight);
        EXPECT_EQ(excitation(au12, fraction.muscle + ".r"), fraction.weight);
        sum += 2 * fraction.weight;
    }
    EXPECT_NEAR(au12.excitation.sum(), sum, 1e-12);
}

TEST(Facs, OneSidedUnitKeepsItsSide) {
    const Expansion right = unit("AU12.r");
    EXPECT_EQ(excitation(right, "zygomaticus_major.l"), 0.0);
    EXPECT_EQ(excitation(right, "zygomaticus_major.r"),
              excitation(unit("AU12"), "zygomaticus_major.r"));
}

TEST(Facs, LeftAndRightTogetherAreTheWholeUnit) {
    for (const ActionUnit& u : tables().facs.units) {
        if (!u.sided) continue;
        Expansion halves = expand(u, Side::kLeft, tables().channels);
        halves.add(expand(u, Side::kRight, tables().channels), 1);
        const Expansion whole = expand(u, std::nullopt, tables().channels);
        EXPECT_EQ((halves.excitation - whole.excitation).cwiseAbs().maxCoeff(), 0.0) << u.id;
        for (std::size_t k = 0; k < whole.kinematic.size(); ++k)
            EXPECT_EQ(halves.kinematic[k], whole.kinematic[k]) << u.id;
    }
}

TEST(Facs, MillimetresBecomeRatiosOfTheTablesRanges) {
    EXPECT_DOUBLE_EQ(kinematic(unit("AU29"), Kinematic::kJawForward), 8.0 / 9.0);
    EXPECT_DOUBLE_EQ(kinematic(unit("AU19"), Kinematic::kTongueOut), 20.0 / 45.0);
    EXPECT_EQ(kinematic(unit("AU30.l"), Kinematic::kJawSide), 1.0);
    EXPECT_EQ(kinematic(unit("AU30.r"), Kinematic::kJawSide), -1.0);
    EXPECT_EQ(kinematic(unit("AU27"), Kinematic::kJawOpen), 1.2);
    EXPECT_EQ(kinematic(unit("AU34"), Kinematic::kMouthPressure), 2300.0);
    EXPECT_EQ(kinematic(unit("AU35"), Kinematic::kMouthPressure), -2500.0);
}

TEST(Facs, JawMovesAwayFromThePterygoidThatPulls) {
    EXPECT_EQ(excitation(unit("AU30.l"), "pterygoid_lateral_inferior.r"), 1.0);
    EXPECT_EQ(excitation(unit("AU30.l"), "pterygoid_lateral_inferior.l"), 0.0);
}

TEST(Facs, HeadAndEyesTurnTheRightWay) {
    EXPECT_EQ(kinematic(unit("AU51"), Kinematic::kHeadYaw), 45.0);
    EXPECT_EQ(kinematic(unit("AU54"), Kinematic::kHeadPitch), -30.0);
    EXPECT_EQ(kinematic(unit("AU57"), Kinematic::kHeadForward), 60.0);
    const Expansion left = unit("AU61");
    EXPECT_EQ(kinematic(left, Kinematic::kGazeYawLeft), 35.0);
    EXPECT_EQ(kinematic(left, Kinematic::kGazeYawRight), 35.0);
    const Expansion cross = unit("AU66");  // the left eye turns right
    EXPECT_EQ(kinematic(cross, Kinematic::kGazeYawLeft), -12.5);
    EXPECT_EQ(kinematic(cross, Kinematic::kGazeYawRight), 12.5);
    const Expansion one_eye = unit("AU63.r");
    EXPECT_EQ(kinematic(one_eye, Kinematic::kGazePitchLeft), 0.0);
    EXPECT_EQ(kinematic(one_eye, Kinematic::kGazePitchRight), 30.0);
}

TEST(Facs, BlinkTakesLevatorToneAway) {
    const Expansion blink = unit("AU45");
    EXPECT_EQ(excitation(blink, "levator_palpebrae_superioris.l"), -1.0);
    EXPECT_EQ(excitation(blink, "orbicularis_oculi_palpebral_upper.r"), 0.5);
}

TEST(Facs, ArkitShapesReplaceWhatTheirUnitsGive) {
    const auto shape = [](const char* name) {
        return expand(*tables().facs.find_arkit(name), tables().facs, tables().channels);
    };
    EXPECT_EQ(kinematic(shape("jawOpen"), Kinematic::kJawOpen), 0.88);
    EXPECT_EQ(kinematic(shape("jawForward"), Kinematic::kJawForward), 1.0);
    EXPECT_EQ(kinematic(shape("jawRight"), Kinematic::kJawSide), -1.0);
    EXPECT_EQ(excitation(shape("mouthClose"), "mentalis.l"), 0.5);
    EXPECT_EQ(excitation(shape("mouthSmileLeft"), "zygomaticus_major.r"), 0.0);
    EXPECT_EQ(excitation(shape("mouthSmileLeft"), "zygomaticus_major.l"),
              excitation(unit("AU12"), "zygomaticus_major.l"));
    EXPECT_EQ(excitation(shape("mouthRight"), "risorius.r"), 0.6);
    EXPECT_EQ(excitation(shape("mouthRight"), "risorius.l"), 0.0);
    for (const ArkitShape& s : tables().facs.arkit) {
        const Expansion full = expand(s, tables().facs, tables().channels);
        EXPECT_LE(full.excitation.maxCoeff(), 1.0) << s.name;
        EXPECT_GE(full.excitation.minCoeff(), -1.0) << s.name;
    }
}

TEST(Facs, ArkitShapesOfTheTwoSidesMirrorEachOther) {
    const auto mirrored = [](std::string name) {
        const std::size_t at = name.rfind("Left");
        return at == std::string::npos ? std::string() : name.replace(at, 4, "Right");
    };
    int pairs = 0;
    for (const ArkitShape& shape : tables().facs.arkit) {
        const ArkitShape* other = tables().facs.find_arkit(mirrored(shape.name));
        if (!other) continue;
        ++pairs;
        const Expansion l = expand(shape, tables().facs, tables().channels);
        const Expansion r = expand(*other, tables().facs, tables().channels);
        for (const MuscleChannel& m : tables().channels.muscles)
            EXPECT_EQ(l.excitation[tables().channels.column(m.id, Side::kLeft)],
                      r.excitation[tables().channels.column(m.id, Side::kRight)])
                << shape.name << " " << m.id;
    }
    EXPECT_EQ(pairs, 20);
}

TEST(Facs, ContemptIsOneSided) {
    const Expression& contempt = *tables().expressions.find("contempt");
    ASSERT_EQ(contempt.parts.units.size(), 2u);
    for (const ExpressionUnit& part : contempt.parts.units) EXPECT_EQ(part.use.side, Side::kRight);
}

TEST(Facs, BrokenTablesAreRefusedWithPlaceAndReason) {
    const auto reading = [](const char* table) {
        return message_of([&] {
            read_facs(JsonCursor::from_json(Json::parse(table), "facs.json"), tables().channels);
        });
    };
    EXPECT_EQ(
        reading(
            R"({"action_units": {"AU1": {"name": "x", "sided": true, "muscles": {"frontalis_medal": 1}}}})"),
        "facs.json:/action_units/AU1/muscles/frontalis_medal: expected a muscle of the rig (did "
        "you mean "
        "\"frontalis_medial\"?), found \"frontalis_medal\"");
    EXPECT_EQ(
        reading(
            R"({"action_units": {"AU1": {"name": "x", "sided": true, "muscles": {"mentalis": -0.5}}}})"),
        "facs.json:/action_units/AU1/muscles/mentalis: expected [0, 1], found -0.5");
    EXPECT_EQ(
        reading(
            R"({"action_units": {"AU29": {"name": "x", "sided": false, "jaw": {"protrude_mm": 12}}}})"),
        "facs.json:/action_units/AU29/jaw/protrude_mm: expected [0, 9], found 12");
    EXPECT_EQ(reading(R"({"action_units": {"AU1": {"name": "x", "sided": "yes"}}})"),
              "facs.json:/action_units/AU1/sided: expected true or false, found \"yes\"");
    EXPECT_EQ(
        reading(R"({"action_units": {"AU55": {"name": "x", "sided": false, "pictured_on": "l"}}})"),
        "facs.json:/action_units/AU55/pictured_on: expected no side for a unit that cannot be "
        "restricted to one, found \"l\"");
    EXPECT_EQ(reading(R"({"action_units": {}, "arkit": {"jawOpen": {"units": {"AU26": 1}}}})"),
              "facs.json:/arkit/jawOpen/units/AU26: expected an action unit of the rig's FACS "
              "table, found \"AU26\"");
    EXPECT_EQ(message_of([] {
                  read_expressions(
                      JsonCursor::from_json(Json::parse(R"({"expressions": {"joy": {"onset_s": 0.4,
                      "hold_s": 1, "offset_s": 1, "units": {"AU12": {"value": 1, "delay": 1}}}}})"),
                                            "expressions.json"),
                      tables().facs, tables().channels);
              }),
              "expressions.json:/expressions/joy/units/AU12/delay: expected [0, 0.9], found 1");
}

// Checks every number of the anatomy tables that other folders rely on, as far as possible here.
TEST(StandardAnatomy, BandsThicknessAndAttachmentsNameKnownLandmarksAndMuscles) {
    const std::filesystem::path folder =
        std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs" / "standard";
    std::set<std::string> landmarks;
    const JsonCursor table = JsonCursor::read_file(folder / "landmarks.json").at("landmarks");
    for (const JsonCursor& landmark : table.items()) landmarks.insert(landmark.at("id").string());
    EXPECT_EQ(landmarks.size(), 109u);

    int bands = 0;
    const JsonCursor muscles = JsonCursor::read_file(folder / "muscle_bands.json").at("muscles");
    for (const std::string& id : muscles.keys()) {
        EXPECT_NE(tables().channels.find(id), nullptr) << id;
        for (const JsonCursor& band : muscles.at(id).items()) {
            ++bands;
            EXPECT_GT(band.at("width_mm").number(), 0);
            EXPECT_GT(band.at("F0_N").number(), 0);
            EXPECT_GE(band.at("points").items().size(), 2u) << id;
            for (const JsonCursor& point : band.at("points").items())
                EXPECT_EQ(landmarks.count(point.at("landmark").string()), 1u) << point.place();
        }
    }
    EXPECT_EQ(muscles.keys().size(), 28u);
    EXPECT_EQ(bands, 41);

    for (const JsonCursor& point :
         JsonCursor::read_file(folder / "tissue_thickness.json").at("points").items()) {
        EXPECT_EQ(landmarks.count(point.at("landmark").string()), 1u) << point.place();
        EXPECT_GT(point.at("thickness_mm").number(), 1);
        EXPECT_LT(point.at("thickness_mm").number(), 30);
        EXPECT_LT(point.at("offset_mm").vec3().norm(), 40) << point.place();
    }
    const JsonCursor attachments =
        JsonCursor::read_file(folder / "attachments.json").at("attachments");
    for (const std::string& id : attachments.keys()) {
        EXPECT_EQ(landmarks.count(id), 1u) << id;
        EXPECT_EQ(attachments.at(id).items().size(), 2u);
        EXPECT_GE(attachments.at(id).items()[0].number(), 100) << id;
    }
}

}  // namespace
}  // namespace risorius::track
