// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/platysma_cords.h"

#include <algorithm>
#include <cmath>

#include "risorius/face/view/detail/muscle_sheets.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kSpacing_mm = 4.0;
constexpr double kMinWidth_mm = 4.0;  // w, where the mesh is fine enough
constexpr double kReach =
    4.0;  // reach of a ridge / w: beyond it less than 4 % of the height is left
constexpr double kHighest_mm = 7.0;
constexpr double kOffSkin_mm = 30.0;  // a mesh whose skin is farther away has no neck
constexpr int kSmoothing = 6;
constexpr double kFar = 1e9;
constexpr double kLine_mm = 26.0;  // wavelength of the line of a border
constexpr double kRidge =
    1.4;  // depth of the line / height of the cord, where the mesh shows nothing of it
constexpr double kLonger_mm = 24.0;  // added below the start of the fibres in the table

// The borders: position across the band towards the midline, in half widths of the band, and the fraction of the muscle's force in
// each.
struct Border {
    double across, fraction;
    int slot;
};
constexpr Border kBorders[] = {{0.75, 0.2, 2}, {-0.55, 0.1, 0}};

void smooth(std::vector<Vec3>& line) {
    for (int pass = 0; pass < kSmoothing; ++pass) {
        const std::vector<Vec3> rough = line;
        for (std::size_t i = 1; i + 1 < line.size(); ++i)
            line[i] = 0.25 * (rough[i - 1] + 2 * rough[i] + rough[i + 1]);
    }
}

}  // namespace

std::vector<double> string_heights(const std::vector<Vec3>& stations,
                                   const std::vector<Vec3>& outward, double spacing_m,
                                   double tension_n, double bed_n_per_m2) {
    const std::size_t n = stations.size();
    std::vector<double> height(n, 0.0), factor(n, 0.0);
    if (tension_n <= 0) return height;
    // Elimination of the tridiagonal system
    const double side = tension_n / (spacing_m * spacing_m);
    const double middle = 2 * side + bed_n_per_m2;
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const Vec3 bend =
            (stations[i - 1] - 2 * stations[i] + stations[i + 1]) / (spacing_m * spacing_m);
        const double load = tension_n * std::max(0.0, bend.dot(outward[i]));
        const double pivot = middle - side * factor[i - 1];
        factor[i] = side / pivot;
        height[i] = (load + side * height[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 1;) height[i] += factor[i] * height[i + 1];
    return height;
}

PlatysmaCords::PlatysmaCords(const rig::Head& head, const rig::RigDescription& rig)
    // A line that is pressed into soft tissue feels about four times the shear modulus of the tissue
    : bed_n_per_m2_(4 * rig.tissue.superficial_shear_pa) {
    const track::ChannelTable channels = rig.channels();
    const auto front = std::find_if(rig.atlas.bands.begin(), rig.atlas.bands.end(),
                                    [](const auto& band) { return band.muscle == "platysma"; });
    if (front == rig.atlas.bands.end()) return;
    const geom::SurfaceTree skin = outer_skin(head);
    for (const Side side : {Side::kLeft, Side::kRight}) {
        const rig::MuscleBand band = side == Side::kLeft ? *front : rig::mirrored(*front);
        const int column = channels.column(band.muscle, side);
        if (column < 0) continue;
        std::vector<Vec3> centre;
        for (const rig::BandPoint& point : band.points)
            centre.push_back(head.landmark(point.landmark) + head.size * point.offset);
        // The fibres of the table begin where the atlas head ends
        const Vec3 down = (centre[0] - centre[1]).normalized();
        const Vec3 lower = centre[0] + head.mm(kLonger_mm) * down;
        if (skin.closest(lower, head.mm(kOffSkin_mm))) centre.insert(centre.begin(), lower);
        // Half a band of two
        const double half = band.width_m * head.size / 4;
        const Vec3 inwards(side == Side::kLeft ? -1.0 : 1.0, 0, 0);
        for (const Border& border : kBorders) {
            std::vector<Vec3> through = centre;
            for (Vec3& p : through) {
                p += border.across * half * inwards;
                // A border stays on its side
                const double x = std::max(-p.dot(inwards), head.mm(7));
                p.x() = -x * inwards.x();
                const auto on_skin = skin.closest(p);
                if (!on_skin || std::sqrt(on_skin->squared_distance) > head.mm(kOffSkin_mm)) {
                    through.clear();
                    break;
                }
                p = on_skin->point;
            }
            if (through.empty()) continue;
            const double force = band.force_n * rig.tissue.force_scale * head.size * head.size;
            add(head, geom::sample_curve(through, head.mm(0.5)), column, border.slot,
                border.fraction * force);
        }
    }
}

void PlatysmaCords::add(const rig::Head& head, const std::vector<Vec3>& along, int column, int slot,
                        double force_n) {
    double length = 0;
    for (std::size_t i = 1; i < along.size(); ++i) length += (along[i] - along[i - 1]).norm();
    const int count = std::max(5, static_cast<int>(std::lround(length / head.mm(kSpacing_mm))));
    Cord cord;
    cord.column = column;
    cord.slot = slot;
    cord.force_n = force_n;
    cord.spacing_m = length / (count - 1);
    cord.line_m = head.mm(kLine_mm);

    const geom::SurfaceTree skin(head.vertices, head.skin);
    double passed = 0;
    for (std::size_t i = 0; i < along.size() && static_cast<int>(cord.stations.size()) < count;
         ++i) {
        if (i > 0) passed += (along[i] - along[i - 1]).norm();
        if (passed + 1e-9 < cord.spacing_m * static_cast<double>(cord.stations.size()) &&
            i + 1 < along.size())
            continue;
        const auto on_skin = skin.closest(along[i]);
        Station station;
        station.barycentric = on_skin->barycentric;
        station.rest = on_skin->point;
        for (int k = 0; k < 3; ++k)
            station.corner[static_cast<std::size_t>(k)] = head.skin(on_skin->triangle, k);
        const Vec3 a = head.vertices.row(station.corner[0]),
                   b = head.vertices.row(station.corner[1]),
                   c = head.vertices.row(station.corner[2]);
        station.outward = (b - a).cross(c - a).normalized();
        cord.stations.push_back(station);
    }
    std::vector<Vec3> outward;
    for (const Station& station : cord.stations) outward.push_back(station.outward);
    smooth(outward);
    for (std::size_t i = 0; i < outward.size(); ++i)
        cord.stations[i].outward = outward[i].normalized();

    // The width of a cord, or the minimum width that the mesh can show
    double edges = 0;
    for (const Station& station : cord.stations)
        for (int k = 0; k < 3; ++k)
            edges += (head.vertices.row(station.corner[static_cast<std::size_t>(k)]) -
                      head.vertices.row(station.corner[static_cast<std::size_t>((k + 1) % 3)]))
                         .norm();
    const double edge = edges / (3.0 * static_cast<double>(cord.stations.size()));
    const double width = std::max(head.mm(kMinWidth_mm), 0.8 * edge);

    std::vector<char> on_skin(static_cast<std::size_t>(head.vertices.rows()), 0);
    for (long i = 0; i < head.skin.size(); ++i)
        on_skin[static_cast<std::size_t>(head.skin.data()[i])] = 1;
    std::vector<char> welded_on_skin = on_skin;
    for (std::size_t v = 0; v < head.welded.size(); ++v)
        if (on_skin[static_cast<std::size_t>(head.welded[v])]) welded_on_skin[v] = 1;
    std::vector<Vec3> border;
    for (const Station& station : cord.stations) border.push_back(station.rest);
    for (long v = 0; v < head.vertices.rows(); ++v) {
        if (!welded_on_skin[static_cast<std::size_t>(v)]) continue;
        const Vec3 p = head.vertices.row(v);
        const double reach = std::max(kReach * width, head.mm(1.5 * kLine_mm));
        const geom::PolylinePoint on = geom::nearest_on_polyline(p, border);
        const double nearest = on.distance_m;
        if (nearest >= reach) continue;
        const Vec3 way = border[on.piece + 1] - border[on.piece];
        const Vec3 beside = p - border[on.piece] - on.fraction * way;
        const double across =
            std::copysign(nearest, beside.dot(way.cross(cord.stations[on.piece].outward)));
        const double at = static_cast<double>(on.piece) + on.fraction;
        const double fraction =
            1 / std::cosh(nearest / width) *
            (1 - geom::smoothstep(0.6 * kReach * width, kReach * width, nearest));
        const double line = head.mm(kLine_mm);
        const double ridge = kRidge * (1 - geom::smoothstep(0.3 * line, 0.5 * line, nearest)) *
                             geom::smoothstep(0, 2 * head.mm(kMinWidth_mm), edge);
        cord.lifted.push_back({static_cast<int>(v), at, fraction, across, ridge});
    }
    cords_.push_back(std::move(cord));
}

void PlatysmaCords::mark(WrinkleLines& lines) {
    // The borders of both sides share a slot. A vertex belongs to the nearer border; other lines of the slot have priority
    Points nearest = Points::Constant(lines.phase.rows(), kWrinkleSlots, kFar);
    const auto is = [&](const Cord& cord, const Lifted& lifted, WrinkleLines::Claim claim) {
        return lines.claim.rows() > 0 && lines.claim(lifted.vertex, cord.slot) == claim;
    };
    const auto mine = [&](const Cord& cord, const Lifted& lifted) {
        return !is(cord, lifted, WrinkleLines::kOfLine) &&
               std::abs(lifted.across) <= nearest(lifted.vertex, cord.slot);
    };
    for (const Cord& cord : cords_)
        for (const Lifted& lifted : cord.lifted)
            if (mine(cord, lifted)) nearest(lifted.vertex, cord.slot) = std::abs(lifted.across);
    for (Cord& cord : cords_)
        for (Lifted& lifted : cord.lifted) {
            if (!mine(cord, lifted)) {
                lifted.ridge = 0;
                continue;
            }
            if (is(cord, lifted, WrinkleLines::kBesideLine)) lifted.ridge = 0;
            lines.phase(lifted.vertex, cord.slot) = lifted.across / cord.line_m;
            lines.wavelength(lifted.vertex, cord.slot) = cord.line_m;
        }
    marked_ = true;
}

void PlatysmaCords::raise(const Eigen::VectorXd& activation, Points& vertices,
                          Points& depth) const {
    std::vector<Vec3> shift;  // of the stations
    std::vector<std::pair<int, Vec3>> moved;
    for (const Cord& cord : cords_) {
        const double a = activation[cord.column];
        if (a <= 0) continue;
        std::vector<Vec3> at, outward;
        for (const Station& station : cord.stations) {
            Vec3 p = Vec3::Zero();
            for (std::size_t k = 0; k < 3; ++k)
                p += station.barycentric[static_cast<long>(k)] *
                     vertices.row(station.corner[k]).transpose();
            at.push_back(p);
            outward.push_back(station.outward);
        }
        smooth(at);
        const std::vector<double> height =
            string_heights(at, outward, cord.spacing_m, a * cord.force_n, bed_n_per_m2_);
        shift.clear();
        for (std::size_t i = 0; i < height.size(); ++i) {
            const double max = kHighest_mm * 1e-3;
            shift.push_back(max * std::tanh(height[i] / max) * outward[i]);
        }
        for (const Lifted& lifted : cord.lifted) {
            const auto i = std::min(static_cast<std::size_t>(lifted.station), shift.size() - 2);
            const double t = lifted.station - static_cast<double>(i);
            const Vec3 by = (1 - t) * shift[i] + t * shift[i + 1];
            if (lifted.fraction > 0) moved.push_back({lifted.vertex, lifted.fraction * by});
            if (marked_ && depth.rows() > 0)
                depth(lifted.vertex, cord.slot) -= lifted.ridge * by.norm();
        }
    }
    for (const auto& [vertex, by] : moved) vertices.row(vertex) += by.transpose();
}

std::vector<std::vector<Vec3>> PlatysmaCords::lines() const {
    std::vector<std::vector<Vec3>> out;
    for (const Cord& cord : cords_) {
        out.emplace_back();
        for (const Station& station : cord.stations) out.back().push_back(station.rest);
    }
    return out;
}

}  // namespace risorius::face
