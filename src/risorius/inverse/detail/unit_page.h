// SPDX-License-Identifier: MIT
/// \file
/// The page on which a coder judges action units: pictures, cues and numbers of each, and boxes to tick. The answers stay in the browser,
/// and a button saves them as a table.
#pragma once

#include <map>
#include <string>

#include "risorius/inverse/read_units.h"
#include "risorius/track/facs.h"

namespace risorius::inverse {

/// Pictures of a unit: file names relative to the page.
struct UnitPictures {
    std::string shown, moved;
};

/// Returns the page. `pictures` has an entry for each unit, or none at all.
std::string unit_page(const UnitReadings& readings, const track::FacsTable& facs,
                      const std::string& name, const std::string& neutral,
                      const std::map<std::string, UnitPictures>& pictures);

/// The script of the page, which keeps and saves the answers.
const std::string& unit_page_script();

}  // namespace risorius::inverse
