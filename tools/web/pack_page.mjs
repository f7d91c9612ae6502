// SPDX-License-Identifier: MIT
// Puts together what tools/web/build_hosted.sh has built: the page, the worker, the engine, and the files that scripts need, each
// packed by gzip, with the licences of everything inside.
//
//   node pack_page.mjs SOURCE_FOLDER BUILD_FOLDER WEB_BUILD_FOLDER OUT

import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { gzipSync } from "node:zlib";

const [source, build, webBuild, out] = process.argv.slice(2).map((path) => resolve(path));
const suitesparse = join(build, "web/suitesparse");

/// In the order of the list; the first one is opened.
const samples = ["hello", "smile", "emotions", "jaw", "emg"];
const rigs = ["adult"];

const weights = {};
function write(name, bytes) {
  const path = join(out, name);
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, bytes);
  weights[name] = bytes.length;
}
// The time of packing is no part of the file: the same inputs give the same bytes.
const packed = (bytes) => {
  const zipped = gzipSync(bytes, { level: 9 });
  zipped.fill(0, 4, 8);
  return zipped;
};

/// The page with the engine inside, and what it may load.
function page() {
  const policy =
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; " +
    "media-src 'self' blob:; object-src 'none'; base-uri 'none'; form-action 'none'";
  const html = readFileSync(join(build, "web/page/index.html"), "utf8")
    .replace('<html lang="en">', '<html lang="en" data-engine="local">')
    .replace('<meta charset="utf-8" />', `<meta charset="utf-8" />\n    <meta http-equiv="Content-Security-Policy" content="${policy}" />`)
    .replace("</head>", '  <link rel="stylesheet" href="/hosted.css" />\n  </head>')
    .replaceAll(/(href|src)="\//g, '$1="');
  if (!html.includes('data-engine="local"') || !html.includes("Content-Security-Policy")) throw new Error("index.html is not as expected");
  write("index.html", html);
  for (const name of ["studio.js", "studio.css", "icon.svg"]) write(name, readFileSync(join(build, "web/page", name)));
  write("hosted.css", readFileSync(join(source, "src/web/hosted.css")));
  const modules = join(build, "web/node_modules");
  execFileSync(
    join(modules, ".bin/esbuild"),
    [join(source, "src/web/engine_worker.ts"), "--bundle", "--minify", "--format=iife", "--target=es2022", "--log-level=warning", `--outfile=${join(out, "engine_worker.js")}`],
    { stdio: "inherit" },
  );
  write("engine.js", readFileSync(join(webBuild, "engine.js")));
  write("engine.wasm.gz", packed(readFileSync(join(webBuild, "engine.wasm"))));
}

/// The files of rigs and samples, at the paths that they have in the source.
function data() {
  const put = (path) => (write(`data/${path}.gz`, packed(readFileSync(join(source, path)))), path);
  const standard = readdirSync(join(source, "rigs/standard")).filter((name) => /\.json$/.test(name)).map((name) => `rigs/standard/${name}`);
  const pack = { first: samples[0], rigs: {}, samples: {} };
  for (const name of rigs) {
    const rig = `rigs/${name}/rig.json`;
    const mesh = relative(source, resolve(source, dirname(rig), JSON.parse(readFileSync(join(source, rig), "utf8")).mesh.file));
    const painted = join(build, "web/pictures", name);
    const pictures = existsSync(painted) ? readdirSync(painted).sort() : [];
    for (const one of pictures) write(`data/pictures/${name}/${one}.gz`, packed(readFileSync(join(painted, one))));
    const bones = pictures.includes("skull") ? `pictures/${name}/skull` : null;
    pack.rigs[name] = {
      rig: put(rig),
      files: [put(mesh), ...standard.map(put)],
      pictures: pictures.filter((one) => one !== "skull").map((one) => `pictures/${name}/${one}`),
      skull: bones,
    };
  }
  for (const name of samples) {
    const script = `samples/${name}/script.json`;
    const read = JSON.parse(readFileSync(join(source, script), "utf8"));
    const files = read.emg ? [put(`samples/${name}/${read.emg.file}`)] : [];
    pack.samples[name] = { script: put(script), rig: read.rig.split("/").at(-2), files };
  }
  write("pack.json", JSON.stringify(pack));
}

/// The texts of all licences, and what the LGPL wants: the library's objects and sources, so that it can be replaced.
function licences() {
  const copies = {
    "risorius-MIT.txt": join(source, "LICENSE"),
    "page-three.txt": join(build, "web/page/LICENCES.txt"),
    "eigen-MPL2.txt": "/usr/share/doc/libeigen3-dev/copyright",
    "nlohmann-json-MIT.txt": "/usr/share/doc/nlohmann-json3-dev/copyright",
    "emscripten-musl-libcxx.txt": "/usr/share/doc/emscripten/copyright",
    "metis-Apache2.txt": join(suitesparse, "metis-5.1.0/LICENSE.txt"),
    "cholmod-LGPL2.1.txt": join(suitesparse, "CHOLMOD/Core/lesser.txt"),
    "cholmod-modules.txt": join(suitesparse, "CHOLMOD/Doc/License.txt"),
    "amd-BSD.txt": join(suitesparse, "AMD/Doc/License.txt"),
    "camd-BSD.txt": join(suitesparse, "CAMD/Doc/License.txt"),
    "colamd-BSD.txt": join(suitesparse, "COLAMD/Doc/License.txt"),
    "ccolamd-BSD.txt": join(suitesparse, "CCOLAMD/Doc/License.txt"),
  };
  for (const [name, from] of Object.entries(copies)) write(`licences/${name}`, readFileSync(from));
  write("licences/libcholmod.a", readFileSync(join(webBuild, "librisorius_cholmod.a")));
  write("licences/libmetis.a", readFileSync(join(webBuild, "librisorius_metis.a")));
  const archive = "suitesparse-sources.tar.xz";
  execFileSync("tar", ["-C", suitesparse, "--sort=name", "--mtime=@0", "--owner=0", "--group=0", "--numeric-owner", "-cJf", join(out, "licences", archive), "AMD", "CAMD", "CCOLAMD", "CHOLMOD", "COLAMD", "SuiteSparse_config", "metis-5.1.0"]);
  write(
    "licences/README.txt",
    `The engine of this page (engine.wasm.gz) is Risorius, under the MIT licence, linked with

  CHOLMOD, modules Core, Cholesky and Partition   LGPL 2.1 or later   cholmod-LGPL2.1.txt, cholmod-modules.txt
  AMD, CAMD, COLAMD, CCOLAMD, SuiteSparse_config  BSD                 amd-BSD.txt and its neighbours
  METIS 5.1.0                                     Apache 2.0          metis-Apache2.txt
  Eigen 3.4                                       MPL 2.0             eigen-MPL2.txt
  nlohmann-json                                   MIT                 nlohmann-json-MIT.txt
  musl, libc++, compiler-rt, Emscripten           MIT, Apache 2.0     emscripten-musl-libcxx.txt

None of CHOLMOD's modules under the GPL (Supernodal, Modify, MatrixOps) is inside. The page (studio.js) contains three.js, MIT: page-three.txt.

You may replace CHOLMOD by a version of your own, as section 6 of its licence says. ${archive} has its sources as they were compiled,
from Debian's source package suitesparse 5.12.0; libcholmod.a and libmetis.a have the objects. In the source of Risorius put yours in place
of build/web/suitesparse, run tools/web/build_hosted.sh, and take the new engine.wasm.gz.
`,
  );
}

for (const old of ["data", "licences"]) rmSync(join(out, old), { recursive: true, force: true });
page();
data();
licences();
const mb = (names) => (names.reduce((sum, name) => sum + weights[name], 0) / 1e6).toFixed(2);
console.log(`${out}: engine ${mb(["engine.wasm.gz"])} MB, data ${mb(Object.keys(weights).filter((name) => name.startsWith("data/")))} MB`);
