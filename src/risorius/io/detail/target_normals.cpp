// SPDX-License-Identifier: MIT
#include "risorius/io/detail/target_normals.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace risorius::io::detail {

namespace {

// Change of a normal at the usual weight: four degrees are hardly visible; of correctives, whose weights are smaller in most frames, six
constexpr double kNoTurn = 0.07, kNoTurnCompact = 0.08, kNoTurnOfCorrective = 0.105;

// A part is cut in two where at least this share of its corners has normals that rest.
constexpr double kWorthACut = 0.1;

/// The triangles of a part that are chosen, with their corners.
MorphPart some_of(const MorphPart& part, const std::vector<long>& triangles) {
    MorphPart out = part;
    const auto count = static_cast<long>(triangles.size());
    out.triangles = part.triangles(triangles, Eigen::indexing::all);
    if (part.texcoords.rows() == 0) return out;
    out.texcoords.resize(3 * count, 2);
    for (long t = 0; t < count; ++t)
        out.texcoords.middleRows<3>(3 * t) =
            part.texcoords.middleRows<3>(3 * triangles[static_cast<std::size_t>(t)]);
    return out;
}

}  // namespace

Points vertex_normals(const MorphModel& model, const Points& vertices) {
    Points normals = Points::Zero(vertices.rows(), 3);
    const auto shared = [&](long v) {
        return model.stands_for.empty() ? v : model.stands_for[static_cast<std::size_t>(v)];
    };
    for (const MorphPart& part : model.parts)
        for (long f = 0; f < part.triangles.rows(); ++f) {
            const auto corner = [&](int k) -> Vec3 {
                return vertices.row(part.triangles(f, k)).transpose();
            };
            const Vec3 twice_area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
            for (int k = 0; k < 3; ++k)
                normals.row(shared(part.triangles(f, k))) += twice_area.transpose();
        }
    for (long v = 0; v < normals.rows(); ++v)
        if (shared(v) != v) normals.row(v) = normals.row(shared(v));
    normals.bottomRows(model.worn_normals.rows()) = model.worn_normals;
    for (long v = 0; v < normals.rows(); ++v) {
        const double length = normals.row(v).norm();
        if (length > 1e-20)
            normals.row(v) /= length;
        else
            normals.row(v) = Vec3::UnitZ().transpose();
    }
    return normals;
}

TargetFields::TargetFields(const MorphModel& model, const MorphTarget& target,
                           const Points& normals) {
    delta = Points::Zero(model.vertices.rows(), 3);
    for (std::size_t i = 0; i < target.vertex.size(); ++i)
        delta.row(target.vertex[i]) = target.delta.row(static_cast<long>(i));
    turn = vertex_normals(model, model.vertices + delta) - normals;
    const double least = !model.whole_numbers       ? kNoTurn
                         : target.usual_weight == 1 ? kNoTurnCompact
                                                    : kNoTurnOfCorrective;
    for (long v = 0; v < turn.rows(); ++v)
        if (target.usual_weight * turn.row(v).norm() < least) turn.row(v).setZero();
}

std::vector<TurningPart> parts_by_turn(const MorphModel& model, const Points& normals) {
    std::vector<char> turned(static_cast<std::size_t>(model.vertices.rows()), 0);
    for (const MorphTarget& target : model.targets) {
        const TargetFields fields(model, target, normals);
        for (long v = 0; v < fields.turn.rows(); ++v)
            if (!fields.turn.row(v).isZero(0.0)) turned[static_cast<std::size_t>(v)] = 1;
    }
    std::vector<TurningPart> out;
    for (const MorphPart& part : model.parts) {
        if (!part.normals_turn) {
            out.push_back({part, false});
            continue;
        }
        std::vector<long> turning, still;
        for (long t = 0; t < part.triangles.rows(); ++t) {
            bool turns = false;
            for (int k = 0; k < 3; ++k)
                turns = turns || turned[static_cast<std::size_t>(part.triangles(t, k))];
            (turns ? turning : still).push_back(t);
        }
        const bool cut = !turning.empty() &&
                         static_cast<double>(still.size()) >=
                             kWorthACut * static_cast<double>(part.triangles.rows()) &&
                         !still.empty();
        if (!cut) {
            out.push_back({part, !turning.empty()});
            continue;
        }
        out.push_back({some_of(part, turning), true});
        out.push_back({some_of(part, still), false});
    }
    return out;
}

}  // namespace risorius::io::detail
