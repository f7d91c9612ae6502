// SPDX-License-Identifier: MIT
// The text of index.html: the trials of an experiment in a browser.
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace {

/// QUEST+ (Watson 2017), the same as in psychopy_course.cpp.
const char* const kBrowserQuest = R"js(
// QUEST+ (Watson 2017, Journal of Vision 17(3), 10): threshold, slope and lapses of a Weibull function are unknown. Each trial shows the
// level, among those that there are, after whose answer least is expected to remain unknown. Levels are in log10.
class QuestPlus {
    constructor(levels, trials, guess) {
        const RIGHT = 0.82, low = levels[0] - 0.3, high = levels[levels.length - 1] + 0.3;
        const steps = Math.max(20, Math.round((high - low) / 0.025)), states = [];
        for (let step = 0; step <= steps; ++step)
            for (const slope of [1, 1.5, 2, 3, 4.5, 7, 10])
                for (const lapse of [0, 0.02, 0.05]) states.push({middle: low + (high - low) * step / steps, slope, lapse});
        Object.assign(this, {levels, trials, states, told: 0});
        this.right = levels.map((level) => states.map(({middle, slope, lapse}) =>
            1 - lapse - (1 - guess - lapse) * Math.exp(-(10 ** (slope * (level - middle))))));
        this.atRight = states.map(({middle, slope, lapse}) =>
            middle + Math.log10(-Math.log((1 - lapse - RIGHT) / (1 - guess - lapse))) / slope);
        this.belief = states.map(() => 1 / states.length);
    }
    unknownAfter(right) {
        let out = 0;
        for (const wanted of [true, false]) {
            let all = 0, sum = 0;
            right.forEach((share, at) => {
                const both = (wanted ? share : 1 - share) * this.belief[at];
                all += both;
                if (both > 0) sum += both * Math.log(both);
            });
            out += all * Math.log(all) - sum;
        }
        return out;
    }
    next() {
        const unknown = this.right.map((right) => this.unknownAfter(right));
        return this.levels[unknown.indexOf(Math.min(...unknown))];
    }
    answered(isRight, level) {
        const right = this.right[this.levels.indexOf(level)];
        const belief = this.belief.map((one, at) => one * (isRight ? right[at] : 1 - right[at]));
        const all = belief.reduce((sum, one) => sum + one, 0);
        this.belief = belief.map((one) => one / all);
        ++this.told;
    }
    mean(values) {
        return values.reduce((sum, value, at) => sum + value * this.belief[at], 0);
    }
    result(series) {
        const middle = this.mean(this.atRight);
        return {series, method: 'questplus', trials: this.told, threshold: (10 ** middle).toFixed(4),
            sd_log10: Math.sqrt(this.mean(this.atRight.map((one) => (one - middle) ** 2))).toFixed(4),
            slope: this.mean(this.states.map((one) => one.slope)).toFixed(3),
            lapse: this.mean(this.states.map((one) => one.lapse)).toFixed(3)};
    }
}
)js";

const char* const kBrowserCourse = R"js(
const said = settings.answers.map((one) => `<kbd>${escaped(one.key)}</kbd> ${escaped(one.answer)}`).join(' &nbsp; ');
const keys = settings.answers.map((one) => one.key);
const catchText = settings.catch ? '<p>Press the <b>space bar</b> as soon as you see a red dot.</p>' : '';
let begun_ms = 0;  // of the run
const wait = {type: jsPsychHtmlKeyboardResponse, choices: 'ALL_KEYS',
    stimulus: `<p>${escaped(settings.question)}</p><p>${said}</p>${catchText}<p>Press any key to begin.</p><div id="left"></div>`,
    on_load: offerUnsaved, on_finish: () => {
        begun_ms = performance.now();
    }};
const fixation = {type: jsPsychHtmlKeyboardResponse, stimulus: '<p style="font-size: 48px">+</p>',
    choices: 'NO_KEYS', trial_duration: 1000 * settings.fixation_s};

// The codes of a clip as ../triggers.tsv has them, and 6 for an answer, each with its time from the first frame. Nothing is sent: a browser
// reaches no port.
function codesOf(clip, response_s, kind) {
    const out = clip.codes.map(([code, at_s]) => [code, at_s]);
    if (settings.response && response_s !== null && kind !== 'catch') out.push([6, response_s]);
    return out.map(([code, at_s]) => `${code}@${at_s.toFixed(4)}`).join(' ');
}

// Thresholds: a series of clips has its own, and QUEST+ chooses the clip of each of its trials.
const series = {};
if (settings.method === 'questplus') {
    for (const clip of conditions)
        if (clip.level) (series[clip.series] = series[clip.series] || {clips: []}).clips.push(clip);
    for (const one of Object.values(series)) {
        const levels = [...new Set(one.clips.map((clip) => Math.log10(clip.level)))].sort((a, b) => a - b);
        one.quest = new QuestPlus(levels, settings.trials, 1 / settings.answers.length);
    }
}
function choose(slot) {
    if (slot.series === undefined || slot.clip) return true;
    const {quest, clips} = series[slot.series], asked = quest.next();
    slot.clip = jsPsych.randomization.sampleWithoutReplacement(
        clips.filter((clip) => Math.abs(Math.log10(clip.level) - asked) <= 0.03), 1)[0];
    return true;
}
function answered(slot, isRight) {
    if (slot.series !== undefined) series[slot.series].quest.answered(isRight, Math.log10(slot.clip.level));
}

let during = null;  // the key pressed while the clip was shown
const missed = [];  // trials of which the browser showed too few frames: they come once more at the end
function answerOf(data, key, clip) {
    const one = settings.answers.find((answer) => answer.key === key);
    data.answer = one ? one.answer : null;
    if (clip.correct_key) data.correct = key === clip.correct_key;
}
// One trial. `which` gives its slot: the clip, the kind of the trial and its block.
function trialOf(which, repeated) {
    const clip = () => which().clip;
    let first_ms = null, dot = null, dot_ms = null, right = null, flagged = false;
    const add = (data, more) => Object.assign(data, {kind: which().kind, block: which().block, repeated, run: runNumber}, more);
    const told = (data, key, after_ms) => {
        answerOf(data, key, clip());
        right = clip().correct_key ? data.correct : null;
        data.response_time_s = after_ms === null ? null : after_ms / 1000;
        data.codes = codesOf(clip(), data.response_time_s, which().kind);
        if (!flagged) answered(which(), data.correct === true);
    };
    const film = shown(clip, [...(settings.answer_during ? keys : []), ...(settings.catch ? [' '] : [])], {
        on_start: () => {
            during = right = dot_ms = null;
        },
        on_load: (its) => {
            if (which().kind !== 'catch') return;
            const length_ms = 1000 * (its.shown_s !== undefined ? its.shown_s : its.frames / its.fps);
            dot = document.createElement('div');
            dot.className = 'dot';
            dot.style = 'position: fixed; left: calc(50% - 12px); top: calc(50% - 12px); width: 24px; height: 24px; ' +
                'border-radius: 50%; background: red; visibility: hidden';
            document.body.append(dot);
            const at_ms = length_ms * (0.2 + 0.6 * Math.random());
            setTimeout((one) => {
                one.style.visibility = 'visible';
                dot_ms = performance.now();
                setTimeout(() => one.remove(), 200);
            }, at_ms, dot);
        },
        on_finish: (data, its) => {
            add(data, {});
            first_ms = data.first_frame_ms;
            flagged = Boolean(data.flag) && !repeated && which().kind === 'trial';
            if (flagged) missed.push(which());
            const pressed = data.response;
            data.codes = codesOf(its, null, which().kind);
            if (settings.catch) data.false_alarm = Number(pressed === ' ' && (dot_ms === null || data.pressed_ms < dot_ms));
            if (which().kind === 'catch') {
                during = pressed === ' ' && !data.false_alarm ? pressed : null;
                data.correct = during !== null;
                if (during) data.response_time_s = data.rt_from_first_frame / 1000;
            } else if (settings.answer_during && pressed && pressed !== ' ') {
                during = pressed;
                told(data, during, data.rt_from_first_frame === undefined ? null : data.rt_from_first_frame);
            }
        },
    });
    let loaded_ms = 0;
    const question = {timeline: [{
        type: jsPsychHtmlKeyboardResponse, stimulus: `<p>${escaped(settings.question)}</p><p>${said}</p>`,
        choices: keys, data: () => ({...clip(), task: 'answer'}),
        on_load: () => {
            loaded_ms = performance.now();
        },
        on_finish: (data) => {
            add(data, {});
            told(data, data.response, first_ms === null ? null : loaded_ms + data.rt - first_ms);
        },
    }], conditional_function: () => !during && which().kind !== 'catch'};
    const late = {timeline: [{
        type: jsPsychHtmlKeyboardResponse, stimulus: '', choices: [' '], trial_duration: 1000,
        data: () => ({...clip(), task: 'catch'}),
        on_load: () => {
            loaded_ms = performance.now();
        },
        on_finish: (data) => {
            add(data, {correct: data.response === ' ', codes: codesOf(clip(), null, 'catch')});
            if (data.correct && first_ms !== null) data.response_time_s = (loaded_ms + data.rt - first_ms) / 1000;
        },
    }], conditional_function: () => which().kind === 'catch' && !during};
    const feedback = {timeline: [{
        type: jsPsychHtmlKeyboardResponse, stimulus: () => right ? '<p>Right</p>' : '<p>Wrong</p>', choices: 'NO_KEYS',
        trial_duration: 800,
    }], conditional_function: () => which().kind === 'practice' && right !== null};
    return {timeline: [fixation, film, question, late, feedback], conditional_function: () => choose(which())};
}

// The order: practice, then blocks of equal length. Trials with a dot to be reported are dealt among the others.
const slots = settings.method === 'questplus'
    ? Object.keys(series).flatMap((name) => Array.from({length: settings.trials}, () => ({series: name, kind: 'trial'})))
    : jsPsych.randomization.repeat(conditions, settings.repetitions).map((clip) => ({clip, kind: 'trial'}));
const drawn = (count) => {
    const out = [];
    while (out.length < count) out.push(...jsPsych.randomization.shuffle(conditions));
    return out.slice(0, count);
};
slots.push(...drawn(Math.round(settings.catch * slots.length)).map((clip) => ({clip, kind: 'catch'})));
const order = jsPsych.randomization.shuffle(slots);
order.forEach((slot, number) => {
    slot.block = 1 + Math.floor(number * settings.blocks / order.length);
});
order.unshift(...drawn(settings.practice).map((clip) => ({clip, kind: 'practice', block: 0})));
const pause = (text) => ({type: jsPsychHtmlKeyboardResponse, choices: 'ALL_KEYS', data: {task: 'pause'},
    stimulus: `<p>${text}</p><p>Press any key to go on.</p>`});
const timeline = [preload, wait];
order.forEach((slot, number) => {
    const before = number ? order[number - 1].block : slot.block;
    if (before !== slot.block)
        timeline.push(pause(before ? `Block ${before} of ${settings.blocks} is over.` : 'The practice is over.'));
    timeline.push(trialOf(() => slot, false));
});
let current = null;
const next = () => {
    current = missed.shift();
    return current !== undefined;
};
timeline.push({timeline: [trialOf(() => current, true)], conditional_function: next, loop_function: next});

// How the red dots were answered
function dotsOf(rows) {
    const film = rows.filter((row) => row.task === 'clip' && row.kind !== 'practice');
    return {catch_trials: film.filter((row) => row.kind === 'catch').length,
        hits: rows.filter((row) => row.kind === 'catch' && row.correct === true).length,
        other_trials: film.filter((row) => row.kind === 'trial').length,
        false_alarms: film.filter((row) => row.false_alarm === 1).length};
}
// The answers, and the events as BIDS has them
function filesOfRun() {
    const rows = jsPsych.data.get().values(), names = ['onset', 'duration', 'trial_type', 'response_time', 'stimulus_id',
        'stim_file', 'trial', 'block', 'kind', 'answer', 'correct', 'false_alarm'];
    const lines = [names.join('\t')], plain = (text) => String(text).replace(/[^A-Za-z0-9]/g, '');
    const cell = (value) => value === undefined || value === null ? 'n/a' : String(value);
    rows.forEach((row, at) => {
        if (row.task !== 'clip' || row.first_frame_ms === null) return;
        const next = rows[at + 1] || {}, told = ['answer', 'catch'].includes(next.task) ? next : row;
        lines.push([((row.first_frame_ms - begun_ms) / 1000).toFixed(4),
            row.shown_s !== undefined ? row.shown_s : (row.frames / row.fps).toFixed(4),
            [row.set, row.control].filter(Boolean).join(' '),
            Number.isFinite(told.response_time_s) ? told.response_time_s.toFixed(4) : 'n/a', `stim-${row.stim_id}`,
            row.stim_file, lines.length - 1, row.block, row.kind, cell(told.answer), told.correct === undefined ? 'n/a' : Number(told.correct), cell(row.false_alarm)].join('\t'));
    });
    const stem = `sub-${plain(participant) || '0'}_task-${plain(settings.name) || 'clips'}_run-${runNumber}`;
    const table = (rows) => [Object.keys(rows[0]), ...rows.map(Object.values)].map((cells) => cells.join(',')).join('\n') + '\n';
    const out = [[`data-${participant || 'participant'}.csv`, 'text/csv', jsPsych.data.get().csv()],
        [`${stem}_events.tsv`, 'text/tab-separated-values', lines.join('\n') + '\n']];
    if (settings.method === 'questplus')
        out.push([`${stem}_thresholds.csv`, 'text/csv',
            table(Object.entries(series).map(([name, one]) => ({...one.quest.result(name), series: `"${name.replace(/"/g, '""')}"`})))]);
    if (settings.catch) out.push([`${stem}_catch.csv`, 'text/csv', table([dotsOf(rows)])]);
    return out;
}
jsPsych.run(timeline);
)js";

}  // namespace

const char* jspsych_course() {
    static const std::string text = std::string(kBrowserQuest) + kBrowserCourse;
    return text.c_str();
}

}  // namespace risorius::stimuli
