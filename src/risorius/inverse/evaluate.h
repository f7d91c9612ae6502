// How near a rig's expressions come to measured ones: driven by its own tables, and after a bounded search of activations.
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
    std::string quality = "preview";     ///< of the mesh; poses are settled
    bool apart = false;                  ///< left and right by themselves
    bool fit = false;
    bool pictures = true;
};

/// One way of showing an expression.
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
    Attempt table;    ///< by the rig's own table
    std::optional<Attempt> fitted;
};

/// Means over a list of expressions; the cosine and relative error of the least good ones beside.
struct ScoreMeans {
    int count = 0;
    double cosine = 0, least_cosine = 1, relative = 0, rms_m = 0, landmark_m = 0;
};

/// Expressions that a mean is given for.
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
    /// All; the sixteen and the twenty-four when every one is there; those the rig was calibrated on, and the others.
    std::vector<ExpressionGroup> groups() const;
    bool is_calibrated_on(const std::string& expression) const;
    Json json() const;
};

/// The sixteen and the twenty-four expressions that published and earlier results are given for.
const std::vector<std::string>& sixteen_expressions();
const std::vector<std::string>& twenty_four_expressions();

/// Throws Error when rig or shapes cannot be used, Interrupted.
Evaluation evaluate(const EvaluateOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::inverse
