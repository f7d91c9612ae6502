// SPDX-License-Identifier: MIT
/// \file
/// A head whose landmarks are known, and where the face network sees its points. What the network says of a new head is compared
/// with it, so that the habits of the network cancel.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/landmarks/detail/face_points.h"
#include "risorius/landmarks/propose_landmarks.h"
#include "risorius/rig/atlas.h"
#include "risorius/rig/rig_description.h"

namespace risorius::landmarks {

/// Head frame, m, in the size of the average adult.
struct TemplateHead {
    std::string name;
    ShownHead head;
    std::vector<SeenPoint> face;  ///< kFacePoints
    std::map<std::string, Vec3> landmarks;
};

/// Reads the landmarks of a mesh, in its units and axes. Throws Error when one that a rig needs is missing.
std::map<std::string, Vec3> known_landmarks(const TemplateFiles& files,
                                            const geom::PolygonMesh& mesh, const rig::Atlas& atlas);

/// `landmarks`: in the units of the mesh. Throws Error when the network does not see the face.
TemplateHead template_head(const std::string& name, geom::PolygonMesh mesh,
                           const std::map<std::string, Vec3>& landmarks, const rig::Atlas& atlas,
                           const FaceNetwork& network);

}  // namespace risorius::landmarks
