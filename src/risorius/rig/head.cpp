// SPDX-License-Identifier: MIT
#include "risorius/rig/head.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "risorius/geom/fitted_sphere.h"
#include "risorius/geom/weld.h"
#include "risorius/rig/detail/landmark_drop.h"

namespace risorius::rig {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

bool any_of(const std::string& role, std::initializer_list<const char*> roles) {
    return std::any_of(roles.begin(), roles.end(), [&](const char* r) { return role == r; });
}

std::vector<std::string> roles_of_groups(const RigDescription& rig, const geom::PolygonMesh& mesh,
                                         const std::string& place) {
    std::vector<std::string> out(mesh.group_names.size());
    for (const auto& [role, groups] : rig.parts)
        for (const std::string& group : groups) {
            const int index = mesh.group_index(group);
            if (index < 0) {
                std::string known;
                for (const std::string& name : mesh.group_names) known += " \"" + name + "\"";
                throw Error(place + ":/mesh/parts/" + role, "a group of the mesh:" + known,
                            "\"" + group + "\"");
            }
            out[index] = role;
        }
    return out;
}

// Welds the seams of regions and of texture charts, which are not edges of the skin. Lips that touch stay separate (see
// geom/weld.h).
std::vector<int> weld_seams(const Points& vertices, const Triangles& surface) {
    const geom::WeldedSurface welded = geom::weld(vertices, surface);
    std::vector<int> out(static_cast<std::size_t>(vertices.rows()));
    for (std::size_t v = 0; v < out.size(); ++v) {
        const int joined = welded.welded_of_vertex[v];
        out[v] = joined < 0 ? static_cast<int>(v) : welded.first_vertex[joined];
    }
    return out;
}

Triangles apply_weld(Triangles triangles, const std::vector<int>& welded) {
    std::vector<long> keep;
    for (long f = 0; f < triangles.rows(); ++f) {
        for (int k = 0; k < 3; ++k) triangles(f, k) = welded[triangles(f, k)];
        if (triangles(f, 0) != triangles(f, 1) && triangles(f, 1) != triangles(f, 2) &&
            triangles(f, 2) != triangles(f, 0))
            keep.push_back(f);
    }
    Triangles out(static_cast<long>(keep.size()), 3);
    for (std::size_t i = 0; i < keep.size(); ++i)
        out.row(static_cast<long>(i)) = triangles.row(keep[i]);
    return out;
}

// Fits a sphere by least squares, then again without the points outside it (the cornea).
void fit_eye(const Points& vertices, const std::vector<int>& members, EyeGeometry& eye) {
    std::vector<int> used = members;
    for (int pass = 0; pass < 3; ++pass) {
        std::vector<Vec3> points;
        for (const int v : used) points.push_back(vertices.row(v).transpose());
        const geom::Sphere sphere = geom::fitted_sphere(points);
        eye.centre = sphere.centre;
        eye.radius_m = sphere.radius;
        std::vector<int> inside;
        for (int v : members) {
            const double off = (vertices.row(v).transpose() - eye.centre).norm() - eye.radius_m;
            if (std::abs(off) < 0.03 * eye.radius_m) inside.push_back(v);
        }
        if (inside.size() < members.size() / 3 || inside.size() < 20) break;
        used = inside;
    }
}

void measure_profile(const Points& vertices, const std::vector<int>& members, EyeGeometry& eye) {
    eye.profile_m.assign(91, 0.0);
    for (int v : members) {
        const Vec3 r = vertices.row(v).transpose() - eye.centre;
        const double angle = std::atan2(r.cross(eye.forward).norm(), r.dot(eye.forward)) / kDegree;
        const int bin = static_cast<int>(angle);
        if (bin > 90) continue;
        // A coarse eye has few vertices per degree, so each also fills the neighbouring bins.
        for (int b = std::max(0, bin - 3); b <= std::min(90, bin + 3); ++b)
            eye.profile_m[b] = std::max(eye.profile_m[b], r.norm());
    }
    for (double& r : eye.profile_m) r = std::max(r, eye.radius_m);
    std::vector<double> smooth = eye.profile_m;
    for (int b = 0; b <= 90; ++b) {
        double sum = 0;
        for (int k = -4; k <= 4; ++k) sum += eye.profile_m[std::clamp(std::abs(b + k), 0, 90)];
        smooth[b] = std::max(eye.radius_m, sum / 9.0);
    }
    eye.profile_m = smooth;
}

// The connected components of the faces in the listed groups, as lists of vertices.
std::vector<std::vector<int>> pieces_of(const geom::PolygonMesh& mesh,
                                        const std::vector<int>& groups) {
    std::vector<int> parent(static_cast<std::size_t>(mesh.vertex_count()), -1);
    const auto find = [&](int v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (int f = 0; f < mesh.face_count(); ++f) {
        if (std::find(groups.begin(), groups.end(), mesh.face_group[f]) == groups.end()) continue;
        const int first = mesh.corner_vertex[mesh.face_begin[f]];
        for (int c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
            const int v = mesh.corner_vertex[c];
            if (parent[v] < 0) parent[v] = v;
            const int a = find(first), b = find(v);
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    std::map<int, std::vector<int>> pieces;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if (parent[v] >= 0) pieces[find(v)].push_back(v);
    std::vector<std::vector<int>> out;
    for (auto& [root, members] : pieces) out.push_back(std::move(members));
    return out;
}

// Whether a component reaches well above and below the bite.
bool spans_both_jaws(const Head& head, const std::vector<int>& piece) {
    double lowest = 1e9, highest = -1e9;
    for (int v : piece) {
        lowest = std::min(lowest, head.vertices(v, 1));
        highest = std::max(highest, head.vertices(v, 1));
    }
    const double bite = head.landmark("sto").y();
    return highest > bite + head.mm(8) && lowest < bite - head.mm(12);
}

// Gums and tongue in one component with both jaws: vertices on the upper teeth and the palate stay with the skull, those on the
// lower teeth and the tongue move with the mandible, and a harmonic function over the edges interpolates in between.
void split_between_jaws(const geom::PolygonMesh& mesh, int group, const std::vector<int>& piece,
                        const std::vector<int>& upper_teeth, const std::vector<int>& lower_teeth,
                        Head& head) {
    std::map<int, int> index;
    for (int v : piece) index.emplace(v, static_cast<int>(index.size()));
    std::vector<std::set<int>> neighbours(piece.size());
    std::vector<Vec3> normal(piece.size(), Vec3::Zero());
    const Triangles triangles = geom::triangulate(mesh, {group});
    for (long f = 0; f < triangles.rows(); ++f) {
        if (!index.count(triangles(f, 0))) continue;
        const Vec3 a = head.vertices.row(triangles(f, 0)), b = head.vertices.row(triangles(f, 1)),
                   c = head.vertices.row(triangles(f, 2));
        for (int k = 0; k < 3; ++k) {
            const int i = index[triangles(f, k)], j = index[triangles(f, (k + 1) % 3)];
            neighbours[i].insert(j);
            neighbours[j].insert(i);
            normal[i] += (b - a).cross(c - a);
        }
    }
    const auto distance = [&](int v, const std::vector<int>& teeth) {
        double min = 1e300;
        for (int t : teeth)
            min = std::min(min, (head.vertices.row(t) - head.vertices.row(v)).squaredNorm());
        return std::sqrt(min);
    };
    constexpr double kUnknown = -1.0;
    std::vector<double> fraction(piece.size(), kUnknown);
    std::vector<char> tongue(piece.size(), 0);
    const double corner = std::abs(head.landmark("ch_l").x());
    for (std::size_t i = 0; i < piece.size(); ++i) {
        const Vec3 p = head.vertices.row(piece[i]).transpose();
        const double up = distance(piece[i], upper_teeth), down = distance(piece[i], lower_teeth);
        const double facing = normal[i].normalized().y();
        if (std::min(up, down) < head.mm(2.5)) {
            fraction[i] = up < down ? 0.0 : 1.0;
        } else if (std::abs(p.x()) < 0.8 * corner && facing > 0.4) {
            fraction[i] = 1.0;
            tongue[i] = 1;
        } else if (std::abs(p.x()) < corner && facing < -0.4 && p.y() > head.landmark("sto").y()) {
            fraction[i] = 0.0;
        }
    }
    std::vector<double> value(piece.size());
    for (std::size_t i = 0; i < piece.size(); ++i)
        value[i] = fraction[i] == kUnknown ? 0.5 : fraction[i];
    for (int sweep = 0; sweep < 300; ++sweep)
        for (std::size_t i = 0; i < piece.size(); ++i) {
            if (fraction[i] != kUnknown || neighbours[i].empty()) continue;
            double sum = 0;
            for (int j : neighbours[i]) sum += value[j];
            value[i] = sum / static_cast<double>(neighbours[i].size());
        }
    for (std::size_t i = 0; i < piece.size(); ++i) {
        head.jaw_fraction[piece[i]] = value[i];
        head.carrier[piece[i]] = tongue[i]        ? Carrier::kTongue
                                 : value[i] > 0.5 ? Carrier::kMandible
                                                  : Carrier::kSkull;
    }
}

}  // namespace

double EyeGeometry::profile_at(double angle_rad) const {
    const double at = std::clamp(angle_rad / kDegree, 0.0, 89.999);
    const int bin = static_cast<int>(at);
    const double t = at - bin;
    return (1 - t) * profile_m[bin] + t * profile_m[bin + 1];
}

double EyeGeometry::distance(const Vec3& p, const Vec3& looks) const {
    const Vec3 r = p - centre;
    return r.norm() - profile_at(std::atan2(r.cross(looks).norm(), r.dot(looks)));
}

const std::vector<std::string>& required_landmarks() {
    static const std::vector<std::string> kRequired{
        "n",    "prn",  "sn",   "ls",   "sto",  "li",   "pg",   "me",   "t_l",  "t_r",
        "en_l", "en_r", "ex_l", "ex_r", "ps_l", "ps_r", "pi_l", "pi_r", "ch_l", "ch_r"};
    return kRequired;
}

namespace {

std::map<std::string, Vec3> landmarks_in_mesh(const RigDescription& rig,
                                              const geom::PolygonMesh& mesh,
                                              const std::string& place) {
    std::map<std::string, Vec3> in_mesh;
    for (const auto& [id, landmark] : rig.landmarks) {
        if (landmark.vertex >= mesh.vertex_count())
            throw Error(place + ":/landmarks/" + id + "/vertex",
                        "a vertex in [0, " + std::to_string(mesh.vertex_count() - 1) + "]",
                        std::to_string(landmark.vertex));
        in_mesh[id] = landmark.vertex >= 0 ? Vec3(mesh.positions.row(landmark.vertex).transpose())
                                           : landmark.xyz;
    }
    for (const std::string& id : required_landmarks())
        if (!in_mesh.count(id))
            throw Error(place + ":/landmarks", "the landmark \"" + id + "\"", "none");
    return in_mesh;
}

void check_size(const RigDescription& rig, const Head& head, const std::string& place) {
    if (head.size > 0.6 && head.size < 1.6) return;
    const double fitting = rig.metres_per_unit / head.size;
    throw Error(place + ":/mesh/metres_per_unit",
                "a head of adult or child size (about " +
                    format_number(std::round(fitting * 1e6) / 1e6) + " for this mesh)",
                format_number(rig.metres_per_unit) + ", a head " +
                    format_number(std::round(head.size * 100) / 100) + " times the average adult");
}

void check_left_and_right(const std::map<std::string, Vec3>& in_mesh, const HeadFrame& frame,
                          const std::string& place) {
    for (const auto& [id, p] : in_mesh) {
        const auto partner = in_mesh.find(mirrored_landmark(id));
        if (!id.ends_with("_l") || partner == in_mesh.end()) continue;
        if (frame.to_head(p).x() <= frame.to_head(partner->second).x())
            throw Error(place + ":/landmarks/" + id,
                        "a point on the subject's left of \"" + partner->first + "\"",
                        "one on its right");
    }
}

// Welds the surfaces that move with the tissue: the skin and the linings of mouth and eye sockets.
void weld_surfaces(const geom::PolygonMesh& mesh, const std::string& place, Head& head) {
    std::vector<int> skin_groups, lining_groups;
    for (std::size_t g = 0; g < head.role_of_group.size(); ++g) {
        if (head.role_of_group[g] == "skin") skin_groups.push_back(static_cast<int>(g));
        if (any_of(head.role_of_group[g], {"mouth", "eye_socket"}))
            lining_groups.push_back(static_cast<int>(g));
    }
    if (skin_groups.empty())
        throw Error(place + ":/mesh/parts", "at least one group for \"skin\"", "none");
    Triangles skin = geom::triangulate(mesh, skin_groups);
    Triangles lining =
        lining_groups.empty() ? Triangles(0, 3) : geom::triangulate(mesh, lining_groups);
    Triangles both(skin.rows() + lining.rows(), 3);
    both << skin, lining;
    head.welded = weld_seams(head.vertices, both);
    head.skin = apply_weld(skin, head.welded);
    head.lining = apply_weld(lining, head.welded);
}

// Sets all landmarks of the atlas: the given ones, and the others by warping the atlas.
void place_landmarks(const RigDescription& rig, const std::map<std::string, Vec3>& in_mesh,
                     Head& head) {
    std::map<std::string, Vec3> in_head;
    for (const auto& [id, p] : in_mesh)
        if (rig.atlas.landmark(id)) in_head[id] = head.frame.to_head(p);
    head.landmarks = in_head;
    head.landmarks.merge(
        missing_landmarks(head.vertices, head.skin, rig.atlas, in_head, head.size));
    for (const AtlasLandmark& landmark : rig.atlas.landmarks)
        if (!in_head.count(landmark.id)) head.warped_landmarks.push_back(landmark.id);
}

// The tongue is the component that fills the midline; gums are arches, which are hollow in the middle.
Carrier carrier_of_gums_or_tongue(const Head& head, const std::vector<int>& piece,
                                  double occlusal_y) {
    double near_middle = 0, lowest = 1e9, highest = -1e9;
    for (int v : piece) {
        near_middle += std::abs(head.vertices(v, 0)) < head.mm(8) &&
                       head.vertices(v, 2) < head.landmark("ch_l").z() - head.mm(12);
        lowest = std::min(lowest, head.vertices(v, 1));
        highest = std::max(highest, head.vertices(v, 1));
    }
    if (near_middle > 0.2 * static_cast<double>(piece.size())) return Carrier::kTongue;
    return 0.5 * (lowest + highest) > occlusal_y ? Carrier::kSkull : Carrier::kMandible;
}

Carrier carrier_of(const Head& head, const std::string& role, const std::vector<int>& piece) {
    const double occlusal_y = head.landmark("sto").y();
    if (any_of(role, {"skin", "mouth", "eye_socket"})) return Carrier::kSkin;
    if (any_of(role, {"teeth_upper", "gums_upper"})) return Carrier::kSkull;
    if (any_of(role, {"teeth_lower", "gums_lower"})) return Carrier::kMandible;
    if (any_of(role, {"teeth", "gums"})) {
        // The occlusal plane separates the upper and lower components of a group.
        double mean_y = 0;
        for (int v : piece) mean_y += head.vertices(v, 1) / static_cast<double>(piece.size());
        return mean_y > occlusal_y ? Carrier::kSkull : Carrier::kMandible;
    }
    if (role == "tongue") return Carrier::kTongue;
    if (any_of(role, {"eye_l", "cornea_l"})) return Carrier::kEyeLeft;
    if (any_of(role, {"eye_r", "cornea_r"})) return Carrier::kEyeRight;
    if (any_of(role, {"lashes", "lashes_l", "lashes_r"})) return Carrier::kLashes;
    if (role == "gums_tongue") return carrier_of_gums_or_tongue(head, piece, occlusal_y);
    return Carrier::kNone;
}

/// Vertices of parts that are measured after the carriers are known.
struct CarriedVertices {
    std::array<std::vector<int>, 2> eyes;  ///< left, right
    std::vector<int> upper_teeth, lower_teeth;
};

void append(std::vector<int>& to, const std::vector<int>& piece) {
    to.insert(to.end(), piece.begin(), piece.end());
}

// Chooses the carrier of each vertex, component by component.
CarriedVertices choose_carriers(const geom::PolygonMesh& mesh, Head& head) {
    CarriedVertices carried;
    std::vector<std::pair<int, std::vector<int>>> both_jaws;
    head.carrier.assign(static_cast<std::size_t>(mesh.vertex_count()), Carrier::kNone);
    head.jaw_fraction.assign(static_cast<std::size_t>(mesh.vertex_count()), 0.0);
    for (std::size_t g = 0; g < head.role_of_group.size(); ++g) {
        const std::string& role = head.role_of_group[g];
        if (role.empty() || role == "hidden") continue;
        for (const std::vector<int>& piece : pieces_of(mesh, {static_cast<int>(g)})) {
            const Carrier carrier = carrier_of(head, role, piece);
            for (int v : piece) {
                head.carrier[v] = carrier;
                head.jaw_fraction[v] =
                    carrier == Carrier::kMandible || carrier == Carrier::kTongue ? 1.0 : 0.0;
            }
            if (any_of(role, {"gums_tongue", "gums"}) && spans_both_jaws(head, piece))
                both_jaws.push_back({static_cast<int>(g), piece});
            if (carrier == Carrier::kEyeLeft) append(carried.eyes[0], piece);
            if (carrier == Carrier::kEyeRight) append(carried.eyes[1], piece);
            if (any_of(role, {"teeth_upper", "teeth"}) && carrier == Carrier::kSkull)
                append(carried.upper_teeth, piece);
            if (any_of(role, {"teeth_lower", "teeth"}) && carrier == Carrier::kMandible)
                append(carried.lower_teeth, piece);
        }
    }
    if (!carried.upper_teeth.empty() && !carried.lower_teeth.empty())
        for (const auto& [group, piece] : both_jaws)
            split_between_jaws(mesh, group, piece, carried.upper_teeth, carried.lower_teeth, head);
    return carried;
}

// For a head without eyes, estimates eyes behind its lids.
void measure_eyes(const std::array<std::vector<int>, 2>& members, Head& head) {
    for (int side = 0; side < 2; ++side) {
        EyeGeometry& eye = head.eyes[side];
        const std::string suffix = side == 0 ? "_l" : "_r";
        if (members[side].size() >= 20) {
            fit_eye(head.vertices, members[side], eye);
            eye.present = true;
            measure_profile(head.vertices, members[side], eye);
        } else {
            eye.radius_m = head.mm(12);
            const Vec3 middle = 0.5 * (head.landmark("ps" + suffix) + head.landmark("pi" + suffix));
            eye.centre = middle - Vec3(0, 0, eye.radius_m);
            eye.profile_m.assign(91, eye.radius_m);
        }
    }
}

void measure_teeth(const std::vector<int>& upper_teeth, Head& head) {
    head.has_teeth = !upper_teeth.empty();
    head.teeth_front_m = head.landmark("sto").z() - head.mm(4);
    if (!head.has_teeth) return;
    double front = -1e9;
    for (int v : upper_teeth)
        if (std::abs(head.vertices(v, 0)) < head.mm(8))
            front = std::max(front, head.vertices(v, 2));
    if (front > -1e8) head.teeth_front_m = std::min(front, head.landmark("sto").z() - head.mm(1));
}

}  // namespace

Head place_head(const RigDescription& rig, const geom::PolygonMesh& mesh,
                const std::string& place) {
    Head head;
    head.role_of_group = roles_of_groups(rig, mesh, place);

    // Position and size of the head.
    const std::map<std::string, Vec3> in_mesh = landmarks_in_mesh(rig, mesh, place);
    head.frame = find_head_frame(in_mesh, rig.atlas, rig.metres_per_unit);
    head.size = head.frame.size;
    check_size(rig, head, place);
    check_left_and_right(in_mesh, head.frame, place);
    head.vertices = head.frame.to_head(mesh.positions);

    // Which vertices move with tissue, skull, mandible and eyes.
    weld_surfaces(mesh, place, head);
    place_landmarks(rig, in_mesh, head);
    const CarriedVertices carried = choose_carriers(mesh, head);
    measure_eyes(carried.eyes, head);
    measure_teeth(carried.upper_teeth, head);
    return head;
}

}  // namespace risorius::rig
