// SPDX-License-Identifier: MIT
#include "risorius/face/solver/detail/local_term.h"

namespace risorius::face {

LocalNodes::LocalNodes(const std::vector<char>& moves) : row_(moves.size(), -1) {
    for (std::size_t i = 0; i < moves.size(); ++i)
        if (moves[i]) add(static_cast<int>(i));
    moving_ = static_cast<int>(node_.size());
}

int LocalNodes::add(int node) {
    int& row = row_[static_cast<std::size_t>(node)];
    if (row < 0) {
        row = static_cast<int>(node_.size());
        node_.push_back(node);
    }
    return row;
}

Points LocalNodes::taken(const Points& x) const {
    Points out(static_cast<long>(node_.size()), 3);
    for (long i = 0; i < out.rows(); ++i) out.row(i) = x.row(node_[static_cast<std::size_t>(i)]);
    return out;
}

}  // namespace risorius::face
