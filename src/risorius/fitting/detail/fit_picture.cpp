// SPDX-License-Identifier: MIT
#include "risorius/fitting/detail/fit_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "risorius/face/anatomy/inside_skin.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/shell.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/media/image_file.h"
#include "risorius/render/measure_view.h"

namespace risorius::fitting {

namespace {

using render::ColouredSurface;
using render::Mark;
using render::MarkedLine;

constexpr int kPanel_px = 560, kPanelHeight_px = 760, kCaption_px = 84;
constexpr double kSeen_m = 0.30;                // visible height on an average head
constexpr double kThin_mm = 2, kThick_mm = 24;  // ends of the colour scale
const Vec3 kGiven(0.93, 0.46, 0.05), kGuessed(0.10, 0.38, 0.88), kSeam(0.75, 0.05, 0.15),
    kLid(0.35, 0.05, 0.55), kSkin(0.86, 0.80, 0.76), kSkull(0.93, 0.88, 0.74),
    kMandible(0.62, 0.74, 0.66);

std::vector<Vec3> all_of(const Vec3& colour, long count) {
    return std::vector<Vec3>(static_cast<std::size_t>(count), colour);
}

// Surfaces of skin and eyes; teeth and other parts would be hidden.
std::vector<ColouredSurface> head_surfaces(const rig::Head& head, const geom::PolygonMesh& mesh) {
    std::vector<ColouredSurface> out;
    out.push_back({head.vertices, head.skin, all_of(kSkin, head.vertices.rows())});
    for (std::size_t g = 0; g < head.role_of_group.size(); ++g) {
        const std::string& role = head.role_of_group[g];
        if (role != "eye_l" && role != "eye_r") continue;
        const rig::EyeGeometry& eye = head.eyes[role == "eye_l" ? 0 : 1];
        std::vector<Vec3> colours;
        for (long v = 0; v < head.vertices.rows(); ++v) {
            const Vec3 r = head.vertices.row(v).transpose() - eye.centre;
            const double angle = std::atan2(r.cross(eye.forward).norm(), r.dot(eye.forward));
            colours.push_back(angle < 0.22   ? Vec3(0.05, 0.05, 0.05)
                              : angle < 0.48 ? Vec3(0.25, 0.45, 0.55)
                                             : Vec3(0.98, 0.98, 0.98));
        }
        out.push_back({head.vertices, geom::triangulate(mesh, {static_cast<int>(g)}), colours});
    }
    return out;
}

Image panel(const std::vector<ColouredSurface>& surfaces, const std::vector<Mark>& marks,
            const std::vector<MarkedLine>& lines, const rig::Head& head, double azimuth_deg) {
    // From crown to throat, estimated from the face where a head has neither.
    const double top = head.landmark("v").y(), bottom = head.landmark("me").y();
    return render::draw_measured(
        surfaces, marks, lines,
        {.width_px = kPanel_px,
         .height_px = kPanelHeight_px,
         .azimuth_deg = azimuth_deg,
         .centre = Vec3(0, 0.5 * (top + bottom) - head.mm(12),
                        azimuth_deg == 0 ? 0.0 : head.mm(azimuth_deg > 60 ? 12 : 40)),
         .height_m = std::max(head.size * kSeen_m, 1.25 * (top - bottom)),
         .marks_above_m = head.mm(5)});
}

void paste(const Image& from, int x, Image& to) {
    for (int y = 0; y < from.height_px; ++y)
        std::copy_n(from.pixel(0, y), 4 * from.width_px, to.pixel(x, y));
}

void dot(Image& image, int x, int y, const Vec3& colour) {
    for (int j = -7; j <= 7; ++j)
        for (int i = -7; i <= 7; ++i)
            if (i * i + j * j <= 49)
                for (int k = 0; k < 3; ++k)
                    image.pixel(x + i, y + j)[k] = static_cast<std::uint8_t>(255 * colour[k]);
}

std::string text_of(const char* format, double a, double b = 0, double c = 0) {
    char text[160];
    std::snprintf(text, sizeof text, format, a, b, c);
    return text;
}

}  // namespace

BoneEstimate bone_estimate(const rig::Head& head, const rig::RigDescription& rig,
                           const face::Shell& shell) {
    const std::array<face::EyeLids, 2> lids{face::EyeLids(head, 0, rig.eyes.lid_closed_fraction),
                                            face::EyeLids(head, 1, rig.eyes.lid_closed_fraction)};
    const face::Jaw jaw(head, rig.jaw);
    const face::TissueMesh tissue = face::build_tissue_mesh(head, rig, shell, lids);
    BoneEstimate out;
    const long count = static_cast<long>(shell.vertex.size());
    out.skin.resize(count, 3);
    out.bone.resize(count, 3);
    out.triangles = shell.triangles;
    for (long v = 0; v < count; ++v) {
        const int node = static_cast<int>(v);
        out.skin.row(v) = tissue.nodes.row(face::node_of(node, face::kSkin));
        out.bone.row(v) = tissue.nodes.row(face::node_of(node, face::kDeep));
        out.thickness_m.push_back((out.skin.row(v) - out.bone.row(v)).norm());
        out.jaw_fraction.push_back(jaw.weight(out.bone.row(v).transpose(),
                                              shell.over_bite_m[static_cast<std::size_t>(v)]));
    }
    return out;
}

BoneFigures bone_figures(const BoneEstimate& bone) {
    BoneFigures out;
    out.thinnest_mm = 1e9;
    for (const double thickness : bone.thickness_m) {
        out.thinnest_mm = std::min(out.thinnest_mm, 1e3 * thickness);
        out.thickest_mm = std::max(out.thickest_mm, 1e3 * thickness);
        out.mean_mm += 1e3 * thickness / static_cast<double>(bone.thickness_m.size());
    }
    const face::InsideSkin skin(bone.skin, bone.triangles);
    for (long v = 0; v < bone.bone.rows(); ++v)
        out.through_skin += skin.outside(bone.bone.row(v).transpose());
    return out;
}

Image fit_picture(const rig::Head& head, const BoneEstimate& bone, const rig::RigDescription& rig,
                  const geom::PolygonMesh& mesh) {
    const std::vector<ColouredSurface> whole = head_surfaces(head, mesh);

    // Given landmarks, estimated landmarks, and the structures made from them
    std::vector<Mark> marks;
    int guessed = 0;
    for (const auto& [id, at] : head.landmarks) {
        const bool given = rig.landmarks.count(id) > 0;
        guessed += !given;
        marks.push_back({at, given ? kGiven : kGuessed, given ? 4.0 : 3.5, !given});
    }
    std::vector<MarkedLine> lines{{face::lip_line(head), kSeam, 2.5}};
    for (int side = 0; side < 2; ++side) {
        const face::EyeLids lids(head, side, rig.eyes.lid_closed_fraction);
        lines.push_back({lids.upper_margin(), kLid, 2});
        lines.push_back({lids.lower_margin(), kLid, 2});
    }

    // Thickness as colour on the moving skin, with the rest of the head pale behind it
    ColouredSurface thickness{bone.skin, bone.triangles, {}};
    for (const double t : bone.thickness_m)
        thickness.colours.push_back(
            render::scale_colour((1e3 * t / head.size - kThin_mm) / (kThick_mm - kThin_mm)));
    Points behind = head.vertices;
    // Moved back, so that the coloured surface shows where the two coincide
    behind.col(2).array() -= head.mm(3);
    const std::vector<ColouredSurface> map{
        {behind, head.skin, all_of(Vec3(0.93, 0.93, 0.93), behind.rows())}, thickness};

    // Bone with skin over it
    ColouredSurface bones{bone.bone, bone.triangles, {}};
    for (const double fraction : bone.jaw_fraction)
        bones.colours.push_back((1 - fraction) * kSkull + fraction * kMandible);
    ColouredSurface veil{head.vertices, head.skin, all_of(kSkin, head.vertices.rows()), 0.28};

    Image image(4 * kPanel_px, kPanelHeight_px + kCaption_px);
    std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{255});
    paste(panel(whole, marks, lines, head, 0), 0, image);
    paste(panel(whole, marks, lines, head, 90), kPanel_px, image);
    paste(panel(map, {}, {}, head, 0), 2 * kPanel_px, image);
    paste(panel({bones, veil}, {}, {}, head, 40), 3 * kPanel_px, image);

    // Captions
    constexpr int kText_px = 13, kLine1 = kPanelHeight_px + 28, kLine2 = kPanelHeight_px + 62;
    dot(image, 24, kLine1 - 6, kGiven);
    media::put_text(image,
                    text_of("%.0f landmarks given", static_cast<double>(rig.landmarks.size())), 42,
                    kLine1, kText_px);
    dot(image, 24, kLine2 - 6, kGuessed);
    media::put_text(image, text_of("%.0f placed by the atlas", guessed), 42, kLine2, kText_px);
    dot(image, kPanel_px + 24, kLine1 - 6, kSeam);
    media::put_text(image, "between the lips", kPanel_px + 42, kLine1, kText_px);
    dot(image, kPanel_px + 24, kLine2 - 6, kLid);
    media::put_text(image, "margins of the lids", kPanel_px + 42, kLine2, kText_px);
    const int bar = 2 * kPanel_px + 24;
    for (int x = 0; x < 400; ++x)
        for (int y = kLine2 - 14; y < kLine2; ++y)
            for (int k = 0; k < 3; ++k)
                image.pixel(bar + x, y)[k] =
                    static_cast<std::uint8_t>(255 * render::scale_colour(x / 399.0)[k]);
    media::put_text(image,
                    text_of("thickness of tissue, %.0f to %.0f mm", kThin_mm * head.size,
                            kThick_mm * head.size),
                    bar, kLine1, kText_px);
    dot(image, 3 * kPanel_px + 24, kLine1 - 6, kSkull);
    media::put_text(image, "skull, as estimated", 3 * kPanel_px + 42, kLine1, kText_px);
    dot(image, 3 * kPanel_px + 24, kLine2 - 6, kMandible);
    media::put_text(image, "mandible", 3 * kPanel_px + 42, kLine2, kText_px);
    return image;
}

}  // namespace risorius::fitting
