// SPDX-License-Identifier: MIT
/// \file
/// Brings the anatomy of a rig near measured expressions: parameters of the anatomy and the activations of every expression
/// together, by Gauss-Newton over settled poses.
///
///   minimise  sum over expressions 1/2 |u - g|_w^2 / |g|_w^2 + keep/2 sum (p / spread)^2 + stay/2 sum (a - a_table)^2 + price sum |a|
///
///   p   parameters (parameters.h), 0 as they are     a   activations of one expression, within their range
///   u   displacement of the simulated skin nodes, dx/dp = -H^-1 dg/dp with H the second derivative of the settled face
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "risorius/inverse/fit_activations.h"
#include "risorius/inverse/measured_shapes.h"
#include "risorius/scene/rig_files.h"
#include "tools/calibrate/parameters.h"

namespace risorius::calibrate {

struct Options {
    int rounds = 6;
    double keep =
        4e-3;  ///< total over all parameters at one spread each, per expression, is keep * count / 2
    double stay = 4e-3;
    double price = 2e-3;  ///< half of it for what the table lists, five times for what it does not
    std::string quality = "preview";
};

struct Result {
    Eigen::VectorXd parameters;
    std::vector<Eigen::VectorXd> activations;  ///< per expression, of its unknowns
    std::vector<std::vector<inverse::ActivationUnknown>> unknowns;
    std::vector<double> relative_before, relative_after;
};

Result calibrate(const scene::RigFiles& files, const std::vector<inverse::MeasuredShape>& shapes,
                 const std::vector<Parameter>& parameters, const Options& options,
                 const std::function<void(const std::string&)>& tell);

}  // namespace risorius::calibrate
