#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the curves of a sentence: what its sounds ask of the mouth, what is planned, and what the simulated face does.

    tools/docs/speech_curves.py samples/talk/english out.png

Reads OUT.json and OUT.utterance.json of `risorius speak`. Needs gnuplot.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

import json

ROOT = pathlib.Path(__file__).resolve().parents[2]
PANELS = [
    ("gap between the lips (mm)", "gap_mm", "target_gap_mm", ["lip_gap_mm"]),
    ("change of width (mm)", "width_mm", "target_width_mm", ["lip_width_change_mm"]),
    ("protrusion (mm)", "protrusion_mm", "target_protrusion_mm", ["lip_protrusion_upper_mm", "lip_protrusion_lower_mm"]),
]
ORANGE, BLUE, GREEN = "#D55E00", "#0072B2", "#009E73"


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))


def run(*arguments):
    subprocess.run([ROOT / "build/risorius", *arguments, "--quiet"], check=True)


def main():
    name, out = sys.argv[1:]
    start = json.loads(pathlib.Path(name + ".json").read_text())["events"][-1]["start_s"]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        run("speak", name + ".utterance.json", "-o", folder / "x.curves.tsv")
        run("speak", name + ".utterance.json", "-o", folder / "x.json")
        run("render", folder / "x.json", "--draft", "--quality", "video", "--size", "64x64", "-o", folder / "x.mp4")
        plan, phones = table(folder / "x.curves.tsv"), table(folder / "x.speech.tsv")
        frames = table(next(folder.glob("x*.frames.tsv")))
        start = json.loads((folder / "x.json").read_text())["events"][-1]["start_s"]
    end = float(phones[-1]["end_s"]) + 0.4
    lines = [
        f"set terminal pngcairo size 1500,900 font 'sans,11' background '#ffffff'; set output '{out}'",
        "set multiplot; set tics nomirror out; set border 3; set key top right horizontal samplen 2",
        f"set xrange [0:{end}]; set lmargin at screen 0.06; set rmargin at screen 0.98; set style fill solid 0.35 noborder",
    ]
    for panel, (label, planned, target, simulated) in enumerate(PANELS):
        top, bottom = 0.95 - 0.3 * panel, 0.95 - 0.3 * panel - 0.255
        lines.append(f"set tmargin at screen {top}; set bmargin at screen {bottom}; unset label; unset object; unset arrow")
        lines.append(f"set ylabel '{label}'; set xlabel '{'time (s)' if panel == 2 else ''}'")
        for i, row in enumerate(phones):
            a, b = float(row["start_s"]), float(row["end_s"])
            if panel == 0:
                lines.append(f"set label '{row['symbol']}' at {(a + b) / 2}, graph 1.03 center")
            lines.append(f"set arrow from {a}, graph 0 to {a}, graph 1 nohead lc '#e0e0e0' lw 0.6 back")
            if row["contact_s"] and row["open_s"]:
                c, o = float(row["contact_s"]), float(row["open_s"])
                lines.append(f"set object {100 + i} rect from {c}, graph 0 to {o}, graph 1 fc '#c8c8c8' fs solid 0.45 noborder behind")
            middle, half = (a + b) / 2, (b - a) / 4
            y = float(row[target])
            lines.append(f"set arrow from {middle - half}, {y} to {middle + half}, {y} nohead lc '{ORANGE}' lw 4 front")
        plots = [f"NaN w l lw 4 lc '{ORANGE}' t 'target'", f"'-' w l lw 1.6 lc '{BLUE}' t 'planned'"]
        plots += [f"'-' w l lw 1.6 dt {i + 1} lc '{GREEN}' t '{'simulated' if len(simulated) == 1 else 'simulated, ' + s.split('_')[2] + ' lip'}'"
                  for i, s in enumerate(simulated)]
        if panel == 0:
            plots.append("NaN w boxes lc '#c8c8c8' t 'lips in contact'")
        lines.append("plot " + ", ".join(plots))
        lines += [f"{float(r['time_s']) + start} {r[planned]}" for r in plan] + ["e"]
        for column in simulated:
            lines += [f"{r['time_s']} {r[column]}" for r in frames] + ["e"]
    subprocess.run(["gnuplot"], input="\n".join(lines) + "\n", text=True, check=True)


if __name__ == "__main__":
    main()
