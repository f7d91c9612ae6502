// SPDX-License-Identifier: MIT
/// \file
/// Which landmarks of a rig the numbered points of face trackers are.
///
///   mediapipe   478 points of MediaPipe's face mesh. Where they lie on a head was measured: the network looked at pictures of the adult from
///               13 sides, and its points were cast onto the surface (landmarks/detail/face_points.h). Each landmark has the nearest
///               point on either side, or the mean of two; they are 3 mm off in the median, at most 9 mm, at the ends of the brows and the
///               forehead, where displacements are smooth.
///   face68      the points of iBUG 300-W, which dlib, OpenFace and others use (Sagonas et al. 2016, Image Vis. Comput. 47, 3-18). Those of
///               the outline but the chin lie on no fixed place of the skin and are left out.
///
/// Left and right are the subject's.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace risorius::inverse {

/// A landmark of rigs, and the two points of a set whose mean it is; twice the same: it is one point.
struct SetPoint {
    std::string_view landmark;
    std::array<int, 2> points;
};

struct LandmarkSet {
    std::string_view name;  ///< before the number in a column: "mediapipe_33.x"
    int count;
    std::span<const SetPoint> landmarks;
};

const LandmarkSet& mediapipe_points();
const LandmarkSet& face68_points();

}  // namespace risorius::inverse
