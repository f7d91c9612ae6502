// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/template_head.h"

#include "risorius/core/error.h"
#include "risorius/rig/head.h"

namespace risorius::landmarks {

TemplateHead template_head(const std::string& name, geom::PolygonMesh mesh,
                           const std::map<std::string, rig::Landmark>& landmarks,
                           const rig::Atlas& atlas, const FaceNetwork& network) {
    TemplateHead out;
    out.name = name;
    for (const auto& [id, landmark] : landmarks)
        out.landmarks[id] = landmark.vertex >= 0
                                ? Vec3(mesh.positions.row(landmark.vertex).transpose())
                                : landmark.xyz;
    const rig::HeadFrame frame = rig::find_head_frame(out.landmarks, atlas, 1.0);
    mesh.positions = frame.to_head(mesh.positions) / frame.size;
    for (auto& [id, p] : out.landmarks) p = frame.to_head(p) / frame.size;
    out.head = shown_head(mesh, name);

    const Vec3 eyes = 0.5 * (out.landmarks.at("ex_l") + out.landmarks.at("ex_r")),
               mouth = 0.5 * (out.landmarks.at("ch_l") + out.landmarks.at("ch_r"));
    const auto face = look_around(
        out.head, network,
        {0.5 * (eyes + mouth), Mat3::Identity(), kPictureOfFace * (eyes - mouth).norm()});
    if (!face) throw Error(name, "a head in which the network finds a face", "none");
    out.face = face->points;
    return out;
}

}  // namespace risorius::landmarks
