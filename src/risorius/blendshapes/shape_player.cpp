// SPDX-License-Identifier: MIT
#include "risorius/blendshapes/shape_player.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/face/surfaces.h"
#include "risorius/io/morph_model.h"

namespace risorius::blendshapes {

namespace {

constexpr double kSamePlace_m = 1e-4;  // tolerance of vertex positions, which a file rounds

// Checks that the vertices lie where the rig's mesh has them; otherwise shapes would move the wrong vertices.
void check_mesh(const io::MorphModel& model, const rig::Head& head,
                const std::filesystem::path& file) {
    const auto fail = [&](const std::string& found) {
        throw Error(file.string(),
                    "the rig's mesh of " + std::to_string(head.vertices.rows()) + " vertices",
                    found);
    };
    if (model.vertices.rows() > head.vertices.rows())
        fail("one of " + std::to_string(model.vertices.rows()));
    for (const io::MorphPart& part : model.parts)
        for (const int v : part.triangles.reshaped())
            if (const double apart = (model.vertices.row(v) - head.vertices.row(v)).norm();
                apart > kSamePlace_m)
                fail("another, whose vertex " + std::to_string(v) + " is " +
                     format_number(std::round(1e4 * apart) / 10) + " mm off");
}

}  // namespace

ShapesOfFile read_shapes_of_file(const std::filesystem::path& file, const scene::RigFiles& files,
                                 const rig::Head& head) {
    const io::MorphModel model = io::read_glb(file);
    check_mesh(model, head, file);
    const JsonCursor extras = JsonCursor::from_json(model.extras, file.string()).at("risorius");
    if (const int vertices = extras.at("vertices").integer(1, 1 << 30);
        vertices != head.vertices.rows())
        extras.at("vertices")
            .fail("the " + std::to_string(head.vertices.rows()) + " vertices of the rig's mesh");
    if (const auto level = extras.find("level"))
        level->fail("the file shapes.glb, which has all vertices", "a coarser level of detail");
    ShapesOfFile out;
    out.set = extras.at("set").string();

    // Correctives follow the shapes in the order of their list. Writers of glTF leave empty lists out.
    const auto listed = [&](const char* key) {
        const auto found = extras.find(key);
        return found && !found->json().is_null() ? found->items() : std::vector<JsonCursor>{};
    };
    const std::vector<JsonCursor> correctives = listed("correctives");
    if (correctives.size() >= model.targets.size())
        extras.fail("fewer correctives than morph targets", std::to_string(correctives.size()));
    const std::size_t count = model.targets.size() - correctives.size();
    std::vector<std::string> names;
    for (std::size_t s = 0; s < count; ++s) {
        names.push_back(model.targets[s].name);
        out.rig.shapes.push_back({model.targets[s].vertex, model.targets[s].delta});
    }
    const ShapeSet set = shape_set(files.rig, out.set, names, file.string(), file.string());
    for (const std::string& name : names) {
        const auto index = set.index(name);
        if (!index || set.goals.size() != count)
            throw Error(file.string(), "shapes of the rig's table, each with its other half",
                        "\"" + name + "\" among " + std::to_string(count));
        out.goals.push_back(set.goals[static_cast<std::size_t>(*index)]);
    }
    const auto indices_of = [&](const JsonCursor& list) {
        std::vector<int> indices;
        for (const JsonCursor& name : list.items())
            indices.push_back(static_cast<int>(index_of_name(name.place(), name.string(), names)));
        return indices;
    };
    const std::vector<JsonCursor> drivers = listed("terms");
    std::vector<std::string> terms;
    for (const JsonCursor& json : drivers) {
        blendshapes::Driver& driver = out.rig.drivers.emplace_back();
        driver.name = json.at("name").string();
        terms.push_back(driver.name);
        driver.shapes = indices_of(json.at("drivers"));
        if (driver.shapes.empty()) json.at("drivers").fail("at least one shape");
        if (driver.shapes.size() == 1) driver.part = json.at("part").integer(1, 3);
        if (const auto others = json.find("fades_with")) driver.fades_with = indices_of(*others);
    }
    for (std::size_t c = 0; c < correctives.size(); ++c) {
        blendshapes::Corrective& one = out.rig.correctives.emplace_back();
        const io::MorphTarget& target = model.targets[count + c];
        one.name = correctives[c].at("name").string();
        if (one.name != target.name)
            correctives[c].at("name").fail("the morph target \"" + target.name + "\"");
        one.shape = {target.vertex, target.delta};
        if (const auto term = correctives[c].find("term")) {
            one.of_drivers = Eigen::VectorXd::Unit(
                static_cast<long>(terms.size()),
                static_cast<long>(index_of_name(term->place(), term->string(), terms)));
            continue;
        }
        const std::vector<JsonCursor> fractions = correctives[c].at("of_terms").items();
        if (fractions.size() != drivers.size())
            correctives[c]
                .at("of_terms")
                .fail("a number for each of " + std::to_string(drivers.size()) + " terms");
        one.of_drivers.resize(static_cast<long>(fractions.size()));
        for (std::size_t t = 0; t < fractions.size(); ++t)
            one.of_drivers[static_cast<long>(t)] = fractions[t].number();
    }
    return out;
}

ShapePlayer::ShapePlayer(ShapesOfFile shapes, face::Face& face, const track::ChannelTable& channels)
    : shapes_(std::move(shapes)),
      packed_(shapes_.rig),
      face_(face),
      weights_(face, channels, shapes_.goals) {}

face::FacePose ShapePlayer::pose(const track::Drive& drive) const {
    Points vertices = face_.head().vertices;
    packed_.add_to(vertices, shapes_.rig.all_weights(weights_.of(drive)));
    return face_.surfaces().posed(std::move(vertices), drive);
}

}  // namespace risorius::blendshapes
