// SPDX-License-Identifier: MIT
// The simulated tissue is a sound mesh under the face, at the size asked for, and its motion reaches every vertex.
#include "risorius/face/anatomy/shell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "cache_setting.h"
#include "face/adult_face.h"
#include "risorius/face/anatomy/detail/attachments.h"
#include "risorius/face/anatomy/detail/jaw.h"
#include "risorius/face/anatomy/lids.h"
#include "risorius/face/anatomy/tissue_mesh.h"
#include "risorius/face/muscle/detail/muscle_placement.h"
#include "risorius/face/skin/detail/skin_binding.h"
#include "risorius/face/solver/detail/contact_search.h"
#include "risorius/geom/surface_topology.h"
#include "temporary_folder.h"

namespace risorius::face {
namespace {

struct Tissue {
    rig::RigDescription rig;
    rig::Head head;
    std::array<EyeLids, 2> lids;
    Jaw jaw;
    Shell shell;
    TissueMesh mesh;
    Tissue(const rig::TestHead& test, int vertices)
        : rig(test.rig),
          head(rig::place_head(rig, test.mesh, "test")),
          lids{EyeLids(head, 0, 0.96), EyeLids(head, 1, 0.96)},
          jaw(head, rig.jaw),
          shell(
              drop_unsupported_vertices(build_shell(head, jaw, lids, {vertices}), head, rig, lids)),
          mesh(build_tissue_mesh(head, rig, shell, lids)) {}
};
const Tissue& adult_tissue() {
    static const Tissue one(rig::adult(), 800);
    return one;
}

double smallest_volume(const TissueMesh& mesh) {
    double min = 1;
    for (long t = 0; t < mesh.tets.rows(); ++t) {
        const auto edge = [&](int k) -> Vec3 {
            return (mesh.nodes.row(mesh.tets(t, k)) - mesh.nodes.row(mesh.tets(t, 0))).transpose();
        };
        min = std::min(min, edge(1).dot(edge(2).cross(edge(3))) / 6);
    }
    return min;
}

TEST(Shell, HasAboutAsManyVerticesAsAskedFor) {
    EXPECT_NEAR(static_cast<double>(adult_tissue().shell.vertex.size()), 800, 40);
    const Shell fine =
        build_shell(adult_tissue().head, adult_tissue().jaw, adult_tissue().lids, {1700});
    EXPECT_NEAR(static_cast<double>(fine.vertex.size()), 1700, 85);
}

TEST(Shell, IsTheSameFromTheCache) {
    const Tissue& adult = adult_tissue();
    TemporaryFolder folder;
    const auto shell_in = [&](const std::string& cache) {
        const CacheSetting place(cache);
        return build_shell(adult.head, adult.jaw, adult.lids, {300});
    };
    const Shell computed = shell_in("off"), kept = shell_in(folder.path().string()),
                found = shell_in(folder.path().string());
    EXPECT_EQ(folder.listing().size(), 2u);  // the folder and one result
    for (const Shell* shell : {&kept, &found}) {
        EXPECT_EQ(shell->fine, computed.fine);
        EXPECT_EQ(shell->direction, computed.direction);
        EXPECT_EQ(shell->vertex, computed.vertex);
        EXPECT_EQ(shell->triangles, computed.triangles);
        EXPECT_EQ(shell->collapsed_to, computed.collapsed_to);
        EXPECT_EQ(shell->fixed, computed.fixed);
        EXPECT_EQ(shell->spacing_m, computed.spacing_m);
        EXPECT_EQ(shell->over_bite_m, computed.over_bite_m);
        EXPECT_EQ(shell->mirrored, computed.mirrored);
    }
}

TEST(Shell, IsOneManifoldSheetWithHolesForMouthAndEyes) {
    const Shell& shell = adult_tissue().shell;
    const geom::SurfaceEdges edges = geom::surface_edges(shell.triangles);
    for (int e = 0; e < edges.count(); ++e) ASSERT_LE(edges.triangle_count(e), 2);
    EXPECT_EQ(geom::surface_pieces(shell.triangles, static_cast<int>(shell.vertex.size())).count(),
              1);
    // Outline, two eyes, mouth; nostrils may open too.
    EXPECT_GE(geom::boundary_loops(shell.triangles, edges).size(), 4u);
}

TEST(Shell, FacesOutwards) {
    // A coarse triangle at a fold may lean over, but no more than a few do.
    const Shell& shell = adult_tissue().shell;
    int leaning = 0;
    for (long f = 0; f < shell.triangles.rows(); ++f) {
        const auto p = [&](int k) -> Vec3 {
            return adult_tissue()
                .head.vertices.row(shell.vertex[shell.triangles(f, k)])
                .transpose();
        };
        const Vec3 n = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
        Vec3 d = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            d += shell.direction.row(shell.vertex[shell.triangles(f, k)]).transpose();
        leaning += n.dot(d.normalized()) < 0;
        ASSERT_GT(n.dot(d.normalized()), -0.5) << f;
    }
    EXPECT_LE(leaning, shell.triangles.rows() / 200);
    RecordProperty("leaning", leaning);
}

TEST(Shell, CoversTheMovingFaceAndHoldsOnlyItsOutline) {
    const Shell& shell = adult_tissue().shell;
    for (const char* id : {"ch_l", "bp_r", "mc_l", "pg", "prn", "g", "ls", "li"}) {
        const int v = adult_tissue().head.welded[rig::adult().vertex(id)];
        ASSERT_GE(shell.collapsed_to[v], 0) << id;
        EXPECT_FALSE(shell.fixed[shell.collapsed_to[v]]) << id;
    }
    const int held = static_cast<int>(std::count(shell.fixed.begin(), shell.fixed.end(), 1));
    EXPECT_GT(held, 20);
    EXPECT_LT(held, 200);
}

/// What stays of `all` is what it was, and what went belongs to a neighbour.
void expect_the_rest(const Shell& shell, const Shell& all, const rig::Head& head,
                     double spacing_mm) {
    std::vector<char> held(shell.vertex.size(), 0);
    for (int v : shell.triangles.reshaped()) held[static_cast<std::size_t>(v)] = 1;
    EXPECT_EQ(std::count(held.begin(), held.end(), 0), 0);
    for (std::size_t v = 0; v < shell.vertex.size(); ++v) {
        const int before = all.collapsed_to[shell.vertex[v]];
        EXPECT_EQ(all.vertex[before], shell.vertex[v]);
        EXPECT_EQ(shell.collapsed_to[shell.vertex[v]], static_cast<int>(v));
        EXPECT_EQ(all.fixed[before], shell.fixed[v]);
        EXPECT_EQ(all.over_bite_m[before], shell.over_bite_m[v]);
        EXPECT_EQ(shell.mirrored[shell.mirrored[v]], static_cast<int>(v));
        EXPECT_EQ(all.vertex[all.mirrored[before]], shell.vertex[shell.mirrored[v]]);
    }
    for (std::size_t v = 0; v < all.collapsed_to.size(); ++v) {
        ASSERT_EQ(all.collapsed_to[v] < 0, shell.collapsed_to[v] < 0) << v;
        if (shell.collapsed_to[v] < 0) continue;
        const int before = all.vertex[all.collapsed_to[v]],
                  now = shell.vertex[shell.collapsed_to[v]];
        EXPECT_LT((head.vertices.row(now) - head.vertices.row(before)).norm(), head.mm(spacing_mm))
            << v;
    }
}

TEST(Shell, TissueBearsAllOfIt) {
    for (const int vertices : {300, 350, 450, 500, 600, 800, 1000}) {
        const Tissue tissue(rig::adult(), vertices);
        const Shell all = build_shell(tissue.head, tissue.jaw, tissue.lids, {vertices});
        const Shell& shell = tissue.shell;
        ASSERT_LE(shell.vertex.size(), all.vertex.size());
        EXPECT_GT(shell.vertex.size(), all.vertex.size() - 10);
        std::vector<char> borne(shell.vertex.size(), 0);
        for (int node : tissue.mesh.tets.reshaped())
            if (node % kLayers == kSkin) borne[static_cast<std::size_t>(node / kLayers)] = 1;
        EXPECT_EQ(std::count(borne.begin(), borne.end(), 0), 0);
        expect_the_rest(shell, all, tissue.head, 6);
    }
}

// As when a corner of a nostril has none but tetrahedra that are too thin
TEST(Shell, WithoutSomeVerticesIsTheRest) {
    const Tissue& tissue = adult_tissue();
    const Shell& all = tissue.shell;
    std::vector<char> gone(all.vertex.size(), 0);
    for (const char* id : {"sbal_l", "al_l"}) {
        const int v = all.collapsed_to[tissue.head.welded[rig::adult().vertex(id)]];
        ASSERT_GE(v, 0) << id;
        gone[static_cast<std::size_t>(v)] = gone[static_cast<std::size_t>(all.mirrored[v])] = 1;
    }
    const Shell shell = without_vertices(all, tissue.head, gone);
    EXPECT_EQ(shell.vertex.size(), all.vertex.size() - 4);
    expect_the_rest(shell, all, tissue.head, 8);
}

TEST(Shell, IsFinestAtLipsAndLids) {
    const Shell& shell = adult_tissue().shell;
    const auto spacing = [&](const char* id) {
        return shell.spacing_m[adult_tissue().head.welded[rig::adult().vertex(id)]];
    };
    EXPECT_LT(spacing("ls"), 0.7 * spacing("mc_l"));
    EXPECT_LT(spacing("ps_l"), 0.7 * spacing("mef"));
}

// Which vertices the lips keep decides how they roll, and a nose that stood out another half millimetre changed it.
TEST(Shell, LipsKeepTheirVerticesWhateverTheRestNeeds) {
    const rig::Head& head = adult_tissue().head;
    const auto at_lips = [&](int vertices) {
        const Shell shell = build_shell(head, adult_tissue().jaw, adult_tissue().lids, {vertices});
        std::set<int> out;
        for (const int v : shell.vertex)
            if ((head.vertices.row(v).transpose() - head.landmark("sto")).norm() < head.mm(9))
                out.insert(v);
        return out;
    };
    const std::set<int> usual = at_lips(800);
    EXPECT_GT(usual.size(), 8U);
    for (const int vertices : {780, 790, 810, 820}) EXPECT_EQ(at_lips(vertices), usual) << vertices;
    EXPECT_GT(at_lips(1200).size(), usual.size());
}

TEST(Shell, IsItsOwnMirrorImageOnASymmetricHead) {
    const Shell& shell = adult_tissue().shell;
    const int count = static_cast<int>(shell.vertex.size());
    ASSERT_EQ(shell.mirrored.size(), shell.vertex.size());
    const auto reflected = [](Vec3 p) { return Vec3(-p.x(), p.y(), p.z()); };
    for (int v = 0; v < count; ++v) {
        const int w = shell.mirrored[v];
        EXPECT_EQ(shell.mirrored[w], v);
        EXPECT_EQ(shell.fixed[v], shell.fixed[w]);
        for (const Layer layer : {kDeep, kMiddle, kSkin})
            EXPECT_LT((adult_tissue().mesh.nodes.row(node_of(v, layer)).transpose() -
                       reflected(adult_tissue().mesh.nodes.row(node_of(w, layer)).transpose()))
                          .norm(),
                      2e-5)
                << v;
    }
    std::set<std::array<int, 4>> tets, images;
    for (long t = 0; t < adult_tissue().mesh.tets.rows(); ++t) {
        std::array<int, 4> here, there;
        for (int k = 0; k < 4; ++k) {
            here[k] = adult_tissue().mesh.tets(t, k);
            there[k] = kLayers * shell.mirrored[here[k] / kLayers] + here[k] % kLayers;
        }
        std::sort(here.begin(), here.end());
        std::sort(there.begin(), there.end());
        tets.insert(here);
        images.insert(there);
    }
    EXPECT_EQ(tets, images);
}

TEST(Shell, AHeadThatIsNotSymmetricHasOneAllTheSame) {
    rig::Head head = adult_tissue().head;
    for (long v = 0; v < head.vertices.rows(); ++v)
        head.vertices(v, 1) += 1.5e-3 * std::sin(0.1e3 * head.vertices(v, 0));
    const Shell shell = build_shell(head, adult_tissue().jaw, adult_tissue().lids, {300});
    EXPECT_TRUE(shell.mirrored.empty());
    EXPECT_NEAR(static_cast<double>(shell.vertex.size()), 300, 15);
}

TEST(Tissue, EveryTetStandsUpright) {
    EXPECT_GT(smallest_volume(adult_tissue().mesh), 0);
    EXPECT_EQ(adult_tissue().mesh.nodes.rows(),
              3 * static_cast<long>(adult_tissue().shell.vertex.size()));
    EXPECT_LT(adult_tissue().mesh.dropped_tets, adult_tissue().mesh.tets.rows() / 50);
}

TEST(Tissue, IsAsThickAsTheTablesSay) {
    const auto thickness = [&](const char* id) {
        const int v = adult_tissue().head.welded[rig::adult().vertex(id)];
        return 1e3 * adult_tissue().mesh.thickness_m[adult_tissue().shell.collapsed_to[v]];
    };
    double sum = 0;
    for (double t : adult_tissue().mesh.thickness_m) {
        EXPECT_GT(t, 0.3e-3);
        EXPECT_LT(t, 30e-3);
        sum += t;
    }
    EXPECT_NEAR(1e3 * sum / static_cast<double>(adult_tissue().mesh.thickness_m.size()), 8.9, 2.5);
    EXPECT_NEAR(thickness("g"), 5.5, 2);
    EXPECT_NEAR(thickness("mc_l"), 22, 5) << "18 at the mark, 26 three millimetres behind it";
    EXPECT_LT(thickness("ps_l"), 5) << "lids are thin";
}

TEST(Tissue, LayersLieAboveEachOther) {
    const TissueMesh& mesh = adult_tissue().mesh;
    for (std::size_t v = 0; v < mesh.thickness_m.size(); ++v) {
        const auto height = [&](Layer layer) {
            return mesh.nodes.row(node_of(static_cast<int>(v), layer)).dot(mesh.direction[v]);
        };
        ASSERT_GT(height(kSkin), height(kMiddle)) << v;
        ASSERT_GT(height(kMiddle), height(kDeep)) << v;
        EXPECT_GE(mesh.area_m2[v], 0);
    }
}

TEST(Tissue, IsHeldMostFirmlyWhereItIsBoundToBone) {
    const std::vector<Attachment> held =
        place_attachments(adult_tissue().head, adult_tissue().rig, adult_tissue().jaw,
                          adult_tissue().shell, adult_tissue().mesh);
    int free = 0;
    for (char fixed : adult_tissue().shell.fixed) free += !fixed;
    EXPECT_EQ(static_cast<int>(held.size()), free);
    const auto sliding = [&](const char* id) {
        const int v =
            adult_tissue().shell.collapsed_to[adult_tissue().head.welded[rig::adult().vertex(id)]];
        for (const Attachment& a : held)
            if (a.shell_vertex == v) return a.tangential_n_per_m / adult_tissue().mesh.area_m2[v];
        return -1.0;
    };
    EXPECT_GT(sliding("n"), 10 * sliding("ls"));
    EXPECT_GT(sliding("rhi"), 60 * sliding("mc_l"));
    for (const Attachment& a : held) {
        EXPECT_GE(a.normal_n_per_m, 0);
        EXPECT_GE(a.jaw_weight, 0);
        EXPECT_LE(a.jaw_weight, 1 + 1e-12);
    }
}

TEST(Tissue, RestIsFreeOfContactForces) {
    const ContactSearch search(adult_tissue().head, adult_tissue().jaw, adult_tissue().shell,
                               adult_tissue().mesh, adult_tissue().lids, 5e6);
    const auto pairs = search.find(adult_tissue().mesh.nodes, Rigid::Identity(),
                                   {Mat3::Identity(), Mat3::Identity()});
    EXPECT_LT(ContactSearch::deepest(pairs, adult_tissue().mesh.nodes), 1e-9);
    tissue::Contacts contacts;
    contacts.set(pairs);
    Points gradient = Points::Zero(adult_tissue().mesh.nodes.rows(), 3);
    contacts.add_energy(adult_tissue().mesh.nodes, gradient);
    EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-9);
}

// A plane that leaps while lips slide keeps a held face from resting.
TEST(Tissue, APlaneOfALipTurnsAsSlowlyAsTheLipsSlide) {
    const Tissue& tissue = adult_tissue();
    const ContactSearch search(tissue.head, tissue.jaw, tissue.shell, tissue.mesh, tissue.lids,
                               5e6);
    constexpr double kStep_m = 0.05e-3;
    const auto slid = [&](int steps) {
        Points x = tissue.mesh.nodes;
        for (std::size_t v = 0; v < tissue.shell.vertex.size(); ++v)
            if (tissue.shell.over_bite_m[v] < 0)
                for (Layer layer : {kDeep, kMiddle, kSkin})
                    x.row(node_of(static_cast<int>(v), layer)) +=
                        steps * kStep_m * Vec3(0.6, 0.5, -0.62).transpose();
        return x;
    };
    const auto past_rest_m = [&](int steps) {
        const Points x = slid(steps);
        std::map<int, double> gaps;
        for (const auto& pair :
             search.find(x, Rigid::Identity(), {Mat3::Identity(), Mat3::Identity()}))
            if (pair.body == kLipBody && pair.fraction > 0.5)
                gaps[pair.slot] = tissue::Contacts::gap(pair, x) - pair.rest_gap_m;
        return gaps;
    };
    std::map<int, double> before = past_rest_m(0);
    EXPECT_GT(before.size(), 40u);
    for (int step = 1; step <= 80; ++step) {
        std::map<int, double> now = past_rest_m(step);
        for (const auto& [slot, gap] : now) {
            const auto known = before.find(slot);
            if (known == before.end()) continue;
            EXPECT_LT(std::abs(gap - known->second), 4 * kStep_m) << slot << " at " << step;
        }
        before = std::move(now);
    }
}

// Of the adult with bundles alone
rig::RigDescription all_bundles() {
    rig::RigDescription rig = adult_tissue().rig;
    rig.solids.clear();
    return rig;
}

TEST(MusclePlacement, EveryMuscleHasFibresOnBothSides) {
    const MusclePlacement placed = place_muscles(adult_tissue().head, all_bundles(),
                                                 adult_tissue().shell, adult_tissue().mesh);
    ASSERT_EQ(placed.fibres.size(), placed.paths.size());
    const track::ChannelTable channels = adult_tissue().rig.channels();
    std::map<int, int> fibres;
    std::map<int, double> force;
    for (const muscle::Fibre& fibre : placed.fibres) {
        ++fibres[fibre.column];
        force[fibre.column] += fibre.f0_n;
    }
    for (const rig::Muscle& muscle : adult_tissue().rig.muscles.muscles) {
        if (muscle.group != "mimetic") continue;
        const int left = channels.column(muscle.id, Side::kLeft),
                  right = channels.column(muscle.id, Side::kRight);
        EXPECT_GT(fibres[left], 0) << muscle.id;
        EXPECT_EQ(fibres[left], fibres[right]) << muscle.id;
        EXPECT_NEAR(force[left], force[right], 1e-9) << muscle.id;
    }
}

TEST(MusclePlacement, ForceIsThatOfTheBandsTimesTheirStrength) {
    const MusclePlacement placed = place_muscles(adult_tissue().head, all_bundles(),
                                                 adult_tissue().shell, adult_tissue().mesh);
    const track::ChannelTable channels = adult_tissue().rig.channels();
    for (const char* id : {"zygomaticus_major", "risorius", "mentalis", "frontalis_medial"}) {
        double placed_n = 0, wanted_n = 0;
        int bands = 0;
        for (const muscle::Fibre& fibre : placed.fibres)
            if (fibre.column == channels.column(id, Side::kLeft)) placed_n += fibre.f0_n;
        for (const rig::MuscleBand& band : adult_tissue().rig.atlas.bands)
            if (band.muscle == id) wanted_n += band.force_n * band.strength, ++bands;
        wanted_n *= adult_tissue().rig.tissue.force_scale / bands;
        EXPECT_NEAR(placed_n / wanted_n, 1.0, 0.02) << id;
    }
}

TEST(SkinBinding, CarriesAMovedShellToItsVertices) {
    const SkinBinding binding(adult_tissue().head, adult_tissue().jaw, adult_tissue().shell);
    const Vec3 shift(1e-3, -2e-3, 3e-3);
    Points displacement(static_cast<long>(adult_tissue().shell.vertex.size()), 3);
    displacement.rowwise() = shift.transpose();
    Points moved = adult_tissue().head.vertices;
    binding.apply(displacement, Rigid::Identity(), moved);
    const Points u = moved - adult_tissue().head.vertices;
    for (long v = 0; v < u.rows(); ++v) {
        // No vertex moves further than the shell, none against it.
        const double fraction = u.row(v).dot(shift) / shift.squaredNorm();
        ASSERT_LE(fraction, 1 + 1e-9) << v;
        ASSERT_GE(fraction, -1e-9) << v;
        ASSERT_LT((u.row(v).transpose() - fraction * shift).norm(), 1e-12) << v;
    }
    for (const char* id : {"ch_l", "mc_l", "pg", "bp_l", "prn"})
        EXPECT_LT((at(u, id) - shift).norm(), 1e-9) << id;
    EXPECT_EQ(at(u, "op").norm(), 0.0) << "the back of the head moves";
    EXPECT_EQ(at(u, "t_l").norm(), 0.0) << "the ear moves";
}

TEST(SkinBinding, CarriesTheLiningOfTheMouthBetweenSkullAndJaw) {
    const SkinBinding binding(adult_tissue().head, adult_tissue().jaw, adult_tissue().shell);
    const Rigid mandible = adult_tissue().jaw.motion(0.5, 0, 0);
    Points moved = adult_tissue().head.vertices;
    binding.apply(Points::Zero(static_cast<long>(adult_tissue().shell.vertex.size()), 3), mandible,
                  moved);
    double furthest = 0;
    for (long v = 0; v < moved.rows(); ++v) {
        const Vec3 rest = adult_tissue().head.vertices.row(v).transpose();
        const double way = (mandible * rest - rest).norm();
        const double went = (moved.row(v).transpose() - rest).norm();
        furthest = std::max(furthest, went);
        ASSERT_LE(went, way + 3e-3) << v;
    }
    EXPECT_GT(furthest, 3e-3);
}

TEST(MeasuredHeads, MakeSoundTissueToo) {
    const auto ict = rig::ict_head(), makehuman = rig::makehuman_head();
    if (!ict && !makehuman) GTEST_SKIP() << "the measured heads are not in RISORIUS_SHARED_DIR";
    for (const auto& test : {ict, makehuman}) {
        if (!test) continue;
        const Tissue tissue(*test, 800);
        EXPECT_NEAR(static_cast<double>(tissue.shell.vertex.size()), 800, 40)
            << test->rig.mesh_file.filename();
        EXPECT_GT(smallest_volume(tissue.mesh), 0);
        EXPECT_LT(tissue.mesh.dropped_tets, tissue.mesh.tets.rows() / 50);
    }
}

}  // namespace
}  // namespace risorius::face
