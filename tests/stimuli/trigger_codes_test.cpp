// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/trigger_codes.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_of.h"

namespace risorius::stimuli {
namespace {

std::vector<ClipPlan> clips_of(int heads) {
    std::vector<ClipPlan> out;
    for (int head = 0; head < heads; ++head)
        for (const char* expression : {"happiness", "fear"}) {
            ClipPlan plan;
            plan.condition.clip = expression + std::to_string(head);
            plan.condition.values = {{"expression", expression}, {"head", head}};
            out.push_back(plan);
        }
    return out;
}

Json record(const char* clip, const Json& onset) {
    return {{"stim_id", clip},
            {"fps", 10},
            {"frames", 6},
            {"duration_s", 0.6},
            {"movement_onset_frame", onset},
            {"apex_frame", onset}};
}

TEST(TriggerCodes, AreThoseOfMomentsUnlessAskedFor) {
    const CodesOfClips codes = codes_of_clips(clips_of(2), {});
    EXPECT_EQ(codes.table, "");
    EXPECT_EQ(triggers({record("happiness0", 2), record("fear0", Json())}, codes),
              "stim_id\tevent\tcode\tframe\ttime_s\tmerged_into\n"
              "happiness0\tclip_on\t1\t0\t0\tn/a\n"
              "happiness0\tmovement_onset\t2\t2\t0.2\tn/a\n"
              "happiness0\tapex\t3\t2\t0.2\tmovement_onset\n"
              "happiness0\tclip_off\t4\t6\t0.6\tn/a\n"
              "fear0\tclip_on\t1\t0\t0\tn/a\n"
              "fear0\tclip_off\t4\t6\t0.6\tn/a\n");
}

TEST(TriggerCodes, HaveTheOnsetOfSoundInTheNearestFrame) {
    const double fps = record("a", 2).at("fps");
    Json heard = record("a", 2);
    heard["audio"] = {{"onset_s", 1.4 / fps}};
    const CodesOfClips codes;
    EXPECT_NE(triggers({heard}, codes).find("a\tsound_onset\t5\t1\t"), std::string::npos)
        << triggers({heard}, codes);
    // One code for moments of one frame: the sound comes before the movement
    heard["audio"]["onset_s"] = 2 / fps;
    EXPECT_NE(triggers({heard}, codes)
                  .find("a\tmovement_onset\t2\t2\t" + format_number(2 / fps) + "\tsound_onset\n"),
              std::string::npos);
    heard["audio"]["onset_s"] = Json();
    EXPECT_EQ(triggers({heard}, codes).find("sound_onset"), std::string::npos) << "silence";
}

TEST(TriggerCodes, TellTheClipOrWhatIsNamed) {
    design::Design design;
    design.triggers.code_by = {"stim_id"};
    const CodesOfClips each = codes_of_clips(clips_of(2), design);
    EXPECT_EQ(each.table, "code\tstim_id\n10\thappiness0\n11\tfear0\n12\thappiness1\n13\tfear1\n");
    EXPECT_NE(triggers({record("fear1", 2)}, each).find("fear1\tclip_on\t13\t0"),
              std::string::npos);

    design.triggers.code_by = {"expression", "control"};
    std::vector<ClipPlan> clips = clips_of(200);
    ClipPlan reversed = clips.front();
    reversed.condition.clip += "Reversed";
    reversed.condition.control.kind = design::ControlKind::kReversed;
    clips.push_back(reversed);
    const CodesOfClips named = codes_of_clips(clips, design);
    EXPECT_EQ(
        named.table,
        "code\texpression\tcontrol\n10\thappiness\tn/a\n11\tfear\tn/a\n12\thappiness\treversed\n");
    EXPECT_EQ(named.code_of.at("fear199"), 11);
    EXPECT_EQ(named.code_of.at("happiness0Reversed"), 12);
}

TEST(TriggerCodes, AreRefusedWhenThereAreTooFew) {
    design::Design design;
    design.file = "design.json";
    design.triggers.code_by = {"stim_id"};
    EXPECT_EQ(message_of([&] { codes_of_clips(clips_of(120), design); }), "no error");
    EXPECT_EQ(message_of([&] { codes_of_clips(clips_of(121), design); }),
              "design.json:/triggers: expected 241 codes at most; \"code_by\" names the parameters "
              "that they tell, found more");
    design.triggers.code_by = {"age"};
    EXPECT_EQ(message_of([&] { codes_of_clips(clips_of(1), design); }),
              "design.json:/triggers/code_by: expected names of parameters, or \"control\", found "
              "\"age\"");
}

}  // namespace
}  // namespace risorius::stimuli
