// The measured and designed numbers the head is made from, read from the model's design folder. Lengths in mm.
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

/// A closed or open curve: points pinned to places along an edge loop of the mesh.
struct LoopPoint {
    double place;  ///< vertex number along the loop
    Vec3 point;
};

/// A point of a ridge or pit of the ear: the line through them is raised, and falls off to both sides like a bell.
struct ReliefPoint {
    Vec2 place;        ///< back, up in the ear frame, mm
    double height_mm;  ///< outwards; below 0: a pit
    double width_mm;   ///< aside, where 1/e of it is left
    double lean_mm;    ///< backwards, where it overhangs
};

/// A distance between two landmarks and how it is spread among adults.
struct Measure {
    std::string name, from, to;
    double mean_mm, sd_mm, men_less_women_mm;
};

/// How one parameter moves the average head: everything within `reach` of a place is moved along `by`, or enlarged about it.
/// Each works on both sides.
struct Handle {
    std::string parameter;
    enum class Kind { kMove, kScale, kLid } kind;
    Vec3 at;
    double reach_mm;  ///< infinite: everywhere
    Vec3 by;          ///< mm, or percent for kScale, per unit of the parameter
};

struct DesignTables {
    GridTable face_depth;                   ///< z over rows y, columns x
    GridTable head_radius;                  ///< r about (x 0, z 20) over rows y, columns azimuth
    std::map<std::string, Vec3> landmarks;  ///< head frame
    std::map<std::string, std::vector<LoopPoint>> nose_loops;  ///< left side, head frame
    std::map<std::string, std::vector<LoopPoint>>
        ear_loops;  ///< left side, ear frame: back, up, out
    std::map<std::string, std::vector<ReliefPoint>> ear_relief;  ///< ridges and pits by name
    std::vector<Measure> measures;
    std::vector<Handle> handles;
    std::map<std::string, std::map<std::string, Vec3>> tones;  ///< part, name: sRGB 0..1
};

/// models/ of the tree this was built from.
std::filesystem::path models_folder();

/// Throws Error on a missing or malformed table.
DesignTables read_design_tables(const std::filesystem::path& folder);

}  // namespace risorius::headmodel
