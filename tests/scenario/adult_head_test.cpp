// SPDX-License-Identifier: MIT
// The embedded head: what the simulation and the renderer take for granted about its geometry.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "paths.h"
#include "risorius/core/types.h"

namespace {

using risorius::Vec3;

const std::string kFolder = std::string(RISORIUS_SOURCE_DIR) + "/models/adult/";

struct Head {
    std::vector<Vec3> points;  // mm
    std::map<std::string, std::vector<std::vector<int>>> faces;
    std::map<std::string, int> landmarks;
};

// Read here line by line, so that the test does not lean on the reader it might be testing.
const Head& head() {
    static const Head read = [] {
        Head h;
        std::ifstream in(kFolder + "head.obj");
        std::string line, word, group;
        while (std::getline(in, line)) {
            std::istringstream text(line);
            text >> word;
            if (word == "v") {
                Vec3 p;
                text >> p.x() >> p.y() >> p.z();
                h.points.push_back(p);
            } else if (word == "g") {
                text >> group;
            } else if (word == "f") {
                std::vector<int> face;
                // Of "vertex/place" the vertex
                for (std::string corner; text >> corner;) face.push_back(std::stoi(corner) - 1);
                h.faces[group].push_back(face);
            }
        }
        std::ifstream json(kFolder + "landmarks.json");
        const auto document = nlohmann::json::parse(json);
        for (const auto& [id, value] : document.at("landmarks").items())
            h.landmarks[id] = value.at("vertex");
        return h;
    }();
    return read;
}

std::vector<std::vector<int>> skin_and_mouth() {
    auto faces = head().faces.at("skin");
    const auto& mouth = head().faces.at("mouth");
    faces.insert(faces.end(), mouth.begin(), mouth.end());
    return faces;
}

std::map<std::pair<int, int>, int> directed_edges(const std::vector<std::vector<int>>& faces) {
    std::map<std::pair<int, int>, int> count;
    for (const auto& f : faces)
        for (std::size_t k = 0; k < f.size(); ++k) ++count[{f[k], f[(k + 1) % f.size()]}];
    return count;
}

std::map<std::string, Vec3> measured_landmarks() {
    std::ifstream in(kFolder + "design/landmarks.csv");
    std::map<std::string, Vec3> table;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream text(line);
        std::string id, side, x, y, z;
        std::getline(text, id, ',');
        std::getline(text, side, ',');
        std::getline(text, x, ',');
        std::getline(text, y, ',');
        std::getline(text, z, ',');
        table[id] = Vec3(std::stod(x), std::stod(y), std::stod(z));
    }
    return table;
}

// Sclera and cornea as in tools/sculpt/eyes.h: 11.5 mm about the centre, 7.8 mm about a point 4.7 mm before it.
double globe_radius(double cosine) {
    const double b = 4.7 * cosine, under = b * b - 4.7 * 4.7 + 7.8 * 7.8;
    return cosine > 0 && under > 0 ? std::max(11.5, b + std::sqrt(under)) : 11.5;
}

TEST(AdultHead, HasAllItsParts) {
    for (const char* part : {"skin", "mouth", "eye_l", "eye_r", "teeth_upper", "teeth_lower",
                             "gums_upper", "gums_lower", "tongue", "lashes_l", "lashes_r"})
        EXPECT_TRUE(head().faces.count(part) && !head().faces.at(part).empty()) << part;
    EXPECT_EQ(head().faces.size(), 11u);
}

TEST(AdultHead, SkinIsOneManifoldOpenOnlyAtShouldersAndSockets) {
    const auto faces = skin_and_mouth();
    const auto edges = directed_edges(faces);
    std::map<int, std::vector<int>> next;
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1) << "edge " << edge.first << " " << edge.second
                            << " is used twice in one direction";
        if (!edges.count({edge.second, edge.first})) next[edge.first].push_back(edge.second);
    }
    // Boundary loops: the bust, and the inner end of each lid.
    int loops = 0;
    std::set<int> seen;
    for (const auto& [start, to] : next) {
        EXPECT_EQ(to.size(), 1u) << "boundary branches at vertex " << start;
        if (seen.count(start)) continue;
        ++loops;
        const Vec3 p = head().points[static_cast<std::size_t>(start)];
        EXPECT_TRUE(p.y() < -120 ||
                    (std::abs(std::abs(p.x()) - 31.5) < 16 && std::abs(p.y() - 18.2) < 12))
            << p.transpose();
        for (int v = start; !seen.count(v); v = next.at(v)[0]) seen.insert(v);
    }
    EXPECT_EQ(loops, 3);

    // One piece: spread from any vertex over edges.
    std::map<int, std::vector<int>> around;
    for (const auto& [edge, count] : edges) {
        around[edge.first].push_back(edge.second);
        around[edge.second].push_back(edge.first);
    }
    std::set<int> reached{around.begin()->first};
    std::vector<int> open(reached.begin(), reached.end());
    while (!open.empty()) {
        const int v = open.back();
        open.pop_back();
        for (const int n : around[v])
            if (reached.insert(n).second) open.push_back(n);
    }
    EXPECT_EQ(reached.size(), around.size());
    // Every vertex of a part is used by it.
    EXPECT_GT(around.size(), 8000u);
    EXPECT_LT(around.size(), 14000u);
}

TEST(AdultHead, SkinIsQuadsOnly) {
    for (const auto& f : skin_and_mouth()) EXPECT_EQ(f.size(), 4u);
}

TEST(AdultHead, MirrorsExactly) {
    std::set<std::array<long, 3>> all;
    const auto key = [](const Vec3& p, double side) {
        return std::array<long, 3>{std::lround(side * p.x() * 1e6), std::lround(p.y() * 1e6),
                                   std::lround(p.z() * 1e6)};
    };
    std::set<int> used;
    for (const auto& f : skin_and_mouth()) used.insert(f.begin(), f.end());
    for (const int v : used) all.insert(key(head().points[static_cast<std::size_t>(v)], 1));
    for (const int v : used)
        EXPECT_TRUE(all.count(key(head().points[static_cast<std::size_t>(v)], -1)))
            << head().points[static_cast<std::size_t>(v)].transpose();
}

TEST(AdultHead, SurfacesFaceOutwards) {
    // Signed volume of the closed parts, and of the skin closed by a cone at its boundary towards the neck.
    for (const auto& [name, faces] : head().faces) {
        if (name.starts_with("lashes") || name == "mouth") continue;
        const auto parts = name == "skin" ? skin_and_mouth() : faces;
        Vec3 apex = Vec3::Zero();
        std::set<int> used;
        for (const auto& f : parts) used.insert(f.begin(), f.end());
        for (const int v : used)
            apex += head().points[static_cast<std::size_t>(v)] / static_cast<double>(used.size());
        double volume = 0;
        for (const auto& f : parts)
            for (std::size_t k = 1; k + 1 < f.size(); ++k) {
                const auto at = [&](int v) {
                    return Vec3(head().points[static_cast<std::size_t>(v)] - apex);
                };
                volume += at(f[0]).dot(at(f[k]).cross(at(f[k + 1]))) / 6;
            }
        EXPECT_GT(volume, 0) << name;
        if (name == "eye_l") {
            EXPECT_NEAR(volume, 4.0 / 3 * M_PI * std::pow(11.5, 3), 250);  // plus the corneal cap
        }
    }
}

TEST(AdultHead, LandmarksStandWhereTheyWereMeasured) {
    double square = 0;
    std::set<int> skin;
    for (const auto& f : head().faces.at("skin")) skin.insert(f.begin(), f.end());
    const auto table = measured_landmarks();
    ASSERT_EQ(table.size(), 109u);
    for (const auto& [id, p] : table) {
        ASSERT_TRUE(head().landmarks.count(id)) << id;
        const int v = head().landmarks.at(id);
        EXPECT_TRUE(skin.count(v)) << id << " is not a vertex of the skin";
        const double error = (head().points[static_cast<std::size_t>(v)] - p).norm();
        EXPECT_LE(error, 1.5) << id;
        square += error * error;
    }
    EXPECT_LE(std::sqrt(square / 109), 0.6);
}

TEST(AdultHead, MirroredLandmarksAreMirroredVertices) {
    for (const auto& [id, v] : head().landmarks) {
        if (!id.ends_with("_l")) continue;
        const Vec3 left = head().points[static_cast<std::size_t>(v)];
        const Vec3 right = head().points[static_cast<std::size_t>(
            head().landmarks.at(id.substr(0, id.size() - 2) + "_r"))];
        EXPECT_LE((Vec3(-left.x(), left.y(), left.z()) - right).norm(), 1e-6) << id;
    }
}

TEST(AdultHead, FaceHasTheMeasuredDepth) {
    std::ifstream in(kFolder + "design/face_depth.csv");
    std::string line, cell;
    std::getline(in, line);
    std::vector<double> xs;
    std::istringstream header(line);
    std::getline(header, cell, ',');
    while (std::getline(header, cell, ',')) xs.push_back(std::stod(cell));
    double square = 0;
    int rays = 0, missed = 0;
    while (std::getline(in, line)) {
        std::istringstream text(line);
        std::getline(text, cell, ',');
        const double y = std::stod(cell);
        for (std::size_t c = 0; c < xs.size() && std::getline(text, cell, ','); ++c) {
            if (cell.empty()) continue;
            double z = -1e9;
            for (const auto& f : head().faces.at("skin"))
                for (std::size_t k = 1; k + 1 < f.size(); ++k) {
                    const Vec3 &a = head().points[static_cast<std::size_t>(f[0])],
                               &b = head().points[static_cast<std::size_t>(f[k])],
                               &d = head().points[static_cast<std::size_t>(f[k + 1])];
                    const double area =
                        (b.x() - a.x()) * (d.y() - a.y()) - (b.y() - a.y()) * (d.x() - a.x());
                    if (area < 1e-9) continue;
                    const double u =
                        ((xs[c] - a.x()) * (d.y() - a.y()) - (y - a.y()) * (d.x() - a.x())) / area;
                    const double v =
                        ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (xs[c] - a.x())) / area;
                    if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9) continue;
                    z = std::max(z, (1 - u - v) * a.z() + u * b.z() + v * d.z());
                }
            if (z < -1e8) {
                ++missed;
                continue;
            }
            square += std::pow(z - std::stod(cell), 2);
            ++rays;
        }
    }
    EXPECT_LE(std::sqrt(square / rays), 1.2);
    EXPECT_LE(missed, 8) << "rays that graze the measured outline may pass beside this one";
}

TEST(AdultHead, LipsMeetWithoutOverlap) {
    // The margin of the upper lip over its whole length stands above that of the lower lip by no more than 0.3 mm.
    const Vec3 upper = head().points[static_cast<std::size_t>(head().landmarks.at("stos"))];
    const Vec3 lower = head().points[static_cast<std::size_t>(head().landmarks.at("stoi"))];
    EXPECT_NE(head().landmarks.at("stos"), head().landmarks.at("stoi"));
    EXPECT_GT(upper.y(), lower.y());
    EXPECT_LE((upper - lower).norm(), 0.3);
    // Along the line of contact every vertex has a partner of the other lip straight below or above it.
    std::set<int> skin;
    for (const auto& f : head().faces.at("skin")) skin.insert(f.begin(), f.end());
    int pairs = 0;
    for (const int a : skin)
        for (const int b : skin) {
            if (a >= b) continue;
            const Vec3 pa = head().points[static_cast<std::size_t>(a)],
                       pb = head().points[static_cast<std::size_t>(b)];
            if (std::abs(pa.x()) > 24 || pa.z() < 78 || std::abs(pa.y() + 52.5) > 1.5) continue;
            if (std::abs(pa.x() - pb.x()) < 1e-6 && std::abs(pa.z() - pb.z()) < 1e-6 &&
                std::abs(pa.y() - pb.y()) <= 0.3)
                ++pairs;
        }
    EXPECT_GE(pairs, 29 * 3);  // 29 free vertices along each of three rows
}

TEST(AdultHead, EyeballsStayBehindTheLids) {
    for (const double side : {1.0, -1.0}) {
        const Vec3 centre(side * 31.5, 18.2, 73.2);
        double nearest = 1e9;
        for (const auto& f : head().faces.at("skin")) {
            // Corners, edge middles and face middles.
            std::vector<Vec3> samples;
            Vec3 middle = Vec3::Zero();
            for (std::size_t k = 0; k < f.size(); ++k) {
                const Vec3 p = head().points[static_cast<std::size_t>(f[k])];
                samples.push_back(p);
                samples.push_back(
                    0.5 * (p + head().points[static_cast<std::size_t>(f[(k + 1) % f.size()])]));
                middle += p / static_cast<double>(f.size());
            }
            samples.push_back(middle);
            for (const Vec3& p : samples) {
                const Vec3 d = p - centre;
                if (d.norm() > 20 || d.z() < 0) continue;
                nearest = std::min(nearest, d.norm() - globe_radius(d.z() / d.norm()));
            }
        }
        EXPECT_GT(nearest, 0.05);
        EXPECT_LT(nearest, 0.45);
    }
}

TEST(AdultHead, TeethAndTongueStayInsideTheMouth) {
    // Horizontal rays towards the front from a point inside cross the surface of skin and mouth an odd number of times
    // only for points in the flesh; a point in the cavity, which is outside of the closed skin, crosses it evenly.
    std::vector<std::array<Vec3, 3>> triangles;
    for (const auto& f : skin_and_mouth())
        for (std::size_t k = 1; k + 1 < f.size(); ++k)
            triangles.push_back({head().points[static_cast<std::size_t>(f[0])],
                                 head().points[static_cast<std::size_t>(f[k])],
                                 head().points[static_cast<std::size_t>(f[k + 1])]});
    for (const char* part : {"teeth_upper", "teeth_lower", "gums_upper", "gums_lower", "tongue"}) {
        std::set<int> used;
        for (const auto& f : head().faces.at(part)) used.insert(f.begin(), f.end());
        int outside = 0;
        for (const int v : used) {
            if (v % 5 != 0)
                continue;  // a fifth of the vertices is enough to find a part that sticks out
            const Vec3 p = head().points[static_cast<std::size_t>(v)] + Vec3(1e-4, 1.3e-4, 0);
            int crossings = 0;
            for (const auto& t : triangles) {
                const double area = (t[1].x() - t[0].x()) * (t[2].y() - t[0].y()) -
                                    (t[1].y() - t[0].y()) * (t[2].x() - t[0].x());
                if (area == 0) continue;
                const double u = ((p.x() - t[0].x()) * (t[2].y() - t[0].y()) -
                                  (p.y() - t[0].y()) * (t[2].x() - t[0].x())) /
                                 area;
                const double w = ((t[1].x() - t[0].x()) * (p.y() - t[0].y()) -
                                  (t[1].y() - t[0].y()) * (p.x() - t[0].x())) /
                                 area;
                if (u < 0 || w < 0 || u + w > 1) continue;
                if ((1 - u - w) * t[0].z() + u * t[1].z() + w * t[2].z() > p.z()) ++crossings;
            }
            if (crossings % 2 != 0) ++outside;
        }
        EXPECT_EQ(outside, 0) << part << " reaches into the flesh";
    }
}

TEST(AdultHead, IsMadeAgainToTheByte) {
    const std::string sculpt = std::string(RISORIUS_BINARY_DIR) + "/sculpt";
    if (!std::ifstream(sculpt)) GTEST_SKIP() << "the program sculpt is not built";
    const std::string folder = std::string(RISORIUS_BINARY_DIR) + "/adult_head_again";
    ASSERT_EQ(std::system((sculpt + " --output " + folder + " > /dev/null").c_str()), 0);
    for (const char* name : {"head.obj", "landmarks.json"}) {
        std::ifstream made(folder + "/" + name, std::ios::binary),
            kept(kFolder + name, std::ios::binary);
        const std::string a{std::istreambuf_iterator<char>(made), {}},
            b{std::istreambuf_iterator<char>(kept), {}};
        EXPECT_FALSE(a.empty());
        EXPECT_TRUE(a == b) << name << " differs from the committed file";
    }
}

}  // namespace
