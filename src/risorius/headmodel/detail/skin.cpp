// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace risorius::headmodel {
namespace {

constexpr int kColumns = 48;
constexpr int kEarColumn0 = 29, kEarColumn1 = 35;
constexpr int kCapSide = 12;  ///< cells along the front and the back edge of the crown cap

constexpr int kJawRow = 65, kNeckRow = 74, kNeckBaseRows = 5, kSkirtRows = 11;
/// The strip from the tip of the nose to the lip, where the skin runs almost along the rays of the head surface: its rows are even on
/// the skin, not by height.
constexpr int kStripRow = 34, kStripColumns = 1;

double smooth_between(double a, double b, double t) { return a + (b - a) * t * t * (3 - 2 * t); }

double row_height(const GridTable& rows, int row, double azimuth_deg) {
    std::size_t k = 0;
    while (k + 2 < rows.rows.size() && rows.rows[k + 1] <= row) ++k;
    const double t = (row - rows.rows[k]) / (rows.rows[k + 1] - rows.rows[k]);
    std::size_t a = 0;
    while (a < 2 && rows.columns[a + 1] < azimuth_deg) ++a;
    const double u = std::clamp(
        (azimuth_deg - rows.columns[a]) / (rows.columns[a + 1] - rows.columns[a]), 0.0, 1.0);
    const auto at = [&](std::size_t key) {
        return smooth_between(rows.value[key][a], rows.value[key][a + 1], u);
    };
    return at(k) * (1 - t) + at(k + 1) * t;
}

/// The azimuth of a column at one level, degrees.
double azimuth_at(const SkinLevel& level, int column) {
    auto a = level.azimuth.begin();
    while (a + 2 < level.azimuth.end() && (a + 1)->first <= column) ++a;
    const auto b = a + 1;
    return a->second + (b->second - a->second) * (column - a->first) / (b->first - a->first);
}

/// The azimuth of a column in a row, degrees. Columns of the face pass smoothly from level to level; those of the side pass evenly from
/// the crown to the brow and keep their places below it.
double column_azimuth(const std::vector<SkinLevel>& levels, int column, int row) {
    constexpr int kFaceColumns = 16;
    std::size_t k = 0;
    while (k + 2 < levels.size() && row > levels[k + 1].last_row) ++k;
    const SkinLevel &above = levels[k], &below = levels[k + 1];
    const double rows = below.first_row - above.last_row;
    const double from = azimuth_at(above, column), to = azimuth_at(below, column);
    if (column >= kFaceColumns)
        return to + (from - to) * std::clamp((below.first_row - row) / rows, 0.0, 1.0);
    return smooth_between(from, to, std::clamp((row - above.last_row) / rows, 0.0, 1.0));
}

struct Block {
    int row0, row1, column0, column1;
};
constexpr Block kEyeBlock{21, 31, 4, 16}, kNoseBlock{34, 44, 1, 7}, kMouthBlock{45, 55, 0, 10},
    kEarBlock{22, 44, kEarColumn0, kEarColumn1};

/// What the cell of the grid belongs to that has this corner.
Region region_of_cell(int row, int column) {
    if (row >= kJawRow) return column < 34 ? Region::kNeck : Region::kNape;
    if (row < 9) return Region::kScalp;
    if (column >= kEarColumn1) return row < 44 ? Region::kScalp : Region::kNape;
    if (column >= 24)
        return row < 18   ? Region::kScalp
               : row < 26 ? Region::kTemple
               : row < 52 ? Region::kCheek
                          : Region::kJaw;
    if (row < 16) return column < 17 ? Region::kForehead : Region::kTemple;
    if (row < 20 && column < 17) return Region::kBrow;
    if (column >= 17 && row < 26) return Region::kTemple;
    if (row < 33 && column >= 4 && column < 17) return Region::kOrbit;
    if (row < 44 && column < 7) return Region::kNose;
    if (row >= 56) return column < 11 ? Region::kChin : Region::kJaw;
    if (row >= 44 && column < 11) return Region::kMouthSkin;
    return Region::kCheek;
}

void add_crown(Skin& skin, const HeadSurface& head) {
    HalfMesh& mesh = skin.mesh;
    const std::vector<int>& ring = skin.grid[0];
    constexpr int kRows = kColumns - 2 * kCapSide;
    std::vector<std::vector<int>> id(kRows + 1, std::vector<int>(kCapSide + 1));
    for (int c = 0; c <= kCapSide; ++c) {
        id[0][c] = ring[c];
        id[kRows][c] = ring[kColumns - c];
    }
    for (int r = 0; r <= kRows; ++r) id[r][kCapSide] = ring[kCapSide + r];
    for (int r = 1; r < kRows; ++r)
        for (int c = 0; c < kCapSide; ++c) {
            const double u = static_cast<double>(c) / kCapSide, v = static_cast<double>(r) / kRows;
            const auto p = [&](int row, int column) {
                return mesh.point[static_cast<std::size_t>(id[row][column])];
            };
            const Vec3 straight = (1 - v) * p(0, c) + v * p(kRows, c);
            Vec3 q = straight;
            q.x() = u * p(r, kCapSide).x();
            q.z() = (1 - u) * straight.z() + u * p(r, kCapSide).z();
            id[r][c] = mesh.add(head.project(q), Hold::kOnHead, c == 0);
        }
    for (int r = 0; r < kRows; ++r)
        for (int c = 0; c < kCapSide; ++c)
            mesh.quad(id[r][c], id[r][c + 1], id[r + 1][c + 1], id[r + 1][c]);
}

/// Down the neck to its base, then outwards over the trapezius to the edge of the bust; own design.
void add_skirt(Skin& skin, const DesignTables& tables) {
    HalfMesh& mesh = skin.mesh;
    const std::vector<int> last = skin.grid[kNeckRow];
    const std::vector<int> before = skin.grid[kNeckRow - 2];
    std::vector<std::vector<int>> rows{last};
    for (int k = 1; k <= kSkirtRows; ++k) rows.emplace_back(kColumns + 1);
    const auto hermite = [](const Vec3& p, const Vec3& dp, const Vec3& q, const Vec3& dq,
                            double t) {
        const double t2 = t * t, t3 = t2 * t;
        return Vec3((2 * t3 - 3 * t2 + 1) * p + (t3 - 2 * t2 + t) * dp + (3 * t2 - 2 * t3) * q +
                    (t3 - t2) * dq);
    };
    for (int c = 0; c <= kColumns; ++c) {
        const Vec3 start = mesh.point[static_cast<std::size_t>(last[c])];
        const double a = std::atan2(start.x(), start.z() + 26.0), cos_a = std::cos(a),
                     sin_a = std::sin(a);
        const auto on_edge = [&](const BustEdge& edge) {
            return Vec3(edge.half_width * std::pow(sin_a, edge.roundness),
                        edge.height + edge.slope * cos_a + edge.curve * cos_a * cos_a,
                        edge.middle + (cos_a > 0 ? edge.front : edge.back) * cos_a);
        };
        const Vec3 base = on_edge(tables.neck_base), end = on_edge(tables.bust);
        const Vec3 down = (start - mesh.point[static_cast<std::size_t>(before[c])]).normalized();
        const double reach0 = (base - start).norm(), reach1 = (end - base).norm();
        // Steeper in front of and behind the neck, where the body goes on downwards.
        const Vec3 turn =
            ((base - start).normalized() + 0.9 * (end - base).normalized()).normalized();
        const Vec3 out = ((end - base).normalized() + Vec3(0, -0.35 - 0.5 * sin_a, 0)).normalized();
        for (int k = 1; k <= kSkirtRows; ++k) {
            const Vec3 p = k <= kNeckBaseRows ? hermite(start, down * reach0, base, turn * reach0,
                                                        static_cast<double>(k) / kNeckBaseRows)
                                              : hermite(base, turn * reach1, end, out * reach1,
                                                        static_cast<double>(k - kNeckBaseRows) /
                                                            (kSkirtRows - kNeckBaseRows));
            rows[k][c] = mesh.add(p, Hold::kPinned, c == 0 || c == kColumns);
        }
    }
    for (int k = 0; k < kSkirtRows; ++k)
        for (int c = 0; c < kColumns; ++c) {
            mesh.adding = k < kNeckBaseRows ? Region::kNeck : Region::kShoulder;
            mesh.quad(rows[k][c], rows[k + 1][c], rows[k + 1][c + 1], rows[k][c + 1]);
        }
    skin.grid.insert(skin.grid.end(), rows.begin() + 1, rows.end());
}

/// Relief finer than the measured grid: the philtrum between nose and upper lip, a groove between two low ridges.
double philtrum(const std::map<std::string, double>& measures, const Vec3& p) {
    const auto of = [&](const char* name) { return measures.at(name); };
    const double top = of("top_y"), bottom = of("bottom_y");
    if (p.z() < of("behind_z") || p.y() > top || p.y() < bottom) return 0;
    const double along = std::clamp((top - p.y()) / of("fade_top"), 0.0, 1.0) *
                         std::clamp((p.y() - bottom) / of("fade_bottom"), 0.0, 1.0);
    const double ridge =
        of("ridge_x") +
        of("ridge_spread") *
            std::clamp((of("spread_from_y") - p.y()) / of("spread_length"), 0.0, 1.0);
    const double x = std::abs(p.x());
    const auto bell = [](double t) { return std::exp(-t * t); };
    return along * (of("ridge_height") * bell((x - ridge) / of("ridge_width")) -
                    of("groove_depth") * bell(x / of("groove_width")));
}

/// A line along which the skin is raised, or carved where its height is below 0.
struct ReliefLine {
    const std::vector<SkinReliefPoint>& points;

    /// Height at a place, mm: the largest of what its segments add there.
    double height(const Vec3& p) const {
        double max_height = 0;
        for (std::size_t k = 0; k + 1 < points.size(); ++k) {
            const SkinReliefPoint &a = points[k], &b = points[k + 1];
            const Vec3 along = b.at - a.at, from = p - a.at;
            const double t = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
            const double width = a.width_mm + t * (b.width_mm - a.width_mm),
                         full = a.height_mm + t * (b.height_mm - a.height_mm);
            const double here =
                full * std::exp(-(from - t * along).squaredNorm() / (width * width));
            if (std::abs(here) > std::abs(max_height)) max_height = here;
        }
        return max_height;
    }
};

/// The groove that sets the wing of the nose off from its side and the cheek, with the dimple before the tip; the ridge of
/// lobule and columella, which hangs below the wings and stands out between the nostrils; and the bridge, which is round across.
void shape_nose(Skin& skin, const DesignTables& tables) {
    const auto line = [&](const char* name) { return ReliefLine{tables.nose_relief.at(name)}; };
    const ReliefLine groove = line("groove"), columella = line("columella"),
                     bridge = line("bridge"), flank = line("flank");
    const std::set<int> fixed(skin.fixed.begin(), skin.fixed.end());
    HalfMesh& mesh = skin.mesh;
    const std::vector<Vec3> before = mesh.point;
    const std::vector<Vec3> normal = mesh.normals();
    std::vector<double> tip(before.size(), 0.0);
    for (std::size_t v = 0; v < before.size(); ++v) {
        const Vec3& p = before[v];
        if (fixed.count(static_cast<int>(v)) || (p - Vec3(9, -12, 102)).norm() > 34) continue;
        mesh.point[v] +=
            (groove.height(p) + columella.height(p) + bridge.height(p) + flank.height(p)) *
            normal[v];
        if (mesh.midline[v]) mesh.point[v].x() = 0;
        // One dome from wing to wing: the loops that begin beside the columella would show as a dent on either side of it.
        const Vec3 from = (p - Vec3(0, -20, 114)).cwiseQuotient(Vec3(12, 11, 10));
        tip[v] = std::clamp(2.2 * (1 - from.norm()), 0.0, 1.0);
    }
    mesh.smooth(25, tip);
}

/// Takes the seams between the head surface and the lofted wing out, and the pole out of the crown.
void smooth_joints(Skin& skin) {
    HalfMesh& mesh = skin.mesh;
    std::vector<double> nose(mesh.point.size(), 0.0), crown(mesh.point.size(), 0.0),
        neck(mesh.point.size(), 0.0);
    const auto fall = [](double d, double from, double to) {
        return std::clamp((to - d) / (to - from), 0.0, 1.0);
    };
    for (std::size_t v = 0; v < mesh.point.size(); ++v) {
        const Vec3& p = mesh.point[v];
        nose[v] = p.y() > -34 ? fall((p - Vec3(11, -20, 102)).norm(), 12, 18) : 0;
        crown[v] = fall(Vec2(p.x(), p.z() - 5).norm(), 30, 55) * (p.y() > 90 ? 1 : 0);
    }
    for (int r = kJawRow + 2; r < static_cast<int>(skin.grid.size()) - 1; ++r)
        for (const int v : skin.grid[static_cast<std::size_t>(r)])
            neck[static_cast<std::size_t>(v)] = std::clamp((r - kJawRow - 1) / 5.0, 0.0, 1.0);
    for (const int v : skin.fixed) nose[static_cast<std::size_t>(v)] = 0;
    mesh.smooth(6, nose);
    mesh.smooth(60, crown);
    mesh.smooth(60, neck);
}

}  // namespace

std::vector<int> block_loop(const std::vector<std::vector<int>>& grid, int row0, int row1,
                            int column0, int column1) {
    std::vector<int> loop;
    for (int r = row0; r < row1; ++r) loop.push_back(grid[r][column0]);
    for (int c = column0; c < column1; ++c) loop.push_back(grid[row1][c]);
    for (int r = row1; r > row0; --r) loop.push_back(grid[r][column1]);
    for (int c = column1; c > column0; --c) loop.push_back(grid[row0][c]);
    return loop;
}

Vec3 clear_of_globe(const Vec3& point, const Globe& globe, double gap) {
    const Vec3 from = point - globe.centre;
    const double d = from.norm();
    if (d > 18 || from.z() < -2) return point;
    const double min = globe.radius_at(from.z() / d) + gap;
    const double soft = 0.5, over = d - min;
    return globe.centre + from / d * (min + 0.5 * (over + std::sqrt(over * over + soft * soft)));
}

Skin make_skin(const DesignTables& tables, const HeadSurface& head, const Globe& globe) {
    Skin skin;
    HalfMesh& mesh = skin.mesh;
    const auto inside = [](const Block& b, int r, int c) {
        return r > b.row0 && r < b.row1 && (c > b.column0 || b.column0 == 0) && c < b.column1;
    };
    const auto in_block = [&](int r, int c) {
        return inside(kEyeBlock, r, c) || inside(kNoseBlock, r, c) || inside(kMouthBlock, r, c) ||
               inside(kEarBlock, r, c);
    };
    skin.grid.assign(kNeckRow + 1, std::vector<int>(kColumns + 1, -1));
    for (int r = 0; r <= kNeckRow; ++r)
        for (int c = 0; c <= kColumns; ++c) {
            if (in_block(r, c)) continue;
            const double azimuth = column_azimuth(tables.skin_columns, c, r);
            const bool strip = c <= kStripColumns && r >= kStripRow &&
                               r - kStripRow < static_cast<int>(tables.skin_strip.size());
            const Vec3 p =
                head.at(azimuth * M_PI / 180,
                        strip ? tables.skin_strip[static_cast<std::size_t>(r - kStripRow)]
                              : row_height(tables.skin_rows, r, azimuth));
            skin.grid[r][c] =
                mesh.add(p, r == kNeckRow ? Hold::kPinned : Hold::kOnHead, c == 0 || c == kColumns);
        }
    const auto cell_in = [](const Block& b, int r, int c) {
        return r >= b.row0 && r < b.row1 && c >= b.column0 && c < b.column1;
    };
    for (int r = 0; r < kNeckRow; ++r)
        for (int c = 0; c < kColumns; ++c)
            if (!cell_in(kEyeBlock, r, c) && !cell_in(kNoseBlock, r, c) &&
                !cell_in(kMouthBlock, r, c) && !cell_in(kEarBlock, r, c)) {
                mesh.adding = region_of_cell(r, c);
                mesh.quad(skin.grid[r][c], skin.grid[r + 1][c], skin.grid[r + 1][c + 1],
                          skin.grid[r][c + 1]);
            }

    const auto loop = [&](const Block& b) {
        return block_loop(skin.grid, b.row0, b.row1, b.column0, b.column1);
    };
    mesh.adding = Region::kScalp;
    add_crown(skin, head);
    mesh.adding = Region::kOrbit;
    add_lids(skin, loop(kEyeBlock), tables, head, globe);
    mesh.adding = Region::kMouthSkin;
    std::vector<int> mouth;  // the midline side of the block is open: bottom, right side, top
    for (int c = 0; c < kMouthBlock.column1; ++c) mouth.push_back(skin.grid[kMouthBlock.row1][c]);
    for (int r = kMouthBlock.row1; r > kMouthBlock.row0; --r)
        mouth.push_back(skin.grid[r][kMouthBlock.column1]);
    for (int c = kMouthBlock.column1; c >= 0; --c) mouth.push_back(skin.grid[kMouthBlock.row0][c]);
    add_mouth(skin, mouth, tables, head);
    mesh.adding = Region::kWing;
    add_nasal_wing(skin, loop(kNoseBlock), tables);
    mesh.adding = Region::kCheek;
    add_ear(skin, loop(kEarBlock), tables, head);

    const auto on_head = [&](const Vec3& p) {
        Vec3 q = clear_of_globe(head.project(p), globe, 1.3);
        q.z() += philtrum(tables.philtrum, q);
        return q;
    };
    mesh.relax(60, 0.5, on_head, Hold::kOnHead);
    mesh.relax(40, 0.5, nullptr, Hold::kSmooth);
    add_skirt(skin, tables);
    smooth_joints(skin);
    shape_nose(skin, tables);
    fit_landmarks(skin, tables);
    return skin;
}

}  // namespace risorius::headmodel
