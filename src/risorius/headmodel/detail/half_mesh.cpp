// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/half_mesh.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace risorius::headmodel {

const std::vector<std::string>& region_names() {
    static const std::vector<std::string> names{
        "scalp",   "forehead", "temple",           "brow", "orbit", "lid", "nose", "wing",
        "nostril", "cheek",    "skin_round_mouth", "lips", "chin",  "jaw", "ear",  "nape",
        "neck",    "shoulder", "mouth_lining"};
    return names;
}

int HalfMesh::add(const Vec3& p, Hold how, bool on_midline) {
    point.push_back(p);
    if (on_midline) point.back().x() = 0;
    hold.push_back(how);
    midline.push_back(on_midline);
    return static_cast<int>(point.size()) - 1;
}

void HalfMesh::quad(int a, int b, int c, int d, int in_group) {
    face.push_back({a, b, c, d});
    group.push_back(in_group);
    region.push_back(in_group == 1 ? Region::kLining : adding);
}

void HalfMesh::bridge(const std::vector<int>& outer, const std::vector<int>& inner, bool closed,
                      int in_group) {
    const std::size_t n = outer.size();
    for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
        const std::size_t next = (k + 1) % n;
        quad(outer[k], outer[next], inner[next], inner[k], in_group);
    }
}

void HalfMesh::fill(const std::vector<int>& loop, int rows, int columns, Hold how, int in_group) {
    std::vector<std::vector<int>> id(static_cast<std::size_t>(rows) + 1,
                                     std::vector<int>(static_cast<std::size_t>(columns) + 1, -1));
    const auto at = [&](int place) { return loop[static_cast<std::size_t>(place) % loop.size()]; };
    for (int r = 0; r <= rows; ++r) {
        id[r][0] = at(r);
        id[r][columns] = at(2 * rows + columns - r);
    }
    for (int c = 0; c <= columns; ++c) {
        id[rows][c] = at(rows + c);
        id[0][c] = at(2 * rows + 2 * columns - c);
    }
    for (int r = 1; r < rows; ++r)
        for (int c = 1; c < columns; ++c) {
            const double u = static_cast<double>(c) / columns, v = static_cast<double>(r) / rows;
            const auto p = [&](int row, int column) {
                return point[static_cast<std::size_t>(id[row][column])];
            };
            const Vec3 coons = (1 - u) * p(r, 0) + u * p(r, columns) + (1 - v) * p(0, c) +
                               v * p(rows, c) - (1 - u) * (1 - v) * p(0, 0) -
                               u * (1 - v) * p(0, columns) - (1 - u) * v * p(rows, 0) -
                               u * v * p(rows, columns);
            id[r][c] = add(coons, how);
        }
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            quad(id[r][c], id[r + 1][c], id[r + 1][c + 1], id[r][c + 1], in_group);
}

std::vector<std::vector<int>> HalfMesh::neighbours() const {
    std::vector<std::set<int>> sets(point.size());
    for (const auto& f : face) {
        for (int k = 0; k < 4; ++k) {
            sets[static_cast<std::size_t>(f[k])].insert(f[(k + 1) % 4]);
            sets[static_cast<std::size_t>(f[(k + 1) % 4])].insert(f[k]);
        }
    }
    std::vector<std::vector<int>> lists;
    for (const auto& s : sets) lists.emplace_back(s.begin(), s.end());
    return lists;
}

std::vector<Vec3> HalfMesh::normals() const {
    std::vector<Vec3> sum(point.size(), Vec3::Zero());
    for (const auto& f : face)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto at = [&](std::size_t i) {
                return point[static_cast<std::size_t>(f[i % 4])];
            };
            sum[static_cast<std::size_t>(f[k])] += (at(k + 1) - at(k)).cross(at(k + 3) - at(k));
        }
    for (std::size_t v = 0; v < sum.size(); ++v) {
        if (midline[v]) sum[v].x() = 0;
        sum[v].normalize();
    }
    return sum;
}

void HalfMesh::relax(int iterations, double rate, const std::function<Vec3(const Vec3&)>& project,
                     Hold which) {
    const auto around = neighbours();
    std::vector<Vec3> moved = point;
    for (int iteration = 0; iteration < iterations; ++iteration) {
        for (std::size_t v = 0; v < point.size(); ++v) {
            if (hold[v] != which) continue;
            Vec3 sum = Vec3::Zero();
            double weight = 0;
            for (const int n : around[v]) {
                Vec3 p = point[static_cast<std::size_t>(n)];
                double w = 1;
                if (midline[v] && !midline[static_cast<std::size_t>(n)]) {
                    p.x() = 0;
                    w = 2;
                }
                sum += w * p;
                weight += w;
            }
            Vec3 p = point[v] + rate * (sum / weight - point[v]);
            if (project) p = project(p);
            if (midline[v]) p.x() = 0;
            moved[v] = p;
        }
        point = moved;
    }
}

void HalfMesh::smooth(int iterations, const std::vector<double>& fraction) {
    constexpr double kShrink = 0.5, kGrow = -0.53;
    const auto around = neighbours();
    std::vector<Vec3> moved = point;
    for (int step = 0; step < 2 * iterations; ++step) {
        const double rate = step % 2 == 0 ? kShrink : kGrow;
        for (std::size_t v = 0; v < point.size(); ++v) {
            if (fraction[v] <= 0) continue;
            Vec3 sum = Vec3::Zero();
            double weight = 0;
            for (const int n : around[v]) {
                const Vec3& p = point[static_cast<std::size_t>(n)];
                const double w = midline[v] && !midline[static_cast<std::size_t>(n)] ? 2 : 1;
                sum += w * p;
                weight += w;
            }
            moved[v] = point[v] + fraction[v] * rate * (sum / weight - point[v]);
            if (midline[v]) moved[v].x() = 0;
        }
        point = moved;
    }
}

std::vector<Vec3> curve_points(const std::vector<std::pair<double, Vec3>>& through, int count,
                               bool closed) {
    std::vector<Vec3> out;
    const int n = static_cast<int>(through.size());
    const auto knot = [&](int i) -> std::pair<double, Vec3> {
        if (closed) {
            const int turns = i < 0 ? -1 : i / n;
            const auto& base = through[static_cast<std::size_t>(i - turns * n)];
            return {base.first + turns * count, base.second};
        }
        if (i < 0) {
            return {2 * through[0].first - through[1].first,
                    2 * through[0].second - through[1].second};
        }
        if (i >= n) {
            const auto &a = through[static_cast<std::size_t>(n - 1)],
                       &b = through[static_cast<std::size_t>(n - 2)];
            return {2 * a.first - b.first, 2 * a.second - b.second};
        }
        return through[static_cast<std::size_t>(i)];
    };
    for (int k = 0; k < count + (closed ? 0 : 1); ++k) {
        int i = closed ? -1 : 0;
        while (i + 1 < (closed ? n : n - 1) && knot(i + 1).first <= k) ++i;
        if (!closed) i = std::min(i, n - 2);
        // Cubic Hermite with the slopes of the non-uniform Catmull-Rom curve.
        const auto a = knot(i - 1), b = knot(i), c = knot(i + 1), d = knot(i + 2);
        const double h = c.first - b.first, t = (k - b.first) / h;
        const auto slope = [](const std::pair<double, Vec3>& l, const std::pair<double, Vec3>& m,
                              const std::pair<double, Vec3>& r) -> Vec3 {
            const double hl = m.first - l.first, hr = r.first - m.first;
            return ((m.second - l.second) / hl * hr + (r.second - m.second) / hr * hl) / (hl + hr);
        };
        const Vec3 mb = slope(a, b, c), mc = slope(b, c, d);
        const double t2 = t * t, t3 = t2 * t;
        out.push_back((2 * t3 - 3 * t2 + 1) * b.second + (t3 - 2 * t2 + t) * h * mb +
                      (3 * t2 - 2 * t3) * c.second + (t3 - t2) * h * mc);
    }
    return out;
}

std::vector<int> mirror_map(const HalfMesh& half) {
    const int n = static_cast<int>(half.point.size());
    std::vector<int> other(static_cast<std::size_t>(n));
    int next = n;
    for (int v = 0; v < n; ++v)
        other[static_cast<std::size_t>(v)] = half.midline[static_cast<std::size_t>(v)] ? v : next++;
    return other;
}

geom::PolygonMesh mirrored(const HalfMesh& half) {
    const std::vector<int> other = mirror_map(half);
    const int n = static_cast<int>(half.point.size());
    const int total = std::max(n, 1 + *std::max_element(other.begin(), other.end()));
    geom::PolygonMesh mesh;
    mesh.positions.resize(total, 3);
    for (int v = 0; v < n; ++v) {
        const Vec3& p = half.point[static_cast<std::size_t>(v)];
        mesh.positions.row(v) = p.transpose();
        if (other[static_cast<std::size_t>(v)] != v)
            mesh.positions.row(other[static_cast<std::size_t>(v)]) =
                Vec3(-p.x(), p.y(), p.z()).transpose();
    }
    mesh.group_names = {"skin", "mouth"};
    const auto append = [&](const std::array<int, 4>& f, int group, bool mirror) {
        for (int k = 0; k < 4; ++k) {
            const int v = f[mirror ? 3 - k : k];
            mesh.corner_vertex.push_back(mirror ? other[static_cast<std::size_t>(v)] : v);
        }
        mesh.face_begin.push_back(static_cast<int>(mesh.corner_vertex.size()));
        mesh.face_group.push_back(group);
    };
    for (const bool mirror : {false, true})
        for (std::size_t f = 0; f < half.face.size(); ++f)
            append(half.face[f], half.group[f], mirror);
    return mesh;
}

}  // namespace risorius::headmodel
