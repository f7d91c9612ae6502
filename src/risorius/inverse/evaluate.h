// SPDX-License-Identifier: MIT
/// \file
/// Compares a rig's expressions with measured ones: driven by the rig's own tables, and after a bounded search of activations.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"
#include "risorius/core/types.h"
#include "risorius/scene/expression_score.h"
#include "risorius/track/channels.h"

namespace risorius::inverse {

struct EvaluateOptions {
    std::filesystem::path rig = {}, shapes = {},
                          out = {};      ///< out: a folder; empty: nothing is written
    std::vector<std::string> only = {};  ///< names of shapes; empty: all
    std::string quality = "preview";     ///< quality of the mesh; poses are in equilibrium
    bool separate_sides = false;         ///< left and right shapes are evaluated separately
    bool fit = false;
    bool pictures = true;
};

/// One simulation of an expression.
struct Attempt {
    track::Drive drive;
    scene::ExpressionScore score;
    Points vertices;  ///< V x 3, m, head frame
    int inverted_tets = 0;
    bool converged = true;
};

struct EvaluatedExpression {
    std::string name;
    Points measured;  ///< displacement, V x 3, m
    Attempt table;    ///< with the drive of the rig's own table
    std::optional<Attempt> fitted;
};

/// Means over a list of expressions, with the worst cosine and relative error.
struct ScoreMeans {
    int count = 0;
    double cosine = 0, min_cosine = 1, relative = 0, rms_m = 0, landmark_m = 0;
};

/// A list of expressions with its means.
struct ExpressionGroup {
    std::string key, title;
    std::vector<std::string> names;
};

struct Evaluation {
    std::string name;         ///< of the rig
    std::string rig, shapes;  ///< files
    std::vector<std::string> calibrated_on;
    track::ChannelTable channels;
    std::vector<EvaluatedExpression> expressions;
    int nodes = 0;

    ScoreMeans means(const std::vector<std::string>& names, bool fitted) const;
    /// Lists: all; the sixteen and the twenty-four when all of them are present; those the rig was calibrated on, and the others.
    std::vector<ExpressionGroup> groups() const;
    bool is_calibrated_on(const std::string& expression) const;
    Json json() const;
};

/// The sixteen and the twenty-four expressions for which published and earlier results are given.
const std::vector<std::string>& sixteen_expressions();
const std::vector<std::string>& twenty_four_expressions();

/// Throws Error when rig or shapes cannot be used, Interrupted.
Evaluation evaluate(const EvaluateOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
