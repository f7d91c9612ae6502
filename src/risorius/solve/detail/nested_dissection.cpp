// SPDX-License-Identifier: MIT
#include "risorius/solve/detail/nested_dissection.h"

#include <suitesparse/cholmod.h>

#include <mutex>
#include <stdexcept>

#include "risorius/solve/detail/cholmod_view.h"
#include "risorius/solve/detail/simplicial_panels.h"

namespace risorius::solve::detail {

namespace {

// The build for browsers has no module Supernodal (src/web_engine.cmake).
#ifdef RISORIUS_SIMPLICIAL_PANELS
constexpr bool kSupernodal = false;
#else
constexpr bool kSupernodal = true;
#endif

struct Workspace {
    cholmod_common common;
    cholmod_factor* factor = nullptr;
    Workspace() {
        cholmod_start(&common);
        common.nmethods = 1;
        common.print = 0;
    }
    ~Workspace() {
        cholmod_free_factor(&factor, &common);
        cholmod_finish(&common);
    }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
    const cholmod_factor& found() const {
        if (factor == nullptr) throw std::invalid_argument("no ordering of the matrix found");
        return *factor;
    }
};

Eigen::SparseMatrix<double> node_pattern(const Eigen::SparseMatrix<double>& A, int block) {
    const int n = static_cast<int>(A.rows()) / block;
    std::vector<Eigen::Triplet<double, int>> entries;
    entries.reserve(static_cast<std::size_t>(A.nonZeros() / (block * block) + n));
    for (int j = 0; j < n; ++j)  // the first column of a node lists all its rows
        for (Eigen::SparseMatrix<double>::InnerIterator it(A, j * block); it; ++it)
            if (it.row() % block == 0 || it.row() / block == j)
                entries.emplace_back(static_cast<int>(it.row()) / block, j, 1.0);
    Eigen::SparseMatrix<double> pattern(n, n);
    pattern.setFromTriplets(entries.begin(), entries.end());
    return pattern;
}

}  // namespace

cholmod_factor* analyse(cholmod_sparse& A, cholmod_common& common) {
    static std::mutex one_at_a_time;
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    return cholmod_analyze(&A, &common);
}

std::vector<int> nested_dissection(const Eigen::SparseMatrix<double>& A, int block) {
    Workspace work;
    work.common.supernodal = CHOLMOD_SIMPLICIAL;
    work.common.postorder = 1;
    work.common.method[0].ordering = CHOLMOD_NESDIS;
    const Eigen::SparseMatrix<double> nodes = node_pattern(A, block);
    cholmod_sparse graph = view_of(nodes);
    work.factor = analyse(graph, work.common);
    const auto* perm = static_cast<const int*>(work.found().Perm);
    std::vector<int> order(static_cast<std::size_t>(A.rows()));
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = perm[i / static_cast<std::size_t>(block)] * block +
                   static_cast<int>(i % static_cast<std::size_t>(block));
    return order;
}

PanelPattern panel_pattern(const Eigen::SparseMatrix<double>& A, const std::vector<int>& order) {
    PanelPattern out;
    out.order = order;
    Workspace work;
    work.common.supernodal = kSupernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
    work.common.postorder = 1;
    work.common.method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse view = view_of(A);
    work.factor = cholmod_analyze_p(&view, out.order.data(), nullptr, 0, &work.common);
    const cholmod_factor& L = work.found();
    const auto* perm = static_cast<const int*>(L.Perm);
    out.order.assign(perm, perm + L.n);
    if (!kSupernodal) return simplicial_panels(A, std::move(out.order));
    const auto* super = static_cast<const int*>(L.super);
    const auto* row_begin = static_cast<const int*>(L.pi);
    const auto* row = static_cast<const int*>(L.s);
    out.super.assign(super, super + L.nsuper + 1);
    out.row_begin.assign(row_begin, row_begin + L.nsuper + 1);
    out.row.assign(row, row + L.ssize);
    return out;
}

}  // namespace risorius::solve::detail
