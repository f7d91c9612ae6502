// SPDX-License-Identifier: MIT
#include "risorius/headmodel/detail/tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"
#include "risorius/core/known_names.h"
#include "risorius/core/text_lines.h"
#include "risorius/render/hair_styles.h"

namespace risorius::headmodel {
namespace {

std::vector<std::vector<std::string>> read_csv(const std::filesystem::path& file) {
    const std::string text = read_text(file, {"a readable table", 32 * kMegabyte});
    std::vector<std::vector<std::string>> rows;
    for (TextLines lines(text); lines.next();) {
        const std::string line(lines.line());
        if (line.empty() || line[0] == '#') continue;
        std::vector<std::string> cells;
        std::string cell;
        std::istringstream stream(line);
        while (std::getline(stream, cell, ',')) cells.push_back(cell);
        if (line.back() == ',') cells.emplace_back();
        if (!rows.empty() && cells.size() != rows[0].size())
            throw Error(file.string() + ": row " + std::to_string(rows.size() + 1),
                        std::to_string(rows[0].size()) + " cells", std::to_string(cells.size()));
        rows.push_back(std::move(cells));
    }
    if (rows.size() < 2) throw Error(file.string(), "a header and at least one row", "less");
    return rows;
}

double number(const std::filesystem::path& file, const std::string& cell) {
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(cell, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    if (used != cell.size()) throw Error(file.string(), "a number", "\"" + cell + "\"");
    return value;
}

GridTable read_grid(const std::filesystem::path& file) {
    const auto cells = read_csv(file);
    GridTable table;
    for (std::size_t c = 1; c < cells[0].size(); ++c)
        table.columns.push_back(number(file, cells[0][c]));
    for (std::size_t r = 1; r < cells.size(); ++r) {
        table.rows.push_back(number(file, cells[r][0]));
        table.value.emplace_back();
        for (std::size_t c = 1; c < cells[r].size(); ++c)
            table.value.back().push_back(number(file, cells[r][c]));
    }
    return table;
}

std::map<std::string, std::vector<LoopPoint>> read_loops(const std::filesystem::path& file) {
    std::map<std::string, std::vector<LoopPoint>> loops;
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const auto& row = cells[r];
        if (row.size() != 5) throw Error(file.string(), "loop,place and three lengths", row[0]);
        loops[row[0]].push_back(
            {number(file, row[1]),
             Vec3(number(file, row[2]), number(file, row[3]), number(file, row[4]))});
    }
    return loops;
}

std::map<std::string, std::vector<ReliefPoint>> read_relief(const std::filesystem::path& file) {
    std::map<std::string, std::vector<ReliefPoint>> features;
    const auto cells = read_csv(file);
    if (cells[0].size() != 6) throw Error(file.string(), "six columns", cells[0][0]);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const auto& row = cells[r];
        const double width = number(file, row[4]);
        if (!(width > 0))
            throw Error(file.string() + ": row " + std::to_string(r + 1), "a width above 0",
                        row[4]);
        features[row[0]].push_back({Vec2(number(file, row[1]), number(file, row[2])),
                                    number(file, row[3]), width, number(file, row[5])});
    }
    return features;
}

/// A row of numbers after `names` cells of text.
std::vector<double> numbers_of(const std::filesystem::path& file,
                               const std::vector<std::string>& row, std::size_t names,
                               std::size_t count) {
    if (row.size() != names + count)
        throw Error(file.string(), std::to_string(names + count) + " cells",
                    std::to_string(row.size()));
    std::vector<double> out;
    for (std::size_t c = names; c < row.size(); ++c) out.push_back(number(file, row[c]));
    return out;
}

std::vector<double> read_skin_strip(const std::filesystem::path& file) {
    std::vector<double> out;
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r)
        out.push_back(numbers_of(file, cells[r], 1, 1)[0]);
    return out;
}

std::map<std::string, std::vector<SkinReliefPoint>> read_nose_relief(
    const std::filesystem::path& file) {
    std::map<std::string, std::vector<SkinReliefPoint>> out;
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const std::vector<double> n = numbers_of(file, cells[r], 1, 5);
        out[cells[r][0]].push_back({Vec3(n[0], n[1], n[2]), n[3], n[4]});
    }
    for (const char* line : {"groove", "columella", "bridge", "flank"})
        if (!out.count(line)) throw Error(file.string(), std::string("the line ") + line, "none");
    return out;
}

std::vector<SkinLevel> read_skin_columns(const std::filesystem::path& file) {
    const auto cells = read_csv(file);
    if (cells[0].size() < 5) throw Error(file.string(), "five columns or more", cells[0][0]);
    std::vector<SkinLevel> out;
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const auto& row = cells[r];
        SkinLevel level{row[0],
                        static_cast<int>(number(file, row[1])),
                        static_cast<int>(number(file, row[2])),
                        {}};
        for (std::size_t c = 3; c < row.size(); ++c)
            if (!row[c].empty())
                level.azimuth.emplace_back(static_cast<int>(number(file, cells[0][c])),
                                           number(file, row[c]));
        const std::string where = file.string() + ": row " + std::to_string(r + 1);
        if (level.azimuth.size() < 2) throw Error(where, "two azimuths or more", "less");
        if (level.last_row < level.first_row ||
            (!out.empty() && level.first_row <= out.back().last_row))
            throw Error(where, "rows below those of the level above", row[1]);
        out.push_back(std::move(level));
    }
    if (out.size() < 2) throw Error(file.string(), "two levels or more", "one");
    return out;
}

std::vector<Vec3> read_lip_contact(const std::filesystem::path& file) {
    std::vector<Vec3> out;
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const std::vector<double> n = numbers_of(file, cells[r], 0, 3);
        out.emplace_back(n[0], n[1], n[2]);
    }
    return out;
}

std::map<std::string, double> read_philtrum(const std::filesystem::path& file) {
    std::map<std::string, double> out;
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r)
        out[cells[r][0]] = numbers_of(file, cells[r], 1, 1)[0];
    for (const char* name : {"behind_z", "top_y", "fade_top", "bottom_y", "fade_bottom", "ridge_x",
                             "ridge_spread", "spread_from_y", "spread_length", "ridge_height",
                             "ridge_width", "groove_depth", "groove_width"})
        if (!out.count(name))
            throw Error(file.string(), std::string("the measure ") + name, "none");
    return out;
}

BustEdge read_bust_edge(const std::filesystem::path& file, const std::string& edge) {
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r)
        if (cells[r][0] == edge) {
            const std::vector<double> n = numbers_of(file, cells[r], 1, 8);
            return {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]};
        }
    throw Error(file.string(), "the edge " + edge, "none");
}

std::vector<MouthSection> read_mouth_sections(const std::filesystem::path& file) {
    std::vector<MouthSection> out;
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const std::vector<double> n = numbers_of(file, cells[r], 0, 6);
        out.push_back({n[0], n[1], n[2], n[3], n[4], n[5]});
    }
    return out;
}

std::vector<Measure> read_measures(const std::filesystem::path& file) {
    std::vector<Measure> measures;
    const auto cells = read_csv(file);
    if (cells[0].size() < 6) throw Error(file.string(), "at least six columns", cells[0][0]);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const auto& row = cells[r];
        measures.push_back({row[0], row[1], row[2], number(file, row[3]), number(file, row[4]),
                            number(file, row[5])});
    }
    return measures;
}

const std::map<std::string, Handle::Kind> kFamilyKinds{
    {"move", Handle::Kind::kMove}, {"scale", Handle::Kind::kScale}, {"lid", Handle::Kind::kLid}};
const std::map<std::string, Handle::Kind> kPopulationKinds{
    {"move", Handle::Kind::kMove},       {"scale", Handle::Kind::kScale},
    {"lid", Handle::Kind::kLid},         {"near", Handle::Kind::kNear},
    {"corner", Handle::Kind::kCorner},   {"lean", Handle::Kind::kLean},
    {"lean_lid", Handle::Kind::kLeanLid}};

std::vector<Handle> read_handles(const std::filesystem::path& file,
                                 const std::map<std::string, Handle::Kind>& kinds) {
    std::vector<Handle> handles;
    const auto cells = read_csv(file);
    if (cells[0].size() != 9) throw Error(file.string(), "nine columns", cells[0][0]);
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const auto& row = cells[r];
        const auto kind = kinds.find(row[1]);
        if (kind == kinds.end())
            throw Error(file.string() + ": row " + std::to_string(r + 1),
                        kinds.count("near") ? "move, scale, lid, near, corner, lean or lean_lid"
                                            : "move, scale or lid",
                        in_quotes(row[1]));
        const double reach = number(file, row[5]);
        handles.push_back({row[0], kind->second,
                           Vec3(number(file, row[2]), number(file, row[3]), number(file, row[4])),
                           std::isnan(reach) ? std::numeric_limits<double>::infinity() : reach,
                           Vec3(number(file, row[6]), number(file, row[7]), number(file, row[8]))});
    }
    return handles;
}

/// Columns: parameter,mean,sex,age,late_age,seen, the ancestries, own, and the modes.
void read_population(const std::filesystem::path& file, DesignTables& tables) {
    constexpr std::size_t kFirstAncestry = 6;
    const auto cells = read_csv(file);
    const auto own = static_cast<std::size_t>(std::find(cells[0].begin(), cells[0].end(), "own") -
                                              cells[0].begin());
    if (own <= kFirstAncestry || own >= cells[0].size())
        throw Error(file.string(), "ancestries and then a column own", cells[0].back());
    tables.ancestries.assign(cells[0].begin() + kFirstAncestry,
                             cells[0].begin() + static_cast<long>(own));
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const auto row = numbers_of(file, cells[r], 1, cells[0].size() - 1);
        const auto part = [&](std::size_t from, std::size_t to) {
            return std::vector<double>(row.begin() + static_cast<long>(from) - 1,
                                       row.begin() + static_cast<long>(to) - 1);
        };
        tables.population.push_back({cells[r][0], row[0], row[1], row[2], row[3], row[4],
                                     part(kFirstAncestry, own), row[own - 1],
                                     part(own + 1, cells[0].size())});
    }
    for (const Handle& handle : tables.population_handles)
        if (handle.parameter != "sex" && handle.parameter != "age" &&
            handle.parameter != kFoldsOfAge &&
            std::none_of(tables.population.begin(), tables.population.end(),
                         [&](const auto& p) { return p.name == handle.parameter; }))
            throw Error(file.string(), "a row of " + handle.parameter, "none");
}

/// Columns: sex,style, the ancestries.
void read_hair_styles(const std::filesystem::path& file, DesignTables& tables) {
    const auto cells = read_csv(file);
    const std::size_t columns = 2 + tables.ancestries.size();
    if (cells.front().size() != columns ||
        !std::equal(tables.ancestries.begin(), tables.ancestries.end(), cells.front().begin() + 2))
        throw Error(file.string(), "the columns sex, style and the ancestries of population.csv",
                    cells.front().back());
    for (std::size_t r = 1; r < cells.size(); ++r) {
        HairChance chance{number(file, cells[r][0]), cells[r][1], {}};
        const std::string row = file.string() + ": row " + std::to_string(r + 1);
        index_of_name(row, chance.style, render::hair_style_names());
        for (std::size_t k = 2; k < columns; ++k) {
            const double weight = number(file, cells[r][k]);
            if (!(weight >= 0)) throw Error(row, "weights of 0 or more", in_quotes(cells[r][k]));
            chance.ancestry.push_back(weight);
        }
        tables.hair_styles.push_back(std::move(chance));
    }
}

std::vector<PigmentTone> read_skin_pigments(const std::filesystem::path& file) {
    const auto cells = read_csv(file);
    std::vector<PigmentTone> tones;
    for (std::size_t r = 1; r < cells.size(); ++r) {
        const std::string row = file.string() + ": row " + std::to_string(r + 1);
        if (cells[r].size() != 6) throw Error(row, "6 cells", std::to_string(cells[r].size()));
        const auto cell = [&](std::size_t k) { return number(file, cells[r][k]); };
        tones.push_back({cell(0), cell(1), Vec3(cell(2), cell(3), cell(4)), cell(5)});
        if (!(tones.back().albedo.minCoeff() > 0))
            throw Error(row, "red, green and blue above 0", "one that is not");
        if (tones.size() > 1 && !(tones.back().melanin > tones[tones.size() - 2].melanin))
            throw Error(row, "more melanin than in the row before", cells[r][0]);
    }
    if (tones.size() < 2 || tones.front().melanin != 0 || tones.back().melanin != 1)
        throw Error(file.string(), "rows from melanin 0 to 1", "others");
    return tones;
}

}  // namespace

std::filesystem::path models_folder() { return data_folder() / "models"; }

DesignTables read_design_tables(const std::filesystem::path& folder) {
    DesignTables tables;
    tables.face_depth = read_grid(folder / "face_depth.csv");
    tables.head_radius = read_grid(folder / "head_radius.csv");
    const auto file = folder / "landmarks.csv";
    const auto cells = read_csv(file);
    for (std::size_t r = 1; r < cells.size(); ++r)
        tables.landmarks[cells[r][0]] =
            Vec3(number(file, cells[r][2]), number(file, cells[r][3]), number(file, cells[r][4]));
    tables.nose_loops = read_loops(folder / "nose_loops.csv");
    tables.ear_loops = read_loops(folder / "ear_loops.csv");
    tables.ear_relief = read_relief(folder / "ear_relief.csv");
    tables.skin_rows = read_grid(folder / "skin_rows.csv");
    if (tables.skin_rows.columns.size() != 4 || tables.skin_rows.rows.size() < 2)
        throw Error((folder / "skin_rows.csv").string(), "four azimuths and two rows or more",
                    "others");
    tables.skin_columns = read_skin_columns(folder / "skin_columns.csv");
    tables.skin_strip = read_skin_strip(folder / "skin_strip.csv");
    tables.nose_relief = read_nose_relief(folder / "nose_relief.csv");
    tables.mouth_sections = read_mouth_sections(folder / "mouth_sections.csv");
    tables.lip_contact = read_lip_contact(folder / "lip_contact.csv");
    tables.philtrum = read_philtrum(folder / "philtrum.csv");
    tables.neck_base = read_bust_edge(folder / "bust_edges.csv", "neck_base");
    tables.bust = read_bust_edge(folder / "bust_edges.csv", "bust");
    tables.measures = read_measures(folder / "anthropometry.csv");
    tables.handles = read_handles(folder / "parameters.csv", kFamilyKinds);
    tables.population_handles = read_handles(folder / "population_handles.csv", kPopulationKinds);
    read_population(folder / "population.csv", tables);
    read_hair_styles(folder / "hair_styles.csv", tables);
    tables.skin_pigments = read_skin_pigments(folder / "skin_pigments.csv");
    const auto tones = folder / "tones.csv";
    for (const auto& row : read_csv(tones))
        if (row.size() == 5 && row[0] != "part")
            tables.tones[row[0]][row[1]] =
                Vec3(number(tones, row[2]), number(tones, row[3]), number(tones, row[4]));
    for (const char* part : {"skin", "lips", "iris", "hair"})
        if (tables.tones[part].empty())
            throw Error(tones.string(), std::string("a row of part ") + part, "none");
    for (const auto& [name, tone] : tables.tones["skin"])
        if (!tables.tones["lips"].count(name))
            throw Error(tones.string(), "lips for skin " + in_quotes(name), "none");
    return tables;
}

}  // namespace risorius::headmodel
