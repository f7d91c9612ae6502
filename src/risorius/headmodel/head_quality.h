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
    /// Of the skin along the rays of face_depth.csv; and of its nearest point from theirs.
    double depth_rms_mm = 0, relief_rms_mm = 0, relief_worst_mm = 0;
    int rays = 0;
    /// Of the skin from the points of head_radius.csv that are neither ear, shoulder nor lowered crown.
    double radius_rms_mm = 0;
    double landmark_rms_mm = 0;
    std::vector<LandmarkMiss> landmarks;  ///< farthest first

    std::vector<MeasureScore> measures;  ///< of the table, in its order

    int vertices = 0, faces = 0;  ///< of skin and mouth
    int triangles = 0;            ///< faces of skin and mouth that are no quads
    int self_intersections = 0;   ///< pairs of triangles of skin and mouth
    double quad_fraction = 0,
           unusual_valence_fraction = 0;  ///< of the faces; of inner vertices not 3 to 5
    double mirror_error_mm = 0;
    /// Longest side of a face / its shortest: median, 99th of a hundred, greatest.
    double aspect_median = 0, aspect_99 = 0, aspect_worst = 0;
    /// Of lengths on the skin over those of the layout, to their median: 1st and 99th of a hundred. 0 without a layout.
    double stretch_low = 0, stretch_high = 0;
    int turned_over = 0;  ///< faces of the skin that lie on their face in the layout

    double worst_deviation() const;  ///< greatest of the measures, either way
};

/// `sex` is -1 for the means of women, 1 for those of men. With `tables` empty of relief (an identity) that part stays 0.
HeadQuality head_quality(const HeadModel& model, const DesignTables& tables, double sex = 0,
                         bool compare_with_relief = true);

std::string quality_report(const HeadQuality& quality);

/// The measures alone, quickly.
std::vector<MeasureScore> measure_head(const HeadModel& model, const DesignTables& tables,
                                       double sex);

}  // namespace risorius::headmodel
