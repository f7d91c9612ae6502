// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/detail/make_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "risorius/blendshapes/detail/rigid_parts.h"
#include "risorius/face/anatomy/lid_measures.h"
#include "risorius/face/surfaces.h"
#include "risorius/scene/landmark_points.h"

namespace risorius::blendshapes {

namespace {

using track::Kinematic;

// Half width of the strip in the middle of the face that halves share
constexpr double kHalfWidth_mm = 15;
// An eye is to close when the excitation of its levator falls by this much
constexpr double kClosing = 0.9;
constexpr double kPressing = 0.2;  // or when that of its orbicularis rises by this much
constexpr int kUprightSteps = 12;
constexpr double kShutLips_m = 1e-3;  // maximum gap of the lips for a shape that closes them
/// Weights at which closed lips over an open jaw are tried, largest first.
constexpr std::array<double, 3> kShutTries{0.5, 0.35, 0.2};

/// The poses to solve, and the shapes they belong to.
struct Plan {
    std::vector<track::Drive> drives;
    /// Per goal; several where several weights are tried
    std::vector<std::vector<std::size_t>> own;
    /// Per goal and try: the pose of the shape below; else empty
    std::vector<std::vector<std::size_t>> under;
    std::vector<int> whole;  ///< per goal: pose of both halves together, else -1
};

track::Drive both(const track::Drive& one, const track::Drive& other,
                  const track::ChannelTable& channels) {
    track::Drive out = one;
    out.excitation =
        (one.excitation + other.excitation).cwiseMin(1.0).cwiseMax(channels.column_min());
    for (std::size_t k = 0; k < out.kinematic.size(); ++k) {
        const track::KinematicChannel& channel = track::kinematic_channels()[k];
        out.kinematic[k] =
            std::clamp(one.kinematic[k] + other.kinematic[k], channel.min, channel.max);
    }
    return out;
}

// The drive `shuts` with the jaw of `opens` times a fraction. The lip muscles of `opens` are not included.
track::Drive over_jaw(const track::Drive& shuts, const track::Drive& opens, double fraction) {
    track::Drive out = shuts;
    for (const Kinematic k : {Kinematic::kJawOpen, Kinematic::kJawForward, Kinematic::kJawSide})
        out.kinematic[static_cast<std::size_t>(k)] = fraction * opens.at(k);
    return out;
}

track::Drive part_of_drive(track::Drive drive, double fraction) {
    drive.excitation *= fraction;
    for (double& value : drive.kinematic) value *= fraction;
    return drive;
}

Plan plan_of(const ShapeSet& set, const track::ChannelTable& channels) {
    Plan plan;
    plan.whole.assign(set.goals.size(), -1);
    const auto add = [&](const track::Drive& drive) {
        plan.drives.push_back(drive);
        return plan.drives.size() - 1;
    };
    for (std::size_t i = 0; i < set.goals.size(); ++i) {
        const ShapeGoal& goal = set.goals[i];
        std::vector<std::size_t>& own = plan.own.emplace_back();
        std::vector<std::size_t>& under = plan.under.emplace_back();
        if (goal.on_top_of < 0) {
            own.push_back(add(goal.drive));
        } else {
            const track::Drive& opens = set.goals[static_cast<std::size_t>(goal.on_top_of)].drive;
            for (const double fraction : kShutTries) {
                own.push_back(add(over_jaw(goal.drive, opens, fraction)));
                under.push_back(add(part_of_drive(opens, fraction)));
            }
        }
        if (goal.sides == Sides::kHalves && goal.left)
            plan.whole[i] = static_cast<int>(add(both(
                goal.drive, set.goals[static_cast<std::size_t>(goal.partner)].drive, channels)));
    }
    return plan;
}

// Relaxing the levator only makes the lid droop; orbicularis closes the eye.
bool shuts_eye(const track::Drive& drive, const track::ChannelTable& channels, Side side) {
    const int levator = channels.column("levator_palpebrae_superioris", side),
              orbicularis = channels.column("orbicularis_oculi_palpebral_upper", side);
    return levator >= 0 && orbicularis >= 0 && drive.excitation[levator] <= -kClosing &&
           drive.excitation[orbicularis] >= kPressing;
}

// Whether each drive is the mirror image of the other.
bool are_mirrored(const track::Drive& one, const track::Drive& other,
                  const track::ChannelTable& channels) {
    constexpr double kSame = 1e-12;
    for (const track::MuscleChannel& muscle : channels.muscles)
        for (const Side side : {Side::kLeft, Side::kRight})
            if (std::abs(one.excitation[channels.column(muscle.id, side)] -
                         other.excitation[channels.column(
                             muscle.id, side == Side::kLeft ? Side::kRight : Side::kLeft)]) > kSame)
                return false;
    for (int k = 0; k < track::kKinematicCount; ++k) {
        const auto channel = static_cast<Kinematic>(k);
        double there = other.at(channel);
        if (channel == Kinematic::kJawSide) there = -there;
        if (channel == Kinematic::kGazeYawLeft) there = -other.at(Kinematic::kGazeYawRight);
        if (channel == Kinematic::kGazeYawRight) there = -other.at(Kinematic::kGazeYawLeft);
        if (channel == Kinematic::kGazePitchLeft) there = other.at(Kinematic::kGazePitchRight);
        if (channel == Kinematic::kGazePitchRight) there = other.at(Kinematic::kGazePitchLeft);
        if (std::abs(one.at(channel) - there) > kSame) return false;
    }
    return true;
}

class Maker {
  public:
    Maker(const scene::RigFiles& files, const ShapeSet& set, const ShapeSolver& solver)
        : files_(files),
          set_(set),
          solver_(solver),
          head_(solver.face().head()),
          channels_(files.rig.channels()),
          points_(head_, files.rig),
          mirror_(blendshapes::mirror_of(head_.skin, head_.vertices)),
          rigid_(rigid_parts(head_, files.mesh)) {}

    MadeShapes make(const ProgressMonitor& monitor) {
        const Plan plan = plan_of(set_, channels_);
        std::vector<SolvedPose> poses = solver_.solve(plan.drives, monitor);
        keep_upright(plan, poses, monitor);
        MadeShapes out;
        out.mirrored = mirror_.has_value();
        const std::vector<std::optional<double>> as_solved = mirror_poses(plan, poses);
        std::vector<Points> fields;
        std::vector<const SolvedPose*> solved;
        for (std::size_t i = 0; i < set_.goals.size(); ++i) {
            MadeShape& made = out.list.emplace_back();
            made.goal = set_.goals[i];
            const std::size_t chosen = choose(plan.own[i], poses);
            if (made.goal.on_top_of >= 0) made.solved_at = kShutTries[chosen];
            solved.push_back(&poses[plan.own[i][chosen]]);
            fields.push_back(solved.back()->moved);
            // A shape on top of another is the difference from that one, with the jaw in the same position.
            if (made.goal.on_top_of >= 0)
                fields.back() =
                    (fields.back() - poses[plan.under[i][chosen]].moved) / made.solved_at;
            made.eye_rotation = solved.back()->eye_rotation;
            made.certificate.asymmetry_as_solved_m = as_solved[plan.own[i][chosen]];
        }
        // Halves are corrected so that their sum is the whole.
        for (std::size_t i = 0; i < set_.goals.size(); ++i)
            if (plan.whole[i] >= 0)
                blendshapes::share_the_rest(
                    head_.vertices, poses[static_cast<std::size_t>(plan.whole[i])].moved,
                    head_.mm(kHalfWidth_mm), fields[i],
                    fields[static_cast<std::size_t>(set_.goals[i].partner)]);
        for (Points& field : fields) blendshapes::fade_out(field);
        for (std::size_t i = 0; i < set_.goals.size(); ++i)
            if (plan.whole[i] >= 0) {
                const Points sum =
                    fields[i] + fields[static_cast<std::size_t>(set_.goals[i].partner)];
                const Points& whole = poses[static_cast<std::size_t>(plan.whole[i])].moved;
                out.halves_error_m =
                    std::max(out.halves_error_m, (sum - whole).rowwise().norm().maxCoeff());
            }
        for (std::size_t i = 0; i < set_.goals.size(); ++i)
            out.list[i].shape = blendshapes::sparse(fields[i]);
        for (std::size_t i = 0; i < set_.goals.size(); ++i) certify(out, i, *solved[i], fields);
        return out;
    }

  private:
    // A symmetric drive on a symmetric head may give an asymmetric pose, because the tissue has buckled. Such a pose is solved
    // again in small steps, and the less asymmetric one is used.
    void keep_upright(const Plan& plan, std::vector<SolvedPose>& poses,
                      const ProgressMonitor& monitor) const {
        if (!mirror_) return;
        const auto lean = [&](const SolvedPose& pose) {
            return blendshapes::asymmetry_m(*mirror_, pose.moved, pose.moved);
        };
        std::vector<std::size_t> leaning;
        std::vector<track::Drive> drives;
        for (std::size_t i = 0; i < poses.size(); ++i)
            if (are_mirrored(plan.drives[i], plan.drives[i], channels_) &&
                lean(poses[i]) > ShapeLimits().asymmetry_m) {
                leaning.push_back(i);
                drives.push_back(plan.drives[i]);
            }
        if (leaning.empty()) return;
        std::vector<SolvedPose> again = solver_.solve(
            drives, {.progress = {}, .stopped = monitor.stopped}, {.steps = kUprightSteps});
        for (std::size_t k = 0; k < leaning.size(); ++k)
            if (again[k].figures.converged && lean(again[k]) < lean(poses[leaning[k]]))
                poses[leaning[k]] = std::move(again[k]);
    }

    // Makes poses with mirrored drives exact mirror images: each becomes the mean of itself and of the mirror image of the other.
    // The mean of two ways to buckle is a pose that has not buckled. Returns the asymmetry of each pose before.
    std::vector<std::optional<double>> mirror_poses(const Plan& plan,
                                                    std::vector<SolvedPose>& poses) const {
        std::vector<std::optional<double>> out(poses.size());
        if (!mirror_) return out;
        const auto mirror = [&](std::size_t a, std::size_t b) {
            if (!are_mirrored(plan.drives[a], plan.drives[b], channels_)) return;
            out[a] = out[b] = blendshapes::asymmetry_m(*mirror_, poses[a].moved, poses[b].moved);
            poses[a].moved =
                blendshapes::mean_with_mirror_image(*mirror_, poses[a].moved, poses[b].moved);
            if (b != a)
                poses[b].moved =
                    blendshapes::with_mirror_image(*mirror_, poses[b].moved, poses[a].moved);
        };
        for (std::size_t i = 0; i < set_.goals.size(); ++i) {
            const ShapeGoal& goal = set_.goals[i];
            if (goal.partner < 0)
                for (std::size_t k = 0; k < plan.own[i].size(); ++k) {
                    mirror(plan.own[i][k], plan.own[i][k]);
                    if (goal.on_top_of >= 0) mirror(plan.under[i][k], plan.under[i][k]);
                }
            else if (goal.left)
                mirror(plan.own[i][0], plan.own[static_cast<std::size_t>(goal.partner)][0]);
            if (plan.whole[i] >= 0)
                mirror(static_cast<std::size_t>(plan.whole[i]),
                       static_cast<std::size_t>(plan.whole[i]));
        }
        return out;
    }

    double lip_gap_m(const Points& moved) const {
        const auto gap = [&](const Points& vertices) {
            return points_.at("stos", vertices).y() - points_.at("stoi", vertices).y();
        };
        return gap(head_.vertices + moved) - gap(head_.vertices);
    }

    // Of several tries, the first that closes the lips, or else the one with the smallest gap.
    std::size_t choose(const std::vector<std::size_t>& tries,
                       const std::vector<SolvedPose>& poses) const {
        if (tries.size() == 1) return 0;
        std::size_t best = 0;
        double min = kInfinity;
        for (std::size_t i = 0; i < tries.size(); ++i) {
            const double gap = lip_gap_m(poses[tries[i]].moved);
            if (gap <= kShutLips_m) return i;
            if (gap < min) std::tie(min, best) = std::tuple(gap, i);
        }
        return best;
    }

    void certify(MadeShapes& out, std::size_t i, const SolvedPose& solved,
                 const std::vector<Points>& fields) const {
        MadeShape& made = out.list[i];
        ShapeCertificate& certificate = made.certificate;
        const Points& field = fields[i];
        const Points shown = made.goal.on_top_of < 0 ? Points(head_.vertices + field)
                                                     : Points(head_.vertices + solved.moved);
        certificate.volume_change = solved.volume_ratio - 1;
        certificate.lip_depth_m = solved.figures.lip_depth_m;
        certificate.bone_depth_m = solved.figures.bone_depth_m;
        certificate.converged = solved.figures.converged;
        certificate.inverted_tets = solved.inverted_tets;
        certificate.eye_depth_m = face::depth_in_eyes_m(head_, made.eye_rotation, shown);
        for (const Side side : {Side::kLeft, Side::kRight}) {
            const int s = static_cast<int>(side);
            if (!head_.eyes[static_cast<std::size_t>(s)].present ||
                !shuts_eye(made.goal.drive, channels_, side))
                continue;
            const face::EyeLids lids(head_, s, files_.rig.eyes.lid_closed_fraction);
            certificate.lid_gap_m = std::max(certificate.lid_gap_m.value_or(0.0),
                                             face::max_lid_gap_m(head_, lids, shown));
        }
        if (made.goal.on_top_of >= 0) certificate.lip_gap_m = lip_gap_m(solved.moved);
        const std::size_t partner =
            made.goal.partner >= 0 ? static_cast<std::size_t>(made.goal.partner) : i;
        if (mirror_ && are_mirrored(made.goal.drive, set_.goals[partner].drive, channels_))
            certificate.asymmetry_m =
                made.solved_at * blendshapes::asymmetry_m(*mirror_, field, fields[partner]);
        certificate.stretch = blendshapes::stretch_of(solver_.face().surfaces().simulated_skin(),
                                                      head_.vertices, shown);
        certificate.rigid_part_m = bent_by_m(rigid_, head_.vertices, shown);
        certificate.peak_m = field.rowwise().norm().maxCoeff();
        certificate.moved_vertices = static_cast<int>(made.shape.vertex.size());
    }

    const scene::RigFiles& files_;
    const ShapeSet& set_;
    const ShapeSolver& solver_;
    const rig::Head& head_;
    track::ChannelTable channels_;
    scene::LandmarkPoints points_;
    std::optional<geom::MirrorPairs> mirror_;
    std::vector<std::vector<int>> rigid_;
};

}  // namespace

MadeShapes make_shapes(const scene::RigFiles& files, const ShapeSet& set, const ShapeSolver& solver,
                       const ProgressMonitor& monitor) {
    return Maker(files, set, solver).make(monitor);
}

Points shown_pose(const MadeShapes& shapes, std::size_t index, const Points& rest) {
    const MadeShape& made = shapes.list[index];
    Points out = rest;
    if (made.goal.on_top_of >= 0)
        shapes.list[static_cast<std::size_t>(made.goal.on_top_of)].shape.add_to(out,
                                                                                made.solved_at);
    made.shape.add_to(out, made.goal.on_top_of >= 0 ? made.solved_at : 1.0);
    return out;
}

}  // namespace risorius::blendshapes
