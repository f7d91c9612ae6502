// SPDX-License-Identifier: MIT
#include "risorius/inverse/read_units.h"

#include <cstdio>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/face/face.h"
#include "risorius/face/surfaces.h"
#include "risorius/inverse/detail/coder_kit.h"
#include "risorius/inverse/detail/unit_page.h"
#include "risorius/media/image_file.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/report/contact_sheet.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/expression_score.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::inverse {

namespace {

constexpr const char* kNeutralPicture = "pictures/neutral.png";

Json measures_json(const scene::FaceMeasures& measures) {
    return json_object({{"lid_aperture_mm", measures.lid_aperture},
                        {"mouth_width_mm", measures.mouth_width},
                        {"lip_gap_mm", measures.lip_gap},
                        {"corner_height_mm", measures.corner_height},
                        {"nasolabial_furrow_mm", measures.nasolabial_furrow},
                        {"glabellar_furrow_mm", measures.glabellar_furrow},
                        {"forehead_furrow_mm", measures.forehead_furrow},
                        {"lip_contact_mm2", measures.lip_contact_mm2}});
}

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Json UnitReadings::json() const {
    Json list = Json::array();
    for (const scene::UnitReading& one : units) {
        Json marks = Json::object();
        for (const scene::LandmarkReading& mark : one.landmarks)
            marks[mark.landmark] = json_object({{"target_mm", vector_json(mark.target_mm)},
                                                {"moved_mm", vector_json(mark.moved_mm)},
                                                {"gain", mark.gain}});
        list.push_back(json_object({{"unit", one.unit},
                                    {"name", one.name},
                                    {"gain", one.gain},
                                    {"response", one.response},
                                    {"change", measures_json(one.change)},
                                    {"uneven_mm", one.uneven_mm},
                                    {"landmarks", marks},
                                    {"in_equilibrium", one.in_equilibrium},
                                    {"inverted_tets", one.faults.inverted_tets},
                                    {"volume_change", one.faults.volume_change},
                                    {"lip_depth_mm", one.faults.lip_depth_mm},
                                    {"eye_depth_mm", one.faults.eye_depth_mm},
                                    {"bone_depth_mm", one.faults.bone_depth_mm}}));
    }
    return json_object({{"format", "risorius-unit-readings"},
                        {"version", 1},
                        {"rig", rig},
                        {"neutral", measures_json(neutral)},
                        {"units", list}});
}

namespace {

namespace fs = std::filesystem;

constexpr int kWidth_px = 480, kHeight_px = 560;
constexpr double kMoved_mm = 10;  // end of the colour scale

std::vector<const track::ActionUnit*> chosen(const scene::RigFiles& files,
                                             const std::vector<std::string>& only) {
    std::vector<const track::ActionUnit*> units;
    for (const std::string& id : only) {
        const track::ActionUnit* unit = files.rig.facs.find(id);
        if (!unit || unit->landmark_targets_mm.empty())
            throw Error(files.place(), "an action unit with landmark targets", "\"" + id + "\"");
        units.push_back(unit);
    }
    if (only.empty())
        for (const track::ActionUnit& unit : files.rig.facs.units)
            if (!unit.landmark_targets_mm.empty() && unit.unsupported.empty())
                units.push_back(&unit);
    return units;
}

render::SkinValues moved_scale() {
    return {.name = "motion", .unit = "mm", .from = 0, .to = kMoved_mm, .at = {}};
}

// The face in the pose of a unit, coloured by how far the skin has moved.
render::Pose moved(const face::FacePose& pose, const Points& neutral, const Eigen::VectorXd& area) {
    render::Pose out = scene::pose_for_view(pose);
    out.values = moved_scale();
    out.values->at.assign(static_cast<std::size_t>(area.size()),
                          std::numeric_limits<double>::quiet_NaN());
    for (long v = 0; v < area.size(); ++v)
        if (area[v] > 0)
            out.values->at[static_cast<std::size_t>(v)] =
                1e3 * (pose.vertices.row(v) - neutral.row(v)).norm();
    return out;
}

std::string numbers_of(const scene::UnitReading& one) {
    char text[64];
    std::snprintf(text, sizeof text, "gain %.2f  eye %+.1f mm", one.gain, one.change.lid_aperture);
    return text;
}

// The pose that a coder sees: that which was read, or that of one side.
face::FacePose pictured(const scene::UnitReading& one, face::Face& face,
                        const rig::RigDescription& rig) {
    const track::ActionUnit& unit = *rig.facs.find(one.unit);
    if (!unit.pictured_on) return one.pose;
    const std::string id = one.unit + (*unit.pictured_on == Side::kLeft ? ".l" : ".r");
    const track::Drive drive = rig::clamped_drive(*rig::expansion_at(rig, id, 1), rig.channels());
    const track::Drive rest =
        rig::clamped_drive(track::Expansion::none(rig.channels()), rig.channels());
    face.start([&](double) { return rest; });
    face.solve_equilibrium(drive.excitation, drive);
    return face.pose();
}

// Draws pictures/ and contact_sheet.png, and adds their names to `files`.
std::map<std::string, UnitPictures> draw_units(
    const UnitReadings& readings, face::Face& face, const face::FacePose& neutral,
    const render::Scene& scene, const rig::RigDescription& rig, const fs::path& folder,
    std::vector<std::string>& files, const ProgressMonitor& monitor) {
    fs::create_directories(folder / "pictures");
    render::OffscreenView view(scene, {.width_px = kWidth_px, .height_px = kHeight_px});
    const Eigen::VectorXd area =
        scene::vertex_areas(face.surfaces().simulated_skin(), face.head().vertices);
    report::ContactSheet sheet{rig.name + ", action units at intensity 1",
                               {"neutral", "unit", "motion"},
                               {},
                               moved_scale()};
    const auto write = [&](const Image& image, const std::string& file) {
        media::write_png(image, folder / file);
        files.push_back(file);
        return file;
    };
    const auto small = [](const Image& image) {
        return report::shrunk(image, kWidth_px / 2, kHeight_px / 2);
    };
    const Image rest = view.draw(scene::pose_for_view(neutral));
    write(rest, kNeutralPicture);
    std::map<std::string, UnitPictures> out;
    for (const scene::UnitReading& one : readings.units) {
        monitor.report(static_cast<double>(out.size()) / static_cast<double>(readings.units.size()),
                       "pictures of " + one.unit);
        const face::FacePose pose = pictured(one, face, rig);
        const Image shown = view.draw(scene::pose_for_view(pose)),
                    motion = view.draw(moved(pose, neutral.vertices, area));
        out[one.unit] = {write(shown, "pictures/" + one.unit + ".png"),
                         write(motion, "pictures/" + one.unit + "_moved.png")};
        sheet.rows.push_back({one.unit + " " + one.name,
                              numbers_of(one),
                              {small(rest), small(shown), small(motion)}});
    }
    write(report::draw_contact_sheet(sheet), "contact_sheet.png");
    return out;
}

void write_report(const UnitReadings& readings, const UnitOptions& options,
                  const scene::RigFiles& files, face::Face& face, const face::FacePose& neutral,
                  const fs::path& folder, double from, const ProgressMonitor& monitor) {
    std::vector<std::string> written{"index.html", "coder.js", "results.json"};
    std::map<std::string, UnitPictures> pictures;
    if (options.pictures || options.kit) {
        render::Scene scene = scene::scene_from_rig(face.head(), files.rig, files.mesh);
        scene::add_wrinkles(face.surfaces().wrinkle_lines(), scene);
        const double middle = options.kit ? from + 0.2 * (1 - from) : 1;
        if (options.pictures)
            pictures = draw_units(readings, face, neutral, scene, files.rig, folder, written,
                                  monitor.subrange(from, middle));
        if (options.kit) {
            std::vector<std::string> units;
            for (const scene::UnitReading& one : readings.units) units.push_back(one.unit);
            for (const std::string& file : write_coder_kit(
                     face, files.rig, scene, kit_clips(files.rig.facs, units, options.seed), folder,
                     monitor.subrange(middle, 1)))
                written.push_back(file);
        }
    }
    report::write_text(folder / "index.html", unit_page(readings, files.rig.facs, files.rig.name,
                                                        kNeutralPicture, pictures));
    report::write_text(folder / "coder.js", unit_page_script());
    Json json = readings.json();
    json[report::kFilesKey] = written;
    report::write_text(folder / "results.json", json_text(json, 2) + "\n");
}

// The part of the time that reading takes: about 1 s a unit, of 1.3 s with pictures, and of 6 s with the kit.
double reading_part(const UnitOptions& options) {
    if (options.out.empty()) return 1;
    return options.kit ? 0.2 : options.pictures ? 0.75 : 1;
}

}  // namespace

UnitReadings read_units(const UnitOptions& options, const ProgressMonitor& monitor) {
    if (options.kit && options.out.empty())
        throw Error(option_name("kit"), "a folder for it, " + option_name("out"), "none");
    const scene::RigFiles files = scene::read_rig_files(options.rig, monitor.stopped);
    const std::vector<const track::ActionUnit*> units = chosen(files, options.only);
    std::optional<report::AtomicFolder> folder;
    if (!options.out.empty()) folder.emplace(options.out);
    face::Face face(files.rig, files.mesh, face::quality_named(options.quality), files.place());
    scene::UnitReader reader(face, files.rig);
    UnitReadings out{options.rig.generic_string(), reader.measures(reader.neutral_pose()), {}};
    const double reading = reading_part(options);
    for (const track::ActionUnit* unit : units) {
        monitor.report(
            reading * static_cast<double>(out.units.size()) / static_cast<double>(units.size()),
            unit->id);
        out.units.push_back(reader.read(*unit, options.steps));
    }
    if (folder) {
        write_report(out, options, files, face, reader.neutral_pose(), folder->partial(), reading,
                     monitor);
        folder->commit();
    }
    return out;
}

}  // namespace risorius::inverse
