#include "risorius/face/anatomy/tissue_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/face/anatomy/inside_skin.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kLeastVolume = 0.12;  // of a tet's nominal volume
constexpr int kRepairRounds = 60;
constexpr double kThinnest_mm = 0.8;

// Three tetrahedra per prism, with diagonals from the vertex of least rank so that neighbours agree, and mirror images too.
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

TissueMesh build_tissue_mesh(const rig::Head& head, const rig::RigDescription& rig,
                             const Shell& shell, const std::array<EyeLids, 2>& lids) {
    const int count = static_cast<int>(shell.vertex.size());
    TissueMesh mesh;
    std::vector<Vec3> skin(static_cast<std::size_t>(count));
    mesh.direction.resize(static_cast<std::size_t>(count));
    mesh.thickness_m.resize(static_cast<std::size_t>(count));
    Points coarse(count, 3);
    for (int v = 0; v < count; ++v) coarse.row(v) = head.vertices.row(shell.vertex[v]);
    const InsideSkin inside(coarse, shell.triangles);
    const double least = head.mm(kThinnest_mm);
    const std::vector<Vec3> lips = lip_line(head);
    const double arch_z = head.teeth_front_m;
    for (int v = 0; v < count; ++v) {
        const Vec3 p = head.vertices.row(shell.vertex[v]).transpose();
        skin[v] = p;
        mesh.direction[v] = shell.direction.row(shell.vertex[v]).transpose();
        double thickness = interpolate_thickness(head, rig.atlas.thickness, p);

        // Lips lie on the teeth
        const double lip =
            1.0 - geom::smoothstep(head.mm(7), head.mm(16), geom::distance_to_polyline(p, lips));
        if (lip > 0) {
            const double x_mm = p.x() / head.mm(1);
            const double overjet =
                head.mm(2.6) * geom::smoothstep(head.mm(2), head.mm(-2), p.y() - lips[2].y());
            const double arch = arch_z - overjet - head.mm(0.03 * x_mm * x_mm);
            const double to_arch = std::clamp(p.z() - arch, head.mm(3), head.mm(14));
            thickness = (1 - lip) * thickness + lip * to_arch;
        }
        // Lids lie on the eyeball
        bool on_lid = false;
        for (int side = 0; side < 2; ++side) {
            const double from_centre = (p - lids[side].centre()).norm();
            const double lid =
                1.0 - geom::smoothstep(lids[side].zone_m() - head.mm(2.5),
                                       lids[side].zone_m() + head.mm(3), from_centre);
            const double to_globe =
                std::clamp(from_centre - head.eyes[side].radius_m, head.mm(1.0), head.mm(9));
            thickness = (1 - lid) * thickness + lid * to_globe;
            on_lid = on_lid || lid > 0;
        }
        // Elsewhere no bone comes near the skin of another side
        if (lip == 0 && !on_lid) thickness = inside.depth(p, mesh.direction[v], thickness, least);
        mesh.thickness_m[v] = thickness;
    }

    // No triangle holds a vertex and its image, so within one the ranks differ.
    std::vector<int> rank(static_cast<std::size_t>(count));
    for (int v = 0; v < count; ++v)
        rank[v] = shell.mirrored.empty() ? v : std::min(v, shell.mirrored[v]);
    std::vector<std::array<int, 4>> tets;
    for (long f = 0; f < shell.triangles.rows(); ++f) {
        const std::array<int, 3> base{shell.triangles(f, 0), shell.triangles(f, 1),
                                      shell.triangles(f, 2)};
        cut_prism(base, rank, kDeep, kMiddle, tets);
        cut_prism(base, rank, kMiddle, kSkin, tets);
    }
    std::vector<std::set<int>> neighbours(static_cast<std::size_t>(count));
    std::vector<double> face_area(static_cast<std::size_t>(shell.triangles.rows()));
    mesh.area_m2.assign(static_cast<std::size_t>(count), 0);
    for (long f = 0; f < shell.triangles.rows(); ++f) {
        const Vec3 &a = skin[shell.triangles(f, 0)], &b = skin[shell.triangles(f, 1)],
                   &c = skin[shell.triangles(f, 2)];
        face_area[f] = 0.5 * (b - a).cross(c - a).norm();
        for (int k = 0; k < 3; ++k) {
            mesh.area_m2[shell.triangles(f, k)] += face_area[f] / 3.0;
            neighbours[shell.triangles(f, k)].insert(shell.triangles(f, (k + 1) % 3));
            neighbours[shell.triangles(f, (k + 1) % 3)].insert(shell.triangles(f, k));
        }
    }

    // A tet that is too thin makes the whole column thinner and turns it towards its neighbours; bone outside of the skin
    // turns the column's foot under its own skin.
    mesh.nodes.resize(kLayers * count, 3);
    std::vector<char> good, looked_at(static_cast<std::size_t>(count), 1),
        outside(static_cast<std::size_t>(count), 0);
    for (int round = 0; round <= kRepairRounds; ++round) {
        for (int v = 0; v < count; ++v) {
            mesh.nodes.row(node_of(v, kSkin)) = skin[v].transpose();
            mesh.nodes.row(node_of(v, kMiddle)) =
                (skin[v] - kMiddleDepth * mesh.thickness_m[v] * mesh.direction[v]).transpose();
            mesh.nodes.row(node_of(v, kDeep)) =
                (skin[v] - mesh.thickness_m[v] * mesh.direction[v]).transpose();
        }
        good.assign(tets.size(), 1);
        std::vector<char> bad_vertex(static_cast<std::size_t>(count), 0);
        bool any_bad = false;
        for (std::size_t t = 0; t < tets.size(); ++t) {
            const Vec3 a = mesh.nodes.row(tets[t][0]), b = mesh.nodes.row(tets[t][1]),
                       c = mesh.nodes.row(tets[t][2]), d = mesh.nodes.row(tets[t][3]);
            const double volume = (b - a).dot((c - a).cross(d - a)) / 6.0;
            const long face = static_cast<long>(t / 6);
            const double share = t % 6 < 3 ? 1 - kMiddleDepth : kMiddleDepth;
            double thickness = 0;
            for (int k = 0; k < 3; ++k)
                thickness += mesh.thickness_m[shell.triangles(face, k)] / 3.0;
            if (volume < kLeastVolume * face_area[face] * thickness * share / 3.0) {
                good[t] = 0;
                any_bad = true;
                for (int k = 0; k < 3; ++k) bad_vertex[shell.triangles(face, k)] = 1;
            }
        }
        for (int v = 0; v < count; ++v) {
            if (looked_at[v])
                outside[v] = inside.outside(mesh.nodes.row(node_of(v, kDeep)).transpose());
            any_bad = any_bad || outside[v];
        }
        if (!any_bad || round == kRepairRounds) break;
        // In the end that bone is inside comes before whole columns
        const bool late = round >= kRepairRounds - 10;
        std::vector<Vec3> turned = mesh.direction;
        for (int v = 0; v < count; ++v) {
            looked_at[v] = bad_vertex[v] || outside[v];
            if (outside[v]) {
                const double shrink = late ? 0.7 : 0.9;
                mesh.thickness_m[v] =
                    std::max(late ? 0.4 * least : least, shrink * mesh.thickness_m[v]);
                turned[v] =
                    late ? inside.normal(v) : (mesh.direction[v] + inside.normal(v)).normalized();
                continue;
            }
            if (late || !bad_vertex[v]) continue;
            mesh.thickness_m[v] = std::max(least, 0.9 * mesh.thickness_m[v]);
            Vec3 sum = mesh.direction[v];
            for (int w : neighbours[v])
                sum += mesh.direction[w] / static_cast<double>(neighbours[v].size());
            turned[v] = sum.normalized();
        }
        mesh.direction = turned;
    }
    std::vector<std::array<int, 4>> kept;
    for (std::size_t t = 0; t < tets.size(); ++t) {
        if (!good[t]) {
            ++mesh.dropped_tets;
            continue;
        }
        kept.push_back(tets[t]);
        mesh.tet_layer.push_back(t % 6 < 3 ? kMiddle : kSkin);
    }
    mesh.tets.resize(static_cast<long>(kept.size()), 4);
    for (std::size_t t = 0; t < kept.size(); ++t)
        for (int k = 0; k < 4; ++k) mesh.tets(static_cast<long>(t), k) = kept[t][k];
    return mesh;
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
