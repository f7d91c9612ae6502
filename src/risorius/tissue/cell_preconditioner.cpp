// SPDX-License-Identifier: MIT
#include "risorius/tissue/cell_preconditioner.h"

#include <cassert>
#include <cmath>
#include <stdexcept>

#include "risorius/tissue/detail/cell_point.h"
#include "risorius/tissue/detail/pressure_multigrid.h"

namespace risorius::tissue {

using detail::Field;
using detail::Lanes8;
using detail::load8;
using detail::PaddedGrid;
using detail::store8;

namespace {

/// Diagonal of the shape's stiffness as a fraction of the metric's bound (cell_metric), averaged over directions.
constexpr double kShapeFraction = 2.0 / 3.0;

/// Eight vectors.
struct Rows8 {
    Lanes8 x, y, z;
};
Rows8 operator+(const Rows8& a, const Rows8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Rows8 operator-(const Rows8& a, const Rows8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Rows8 operator*(const Lanes8& s, const Rows8& a) { return {s * a.x, s * a.y, s * a.z}; }
Rows8 cross(const Rows8& a, const Rows8& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Fields3 = std::array<Field, 3>;

Rows8 load_rows(const Fields3& fields, int at) {
    return {load8(fields[0].data() + at), load8(fields[1].data() + at),
            load8(fields[2].data() + at)};
}
void store_rows(Fields3& fields, int at, const Rows8& rows) {
    store8(fields[0].data() + at, rows.x);
    store8(fields[1].data() + at, rows.y);
    store8(fields[2].data() + at, rows.z);
}
Lanes8 dot(const Rows8& a, const Rows8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Derivative of 64 V by the corners, exact for trilinear cells. It is computed from the modes of their maps (cell_lanes.h).
void volume_gradient(const Rows8 (&x)[8], Rows8 (&gradient)[8]) {
    const Rows8 s0 = x[1] + x[0], s1 = x[3] + x[2], s2 = x[5] + x[4], s3 = x[7] + x[6];
    const Rows8 d0 = x[1] - x[0], d1 = x[3] - x[2], d2 = x[5] - x[4], d3 = x[7] - x[6];
    const Rows8 a = (s2 + s3) - (s0 + s1), b = (s1 + s3) - (s0 + s2), c = (d0 + d1) + (d2 + d3);
    const Rows8 d = (s3 - s2) - (s1 - s0), e = (d2 + d3) - (d0 + d1), f = (d1 + d3) - (d0 + d2);
    const Lanes8 third = Lanes8{} + 1.0f / 3.0f;
    const Rows8 da = cross(b, c) + third * cross(d, e), db = cross(c, a) + third * cross(f, d),
                dc = cross(a, b) + third * cross(e, f);
    const Rows8 dd = third * (cross(e, a) + cross(b, f)), de = third * (cross(a, d) + cross(f, c)),
                df = third * (cross(d, b) + cross(c, e));
    // Opposite corners have opposite signs in the odd modes a, b, c and equal signs in the even modes d, e, f.
    const auto opposite = [&](int v, const Rows8& odd, const Rows8& even) {
        gradient[v] = even + odd;
        gradient[7 - v] = even - odd;
    };
    opposite(0, (Rows8{} - da) - (db + dc), dd + (de + df));
    opposite(1, (dc - da) - db, (dd - de) - df);
    opposite(2, (db - da) - dc, (de - dd) - df);
    opposite(3, (db - da) + dc, (df - dd) - de);
}

}  // namespace

struct CellPreconditioner::Parts {
    Parts(const GridShape& nodes, const CellPreconditionerOptions& of)
        : options(of),
          grid{nodes},
          pressure(nodes, of.coarsest_cells),
          inverse(grid),
          exists(grid),
          compliance(grid),
          t(grid),
          q(grid) {
        const Field empty(grid);
        for (Fields3& corner : gradient) corner.fill(empty);
        positions.fill(empty);
        y.fill(empty);
    }

    CellPreconditionerOptions options;
    PaddedGrid grid;
    detail::PressureMultigrid pressure;
    Field inverse;        ///< d^-1 of each node; 0 on fixed nodes
    Field exists;         ///< 1 for each cell that resists changes of volume
    Field compliance;     ///< D^-1 of each cell, in the scale of 64 V
    Fields3 gradient[8];  ///< C, per corner and cell
    Fields3 positions, y;
    Field t, q;
};

CellPreconditioner::CellPreconditioner(const solve::MotionSystem& system,
                                       const std::shared_ptr<const CellSolid>& solid, double step_s,
                                       const CellPreconditionerOptions& options) {
    const CellBody& body = solid->body();
    const CellMesh& mesh = body.mesh;
    if (!mesh.uniform())
        throw std::invalid_argument("CellPreconditioner: the cells are not a uniform grid");
    if (mesh.root().closed) throw std::invalid_argument("CellPreconditioner: the cells go round");
    if (system.size() != mesh.node_count())
        throw std::invalid_argument("CellPreconditioner: the nodes are not those of the solid");
    if (options.degree < 1)
        throw std::invalid_argument("CellPreconditioner: the degree is below 1");
    const auto along = [&](int axis) {
        return ((mesh.root().along(axis) - 1) << mesh.deepest_level()) + 1;
    };
    parts_ = std::make_unique<Parts>(GridShape{along(0), along(1), along(2)}, options);
    Parts& p = *parts_;
    const double rate_hz = 1.0 / step_s;

    // d: inertia, the other terms, and the stiffness of the solid's shape
    solve::MetricBuilder others(system.size());
    for (const auto& term : system.terms())
        if (term.get() != solid.get()) term->add_metric(step_s, others);
    Eigen::VectorXd d = Eigen::VectorXd(others.build({}).diagonal());
    d += rate_hz * rate_hz * system.mass_kg();
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        const CellMesh::Cell& cell = mesh.cells()[c];
        auto law = body.moduli.empty() ? detail::CellMaterialLaw(body.parameters[c])
                                       : detail::CellMaterialLaw(body.moduli[c]);
        const double stiffness =
            2 * detail::volume_stiffness(law, cell.size, cell_volume(cell, body.rest)) / 4096;
        const int at = cell.vertex[0];
        p.exists[at] = stiffness > 0 ? 1.0f : 0.0f;
        p.compliance[at] = stiffness > 0 ? static_cast<float>(1 / stiffness) : 0.0f;

        law.parameters.incompressibility_n_per_m5 = law.moduli.bulk_pa = 0;
        const detail::CellScalarMatrix shape =
            detail::cell_metric(law, cell.size, detail::CellCorners(cell, body.rest), rate_hz);
        for (int v = 0; v < 8; ++v)
            d[cell.vertex[static_cast<std::size_t>(v)]] += kShapeFraction * shape(v, v);
    }
    for (int i = 0; i < system.size(); ++i)
        p.inverse[i] =
            system.fixed()[static_cast<std::size_t>(i)] ? 0.0f : static_cast<float>(1 / d[i]);
}

CellPreconditioner::~CellPreconditioner() = default;

void CellPreconditioner::refresh(const solve::ImplicitStep& /*step*/, const Points& x) {
    Parts& p = *parts_;
    const int nodes = static_cast<int>(x.rows()), size = p.grid.size();
    // Relative to one node, because single precision has few digits.
    for (int axis = 0; axis < 3; ++axis) {
        float* const to = p.positions[static_cast<std::size_t>(axis)].data();
        const double* const from = x.data() + axis;
        for (int i = 0; i < nodes; ++i) to[i] = static_cast<float>(from[3L * i] - from[0]);
    }

    // C at the present positions
    int corner[8];
    for (int v = 0; v < 8; ++v) corner[v] = p.grid.corner(v);
    for (int c = 0; c < size; c += 8) {
        Rows8 at[8], gradient[8];
        for (int v = 0; v < 8; ++v) at[v] = load_rows(p.positions, c + corner[v]);
        volume_gradient(at, gradient);
        const Lanes8 exists = load8(p.exists.data() + c);
        for (int v = 0; v < 8; ++v) store_rows(p.gradient[v], c, exists * gradient[v]);
    }

    // C d^-1 C^T: corner v of a cell is corner w of its neighbour.
    const float* const inverse = p.inverse.data();
    for (int c = 0; c < size; c += 8) {
        Rows8 weighed[8];
        Lanes8 diagonal{};
        for (int v = 0; v < 8; ++v) {
            const Rows8 own = load_rows(p.gradient[v], c);
            weighed[v] = load8(inverse + c + corner[v]) * own;
            diagonal += dot(weighed[v], own);
        }
        store8(p.pressure.diagonal().data() + c, diagonal);
        for (int q = 0; q < 13; ++q) {
            const int* const away = detail::kBehind[q];
            const int there = c + p.grid.distance(away[0], away[1], away[2]);
            Lanes8 sum{};
            for (int v = 0; v < 8; ++v) {
                const int i = (v >> 2 & 1) - away[0], j = (v >> 1 & 1) - away[1],
                          k = (v & 1) - away[2];
                if ((i | j | k) & ~1) continue;
                sum += dot(weighed[v], load_rows(p.gradient[4 * i + 2 * j + k], there));
            }
            store8(p.pressure.behind(q).data() + c, sum);
        }
    }
    p.pressure.refresh(p.compliance);
}

void CellPreconditioner::apply(const Points& b, Points& x) const {
    Parts& p = *parts_;
    const int nodes = static_cast<int>(b.rows()), size = p.grid.size();
    x.resize(b.rows(), 3);
    // Scaled so that single precision neither overflows nor underflows.
    const double largest = b.cwiseAbs().maxCoeff();
    if (!(largest > 0)) {
        x.setZero();
        return;
    }
    const double scale = 1.0 / largest;
    const float* const inverse = p.inverse.data();
    for (int axis = 0; axis < 3; ++axis) {
        float* const to = p.y[static_cast<std::size_t>(axis)].data();
        const double* const from = b.data() + axis;
        for (int i = 0; i < nodes; ++i)
            to[i] = inverse[i] * static_cast<float>(scale * from[3L * i]);
    }
    int corner[8];
    for (int v = 0; v < 8; ++v) corner[v] = p.grid.corner(v);
    for (int c = 0; c < size; c += 8) {
        Lanes8 sum{};
        for (int v = 0; v < 8; ++v)
            sum += dot(load_rows(p.gradient[v], c), load_rows(p.y, c + corner[v]));
        store8(p.t.data() + c, sum);
    }
    p.pressure.solve(p.t, p.options.degree, p.q);
    for (int i = 0; i < size; i += 8) {
        Rows8 force{};
        for (int v = 0; v < 8; ++v) {
            const int cell = i - corner[v];
            force = force + load8(p.q.data() + cell) * load_rows(p.gradient[v], cell);
        }
        store_rows(p.y, i, load_rows(p.y, i) - load8(inverse + i) * force);
    }
    for (int axis = 0; axis < 3; ++axis) {
        const float* const from = p.y[static_cast<std::size_t>(axis)].data();
        double* const to = x.data() + axis;
        for (int i = 0; i < nodes; ++i) to[3L * i] = largest * static_cast<double>(from[i]);
    }
}

int CellPreconditioner::level_count() const { return parts_->pressure.level_count(); }

}  // namespace risorius::tissue
