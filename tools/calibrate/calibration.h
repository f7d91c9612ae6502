// SPDX-License-Identifier: MIT
/// \file
/// Fits the anatomy of a rig to measured expressions: parameters of the anatomy and the activations of every expression together,
/// by Gauss-Newton over equilibrium poses.
///
///   minimise  sum over expressions 1/2 |u - g|_w^2 / |g|_w^2 + keep/2 sum (p / spread)^2 + stay/2 sum (a - a_table)^2 + price sum |a|
///
///   p   parameters (parameters.h), 0 for the given anatomy     a   activations of one expression, within their range
///   u   displacement of the simulated skin nodes, dx/dp = -H^-1 dg/dp with the Hessian H of the face in equilibrium
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
    /// With all parameters at one spread, the total per expression is keep * count / 2
    double keep = 4e-3;
    double stay = 4e-3;
    /// Halved for muscles that the table lists, five times as large for others
    double l1_weight = 2e-3;
    std::string quality = "preview";
};

struct Result {
    Eigen::VectorXd parameters;
    std::vector<Eigen::VectorXd> activations;  ///< one vector per expression
    std::vector<std::vector<inverse::ActivationUnknown>> unknowns;
    std::vector<double> relative_before, relative_after;
};

Result calibrate(const scene::RigFiles& files, const std::vector<inverse::MeasuredShape>& shapes,
                 const std::vector<Parameter>& parameters, const Options& options,
                 const std::function<void(const std::string&)>& tell);

}  // namespace risorius::calibrate
