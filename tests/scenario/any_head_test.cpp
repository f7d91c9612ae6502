// SPDX-License-Identifier: MIT
// Heads as people bring them: scans with grown lips, soups of triangles, other people, other units.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "rig/head_variants.h"
#include "risorius/fitting/fit_rig.h"
#include "risorius/headmodel/sculpt_head.h"
#include "risorius/io/read_mesh.h"
#include "risorius/media/image_file.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"
#include "scenario/run_program.h"

namespace risorius::scenario {
namespace {

namespace fs = std::filesystem;

/// Mesh and landmarks as files, and what `fit` makes of them.
struct Brought {
    Folder folder;
    fitting::FitOptions options;

    Brought(geom::PolygonMesh mesh, const std::map<std::string, Vec3>& landmarks, double unit) {
        mesh.positions /= unit;
        io::write_obj(mesh, folder / "head.obj");
        Json file = {{"format", "risorius-landmarks"}, {"version", 1}};
        for (const auto& [id, p] : landmarks)
            file["landmarks"][id]["xyz"] = {p.x() / unit, p.y() / unit, p.z() / unit};
        std::ofstream(folder / "landmarks.json") << file;
        options = {.mesh = folder / "head.obj",
                   .landmarks = folder / "landmarks.json",
                   .out = folder / "rig.json",
                   .calibrate = false};
    }
};

std::map<std::string, Vec3> twenty_of(const rig::Head& head) {
    std::map<std::string, Vec3> out;
    for (const std::string& id : rig::required_landmarks()) out[id] = head.landmark(id);
    return out;
}

/// How far the lips part and the corners rise, mm.
struct Moves {
    double jaw_mm, smile_mm;
    bool finite;
    explicit Moves(const fs::path& rig) {
        const scene::RigFiles files = scene::read_rig_files(rig);
        face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
        const scene::LandmarkPoints points(face.head(), files.rig);
        const Points rest = face.pose().vertices;
        track::Drive none;
        none.excitation = Eigen::VectorXd::Zero(files.rig.channels().column_count());
        none.kinematic.fill(0);
        track::Drive open = none;
        open.kinematic[static_cast<std::size_t>(track::Kinematic::kJawOpen)] = 1;
        face.start([&](double) { return none; });
        face.solve_equilibrium(open.excitation, open, {.iterations = 120});
        const Points opened = face.pose().vertices;
        jaw_mm = 1e3 * points.distance("stos", "stoi", opened);
        face.start([&](double) { return none; });
        Eigen::VectorXd smile = none.excitation;
        for (const Side side : {Side::kLeft, Side::kRight})
            smile[files.rig.channels().column("zygomaticus_major", side)] = 1;
        face.solve_equilibrium(smile, none, {.iterations = 120});
        const Points smiling = face.pose().vertices;
        smile_mm = 1e3 * (points.at("ch_l", smiling) - points.at("ch_l", rest)).y();
        finite = opened.allFinite() && smiling.allFinite();
    }
};

/// Lays a picture on the mesh in a file: "skin.png" beside it.
void paint(const fs::path& file) {
    geom::PolygonMesh mesh = io::read_mesh(file);
    mesh.corner_texcoord = TexCoords::Zero(static_cast<long>(mesh.corner_vertex.size()), 2);
    mesh.textures = {{file.parent_path() / "skin.png", "here", {}}};
    mesh.face_texture.assign(static_cast<std::size_t>(mesh.face_count()), 0);
    media::write_png(Image(2, 2), mesh.textures[0].file);
    io::write_obj_with_pictures(mesh, file, io::obj_files(mesh, file));
}

TEST(AnyHead, ScanWithGrownLipsIsRefusedOrCutAndThenOpensItsMouth) {
    const rig::Head& adult = rig::adult_placed();
    Brought scan(rig::scan_of(adult, rig::adult().mesh, 56, 76), twenty_of(adult), 1.0);
    paint(scan.options.mesh);
    scan.options.report = scan.folder / "report";
    try {
        fitting::fit_rig(scan.options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.what(),
                  scan.options.mesh.string() +
                      ": expected lips that can part (cut_lips cuts them), found skin that runs on "
                      "from the upper lip to the lower");
    }
    EXPECT_EQ(scan.folder.listing(),
              (std::set<std::string>{"head.mtl", "head.obj", "landmarks.json", "skin.png"}));

    scan.options.cut_lips = true;
    const fitting::FitReport report = fitting::fit_rig(scan.options);
    EXPECT_TRUE(report.lips_cut);
    EXPECT_EQ(report.bone.through_skin, 0);
    EXPECT_GT(report.bone.thinnest_mm, 0.3);
    const geom::PolygonMesh cut = scene::read_rig_files(scan.options.out).mesh;
    ASSERT_EQ(cut.textures.size(), 1U);
    EXPECT_TRUE(fs::equivalent(cut.textures[0].file, scan.folder / "skin.png"));
    EXPECT_EQ(
        std::count(cut.face_texture.begin(), cut.face_texture.end(), -1),
        std::count(cut.face_group.begin(), cut.face_group.end(), cut.group_index("mouth_lining")));
    const Moves moves(scan.options.out);
    EXPECT_TRUE(moves.finite);
    EXPECT_GT(moves.jaw_mm, 15);
    EXPECT_GT(moves.smile_mm, 2);
    for (const char* file : {"index.html", "fit.png", "results.json"})
        EXPECT_TRUE(fs::exists(scan.options.report / file)) << file;
    const Json results = JsonCursor::read_file(scan.options.report / "results.json").json();
    EXPECT_EQ(results["worth_giving"], Json(report.worth_giving));
}

TEST(AnyHead, SoupOfTrianglesInInchesIsWeldedAndMeasured) {
    const rig::Head& adult = rig::adult_placed();
    geom::PolygonMesh skin = rig::adult().mesh;
    skin.positions = adult.vertices;
    const Triangles triangles = adult.skin;
    geom::PolygonMesh plain;
    plain.positions = adult.vertices;
    plain.group_names = {"skin"};
    for (long f = 0; f < triangles.rows(); ++f) {
        for (int k = 0; k < 3; ++k) plain.corner_vertex.push_back(triangles(f, k));
        plain.face_begin.push_back(static_cast<int>(plain.corner_vertex.size()));
        plain.face_group.push_back(0);
    }
    Brought soup(rig::soup_of(plain), twenty_of(adult), 0.0254);
    const fitting::FitReport report = fitting::fit_rig(soup.options);
    EXPECT_EQ(report.metres_per_unit, 0.0254);
    EXPECT_NEAR(report.size, 1.0, 0.02);
    EXPECT_EQ(report.inverted_tets, 0);
    EXPECT_FALSE(report.eyes);
}

TEST(AnyHead, AnotherPersonIsFittedFromTwentyLandmarks) {
    const auto ict = rig::ict_head();
    if (!ict) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    // Drawn once from N(0, 1), clamped to 2
    const std::vector<double> sigmas{1.2, -0.9, 2,    -1.7, 0.4, -0.3, 1.1, -2,  0.8, 0.2,
                                     -1,  1.5,  -0.6, 0.7,  -2,  1.3,  0.1, -.4, 1.9, -1.2};
    rig::TestHead person = *ict;
    person.mesh = rig::with_identity(ict->mesh, sigmas);
    const rig::Head whole = rig::place_head(person.rig, person.mesh, "person");
    std::map<std::string, Vec3> given;
    for (const std::string& id : rig::required_landmarks())
        given[id] = 0.01 * Vec3(person.mesh.positions.row(person.vertex(id)).transpose());
    geom::PolygonMesh metres = person.mesh;
    metres.positions *= 0.01;
    Brought brought(metres, given, 0.01);
    const fitting::FitReport report = fitting::fit_rig(brought.options);
    EXPECT_EQ(report.metres_per_unit, 0.01);
    EXPECT_TRUE(report.eyes && report.teeth);
    EXPECT_EQ(report.inverted_tets, 0);
    EXPECT_LT(report.dropped_tets, report.tets / 50);
    // What was not given lies where it was marked on this person, in front
    const scene::RigFiles files = scene::read_rig_files(brought.options.out);
    const rig::Head head = rig::place_head(files.rig, files.mesh, files.place());
    double squared = 0;
    int count = 0;
    for (const std::string& id : head.warped_landmarks) {
        if (person.rig.atlas.landmark(id)->position.z() < 8e-3) continue;
        const Vec3 marked =
            head.frame.to_head(Vec3(person.mesh.positions.row(person.vertex(id)).transpose()));
        squared += (head.landmark(id) - marked).squaredNorm();
        ++count;
    }
    EXPECT_LT(1e3 * std::sqrt(squared / count), 5);
}

TEST(AnyHead, LongUpperLipOverAThinLowerOneKeepsNoFibreOfTheOther) {
    const Folder folder;
    headmodel::sculpt_head(
        {.out = folder / "head",
         .identity = headmodel::chosen_identity(
             {.identity = (kRoot / "tests/data/heads/long_upper_lip.json").string()})});
    const Moves moves(folder / "head/rig.json");
    EXPECT_TRUE(moves.finite);
    EXPECT_GT(moves.jaw_mm, 20);  // 8.7 with fibres of the lower lip in the upper one
}

}  // namespace
}  // namespace risorius::scenario
