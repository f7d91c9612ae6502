// SPDX-License-Identifier: MIT
// Loads a .glb by three.js' GLTFLoader, in node or in a browser, and says as JSON what came of it.
'use strict';

// In world space, m: of every mesh the base vertices, and the largest move of each morph target at weight 1.
function described(gltf) {
    const out = {meshes: [], animations: []};
    gltf.scene.updateMatrixWorld(true);
    gltf.scene.traverse((node) => {
        if (!node.isMesh) return;
        const morphs = node.geometry.morphAttributes, base = node.geometry.attributes.position;
        const scale = new THREE.Vector3().setFromMatrixScale(node.matrixWorld).x;
        const relative = node.geometry.morphTargetsRelative === true;
        const targets = {};
        for (const [name, index] of Object.entries(node.morphTargetDictionary || {})) {
            const at = morphs.position[index];
            let largest = 0;
            for (let v = 0; v < at.count; ++v) {
                const move = [at.getX(v), at.getY(v), at.getZ(v)];
                if (!relative) {
                    move[0] -= base.getX(v);
                    move[1] -= base.getY(v);
                    move[2] -= base.getZ(v);
                }
                largest = Math.max(largest, Math.hypot(...move));
            }
            targets[name] = scale * largest;
        }
        const box = new THREE.Box3().setFromBufferAttribute(base).applyMatrix4(node.matrixWorld);
        out.meshes.push({
            vertices: base.count,
            normals: morphs.normal ? morphs.normal.length : 0,
            names: Object.keys(targets),
            largest: targets,
            box: [box.min.toArray(), box.max.toArray()],
        });
    });
    for (const animation of gltf.animations)
        out.animations.push({
            name: animation.name,
            duration: animation.duration,
            tracks: animation.tracks.map((track) => [track.name, track.times.length, track.values.length]),
        });
    return out;
}

function load(buffer, say) {
    new THREE.GLTFLoader().parse(
        buffer, '', (gltf) => say(described(gltf)), (error) => say({error: String(error)}));
}

if (typeof process !== 'undefined' && process.argv) {
    // node load_in_three.js FOLDER_OF_THREE FILE.glb
    const fs = require('fs'), vm = require('vm');
    for (const file of ['build/three.js', 'examples/js/loaders/GLTFLoader.js']) {
        const code = fs.readFileSync(process.argv[2] + '/' + file, 'utf8');
        vm.runInThisContext(code, {filename: file});
    }
    const bytes = fs.readFileSync(process.argv[3]);
    load(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length),
         (what) => console.log(JSON.stringify(what)));
}
