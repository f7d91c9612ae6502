#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays the page of an experiment in a headless browser as a participant would, and keeps the data it sends.

    play.py ROOT PAGE DATA BROWSER...

ROOT is served on the loopback, PAGE is the page below it, DATA the file for what the page posts. Keys are pressed where it
waits for one: "a" for every answer. Fails when nothing is posted within two minutes.
"""
import functools
import http.server
import subprocess
import sys
import tempfile
import threading

root, page, data, *browser = sys.argv[1:]
posted = threading.Event()

PARTICIPANT = """<!doctype html><title>participant</title>
<iframe id="experiment" src="/PAGE?save=/data&seed=1&participant=7" width="900" height="700" allow="autoplay"></iframe>
<script>
setInterval(() => {
    const page = document.getElementById('experiment').contentDocument;
    if (!page || !page.querySelector('kbd')) return;
    for (const kind of ['keydown', 'keyup'])
        page.querySelector('.jspsych-content').dispatchEvent(new KeyboardEvent(kind, {key: 'a', bubbles: true}));
}, 100);
document.getElementById('experiment').addEventListener('load', (event) => {
    event.target.contentWindow.addEventListener('error', (error) =>
        fetch('/data', {method: 'POST', body: 'error: ' + error.message}));
});
</script>
""".replace("PAGE", page)


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
    run = subprocess.Popen(
        [
            *browser, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--mute-audio",
            "--autoplay-policy=no-user-gesture-required", f"--user-data-dir={profile}",
            f"http://127.0.0.1:{server.server_port}/participant.html", "--remote-debugging-port=0",
        ],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )
    came = posted.wait(120)
    run.terminate()
    run.wait()
sys.exit(0 if came else "nothing was posted")
