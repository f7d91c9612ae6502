// SPDX-License-Identifier: MIT
#include "risorius/study/study_description.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/existing_file.h"
#include "risorius/core/known_names.h"
#include "risorius/core/readable_text.h"
#include "risorius/face/quality.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/rig/rig_description.h"
#include "risorius/sensitivity/sobol_sequence.h"
#include "risorius/study/rig_numbers.h"

namespace risorius::study {

namespace {

constexpr int kMaxCount = 1 << 16;
constexpr int kMaxRuns = 1'000'000;
constexpr int kMaxReplicates = 10'000;

/// Letters, digits, "_" and "-": names become parts of the names of files.
std::string plain_name(const JsonCursor& json, const std::string& name) {
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_' || c == '-';
    });
    if (name.empty() || name.front() == '-' || name.size() > 60 || !plain)
        json.fail("a name of letters, digits, _ and -, at most 60", in_quotes(name));
    return name;
}

std::vector<std::string> read_paths(const JsonCursor& json) {
    if (json.is_string()) return {json.string()};
    std::vector<std::string> out;
    for (const JsonCursor& item : json.items()) out.push_back(item.string());
    if (out.empty()) json.fail("at least one path", "none");
    return out;
}

Parameter read_parameter(const JsonCursor& json, const std::string& name, const Json& rig) {
    json.allow_keys({"of", "factor", "add", "set", "each"});
    Parameter out;
    out.name = plain_name(json, name);
    out.place = json.place();
    out.of = read_paths(json.at("of"));
    int ways = 0;
    for (const auto& [key, how] : {std::pair{"factor", Parameter::How::kFactor},
                                   {"add", Parameter::How::kAdd},
                                   {"set", Parameter::How::kSet}})
        if (const auto found = json.find(key)) {
            out.how = how;
            out.distribution = sensitivity::read_distribution(*found);
            ++ways;
        }
    if (ways != 1)
        json.fail("one of \"factor\", \"add\" and \"set\"", std::to_string(ways) + " of them");
    if (const auto each = json.find("each")) out.each = each->boolean();
    std::set<std::string> known;
    for (const std::string& path : out.of)
        for (const std::string& number : rig_numbers(rig, path, json.at("of").place()))
            if (known.insert(number).second) out.numbers.push_back(number);
    return out;
}

void read_parameters(const JsonCursor& json, StudyDescription& study) {
    std::map<std::string, std::string> owners;
    int single = 0;
    for (const std::string& name : json.keys()) {
        Parameter parameter = read_parameter(json.at(name), name, *study.rig_json);
        for (const std::string& number : parameter.numbers)
            if (const auto [owner, is_new] = owners.emplace(number, name); !is_new)
                json.at(name).at("of").fail(
                    "numbers that no other parameter has",
                    number.substr(1) + ", which is one of " + in_quotes(owner->second));
        single += parameter.each ? 0 : 1;
        study.parameters.push_back(std::move(parameter));
    }
    if (study.parameters.empty()) json.fail("at least one parameter", "none");
    constexpr int kMostSingle = sensitivity::SobolSequence::kMaxDimensions / 2;
    if (single > kMostSingle)
        json.fail("at most " + std::to_string(kMostSingle) + " parameters without \"each\"",
                  std::to_string(single));
}

/// Reads {muscle or channel: value}, as scripts name them.
track::Drive read_drive(const JsonCursor& json, const track::ChannelTable& channels) {
    track::Drive drive;
    drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
    const Eigen::VectorXd least = channels.column_min();
    for (const std::string& name : json.keys()) {
        const JsonCursor value = json.at(name);
        const std::vector<track::Kinematic> kinematic = track::kinematic_named(name);
        for (const track::Kinematic channel : kinematic) {
            const auto at = static_cast<std::size_t>(channel);
            const track::KinematicChannel& known = track::kinematic_channels()[at];
            drive.kinematic[at] = value.number({known.min, known.max});
        }
        if (!kinematic.empty()) continue;
        const track::SidedName muscle = track::split_side(name);
        if (!channels.find(muscle.id)) {
            std::vector<std::string> names;
            for (const track::MuscleChannel& known : channels.muscles) names.push_back(known.id);
            for (const track::KinematicChannel& known : track::kinematic_channels())
                names.emplace_back(known.name);
            value.fail("a muscle or channel of the rig" + did_you_mean(name, names),
                       in_quotes(name));
        }
        for (const Side side : {Side::kLeft, Side::kRight}) {
            if (muscle.side && *muscle.side != side) continue;
            const int column = channels.column(muscle.id, side);
            drive.excitation[column] = value.number({least[column], 1});
        }
    }
    return drive;
}

std::vector<Pose> read_poses(const JsonCursor& json, const rig::RigDescription& rig) {
    std::vector<Pose> out;
    const track::ChannelTable channels = rig.channels();
    for (const JsonCursor& item : json.items()) {
        Pose pose;
        if (item.is_string()) {
            pose.name = item.string();
            const auto expansion = rig::expansion_at(rig, pose.name, 1);
            // 1 of a channel may be a degree or a pascal: its value must be given
            if (!expansion || !track::kinematic_named(pose.name).empty())
                item.fail("an expression, action unit, shape or muscle of the rig",
                          in_quotes(pose.name));
            pose.drive = rig::clamped_drive(*expansion, channels);
        } else {
            item.allow_keys({"name", "activation"});
            pose.name = item.at("name").string();
            pose.drive = read_drive(item.at("activation"), channels);
        }
        plain_name(item, pose.name);
        for (const Pose& other : out)
            if (other.name == pose.name)
                item.fail("a pose with another name", in_quotes(pose.name));
        out.push_back(std::move(pose));
    }
    if (out.empty()) json.fail("at least one pose", "none");
    return out;
}

std::vector<std::string> read_landmark_names(const JsonCursor& json,
                                             const rig::RigDescription& rig) {
    const std::vector<std::string> known = rig.atlas.landmark_ids();
    std::vector<std::string> out;
    for (const JsonCursor& item : json.items()) {
        out.push_back(known[index_of_name(item.place(), item.string(), known)]);
        if (std::count(out.begin(), out.end(), out.back()) > 1)
            item.fail("each landmark once", in_quotes(out.back()) + " again");
    }
    if (out.empty()) json.fail("at least one landmark", "none");
    return out;
}

/// Landmarks of brows, eyes, nose, mouth, cheeks and chin.
std::vector<std::string> face_landmarks(const rig::RigDescription& rig) {
    static const std::set<std::string> kFace{"brow", "eye",        "nose", "lip",
                                             "chin", "nasolabial", "cheek"};
    std::vector<std::string> out;
    for (const rig::AtlasLandmark& landmark : rig.atlas.landmarks)
        if (kFace.count(landmark.region)) out.push_back(landmark.id);
    return out;
}

void read_sample_options(const JsonCursor& json, StudyDescription& study) {
    using sensitivity::Sampling;
    json.allow_keys({"method", "count", "seed", "indices", "replicates"});
    if (const auto v = json.find("method")) {
        const std::string method = v->one_of({"sobol", "latin_hypercube", "random"});
        study.sampling = method == "sobol"             ? Sampling::kSobol
                         : method == "latin_hypercube" ? Sampling::kLatinHypercube
                                                       : Sampling::kRandom;
    }
    if (const auto v = json.find("count")) study.count = v->integer(2, kMaxCount);
    if (const auto v = json.find("seed"))
        study.seed = static_cast<std::uint64_t>(v->integer(0, std::numeric_limits<int>::max()));
    if (const auto v = json.find("indices")) study.indices = v->boolean();
    if (const auto v = json.find("replicates")) study.replicates = v->integer(2, kMaxReplicates);
    if (study.runs() > kMaxRuns)
        json.fail("at most " + std::to_string(kMaxRuns) + " faces", std::to_string(study.runs()));
}

}  // namespace

std::string Parameter::text() const {
    return std::string(how == How::kFactor ? "factor, "
                       : how == How::kAdd  ? "add, "
                                           : "set, ") +
           distribution.text();
}

int StudyDescription::runs() const {
    return 1 + count * (indices ? static_cast<int>(parameters.size()) + 2 : 1);
}

StudyDescription read_study(const std::filesystem::path& file) {
    StudyDescription study = read_study(JsonCursor::read_file(file));
    study.file = file;
    return study;
}

StudyDescription read_study(const JsonCursor& json) {
    json.at("format").one_of({"risorius-study"});
    json.allow_keys(
        {"format", "version", "name", "rig", "quality", "poses", "landmarks", "vary", "sample"});
    json.at("version").integer(1, 1);
    StudyDescription study;
    study.name = json.at("name").string();
    study.rig = existing_file(json.at("rig"));
    study.rig_json = std::make_shared<const Json>(rig::resolved_rig(study.rig));
    const rig::RigDescription rig =
        rig::read_rig(JsonCursor::from_json(*study.rig_json, study.rig.string()));
    if (const auto v = json.find("quality"))
        study.quality = v->one_of({"draft", "preview", "video", "fine"});
    study.poses = read_poses(json.at("poses"), rig);
    study.landmarks = json.has("landmarks") ? read_landmark_names(json.at("landmarks"), rig)
                                            : face_landmarks(rig);
    read_parameters(json.at("vary"), study);
    if (const auto sample = json.find("sample")) read_sample_options(*sample, study);
    return study;
}

}  // namespace risorius::study
