// SPDX-License-Identifier: MIT
#include "risorius/headmodel/sculpt_head.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/fitting/fit_rig.h"
#include "risorius/headmodel/detail/deform_head.h"
#include "risorius/headmodel/detail/head_textures.h"
#include "risorius/headmodel/detail/population.h"
#include "risorius/headmodel/detail/skin_pigments.h"
#include "risorius/media/image_file.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/rig/head.h"
#include "risorius/scene/rig_files.h"
#include "risorius/scene/scene_from_rig.h"

namespace risorius::headmodel {

namespace fs = std::filesystem;

namespace {

constexpr const char* kMeshFile = "head.obj";
constexpr const char* kLandmarks = "landmarks.json";
constexpr const char* kRegions = "regions.json";
constexpr const char* kIdentityFile = "identity.json";
constexpr const char* kRigFile = "rig.json";
constexpr const char* kViews = "views.png";
constexpr const char* kResults = "results.json";
constexpr const char* kCastTable = "cast.tsv";

headmodel::DesignTables design_tables() {
    return headmodel::read_design_tables(headmodel::models_folder() / "adult/design");
}

Json tone_json(const Vec3& tone) { return Json{tone.x(), tone.y(), tone.z()}; }

Json appearance_json(const headmodel::Identity& identity, const headmodel::DesignTables& tables) {
    // Skin begins to show its age at 25, and hair is grey at 75.
    constexpr double kYoung = 25, kOld = 75;
    Json out;
    const SkinColours skin = skin_colours(identity, tables);
    out["skin_tone"] = tone_json(skin.skin);
    out["lip_tone"] = tone_json(skin.lips);
    out["iris_tone"] = tone_json(tables.tones.at("iris").at(identity.iris));
    out["hair_tone"] = tone_json(tables.tones.at("hair").at(identity.hair));
    out["freckles"] = identity.freckles;
    out["scalp_hair"] = identity.scalp_hair;
    out["hairline_mm"] = identity.hairline;
    out["temples_mm"] = identity.temples;
    out["beard"] = identity.beard;
    write_identity_hair(identity.hairdo, out);
    out["age"] = std::clamp((identity.age - kYoung) / (kOld - kYoung), 0.0, 1.0);
    return out;
}

render::Scene scene_of(const fs::path& rig_file) {
    const scene::RigFiles files = scene::read_rig_files(rig_file);
    return scene::scene_from_rig(rig::place_head(files.rig, files.mesh, files.place()), files.rig,
                                 files.mesh);
}

Image views_of(const render::Scene& scene) {
    constexpr int kWidth_px = 560, kHeight_px = 720;
    render::Pose pose;
    pose.positions = scene.rest;
    Image row(3 * kWidth_px, kHeight_px);
    int left = 0;
    for (const char* camera : {"front", "three_quarter", "profile"}) {
        render::OffscreenView view(
            scene, {.width_px = kWidth_px, .height_px = kHeight_px, .camera = camera});
        const Image one = view.draw(pose);
        for (int y = 0; y < kHeight_px; ++y)
            std::copy_n(one.pixel(0, y), 4 * kWidth_px, row.pixel(left, y));
        left += kWidth_px;
    }
    return row;
}

// A head of this family that is not calibrated gets what was found for its mean, the adult.
void take_calibration(const fs::path& standard, Json& rig) {
    const fs::path rigs = standard.empty() ? data_folder() / "rigs" : standard.parent_path();
    const Json adult = JsonCursor::read_file(rigs / "adult" / "rig.json").json();
    for (const char* key : {"strength", "lips", "solids"})
        rig["anatomy"][key] = adult["anatomy"][key];
    if (adult.contains("unit_gains")) rig["unit_gains"] = adult["unit_gains"];
}

double number_in(const std::string& digits, const char* option, const char* expected,
                 const std::string& found) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(digits, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used == 0 || used != digits.size())
        throw Error(option_name(option), expected, in_quotes(found));
    return value;
}

headmodel::Identity identity_called(const std::string& name, const char* option,
                                    const headmodel::DesignTables& tables) {
    fs::path file = name;
    if (file.extension() != ".json") {
        index_of_name(option_name(option), name, headmodel::named_identities());
        file = headmodel::identity_file(name);
    }
    return headmodel::read_identity(file, tables);
}

headmodel::Identity morph_of(const std::vector<std::string>& words,
                             const headmodel::DesignTables& tables) {
    constexpr double kFarthest = 2;
    constexpr const char* kExpected = "two identities and a share from -2 to 2";
    if (words.size() != 3)
        throw Error(option_name("morph"), kExpected, std::to_string(words.size()) + " words");
    const double share = number_in(words[2], "morph", kExpected, words[2]);
    if (!(std::abs(share) <= kFarthest))
        throw Error(option_name("morph"), kExpected, in_quotes(words[2]));
    return headmodel::morph(identity_called(words[0], "morph", tables),
                            identity_called(words[1], "morph", tables), share);
}

/// The identity that the others fields of the choice then change.
headmodel::Identity begun_identity(const IdentityChoice& choice,
                                   const headmodel::DesignTables& tables) {
    constexpr double kStrongest = 3;
    if (choice.exaggerate && !(std::abs(*choice.exaggerate) <= kStrongest))
        throw Error(option_name("exaggerate"), "a factor from -3 to 3",
                    format_number(*choice.exaggerate));
    const int sources = (choice.identity.empty() ? 0 : 1) + (choice.seed ? 1 : 0) +
                        (choice.morph.empty() ? 0 : 1) + (choice.average.empty() ? 0 : 1);
    if (choice.seed && !choice.identity.empty())
        throw Error(option_name("seed"), "a seed or " + option_name("identity"), "both");
    if (sources > 1)
        throw Error(option_name(choice.morph.empty() ? "average" : "morph"),
                    "no other source of the identity", "one");
    const bool person =
        choice.model ? *choice.model == 2 : choice.ancestry.has_value() || choice.seed.has_value();
    if (!choice.identity.empty()) return identity_called(choice.identity, "identity", tables);
    if (!choice.morph.empty()) return morph_of(choice.morph, tables);
    if (!choice.average.empty()) {
        std::vector<headmodel::Identity> persons;
        for (const std::string& name : choice.average)
            persons.push_back(identity_called(name, "average", tables));
        return headmodel::average_of(persons);
    }
    if (choice.seed && person)
        return headmodel::random_person(*choice.seed, {choice.sex, choice.age, choice.ancestry},
                                        tables);
    if (choice.seed) return headmodel::random_identity(*choice.seed, tables);
    headmodel::Identity identity;
    if (person) {
        identity.model = headmodel::Model::kPopulation;
        identity.name = "mean";
    }
    return identity;
}

}  // namespace

headmodel::Identity chosen_identity(const IdentityChoice& choice) {
    const headmodel::DesignTables tables = design_tables();
    headmodel::Identity identity = begun_identity(choice, tables);
    identity.sex = choice.sex.value_or(identity.sex);
    identity.age = choice.age.value_or(identity.age);
    if (choice.ancestry) identity.ancestry = {{*choice.ancestry, 1}};
    if (choice.skin && choice.melanin)
        throw Error(option_name("melanin"), "a tone by melanin or by " + option_name("skin"),
                    "both");
    if (choice.skin) {
        identity.skin = *choice.skin;
        identity.melanin.reset();
        identity.haemoglobin = 0;
    }
    if (choice.melanin) identity.melanin = choice.melanin;
    if (choice.haemoglobin && !identity.melanin)
        throw Error(option_name("haemoglobin"), option_name("melanin") + " beside it", "none");
    identity.haemoglobin = choice.haemoglobin.value_or(identity.haemoglobin);
    identity.hairdo.skin_gloss = choice.skin_gloss.value_or(identity.hairdo.skin_gloss);
    identity.hairdo.garment = choice.garment.value_or(identity.hairdo.garment);
    if (choice.garment_tone.size() == 3)
        identity.hairdo.garment_tone = Eigen::Map<const Vec3>(choice.garment_tone.data());
    identity.iris = choice.iris.value_or(identity.iris);
    identity.hair = choice.hair.value_or(identity.hair);
    identity.hairdo.style = choice.hair_style.value_or(identity.hairdo.style);
    identity.hairdo.hairline_form = choice.hairline_form.value_or(identity.hairdo.hairline_form);
    headmodel::check_identity(identity, tables, option_name);
    if (choice.seed)
        headmodel::deform_within_spread(headmodel::make_form(tables), tables, identity);
    for (const std::string& text : choice.shape) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos)
            throw Error(option_name("shape"), "PARAMETER=NUMBER", in_quotes(text));
        identity.shape[text.substr(0, equals)] =
            number_in(text.substr(equals + 1), "shape", "PARAMETER=NUMBER", text);
    }
    headmodel::check_identity(identity, tables, option_name);
    if (choice.exaggerate) identity = headmodel::exaggerate(identity, *choice.exaggerate);
    return identity;
}

std::vector<std::string> write_cast(const CastOptions& options, const fs::path& out) {
    const headmodel::DesignTables tables = design_tables();
    const auto cast = headmodel::choose_cast(options, tables);
    report::AtomicFolder folder(out);
    std::vector<std::string> files;
    for (const headmodel::CastMember& member : cast) {
        files.push_back(member.identity.name + ".json");
        report::write_text(folder.partial() / files.back(),
                           json_text(headmodel::identity_json(member.identity), 2) + "\n");
    }
    report::write_text(folder.partial() / kCastTable, headmodel::cast_table(cast, tables));
    files.insert(files.end(), {kCastTable, kResults});
    report::write_text(folder.partial() / kResults,
                       json_text(Json{{report::kFilesKey, files}}, 2) + "\n");
    folder.commit();
    return files;
}

SculptReport sculpt_head(const SculptOptions& options, const ProgressMonitor& monitor) {
    if (options.mesh_only && fs::exists(options.out / kRigFile))
        throw Error(option_name("mesh_only"), "a folder without a rig, which it would take away",
                    in_quotes((options.out / kRigFile).generic_string()));
    // Shape it, and prove that there are people like this
    monitor.report(0, "sculpting");
    const headmodel::DesignTables tables = design_tables();
    SculptReport report;
    report.out = options.out;
    report.identity = options.identity;
    report.skin_ita_deg = skin_colours(options.identity, tables).ita_deg;
    const headmodel::HeadModel model =
        headmodel::deform_head(headmodel::make_head(tables), tables, options.identity);
    headmodel::check_spread(model, tables, options.identity, options.place);
    report.quality = headmodel::head_quality(model, tables, options.identity.sex, false);
    if (options.identity.model == headmodel::Model::kPopulation &&
        report.quality.self_intersections > 0)
        throw Error(
            options.place, "a head that does not run through itself",
            std::to_string(report.quality.self_intersections) + " pairs of triangles that do");

    // Write who it is, mesh and landmarks
    report::AtomicFolder folder(options.out);
    const fs::path partial = folder.partial();
    report::write_text(partial / kIdentityFile,
                       json_text(headmodel::identity_json(options.identity), 2) + "\n");
    report.files = {kIdentityFile, kResults};
    if (options.identity_only) {
        report::write_text(partial / kResults, json_text(report.json(), 2) + "\n");
        folder.commit();
        return report;
    }
    const bool textured = options.texture_px > 0;
    headmodel::write_head(model, partial, textured ? kTextureLibrary : "");
    report.files.insert(report.files.end(), {kMeshFile, kLandmarks, kRegions});

    // Give it muscles, and colours of its own
    if (!options.mesh_only) {
        fitting::FitOptions fit;
        fit.mesh = partial / kMeshFile;
        fit.landmarks = partial / kLandmarks;
        fit.out = partial / kRigFile;
        fit.standard = options.standard;
        fit.metres_per_unit = 1e-3;
        fit.name = options.identity.name;
        fit.calibrate = options.calibrate;
        fit.solids = true;
        report.notes = fitting::fit_rig(fit, monitor).notes;
        Json rig = JsonCursor::read_file(fit.out).json();
        if (!options.calibrate) take_calibration(options.standard, rig);
        rig["appearance"] = appearance_json(options.identity, tables);
        // The pictures are for others: drawn here, the head looks the same with and without them.
        if (textured) rig["appearance"]["textures"] = "generated";
        report::write_text(fit.out, json_text(rig, 1) + "\n");
        const render::Scene scene = scene_of(fit.out);
        media::write_png(views_of(scene), partial / kViews);
        if (textured) {
            const std::vector<std::string> written =
                write_head_textures(scene, options.texture_px, model.crown_height, partial);
            report.files.insert(report.files.end(), written.begin(), written.end());
        }
        report.files.insert(report.files.end(), {kRigFile, kViews});
    }
    std::sort(report.files.begin(), report.files.end());
    report::write_text(partial / kResults, json_text(report.json(), 2) + "\n");
    monitor.report(1, "done");
    folder.commit();
    return report;
}

Json SculptReport::json() const {
    Json json;
    json["identity"] = headmodel::identity_json(identity);
    json["skin_ita_deg"] = std::round(10 * skin_ita_deg) / 10;
    json["worst_deviation"] = quality.worst_deviation();
    for (const headmodel::MeasureScore& m : quality.measures)
        json["measures"][m.measure] =
            json_object({{"length_mm", m.length_mm}, {"deviation", m.deviation}});
    json["self_intersections"] = quality.self_intersections;
    json["quad_share"] = quality.quad_fraction;
    json["unusual_valence_share"] = quality.unusual_valence_fraction;
    json["mirror_error_mm"] = quality.mirror_error_mm;
    json["aspect"] = json_object({{"median", quality.aspect_median},
                                  {"of_99", quality.aspect_99},
                                  {"greatest", quality.aspect_worst}});
    json["layout"] = json_object({{"stretch_low", quality.stretch_low},
                                  {"stretch_high", quality.stretch_high},
                                  {"turned_over", quality.turned_over}});
    json["notes"] = notes;
    json[report::kFilesKey] = files;
    return json;
}

}  // namespace risorius::headmodel
