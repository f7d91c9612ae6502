// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/skin_layer.h"

#include "risorius/face/anatomy/detail/attachments.h"

namespace risorius::face {

namespace {

constexpr double kLid_mm = 6.0;  // lids follow the tarsal plate near their margins

// Returns the stiffness of the bed of the skin at each vertex, Pa/m: the fat between skin and middle layer plus the ligaments below.
std::vector<double> bed(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                        const Shell& shell, const TissueMesh& mesh) {
    const double young_pa =
        3 * rig.tissue.superficial_shear_pa;  // Young modulus of nearly incompressible tissue
    std::vector<double> of_shell(shell.vertex.size());
    for (std::size_t v = 0; v < of_shell.size(); ++v)
        of_shell[v] = young_pa / (kMiddleDepth * mesh.thickness_m[v]);
    for (const Attachment& held : place_attachments(head, rig, jaw, shell, mesh))
        of_shell[held.shell_vertex] += held.tangential_n_per_m / mesh.area_m2[held.shell_vertex];
    std::vector<double> out(static_cast<std::size_t>(head.vertices.rows()), young_pa);
    for (std::size_t v = 0; v < out.size(); ++v)
        if (shell.collapsed_to[v] >= 0) out[v] = of_shell[shell.collapsed_to[v]];
    return out;
}

SkinSheetOnBed sheet_of(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                        const std::array<EyeLids, 2>& lids, const Shell& shell,
                        const TissueMesh& mesh) {
    SkinSheetOnBed sheet{.triangles = shell.fine,
                         .rest = head.vertices,
                         .bed_pa_per_m = bed(head, rig, jaw, shell, mesh),
                         .held = std::vector<char>(static_cast<std::size_t>(head.vertices.rows())),
                         .membrane_n_per_m = rig.skin.membrane_n_per_m,
                         .bending_n_m = rig.skin.bending_n_m};
    for (long v = 0; v < head.vertices.rows(); ++v)
        for (const EyeLids& lid : lids)
            if (lid.margin_distance(head.vertices.row(v).transpose()) < head.mm(kLid_mm))
                sheet.held[v] = 1;
    return sheet;
}

}  // namespace

SkinLayer::SkinLayer(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                     const std::array<EyeLids, 2>& lids, const Shell& shell, const TissueMesh& mesh,
                     const SkinBinding& binding)
    : folds_(rig.skin.wrinkles > 0),
      lines_(folds_ ? lay_wrinkle_lines(head, rig, shell.fine) : WrinkleLines{}),
      wrinkles_(lines_, folds_ ? shell.fine : Triangles(0, 3), head.vertices,
                {.strength = rig.skin.wrinkles,
                 .mean_over_m = head.mm(3),
                 .mean_along_crease_m = head.mm(9)}),
      surface_(sheet_of(head, rig, jaw, lids, shell, mesh)),
      cords_(head, rig) {
    if (folds_) cords_.mark(lines_);
    std::vector<char> of_surface(static_cast<std::size_t>(head.vertices.rows()), 0);
    for (long i = 0; i < shell.fine.size(); ++i) of_surface[shell.fine.data()[i]] = 1;
    for (std::size_t v = 0; v < head.welded.size(); ++v)
        if (head.welded[v] != static_cast<int>(v) && of_surface[head.welded[v]])
            alike_.push_back({static_cast<int>(v), head.welded[v]});
    for (const auto& [vertex, like] : binding.followers())
        if (of_surface[head.welded[like]]) alike_.push_back({vertex, head.welded[like]});
    shift_.resize(static_cast<long>(alike_.size()), 3);
}

Points SkinLayer::apply(const Eigen::VectorXd& activation, Points& vertices) const {
    for (std::size_t i = 0; i < alike_.size(); ++i)
        shift_.row(static_cast<long>(i)) = vertices.row(alike_[i].second);
    surface_.relax(vertices);
    Points depth;
    if (folds_) {
        depth.setZero(vertices.rows(), kWrinkleSlots);
        wrinkles_.fold(vertices, depth);
    }
    for (std::size_t i = 0; i < alike_.size(); ++i)
        vertices.row(alike_[i].first) +=
            vertices.row(alike_[i].second) - shift_.row(static_cast<long>(i));
    cords_.raise(activation, vertices, depth);
    return depth;
}

Points SkinLayer::fold_depth(const Eigen::VectorXd& activation, Points vertices) const {
    Points depth;
    if (!folds_) return depth;
    depth.setZero(vertices.rows(), kWrinkleSlots);
    wrinkles_.fold(vertices, depth);
    cords_.raise(activation, vertices, depth);
    return depth;
}

}  // namespace risorius::face
