// SPDX-License-Identifier: MIT
#include "risorius/design/design.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/counter_rng.h"
#include "risorius/core/error.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/known_names.h"
#include "risorius/design/conditions.h"
#include "risorius/design/table.h"

namespace risorius::design {

namespace {

std::vector<Given> read_values(const JsonCursor& json) {
    std::vector<Given> out;
    for (const std::string& name : json.keys()) {
        if (!is_parameter_name(name))
            json.at(name).fail("a name of letters, digits and _, a letter first",
                               risorius::in_quotes(name));
        out.push_back({name, json.at(name)});
    }
    return out;
}

/// The values of a list, each with its position in the file.
std::vector<JsonCursor> made_levels(const std::vector<double>& values, const JsonCursor& from) {
    std::vector<JsonCursor> out;
    for (const double value : values)
        out.push_back(JsonCursor::from_json(json_number(value), from.place()));
    return out;
}

// A random number that depends only on its arguments, not on other random numbers of the design.
double chance(int seed, const std::string& name, int index) {
    CounterRng place(static_cast<std::uint64_t>(seed));
    for (const char c : name) place.at(static_cast<unsigned char>(c));
    return place.at(static_cast<std::uint64_t>(index)).uniform();
}

constexpr int kMaxLevels = 100000;
constexpr double kBroadcastLufs = -23;  // EBU R 128
constexpr int kMaxRounds = 50;
constexpr double kLongest_s = 3600;  // of a script or a picture

Factor read_factor(const JsonCursor& json, const std::string& name, int seed) {
    Factor factor{.name = name, .levels = {}};
    if (json.is_array()) {
        factor.levels = json.items();
    } else if (json.is_object() && json.has("draw")) {
        json.allow_keys({"draw", "count"});
        const std::vector<JsonCursor> ends = json.at("draw").items();
        if (ends.size() != 2) json.at("draw").fail("[min, max]");
        const double min = ends[0].number(), max = ends[1].number();
        std::vector<double> values;
        for (int i = 0; i < json.at("count").integer(1, kMaxLevels); ++i)
            values.push_back(min + (max - min) * chance(seed, name, i));
        factor.drawn = true;
        factor.levels = made_levels(values, json);
    } else if (json.is_object()) {
        json.allow_keys({"from", "to", "steps"});
        const double from = json.at("from").number(), to = json.at("to").number();
        const int steps = json.at("steps").integer(2, kMaxLevels);
        std::vector<double> values;
        for (int i = 0; i < steps; ++i)
            values.push_back(i + 1 == steps ? to : from + (to - from) * i / (steps - 1));
        factor.levels = made_levels(values, json);
    } else {
        json.fail("a list of values, {\"from\", \"to\", \"steps\"} or {\"draw\", \"count\"}");
    }
    if (factor.levels.empty()) json.fail("at least one value", "none");
    return factor;
}

std::vector<std::vector<Given>> read_rows(const JsonCursor& json) {
    if (json.is_string()) return read_table(existing_file(json));
    std::vector<std::vector<Given>> rows;
    for (const JsonCursor& row : json.items()) rows.push_back(read_values(row));
    if (rows.empty()) json.fail("at least one condition", "none");
    return rows;
}

/// Draws the trials of a set, and makes a row of conditions of each.
void add_sample(const JsonCursor& json, const JsonCursor& of, int seed, ConditionSet& set) {
    for (const char* key : {"conditions", "fraction", "draw"})
        if (of.has(key)) of.at(key).fail("nothing beside \"sample\", which draws the conditions");
    set.sample = read_sample(json);
    CounterRng place(static_cast<std::uint64_t>(seed));
    for (const char c : set.name) place.at(static_cast<unsigned char>(c));
    set.trials = sampled_trials(*set.sample, static_cast<unsigned>(place.bits()));
    set.rows.clear();
    for (const Trial& trial : set.trials)
        set.rows.push_back({{"trial", JsonCursor::from_json(trial.number, json.place())}});
}

ConditionSet read_set(const JsonCursor& json, int seed) {
    json.allow_keys({"name", "script", "parameters", "factors", "conditions", "fraction", "draw",
                     "overrides", "clip", "controls", "audio", "audio_start_s", "sample"});
    const JsonCursor script = json.at("script");
    ConditionSet set{
        .name = json.at("name").string(),
        .script = script.is_string() ? JsonCursor::read_file(existing_file(script)) : script,
        .parameters = {},
        .factors = {},
        .rows = {{}},
        .fraction = {},
        .draw = {},
        .overrides = {},
        .clip = json.at("clip").string(),
        .controls = {},
        .audio = json.find("audio"),
        .audio_start_s = json.find("audio_start_s"),
        .place = json.place()};
    if (clip_word(set.name).empty()) json.at("name").fail("a name with letters or digits");
    if (!set.script.is_object()) script.fail("a script, or the file of one");
    if (const auto v = json.find("parameters")) set.parameters = read_values(*v);
    if (const auto v = json.find("factors"))
        for (const std::string& name : v->keys()) {
            if (!is_parameter_name(name))
                v->at(name).fail("a name of letters, digits and _, a letter first",
                                 risorius::in_quotes(name));
            set.factors.push_back(read_factor(v->at(name), name, seed));
        }
    if (const auto v = json.find("conditions")) set.rows = read_rows(*v);
    if (const auto v = json.find("fraction")) {
        std::vector<std::string> names;
        for (const Factor& factor : set.factors) names.push_back(factor.name);
        set.fraction = read_fraction(*v, names);
    }
    if (set.audio_start_s && !set.audio) set.audio_start_s->fail("\"audio\" beside it", "none");
    if (const auto v = json.find("draw"))
        set.draw = v->integer(1, static_cast<int>(kMaxConditions));
    if (const auto v = json.find("overrides"))
        for (const JsonCursor& one : v->items()) {
            one.allow_keys({"when", "set"});
            set.overrides.push_back({read_values(one.at("when")), read_values(one.at("set"))});
        }
    if (const auto v = json.find("sample")) add_sample(*v, json, seed, set);
    if (const auto v = json.find("controls"))
        for (const JsonCursor& one : v->items()) set.controls.push_back(read_control(one));
    return set;
}

ClipOptions read_clips(const JsonCursor& json) {
    json.allow_keys({"ending", "quality", "crf", "lossless", "landmarks", "photodiode",
                     "keyframe_interval", "aois", "aoi_margin", "still_s", "shown_s"});
    ClipOptions clips;
    if (const auto v = json.find("ending"))
        clips.ending = v->one_of({"mp4", "mov", "mkv", "webm", "png"});
    for (const char* key : {"crf", "lossless", "keyframe_interval", "photodiode"})
        if (clips.pictures() && json.find(key))
            json.at(key).fail("none beside \"ending\": \"png\", which makes pictures");
    for (const char* key : {"still_s", "shown_s"})
        if (!clips.pictures() && json.find(key))
            json.at(key).fail("none without \"ending\": \"png\"");
    if (const auto v = json.find("still_s")) clips.still_s = v->number({0, kLongest_s});
    if (const auto v = json.find("shown_s")) clips.shown_s = v->number({0.001, kLongest_s});
    if (const auto v = json.find("quality"))
        clips.quality = v->one_of({"draft", "preview", "video", "fine"});
    if (const auto v = json.find("crf")) clips.crf = v->integer(0, 63);
    if (const auto v = json.find("lossless")) clips.lossless = v->boolean();
    if (clips.lossless && clips.crf)
        json.at("crf").fail("no crf beside \"lossless\": true, which has no quality to choose");
    if (const auto v = json.find("keyframe_interval"))
        clips.keyframe_interval = v->integer(1, kMaxLevels);
    if (const auto v = json.find("aois"))
        for (const JsonCursor& one : v->items()) {
            index_of_name(one.place(), one.string(), aoi_names());
            if (std::count(clips.aois.begin(), clips.aois.end(), one.string()) > 0)
                one.fail("each area once", risorius::in_quotes(one.string()) + " again");
            clips.aois.push_back(one.string());
        }
    if (const auto v = json.find("aoi_margin")) clips.aoi_margin = v->number({0, 0.2});
    if (const auto v = json.find("landmarks")) clips.landmarks = v->boolean();
    if (const auto v = json.find("photodiode")) clips.photodiode = v->string();
    return clips;
}

LuminanceMatch read_luminance(const JsonCursor& json) {
    using OneFor = LuminanceMatch::OneFor;
    json.allow_keys({"within", "one_for", "mean", "sd", "cut_limit", "allow_clipping", "histogram",
                     "spectrum", "rounds", "colour"});
    LuminanceMatch out;
    if (const auto v = json.find("within"))
        out.within_face = v->one_of({"picture", "face"}) == "face";
    out.one_for = out.within_face ? OneFor::kIdentity : OneFor::kAll;
    if (const auto v = json.find("one_for")) {
        const std::string name = v->one_of({"all", "identity", "clip"});
        out.one_for = name == "all"        ? OneFor::kAll
                      : name == "identity" ? OneFor::kIdentity
                                           : OneFor::kClip;
    }
    if (const auto v = json.find("mean")) out.mean = v->number({0.001, 0.999});
    if (const auto v = json.find("sd")) out.sd = v->number({0.001, 0.5});
    if (const auto v = json.find("cut_limit")) out.cut_limit = v->number({0, 1});
    if (const auto v = json.find("allow_clipping")) out.allow_clipping = v->boolean();
    if (const auto v = json.find("histogram")) out.histogram = v->boolean();
    if (const auto v = json.find("spectrum")) out.spectrum = v->one_of({"rotational"}) != "";
    if (const auto v = json.find("rounds")) {
        if (!out.spectrum) v->fail("\"spectrum\" beside it", "none");
        out.rounds = v->integer(1, kMaxRounds);
    }
    if (const auto v = json.find("colour")) out.grey = v->one_of({"keep", "grey"}) == "grey";
    if (out.one_for == OneFor::kAll && !out.mean && !out.sd)
        json.fail(
            "\"mean\" or \"sd\" to match all clips to, or \"one_for\": \"identity\" or \"clip\"",
            "none of them");
    return out;
}

MotionMatch read_motion(const JsonCursor& json) {
    json.allow_keys({"share", "of", "apex_s", "apex_of"});
    MotionMatch out;
    const auto parameter = [&](const char* key) {
        const JsonCursor name = json.at(key);
        if (!is_parameter_name(name.string())) name.fail("the name of a parameter");
        return name.string();
    };
    const auto apex = json.find("apex_s");
    if (!apex || json.find("share")) {
        out.share = json.at("share").items();
        for (const JsonCursor& share : out.share) share.number({0.01, 1});
        if (out.share.empty()) json.at("share").fail("at least one share", "none");
    }
    if (!out.share.empty())
        out.of = parameter("of");
    else if (const auto v = json.find("of"))
        v->fail("\"share\" beside it", "none");
    if (apex) out.apex_s = apex->number({0.01, 60});
    if (const auto v = json.find("apex_of")) {
        if (!apex) v->fail("\"apex_s\" beside it", "none");
        out.apex_of = parameter("apex_of");
        if (out.apex_of == out.of) v->fail("another parameter than \"of\"");
    }
    return out;
}

Match read_match(const JsonCursor& json) {
    json.allow_keys({"luminance", "loudness", "motion"});
    Match match;
    if (const auto motion = json.find("motion")) match.motion = read_motion(*motion);
    if (const auto luminance = json.find("luminance")) {
        match.luminance = read_luminance(*luminance);
    }
    if (const auto loudness = json.find("loudness")) {
        loudness->allow_keys({"lufs"});
        match.loudness_lufs = kBroadcastLufs;
        if (const auto v = loudness->find("lufs")) match.loudness_lufs = v->number({-70, 0});
    }
    return match;
}

/// A key that every keyboard has, and whose name both programs use.
bool is_key(const std::string& name) {
    return name.size() == 1 && (std::islower(static_cast<unsigned char>(name[0])) ||
                                std::isdigit(static_cast<unsigned char>(name[0])));
}
constexpr const char* kKeys = "a key from a to z or 0 to 9";

/// How the trials of an experiment follow one another.
void read_course(const JsonCursor& json, ExperimentOptions& out) {
    if (const auto v = json.find("repetitions")) out.repetitions = v->integer(1, 1000);
    if (const auto v = json.find("fixation_s")) out.fixation_s = v->number({0, 60});
    if (const auto v = json.find("answer_during")) out.answer_during = v->boolean();
    if (const auto v = json.find("blocks")) out.blocks = v->integer(1, 100);
    if (const auto v = json.find("practice")) out.practice = v->integer(0, 1000);
    if (const auto v = json.find("catch")) out.catch_share = v->number({0, 0.5});
    const auto method = json.find("method");
    using Method = ExperimentOptions::Method;
    if (method)
        out.method =
            static_cast<Method>(index_of_name(method->place(), method->string(), method_names()));
    if (out.method == Method::kConstant) {
        for (const char* key : {"over", "series_by", "trials"})
            if (const auto v = json.find(key))
                v->fail("none without a \"method\" that chooses its clips");
        return;
    }
    if (!out.correct)
        method->fail("\"correct\" beside it, the parameter of the right answer", "none");
    for (const std::string& program : out.programs)
        if (program == "jspsych" && out.method != Method::kQuestPlus)
            method->fail("\"constant\" or \"questplus\" for jspsych, which has no other method");
    if (const auto v = json.find("repetitions"))
        v->fail("none beside a method that chooses its clips; \"trials\" says how many");
    out.series_by = {*out.correct};
    if (const auto v = json.find("over")) out.over = v->string();
    if (const auto v = json.find("series_by")) {
        out.series_by.clear();
        for (const JsonCursor& one : v->items()) out.series_by.push_back(one.string());
    }
    if (const auto v = json.find("trials")) out.trials = v->integer(1, 1000);
}

ExperimentOptions read_experiment(const JsonCursor& json) {
    json.allow_keys({"programs", "question", "answers", "correct", "sets", "controls",
                     "repetitions", "fixation_s", "answer_during", "blocks", "practice", "catch",
                     "method", "over", "series_by", "trials", "scales", "jspsych_from"});
    ExperimentOptions out;
    for (const JsonCursor& one : json.at("programs").items())
        out.programs.push_back(one.one_of({"psychopy", "jspsych", "rating"}));
    if (out.programs.empty()) json.at("programs").fail("at least one program", "none");
    if (const auto v = json.find("question")) out.question = v->string();
    const JsonCursor answers = json.at("answers");
    for (const std::string& key : answers.keys()) {
        if (!is_key(key)) answers.at(key).fail(kKeys, risorius::in_quotes(key));
        out.answers.emplace_back(key, answers.at(key).string());
    }
    if (out.answers.empty()) answers.fail("at least one key to answer with", "none");
    if (const auto v = json.find("correct")) out.correct = v->string();
    if (const auto v = json.find("sets"))
        for (const JsonCursor& one : v->items()) out.sets.push_back(one.string());
    if (const auto v = json.find("controls")) out.controls = v->boolean();
    read_course(json, out);
    out.scales = rating_scales();
    if (const auto v = json.find("scales")) {
        out.scales.clear();
        const std::vector<std::string_view> known(rating_scales().begin(), rating_scales().end());
        for (const JsonCursor& one : v->items()) out.scales.push_back(one.one_of(known));
    }
    if (const auto v = json.find("jspsych_from")) out.jspsych_from = v->string();
    return out;
}

TriggerOptions read_triggers(const JsonCursor& json) {
    json.allow_keys(
        {"pulse_ms", "codes", "code_by", "response", "lsl", "wait_for", "dummy_volumes"});
    TriggerOptions out;
    const auto codes = json.find("codes");
    if (codes && codes->one_of({"moments", "condition"}) == "condition") out.code_by = {"stim_id"};
    if (const auto by = json.find("code_by")) {
        if (out.code_by.empty()) by->fail("\"codes\": \"condition\" beside it", "none");
        out.code_by.clear();
        for (const JsonCursor& one : by->items()) out.code_by.push_back(one.string());
        if (out.code_by.empty()) by->fail("at least one parameter", "none");
    }
    if (const auto pulse = json.find("pulse_ms")) out.pulse_ms = pulse->number({1, 1000});
    if (const auto v = json.find("response")) out.response = v->boolean();
    if (const auto v = json.find("lsl")) out.lsl = v->boolean();
    if (const auto v = json.find("wait_for")) {
        out.wait_for = v->string();
        if (!is_key(out.wait_for)) v->fail(kKeys, risorius::in_quotes(out.wait_for));
    }
    if (const auto v = json.find("dummy_volumes")) {
        if (out.wait_for.empty()) v->fail("\"wait_for\" beside it", "none");
        out.dummy_volumes = v->integer(0, 1000);
    }
    return out;
}

/// Checks that the design has everything that the experiment names.
void check_experiment(const JsonCursor& json, const Design& design) {
    std::vector<std::string> names;
    for (const ConditionSet& set : design.sets) names.push_back(set.name);
    for (std::size_t i = 0; i < design.experiment->sets.size(); ++i)
        index_of_name(json.at("sets").items()[i].place(), design.experiment->sets[i], names);
    for (const auto& [key, answer] : design.experiment->answers)
        if (key == design.triggers.wait_for)
            json.at("answers").at(key).fail("a key that the pulses of the scanner do not press");
}

}  // namespace

const std::vector<std::string>& method_names() {
    static const std::vector<std::string> kNames{"constant", "staircase", "quest", "questplus"};
    return kNames;
}

const std::vector<std::string>& rating_scales() {
    static const std::vector<std::string> kNames{"valence", "arousal", "intensity", "naturalness"};
    return kNames;
}

const std::vector<std::string>& aoi_names() {
    static const std::vector<std::string> kNames{"eye_l", "eye_r", "brow_l", "brow_r",
                                                 "nose",  "mouth", "face"};
    return kNames;
}

Design read_design(const std::filesystem::path& file) {
    const JsonCursor json = JsonCursor::read_file(file);
    json.at("format").one_of({"risorius-design"});
    const JsonCursor version = json.at("version");
    if (version.json() != 1) version.fail("1, the version of the format this program reads");
    json.allow_keys({"format", "version", "name", "seed", "clips", "match", "experiment",
                     "triggers", "dataset", "parameters", "sets"});
    Design design;
    design.file = file;
    design.name = json.at("name").string();
    if (const auto v = json.find("seed")) design.seed = v->integer(0, 2147483647);
    if (const auto v = json.find("clips")) design.clips = read_clips(*v);
    if (const auto v = json.find("match")) design.match = read_match(*v);
    if (design.match.motion && design.clips.still_s)
        json.at("clips").at("still_s").fail(
            "none beside a match of motion, which is that at the apex");
    if (const auto v = json.find("experiment")) design.experiment = read_experiment(*v);
    if (const auto v = json.find("dataset")) {
        v->allow_keys({"authors", "license", "copyright"});
        if (const auto authors = v->find("authors"))
            for (const JsonCursor& one : authors->items())
                design.dataset.authors.push_back(one.string());
        if (const auto text = v->find("license")) design.dataset.license = text->string();
        if (const auto text = v->find("copyright")) design.dataset.copyright = text->string();
    }
    if (const auto v = json.find("triggers")) design.triggers = read_triggers(*v);
    if (const auto v = json.find("parameters")) design.parameters = read_values(*v);
    std::set<std::string> names;
    for (const JsonCursor& set : json.at("sets").items()) {
        design.sets.push_back(read_set(set, design.seed));
        if (!names.insert(design.sets.back().name).second)
            set.at("name").fail("every set's name once",
                                risorius::in_quotes(design.sets.back().name) + " again");
    }
    if (design.match.motion && !design.match.motion->share.empty())
        for (ConditionSet& set : design.sets)
            set.factors.push_back({.name = kSeenStep, .levels = design.match.motion->share});
    if (design.sets.empty()) json.at("sets").fail("at least one set of conditions", "none");
    if (design.experiment) check_experiment(json.at("experiment"), design);
    return design;
}

}  // namespace risorius::design
