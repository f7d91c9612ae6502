// SPDX-License-Identifier: MIT
/// \file
/// The action units and muscles of a rig as unknowns of a search: what each of them adds to the drive at a weight.
///
/// The weight of a unit is its intensity. The curve from the intensity to the activation is part of what it adds, so that a script
/// plays the weights that were found.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "risorius/scene/rig_files.h"
#include "risorius/track/facs.h"

namespace risorius::inverse {

/// What a unit or a muscle of one side adds to the drive.
struct UnitSource {
    std::string name;
    track::Expansion drives;  ///< at the weight 1
    /// 0 left, 1 right; -1: it has no other half
    int side = -1;
    track::UnitCurves curve;
};

/// A unit or muscle: one side, or both.
struct UnitCandidate {
    std::string name;
    std::vector<std::size_t> sources;
    bool is_unit = true;
    /// How much it has to explain before it is used, relative to the unit that expressions have most often: a rare unit more, a muscle
    /// four times as much
    double cost = 1;
};

class UnitSources {
  public:
    /// `pressure`, `tongue`: whether units of the pressure in the mouth and of the tongue are among them.
    UnitSources(const scene::RigFiles& files, bool pressure, bool tongue);

    long count() const { return static_cast<long>(sources_.size()); }
    const std::vector<UnitCandidate>& candidates() const { return candidates_; }
    /// How many units of a set of candidates the expression, or form of one, lacks that has most of them. Muscles do not count.
    int strangers(const std::set<std::size_t>& candidates) const;
    const UnitSource& at(std::size_t source) const { return sources_[source]; }

    /// The weights of the units of an expression at an intensity; 0 for those that are no sources.
    Eigen::VectorXd weights_of(const track::ExpressionParts& parts, double intensity) const;
    /// The drive of weights, one per source; clamped to the ranges of muscles and channels.
    track::Drive drive_of(const Eigen::VectorXd& weights) const;
    /// The change of the drive per change of the weight of a source, over a tenth of its range.
    track::Expansion change_of(std::size_t source, double weight) const;

  private:
    void set_costs(const track::Expressions& expressions);
    void set_expressions(const track::Expressions& expressions);
    void add(const scene::RigFiles& files, const std::string& set, bool units, bool pressure,
             bool tongue);

    track::ChannelTable channels_;
    std::vector<UnitSource> sources_;
    std::vector<UnitCandidate> candidates_;
    std::vector<std::vector<bool>> expressions_;  ///< each: by candidate, whether it is a part
};

}  // namespace risorius::inverse
