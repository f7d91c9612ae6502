// SPDX-License-Identifier: MIT
/// \file
/// The face that the network sees in a picture, as the motion of its head and the shape of the rest.
///
/// Positions have three axes: x to the right of the picture, which is the subject's left, y up, z towards the camera.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/types.h"
#include "risorius/landmarks/face_network.h"

namespace risorius::perform {

/// The networks that look at pictures.
struct Networks {
    /// Reads both. Throws Error when a file is missing or not the known one.
    explicit Networks(const std::filesystem::path& folder) : face(folder), eye(folder) {}

    landmarks::FaceNetwork face;
    landmarks::EyeNetwork eye;
};

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
    /// Lids and brow of the left and of the right eye, kEyePoints each: x to the right and y down from the middle of the eye, along
    /// the line of its corners, in widths of the eye
    std::array<std::vector<Vec2>, 2> eyes;
    Crop next;  ///< where to look in the next picture
};

/// What the network sees in a part of a picture, without the eyes.
SeenFace look_at(const landmarks::FaceNetwork& network, const Image& picture, const Crop& crop);
/// Looks at both eyes of a face.
void look_at_eyes(const landmarks::EyeNetwork& network, const Image& picture, SeenFace& face);

/// A crop that is a little larger, smaller or shifted, for look 0, 1, 2 ... The answers of the network depend on the crop; the mean of
/// kLooks looks hardly does.
inline constexpr int kLooks = 5;
Crop crop_of_look(const Crop& crop, int look);

/// kLooks looks.
std::vector<SeenFace> looks_at(const landmarks::FaceNetwork& network, const Image& picture,
                               const Crop& crop);
/// Their mean, with its eyes.
SeenFace mean_look(const Networks& networks, const Image& picture,
                   const std::vector<SeenFace>& looks);

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
    std::array<std::vector<Vec2>, 2> eyes;  ///< SeenFace::eyes, in the same unit
};

/// Forehead, temples and the bridge of the nose say how the head has moved; what the other points have moved beyond that is the
/// change of the shape.
ShapeChange change_of(const SeenFace& rest, const SeenFace& now);

/// A change as numbers: x and y of the points at brows, nose and mouth, then those of the eyes. Depth is a guess of the network and
/// left out.
Eigen::VectorXd numbers_of(const ShapeChange& change);

/// Distance between the outer corners of the eyes, px.
double eye_distance(const std::vector<Vec3>& points);

}  // namespace risorius::perform
