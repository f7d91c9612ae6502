// SPDX-License-Identifier: MIT
/// \file
/// Compares the codes that a coder of FACS has given to the clips of a kit (detail/coder_kit.h) with what the clips show.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/core/types.h"

namespace risorius::inverse {

/// One unit in a code.
struct CodedUnit {
    int number = 0;            ///< such as 12
    std::optional<Side> side;  ///< none: both
    std::optional<int> level;  ///< 1..5 for A..E; none: not coded
    bool operator==(const CodedUnit&) const = default;
};

/// Reads codes such as "1C+2C" or "R12B"; "0" and "" are no units. Throws Error with `place` for anything else, and for a unit that comes
/// twice.
std::vector<CodedUnit> read_codes(const std::string& text, const std::string& place);

/// How well a coder's codes of one unit agree with what was shown.
struct UnitAgreement {
    int unit = 0;
    int shown = 0;         ///< clips that show the unit
    int seen = 0;          ///< of these, clips in which it was coded
    int falsely_seen = 0;  ///< clips in which it was coded, but not shown
    double kappa =
        0;  ///< Cohen 1960; 0 by chance, 1 at best, NaN if it was never shown and never coded
    int levels = 0;           ///< clips in which both gave an intensity
    int levels_within_1 = 0;  ///< of these, those at most one level apart
};

struct Agreement {
    int clips = 0;
    /// Twice the number of agreed units / number of all units that were shown and coded: the index of the manual of FACS
    double index = 0;
    std::vector<UnitAgreement> units;  ///< by number
    Json json() const;
};

/// Compares a filled sheet with the key. Throws Error when a file cannot be read, a clip of the key is missing in the sheet or is unknown,
/// or codes cannot be read.
Agreement code_agreement(const std::filesystem::path& sheet, const std::filesystem::path& key);

}  // namespace risorius::inverse
