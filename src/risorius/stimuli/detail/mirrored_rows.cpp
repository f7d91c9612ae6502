// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/mirrored_rows.h"

#include <array>
#include <cstdio>

namespace risorius::stimuli {

namespace {

// Units that name a direction: head turned, head tilted, both eyes turned
constexpr std::array kDirections{std::array{"AU51", "AU52"}, std::array{"AU55", "AU56"},
                                 std::array{"AU61.l", "AU62.r"}, std::array{"AU61.r", "AU62.l"}};

/// Whether the sign of a column says to which side.
bool has_a_side(const std::string& name) {
    return name.ends_with(".x_mm") || name.find("yaw_deg") != std::string::npos ||
           name.ends_with("roll_deg") || name == "jaw_side" || name == "head_side_mm" ||
           name == "incisor_side_mm";
}

std::string negated(const std::string& cell) {
    if (cell.find_first_of("123456789") == std::string::npos) return cell;  // 0 or no number
    return cell[0] == '-' ? cell.substr(1) : "-" + cell;
}

std::string three_decimals(double value) {
    char text[48];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
}

}  // namespace

std::string other_side(const std::string& name) {
    for (const auto& pair : kDirections)
        for (std::size_t k = 0; k < 2; ++k)
            if (name == pair[k]) return pair[1 - k];
    // "_l" of a landmark or an aperture, ".l" of a muscle, a unit or an eye; the next sign is the end, "." or "_"
    for (std::size_t i = 0; i + 1 < name.size(); ++i) {
        if (name[i] != '_' && name[i] != '.') continue;
        if (name[i + 1] != 'l' && name[i + 1] != 'r') continue;
        if (i + 2 < name.size() && name[i + 2] != '.' && name[i + 2] != '_') continue;
        std::string out = name;
        out[i + 1] = name[i + 1] == 'l' ? 'r' : 'l';
        return out;
    }
    return name;
}

animate::FrameRows mirrored(const animate::FrameRows& rows, int width_px) {
    animate::FrameRows out = rows;
    for (std::size_t c = 0; c < rows.names.size(); ++c) {
        const std::string& name = rows.names[c];
        const int partner = rows.column(other_side(name));
        const int from = partner < 0 ? static_cast<int>(c) : partner;
        for (int r = 0; r < rows.rows(); ++r) {
            std::string cell =
                rows.cells[static_cast<std::size_t>(r)][static_cast<std::size_t>(from)];
            if (name.ends_with(".u_px"))
                cell = three_decimals(width_px - rows.number(r, from));
            else if (has_a_side(name))
                cell = negated(cell);
            out.cells[static_cast<std::size_t>(r)][c] = cell;
        }
    }
    return out;
}

}  // namespace risorius::stimuli
