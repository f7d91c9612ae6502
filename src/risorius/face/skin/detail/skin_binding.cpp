#include "risorius/face/skin/detail/skin_binding.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <set>

#include "risorius/geom/closest_point.h"
#include "risorius/geom/polyline.h"

namespace risorius::face {

namespace {

constexpr double kSmallestWeight = 1e-3;

// A row under construction: weights of shell vertices, and the mandible's part.
struct Terms {
    std::vector<std::pair<int, double>> nodes;  // ascending
    double jaw = 0.0;
    Vec3 jaw_point = Vec3::Zero();

    void add(const Terms& other, double scale) {
        std::vector<std::pair<int, double>> merged;
        merged.reserve(nodes.size() + other.nodes.size());
        std::size_t i = 0, j = 0;
        while (i < nodes.size() || j < other.nodes.size()) {
            if (j == other.nodes.size() ||
                (i < nodes.size() && nodes[i].first < other.nodes[j].first)) {
                merged.push_back(nodes[i++]);
            } else if (i == nodes.size() || other.nodes[j].first < nodes[i].first) {
                merged.push_back({other.nodes[j].first, scale * other.nodes[j].second});
                ++j;
            } else {
                merged.push_back({nodes[i].first, nodes[i].second + scale * other.nodes[j].second});
                ++i;
                ++j;
            }
        }
        nodes.swap(merged);
        jaw += scale * other.jaw;
        jaw_point += scale * other.jaw_point;
    }
    // Small weights go; the others grow so that the sum stays.
    void prune() {
        double all = 0, left = 0;
        for (const auto& [node, w] : nodes) all += w;
        std::erase_if(nodes, [](const auto& term) { return term.second < kSmallestWeight; });
        for (const auto& [node, w] : nodes) left += w;
        if (left > 0)
            for (auto& [node, w] : nodes) w *= all / left;
    }
};

// Shortest ways along the edges of a surface; infinite where there is none.
std::vector<double> surface_ways(const std::vector<int>& from,
                                 const std::vector<std::set<int>>& neighbours,
                                 const Points& vertices) {
    std::vector<double> way(neighbours.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>
        open;
    for (int v : from) {
        way[static_cast<std::size_t>(v)] = 0;
        open.push({0.0, v});
    }
    while (!open.empty()) {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > way[static_cast<std::size_t>(v)]) continue;
        for (int w : neighbours[static_cast<std::size_t>(v)]) {
            const double longer = distance + (vertices.row(v) - vertices.row(w)).norm();
            if (longer < way[static_cast<std::size_t>(w)]) {
                way[static_cast<std::size_t>(w)] = longer;
                open.push({longer, w});
            }
        }
    }
    return way;
}

}  // namespace

SkinBinding::SkinBinding(const rig::Head& head, const Jaw& jaw, const Shell& shell) {
    const long count = head.vertices.rows();
    const auto at = [&](int v) { return Vec3(head.vertices.row(v).transpose()); };
    std::vector<Terms> terms(static_cast<std::size_t>(count));

    // Surface graph of skin and lining
    std::vector<std::set<int>> neighbours(static_cast<std::size_t>(count));
    std::vector<char> on_surface(static_cast<std::size_t>(count), 0);
    for (const Triangles* triangles : {&head.skin, &head.lining})
        for (long f = 0; f < triangles->rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = (*triangles)(f, k), b = (*triangles)(f, (k + 1) % 3);
                neighbours[a].insert(b);
                neighbours[b].insert(a);
                on_surface[a] = 1;
            }

    // On the shell: nearest triangle in the two rings around the vertex it collapsed to
    const int shell_count = static_cast<int>(shell.vertex.size());
    std::vector<std::vector<long>> faces_of(static_cast<std::size_t>(shell_count));
    for (long f = 0; f < shell.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) faces_of[shell.triangles(f, k)].push_back(f);
    std::vector<char> on_shell(static_cast<std::size_t>(count), 0);
    for (long v = 0; v < count; ++v) {
        const int home = shell.collapsed_to[v];
        if (home < 0) continue;
        std::set<long> near;
        for (long f : faces_of[home])
            for (int k = 0; k < 3; ++k)
                for (long g : faces_of[shell.triangles(f, k)]) near.insert(g);
        double best_squared = 1e300;
        for (long f : near) {
            const int a = shell.triangles(f, 0), b = shell.triangles(f, 1),
                      c = shell.triangles(f, 2);
            const geom::TrianglePoint foot =
                geom::closest_point_on_triangle(at(static_cast<int>(v)), at(shell.vertex[a]),
                                                at(shell.vertex[b]), at(shell.vertex[c]));
            if (foot.squared_distance >= best_squared) continue;
            best_squared = foot.squared_distance;
            const Vec3& w = foot.barycentric;
            terms[v].nodes = {{a, w[0]}, {b, w[1]}, {c, w[2]}};
        }
        std::sort(terms[v].nodes.begin(), terms[v].nodes.end());
        std::erase_if(terms[v].nodes, [](const auto& term) { return term.second < 1e-9; });
        on_shell[v] = 1;
    }

    // What lies off the shell falls into pieces: the rest of the head, the mouth, the eye sockets, the nostrils
    std::vector<int> piece(static_cast<std::size_t>(count), -1);
    std::vector<Vec3> low, high;
    for (long seed = 0; seed < count; ++seed) {
        if (!on_surface[seed] || on_shell[seed] || piece[seed] >= 0) continue;
        const int id = static_cast<int>(low.size());
        low.push_back(at(static_cast<int>(seed)));
        high.push_back(low.back());
        std::vector<int> open{static_cast<int>(seed)};
        piece[seed] = id;
        while (!open.empty()) {
            const int v = open.back();
            open.pop_back();
            low[id] = low[id].cwiseMin(at(v));
            high[id] = high[id].cwiseMax(at(v));
            for (int w : neighbours[v])
                if (!on_shell[w] && piece[w] < 0) {
                    piece[w] = id;
                    open.push_back(w);
                }
        }
    }
    int outside_piece = -1;
    for (std::size_t id = 0; id < low.size(); ++id)
        if (outside_piece < 0 ||
            (high[id] - low[id]).norm() > (high[outside_piece] - low[outside_piece]).norm())
            outside_piece = static_cast<int>(id);

    // Which of them is held, and by what
    const std::vector<Vec3> lips = lip_line(head);
    const auto near_rim = [&](bool upper) {
        std::vector<int> from;
        for (long v = 0; v < count; ++v)
            if (on_shell[v] && (shell.over_bite_m[shell.collapsed_to[v]] >= 0) == upper &&
                geom::distance_to_polyline(at(static_cast<int>(v)), lips) < head.mm(6))
                from.push_back(static_cast<int>(v));
        return surface_ways(from, neighbours, head.vertices);
    };
    const std::vector<double> way_up = near_rim(true), way_down = near_rim(false);
    std::vector<char> held(static_cast<std::size_t>(count), 0);
    std::vector<double> pull(static_cast<std::size_t>(count),
                             0.0);  // towards terms, beside the neighbours
    for (long v = 0; v < count; ++v) {
        if (!on_surface[v] || on_shell[v]) continue;
        const Vec3 p = at(static_cast<int>(v));
        if (piece[v] == outside_piece) {
            held[v] = p.z() <= head.mm(8) || p.y() <= head.mm(-135) || p.y() >= head.mm(112);
            continue;
        }
        const double from_lips = geom::distance_to_polyline(p, lips);
        if (from_lips > head.mm(30) && p.y() > head.landmark("sn").y()) {
            // Eye sockets: still, but for what lies right behind the lids
            for (const rig::EyeGeometry& eye : head.eyes)
                if ((p - eye.centre).norm() < eye.radius_m + head.mm(12))
                    held[v] = held[v] || p.z() < eye.centre.z() + 0.3 * eye.radius_m;
        } else if (from_lips > head.mm(16) && p.z() < lips[2].z() - head.mm(16)) {
            held[v] = 1;
            terms[v].jaw = 1.0 - geom::smoothstep(-head.mm(8), head.mm(8), jaw.height_over_bite(p));
            terms[v].jaw_point = terms[v].jaw * p;
        } else if (from_lips > head.mm(4) && from_lips < head.mm(40) &&
                   p.y() < head.landmark("sn").y() && p.z() < lips[2].z()) {
            // The lining of lips and cheeks goes with the skin in front of it, or it would come through; that of the upper lip
            // with the upper lip however near the bite it lies, or a dropping jaw would draw it out from behind the lip
            const double up = way_up[static_cast<std::size_t>(v)],
                         down = way_down[static_cast<std::size_t>(v)];
            if (!std::isfinite(up + down)) continue;
            const double side = (down - up) / (down + up + 1e-9);
            int nearest = -1;
            double least = head.mm(16) * head.mm(16);
            for (long w = 0; w < count; ++w) {
                if (!on_shell[w]) continue;
                const double squared = (head.vertices.row(w) - head.vertices.row(v)).squaredNorm();
                if (squared < least && side * shell.over_bite_m[shell.collapsed_to[w]] >= 0) {
                    least = squared;
                    nearest = static_cast<int>(w);
                }
            }
            if (nearest >= 0) {
                pull[v] = geom::smoothstep(0.1, 0.5, std::abs(side));
                terms[v] = terms[nearest];
            }
        }
    }

    // Harmonic extension to what is left
    std::vector<int> unknown(static_cast<std::size_t>(count), -1), free;
    for (long v = 0; v < count; ++v)
        if (on_surface[v] && !on_shell[v] && !held[v]) {
            unknown[v] = static_cast<int>(free.size());
            free.push_back(static_cast<int>(v));
        }
    if (!free.empty()) {
        std::vector<Eigen::Triplet<double>> entries;
        std::vector<int> column_of(static_cast<std::size_t>(shell_count), -1), node_of_column;
        const auto add_columns = [&](const Terms& row) {
            for (const auto& [node, weight] : row.nodes)
                if (column_of[node] < 0) {
                    column_of[node] = static_cast<int>(node_of_column.size());
                    node_of_column.push_back(node);
                }
        };
        for (int v : free) {
            if (pull[v] > 0) add_columns(terms[v]);
            for (int w : neighbours[v])
                if (unknown[w] < 0) add_columns(terms[w]);
        }
        const long columns = static_cast<long>(node_of_column.size());
        Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<long>(free.size()), columns + 4);
        for (std::size_t i = 0; i < free.size(); ++i) {
            const int v = free[i];
            double diagonal = 1e-9;
            const auto add_known = [&](const Terms& row, double weight) {
                diagonal += weight;
                for (const auto& [node, share] : row.nodes)
                    right(static_cast<long>(i), column_of[node]) += weight * share;
                right(static_cast<long>(i), columns) += weight * row.jaw;
                for (int k = 0; k < 3; ++k)
                    right(static_cast<long>(i), columns + 1 + k) += weight * row.jaw_point[k];
            };
            double around = 0;
            for (int w : neighbours[v]) {
                const double weight = 1.0 / std::max(1e-6, (at(v) - at(w)).norm());
                around += weight;
                if (unknown[w] < 0) {
                    add_known(terms[w], weight);
                } else {
                    diagonal += weight;
                    entries.emplace_back(static_cast<int>(i), unknown[w], -weight);
                }
            }
            if (pull[v] > 0) add_known(terms[v], pull[v] * around);
            entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal);
        }
        Eigen::SparseMatrix<double> laplacian(static_cast<long>(free.size()),
                                              static_cast<long>(free.size()));
        laplacian.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(laplacian);
        const Eigen::MatrixXd solution = factor.solve(right);
        for (std::size_t i = 0; i < free.size(); ++i) {
            Terms& row = terms[free[i]];
            row.nodes.clear();
            for (long c = 0; c < columns; ++c)
                if (solution(static_cast<long>(i), c) > 1e-6)
                    row.nodes.push_back({node_of_column[c], solution(static_cast<long>(i), c)});
            std::sort(row.nodes.begin(), row.nodes.end());
            row.jaw = solution(static_cast<long>(i), columns);
            for (int k = 0; k < 3; ++k)
                row.jaw_point[k] = solution(static_cast<long>(i), columns + 1 + k);
            row.prune();
        }
    }

    // Smooth over the mesh until facets of the coarse shell no longer show
    constexpr int kSweeps = 6;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        std::vector<Terms> next = terms;
        for (long v = 0; v < count; ++v) {
            if (!on_shell[v] || neighbours[v].empty()) continue;
            double edge = 0;
            for (int w : neighbours[v]) edge += (at(static_cast<int>(v)) - at(w)).norm();
            edge /= static_cast<double>(neighbours[v].size());
            // A sweep of strength s spreads by edge sqrt(s); aim at a third of the coarse spacing in all.
            const double wanted = 0.33 * shell.spacing_m[v];
            const double strength = std::min(0.8, wanted * wanted / (edge * edge * kSweeps));
            Terms row;
            row.add(terms[v], 1 - strength);
            for (int w : neighbours[v])
                row.add(terms[w], strength / static_cast<double>(neighbours[v].size()));
            row.prune();
            next[v] = row;
        }
        terms.swap(next);
    }

    rows_.resize(static_cast<std::size_t>(count));
    for (long v = 0; v < count; ++v) {
        const Terms& row = terms[head.welded[v]];
        rows_[v].begin = static_cast<int>(column_.size());
        for (const auto& [node, w] : row.nodes) {
            column_.push_back(node);
            weight_.push_back(w);
        }
        rows_[v].end = static_cast<int>(column_.size());
        rows_[v].jaw = row.jaw;
        rows_[v].jaw_point = row.jaw_point;
    }
}

void SkinBinding::apply(const Points& shell_displacement, const Rigid& mandible,
                        Points& vertices) const {
    for (long v = 0; v < vertices.rows(); ++v) {
        const Row& row = rows_[v];
        Vec3 u = Vec3::Zero();
        for (int k = row.begin; k < row.end; ++k)
            u += weight_[k] * shell_displacement.row(column_[k]).transpose();
        if (row.jaw != 0.0)
            u += mandible.linear() * row.jaw_point + row.jaw * mandible.translation() -
                 row.jaw_point;
        vertices.row(v) += u.transpose();
    }
}

Points SkinBinding::pull_back(const Points& by_vertex, long shell_vertices) const {
    Points out = Points::Zero(shell_vertices, 3);
    for (long v = 0; v < by_vertex.rows(); ++v)
        for (int k = rows_[v].begin; k < rows_[v].end; ++k)
            out.row(column_[k]) += weight_[k] * by_vertex.row(v);
    return out;
}

void SkinBinding::follow(int vertex, int like) {
    rows_[vertex] = rows_[like];
    followers_.push_back({vertex, like});
}

std::vector<char> SkinBinding::moving() const {
    std::vector<char> out;
    for (const Row& row : rows_) out.push_back(row.end > row.begin || row.jaw != 0.0);
    return out;
}

}  // namespace risorius::face
