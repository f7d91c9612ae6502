// SPDX-License-Identifier: MIT
#include "risorius/figures/detail/figure_files.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/toolkit_record.h"
#include "risorius/media/image_file.h"
#include "risorius/render/object_view.h"
#include "risorius/report/atomic_file.h"

namespace risorius::figures {

namespace fs = std::filesystem;

namespace {

// Size of pictures, px: of a single object, and of each of several in a row
constexpr int kWidth_px = 1200, kHeight_px = 900;
constexpr int kRowWidth_px = 640, kRowHeight_px = 760, kWidestRow_px = 3200;
constexpr int kMargin_px = 36;
/// Objects with a smaller ratio of height to width are drawn from a higher viewpoint
constexpr double kFlat = 0.35;
constexpr double kFlatElevation_deg = 34;

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    return cell + "\"";
}

/// Prevents two results from being written to the same file.
class FileNames {
  public:
    void take(const std::string& kind, const std::string& name,
              const std::vector<std::string>& endings) {
        const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                   c == '_' || c == '-';
        });
        if (name.empty() || !plain || name.front() == '-')
            throw Error(kind + "/name", "letters, digits, _ and -", "\"" + name + "\"");
        for (const std::string& ending : endings)
            if (!taken_.insert(name + ending).second)
                throw Error(kind + " \"" + name + "\"", "a name that no other result has",
                            name + ending + " twice");
    }
    std::vector<std::string> all() const { return {taken_.begin(), taken_.end()}; }

  private:
    std::set<std::string> taken_;
};

void check_table(const figures::Table& table) {
    const std::string place = "table \"" + table.name + "\"";
    for (std::size_t r = 0; r < table.rows.size(); ++r)
        if (table.rows[r].size() != table.columns.size())
            throw Error(place + "/rows/" + std::to_string(r),
                        std::to_string(table.columns.size()) + " numbers",
                        std::to_string(table.rows[r].size()));
    if (!table.row_names.empty() && table.row_names.size() != table.rows.size())
        throw Error(place + "/row_names", std::to_string(table.rows.size()) + " names",
                    std::to_string(table.row_names.size()));
}

render::Object object_of(const figures::Shape& shape) {
    return {.positions = shape.positions,
            .surface = shape.surface,
            .wires = shape.wires,
            .fixed = shape.fixed,
            .shade = shape.shade,
            .outline = shape.outline};
}

bool is_flat(const render::Object& object) {
    const Vec3 size =
        (object.positions.colwise().maxCoeff() - object.positions.colwise().minCoeff());
    return size.z() < kFlat * std::max(size.x(), size.y());
}

/// Whether the object lies in a plane of x and z, which is drawn from the front.
bool is_upright_plane(const render::Object& object) {
    constexpr double kThin = 1e-6;
    const Vec3 size =
        (object.positions.colwise().maxCoeff() - object.positions.colwise().minCoeff());
    return size.y() < kThin * std::max(size.x(), size.z());
}

/// Removes empty rows above and below, except for a margin.
Image trimmed(const Image& image) {
    const auto is_empty = [&](int y) {
        const std::uint8_t* row = image.pixel(0, y);
        return std::all_of(row, row + 4 * image.width_px, [](std::uint8_t b) { return b == 255; });
    };
    int first = 0, last = image.height_px - 1;
    while (first < last && is_empty(first)) ++first;
    while (last > first && is_empty(last)) --last;
    first = std::max(0, first - kMargin_px);
    last = std::min(image.height_px - 1, last + kMargin_px);
    Image part(image.width_px, last - first + 1);
    std::copy_n(image.pixel(0, first), part.rgba.size(), part.rgba.begin());
    return part;
}

Image picture_of(const std::vector<render::Object>& objects) {
    render::ObjectViewOptions options{.width_px = kWidth_px, .height_px = kHeight_px};
    const int count = static_cast<int>(objects.size());
    if (count > 1) {
        options.width_px = std::min(kRowWidth_px * count, kWidestRow_px);
        options.height_px = kRowHeight_px;
    }
    const bool has_vertices = std::all_of(objects.begin(), objects.end(), [](const auto& object) {
        return object.positions.rows() > 0;
    });
    if (has_vertices && std::all_of(objects.begin(), objects.end(), is_flat))
        options.elevation_deg = kFlatElevation_deg;
    if (has_vertices && std::all_of(objects.begin(), objects.end(), is_upright_plane)) {
        options.azimuth_deg = -90;
        options.elevation_deg = 0;
    }
    return trimmed(render::ObjectView(objects, options).draw());
}

// JSON has no infinity: open ends of ranges and missing values become null.
Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json check_json(const figures::Check& check) {
    Json json = Json::object();
    json["name"] = check.name;
    json["unit"] = check.unit;
    json["measured"] = number_json(check.measured);
    json["low"] = number_json(check.low);
    json["high"] = number_json(check.high);
    json["passes"] = check.passes();
    json["range"] = check.range_from;
    json["published"] = check.published;
    json["note"] = check.note;
    return json;
}

Json watched_json(const figures::Check& check) {
    Json json = check_json(check);
    for (const char* key : {"range", "published"}) json.erase(key);
    return json;
}

Json claim_json(const figures::Claim& claim) {
    Json json = Json::object();
    json["says"] = claim.says;
    json["finds"] = claim.finds;
    json["verdict"] = name_of(claim.verdict);
    json["holds"] = claim.holds();
    if (!claim.measured) return json;
    json["name"] = claim.name;
    json["unit"] = claim.unit;
    json["measured"] = number_json(claim.value);
    json["low"] = number_json(claim.low);
    json["high"] = number_json(claim.high);
    return json;
}

}  // namespace

std::string csv_of(const figures::Table& table) {
    check_table(table);
    std::string text;
    const bool named = !table.row_names.empty();
    if (named) text += table.columns.empty() ? "name" : "name,";
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text.append(c ? "," : "").append(csv_cell(table.columns[c]));
    text += "\n";
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
        if (named) text += csv_cell(table.row_names[r]);
        for (std::size_t c = 0; c < table.rows[r].size(); ++c) {
            const double value = table.rows[r][c];
            text.append(c || named ? "," : "");
            text += std::isnan(value) ? "nan" : format_number(value);
        }
        text += "\n";
    }
    return text;
}

FigureFiles write_figure(const figures::FigureResult& figure, const fs::path& folder,
                         const plot::ChartWriter& charts) {
    FigureFiles files;
    FileNames names;
    for (const figures::Table& table : figure.tables) {
        names.take("table", table.name, {".csv"});
        files.tables.push_back(table.name + ".csv");
        report::write_text(folder / files.tables.back(), csv_of(table));
    }
    for (const plot::Chart& chart : figure.charts) {
        names.take("chart", chart.name, {".svg", ".png", ".gp", ".data.csv"});
        files.charts.push_back(chart.name);
        plot::write_chart(chart, folder, charts);
    }
    for (std::size_t i = 0; i < figure.shapes.size();) {
        const std::string name = figure.shapes[i].name;
        names.take("shape", name, {".png"});
        FigurePicture picture{.file = name + ".png", .captions = {}};
        std::vector<render::Object> row;
        for (; i < figure.shapes.size() && figure.shapes[i].name == name; ++i) {
            row.push_back(object_of(figure.shapes[i]));
            const figures::Shape& shape = figure.shapes[i];
            picture.captions.push_back(shape.caption);
            picture.held = picture.held || !shape.fixed.empty();
            if (picture.outline_name.empty() && shape.outline.rows() > 0)
                picture.outline_name = shape.outline_name;
            if (picture.shade_ends[0].empty()) picture.shade_ends = shape.shade_ends;
        }
        // Beside coloured objects, an object without shades gets the middle of the scale.
        if (!picture.shade_ends[0].empty())
            for (render::Object& object : row)
                if (object.shade.empty())
                    object.shade.assign(static_cast<std::size_t>(object.positions.rows()), 0.5);
        media::write_png(picture_of(row), folder / picture.file);
        files.pictures.push_back(picture);
    }
    files.all = names.all();
    return files;
}

Json figure_json(const figures::FigureResult& figure) {
    Json json = Json::object();
    json["format"] = "risorius-figure";
    json["version"] = 1;
    json["toolkit"] = toolkit_record();
    json["id"] = figure.id;
    json["title"] = figure.title;
    json["passes"] = figure.passes();
    json["checks"] = Json::array();
    for (const figures::Check& check : figure.checks) json["checks"].push_back(check_json(check));
    json["claims"] = Json::array();
    for (const figures::Claim& claim : figure.claims) json["claims"].push_back(claim_json(claim));
    json["watched"] = Json::array();
    for (const figures::Check& check : figure.watched)
        json["watched"].push_back(watched_json(check));
    json["tables"] = Json::array();
    for (const figures::Table& table : figure.tables)
        json["tables"].push_back(json_object({{"file", table.name + ".csv"},
                                              {"columns", table.columns},
                                              {"rows", table.rows.size()}}));
    json["record"] = figure.record;
    return json;
}

}  // namespace risorius::figures
