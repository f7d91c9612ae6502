// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/deform_head.h"

#include <cmath>
#include <cstdio>

#include "risorius/core/error.h"
#include "risorius/headmodel/detail/eyes.h"

namespace risorius::headmodel {
namespace {

constexpr double kRigid = 14.0;  ///< mm from the centre of a globe: lids end here
constexpr double kFree = 32.0;   ///< mm; from here on the eye is not felt

double bell(double t) { return t >= 1 ? 0 : std::pow(1 - t, 4) * (4 * t + 1); }

struct Force {
    Handle handle;
    double strength;
};

std::vector<Force> forces_of(const DesignTables& tables, const Identity& identity) {
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

/// Of handles at both sides on a point of the left side or the midline.
Vec3 displacement(const Vec3& p, const std::vector<Force>& forces) {
    Vec3 sum = Vec3::Zero();
    for (const Force& force : forces) {
        const Handle& h = force.handle;
        if (h.kind == Handle::Kind::kLid) continue;
        const bool middle = h.at.x() == 0;
        for (const double side : {1.0, -1.0}) {
            if (middle && side < 0) continue;
            const Vec3 at(side * h.at.x(), h.at.y(), h.at.z());
            const double weight =
                force.strength *
                (std::isinf(h.reach_mm) ? 1.0 : bell((p - at).norm() / h.reach_mm));
            if (weight == 0) continue;
            sum += h.kind == Handle::Kind::kMove
                       ? Vec3(weight * Vec3(side * h.by.x(), h.by.y(), h.by.z()))
                       : Vec3(weight * 0.01 * h.by.cwiseProduct(p - at));
        }
    }
    return sum;
}

class Warp {
  public:
    Warp(const DesignTables& tables, const Identity& identity)
        : forces_(forces_of(tables, identity)), eye_(displacement(globe_.centre, forces_)) {}

    Vec3 globe_shift() const { return eye_; }

    /// `p` on the left side or the midline.
    Vec3 moved(const Vec3& p) const {
        const double t =
            std::clamp(((p - globe_.centre).norm() - kRigid) / (kFree - kRigid), 0.0, 1.0);
        const double freedom = t * t * (3 - 2 * t);
        const Vec3 q = p + eye_ + freedom * (displacement(p, forces_) - eye_);
        return over_globe(p, q);
    }

  private:
    Vec3 over_globe(const Vec3& p, const Vec3& q) const {
        Vec3 by = Vec3::Zero();
        for (const Force& force : forces_)
            if (force.handle.kind == Handle::Kind::kLid)
                by += force.strength * bell((p - force.handle.at).norm() / force.handle.reach_mm) *
                      force.handle.by;
        if (by == Vec3::Zero()) return q;
        const Vec3 centre = globe_.centre + eye_, from = q - centre;
        const double distance = from.norm();
        const double gap = distance - globe_.radius_at(from.z() / distance);
        const Vec3 to = (from + by).normalized();
        return centre + to * (globe_.radius_at(to.z()) + gap);
    }

    Globe globe_;
    std::vector<Force> forces_;
    Vec3 eye_;
};

}  // namespace

HeadModel deform_head(const HeadModel& average, const DesignTables& tables,
                      const Identity& identity) {
    HeadModel model = average;
    geom::PolygonMesh& mesh = model.mesh;
    const Warp warp(tables, identity);
    if (forces_of(tables, identity).empty()) return model;
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
            const Vec3 shift = warp.globe_shift();
            mesh.positions.row(v) += Vec3(eye * shift.x(), shift.y(), shift.z()).transpose();
            continue;
        }
        const double side = p.x() < 0 ? -1 : 1;
        const bool middle = p.x() == 0;
        p.x() = std::abs(p.x());
        Vec3 q = warp.moved(p);
        q.x() = middle ? 0 : side * q.x();
        mesh.positions.row(v) = q.transpose();
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
    for (const MeasureScore& m : measure_head(model, tables, identity.sex))
        if (std::abs(m.deviation) > kLargestDeviation) {
            char found[160];
            std::snprintf(found, sizeof found, "%s of %.1f mm, which is %.1f", m.measure.c_str(),
                          m.length_mm, std::abs(m.deviation));
            throw Error(place, "measures within 2.5 standard deviations of the mean", found);
        }
}

}  // namespace risorius::headmodel
