// SPDX-License-Identifier: MIT
#include "tools/calibrate/unit_weights.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/core/output_set.h"
#include "risorius/face/face.h"
#include "risorius/fitting/fit_units.h"
#include "risorius/inverse/fit_activations.h"
#include "risorius/rig/expression_drive.h"
#include "risorius/scene/landmark_points.h"

namespace risorius::calibrate {

namespace {

constexpr double kStayWeight = 0.25;

struct UnitGoal {
    std::string unit;
    std::vector<std::string> muscles;
    std::map<std::string, Vec3> go_mm;  // both sides
    std::map<std::string, double> weight;
    std::map<std::string, double> from;
};

struct HeadAtWork {
    explicit HeadAtWork(const std::filesystem::path& file)
        : files(scene::read_rig_files(file)),
          face(files.rig, files.mesh, face::quality_named("preview"), files.place()),
          points(face.head(), files.rig),
          channels(files.rig.channels()) {
        rest.excitation = Eigen::VectorXd::Zero(channels.column_count());
    }
    scene::RigFiles files;
    face::Face face;
    scene::LandmarkPoints points;
    track::ChannelTable channels;
    track::Drive rest;
};

UnitGoal read_goal(const std::string& unit, const JsonCursor& json,
                   const std::vector<std::string>& known) {
    json.allow_keys({"muscles", "go", "stay", "from"});
    UnitGoal out{unit, {}, {}, {}, {}};
    const auto add = [&](const std::string& id, const Vec3& mm, double weight) {
        if (std::find(known.begin(), known.end(), id) != known.end()) {
            out.go_mm[id] = mm;
            out.weight[id] = weight;
            return;
        }
        out.go_mm[id + "_l"] = mm;
        out.go_mm[id + "_r"] = Vec3(-mm.x(), mm.y(), mm.z());
        out.weight[id + "_l"] = out.weight[id + "_r"] = weight;
    };
    for (const JsonCursor& muscle : json.at("muscles").items())
        out.muscles.push_back(muscle.string());
    if (const auto stay = json.find("stay"))
        for (const JsonCursor& id : stay->items()) add(id.string(), Vec3::Zero(), kStayWeight);
    for (const std::string& id : json.at("go").keys()) add(id, json.at("go").at(id).vec3(), 1);
    if (const auto from = json.find("from"))
        for (const std::string& muscle : from->keys())
            out.from[muscle] = from->at(muscle).number({-1, 1});
    return out;
}

std::vector<inverse::ActivationUnknown> unknowns_of(const UnitGoal& goal,
                                                    const track::ChannelTable& channels) {
    std::vector<inverse::ActivationUnknown> out;
    for (const std::string& muscle : goal.muscles) {
        inverse::ActivationUnknown one{muscle, {}, {}, 0, 1, 1};
        const int left = channels.column(muscle, Side::kLeft);
        const int right = channels.column(muscle, Side::kRight);
        one.columns.push_back(left);
        if (right != left) one.columns.push_back(right);
        out.push_back(one);
    }
    return out;
}

// The drive of the unit with the muscles of the goal alone; jaw and eyes as in the table.
track::Drive begin_drive(const HeadAtWork& head, const UnitGoal& goal,
                         const std::vector<inverse::ActivationUnknown>& unknowns,
                         const std::map<std::string, double>* weights) {
    const track::Expansion table =
        track::expand(*head.files.rig.facs.find(goal.unit), std::nullopt, head.channels);
    track::Expansion own = table;
    own.excitation.setZero();
    for (const inverse::ActivationUnknown& one : unknowns) {
        double value = goal.from.empty() ? table.excitation[one.columns[0]] : 0.0;
        const std::map<std::string, double>& from = weights ? *weights : goal.from;
        if (const auto found = from.find(one.name); found != from.end()) value = found->second;
        for (const int column : one.columns) own.excitation[column] = value;
    }
    return rig::clamped_drive(own, head.channels);
}

Vec3 moved_mm(const HeadAtWork& head, const std::string& id, const Points& vertices) {
    return 1e3 * (head.points.at(id, vertices) - head.points.at(id, head.face.head().vertices)) /
           head.face.head().size;
}

std::map<std::string, double> fit_on(HeadAtWork& head, const UnitGoal& goal, double keep) {
    const std::vector<inverse::ActivationUnknown> unknowns = unknowns_of(goal, head.channels);
    const track::Drive begin = begin_drive(head, goal, unknowns, nullptr);
    const long count = head.face.head().vertices.rows();
    Points measured = Points::Zero(count, 3);
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(count);
    double size = 0;
    for (const auto& [id, mm] : goal.go_mm) {
        const int v = head.points.vertex(id);
        measured.row(v) = 1e-3 * head.face.head().size * mm.transpose();
        weight[v] = goal.weight.at(id);
        size += weight[v] * measured.row(v).squaredNorm();
    }
    inverse::ActivationFitOptions options;
    options.rounds = 20;
    options.l1_weight = 1e-3;
    options.l2_weight = 1e-3;
    options.keep = keep;
    options.size = size;
    options.near.resize(static_cast<long>(unknowns.size()));
    for (std::size_t i = 0; i < unknowns.size(); ++i)
        options.near[static_cast<long>(i)] = inverse::value_of(unknowns[i], begin);
    head.face.start([&](double) { return head.rest; });
    const track::Drive found =
        inverse::fit_activations(head.face, unknowns, measured, weight, begin, options);
    std::map<std::string, double> out;
    for (const inverse::ActivationUnknown& one : unknowns)
        out[one.name] = inverse::value_of(one, found);
    return out;
}

void report(HeadAtWork& head, const UnitGoal& goal, const std::map<std::string, double>* weights) {
    const std::vector<inverse::ActivationUnknown> unknowns = unknowns_of(goal, head.channels);
    const track::Drive drive =
        weights ? begin_drive(head, goal, unknowns, weights)
                : rig::clamped_drive(track::expand(*head.files.rig.facs.find(goal.unit),
                                                   std::nullopt, head.channels),
                                     head.channels);
    head.face.start([&](double) { return head.rest; });
    head.face.solve_equilibrium(drive.excitation, drive, {.iterations = face::kRestIterations});
    const Points vertices = head.face.pose().vertices;
    for (const auto& [id, mm] : goal.go_mm) {
        if (id.size() > 2 && id.substr(id.size() - 2) == "_r") continue;
        const Vec3 moved = moved_mm(head, id, vertices);
        std::printf("   %s (%.1f %.1f %.1f", id.c_str(), moved.x(), moved.y(), moved.z());
        if (!mm.isZero()) std::printf(" of %.1f %.1f %.1f", mm.x(), mm.y(), mm.z());
        std::printf(")");
    }
    std::printf("\n");
}

}  // namespace

void find_unit_weights(const std::vector<std::filesystem::path>& rigs,
                       const std::filesystem::path& goals, const std::vector<std::string>& only,
                       double keep) {
    std::vector<std::unique_ptr<HeadAtWork>> heads;
    for (const std::filesystem::path& rig : rigs)
        heads.push_back(std::make_unique<HeadAtWork>(rig));
    std::vector<std::string> landmarks;
    for (const rig::AtlasLandmark& one : heads[0]->files.rig.atlas.landmarks)
        landmarks.push_back(one.id);
    const JsonCursor json = JsonCursor::read_file(goals);
    for (const std::string& unit : only.empty() ? json.keys() : only) {
        const UnitGoal goal = read_goal(unit, json.at(unit), landmarks);
        std::map<std::string, double> mean;
        std::printf("%s\n", unit.c_str());
        for (const auto& head : heads) {
            const std::map<std::string, double> found = fit_on(*head, goal, keep);
            std::printf("  %s:", head->files.rig.name.c_str());
            for (const auto& [muscle, weight] : found) {
                mean[muscle] += weight / static_cast<double>(heads.size());
                if (weight > 0.02) std::printf(" %s %.2f", muscle.c_str(), weight);
            }
            std::printf("\n");
        }
        std::printf("  mean: {");
        for (auto& [muscle, weight] : mean) {
            weight = std::round(100 * weight) / 100;
            if (weight < 0.04) weight = 0;
            if (weight > 0) std::printf("\"%s\": %.2f, ", muscle.c_str(), weight);
        }
        std::printf("}\n");
        for (const auto& head : heads) {
            std::printf("  %s today:", head->files.rig.name.c_str());
            report(*head, goal, nullptr);
            std::printf("  %s mean: ", head->files.rig.name.c_str());
            report(*head, goal, &mean);
        }
        std::fflush(stdout);
    }
}

void write_unit_gains(const std::filesystem::path& file) {
    Json json = JsonCursor::read_file(file).json();
    json.erase("unit_gains");
    write_file(file, json_text(json, 1) + "\n");
    const scene::RigFiles files = scene::read_rig_files(file);
    face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
    face::FaceTeam team(face);
    for (const auto& [unit, gain] : fitting::fit_units(team, files.rig, {})) {
        std::printf("%-8s muscles %.3f reached %.2f\n", unit.c_str(), gain.muscles, gain.reached);
        json["unit_gains"][unit] = rig::unit_gain_json(gain);
    }
    write_file(file, json_text(json, 1) + "\n");
}

}  // namespace risorius::calibrate
