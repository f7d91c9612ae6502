#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays the page of an experiment in a headless browser as a participant would, and keeps the data it sends.

    play.py ROOT PAGE DATA BROWSER... [--dead-save] [--run=2]

ROOT is served on the loopback, PAGE is the page below it, DATA the file for what the page posts. Keys are pressed where it
waits for one: "a" for every answer, the space bar for a red dot. A form of ratings gets the third choice of each question.
Fails when nothing is posted within two minutes.

With --dead-save the address that the page saves to answers 503. DATA then gets what is left to the participant: the files that
the page offers, the trials that the browser keeps, and the names that the page offers when it is opened again.
"""
import functools
import http.server
import subprocess
import sys
import tempfile
import threading

dead = "--dead-save" in sys.argv
run = "".join(f"&run={one[6:]}" for one in sys.argv if one.startswith("--run="))
root, page, data, *browser = [one for one in sys.argv[1:] if one != "--dead-save" and not one.startswith("--run=")]
posted = threading.Event()

PARTICIPANT = """<!doctype html><title>participant</title>
<iframe id="experiment" src="/PAGE?save=/SAVE&seed=1&participant=7RUN" width="900" height="700" allow="autoplay"></iframe>
<script>
const experiment = document.getElementById('experiment');
const kept = () => new Promise((resolve) => {
    const open = indexedDB.open('risorius', 1);
    open.onsuccess = () => {
        const request = open.result.transaction('runs').objectStore('runs').getAll();
        request.onsuccess = () => resolve(request.result.map((text) => JSON.parse(text)));
    };
});
let left = null;
setInterval(async () => {
    const page = experiment.contentDocument;
    if (!page) return;
    const unsaved = page.querySelector('#unsaved');
    if (unsaved && !left) {
        left = {};
        const links = [...page.querySelectorAll('a[download]')], files = {};
        for (const link of links) files[link.download] = await (await fetch(link.href)).text();
        left = {file: links[0].download, csv: files[links[0].download], files, kept: await kept()};
        experiment.contentWindow.location.reload();
        return;
    }
    if (left) {
        const offered = [...page.querySelectorAll('#left a')].map((link) => link.download);
        if (left.kept && offered.length) fetch('/data', {method: 'POST', body: JSON.stringify({...left, offered})});
        return;
    }
    const form = page.querySelector('#jspsych-survey-html-form');
    if (form) {
        for (const name of new Set([...form.querySelectorAll('input[type=radio]')].map((input) => input.name))) {
            const choices = form.querySelectorAll(`input[name="${name}"]`);
            choices[Math.min(2, choices.length - 1)].click();
        }
        form.querySelector('#jspsych-survey-html-form-next').click();
        return;
    }
    const dot = page.querySelector('.dot');
    const key = dot && dot.style.visibility === 'visible' ? ' '
        : page.querySelector('kbd') || page.body.textContent.includes('Press any key') ? 'a' : null;
    if (!key) return;
    for (const kind of ['keydown', 'keyup'])
        page.querySelector('.jspsych-content').dispatchEvent(new KeyboardEvent(kind, {key, bubbles: true}));
}, 100);
document.getElementById('experiment').addEventListener('load', (event) => {
    event.target.contentWindow.addEventListener('error', (error) =>
        fetch('/data', {method: 'POST', body: 'error: ' + error.message}));
});
</script>
""".replace("PAGE", page).replace("SAVE", "nowhere" if dead else "data").replace("RUN", run)


class Server(http.server.SimpleHTTPRequestHandler):
    def do_GET(self):
        if self.path != "/participant.html":
            return super().do_GET()
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(PARTICIPANT.encode())
        return None

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if self.path != "/data":
            self.send_error(503)
            return
        with open(data, "wb") as file:
            file.write(body)
        self.send_response(204)
        self.end_headers()
        posted.set()

    def log_message(self, *_):
        pass


server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Server, directory=root))
threading.Thread(target=server.serve_forever, daemon=True).start()
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
    browsing = subprocess.Popen(
        [
            *browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--mute-audio",
            "--autoplay-policy=no-user-gesture-required", f"--user-data-dir={profile}",
            f"http://127.0.0.1:{server.server_port}/participant.html", "--remote-debugging-port=0",
        ],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )
    came = posted.wait(120)
    browsing.terminate()
    browsing.wait()
sys.exit(0 if came else "nothing was posted")
