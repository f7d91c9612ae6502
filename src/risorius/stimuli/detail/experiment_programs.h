// The programs of an example of an experiment: what write_experiment() puts beside the clips.
#pragma once

#include <string>

namespace risorius::stimuli {

/// experiment.py, for PsychoPy: the same for every set, it reads settings.json and conditions.csv beside it.
const std::string& psychopy_program();

/// index.html, for jsPsych. `from`: where its packages are, an address or a folder as seen from the page; `settings` and
/// `conditions` as JSON text, because a page that is opened as a file may not read others.
std::string jspsych_page(const std::string& title, const std::string& from,
                         const std::string& settings, const std::string& conditions);

}  // namespace risorius::stimuli
