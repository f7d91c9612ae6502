// SPDX-License-Identifier: MIT
/// \file
/// The HTML page of an evaluation: means, a sortable table, and pictures, numbers and activations of every expression. It has no
/// scripts and loads nothing from the network.
#pragma once

#include <string>

#include "risorius/inverse/detail/evaluation_pictures.h"
#include "risorius/inverse/evaluate.h"

namespace risorius::inverse {

/// Returns the complete page. If `pictures` is null, it has only numbers.
std::string evaluation_page(const Evaluation& evaluation, const EvaluationPictures* pictures);

/// Returns a table for other programs, separated by tabs, with one row per expression and lengths in mm.
std::string evaluation_table(const Evaluation& evaluation);

}  // namespace risorius::inverse
