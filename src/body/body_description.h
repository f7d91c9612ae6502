// A soft object as an experiment file describes it: its kind, grid, size, material, what holds it and what acts on it.
#pragma once

#include <string>

#include "tissue/solid_material.h"

namespace risorius::body {

enum class Discretisation {
    kDifferences,  ///< A, the thesis' finite differences
    kCells         ///< B, trilinear cells with exact volume
};

}  // namespace risorius::body
