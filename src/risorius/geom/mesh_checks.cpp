// SPDX-License-Identifier: MIT
#include "risorius/geom/mesh_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "risorius/core/error.h"
#include "risorius/geom/surface_topology.h"
#include "risorius/geom/weld.h"

namespace risorius::geom {
namespace {

std::string number(double value) {
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), "%.4g", value);
    return text.data();
}

constexpr std::size_t kFacesInMessage = 10;  ///< of an edge that has more

/// One side of a face. Sorted, the sides of an edge are next to each other.
struct FaceSide {
    int low, high, face;
    bool forward;  ///< runs from low to high
};

class MeshInspector {
  public:
    MeshInspector(const PolygonMesh& mesh, const std::string& name, const MeshCheckOptions& options)
        : mesh_(mesh), name_(name), options_(options) {
        for (int f = 0; f < mesh.face_count(); ++f)
            if (options.groups.empty() || std::find(options.groups.begin(), options.groups.end(),
                                                    mesh.face_group[f]) != options.groups.end())
                faces_.push_back(f);
    }

    MeshReport inspect() {
        if (!is_filled() || !is_finite() || !has_valid_indices()) return std::move(report_);
        find_bounding_box();
        check_areas();
        check_edges();
        triangles_ = triangulate(mesh_, options_.groups);
        edges_ = surface_edges(triangles_);
        pieces_ = surface_pieces(triangles_, mesh_.vertex_count());
        check_facing();
        check_scale();
        check_pieces();
        check_unused();
        check_seams();
        return std::move(report_);
    }

  private:
    void add(MeshCheck check, Severity severity, const std::string& where,
             const std::string& expected, const std::string& found) {
        if (severity == Severity::kIgnore) return;
        if (++count_[check] > options_.findings_per_check) return;
        report_.findings.push_back({check, severity, name_ + where, expected, found});
    }

    /// Adds the number of findings to the first finding of a check.
    void total(MeshCheck check, const std::string& what) {
        const auto counted = count_.find(check);
        if (counted == count_.end() || counted->second < 2) return;
        for (MeshFinding& finding : report_.findings)
            if (finding.check == check) {
                finding.found += "; " + std::to_string(counted->second) + " such " + what;
                return;
            }
    }

    std::string at(const Vec3& p) const {
        return "at (" + number(p(0)) + ", " + number(p(1)) + ", " + number(p(2)) +
               (options_.scale == Severity::kIgnore ? ") in units of the mesh" : ") m");
    }
    Vec3 position(int v) const { return mesh_.positions.row(v).transpose(); }
    Vec3 face_centre(int f) const {
        Vec3 sum = Vec3::Zero();
        for (int c = mesh_.face_begin[f]; c < mesh_.face_begin[f + 1]; ++c)
            sum += position(mesh_.corner_vertex[c]);
        return sum / mesh_.corner_count(f);
    }
    std::string group_of(int f) const { return "group " + mesh_.group_names[mesh_.face_group[f]]; }

    bool is_filled() {
        if (mesh_.vertex_count() == 0)
            add(MeshCheck::kEmpty, Severity::kError, "", "vertices", "none");
        else if (mesh_.face_count() == 0)
            add(MeshCheck::kEmpty, Severity::kError, "", "faces", "none");
        else if (faces_.empty())
            add(MeshCheck::kEmpty, Severity::kError, "", "faces in the groups asked for", "none");
        return count_.empty();
    }

    bool is_finite() {
        for (int v = 0; v < mesh_.vertex_count(); ++v) {
            const Vec3 p = position(v);
            if (p.allFinite()) continue;
            add(MeshCheck::kNonFinite, Severity::kError, ":vertex " + std::to_string(v),
                "a finite position",
                "(" + number(p(0)) + ", " + number(p(1)) + ", " + number(p(2)) + ")");
        }
        total(MeshCheck::kNonFinite, "vertices");
        return count_.empty();
    }

    bool has_valid_indices() {
        for (int f = 0; f < mesh_.face_count(); ++f) {
            if (mesh_.corner_count(f) < 3)
                add(MeshCheck::kIndexRange, Severity::kError, ":face " + std::to_string(f),
                    "at least three corners", std::to_string(mesh_.corner_count(f)));
            for (int c = mesh_.face_begin[f]; c < mesh_.face_begin[f + 1]; ++c) {
                const int v = mesh_.corner_vertex[c];
                if (v >= 0 && v < mesh_.vertex_count()) continue;
                add(MeshCheck::kIndexRange, Severity::kError, ":face " + std::to_string(f),
                    "vertices in 0 .. " + std::to_string(mesh_.vertex_count() - 1),
                    std::to_string(v));
                break;
            }
        }
        total(MeshCheck::kIndexRange, "faces");
        return count_.empty();
    }

    void find_bounding_box() {
        report_.low.setConstant(std::numeric_limits<double>::infinity());
        report_.high = -report_.low;
        for (const int f : faces_)
            for (int c = mesh_.face_begin[f]; c < mesh_.face_begin[f + 1]; ++c) {
                report_.low = report_.low.cwiseMin(position(mesh_.corner_vertex[c]));
                report_.high = report_.high.cwiseMax(position(mesh_.corner_vertex[c]));
            }
    }

    double face_area(int f) const {
        const int first = mesh_.face_begin[f];
        const Vec3 a = position(mesh_.corner_vertex[first]);
        Vec3 doubled = Vec3::Zero();
        for (int k = 1; k + 1 < mesh_.corner_count(f); ++k)
            doubled += (position(mesh_.corner_vertex[first + k]) - a)
                           .cross(position(mesh_.corner_vertex[first + k + 1]) - a);
        return 0.5 * doubled.norm();
    }

    void check_areas() {
        for (const int f : faces_) {
            const std::string where = ":face " + std::to_string(f);
            std::vector<int> corners(mesh_.corner_vertex.begin() + mesh_.face_begin[f],
                                     mesh_.corner_vertex.begin() + mesh_.face_begin[f + 1]);
            std::sort(corners.begin(), corners.end());
            const auto twice = std::adjacent_find(corners.begin(), corners.end());
            const std::string context = "(" + group_of(f) + ", " + at(face_centre(f)) + ")";
            if (twice != corners.end())
                add(MeshCheck::kDegenerateFace, options_.degenerate_face, where, "each vertex once",
                    "vertex " + std::to_string(*twice) + " twice " + context);
            else if (const double area = face_area(f); !(area > options_.smallest_face_area_m2))
                add(MeshCheck::kDegenerateFace, options_.degenerate_face, where,
                    "an area above " + number(options_.smallest_face_area_m2) + " m2",
                    number(area) + " m2 " + context);
        }
        total(MeshCheck::kDegenerateFace, "faces");
    }

    void check_edges() {
        std::vector<FaceSide> sides;
        for (const int f : faces_) {
            const int first = mesh_.face_begin[f], n = mesh_.corner_count(f);
            for (int k = 0; k < n; ++k) {
                const int a = mesh_.corner_vertex[first + k],
                          b = mesh_.corner_vertex[first + (k + 1) % n];
                if (a != b) sides.push_back({std::min(a, b), std::max(a, b), f, a < b});
            }
        }
        std::stable_sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
            return std::array{a.low, a.high} < std::array{b.low, b.high};
        });
        for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
            const FaceSide& side = sides[begin];
            while (end < sides.size() && sides[end].low == side.low && sides[end].high == side.high)
                ++end;
            const std::string where =
                ":edge " + std::to_string(side.low) + "-" + std::to_string(side.high);
            const Vec3 middle = 0.5 * (position(side.low) + position(side.high));
            const std::string context = "(" + group_of(side.face) + ", " + at(middle) + ")";
            if (end - begin > 2) {
                std::string list;
                const std::size_t last = std::min(end, begin + kFacesInMessage);
                for (std::size_t i = begin; i < last; ++i)
                    (list += i > begin ? ", " : "") += std::to_string(sides[i].face);
                if (last < end) list += " ...";
                add(MeshCheck::kNonManifoldEdge, options_.non_manifold_edge, where,
                    "one or two faces",
                    std::to_string(end - begin) + ", faces " + list + " " + context);
            } else if (end - begin == 2 && side.forward == sides[begin + 1].forward) {
                add(MeshCheck::kWinding, options_.winding, where,
                    "its two faces to run along it opposite ways",
                    "faces " + std::to_string(side.face) + " and " +
                        std::to_string(sides[begin + 1].face) +
                        " running the same way, one is flipped " + context);
            }
        }
        std::stable_sort(
            report_.findings.begin(), report_.findings.end(),
            [](const MeshFinding& a, const MeshFinding& b) { return a.check < b.check; });
        total(MeshCheck::kNonManifoldEdge, "edges");
        total(MeshCheck::kWinding, "edges");
    }

    void check_facing() {
        // Volume relative to the middle. For an open surface it is positive when most of it faces away from its middle.
        const Vec3 middle = 0.5 * (report_.low + report_.high);
        std::vector<double> volume(static_cast<std::size_t>(pieces_.count()), 0.0);
        double whole = 0;
        for (long t = 0; t < triangles_.rows(); ++t) {
            const Vec3 a = position(triangles_(t, 0)) - middle,
                       b = position(triangles_(t, 1)) - middle,
                       c = position(triangles_(t, 2)) - middle;
            const double sixth = a.dot(b.cross(c)) / 6.0;
            volume[pieces_.of_triangle[t]] += sixth;
            whole += sixth;
        }
        if (whole < 0) {
            add(MeshCheck::kInsideOut, options_.inside_out, "", "a surface facing outwards",
                "one facing inwards (enclosed volume " + number(whole) + " m3)");
            return;
        }
        std::vector<bool> open(volume.size(), false);
        for (int e = 0; e < edges_.count(); ++e)
            if (edges_.triangle_count(e) == 1)
                open[pieces_.of_triangle[edges_.triangle[edges_.triangle_begin[e]]]] = true;
        const std::vector<int> first_face = first_face_of_pieces();
        for (std::size_t p = 0; p < volume.size(); ++p) {
            if (open[p] || !(volume[p] < 0)) continue;
            add(MeshCheck::kInsideOut, options_.inside_out,
                ":face " + std::to_string(first_face[p]), "a closed piece facing outwards",
                "one facing inwards (enclosed volume " + number(volume[p]) + " m3, " +
                    group_of(first_face[p]) + ")");
        }
        total(MeshCheck::kInsideOut, "pieces");
    }

    int piece_of_face(int f) const {
        return pieces_.of_vertex[mesh_.corner_vertex[mesh_.face_begin[f]]];
    }

    std::vector<int> first_face_of_pieces() const {
        std::vector<int> first(static_cast<std::size_t>(pieces_.count()), -1);
        for (const int f : faces_)
            if (int& face = first[piece_of_face(f)]; face < 0) face = f;
        return first;
    }

    void check_scale() {
        const double size = (report_.high - report_.low).maxCoeff();
        if (size >= options_.smallest_size_m && size <= options_.max_size_m) return;
        std::string advice;
        // Millimetres, centimetres, inches, decimetres, feet, metres, and the results of mistaking one unit for another.
        constexpr double kTypicalHead_m = 0.3;
        double best = 0;
        for (const double factor :
             {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.0254, 0.1, 0.3048, 1.0, 10.0, 100.0, 1000.0}) {
            const double resized = size / options_.metres_per_unit * factor;
            if (resized < options_.smallest_size_m || resized > options_.max_size_m) continue;
            const double previous = size / options_.metres_per_unit * best;
            if (best == 0 || std::abs(std::log(resized / kTypicalHead_m)) <
                                 std::abs(std::log(previous / kTypicalHead_m)))
                best = factor;
        }
        if (best > 0)
            advice = "; metres_per_unit " + number(best) + " instead of " +
                     number(options_.metres_per_unit) + " would make it " +
                     number(size / options_.metres_per_unit * best) + " m";
        add(MeshCheck::kScale, options_.scale, "",
            "a longest side of " + number(options_.smallest_size_m) + " to " +
                number(options_.max_size_m) + " m",
            number(size) + " m" + advice);
    }

    void check_pieces() {
        report_.piece_face_count.assign(static_cast<std::size_t>(pieces_.count()), 0);
        for (const int f : faces_) ++report_.piece_face_count[piece_of_face(f)];
        report_.boundary_loop_count = static_cast<int>(boundary_loops(triangles_, edges_).size());
        if (pieces_.count() < 2) return;
        constexpr std::size_t kListed = 6;
        std::vector<int> sizes = report_.piece_face_count;
        std::sort(sizes.rbegin(), sizes.rend());
        std::string list;
        for (std::size_t i = 0; i < std::min(sizes.size(), kListed); ++i)
            (list += i > 0 ? ", " : "") += std::to_string(sizes[i]);
        if (sizes.size() > kListed) list += ", ...";
        add(MeshCheck::kPieces, options_.pieces, "", "one piece",
            std::to_string(pieces_.count()) + " pieces of " + list + " faces");
    }

    void check_unused() {
        std::vector<bool> used(static_cast<std::size_t>(mesh_.vertex_count()), false);
        for (const int v : mesh_.corner_vertex) used[v] = true;
        for (int v = 0; v < mesh_.vertex_count(); ++v)
            if (!used[v])
                add(MeshCheck::kUnusedVertex, options_.unused_vertex,
                    ":vertex " + std::to_string(v), "a face that uses it",
                    "none (" + at(position(v)) + ")");
        total(MeshCheck::kUnusedVertex, "vertices");
    }

    void check_seams() {
        const WeldedSurface welded =
            weld(mesh_.positions, triangles_,
                 {.tolerance_m = options_.seam_tolerance_m, .boundary_only = true});
        for (int v = 0; v < mesh_.vertex_count(); ++v) {
            const int w = welded.welded_of_vertex[v];
            if (w < 0 || welded.first_vertex[w] == v) continue;
            add(MeshCheck::kCoincidentVertex, options_.coincident_vertex,
                ":vertex " + std::to_string(v), "a position of its own",
                "that of vertex " + std::to_string(welded.first_vertex[w]) + " (" +
                    at(position(v)) + ")");
        }
        total(MeshCheck::kCoincidentVertex, "vertices");
    }

    const PolygonMesh& mesh_;
    const std::string& name_;
    const MeshCheckOptions& options_;
    std::vector<int> faces_;  ///< checked faces
    Triangles triangles_;
    SurfaceEdges edges_;
    SurfacePieces pieces_;
    std::map<MeshCheck, int> count_;
    MeshReport report_;
};

}  // namespace

MeshReport inspect_mesh(const PolygonMesh& mesh, const std::string& name,
                        const MeshCheckOptions& options) {
    return MeshInspector(mesh, name, options).inspect();
}

MeshReport check_mesh(const PolygonMesh& mesh, const std::string& name,
                      const MeshCheckOptions& options) {
    MeshReport report = inspect_mesh(mesh, name, options);
    for (const MeshFinding& finding : report.findings)
        if (finding.severity == Severity::kError)
            throw Error(finding.place, finding.expected, finding.found);
    return report;
}

}  // namespace risorius::geom
