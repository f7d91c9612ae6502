// SPDX-License-Identifier: MIT
#include "risorius/render/detail/face_order.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace risorius::render {
namespace {

constexpr std::size_t kCluster = 320;  ///< triangles drawn together

Vec3 corner(const Points& rest, const Face& face, std::size_t k) {
    return rest.row(face[k]).transpose();
}

Vec3 middle(const Points& rest, const Face& face) {
    return (corner(rest, face, 0) + corner(rest, face, 1) + corner(rest, face, 2)) / 3;
}

/// Position on a space-filling curve: interleaves the bits of the three coordinates (Morton 1966).
std::uint64_t curve_place(const Vec3& unit) {
    std::uint64_t place = 0;
    for (int bit = 9; bit >= 0; --bit)
        for (int k = 0; k < 3; ++k)
            place = place << 1 | (static_cast<std::uint64_t>(unit[k] * 1023) >> bit & 1);
    return place;
}

}  // namespace

void wind_outwards(const Points& rest, std::vector<Face>& faces) {
    // Components: vertices that are connected by triangles
    std::vector<int> root(static_cast<std::size_t>(rest.rows()));
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
        while (root[static_cast<std::size_t>(v)] != v)
            v = root[static_cast<std::size_t>(v)] =
                root[static_cast<std::size_t>(root[static_cast<std::size_t>(v)])];
        return v;
    };
    for (const Face& face : faces)
        for (const int v : {face[1], face[2]}) {
            const int a = find(face[0]), b = find(v);
            root[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
        }
    std::vector<double> volume(root.size(), 0.0);
    for (const Face& face : faces) {
        const int piece = find(face[0]);
        // The origin lies on the component itself, so that an open component is judged by its own bulge.
        const Vec3 origin = rest.row(piece).transpose();
        volume[static_cast<std::size_t>(piece)] +=
            (corner(rest, face, 0) - origin)
                .dot((corner(rest, face, 1) - origin).cross(corner(rest, face, 2) - origin));
    }
    for (Face& face : faces)
        if (volume[static_cast<std::size_t>(find(face[0]))] < 0) std::swap(face[1], face[2]);
}

bool is_wound_outwards(const Points& rest, const std::vector<Face>& faces, const Vec3& inside) {
    double outwards = 0;
    for (const Face& face : faces) {
        const Vec3 a = corner(rest, face, 0);
        const Vec3 area = (corner(rest, face, 1) - a).cross(corner(rest, face, 2) - a);
        outwards += area.dot((a - inside).normalized());
    }
    return outwards > 0;
}

void order_for_drawing(const Points& rest, const Vec3& camera, std::vector<Face>& faces) {
    if (faces.empty()) return;
    std::vector<Vec3> middles;
    Vec3 low = Vec3::Constant(1e9), high = Vec3::Constant(-1e9);
    for (const Face& face : faces) {
        middles.push_back(middle(rest, face));
        low = low.cwiseMin(middles.back());
        high = high.cwiseMax(middles.back());
    }
    const Vec3 size = (high - low).cwiseMax(1e-9);
    std::vector<std::uint64_t> place;
    for (const Vec3& m : middles) place.push_back(curve_place((m - low).cwiseQuotient(size)));
    std::vector<std::size_t> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });

    struct Cluster {
        std::size_t begin, end;
        double distance;
    };
    std::vector<Cluster> clusters;
    for (std::size_t begin = 0; begin < order.size(); begin += kCluster) {
        const std::size_t end = std::min(begin + kCluster, order.size());
        Vec3 mean = Vec3::Zero();
        for (std::size_t i = begin; i < end; ++i) mean += middles[order[i]];
        mean /= static_cast<double>(end - begin);
        clusters.push_back({begin, end, (mean - camera).norm()});
    }
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const Cluster& a, const Cluster& b) { return a.distance < b.distance; });
    std::vector<Face> ordered;
    ordered.reserve(faces.size());
    for (const Cluster& cluster : clusters)
        for (std::size_t i = cluster.begin; i < cluster.end; ++i)
            ordered.push_back(faces[order[i]]);
    faces.swap(ordered);
}

}  // namespace risorius::render
