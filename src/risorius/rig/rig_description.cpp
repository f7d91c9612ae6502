// SPDX-License-Identifier: MIT
#include "risorius/rig/rig_description.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/data_folder.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/known_names.h"
#include "risorius/core/output_set.h"
#include "risorius/rig/calibration.h"

namespace risorius::rig {

namespace {

// The same list of fields serves reading and writing, so that no key exists in only one of them.
template <typename Visit>
void visit_fields(JawDescription& jaw, Visit visit) {
    visit("hinge_mm", jaw.hinge_mm);
    visit("open_deg", jaw.open_deg, Range{1, 60});
    visit("open_slide_mm", jaw.open_slide_mm);
    visit("forward_mm", jaw.forward_mm);
    visit("side_mm", jaw.side_mm, Range{0, 30});
}
template <typename Visit>
void visit_fields(EyesDescription& eyes, Visit visit) {
    visit("gaze_limit_deg", eyes.gaze_limit_deg, Range{0, 90});
    visit("iris_radius_mm", eyes.iris_radius_mm, Range{1, 20});
    visit("pupil_radius_mm", eyes.pupil_radius_mm, Range{0.5, 10});
    visit("upper_lid_per_gaze_down", eyes.upper_lid_per_gaze_down, Range{0, 2});
    visit("upper_lid_per_gaze_up", eyes.upper_lid_per_gaze_up, Range{0, 2});
    visit("lower_lid_per_gaze_down", eyes.lower_lid_per_gaze_down, Range{0, 2});
    visit("lower_lid_per_gaze_up", eyes.lower_lid_per_gaze_up, Range{0, 2});
    visit("lids_per_gaze_aside", eyes.lids_per_gaze_aside, Range{0, 1});
    visit("upper_lid_per_brow", eyes.upper_lid_per_brow, Range{0, 1});
    visit("lower_lid_per_cheek", eyes.lower_lid_per_cheek, Range{0, 1});
    visit("wide_deg", eyes.wide_deg, Range{0, 45});
    visit("lid_closed_share", eyes.lid_closed_fraction, Range{0.5, 1});
}
template <typename Visit>
void visit_fields(ActivationDescription& activation, Visit visit) {
    visit("law", activation.law, {"thelen2003", "smooth"});
    visit("steepness", activation.steepness, Range{0.1, 1000});
}
template <typename Visit>
void visit_fields(TissueDescription& tissue, Visit visit) {
    visit("deep_shear_pa", tissue.deep_shear_pa, Range{1, 1e9});
    visit("superficial_shear_pa", tissue.superficial_shear_pa, Range{1, 1e9});
    visit("bulk_pa", tissue.bulk_pa, Range{1, 1e10});
    visit("density_kg_m3", tissue.density_kg_m3, Range{1, 1e5});
    visit("damping_s", tissue.damping_s, Range{0, 10});
    visit("contact_pa_per_m", tissue.contact_pa_per_m, Range{0, 1e12});
    visit("lid_shear_ratio", tissue.lid_shear_ratio, Range{1e-4, 100});
    visit("lip_shear_ratio", tissue.lip_shear_ratio, Range{1e-4, 100});
    visit("modiolus_shear_ratio", tissue.modiolus_shear_ratio, Range{1e-4, 100});
    visit("crease_shear_ratio", tissue.crease_shear_ratio, Range{1e-4, 100});
    visit("malar_shear_ratio", tissue.malar_shear_ratio, Range{1e-4, 100});
    visit("fibre_passive_strain", tissue.fibre_passive_strain, Range{0.05, 10});
    visit("bundles", tissue.bundles, {"facial", "musculotendon"});
    visit("force_scale", tissue.force_scale, Range{0, 100});
}
template <typename Visit>
void visit_fields(SkinDescription& skin, Visit visit) {
    visit("membrane_n_per_m", skin.membrane_n_per_m, Range{0, 1e6});
    visit("bending_n_m", skin.bending_n_m, Range{0, 1e3});
    visit("lid_membrane_ratio", skin.lid_membrane_ratio, Range{1e-4, 100});
    visit("wrinkles", skin.wrinkles, Range{0, 10});
}
template <typename Visit>
void visit_fields(LipsDescription& lips, Visit visit) {
    for (const auto& [key, ratio] : {std::pair{"upper_turn", &lips.upper_turn},
                                     {"lower_turn", &lips.lower_turn},
                                     {"upper_push", &lips.upper_push},
                                     {"lower_push", &lips.lower_push},
                                     {"puff", &lips.puff}})
        visit(key, *ratio, Range{0.05, 4});
}
template <typename Visit>
void visit_fields(AppearanceDescription& appearance, Visit visit) {
    static const std::vector<std::string_view> kTextures{"mesh", "generated"};
    visit("textures", appearance.textures, kTextures);
    visit("skin_tone", appearance.skin_tone);
    visit("lip_tone", appearance.lip_tone);
    visit("hair_tone", appearance.hair_tone);
    visit("iris_tone", appearance.iris_tone);
    visit("freckles", appearance.freckles, Range{0, 1});
    visit("scalp_hair", appearance.scalp_hair, Range{0, 1});
    visit("hairline_mm", appearance.hairline_mm, Range{-10, 40});
    visit("temples_mm", appearance.temples_mm, Range{-10, 40});
    visit("hair_length_mm", appearance.hair_length_mm, Range{0, 15});
    visit("beard", appearance.beard, Range{0, 1});
    visit("beard_length_mm", appearance.beard_length_mm, Range{0, 15});
    visit("age", appearance.age, Range{0, 1});
    visit("seed", appearance.seed);
    static const std::vector<std::string_view> kHairStyles{
        "shaven", "crop", "short_parted", "curly_short", "afro", "bob", "long_tied", "bald_fringe"};
    static const std::vector<std::string_view> kHairlines{"even", "round", "widows_peak",
                                                          "m",    "high",  "receding"};
    visit("hair_style", appearance.hair_style, kHairStyles);
    visit("hairline_form", appearance.hairline_form, kHairlines);
    visit("lock_length", appearance.lock_length, Range{0.5, 1.5});
    visit("lock_wave", appearance.lock_wave, Range{0, 1});
    visit("fringe", appearance.fringe, Range{0, 1});
    visit("parting", appearance.parting, Range{-2, 2});
    visit("grey_hair", appearance.grey_hair, Range{0, 1});
    visit("age_lines", appearance.age_lines, Range{0, 1});
    static const std::vector<std::string_view> kBeards{"stubble", "full", "moustache", "goatee",
                                                       "jawline"};
    visit("beard_form", appearance.beard_form, kBeards);
    visit("brow_density", appearance.brow_density, Range{0, 3});
    visit("brow_width", appearance.brow_width, Range{0.3, 2});
    visit("skin_gloss", appearance.skin_gloss, Range{0, 2});
    visit("complexion", appearance.complexion, Range{0, 2});
    visit("mottling", appearance.mottling, Range{0, 1});
    static const std::vector<std::string_view> kGarments{"none", "crew_neck", "v_neck"};
    visit("garment", appearance.garment, kGarments);
    visit("garment_tone", appearance.garment_tone);
}

struct FieldReader {
    JsonCursor json;
    void operator()(const char* key, double& value, Range range) const {
        if (const auto found = json.find(key)) value = found->number(range);
    }
    void operator()(const char* key, std::optional<double>& value, Range range) const {
        if (const auto found = json.find(key)) value = found->number(range);
    }
    void operator()(const char* key, Vec3& value) const {
        if (const auto found = json.find(key)) value = found->vec3();
    }
    void operator()(const char* key, int& value) const {
        if (const auto found = json.find(key))
            value = found->integer(0, std::numeric_limits<int>::max());
    }
    void operator()(const char* key, std::string& value,
                    const std::vector<std::string_view>& choices) const {
        if (const auto found = json.find(key)) value = found->one_of(choices);
    }
};
struct FieldKeys {
    std::vector<std::string_view>& keys;
    template <typename... Rest>
    void operator()(const char* key, Rest&&...) const {
        keys.push_back(key);
    }
    void operator()(const char* key, std::string&, const std::vector<std::string_view>&) const {
        keys.push_back(key);
    }
};
struct FieldWriter {
    Json& json;
    void operator()(const char* key, double& value, Range) const { json[key] = value; }
    void operator()(const char* key, std::optional<double>& value, Range) const {
        if (value) json[key] = *value;
    }
    void operator()(const char* key, Vec3& value) const {
        json[key] = {value.x(), value.y(), value.z()};
    }
    void operator()(const char* key, int& value) const { json[key] = value; }
    void operator()(const char* key, std::string& value,
                    const std::vector<std::string_view>&) const {
        json[key] = value;
    }
};

template <typename T>
void read_fields(const JsonCursor& parent, const char* key, T& out,
                 std::vector<std::string_view> keys = {}) {
    const auto found = parent.find(key);
    if (!found) return;
    const JsonCursor json = follow_table(*found);
    visit_fields(out, FieldKeys{keys});
    json.allow_keys(keys);
    visit_fields(out, FieldReader{json});
}
template <typename T>
Json fields_of(const T& value) {
    Json json = Json::object();
    T copy = value;
    visit_fields(copy, FieldWriter{json});
    return json;
}

void read_tissue(const JsonCursor& rig_json, RigDescription& rig) {
    read_fields(rig_json, "tissue", rig.tissue, {"collagen"});
    const auto found = rig_json.find("tissue");
    if (!found) return;
    if (const auto fibres = follow_table(*found).find("collagen"))
        rig.tissue.collagen = read_collagen_regions(*fibres, rig.atlas.landmark_ids());
}
Json tissue_json(const TissueDescription& tissue) {
    Json json = fields_of(tissue);
    if (!tissue.collagen.empty()) json["collagen"] = collagen_regions_json(tissue.collagen);
    return json;
}

constexpr const char* kTables[] = {"landmarks",    "thickness", "attachments",
                                   "muscle_bands", "muscles",   "wrinkles"};
constexpr const char* kTableFiles[] = {"landmarks.json",   "tissue_thickness.json",
                                       "attachments.json", "muscle_bands.json",
                                       "muscles.json",     kWrinkleFile};

void read_solids_of(const JsonCursor& json, RigDescription& rig) {
    rig.solids = read_solid_muscles(json, rig.muscles);
    for (const SolidMuscle& solid : rig.solids)
        if (solid.mesh)
            for (const std::filesystem::path& file : {solid.mesh->file, solid.mesh->right_file})
                if (!file.empty()) rig.table_files.push_back(file);
}

// A rig without its own table has the wrinkles of the standard anatomy.
void read_wrinkles_of(const JsonCursor& anatomy, RigDescription& rig) {
    const auto named = anatomy.find("wrinkles");
    if (!named) {
        rig.table_files.push_back(data_folder() / "rigs" / "standard" / kWrinkleFile);
        rig.atlas.wrinkles =
            read_wrinkles(JsonCursor::read_file(rig.table_files.back()), rig.atlas.landmark_ids());
        return;
    }
    if (named->is_string()) rig.table_files.push_back(named->path());
    rig.atlas.wrinkles = read_wrinkles(follow_table(*named), rig.atlas.landmark_ids());
}

}  // namespace

const SolidMuscle* RigDescription::solid(const std::string& muscle) const {
    for (const SolidMuscle& entry : solids)
        if (entry.muscle == muscle) return &entry;
    return nullptr;
}

const std::vector<std::string_view>& part_roles() {
    static const std::vector<std::string_view> kRoles{
        "skin",     "mouth",      "eye_socket", "eye_l",       "eye_r",
        "cornea_l", "cornea_r",   "teeth",      "teeth_upper", "teeth_lower",
        "gums",     "gums_upper", "gums_lower", "tongue",      "gums_tongue",
        "lashes",   "lashes_l",   "lashes_r",   "hidden"};
    return kRoles;
}

std::map<std::string, Landmark> read_landmark_table(JsonCursor table) {
    std::map<std::string, Landmark> out;
    for (const std::string& id : table.keys()) {
        const JsonCursor item = table.at(id);
        item.allow_keys({"vertex", "xyz", "distance_mm", "confidence"});
        Landmark landmark;
        const auto vertex = item.find("vertex"), xyz = item.find("xyz");
        if (vertex.has_value() == xyz.has_value()) item.fail("either \"vertex\" or \"xyz\"");
        if (vertex) landmark.vertex = vertex->integer(0, std::numeric_limits<int>::max());
        if (xyz) landmark.xyz = xyz->vec3();
        if (const auto confidence = item.find("confidence"))
            landmark.confidence = confidence->number({0, 1});
        out[id] = landmark;
    }
    return out;
}

std::map<std::string, Landmark> read_landmarks(const std::filesystem::path& file) {
    const JsonCursor json = JsonCursor::read_file(file);
    json.at("format").one_of({"risorius-landmarks"});
    json.allow_keys({"format", "version", "landmarks", "mesh", "note", "mesh_units_per_metre"});
    json.at("version").integer(1, 1);
    return read_landmark_table(json.at("landmarks"));
}

std::map<std::string, UnitGain> read_unit_gains(const JsonCursor& json,
                                                const track::FacsTable& facs) {
    std::map<std::string, UnitGain> out;
    for (const std::string& id : json.keys()) {
        const JsonCursor item = json.at(id);
        if (!facs.find(id)) item.fail("an action unit of the facs table", "\"" + id + "\"");
        item.allow_keys({"muscles", "activation_at", "channels_at", "reached"});
        UnitGain& gain = out[id];
        gain.muscles = item.at("muscles").number({0.05, 20});
        gain.curve.muscles = track::read_intensity_curve(item.at("activation_at"));
        gain.curve.channels = facs.find(id)->curve.channels;
        if (const auto jaw = item.find("channels_at"))
            gain.curve.channels = track::read_intensity_curve(*jaw);
        if (const auto reached = item.find("reached")) gain.reached = reached->number();
    }
    return out;
}

Json unit_gain_json(const UnitGain& gain) {
    Json json = json_object({{"muscles", gain.muscles},
                             {"activation_at", gain.curve.muscles.points()},
                             {"reached", gain.reached}});
    if (!gain.curve.channels.is_identity()) json["channels_at"] = gain.curve.channels.points();
    return json;
}

void apply_unit_gains(const std::map<std::string, UnitGain>& gains, track::FacsTable& facs) {
    for (track::ActionUnit& unit : facs.units) {
        const auto gain = gains.find(unit.id);
        if (gain == gains.end()) continue;
        for (track::MuscleFraction& muscle : unit.muscles)
            muscle.weight = std::clamp(gain->second.muscles * muscle.weight, -1.0, 1.0);
        unit.curve = gain->second.curve;
    }
}

/// Whether all bands of a muscle have the same strength, so that one number can say it.
static bool has_one_strength(const std::vector<MuscleBand>& bands, const std::string& muscle) {
    std::set<double> strengths;
    for (const MuscleBand& band : bands)
        if (band.muscle == muscle) strengths.insert(band.strength);
    return strengths.size() == 1;
}

RigDescription read_rig(const std::filesystem::path& file) {
    return read_rig(JsonCursor::read_file(file));
}

Json resolved_rig(const std::filesystem::path& file) {
    const JsonCursor json = JsonCursor::read_file(file);
    const RigDescription rig = read_rig(json);
    const auto follow_all = [](Json& out, const JsonCursor& from,
                               std::initializer_list<const char*> tables) {
        for (const char* key : tables)
            if (const auto found = from.find(key)) out[key] = follow_table(*found).json();
    };
    Json out = json.json();
    follow_all(out, json, {"anatomy", "tissue", "skin", "facs", "expressions"});
    // A table of the anatomy is relative to the file of the anatomy.
    follow_all(out["anatomy"], follow_table(json.at("anatomy")),
               {"landmarks", "thickness", "attachments", "muscle_bands", "muscles", "wrinkles",
                "solids", "lips", "jaw", "eyes", "activation"});
    // Paths of meshes begin at the file of their table, which is none of the rig's any more
    if (out["anatomy"].contains("solids"))
        for (const SolidMuscle& solid : rig.solids)
            if (solid.mesh)
                out["anatomy"]["solids"][solid.muscle]["mesh"] =
                    solid_muscles_json({solid})[solid.muscle]["mesh"];
    Json& strength = out["anatomy"]["strength"];
    for (const MuscleBand& band : rig.atlas.bands)
        if (has_one_strength(rig.atlas.bands, band.muscle)) strength[band.muscle] = band.strength;
    out["anatomy"]["lips"] = fields_of(rig.lips);
    out["anatomy"]["jaw"] = fields_of(rig.jaw);
    out["anatomy"]["eyes"] = fields_of(rig.eyes);
    out["tissue"] = tissue_json(rig.tissue);
    out["skin"] = fields_of(rig.skin);
    return out;
}

RigDescription read_rig(const JsonCursor& json) {
    json.at("format").one_of({"risorius-rig"});
    json.allow_keys({"format", "version", "name", "mesh", "landmarks", "anatomy", "tissue", "skin",
                     "facs", "unit_gains", "expressions", "appearance", "look", "calibrated_on"});
    json.at("version").integer(1, 1);
    RigDescription rig;
    const auto table = [&](const JsonCursor& named) {
        if (named.is_string()) rig.table_files.push_back(named.path());
        return follow_table(named);
    };
    rig.name = json.at("name").string();

    const JsonCursor mesh = json.at("mesh");
    mesh.allow_keys({"file", "metres_per_unit", "parts"});
    rig.mesh_file = existing_file(mesh.at("file"));
    rig.metres_per_unit = mesh.at("metres_per_unit").number({1e-9, 1e3});
    mesh.at("parts").allow_keys(part_roles());
    for (const std::string& role : mesh.at("parts").keys())
        for (const JsonCursor& group : mesh.at("parts").at(role).items())
            rig.parts[role].push_back(group.string());

    const JsonCursor landmarks = json.at("landmarks");
    rig.landmarks = landmarks.is_string() ? read_landmarks(existing_file(landmarks))
                                          : read_landmark_table(landmarks);
    if (landmarks.is_string()) rig.table_files.push_back(landmarks.path());

    const JsonCursor anatomy = table(json.at("anatomy"));
    anatomy.allow_keys({"landmarks", "thickness", "attachments", "muscle_bands", "muscles",
                        "wrinkles", "strength", "solids", "lips", "jaw", "eyes", "activation"});
    rig.atlas.landmarks = read_atlas_landmarks(table(anatomy.at("landmarks")));
    rig.atlas.thickness = read_thickness(table(anatomy.at("thickness")));
    rig.atlas.attachments = read_attachments(table(anatomy.at("attachments")));
    rig.atlas.bands = read_muscle_bands(table(anatomy.at("muscle_bands")));
    rig.muscles = read_muscle_table(table(anatomy.at("muscles")));
    read_wrinkles_of(anatomy, rig);
    if (const auto solids = anatomy.find("solids")) read_solids_of(table(*solids), rig);
    if (const auto strength = anatomy.find("strength"))
        for (const std::string& muscle : strength->keys()) {
            bool known = false;
            for (MuscleBand& band : rig.atlas.bands)
                if (band.muscle == muscle) {
                    band.strength = strength->at(muscle).number({0, 100});
                    known = true;
                }
            if (!known)
                strength->at(muscle).fail("a muscle of the muscle bands", "\"" + muscle + "\"");
        }
    for (const auto& [id, landmark] : rig.landmarks)
        if (!rig.atlas.landmark(id))
            throw Error(landmarks.place() + "/" + id,
                        "a landmark of the atlas" + did_you_mean(id, rig.atlas.landmark_ids()),
                        "\"" + id + "\"");

    if (const auto calibrated = json.find("calibrated_on")) {
        read_calibration(*calibrated);
        if (calibrated->is_string()) rig.table_files.push_back(calibrated->path());
    }

    read_fields(anatomy, "lips", rig.lips);
    read_fields(anatomy, "jaw", rig.jaw);
    read_fields(anatomy, "eyes", rig.eyes);
    read_fields(anatomy, "activation", rig.activation);
    read_tissue(json, rig);
    read_fields(json, "skin", rig.skin);
    if (json.has("look")) {
        if (json.has("appearance"))
            json.at("look").fail("either \"appearance\" or its old name \"look\"");
        rig.notes.push_back("the key \"look\" is now named \"appearance\"");
    }
    read_fields(json, json.has("look") ? "look" : "appearance", rig.appearance);
    rig.facs = track::read_facs(table(json.at("facs")), rig.channels());
    if (const auto gains = json.find("unit_gains"))
        rig.unit_gains = read_unit_gains(*gains, rig.facs);
    apply_unit_gains(rig.unit_gains, rig.facs);
    for (track::ActionUnit& unit : rig.facs.units)
        unit.kinematic[static_cast<std::size_t>(track::Kinematic::kMouthPressure)] *= rig.lips.puff;
    rig.expressions =
        track::read_expressions(table(json.at("expressions")), rig.facs, rig.channels());
    return rig;
}

void write_rig(const RigDescription& rig, const std::filesystem::path& file,
               const RigWriteOptions& options) {
    const std::filesystem::path& place = options.place.empty() ? file : options.place;
    const std::filesystem::path folder =
        place.has_parent_path() ? place.parent_path() : std::filesystem::path(".");
    const auto relative = [&](const std::filesystem::path& path) {
        return std::filesystem::proximate(std::filesystem::absolute(path),
                                          std::filesystem::absolute(folder))
            .generic_string();
    };
    const auto table = [&](const char* name) -> Json {
        const std::filesystem::path source = options.standard_folder / name;
        if (!options.inline_tables) return relative(source);
        return JsonCursor::read_file(source).json();
    };
    Json json;
    json["format"] = "risorius-rig";
    json["version"] = 1;
    json["name"] = rig.name;
    json["mesh"]["file"] = relative(rig.mesh_file);
    json["mesh"]["metres_per_unit"] = rig.metres_per_unit;
    json["mesh"]["parts"] = Json::object();
    for (std::string_view role : part_roles()) {
        const auto found = rig.parts.find(std::string(role));
        if (found != rig.parts.end()) json["mesh"]["parts"][std::string(role)] = found->second;
    }
    Json landmarks = Json::object();
    for (const auto& [id, landmark] : rig.landmarks) {
        if (landmark.vertex >= 0)
            landmarks[id]["vertex"] = landmark.vertex;
        else
            landmarks[id]["xyz"] = {landmark.xyz.x(), landmark.xyz.y(), landmark.xyz.z()};
    }
    json["landmarks"] = landmarks;
    Json anatomy;
    for (std::size_t i = 0; i < std::size(kTables); ++i)
        anatomy[kTables[i]] = table(kTableFiles[i]);
    Json strength = Json::object();
    for (const MuscleBand& band : rig.atlas.bands) strength[band.muscle] = band.strength;
    anatomy["strength"] = strength;
    if (!rig.solids.empty()) anatomy["solids"] = solid_muscles_json(rig.solids, relative);
    anatomy["lips"] = fields_of(rig.lips);
    anatomy["jaw"] = fields_of(rig.jaw);
    anatomy["eyes"] = fields_of(rig.eyes);
    if (rig.activation.law != ActivationDescription().law)
        anatomy["activation"] = fields_of(rig.activation);
    json["anatomy"] = anatomy;
    json["tissue"] = tissue_json(rig.tissue);
    json["skin"] = fields_of(rig.skin);
    json["facs"] = table("facs.json");
    for (const auto& [unit, gain] : rig.unit_gains) json["unit_gains"][unit] = unit_gain_json(gain);
    json["expressions"] = table("expressions.json");
    json["appearance"] = fields_of(rig.appearance);
    // Rigs that ask for no hair and no lines stay as they were before there were any.
    const Json usual = fields_of(AppearanceDescription{});
    for (const char* key :
         {"hair_style", "lock_length", "lock_wave", "fringe", "parting", "hairline_form",
          "age_lines", "beard_form", "brow_density", "brow_width", "skin_gloss", "complexion",
          "mottling", "garment", "garment_tone"})
        if (json["appearance"][key] == usual[key]) json["appearance"].erase(key);
    if (const auto source = options.standard_folder / kCalibrationFile;
        std::filesystem::exists(source))
        json["calibrated_on"] = options.inline_tables
                                    ? Json(read_calibration(JsonCursor::read_file(source)))
                                    : Json(relative(source));

    write_file(file, json_text(json, 1) + "\n");
}

}  // namespace risorius::rig
