// SPDX-License-Identifier: MIT
#include "risorius/face/quality.h"

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"

namespace risorius::face {

namespace {

constexpr int kMinIterations = 4, kMouthPasses = 6;

}  // namespace

Quality quality_named(const std::string& name) {
    if (name == "draft")
        return {.name = "draft",
                .min_iterations = kMinIterations,
                .mouth_passes = kMouthPasses,
                .tolerance_rms_m = 0.02e-3,
                .step_s = 2 * kStep_s,
                .max_substep_s = 2 * kStep_s};
    if (name == "preview")
        return {.name = "preview",
                .min_iterations = kMinIterations,
                .mouth_passes = kMouthPasses,
                .tolerance_rms_m = 0.01e-3};
    if (name == "video")
        return {.name = "video",
                .iterations = 160,
                .min_iterations = kMinIterations,
                .tolerance_rms_m = 0.0025e-3,
                .max_substep_s = kStep_s / 2};
    if (name == "fine")
        return {.name = "fine",
                .shell_vertices = 1700,
                .iterations = 240,
                .min_iterations = kMinIterations,
                .tolerance_rms_m = 0.0025e-3,
                .max_substep_s = kStep_s / 2};
    throw Error(option_name("quality"),
                "\"draft\", \"preview\", \"video\" or \"fine\"" +
                    did_you_mean(name, {"draft", "preview", "video", "fine"}),
                "\"" + name + "\"");
}

}  // namespace risorius::face
