// SPDX-License-Identifier: MIT
#include "risorius/render/detail/tear_layer.h"

#include <algorithm>

#include "risorius/render/detail/shaders.h"

namespace risorius::render {
namespace {

constexpr std::size_t kTearRows = 3;  ///< on the lid, in the corner between lid and eye, on the eye

// Height of the meniscus: 0.2 to 0.3 mm in healthy eyes (Mainstone et al. 1996); it is drawn a little wider.
constexpr double kTearOntoLid_m = 0.00012, kTearOntoEye_m = 0.00038, kTearThickness_m = 0.00015;

std::vector<unsigned> tear_ribbons(const std::array<std::vector<SkinPlace>, 2>& lines) {
    std::vector<unsigned> indices;
    unsigned first = 0;
    for (const std::vector<SkinPlace>& line : lines) {
        const auto columns = static_cast<unsigned>(line.size());
        for (unsigned i = 0; i + 1 < columns; ++i)
            for (unsigned r = 0; r + 1 < kTearRows; ++r) {
                const unsigned a = first + kTearRows * i + r, b = a + kTearRows;
                indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
            }
        first += kTearRows * columns;
    }
    return indices;
}

}  // namespace

TearLayer::TearLayer(const Scene& scene, const ShaderConstants& constants)
    : lines_{plan_tear_line(scene, 0), plan_tear_line(scene, 1)},
      eyes_(scene.eyes),
      share_(scene.appearance.complexion > 0 ? 0.45 : 1),
      program_("tears", constants.in(tear_vertex_shader()), constants.in(tear_shader())),
      triangles_(tear_ribbons(lines_), {3, 3, 1}) {}  // position, normal, fraction of the light

void TearLayer::upload(const Pose& pose, const PosedMarks& marks) {
    std::vector<float> vertices = triangles_.take();
    for (std::size_t eye = 0; eye < 2; ++eye) {
        const std::vector<SkinPlace>& line = lines_[eye];
        if (line.empty()) continue;
        const LidMarks lids = marks.lids(pose, static_cast<int>(eye));
        const double shut = marks.lids_closed(pose, static_cast<int>(eye));
        const double wet = std::clamp((0.92 - shut) / 0.15, 0.0, 1.0);
        const Vec3 across = (lids.outer - lids.inner).normalized();
        const double width = (lids.outer - lids.inner).norm();

        // The search for the lid has steps of a tenth of a millimetre, so the line is smoothed.
        std::vector<Vec3> at;
        for (const SkinPlace& place : line) at.push_back(place.on(pose.positions));
        for (int round = 0; round < 3; ++round) {
            std::vector<Vec3> smooth = at;
            for (std::size_t i = 1; i + 1 < at.size(); ++i)
                smooth[i] = (at[i - 1] + 2 * at[i] + at[i + 1]) / 4;
            at = std::move(smooth);
        }
        // The centre of the eye lies behind the line between its corners by the distance between them.
        const Vec3 middle = (lids.inner + lids.outer) / 2;
        const Vec3 ahead =
            (eye == 0 ? across.cross(Vec3::UnitY()) : Vec3::UnitY().cross(across)).normalized();
        const Vec3 centre = middle - std::max(eyes_[eye].radius_m * 0.6, 0.4 * width) * ahead;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const Vec3 out = (at[i] - centre).normalized();
            const Vec3 along =
                (at[std::min(i + 1, at.size() - 1)] - at[i > 0 ? i - 1 : 0]).normalized();
            Vec3 up = eye == 0 ? out.cross(along) : along.cross(out);
            up.normalize();
            const double from_end = std::min(i, at.size() - 1 - i) / 5.0;
            const double fraction = share_ * wet * std::clamp(from_end, 0.0, 1.0);
            const Vec3 places[kTearRows] = {at[i] - kTearOntoLid_m * up,
                                            at[i] + 0.3 * kTearOntoEye_m * up,
                                            at[i] + kTearOntoEye_m * up};
            const Vec3 normals[kTearRows] = {(out + 1.6 * up).normalized(),
                                             (out + 0.55 * up).normalized(), out};
            const double fractions[kTearRows] = {0.0, fraction, 0.0};
            for (std::size_t r = 0; r < kTearRows; ++r) {
                const Vec3 p = places[r] + kTearThickness_m * out;
                for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(p[k]));
                for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(normals[r][k]));
                vertices.push_back(static_cast<float>(fractions[r]));
            }
        }
    }
    triangles_.upload(std::move(vertices));
}

void TearLayer::draw() const {
    program_.use();
    glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    triangles_.draw();
}

}  // namespace risorius::render
