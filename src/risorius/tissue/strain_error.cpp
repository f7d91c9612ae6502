// SPDX-License-Identifier: MIT
#include "risorius/tissue/strain_error.h"

#include <cmath>

namespace risorius::tissue {

namespace {

/// The recovered quantities: metric strain, and dilatation as in the volume energy.
struct SmoothStrain {
    Mat3 metric = Mat3::Zero();
    double dilatation = 0;  ///< (V_c - V_c0) / (h1 h2 h3), m^3; with moduli V_c / V_c0 - 1

    void add(double weight, const SmoothStrain& other) {
        metric += weight * other.metric;
        dilatation += weight * other.dilatation;
    }
};

struct CellStrain {
    std::array<Mat3, 8> point;  ///< metric strain at the Gauss points
    SmoothStrain mean;
};

std::vector<CellStrain> strain_of_cells(const CellSolid& solid, const Points& vertices) {
    const auto& cells = solid.mesh().cells();
    const Points rest = solid.vertices(solid.body().rest);
    std::vector<CellStrain> strain(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        Mat3 at[8];
        solid.metric_strain(vertices, static_cast<int>(c), at);
        for (std::size_t g = 0; g < 8; ++g) {
            strain[c].point[g] = at[g];
            strain[c].mean.metric += 0.125 * at[g];
        }
        const double volume = cell_volume(cells[c], vertices), before = cell_volume(cells[c], rest);
        const double unit = solid.body().moduli.empty() ? cells[c].size.prod() : before;
        strain[c].mean.dilatation = (volume - before) / unit;
    }
    return strain;
}

/// Means over the cells around each vertex, weighted by size.
std::vector<SmoothStrain> strain_of_vertices(const CellMesh& mesh,
                                             const std::vector<CellStrain>& cells) {
    std::vector<SmoothStrain> mean(static_cast<std::size_t>(mesh.vertex_count()));
    std::vector<double> whole(mean.size(), 0.0);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const double weight = mesh.cells()[c].size.prod();
        for (const int vertex : mesh.cells()[c].vertex) {
            mean[static_cast<std::size_t>(vertex)].add(weight, cells[c].mean);
            whole[static_cast<std::size_t>(vertex)] += weight;
        }
    }
    for (std::size_t v = 0; v < mean.size(); ++v) {
        mean[v].metric /= whole[v];
        mean[v].dilatation /= whole[v];
    }
    // Hanging vertices follow their nodes. Otherwise E* would jump towards the larger cell beside them.
    for (std::size_t h = 0; h < mesh.hanging().size(); ++h) {
        const CellMesh::Hanging& hanging = mesh.hanging()[h];
        SmoothStrain sum;
        for (int k = 0; k < hanging.count; ++k)
            sum.add(1.0 / hanging.count,
                    mean[static_cast<std::size_t>(hanging.node[static_cast<std::size_t>(k)])]);
        mean[static_cast<std::size_t>(mesh.node_count()) + h] = sum;
    }
    return mean;
}

}  // namespace

std::vector<Mat3> smooth_strain(const CellSolid& solid, const Points& x) {
    const auto mean = strain_of_vertices(solid.mesh(), strain_of_cells(solid, solid.vertices(x)));
    std::vector<Mat3> strain;
    strain.reserve(mean.size());
    for (const SmoothStrain& one : mean) strain.push_back(one.metric);
    return strain;
}

Eigen::VectorXd squared_error(const CellSolid& solid, const Points& x) {
    const CellMesh& mesh = solid.mesh();
    const CellBody& body = solid.body();
    const std::vector<CellStrain> strain = strain_of_cells(solid, solid.vertices(x));
    const std::vector<SmoothStrain> mean = strain_of_vertices(mesh, strain);

    constexpr double kNear = 0.5 + 0.28867513459481288225;  // (1 + 1/sqrt 3) / 2
    Eigen::VectorXd squared(static_cast<Eigen::Index>(strain.size()));
    for (std::size_t c = 0; c < strain.size(); ++c) {
        const CellMesh::Cell& cell = mesh.cells()[c];
        const bool physical = !body.moduli.empty();
        const Mat3 inverse =
            physical ? solid.inverse_rest_metric(static_cast<int>(c)) : Mat3::Zero().eval();
        const double volume_stiffness =
            physical ? 0.5 * body.moduli[c].bulk_pa : body.parameters[c].incompressibility_n_per_m5;
        double density = 0;  // mean over the Gauss points
        for (std::size_t g = 0; g < 8; ++g) {
            const auto weight =
                trilinear_weights(Vec3((g & 4) ? kNear : 1 - kNear, (g & 2) ? kNear : 1 - kNear,
                                       (g & 1) ? kNear : 1 - kNear));
            SmoothStrain smooth;
            for (std::size_t k = 0; k < 8; ++k)
                smooth.add(weight[k], mean[static_cast<std::size_t>(cell.vertex[k])]);
            const Mat3 off = strain[c].point[g] - smooth.metric;
            const double off_volume = strain[c].mean.dilatation - smooth.dilatation;
            const double shape =
                physical ? body.moduli[c].mu_pa * (inverse * off * inverse * off).trace()
                         : body.parameters[c].elastic_n_per_m3.cwiseProduct(off.cwiseAbs2()).sum();
            density += 0.125 * (0.25 * shape + volume_stiffness * off_volume * off_volume);
        }
        const double unit = physical ? 1 / std::sqrt(inverse.determinant()) : 1.0;
        squared[static_cast<Eigen::Index>(c)] = density * unit * cell.size.prod();
    }
    return squared;
}

}  // namespace risorius::tissue
