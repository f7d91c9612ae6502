#include "tissue/cell_multigrid.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "solve/block_matrix.h"
#include "tissue/detail/cell_blocks.h"

namespace risorius::tissue {

using solve::Block;
using solve::BlockMatrix;
using solve::FloatPoints;
using solve::FloatRow;

struct CellMultigrid::Level {
    CellBody body;
    Points rest_vertices;
    std::vector<char> fixed;
    std::vector<detail::CellBlockLaw> laws;  ///< one per cell
    std::unique_ptr<BlockMatrix> matrix;
    std::vector<std::array<std::int32_t, 64>>
        plain_slots;  ///< of cells without hanging corners, v < w
    std::vector<int> plain_cells;
    struct HangingCell {
        int cell;
        CellMesh::Support support;
        std::vector<std::int32_t> slots;  ///< count x count, where node i < node j
    };
    std::vector<HangingCell> hanging_cells;
    std::vector<float> diagonal;  ///< M/h^2 and the other terms, per node

    // Interpolation from the next level: rows of this one
    std::vector<std::int32_t> weight_begin, weight_node;
    std::vector<float> weight;
    Points to_coarse_x;  ///< scratch: positions on the next level

    // Coarsest level
    std::vector<int> free_nodes;
    Eigen::LLT<Eigen::MatrixXf> direct;

    mutable FloatPoints b, x, r;
    Points positions;  ///< of vertices

    explicit Level(CellBody of) : body(std::move(of)) {}
};

namespace {

void add_to(Block& to, const Block& block) {
    for (int c = 0; c < 3; ++c) to.column[c] += block.column[c];
}

Block transposed(const Block& block) {
    Block out{};
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) out.column[r][c] = block.column[c][r];
    return out;
}

}  // namespace

CellMesh coarser(const CellMesh& mesh) {
    std::vector<CellPlace> cells;
    if (mesh.deepest_level() > 0) {
        for (const CellMesh::Cell& cell : mesh.cells()) {
            CellPlace place = cell.place;
            if (place.level == mesh.deepest_level()) {
                --place.level;
                for (int& at : place.at) at /= 2;
            }
            cells.push_back(place);
        }
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        return {mesh.root(), std::move(cells)};
    }
    const auto halved = [](int nodes) { return std::max(nodes / 2 + 1, 2); };
    const GridShape& root = mesh.root();
    return uniform_cells({halved(root.m), halved(root.n), halved(root.o)});
}

CellBody coarsened(const CellBody& body, const CellMesh& mesh) {
    CellBody coarse{mesh, {}, {}, {}, {}, {}};
    Points rest(body.mesh.vertex_count(), 3);
    rest.topRows(body.rest.rows()) = body.rest;
    body.mesh.spread(rest);
    coarse.rest.resize(mesh.node_count(), 3);
    for (int i = 0; i < mesh.node_count(); ++i)
        coarse.rest.row(i) =
            body.mesh.interpolate(rest, mesh.material_coordinates().row(i).transpose()).transpose();
    for (const CellMesh::Cell& cell : mesh.cells()) {
        CellParameters parameters;
        CellModuli moduli;
        for (int g = 0; g < 8; ++g) {
            const Vec3 s((g & 4) ? 0.75 : 0.25, (g & 2) ? 0.75 : 0.25, (g & 1) ? 0.75 : 0.25);
            const auto fine =
                static_cast<std::size_t>(body.mesh.cell_at(cell.low + s.cwiseProduct(cell.size)));
            if (body.moduli.empty()) {
                parameters.elastic_n_per_m3 += 0.125 * body.parameters[fine].elastic_n_per_m3;
                parameters.damping_ns_per_m3 += 0.125 * body.parameters[fine].damping_ns_per_m3;
                parameters.incompressibility_n_per_m5 +=
                    0.125 * body.parameters[fine].incompressibility_n_per_m5;
            } else {
                moduli.mu_pa += 0.125 * body.moduli[fine].mu_pa;
                moduli.bulk_pa += 0.125 * body.moduli[fine].bulk_pa;
                moduli.viscosity_pa_s += 0.125 * body.moduli[fine].viscosity_pa_s;
            }
        }
        if (body.moduli.empty())
            coarse.parameters.push_back(parameters);
        else
            coarse.moduli.push_back(moduli);
    }
    coarse.mass_kg.setZero(mesh.node_count());
    coarse.drag_ns_per_m.setZero(mesh.node_count());
    for (int i = 0; i < body.mesh.node_count(); ++i) {
        const Vec3 a = body.mesh.material_coordinates().row(i).transpose();
        const CellMesh::Cell& cell = mesh.cells()[static_cast<std::size_t>(mesh.cell_at(a))];
        const auto corner = trilinear_weights((a - cell.low).cwiseQuotient(cell.size));
        const CellMesh::Support support = mesh.support(cell);
        for (std::size_t k = 0; k < support.node.size(); ++k) {
            double w = 0;
            for (std::size_t c = 0; c < 8; ++c)
                w += corner[c] *
                     support.weight(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k));
            coarse.mass_kg[support.node[k]] += w * body.mass_kg[i];
            coarse.drag_ns_per_m[support.node[k]] += w * body.drag_ns_per_m[i];
        }
    }
    return coarse;
}

CellMultigrid::CellMultigrid(const solve::MotionSystem& system,
                             std::shared_ptr<const CellSolid> solid, double step_s,
                             const MultigridOptions& options)
    : options_(options) {
    assert(system.size() == solid->mesh().node_count());
    const double rate_hz = 1.0 / step_s;

    // What the other terms add to single nodes
    solve::MetricBuilder others(system.size());
    for (const auto& term : system.terms())
        if (term.get() != solid.get()) term->add_metric(step_s, others);
    Eigen::VectorXd diagonal = Eigen::VectorXd(others.build({}).diagonal());
    diagonal += rate_hz * rate_hz * system.mass_kg();

    CellBody body = solid->body();
    std::vector<char> fixed = system.fixed();
    for (;;) {
        levels_.push_back(std::make_unique<Level>(std::move(body)));
        Level& level = *levels_.back();
        const CellMesh& mesh = level.body.mesh;
        level.fixed = fixed;
        level.rest_vertices.resize(mesh.vertex_count(), 3);
        level.rest_vertices.topRows(level.body.rest.rows()) = level.body.rest;
        mesh.spread(level.rest_vertices);
        level.diagonal.resize(static_cast<std::size_t>(mesh.node_count()));
        for (int i = 0; i < mesh.node_count(); ++i)
            level.diagonal[static_cast<std::size_t>(i)] = static_cast<float>(diagonal[i]);

        std::vector<std::vector<int>> cliques;
        for (const CellMesh::Cell& cell : mesh.cells()) cliques.push_back(mesh.support(cell).node);
        level.matrix = std::make_unique<BlockMatrix>(mesh.node_count(), cliques);
        // Corners and nodes ascend alike, so that blocks above the diagonal of a cell are so in the matrix
        const auto slot = [&](int i, int j) {
            return i >= j ? level.matrix->spare_slot()
                   : fixed[static_cast<std::size_t>(i)] || fixed[static_cast<std::size_t>(j)]
                       ? level.matrix->spare_slot()
                       : level.matrix->slot(i, j);
        };
        for (int c = 0; c < static_cast<int>(mesh.cells().size()); ++c) {
            const CellMesh::Cell& cell = mesh.cells()[static_cast<std::size_t>(c)];
            level.laws.push_back(
                detail::cell_block_law(level.body, c, level.rest_vertices, rate_hz));
            CellMesh::Support support = mesh.support(cell);
            if (support.plain) {
                level.plain_cells.push_back(c);
                auto& slots = level.plain_slots.emplace_back();
                for (std::size_t v = 0; v < 8; ++v)
                    for (std::size_t w = 0; w < 8; ++w)
                        slots[8 * v + w] = slot(cell.vertex[v], cell.vertex[w]);
            } else {
                std::vector<std::int32_t> slots;
                for (const int i : support.node)
                    for (const int j : support.node) slots.push_back(slot(i, j));
                level.hanging_cells.push_back({c, std::move(support), std::move(slots)});
            }
        }
        const bool smallest = mesh.root().m <= 3 && mesh.root().n <= 3 && mesh.root().o <= 3 &&
                              mesh.deepest_level() == 0;
        if (mesh.node_count() <= options.coarsest_nodes || smallest) {
            for (int i = 0; i < mesh.node_count(); ++i)
                if (!fixed[static_cast<std::size_t>(i)]) level.free_nodes.push_back(i);
            break;
        }

        // The next level, and the way from it
        const CellMesh next = coarser(mesh);
        body = coarsened(level.body, next);
        Eigen::VectorXd coarse_diagonal = Eigen::VectorXd::Zero(next.node_count());
        Eigen::VectorXd share = coarse_diagonal, fixed_share = coarse_diagonal;
        level.weight_begin.push_back(0);
        for (int i = 0; i < mesh.node_count(); ++i) {
            const Vec3 a = mesh.material_coordinates().row(i).transpose();
            const CellMesh::Cell& cell = next.cells()[static_cast<std::size_t>(next.cell_at(a))];
            const auto corner = trilinear_weights((a - cell.low).cwiseQuotient(cell.size));
            const CellMesh::Support support = next.support(cell);
            for (std::size_t k = 0; k < support.node.size(); ++k) {
                double w = 0;
                for (std::size_t c = 0; c < 8; ++c)
                    w += corner[c] *
                         support.weight(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k));
                if (std::abs(w) < 1e-9) continue;
                share[support.node[k]] += w;
                if (fixed[static_cast<std::size_t>(i)]) {
                    fixed_share[support.node[k]] += w;
                    continue;
                }
                coarse_diagonal[support.node[k]] += w * diagonal[i];
                level.weight_node.push_back(support.node[k]);
                level.weight.push_back(static_cast<float>(w));
            }
            level.weight_begin.push_back(static_cast<std::int32_t>(level.weight.size()));
        }
        // A coarse node is held where most of what it stands for is
        fixed.assign(static_cast<std::size_t>(next.node_count()), 0);
        for (int i = 0; i < next.node_count(); ++i)
            fixed[static_cast<std::size_t>(i)] = fixed_share[i] >= 0.5 * share[i];
        for (std::size_t k = 0; k < level.weight.size(); ++k)
            if (fixed[static_cast<std::size_t>(level.weight_node[k])]) level.weight[k] = 0;
        diagonal = coarse_diagonal;
    }
}

CellMultigrid::~CellMultigrid() = default;

void CellMultigrid::refresh(const solve::ImplicitStep& /*step*/, const Points& x) {
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = *levels_[l];
        const CellMesh& mesh = level.body.mesh;
        level.positions.resize(mesh.vertex_count(), 3);
        if (l == 0) {
            level.positions.topRows(mesh.node_count()) = x;
        } else {
            const Level& finer = *levels_[l - 1];
            for (int i = 0; i < mesh.node_count(); ++i)
                level.positions.row(i) =
                    finer.body.mesh
                        .interpolate(finer.positions,
                                     mesh.material_coordinates().row(i).transpose())
                        .transpose();
        }
        mesh.spread(level.positions);

        BlockMatrix& matrix = *level.matrix;
        matrix.set_zero();
        Block blocks[64];
        for (std::size_t k = 0; k < level.plain_cells.size(); ++k) {
            const auto c = static_cast<std::size_t>(level.plain_cells[k]);
            detail::cell_blocks(level.laws[c], mesh.cells()[c], level.positions, blocks);
            const auto& slots = level.plain_slots[k];
            for (std::size_t v = 0; v < 8; ++v) {
                add_to(matrix.diagonal(mesh.cells()[c].vertex[v]), blocks[9 * v]);
                for (std::size_t w = v + 1; w < 8; ++w)
                    matrix.add(slots[8 * v + w], blocks[8 * v + w]);
            }
        }
        for (const Level::HangingCell& hanging : level.hanging_cells) {
            const auto c = static_cast<std::size_t>(hanging.cell);
            detail::cell_blocks(level.laws[c], mesh.cells()[c], level.positions, blocks);
            const std::size_t count = hanging.support.node.size();
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < count; ++j) {
                    if (hanging.support.node[i] > hanging.support.node[j]) continue;
                    Block sum{};
                    for (int v = 0; v < 8; ++v)
                        for (int w = 0; w < 8; ++w) {
                            const double both =
                                hanging.support.weight(v, static_cast<Eigen::Index>(i)) *
                                hanging.support.weight(w, static_cast<Eigen::Index>(j));
                            if (both == 0) continue;
                            const Block part =
                                v <= w ? blocks[8 * v + w] : transposed(blocks[8 * w + v]);
                            for (int column = 0; column < 3; ++column)
                                sum.column[column] +=
                                    static_cast<float>(both) * part.column[column];
                        }
                    if (i == j)
                        add_to(matrix.diagonal(hanging.support.node[i]), sum);
                    else
                        matrix.add(hanging.slots[i * count + j], sum);
                }
        }
        for (int i = 0; i < mesh.node_count(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            Block& block = matrix.diagonal(i);
            if (level.fixed[at]) block = Block{};
            const float add = level.fixed[at] ? 1.0f : level.diagonal[at];
            for (int k = 0; k < 3; ++k) block.column[k][k] += add;
        }
        if (l + 1 < levels_.size()) {
            matrix.finish();
            continue;
        }
        const auto free = static_cast<Eigen::Index>(level.free_nodes.size());
        Eigen::MatrixXf dense = Eigen::MatrixXf::Zero(3 * free, 3 * free);
        for (Eigen::Index i = 0; i < free; ++i)
            for (Eigen::Index j = 0; j <= i; ++j) {
                const int row = level.free_nodes[static_cast<std::size_t>(i)];
                const int column = level.free_nodes[static_cast<std::size_t>(j)];
                const int at = i == j ? 0 : matrix.slot(column, row);
                if (at < 0) continue;
                // block (column, row) lies above the diagonal, dense below it
                const Block block = i == j ? matrix.diagonal(row) : transposed(matrix.block(at));
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) dense(3 * i + r, 3 * j + c) = block.column[c][r];
            }
        level.direct.compute(dense);
    }
}

// x of the level becomes its cycle's answer to b of the level.
void CellMultigrid::cycle(std::size_t l) const {
    const Level& level = *levels_[l];
    if (l + 1 == levels_.size()) {
        const auto free = static_cast<Eigen::Index>(level.free_nodes.size());
        Eigen::VectorXf v(3 * free);
        for (Eigen::Index i = 0; i < free; ++i)
            for (int k = 0; k < 3; ++k)
                v[3 * i + k] =
                    level.b[static_cast<std::size_t>(level.free_nodes[static_cast<std::size_t>(i)])]
                           [k];
        level.direct.solveInPlace(v);
        level.x.assign(level.b.size(), FloatRow{});
        for (Eigen::Index i = 0; i < free; ++i)
            level.x[static_cast<std::size_t>(level.free_nodes[static_cast<std::size_t>(i)])] =
                FloatRow{v[3 * i], v[3 * i + 1], v[3 * i + 2], 0};
        return;
    }
    const BlockMatrix& matrix = *level.matrix;
    matrix.forward_from_zero(level.b, level.x, level.r);
    for (int s = 1; s < options_.sweeps; ++s) matrix.forward(level.b, level.x, level.r);
    const Level& next = *levels_[l + 1];
    next.b.assign(static_cast<std::size_t>(next.body.mesh.node_count()), FloatRow{});
    const std::size_t n = level.b.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::int32_t k = level.weight_begin[i]; k < level.weight_begin[i + 1]; ++k) {
            const auto at = static_cast<std::size_t>(k);
            next.b[static_cast<std::size_t>(level.weight_node[at])] +=
                level.weight[at] * level.r[i];
        }
    cycle(l + 1);
    for (std::size_t i = 0; i < n; ++i) {
        FloatRow sum = level.x[i];
        for (std::int32_t k = level.weight_begin[i]; k < level.weight_begin[i + 1]; ++k) {
            const auto at = static_cast<std::size_t>(k);
            sum += level.weight[at] * next.x[static_cast<std::size_t>(level.weight_node[at])];
        }
        level.x[i] = sum;
    }
    for (int s = 0; s < options_.sweeps; ++s) matrix.backward(level.b, level.x, level.r);
}

void CellMultigrid::apply(const Points& b, Points& x) const {
    const Level& level = *levels_.front();
    const auto n = static_cast<std::size_t>(b.rows());
    // Scaled so that single precision neither overflows nor underflows
    const double largest = b.cwiseAbs().maxCoeff();
    x.resize(b.rows(), 3);
    if (!(largest > 0)) {
        x.setZero();
        return;
    }
    const double scale = 1.0 / largest;
    level.b.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double* const at = b.data() + 3 * i;
        level.b[i] = FloatRow{static_cast<float>(scale * at[0]), static_cast<float>(scale * at[1]),
                              static_cast<float>(scale * at[2]), 0};
    }
    cycle(0);
    for (std::size_t i = 0; i < n; ++i) {
        double* const at = x.data() + 3 * i;
        for (int k = 0; k < 3; ++k) at[k] = largest * static_cast<double>(level.x[i][k]);
    }
    for (std::size_t i = 0; i < n; ++i)
        if (level.fixed[i]) x.row(static_cast<Eigen::Index>(i)).setZero();
}

int CellMultigrid::level_count() const { return static_cast<int>(levels_.size()); }

double CellMultigrid::apply_flops() const {
    double sum = 0;
    for (const auto& level : levels_) {
        if (!level->free_nodes.empty()) {
            const double n = 3.0 * static_cast<double>(level->free_nodes.size());
            sum += 2 * n * n;
        } else {
            sum += 18.0 * 4 * options_.sweeps * static_cast<double>(level->matrix->block_count());
        }
    }
    return sum;
}

double CellMultigrid::refresh_flops() const {
    double sum = 0;
    for (const auto& level : levels_) {
        sum += detail::kCellBlockFlops * static_cast<double>(level->laws.size());
        const double n = 3.0 * static_cast<double>(level->free_nodes.size());
        sum += n * n * n / 3;
    }
    return sum;
}

}  // namespace risorius::tissue
