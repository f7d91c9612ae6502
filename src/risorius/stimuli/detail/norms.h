// SPDX-License-Identifier: MIT
/// \file
/// Norms: what raters saw in the clips of a set, from a table of their ratings.
///
///   norms/ratings.csv       the ratings as they were given
///   norms/norms.json        agreement, and hit rates of each answer
///   norms/confusion.tsv     how often each right answer got each answer
///   norms/catch.tsv         with catch trials: how each participant answered their red dots
///
/// Sources: hit rates that do not gain by a liking for an answer: Wagner 1993, Journal of Nonverbal Behavior 17(1), 3-28.
/// Intervals: Wilson 1927, Journal of the American Statistical Association 22, 209-212. Agreement: Fleiss 1971, Psychological
/// Bulletin 76(5), 378-382; Shrout, Fleiss 1979, Psychological Bulletin 86(2), 420-428, ICC(2,k).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::stimuli {

struct Rating {
    std::string participant, clip, answer;
    std::map<std::string, double>
        scales;  ///< of valence, arousal, intensity and naturalness, those that were given
};

/// How a participant answered the red dots of catch trials.
struct CatchTrials {
    int trials = 0, hits = 0;  ///< with a dot, and those in which it was answered
    int other_trials = 0,
        false_alarms = 0;  ///< without one, and times that a dot was answered where none was
};

/// What a table of ratings holds.
struct Ratings {
    std::vector<Rating> given;
    std::map<std::string, CatchTrials>
        catches;  ///< by participant; empty when no row is of a catch trial
};

/// Reads ratings: columns participant, stimulus_id (or stim_id), answer (or response), and scales. Rows whose column "kind" says
/// "practice" are left out; rows of "catch" are no ratings, but tell of attention. Throws Error for clips outside of `clips`.
Ratings read_ratings(const std::filesystem::path& file, const std::vector<std::string>& clips);

/// A share of `count`, with its interval of 95 % by Wilson.
struct Share {
    int hits = 0, count = 0;
    double value() const { return count > 0 ? static_cast<double>(hits) / count : 0; }
    double low() const;
    double high() const;
};

/// What the ratings of a set say.
struct Norms {
    struct OfClip {
        Share hits;                           ///< right answers; count 0: the clip has none
        int ratings = 0;                      ///< answers
        std::string answer;                   ///< the most frequent one
        std::map<std::string, double> means;  ///< of scales
    };
    std::map<std::string, OfClip> clips;
    std::map<std::string, std::map<std::string, int>>
        confusion;                ///< right answer -> answer -> times
    std::optional<double> kappa;  ///< Fleiss; none with fewer than two ratings of a clip
    std::map<std::string, double>
        icc;  ///< ICC(2,k) of scales that several participants gave for all rated clips
    std::map<std::string, CatchTrials> catches;  ///< by participant

    /// Hits squared / (times shown x times answered), for an answer.
    std::optional<double> unbiased_hit_rate(const std::string& answer) const;
    Json json() const;
    std::string confusion_table() const;
    std::string catch_table() const;  ///< empty without catch trials
};

/// `right`: the right answer of each clip that has one.
Norms norms_of(const Ratings& ratings, const std::map<std::string, std::string>& right);

}  // namespace risorius::stimuli
