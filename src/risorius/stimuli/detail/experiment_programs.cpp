// SPDX-License-Identifier: MIT
#include "risorius/stimuli/detail/experiment_programs.h"

#include <algorithm>
#include <array>
#include <vector>

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
constexpr std::array<PublishedFile, 6> kJsPsych{{
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
    {"@jspsych/plugin-survey-html-form", "2.1.0", "dist/index.browser.min.js",
     "sha384-60fiNESvg3n32x9sx0QAOyIlVkUgaC20Fsuo/ROTm0DeXCwEfaJ0FfE674kO0F9n"},
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

/// What both pages share: the trials are kept in the browser, and saved or offered at the end.
const char* const kKeeping = R"js(
'use strict';
// An example to start from. The address may say ?participant=7, ?run=2, ?seed=1 for an order that can be had again, and ?save=URL:
// the data are sent there as JSON when all is done, and offered as a file when that fails or no address is given.
// Every trial is also kept in the browser (IndexedDB) at once, and stays there until the data have been saved.
const asked = new URLSearchParams(location.search);
const escaped = (text) => String(text).replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const participant = asked.get('participant') || '';
const runNumber = Math.max(1, Math.floor(Number(asked.get('run')) || 1));
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
function linkTo(name, type, text) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], {type}));
    link.download = name;
    link.textContent = name;
    return link;
}
// Offers what an earlier run could not save, on the first page.
async function offerUnsaved() {
    const place = document.getElementById('left');
    const names = (await inStore('readonly', (runs) => runs.getAllKeys()) || []).filter((name) => name !== run);
    for (const name of names) {
        const text = await inStore('readonly', (runs) => runs.get(name));
        const link = linkTo(`${name}.json`, 'application/json', text);
        link.textContent = `Data of an earlier run that were not saved: ${name}`;
        link.addEventListener('click', () => inStore('readwrite', (runs) => runs.delete(name)));
        const line = document.createElement('p');
        line.append(link);
        place.append(line);
    }
}

const jsPsych = initJsPsych({on_finish: finish, on_data_update: keep});
if (asked.has('seed')) jsPsych.randomization.setSeed(asked.get('seed'));
jsPsych.data.addProperties({participant});

// The data are on the server, or else in files that the participant is offered; only what a server has confirmed is
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
    const place = jsPsych.getDisplayElement();
    place.innerHTML = '<p>The data are being saved. Please wait.</p>';
    await keeping;
    if (asked.has('save') && await sent(jsPsych.data.get().json())) {
        await inStore('readwrite', (runs) => runs.delete(run));
        place.innerHTML = '<p>Thank you.</p>';
        return;
    }
    place.innerHTML = asked.has('save')
        ? '<p id="unsaved">Thank you. The data could not be sent. Please keep these files, and give them to the experimenter:</p>'
        : '<p>Thank you. Please keep these files:</p>';
    for (const [name, type, text] of filesOfRun()) {
        const link = linkTo(name, type, text), line = document.createElement('p');
        line.append(link);
        place.append(line);
        link.click();
    }
}

// The clip of a trial, and how well the browser kept up with its frames. `which` gives the clip when its trial begins.
// `more`: what this page does at the beginning, once the clip is on the screen, and at the end.
function shown(which, keys, more) {
    let clip = null, begun = null, loaded = 0, seen = 0;
    const still = conditions[0].shown_s !== undefined;
    const common = {
        choices: keys.length ? keys : 'NO_KEYS', response_ends_trial: false, data: () => ({...which(), task: 'clip'}),
        on_start: () => {
            clip = which();
            begun = null;
            seen = 0;
            if (more.on_start) more.on_start(clip);
        },
        on_load: () => {
            loaded = performance.now();
            const video = document.querySelector('video');
            const note = (now) => {
                begun = begun === null ? now : begun;
                ++seen;
                if (video) video.requestVideoFrameCallback(note);
            };
            // The first refresh of the screen after a picture was put there is its beginning.
            if (!video) requestAnimationFrame(note);
            else if (video.requestVideoFrameCallback) video.requestVideoFrameCallback(note);
            if (more.on_load) more.on_load(clip);
        },
        on_finish: (data) => {
            data.first_frame_ms = begun;
            data.frames_seen = seen;
            data.flag = begun === null || (still ? document.hidden : seen < clip.frames - 1) ? 'frames_missing' : '';
            // jsPsych counts from the start of the trial.
            data.pressed_ms = data.rt === null ? null : loaded + data.rt;
            if (begun !== null && data.rt !== null) data.rt_from_first_frame = data.rt - (begun - loaded);
            if (more.on_finish) more.on_finish(data, clip);
        },
    };
    if (still) {
        return {...common, type: jsPsychHtmlKeyboardResponse,
            stimulus: () => `<img src="${escaped(settings.clips + which().stim_file)}" alt="">`,
            trial_duration: () => 1000 * which().shown_s};
    }
    return {...common, type: jsPsychVideoKeyboardResponse, stimulus: () => [settings.clips + which().stim_file],
        response_allowed_while_playing: true, trial_ends_after_video: true};
}
const files = [...new Set(conditions.map((clip) => settings.clips + clip.stim_file))];
const preload = {type: jsPsychPreload, ...(conditions[0].shown_s !== undefined ? {images: files}
    : {video: location.protocol === 'file:' ? [] : files})};
)js";

std::string page(const std::string& title, const std::string& from,
                 const std::vector<const char*>& packages, const std::string& settings,
                 const std::string& conditions, const char* course) {
    std::string out =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
        report::html_escaped(title) + "</title>\n";
    for (const PublishedFile& one : kJsPsych)
        if (std::find(packages.begin(), packages.end(), std::string(one.package)) != packages.end())
            out += load(one, from);
    return out + "</head>\n<body></body>\n<script>\nconst settings = " + within_script(settings) +
           ";\nconst conditions = " + within_script(conditions) + ";\n</script>\n<script>" +
           kKeeping + course + "</script>\n</html>\n";
}

constexpr const char *kJsPsychCore = "jspsych", *kPreload = "@jspsych/plugin-preload",
                     *kKeyboard = "@jspsych/plugin-html-keyboard-response",
                     *kVideo = "@jspsych/plugin-video-keyboard-response",
                     *kForm = "@jspsych/plugin-survey-html-form";

}  // namespace

std::string jspsych_page(const std::string& title, const std::string& from,
                         const std::string& settings, const std::string& conditions) {
    return page(title, from, {kJsPsychCore, kKeyboard, kVideo, kPreload}, settings, conditions,
                jspsych_course());
}

std::string rating_page(const std::string& title, const std::string& from,
                        const std::string& settings, const std::string& conditions) {
    return page(title, from, {kJsPsychCore, kKeyboard, kVideo, kPreload, kForm}, settings,
                conditions, rating_course());
}

}  // namespace risorius::stimuli
