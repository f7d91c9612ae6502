// SPDX-License-Identifier: MIT
#include "tools/bench/bench_growth.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "risorius/animate/animate.h"
#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/face/diagnostics.h"
#include "risorius/face/face.h"
#include "risorius/plot/write_chart.h"
#include "risorius/render/offscreen_view.h"
#include "risorius/report/atomic_file.h"
#include "risorius/report/median.h"
#include "risorius/report/stopwatch.h"
#include "risorius/scene/scene_from_rig.h"
#include "risorius/stimuli/batch.h"
#include "risorius/track/timeline.h"
#include "tools/bench/bench_steps.h"

namespace risorius::bench {

namespace fs = std::filesystem;

namespace {

constexpr int kSteps = 40, kDrawings = 5;
// Finer shells need a finer mesh of the head than the embedded one.
constexpr int kFinestShell = 6600;
constexpr int kClipsOfOneFactor = 100;

/// What a measuring process hands back. `letters`: how many characters of a message follow.
struct Answer {
    long letters = 0;
    Measured measured;
};

bool write_all(int pipe, const void* from, std::size_t count) {
    const char* at = static_cast<const char*>(from);
    while (count > 0) {
        const ssize_t written = ::write(pipe, at, count);
        if (written <= 0) return false;
        at += written;
        count -= static_cast<std::size_t>(written);
    }
    return true;
}

bool read_all(int pipe, void* to, std::size_t count) {
    char* at = static_cast<char*>(to);
    while (count > 0) {
        const ssize_t read = ::read(pipe, at, count);
        if (read <= 0) return false;
        at += read;
        count -= static_cast<std::size_t>(read);
    }
    return true;
}

/// The measuring process. It never returns.
[[noreturn]] void measure(int pipe, const std::function<Measured()>& work) {
    // A stop ends it at once; what it has written lies in the folder of the benchmark.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    std::string why;
    Answer answer;
    try {
        answer.measured = work();
    } catch (const std::exception& error) {
        why = error.what();
    }
    answer.letters = static_cast<long>(why.size());
    const bool sent =
        write_all(pipe, &answer, sizeof answer) && write_all(pipe, why.data(), why.size());
    ::_exit(sent ? 0 : 1);
}

/// One size of a series and how it is measured.
struct Case {
    double size = 0;  ///< 0: the work tells it
    std::function<Measured()> work;
};

struct SeriesPlan {
    std::string name, size, label;  ///< `label`: for the key of the chart
    std::vector<Case> cases;
};

geom::PolygonMesh refined(geom::PolygonMesh mesh, int times) {
    for (int k = 0; k < times; ++k) mesh = finer_mesh(mesh);
    return mesh;
}

/// Steps of the demanding track, and the building of the face, for shells of several sizes.
void add_nodes(const scene::RigFiles& files, const std::vector<int>& skin_vertices,
               std::vector<SeriesPlan>& plans) {
    SeriesPlan steps{"a time step", "nodes", "step, nodes", {}},
        building{"building the face", "nodes", "building, nodes", {}};
    for (const int vertices : skin_vertices) {
        const face::Quality quality = preview_with(vertices);
        const int refinements = vertices > kFinestShell ? 1 : 0;
        steps.cases.push_back(
            {0, [&files, quality, refinements]() -> Measured {
                 const track::Timeline timeline(step_track(files), files.rig.channels());
                 const face::DriveAt drive = [&](double t_s) { return timeline.at(t_s); };
                 face::Face face(files.rig, refined(files.mesh, refinements), quality,
                                 files.place());
                 face.start(drive);
                 const report::ProcessStopwatch time;
                 for (int step = 0; step < kSteps; ++step) face.step(drive);
                 return {time.seconds() / kSteps,
                         static_cast<double>(face.diagnostics().node_count())};
             }});
        if (refinements > 0) continue;  // the mesh would be another, too
        building.cases.push_back(
            {0, [&files, quality]() -> Measured {
                 const report::ProcessStopwatch time;
                 const face::Face face(files.rig, files.mesh, quality, files.place());
                 return {time.seconds(), static_cast<double>(face.diagnostics().node_count())};
             }});
    }
    plans.push_back(std::move(steps));
    plans.push_back(std::move(building));
}

/// Drawing a frame of 64 x 64 pixels, most of which is the work on the mesh's vertices.
void add_vertices(const scene::RigFiles& files, const std::vector<int>& refinements,
                  std::vector<SeriesPlan>& plans) {
    SeriesPlan drawing{"drawing 64 x 64 pixels", "vertices", "drawing, vertices", {}},
        building{"building the face and its view", "vertices", "building, vertices", {}};
    for (const int times : refinements) {
        const double vertices = refined(files.mesh, times).vertex_count();
        // The mesh is made in the process that measures, whose memory is asked for.
        const auto view_of = [&files, times](double& building_s) {
            const geom::PolygonMesh mesh = refined(files.mesh, times);
            const report::ProcessStopwatch time;
            const face::Face face(files.rig, mesh, face::quality_named("preview"), files.place());
            const render::Scene scene = scene::scene_from_rig(face.head(), files.rig, mesh);
            render::ViewOptions view;
            view.width_px = view.height_px = 64;
            view.threads = 0;
            render::OffscreenView window(scene, view);
            const std::vector<render::Pose> pose{scene::pose_for_view(face.pose())};
            window.draw(pose);
            building_s = time.seconds();
            std::vector<double> drawn_s;
            for (int k = 0; k < kDrawings; ++k) {
                const report::ProcessStopwatch drawing_time;
                window.draw(pose);
                drawn_s.push_back(drawing_time.seconds());
            }
            return report::median(drawn_s);
        };
        drawing.cases.push_back({vertices, [view_of]() -> Measured {
                                     double building_s = 0;
                                     return {view_of(building_s), 0};
                                 }});
        building.cases.push_back({vertices, [view_of]() -> Measured {
                                      double building_s = 0;
                                      view_of(building_s);
                                      return {building_s, 0};
                                  }});
    }
    plans.push_back(std::move(drawing));
    plans.push_back(std::move(building));
}

/// Writes a script with a smile and returns how to render it.
animate::RenderRequest smile_of(const scene::RigFiles& files, const fs::path& folder, int frames,
                                int size_px) {
    constexpr int kFps = 60;
    const Json script = json_object(
        {{"format", "risorius-script"},
         {"version", 1},
         {"rig", fs::absolute(files.file).generic_string()},
         {"fps", kFps},
         {"duration_s", static_cast<double>(frames) / kFps},
         {"seed", 1},
         {"channels", json_object({{"AU12", json_object({{"keys", {{0.0, 0.0}, {0.4, 0.9}}}})}})}});
    animate::RenderRequest request;
    request.script = folder / ("smile_" + std::to_string(frames) + ".json");
    report::write_text(request.script, json_text(script));
    request.out = folder / "smile.mkv";
    request.size = animate::PictureSize{size_px, size_px};
    request.quality = "preview";
    request.threads = 1;
    return request;
}

void add_frames(const scene::RigFiles& files, const fs::path& folder,
                const std::vector<int>& frames, std::vector<SeriesPlan>& plans) {
    SeriesPlan videos{"a video of 64 x 64 pixels", "frames", "video, frames", {}};
    for (const int count : frames) {
        const animate::RenderRequest request = smile_of(files, folder, count, 64);
        videos.cases.push_back({static_cast<double>(count), [request]() -> Measured {
                                    const report::ProcessStopwatch time;
                                    animate::animate(request);
                                    return {time.seconds(), 0};
                                }});
    }
    plans.push_back(std::move(videos));
}

void add_threads(const scene::RigFiles& files, const fs::path& folder,
                 const std::vector<int>& threads, std::vector<SeriesPlan>& plans) {
    constexpr int kFrames = 60, kSize_px = 256;
    SeriesPlan videos{"60 frames of 256 x 256 pixels", "threads", "video, threads", {}};
    for (const int count : threads) {
        animate::RenderRequest request = smile_of(files, folder, kFrames, kSize_px);
        request.threads = count;
        videos.cases.push_back({static_cast<double>(count), [request]() -> Measured {
                                    const report::ProcessStopwatch time;
                                    animate::animate(request);
                                    return {time.seconds(), 0};
                                }});
    }
    plans.push_back(std::move(videos));
}

/// Writes a design of `clips` clips of two frames and returns its file.
fs::path design_of(const scene::RigFiles& files, const fs::path& folder, int clips) {
    const int others = std::min(clips, kClipsOfOneFactor);
    const auto up_to = [](int count) {
        return json_object({{"from", 1}, {"to", count}, {"steps", count}});
    };
    const Json script = json_object(
        {{"format", "risorius-script"},
         {"version", 1},
         {"rig", fs::absolute(files.file).generic_string()},
         {"fps", 30},
         {"duration_s", 2 / 30.0},
         {"channels",
          json_object(
              {{"AU12", json_object({{"keys", {{0.0, "${intensity}"}, {0.06, "${tempo}"}}}})}})},
         {"view", json_object({{"width_px", 64}, {"height_px", 64}})}});
    report::write_text(folder / "clip.json", json_text(script));
    Json factors = json_object({{"a", up_to(others)}});
    const int levels = clips / others;
    if (levels > 1) factors["b"] = up_to(levels);
    const Json design = json_object(
        {{"format", "risorius-design"},
         {"version", 1},
         {"name", "Growth"},
         {"seed", 1},
         {"clips", json_object({{"ending", "mkv"}, {"quality", "preview"}})},
         {"sets", Json::array({json_object(
                      {{"name", "smile"},
                       {"clip", levels > 1 ? "smile_a${a}b${b}" : "smile_a${a}"},
                       {"script", "clip.json"},
                       {"factors", factors},
                       {"parameters",
                        json_object({{"intensity", "= a / " + std::to_string(others)},
                                     {"tempo",
                                      levels > 1 ? "= b / " + std::to_string(levels)
                                                 : "= a / " + std::to_string(2 * others)}})}})})}});
    const fs::path file = folder / ("design_" + std::to_string(clips) + ".json");
    report::write_text(file, json_text(design));
    return file;
}

void add_clips(const scene::RigFiles& files, const fs::path& folder, const GrowthSizes& sizes,
               std::vector<SeriesPlan>& plans) {
    SeriesPlan planned{"planning a set", "clips", "planning, clips", {}},
        rendered{"making a set of clips with two frames of 64 x 64 pixels",
                 "clips",
                 "making, clips",
                 {}};
    for (const int clips : sizes.planned_clips) {
        const fs::path design = design_of(files, folder, clips);
        planned.cases.push_back({static_cast<double>(clips), [design]() -> Measured {
                                     const report::ProcessStopwatch time;
                                     stimuli::plan_batch(design);
                                     return {time.seconds(), 0};
                                 }});
    }
    for (const int clips : sizes.rendered_clips) {
        const fs::path design = design_of(files, folder, clips);
        const fs::path out = folder / ("set_" + std::to_string(clips));
        rendered.cases.push_back({static_cast<double>(clips), [design, out]() -> Measured {
                                      const report::ProcessStopwatch time;
                                      const stimuli::BatchReport report =
                                          stimuli::make_batch({.design = design, .out = out});
                                      if (!report.failed.empty())
                                          throw RunError(report.failed.front().second);
                                      return {time.seconds(), 0};
                                  }});
    }
    plans.push_back(std::move(planned));
    plans.push_back(std::move(rendered));
}

Json measured(const SeriesPlan& plan, double done, double all, const ProgressMonitor& monitor) {
    Json cases = Json::array(), exponents = Json::array();
    double before_size = 0, before_s = 0;
    for (const Case& one : plan.cases) {
        monitor.report(done++ / all, plan.name + ", by " + plan.size);
        monitor.throw_if_stopped();
        const Cost cost = cost_apart(one.work);
        const double size = one.size > 0 ? one.size : cost.measured.size;
        const double seconds = cost.measured.seconds;
        cases.push_back(
            json_object({{"size", size}, {"seconds", seconds}, {"megabytes", cost.megabytes}}));
        if (before_size > 0)
            exponents.push_back(std::log(seconds / before_s) / std::log(size / before_size));
        before_size = size;
        before_s = seconds;
    }
    return json_object({{"series", plan.name},
                        {"size", plan.size},
                        {"label", plan.label},
                        {"cases", cases},
                        {"exponents", exponents}});
}

}  // namespace

Cost cost_apart(const std::function<Measured()>& work) {
    int ends[2];
    if (::pipe(ends) != 0) throw RunError("a pipe cannot be made");
    std::fflush(nullptr);  // what waits to be printed is the parent's
    const pid_t child = ::fork();
    if (child < 0) throw RunError("a process cannot be started");
    if (child == 0) {
        ::close(ends[0]);
        measure(ends[1], work);
    }
    ::close(ends[1]);
    Answer answer;
    std::string why;
    bool whole = read_all(ends[0], &answer, sizeof answer);
    if (whole && answer.letters > 0) {
        why.resize(static_cast<std::size_t>(answer.letters));
        whole = read_all(ends[0], why.data(), why.size());
    }
    ::close(ends[0]);
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    if (!whole) throw RunError("the process that measures ended by itself");
    if (!why.empty()) throw RunError(why);
    return {answer.measured, static_cast<double>(usage.ru_maxrss) / 1024};  // Linux reports kB
}

geom::PolygonMesh finer_mesh(const geom::PolygonMesh& mesh) {
    geom::PolygonMesh out = mesh;
    out.face_begin = {0};
    out.corner_vertex.clear();
    out.face_group.clear();
    out.face_texture.clear();
    out.face_material.clear();
    std::vector<Vec3> added;
    std::vector<Eigen::Vector2d> texcoords;
    std::map<std::pair<int, int>, int> middles;
    const auto place = [&](int v) -> Vec3 { return mesh.positions.row(v).transpose(); };
    const auto add = [&](const Vec3& at) {
        added.push_back(at);
        return mesh.vertex_count() + static_cast<int>(added.size()) - 1;
    };
    const auto middle = [&](int a, int b) {
        const auto [found, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, 0);
        if (is_new) found->second = add((place(a) + place(b)) / 2);
        return found->second;
    };
    for (int face = 0; face < mesh.face_count(); ++face) {
        const int first = mesh.face_begin[static_cast<std::size_t>(face)],
                  n = mesh.corner_count(face);
        const auto vertex = [&](int k) {
            return mesh.corner_vertex[static_cast<std::size_t>(first + k % n)];
        };
        const auto texcoord = [&](int k) -> Eigen::Vector2d {
            return mesh.corner_texcoord.row(first + k % n).transpose();
        };
        const bool coloured = mesh.corner_texcoord.rows() > 0;
        Vec3 centre = Vec3::Zero();
        Eigen::Vector2d centre_texcoord = Eigen::Vector2d::Zero();
        for (int k = 0; k < n; ++k) {
            centre += place(vertex(k)) / n;
            if (coloured) centre_texcoord += texcoord(k) / n;
        }
        const int inner = add(centre);
        for (int k = 0; k < n; ++k) {
            for (const int v : {vertex(k), middle(vertex(k), vertex(k + 1)), inner,
                                middle(vertex(k + n - 1), vertex(k))})
                out.corner_vertex.push_back(v);
            out.face_begin.push_back(static_cast<int>(out.corner_vertex.size()));
            out.face_group.push_back(mesh.face_group[static_cast<std::size_t>(face)]);
            for (auto [from, to] : {std::pair{&mesh.face_texture, &out.face_texture},
                                    std::pair{&mesh.face_material, &out.face_material}})
                if (!from->empty()) to->push_back((*from)[static_cast<std::size_t>(face)]);
            if (!coloured) continue;
            texcoords.push_back(texcoord(k));
            texcoords.emplace_back((texcoord(k) + texcoord(k + 1)) / 2);
            texcoords.push_back(centre_texcoord);
            texcoords.emplace_back((texcoord(k + n - 1) + texcoord(k)) / 2);
        }
    }
    out.positions.conservativeResize(mesh.vertex_count() + static_cast<long>(added.size()), 3);
    for (std::size_t k = 0; k < added.size(); ++k)
        out.positions.row(mesh.vertex_count() + static_cast<long>(k)) = added[k].transpose();
    out.corner_texcoord.resize(static_cast<long>(texcoords.size()), 2);
    for (std::size_t k = 0; k < texcoords.size(); ++k)
        out.corner_texcoord.row(static_cast<long>(k)) = texcoords[k].transpose();
    return out;
}

Json bench_growth(const scene::RigFiles& files, const fs::path& folder, const GrowthSizes& sizes,
                  const ProgressMonitor& monitor) {
    std::vector<SeriesPlan> plans;
    add_nodes(files, sizes.skin_vertices, plans);
    add_vertices(files, sizes.refinements, plans);
    add_frames(files, folder, sizes.frames, plans);
    add_clips(files, folder, sizes, plans);
    add_threads(files, folder, sizes.threads, plans);
    double all = 0, done = 0;
    for (const SeriesPlan& plan : plans) all += static_cast<double>(plan.cases.size());
    Json out = Json::array();
    for (const SeriesPlan& plan : plans) {
        if (!plan.cases.empty()) out.push_back(measured(plan, done, all, monitor));
        done += static_cast<double>(plan.cases.size());
    }
    return out;
}

void draw_growth(const Json& growth, const fs::path& folder) {
    plot::Chart chart;
    chart.name = "growth";
    chart.x = {.label = "size / smallest size", .logarithmic = true};
    chart.y = {.label = "time / time of the smallest", .logarithmic = true};
    double furthest = 1;
    for (const Json& one : growth) {
        plot::Series series;
        series.label = one["label"].get<std::string>();
        series.mark = plot::Mark::kLinePoints;
        const Json& first = one["cases"].front();
        for (const Json& at : one["cases"]) {
            series.x.push_back(at["size"].get<double>() / first["size"].get<double>());
            series.y.push_back(at["seconds"].get<double>() / first["seconds"].get<double>());
        }
        furthest = std::max(furthest, series.x.back());
        chart.series.push_back(std::move(series));
    }
    for (const auto& [power, label] :
         {std::pair{1.0, "in proportion"}, std::pair{1.3, "power of 1.3"}})
        chart.series.push_back({.label = label,
                                .x = {1, furthest},
                                .y = {1, std::pow(furthest, power)},
                                .mark = plot::Mark::kDashed});
    plot::write_chart(chart, folder);
}

}  // namespace risorius::bench
