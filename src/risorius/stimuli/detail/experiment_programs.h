// SPDX-License-Identifier: MIT
/// \file
/// The programs of the example experiment, which write_experiment() puts beside the clips.
#pragma once

#include <string>

namespace risorius::stimuli {

/// Returns experiment.py, the program for PsychoPy. It is the same for every set. It reads settings.json and conditions.csv in
/// its folder.
const std::string& psychopy_program();

/// Its second half: the order of the trials, a trial, and main().
const char* psychopy_course();

/// Returns index.html, the program for jsPsych. `from`: the packages of jsPsych, a URL or a folder relative to the page.
/// `settings` and `conditions`: JSON text, included in the page because a page that is opened as a file may not read other files.
std::string jspsych_page(const std::string& title, const std::string& from,
                         const std::string& settings, const std::string& conditions);

/// The scripts of the two pages, which follow what they share.
const char* jspsych_course();
const char* rating_course();

/// Returns rating.html, the page on which raters judge every clip. Its data are what `batch` takes as norms.
std::string rating_page(const std::string& title, const std::string& from,
                        const std::string& settings, const std::string& conditions);

}  // namespace risorius::stimuli
