#include "solve/laplacian.h"

#include <cassert>

namespace risorius::solve {

Laplacian::Laplacian(const Eigen::SparseMatrix<double>& lower) {
    const long n = lower.rows();
    std::vector<std::vector<Neighbour>> of(static_cast<std::size_t>(n));
    for (long j = 0; j < n; ++j)
        for (Eigen::SparseMatrix<double>::InnerIterator it(lower, j); it; ++it) {
            if (it.row() <= j) continue;
            const auto value = static_cast<float>(it.value());
            of[static_cast<std::size_t>(j)].push_back({static_cast<std::int32_t>(it.row()), value});
            of[static_cast<std::size_t>(it.row())].push_back({static_cast<std::int32_t>(j), value});
        }
    for (const auto& neighbours : of) {
        neighbours_.insert(neighbours_.end(), neighbours.begin(), neighbours.end());
        begin_.push_back(static_cast<std::int32_t>(neighbours_.size()));
    }
}

double Laplacian::pull(double scale, const Points& x, const Points& y, Points& gradient) const {
    const auto n = static_cast<long>(begin_.size()) - 1;
    assert(x.rows() == n && y.rows() == n);
    gradient.resize(n, 3);
    moved_.copy_difference(x, y);
    double twice = 0;
    double* to = gradient.data();
    for (long i = 0; i < n; ++i, to += 3) {
        const FloatPoint own = moved_[static_cast<int>(i)];
        FloatPoint sum{};
        for (std::int32_t k = begin_[static_cast<std::size_t>(i)];
             k < begin_[static_cast<std::size_t>(i) + 1]; ++k) {
            const Neighbour& other = neighbours_[static_cast<std::size_t>(k)];
            sum += other.value * (moved_[other.row] - own);
        }
        const FloatPoint product = own * sum;
        twice += static_cast<double>(product[0] + product[1] + product[2]);
        for (int c = 0; c < 3; ++c) to[c] = scale * static_cast<double>(sum[c]);
    }
    return 0.5 * scale * twice;
}

}  // namespace risorius::solve
