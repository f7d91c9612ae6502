// SPDX-License-Identifier: MIT
/// \file
/// The project's own muscle, FACS and expression tables, read once for the tests of this folder.
#pragma once

#include <filesystem>
#include <string>

#include "paths.h"
#include "risorius/track/facs.h"

namespace risorius::track {

struct StandardTables {
    ChannelTable channels;
    FacsTable facs;
    Expressions expressions;

    static const StandardTables& get() {
        static const StandardTables tables = read();
        return tables;
    }

    int column(const std::string& name) const {
        const SidedName sided = split_side(name);
        return channels.column(sided.id, sided.side.value_or(Side::kLeft));
    }

  private:
    static StandardTables read() {
        const std::filesystem::path folder =
            std::filesystem::path(RISORIUS_SOURCE_DIR) / "rigs" / "standard";
        StandardTables tables;
        for (const JsonCursor& muscle :
             JsonCursor::read_file(folder / "muscles.json").at("muscles").items())
            tables.channels.muscles.push_back({muscle.at("id").string(),
                                               muscle.at("paired").boolean(),
                                               muscle.has("tonic_rest_activation") ? -1.0 : 0.0});
        tables.facs = read_facs(JsonCursor::read_file(folder / "facs.json"), tables.channels);
        tables.expressions = read_expressions(JsonCursor::read_file(folder / "expressions.json"),
                                              tables.facs, tables.channels);
        return tables;
    }
};

inline const StandardTables& tables() { return StandardTables::get(); }

}  // namespace risorius::track
