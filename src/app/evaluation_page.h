// The page of an evaluation: means, a table that can be put in any order, and every expression in pictures, numbers and activations.
// No scripts, nothing from the network.
#pragma once

#include <string>

#include "app/evaluate.h"
#include "app/evaluation_pictures.h"

namespace risorius::app {

/// `pictures` null: numbers only.
std::string evaluation_page(const Evaluation& evaluation, const EvaluationPictures* pictures);

/// A row per expression, for other programs: tab-separated, lengths in mm.
std::string evaluation_table(const Evaluation& evaluation);

}  // namespace risorius::app
