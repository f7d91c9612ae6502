// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/experiment_programs.h"

#include <array>

#include "risorius/report/html_writer.h"

namespace risorius::stimuli {

namespace {

/// A published file of jsPsych, and the hash by which a browser checks it.
struct PublishedFile {
    const char* package;
    const char* version;
    const char* file;
    const char* integrity;
};
constexpr std::array<PublishedFile, 5> kJsPsych{{
    {"jspsych", "8.2.3", "css/jspsych.css",
     "sha384-JNNpz6XWsC9uPPHlCuf9rr6LrSD2uYvbkApP5kAp6g/lFBue51K1kMzxGawS50nK"},
    {"jspsych", "8.2.3", "dist/index.browser.min.js",
     "sha384-rSMOcLayYRCXgf6ExTgyY+tTIgmnwYS8gZvBHBnKEesX9CWsOIpI8vAvCHllhsAE"},
    {"@jspsych/plugin-html-keyboard-response", "2.1.0", "dist/index.browser.min.js",
     "sha384-JyKpJgu7DU4Cgu1+TTOMRxkNWsYCT5ENOipB9fwXibgV4+N2XZXtlfyjbkMv8Hgp"},
    {"@jspsych/plugin-video-keyboard-response", "2.1.1", "dist/index.browser.min.js",
     "sha384-2EmyERJMIl3pISnjhXDJphPAi4VxAMjimEoWvObgiqe9cw43o4eheWPvsmu+XxyT"},
    {"@jspsych/plugin-preload", "2.1.0", "dist/index.browser.min.js",
     "sha384-BiUYHx4tdTYToceth936qf4Wkf+Ho2VZti/5bB5/nDiPRuTaZ37hrxkLsANkHGdp"},
}};

/// Loads from a URL with version and hash, or from a folder of installed packages.
std::string load(const PublishedFile& one, const std::string& from) {
    const bool remote = from.rfind("https://", 0) == 0 || from.rfind("http://", 0) == 0;
    const std::string address = report::html_escaped(
        from + "/" + one.package + (remote ? "@" + std::string(one.version) : std::string()) + "/" +
        one.file);
    const std::string guard =
        remote ? " integrity=\"" + std::string(one.integrity) + "\" crossorigin=\"anonymous\""
               : std::string();
    if (std::string(one.file).ends_with(".css"))
        return "<link rel=\"stylesheet\" href=\"" + address + "\"" + guard + ">\n";
    return "<script src=\"" + address + "\"" + guard + "></script>\n";
}

/// JSON for a script element, escaped so that it cannot end the element.
std::string within_script(std::string json) {
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;)
        json.replace(at, 1, "\\u003c");
    return json;
}

const char* const kPage = R"js(
'use strict';
// An example to start from. The address may say ?participant=7, ?seed=1 for an order that can be had again, and ?save=URL:
// the data are sent there as JSON when all is done, and offered as a file when that fails or no address is given.
// Every trial is also kept in the browser (IndexedDB) at once, and stays there until the data have been saved.
const asked = new URLSearchParams(location.search);
const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const participant = asked.get('participant') || '';
document.body.style.background = settings.background;

// What is kept: a list of trials for each run, by the time of its start
const run = `${settings.name} ${participant} ${new Date().toISOString()}`;
const kept = new Promise((resolve) => {
    const request = indexedDB.open('risorius', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('runs');
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => resolve(null);
}).catch(() => null);
async function inStore(mode, use) {
    const store = await kept;
    if (!store) return null;
    return new Promise((resolve) => {
        const transaction = store.transaction('runs', mode);
        const request = use(transaction.objectStore('runs'));
        transaction.oncomplete = () => resolve(request.result);
        transaction.onabort = transaction.onerror = () => resolve(null);
    });
}
const trials = [];
let keeping = Promise.resolve();
function keep(trial) {
    trials.push(trial);
    const text = JSON.stringify(trials);
    keeping = keeping.then(() => inStore('readwrite', (runs) => runs.put(text, run))).catch(() => null);
}
function offer(name, type, text) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], {type}));
    link.download = name;
    link.textContent = name;
    link.click();
    return link;
}

const jsPsych = initJsPsych({on_finish: finish, on_data_update: keep});
if (asked.has('seed')) jsPsych.randomization.setSeed(asked.get('seed'));
jsPsych.data.addProperties({participant});

const said = settings.answers.map((one) => `<kbd>${escaped(one.key)}</kbd> ${escaped(one.answer)}`).join(' &nbsp; ');
const keys = settings.answers.map((one) => one.key);
const wait = {type: jsPsychHtmlKeyboardResponse, choices: 'ALL_KEYS',
    stimulus: `<p>${escaped(settings.question)}</p><p>${said}</p><p>Press any key to begin.</p><div id="left"></div>`,
    on_load: async () => {
        const place = document.getElementById('left');
        const names = (await inStore('readonly', (runs) => runs.getAllKeys()) || []).filter((name) => name !== run);
        for (const name of names) {
            const text = await inStore('readonly', (runs) => runs.get(name));
            const link = document.createElement('a');
            link.href = URL.createObjectURL(new Blob([text], {type: 'application/json'}));
            link.download = `${name}.json`;
            link.textContent = `Data of an earlier run that were not saved: ${name}`;
            link.addEventListener('click', () => inStore('readwrite', (runs) => runs.delete(name)));
            const line = document.createElement('p');
            line.append(link);
            place.append(line);
        }
    }};
const fixation = {type: jsPsychHtmlKeyboardResponse, stimulus: '<p style="font-size: 48px">+</p>',
    choices: 'NO_KEYS', trial_duration: 1000 * settings.fixation_s};

// The clip itself, and how well the browser kept up with its frames. `which` gives the clip when its trial begins.
let during = null;  // the key pressed while the clip was shown
const missed = [];  // clips of which the browser showed too few frames: they come once more at the end
function answerOf(data, key, clip) {
    const one = settings.answers.find((answer) => answer.key === key);
    data.answer = one ? one.answer : null;
    if (clip.correct_key) data.correct = key === clip.correct_key;
}
function shown(which, repeated) {
    let clip = null, begun = null, loaded = 0, seen = 0;
    if (conditions[0].shown_s !== undefined) return picture(which, repeated);
    return {
        type: jsPsychVideoKeyboardResponse, stimulus: () => [settings.clips + which().stim_file],
        choices: settings.answer_during ? keys : 'NO_KEYS', response_allowed_while_playing: true,
        response_ends_trial: false, trial_ends_after_video: true,
        data: () => ({...which(), task: 'clip', repeated}),
        on_start: () => {
            clip = which();
            begun = null;
            seen = 0;
            during = null;
        },
        on_load: () => {
            loaded = performance.now();
            const video = document.querySelector('video');
            const note = (now) => {
                begun = begun === null ? now : begun;
                ++seen;
                video.requestVideoFrameCallback(note);
            };
            if (video.requestVideoFrameCallback) video.requestVideoFrameCallback(note);
        },
        on_finish: (data) => {
            data.first_frame_ms = begun;
            data.frames_seen = seen;
            data.flag = seen < clip.frames - 1 ? 'frames_missing' : '';
            if (data.flag && !repeated) missed.push(clip);
            during = settings.answer_during ? data.response : null;
            if (during) {
                answerOf(data, during, clip);
                // jsPsych counts from the start of the trial.
                if (begun !== null && data.rt !== null) data.rt_from_first_frame = data.rt - (begun - loaded);
            }
        },
    };
}
// A picture stays for its time; the first refresh of the screen after it was put there is its beginning.
function picture(which, repeated) {
    let clip = null, begun = null, loaded = 0;
    return {
        type: jsPsychHtmlKeyboardResponse, stimulus: () => `<img src="${escaped(settings.clips + which().stim_file)}" alt="">`,
        choices: settings.answer_during ? keys : 'NO_KEYS', response_ends_trial: false,
        trial_duration: () => 1000 * which().shown_s, data: () => ({...which(), task: 'clip', repeated}),
        on_start: () => {
            clip = which();
            begun = null;
            during = null;
        },
        on_load: () => {
            loaded = performance.now();
            requestAnimationFrame((now) => {
                begun = now;
            });
        },
        on_finish: (data) => {
            data.first_frame_ms = begun;
            data.frames_seen = 1;
            data.flag = document.hidden || begun === null ? 'frames_missing' : '';
            if (data.flag && !repeated) missed.push(clip);
            during = settings.answer_during ? data.response : null;
            if (during) {
                answerOf(data, during, clip);
                if (begun !== null && data.rt !== null) data.rt_from_first_frame = data.rt - (begun - loaded);
            }
        },
    };
}
function answered(which, repeated) {
    return {timeline: [{
        type: jsPsychHtmlKeyboardResponse, stimulus: `<p>${escaped(settings.question)}</p><p>${said}</p>`,
        choices: keys, data: () => ({...which(), task: 'answer', repeated}),
        on_finish: (data) => answerOf(data, data.response, which()),
    }], conditional_function: () => !during};
}

const clips = jsPsych.randomization.repeat(conditions, settings.repetitions);
const files = [...new Set(conditions.map((clip) => settings.clips + clip.stim_file))];
const local = location.protocol === 'file:';
const preload = conditions[0].shown_s !== undefined ? {images: files} : {video: local ? [] : files};
const timeline = [{type: jsPsychPreload, ...preload}, wait];
for (const clip of clips) timeline.push(fixation, shown(() => clip, false), answered(() => clip, false));
let current = null;
const next = () => {
    current = missed.shift();
    return current !== undefined;
};
timeline.push({timeline: [fixation, shown(() => current, true), answered(() => current, true)],
    conditional_function: next, loop_function: next});
jsPsych.run(timeline);

// The data are on the server, or else in a file that the participant is offered; only what a server has confirmed is
// removed from the browser.
async function sent(body) {
    for (let attempt = 0; attempt < 3; ++attempt) {
        try {
            const answer = await fetch(asked.get('save'), {method: 'POST', headers: {'Content-Type': 'application/json'}, body});
            if (answer.ok) return true;
        } catch (error) {
            console.warn(error);
        }
        await new Promise((resolve) => setTimeout(resolve, 500 * (attempt + 1)));
    }
    return false;
}
async function finish() {
    const data = jsPsych.data.get(), place = jsPsych.getDisplayElement();
    place.innerHTML = '<p>The data are being saved. Please wait.</p>';
    await keeping;
    if (asked.has('save') && await sent(data.json())) {
        await inStore('readwrite', (runs) => runs.delete(run));
        place.innerHTML = '<p>Thank you.</p>';
        return;
    }
    place.innerHTML = asked.has('save')
        ? '<p id="unsaved">Thank you. The data could not be sent. Please keep this file, and give it to the experimenter:</p>'
        : '<p>Thank you. Please keep this file:</p>';
    place.append(offer(`data-${participant || 'participant'}.csv`, 'text/csv', data.csv()));
}
)js";

}  // namespace

std::string jspsych_page(const std::string& title, const std::string& from,
                         const std::string& settings, const std::string& conditions) {
    std::string out =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
        report::html_escaped(title) + "</title>\n";
    for (const PublishedFile& one : kJsPsych) out += load(one, from);
    out += "</head>\n<body></body>\n<script>\nconst settings = " + within_script(settings) +
           ";\nconst conditions = " + within_script(conditions) + ";\n</script>\n<script>" + kPage +
           "</script>\n</html>\n";
    return out;
}

}  // namespace risorius::stimuli
