#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a wheel of the Python module in a build folder, with the rigs and models that it needs.

    make_wheel.py BUILD_FOLDER SOURCE_FOLDER VERSION OUT_FOLDER

Install it with `pip install --no-index --no-deps FILE`. It links the libraries of this system (OSMesa, FFmpeg, CHOLMOD), so it is for
machines with the same release of Debian.
"""
import base64
import hashlib
import pathlib
import sys
import zipfile

METADATA = """Metadata-Version: 2.1
Name: risorius
Version: %s
Summary: Facial animation by muscles
License: MIT
Requires-Python: >=3.9
Requires-Dist: numpy
"""


def main():
    build, source, version, out = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3], pathlib.Path(sys.argv[4])
    package = pathlib.Path(build) / "python/risorius"
    modules = sorted(package.glob("_core.*.so"))
    if len(modules) != 1:
        sys.exit("make_wheel: %s: expected one module _core.*.so, found %d" % (package, len(modules)))
    # _core.cpython-311-x86_64-linux-gnu.so
    python, machine = modules[0].name.split(".")[1].split("-")[1:3]
    tag = "cp%s-cp%s-linux_%s" % (python, python, machine)
    files = [(path, "risorius/" + path.name) for path in sorted(package.iterdir()) if path.is_file()]
    for folder in ("rigs", "models"):
        for path in sorted((source / folder).rglob("*")):
            if path.is_file():
                files.append((path, "risorius/data/" + path.relative_to(source).as_posix()))
    # data_folder() asks for these three folders; the hello sample is what the documents show first.
    files.append((source / "samples/hello/script.json", "risorius/data/samples/hello/script.json"))
    info = "risorius-%s.dist-info/" % version
    texts = {
        info + "METADATA": METADATA % version,
        info + "WHEEL": "Wheel-Version: 1.0\nGenerator: risorius\nRoot-Is-Purelib: false\nTag: %s\n" % tag,
        info + "LICENSE": (source / "LICENSE").read_text(),
    }
    out.mkdir(parents=True, exist_ok=True)
    target = out / ("risorius-%s-%s.whl" % (version, tag))
    record = []
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as wheel:

        def add(name, data):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes whenever it is made
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            wheel.writestr(entry, data, zipfile.ZIP_DEFLATED)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append("%s,sha256=%s,%d" % (name, digest, len(data)))

        for path, name in files:
            add(name, path.read_bytes())
        for name, text in texts.items():
            add(name, text.encode())
        record.append(info + "RECORD,,")
        wheel.writestr(zipfile.ZipInfo(info + "RECORD", (1980, 1, 1, 0, 0, 0)), "\n".join(record) + "\n")
    print(target)


main()
