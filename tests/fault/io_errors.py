#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lets each operation on files below the output folder fail in turn, or ends the program there, and looks at what is left.

After each run, the output must be absent, the former one, or the new one, and whole. After one more run it must be whole, with no
hidden file beside it. Prints the number of operations and runs of each command. Exit code 1: a promise is broken.

    io_errors.py PROGRAM LIBRARY              a few operations of each command, for ctest
    io_errors.py PROGRAM LIBRARY --each       every operation with one fault, which changes from one to the next
    io_errors.py PROGRAM LIBRARY --all        every operation with every fault, which takes hours
    io_errors.py PROGRAM LIBRARY --copies     the same in minutes: the run is copied at each operation, see fault_each.h; needs root
    io_errors.py ... --copies --turn 0        with one fault for each operation, which changes from one to the next; 0 to 5: all of them
    io_errors.py ... --copies --from 600      operations from this number on, such as those behind the last one of a run that was cut off
    io_errors.py ... --part 2/5               of these, every fifth from the second on: the parts may run one after the other
"""
import argparse
import ctypes
import errno
import hashlib
import json
import multiprocessing
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
ERRORS = [errno.ENOSPC, errno.EIO, errno.EMFILE]
SIGNALS = [signal.SIGKILL, signal.SIGINT, signal.SIGHUP]
TIMES = ("timing", "solving_s")  # keys of JSON files that may differ between two runs


def stable(path, folder):
    """The bytes of a file without names of folders; of a JSON file, what does not differ between two runs."""
    data = path.read_bytes()
    for name in ("former", "whole", "out"):  # records name the file that they belong to
        data = data.replace(str(folder.with_name(name)).encode(), b"OUT")
    if path.suffix == ".json":
        value = json.loads(data)
        if isinstance(value, dict):
            for key in TIMES:
                value.pop(key, None)
            return json.dumps(value, sort_keys=True).encode()
    return data


def state_of(folder):
    """What is in the folder: for each file a checksum. Hidden names are listed apart."""
    files, hidden = {}, []
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        # A set has one hidden file of its own: validators of BIDS look for it.
        if any(part.startswith(".") and part != ".bidsignore" for part in pathlib.PurePath(name).parts):
            hidden.append(name)
        elif path.is_file():
            files[name] = hashlib.sha256(stable(path, folder)).hexdigest()
    return files, hidden


class Command:
    """`new` and `former`: arguments with {out} for the folder. The outputs are everything in that folder.

    `parts`: the command makes several sets of outputs one after the other, each of which is whole."""

    def __init__(self, name, new, former, parts=False):
        self.name, self.new, self.former, self.parts = name, new, former, parts


def script_of(duration_s, side_px):
    return {"format": "risorius-script", "version": 1, "rig": str(ROOT / "rigs/adult/rig.json"),
            "fps": 20, "duration_s": duration_s, "view": {"width_px": side_px, "height_px": side_px}}


def design_of(duration_s, side_px):
    return {
        "format": "risorius-design", "version": 1, "name": "two clips",
        "clips": {"quality": "draft"},
        "sets": [{"name": "a", "clip": "c${k}", "script": script_of(duration_s, side_px), "factors": {"k": [1, 2]}}]}


def commands(scratch):
    def write(name, value):
        (scratch / name).write_text(json.dumps(value))

    write("clip.json", script_of(0.1, 64))
    for name, duration in (("new", 0.1), ("former", 0.05)):
        write(f"{name}.json", design_of(duration, 64))
    mesh = ROOT / "models/adult/head.obj"

    def render(size):
        return ["render", scratch / "clip.json", "-o", "{out}/x.mp4", "--draft", "--size", size, "--threads", "1"]

    def fit(tables):
        return ["fit", mesh, "--landmarks", mesh.with_name("landmarks.json"), "-o",
                "{out}/rig.json", "--no-calibrate", "--name", tables, "--report", "{out}/report",
                "--threads", "1"]

    def shapes(name):
        return ["shapes", ROOT / "rigs/adult/rig.json", "-o", "{out}/s", "--only", name,
                "--no-pictures", "--no-correctives", "--test-frames", "0", "--formats", "glb,obj",
                "--texture", "0", "--threads", "1"]

    return [
        Command("render", render("64x64"), render("48x48")),
        Command("head", ["head", "-o", "{out}/h", "--mesh-only", "--seed", "1"],
                ["head", "-o", "{out}/h", "--mesh-only", "--seed", "2"]),
        Command("batch", ["batch", scratch / "new.json", "-o", "{out}/b", "--workers", "1"],
                ["batch", scratch / "former.json", "-o", "{out}/b", "--workers", "1"], parts=True),
        Command("shapes", shapes("jawOpen"), shapes("mouthPucker")),
        Command("fit", fit("new"), fit("former")),
    ]


def all_faults():
    """Each as settings of the library, and its name."""
    faults = [({"FAULT_ERROR": str(e)}, errno.errorcode[e]) for e in ERRORS]
    return faults + [({"FAULT_SIGNAL": str(int(s))}, s.name) for s in SIGNALS]


def run(program, arguments, out, environment=None, timeout_s=900):
    command = [program] + [str(word).format(out=out) for word in arguments]
    return subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          env={**os.environ, "RISORIUS_DATA": str(ROOT), **(environment or {})}, timeout=timeout_s)


class Loop:
    def __init__(self, program, library, command, scratch):
        self.program, self.library, self.command, self.scratch = program, library, command, scratch
        self.runs = self.broken = 0
        self.former = self.reference(command.former, "former")
        self.whole = self.reference(command.new, "whole")
        assert self.former != self.whole

    def reference(self, arguments, name):
        """What the command writes when nothing fails. JSON is compared without times."""
        out = self.scratch / name
        out.mkdir()
        done = run(self.program, arguments, out)
        assert done.returncode == 0, done.stderr
        files, hidden = state_of(out)
        assert not hidden, hidden
        return files

    def fresh(self, with_former):
        out = self.scratch / "out"
        shutil.rmtree(out, ignore_errors=True)
        if with_former:
            shutil.copytree(self.scratch / "former", out)
        else:
            out.mkdir()
        return out

    def operations(self, with_former):
        out, log = self.fresh(with_former), self.scratch / "log"
        log.unlink(missing_ok=True)
        run(self.program, self.command.new, out, self.fault(out, FAULT_LOG=str(log)))
        return [line.split(" ", 1)[1] for line in log.read_text().splitlines()]

    def fault(self, out, **more):
        return {"LD_PRELOAD": str(self.library), "FAULT_BELOW": str(out), **more}

    def tell(self, what, where, seen):
        self.broken += 1
        print(f"{self.command.name}: {where}: {what}: {seen}", flush=True)

    def try_one(self, at, with_former, fault, name):
        self.runs += 1
        where = f"{name} at operation {at}, {'with' if with_former else 'without'} a former output"
        out = self.fresh(with_former)
        done = run(self.program, self.command.new, out, self.fault(out, FAULT_AT=str(at), **fault))
        self.judge(out, with_former, done.returncode, done.stderr, where)
        self.once_more(out, where)

    def judge(self, out, with_former, code, errors, where):
        """Looks at what a run with a fault has left. Returns it."""
        files, hidden = state_of(out)
        allowed = [self.former] if with_former else [{}]
        killed = code == -signal.SIGKILL
        of_both = all(files[f] in (self.former.get(f), self.whole.get(f)) for f in files)
        if not killed and code not in (0, 1, 2, 130):
            self.tell("exit code", where, (code, errors))
        if killed:
            # Some of several moves may be done; the next run does the others.
            if not of_both:
                self.tell("half a file", where, sorted(files))
        elif code == 0:
            if files != self.whole:
                self.tell("not whole after success", where, sorted(files))
        elif not (self.command.parts and of_both) and files not in allowed + [self.whole]:
            self.tell("neither absent, former nor whole", where, sorted(files))
        if code == 130 and files == self.whole:
            self.tell("it says that it was interrupted", where, errors)
        if hidden and not killed:
            self.tell("hidden files", where, hidden)
        return files, hidden

    def once_more(self, out, where):
        again = run(self.program, self.command.new, out)
        files, hidden = state_of(out)
        if again.returncode != 0 or files != self.whole or hidden:
            self.tell("after one more run", where,
                      (again.returncode, again.stderr, sorted(files), hidden))

    def all(self, every, each, names, part):
        faults = [fault for fault in all_faults() if not names or fault[1] in names]
        total, begin = 0, time.monotonic()
        for with_former in (False, True):
            operations = self.operations(with_former)
            total += len(operations)
            chosen = range(1, len(operations) + 1)
            if not every and not each:
                # The operations around the decision, with a fault that changes from one to the next
                moves = [i for i, o in enumerate(operations, 1) if o.startswith("rename")]
                chosen = sorted({2, *moves[-3:], *(i + 1 for i in moves[-1:])})
            for n, at in list(enumerate(chosen))[part[0] - 1::part[1]]:
                step = 1 if each else 3
                for fault, name in faults if every else [faults[(2 + n * step) % len(faults)]]:
                    self.try_one(at, with_former, fault, name)
        print(f"{self.command.name}: {total} operations, {self.runs} runs with a fault, "
              f"{self.broken} broken promises, in {time.monotonic() - begin:.0f} s", flush=True)
        return self.broken


CLONE_NEWNS, MS_PRIVATE = 0x20000, 0x44000  # of <sched.h>; of <sys/mount.h>, for all mounts below
# Of a program that is copied: no thread but the first works, see fault_each.h.
ALONE = {"FAULT_ONE_THREAD": "1", "LP_NUM_THREADS": "0"}


class Copies(Loop):
    """Tries each fault in a copy of one run. States that the next run must treat alike are run once more once."""

    def each(self, names, part, turn, first):
        chosen = [(settings, name) for settings, name in all_faults() if not names or name in names]
        numbers = {int(s.get("FAULT_ERROR", 0)) or -int(s["FAULT_SIGNAL"]): name for s, name in chosen}
        begin, total = time.monotonic(), 0
        for with_former in (False, True):
            total += len(self.operations(with_former))
            out, each = self.fresh(with_former), self.scratch / "each"
            shutil.rmtree(each, ignore_errors=True)
            (each / "seen").mkdir(parents=True)
            for pipe in ("asked", "answered"):
                os.mkfifo(each / pipe)
            child = multiprocessing.Process(target=self.copied_run, args=(out, each, numbers, part, turn, first))
            child.start()
            # Both ends of each pipe are open, so that nobody waits for the other.
            asked, answered = (os.open(each / pipe, os.O_RDWR) for pipe in ("asked", "answered"))
            with open(asked, encoding="utf-8") as lines:
                while (line := lines.readline().split()) != ["end"]:
                    self.runs += 1
                    judge = multiprocessing.Process(target=self.judge_copy, args=(each, with_former, numbers, line))
                    judge.start()
                    judge.join()
                    self.more += judge.exitcode & 1
                    self.broken += bool(judge.exitcode & 2)
                    shutil.rmtree(each / f"{line[0]}_{line[1]}", ignore_errors=True)
                    os.write(answered, b"\n")
            os.close(answered)
            child.join()
            files, hidden = state_of(out)
            if child.exitcode != 0 or files != self.whole or hidden:
                self.tell("the run that is copied", "at its end", (child.exitcode, sorted(files), hidden))
            if (each / "of_threads").exists():
                for at in map(int, (each / "of_threads").read_text().split()):
                    if at >= first and (at - part[0]) % part[1] == 0:
                        for fault, name in chosen:
                            self.try_one(at, with_former, fault, name)
        print(f"{self.command.name}: {total} operations, {self.runs} runs with a fault, {self.more} states run once more, "
              f"{self.broken} broken promises, in {time.monotonic() - begin:.0f} s", flush=True)
        return self.broken

    def copied_run(self, out, each, numbers, part, turn, first):
        done = run(self.program, self.command.new, out, self.fault(
            out, FAULT_EACH=str(each), FAULT_LIST=",".join(map(str, numbers)), FAULT_PART="/".join(map(str, part)),
            FAULT_FROM=str(first), **({} if turn is None else {"FAULT_TURN": str(turn)})), timeout_s=None)
        (each / "asked").write_text("end\n")
        if done.returncode != 0:
            print(done.stderr.decode(errors="replace"), flush=True)
        sys.exit(done.returncode)

    def judge_copy(self, each, with_former, numbers, line):
        """Sees what the copy saw. Exit code: 1: run once more, 2: a promise is broken, or both."""
        number, fault, code, mounts = int(line[0]), int(line[1]), int(line[2]), line[3]
        out, changes, libc = self.scratch / "out", each / f"{number}_{fault}", ctypes.CDLL(None, use_errno=True)
        if mounts == "-":
            for one in (changes, changes / "upper", changes / "work"):
                one.mkdir()
            options = f"lowerdir={out},upperdir={changes}/upper,workdir={changes}/work,redirect_dir=on"
            assert libc.unshare(CLONE_NEWNS) == 0 and libc.mount(None, b"/", None, MS_PRIVATE, None) == 0
            assert libc.mount(b"overlay", bytes(out), b"overlay", 0, options.encode()) == 0
        else:
            with open(mounts, encoding="utf-8") as mounts_of_copy:
                assert libc.setns(mounts_of_copy.fileno(), CLONE_NEWNS) == 0
        self.broken = self.more = 0
        where = f"{numbers[fault]} at operation {number}, {'with' if with_former else 'without'} a former output"
        errors = changes / "errors"
        files, hidden = self.judge(out, with_former, code, errors.read_bytes()[-500:] if errors.exists() else b"",
            where)
        # The random letters of private folders do not count. Without a journal, all that is in one is removed alike.
        parts = [["." if part.startswith(".risorius-") else part for part in name.split("/")] for name in hidden]
        if not any(part[-1] == "journal" for part in parts):
            parts = [part[:part.index(".") + 2] if "." in part else part for part in parts]
        names = sorted({"/".join(part) for part in parts})
        key = hashlib.sha256(json.dumps([files, names]).encode()).hexdigest()
        if not (each / "seen" / key).exists():
            (each / "seen" / key).touch()
            self.more = 1
            self.once_more(out, where)
        sys.exit(self.more | (2 if self.broken else 0))

    more = 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--copies", action="store_true")
    parser.add_argument("--turn", type=int)
    parser.add_argument("--from", type=int, default=1, dest="first")
    parser.add_argument("--only", default="render,head", help="commands: render,head,batch,shapes,fit")
    parser.add_argument("--part", default="1/1", type=lambda text: [int(number) for number in text.split("/")])
    parser.add_argument("--faults", default="", help="such as ENOSPC,SIGKILL; default: all")
    arguments = parser.parse_args()
    # Signals that this program was started to ignore, as with nohup, the other one would ignore too.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    broken = 0
    with tempfile.TemporaryDirectory() as base:
        for command in commands(pathlib.Path(base)):
            if command.name not in arguments.only.split(","):
                continue
            scratch = pathlib.Path(base) / command.name
            scratch.mkdir()
            places = arguments.program.resolve(), arguments.library.resolve(), command, scratch
            if arguments.copies:
                # Libraries may compute other last bits with one thread: all runs have one.
                os.environ.update(ALONE, LD_PRELOAD=str(places[1]))
                broken += Copies(*places).each(arguments.faults, arguments.part, arguments.turn,
                    arguments.first)
            else:
                broken += Loop(*places).all(arguments.all, arguments.each, arguments.faults, arguments.part)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
