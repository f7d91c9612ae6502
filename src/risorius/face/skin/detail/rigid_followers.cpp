// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/rigid_followers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kUnfolded = 0.8;    // of the depth of a fold, by a shut lid
constexpr double kUnfoldedBy = 0.6;  // closure
constexpr double kNotKept = -1.0;    // m; no lid lies this far inside its eye

}  // namespace

RigidFollowers::RigidFollowers(const rig::Head& head, const rig::RigDescription& rig,
                               const std::array<EyeLids, 2>& lids, SkinBinding& binding)
    : head_(head),
      neck_(head),
      lids_(lids),
      rest_(head.vertices),
      tongue_(head, 1e-3 * rig.facs.ranges.tongue_out_mm * head.size) {
    const long count = head.vertices.rows();
    const std::vector<char> moving = binding.moving();

    // Lids: skin near a margin follows its tarsal plate, the more the nearer it is
    std::vector<int> skin_near_eye[2];
    for (long v = 0; v < count; ++v) {
        if (head.carrier[v] != rig::Carrier::kSkin) continue;
        const Vec3 p = head.vertices.row(v).transpose();
        for (int side = 0; side < 2; ++side) {
            const double from_centre = (p - lids[side].centre()).norm();
            if (from_centre > lids[side].zone_m() + head.mm(4)) continue;
            if (p.z() < lids[side].centre().z()) continue;
            skin_near_eye[side].push_back(static_cast<int>(v));
            const LidMember member = lids[side].member(p);
            const double weight = EyeLids::firmness(member, 0.15, 1.0, 0.08, 0.45);
            // The clearance is at most that of the rest shape, so that the rest shape does not change
            const double clearance =
                std::min(head.eyes[side].distance(p, head.eyes[side].forward), head.mm(1.6));
            lid_vertices_.push_back({static_cast<int>(v), side, member, weight, clearance});
        }
    }

    measure_folds();

    // Lashes follow the skin at their root, and the tarsal plate
    std::vector<int> lashes;
    for (long v = 0; v < count; ++v)
        if (head.carrier[v] == rig::Carrier::kLashes) lashes.push_back(static_cast<int>(v));
    for (int v : lashes) {
        const Vec3 p = head.vertices.row(v).transpose();
        const int side = p.x() >= 0 ? 0 : 1;
        const double upper = geom::distance_to_polyline(p, lids[side].upper_margin());
        const double lower = geom::distance_to_polyline(p, lids[side].lower_margin());
        LidMember member;
        member.upper = upper < lower;
        member.fraction = member.upper ? 1.0 : 0.0;
        // A hair turns as its root does, which lies straight towards the eye's middle
        const std::vector<Vec3>& margin =
            member.upper ? lids[side].upper_margin() : lids[side].lower_margin();
        const Vec3 off = p - lids[side].centre();
        const Vec3 root =
            *std::min_element(margin.begin(), margin.end(), [&](const Vec3& a, const Vec3& b) {
                const auto across = [&](const Vec3& m) {
                    return (m - lids[side].centre()).cross(off).norm() /
                           (m - lids[side].centre()).norm();
                };
                return across(a) < across(b);
            });
        member.place = std::clamp(lids[side].place_of(root), 0.0, 1.0);
        lid_vertices_.push_back({v, side, member, 1.0, kNotKept});
        int nearest = -1;
        double min = 1e300;
        for (int w : skin_near_eye[side]) {
            const double squared = (head.vertices.row(w) - head.vertices.row(v)).squaredNorm();
            if (moving[w] && squared < min) {
                min = squared;
                nearest = w;
            }
        }
        if (nearest >= 0) binding.follow(v, nearest);
    }

    for (long v = 0; v < count; ++v) {
        switch (head.carrier[v]) {
            case rig::Carrier::kSkull:
            case rig::Carrier::kMandible:
                if (head.jaw_fraction[v] > 0)
                    on_jaw_.push_back({static_cast<int>(v), head.jaw_fraction[v]});
                break;
            case rig::Carrier::kEyeLeft:
                eye_[0].push_back(static_cast<int>(v));
                break;
            case rig::Carrier::kEyeRight:
                eye_[1].push_back(static_cast<int>(v));
                break;
            default:
                break;
        }
    }

    head_fraction_.resize(static_cast<std::size_t>(count));
    for (long v = 0; v < count; ++v)
        head_fraction_[v] =
            head.carrier[v] == rig::Carrier::kSkin || head.carrier[v] == rig::Carrier::kNone
                ? neck_.fraction(head.vertices.row(v).transpose())
                : 1.0;
}

// How deep a vertex lies below the straight lines between skin on both sides of the fold, seen from the eye. Only skin as near as
// a lid is high counts: the hollow below the brow is no fold.
void RigidFollowers::measure_folds() {
    struct Place {
        double along_m, angle, radius_m;
    };
    const double near_m = head_.mm(2), far_m = head_.mm(6.5), deepest_m = head_.mm(1.5);
    for (int side = 0; side < 2; ++side) {
        const EyeLids& lids = lids_[side];
        const auto place_of = [&](const Vec3& p) {
            const Vec3 r = p - lids.centre();
            return Place{lids.place_of(p) * lids.fissure_m(), lids.angle_of(p),
                         (r - r.dot(lids.axis()) * lids.axis()).norm()};
        };
        std::vector<Place> skin;
        for (long v = 0; v < rest_.rows(); ++v) {
            const Vec3 p = rest_.row(v).transpose();
            if (head_.carrier[v] == rig::Carrier::kSkin && p.z() > lids.centre().z() &&
                (p - lids.centre()).norm() < lids.zone_m() + head_.mm(12) && lids.member(p).upper &&
                lids.member(p).beyond == 0)
                skin.push_back(place_of(p));
        }
        for (LidVertex& lid : lid_vertices_) {
            if (lid.side != side || !lid.member.upper || lid.member.beyond > 0) continue;
            const Place at = place_of(rest_.row(lid.vertex).transpose());
            std::vector<Place> below, above;
            for (const Place& other : skin) {
                const double up_m = (other.angle - at.angle) * at.radius_m;
                if (std::abs(other.along_m - at.along_m) > near_m || std::abs(up_m) > far_m)
                    continue;
                if (up_m < 0) below.push_back(other);
                if (up_m > 0) above.push_back(other);
            }
            double hollow_m = 0;
            for (const Place& a : below)
                for (const Place& b : above) {
                    const double part = (at.angle - a.angle) / (b.angle - a.angle);
                    const double line_m = (1 - part) * a.radius_m + part * b.radius_m;
                    hollow_m = std::max(hollow_m, line_m - at.radius_m);
                }
            const double middle =
                std::sin(std::numbers::pi * std::clamp(lid.member.place, 0.0, 1.0)) *
                geom::smoothstep(0.25, 0.6, lid.member.height);
            lid.hollow_m = middle * std::min(hollow_m, deepest_m);
        }
    }
}

void RigidFollowers::turn_with_head(const Rigid& head, const Points& rest, Points& points) const {
    if (head.isApprox(Rigid::Identity(), 0.0)) return;
    for (long p = 0; p < points.rows(); ++p)
        points.row(p) = (neck_.part(head, neck_.fraction(rest.row(p).transpose())) *
                         Vec3(points.row(p).transpose()))
                            .transpose();
}

void RigidFollowers::apply_lids(const FollowDrive& drive, Points& vertices) const {
    for (const LidVertex& lid : lid_vertices_) {
        const int v = lid.vertex;
        const Vec3 rest = rest_.row(v).transpose();
        if (lid.weight > 0) {
            const Vec3 ride = rest + lids_[lid.side].ride(rest, lid.member, drive.lid[lid.side]);
            vertices.row(v) = (1 - lid.weight) * vertices.row(v) + lid.weight * ride.transpose();
        }
        if (lid.hollow_m > 0) {
            const Vec3 out = Vec3(vertices.row(v).transpose()) - lids_[lid.side].centre();
            const double unfolded = std::min(1.0, drive.lid[lid.side].upper_closure / kUnfoldedBy);
            vertices.row(v) += kUnfolded * unfolded * lid.hollow_m * out.normalized().transpose();
        }
        if (lid.clearance == kNotKept) continue;
        // The lid slides over the cornea: it is lifted where the surface of the eye is nearer than at rest
        const rig::EyeGeometry& eye = head_.eyes[lid.side];
        const Vec3 p = vertices.row(v).transpose();
        const double lift = lid.clearance - eye.distance(p, drive.gaze[lid.side] * eye.forward);
        if (lift > 0) vertices.row(v) += lift * (p - eye.centre).normalized().transpose();
    }
}

void RigidFollowers::turn_eyes(const std::array<Mat3, 2>& gaze, Points& vertices) const {
    for (int side = 0; side < 2; ++side) {
        const Vec3& centre = head_.eyes[side].centre;
        for (int v : eye_[side])
            vertices.row(v) =
                (centre + gaze[side] * (rest_.row(v).transpose() - centre)).transpose();
    }
}

void RigidFollowers::turn_head(const Rigid& head, Points& vertices) const {
    if (head.isApprox(Rigid::Identity(), 0.0)) return;
    // Nearly all vertices go with the head as a whole, one after the other
    double fraction = head_fraction_[0];
    Rigid part = neck_.part(head, fraction);
    for (long v = 0; v < vertices.rows(); ++v) {
        if (head_fraction_[v] != fraction) {
            fraction = head_fraction_[v];
            part = neck_.part(head, fraction);
        }
        vertices.row(v) = (part * Vec3(vertices.row(v).transpose())).transpose();
    }
}

void RigidFollowers::apply(const FollowDrive& drive, Points& vertices) const {
    apply_lids(drive, vertices);
    turn_eyes(drive.gaze, vertices);
    for (const auto& [v, fraction] : on_jaw_) {
        const Vec3 rest = rest_.row(v).transpose();
        vertices.row(v) = (rest + fraction * (drive.mandible * rest - rest)).transpose();
    }
    tongue_.place({drive.tongue_out, drive.tongue_up, drive.tongue_body_up, drive.tongue_body_back,
                   drive.mandible},
                  vertices);
    turn_head(drive.head, vertices);
}

}  // namespace risorius::face
