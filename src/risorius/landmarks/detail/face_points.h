// SPDX-License-Identifier: MIT
/// \file
/// Finds the face of a mesh in any position, and the points of the face network on its surface.
///
/// 1. Upright: 24 orientations in small pictures; the one with the highest score, turned and centred on what the network finds.
/// 2. Look: the network sees the face from several sides.
/// 3. Lift: the points of every picture are cast onto the surface. Their weighted geometric median is the point; how far the
///    views differ is its confidence.
#pragma once

#include <optional>
#include <vector>

#include "risorius/landmarks/detail/shown_head.h"
#include "risorius/landmarks/face_network.h"

namespace risorius::landmarks {

/// A point on a surface as several views see it.
struct SeenPoint {
    Vec3 at = Vec3::Zero();  ///< mesh units
    double spread = 0;       ///< weighted mean distance of the views from it, mesh units
    double weight = 0;       ///< sum over the views; 0: no view sees it, and `at` means nothing
};

/// What one view says of a point.
struct Sighting {
    Vec3 at;
    double weight;
};
/// The point with the least weighted sum of distances from what the views say (Weiszfeld 1937).
SeenPoint median_point(const std::vector<Sighting>& sightings);

/// The face of a mesh.
struct FacePoints {
    ViewFrame frame;    ///< from the front, upright, the face in two thirds of the picture
    double score = 0;   ///< mean of the network over the views, 0..1
    double spread = 0;  ///< median of the points, mesh units
    std::vector<SeenPoint> points;  ///< kFacePoints
};

/// Width of a picture two thirds of which are the face, over the distance from the eyes to the mouth.
inline constexpr double kPictureOfFace = 3.8;

/// Turns and centres a frame on the face that the network finds near it, then looks from all sides. Returns nothing when there is
/// no face.
std::optional<FacePoints> look_around(const ShownHead& head, const FaceNetwork& network,
                                      const ViewFrame& near);

/// Finds the frame too. Returns nothing when no orientation shows a face.
std::optional<FacePoints> find_face_points(const ShownHead& head, const FaceNetwork& network);

}  // namespace risorius::landmarks
