// SPDX-License-Identifier: MIT
/// \file
/// A test in a folder of its own, so that it can write files by short names while others run beside it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "temporary_folder.h"

namespace risorius {

class OwnFolderTest : public testing::Test {
  protected:
    OwnFolderTest() : before_(std::filesystem::current_path()) {
        std::filesystem::current_path(folder_.path());
    }
    ~OwnFolderTest() override { std::filesystem::current_path(before_); }

  private:
    TemporaryFolder folder_;
    std::filesystem::path before_;
};

}  // namespace risorius
