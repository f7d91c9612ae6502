// SPDX-License-Identifier: MIT
/// \file
/// The face that the network sees in a picture, as the motion of its head and the shape of the rest.
///
/// Positions have three axes: x to the right of the picture, which is the subject's left, y up, z towards the camera.
#pragma once

#include <optional>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"
#include "risorius/landmarks/face_network.h"

namespace risorius::perform {

/// The part of a picture that the network looks at: a square that may be rolled.
struct Crop {
    Vec2 centre = Vec2::Zero();  ///< px of the picture, to the right and down
    double side_px = 0;
    double roll = 0;  ///< of the face in the picture, rad, clockwise
};

/// A face in a picture.
struct SeenFace {
    double score = 0;          ///< of the network, 0..1
    std::vector<Vec3> points;  ///< landmarks::kFacePoints, px of the picture
    Crop next;                 ///< where to look in the next picture
};

/// What the network sees in a part of a picture.
SeenFace look_at(const landmarks::FaceNetwork& network, const Image& picture, const Crop& crop);

/// A crop that is a little larger, smaller or shifted, for look 0, 1, 2 ... The answers of the network depend on the crop; the mean of
/// kLooks looks hardly does.
inline constexpr int kLooks = 5;
Crop crop_of_look(const Crop& crop, int look);

/// The mean of kLooks looks.
SeenFace look_closely(const landmarks::FaceNetwork& network, const Image& picture,
                      const Crop& crop);

/// Searches the whole picture for a face and looks twice. Returns nothing when there is none.
std::optional<SeenFace> find_face(const landmarks::FaceNetwork& network, const Image& picture);

/// Head angles, degrees, with the signs of the channels head_yaw_deg, head_pitch_deg and head_roll_deg.
struct HeadAngles {
    double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
};

/// How a face differs from a face at rest.
struct ShapeChange {
    HeadAngles head;
    std::vector<Vec3> moved;  ///< per point, in distances between the outer corners of the eyes
    double left_open = 1, right_open = 1;  ///< eye_aspect() over that at rest
};

/// Forehead, temples and the bridge of the nose say how the head has moved; what the other points have moved beyond that is the
/// change of the shape. `rest` and `now`: kFacePoints each.
ShapeChange change_of(const std::vector<Vec3>& rest, const std::vector<Vec3>& now);

/// The points of the network at brows, nose and mouth, which channels move.
const std::vector<int>& moving_points();

/// Distance between the outer corners of the eyes, px.
double eye_distance(const std::vector<Vec3>& points);

/// Opening of an eye over its width, a ratio.
double eye_aspect(const std::vector<Vec3>& points, bool left);

}  // namespace risorius::perform
