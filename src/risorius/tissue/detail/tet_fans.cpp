// SPDX-License-Identifier: MIT
#include "risorius/tissue/detail/tet_fans.h"

#include <algorithm>
#include <cstdlib>
#include <unordered_map>

#include "risorius/core/counter_rng.h"

namespace risorius::tissue {

namespace {

constexpr int kPairs[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

struct Face {
    std::array<int, 3> nodes;  // ascending
    bool operator==(const Face&) const = default;
};
struct FaceHash {
    std::size_t operator()(const Face& face) const {
        CounterRng mixed;
        for (int node : face.nodes) mixed.at(static_cast<std::uint64_t>(node));
        return static_cast<std::size_t>(mixed.bits());
    }
};

Face face_of(int a, int b, int c) {
    Face face{{a, b, c}};
    std::sort(face.nodes.begin(), face.nodes.end());
    return face;
}

// The tets of each face, at most two.
class FaceNeighbours {
  public:
    explicit FaceNeighbours(const Tets& tets) : tets_(tets) {
        for (int t = 0; t < static_cast<int>(tets.rows()); ++t)
            for (int k = 0; k < 4; ++k) {
                auto& pair = of_[face_of(tets(t, k), tets(t, (k + 1) % 4), tets(t, (k + 2) % 4))];
                if (pair[0] < 0)
                    pair[0] = t;
                else if (pair[1] < 0)
                    pair[1] = t;
            }
    }
    int across(int tet, const Face& face) const {
        const std::array<int, 2>& pair = of_.at(face).tets;
        return pair[0] == tet ? pair[1] : pair[0];
    }
    // The node of a tet that is not on the given face of it.
    int opposite(int tet, const Face& face) const {
        for (int k = 0; k < 4; ++k)
            if (std::find(face.nodes.begin(), face.nodes.end(), tets_(tet, k)) == face.nodes.end())
                return tets_(tet, k);
        return -1;
    }

  private:
    struct Pair {
        std::array<int, 2> tets{-1, -1};
        int& operator[](std::size_t i) { return tets[i]; }
    };
    const Tets& tets_;
    std::unordered_map<Face, Pair, FaceHash> of_;
};

}  // namespace

TetFans find_fans(const Tets& tets) {
    const FaceNeighbours neighbours(tets);
    struct Candidate {
        int apart;  // sum of the differences of tet numbers
        TetFan fan;
    };
    std::vector<Candidate> candidates;
    for (int middle = 0; middle < static_cast<int>(tets.rows()); ++middle)
        for (const auto& pair : kPairs) {
            const int a = tets(middle, pair[0]), b = tets(middle, pair[1]);
            std::array<int, 2> ring;
            int found = 0;
            for (int k = 0; k < 4; ++k)
                if (tets(middle, k) != a && tets(middle, k) != b) ring[found++] = tets(middle, k);
            const Face first = face_of(a, b, ring[0]), last = face_of(a, b, ring[1]);
            const int before = neighbours.across(middle, first),
                      after = neighbours.across(middle, last);
            if (before < 0 || after < 0) continue;
            const int begin = neighbours.opposite(before, first),
                      end = neighbours.opposite(after, last);
            if (begin == end) continue;  // the ring is closed: not a fan
            candidates.push_back({std::abs(before - middle) + std::abs(after - middle),
                                  {{before, middle, after}, {a, b, begin, ring[0], ring[1], end}}});
        }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& x, const Candidate& y) { return x.apart < y.apart; });
    std::vector<char> taken(static_cast<std::size_t>(tets.rows()), 0);
    TetFans out;
    for (const Candidate& candidate : candidates) {
        const auto& three = candidate.fan.tets;
        if (taken[three[0]] || taken[three[1]] || taken[three[2]]) continue;
        for (int tet : three) taken[tet] = 1;
        out.fans.push_back(candidate.fan);
    }
    std::sort(out.fans.begin(), out.fans.end(),
              [](const TetFan& x, const TetFan& y) { return x.tets[1] < y.tets[1]; });
    for (int t = 0; t < static_cast<int>(tets.rows()); ++t)
        if (!taken[t]) out.alone.push_back(t);
    return out;
}

}  // namespace risorius::tissue
