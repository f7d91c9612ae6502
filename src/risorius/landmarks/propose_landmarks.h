// SPDX-License-Identifier: MIT
/// \file
/// Finds the landmarks of a head mesh: a network looks at pictures of it, and heads whose landmarks are known are brought onto it.
/// Docs: docs/howto/own-head.md; design: docs/decisions/0091.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/image.h"
#include "risorius/core/json_cursor.h"
#include "risorius/core/progress_monitor.h"

namespace risorius::landmarks {

/// A head whose landmarks are known.
struct TemplateFiles {
    std::filesystem::path mesh, landmarks;
    /// Landmarks that lie elsewhere by their definition, in place of those; empty: none
    std::filesystem::path by_definition{};
};

struct LandmarkOptions {
    std::filesystem::path mesh;
    std::optional<double> metres_per_unit{};  ///< none: estimated from the size of the face
    /// A map from role to names of mesh groups, for groups whose names do not show it (fitting/fit_rig.h)
    std::map<std::string, std::vector<std::string>> parts{};
    /// Heads that are brought onto the mesh; none: the embedded adult. A head of the same topology as the mesh would do too well.
    std::vector<TemplateFiles> templates{};
    std::filesystem::path weights{};  ///< folder of the network; empty: weights_folder()
    std::filesystem::path
        standard{};         ///< folder of the standard tables; empty: those of this toolkit
    bool pictures = false;  ///< also draws those of LandmarkProposal, which a report shows
};

/// How sure a landmark is.
enum class Certainty { kSure, kDoubtful, kUnsure };

struct ProposedLandmark {
    Vec3 xyz;                ///< in the units and axes of the mesh's file
    double expected_mm = 0;  ///< how far off it may be
    /// 0..1: halved with every kHalved_mm of expected_mm
    double confidence = 0;
    std::string reason;  ///< what speaks against it, for a person; may be empty
    Certainty certainty() const;
};
inline constexpr double kHalved_mm = 5;  ///< so 0.5 is a landmark that may be 5 mm off
inline constexpr double kSureFrom = 0.75, kDoubtfulFrom = 0.5;  ///< confidences: 2.1 mm and 5 mm

/// A picture of the report: a view of the head with the landmarks that it shows.
struct LandmarkPicture {
    std::string name;  ///< "front"
    Image image;
};

struct LandmarkProposal {
    std::string mesh;  ///< name of its file
    std::map<std::string, ProposedLandmark> landmarks;
    double metres_per_unit = 1;
    bool guessed_unit = false;
    bool usual_unit = true;  ///< false: in no usual unit it has the size of a head
    double size = 1;         ///< of the head over the average adult
    double score = 0;        ///< of the network, 0..1
    double spread_mm = 0;    ///< median over the points of the network, of the views
    Vec3 up, forward;        ///< of the head, axes of the mesh as it is read
    std::vector<std::string> templates;
    std::vector<std::string> notes;
    std::vector<LandmarkPicture> pictures;

    /// The landmarks that a rig needs and that are Certainty::kUnsure; with them nothing should be fitted unseen.
    std::vector<std::string> unsure_required() const;
    Json json() const;            ///< what was found, without the landmarks
    Json landmarks_json() const;  ///< a file of landmarks
};

/// Throws Error for a mesh in which no face is found, and when the weights of the network are missing.
LandmarkProposal propose_landmarks(const LandmarkOptions& options,
                                   const ProgressMonitor& monitor = {});

/// Writes the file of landmarks, and with a folder for the report the pictures, index.html and results.json. They appear together
/// where the folder lies below that of the file. Throws Error and RunError as OutputSet does.
void write_landmarks(const LandmarkProposal& proposal, const std::filesystem::path& out,
                     const std::filesystem::path& report = {});

}  // namespace risorius::landmarks
