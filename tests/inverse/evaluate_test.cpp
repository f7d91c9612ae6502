// SPDX-License-Identifier: MIT
// What a rig did itself, written down as if it had been measured, is found again; and a report is there as a whole or not at all.
#include "risorius/inverse/evaluate.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "paths.h"
#include "risorius/core/error.h"
#include "risorius/face/face.h"
#include "risorius/headmodel/sculpt_head.h"
#include "risorius/inverse/read_units.h"
#include "risorius/media/image_file.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/scene/rig_files.h"
#include "temporary_folder.h"

namespace risorius::inverse {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = RISORIUS_SOURCE_DIR;

using Excitations = std::map<std::string, double>;

/// A rig and a file of "measured" shapes that were brought about by known activations.
struct SelfMade {
    fs::path rig, shapes;

    /// The file says `said` of shapes that `done` brought about.
    SelfMade(const fs::path& rig_file, const fs::path& folder,
             const std::map<std::string, Excitations>& done,
             const std::map<std::string, Excitations>& said)
        : rig(rig_file), shapes(folder / "shapes.json") {
        const scene::RigFiles files = scene::read_rig_files(rig);
        face::Face face(files.rig, files.mesh, face::quality_named("preview"), files.place());
        const track::ChannelTable channels = files.rig.channels();
        const Points rest = face.head().frame.to_mesh(face.head().vertices);
        std::ofstream numbers(folder / "shapes.f32", std::ios::binary);
        Json json{{"shape", {done.size(), rest.rows(), 3}},
                  {"dtype", "<f4"},
                  {"layout", "[shape][vertex][xyz]"},
                  {"names", Json::array()},
                  {"excitations", Json::object()}};
        for (const auto& [name, excitations] : done) {
            track::Drive drive;
            drive.excitation = Eigen::VectorXd::Zero(channels.column_count());
            face.start([&](double) { return drive; });
            for (const auto& [muscle, value] : excitations)
                for (const Side side : {Side::kLeft, Side::kRight})
                    drive.excitation[channels.column(muscle, side)] = value;
            face.solve_equilibrium(drive.excitation, drive);
            const Points moved = face.head().frame.to_mesh(face.pose().vertices) - rest;
            for (long v = 0; v < moved.rows(); ++v)
                for (int k = 0; k < 3; ++k) {
                    const auto number = static_cast<float>(moved(v, k));
                    numbers.write(reinterpret_cast<const char*>(&number), sizeof number);
                }
            json["names"].push_back(name);
            json["excitations"][name] = said.at(name);
        }
        std::ofstream(shapes) << json.dump();
    }
};

TEST(EvaluateAdult, FindsAgainWhatItDidItself) {
    const TemporaryFolder folder;
    const std::map<std::string, Excitations> done{
        {"frown", {{"depressor_anguli_oris", 0.4}, {"corrugator_supercilii", 0.7}}},
        {"smile", {{"zygomaticus_major", 0.6}}}};
    const SelfMade made(kRoot / "rigs/adult/rig.json", folder.path(), done, done);
    const Evaluation found = evaluate({.rig = made.rig, .shapes = made.shapes});
    ASSERT_EQ(found.expressions.size(), 2u);
    for (const EvaluatedExpression& one : found.expressions) {
        EXPECT_GT(one.table.score.cosine, 0.999) << one.name;
        EXPECT_LT(one.table.score.relative, 0.01) << one.name;
        EXPECT_GT(one.table.score.peak_m, 0.002) << one.name;
    }
}

/// A head that none of the rigs was made for, in a folder with shapes of its own.
class Evaluate : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<TemporaryFolder>();
        headmodel::sculpt_head({.out = *folder / "imani",
                                .identity = headmodel::chosen_identity({.identity = "imani"})});
        const std::map<std::string, Excitations> done{
            {"noseSneer", {{"corrugator_supercilii", 0.7}}},
            {"smile", {{"zygomaticus_major", 0.6}}}};
        // The file sets out from less, and from another muscle
        const std::map<std::string, Excitations> said{
            {"noseSneer", {{"corrugator_supercilii", 0.7}}},
            {"smile", {{"zygomaticus_major", 0.2}}}};
        made = std::make_unique<SelfMade>(*folder / "imani/rig.json", folder->path(), done, said);
    }
    static void TearDownTestSuite() {
        made.reset();
        folder.reset();
    }
    static EvaluateOptions options(const std::string& out = "") {
        return {.rig = made->rig,
                .shapes = made->shapes,
                .out = out.empty() ? fs::path() : *folder / out};
    }
    static std::string complaint(const EvaluateOptions& options) {
        try {
            evaluate(options);
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    }
    static std::unique_ptr<TemporaryFolder> folder;
    static std::unique_ptr<SelfMade> made;
};
std::unique_ptr<TemporaryFolder> Evaluate::folder;
std::unique_ptr<SelfMade> Evaluate::made;

TEST_F(Evaluate, ASearchFindsTheActivationAgain) {
    EvaluateOptions asked = options();
    asked.only = {"smile"};
    asked.fit = true;
    const Evaluation found = evaluate(asked);
    ASSERT_TRUE(found.expressions.at(0).fitted);
    const EvaluatedExpression& smile = found.expressions[0];
    EXPECT_GT(smile.table.score.relative, 0.3);
    EXPECT_GT(smile.fitted->score.cosine, 0.99);
    EXPECT_LT(smile.fitted->score.relative, 0.15);
    const int left = found.channels.column("zygomaticus_major", Side::kLeft);
    EXPECT_NEAR(smile.fitted->drive.excitation[left], 0.6, 0.12);
}

TEST_F(Evaluate, TheReportIsWholeAndListsItsFiles) {
    const Evaluation evaluation = evaluate(options("report"));
    std::ifstream stream(*folder / "report/results.json");
    const Json results = Json::parse(stream);
    std::set<std::string> listed, there;
    for (const Json& file : results[report::kFilesKey]) listed.insert(file);
    for (const auto& entry : fs::recursive_directory_iterator(*folder / "report"))
        if (!entry.is_directory())
            there.insert(entry.path().lexically_relative(*folder / "report").generic_string());
    EXPECT_EQ(listed, there);
    for (const char* file :
         {"index.html", "scores.tsv", "contact_sheet_front.png", "contact_sheet_three_quarter.png",
          "pictures/smile/front_table.png", "pictures/smile/three_quarter_measured.png",
          "pictures/smile/front_table_error.png"})
        EXPECT_TRUE(there.count(file)) << file;
    EXPECT_EQ(results["expressions"][1]["name"], "smile");
    EXPECT_EQ(results["expressions"][1]["table"]["drive"]["zygomaticus_major.l"], 0.2);

    // The page needs nobody else, and every picture that it shows is there
    const std::string page = bytes_of(*folder / "report/index.html");
    for (const char* foreign : {"<script", "http:", "https:", "@import", "<link"})
        EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
    int shown = 0;
    for (std::size_t at = page.find(" src=\""); at != std::string::npos;
         at = page.find(" src=\"", at + 1), ++shown) {
        const std::string file = page.substr(at + 6, page.find('"', at + 6) - at - 6);
        EXPECT_TRUE(there.count(file)) << file;
    }
    EXPECT_EQ(shown, 2 + 2 * 2 * 3);

    // A face that does what was measured has no error: pale all over
    const Image pale = media::read_png(*folder / "report/pictures/noseSneer/front_table_error.png"),
                wrong = media::read_png(*folder / "report/pictures/smile/front_table_error.png");
    const auto mean_blue = [](const Image& image) {
        double sum = 0;
        for (std::size_t i = 2; i < image.rgba.size(); i += 4) sum += image.rgba[i];
        return 4 * sum / static_cast<double>(image.rgba.size());
    };
    EXPECT_GT(mean_blue(pale), mean_blue(wrong) + 1);
}

TEST_F(Evaluate, TwiceIsTheSameToTheByte) {
    for (const char* out : {"one", "two"}) {
        EvaluateOptions asked = options(out);
        asked.pictures = false;
        evaluate(asked);
    }
    for (const char* file : {"results.json", "index.html", "scores.tsv"})
        EXPECT_EQ(bytes_of(*folder / "one" / file), bytes_of(*folder / "two" / file)) << file;
    EXPECT_FALSE(fs::exists(*folder / "one/pictures"));
}

TEST_F(Evaluate, BadInputLeavesNothingBehind) {
    const std::set<std::string> before = folder->listing();
    EvaluateOptions asked = options("bad");
    asked.only = {"smiel"};
    EXPECT_EQ(complaint(asked), "only: expected names of shapes in " + made->shapes.string() +
                                    " (did you mean \"smile\"?), found \"smiel\"");
    asked = options("bad");
    Json other = JsonCursor::read_file(made->shapes).json();  // shapes of another head
    other["shape"][1] = other["shape"][1].get<long>() - 1;
    std::ofstream(*folder / "imani/other.json") << other.dump();
    asked.shapes = *folder / "imani/other.json";
    EXPECT_NE(complaint(asked).find("/shape/1: expected the "), std::string::npos);
    asked = options("bad");
    asked.quality = "best";
    EXPECT_EQ(complaint(asked),
              "quality: expected \"draft\", \"preview\", \"video\" or \"fine\", found \"best\"");
    fs::remove(*folder / "imani/other.json");
    EXPECT_EQ(folder->listing(), before);
}

TEST_F(Evaluate, InterruptedLeavesNothingBehind) {
    const std::set<std::string> before = folder->listing();
    int told = 0;
    ProgressMonitor monitor;
    monitor.progress = [&](double, const std::string&) { ++told; };
    monitor.stopped = [&] { return told == 3; };  // while pictures are drawn
    EXPECT_THROW(evaluate(options("stopped"), monitor), Interrupted);
    EXPECT_EQ(told, 3);
    EXPECT_EQ(folder->listing(), before);
}

TEST(Evaluation, SaysWhichExpressionsTheRigWasCalibratedOn) {
    Evaluation evaluation;
    evaluation.calibrated_on = {"smile", "jawLeft"};
    for (const char* name : {"smile", "smile_L", "sneer", "jawLeft", "jawRight"}) {
        EvaluatedExpression one;
        one.name = name;
        one.table.score.cosine = one.name.starts_with("s") ? 0.5 : 0.9;
        evaluation.expressions.push_back(one);
    }
    EXPECT_TRUE(evaluation.is_calibrated_on("smile_L"));
    EXPECT_FALSE(evaluation.is_calibrated_on("jawRight"));
    const auto groups = evaluation.groups();
    ASSERT_EQ(groups.size(), 3u);  // the sixteen are not all there
    EXPECT_EQ(groups[1].names, (std::vector<std::string>{"smile", "smile_L", "jawLeft"}));
    EXPECT_EQ(groups[2].names, (std::vector<std::string>{"sneer", "jawRight"}));
    EXPECT_NEAR(evaluation.means(groups[2].names, false).cosine, 0.7, 1e-15);
}

TEST(ReadUnits, TheAdultsUnitsGoAsFarAndAsEvenlyAsTheTableAsks) {
    const UnitReadings readings =
        read_units({.rig = kRoot / "rigs/adult/rig.json", .only = {"AU4", "AU12"}});
    EXPECT_NEAR(readings.neutral.lid_aperture, 10.3, 0.5);
    ASSERT_EQ(readings.units.size(), 2u);
    for (const scene::UnitReading& unit : readings.units) {
        EXPECT_GT(unit.gain, 0.8) << unit.unit;
        EXPECT_LT(unit.gain, 1.25) << unit.unit;
        const std::array<double, 3> even{0.25, 0.5, 0.75};
        for (std::size_t i = 0; i < even.size(); ++i)
            EXPECT_NEAR(unit.response[i], even[i], 0.05) << unit.unit;
        EXPECT_LT(unit.change.lid_aperture, -0.9) << unit.unit;
        EXPECT_GT(unit.change.lid_aperture, -3) << unit.unit;
        EXPECT_TRUE(unit.in_equilibrium) << unit.unit;
    }
    EXPECT_GT(readings.units[1].change.corner_height, 8);
    // Brows that meet fold the skin between them, a smile that beside the nose, and the other way round not.
    const scene::FaceMeasures &frown = readings.units[0].change, &smile = readings.units[1].change;
    EXPECT_GT(frown.glabellar_furrow, 1);
    EXPECT_NEAR(smile.glabellar_furrow, 0, 0.2);
    EXPECT_GT(smile.nasolabial_furrow, 1);
    EXPECT_NEAR(frown.nasolabial_furrow, 0, 0.2);
    const Json json = readings.json();
    EXPECT_EQ(json["units"][0]["change"]["glabellar_furrow_mm"], frown.glabellar_furrow);
    EXPECT_EQ(json["units"][1]["change"]["lip_contact_mm2"], smile.lip_contact_mm2);
    for (const scene::UnitReading& unit : readings.units) EXPECT_LT(unit.uneven_mm, 1) << unit.unit;
    EXPECT_EQ(
        message_of([] { read_units({.rig = kRoot / "rigs/adult/rig.json", .only = {"AU99"}}); }),
        (kRoot / "rigs/adult/rig.json").string() +
            ": expected an action unit with landmark targets, found \"AU99\"");
}

TEST(ReadUnits, AWinkIsPicturedOnOneSide) {
    const TemporaryFolder folder;
    read_units({.rig = kRoot / "rigs/adult/rig.json",
                .out = folder.path() / "report",
                .only = {"AU46"},
                .steps = false});
    const Image rest = media::read_png(folder.path() / "report/pictures/neutral.png"),
                wink = media::read_png(folder.path() / "report/pictures/AU46.png");
    std::array<int, 2> changed{};  // on the subject's right and left
    for (int y = 0; y < rest.height_px; ++y)
        for (int x = 0; x < rest.width_px; ++x)
            if (std::abs(*rest.pixel(x, y) - *wink.pixel(x, y)) > 24)
                ++changed[x < rest.width_px / 2 ? 0 : 1];
    EXPECT_GT(changed[1], 100);
    EXPECT_LT(20 * changed[0], changed[1]);
}

}  // namespace
}  // namespace risorius::inverse
