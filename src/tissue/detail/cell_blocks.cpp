#include "tissue/detail/cell_blocks.h"

#include <Eigen/LU>
#include <cmath>

#include "tissue/detail/cell_point.h"

namespace risorius::tissue::detail {

using solve::Block;
using solve::FloatRow;

namespace {

constexpr int kOf[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};

Block operator+(const Block& a, const Block& b) {
    return {{a.column[0] + b.column[0], a.column[1] + b.column[1], a.column[2] + b.column[2]}};
}
Block operator-(const Block& a, const Block& b) {
    return {{a.column[0] - b.column[0], a.column[1] - b.column[1], a.column[2] - b.column[2]}};
}

Block outer(const FloatRow& a, const FloatRow& b) { return {{a * b[0], a * b[1], a * b[2]}}; }
Block scaled(float s, const Block& a) {
    return {{s * a.column[0], s * a.column[1], s * a.column[2]}};
}

FloatRow cross(const FloatRow& a, const FloatRow& b) {
    const FloatRow a1 = __builtin_shufflevector(a, a, 1, 2, 0, 3);
    const FloatRow b1 = __builtin_shufflevector(b, b, 1, 2, 0, 3);
    const FloatRow c = a * b1 - a1 * b;  // z x y
    return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}

const Block zero{};

}  // namespace

CellBlockLaw cell_block_law(const CellBody& body, int cell, const Points& rest_vertices,
                            double rate_hz) {
    const auto c = static_cast<std::size_t>(cell);
    const CellMesh::Cell& at = body.mesh.cells()[c];
    const CellCorners rest(at, rest_vertices);
    const double volume = cell_volume(at, rest_vertices);
    CellBlockLaw law;
    const double share = at.size.prod();  // eight Gauss points as one
    if (body.moduli.empty()) {
        const CellParameters& parameters = body.parameters[c];
        law.root_bulk = static_cast<float>(
            std::sqrt(volume_stiffness(CellMaterialLaw(parameters), at.size, volume) / 2048));
        const Mat3 d =
            share * (parameters.elastic_n_per_m3 + rate_hz * parameters.damping_ns_per_m3);
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) {
                const double scale = 16 * at.size[i] * at.size[j];
                law.elastic[kOf[i][j]] = static_cast<float>(d(i, j) / (scale * scale));
            }
        return law;
    }
    const CellModuli& moduli = body.moduli[c];
    law.physical = true;
    law.root_bulk = static_cast<float>(
        std::sqrt(volume_stiffness(CellMaterialLaw(moduli), at.size, volume) / 2048));
    law.factor = static_cast<float>((moduli.mu_pa + rate_hz * moduli.viscosity_pa_s) * volume);
    Mat3 mean = Mat3::Zero();
    for (int g = 0; g < 8; ++g) mean += 0.125 * tangents_at(rest, at.size, g);
    const Mat3 inverse = (mean.transpose() * mean).inverse();
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            law.elastic[kOf[i][j]] =
                static_cast<float>(inverse(i, j) / (16 * at.size[i] * at.size[j]));
    return law;
}

void cell_blocks(const CellBlockLaw& law, const CellMesh::Cell& cell, const Points& vertices,
                 Block (&blocks)[64]) {
    // Modes a b c (8 times the mean tangents) and d e f, unscaled
    FloatRow x[8];
    const double* const origin = vertices.data() + 3L * cell.vertex[0];
    for (std::size_t c = 0; c < 8; ++c) {
        const double* const from = vertices.data() + 3L * cell.vertex[c];
        x[c] = FloatRow{static_cast<float>(from[0] - origin[0]),
                        static_cast<float>(from[1] - origin[1]),
                        static_cast<float>(from[2] - origin[2]), 0};
    }
    const FloatRow s0 = x[1] + x[0], s1 = x[3] + x[2], s2 = x[5] + x[4], s3 = x[7] + x[6];
    const FloatRow d0 = x[1] - x[0], d1 = x[3] - x[2], d2 = x[5] - x[4], d3 = x[7] - x[6];
    const FloatRow t[3] = {(s2 + s3) - (s0 + s1), (s1 + s3) - (s0 + s2), (d0 + d1) + (d2 + d3)};
    const FloatRow d = (s3 - s2) - (s1 - s0), e = (d2 + d3) - (d0 + d1), f = (d1 + d3) - (d0 + d2);

    // dP_i/dt_j of constant tangents
    Block b[3][3];
    if (law.physical) {
        FloatRow tc[3];
        for (int i = 0; i < 3; ++i)
            tc[i] = law.elastic[kOf[i][0]] * t[0] + law.elastic[kOf[i][1]] * t[1] +
                    law.elastic[kOf[i][2]] * t[2];
        const Block tct =
            scaled(law.factor, outer(tc[0], t[0]) + outer(tc[1], t[1]) + outer(tc[2], t[2]));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                b[i][j] = scaled(law.elastic[kOf[i][j]], tct) + outer(law.factor * tc[j], tc[i]);
    } else {
        const Block square[3] = {outer(t[0], t[0]), outer(t[1], t[1]), outer(t[2], t[2])};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                b[i][j] = outer(law.elastic[kOf[i][j]] * t[j], t[i]);
                if (i == j)
                    b[i][j] = b[i][j] + scaled(law.elastic[kOf[i][0]], square[0]) +
                              scaled(law.elastic[kOf[i][1]], square[1]) +
                              scaled(law.elastic[kOf[i][2]], square[2]);
            }
    }
    constexpr float third = 1.0f / 3.0f;
    // of d e f: the two share what they do along the axis neither has
    Block even[3][3];
    even[0][0] = scaled(third, b[0][0] + b[1][1]);
    even[1][1] = scaled(third, b[0][0] + b[2][2]);
    even[2][2] = scaled(third, b[1][1] + b[2][2]);
    even[0][1] = scaled(third, b[1][2]);
    even[1][0] = scaled(third, b[2][1]);
    even[0][2] = scaled(third, b[0][2]);
    even[2][0] = scaled(third, b[2][0]);
    even[1][2] = scaled(third, b[0][1]);
    even[2][1] = scaled(third, b[1][0]);
    const Block kk = scaled(third * third, b[0][0] + b[1][1] + b[2][2]);

    // Derivative of 64 V by the corners
    const FloatRow da = cross(t[1], t[2]) + third * cross(d, e),
                   db = cross(t[2], t[0]) + third * cross(f, d),
                   dc = cross(t[0], t[1]) + third * cross(e, f);
    const FloatRow dd = third * (cross(e, t[0]) + cross(t[1], f)),
                   de = third * (cross(t[0], d) + cross(f, t[2])),
                   df = third * (cross(d, t[1]) + cross(t[2], e));
    FloatRow gradient[8];
    for (int v = 0; v < 4; ++v) {
        const float j = (v & 2) ? 1.0f : -1.0f, k = (v & 1) ? 1.0f : -1.0f;
        const FloatRow odd = law.root_bulk * (j * db + k * dc - da);
        const FloatRow paired = law.root_bulk * ((j * k) * df - j * dd - k * de);
        gradient[v] = odd + paired;
        gradient[7 - v] = paired - odd;
    }

    // Corners v and 7 - v lie opposite: their signs differ in the odd modes a b c k and agree in the even ones d e f. So
    // the sums over odd and over even modes of sixteen pairs, added and subtracted, make all sixty-four.
    for (int v = 0; v < 4; ++v) {
        const bool j = v & 2, k = v & 1;  // along a1, v is low
        Block odd[3], paired[3];
        for (int m = 0; m < 3; ++m) {
            const Block jk = j == k ? (k ? b[1][m] + b[2][m] : zero - (b[1][m] + b[2][m]))
                                    : (j ? b[1][m] - b[2][m] : b[2][m] - b[1][m]);
            odd[m] = jk - b[0][m];
            const Block de_of =
                j == k ? (j ? zero - (even[0][m] + even[1][m]) : even[0][m] + even[1][m])
                       : (j ? even[1][m] - even[0][m] : even[0][m] - even[1][m]);
            paired[m] = j == k ? de_of + even[2][m] : de_of - even[2][m];
        }
        const Block cubic = j == k ? zero - kk : kk;
        // w low along a1 too: signs -1, sj, sk
        const Block base_low = zero - odd[0];
        for (int w = 0; w < 4; ++w) {
            const bool wj = w & 2, wk = w & 1;
            Block o = wj ? base_low + odd[1] : base_low - odd[1];
            o = wk ? o + odd[2] : o - odd[2];
            o = wj == wk ? o - cubic : o + cubic;
            Block p = wj == wk ? paired[2] : zero - paired[2];
            p = wj ? p - paired[0] : p + paired[0];
            p = wk ? p - paired[1] : p + paired[1];
            const Block same = p + o, other = p - o;
            if (v <= w) blocks[8 * v + w] = same + outer(gradient[v], gradient[w]);
            if (v >= w)
                blocks[8 * (7 - v) + 7 - w] = same + outer(gradient[7 - v], gradient[7 - w]);
            blocks[8 * v + 7 - w] = other + outer(gradient[v], gradient[7 - w]);
        }
    }
}

}  // namespace risorius::tissue::detail
