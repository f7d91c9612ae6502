// SPDX-License-Identifier: MIT
/// \file
/// A script that is being edited: its JSON, the operations that change it, undo and redo.
///
/// An operation puts a value at a JSON pointer or removes it. What undoes it is an operation again, so that undo keeps no copies of
/// the script. Undo and redo give the same JSON with the same order of keys.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "risorius/core/json_cursor.h"

namespace risorius::view {

/// Sets the value at a pointer such as "/channels/AU12/keys". The parent must exist; an index one past the end appends.
struct Operation {
    std::string pointer;
    std::shared_ptr<const Json> value;  ///< null: the value is removed
    /// Where a new key of an object goes: before the entry with this number; at the end by default.
    std::optional<std::size_t> place;
};

class Document {
  public:
    static constexpr std::size_t kDeepestUndo = 500;

    explicit Document(Json script);

    const Json& json() const { return *json_; }
    /// The script as a file has it: two spaces a level, numbers in the shortest form, keys of curves each on one line.
    std::string text() const;
    long revision() const { return revision_; }  ///< counts all changes
    bool dirty() const { return revision_ != saved_revision_; }
    void saved() { saved_revision_ = revision_; }
    bool can_undo() const { return !undo_.empty(); }
    bool can_redo() const { return !redo_.empty(); }

    /// Makes all operations, or none. Edits with the same gesture, if it is not empty, are undone together. Throws Error for an
    /// operation that cannot be made.
    void edit(const std::vector<Operation>& operations, const std::string& gesture = "");
    bool undo();  ///< false when there is nothing to undo
    bool redo();
    /// Takes the last edit() back as if it had not been made.
    void reject();

  private:
    struct Step {
        std::string gesture;
        std::vector<Operation> inverse;  ///< to be made from the last to the first
    };
    Operation make(const Operation& operation);
    std::vector<Operation> make_all(const std::vector<Operation>& operations);

    std::shared_ptr<Json> json_;
    std::vector<Step> undo_, redo_;
    std::vector<Operation> last_;
    bool last_joined_ = false;
    std::size_t kept_before_ = 0;
    std::vector<Step> redo_before_;
    long revision_ = 0, saved_revision_ = 0;
};

/// Reads {"path": "/channels/AU12/keys", "value": [[0, 0]]}; without "value" the entry is removed.
Operation read_operation(const JsonCursor& json);

}  // namespace risorius::view
