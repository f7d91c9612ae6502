// SPDX-License-Identifier: MIT
// Weights of morph targets in glTF, and VRM animations.
#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_cursor.h"
#include "risorius/io/animation_tracks.h"
#include "risorius/motion/detail/motion_readers.h"

namespace risorius::motion::detail {

namespace {

using io::AnimationTrack;

/// The row of a track at a time.
Eigen::VectorXd value_at(const AnimationTrack& track, double t_s) {
    const auto after = std::upper_bound(track.times_s.begin(), track.times_s.end(), t_s + 1e-9);
    const long next = after - track.times_s.begin();
    if (next == 0) return track.values.row(0);
    if (next == track.values.rows() || track.stepped) return track.values.row(next - 1);
    const double from = track.times_s[static_cast<std::size_t>(next) - 1],
                 share = (t_s - from) / (track.times_s[static_cast<std::size_t>(next)] - from);
    Eigen::VectorXd one = track.values.row(next - 1), two = track.values.row(next);
    if (track.path == "rotation" && one.dot(two) < 0) two = -two;
    return one + std::clamp(share, 0.0, 1.0) * (two - one);
}

Eigen::Quaterniond quaternion_of(const Eigen::VectorXd& xyzw) {
    return Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized();
}

/// Rotation of a node from its place at rest.
Mat3 turn_at(const AnimationTrack& track, double t_s) {
    return (quaternion_of(track.at_rest).inverse() * quaternion_of(value_at(track, t_s)))
        .toRotationMatrix();
}

}  // namespace

RecordedMotion read_gltf_motion(const std::filesystem::path& file, double fps) {
    const io::AnimationTracks from = io::read_animation_tracks(file);
    MotionBuilder out;
    struct Weight {
        std::string channel;
        const AnimationTrack* track;
        long column;
    };
    std::vector<Weight> weights;
    std::vector<const AnimationTrack*> head;
    const AnimationTrack* look = nullptr;
    const auto add = [&](const std::string& name, const AnimationTrack& track, long column) {
        std::string channel = arkit_spelling(name);
        std::vector<std::string> channels{channel};
        if (name == "blink") channels = {"eyeBlinkLeft", "eyeBlinkRight"};
        if (name == "blinkLeft") channels = {"eyeBlinkLeft"};
        if (name == "blinkRight") channels = {"eyeBlinkRight"};
        for (const std::string& one : channels)
            if (one.empty())
                out.unmapped(name);
            else if (std::none_of(weights.begin(), weights.end(),
                                  [&](const Weight& other) { return other.channel == one; }))
                weights.push_back({one, &track, column});  // several meshes have the same
    };
    const auto named = [&](const AnimationTrack& track) -> const io::VrmNode* {
        for (const io::VrmNode& node : from.vrm)
            if (node.node == track.node) return &node;
        return nullptr;
    };
    for (const AnimationTrack& track : from.tracks) {
        const io::VrmNode* vrm = named(track);
        if (track.path == "weights") {
            for (std::size_t t = 0; t < track.targets.size(); ++t)
                add(track.targets[t], track, static_cast<long>(t));
            if (track.targets.empty()) out.unmapped("weights of " + track.node_name);
        } else if (track.path == "translation" && vrm && vrm->kind == "expression") {
            add(vrm->name, track, 0);
        } else if (track.path == "rotation") {
            const std::string bone =
                lower_case(vrm && vrm->kind == "bone" ? vrm->name : track.node_name);
            if (vrm && vrm->kind == "look_at")
                look = &track;
            else if (bone == "neck")
                head.insert(head.begin(), &track);
            else if (bone == "head")
                head.push_back(&track);
        }
    }
    constexpr std::size_t kMostBent = 16;
    if (head.size() > kMostBent)
        throw Error(file.string(), "at most 16 moving nodes called head or neck",
                    std::to_string(head.size()));
    std::set<double> times;
    for (const Weight& weight : weights)
        times.insert(weight.track->times_s.begin(), weight.track->times_s.end());
    for (const AnimationTrack* track : head)
        times.insert(track->times_s.begin(), track->times_s.end());
    if (look) times.insert(look->times_s.begin(), look->times_s.end());
    // Times of several tracks may differ by the rounding of floats.
    double before = -1;
    for (const double t_s : times) {
        if (t_s - before < 1e-6) continue;
        before = t_s;
        out.begin(t_s, true);
        for (const Weight& weight : weights)
            out.set(weight.channel, value_at(*weight.track, t_s)[weight.column]);
        if (!head.empty()) {
            Mat3 turn = Mat3::Identity();
            for (const AnimationTrack* track : head) turn = turn * turn_at(*track, t_s);
            out.set_head(head_angles(turn));
        }
        if (look) {
            const std::array<double, 3> angles = head_angles(turn_at(*look, t_s));
            for (const char* side : {".l", ".r"}) {
                out.set(std::string("gaze_yaw_deg") + side, angles[0]);
                out.set(std::string("gaze_pitch_deg") + side, angles[1]);
            }
        }
    }
    if (from.animations > 1)
        out.motion().notes.push_back("the first of " + std::to_string(from.animations) +
                                     " animations is taken");
    RecordedMotion motion = out.finish(file.string(), "gltf", fps);
    motion.lost = 0;
    motion.keyed = true;
    return motion;
}

}  // namespace risorius::motion::detail
