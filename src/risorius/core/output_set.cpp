// SPDX-License-Identifier: MIT
#include "risorius/core/output_set.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <set>
#include <vector>

#include "risorius/core/detail/live_outputs.h"
#include "risorius/core/detail/private_folder.h"
#include "risorius/core/input_log.h"

namespace risorius {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFileExpected = "a regular file, or nothing yet";
constexpr const char* kFolderExpected = "a folder, or nothing yet";
constexpr const char* kNoInput = "an output that is not an input";

const char* kind_of(mode_t mode) {
    if (S_ISREG(mode)) return "a file";
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISLNK(mode)) return "a symbolic link";
    if (S_ISFIFO(mode)) return "a pipe";
    return "a device or socket";
}

/// A target as it was given, and where it is.
struct Target {
    fs::path shown, place;
    std::string relative;
    enum class Kind { kFile, kReplacement, kFolder, kRemoval } kind = Kind::kFile;
};
using Kind = Target::Kind;

/// Throws Error when what is at the place cannot be replaced.
void check_place(const Target& target) {
    const auto& [shown, place, relative, kind] = target;
    const bool folder = kind == Kind::kFolder;
    struct ::stat status {};
    if (::lstat(place.c_str(), &status) != 0) {
        if (errno == ENOENT || errno == ENOTDIR) return;
        throw Error(shown.string(), folder ? kFolderExpected : kFileExpected, std::strerror(errno));
    }
    if (folder ? !S_ISDIR(status.st_mode) : !S_ISREG(status.st_mode))
        throw Error(shown.string(), folder ? kFolderExpected : kFileExpected,
                    kind_of(status.st_mode));
    if (kind == Kind::kRemoval || kind == Kind::kReplacement) return;
    if (is_input(status.st_dev, status.st_ino))
        throw Error(shown.string(), kNoInput, "one that was read");
    if (!folder) return;
    std::error_code failure;
    for (const auto& entry : fs::recursive_directory_iterator(place, failure))
        if (::lstat(entry.path().c_str(), &status) == 0 && is_input(status.st_dev, status.st_ino))
            throw Error(shown.string(), kNoInput,
                        in_quotes(entry.path().lexically_relative(place).string()) +
                            " in it, which was read");
}

/// The absolute path without links, "." and final slash.
fs::path real_folder(const fs::path& folder) {
    std::error_code failure;
    fs::path path = fs::weakly_canonical(fs::absolute(folder), failure).lexically_normal();
    if (failure) throw Error(folder.string(), "a folder that can be written", failure.message());
    if (!path.has_filename()) path = path.parent_path();
    return path;
}

/// Makes the folders that are missing, and returns them, the outermost first.
std::vector<fs::path> made_folders(const fs::path& folder) {
    std::vector<fs::path> missing, made;
    for (fs::path above = folder; !above.empty(); above = above.parent_path()) {
        std::error_code ignored;
        const fs::file_status status = fs::status(above, ignored);
        if (fs::is_directory(status)) break;
        if (fs::exists(status)) throw Error(above.string(), "a folder", "a file");
        missing.insert(missing.begin(), above);
        if (above == above.parent_path()) break;
    }
    for (const fs::path& one : missing) {
        if (::mkdir(one.c_str(), 0777) == 0) {
            made.push_back(one);
        } else if (errno != EEXIST) {
            const std::string reason = std::strerror(errno);
            for (auto begun = made.rbegin(); begun != made.rend(); ++begun) ::rmdir(begun->c_str());
            throw RunError(one.string() + ": the folder cannot be made: " + reason);
        }
    }
    return made;
}

/// Folders that were made for a set, and go with it when they are empty.
class MadeFolders {
  public:
    explicit MadeFolders(const fs::path& folder) : made_(made_folders(folder)) {}
    ~MadeFolders() {
        for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder)
            ::rmdir(folder->c_str());  // fails for one that is not empty, as intended
    }
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;
    const std::vector<fs::path>& list() const { return made_; }

  private:
    std::vector<fs::path> made_;
};

}  // namespace

struct OutputSet::Impl {
    Impl(const fs::path& given, Then then_)
        : then(then_),
          root(real_folder(given.empty() ? "." : given)),
          made(root),
          own(root),
          live(root, own.places().private_folder, made.list()) {}

    fs::path fresh(const Target& target) const { return own.places().fresh(target.relative); }

    fs::path add(const fs::path& shown, Kind kind) {
        Target target{.shown = shown, .place = {}, .relative = {}, .kind = kind};
        const bool folder = kind == Kind::kFolder;
        const fs::path whole = fs::absolute(shown).lexically_normal();
        const fs::path named = whole.has_filename() ? whole : whole.parent_path();
        // A link to a folder is followed.
        target.place =
            folder ? real_folder(named) : real_folder(named.parent_path()) / named.filename();
        const fs::path relative = target.place.lexically_relative(root);
        if (relative.empty() || relative == "." || *relative.begin() == "..")
            throw Error(shown.string(), "a place in " + root.string(), target.place.string());
        target.relative = relative.string();
        check_place(target);
        own.claim({"output " + target.relative}, shown);
        const fs::path path = fresh(target);
        if (kind != Kind::kRemoval) make_folder(folder ? path : path.parent_path());
        targets.push_back(std::move(target));
        return path;
    }

    void commit();
    void move_all(const std::vector<detail::Move>& moves);
    std::vector<detail::Move> checked_moves() const;

    Then then;
    fs::path root;
    MadeFolders made;
    detail::PrivateFolder own;
    detail::LiveOutput live;
    std::vector<Target> targets;
};

/// What is to be moved. All of it is on the disk.
std::vector<detail::Move> OutputSet::Impl::checked_moves() const {
    std::vector<detail::Move> moves;
    for (const Target& target : targets) {
        check_place(target);
        const bool removes = target.kind == Kind::kRemoval;
        struct ::stat status {};
        if (::lstat((removes ? target.place : fresh(target)).c_str(), &status) != 0) {
            if (removes && errno == ENOENT) continue;
            detail::fail_to_write(target.shown);
        }
        if (!removes) detail::sync_tree(fresh(target), target.shown);
        moves.push_back({target.relative, status.st_ino, removes});
    }
    return moves;
}

void OutputSet::Impl::move_all(const std::vector<detail::Move>& moves) {
    std::size_t done = 0;
    try {
        for (; done < moves.size(); ++done) detail::move_to_place(own.places(), moves[done]);
    } catch (...) {
        try {
            for (std::size_t i = done + 1; i-- > 0;) detail::move_back(own.places(), moves[i]);
        } catch (const RunError&) {
            own.keep();  // the next run finishes it
        }
        throw;
    }
    std::set<fs::path> folders;
    for (const Target& target : targets) folders.insert(target.place.parent_path());
    for (const fs::path& folder : folders) detail::sync_path(folder, folder);
}

void OutputSet::Impl::commit() {
    const std::vector<detail::Move> moves = checked_moves();
    const bool one_rename = targets.size() == 1 && (targets.front().kind == Kind::kFile ||
                                                    targets.front().kind == Kind::kReplacement);
    const fs::path folder = own.places().private_folder, journal = folder / detail::kJournal,
                   part = folder / "journal.part";
    if (!one_rename) detail::write_new_file(part, detail::journal_text(moves), true, root);
    const detail::Decision decision;  // throws Interrupted when the outputs were abandoned
    if (one_rename) {
        const Target& target = targets.front();
        make_folder(target.place.parent_path());
        if (::rename(fresh(target).c_str(), target.place.c_str()) != 0)
            detail::fail_to_write(target.shown);
        detail::sync_path(target.place.parent_path(), target.shown);
    } else {
        if (::rename(part.c_str(), journal.c_str()) != 0) detail::fail_to_write(root);
        detail::sync_path(folder, root);
        move_all(moves);
    }
    decision.succeeded(then == Then::kRunEnds);
}

OutputSet::OutputSet(const fs::path& folder, Then then) {
    const UninterruptedStep step;  // until it is known to abandon_outputs()
    impl_ = std::make_unique<Impl>(folder, then);
}
OutputSet::~OutputSet() {
    const detail::Removal removal;
    impl_.reset();
}

fs::path OutputSet::file(const fs::path& target) { return impl_->add(target, Kind::kFile); }
fs::path OutputSet::replacement(const fs::path& target) {
    return impl_->add(target, Kind::kReplacement);
}
fs::path OutputSet::folder(const fs::path& target) { return impl_->add(target, Kind::kFolder); }

fs::path OutputSet::scratch_file(const std::string& name) {
    const fs::path folder = impl_->own.places().private_folder / "scratch";
    make_folder(folder);
    return folder / name;
}

void OutputSet::removal(const fs::path& target) { impl_->add(target, Kind::kRemoval); }

void OutputSet::claim(const std::vector<std::string>& what) {
    std::vector<std::string> lines;
    for (const std::string& one : what) lines.push_back("claim " + one);
    impl_->own.claim(lines, impl_->root);
}

void OutputSet::commit() { impl_->commit(); }

fs::path folder_of_output(const fs::path& out) {
    return (out.has_filename() ? out : out.parent_path()).parent_path();
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure)
        throw RunError(shown_output(folder).string() +
                       ": the folder cannot be made: " + failure.message());
}

void write_file(const fs::path& file, std::string_view bytes) {
    if (is_private_output(file)) {
        make_folder(file.parent_path());
        if (::unlink(file.c_str()) != 0 && errno != ENOENT)
            detail::fail_to_write(shown_output(file));
        detail::write_new_file(file, bytes, false, shown_output(file));
        return;
    }
    OutputSet set(folder_of_output(file), OutputSet::Then::kRunGoesOn);
    detail::write_new_file(set.file(file), bytes, false, file);
    set.commit();
}

}  // namespace risorius
