// SPDX-License-Identifier: MIT
#include "tools/risorius/schema_check.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "risorius/core/data_folder.h"
#include "risorius/core/error.h"

namespace risorius::cli {
namespace {

namespace fs = std::filesystem;
using valijson::adapters::NlohmannJsonAdapter;

constexpr const char* kEnding = ".schema.json";

fs::path schema_folder() { return data_folder() / "docs/formats/schema"; }

/// The validator needs another JSON type.
nlohmann::json plain(const JsonCursor& json) { return nlohmann::json(json.json()); }

nlohmann::json read_plain(const fs::path& file) { return plain(JsonCursor::read_file(file)); }

std::unique_ptr<valijson::Schema> read_schema(const std::string& format) {
    const nlohmann::json document = read_plain(schema_folder() / (format + kEnding));
    auto schema = std::make_unique<valijson::Schema>();
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    // A schema may refer to another schema of the folder by its file name.
    parser.populateSchema(
        NlohmannJsonAdapter(document), *schema,
        [](const std::string& uri) {
            return new nlohmann::json(
                read_plain(schema_folder() / fs::path(uri).filename().string()));
        },
        [](const nlohmann::json* fetched) { delete fetched; });
    return schema;
}

/// The JSON pointer "/channels/jaw_open" of the context {"<root>", "[channels]", "[jaw_open]"}.
std::string pointer_of(const std::vector<std::string>& context) {
    std::string pointer;
    for (std::size_t i = 1; i < context.size(); ++i)
        pointer += "/" + context[i].substr(1, context[i].size() - 2);
    return pointer.empty() ? "/" : pointer;
}

}  // namespace

std::vector<std::string> schema_formats() {
    std::vector<std::string> formats;
    for (const auto& entry : fs::directory_iterator(schema_folder())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("risorius-") && name.ends_with(kEnding))
            formats.push_back(name.substr(0, name.size() - std::string(kEnding).size()));
    }
    std::sort(formats.begin(), formats.end());
    return formats;
}

void check_against_schema(const JsonCursor& json, const std::string& format) {
    const std::unique_ptr<valijson::Schema> schema = read_schema(format);
    const nlohmann::json document = plain(json);
    valijson::ValidationResults results;
    valijson::Validator validator;
    if (validator.validate(*schema, NlohmannJsonAdapter(document), &results)) return;
    // The innermost error is the most specific; outer ones only repeat that something inside is wrong.
    valijson::ValidationResults::Error finding, innermost;
    while (results.popError(finding))
        if (innermost.context.empty() || finding.context.size() > innermost.context.size())
            innermost = finding;
    std::string said = innermost.description;
    while (!said.empty() && said.back() == '.') said.pop_back();
    const std::string file = json.place().substr(0, json.place().rfind(':'));
    throw Error(file + ":" + pointer_of(innermost.context),
                "what the schema of " + format + " says", "otherwise: " + said);
}

}  // namespace risorius::cli
