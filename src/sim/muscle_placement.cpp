#include "sim/muscle_placement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "sim/polyline.h"

namespace risorius::sim {

namespace {

// Finds where points lie in the tissue.
class TissueLocator {
  public:
    TissueLocator(const Shell& shell, const TissueMesh& mesh) : shell_(shell), mesh_(mesh) {
        centres_.resize(mesh.tets.rows(), 3);
        for (long t = 0; t < mesh.tets.rows(); ++t) {
            centres_.row(t).setZero();
            for (int k = 0; k < 4; ++k) centres_.row(t) += 0.25 * mesh.nodes.row(mesh.tets(t, k));
        }
    }

    // Skin, thickness and inward direction below a point on or over the skin.
    struct Column {
        Vec3 skin, outward;
        double thickness;
    };
    Column column_at(const Vec3& p) const {
        Column best{};
        double best_squared = 1e300;
        for (long f = 0; f < shell_.triangles.rows(); ++f) {
            std::array<Vec3, 3> corner;
            for (int k = 0; k < 3; ++k)
                corner[k] = mesh_.nodes.row(node_of(shell_.triangles(f, k), kSkin)).transpose();
            const Vec3 b = closest(p, corner);
            const Vec3 q = b[0] * corner[0] + b[1] * corner[1] + b[2] * corner[2];
            const double squared = (p - q).squaredNorm();
            if (squared >= best_squared) continue;
            best_squared = squared;
            best = {q, Vec3::Zero(), 0};
            for (int k = 0; k < 3; ++k) {
                best.outward += b[k] * mesh_.direction[shell_.triangles(f, k)];
                best.thickness += b[k] * mesh_.thickness_m[shell_.triangles(f, k)];
            }
            best.outward.normalize();
        }
        return best;
    }

    // Weights on the tet that holds p, or on the nearest one when p lies outside the tissue.
    muscle::FibrePoint embed(const Vec3& p) const {
        double best_outside = 1e300;
        long best_tet = 0;
        Eigen::Vector4d best_weights;
        for (long t = 0; t < mesh_.tets.rows(); ++t) {
            const double far = (centres_.row(t).transpose() - p).squaredNorm();
            if (far > 4e-4) continue;
            const Eigen::Vector4d w = weights(t, p);
            // How far outside, in metres: least weight times the tet's size.
            const double outside = -std::min(0.0, w.minCoeff()) * std::sqrt(far) + (w.minCoeff() < 0 ? far : 0.0);
            if (outside < best_outside) {
                best_outside = outside;
                best_tet = t;
                best_weights = w;
            }
            if (w.minCoeff() >= 0) break;
        }
        if (best_outside > 1e299) {
            double least = 1e300;
            for (long t = 0; t < mesh_.tets.rows(); ++t) {
                const double far = (centres_.row(t).transpose() - p).squaredNorm();
                if (far < least) {
                    least = far;
                    best_tet = t;
                }
            }
            best_weights = weights(best_tet, p);
        }
        best_weights = best_weights.cwiseMax(0.0);
        best_weights /= best_weights.sum();
        muscle::FibrePoint point;
        point.count = 4;
        for (int k = 0; k < 4; ++k) {
            point.nodes[k] = mesh_.tets(best_tet, k);
            point.weights[k] = best_weights[k];
        }
        return point;
    }

  private:
    Eigen::Vector4d weights(long t, const Vec3& p) const {
        const Vec3 a = mesh_.nodes.row(mesh_.tets(t, 0));
        Mat3 edges;
        for (int k = 0; k < 3; ++k)
            edges.col(k) = mesh_.nodes.row(mesh_.tets(t, k + 1)).transpose() - a;
        const Vec3 b = edges.inverse() * (p - a);
        return Eigen::Vector4d(1 - b.sum(), b[0], b[1], b[2]);
    }

    // Barycentric coordinates of the point of a triangle nearest to p (Ericson 2005, Real-Time Collision Detection, 5.1.5).
    static Vec3 closest(const Vec3& p, const std::array<Vec3, 3>& c) {
        const Vec3 ab = c[1] - c[0], ac = c[2] - c[0], ap = p - c[0];
        const double d1 = ab.dot(ap), d2 = ac.dot(ap);
        if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
        const Vec3 bp = p - c[1];
        const double d3 = ab.dot(bp), d4 = ac.dot(bp);
        if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
        const double vc = d1 * d4 - d3 * d2;
        if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
        const Vec3 cp = p - c[2];
        const double d5 = ab.dot(cp), d6 = ac.dot(cp);
        if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
        const double vb = d5 * d2 - d1 * d6;
        if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
        const double va = d3 * d6 - d5 * d4;
        if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
            const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
            return {0, 1 - w, w};
        }
        const double sum = va + vb + vc;
        return {va / sum, vb / sum, vc / sum};
    }

    const Shell& shell_;
    const TissueMesh& mesh_;
    Points centres_;
};

rig::MuscleBand mirrored(const rig::MuscleBand& band) {
    rig::MuscleBand out = band;
    for (rig::BandPoint& point : out.points) {
        point.landmark = rig::mirrored_landmark(point.landmark);
        point.offset.x() = -point.offset.x();
    }
    return out;
}

int bands_of(const rig::Atlas& atlas, const std::string& muscle) {
    return static_cast<int>(std::count_if(atlas.bands.begin(), atlas.bands.end(),
                                          [&](const rig::MuscleBand& b) { return b.muscle == muscle; }));
}

}  // namespace

MusclePlacement place_muscles(const rig::Head& head, const rig::RigDescription& rig, const Shell& shell,
                              const TissueMesh& mesh) {
    constexpr double kFibreSpacing_mm = 4.0, kPointSpacing_mm = 5.0;
    const TissueLocator locator(shell, mesh);
    const track::ChannelTable channels = rig.channels();
    MusclePlacement out;

    const auto place_band = [&](const rig::MuscleBand& band, Side side) {
        const int column = channels.column(band.muscle, side);
        // The centre line, and the skin above it
        std::vector<Vec3> centre, outward;
        for (const rig::BandPoint& point : band.points) {
            const Vec3 over = head.landmark(point.landmark) + head.size * point.offset;
            const auto tissue = locator.column_at(over);
            outward.push_back(tissue.outward);
            centre.push_back(point.depth < 0 ? over
                                             : Vec3(tissue.skin - point.depth * tissue.thickness * tissue.outward));
        }
        // Parallel fibres across the width: each point moves sideways along the skin at its own depth
        const int strands = std::max(2, static_cast<int>(std::lround(band.width_m * 1e3 / kFibreSpacing_mm)));
        const double force = band.force_n * band.strength * rig.tissue.force_scale * head.size * head.size /
                             (strands * bands_of(rig.atlas, band.muscle));
        for (int strand = 0; strand < strands; ++strand) {
            const double across = band.width_m * head.size * ((strand + 0.5) / strands - 0.5);
            std::vector<Vec3> through;
            for (std::size_t i = 0; i < centre.size(); ++i) {
                const Vec3 along = (centre[std::min(i + 1, centre.size() - 1)] - centre[i > 0 ? i - 1 : 0]).normalized();
                const Vec3 sideways = along.cross(outward[i]).normalized();
                Vec3 p = centre[i] + across * sideways;
                if (band.points[i].depth >= 0) {
                    const auto tissue = locator.column_at(p + (band.points[i].depth * 2e-3) * outward[i]);
                    p = tissue.skin - band.points[i].depth * tissue.thickness * tissue.outward;
                }
                through.push_back(p);
            }
            std::vector<Vec3> path = sample_curve(through, head.mm(kPointSpacing_mm));
            // Points too close together would make a stiff segment
            std::vector<Vec3> spaced{path.front()};
            for (std::size_t i = 1; i + 1 < path.size(); ++i)
                if ((path[i] - spaced.back()).norm() > head.mm(1.5) && (path[i] - path.back()).norm() > head.mm(1.5))
                    spaced.push_back(path[i]);
            spaced.push_back(path.back());
            if ((spaced.front() - spaced.back()).norm() < head.mm(1.0) && spaced.size() == 2) continue;

            muscle::Fibre fibre;
            fibre.first_point = static_cast<int>(out.points.size());
            fibre.point_count = static_cast<int>(spaced.size());
            fibre.column = column;
            fibre.f0_n = force;
            for (std::size_t i = 0; i < spaced.size(); ++i) {
                const rig::Body body = i == 0                     ? band.origin
                                       : i + 1 == spaced.size() ? band.insertion
                                                                : rig::Body::kSoft;
                const std::string& attach = i == 0 ? band.origin_attach : band.insertion_attach;
                const bool end = i == 0 || i + 1 == spaced.size();
                const bool on_bone = end && (attach == "bone");
                muscle::FibrePoint point;
                if (on_bone && (body == rig::Body::kSkull || body == rig::Body::kMandible)) {
                    point.count = 0;
                    point.body = body == rig::Body::kMandible ? kMandibleBody : kSkullBody;
                    point.body_rest = spaced[i];
                } else {
                    point = locator.embed(spaced[i]);
                }
                out.points.push_back(point);
            }
            out.fibres.push_back(fibre);
            out.paths.push_back(spaced);
        }
    };
    for (const rig::MuscleBand& band : rig.atlas.bands) {
        if (channels.column(band.muscle, Side::kLeft) < 0) continue;
        place_band(band, Side::kLeft);
        if (!band.crosses_midline()) place_band(mirrored(band), Side::kRight);
    }
    return out;
}

}  // namespace risorius::sim
