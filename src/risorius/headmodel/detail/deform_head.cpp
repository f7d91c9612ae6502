// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/deform_head.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "risorius/core/error.h"
#include "risorius/headmodel/detail/eyes.h"
#include "risorius/headmodel/detail/population.h"
#include "risorius/headmodel/detail/skin_steps.h"

namespace risorius::headmodel {
namespace {

constexpr double kRigid = 14.0;  ///< mm from the centre of a globe: lids end here
constexpr double kFree = 32.0;   ///< mm; from here on the eye is not felt

double bell(double t) { return t >= 1 ? 0 : std::pow(1 - t, 4) * (4 * t + 1); }

struct Force {
    Handle handle;
    double strength;
};

/// `strength`, less the more it would bend the skin: the displacement of a handle changes by kSteepest of its way at most. Rare
/// values of local parameters would leave dents and lumps. Half of the limit is kept to 0.1 %.
double without_dents(const Handle& handle, double strength) {
    constexpr double kSteepest = 0.6, kBellSlope = 2.1;  // the bell's largest slope is 2.1 / reach
    if (std::isinf(handle.reach_mm) || handle.kind == Handle::Kind::kScale) return strength;
    const double slope = kBellSlope * std::abs(strength) * handle.by.norm() / handle.reach_mm;
    return strength / std::pow(1 + std::pow(slope / kSteepest, 8), 1.0 / 8);
}

/// Of persons of the population: what is usual at their sex, age and ancestry, and what is their own.
std::vector<Force> forces_of_person(const DesignTables& tables, const Identity& identity) {
    std::vector<Force> forces;
    const auto strengths = person_shape(identity, tables);
    for (const Handle& handle : tables.population_handles) {
        const double age = (identity.age - 40.0) / 40.0;
        const double strength = handle.parameter == "sex"   ? identity.sex
                                : handle.parameter == "age" ? age
                                : handle.parameter == kFoldsOfAge
                                    ? std::max(0.0, identity.age - 30) / 40
                                    : without_dents(handle, strengths.at(handle.parameter));
        if (strength != 0) forces.push_back({handle, strength});
    }
    return forces;
}

std::vector<Force> forces_of(const DesignTables& tables, const Identity& identity) {
    if (identity.model == Model::kPopulation) return forces_of_person(tables, identity);
    std::vector<Force> forces;
    for (const Handle& handle : tables.handles) {
        double strength = 0;
        if (handle.parameter == "sex")
            strength = identity.sex;
        else if (handle.parameter == "age")
            strength = (identity.age - 40.0) / 40.0;
        else if (const auto found = identity.shape.find(handle.parameter);
                 found != identity.shape.end())
            strength = found->second;
        if (strength != 0) forces.push_back({handle, strength});
    }
    return forces;
}

bool along_globe(const Handle& handle) {
    return handle.kind == Handle::Kind::kLid || handle.kind == Handle::Kind::kLeanLid;
}

bool in_front_of_globe(const Handle& handle) {
    return handle.kind == Handle::Kind::kNear || handle.kind == Handle::Kind::kCorner;
}

bool leans(const Handle& handle) {
    return handle.kind == Handle::Kind::kLean || handle.kind == Handle::Kind::kLeanLid;
}

/// Of handles at both sides on a point of the left side or the midline. `half`: 1; -1 for the mirror image of the right side.
Vec3 displacement(const Vec3& p, const std::vector<Force>& forces, double half) {
    Vec3 sum = Vec3::Zero();
    for (const Force& force : forces) {
        const Handle& h = force.handle;
        if (along_globe(h) || in_front_of_globe(h)) continue;
        const bool middle = h.at.x() == 0;
        for (const double side : {1.0, -1.0}) {
            if (middle && side < 0) continue;
            const Vec3 at(side * h.at.x(), h.at.y(), h.at.z());
            const double weight =
                force.strength *
                (std::isinf(h.reach_mm) ? 1.0 : bell((p - at).norm() / h.reach_mm));
            if (weight == 0) continue;
            if (h.kind == Handle::Kind::kScale)
                sum += Vec3(weight * 0.01 * h.by.cwiseProduct(p - at));
            else if (h.kind == Handle::Kind::kLean)
                sum += middle
                           ? Vec3(weight * half * h.by.x(), weight * h.by.y(), weight * h.by.z())
                           : Vec3(side * half * weight * Vec3(side * h.by.x(), h.by.y(), h.by.z()));
            else
                sum += Vec3(weight * Vec3(side * h.by.x(), h.by.y(), h.by.z()));
        }
    }
    return sum;
}

class Warp {
  public:
    Warp(const std::vector<Force>& forces, double half)
        : forces_(forces), half_(half), eye_(displacement(globe_.centre, forces_, half)) {}

    Vec3 globe_shift() const { return eye_; }

    /// `p` on the left side or the midline.
    Vec3 moved(const Vec3& p) const {
        const double t =
            std::clamp(((p - globe_.centre).norm() - kRigid) / (kFree - kRigid), 0.0, 1.0);
        const double freedom = t * t * (3 - 2 * t);
        const Vec3 q = p + eye_ + freedom * (displacement(p, forces_, half_) - eye_);
        return over_globe(p, q);
    }

  private:
    Vec3 over_globe(const Vec3& p, const Vec3& q) const {
        constexpr double kEdge = 1.2, kOpen = 4.5;  // mm from the globe: edge of the lid, free skin
        const double t = std::clamp((gap_of(p - globe_.centre) - kEdge) / (kOpen - kEdge), 0., 1.);
        Vec3 by = Vec3::Zero(), front = Vec3::Zero();
        for (const Force& force : forces_) {
            const Handle& h = force.handle;
            if (!along_globe(h) && !in_front_of_globe(h)) continue;
            const double weight =
                force.strength * (leans(h) ? half_ : 1.0) * bell((p - h.at).norm() / h.reach_mm);
            if (along_globe(h))
                by += weight * h.by;
            else
                front += weight * (h.kind == Handle::Kind::kNear ? t * t * (3 - 2 * t) : 1) * h.by;
        }
        return kept_clear(p, slid(q, by), front);
    }

    double gap_of(const Vec3& from) const {
        const double distance = from.norm();
        return distance - globe_.radius_at(from.z() / distance);
    }

    Vec3 slid(const Vec3& q, const Vec3& by) const {
        if (by == Vec3::Zero()) return q;
        const Vec3 centre = globe_.centre + eye_, from = q - centre;
        const double distance = from.norm();
        const double gap = distance - globe_.radius_at(from.z() / distance);
        const Vec3 to = (from + by).normalized();
        return centre + to * (globe_.radius_at(to.z()) + gap);
    }

    /// Nothing comes nearer to the globe than kLeast of its gap.
    Vec3 kept_clear(const Vec3& p, const Vec3& q, const Vec3& by) const {
        if (by == Vec3::Zero()) return q;
        constexpr double kLeast = 0.6;
        const Vec3 from = q + by - (globe_.centre + eye_);
        const double least = kLeast * std::max(gap_of(p - globe_.centre), 0.0);
        return q + by + from * (std::max(0.0, least - gap_of(from)) / from.norm());
    }

    Globe globe_;
    std::vector<Force> forces_;
    double half_;
    Vec3 eye_;
};

/// Moves `mesh`, which has the form of the average head.
void move_by(const std::vector<Force>& forces, geom::PolygonMesh& mesh) {
    const Warp left(forces, 1), right(forces, -1);
    const bool uneven =
        std::any_of(forces.begin(), forces.end(), [](const Force& f) { return leans(f.handle); });
    std::vector<double> globe(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
    for (int f = 0; f < mesh.face_count(); ++f) {
        const std::string& group = mesh.group_names[static_cast<std::size_t>(mesh.face_group[f])];
        const double side = group == "eye_l" ? 1 : group == "eye_r" ? -1 : 0;
        if (side != 0)
            for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
                globe[static_cast<std::size_t>(mesh.corner_vertex[c])] = side;
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        Vec3 p = mesh.positions.row(v).transpose();
        const double eye = globe[static_cast<std::size_t>(v)];
        if (eye != 0) {
            const Vec3 shift = (eye < 0 ? right : left).globe_shift();
            mesh.positions.row(v) += Vec3(eye * shift.x(), shift.y(), shift.z()).transpose();
            continue;
        }
        const double side = p.x() < 0 ? -1 : 1;
        const bool middle = p.x() == 0;
        p.x() = std::abs(p.x());
        Vec3 q = (side < 0 ? right : left).moved(p);
        q.x() = middle && !uneven ? 0 : side * q.x();
        mesh.positions.row(v) = q.transpose();
    }
}

/// What is usual at a sex and an age, without what is a person's own
std::vector<Force> usual_of(const std::vector<Force>& forces) {
    std::vector<Force> usual;
    for (const Force& force : forces) {
        const std::string& parameter = force.handle.parameter;
        if (parameter == "sex" || parameter == "age" || parameter == kFoldsOfAge)
            usual.push_back(force);
    }
    return usual;
}

}  // namespace

HeadModel deform_head(const HeadModel& average, const DesignTables& tables,
                      const Identity& identity) {
    HeadModel model = average;
    const std::vector<Force> forces = forces_of(tables, identity);
    if (forces.empty()) return model;
    move_by(forces, model.mesh);
    if (identity.model == Model::kPopulation) {
        // Folds and jowls of the years are steps on purpose.
        geom::PolygonMesh usual = average.mesh;
        move_by(usual_of(forces), usual);
        ease_steps(usual, model.mesh);
    }
    return model;
}

HeadModel deform_within_spread(const HeadModel& average, const DesignTables& tables,
                               Identity& identity) {
    constexpr int kSteps = 20;
    const Identity wanted = identity;
    for (int step = 0;; ++step) {
        HeadModel model = deform_head(average, tables, identity);
        bool within = true;
        if (identity.model == Model::kPopulation)
            within = !runs_through_itself(model);
        else
            for (const MeasureScore& m : measure_head(model, tables, identity.sex))
                within = within && std::abs(m.deviation) <= kLargestDeviation;
        if (within || step == kSteps) return model;
        const double fraction = 1.0 - static_cast<double>(step + 1) / kSteps;
        for (auto& [parameter, value] : identity.shape)
            value = std::round(100 * fraction * wanted.shape.at(parameter)) / 100 + 0.0;
    }
}

void check_spread(const HeadModel& model, const DesignTables& tables, const Identity& identity,
                  const std::string& place) {
    if (identity.model == Model::kPopulation) return;
    for (const MeasureScore& m : measure_head(model, tables, identity.sex))
        if (std::abs(m.deviation) > kLargestDeviation) {
            char found[160];
            std::snprintf(found, sizeof found, "%s of %.1f mm, which is %.1f", m.measure.c_str(),
                          m.length_mm, std::abs(m.deviation));
            throw Error(place, "measures within 2.5 standard deviations of the mean", found);
        }
}

}  // namespace risorius::headmodel
