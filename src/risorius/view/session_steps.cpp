// SPDX-License-Identifier: MIT
// The ticks of a session.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/surfaces.h"
#include "risorius/scene/visualization.h"
#include "risorius/view/session.h"

namespace risorius::view {

// The steps

bool Session::tick() {
    ++ticks_;
    try {
        const bool moved = playing_                     ? tick_playing()
                           : wanted_ >= 0 && !touched() ? tick_seeking()
                                                        : tick_live();
        if (std::exchange(document_changed_, false)) events_.push_back(document());
        return moved;
    } catch (const Error& error) {
        events_.push_back(error_message(nullptr, error.what()));
        restart_face();
        return true;
    }
}

bool Session::tick_playing() {
    if (++waited_ < every_) return false;
    waited_ = 0;
    if (frame_ >= last_frame()) {
        if (!loop_) playing_ = false;
        finish_recording();
        if (loop_) {
            frame_ = -1;
        } else {
            return true;
        }
    }
    const long next = frame_ + 1;
    if (touched()) {
        frame_ = next;
        record_hands();
        record_channels();
        const double shift_s = time_s() - face_->time_s() - face_->step_s();
        face_->step([&](double t_s) { return live_drive(std::max(0.0, t_s + shift_s)); });
        face_frame_ = -1;
        unseen_ = Unseen{time_s(), live_drive(time_s())};
        return true;
    }
    if (!compute_until(next)) return false;
    frame_ = next;
    show_taken(next);
    return true;
}

bool Session::tick_seeking() {
    if (!compute_until(wanted_)) return false;
    show_taken(wanted_);
    wanted_ = -1;
    quiet_ = kQuietTicks;
    return true;
}

/// Puts the face where it was at the last moment that is known, or at the start.
void Session::begin_take(const face::DriveAt& drive) {
    if (const auto last = moments_.last_until(take_.valid() - 1)) {
        face_->go_back_to(last->moment);
        face_frame_ = last->frame;
    } else {
        face_->start(drive);
    }
}

/// Computes some more frames of the take; true when the frame is there.
bool Session::compute_until(long frame) {
    constexpr int kFramesPerTick = 5;
    if (take_.has(frame)) return true;
    const face::DriveAt drive = [this](double t_s) { return timeline_->at(t_s); };
    if (face_frame_ > frame) face_frame_ = -1;  // there was no room for it
    for (int i = 0; i < kFramesPerTick && (face_frame_ < frame || face_frame_ < 0); ++i) {
        if (face_frame_ < 0) begin_take(drive);
        if (face_frame_ == frame) {
            show(face_->pose(), time_s(), timeline_->at(time_s()));
            break;
        }
        const long next = face_frame_ + 1;
        const double t_s = static_cast<double>(next) / 60;
        const face::FacePose pose = face_->pose_at(t_s, drive);
        face_frame_ = next;
        show(pose, t_s, timeline_->at(t_s));
        if (!shown_.vertices.allFinite()) {
            recover();
            return false;
        }
        take_.put(next, encode_pose(shown_, unit_m_));
        if (script_.header.motion == track::Motion::kDynamic && take_.has(next) &&
            moments_.wants(next))
            moments_.put(next, face_->keep());
    }
    return take_.has(frame) || face_frame_ == frame;
}

bool Session::tick_live() {
    if (quiet_ >= kQuietTicks) return false;
    record_hands();
    const double t_s = time_s();
    const track::Drive drive = live_drive(t_s);
    face_->step([&](double) { return drive; });
    face_frame_ = -1;
    unseen_ = Unseen{t_s, drive};
    constexpr double kStill_m = 2e-6;  // far less than one unit of a pose
    const Points nodes = face_->diagnostics().skin_nodes();
    if (!nodes.allFinite()) {
        recover();
        return true;
    }
    const bool still = last_nodes_.rows() == nodes.rows() &&
                       (nodes - last_nodes_).cwiseAbs().maxCoeff() < kStill_m;
    last_nodes_ = nodes;
    quiet_ = still ? quiet_ + 1 : 0;
    if (!touched() && !fails_ && (quiet_ >= kQuietTicks || ++held_ >= kLongestHold))
        wanted_ = frame_;
    return true;
}

/// After a position that is not finite: lets go of everything and begins again.
void Session::recover() {
    events_.push_back(error_message(
        nullptr, "the simulation: expected finite positions, found none at " +
                     format_number(time_s()) + " s; pulls and overrides are released"));
    restart_face();
}

void Session::restart_face() {
    hands_.clear();
    overrides_.clear();
    performed_.clear();
    recording_ = false;
    recorded_ = {};
    playing_ = false;
    fails_ = true;
    wanted_ = -1;
    face_frame_ = -1;
    make_live();
    const track::Drive drive = live_drive(time_s());
    face_->start([&](double) { return drive; });
    show(face_->pose(), time_s(), drive);
}

void Session::show(const face::FacePose& pose, double t_s, const track::Drive& drive) {
    unseen_.reset();
    shown_.t_s = t_s;
    shown_.head = pose.head;
    shown_.mandible = pose.mandible;
    shown_.vertices = drawn_.of(pose.vertices);
    shown_.drive = drive.excitation;
    shown_.activation = face_->activation();
    shown_.muscles.resize(0, 3);
    if (with_muscles_) shown_.muscles = face_->surfaces().muscle_vertices_at(face_->time_s());
}

void Session::show_taken(long frame) {
    if (!take_.has(frame)) return;  // no room: it is what has been computed last
    unseen_.reset();
    shown_ = decode_pose(take_.at(frame), unit_m_);
}

std::string Session::pose() {
    if (unseen_) {
        const Unseen now = *unseen_;
        show(face_->pose(), now.t_s, now.drive);
    }
    PoseFrame frame = shown_;
    frame.step = static_cast<std::uint32_t>(ticks_);
    if (with_strain_)
        frame.strain = scene::principal_strain(skin_, drawn_.of(scene_.rest), frame.vertices);
    if (!with_muscles_) frame.muscles.resize(0, 3);
    return encode_pose(frame, unit_m_);
}

}  // namespace risorius::view
