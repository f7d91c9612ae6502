// SPDX-License-Identifier: MIT
#include "risorius/inverse/detail/evaluation_pictures.h"

#include <cstdio>
#include <limits>
#include <set>

#include "risorius/core/rotations.h"
#include "risorius/media/image_file.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/contact_sheet.h"
#include "risorius/report/folder_name.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::inverse {

namespace fs = std::filesystem;

namespace {

constexpr double kShown = 0.42;  ///< size of a picture on a sheet, ratio to the single picture
constexpr const char* kFolder = "pictures";

// The rotation of an eye, from its vertices.
Mat3 eye_rotation(const rig::Head& head, int side, const Points& vertices) {
    const rig::Carrier eye = side == 0 ? rig::Carrier::kEyeLeft : rig::Carrier::kEyeRight;
    const Vec3 centre = head.eyes[static_cast<std::size_t>(side)].centre;
    Mat3 covariance = Mat3::Zero();
    for (long v = 0; v < vertices.rows(); ++v)
        if (head.carrier[static_cast<std::size_t>(v)] == eye)
            covariance += (vertices.row(v).transpose() - centre) *
                          (head.vertices.row(v).transpose() - centre).transpose();
    if (covariance.isZero()) return Mat3::Identity();
    return nearest_rotation(covariance).rotation;
}

render::Pose pose_of(const rig::Head& head, const Points& vertices) {
    render::Pose pose;
    pose.positions = vertices;
    for (int side = 0; side < 2; ++side)
        pose.eye_rotation[static_cast<std::size_t>(side)] = eye_rotation(head, side, vertices);
    return pose;
}

render::SkinValues error_scale() {
    return {.name = "error", .unit = "mm", .from = 0, .to = kErrorScale_mm, .at = {}};
}

// The error is drawn on the measured face, where a viewer expects the correct shape.
render::Pose error_pose(const render::Pose& measured, const Points& simulated,
                        const Eigen::VectorXd& area) {
    render::Pose pose = measured;
    pose.values = error_scale();
    pose.values->at.assign(static_cast<std::size_t>(area.size()),
                           std::numeric_limits<double>::quiet_NaN());
    for (long v = 0; v < area.size(); ++v)
        if (area[v] > 0)
            pose.values->at[static_cast<std::size_t>(v)] =
                1e3 * (simulated.row(v) - measured.positions.row(v)).norm();
    return pose;
}

std::string numbers_text(const EvaluatedExpression& one) {
    char text[128];
    const auto format = [&](const scene::ExpressionScore& score) {
        std::snprintf(text, sizeof text, "cos %.2f  rel %.2f  rms %.1f mm", score.cosine,
                      score.relative, 1e3 * score.rms_m);
        return std::string(text);
    };
    if (!one.fitted) return format(one.table.score);
    std::snprintf(text, sizeof text, "cos %.2f, fitted %.2f  rms %.1f, fitted %.1f mm",
                  one.table.score.cosine, one.fitted->score.cosine, 1e3 * one.table.score.rms_m,
                  1e3 * one.fitted->score.rms_m);
    return text;
}

}  // namespace

const std::vector<std::string>& evaluation_cameras() {
    static const std::vector<std::string> kCameras{"front", "three_quarter"};
    return kCameras;
}

std::vector<std::string> EvaluationPictures::files() const {
    std::set<std::string> out;
    for (const auto& [camera, file] : sheets) out.insert(file);
    for (const auto& views : expressions)
        for (const auto& [camera, kinds] : views)
            for (const auto& [kind, file] : kinds) out.insert(file);
    return {out.begin(), out.end()};
}

EvaluationPictures draw_evaluation(const Evaluation& evaluation, const rig::RigDescription& rig,
                                   const geom::PolygonMesh& mesh, const rig::Head& head,
                                   const Eigen::VectorXd& area, const fs::path& folder,
                                   const ProgressMonitor& monitor) {
    const render::Scene scene = scene::scene_from_rig(head, rig, mesh);
    const int shown_width = static_cast<int>(kShown * EvaluationPictures::kWidth_px),
              shown_height = static_cast<int>(kShown * EvaluationPictures::kHeight_px);
    EvaluationPictures out;
    out.expressions.resize(evaluation.expressions.size());
    std::set<std::string> taken;
    std::vector<std::string> folders;
    for (const EvaluatedExpression& one : evaluation.expressions) {
        folders.push_back(std::string(kFolder) + "/" + report::folder_name(one.name, taken));
        fs::create_directories(folder / folders.back());
    }
    const bool fitted = !evaluation.expressions.empty() && evaluation.expressions[0].fitted;
    const double views =
        static_cast<double>(evaluation_cameras().size() * evaluation.expressions.size());
    double drawn = 0;
    for (const std::string& camera : evaluation_cameras()) {
        monitor.report(drawn / views, "pictures");
        render::OffscreenView view(scene, {.width_px = EvaluationPictures::kWidth_px,
                                           .height_px = EvaluationPictures::kHeight_px,
                                           .camera = camera});
        report::ContactSheet sheet;
        sheet.title = rig.name + ", measured and simulated";
        sheet.columns =
            fitted ? std::vector<std::string>{"neutral", "by the rig's table", "fitted", "measured",
                                              "error of fitted"}
                   : std::vector<std::string>{"neutral", "by the rig's table", "measured", "error"};
        sheet.scale = error_scale();
        const auto write = [&](const Image& image, const std::string& file) {
            media::write_png(image, folder / file);
            return file;
        };
        const Image neutral = view.draw(pose_of(head, head.vertices));
        const std::string neutral_file =
            write(neutral, std::string(kFolder) + "/neutral_" + camera + ".png");
        for (std::size_t e = 0; e < evaluation.expressions.size(); ++e) {
            const EvaluatedExpression& one = evaluation.expressions[e];
            monitor.report(drawn++ / views, "pictures of " + one.name);
            EvaluationPictures::Kinds& kinds = out.expressions[e][camera];
            kinds["neutral"] = neutral_file;
            report::ContactRow row{one.name, numbers_text(one), {}};
            row.pictures.push_back(report::shrunk(neutral, shown_width, shown_height));
            const auto picture = [&](const std::string& kind, const render::Pose& pose,
                                     bool on_sheet) {
                const Image image = view.draw(pose);
                kinds[kind] = write(image, folders[e] + "/" + camera + "_" + kind + ".png");
                if (on_sheet)
                    row.pictures.push_back(report::shrunk(image, shown_width, shown_height));
            };
            const render::Pose measured = pose_of(head, head.vertices + one.measured);
            constexpr bool kOnSheet = true;
            picture("table", pose_of(head, one.table.vertices), kOnSheet);
            if (one.fitted) picture("fitted", pose_of(head, one.fitted->vertices), kOnSheet);
            picture("measured", measured, kOnSheet);
            picture("table_error", error_pose(measured, one.table.vertices, area), !fitted);
            if (one.fitted)
                picture("fitted_error", error_pose(measured, one.fitted->vertices, area), kOnSheet);
            sheet.rows.push_back(std::move(row));
        }
        if (!sheet.rows.empty())
            out.sheets[camera] =
                write(report::draw_contact_sheet(sheet), "contact_sheet_" + camera + ".png");
    }
    return out;
}

}  // namespace risorius::inverse
