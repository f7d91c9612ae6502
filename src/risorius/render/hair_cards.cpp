// SPDX-License-Identifier: MIT
#include "risorius/render/hair_cards.h"

#include <algorithm>
#include <cmath>

#include "risorius/render/detail/card_picture.h"
#include "risorius/render/detail/locks.h"

namespace risorius::render {
namespace {

/// Wider cards have the rims of the picture; strips of fewer hairs are cut from its inside.
constexpr double kWideCard_m = 0.006;

/// Folds a number into 0..1, there and back. Pictures are not repeated: the ends of strands would show the roots above them.
double folded(double x) {
    const double along = x - 2 * std::floor(0.5 * x);
    return along <= 1 ? along : 2 - along;
}

class CardMaker {
  public:
    CardMaker(const Scene& scene, const Hair& hair) : hair_(hair) {
        for (const SkinPlace& root : hair.roots) root_at_.push_back(root.on(scene.rest));
    }

    HairCards made() {
        std::vector<int> cards, cap;
        for (const HairPiece& piece : hair_.pieces) {
            if (piece.columns == 0) {
                add_cap(piece, cap);
            } else {
                add_card(piece, cards);
                ++out_.locks;
            }
        }
        const auto count = static_cast<long>(at_.size());
        out_.vertices.resize(count, 3);
        out_.normals.resize(count, 3);
        out_.texcoords.resize(count, 2);
        out_.root.resize(count, 3);
        out_.share.resize(count, 3);
        for (long i = 0; i < count; ++i) {
            const CardVertex& v = at_[static_cast<std::size_t>(i)];
            const SkinPlace& root = hair_.roots[v.root];
            out_.vertices.row(i) = v.at.transpose();
            out_.normals.row(i) = v.normal.transpose();
            out_.texcoords.row(i) = v.texcoord.transpose();
            out_.shade.push_back(v.shade);
            for (int k = 0; k < 3; ++k) out_.root(i, k) = root.corner[static_cast<std::size_t>(k)];
            out_.share.row(i) = root.fraction.transpose();
        }
        out_.cards = Eigen::Map<Triangles>(cards.data(), static_cast<long>(cards.size()) / 3, 3);
        out_.cap = Eigen::Map<Triangles>(cap.data(), static_cast<long>(cap.size()) / 3, 3);
        return std::move(out_);
    }

  private:
    struct CardVertex {
        Vec3 at, normal;
        Vec2 texcoord;
        double shade;
        std::size_t root;
    };

    Vec3 place(const HairVertex& v) const { return root_at_[v.root] + v.offset; }
    CardVertex vertex(const HairVertex& v, const Vec2& texcoord) const {
        return {place(v), v.out.normalized(), texcoord,
                std::min(v.lit * v.tone / kMostHairTone, 1.0), v.root};
    }

    /// The triangle seen from where its normals point.
    void add_triangle(int a, int b, int c, std::vector<int>& triangles) const {
        const auto of = [&](int i) -> const CardVertex& {
            return at_[static_cast<std::size_t>(i)];
        };
        const Vec3 normal = (of(b).at - of(a).at).cross(of(c).at - of(a).at);
        if (normal.norm() == 0) return;
        const bool outwards = normal.dot(of(a).normal + of(b).normal + of(c).normal) > 0;
        triangles.insert(triangles.end(), {a, outwards ? b : c, outwards ? c : b});
    }

    const HairVertex& at(const HairPiece& piece, std::size_t row, std::size_t column) const {
        return hair_.vertices[piece.first_vertex + row * piece.columns + column];
    }
    Vec3 middle(const HairPiece& piece, std::size_t row) const {
        return 0.5 * (place(at(piece, row, 0)) + place(at(piece, row, piece.columns - 1)));
    }
    double width_m(const HairPiece& piece, std::size_t row) const {
        return (place(at(piece, row, piece.columns - 1)) - place(at(piece, row, 0))).norm();
    }

    /// From where to where a card lies across the picture.
    std::pair<double, double> across(double width_m, double chance) {
        const std::size_t number = static_cast<std::size_t>(out_.locks);
        const double cell = 1.0 / kCardCells,
                     first = cell * static_cast<double>(number * 5 % kCardCells);
        const bool turned = number / kCardCells % 2 == 1;
        double from = first, to = first + cell;
        if (width_m < kWideCard_m) {
            const double share = std::min(width_m / kCardPicture_m, cell * (1 - 2 * kCardRim));
            from += cell * kCardRim + (cell * (1 - 2 * kCardRim) - share) * chance;
            to = from + share;
        }
        return turned ? std::pair{to, from} : std::pair{from, to};
    }

    void add_card(const HairPiece& piece, std::vector<int>& triangles) {
        double widest = 0, whole = 0;
        std::vector<double> passed{0};
        for (std::size_t row = 0; row < piece.rows; ++row) {
            widest = std::max(widest, width_m(piece, row));
            if (row > 0)
                passed.push_back(passed.back() +
                                 (middle(piece, row) - middle(piece, row - 1)).norm());
        }
        whole = std::max(passed.back(), 1e-9);
        const double chance = at(piece, 0, 0).strand.x();
        const auto [left, right] = across(widest, chance - std::floor(chance));
        const auto first = static_cast<int>(at_.size());
        const auto columns = static_cast<int>(piece.columns);
        const auto u = [&](std::size_t column) {
            return left + (right - left) * static_cast<double>(column) /
                              static_cast<double>(piece.columns - 1);
        };
        for (std::size_t row = 0; row < piece.rows; ++row)
            for (std::size_t column = 0; column < piece.columns; ++column)
                at_.push_back(vertex(at(piece, row, column),
                                     {u(column), 1 - kCardBody * passed[row] / whole}));
        // Strands of several lengths, in place of the pointed ends of a lock
        auto last = static_cast<int>(piece.rows) - 1;
        if (const double ends = ends_m(piece); ends > 0) {
            for (std::size_t column = 0; column < piece.columns; ++column) {
                HairVertex end = at(piece, piece.rows - 1, column);
                end.offset += ends * end.along;
                at_.push_back(vertex(end, {u(column), 0}));
            }
            ++last;
        }
        for (int row = 0; row < last; ++row)
            for (int k = 0; k + 1 < columns; ++k) {
                const int a = first + row * columns + k, c = a + columns;
                add_triangle(a, a + 1, c + 1, triangles);
                add_triangle(a, c + 1, c, triangles);
            }
    }

    /// How far the ends of a lock reach beyond its last row, m; 0: it has none.
    double ends_m(const HairPiece& piece) const {
        double most = 0;
        const std::size_t end = piece.first_vertex + piece.vertices;
        for (std::size_t v = piece.first_vertex + piece.columns * piece.rows; v + 2 < end; v += 3)
            most = std::max(most, (hair_.vertices[v + 2].offset -
                                   0.5 * (hair_.vertices[v].offset + hair_.vertices[v + 1].offset))
                                      .norm());
        return most;
    }

    void add_cap(const HairPiece& piece, std::vector<int>& triangles) {
        const auto first = static_cast<int>(at_.size());
        for (std::size_t i = 0; i < piece.vertices; ++i) {
            const HairVertex& v = hair_.vertices[piece.first_vertex + i];
            at_.push_back(vertex(v, {folded(kStrandTexture_m / kCardPicture_m * v.strand.x()),
                                     1 - folded(v.strand.y())}));
        }
        const auto shift = first - static_cast<int>(piece.first_vertex);
        for (std::size_t i = 0; i < piece.indices; i += 3) {
            const unsigned* corner = hair_.triangles.data() + piece.first_index + i;
            add_triangle(static_cast<int>(corner[0]) + shift, static_cast<int>(corner[1]) + shift,
                         static_cast<int>(corner[2]) + shift, triangles);
        }
    }

    const Hair& hair_;
    std::vector<Vec3> root_at_;
    std::vector<CardVertex> at_;
    HairCards out_;
};

}  // namespace

Points HairCards::moved(const Points& delta) const {
    Points out(vertices.rows(), 3);
    for (long i = 0; i < out.rows(); ++i)
        out.row(i) = share(i, 0) * delta.row(root(i, 0)) + share(i, 1) * delta.row(root(i, 1)) +
                     share(i, 2) * delta.row(root(i, 2));
    return out;
}

HairCards hair_cards(const Scene& scene) {
    const Hair hair = plan_hair(scene);
    return hair.empty() ? HairCards{} : CardMaker(scene, hair).made();
}

}  // namespace risorius::render
