// SPDX-License-Identifier: MIT
/// \file
/// Compares the expressions of a rig with measured ones. Each is simulated twice: with the drive of the rig's tables, and with
/// the activations of a bounded search (fit_activations.h).
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

/// Options of evaluate().
struct EvaluateOptions {
    std::filesystem::path rig = {}, shapes = {},
                          out = {};      ///< out: a folder; empty: nothing is written
    std::vector<std::string> only = {};  ///< names of shapes; empty: all
    std::string quality = "preview";     ///< face::quality_named(); poses are in equilibrium
    bool separate_sides = false;         ///< left and right shapes are evaluated separately
    bool fit = false;
    bool pictures = true;
};

/// A simulation of an expression.
struct Attempt {
    track::Drive drive;
    scene::ExpressionScore score;
    Points vertices;  ///< V x 3, m, head frame
    int inverted_tets = 0;
    bool converged = true;
};

/// A measured expression and its simulations.
struct EvaluatedExpression {
    std::string name;
    Points measured;  ///< displacement, V x 3, m
    Attempt table;    ///< with the drive from the rig's tables
    std::optional<Attempt> fitted;
};

/// Means over a list of expressions, and the worst cosine.
struct ScoreMeans {
    int count = 0;
    double cosine = 0, min_cosine = 1, relative = 0, rms_m = 0, landmark_m = 0;
};

/// A list of expressions and its title.
struct ExpressionGroup {
    std::string key, title;
    std::vector<std::string> names;
};

/// The result of evaluate().
struct Evaluation {
    std::string name;         ///< name of the rig
    std::string rig, shapes;  ///< file names
    std::vector<std::string> calibrated_on;
    track::ChannelTable channels;
    std::vector<EvaluatedExpression> expressions;
    int nodes = 0;

    ScoreMeans means(const std::vector<std::string>& names, bool fitted) const;
    /// The means of several lists: all expressions; the sixteen and the twenty-four ones, if all of them are present; those on
    /// which the rig was calibrated; and the others.
    std::vector<ExpressionGroup> groups() const;
    bool is_calibrated_on(const std::string& expression) const;
    Json json() const;
};

/// The two lists of expressions, sixteen and twenty-four, for which there are published or earlier results.
const std::vector<std::string>& sixteen_expressions();
const std::vector<std::string>& twenty_four_expressions();

/// Evaluates a rig, and writes the page and its files if a folder is given. Throws Error when rig or shapes cannot be used, and
/// Interrupted when the monitor asks to stop.
Evaluation evaluate(const EvaluateOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
