// SPDX-License-Identifier: MIT
#include "risorius/scene/visualization.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "risorius/render/overlays.h"

namespace risorius::scene {

namespace {

constexpr double kMaxStrain = 0.4, kMaxError_mm = 5;

/// The edges of the polygons of the skin, each once.
std::vector<std::array<int, 2>> edges_of(const rig::Head& head, const geom::PolygonMesh& mesh) {
    std::vector<std::array<int, 2>> edges;
    for (int f = 0; f < mesh.face_count(); ++f) {
        const auto group = static_cast<std::size_t>(mesh.face_group[static_cast<std::size_t>(f)]);
        if (head.role_of_group[group] != "skin") continue;
        const int begin = mesh.face_begin[static_cast<std::size_t>(f)],
                  count = mesh.corner_count(f);
        for (int k = 0; k < count; ++k) {
            const auto vertex = [&](int corner) {
                const int given = mesh.corner_vertex[static_cast<std::size_t>(begin + corner)];
                return head.welded[static_cast<std::size_t>(given)];
            };
            const int a = vertex(k), b = vertex((k + 1) % count);
            if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

Triangles skin_of(const render::Scene& scene) {
    Triangles skin(0, 3);
    for (const render::Surface& surface : scene.surfaces) {
        if (surface.material != render::Material::kSkin) continue;
        const Eigen::Index before = skin.rows();
        skin.conservativeResize(before + surface.triangles.rows(), 3);
        skin.bottomRows(surface.triangles.rows()) = surface.triangles;
    }
    return skin;
}

/// The mean at each vertex of one number of the two principal strains of its triangles.
template <class Choose>
std::vector<double> mean_strain(const Triangles& skin, const Points& rest, const Points& positions,
                                const Choose& choose) {
    const auto count = static_cast<std::size_t>(rest.rows());
    std::vector<double> sum(count, 0), weight(count, 0);
    for (Eigen::Index f = 0; f < skin.rows(); ++f) {
        const auto side = [&](const Points& at, int k) {
            return Vec3((at.row(skin(f, k)) - at.row(skin(f, 0))).transpose());
        };
        const Vec3 r1 = side(rest, 1), r2 = side(rest, 2), x1 = side(positions, 1),
                   x2 = side(positions, 2);
        const double area = r1.cross(r2).norm();
        if (area <= 0) continue;
        // C = F^T F in an orthonormal frame of the rest triangle. The eigenvalues are squared stretches.
        const double a = r1.norm(), b = r1.dot(r2) / a, h = area / a;
        const double c11 = x1.squaredNorm() / (a * a);
        const double c12 = (x1.dot(x2) - b / a * x1.squaredNorm()) / (a * h);
        const double c22 =
            (x2.squaredNorm() - 2 * b / a * x1.dot(x2) + b * b / (a * a) * x1.squaredNorm()) /
            (h * h);
        const double middle = (c11 + c22) / 2, spread = std::hypot((c11 - c22) / 2, c12);
        const double strain =
            choose(std::sqrt(std::max(0.0, middle - spread)) - 1, std::sqrt(middle + spread) - 1);
        for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(skin(f, k));
            sum[v] += area * strain;
            weight[v] += area;
        }
    }
    for (std::size_t v = 0; v < count; ++v)
        sum[v] = weight[v] > 0 ? sum[v] / weight[v] : std::numeric_limits<double>::quiet_NaN();
    return sum;
}

}  // namespace

StrainRange strain_range(const Triangles& skin, const Points& rest, const Points& positions) {
    StrainRange out;
    out.least = mean_strain(skin, rest, positions, [](double least, double) { return least; });
    out.greatest =
        mean_strain(skin, rest, positions, [](double, double greatest) { return greatest; });
    return out;
}

std::vector<double> principal_strain(const Triangles& skin, const Points& rest,
                                     const Points& positions) {
    return mean_strain(skin, rest, positions, [](double least, double greatest) {
        return std::abs(greatest) >= std::abs(least) ? greatest : least;
    });
}

Visualization::Visualization(render::Show show, const render::Scene& scene, const rig::Head& head,
                             const geom::PolygonMesh& mesh, const render::OffscreenView& view,
                             int width_px, int height_px, const LandmarkPoints& landmarks,
                             std::optional<double> scale)
    : show_(show), scale_end_(scale_end(show, scale)), rest_(scene.rest), landmarks_(landmarks) {
    if (show == render::Show::kStrain || show == render::Show::kError) skin_ = skin_of(scene);
    if (show == render::Show::kArticulation) articulation_.emplace(scene, head);
    if (show == render::Show::kWire) edges_ = edges_of(head, mesh);
    if (show == render::Show::kWire || show == render::Show::kLandmarks)
        surface_.emplace(scene, view.clip_from_world(), width_px, height_px,
                         render::SurfacePasses::Over::kSkinAlone);
}

double Visualization::scale_end(render::Show show, std::optional<double> given) {
    return given.value_or(show == render::Show::kStrain ? kMaxStrain : kMaxError_mm);
}

std::optional<render::SkinValues> Visualization::values(
    const Points& positions, const std::optional<Points>& reference) const {
    if (show_ == render::Show::kStrain)
        return render::SkinValues{.name = "strain",
                                  .unit = "ratio",
                                  .from = -scale_end_,
                                  .to = scale_end_,
                                  .at = principal_strain(skin_, rest_, positions)};
    if (show_ != render::Show::kError || !reference) return std::nullopt;
    render::SkinValues values{.name = "error",
                              .unit = "mm",
                              .from = 0,
                              .to = scale_end_,
                              .at = std::vector<double>(static_cast<std::size_t>(rest_.rows()),
                                                        std::numeric_limits<double>::quiet_NaN())};
    for (Eigen::Index i = 0; i < skin_.size(); ++i) {
        const int v = skin_.data()[i];
        values.at[static_cast<std::size_t>(v)] =
            1e3 * (positions.row(v) - reference->row(v)).norm();
    }
    return values;
}

void Visualization::draw_over(const Points& positions, Image& image) const {
    if (articulation_) return articulation_->draw(positions, image);
    if (!surface_) return;
    const render::SeenSurface seen = surface_->look(positions);
    if (show_ == render::Show::kWire) return draw_wire(edges_, *surface_, seen, image);
    std::vector<render::NamedPoint> points;
    for (const std::string& id : landmarks_.ids())
        points.push_back({id, landmarks_.at(id, positions)});
    draw_landmarks(points, *surface_, seen, image);
}

}  // namespace risorius::scene
