// SPDX-License-Identifier: MIT
#include "risorius/face/anatomy/tissue_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/face/anatomy/inside_skin.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kMinVolume = 0.12;  // minimum volume of a tet / its nominal volume
constexpr int kRepairRounds = 60;
constexpr double kThinnest_mm = 0.8;

// Splits a prism into three tetrahedra. Diagonals start at the vertex of lowest rank, so that neighbours and mirror images agree.
void cut_prism(const std::array<int, 3>& base, const std::vector<int>& rank, Layer bottom,
               Layer top, std::vector<std::array<int, 4>>& out) {
    std::array<int, 3> v = base;
    bool odd = false;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2 - i; ++j)
            if (rank[v[j]] > rank[v[j + 1]]) {
                std::swap(v[j], v[j + 1]);
                odd = !odd;
            }
    const auto b = [&](int k) { return node_of(v[k], bottom); };
    const auto t = [&](int k) { return node_of(v[k], top); };
    const std::array<std::array<int, 4>, 3> tets{
        {{b(0), b(1), b(2), t(2)}, {b(0), b(1), t(2), t(1)}, {b(0), t(1), t(2), t(0)}}};
    for (std::array<int, 4> tet : tets) {
        if (odd) std::swap(tet[1], tet[2]);
        out.push_back(tet);
    }
}

}  // namespace

double interpolate_thickness(const rig::Head& head,
                             const std::vector<rig::ThicknessSample>& samples, const Vec3& p) {
    double sum = 0, weights = 0;
    for (const rig::ThicknessSample& sample : samples) {
        const Vec3 at = head.landmark(sample.landmark) + head.size * sample.offset;
        const double squared = (p - at).squaredNorm() + 1e-10;
        const double w = 1.0 / (squared * squared);
        sum += w * sample.thickness_m * head.size;
        weights += w;
    }
    return sum / weights;
}

namespace {

// Builds the tissue under a shell, step by step in the order of the public functions.
class TissueMaker {
  public:
    TissueMaker(const rig::Head& head, const Shell& shell);

    void choose_thickness(const rig::RigDescription& rig, const std::array<EyeLids, 2>& lids);
    void cut_prisms();
    void measure_triangles();
    void repair_columns();
    TissueMesh take();

  private:
    void place_nodes();
    std::vector<char> find_thin_columns();
    void find_bone_outside();
    void repair_round(const std::vector<char>& thin, bool late);

    const rig::Head& head_;
    const Shell& shell_;
    const int count_;           // columns: vertices of the shell
    const double min_depth_m_;  // of a column that is made thinner
    std::vector<Vec3> skin_;    // of each column
    InsideSkin inside_;
    std::vector<std::set<int>> neighbours_;
    std::vector<double> face_area_;               // of each triangle of the shell, m2
    std::vector<std::array<int, 4>> tets_;        // six for each triangle
    std::vector<char> good_;                      // of each tet: thick enough
    std::vector<char> looked_at_, bone_outside_;  // of each column
    TissueMesh mesh_;
};

Points skin_points(const rig::Head& head, const Shell& shell) {
    Points out(static_cast<long>(shell.vertex.size()), 3);
    for (long v = 0; v < out.rows(); ++v) out.row(v) = head.vertices.row(shell.vertex[v]);
    return out;
}

TissueMaker::TissueMaker(const rig::Head& head, const Shell& shell)
    : head_(head),
      shell_(shell),
      count_(static_cast<int>(shell.vertex.size())),
      min_depth_m_(head.mm(kThinnest_mm)),
      skin_(static_cast<std::size_t>(count_)),
      inside_(skin_points(head, shell), shell.triangles),
      neighbours_(static_cast<std::size_t>(count_)),
      looked_at_(static_cast<std::size_t>(count_), 1),
      bone_outside_(static_cast<std::size_t>(count_), 0) {
    mesh_.direction.resize(static_cast<std::size_t>(count_));
    for (int v = 0; v < count_; ++v) {
        skin_[v] = head.vertices.row(shell.vertex[v]).transpose();
        mesh_.direction[v] = shell.direction.row(shell.vertex[v]).transpose();
    }
}

// How far a point near the lips lies in front of the teeth, within limits, m. The arch of the teeth is a parabola.
double depth_to_teeth(const rig::Head& head, const Vec3& p, double lip_y) {
    const double x_mm = p.x() / head.mm(1);
    const double overjet = head.mm(2.6) * geom::smoothstep(head.mm(2), head.mm(-2), p.y() - lip_y);
    const double arch = head.teeth_front_m - overjet - head.mm(0.03 * x_mm * x_mm);
    return std::clamp(p.z() - arch, head.mm(3), head.mm(14));
}

void TissueMaker::choose_thickness(const rig::RigDescription& rig,
                                   const std::array<EyeLids, 2>& lids) {
    const std::vector<Vec3> lips = lip_line(head_);
    mesh_.thickness_m.resize(static_cast<std::size_t>(count_));
    for (int v = 0; v < count_; ++v) {
        const Vec3& p = skin_[v];
        double thickness = interpolate_thickness(head_, rig.atlas.thickness, p);

        // Lips lie on the teeth
        const double lip =
            1.0 - geom::smoothstep(head_.mm(7), head_.mm(16), geom::distance_to_polyline(p, lips));
        if (lip > 0)
            thickness = (1 - lip) * thickness + lip * depth_to_teeth(head_, p, lips[2].y());
        // Lids lie on the eyeball
        bool on_lid = false;
        for (int side = 0; side < 2; ++side) {
            const double from_centre = (p - lids[side].centre()).norm();
            const double lid =
                1.0 - geom::smoothstep(lids[side].zone_m() - head_.mm(2.5),
                                       lids[side].zone_m() + head_.mm(3), from_centre);
            const double to_globe =
                std::clamp(from_centre - head_.eyes[side].radius_m, head_.mm(1.0), head_.mm(9));
            thickness = (1 - lid) * thickness + lid * to_globe;
            on_lid = on_lid || lid > 0;
        }
        // Elsewhere bone keeps away from the skin of the other side
        if (lip == 0 && !on_lid)
            thickness = inside_.depth(p, mesh_.direction[v], thickness, min_depth_m_);
        mesh_.thickness_m[v] = thickness;
    }
}

void TissueMaker::cut_prisms() {
    // No triangle holds a vertex and its image, so within one the ranks differ.
    std::vector<int> rank(static_cast<std::size_t>(count_));
    for (int v = 0; v < count_; ++v)
        rank[v] = shell_.mirrored.empty() ? v : std::min(v, shell_.mirrored[v]);
    for (long f = 0; f < shell_.triangles.rows(); ++f) {
        const std::array<int, 3> base{shell_.triangles(f, 0), shell_.triangles(f, 1),
                                      shell_.triangles(f, 2)};
        cut_prism(base, rank, kDeep, kMiddle, tets_);
        cut_prism(base, rank, kMiddle, kSkin, tets_);
    }
}

void TissueMaker::measure_triangles() {
    face_area_.resize(static_cast<std::size_t>(shell_.triangles.rows()));
    mesh_.area_m2.assign(static_cast<std::size_t>(count_), 0);
    for (long f = 0; f < shell_.triangles.rows(); ++f) {
        const Vec3 &a = skin_[shell_.triangles(f, 0)], &b = skin_[shell_.triangles(f, 1)],
                   &c = skin_[shell_.triangles(f, 2)];
        face_area_[f] = 0.5 * (b - a).cross(c - a).norm();
        for (int k = 0; k < 3; ++k) {
            mesh_.area_m2[shell_.triangles(f, k)] += face_area_[f] / 3.0;
            neighbours_[shell_.triangles(f, k)].insert(shell_.triangles(f, (k + 1) % 3));
            neighbours_[shell_.triangles(f, (k + 1) % 3)].insert(shell_.triangles(f, k));
        }
    }
}

void TissueMaker::place_nodes() {
    for (int v = 0; v < count_; ++v) {
        mesh_.nodes.row(node_of(v, kSkin)) = skin_[v].transpose();
        mesh_.nodes.row(node_of(v, kMiddle)) =
            (skin_[v] - kMiddleDepth * mesh_.thickness_m[v] * mesh_.direction[v]).transpose();
        mesh_.nodes.row(node_of(v, kDeep)) =
            (skin_[v] - mesh_.thickness_m[v] * mesh_.direction[v]).transpose();
    }
}

// Columns with a tet of too little volume; says of each tet whether it is good.
std::vector<char> TissueMaker::find_thin_columns() {
    good_.assign(tets_.size(), 1);
    std::vector<char> thin(static_cast<std::size_t>(count_), 0);
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Vec3 a = mesh_.nodes.row(tets_[t][0]), b = mesh_.nodes.row(tets_[t][1]),
                   c = mesh_.nodes.row(tets_[t][2]), d = mesh_.nodes.row(tets_[t][3]);
        const double volume = (b - a).dot((c - a).cross(d - a)) / 6.0;
        const long face = static_cast<long>(t / 6);
        const double fraction = t % 6 < 3 ? 1 - kMiddleDepth : kMiddleDepth;
        double thickness = 0;
        for (int k = 0; k < 3; ++k) thickness += mesh_.thickness_m[shell_.triangles(face, k)] / 3.0;
        if (volume < kMinVolume * face_area_[face] * thickness * fraction / 3.0) {
            good_[t] = 0;
            for (int k = 0; k < 3; ++k) thin[shell_.triangles(face, k)] = 1;
        }
    }
    return thin;
}

// Columns whose foot lies outside of the skin.
void TissueMaker::find_bone_outside() {
    for (int v = 0; v < count_; ++v)
        if (looked_at_[v])
            bone_outside_[v] = inside_.outside(mesh_.nodes.row(node_of(v, kDeep)).transpose());
}

// Makes a column with a thin tet thinner and turns it towards its neighbours; turns a column with bone outside of the skin under its own
// skin. In the last rounds, bone inside of the skin is more important than whole columns.
void TissueMaker::repair_round(const std::vector<char>& thin, bool late) {
    std::vector<Vec3> turned = mesh_.direction;
    for (int v = 0; v < count_; ++v) {
        looked_at_[v] = thin[v] || bone_outside_[v];
        if (bone_outside_[v]) {
            const double shrink = late ? 0.7 : 0.9;
            mesh_.thickness_m[v] =
                std::max(late ? 0.4 * min_depth_m_ : min_depth_m_, shrink * mesh_.thickness_m[v]);
            turned[v] =
                late ? inside_.normal(v) : (mesh_.direction[v] + inside_.normal(v)).normalized();
            continue;
        }
        if (late || !thin[v]) continue;
        mesh_.thickness_m[v] = std::max(min_depth_m_, 0.9 * mesh_.thickness_m[v]);
        Vec3 sum = mesh_.direction[v];
        for (int w : neighbours_[v])
            sum += mesh_.direction[w] / static_cast<double>(neighbours_[v].size());
        turned[v] = sum.normalized();
    }
    mesh_.direction = turned;
}

void TissueMaker::repair_columns() {
    mesh_.nodes.resize(kLayers * count_, 3);
    const auto any = [](const std::vector<char>& flags) {
        return std::find(flags.begin(), flags.end(), 1) != flags.end();
    };
    for (int round = 0; round <= kRepairRounds; ++round) {
        place_nodes();
        const std::vector<char> thin = find_thin_columns();
        find_bone_outside();
        if ((!any(thin) && !any(bone_outside_)) || round == kRepairRounds) return;
        repair_round(thin, round >= kRepairRounds - 10);
    }
}

// Returns the mesh of the good tets.
TissueMesh TissueMaker::take() {
    std::vector<std::array<int, 4>> kept;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        if (!good_[t]) {
            ++mesh_.dropped_tets;
            continue;
        }
        kept.push_back(tets_[t]);
        mesh_.tet_layer.push_back(t % 6 < 3 ? kMiddle : kSkin);
    }
    mesh_.tets.resize(static_cast<long>(kept.size()), 4);
    for (std::size_t t = 0; t < kept.size(); ++t)
        for (int k = 0; k < 4; ++k) mesh_.tets(static_cast<long>(t), k) = kept[t][k];
    return std::move(mesh_);
}

}  // namespace

TissueMesh build_tissue_mesh(const rig::Head& head, const rig::RigDescription& rig,
                             const Shell& shell, const std::array<EyeLids, 2>& lids) {
    TissueMaker maker(head, shell);
    maker.choose_thickness(rig, lids);
    maker.cut_prisms();
    maker.measure_triangles();
    maker.repair_columns();
    return maker.take();
}

Shell drop_unsupported_vertices(Shell shell, const rig::Head& head, const rig::RigDescription& rig,
                                const std::array<EyeLids, 2>& lids) {
    while (true) {
        const TissueMesh mesh = build_tissue_mesh(head, rig, shell, lids);
        std::vector<char> bare(shell.vertex.size(), 1);
        for (int node : mesh.tets.reshaped())
            if (node % kLayers == kSkin) bare[static_cast<std::size_t>(node / kLayers)] = 0;
        if (std::find(bare.begin(), bare.end(), 1) == bare.end()) return shell;
        shell = without_vertices(shell, head, bare);
    }
}

}  // namespace risorius::face
