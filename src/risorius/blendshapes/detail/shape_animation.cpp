// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/shape_animation.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "risorius/scene/script_drives.h"
#include "risorius/speech/visemes.h"
#include "risorius/talk/say_event.h"
#include "risorius/track/arkit_names.h"
#include "risorius/track/script.h"

namespace risorius::blendshapes {

namespace {

constexpr double kRadian = 3.14159265358979323846 / 180.0;
constexpr const char* kTurns[] = {"HeadYaw",     "HeadPitch",     "HeadRoll",
                                  "LeftEyeYaw",  "LeftEyePitch",  "LeftEyeRoll",
                                  "RightEyeYaw", "RightEyePitch", "RightEyeRoll"};

// "00:00:01:29.000": hours, minutes, seconds, frame and fraction of the frame
std::string timecode(long frame, int fps) {
    const long seconds = frame / fps;
    char text[96];
    std::snprintf(text, sizeof text, "%02ld:%02ld:%02ld:%02ld.000", seconds / 3600,
                  seconds / 60 % 60, seconds % 60, frame % fps);
    return text;
}

/// Visemes are not fitted to what muscles do: while a script speaks, they have the weights of its curves, so that the lips close.
void use_viseme_weights(const talk::PlannedSpeech& speech, ShapeAnimation& animation) {
    const auto column = [&](std::string_view viseme) {
        const auto found = std::find(animation.shapes.begin(), animation.shapes.end(),
                                     "viseme_" + std::string(viseme));
        return found == animation.shapes.end() ? -1L : found - animation.shapes.begin();
    };
    const speech::PhoneTable table = speech::PhoneTable::standard();
    for (const talk::PlacedUtterance& said : speech.utterances) {
        if (!said.face) continue;
        const auto frame = [&](double t_s) {
            return std::clamp<long>(std::lround((said.start_s + t_s) * animation.fps), 0,
                                    animation.weights.rows());
        };
        const long from = frame(said.targets.start_s), to = frame(said.targets.end_s);
        const Eigen::MatrixXd weights = speech::viseme_weights(
            said.utterance, said.targets, table,
            static_cast<double>(from) / animation.fps - said.start_s, animation.fps, to - from);
        animation.weights.middleRows(from, to - from).setZero();
        for (std::size_t v = 0; v < speech::kVisemeCount; ++v)
            if (const long at = column(speech::oculus_visemes()[v]); at >= 0)
                animation.weights.block(from, at, to - from, 1) = weights.col(static_cast<long>(v));
    }
}

}  // namespace

ShapeAnimation bake_script(const std::filesystem::path& script_file, const scene::RigFiles& files,
                           const std::vector<ShapeGoal>& goals, const ShapeWeights& weights) {
    track::ScriptDescription script = track::read_script(script_file, files.rig.channels(),
                                                         files.rig.facs, files.rig.expressions);
    const talk::PlannedSpeech speech = talk::plan_speech(script.says, script.header, files);
    talk::add_to_script(speech, script);
    scene::ScriptDrives drives(script, files.rig);
    ShapeAnimation out;
    out.name = script_file.stem().string();
    out.fps = script.header.fps;
    for (const ShapeGoal& goal : goals) out.shapes.push_back(goal.name);
    const bool of_visemes = std::any_of(goals.begin(), goals.end(), [](const ShapeGoal& goal) {
        return goal.name.starts_with("viseme_");
    });
    const int frames = script.header.frame_count();
    out.weights.resize(frames, static_cast<long>(goals.size()));
    for (int f = 0; f < frames; ++f) {
        track::Drive drive = drives.at(static_cast<double>(f) / out.fps);
        out.weights.row(f) = weights.of(drive).transpose();
        out.drives.push_back(std::move(drive));
    }
    if (of_visemes) use_viseme_weights(speech, out);
    return out;
}

std::string live_link_table(const ShapeAnimation& animation) {
    const std::vector<std::string>& names = track::arkit_names();
    std::vector<long> columns;  // -1: not among the shapes
    for (const std::string& name : names) {
        const auto found = std::find(animation.shapes.begin(), animation.shapes.end(), name);
        columns.push_back(found == animation.shapes.end() ? -1 : found - animation.shapes.begin());
    }
    std::string out = "Timecode,BlendShapeCount";
    for (std::string name : names) {
        name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
        out += "," + name;
    }
    for (const char* turn : kTurns) out += std::string(",") + turn;
    out += "\n";
    const auto add = [&](double value) {
        char text[32];
        std::snprintf(text, sizeof text, ",%.6f", value == 0 ? 0.0 : value);
        out += text;
    };
    for (long f = 0; f < animation.weights.rows(); ++f) {
        out += timecode(f, animation.fps) + "," + std::to_string(names.size() + std::size(kTurns));
        for (const long column : columns) add(column < 0 ? 0.0 : animation.weights(f, column));
        const track::Drive& drive = animation.drives[static_cast<std::size_t>(f)];
        using track::Kinematic;
        for (const Kinematic k : {Kinematic::kHeadYaw, Kinematic::kHeadPitch, Kinematic::kHeadRoll})
            add(kRadian * drive.at(k));
        add(kRadian * drive.at(Kinematic::kGazeYawLeft));
        add(kRadian * drive.at(Kinematic::kGazePitchLeft));
        add(0);
        add(kRadian * drive.at(Kinematic::kGazeYawRight));
        add(kRadian * drive.at(Kinematic::kGazePitchRight));
        add(0);
        out += "\n";
    }
    return out;
}

}  // namespace risorius::blendshapes
