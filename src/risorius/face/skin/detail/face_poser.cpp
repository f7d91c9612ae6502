// SPDX-License-Identifier: MIT
#include "risorius/face/skin/detail/face_poser.h"

#include <algorithm>
#include <utility>

#include "risorius/face/skin/detail/head_motion.h"

namespace risorius::face {

namespace {

Mat3 gaze_rotation(double yaw_deg, double pitch_deg) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    return (Eigen::AngleAxisd(yaw_deg * kDegree, Vec3::UnitY()) *
            Eigen::AngleAxisd(-pitch_deg * kDegree, Vec3::UnitX()))
        .toRotationMatrix();
}

}  // namespace

FacePoser::FacePoser(const rig::Head& head, const rig::RigDescription& rig, const Jaw& jaw,
                     const JawJoint& joint, const std::array<EyeLids, 2>& lids, const Shell& shell,
                     const TissueMesh& mesh)
    : head_(head),
      rig_(rig),
      joint_(joint),
      lids_(lids),
      shell_(shell),
      mesh_(mesh),
      channels_(rig.channels()),
      binding_(head, jaw, shell),
      lid_pull_(head, rig.eyes),
      follow_(head, rig, lids, binding_),
      skin_(head, rig, jaw, lids, shell, mesh, binding_),
      lining_(head) {}

LidPose FacePoser::lid(int side, const Eigen::VectorXd& activation, const track::Drive& drive,
                       const LidPull& pull) const {
    const Side s = side == 0 ? Side::kLeft : Side::kRight;
    const auto of = [&](const char* id) {
        const int column = channels_.column(id, s);
        return column < 0 ? 0.0 : activation[column];
    };
    // A lid falls when the levator relaxes. Orbicularis presses it shut; levator and tarsal muscle open it wide.
    const double levator = of("levator_palpebrae_superioris");
    const double upper = of("orbicularis_oculi_palpebral_upper");
    const double lower = of("orbicularis_oculi_palpebral_lower");
    LidPose pose;
    pose.upper_closure = std::min(1.0, 0.95 * std::max(0.0, -levator) + 0.2 * upper);
    pose.lower_closure = pose.upper_closure;
    pose.lower_lift = 0.22 * lower * (1.0 - pose.upper_closure);
    // Orbicularis pulls both lids towards its origin at the inner canthus.
    pose.inward = pose.upper_closure * (0.5 + std::min(0.5, upper));
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const double pitch =
        drive.at(side == 0 ? track::Kinematic::kGazePitchLeft : track::Kinematic::kGazePitchRight);
    const double open = 1.0 - pose.upper_closure;
    pose.upper_gaze_rad =
        -open * kDegree *
        (pitch > 0 ? rig_.eyes.upper_lid_per_gaze_up : rig_.eyes.upper_lid_per_gaze_down) * pitch;
    pose.lower_gaze_rad =
        -open * kDegree *
        (pitch > 0 ? rig_.eyes.lower_lid_per_gaze_up : rig_.eyes.lower_lid_per_gaze_down) * pitch;
    pose.aside_rad =
        open * kDegree * rig_.eyes.lids_per_gaze_aside *
        drive.at(side == 0 ? track::Kinematic::kGazeYawLeft : track::Kinematic::kGazeYawRight);
    pose.upper_gaze_rad -=
        kDegree * rig_.eyes.wide_deg * (0.8 * std::max(0.0, levator) + 0.2 * of("superior_tarsal"));
    const EyeLids& lids = lids_[side];
    const double fissure_rad = lids.upper_angle(0.5) - lids.lower_angle(0.5);
    pose.upper_gaze_rad += open * pull.upper_m / lids.zone_m();
    pose.lower_lift += open * pull.lower_m / (lids.zone_m() * std::max(fissure_rad, 0.1));
    return pose;
}

std::array<Mat3, 2> FacePoser::gaze(const track::Drive& drive) const {
    const auto of = [&](track::Kinematic channel) {
        return std::clamp(drive.at(channel), -rig_.eyes.gaze_limit_deg, rig_.eyes.gaze_limit_deg);
    };
    return {
        gaze_rotation(of(track::Kinematic::kGazeYawLeft), of(track::Kinematic::kGazePitchLeft)),
        gaze_rotation(of(track::Kinematic::kGazeYawRight), of(track::Kinematic::kGazePitchRight))};
}

Points FacePoser::skin_displacement(const Points& x) const {
    Points displacement(static_cast<long>(shell_.vertex.size()), 3);
    for (long v = 0; v < displacement.rows(); ++v) {
        const int node = node_of(static_cast<int>(v), kSkin);
        displacement.row(v) = x.row(node) - mesh_.nodes.row(node);
    }
    return displacement;
}

FollowDrive FacePoser::follow_drive(const FaceMoment& moment,
                                    const std::array<LidPull, 2>& pull) const {
    const track::Drive& drive = moment.drive;
    return {moment.mandible,
            gaze(drive),
            lids(moment.activation, drive, pull),
            drive.at(track::Kinematic::kTongueOut),
            drive.at(track::Kinematic::kTongueUp),
            drive.at(track::Kinematic::kTongueBodyUp),
            drive.at(track::Kinematic::kTongueBodyBack),
            head_motion(head_, drive)};
}

// Transposes the motion of the parts that follow the skin. Each of their vertices depends on itself, and those of the lids on the skin
// of brow and cheek.
Points FacePoser::pull_through(const FaceMoment& moment, const Points& surface,
                               const Points& slope) const {
    constexpr double kDifference_m = 1e-6;
    const std::array<LidPull, 2> pull = lid_pull_.of(surface);
    const auto followed = [&](const std::array<LidPull, 2>& with, Points vertices) {
        follow_.apply(follow_drive(moment, with), vertices);
        return vertices;
    };
    Points out(slope.rows(), 3);
    for (int k = 0; k < 3; ++k) {
        Points above = surface, below = surface;
        above.col(k).array() += kDifference_m;
        below.col(k).array() -= kDifference_m;
        const Points change = followed(pull, std::move(above)) - followed(pull, std::move(below));
        out.col(k) = change.cwiseProduct(slope).rowwise().sum() / (2 * kDifference_m);
    }
    std::array<LidPull, 2> by_pull;
    for (std::size_t side = 0; side < 2; ++side)
        for (double LidPull::*lid : {&LidPull::upper_m, &LidPull::lower_m}) {
            std::array<LidPull, 2> more = pull, less = pull;
            more[side].*lid += kDifference_m;
            less[side].*lid -= kDifference_m;
            by_pull[side].*lid =
                (followed(more, surface) - followed(less, surface)).cwiseProduct(slope).sum() /
                (2 * kDifference_m);
        }
    lid_pull_.add_gradient(surface, by_pull, out);
    return out;
}

Points FacePoser::pull_back(const FaceMoment& moment, const Points& slope) const {
    Points by_skin = slope;
    pose(moment, Folds::kLeftOut, &by_skin);
    const Points by_shell = binding_.pull_back(by_skin, static_cast<long>(shell_.vertex.size()));
    Points out = Points::Zero(moment.x.rows(), 3);
    for (long v = 0; v < by_shell.rows(); ++v)
        out.row(node_of(static_cast<int>(v), kSkin)) = by_shell.row(v);
    return out;
}

FacePose FacePoser::pose(const FaceMoment& moment, Folds folds, Points* pulled) const {
    const track::Drive& drive = moment.drive;
    FacePose out;
    out.mandible = moment.mandible;
    out.jaw = joint_.place(moment.mandible);
    out.jaw_open = drive.at(track::Kinematic::kJawOpen);
    out.vertices = head_.vertices;
    binding_.apply(skin_displacement(moment.x), moment.mandible, out.vertices);
    const FollowDrive followed = follow_drive(moment, lid_pull_.of(out.vertices));
    if (folds == Folds::kFormed) {
        out.fold_depth = skin_.apply(moment.activation, out.vertices);
        lining_.stay_behind(out.vertices);
    }
    out.head = followed.head;
    if (pulled) *pulled = pull_through(moment, out.vertices, *pulled);
    follow_.apply(followed, out.vertices);
    for (std::size_t side = 0; side < 2; ++side)
        out.eye_rotation[side] = out.head.linear() * followed.gaze[side];
    return out;
}

FacePose FacePoser::posed(Points vertices, const track::Drive& drive, const Rigid& mandible) const {
    FacePose out;
    const std::array<Mat3, 2> turned = gaze(drive);
    out.mandible = mandible;
    out.jaw = joint_.place(mandible);
    out.jaw_open = drive.at(track::Kinematic::kJawOpen);
    out.head = head_motion(head_, drive);
    for (std::size_t side = 0; side < 2; ++side)
        out.eye_rotation[side] = out.head.linear() * turned[side];
    out.vertices = std::move(vertices);
    follow_.turn_eyes(turned, out.vertices);
    follow_.turn_head(out.head, out.vertices);
    return out;
}

}  // namespace risorius::face
