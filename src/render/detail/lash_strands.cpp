#include "render/detail/lash_strands.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <set>

namespace risorius::render {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Vertices of all surfaces of a material, ascending.
std::vector<int> vertices_of(const Scene& scene, Material material) {
    std::vector<int> vertices;
    for (const Surface& surface : scene.surfaces)
        if (surface.material == material)
            vertices.insert(vertices.end(), surface.triangles.data(),
                            surface.triangles.data() + surface.triangles.size());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

}  // namespace

std::vector<LashPlace> lash_places(const Scene& scene) {
    std::vector<LashPlace> places(static_cast<std::size_t>(scene.rest.rows()));
    const std::vector<int> lash = vertices_of(scene, Material::kLashes);
    const std::vector<int> skin = vertices_of(scene, Material::kSkin);
    if (lash.empty() || skin.empty()) return places;
    const auto local = [&](int v) {
        return static_cast<std::size_t>(std::lower_bound(lash.begin(), lash.end(), v) -
                                        lash.begin());
    };
    const auto at = [&](std::size_t i) -> Vec3 { return scene.rest.row(lash[i]).transpose(); };

    const auto below_eye = [&](const Vec3& p) {
        const bool left = (p - scene.eyes[0].centre).norm() < (p - scene.eyes[1].centre).norm();
        return p.y() < scene.eyes[left ? 0 : 1].centre.y();
    };

    // Neighbours along edges, and how far the skin is
    std::vector<std::set<std::size_t>> next(lash.size());
    for (const Surface& surface : scene.surfaces)
        if (surface.material == Material::kLashes)
            for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
                for (int k = 0; k < 3; ++k) {
                    const std::size_t a = local(surface.triangles(f, k));
                    const std::size_t b = local(surface.triangles(f, (k + 1) % 3));
                    next[a].insert(b);
                    next[b].insert(a);
                }
    std::vector<double> to_skin(lash.size(), kFar);
    for (std::size_t i = 0; i < lash.size(); ++i)
        for (const int v : skin)
            to_skin[i] =
                std::min(to_skin[i], (scene.rest.row(v).transpose() - at(i)).squaredNorm());
    for (double& d : to_skin) d = std::sqrt(d);

    // Each ribbon by itself
    std::vector<bool> seen(lash.size(), false);
    for (std::size_t first = 0; first < lash.size(); ++first) {
        if (seen[first]) continue;
        std::vector<std::size_t> ribbon{first};
        seen[first] = true;
        for (std::size_t i = 0; i < ribbon.size(); ++i)
            for (const std::size_t j : next[ribbon[i]])
                if (!seen[j]) {
                    seen[j] = true;
                    ribbon.push_back(j);
                }
        double least = kFar, most = 0;
        for (const std::size_t i : ribbon) {
            least = std::min(least, to_skin[i]);
            most = std::max(most, to_skin[i]);
        }

        // A root is a vertex at the skin with no neighbour clearly nearer to it.
        std::vector<std::size_t> roots;
        for (const std::size_t i : ribbon) {
            const bool at_skin = to_skin[i] <= least + 0.3 * (most - least);
            const bool lowest = std::none_of(next[i].begin(), next[i].end(), [&](std::size_t j) {
                return to_skin[j] < to_skin[i] - 0.35 * (at(j) - at(i)).norm();
            });
            if (at_skin && lowest) roots.push_back(i);
        }
        if (roots.empty()) roots.push_back(ribbon.front());
        std::sort(roots.begin(), roots.end(), [&](std::size_t a, std::size_t b) {
            return at(a).x() != at(b).x() ? at(a).x() < at(b).x() : a < b;
        });
        // The two lids may be one ribbon; each is measured by itself.
        std::map<std::size_t, double> along;
        for (const bool lower : {false, true}) {
            double length = 0;
            std::optional<Vec3> last;
            for (const std::size_t r : roots) {
                if (below_eye(at(r)) != lower) continue;
                if (last) length += (at(r) - *last).norm();
                last = at(r);
                along[r] = length;
            }
        }

        // Every vertex belongs to the root it is reached from over the ribbon first.
        std::map<std::size_t, double> distance;
        std::map<std::size_t, std::size_t> root_of;
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        for (const std::size_t r : roots) {
            distance[r] = 0;
            root_of[r] = r;
            front.emplace(0.0, r);
        }
        while (!front.empty()) {
            const auto [d, i] = front.top();
            front.pop();
            if (d > distance[i]) continue;
            for (const std::size_t j : next[i]) {
                const double through = d + (at(j) - at(i)).norm();
                const auto known = distance.find(j);
                if (known != distance.end() && known->second <= through) continue;
                distance[j] = through;
                root_of[j] = root_of[i];
                front.emplace(through, j);
            }
        }
        std::map<std::size_t, double> longest;
        for (const auto& [i, d] : distance) longest[root_of[i]] = std::max(longest[root_of[i]], d);
        for (const auto& [i, d] : distance) {
            const auto v = static_cast<std::size_t>(lash[i]);
            const double reach = longest[root_of[i]];
            places[v].along_m = static_cast<float>(along[root_of[i]]);
            places[v].share = static_cast<float>(reach > 0 ? d / reach : 0.0);
            places[v].is_lash = true;
            places[v].lower_lid = below_eye(at(root_of[i]));
        }
    }
    return places;
}

}  // namespace risorius::render
