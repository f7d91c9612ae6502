// SPDX-License-Identifier: MIT
/// \file
/// Quality of a head: distances to the tables of its design, anthropometric measures, and the topology that animation needs. Lengths in mm.
#pragma once

#include <string>
#include <vector>

#include "risorius/headmodel/detail/head_model.h"

namespace risorius::headmodel {

struct MeasureScore {
    std::string measure;
    double length_mm = 0;
    double deviation = 0;  ///< from the mean of the head's sex / standard deviation
};

struct LandmarkMiss {
    std::string landmark;
    double distance_mm = 0;
};

struct HeadQuality {
    /// Distances of the skin from the points of face_depth.csv. `depth`: along their rays. `relief`: to the nearest point of the
    /// skin.
    double depth_rms_mm = 0, relief_rms_mm = 0, relief_worst_mm = 0;
    int rays = 0;
    /// Distances of the skin from the points of head_radius.csv, except those on ears, shoulders and the lowered crown.
    double radius_rms_mm = 0;
    double landmark_rms_mm = 0;
    std::vector<LandmarkMiss> landmarks;  ///< farthest first

    std::vector<MeasureScore> measures;  ///< of the table, in its order

    int vertices = 0, faces = 0;  ///< of skin and mouth
    int triangles = 0;            ///< number of faces of skin and mouth that are not quads
    int self_intersections = 0;   ///< pairs of triangles of skin and mouth
    double quad_fraction = 0,
           unusual_valence_fraction = 0;  ///< of the faces; of inner vertices not 3 to 5
    double mirror_error_mm = 0;
    /// Longest side of a face over its shortest one: median, 99th percentile, maximum.
    double aspect_median = 0, aspect_99 = 0, aspect_worst = 0;
    /// Ratios of lengths on the skin to those in the layout, over the median of the ratios: 1st and 99th percentile. 0 without a
    /// layout.
    double stretch_low = 0, stretch_high = 0;
    int turned_over = 0;  ///< number of faces of the skin that are turned over in the layout

    double worst_deviation() const;  ///< the largest magnitude of a deviation of the measures
};

/// Measures the quality of a head. `sex`: -1 for the means of women, 1 for those of men. If `tables` has no relief, as for an
/// identity, the numbers of the relief are 0.
HeadQuality head_quality(const HeadModel& model, const DesignTables& tables, double sex = 0,
                         bool compare_with_relief = true);

/// Whether triangles of skin or mouth cut each other.
bool runs_through_itself(const HeadModel& model);

std::string quality_report(const HeadQuality& quality);

/// Computes only the measures, which is fast.
std::vector<MeasureScore> measure_head(const HeadModel& model, const DesignTables& tables,
                                       double sex);

}  // namespace risorius::headmodel
