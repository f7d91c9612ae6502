// SPDX-License-Identifier: MIT
/// \file
/// Contact between two soft bodies of one system, with friction. contact_law.h explains the symbols.
///
///   E = sum over pairs of A k w(n . xi)     A  area of a sample, m^2     n  normal of the pair in the frame of the triangle
///   xi  coordinates of the sample in the frame of the nearest triangle of the other body, m
///
/// Samples of the surface of each body (surface_samples.h) are paired with triangles of the other body. The pairs of either
/// direction have half of the stiffness. Pairs and their normals are found at the start of a step and stay constant in the
/// frame of the triangle (detail/carried_frame.h). So the net force and torque of a pair are zero up to rounding in every
/// state, also with friction and damping. Friction and damping are lagged as in obstacle_contact.h; the slip is measured in the
/// frame of the triangle.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "risorius/contact/contact_law.h"
#include "risorius/contact/detail/closed_surface.h"
#include "risorius/contact/surface_samples.h"
#include "risorius/solve/energy_term.h"

namespace risorius::contact {

/// Density of the samples, and the range of the search.
struct SurfaceContactOptions {
    int per_side = 2;  ///< number of parts of each side of a triangle, for samples     [1, inf)
    /// Pairs are searched inside and outside within this distance plus the thickness plus the motion in the step, m. 0: 4
    /// thicknesses.
    double search_m = 0;
};

class CarriedFrame;

/// The contact forces between two surfaces.
class SurfaceContact : public solve::EnergyTerm {
  public:
    /// Contact between two closed surfaces over the nodes of one system. Throws Error unless both are closed in the rest shape.
    SurfaceContact(const Points& rest, const Triangles& first, const Triangles& second,
                   const ContactMaterial& material, const SurfaceContactOptions& options = {});
    /// Contact of samples of a body without an inside (a cloth, a curve) with a closed surface.
    SurfaceContact(const Points& rest, std::vector<ContactSample> samples, const Triangles& closed,
                   const ContactMaterial& material, const SurfaceContactOptions& options = {});

    SurfaceContact(const SurfaceContact&) = delete;  // pairs point into the object
    SurfaceContact& operator=(const SurfaceContact&) = delete;

    void begin_step(double t_s, double step_s, const Points& x, const Points& v) override;
    void add_force(double t_s, const Points& x, const Points& v, Points& force) const override;
    double energy(double t_s, const Points& x) const override;
    double add_potential(const solve::ImplicitStep& step, const Points& x,
                         Points& gradient) const override;
    void add_hessian(const solve::ImplicitStep& step, const Points& x, solve::Curvature curvature,
                     solve::HessianBuilder& hessian) const override;
    /// Adds half of the stiffness of every node of either surface, whether it touches or not, because every node may touch at
    /// some time.
    void add_metric(double step_s, solve::MetricBuilder& metric) const override;

    /// Minimum gap of the pairs of the step, m. It is negative when there is penetration, and infinite without pairs.
    double min_gap_m(const Points& x) const;
    int pair_count() const { return static_cast<int>(pairs_.size()); }
    /// Force on the first body (or on the samples) at the positions x, without friction and damping, N.
    Vec3 force_on_first(const Points& x) const;

  private:
    /// The samples of one surface and the triangles of another.
    struct Side {
        std::vector<ContactSample> samples;
        int own = -1;  // index of the surface that has the samples; -1: none
        int other = 0;
        double fraction = 1;  // of the stiffness
    };
    struct Pair {
        const ContactSample* sample;
        std::array<int, 3> corners;
        Vec3 weights;       // of the corners
        Vec3 normal;        // in the triangle's frame
        double stiffness;   // N/m per unit of penalty
        bool of_first;      // the sample belongs to the first body
        Vec3 start;         // xi at the start of the step
        double friction_n;  // mu N at the start of the step
        double damping;     // N s/m, at the start of the step
    };
    struct Slip {
        Vec3 along;
        double apart;
    };

    void find_pairs(const Side& side, bool of_first, double reach_m, const Points& x);
    void add_pair(const Side& side, const ContactSample& sample, bool of_first, int triangle,
                  const Vec3& weights, const Vec3& normal, const Points& x);
    static CarriedFrame frame_of(const Pair& pair, const Points& x);
    static Slip slip_of(const Pair& pair, const Vec3& place);
    static void scatter(const Pair& pair, const CarriedFrame& frame, const Vec3& y, Points& out);

    std::vector<ClosedSurface> surfaces_;
    std::vector<std::vector<int>> nodes_;  // nodes of each surface
    std::vector<Side> sides_;
    ContactMaterial material_;
    SurfaceContactOptions options_;
    std::vector<Pair> pairs_;
};

}  // namespace risorius::contact
