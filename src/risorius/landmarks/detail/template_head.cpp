// SPDX-License-Identifier: MIT
#include "risorius/landmarks/detail/template_head.h"

#include "risorius/core/error.h"
#include "risorius/rig/head.h"

namespace risorius::landmarks {

namespace {

void add_landmarks(const std::filesystem::path& file, const geom::PolygonMesh& mesh,
                   const rig::Atlas& atlas, std::map<std::string, Vec3>& out) {
    const std::string place = file.string() + ":/landmarks";
    for (const auto& [id, landmark] : rig::read_landmarks(file)) {
        if (!atlas.landmark(id))
            throw Error(place + "/" + id, "a landmark of the atlas", in_quotes(id));
        if (landmark.vertex >= mesh.vertex_count())
            throw Error(
                place + "/" + id + "/vertex",
                "a vertex of the mesh, in [0, " + std::to_string(mesh.vertex_count() - 1) + "]",
                std::to_string(landmark.vertex));
        out[id] = landmark.vertex >= 0
                      ? Vec3(mesh.positions.row(landmark.vertex).transpose())
                      : Vec3((mesh.from_file * landmark.xyz.homogeneous()).head<3>());
    }
}

}  // namespace

std::map<std::string, Vec3> known_landmarks(const TemplateFiles& files,
                                            const geom::PolygonMesh& mesh,
                                            const rig::Atlas& atlas) {
    std::map<std::string, Vec3> out;
    add_landmarks(files.landmarks, mesh, atlas, out);
    if (!files.by_definition.empty()) add_landmarks(files.by_definition, mesh, atlas, out);
    for (const std::string& id : rig::required_landmarks())
        if (!out.count(id))
            throw Error(files.landmarks.string() + ":/landmarks", "the landmarks that a rig needs",
                        "none for " + in_quotes(id));
    return out;
}

TemplateHead template_head(const std::string& name, geom::PolygonMesh mesh,
                           const std::map<std::string, Vec3>& landmarks, const rig::Atlas& atlas,
                           const FaceNetwork& network) {
    TemplateHead out;
    out.name = name;
    out.landmarks = landmarks;
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
