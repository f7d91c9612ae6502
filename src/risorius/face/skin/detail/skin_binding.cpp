// SPDX-License-Identifier: MIT
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

// A row under construction: weights of shell vertices, and the weight of the mandible.
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
    // Drops small weights and scales the others so that the sum stays the same.
    void prune() {
        double all = 0, left = 0;
        for (const auto& [node, w] : nodes) all += w;
        std::erase_if(nodes, [](const auto& term) { return term.second < kSmallestWeight; });
        for (const auto& [node, w] : nodes) left += w;
        if (left > 0)
            for (auto& [node, w] : nodes) w *= all / left;
    }
};

// Length of the shortest way from a set of vertices to every vertex, along the edges of a surface, m; infinite where there is none.
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

// Builds the rows of all vertices, step by step in the order of the public functions.
class BindingRows {
  public:
    BindingRows(const rig::Head& head, const Jaw& jaw, const Shell& shell);

    void bind_shell_vertices();
    void choose_held_vertices();
    void extend_harmonically();
    void smooth_over_mesh();

    const std::vector<Terms>& rows() const { return terms_; }

  private:
    Vec3 at(long v) const { return head_.vertices.row(v).transpose(); }
    int find_outside_piece();
    std::vector<double> ways_from_rim(bool upper) const;
    bool is_behind_lids(const Vec3& p) const;
    void hold_on_bone(long v);
    void pull_towards_skin(long v, double from_upper_rim_m, double from_lower_rim_m);
    std::vector<int> number_unknowns();
    void number_columns(const std::vector<int>& free);
    void write_solution(const Eigen::MatrixXd& solution, const std::vector<int>& free);

    const rig::Head& head_;
    const Jaw& jaw_;
    const Shell& shell_;
    long count_;                             // V
    std::vector<Vec3> lips_;                 // the line of the lips
    std::vector<Terms> terms_;               // V
    std::vector<std::set<int>> neighbours_;  // V, over edges of skin and lining
    std::vector<char> on_surface_, on_shell_, held_;
    std::vector<int> piece_;      // V, connected piece of what lies off the shell; -1: on it
    std::vector<double> pull_;    // V, weight of a vertex's own terms, in sums of its edge weights
    std::vector<int> unknown_;    // V, row in the system of equations; -1: known
    std::vector<int> column_of_;  // of each shell vertex in the right side; -1: not used
    std::vector<int> column_node_;  // shell vertex of each column
};

BindingRows::BindingRows(const rig::Head& head, const Jaw& jaw, const Shell& shell)
    : head_(head),
      jaw_(jaw),
      shell_(shell),
      count_(head.vertices.rows()),
      lips_(lip_line(head)),
      terms_(static_cast<std::size_t>(count_)),
      neighbours_(static_cast<std::size_t>(count_)),
      on_surface_(static_cast<std::size_t>(count_), 0),
      on_shell_(static_cast<std::size_t>(count_), 0),
      held_(static_cast<std::size_t>(count_), 0),
      piece_(static_cast<std::size_t>(count_), -1),
      pull_(static_cast<std::size_t>(count_), 0.0) {
    for (const Triangles* triangles : {&head.skin, &head.lining})
        for (long f = 0; f < triangles->rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const int a = (*triangles)(f, k), b = (*triangles)(f, (k + 1) % 3);
                neighbours_[a].insert(b);
                neighbours_[b].insert(a);
                on_surface_[a] = 1;
            }
}

// A vertex on the shell is bound to the nearest triangle in the two rings around the shell vertex it collapsed to.
void BindingRows::bind_shell_vertices() {
    std::vector<std::vector<long>> faces_of(shell_.vertex.size());
    for (long f = 0; f < shell_.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) faces_of[shell_.triangles(f, k)].push_back(f);
    for (long v = 0; v < count_; ++v) {
        const int home = shell_.collapsed_to[v];
        if (home < 0) continue;
        std::set<long> near;
        for (long f : faces_of[home])
            for (int k = 0; k < 3; ++k)
                for (long g : faces_of[shell_.triangles(f, k)]) near.insert(g);
        double best_squared = 1e300;
        for (long f : near) {
            const int a = shell_.triangles(f, 0), b = shell_.triangles(f, 1),
                      c = shell_.triangles(f, 2);
            const geom::TrianglePoint foot = geom::closest_point_on_triangle(
                at(v), at(shell_.vertex[a]), at(shell_.vertex[b]), at(shell_.vertex[c]));
            if (foot.squared_distance >= best_squared) continue;
            best_squared = foot.squared_distance;
            const Vec3& w = foot.barycentric;
            terms_[v].nodes = {{a, w[0]}, {b, w[1]}, {c, w[2]}};
        }
        std::sort(terms_[v].nodes.begin(), terms_[v].nodes.end());
        std::erase_if(terms_[v].nodes, [](const auto& term) { return term.second < 1e-9; });
        on_shell_[v] = 1;
    }
}

// What lies off the shell falls into connected pieces: the rest of the head, the mouth, the eye sockets, the nostrils.
// Returns the piece with the largest bounding box, which is the rest of the head.
int BindingRows::find_outside_piece() {
    std::vector<Vec3> low, high;
    for (long seed = 0; seed < count_; ++seed) {
        if (!on_surface_[seed] || on_shell_[seed] || piece_[seed] >= 0) continue;
        const int id = static_cast<int>(low.size());
        low.push_back(at(seed));
        high.push_back(low.back());
        std::vector<int> open{static_cast<int>(seed)};
        piece_[seed] = id;
        while (!open.empty()) {
            const int v = open.back();
            open.pop_back();
            low[id] = low[id].cwiseMin(at(v));
            high[id] = high[id].cwiseMax(at(v));
            for (int w : neighbours_[v])
                if (!on_shell_[w] && piece_[w] < 0) {
                    piece_[w] = id;
                    open.push_back(w);
                }
        }
    }
    int outside = -1;
    for (std::size_t id = 0; id < low.size(); ++id)
        if (outside < 0 || (high[id] - low[id]).norm() > (high[outside] - low[outside]).norm())
            outside = static_cast<int>(id);
    return outside;
}

// Distance of each vertex from the rim of one lip along the surface, m.
std::vector<double> BindingRows::ways_from_rim(bool upper) const {
    std::vector<int> from;
    for (long v = 0; v < count_; ++v)
        if (on_shell_[v] && (shell_.over_bite_m[shell_.collapsed_to[v]] >= 0) == upper &&
            geom::distance_to_polyline(at(v), lips_) < head_.mm(6))
            from.push_back(static_cast<int>(v));
    return surface_ways(from, neighbours_, head_.vertices);
}

// Which vertices off the shell do not move by themselves, and what holds them.
void BindingRows::choose_held_vertices() {
    const int outside = find_outside_piece();
    const std::vector<double> from_upper = ways_from_rim(true), from_lower = ways_from_rim(false);
    for (long v = 0; v < count_; ++v) {
        if (!on_surface_[v] || on_shell_[v]) continue;
        const Vec3 p = at(v);
        if (piece_[v] == outside) {
            held_[v] = p.z() <= head_.mm(8) || p.y() <= head_.mm(-135) || p.y() >= head_.mm(112);
            continue;
        }
        const double from_lips = geom::distance_to_polyline(p, lips_);
        if (from_lips > head_.mm(30) && p.y() > head_.landmark("sn").y())
            held_[v] = is_behind_lids(p);
        else if (from_lips > head_.mm(16) && p.z() < lips_[2].z() - head_.mm(16))
            hold_on_bone(v);
        else if (from_lips > head_.mm(4) && from_lips < head_.mm(40) &&
                 p.y() < head_.landmark("sn").y() && p.z() < lips_[2].z())
            pull_towards_skin(v, from_upper[static_cast<std::size_t>(v)],
                              from_lower[static_cast<std::size_t>(v)]);
    }
}

// Eye sockets are still, except for what lies right behind the lids.
bool BindingRows::is_behind_lids(const Vec3& p) const {
    for (const rig::EyeGeometry& eye : head_.eyes)
        if ((p - eye.centre).norm() < eye.radius_m + head_.mm(12) &&
            p.z() < eye.centre.z() + 0.3 * eye.radius_m)
            return true;
    return false;
}

// The back of the mouth is held by skull and mandible.
void BindingRows::hold_on_bone(long v) {
    const Vec3 p = at(v);
    held_[v] = 1;
    terms_[v].jaw = 1.0 - geom::smoothstep(-head_.mm(8), head_.mm(8), jaw_.height_over_bite(p));
    terms_[v].jaw_point = terms_[v].jaw * p;
}

// The lining of lips and cheeks goes with the skin in front of it, or it would come through. The lining of the upper lip goes with the
// upper lip however near the bite it lies, or a dropping jaw would draw it out from behind the lip.
void BindingRows::pull_towards_skin(long v, double from_upper_rim_m, double from_lower_rim_m) {
    if (!std::isfinite(from_upper_rim_m + from_lower_rim_m)) return;
    const double side =
        (from_lower_rim_m - from_upper_rim_m) / (from_lower_rim_m + from_upper_rim_m + 1e-9);
    int nearest = -1;
    double min_squared = head_.mm(16) * head_.mm(16);
    for (long w = 0; w < count_; ++w) {
        if (!on_shell_[w]) continue;
        const double squared = (head_.vertices.row(w) - head_.vertices.row(v)).squaredNorm();
        if (squared < min_squared && side * shell_.over_bite_m[shell_.collapsed_to[w]] >= 0) {
            min_squared = squared;
            nearest = static_cast<int>(w);
        }
    }
    if (nearest < 0) return;
    pull_[v] = geom::smoothstep(0.1, 0.5, std::abs(side));
    terms_[v] = terms_[nearest];
}

// Vertices whose rows the harmonic extension finds.
std::vector<int> BindingRows::number_unknowns() {
    std::vector<int> free;
    unknown_.assign(static_cast<std::size_t>(count_), -1);
    for (long v = 0; v < count_; ++v)
        if (on_surface_[v] && !on_shell_[v] && !held_[v]) {
            unknown_[v] = static_cast<int>(free.size());
            free.push_back(static_cast<int>(v));
        }
    return free;
}

// One column of the right side for each shell vertex that known rows next to the unknown ones use.
void BindingRows::number_columns(const std::vector<int>& free) {
    column_of_.assign(shell_.vertex.size(), -1);
    const auto add_columns = [&](const Terms& row) {
        for (const auto& [node, weight] : row.nodes)
            if (column_of_[node] < 0) {
                column_of_[node] = static_cast<int>(column_node_.size());
                column_node_.push_back(node);
            }
    };
    for (int v : free) {
        if (pull_[v] > 0) add_columns(terms_[v]);
        for (int w : neighbours_[v])
            if (unknown_[w] < 0) add_columns(terms_[w]);
    }
}

// Harmonic extension to what is left: each unknown row is the mean of its neighbours', weighted by inverse edge length.
void BindingRows::extend_harmonically() {
    const std::vector<int> free = number_unknowns();
    if (free.empty()) return;
    number_columns(free);
    const long columns = static_cast<long>(column_node_.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(static_cast<long>(free.size()), columns + 4);
    for (std::size_t i = 0; i < free.size(); ++i) {
        const int v = free[i];
        double diagonal = 1e-9;
        const auto add_known = [&](const Terms& row, double weight) {
            diagonal += weight;
            for (const auto& [node, fraction] : row.nodes)
                right(static_cast<long>(i), column_of_[node]) += weight * fraction;
            right(static_cast<long>(i), columns) += weight * row.jaw;
            for (int k = 0; k < 3; ++k)
                right(static_cast<long>(i), columns + 1 + k) += weight * row.jaw_point[k];
        };
        double around = 0;
        for (int w : neighbours_[v]) {
            const double weight = 1.0 / std::max(1e-6, (at(v) - at(w)).norm());
            around += weight;
            if (unknown_[w] < 0) {
                add_known(terms_[w], weight);
            } else {
                diagonal += weight;
                entries.emplace_back(static_cast<int>(i), unknown_[w], -weight);
            }
        }
        if (pull_[v] > 0) add_known(terms_[v], pull_[v] * around);
        entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal);
    }
    Eigen::SparseMatrix<double> laplacian(static_cast<long>(free.size()),
                                          static_cast<long>(free.size()));
    laplacian.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(laplacian);
    write_solution(factor.solve(right), free);
}

void BindingRows::write_solution(const Eigen::MatrixXd& solution, const std::vector<int>& free) {
    const long columns = static_cast<long>(column_node_.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
        Terms& row = terms_[free[i]];
        row.nodes.clear();
        for (long c = 0; c < columns; ++c)
            if (solution(static_cast<long>(i), c) > 1e-6)
                row.nodes.push_back({column_node_[c], solution(static_cast<long>(i), c)});
        std::sort(row.nodes.begin(), row.nodes.end());
        row.jaw = solution(static_cast<long>(i), columns);
        for (int k = 0; k < 3; ++k)
            row.jaw_point[k] = solution(static_cast<long>(i), columns + 1 + k);
        row.prune();
    }
}

// Smooths the rows of shell vertices over the mesh until facets of the coarse shell no longer show.
void BindingRows::smooth_over_mesh() {
    constexpr int kSweeps = 6;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        std::vector<Terms> next = terms_;
        for (long v = 0; v < count_; ++v) {
            if (!on_shell_[v] || neighbours_[v].empty()) continue;
            double edge = 0;
            for (int w : neighbours_[v]) edge += (at(v) - at(w)).norm();
            edge /= static_cast<double>(neighbours_[v].size());
            // A sweep of strength s spreads by edge sqrt(s); all sweeps together aim at a third of the coarse spacing.
            const double wanted = 0.33 * shell_.spacing_m[v];
            const double strength = std::min(0.8, wanted * wanted / (edge * edge * kSweeps));
            Terms row;
            row.add(terms_[v], 1 - strength);
            for (int w : neighbours_[v])
                row.add(terms_[w], strength / static_cast<double>(neighbours_[v].size()));
            row.prune();
            next[v] = row;
        }
        terms_.swap(next);
    }
}

}  // namespace

SkinBinding::SkinBinding(const rig::Head& head, const Jaw& jaw, const Shell& shell) {
    BindingRows binding(head, jaw, shell);
    binding.bind_shell_vertices();
    binding.choose_held_vertices();
    binding.extend_harmonically();
    binding.smooth_over_mesh();

    const long count = head.vertices.rows();
    rows_.resize(static_cast<std::size_t>(count));
    for (long v = 0; v < count; ++v) {
        const Terms& row = binding.rows()[head.welded[v]];
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

std::vector<std::pair<int, double>> SkinBinding::row(int vertex) const {
    std::vector<std::pair<int, double>> out;
    if (vertex < 0 || vertex >= static_cast<int>(rows_.size())) return out;
    const Row& row = rows_[static_cast<std::size_t>(vertex)];
    for (int k = row.begin; k < row.end; ++k)
        out.emplace_back(column_[static_cast<std::size_t>(k)],
                         weight_[static_cast<std::size_t>(k)]);
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
