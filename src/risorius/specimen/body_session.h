// SPDX-License-Identifier: MIT
/// \file
/// A soft body of an experiment (samples/figures) that is simulated and pulled: what a page of the studio asks for, without sockets, threads
/// and files. The page speaks as with a face (view/session.h); there are no channels and no script.
///
/// Messages take effect between two ticks. A tick is a step of 1/60 s by implicit Euler, from the rest shape on. The same messages between
/// the same ticks give the same poses. A body may be of any size: the page gets it as if its longest edge were 150 mm, around the origin.
/// Forces and distances that are told are those of the body.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/render/scene.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"
#include "risorius/tissue/point_springs.h"
#include "risorius/view/scene_frame.h"

namespace risorius::specimen {

class BodySession {
  public:
    /// Builds the "body" of an experiment. Throws Error for an experiment without one, and for a body without a surface.
    explicit BodySession(const JsonCursor& experiment);

    /// {"type": "welcome", "kind": "body", "rig": the title, "channels": [], ...}
    std::string welcome() const;
    /// {"type": "document", "script": {"duration_s": 4}, ...}: nothing to be edited.
    std::string document() const;
    std::string scene() const;  ///< see view/scene_frame.h

    /// Does what "pull", "pull_to", "pull_end", "play", "pause" and "seek" to 0 s (from the rest shape again) ask, and returns
    /// messages for the page. Anything else gives a message "error"; nothing is thrown.
    std::vector<std::string> receive(const std::string& message);

    /// Makes a step if anything moves, and returns whether there is a new pose.
    bool tick();
    /// Messages that steps have caused: the simulation has diverged, and begins again.
    std::vector<std::string> events() { return std::exchange(events_, {}); }
    std::string pose() const;   ///< see view/pose_frame.h
    std::string state() const;  ///< as of a face

    const softbody::SoftBody& body() const { return body_; }
    const Points& positions() const { return state_.x; }  ///< of all nodes, m

  private:
    /// A spring between a node and a hand.
    struct Hand {
        int node;
        double stiffness_n_per_m;
        Vec3 at;    ///< m
        Vec3 from;  ///< where the node was when it was taken, m
        std::shared_ptr<tissue::InteractiveSpring> spring;
    };

    void pull(const JsonCursor& message);
    void pull_to(const JsonCursor& message);
    void pull_end(const JsonCursor& message);
    void let_go(const Hand& hand);
    void restart();
    // Of the body, z is up; of the page, y.
    Vec3 shown(const Vec3& point_m) const {
        const Vec3 p = scale_ * (point_m - centre_);
        return {p.x(), p.z(), -p.y()};
    }
    Vec3 meant(const Vec3& shown_m) const {
        return Vec3(shown_m.x(), -shown_m.z(), shown_m.y()) / scale_ + centre_;
    }
    Points shown(const Points& points) const;

    std::string title_, file_;
    softbody::SoftBody body_;
    std::unique_ptr<solve::Integrator> steps_;
    solve::MotionState state_;
    render::Scene scene_;
    view::DrawnVertices drawn_;
    double scale_ = 1;
    Vec3 centre_ = Vec3::Zero();
    double unit_m_ = 1;
    std::map<int, Hand> hands_;
    std::vector<std::shared_ptr<tissue::InteractiveSpring>> free_;  ///< springs that nobody holds
    bool playing_ = true;
    int quiet_ = 0;  ///< ticks without motion
    long ticks_ = 0;
    std::vector<std::string> events_;
};

}  // namespace risorius::specimen
