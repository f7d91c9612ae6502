// The page of an evaluation: means, a table that can be put in any order, and every expression in pictures, numbers and activations.
// No scripts, nothing from the network.
#pragma once

#include <string>

#include "risorius/inverse/detail/evaluation_pictures.h"
#include "risorius/inverse/evaluate.h"

namespace risorius::inverse {

/// `pictures` null: numbers only.
std::string evaluation_page(const Evaluation& evaluation, const EvaluationPictures* pictures);

/// A row per expression, for other programs: tab-separated, lengths in mm.
std::string evaluation_table(const Evaluation& evaluation);

}  // namespace risorius::inverse
