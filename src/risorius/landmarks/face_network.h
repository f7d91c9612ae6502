// SPDX-License-Identifier: MIT
/// \file
/// A network that finds 468 points of a face in a picture: "facemesh" of MediaPipe (Kartynnik et al. 2019, Real-time facial
/// surface geometry from monocular video on mobile GPUs, arXiv 1907.06724), as a graph model of TensorFlow.js.
///
/// Beside it, a network for the lids of an eye. Their files are no part of the project: tools/web/fetch_weights.sh takes them from npm. They are known by their SHA-256.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "risorius/core/types.h"
#include "risorius/landmarks/detail/layers.h"

namespace risorius::landmarks {

inline constexpr int kFacePoints = 468, kFacePicture_px = 192;

/// What the network says of a picture.
struct FaceAnswer {
    double score = 0;          ///< 0..1: whether there is a face
    std::vector<Vec2> points;  ///< kFacePoints, px to the right and down
    std::vector<double>
        depth;  ///< of the points, px away from the camera, from the middle of the head: a guess of the network
};

class FaceNetwork {
  public:
    /// Reads facemesh.json and facemesh.bin of a folder. Throws Error when they are missing or not the known ones.
    explicit FaceNetwork(const std::filesystem::path& folder);
    ~FaceNetwork();
    FaceNetwork(const FaceNetwork&) = delete;
    FaceNetwork& operator=(const FaceNetwork&) = delete;

    /// `picture`: kFacePicture_px square, red, green, blue, 0..1. Several threads may call it.
    FaceAnswer look_at(const Picture& picture) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

inline constexpr int kEyePoints = 71, kEyePicture_px = 64;

/// A network that finds the lids and the brow of one eye: "iris" of MediaPipe (Ablavatski et al. 2020, Real-time pupil tracking from
/// monocular video for digital puppetry, arXiv 2006.11341). Points 0 to 8 are the lower lid from corner to corner, 9 to 15 the upper
/// one between them.
class EyeNetwork {
  public:
    /// Reads iris.json and iris.bin of a folder. Throws Error when they are missing or not the known ones.
    explicit EyeNetwork(const std::filesystem::path& folder);
    ~EyeNetwork();
    EyeNetwork(const EyeNetwork&) = delete;
    EyeNetwork& operator=(const EyeNetwork&) = delete;

    /// `picture`: kEyePicture_px square, the eye in the middle, 1 / 2.3 of it wide. Returns kEyePoints, px to the right and down.
    /// Several threads may call it.
    std::vector<Vec2> look_at(const Picture& picture) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The folder of the weights: beside the program in a build folder, or with the data of an installation. Throws Error that says
/// what fetches them when they are in neither.
std::filesystem::path weights_folder();

}  // namespace risorius::landmarks
