// SPDX-License-Identifier: MIT
// Pictures of a set of blend shapes: the front and three-quarter views of each, and its displacement of the skin as colour.
#include <cstdio>
#include <limits>
#include <set>

#include "risorius/blendshapes/detail/shapes_page.h"
#include "risorius/media/image_file.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/contact_sheet.h"
#include "risorius/report/folder_name.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::blendshapes {

namespace fs = std::filesystem;

namespace {

constexpr double kOnSheet = 0.42;      ///< size on the sheet, ratio to the single picture
constexpr double kMovedScale_mm = 12;  ///< end of the colour scale
constexpr const char* kShapesFolder = "pictures";

render::SkinValues moved_scale() {
    return {.name = "moved by", .unit = "mm", .from = 0, .to = kMovedScale_mm, .at = {}};
}

std::string shape_numbers(const MadeShape& made) {
    const ShapeCertificate& of = made.certificate;
    char text[128];
    std::snprintf(text, sizeof text, "%.1f mm  vol %+.2f %%  lip %.2f  eye %.2f", 1e3 * of.peak_m,
                  100 * of.volume_change, 1e3 * of.lip_depth_m, 1e3 * of.eye_depth_m);
    return text;
}

}  // namespace

ShapesPictures draw_shapes(const ShapesReport& report, const scene::RigFiles& files,
                           const rig::Head& head, const fs::path& folder,
                           const ProgressMonitor& monitor) {
    const render::Scene scene = scene::scene_from_rig(head, files.rig, files.mesh);
    ShapesPictures out;
    out.shapes.resize(report.shapes.list.size());
    fs::create_directories(folder / kShapesFolder);
    report::ContactSheet sheet;
    sheet.title = report.name + ", " + report.set;
    sheet.columns = {"from the front", "from the side", "moved by"};
    sheet.scale = moved_scale();
    std::set<std::string> taken;
    std::vector<std::string> names;
    for (const MadeShape& made : report.shapes.list) {
        names.push_back(report::folder_name(made.goal.name, taken));
        sheet.rows.push_back({made.goal.name, shape_numbers(made), {}});
    }
    const double all = 3.0 * static_cast<double>(names.size());
    double drawn = 0;
    const auto draw = [&](render::OffscreenView& view, std::size_t i, const std::string& kind,
                          bool as_colour) {
        monitor.report(drawn++ / all, "pictures of " + report.shapes.list[i].goal.name);
        const MadeShape& made = report.shapes.list[i];
        render::Pose pose;
        pose.positions = shown_pose(report.shapes, i, head.vertices);
        pose.eye_rotation = made.eye_rotation;
        if (as_colour) {
            pose.values = moved_scale();
            pose.values->at.assign(static_cast<std::size_t>(head.vertices.rows()), 0.0);
            for (std::size_t k = 0; k < made.shape.vertex.size(); ++k)
                pose.values->at[static_cast<std::size_t>(made.shape.vertex[k])] =
                    1e3 * made.shape.delta.row(static_cast<long>(k)).norm();
        }
        const Image image = view.draw(pose);
        const std::string file = std::string(kShapesFolder) + "/" + names[i] + "_" + kind + ".png";
        media::write_png(image, folder / file);
        out.files.push_back(file);
        out.shapes[i][kind] = file;
        sheet.rows[i].pictures.push_back(
            report::shrunk(image, static_cast<int>(kOnSheet * ShapesPictures::kWidth_px),
                           static_cast<int>(kOnSheet * ShapesPictures::kHeight_px)));
    };
    for (const std::string& camera : {std::string("front"), std::string("three_quarter")}) {
        render::OffscreenView view(scene, {.width_px = ShapesPictures::kWidth_px,
                                           .height_px = ShapesPictures::kHeight_px,
                                           .camera = camera});
        for (std::size_t i = 0; i < names.size(); ++i) draw(view, i, camera, false);
        if (camera == "front") continue;
        for (std::size_t i = 0; i < names.size(); ++i) draw(view, i, "moved", true);
    }
    if (!sheet.rows.empty()) {
        out.sheet = "contact_sheet.png";
        media::write_png(report::draw_contact_sheet(sheet), folder / out.sheet);
        out.files.push_back(out.sheet);
    }
    return out;
}

}  // namespace risorius::blendshapes
