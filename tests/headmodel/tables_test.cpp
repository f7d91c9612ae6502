// SPDX-License-Identifier: MIT
// The tables that the head is designed by: what is refused, and where.
#include "risorius/headmodel/detail/tables.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "message_of.h"
#include "temporary_folder.h"

namespace risorius::headmodel {
namespace {

/// What reading the design says once one of its tables holds this text.
std::string complaint(const std::string& table, const std::string& text) {
    const TemporaryFolder folder;
    std::filesystem::copy(models_folder() / "adult/design", folder.path(),
                          std::filesystem::copy_options::recursive);
    std::ofstream(folder / table) << text;
    std::string message = message_of([&] { read_design_tables(folder.path()); });
    const std::string place = folder.path().string() + "/";
    if (message.starts_with(place)) message.erase(0, place.size());
    return message;
}

TEST(DesignTables, LevelsOfColumnsFollowEachOther) {
    const std::string header = "level,first_row,last_row,0,16,48\n";
    EXPECT_EQ(complaint("skin_columns.csv", header + "crown,0,0,0,,180\nbrow,0,18,0,38.5,180\n"),
              "skin_columns.csv: row 3: expected rows below those of the level above, found 0");
    EXPECT_EQ(complaint("skin_columns.csv", header + "crown,0,0,0,,180\nbrow,14,18,,38.5,\n"),
              "skin_columns.csv: row 3: expected two azimuths or more, found less");
    EXPECT_EQ(complaint("skin_columns.csv", header + "crown,0,0,0,,180\n"),
              "skin_columns.csv: expected two levels or more, found one");
}

TEST(DesignTables, NothingIsMissing) {
    EXPECT_EQ(complaint("bust_edges.csv",
                        "edge,half_width_mm,roundness,height_mm,slope_mm,curve_mm,middle_mm,"
                        "front_mm,back_mm\nneck_base,58,0.85,-117,-17,3,-30,51,62\n"),
              "bust_edges.csv: expected the edge bust, found none");
    EXPECT_EQ(complaint("philtrum.csv", "measure,value_mm\ntop_y,-33\n"),
              "philtrum.csv: expected the measure behind_z, found none");
    EXPECT_EQ(complaint("lip_contact.csv", "x_mm,y_mm,z_mm\n0,low,94\n"),
              "lip_contact.csv: expected a number, found \"low\"");
}

}  // namespace
}  // namespace risorius::headmodel
