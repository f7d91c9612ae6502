// SPDX-License-Identifier: MIT
#include "risorius/face/muscle/detail/muscle_placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "risorius/face/anatomy/detail/tissue_locator.h"
#include "risorius/geom/polyline.h"
#include "risorius/rig/muscle_force.h"

namespace risorius::face {

namespace {

// Points too close together would make stiff segments.
std::vector<Vec3> without_close_points(const std::vector<Vec3>& path, const rig::Head& head) {
    std::vector<Vec3> spaced{path.front()};
    for (std::size_t i = 1; i + 1 < path.size(); ++i)
        if ((path[i] - spaced.back()).norm() > head.mm(1.5) &&
            (path[i] - path.back()).norm() > head.mm(1.5))
            spaced.push_back(path[i]);
    spaced.push_back(path.back());
    return spaced;
}

// Returns the lip that all landmarks of the band on lips belong to; none when they belong to both, or when there are none.
Lip lip_of_band(const rig::MuscleBand& band) {
    Lip out = Lip::kNone;
    for (const rig::BandPoint& point : band.points) {
        const Lip lip = lip_of(point.landmark);
        if (lip == Lip::kNone) continue;
        if (out != Lip::kNone && out != lip) return Lip::kNone;
        out = lip;
    }
    return out;
}

struct Strand {
    std::vector<muscle::FibrePoint> points;
    std::vector<Vec3> places;  ///< of the points at rest, m
};

// Ends on bone move with it. The other points are embedded in the tissue; points that coincide outside of the tissue become one.
Strand embed_strand(const std::vector<Vec3>& spaced, const rig::MuscleBand& band, Lip lip,
                    const TissueLocator& locator, const TissueMesh& mesh, const rig::Head& head) {
    Strand strand;
    auto& [points, places] = strand;
    for (std::size_t i = 0; i < spaced.size(); ++i) {
        const bool first = i == 0, last = i + 1 == spaced.size();
        const rig::Body body = first ? band.origin : last ? band.insertion : rig::Body::kSoft;
        const bool on_bone =
            (first && band.origin_attach == "bone") || (last && band.insertion_attach == "bone");
        muscle::FibrePoint point;
        Vec3 place = spaced[i];
        if (on_bone && (body == rig::Body::kSkull || body == rig::Body::kMandible)) {
            point.body = body == rig::Body::kMandible ? kMandibleBody : kSkullBody;
            point.body_rest = place;
        } else {
            point = locator.embed(place, lip);
            place.setZero();
            for (int k = 0; k < 4; ++k)
                place += point.weights[k] * mesh.nodes.row(point.nodes[k]).transpose();
        }
        if (!places.empty() && (place - places.back()).norm() < head.mm(1.0)) {
            if (!last || points.size() < 2) continue;
            points.pop_back();
            places.pop_back();
        }
        points.push_back(point);
        places.push_back(place);
    }
    return strand;
}

}  // namespace

MusclePlacement place_muscles(const rig::Head& head, const rig::RigDescription& rig,
                              const Shell& shell, const TissueMesh& mesh) {
    constexpr double kFibreSpacing_mm = 4.0, kPointSpacing_mm = 5.0;
    const TissueLocator locator(head, shell, mesh);
    const track::ChannelTable channels = rig.channels();
    MusclePlacement out;

    // The given width is that of the whole muscle, whose bands lie side by side
    const auto place_band = [&](const rig::MuscleBand& band, Side side) {
        const int column = channels.column(band.muscle, side);
        const Lip lip = lip_of_band(band);
        // The centre line, and the skin above it
        std::vector<Vec3> centre, outward;
        for (const rig::BandPoint& point : band.points) {
            const Vec3 over = head.landmark(point.landmark) + head.size * point.offset;
            const auto tissue = locator.column_at(over, lip);
            outward.push_back(tissue.outward);
            centre.push_back(point.depth < 0 ? over
                                             : Vec3(tissue.skin - point.depth * tissue.thickness *
                                                                      tissue.outward));
        }
        // Parallel fibres across the width: each point moves sideways along the skin at its own depth
        const int bands = rig::bands_of(rig.atlas, band.muscle);
        const int strands = std::max(
            2, static_cast<int>(std::lround(band.width_m * 1e3 / (bands * kFibreSpacing_mm))));
        FibreBundle bundle;
        bundle.muscle = band.muscle;
        if (channels.column(band.muscle, Side::kLeft) != channels.column(band.muscle, Side::kRight))
            bundle.side = side;
        bundle.column = column;
        bundle.first_fibre = static_cast<int>(out.fibres.size());
        bundle.width_m = band.width_m / bands * head.size;
        bundle.origin_on_bone = band.origin_attach == "bone";
        bundle.insertion_on_bone = band.insertion_attach == "bone";
        const auto muscle =
            std::find_if(rig.muscles.muscles.begin(), rig.muscles.muscles.end(),
                         [&](const rig::Muscle& candidate) { return candidate.id == band.muscle; });
        for (int strand = 0; strand < strands; ++strand) {
            const double across =
                band.width_m / bands * head.size * ((strand + 0.5) / strands - 0.5);
            std::vector<Vec3> through;
            for (std::size_t i = 0; i < centre.size(); ++i) {
                const Vec3 along =
                    (centre[std::min(i + 1, centre.size() - 1)] - centre[i > 0 ? i - 1 : 0])
                        .normalized();
                const Vec3 sideways = along.cross(outward[i]).normalized();
                Vec3 p = centre[i] + across * sideways;
                if (band.points[i].depth >= 0) {
                    const auto tissue =
                        locator.column_at(p + (band.points[i].depth * 2e-3) * outward[i], lip);
                    p = tissue.skin - band.points[i].depth * tissue.thickness * tissue.outward;
                }
                through.push_back(p);
            }
            const std::vector<Vec3> path = geom::sample_curve(through, head.mm(kPointSpacing_mm));
            const std::vector<Vec3> spaced = without_close_points(path, head);
            const auto [points, places] = embed_strand(spaced, band, lip, locator, mesh, head);
            if (points.size() < 2) continue;
            muscle::Fibre fibre;
            fibre.first_point = static_cast<int>(out.points.size());
            fibre.point_count = static_cast<int>(points.size());
            fibre.column = column;
            fibre.max_speed_hz = muscle->max_speed_hz;
            if (rig.tissue.bundles == "musculotendon") {
                const double fibre_m = muscle->rest_stretch * muscle->optimal_length_m;
                fibre.rest_stretch = muscle->rest_stretch;
                fibre.pennation_rad = muscle->pennation_deg * std::numbers::pi / 180;
                // A muscle without a length of its fibres in the table has no tendon
                fibre.tendon_fraction =
                    fibre_m > 0 ? muscle->tendon_slack_m / (muscle->tendon_slack_m + fibre_m) : 0.0;
            }
            out.points.insert(out.points.end(), points.begin(), points.end());
            out.fibres.push_back(fibre);
            out.paths.push_back(places);
        }
        bundle.fibre_count = static_cast<int>(out.fibres.size()) - bundle.first_fibre;
        if (bundle.fibre_count == 0) return;
        // Strands that are too short on this head leave their force to the others
        for (int f = 0; f < bundle.fibre_count; ++f)
            out.fibres[static_cast<std::size_t>(bundle.first_fibre + f)].f0_n =
                rig::fibre_force_n(rig, band, head.size, bundle.fibre_count * bands);
        out.bundles.push_back(bundle);
    };
    for (const rig::MuscleBand& band : rig.atlas.bands) {
        if (channels.column(band.muscle, Side::kLeft) < 0) continue;
        if (rig.solid(band.muscle) != nullptr) continue;
        place_band(band, Side::kLeft);
        if (!band.crosses_midline()) place_band(mirrored(band), Side::kRight);
    }
    return out;
}

}  // namespace risorius::face
