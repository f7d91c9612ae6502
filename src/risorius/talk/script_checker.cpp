// SPDX-License-Identifier: MIT
#include "risorius/talk/script_checker.h"

#include "risorius/face/quality.h"

namespace risorius::talk {

ScriptChecker::ScriptChecker(const scene::RigFiles& files, const std::string& quality)
    : files_(files),
      face_(files.rig, files.mesh, face::quality_named(quality), files.place()),
      measures_(face_.head(), files.rig) {}

CheckedSpeech ScriptChecker::check(const JsonCursor& json,
                                   const std::function<void(double fraction)>& report) {
    const track::ChannelTable channels = files_.rig.channels();
    track::ScriptDescription script =
        track::read_script(json, channels, files_.rig.facs, files_.rig.expressions);
    PlannedSpeech speech = plan_speech(script.says, script.header, files_);
    add_to_script(speech, script);
    face_.drive_jaw_by(script.header.jaw);
    face_.set_gravity(script.header.gravity_m_s2);
    face_.move(script.header.motion);
    CheckedSpeech out;
    out.track = simulate_mouth(face_, track::Timeline(script, channels), script.header.duration_s,
                               measures_, report);
    const speech::PhoneTable table = speech::PhoneTable::standard();
    int vowels = 0;
    for (PlacedUtterance& placed : speech.utterances) {
        out.closures.push_back(placed.face ? check_closures(out.track, placed)
                                           : std::vector<ClosureCheck>());
        for (const ClosureCheck& check : out.closures.back()) {
            ++out.total;
            out.reached += check.reached();
            out.held += check.held();
            out.in_time += check.in_time();
            out.opened += check.opened();
        }
        out.vowels.push_back(placed.face ? check_vowels(out.track, placed, table)
                                         : std::vector<VowelCheck>());
        for (const VowelCheck& check : out.vowels.back()) {
            ++vowels;
            out.missing_mm += std::max(0.0, check.planned_mm - check.reached_mm);
        }
        out.utterances.push_back(std::move(placed));
    }
    out.missing_mm /= std::max(1, vowels);
    return out;
}

}  // namespace risorius::talk
