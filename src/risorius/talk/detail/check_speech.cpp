// SPDX-License-Identifier: MIT
#include "risorius/talk/detail/check_speech.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "risorius/speech/trajectory.h"

namespace risorius::talk {

namespace {

using speech::ClosureChange;
using speech::LipClosure;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kHeldFrom_s = 0.010, kHeldTo_s = 0.005;
constexpr double kOpenGap_mm = 0.5;
// How far around a closure its contact and its opening are looked for
constexpr double kBefore_s = 0.15, kAfter_s = 0.2;
// The most that one pass changes
constexpr double kMaxEarlier_s = 0.03;
// Lips that meet too early are too near in the sound before: it opens them further, at most to this beyond the plan.
constexpr double kWiderBefore_mm = 1.5, kWidestBefore_mm = 4.5;
constexpr double kDeeper = 2, kDeeperAtLeast_mm = 0.6, kDeepest_mm = 8;
// The lips gain less than half of the time by which they begin earlier.
constexpr double kEarlier = 2;
constexpr double kStuck_s = 0.05, kLessDeep = 0.6;
constexpr double kPressed_mm = 0.05, kLessPressed = 0.25;
constexpr double kSmallLeak_mm = 1, kMuch_s = 0.005;
// Median of what 15 closures of two sentences needed on the adult: 2.4 mm
constexpr double kUsuallyDeeper_mm = 2;
// Vowels that open too little: what is left as it is, and the most that is asked for beyond the plan
constexpr double kMissing_mm = 1, kWider = 0.8, kWidest_mm = 6;
constexpr double kEarliest_s = 0.06, kShortest_s = 0.06, kLongest_s = 0.04;

std::string cell(double value, int decimals) {
    if (std::isnan(value)) return "\t";
    char text[48];
    std::snprintf(text, sizeof text, "\t%.*f", decimals, value + 0.0);
    return text;
}

}  // namespace

double MouthTrack::at(double t_s, double Mouth::*measure) const {
    if (mouths.empty()) return 0;
    const double place = std::clamp((t_s - time_s.front()) / kMouthStep_s, 0.0,
                                    static_cast<double>(mouths.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(place),
                            mouths.size() > 1 ? mouths.size() - 2 : std::size_t{0});
    if (mouths.size() == 1) return mouths[0].*measure;
    const double s = place - static_cast<double>(i);
    return (1 - s) * (mouths[i].*measure) + s * (mouths[i + 1].*measure);
}

MouthTrack simulate_mouth(face::Face& face, const track::Timeline& timeline, double duration_s,
                          const MouthMeasures& measures,
                          const std::function<void(double fraction)>& report) {
    const face::DriveAt drive = [&](double t_s) { return timeline.at(t_s); };
    face.start(drive);
    MouthTrack out;
    const long count = static_cast<long>(std::floor(duration_s / kMouthStep_s)) + 1;
    for (long i = 0; i < count; ++i) {
        const double t_s = static_cast<double>(i) * kMouthStep_s;
        out.time_s.push_back(t_s);
        out.mouths.push_back(measures.at(face.pose_at(t_s, drive)));
        if (report) report(static_cast<double>(i) / static_cast<double>(count));
    }
    return out;
}

std::vector<ClosureCheck> check_closures(const MouthTrack& track, const PlacedUtterance& placed) {
    std::vector<ClosureCheck> out;
    for (const LipClosure& closure : placed.targets.closures) {
        ClosureCheck check;
        check.phone = closure.first_phone;
        check.closure_s = placed.start_s + closure.closure_s;
        check.release_s = placed.start_s + closure.release_s;
        check.from_rest =
            closure.first_phone == 0 ||
            placed.utterance.phones[static_cast<std::size_t>(closure.first_phone) - 1].is_pause();
        check.least_gap_mm = std::numeric_limits<double>::infinity();
        for (double t = check.closure_s; t <= check.release_s; t += kMouthStep_s / 2) {
            const double gap = track.at(t, &Mouth::gap);
            check.least_gap_mm = std::min(check.least_gap_mm, gap);
            if (t >= check.closure_s + kHeldFrom_s && t <= check.release_s - kHeldTo_s)
                check.max_gap_mm = std::max(check.max_gap_mm, gap);
        }
        // The contact that is there in the middle of the closure, back to where it began and on to its end
        const double middle_s = (check.closure_s + check.release_s) / 2;
        check.contact_s = check.open_s = check.closed_until_s = kNone;
        if (check.reached()) {
            double t = middle_s;
            while (t > check.closure_s - kBefore_s && track.at(t, &Mouth::gap) < kContactGap_mm)
                t -= 0.001;
            while (t < check.release_s && track.at(t, &Mouth::gap) >= kContactGap_mm) t += 0.001;
            check.contact_s = t;
            t = std::max(middle_s, t);
            check.closed_until_s = t;
            while (check.closed_until_s < check.release_s + kAfter_s &&
                   track.at(check.closed_until_s, &Mouth::gap) < kContactGap_mm)
                check.closed_until_s += 0.001;
            while (t < check.release_s + kAfter_s && track.at(t, &Mouth::gap) <= kOpenGap_mm)
                t += 0.001;
            if (t < check.release_s + kAfter_s) check.open_s = t;
        }
        out.push_back(check);
    }
    return out;
}

std::vector<VowelCheck> check_vowels(const MouthTrack& track, const PlacedUtterance& placed,
                                     const speech::PhoneTable& table) {
    const speech::ArticulationCurves plan = speech::curves_of(placed.targets);
    std::vector<VowelCheck> out;
    const speech::Utterance& u = placed.utterance;
    for (std::size_t i = 0; i < u.phones.size(); ++i) {
        if (!is_vowel(table.phone(u.phones[i].symbol, "phone").kind)) continue;
        const auto closes = [&](std::size_t k) {
            return k < u.phones.size() &&
                   table.phone(u.phones[k].symbol, "phone").kind == speech::PhoneClass::kClosure;
        };
        if (closes(i - 1) || closes(i + 1)) continue;
        VowelCheck check{static_cast<int>(i)};
        const double from_s = u.seconds(u.phones[i].start), to_s = u.seconds(u.phones[i].end);
        for (double t = from_s; t <= to_s; t += kMouthStep_s) {
            check.planned_mm = std::max(check.planned_mm, plan.at(speech::Parameter::kGap, t));
            check.reached_mm =
                std::max(check.reached_mm, track.at(placed.start_s + t, &Mouth::gap));
        }
        out.push_back(check);
    }
    return out;
}

std::vector<ClosureChange> widened(const std::vector<VowelCheck>& checks,
                                   std::vector<ClosureChange> before) {
    for (const VowelCheck& check : checks) {
        const double missing_mm = check.planned_mm - check.reached_mm;
        if (missing_mm < kMissing_mm) continue;
        const auto known = std::find_if(before.begin(), before.end(), [&](const ClosureChange& c) {
            return c.phone == check.phone;
        });
        ClosureChange& to =
            known != before.end() ? *known : before.emplace_back(ClosureChange{check.phone});
        to.wider_mm = std::min(kWidest_mm, to.wider_mm + kWider * missing_mm);
    }
    return before;
}

std::vector<ClosureChange> usual_changes(const speech::Utterance& utterance,
                                         const speech::PhoneTable& table) {
    std::vector<ClosureChange> out;
    for (const LipClosure& closure : speech::targets_of(utterance, table).closures)
        out.push_back({.phone = closure.first_phone, .deeper_mm = kUsuallyDeeper_mm});
    return out;
}

namespace {

/// What one closure needs beyond the changes that are in force.
ClosureChange change_for(const ClosureCheck& check, const ClosureChange& before) {
    ClosureChange change;
    change.phone = check.phone;
    const double late_s = std::isnan(check.contact_s) ? kMaxEarlier_s / 2
                                                      : check.contact_s - check.closure_s,
                 early_s = check.release_s - check.closed_until_s;
    const bool too_early = early_s > kHeldTo_s;
    // Lips that meet in time and press well, but part too early, are closed for longer. Only when that was not enough, they press harder.
    const bool leaks = !check.held() && !(too_early && late_s <= kLate_s && before.shorter_s >= 0);
    if (leaks) change.deeper_mm = kDeeper * check.max_gap_mm + kDeeperAtLeast_mm;
    if (leaks || late_s > kLate_s) {
        const double over_s = std::isnan(check.contact_s) ? late_s : late_s - kLate_s / 2;
        change.earlier_s = std::clamp((leaks ? kEarlier : 1) * over_s, 0.0, kMaxEarlier_s);
    } else if (late_s < -kEarly_s && !check.from_rest) {
        // What was too much of an earlier change; it may have shut the vowel before.
        change.earlier_s = std::max(late_s + kEarly_s, -kMaxEarlier_s / 2);
    }
    if (too_early)
        change.shorter_s = -std::min(early_s, kMaxEarlier_s);
    else if (check.held() && check.open_s > check.release_s + kOpensLate_s)
        change.shorter_s =
            std::min(check.open_s - check.release_s - kOpensLate_s / 2, kMaxEarlier_s / 2);
    // Pressed harder than needed
    if (check.held() && check.max_gap_mm < kPressed_mm &&
        check.open_s > check.release_s + kOpensLate_s)
        change.deeper_mm = -kLessPressed * before.deeper_mm;
    return change;
}

}  // namespace

std::vector<ClosureChange> changes_for(const std::vector<ClosureCheck>& checks,
                                       std::vector<ClosureChange> before) {
    const auto change_of = [&](int phone) {
        return std::find_if(before.begin(), before.end(),
                            [&](const ClosureChange& c) { return c.phone == phone; });
    };
    for (const ClosureCheck& check : checks) {
        const auto known = change_of(check.phone);
        const ClosureChange change =
            change_for(check, known != before.end() ? *known : ClosureChange{});
        const bool stuck = check.held() && !(check.open_s < check.release_s + kStuck_s);
        const bool near_before = check.held() && !check.from_rest &&
                                 check.contact_s < check.closure_s - kEarly_s &&
                                 (known == before.end() || known->earlier_s <= 0);
        if (change.deeper_mm == 0 && change.earlier_s == 0 && change.shorter_s == 0 && !stuck)
            continue;
        ClosureChange& to =
            known != before.end() ? *known : before.emplace_back(ClosureChange{change.phone});
        to.deeper_mm = std::min(kDeepest_mm, to.deeper_mm + change.deeper_mm);
        to.earlier_s = std::clamp(to.earlier_s + change.earlier_s, 0.0, kEarliest_s);
        to.shorter_s = std::clamp(to.shorter_s + change.shorter_s, -kLongest_s, kShortest_s);
        if (stuck) {
            // Lips that are pressed too hard, or held on to the next closure, do not part in time.
            to.deeper_mm *= kLessDeep;
            to.shorter_s = std::max(to.shorter_s, 0.0);
        }
        if (!near_before) continue;
        const auto sound = change_of(check.phone - 1);
        double& wider_mm =
            (sound != before.end() ? *sound : before.emplace_back(ClosureChange{check.phone - 1}))
                .wider_mm;
        wider_mm = std::min(kWidestBefore_mm, wider_mm + kWiderBefore_mm);
    }
    return before;
}

namespace {

ClosureChange change_in(const std::vector<ClosureChange>& changes, int phone) {
    const auto found = std::find_if(changes.begin(), changes.end(),
                                    [&](const ClosureChange& c) { return c.phone == phone; });
    return found != changes.end() ? *found : ClosureChange{phone};
}
ClosureChange& change_in(std::vector<ClosureChange>& changes, int phone) {
    const auto found = std::find_if(changes.begin(), changes.end(),
                                    [&](const ClosureChange& c) { return c.phone == phone; });
    return found != changes.end() ? *found : changes.emplace_back(ClosureChange{phone});
}

/// By how much the lips meet or part at the wrong time, s.
double off_s(const ClosureCheck& check) {
    const double late_s = check.contact_s - check.closure_s - kLate_s,
                 early_s = check.from_rest ? 0 : check.closure_s - kEarly_s - check.contact_s,
                 open_s = check.open_s - check.release_s - kOpensLate_s;
    return std::max({0.0, late_s, early_s}) + std::max(0.0, open_s);
}

bool is_better(const ClosureCheck& one, const ClosureCheck& other) {
    if (one.held() != other.held()) return one.held();
    if (!one.held()) return one.max_gap_mm < other.max_gap_mm;
    const int one_in_time = one.opened() + one.in_time(),
              other_in_time = other.opened() + other.in_time();
    if (one_in_time != other_in_time) return one_in_time > other_in_time;
    return off_s(one) < off_s(other);
}

bool is_well(const ClosureCheck& check) {
    return check.held() && check.in_time() && check.opened();
}

/// The newest simulation counts: the sounds around a closure may have changed.
bool is_same(const ClosureChange& one, const ClosureChange& other) {
    return one.deeper_mm == other.deeper_mm && one.earlier_s == other.earlier_s &&
           one.shorter_s == other.shorter_s;
}

}  // namespace

void TriedClosures::add(const std::vector<ClosureCheck>& checks,
                        const std::vector<ClosureChange>& changes) {
    for (std::size_t i = 0; i < checks.size(); ++i) {
        Tried one{checks[i], change_in(changes, checks[i].phone),
                  change_in(changes, checks[i].phone - 1)};
        if (i == best_.size())
            best_.push_back(std::move(one));
        else if (is_better(one.check, best_[i].check) || is_same(one.change, best_[i].change))
            best_[i] = std::move(one);
    }
}

std::vector<ClosureChange> TriedClosures::next(const std::vector<ClosureCheck>& checks,
                                               const std::vector<ClosureChange>& last) const {
    std::vector<ClosureChange> out = changes_for(checks, last);
    for (std::size_t i = 0; i < checks.size() && i < best_.size(); ++i) {
        const Tried& best = best_[i];
        if (!is_well(best.check) && !is_better(best.check, checks[i])) continue;
        const ClosureChange tried = change_in(last, checks[i].phone);
        // Pressed as little as the best, it leaks, but opens in time: first it is pressed harder. Lips that part too early after ones
        // that part much too late are for a change between the two.
        const bool parts_early = checks[i].closed_until_s < checks[i].release_s - kHeldTo_s,
                   much_late = !(best.check.open_s < best.check.release_s + kOpensLate_s + kMuch_s);
        if (!is_well(best.check) && checks[i].opened() && checks[i].max_gap_mm < kSmallLeak_mm &&
            tried.deeper_mm <= best.change.deeper_mm && !(parts_early && much_late))
            continue;
        ClosureChange& to = change_in(out, checks[i].phone);
        const auto between = [&](double ClosureChange::*value) {
            to.*value =
                is_well(best.check) ? best.change.*value : (best.change.*value + tried.*value) / 2;
        };
        between(&ClosureChange::deeper_mm);
        between(&ClosureChange::earlier_s);
        between(&ClosureChange::shorter_s);
    }
    return out;
}

std::vector<ClosureChange> TriedClosures::best() const {
    std::vector<ClosureChange> out;
    for (const Tried& tried : best_) {
        out.push_back(tried.change);
        if (tried.before.wider_mm > 0) out.push_back(tried.before);
    }
    return out;
}

std::string speech_table(const MouthTrack& track, const std::vector<PlacedUtterance>& utterances,
                         const speech::PhoneTable& table) {
    std::string out =
        "start_s\tend_s\tsymbol\tword\tstress\tstart_sample\tend_sample\tclosure_s\trelease_s\t"
        "contact_s\topen_s\tmax_gap_mm\tleast_gap_mm\ttarget_gap_mm\twidth_mm\ttarget_width_mm\t"
        "upper_protrusion_mm\tlower_protrusion_mm\ttarget_protrusion_mm\tteeth_mm\t"
        "peak_closing_mm_s\tpeak_opening_mm_s\tbound\n";
    for (const PlacedUtterance& placed : utterances) {
        const std::vector<ClosureCheck> checks = check_closures(track, placed);
        const speech::Utterance& u = placed.utterance;
        for (std::size_t i = 0; i < u.phones.size(); ++i) {
            const speech::Phone& phone = u.phones[i];
            if (phone.is_pause()) continue;
            const double from_s = placed.start_s + u.seconds(phone.start),
                         to_s = placed.start_s + u.seconds(phone.end),
                         middle_s = (from_s + to_s) / 2;
            const auto check = std::find_if(checks.begin(), checks.end(), [&](const auto& c) {
                return c.phone == static_cast<int>(i);
            });
            double max_gap = 0, least = 1e9, closing = 0, opening = 0;
            for (double t = from_s; t <= to_s; t += kMouthStep_s) {
                const double gap = track.at(t, &Mouth::gap);
                const double speed = (track.at(t + kMouthStep_s, &Mouth::gap) - gap) / kMouthStep_s;
                max_gap = std::max(max_gap, gap);
                least = std::min(least, gap);
                closing = std::max(closing, -speed);
                opening = std::max(opening, speed);
            }
            const int word = u.word_at((phone.start + phone.end) / 2);
            const speech::Articulation target = table.phone(phone.symbol, "phone").target;
            char begin[80];
            std::snprintf(begin, sizeof begin, "%.6f\t%.6f\t", from_s, to_s);
            out += begin + phone.text() + "\t" +
                   (word < 0 ? "" : u.words[static_cast<std::size_t>(word)].text) + "\t" +
                   std::to_string(phone.stress) + "\t" + std::to_string(phone.start) + "\t" +
                   std::to_string(phone.end);
            const auto moment = [&](const std::optional<std::int64_t>& sample) {
                return sample ? placed.start_s + u.seconds(*sample) : kNone;
            };
            out += cell(moment(phone.closure), 6) + cell(moment(phone.release), 6);
            const bool known = check != checks.end();
            out +=
                cell(known ? check->contact_s : kNone, 3) + cell(known ? check->open_s : kNone, 3);
            out += cell(max_gap, 3) + cell(least, 3);
            out += cell(value_of(target, speech::Parameter::kGap), 2);
            out += cell(track.at(middle_s, &Mouth::width), 3) +
                   cell(value_of(target, speech::Parameter::kWidth), 2);
            out += cell(track.at(middle_s, &Mouth::upper_protrusion), 3) +
                   cell(track.at(middle_s, &Mouth::lower_protrusion), 3) +
                   cell(value_of(target, speech::Parameter::kProtrusion), 2);
            out += cell(track.at(middle_s, &Mouth::teeth), 3) + cell(closing, 1) + cell(opening, 1);
            out += "\t" +
                   std::string(!known             ? ""
                               : check->held()    ? "held"
                               : check->reached() ? "reached"
                                                  : "open") +
                   "\n";
        }
    }
    return out;
}

}  // namespace risorius::talk
