// SPDX-License-Identifier: MIT
/// \file
/// Sentences of methods.md about controls and about the course of an experiment, and the works that they name.
#pragma once

#include <string>

#include "risorius/stimuli/batch.h"

namespace risorius::stimuli {

/// Returns how the controls of a set were made, a line for each kind; empty when there are none.
std::string controls_text(const BatchPlan& plan);

/// Returns how an experiment chose the clip of a trial, and which codes went out.
std::string course_text(const BatchPlan& plan);

/// Returns the works that the text names, as BibTeX.
std::string sources_text(const BatchPlan& plan);

}  // namespace risorius::stimuli
