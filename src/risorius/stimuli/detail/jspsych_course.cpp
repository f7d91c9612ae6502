// SPDX-License-Identifier: MIT
// The text of index.html: the trials of an experiment in a browser.
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace {

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
    let first_ms = null, dot = null, right = null;
    const add = (data, more) => Object.assign(data, {kind: which().kind, block: which().block, repeated}, more);
    const told = (data, key, after_ms) => {
        answerOf(data, key, clip());
        right = clip().correct_key ? data.correct : null;
        data.response_time_s = after_ms === null ? null : after_ms / 1000;
    };
    const film = shown(clip, [...(settings.answer_during ? keys : []), ...(settings.catch ? [' '] : [])], {
        on_start: () => {
            during = right = null;
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
                setTimeout(() => one.remove(), 200);
            }, at_ms, dot);
        },
        on_finish: (data, its) => {
            add(data, {});
            first_ms = data.first_frame_ms;
            if (data.flag && !repeated && which().kind === 'trial') missed.push(which());
            const pressed = data.response;
            if (which().kind === 'catch') {
                during = pressed === ' ' ? pressed : null;
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
            add(data, {correct: data.response === ' '});
            if (data.correct && first_ms !== null) data.response_time_s = (loaded_ms + data.rt - first_ms) / 1000;
        },
    }], conditional_function: () => which().kind === 'catch' && !during};
    const feedback = {timeline: [{
        type: jsPsychHtmlKeyboardResponse, stimulus: () => right ? '<p>Right</p>' : '<p>Wrong</p>', choices: 'NO_KEYS',
        trial_duration: 800,
    }], conditional_function: () => which().kind === 'practice' && right !== null};
    return {timeline: [fixation, film, question, late, feedback]};
}

// The order: practice, then blocks of equal length. Trials with a dot to be reported are dealt among the others.
const slots = jsPsych.randomization.repeat(conditions, settings.repetitions).map((clip) => ({clip, kind: 'trial'}));
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

// The answers, and the events as BIDS has them
function filesOfRun() {
    const rows = jsPsych.data.get().values(), names = ['onset', 'duration', 'trial_type', 'response_time', 'stimulus_id',
        'stim_file', 'trial', 'block', 'kind', 'answer', 'correct'];
    const lines = [names.join('\t')], plain = (text) => String(text).replace(/[^A-Za-z0-9]/g, '');
    const cell = (value) => value === undefined || value === null ? 'n/a' : String(value);
    rows.forEach((row, at) => {
        if (row.task !== 'clip' || row.first_frame_ms === null) return;
        const next = rows[at + 1] || {}, told = ['answer', 'catch'].includes(next.task) ? next : row;
        lines.push([((row.first_frame_ms - begun_ms) / 1000).toFixed(4),
            row.shown_s !== undefined ? row.shown_s : (row.frames / row.fps).toFixed(4),
            [row.set, row.control].filter(Boolean).join(' '),
            Number.isFinite(told.response_time_s) ? told.response_time_s.toFixed(4) : 'n/a', `stim-${row.stim_id}`,
            row.stim_file, lines.length - 1, row.block, row.kind, cell(told.answer), told.correct === undefined ? 'n/a' : Number(told.correct)].join('\t'));
    });
    const stem = `sub-${plain(participant) || '0'}_task-${plain(settings.name) || 'clips'}_run-1`;
    return [[`data-${participant || 'participant'}.csv`, 'text/csv', jsPsych.data.get().csv()],
        [`${stem}_events.tsv`, 'text/tab-separated-values', lines.join('\n') + '\n']];
}
jsPsych.run(timeline);
)js";

}  // namespace

const char* jspsych_course() { return kBrowserCourse; }

}  // namespace risorius::stimuli
