// SPDX-License-Identifier: MIT
/// \file
/// One scene of an experiment file: soft bodies that fall on rigid obstacles and on each other.
///
///   {"name": "cloth-over-torus", "caption": "...", "duration_s": 1.5, "parts_per_side": 2,
///    "bodies": [{...}], "obstacles": [{"torus": {"centre_m": [0, 0, 0], "radius_m": 0.1, "tube_m": 0.04}}],
///    "contact": {"stiffness_pa_per_m": 1e5, "thickness_m": 1e-3, "friction": 0.5}}
///
/// Obstacles are planes, spheres and capsules as in softbody/action_description.h, and tori, which are closed meshes. Every body
/// may touch every obstacle. Closed bodies also touch each other. Contact is tested at sample points on the surfaces of the
/// bodies; "parts_per_side" is the number of parts into which the samples divide each side of a triangle (1: nodes only).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "risorius/contact/obstacle_contact.h"
#include "risorius/contact/surface_contact.h"
#include "risorius/core/json_cursor.h"
#include "risorius/figures/detail/figure_result.h"
#include "risorius/figures/detail/run_options.h"
#include "risorius/softbody/body_description.h"
#include "risorius/softbody/soft_body.h"
#include "risorius/solve/integrator.h"

namespace risorius::figures {

/// A rigid obstacle, and the surface that is drawn for it.
struct SceneObstacle {
    std::shared_ptr<const contact::Obstacle> obstacle;
    Points positions;  ///< vertices of the surface to draw; empty for a plane
    Triangles triangles;
    bool is_plane = false;  ///< it is drawn as a square below the bodies, perpendicular to `normal`
    Vec3 point_m = Vec3::Zero(), normal = Vec3::UnitZ();
};

struct ContactSceneDescription {
    std::string name, caption;
    double duration_s = 1;
    int parts_per_side = 2;
    std::vector<softbody::BodyDescription> bodies;
    std::vector<SceneObstacle> obstacles;
    contact::ContactMaterial contact;
};

/// Throws Error for a wrong description.
ContactSceneDescription read_contact_scene(const JsonCursor& json);

/// A scene that can be simulated and measured. Measurements apply to its current state.
class ContactScene {
  public:
    explicit ContactScene(const ContactSceneDescription& description);

    /// Simulates up to the time `until_s`.
    solve::IntegratorReport run(solve::IntegratorOptions integrator, double until_s,
                                const RunOptions& options);

    const solve::MotionState& state() const { return state_; }
    int body_count() const { return static_cast<int>(bodies_.size()); }
    double weight_n(int body) const { return bodies_[static_cast<std::size_t>(body)].weight_n; }
    Vec3 velocity(int body) const;  ///< velocity of the centre of mass, m/s

    Vec3 support_n() const;  ///< total force of the obstacles on all bodies, friction included
    Vec3 load_on_first_n() const;  ///< force of the other bodies on body 0, friction included
    double min_gap_m() const;      ///< smallest gap of all contacts; negative: penetration
    double max_speed_m_per_s() const { return state_.v.rowwise().norm().maxCoeff(); }

    Shape shape(const ContactSceneDescription& description) const;

  private:
    std::vector<softbody::SoftBody> bodies_;
    std::vector<int> first_;  // row of the first node of each body
    Eigen::VectorXd mass_kg_;
    std::vector<std::shared_ptr<contact::ObstacleContact>> on_obstacles_;
    std::vector<std::shared_ptr<contact::SurfaceContact>> between_;
    std::unique_ptr<solve::MotionSystem> system_;
    solve::MotionState state_;
    double length_scale_m_ = 0;
};

}  // namespace risorius::figures
