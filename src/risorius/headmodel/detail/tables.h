// SPDX-License-Identifier: MIT
/// \file
/// Measured and designed numbers of the head, read from the model's design folder. Lengths in mm.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "risorius/core/types.h"

namespace risorius::headmodel {

/// A table over two coordinates; NaN where nothing was measured.
struct GridTable {
    std::vector<double> rows, columns;       ///< coordinates in the file's order
    std::vector<std::vector<double>> value;  ///< [row][column]
};

/// A point of a curve that is pinned to a place along an edge loop of the mesh.
struct LoopPoint {
    double place;  ///< vertex number along the loop
    Vec3 point;
};

/// A point of a ridge or pit of the ear. The skin along the line through such points is raised; the height falls off like a bell curve.
struct ReliefPoint {
    Vec2 place;        ///< back, up in the ear frame, mm
    double height_mm;  ///< outwards; below 0: a pit
    double width_mm;   ///< distance aside at which 1/e of the height is left
    double lean_mm;    ///< shift backwards of a ridge that overhangs
};

/// A point of a line along which the skin is raised, or carved where its height is below 0.
struct SkinReliefPoint {
    Vec3 at;           ///< head frame, mm
    double height_mm;  ///< along the normal
    double width_mm;   ///< distance at which 1/e of the height is left
};

/// A section of the cavity behind the lips, mm: half an oval bent back round the dental arch.
struct MouthSection {
    double up, down;  ///< above and below the line of the lips
    double half_width;
    double front,
        front_below;  ///< z in the midline, at its top and its bottom, where the chin recedes
    double bend;      ///< how far the sides lie behind it
};

/// One level of the columns of the skin's grid.
struct SkinLevel {
    std::string name;
    int first_row, last_row;                      ///< rows on which the level holds
    std::vector<std::pair<int, double>> azimuth;  ///< column, degrees; even between them
};

/// The edge of the neck or of the bust by the angle a about the axis of the neck, 0 in front, mm:
/// x = half_width sin^roundness a, y = height + slope cos a + curve cos^2 a, z = middle + (front or back) cos a.
struct BustEdge {
    double half_width, roundness, height, slope, curve, middle, front, back;
};

/// A distance between two landmarks and its distribution among adults.
struct Measure {
    std::string name, from, to;
    double mean_mm, sd_mm, men_less_women_mm;
};

/// How often a drawn person of this sex wears a style of hair.
struct HairChance {
    double sex;                    ///< -1 or 1
    std::string style;             ///< a name of render::hair_style_names()
    std::vector<double> ancestry;  ///< weight in each, in the order of the ancestries
};

/// Skin of one melanin content.
struct PigmentTone {
    double melanin, ita_deg;
    Vec3 albedo;         ///< linear
    double haemoglobin;  ///< absorption of a standard deviation of redness
};

/// Handles of this name move a head with the years from 30 on, per 40 years: folds that the young do not have.
inline constexpr const char* kFoldsOfAge = "aged";

/// Effect of one parameter on the average head: everything within `reach` of a place is moved along `by`, or scaled about it, on both sides.
/// kNear acts in front of the globe, but not on the edge of the lid, and kCorner also there; the lean ones move the sides against each other.
struct Handle {
    std::string parameter;
    enum class Kind { kMove, kScale, kLid, kNear, kCorner, kLean, kLeanLid } kind;
    Vec3 at;
    double reach_mm;  ///< reach of the effect; infinite: it acts everywhere
    Vec3 by;          ///< mm, or percent for kScale, per unit of the parameter
};

/// How one parameter is spread among adults, in its standard deviations within a sex and an ancestry.
struct PopulationParameter {
    std::string name;
    double mean;                   ///< of all, against the average head
    double sex, age;               ///< per unit: men 1, women -1; 1 at 80 years, 0 at 40
    double late_age;               ///< per unit: 1 at 80 years, 0 until 45
    double seen;                   ///< how much of it is seen, against the mean of all
    std::vector<double> ancestry;  ///< added, in the order of DesignTables::ancestries
    double own;                    ///< part that varies by itself
    std::vector<double> modes;     ///< parts along what all parameters have in common
};

struct DesignTables {
    GridTable face_depth;                   ///< z over rows y, columns x
    GridTable head_radius;                  ///< r about (x 0, z 20) over rows y, columns azimuth
    std::map<std::string, Vec3> landmarks;  ///< head frame
    std::map<std::string, std::vector<LoopPoint>> nose_loops;  ///< left side, head frame
    std::map<std::string, std::vector<LoopPoint>>
        ear_loops;  ///< left side, ear frame: back, up, out
    std::map<std::string, std::vector<ReliefPoint>> ear_relief;  ///< ridges and pits by name
    GridTable skin_rows;                  ///< y of rows of the skin's grid over columns azimuth
    std::vector<SkinLevel> skin_columns;  ///< from the crown to the jaw
    std::vector<double> skin_strip;  ///< y of rows 34 and on, from the tip of the nose to the lip
    std::map<std::string, std::vector<SkinReliefPoint>>
        nose_relief;                           ///< ridges and grooves by name
    std::vector<MouthSection> mouth_sections;  ///< from the lips to the throat
    std::vector<Vec3> lip_contact;             ///< where the lips touch, midline to corner
    std::map<std::string, double> philtrum;    ///< its measures by name, mm
    BustEdge neck_base, bust;
    std::vector<Measure> measures;
    std::vector<Handle> handles;
    std::vector<Handle> population_handles;                    ///< of persons of the population
    std::vector<std::string> ancestries;                       ///< sorted
    std::vector<HairChance> hair_styles;                       ///< of drawn persons
    std::vector<PopulationParameter> population;               ///< in the order of its table
    std::map<std::string, std::map<std::string, Vec3>> tones;  ///< part, name: sRGB 0..1
    std::vector<PigmentTone> skin_pigments;                    ///< by rising melanin, 0 to 1
};

/// The folder `models` of the data folder.
std::filesystem::path models_folder();

/// Throws Error on a missing or malformed table.
DesignTables read_design_tables(const std::filesystem::path& folder);

}  // namespace risorius::headmodel
