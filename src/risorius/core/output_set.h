// SPDX-License-Identifier: MIT
/// \file
/// The outputs of a run: files and folders below one folder, which appear together or not at all.
///
/// They are written in a private folder ".risorius-XXXXXX" with a random name, below the folder that they belong to. commit()
/// moves them to their places. What happens when the process ends before that:
/// - Before the decision, nothing has changed. The next set in the same folder removes the private folder.
/// - After the decision, the private folder has a complete journal of what is to be moved. The next set finishes it.
/// The decision is one rename: that of the journal. When there is one target, and no folder is replaced, it is that of the target.
///
/// A lock on the file "owner" in the private folder tells whether its process still runs. So two sets in one folder can have
/// different targets, but never the same. Where a file system has no locks, nothing that is found is touched.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "risorius/core/error.h"

namespace risorius {

/// Thrown when another run writes the same output.
class OutputInUse : public Error {
  public:
    using Error::Error;
};

class OutputSet {
  public:
    /// What follows the commit of a set. After that of the last one, a request to stop no longer counts.
    enum class Then { kRunEnds, kRunGoesOn };

    /// `folder`: where the outputs appear, themselves or in folders below; an empty path is the current folder. It is made when
    /// it is missing, and removed again without commit(). Throws Error or RunError when it cannot be made.
    explicit OutputSet(const std::filesystem::path& folder, Then then = Then::kRunEnds);
    ~OutputSet();  ///< without commit(), it removes everything that was written
    OutputSet(const OutputSet&) = delete;
    OutputSet& operator=(const OutputSet&) = delete;

    /// Adds a file and returns the path to write it to. Throws
    /// - Error when the target is a folder, link, pipe, device or socket, is an input, or lies outside of the folder,
    /// - OutputInUse when another set has it,
    /// - RunError when the private folder cannot be written.
    std::filesystem::path file(const std::filesystem::path& target);
    /// As file(), of a file that may be an input: a person who was asked lets it be replaced.
    std::filesystem::path replacement(const std::filesystem::path& target);
    /// Adds a folder, makes it, and returns the path to fill. At commit it takes the place of a folder of that name.
    std::filesystem::path folder(const std::filesystem::path& target);
    /// Adds a file that is to be gone after commit(). Throws as file() does, except that an input may be removed.
    void removal(const std::filesystem::path& target);
    /// Returns the path of a file that is not kept.
    std::filesystem::path scratch_file(const std::string& name);
    /// Keeps others from claiming the same, without writing anything. Throws OutputInUse.
    void claim(const std::vector<std::string>& what);

    /// Moves everything to its place. Throws RunError when that fails; then all targets are what they were. Throws Error when a
    /// target has become one that file() or folder() would refuse.
    void commit();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The folder of an output: that of "out/a.mp4" and of "out/frames/" is "out".
std::filesystem::path folder_of_output(const std::filesystem::path& out);

/// Writes a file: below the private folder of a set straight away, and elsewhere as the one target of a set. Missing folders are
/// made. Throws Error and RunError as OutputSet does.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Makes a folder and those above it. Throws RunError.
void make_folder(const std::filesystem::path& folder);

/// Whether the path lies in the private folder of a set of this process.
bool is_private_output(const std::filesystem::path& path);

/// The path as users know it: without the private folder.
std::filesystem::path shown_output(const std::filesystem::path& path);

/// For programs that are asked to stop: removes what all sets of this process have written, and lets none commit from now on.
/// Returns false, and does nothing, when a set is being committed or the last one has been.
bool abandon_outputs();

/// Whether the last set of the run has been committed, so that a request to stop comes too late. A new set begins a new run.
bool outputs_are_decided();

/// Whether any set of this process has been committed.
bool any_output_committed();

/// While an object of this class exists, abandon_outputs() waits for it. For steps that must not be cut off.
class UninterruptedStep {
  public:
    UninterruptedStep();  ///< throws Interrupted when the outputs were abandoned before
    ~UninterruptedStep();
    UninterruptedStep(const UninterruptedStep&) = delete;
    UninterruptedStep& operator=(const UninterruptedStep&) = delete;
};

}  // namespace risorius
