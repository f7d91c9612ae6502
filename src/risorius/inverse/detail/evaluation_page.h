// SPDX-License-Identifier: MIT
/// \file
/// The HTML page of an evaluation: means, a sortable table, and every expression in pictures, numbers and activations. It has no scripts
/// and loads nothing from the network.
#pragma once

#include <string>

#include "risorius/inverse/detail/evaluation_pictures.h"
#include "risorius/inverse/evaluate.h"

namespace risorius::inverse {

/// `pictures` null: only numbers.
std::string evaluation_page(const Evaluation& evaluation, const EvaluationPictures* pictures);

/// One row per expression for other programs: tab-separated, lengths in mm.
std::string evaluation_table(const Evaluation& evaluation);

}  // namespace risorius::inverse
