// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/foreign_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "risorius/core/error.h"

namespace risorius::inverse {

namespace {

constexpr double kSame_m = 1e-4;       // programs round positions
constexpr double kNearby_m = 1e-3;     // of vertices that are known by number or order
constexpr double kShareInOrder = 0.9;  // of vertices that must lie where their number or order says
constexpr long kTried = 500;           // vertices by which a unit is recognised

/// From the file to the head frame, m.
struct Way {
    Mat3 turn;
    Vec3 shift;
    Vec3 operator()(const Vec3& p) const { return turn * p + shift; }
};

/// The ways that files are usually written: in the frame of the rig's mesh or of its head, in several units.
std::vector<Way> usual_ways(const rig::Head& head) {
    const Mat3 axes = head.frame.metres_per_unit * head.frame.rotation;
    const Vec3 shift = head.frame.to_head(Vec3(Vec3::Zero()));
    std::vector<Way> out;
    for (const double unit_m : {1.0, 1e-2, 1e-3, head.frame.metres_per_unit}) {
        out.push_back({unit_m / head.frame.metres_per_unit * axes, shift});
        out.push_back({unit_m * Mat3::Identity(), Vec3::Zero()});
    }
    return out;
}

/// Points by the cell of a grid that they lie in.
class Grid {
  public:
    explicit Grid(const Points& points) : points_(points) {
        for (long v = 0; v < points.rows(); ++v)
            cells_[cell(points.row(v).transpose())].push_back(static_cast<int>(v));
    }
    /// The nearest point within kSame_m, the first one of equals; -1: none.
    int near(const Vec3& p) const {
        const std::array<long, 3> at = cell(p);
        int best = -1;
        double least = kSame_m;
        for (long i = 0; i < 27; ++i) {
            const auto found =
                cells_.find({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
            if (found == cells_.end()) continue;
            for (const int v : found->second) {
                const double apart = (points_.row(v).transpose() - p).norm();
                if (apart > least || (apart == least && best >= 0 && best < v)) continue;
                least = apart;
                best = v;
            }
        }
        return best;
    }

  private:
    static std::array<long, 3> cell(const Vec3& p) {
        return {std::lround(p.x() / kSame_m), std::lround(p.y() / kSame_m),
                std::lround(p.z() / kSame_m)};
    }
    const Points& points_;
    std::map<std::array<long, 3>, std::vector<int>> cells_;
};

Points moved(const Points& points, const Way& way) {
    Points out = points * way.turn.transpose();
    out.rowwise() += way.shift.transpose();
    return out;
}

/// For each vertex of the head, a row of the file's positions; -1: none.
using Rows = std::vector<int>;

/// Rows by number or order, where enough of them lie where they should.
Rows rows_in_order(const io::GltfShapes& shapes, const Points& at, const rig::Head& head) {
    Rows out(static_cast<std::size_t>(head.vertices.rows()), -1);
    if (shapes.vertex.empty() && at.rows() != head.vertices.rows()) return {};
    long here = 0, all = 0;
    for (long row = 0; row < at.rows(); ++row) {
        const long v = shapes.vertex.empty() ? row : shapes.vertex[static_cast<std::size_t>(row)];
        if (v >= head.vertices.rows()) return {};
        ++all;
        if ((at.row(row) - head.vertices.row(v)).norm() > kNearby_m) continue;
        ++here;
        out[static_cast<std::size_t>(v)] = static_cast<int>(row);
    }
    return here >= kShareInOrder * static_cast<double>(all) ? out : Rows{};
}

Rows rows_by_place(const Points& at, const rig::Head& head, long step) {
    const Grid grid(at);
    Rows out(static_cast<std::size_t>(head.vertices.rows()), -1);
    for (long v = 0; v < head.vertices.rows(); v += step)
        out[static_cast<std::size_t>(v)] = grid.near(head.vertices.row(v).transpose());
    return out;
}

long count_of(const Rows& rows) {
    return std::count_if(rows.begin(), rows.end(), [](int row) { return row >= 0; });
}

}  // namespace

ForeignShapes place_foreign_shapes(const io::GltfShapes& shapes, const rig::Head& head,
                                   const std::string& place) {
    const long vertices = head.vertices.rows();
    Rows rows;
    Way way{};
    std::string how;
    for (const Way& one : usual_ways(head)) {
        rows = rows_in_order(shapes, moved(shapes.positions, one), head);
        if (rows.empty()) continue;
        way = one;
        how = shapes.vertex.empty() ? "by order" : "by _VERTEX";
        break;
    }
    if (rows.empty()) {
        const long step = std::max(1L, vertices / kTried);
        long most = 0;
        for (const Way& one : usual_ways(head))
            if (const long count =
                    count_of(rows_by_place(moved(shapes.positions, one), head, step));
                count > most) {
                most = count;
                way = one;
            }
        if (most > 0) rows = rows_by_place(moved(shapes.positions, way), head, 1);
        how = "by position";
    }
    const long found = count_of(rows);
    if (2 * found < vertices)
        throw Error(
            place,
            "the " + std::to_string(vertices) +
                " vertices of the rig's mesh at rest, by _VERTEX, order or position",
            std::to_string(found) + " of them among " + std::to_string(shapes.positions.rows()));
    ForeignShapes out;
    out.how = how + ": " + std::to_string(found) + " of " + std::to_string(vertices) + " vertices";
    for (const int row : rows) out.known.push_back(row >= 0);
    for (const io::MorphTarget& target : shapes.targets) {
        Points delta = Points::Zero(shapes.positions.rows(), 3);
        for (std::size_t i = 0; i < target.vertex.size(); ++i)
            delta.row(target.vertex[i]) =
                (way.turn * target.delta.row(static_cast<long>(i)).transpose()).transpose();
        Points& field = out.fields.emplace_back(Points::Zero(vertices, 3));
        for (long v = 0; v < vertices; ++v)
            if (const int row = rows[static_cast<std::size_t>(v)]; row >= 0)
                field.row(v) = delta.row(row);
    }
    return out;
}

}  // namespace risorius::inverse
