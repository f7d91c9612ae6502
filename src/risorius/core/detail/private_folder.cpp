// SPDX-License-Identifier: MIT
#include "risorius/core/detail/private_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <set>
#include <sstream>
#include <thread>

#include "risorius/core/output_set.h"
#include "risorius/core/read_file.h"

namespace risorius::detail {

namespace fs = std::filesystem;

namespace {

constexpr const char* kOwner = "owner";
constexpr std::string_view kPrefix = ".risorius-";
constexpr std::size_t kRandomLetters = 6;
constexpr FileKind kOwnFile{"a file about outputs", 100 * kMegabyte};

enum class Lock { kTaken, kElsewhere, kUnknown };

Lock lock(const Descriptor& file) {
    int result;
    do result = ::flock(file.get(), LOCK_EX | LOCK_NB);
    while (result != 0 && errno == EINTR);
    if (result == 0) return Lock::kTaken;
    return errno == EWOULDBLOCK ? Lock::kElsewhere : Lock::kUnknown;
}

/// Held while private folders are made, looked through or removed, so that none is met half-made. It is a lock on the folder that
/// they lie in. Some network file systems have no locks on folders.
class FolderLock {
  public:
    explicit FolderLock(const fs::path& root)
        : folder_(::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
        constexpr auto kPause = std::chrono::milliseconds(5);
        constexpr int kTries = 2000;
        for (int i = 0; folder_ && i < kTries; ++i) {
            const Lock state = lock(folder_);
            held_ = state == Lock::kTaken;
            if (state != Lock::kElsewhere) return;
            std::this_thread::sleep_for(kPause);
        }
    }
    bool held() const { return held_; }

  private:
    Descriptor folder_;
    bool held_ = false;
};

bool is_private_name(const std::string& name) {
    return name.size() == kPrefix.size() + kRandomLetters && name.starts_with(kPrefix);
}

/// Whether this is a folder that this user's process has made, and no link.
bool is_own_folder(const fs::path& path) {
    struct ::stat status {};
    return ::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
           status.st_uid == ::geteuid();
}

/// The private folders of others and of this process.
std::vector<fs::path> private_folders(const fs::path& root) {
    std::vector<fs::path> folders;
    std::error_code ignored;
    for (auto entry = fs::directory_iterator(root, ignored);
         !ignored && entry != fs::directory_iterator(); entry.increment(ignored))
        if (is_private_name(entry->path().filename().string()) && is_own_folder(entry->path()))
            folders.push_back(entry->path());
    return folders;
}

/// The owner last, because a folder without one has nothing else in it.
void remove_private_folder(const fs::path& folder) {
    std::error_code ignored;
    // First, so that a folder that is only half removed is not taken for one that is to be moved to its place.
    fs::remove(folder / kJournal, ignored);
    for (const char* part : {"new", "former", "scratch", "journal.part"})
        fs::remove_all(folder / part, ignored);
    fs::remove(folder / kOwner, ignored);
    fs::remove(folder, ignored);
}

/// Finishes or removes what a process that has ended left.
void settle(const Places& places) {
    if (fs::exists(places.private_folder / kJournal)) {
        const auto moves = moves_of(read_file(places.private_folder / kJournal, kOwnFile));
        if (moves)
            for (const Move& move : *moves) move_to_place(places, move);
    }
    remove_private_folder(places.private_folder);
}

std::string this_process() {
    std::array<char, 256> host{};
    ::gethostname(host.data(), host.size() - 1);
    return "process " + std::to_string(::getpid()) + " on " + host.data();
}

/// Who claims any of it; empty when the folder's owner does not.
std::string claimed_by(const fs::path& folder, const std::set<std::string>& what) {
    std::istringstream lines(read_file(folder / kOwner, kOwnFile));
    std::string who, line;
    std::getline(lines, who);
    while (std::getline(lines, line))
        if (what.contains(line)) return who;
    return "";
}

/// A text as one line, so that it can be compared with a line.
std::string claim_line(std::string text) {
    for (char& c : text)
        if (c == '\n') c = '\x01';
    return text;
}

}  // namespace

PrivateFolder::PrivateFolder(const fs::path& root) {
    places_.root = root;
    const FolderLock locked(root);
    if (locked.held())
        for (const fs::path& folder : private_folders(root)) {
            const Descriptor owner = open_file(folder / kOwner, O_RDWR);
            if (!owner && errno != ENOENT) continue;
            if (owner && lock(owner) != Lock::kTaken) continue;
            settle({root, folder});
        }
    std::string name = (root / kPrefix).string() + std::string(kRandomLetters, 'X');
    if (!::mkdtemp(name.data())) fail_to_write(root);
    places_.private_folder = name;
    try {
        owner_ = open_file(places_.private_folder / kOwner, O_RDWR | O_CREAT | O_EXCL | O_APPEND);
        if (!owner_) fail_to_write(root);
        lock(owner_);
        write_all(owner_, this_process() + "\n", root);
        for (const char* part : {"new", "former"})
            if (::mkdir((places_.private_folder / part).c_str(), 0777) != 0) fail_to_write(root);
    } catch (...) {
        remove_private_folder(places_.private_folder);
        throw;
    }
}

PrivateFolder::~PrivateFolder() {
    if (!kept_) remove_private_folder(places_.private_folder);
}

void PrivateFolder::claim(const std::vector<std::string>& what, const fs::path& place) {
    std::set<std::string> lines;
    for (const std::string& one : what) lines.insert(claim_line(one));
    const FolderLock locked(places_.root);
    for (const fs::path& folder : private_folders(places_.root)) {
        if (folder == places_.private_folder) continue;
        const Descriptor owner = open_file(folder / kOwner, O_RDWR);
        if (!owner || lock(owner) != Lock::kElsewhere) continue;
        if (const std::string who = claimed_by(folder, lines); !who.empty())
            throw OutputInUse(place.string(), "an output that no other run is writing", who);
    }
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    write_all(owner_, text, place);
}

}  // namespace risorius::detail
