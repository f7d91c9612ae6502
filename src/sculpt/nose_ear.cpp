// Nasal wing with nostril, and ear: lofts through the edge loops of the design tables.
#include <cmath>

#include "core/error.h"
#include "sculpt/skin.h"

namespace risorius::sculpt {
namespace {

std::vector<Vec3> loop_points(const std::map<std::string, std::vector<LoopPoint>>& loops,
                              const std::string& name, int count,
                              const std::function<double(double)>& place) {
    const auto found = loops.find(name);
    if (found == loops.end()) throw Error("design loops", "a loop named " + name, "none");
    std::vector<std::pair<double, Vec3>> through;
    for (const LoopPoint& p : found->second) through.emplace_back(place(p.place), p.point);
    return curve_points(through, count, true);
}

}  // namespace

void add_nasal_wing(Skin& skin, const std::vector<int>& block, const DesignTables& tables) {
    constexpr int kRows = 8, kAcross = 6, kLoop = 2 * (kRows + kAcross);
    HalfMesh& mesh = skin.mesh;
    const auto named = [&](const char* name) {
        return loop_points(tables.nose_loops, name, kLoop, [](double p) { return p; });
    };
    const std::vector<Vec3> crease = named("crease"), wing = named("wing"), edge = named("edge"),
                            rim = named("rim");
    std::vector<int> previous = block;
    const auto ring = [&](const std::vector<Vec3>& points, Hold hold) {
        std::vector<int> ids;
        for (const Vec3& p : points) ids.push_back(mesh.add(p, hold));
        mesh.bridge(previous, ids, true);
        previous = ids;
    };
    const auto between = [&](const std::vector<Vec3>& before, const std::vector<Vec3>& a,
                             const std::vector<Vec3>& b, const std::vector<Vec3>& after) {
        std::vector<Vec3> points;
        for (int k = 0; k < kLoop; ++k)
            points.push_back((9 * (a[k] + b[k]) - before[k] - after[k]) / 16);
        return points;
    };
    std::vector<Vec3> halfway;
    for (int k = 0; k < kLoop; ++k)
        halfway.push_back(0.5 * (mesh.point[static_cast<std::size_t>(block[k])] + crease[k]));
    ring(halfway, Hold::kSmooth);
    ring(crease, Hold::kPinned);
    ring(between(halfway, crease, wing, edge), Hold::kSmooth);
    ring(wing, Hold::kPinned);
    ring(between(crease, wing, edge, rim), Hold::kSmooth);
    ring(edge, Hold::kPinned);
    ring(rim, Hold::kPinned);
    const std::size_t inner = mesh.point.size() - kLoop;
    // The vestibule goes back and up from the rim, so that who looks in from the front looks into depth.
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : rim) centre += p / kLoop;
    const struct {
        double width;
        Vec3 shift;
    } kInside[] = {{0.92, Vec3(0, 0.9, -0.8)},
                   {0.98, Vec3(0, 3, -3.4)},
                   {0.9, Vec3(-0.4, 6, -7.5)},
                   {0.6, Vec3(-1.0, 9.5, -13)}};
    for (const auto& inside : kInside) {
        std::vector<Vec3> points;
        for (const Vec3& p : rim)
            points.push_back(centre + inside.width * (p - centre) + inside.shift);
        ring(points, Hold::kPinned);
    }
    mesh.fill(previous, kRows, kAcross, Hold::kPinned);
    for (std::size_t v = inner; v < mesh.point.size(); ++v)
        skin.fixed.push_back(static_cast<int>(v));
}

void add_ear(Skin& skin, const std::vector<int>& block, const DesignTables& tables,
             const HeadSurface& head) {
    constexpr int kRows = 20, kAcross = 6, kLoop = 2 * (kRows + kAcross);
    HalfMesh& mesh = skin.mesh;
    // The tables count 36 places, 12 along each long side; the mesh has 20 there.
    const auto place = [](double p) {
        if (p <= 12) return p * kRows / 12;
        if (p <= 18) return kRows + (p - 12);
        if (p <= 30) return kRows + kAcross + (p - 18) * kRows / 12;
        return 2.0 * kRows + kAcross + (p - 30);
    };
    const Vec3 origin(71, -2, -7);
    const Vec3 up = Vec3(0.05, 0.985, -0.16).normalized();
    const Vec3 back = (Vec3(0.42, 0, -0.907) - up * up.dot(Vec3(0.42, 0, -0.907))).normalized();
    const Vec3 out = back.cross(up);
    const auto named = [&](const char* name) {
        std::vector<Vec3> points = loop_points(tables.ear_loops, name, kLoop, place);
        for (Vec3& p : points) p = origin + back * p.x() + up * p.y() + out * p.z();
        return points;
    };
    std::vector<int> previous = block;
    std::vector<Vec3> last;
    for (const int v : block) last.push_back(mesh.point[static_cast<std::size_t>(v)]);
    const auto ring = [&](const std::vector<Vec3>& points, Hold hold) {
        std::vector<int> ids;
        for (const Vec3& p : points) ids.push_back(mesh.add(p, hold));
        mesh.bridge(previous, ids, true);
        previous = ids;
        last = points;
    };
    const auto halfway_to = [&](const std::vector<Vec3>& next) {
        std::vector<Vec3> points;
        for (int k = 0; k < kLoop; ++k) points.push_back(0.5 * (last[k] + next[k]));
        ring(points, Hold::kSmooth);
    };
    std::vector<Vec3> behind = named("behind");
    for (int k = kRows / 6; k <= kRows + 1; ++k) behind[k] = head.project(behind[k]);
    halfway_to(behind);
    ring(behind, Hold::kPinned);
    halfway_to(named("outer"));
    for (const char* name : {"outer", "helix", "scapha", "antihelix", "concha"})
        ring(named(name), Hold::kPinned);
    mesh.fill(previous, kRows, kAcross, Hold::kSmooth);
}

}  // namespace risorius::sculpt
