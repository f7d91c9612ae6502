// SPDX-License-Identifier: MIT
/// \file
/// The middle lines of locks: where they grow, and how they lie over the head.
#pragma once

#include <vector>

#include "risorius/core/counter_rng.h"
#include "risorius/render/detail/head_radius.h"
#include "risorius/render/detail/lock_style.h"
#include "risorius/render/detail/skin_plan.h"

namespace risorius::render {

/// The middle line of a lock at rest.
struct LockGuide {
    SkinPlace root;
    std::vector<Vec3> points, out;  ///< m; unit vectors away from the head
    double layer = 0;               ///< 0 innermost .. 1 outermost
    double width = 1;               ///< factor of the style's
    double grey = 0;                ///< added share of white hairs
    int segments = 4;
    bool edge = false;    ///< grows at the hairline
    bool single = false;  ///< one of the single hairs at the hairline
    bool hangs = false;   ///< some of it is far from the head
    bool tail = false;    ///< hangs from the knot
    double fray = 1;      ///< factor of the length of the strands in which it ends
    bool fringe = false;  ///< of the front, over the forehead
};

/// The head of a scene with a style: where its hair grows, and the hull that it lies on.
class LockGround {
  public:
    /// `style` and `plan` must outlive this object.
    LockGround(const Scene& scene, const SkinPlan& plan, const Vec3& centre,
               const LockStyle& style);

    /// Whether hair grows on the skin in a direction from the centre, at least so far from its border, m.
    bool grows(const Vec3& direction, double inside_m) const;
    /// Whether hanging hair that grows there would hang in front of the ear, alone
    bool before_ear(const Vec3& direction) const;
    /// Thickness of the cap, m; it falls to 0 towards the border.
    double cap_m(const Vec3& direction) const;
    /// The way of the hair in the skin at a point, a unit vector.
    Vec3 flow(const Vec3& at) const;
    std::vector<LockGuide> guides(unsigned seed) const;

    const HeadRadius& head() const { return head_; }
    const Vec3& whorl() const { return whorl_; }  ///< unit vector from the centre
    double parting_m() const { return parting_m_; }

  private:
    double length_m(const Vec3& direction) const;
    /// Of the waves of combed hair that grows there, in turns
    double wave_phase(const Vec3& direction) const;
    /// Whether the hair that grows there is combed over the forehead.
    bool in_fringe(const Vec3& direction) const;
    /// Distance from the centre to the skin that hair lies on, or 0 where it lies on none
    double skin_m(const Vec3& direction) const;
    LockGuide guide(const Vec3& direction, RandomSequence& random, double longest_m) const;
    /// Adds short single hairs that break the border.
    void add_hairline(RandomSequence& random, std::vector<LockGuide>& guides) const;
    /// Adds locks that cover the forehead closely.
    void add_fringe(RandomSequence& random, std::vector<LockGuide>& guides) const;
    void add_tail(RandomSequence& random, std::vector<LockGuide>& guides) const;
    void finish(std::vector<Vec3> way, const Vec3& across, double phase, LockGuide& guide) const;

    const LockStyle& style_;
    const SkinPlan& plan_;
    HeadRadius head_;
    Vec3 whorl_, knot_;
    double parting_m_, tips_m_;
    double fringe_m_ = 0;  ///< height of the tips over the forehead
};

}  // namespace risorius::render
