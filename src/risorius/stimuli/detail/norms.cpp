// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/norms.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "risorius/core/error.h"
#include "risorius/core/json_object.h"
#include "risorius/core/json_text.h"
#include "risorius/design/design.h"
#include "risorius/design/table.h"
#include "risorius/stimuli/detail/catalogue.h"

namespace risorius::stimuli {

namespace {

constexpr double kNormal95 = 1.959963984540054;

std::string rating_cell(const std::vector<design::Given>& row,
                        const std::vector<std::string>& names) {
    for (const std::string& name : names)
        for (const design::Given& cell : row)
            if (cell.name == name) {
                const std::string text = catalogue_cell(cell.value.json());
                return text == kMissingCell ? "" : text;
            }
    return {};
}

double wilson(const Share& share, double sign) {
    if (share.count == 0) return 0;
    const double n = share.count, z2 = kNormal95 * kNormal95, p = share.value();
    const double middle = p + z2 / (2 * n),
                 half = kNormal95 * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
    return std::clamp((middle + sign * half) / (1 + z2 / n), 0.0, 1.0);
}

/// Fleiss' kappa; clips may have different numbers of ratings.
std::optional<double> fleiss_kappa(
    const std::map<std::string, std::map<std::string, int>>& counts) {
    double agreement = 0, clips = 0, all = 0;
    std::map<std::string, double> of_answer;
    for (const auto& [clip, answers] : counts) {
        double n = 0, pairs = 0;
        for (const auto& [answer, times] : answers) {
            n += times;
            pairs += times * (times - 1.0);
        }
        if (n < 2) continue;
        for (const auto& [answer, times] : answers) of_answer[answer] += times;
        agreement += pairs / (n * (n - 1));
        all += n;
        ++clips;
    }
    if (clips == 0) return {};
    double chance = 0;
    for (const auto& [answer, times] : of_answer) chance += times / all * (times / all);
    if (chance >= 1) return {};
    return (agreement / clips - chance) / (1 - chance);
}

/// ICC(2,k) of a table of clips x participants without gaps.
std::optional<double> intraclass(const std::vector<std::vector<double>>& table) {
    const std::size_t n = table.size(), k = n > 0 ? table[0].size() : 0;
    if (n < 2 || k < 2) return {};
    const auto rows = static_cast<double>(n), columns = static_cast<double>(k);
    double all = 0;
    for (const auto& row : table)
        for (const double one : row) all += one / (rows * columns);
    double between_rows = 0, between_columns = 0, total = 0;
    for (const auto& row : table) {
        double mean = 0;
        for (const double one : row) {
            mean += one / columns;
            total += (one - all) * (one - all);
        }
        between_rows += columns * (mean - all) * (mean - all);
    }
    for (std::size_t c = 0; c < k; ++c) {
        double mean = 0;
        for (const auto& row : table) mean += row[c] / rows;
        between_columns += rows * (mean - all) * (mean - all);
    }
    const double msr = between_rows / (rows - 1), msc = between_columns / (columns - 1),
                 mse = (total - between_rows - between_columns) / ((rows - 1) * (columns - 1));
    const double spread = msr + (msc - mse) / rows;
    if (!(spread > 0)) return {};
    return (msr - mse) / spread;
}

/// Adds what a row of an experiment's data tells of red dots. A page writes several rows for a trial: "task" tells which.
void add_catch(const std::vector<design::Given>& row, const std::string& kind, CatchTrials& out) {
    const auto is_true = [&](const char* column) {
        const std::string text = rating_cell(row, {column});
        return text == "1" || text == "true";
    };
    const std::string task = rating_cell(row, {"task"});
    const bool of_clip = task.empty() || task == "clip";
    if (kind == "catch") {
        out.trials += of_clip;
        out.hits += is_true("correct");
    } else if (kind == "trial") {
        out.other_trials += of_clip;
    }
    if (kind == "catch" || kind == "trial") out.false_alarms += of_clip && is_true("false_alarm");
}

/// A scale by clips and those participants who gave it for all of them.
std::vector<std::vector<double>> scale_table(const std::vector<Rating>& ratings,
                                             const std::string& scale) {
    std::map<std::string, std::map<std::string, std::pair<double, int>>> by_participant;
    std::set<std::string> clips;
    for (const Rating& one : ratings)
        if (const auto value = one.scales.find(scale); value != one.scales.end()) {
            auto& [sum, count] = by_participant[one.participant][one.clip];
            sum += value->second;
            ++count;
            clips.insert(one.clip);
        }
    std::vector<std::vector<double>> out(clips.size());
    for (const auto& [participant, of] : by_participant) {
        if (of.size() != clips.size()) continue;
        std::size_t row = 0;
        for (const auto& [clip, sum] : of) out[row++].push_back(sum.first / sum.second);
    }
    return out;
}

}  // namespace

double Share::low() const { return wilson(*this, -1); }
double Share::high() const { return wilson(*this, 1); }

Ratings read_ratings(const std::filesystem::path& file, const std::vector<std::string>& clips) {
    const std::set<std::string> known(clips.begin(), clips.end());
    Ratings out;
    std::map<std::string, CatchTrials> dots;
    bool any_dot = false;
    for (const auto& row : design::read_table(file, design::ColumnNames::kAny)) {
        Rating rating;
        rating.participant = rating_cell(row, {"participant"});
        const std::string kind = rating_cell(row, {"kind"});
        add_catch(row, kind, dots[rating.participant]);
        any_dot = any_dot || kind == "catch";
        if (kind == "practice" || kind == "catch") continue;
        rating.clip = rating_cell(row, {"stimulus_id", "stim_id"});
        rating.answer = rating_cell(row, {"answer", "response"});
        for (const design::Given& cell : row)
            if (std::count(design::rating_scales().begin(), design::rating_scales().end(),
                           cell.name) > 0 &&
                !rating_cell(row, {cell.name}).empty())
                rating.scales[cell.name] = cell.value.number({-1e6, 1e6});
        if (rating.clip.starts_with("stim-")) rating.clip.erase(0, 5);
        if (rating.clip.empty() || (rating.answer.empty() && rating.scales.empty())) continue;
        if (known.count(rating.clip) == 0)
            throw Error(design::row_place(row), "a clip of the set", in_quotes(rating.clip));
        out.given.push_back(std::move(rating));
    }
    if (any_dot) out.catches = std::move(dots);
    if (out.given.empty())
        throw Error(file.string(), "ratings with stimulus_id, and an answer or one of the scales",
                    "none");
    return out;
}

Norms norms_of(const Ratings& all, const std::map<std::string, std::string>& right) {
    const std::vector<Rating>& ratings = all.given;
    Norms out;
    out.catches = all.catches;
    std::map<std::string, std::map<std::string, int>> counts;
    std::map<std::string, std::map<std::string, std::pair<double, int>>> scales;
    for (const Rating& one : ratings) {
        Norms::OfClip& clip = out.clips[one.clip];
        for (const auto& [scale, value] : one.scales) {
            scales[one.clip][scale].first += value;
            ++scales[one.clip][scale].second;
        }
        if (one.answer.empty()) continue;
        ++clip.ratings;
        ++counts[one.clip][one.answer];
        const auto of = right.find(one.clip);
        if (of == right.end()) continue;
        ++clip.hits.count;
        clip.hits.hits += one.answer == of->second;
        ++out.confusion[of->second][one.answer];
    }
    for (auto& [name, clip] : out.clips) {
        int most = 0;
        for (const auto& [answer, times] : counts[name])
            if (times > most) {
                most = times;
                clip.answer = answer;
            }
        for (const auto& [scale, sum] : scales[name]) clip.means[scale] = sum.first / sum.second;
    }
    out.kappa = fleiss_kappa(counts);
    for (const std::string& scale : design::rating_scales())
        if (const auto value = intraclass(scale_table(ratings, scale))) out.icc[scale] = *value;
    return out;
}

std::optional<double> Norms::unbiased_hit_rate(const std::string& answer) const {
    double shown = 0, answered = 0, hits = 0;
    for (const auto& [right, answers] : confusion)
        for (const auto& [given, times] : answers) {
            shown += right == answer ? times : 0;
            answered += given == answer ? times : 0;
            hits += right == answer && given == answer ? times : 0;
        }
    if (shown == 0) return {};
    return answered > 0 ? hits * hits / (shown * answered) : 0;
}

Json Norms::json() const {
    Json answers = Json::object();
    for (const auto& [right, given] : confusion) {
        Share share;
        for (const auto& [answer, times] : given) {
            share.count += times;
            share.hits += answer == right ? times : 0;
        }
        answers[right] = json_object({{"shown", share.count},
                                      {"hit_rate", share.value()},
                                      {"low", share.low()},
                                      {"high", share.high()},
                                      {"unbiased_hit_rate", *unbiased_hit_rate(right)}});
    }
    Json reliability = Json::object();
    for (const auto& [scale, value] : icc) reliability[scale] = value;
    Json out = json_object({{"format", "risorius-norms"},
                            {"version", 1},
                            {"clips", clips.size()},
                            {"answers", answers},
                            {"fleiss_kappa", kappa ? Json(*kappa) : Json()},
                            {"icc_2_k", reliability}});
    if (catches.empty()) return out;
    CatchTrials all;
    for (const auto& [participant, of] : catches) {
        all.trials += of.trials;
        all.hits += of.hits;
        all.other_trials += of.other_trials;
        all.false_alarms += of.false_alarms;
    }
    const Share hits{.hits = all.hits, .count = all.trials};
    out["catch"] = json_object({{"trials", all.trials},
                                {"hits", all.hits},
                                {"hit_rate", hits.value()},
                                {"low", hits.low()},
                                {"high", hits.high()},
                                {"other_trials", all.other_trials},
                                {"false_alarms", all.false_alarms}});
    return out;
}

std::string Norms::catch_table() const {
    if (catches.empty()) return {};
    std::string out = "participant\tcatch_trials\thits\tother_trials\tfalse_alarms\n";
    for (const auto& [participant, of] : catches)
        out += catalogue_cell(Json(participant)) + "\t" + std::to_string(of.trials) + "\t" +
               std::to_string(of.hits) + "\t" + std::to_string(of.other_trials) + "\t" +
               std::to_string(of.false_alarms) + "\n";
    return out;
}

std::string Norms::confusion_table() const {
    std::set<std::string> answers;
    for (const auto& [right, given] : confusion)
        for (const auto& [answer, times] : given) answers.insert(answer);
    std::string out = "right";
    for (const std::string& answer : answers) out += "\t" + catalogue_cell(Json(answer));
    out += "\n";
    for (const auto& [right, given] : confusion) {
        out += catalogue_cell(Json(right));
        for (const std::string& answer : answers) {
            const auto times = given.find(answer);
            out += "\t" + std::to_string(times == given.end() ? 0 : times->second);
        }
        out += "\n";
    }
    return out;
}

}  // namespace risorius::stimuli
