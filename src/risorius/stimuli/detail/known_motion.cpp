// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/known_motion.h"

#include "risorius/core/result_cache.h"

namespace risorius::stimuli {

namespace {

/// Numbers in a form that the cache keeps.
struct KnownWays {
    std::vector<double> mm;
};

std::string key_of(const char* computation, const animate::RenderJob& job,
                   const LandmarkChoice& choice) {
    CacheKey key(computation);
    key.add(choice.name());
    key.add(job.script_file.sha256).add(job.rig->rig.sha256).add(job.rig->mesh.sha256);
    key.add(job.rig->tables.size());
    for (const animate::InputFile& table : job.rig->tables) key.add(table.sha256);
    key.add(job.recordings.size());
    for (const animate::InputFile& recording : job.recordings) key.add(recording.sha256);
    key.add(job.quality.name).add(job.fps).add(job.frames).add(job.times_s).add(job.first_frame_s);
    key.add(job.flipped_motion);
    return key.finish();
}

template <typename Compute>
std::vector<double> known_ways(const char* computation, const animate::RenderJob& job,
                               const LandmarkChoice& choice, const std::function<void()>& begin,
                               const Compute& compute) {
    return cached_result(
               key_of(computation, job, choice),
               [&] {
                   if (begin) begin();
                   return KnownWays{compute()};
               },
               [](auto& ways, const auto& visit) { visit(ways.mm); })
        .mm;
}

}  // namespace

double settled_way_mm(const animate::RenderJob& job, animate::RenderSession& session,
                      const std::function<void()>& begin, const LandmarkChoice& choice) {
    const auto settled = [&] {
        return std::vector<double>{
            largest_way_mm(animate::settled_landmarks(job, session), choice)};
    };
    const std::vector<double> known = known_ways("settled way 1", job, choice, begin, settled);
    return known.size() == 1 ? known.front() : settled().front();
}

std::vector<double> course_mm(const animate::RenderJob& job, animate::RenderSession& session,
                              const ProgressMonitor& monitor, const std::function<void()>& begin) {
    return known_ways("course of ways 1", job, {}, begin, [&] {
        std::vector<double> out;
        const animate::LandmarkFrames frames = animate::play_landmarks(job, session, monitor);
        for (const Points& frame : frames.positions_mm)
            out.push_back(largest_way_mm({frames.ids, {frames.positions_mm.front(), frame}}));
        return out;
    });
}

}  // namespace risorius::stimuli
