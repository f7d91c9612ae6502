// SPDX-License-Identifier: MIT
/// \file
/// Simulates scripts with speech on one rig, and checks their closures. The face is built once.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "risorius/face/face.h"
#include "risorius/scene/rig_files.h"
#include "risorius/talk/detail/check_speech.h"

namespace risorius::talk {

struct CheckedSpeech {
    MouthTrack track;
    std::vector<PlacedUtterance> utterances;
    std::vector<std::vector<ClosureCheck>> closures;  ///< of each utterance
    std::vector<std::vector<VowelCheck>> vowels;      ///< the same
    double missing_mm = 0;  ///< by how much the vowels open less than planned, mean
    int reached = 0, held = 0, total = 0;
    int in_time = 0;  ///< closures in which the lips meet when they should
    int opened = 0;   ///< closures that are open again soon after their release
};

class ScriptChecker {
  public:
    /// `quality`: a name of face::quality_named(). The files must outlive this object.
    ScriptChecker(const scene::RigFiles& files, const std::string& quality);

    /// Throws Error when the script cannot be used.
    CheckedSpeech check(const JsonCursor& script,
                        const std::function<void(double fraction)>& report = {});

  private:
    const scene::RigFiles& files_;
    face::Face face_;
    MouthMeasures measures_;
};

}  // namespace risorius::talk
