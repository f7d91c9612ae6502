// SPDX-License-Identifier: MIT
/// \file
/// The classification model of an answer: which action units make an observer give it, and how they move then.
///
/// Each unit is correlated with the answer over all trials. Answers that are permuted within each participant say how large the
/// largest correlation over all units is by chance. Units beyond it facilitate or inhibit the answer. Their parameters are tested
/// in the trials that show them, against the answer, and against its intensity where that was rated. Bootstraps of trials give
/// intervals of 95 %.
///
/// Sources: Yu, Garrod, Schyns 2012, Computers & Graphics 36(3), 152-162; Jack, Garrod, Yu, Caldara, Schyns 2012, PNAS 109(19),
/// 7241-7244. Permutation of maxima: Nichols, Holmes 2002, Human Brain Mapping 15, 1-25. Several tests of one unit: Holm 1979,
/// Scandinavian Journal of Statistics 6(2), 65-70.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/design/sample.h"

namespace risorius::stimuli {

/// The answers of one or more participants to random facial movements.
struct Observations {
    std::vector<std::string> units;
    std::vector<design::Trial> trials;
    struct Answer {
        int participant = 0, trial = 0;  ///< trial: an index
        std::string given;
        std::optional<double> intensity = {};  ///< how strong it looked, on any scale
    };
    std::vector<Answer> answers;  ///< those of a participant stand together
    std::vector<std::string> participants;
};

struct ClassificationOptions {
    int permutations = 2000, bootstraps = 2000;
    unsigned seed = 1;
};

/// A number with its interval of 95 %.
struct Estimate {
    double value = 0, low = 0, high = 0;
};

/// What the trials of a unit say about one of its parameters.
struct ParameterModel {
    Estimate model;      ///< the value in the resulting expression
    double r = 0;        ///< correlation with the answer
    double p = 1;        ///< by permutation, corrected for the six parameters
    bool tuned = false;  ///< whether p < 0.05
    /// Correlation with the intensity that was rated in trials with the answer, and p likewise; none with fewer than ten of them
    std::optional<double> r_intensity = {}, p_intensity = {};
};

struct UnitModel {
    std::string unit;
    int shown = 0, answered = 0;  ///< trials that show it, and those of them with the answer
    Estimate r;                   ///< correlation of being shown with the answer
    Estimate weight;              ///< of a logistic model with all units, log odds
    enum class Role { kNone, kFacilitates, kInhibits } role = Role::kNone;
    int found_in =
        0;  ///< participants whose own answers give it the same role, when that is asked for
    std::vector<ParameterModel>
        parameters;  ///< of units with a role, as design::course_parameters()

    /// The course of a unit in the resulting expression; `which`: 0 the model, -1 and 1 the ends of the interval of its amplitude.
    design::UnitCourse course(int which = 0) const;
};

struct AnswerModel {
    std::string answer;
    int trials = 0, given = 0;
    /// What the largest and the smallest correlation of any unit exceed by chance in 2.5 % of permutations each
    double threshold_up = 0, threshold_down = 0;
    std::vector<UnitModel> units;
};

/// Computes the model of an answer.
AnswerModel classification_model(const Observations& observations, const std::string& answer,
                                 const ClassificationOptions& options,
                                 const ProgressMonitor& monitor = {});

}  // namespace risorius::stimuli
