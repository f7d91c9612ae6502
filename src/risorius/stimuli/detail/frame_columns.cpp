// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/frame_columns.h"

#include <array>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"

namespace risorius::stimuli {

namespace {

/// A column, or all columns that begin or end alike.
struct FrameColumn {
    const char* name;
    const char* description;
    const char* units;  ///< empty: none
};

constexpr std::array kByName{
    FrameColumn{"onset", "Time of the frame from the first one", "s"},
    FrameColumn{"duration", "Duration of the frame", "s"},
    FrameColumn{"frame", "Number of the frame as it is shown, from 0", ""},
    FrameColumn{"source_frame", "Frame of the script that is shown here", ""},
    FrameColumn{"jaw_turn_deg", "Rotation of the jaw about its hinge", "deg"},
    FrameColumn{"incisor_opening_mm", "Way of the lower incisors along the path of opening", "mm"},
    FrameColumn{"condyle_slide_mm", "Way of the condyles forwards", "mm"},
    FrameColumn{"incisor_side_mm", "Way of the lower incisors to the subject's left", "mm"},
    FrameColumn{"tooth_force_n", "Force on all teeth when muscles move the jaw", "N"},
    FrameColumn{"lip_aperture_mm", "Inner upper lip to inner lower lip", "mm"},
    FrameColumn{"lip_width_mm", "Corner to corner of the mouth", "mm"},
    FrameColumn{"lid_aperture_l_mm", "Aperture of the left lids", "mm"},
    FrameColumn{"lid_aperture_r_mm", "Aperture of the right lids", "mm"},
    FrameColumn{"luminance_mean", "Mean relative luminance of the picture, 0 black, 1 white", ""},
    FrameColumn{"luminance_sd", "Standard deviation of relative luminance", ""},
    FrameColumn{"contrast_rms", "luminance_sd / luminance_mean", ""},
    FrameColumn{"motion_energy", "Mean squared change of relative luminance since the last frame",
                ""},
    FrameColumn{"photodiode", "1 where the square of the photodiode is white", ""}};
constexpr std::array kByBegin{
    FrameColumn{"excitation.", "Excitation of a muscle, fraction of the maximum", ""},
    FrameColumn{"activation.", "Activation of a muscle, fraction of the maximum", ""},
    FrameColumn{"emg:", "Simulated electromyogram of a muscle, fraction of the maximum", ""},
    FrameColumn{"eye_yaw_deg.", "Direction of gaze in the world, to the subject's left", "deg"},
    FrameColumn{"eye_pitch_deg.", "Direction of gaze in the world, upwards", "deg"}};
constexpr std::array kByEnd{
    FrameColumn{".x_mm", "Landmark in the world, to the subject's left", "mm"},
    FrameColumn{".y_mm", "Landmark in the world, upwards", "mm"},
    FrameColumn{".z_mm", "Landmark in the world, forwards", "mm"},
    FrameColumn{".u_px", "Landmark in the picture, from its left border", "px"},
    FrameColumn{".v_px", "Landmark in the picture, from its upper border", "px"}};

Json text_of_column(const FrameColumn& column) {
    Json out = json_object({{"Description", column.description}});
    if (*column.units) out["Units"] = column.units;
    return out;
}

Json column_named(const std::string& name) {
    for (const FrameColumn& column : kByName)
        if (name == column.name) return text_of_column(column);
    for (const FrameColumn& column : kByBegin)
        if (name.starts_with(column.name)) return text_of_column(column);
    for (const FrameColumn& column : kByEnd)
        if (name.ends_with(column.name)) return text_of_column(column);
    if (name.starts_with("AU") && name.size() > 2 &&
        std::isdigit(static_cast<unsigned char>(name[2])))
        return json_object({{"Description", "Intensity of an action unit in the script, 0 to 1"}});
    if (name.find("_deg") != std::string::npos)
        return json_object({{"Description", "Rotation by the script"}, {"Units", "deg"}});
    if (name.find("_mm") != std::string::npos)
        return json_object({{"Description", "Distance in the face"}, {"Units", "mm"}});
    return json_object({{"Description", "Channel of the script, or of its speech"}});
}

}  // namespace

std::string frame_columns(const std::string& table, const ClipPlan& plan) {
    Json out = Json::object();
    std::istringstream names(table.substr(0, table.find('\n')));
    for (std::string name; std::getline(names, name, '\t');) out[name] = column_named(name);
    out["StimulusPresentation"] = json_object(
        {{"ScreenDistance", "n/a"}, {"SoftwareName", "Risorius"}, {"FrameRate", plan.fps}});
    return json_text(out, 1) + "\n";
}

}  // namespace risorius::stimuli
