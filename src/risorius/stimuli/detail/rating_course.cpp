// SPDX-License-Identifier: MIT
// The text of rating.html: every clip is seen and judged once.
#include "risorius/stimuli/detail/experiment_programs.h"

namespace risorius::stimuli {

namespace {

const char* const kRatingCourse = R"js(
// Ends of the scales, 1 to 9
const ends = {valence: ['unpleasant', 'pleasant'], arousal: ['calm', 'aroused'], intensity: ['weak', 'strong'],
    naturalness: ['artificial', 'natural']};
const style = document.createElement('style');
style.textContent = 'fieldset { border: 0; margin: 1em auto; max-width: 40em } label { display: inline-block; margin: 0 .7em } ' +
    '.scale { display: flex; justify-content: center; align-items: center } .scale span { width: 7em } ' +
    '.scale label { margin: 0 .3em } .scale input { display: block; margin: auto }';
document.head.append(style);
const choice = (name, value, text) =>
    `<label><input type="radio" name="${escaped(name)}" value="${escaped(value)}" required> ${escaped(text)}</label>`;
const question = settings.answers.length < 2 ? ''
    : `<fieldset><legend>${escaped(settings.question)}</legend>` +
        settings.answers.map((one) => choice('answer', one.answer, one.answer)).join('') + '</fieldset>';
const scales = settings.scales.map((name) => `<fieldset><legend>${escaped(name[0].toUpperCase() + name.slice(1))}</legend>` +
    `<div class="scale"><span>${ends[name][0]}</span>` +
    [1, 2, 3, 4, 5, 6, 7, 8, 9].map((value) => choice(name, value, value)).join('') +
    `<span>${ends[name][1]}</span></div></fieldset>`).join('');
const wait = {type: jsPsychHtmlKeyboardResponse, choices: 'ALL_KEYS', on_load: offerUnsaved,
    stimulus: `<p>You will see ${conditions.length} clips. Please judge each of them right after you have seen it.</p>` +
        '<p>Press any key to begin.</p><div id="left"></div>'};
const fixation = {type: jsPsychHtmlKeyboardResponse, stimulus: '<p style="font-size: 48px">+</p>',
    choices: 'NO_KEYS', trial_duration: 1000 * settings.fixation_s};

const timeline = [preload, wait];
const order = jsPsych.randomization.shuffle(conditions);
order.forEach((clip, number) => {
    timeline.push(fixation, shown(() => clip, [], {}), {
        type: jsPsychSurveyHtmlForm, button_label: 'Next',
        html: `<p>${number + 1} of ${order.length}</p>${question}${scales}`,
        data: {task: 'rating', stimulus_id: `stim-${clip.stim_id}`},
        on_finish: (data) => Object.assign(data, data.response),
    });
});

// A table as `risorius batch` takes it with norms: one row for each clip
function filesOfRun() {
    const names = ['participant', 'stimulus_id', ...(question ? ['answer'] : []), ...settings.scales, 'flag', 'rt'];
    const cell = (text) => /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
    const values = jsPsych.data.get().values(), lines = [names.join(',')];
    values.forEach((row, at) => {
        if (row.task !== 'rating') return;
        const whole = {...row, flag: values[at - 1].flag, participant: participant || 'participant'};
        lines.push(names.map((name) => cell(whole[name] === undefined || whole[name] === null ? '' : String(whole[name])))
            .join(','));
    });
    return [[`ratings-${participant || 'participant'}.csv`, 'text/csv', lines.join('\n') + '\n']];
}
jsPsych.run(timeline);
)js";

}  // namespace

const char* rating_course() { return kRatingCourse; }

}  // namespace risorius::stimuli
