// SPDX-License-Identifier: MIT
#include "risorius/study/run_study.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "risorius/core/error.h"
#include "risorius/core/json_text.h"
#include "risorius/core/parallel.h"
#include "risorius/face/face.h"
#include "risorius/plot/write_chart.h"
#include "risorius/report/atomic_folder.h"
#include "risorius/scene/landmark_points.h"
#include "risorius/scene/rig_files.h"
#include "risorius/study/detail/study_charts.h"
#include "risorius/study/detail/study_page.h"
#include "risorius/study/detail/study_tables.h"
#include "risorius/study/study_results.h"

namespace risorius::study {

namespace {

namespace fs = std::filesystem;

/// Nodes are this near to their place in equilibrium: a hundredth of what parameters move them by.
constexpr double kTolerance_m = 1e-5;

/// One face of the sample in all poses.
class SampledFace {
  public:
    SampledFace(const StudyDescription& study, const rig::RigDescription& rig,
                const geom::PolygonMesh& mesh, const std::string& place)
        : study_(study),
          face_(rig, mesh, face::quality_named(study.quality), place),
          points_(face_.head(), rig) {}

    /// Returns whether the face came to rest, and writes the displacements of the landmarks, mm.
    bool settle(std::size_t pose, Eigen::Ref<Eigen::RowVectorXd> moved_mm) {
        track::Drive rest;
        rest.excitation = Eigen::VectorXd::Zero(study_.poses[pose].drive.excitation.size());
        face_.start([&](double) { return rest; });
        const track::Drive& drive = study_.poses[pose].drive;
        const bool converged = face_
                                   .solve_equilibrium(drive.excitation, drive,
                                                      {.iterations = face::kRestIterations,
                                                       .tolerance_m = kTolerance_m,
                                                       .planes_m = kTolerance_m})
                                   .converged;
        const Points vertices = face_.pose().vertices;
        for (std::size_t l = 0; l < study_.landmarks.size(); ++l) {
            const std::string& id = study_.landmarks[l];
            moved_mm.segment<3>(static_cast<Eigen::Index>(3 * l)) =
                1e3 * (points_.at(id, vertices) - points_.at(id, face_.head().vertices));
        }
        return converged;
    }

  private:
    const StudyDescription& study_;
    face::Face face_;
    scene::LandmarkPoints points_;
};

}  // namespace

StudyResults simulate_study(const StudyDescription& study, const SampledRigs& rigs, int threads,
                            const ProgressMonitor& monitor) {
    const scene::RigFiles files = scene::read_rig_files(study.rig, monitor.stopped);
    const auto poses = static_cast<Eigen::Index>(study.poses.size());
    const auto columns = static_cast<Eigen::Index>(3 * study.landmarks.size());
    const auto runs = static_cast<Eigen::Index>(rigs.runs().size());
    StudyResults results;
    results.moved_mm.resize(runs, poses * columns);
    results.in_equilibrium.resize(runs, poses);
    const ProgressMonitor making = monitor.subrange(0, 0.98);
    TaskProgress progress(making, static_cast<int>(runs));
    parallel_for(static_cast<int>(runs), threads, [&](int r) {
        const Run& run = rigs.runs()[static_cast<std::size_t>(r)];
        const std::string name = "face " + std::to_string(r);
        progress.begin(name);
        SampledFace face(study, rigs.rig(run), files.mesh, files.place() + ", " + name);
        Eigen::RowVectorXd moved_mm(columns);
        for (Eigen::Index p = 0; p < poses; ++p) {
            monitor.throw_if_stopped();
            results.in_equilibrium(r, p) = face.settle(static_cast<std::size_t>(p), moved_mm);
            results.moved_mm.block(r, p * columns, 1, columns) = moved_mm;
        }
    });
    monitor.report(0.98, "indices");
    analyse(study, rigs.runs(), results);
    return results;
}

StudyDescription check_study(const std::filesystem::path& file) {
    StudyDescription study = read_study(file);
    const SampledRigs checked(study);
    return study;
}

Json run_study(const StudyOptions& options, const ProgressMonitor& monitor) {
    const StudyDescription study = read_study(options.study);
    const SampledRigs rigs(study);
    report::AtomicFolder folder(options.out);
    const StudyResults results = simulate_study(study, rigs, options.threads, monitor);

    std::vector<std::string> files{"index.html", "results.json"};
    const auto write = [&](const std::string& name, const std::string& text) {
        write_file(folder.partial() / name, text);
        files.push_back(name);
    };
    for (const StudyTable& table : study_tables(study, rigs, results)) {
        write(table.name + ".tsv", table.text);
        write(table.name + ".json", table.columns);
    }
    for (const plot::Chart& chart : study_charts(study, results))
        for (const std::string& file : plot::write_chart(chart, folder.partial()))
            files.push_back(file);
    Json json = results_json(study, results);
    write_file(folder.partial() / "index.html", study_page(study, results));
    std::sort(files.begin(), files.end());
    json[report::kFilesKey] = files;
    write_file(folder.partial() / "results.json", json_text(json, 2) + "\n");
    monitor.throw_if_stopped();
    folder.commit();
    return json;
}

}  // namespace risorius::study
