// SPDX-License-Identifier: MIT
#include "risorius/core/detail/rename_journal.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <sstream>

#include "risorius/core/detail/checked_file.h"
#include "risorius/core/error.h"

namespace risorius::detail {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFirstLine = "risorius-journal 1";
constexpr const char* kLastLine = "end";

/// The inode of what has this name, a link itself included; 0: nothing.
ino_t inode_of(const fs::path& path) {
    struct ::stat status {};
    return ::lstat(path.c_str(), &status) == 0 ? status.st_ino : 0;
}

/// Makes two names exchange what they name. Returns false where the file system cannot.
bool exchange(const fs::path& a, const fs::path& b, const fs::path& place) {
    if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) fail_to_write(place);
    return false;
}

void rename_checked(const fs::path& from, const fs::path& to, const fs::path& place) {
    if (::rename(from.c_str(), to.c_str()) != 0) fail_to_write(place);
}

void make_parent(const fs::path& path, const fs::path& place) {
    std::error_code failure;
    fs::create_directories(path.parent_path(), failure);
    if (failure) throw RunError(place.string() + ": cannot be written: " + failure.message());
}

/// A line without line breaks.
std::string in_one_line(const std::string& text) {
    std::string out;
    for (const char c : text)
        if (c == '\n')
            out += "%n";
        else if (c == '%')
            out += "%p";
        else
            out += c;
    return out;
}

std::string from_one_line(const std::string& line) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i)
        if (line[i] == '%' && i + 1 < line.size())
            out += line[++i] == 'n' ? '\n' : '%';
        else
            out += line[i];
    return out;
}

/// Whether a path stays below the folder that it is relative to.
bool stays_below(const fs::path& path) {
    if (path.empty() || path.is_absolute()) return false;
    for (const fs::path& part : path)
        if (part == ".." || part == "." || part.empty()) return false;
    return true;
}

}  // namespace

void move_to_place(const Places& places, const Move& move) {
    const fs::path place = places.root / move.target, fresh = places.fresh(move.target),
                   former = places.former(move.target);
    const ino_t there = inode_of(place);
    if (move.removes) {
        if (there != move.inode) return;
        make_parent(former, place);
        rename_checked(place, former, place);
        return;
    }
    if (there == move.inode || inode_of(fresh) != move.inode) return;
    make_parent(place, place);
    if (there != 0) {
        if (exchange(fresh, place, place)) return;
        make_parent(former, place);
        rename_checked(place, former, place);
    }
    rename_checked(fresh, place, place);
}

void move_back(const Places& places, const Move& move) {
    const fs::path place = places.root / move.target, fresh = places.fresh(move.target),
                   former = places.former(move.target);
    if (!move.removes && inode_of(place) == move.inode) {
        if (inode_of(fresh) != 0) {
            exchange(fresh, place, place);
            return;
        }
        rename_checked(place, fresh, place);
    }
    if (inode_of(former) != 0) rename_checked(former, place, place);
}

std::string journal_text(const std::vector<Move>& moves) {
    std::string text = std::string(kFirstLine) + "\n";
    for (const Move& move : moves)
        text += std::to_string(move.inode) + (move.removes ? " - " : " + ") +
                in_one_line(move.target) + "\n";
    return text + kLastLine + "\n";
}

std::optional<std::vector<Move>> moves_of(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || line != kFirstLine) return {};
    std::vector<Move> moves;
    while (std::getline(lines, line)) {
        if (line == kLastLine) return moves;
        const std::size_t gap = line.find(' ');
        if (gap == std::string::npos || gap + 2 >= line.size() || line[gap + 2] != ' ') return {};
        Move move;
        move.removes = line[gap + 1] == '-';
        move.inode = std::strtoull(line.c_str(), nullptr, 10);
        move.target = from_one_line(line.substr(gap + 3));
        if (move.inode == 0 || !stays_below(move.target)) return {};
        moves.push_back(std::move(move));
    }
    return {};
}

}  // namespace risorius::detail
