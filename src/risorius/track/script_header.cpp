// SPDX-License-Identifier: MIT
// The header of a script, which is known before the rig is read.
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/existing_file.h"
#include "risorius/track/detail/script_limits.h"
#include "risorius/track/script.h"

namespace risorius::track {

namespace {

constexpr double kMaxGravity_m_s2 = 50;

ScriptLight read_light(const JsonCursor& json) {
    ScriptLight light;
    const auto preset = [&](const JsonCursor& name) {
        light.preset = name.one_of({"studio", "soft", "dramatic", "outdoor", "portrait", "even"});
    };
    if (json.is_string()) {
        preset(json);
        return light;
    }
    json.allow_keys({"preset", "file", "turn_deg", "exposure_ev", "meter"});
    if (const auto v = json.find("preset")) preset(*v);
    if (const auto v = json.find("file")) light.file = existing_file(*v);
    if (const auto v = json.find("turn_deg")) light.turn_deg = v->number({-360, 360});
    if (const auto v = json.find("exposure_ev")) light.exposure_ev = v->number({-10, 10});
    if (const auto v = json.find("meter")) light.for_card = v->one_of({"skin", "card"}) == "card";
    return light;
}

ScriptView read_view(const JsonCursor& json) {
    json.allow_keys({"width_px", "height_px", "camera", "show", "background", "light", "projection",
                     "distance_m", "view_angle_deg", "aperture_mm", "shutter_deg", "antialiasing",
                     "hair"});
    ScriptView view;
    if (const auto v = json.find("light")) view.light = read_light(*v);
    if (const auto v = json.find("projection"))
        view.orthographic = v->one_of({"perspective", "orthographic"}) == "orthographic";
    if (const auto v = json.find("distance_m")) view.distance_m = v->number({0.2, 100});
    if (const auto v = json.find("view_angle_deg")) view.view_angle_deg = v->number({0.5, 90});
    if (const auto v = json.find("aperture_mm")) view.aperture_mm = v->number({0, 100});
    if (const auto v = json.find("shutter_deg")) view.shutter_deg = v->number({0, 360});
    if (const auto v = json.find("antialiasing")) view.antialiasing = v->integer(1, 4);
    if (const auto v = json.find("hair")) view.hair = v->one_of({"own", "none"}) == "own";
    if (const auto v = json.find("width_px")) view.width_px = v->integer(16, 8192);
    if (const auto v = json.find("height_px")) view.height_px = v->integer(16, 8192);
    if (const auto v = json.find("camera"))
        view.camera = v->one_of({"front", "three_quarter", "three_quarter_right", "profile",
                                 "profile_right", "top", "eye", "nose", "mouth", "ear"});
    if (const auto v = json.find("show"))
        view.show =
            v->one_of({"skin", "muscles", "skull", "wire", "strain", "landmarks", "articulation"});
    if (const auto v = json.find("background")) {
        const char* expected = "a colour \"#rrggbb\" or \"transparent\"";
        if (!v->is_string()) v->fail(expected);
        const std::string colour = v->string();
        if (colour == "transparent") {
            view.transparent = true;
        } else {
            if (colour.size() != 7 || colour[0] != '#' ||
                colour.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
                v->fail(expected);
            for (std::size_t i = 0; i < 3; ++i)
                view.background_rgb[i] =
                    std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
        }
    }
    return view;
}

std::optional<Vec3> read_gravity(const JsonCursor& json) {
    if (json.is_array()) {
        const Vec3 gravity = json.vec3();
        if (!(gravity.norm() <= kMaxGravity_m_s2))
            json.fail("an acceleration of at most " + format_number(kMaxGravity_m_s2) + " m/s^2");
        return gravity;
    }
    if (!json.json().is_boolean()) json.fail("true, false or [x, y, z] in m/s^2");
    return json.boolean() ? ScriptHeader{}.gravity_m_s2 : std::nullopt;
}

ScriptHeader read_header(const JsonCursor& json) {
    json.at("format").one_of({"risorius-script"});
    const JsonCursor version = json.at("version");
    if (version.json() != 1) version.fail("1, the version of the format this program reads");
    json.allow_keys({"format", "version", "rig", "fps", "duration_s", "seed", "jaw", "motion",
                     "gravity", "channels", "emg", "events", "view", "weakness", "late_s",
                     "pulls"});
    ScriptHeader header;
    header.rig = json.at("rig").string();
    if (header.rig.empty()) json.at("rig").fail("the path of a rig file");
    header.rig_file = json.at("rig").path();
    if (const auto v = json.find("fps")) header.fps = v->integer(1, 240);
    const JsonCursor duration = json.at("duration_s");
    header.duration_s = duration.number();
    if (!(header.duration_s > 0 && header.duration_s <= kLongest_s))
        duration.fail("(0, " + format_number(kLongest_s) + "]");
    if (header.frame_count() < 1)
        duration.fail("at least one frame at " + std::to_string(header.fps) + " fps");
    if (const auto v = json.find("seed")) header.seed = v->integer(0, 2147483647);
    if (const auto v = json.find("jaw"))
        header.jaw = v->one_of({"channels", "muscles"}) == "muscles" ? JawDrive::kMuscles
                                                                     : JawDrive::kChannels;
    if (const auto v = json.find("motion"))
        header.motion = v->one_of({"dynamic", "quasi_static"}) == "dynamic" ? Motion::kDynamic
                                                                            : Motion::kQuasiStatic;
    if (const auto v = json.find("gravity")) header.gravity_m_s2 = read_gravity(*v);
    if (const auto v = json.find("view")) header.view = read_view(*v);
    return header;
}

}  // namespace

int frame_count(double duration_s, int fps) {
    return static_cast<int>(std::lround(duration_s * fps));
}

int ScriptHeader::frame_count() const { return track::frame_count(duration_s, fps); }

ScriptHeader read_script_header(const std::filesystem::path& file) {
    return read_header(JsonCursor::read_file(file));
}

ScriptHeader read_script_header(const JsonCursor& script) { return read_header(script); }

}  // namespace risorius::track
