// SPDX-License-Identifier: MIT
// What would stop a clip while it is made is refused when the design is checked.
#include <gtest/gtest.h>

#include "risorius/core/error.h"
#include "risorius/stimuli/batch.h"
#include "stimuli/batch_fixture.h"
#include "tools/risorius/check_files.h"

namespace risorius::stimuli {
namespace {

class CheckedClips : public Batch {
  protected:
    static std::string refusal(const Json& json) {
        const fs::path file = folder().path() / "refused.json";
        std::ofstream(file) << json.dump();
        std::string planned;
        try {
            plan_batch(file);
        } catch (const Error& error) {
            planned = error.what();
        }
        EXPECT_EQ(cli::check_file(file).error, planned);
        return planned;
    }
    static Json design_with(const Json& controls) {
        Json json = Json::parse(text_of(design("checked.json", {0.5, 1})));
        json["sets"][0]["controls"] = controls;
        return json;
    }
};

TEST_F(CheckedClips, RefuseAFilterThatIsFinerThanTheFaceHasPixels) {
    // The face has some 22 pixels from zygion to zygion in a picture of 48 x 64.
    const std::string place = (folder().path() / "refused.json, clip smile0p5LowPass8").string();
    EXPECT_EQ(refusal(design_with({{{"control", "low_pass"}, {"cycles_per_face", 8}}}))
                  .find(place + ": expected a face of 32 px or more for cycles_per_face 8 of the "
                                "control lowPass8, found "),
              0u);
    EXPECT_EQ(refusal(design_with({{{"control", "low_pass"}, {"cycles_per_face", 6}}})), "");
    EXPECT_NE(refusal(design_with({{{"control", "band_pass"}, {"cycles_per_face", {2, 9}}}}))
                  .find("expected a face of 36 px or more"),
              std::string::npos);
    // A head that is turned when the clip begins shows fewer.
    Json turned = design_with({{{"control", "low_pass"}, {"cycles_per_face", 6}}});
    turned["sets"][0]["script"]["channels"] = {{"head_yaw_deg", {{"keys", {{0, 40}}}}}};
    EXPECT_NE(refusal(turned).find("expected a face of 24 px or more"), std::string::npos);
    // Pictures show the apex, and the narrowest frame has to do.
    turned["sets"][0]["script"]["channels"] = {
        {"head_yaw_deg", {{"keys", {{0, 0}, {0.4, 40}}}, {"interpolation", "linear"}}}};
    turned["clips"] = {{"ending", "png"}};
    EXPECT_NE(refusal(turned).find("expected a face of 24 px or more"), std::string::npos);
}

TEST_F(CheckedClips, RefuseWhatTheRendererWouldRefuse) {
    Json json = design_with(Json::array());
    json["sets"][0]["script"]["pulls"] = {
        {{"vertex", 99999999}, {"keys_mm", {{0, {0, 0, 0}}, {0.2, {1, 0, 0}}}}}};
    EXPECT_NE(refusal(json).find("/pulls/0/vertex: expected a vertex of the mesh"),
              std::string::npos);
}

TEST_F(CheckedClips, RefuseSpectraOfPicturesOfTwoSizes) {
    Json json = design_with(Json::array());
    json["match"]["luminance"] = {{"within", "face"}, {"spectrum", "rotational"}};
    json["sets"][0]["factors"]["side"] = {48, 64};
    json["sets"][0]["clip"] = "smile_${intensity}_${side}";
    json["sets"][0]["script"]["view"]["width_px"] = "${side}";
    EXPECT_EQ(refusal(json),
              (folder().path() / "refused.json").string() +
                  ":/match/luminance/spectrum: expected pictures of one size, found smile0p564 of "
                  "another one than smile0p548");
}

}  // namespace
}  // namespace risorius::stimuli
