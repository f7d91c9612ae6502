// SPDX-License-Identifier: MIT
#include "risorius/core/stand_in.h"

#include <gtest/gtest.h>

#include <fstream>

#include "risorius/core/error.h"
#include "risorius/core/existing_file.h"
#include "risorius/core/json_text.h"
#include "risorius/core/read_file.h"
#include "temporary_folder.h"

namespace risorius {
namespace {

TEST(StandIn, AFileIsReadUnderAnotherNameForAsLongAsItStandsIn) {
    const TemporaryFolder folder;
    constexpr FileKind kFile{"a text", 100};
    std::ofstream(folder / "new") << "new";
    std::ofstream(folder / "former") << "former";
    const JsonCursor names = parse_json_text(R"("none")", folder / "script.json");
    {
        const StandIn one(folder / "former", folder / "new"), two(folder / "none", folder / "new");
        EXPECT_EQ(read_text(folder / "former", kFile), "new");
        EXPECT_EQ(read_text(folder / "x/../former", kFile), "new");
        EXPECT_EQ(read_text(folder / "none", kFile), "new");
        EXPECT_EQ(existing_file(names), folder / "none");
    }
    EXPECT_EQ(read_text(folder / "former", kFile), "former");
    EXPECT_THROW(read_text(folder / "none", kFile), Error);
    EXPECT_THROW(existing_file(names), Error);
}

}  // namespace
}  // namespace risorius
