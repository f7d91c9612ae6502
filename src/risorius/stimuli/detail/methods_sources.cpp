// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/methods_sources.h"

#include <algorithm>
#include <map>
#include <vector>

#include "risorius/core/json_text.h"

namespace risorius::stimuli {

namespace {

using design::Control;
using design::ControlKind;
using Method = design::ExperimentOptions::Method;

std::string pass_words(const Control& control) {
    const bool band = control.kind == ControlKind::kBandPass;
    const std::string kept = band ? "between " + format_number(control.cycles_per_face) + " and " +
                                        format_number(control.upper_cycles_per_face)
                                  : (control.kind == ControlKind::kLowPass ? "below " : "above ") +
                                        format_number(control.cycles_per_face);
    return "only spatial frequencies " + kept +
           " cycles per face (width between the zygia in the first frame) remained, by a "
           "Butterworth "
           "filter of order " +
           std::to_string(control.order) +
           " in linear light within the soft oval of the face, -3 dB at the " +
           (band ? "ends" : "limit") + " (as face perception is studied, Costen et al., 1996); " +
           (control.keep_contrast ? "the standard deviation of luminance was restored"
                                  : "the contrast is that which the filter leaves");
}

std::string speed_words(const Control& control) {
    const std::string law = control.speed == design::Speed::kConstant ? "in proportion to time"
                            : control.speed == design::Speed::kAccelerated
                                ? "with the square of time"
                                : "as 1 - (1 - t)^2 of the time t";
    return "the movement had the same onset and apex, but between them the seen share of its way "
           "rose " +
           law + "; frames came from a film with more frames per second";
}

std::string chimeric_words(const Control& control) {
    std::string out =
        "the upper half of the condition stood over the lower half of another one (" +
        control.name() +
        "), joined half-way between nasion and subnasale over 4 % of the width of the face, as in "
        "Calder et al. (2000)";
    if (control.offset != 0)
        out += "; the lower half was shifted aside by " + format_number(control.offset) +
               " widths of the face";
    return out + "; what is seen of each half is in `seen_upper_share` and `seen_lower_share`";
}

/// What a control shows; empty for those whose name says it.
std::string sentence_of(const Control& control, bool picture) {
    switch (control.kind) {
        case ControlKind::kLowPass:
        case ControlKind::kHighPass:
        case ControlKind::kBandPass:
            return pass_words(control);
        case ControlKind::kSpeed:
            return speed_words(control);
        case ControlKind::kChimeric:
            return chimeric_words(control);
        case ControlKind::kOval:
            return "only the oval of the face with a soft rim of 8 % of its width was shown; hair, "
                   "ears "
                   "and neck became background";
        case ControlKind::kNoise:
            return std::string(
                       "Gaussian noise of luminance lay over the oval, another one in each ") +
                   (picture ? "picture" : "frame") + ", at a signal-to-noise ratio of " +
                   format_number(control.snr_db) +
                   " dB; the standard deviation of luminance stayed";
        case ControlKind::kPhaseScrambled:
            return "within the oval each spatial frequency got a random phase, the same in all "
                   "frames "
                   "and channels, in linear light; amplitudes in octaves, mean and standard "
                   "deviation "
                   "of luminance stayed";
        case ControlKind::kMondrian:
            return format_number(control.rate_hz) +
                   " random patterns of rectangles per second, with mean and standard deviation of "
                   "luminance of the face";
        case ControlKind::kPointLight:
            return std::to_string(control.dots) + " white dots " +
                   (picture ? "stood where landmarks of the face are"
                            : "moved as landmarks of the face do") +
                   (control.scattered ? ", each from a random place" : "");
        case ControlKind::kKnockOut:
            return "the same script in a face without " + control.muscle;
        case ControlKind::kPalsy:
            return "the " + control.side + " half of the face had lost " +
                   format_number(100 * control.weakness) + " % of its strength";
        case ControlKind::kLateSide:
            return "the " + control.side + " half of the face moved " +
                   format_number(control.late_s) + " s later";
        default:
            return {};
    }
}

bool has_control(const BatchPlan& plan, bool (*wanted)(const Control&)) {
    return std::any_of(plan.clips.begin(), plan.clips.end(), [&](const ClipPlan& clip) {
        return clip.is_control() && wanted(clip.condition.control);
    });
}

bool has_method(const BatchPlan& plan, Method method) {
    return plan.experiment && plan.experiment->method == method;
}

constexpr const char* kShinePaper = R"(@article{willenbockel2010,
  author = {Willenbockel, V. and Sadr, J. and Fiset, D. and Horne, G. O. and Gosselin, F. and Tanaka, J. W.},
  title = {Controlling low-level image properties: The {SHINE} toolbox},
  journal = {Behavior Research Methods}, year = {2010}, volume = {42}, number = {3}, pages = {671--684}}
)";
constexpr const char* kGrammarPaper = R"(@article{yu2012,
  author = {Yu, H. and Garrod, O. G. B. and Schyns, P. G.},
  title = {Perception-driven facial expression synthesis},
  journal = {Computers \& Graphics}, year = {2012}, volume = {36}, number = {3}, pages = {152--162}}
)";
constexpr const char* kChimeraPaper = R"(@article{calder2000,
  author = {Calder, A. J. and Young, A. W. and Keane, J. and Dean, M.},
  title = {Configural information in facial expression perception},
  journal = {Journal of Experimental Psychology: Human Perception and Performance},
  year = {2000}, volume = {26}, number = {2}, pages = {527--551}}
)";
constexpr const char* kFilterPaper = R"(@article{costen1996,
  author = {Costen, N. P. and Parker, D. M. and Craw, I.},
  title = {Effects of high-pass and low-pass spatial filtering on face identification},
  journal = {Perception \& Psychophysics}, year = {1996}, volume = {58}, number = {4}, pages = {602--612}}
)";
constexpr const char* kStaircasePaper = R"(@article{levitt1971,
  author = {Levitt, H.},
  title = {Transformed up-down methods in psychoacoustics},
  journal = {Journal of the Acoustical Society of America},
  year = {1971}, volume = {49}, number = {2B}, pages = {467--477}}
)";
constexpr const char* kQuestPaper = R"(@article{watson1983,
  author = {Watson, A. B. and Pelli, D. G.},
  title = {{QUEST}: A {B}ayesian adaptive psychometric method},
  journal = {Perception \& Psychophysics}, year = {1983}, volume = {33}, number = {2}, pages = {113--120}}
)";
constexpr const char* kQuestPlusPaper = R"(@article{watson2017,
  author = {Watson, A. B.},
  title = {{QUEST+}: A general multidimensional {B}ayesian adaptive psychometric method},
  journal = {Journal of Vision}, year = {2017}, volume = {17}, number = {3}, pages = {10}}
)";

}  // namespace

std::string controls_text(const BatchPlan& plan) {
    std::vector<std::string> order;
    std::map<std::string, int> count;
    for (const ClipPlan& clip : plan.clips) {
        if (!clip.is_control()) continue;
        const Control& control = clip.condition.control;
        const std::string name =
            design::control_names()[static_cast<std::size_t>(control.kind) - 1];
        const std::string text = sentence_of(control, clip.clips.pictures());
        const std::string line = "`" + name + "`" + (text.empty() ? "" : ": " + text);
        if (++count[line] == 1) order.push_back(line);
    }
    std::string out;
    for (const std::string& line : order)
        out += "- " + std::to_string(count[line]) + (count[line] == 1 ? " clip " : " clips ") +
               line + ".\n";
    return out.empty() ? out : "Controls:\n\n" + out;
}

std::string course_text(const BatchPlan& plan) {
    const design::ExperimentOptions& experiment = *plan.experiment;
    if (experiment.method == Method::kConstant)
        return "Each clip was shown " +
               (experiment.repetitions == 1 ? std::string("once")
                                            : std::to_string(experiment.repetitions) + " times") +
               " in random order";
    const std::string by =
        experiment.method == Method::kStaircase ? "a staircase (three right answers down, one "
                                                  "wrong answer up, 79 % right; Levitt, 1971)"
        : experiment.method == Method::kQuest
            ? "QUEST (82 % right, slope of the Weibull function 3.5; Watson and Pelli, 1983)"
            : "QUEST+ (threshold at 82 % right, slope and lapses of the Weibull function unknown; "
              "Watson, 2017)";
    return std::to_string(experiment.trials) + " trials of each threshold were chosen by " + by +
           " over `" + experiment.over + "`";
}

std::string sources_text(const BatchPlan& plan) {
    std::string out;
    const auto add = [&](bool wanted, const char* paper) {
        if (wanted) out += paper;
    };
    add(plan.match.luminance && plan.match.luminance->has_maps(), kShinePaper);
    add(!plan.samples.empty(), kGrammarPaper);
    add(has_control(plan, [](const Control& one) { return one.kind == ControlKind::kChimeric; }),
        kChimeraPaper);
    add(has_control(plan, [](const Control& one) { return one.passes(); }), kFilterPaper);
    add(has_method(plan, Method::kStaircase), kStaircasePaper);
    add(has_method(plan, Method::kQuest), kQuestPaper);
    add(has_method(plan, Method::kQuestPlus), kQuestPlusPaper);
    return out;
}

}  // namespace risorius::stimuli
