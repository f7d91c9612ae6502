#include "sim/follow.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/polyline.h"

namespace risorius::sim {

namespace {

constexpr double kNotKept = -1.0;  // m; no lid lies this far inside its eye

}  // namespace

Follow::Follow(const rig::Head& head, const rig::RigDescription& rig,
               const std::array<EyeLids, 2>& lids, SkinBinding& binding)
    : head_(head), lids_(lids), rest_(head.vertices) {
    tongue_range_m_ = 1e-3 * rig.facs.ranges.tongue_out_mm * head.size;
    const long count = head.vertices.rows();
    const std::vector<char> moving = binding.moving();

    // Lids: skin near a margin rides on its tarsal plate, more firmly the nearer
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
            // Never more than at rest, so that rest stays as it was imported
            const double clearance =
                std::min(head.eyes[side].distance(p, head.eyes[side].forward), head.mm(1.6));
            lid_vertices_.push_back({static_cast<int>(v), side, member, weight, clearance});
        }
    }

    // Lashes: as the skin at their root, and on the tarsal plate
    std::vector<int> lashes;
    for (long v = 0; v < count; ++v)
        if (head.carrier[v] == rig::Carrier::kLashes) lashes.push_back(static_cast<int>(v));
    for (int v : lashes) {
        const Vec3 p = head.vertices.row(v).transpose();
        const int side = p.x() >= 0 ? 0 : 1;
        const double upper = distance_to_polyline(p, lids[side].upper_margin());
        const double lower = distance_to_polyline(p, lids[side].lower_margin());
        LidMember member;
        member.upper = upper < lower;
        member.share = member.upper ? 1.0 : 0.0;
        member.place = std::clamp(lids[side].place_of(p), 0.0, 1.0);
        lid_vertices_.push_back({v, side, member, 1.0, kNotKept});
        int nearest = -1;
        double least = 1e300;
        for (int w : skin_near_eye[side]) {
            const double squared = (head.vertices.row(w) - head.vertices.row(v)).squaredNorm();
            if (moving[w] && squared < least) {
                least = squared;
                nearest = w;
            }
        }
        if (nearest >= 0) binding.follow(v, nearest);
    }

    // Tongue: its root stays behind, the rest goes with the mandible, the tip comes out
    double back = 1e300, front = -1e300;
    for (long v = 0; v < count; ++v)
        if (head.carrier[v] == rig::Carrier::kTongue) {
            back = std::min(back, head.vertices(v, 2));
            front = std::max(front, head.vertices(v, 2));
        }
    for (long v = 0; v < count; ++v) {
        switch (head.carrier[v]) {
            case rig::Carrier::kTongue: {
                const double along = (head.vertices(v, 2) - back) / std::max(1e-6, front - back);
                tongue_.push_back({static_cast<int>(v), along * along,
                                   head.jaw_share[v] * (0.55 + 0.4 * smoothstep(0.0, 0.7, along))});
                break;
            }
            case rig::Carrier::kSkull:
            case rig::Carrier::kMandible:
                if (head.jaw_share[v] > 0)
                    on_jaw_.push_back({static_cast<int>(v), head.jaw_share[v]});
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

    // The head turns above the jaw line; the neck gives way down to its base
    neck_top_m_ = head.mm(-70);
    neck_base_m_ = std::max(head.vertices.col(1).minCoeff() + head.mm(10), head.mm(-190));
    head_share_.resize(static_cast<std::size_t>(count));
    for (long v = 0; v < count; ++v)
        head_share_[v] =
            head.carrier[v] == rig::Carrier::kSkin || head.carrier[v] == rig::Carrier::kNone
                ? head_share(head.vertices.row(v).transpose())
                : 1.0;
}

double Follow::head_share(const Vec3& rest) const {
    // Behind the jaw the neck begins higher up than under the chin.
    const double under_chin = smoothstep(head_.mm(10), head_.mm(60), rest.z());
    const double start = neck_top_m_ - head_.mm(30) * under_chin;
    return smoothstep(neck_base_m_, start, rest.y());
}

Vec3 Follow::turned(const Rigid& head, double share, const Vec3& p) const {
    if (share <= 0) return p;
    if (share >= 1) return head * p;
    // Part of the turn about the same pivot
    const Vec3 pivot(0, head_.mm(-30), head_.mm(-10));
    const Vec3 moved_pivot = head * pivot;
    const Eigen::Quaterniond part =
        Eigen::Quaterniond::Identity().slerp(share, Eigen::Quaterniond(head.linear()));
    return part * (p - pivot) + pivot + share * (moved_pivot - pivot);
}

void Follow::turn_with_head(const Rigid& head, const Points& rest, Points& points) const {
    if (head.isApprox(Rigid::Identity(), 0.0)) return;
    for (long p = 0; p < points.rows(); ++p)
        points.row(p) = turned(head, head_share(rest.row(p).transpose()), points.row(p).transpose())
                            .transpose();
}

void Follow::apply_lids(const FollowDrive& drive, Points& vertices) const {
    for (const LidVertex& lid : lid_vertices_) {
        const int v = lid.vertex;
        const Vec3 rest = rest_.row(v).transpose();
        if (lid.weight > 0) {
            const Vec3 ride = rest + lids_[lid.side].ride(rest, lid.member, drive.lid[lid.side]);
            vertices.row(v) = (1 - lid.weight) * vertices.row(v) + lid.weight * ride.transpose();
        }
        if (lid.clearance == kNotKept) continue;
        // The lid slides over the cornea: it is lifted where the eye's surface comes closer than at rest
        const rig::EyeGeometry& eye = head_.eyes[lid.side];
        const Vec3 p = vertices.row(v).transpose();
        const double lift = lid.clearance - eye.distance(p, drive.gaze[lid.side] * eye.forward);
        if (lift > 0) vertices.row(v) += lift * (p - eye.centre).normalized().transpose();
    }
}

void Follow::apply(const FollowDrive& drive, Points& vertices) const {
    apply_lids(drive, vertices);
    for (int side = 0; side < 2; ++side) {
        const Vec3& centre = head_.eyes[side].centre;
        for (int v : eye_[side])
            vertices.row(v) =
                (centre + drive.gaze[side] * (rest_.row(v).transpose() - centre)).transpose();
    }
    for (const auto& [v, share] : on_jaw_) {
        const Vec3 rest = rest_.row(v).transpose();
        vertices.row(v) = (rest + share * (drive.mandible * rest - rest)).transpose();
    }
    for (const TongueVertex& t : tongue_) {
        const Vec3 rest = rest_.row(t.vertex).transpose();
        const Vec3 out = drive.tongue_out * tongue_range_m_ * t.tip * Vec3(0, -0.12, 1.0);
        vertices.row(t.vertex) =
            (rest + out + t.over_jaw * (drive.mandible * (rest + out) - (rest + out))).transpose();
    }
    if (drive.head.isApprox(Rigid::Identity(), 0.0)) return;
    for (long v = 0; v < vertices.rows(); ++v)
        vertices.row(v) =
            turned(drive.head, head_share_[v], vertices.row(v).transpose()).transpose();
}

}  // namespace risorius::sim
