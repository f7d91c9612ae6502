// SPDX-License-Identifier: MIT
/// \file
/// What a commit moves from a private folder to its places, and how it is undone or finished after the process has ended.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace risorius::detail {

/// One file or folder. The inode tells whether it is in its place already.
struct Move {
    std::string
        target;  ///< relative to the folder of the set; also relative to "new" in the private folder
    ino_t inode = 0;
    bool removes = false;  ///< the target is moved away, and nothing comes in its place
};

/// The folders of a set: `root`/target is where outputs appear, `private_folder` holds "new" and "former" beside the journal.
struct Places {
    std::filesystem::path root, private_folder;
    std::filesystem::path fresh(const std::string& target) const {
        return private_folder / "new" / target;
    }
    std::filesystem::path former(const std::string& target) const {
        return private_folder / "former" / target;
    }
};

/// Moves to its place what is not there yet. What was there goes to the private folder. Throws RunError.
void move_to_place(const Places& places, const Move& move);

/// The opposite. Does nothing for what was not moved. Throws RunError.
void move_back(const Places& places, const Move& move);

/// The journal as text, and back; none when the text is no complete journal.
std::string journal_text(const std::vector<Move>& moves);
std::optional<std::vector<Move>> moves_of(const std::string& text);

inline constexpr const char* kJournal = "journal";

}  // namespace risorius::detail
