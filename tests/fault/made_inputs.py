#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Gives files that are made to break readers (made_files.py, made_packed.py) to every command that reads such files.

Each run must end with exit code 0 or 2 within 20 s of processor time and 1.5 GB, print JSON with --json and say what is wrong in one readable line, and
leave nothing behind when it fails. Prints each broken promise, and the number of runs. Exit code 1: a promise is broken.

    made_inputs.py PROGRAM                       all of them, which takes some minutes
    made_inputs.py PROGRAM --only designs,labels files of these functions
    made_inputs.py PROGRAM --part 2/7            every seventh run from the second on
"""
import argparse
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import made_files  # noqa: E402
import made_packed  # noqa: E402

ROOT = made_files.ROOT
RIG = made_files.RIG
SMILE = str(ROOT / "samples/smile/script.json")
WAV = str(ROOT / "samples/mcgurk/apa.wav")
HEAD = str(ROOT / "models/adult/head.obj")
MARKS = str(ROOT / "models/adult/landmarks.json")
SECONDS, MEGABYTES, PATIENCE_S = 20, 1500, 200

# What each kind of file is given to. {f}: the file, {o}: a folder for outputs. Where a command would go on for minutes with a good file, it
# is asked for a plan, a check or one small picture.
STILL = "--still 0 --size 16x16 --draft -o {o}/x.png"
COMMANDS = {
    "check": "check {f}", "info": "info {f}", "render": "render {f} " + STILL,
    "render --rig": f"render {SMILE} --rig {{f}} " + STILL,
    "render --shapes": f"render {SMILE} --shapes {{f}} " + STILL,
    "render --audio": f"render {SMILE} --size 16x16 --draft --fps 1 --audio {{f}} -o {{o}}/x.mkv",
    "render --against": f"render {SMILE} --show error --against {{f}} " + STILL, "speak": "speak {f} -o {o}/x.json",
    "speak --script": "speak a --script {f} -o {o}/x.json",
    "speak --labels": f"speak --labels {{f}} --audio {WAV} -o {{o}}/x.utterance.json",
    "speak --audio": "speak a --audio {f} -o {o}/x.TextGrid",
    "align": "align {f} --text a -o {o}/x.TextGrid",
    "compare": f"compare {SMILE} {{f}} --fps 1 --size 16x16 --draft -o {{o}}/x.mp4",
    "sheet": "sheet {f} --times 0 --size 16x16 --draft -o {o}/x.png",
    "sheet --beside": f"sheet {SMILE} --times 0 --size 16x16 --draft --beside {{f}} -o {{o}}/x.png",
    "landmarks": "landmarks {f} -o {o}/x.json", "fit": f"fit {{f}} --landmarks {MARKS} --no-calibrate -o {{o}}/x.json",
    "fit --repair": f"fit {{f}} --landmarks {MARKS} --repair --no-calibrate -o {{o}}/x.json",
    "fit --landmarks": f"fit {HEAD} --landmarks {{f}} --no-calibrate -o {{o}}/x.json",
    "fit --voice": "fit --voice {f}", "head --identity": "head --identity {f} --identity-only -o {o}/h",
    "head --morph": "head --morph {f} {f} 0.5 --identity-only -o {o}/h",
    "evaluate": "evaluate {f} --facs --only AU12",
    "evaluate --shapes": f"evaluate {RIG} --shapes {{f}} --only AU12 --no-pictures",
    "evaluate --like": f"evaluate {RIG} --like {{f}} --only AU12",
    "evaluate --codes": f"evaluate {RIG} --facs --codes {{f}} --key {{f}}", "shapes": "shapes {f} -o {o}/s",
    "shapes --script": f"shapes {RIG} --script {{f}} --only jawOpen --no-pictures --no-correctives --test-frames 0 --texture 0 -o {{o}}/s",
    "solve --shapes": f"solve {RIG} --shapes {{f}} --only jawOpen -o {{o}}/s",
    "solve --mesh": f"solve {RIG} --mesh {{f}} -o {{o}}/s",
    "solve --landmarks": f"solve {RIG} --landmarks {{f}} --fps 1 -o {{o}}/s",
    "import": "import {f} -o {o}/x.json", "import --rig": "import " +
    str(ROOT / "tests/fuzz/seeds/motion/live_link.csv") + " --rig {f} -o {o}/x.json",
    "export": "export {f} --times 0 --quality draft -o {o}/e",
    "export osim": "export {f} --format osim --times 0 --quality draft -o {o}/e",
    "batch --plan": "batch {f} --plan",
    "batch --norms": f"batch {ROOT}/samples/stimuli/design.json --norms {{f}} --part 300/300 -o {{o}}/b",
    "reverse": "reverse {f} {f} --no-pictures -o {o}/r",
    "study --plan": "study {f} --plan", "figure": "figure {f} -o {o}/f", "view": "view {f} --no-browser",
    "bench --rig": "bench --rig {f} --steps -o {o}/b.json",
    **{f"import --as {name}": f"import {{f}} --as {name} -o {{o}}/x.json" for name in ("livelink", "mediapipe",
        "openface", "pyfeat", "arkit", "gltf", "vmc", "bvh", "storage")}}
AS = [name for name in COMMANDS if name.startswith("import --as")]
ALL = [name for name in COMMANDS if name not in AS]
USES = {
    "no_files": [name for name in ALL if name != "speak"],  # which says the name of a file that is not there
    "any_json": [name for name in ALL if name not in ("align", "speak", "speak --audio")],
    "scripts": ["check", "render", "sheet", "export", "speak --script", "shapes --script", "render --against",
    "render --rig"],
    "designs": ["check", "batch --plan"], "studies": ["check", "study --plan", "figure"],
    "tet_meshes": ["check", "fit", "figure"],
    "tables": ["check", "solve --landmarks", "reverse", "evaluate --codes", "batch --norms", "import",
    "import --as livelink", "import --as openface", "import --as pyfeat", "import --as storage", "speak --labels"],
    "recordings": ["import", "solve --landmarks", "info", "check"] + AS,
    "sounds": ["align", "render --audio", "speak --audio", "speak"],
    "labels": ["speak --labels", "speak", "check"],
    "meshes": ["check", "fit", "fit --repair", "landmarks", "info", "render --shapes", "solve --mesh",
    "solve --shapes", "sheet --beside", "import --as gltf"],
    "pictures": ["sheet --beside"], "textured": ["check"], "lights": ["check", "render"], "long_sounds": ["align", "render --audio"],
    "packed_tets": ["figure"], "much_of_little": ["check"]}
MAY_GO_ON = {"view"}  # a server, when the file is good


class Sweep:
    def __init__(self, program, base):
        self.program, self.base, self.runs, self.broken = program.resolve(), base, 0, 0
        self.slowest, self.largest = (0.0, ""), (0.0, "")

    def tell(self, name, path, what, seen):
        self.broken += 1
        print(f"{name} {os.fsencode(path.name)!r}: {what}: {seen}", flush=True)

    def run(self, name, path):
        """One run: (exit code, output, errors, seconds, megabytes). It may hold the pipe `path` open for ever, as a writer that says nothing."""
        out, work, temporary = (self.base / one for one in ("out", "work", "temporary"))
        for folder in (out, work, temporary):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
        words = [os.fspath(path) if w == "{f}" else w.replace("{o}", str(out)) for w in COMMANDS[name].split()]
        environment = {**os.environ, "RISORIUS_DATA": str(ROOT), "TMPDIR": str(temporary)}
        with open(self.base / "stdout", "w+b") as output, open(self.base / "stderr", "w+b") as errors:
            child = subprocess.Popen([self.program, *words, "--json"], stdin=subprocess.DEVNULL, stdout=output,
                stderr=errors, cwd=work, env=environment)
            timer = threading.Timer(5 if name in MAY_GO_ON else PATIENCE_S,
                child.terminate if name in MAY_GO_ON else child.kill)
            timer.start()
            _, status, usage = os.wait4(child.pid, 0)
            timer.cancel()
            child.returncode = os.waitstatus_to_exitcode(status)
            seconds = usage.ru_utime + usage.ru_stime  # of its children, too
            output.seek(0)
            errors.seek(0)
            return child.returncode, output.read(), errors.read(), seconds, usage.ru_maxrss / 1000, [out, work,
                temporary]

    def try_one(self, name, path):
        self.runs += 1
        code, output, errors, seconds, megabytes, folders = self.run(name, path)
        where = f"{name} {path.name!r}"
        self.slowest, self.largest = max(self.slowest, (seconds, where)), max(self.largest, (megabytes, where))
        if code not in (0, 2) and not (name in MAY_GO_ON and code == 130):
            self.tell(name, path, "exit code", (code, errors[-300:]))
        if seconds > SECONDS:
            self.tell(name, path, "seconds", round(seconds, 1))
        if megabytes > MEGABYTES:
            self.tell(name, path, "MB", round(megabytes))
        try:
            if not (name in MAY_GO_ON and code == 130):
                json.loads(output.decode())
        except ValueError:
            self.tell(name, path, "no JSON", output[:200])
        text = errors.decode(errors="replace")
        if "\ufffd" in text or any(ord(c) < 32 and c != "\n" for c in text):
            self.tell(name, path, "a message that cannot be read", errors[:300])
        if code == 2 and not text.startswith("risorius: "):
            self.tell(name, path, "no message", errors[:300])
        left = [str(one) for folder in (folders if code else folders[1:]) for one in folder.rglob("*")]
        if left:
            self.tell(name, path, "left behind", left[:5])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--only", default=",".join(USES), help="functions of made_files.py and made_packed.py")
    parser.add_argument("--part", default="1/1", type=lambda text: [int(number) for number in text.split("/")])
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory() as base:
        sweep, runs, begin = Sweep(arguments.program, pathlib.Path(base)), [], time.monotonic()
        for kind in arguments.only.split(","):
            folder = pathlib.Path(base) / "made" / kind
            folder.mkdir(parents=True)
            files = getattr(made_files if hasattr(made_files, kind) else made_packed, kind)(folder)
            runs += [(name, path) for path in files.values() for name in USES[kind]]
        for name, path in runs[arguments.part[0] - 1::arguments.part[1]]:
            sweep.try_one(name, path)
        print(f"{sweep.runs} runs, {sweep.broken} broken promises, in {time.monotonic() - begin:.0f} s; the slowest {sweep.slowest[0]:.1f} s "
              f"({sweep.slowest[1]}), the largest {sweep.largest[0]:.0f} MB ({sweep.largest[1]})", flush=True)
        sys.exit(1 if sweep.broken else 0)


main()
