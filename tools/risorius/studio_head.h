// SPDX-License-Identifier: MIT
/// \file
/// A new head in the studio: the meshes of the project, one of them for the page, its landmarks as a file, and `risorius fit` from them.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "risorius/core/json_cursor.h"
#include "risorius/geom/polygon_mesh.h"
#include "risorius/serve/web_server.h"
#include "tools/risorius/child_job.h"

namespace risorius::cli {

/// Whether a file has the ending of a mesh that can be read.
bool is_mesh_file(const std::filesystem::path& file);

class StudioHead {
  public:
    /// `folder`: the project, canonical. Files are read and written below it alone.
    explicit StudioHead(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// {"type": "meshes", "files": ["anna/head.obj"]}
    std::string meshes() const;

    /// Reads {"type": "mesh", "path": "anna/head.obj"} and returns the mesh for the page (view/scene_frame.h). Throws Error.
    std::string mesh(const JsonCursor& message);

    /// Writes the landmarks of {"type": "fit" or "save_landmarks", "landmarks": {"n": [x, y, z]}, "replace": true} for the mesh
    /// that was read last, beside it, as NAME.landmarks.json. Positions are those of the page. Returns the file. Throws Error, also
    /// when a file that would be written exists (for a fit, the rig too) and "replace" is not true.
    std::filesystem::path write_landmarks(const JsonCursor& message) const;

    /// Fits a rig in a process of its own; "quick", "cut_lips" and "repair" are true or false, and "parts" is {"skin": ["Mesh_03"]}, the
    /// groups whose names do not tell their role. `tell` gets {"type": "fit", "state": "running", "done", "failed" or "cancelled",
    /// "fraction": 0..1, "path": of the mesh, "rig": ..., "text": what is done, or the report} on the thread of the server. Throws
    /// Error while another fit runs.
    void fit(const JsonCursor& message, const std::filesystem::path& landmarks,
             serve::WebServer& server, std::function<void(const std::string&)> tell);

    void cancel_fit() { fit_.cancel(); }
    bool fits() const { return fit_.running(); }
    /// What was told last of a fit.
    const std::string& fit_told() const { return fit_told_; }

    /// Finds the landmarks of the mesh that was read last, in pictures of it; "parts" as above. `done` gets {"type": "landmarks_found", "state": "done" or
    /// "failed", "path": of the mesh, "landmarks": {"n": {"at": position in the page, "confidence": 0..1}}, "text": what was wrong} on the
    /// thread of the server. Throws Error while another search runs.
    void find(const JsonCursor& message, serve::WebServer& server,
              std::function<void(const std::string&)> done);

    /// Ends a fit that runs, and waits for a search.
    void finish() {
        fit_.finish();
        search_.reset();
    }

  private:
    struct Opened {
        std::filesystem::path file;
        Eigen::Matrix4d to_file;  ///< from metres to coordinates of the file
        std::set<std::string> groups;
    };
    /// Role -> groups of the mesh, of {"parts": {"skin": ["Mesh_03"]}}. Throws Error.
    std::map<std::string, std::vector<std::string>> parts_of(const JsonCursor& message) const;
    std::string name_of(const std::filesystem::path& file) const;
    std::filesystem::path rig_file() const;

    std::filesystem::path folder_;
    std::optional<Opened> open_;
    ChildJob fit_;
    std::string fit_told_;
    std::unique_ptr<std::jthread> search_;
    bool searching_ = false;
};

}  // namespace risorius::cli
