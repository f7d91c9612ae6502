// SPDX-License-Identifier: MIT
// Nothing of the user's is lost under what `fit` writes. What it finds on heads is in tests/scenario.
#include "risorius/fitting/fit_rig.h"

#include <gtest/gtest.h>

#include <fstream>

#include "risorius/core/error.h"
#include "temporary_folder.h"

namespace risorius::fitting {
namespace {

std::string refusal_of_fit(const FitOptions& options) {
    try {
        fit_rig(options);
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(FitRig, TheRigTakesThePlaceOfAnEarlierRigOnly) {
    const TemporaryFolder folder;
    FitOptions asked;
    asked.mesh = folder / "head.obj";
    asked.landmarks = folder / "landmarks.json";
    std::ofstream(asked.mesh) << "v 0 0 0\n";
    std::ofstream(asked.landmarks) << R"({"format": "risorius-landmarks", "version": 1})";
    for (const auto& mine : {asked.mesh, asked.landmarks}) {
        const std::string before = bytes_of(mine);
        FitOptions options = asked;
        options.out = mine;
        EXPECT_EQ(refusal_of_fit(options),
                  mine.string() +
                      ": expected no file, or an earlier rig, found another file of that name");
        EXPECT_EQ(bytes_of(mine), before);
    }
    FitOptions options = asked;
    for (const char* name : {"", "made/"}) {
        options.out = folder / name;
        EXPECT_EQ(refusal_of_fit(options),
                  options.out.string() + ": expected no file, or an earlier rig, found a folder");
    }
    options.out = folder / "rig.json";
    std::ofstream(options.out) << R"({"format": "risorius-rig"})";
    EXPECT_EQ(refusal_of_fit(options).find(options.out.string()), std::string::npos);
    EXPECT_EQ(folder.listing(), (std::set<std::string>{"head.obj", "landmarks.json", "rig.json"}));
}

TEST(FitRig, AUnitIsAPositiveNumber) {
    const TemporaryFolder folder;
    for (const auto& [unit, found] : {std::pair{0.0, "0"}, {-0.01, "-0.01"}}) {
        FitOptions options;
        options.out = folder / "rig.json";
        options.metres_per_unit = unit;
        EXPECT_EQ(refusal_of_fit(options),
                  std::string("metres_per_unit: expected a number in (0, inf), found ") + found);
    }
}

}  // namespace
}  // namespace risorius::fitting
