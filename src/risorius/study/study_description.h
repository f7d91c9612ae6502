// SPDX-License-Identifier: MIT
/// \file
/// The content of a study file: which numbers of a rig are varied, by how much, and in which poses the landmarks are read. The JSON format is
/// "risorius-study", version 1; fields have the names of its keys.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/sensitivity/distribution.h"
#include "risorius/sensitivity/unit_sample.h"
#include "risorius/track/channels.h"

namespace risorius::study {

/// A parameter of the study: one number that varies, and the numbers of the rig that follow it.
struct Parameter {
    std::string name;
    std::vector<std::string>
        of;  ///< paths of numbers, as "tissue/bulk_pa"; see detail/rig_numbers.h
    enum class How { kFactor, kAdd, kSet } how = How::kFactor;
    sensitivity::Distribution distribution;
    bool each =
        false;  ///< whether every number has a value of its own; their indices are those of the group
    std::vector<std::string> numbers;  ///< JSON pointers of all numbers of the rig that `of` means
    std::string place;

    int columns() const { return each ? static_cast<int>(numbers.size()) : 1; }
    /// "factor, log_uniform 0.5, 2"
    std::string text() const;
};

/// A pose in equilibrium.
struct Pose {
    std::string name;
    track::Drive drive;
};

struct StudyDescription {
    std::filesystem::path file, rig;
    std::string name;
    std::string quality = "preview";
    std::vector<Pose> poses;
    std::vector<std::string> landmarks;
    std::vector<Parameter> parameters;
    sensitivity::Sampling sampling = sensitivity::Sampling::kSobol;
    int count = 64;  ///< rows of the sample
    bool indices =
        true;  ///< whether Sobol indices are computed; a study of k parameters then has count * (k + 2) faces
    int replicates = 400;  ///< of the bootstrap
    std::uint64_t seed = 1;
    std::shared_ptr<const Json> rig_json;  ///< the rig with its tables, see rig::resolved_rig()

    /// The number of faces that are made.
    int runs() const;
};

/// Reads a study and its rig. Throws Error with file, place, and the expected and the found value.
StudyDescription read_study(const std::filesystem::path& file);
StudyDescription read_study(const JsonCursor& json);

}  // namespace risorius::study
