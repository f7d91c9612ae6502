// SPDX-License-Identifier: MIT
/// \file
/// Writes a head of the parametric family into a folder: mesh, landmarks, rig, picture, and the identity it was made from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/progress_monitor.h"
#include "risorius/headmodel/detail/cast.h"
#include "risorius/headmodel/detail/identity.h"
#include "risorius/headmodel/head_quality.h"

namespace risorius::headmodel {

struct SculptOptions {
    std::filesystem::path out;     ///< folder
    headmodel::Identity identity;  ///< who
    std::string place = "head";    ///< where the identity was read, for messages
    bool mesh_only = false;        ///< no rig and no picture
    bool identity_only = false;    ///< only identity.json
    int texture_px =
        0;  ///< side of a picture of the skin's colours, those of the other parts half of it; 0: none
    bool calibrate =
        false;  ///< calibrates the muscles, which takes minutes; else they are as strong as the adult's
    std::filesystem::path
        standard{};  ///< folder of the standard tables; empty: those of this build
};

struct SculptReport {
    std::filesystem::path out;
    headmodel::Identity identity;
    double skin_ita_deg = 0;  ///< individual typology angle of the skin
    headmodel::HeadQuality quality;
    std::vector<std::string> files;  ///< in the folder, sorted
    std::vector<std::string> notes;  ///< notes of the fit

    Json json() const;
};

/// The identity that a command line asks for, checked: a named one, a file, a seed, one between or in the middle of others, and then the fields that are set.
struct IdentityChoice {
    std::string identity{};  ///< a name of models/identities, or a file; empty: the average adult
    std::optional<unsigned> seed{};
    std::optional<double> sex{}, age{};
    std::vector<std::string> shape{};  ///< "lips=1.2"
    std::optional<std::string> skin{}, iris{}, hair{};
    std::optional<int> model{};             ///< 2: of the population; 1: varies the average adult
    std::optional<std::string> ancestry{};  ///< means model 2, as a seed does
    std::vector<std::string> morph{};       ///< two names or files, and the share of the second
    std::vector<std::string> average{};     ///< names or files
    std::optional<double> exaggerate{};     ///< factor of what distinguishes the person
    std::optional<std::string> hair_style{}, hairline_form{};
    std::optional<std::string> garment{};
    std::vector<double> garment_tone{};  ///< red, green, blue; empty: that of the identity
    std::optional<double> melanin{}, haemoglobin{}, skin_gloss{};
};
/// Returns the identity. Throws Error that names the option.
headmodel::Identity chosen_identity(const IdentityChoice& choice);

/// Writes the persons of a cast as identities, one file each, and cast.tsv into a folder. Returns the names of the files.
std::vector<std::string> write_cast(const CastOptions& options, const std::filesystem::path& out);

/// Throws Error when the identity is outside of the range of adults, or the folder holds other files; then nothing is written.
SculptReport sculpt_head(const SculptOptions& options, const ProgressMonitor& monitor = {});

}  // namespace risorius::headmodel
