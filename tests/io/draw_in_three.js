// SPDX-License-Identifier: MIT
// Draws a face of shapes.glb in three.js with the mouth open, and says as JSON how bright the inside of the mouth is.
'use strict';

// The weight of a shape on every mesh that has it.
function setShape(scene, name, weight) {
    scene.traverse((mesh) => {
        const index = (mesh.morphTargetDictionary || {})[name];
        if (index !== undefined) mesh.morphTargetInfluences[index] = weight;
    });
}

// RGBA of a picture of the scene, rows from the bottom.
function picture(renderer, scene, camera, size) {
    renderer.render(scene, camera);
    const gl = renderer.getContext(), pixels = new Uint8Array(4 * size * size);
    gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels;
}

// Plain colours: green for what lies behind the lips, red for all else.
function paintBySubstance(scene) {
    scene.traverse((mesh) => {
        if (!mesh.isMesh) return;
        const inside = ['Mouth', 'Teeth', 'Gums', 'Tongue'].includes(mesh.material.name);
        mesh.material = new THREE.MeshBasicMaterial({
            color: inside ? 0x00ff00 : 0xff0000,
            morphTargets: mesh.morphTargetDictionary !== undefined,
            skinning: mesh.isSkinnedMesh === true,
            side: inside ? THREE.DoubleSide : THREE.FrontSide,
        });
    });
}

const luminance = (pixels, i) => 0.2126 * pixels[4 * i] + 0.7152 * pixels[4 * i + 1] + 0.0722 * pixels[4 * i + 2];

// Mean luminance of what lies inside the lips, and of the lips: skin within some pixels of it.
function mouthOf(lit, plain, size, reach) {
    const inside = [], lips = [];
    const isInside = (x, y) => plain[4 * (y * size + x) + 1] > 128;
    const isSkin = (x, y) => plain[4 * (y * size + x)] > 128;
    for (let y = reach; y < size - reach; ++y)
        for (let x = reach; x < size - reach; ++x) {
            if (isInside(x, y)) inside.push(luminance(lit, y * size + x));
            if (!isSkin(x, y)) continue;
            let near = false;
            for (let d = 1; d <= reach && !near; ++d)
                near = isInside(x + d, y) || isInside(x - d, y) || isInside(x, y + d) || isInside(x, y - d);
            if (near) lips.push(luminance(lit, y * size + x));
        }
    const mean = (list) => list.reduce((a, b) => a + b, 0) / Math.max(1, list.length);
    return {inside: mean(inside), lips: mean(lips), pixels: [inside.length, lips.length]};
}

// Bytes of the textures in which three.js keeps morph targets: positions and normals of each, four floats a vertex.
function morphMemory(scene) {
    let bytes = 0;
    scene.traverse((mesh) => {
        const morphs = mesh.isMesh && mesh.geometry.morphAttributes;
        if (!morphs || !morphs.position) return;
        const attributes = 1 + (morphs.normal ? 1 : 0);
        bytes += mesh.geometry.attributes.position.count * morphs.position.length * attributes * 16;
    });
    return bytes;
}

function drawMouth(buffer, size, say) {
    new THREE.GLTFLoader().parse(buffer, '', (gltf) => {
        const scene = new THREE.Scene();
        scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x888888, 1));
        const sun = new THREE.DirectionalLight(0xffffff, 0.6);
        sun.position.set(0.3, 0.5, 1);
        scene.add(sun);
        const camera = new THREE.OrthographicCamera(-0.06, 0.06, 0.06, -0.06, 0.01, 2);
        camera.position.set(0, -0.055, 1);
        const renderer = new THREE.WebGLRenderer({antialias: false, preserveDrawingBuffer: true});
        if (THREE.sRGBEncoding !== undefined) renderer.outputEncoding = THREE.sRGBEncoding;
        renderer.setSize(size, size);
        document.body.appendChild(renderer.domElement);
        setShape(gltf.scene, 'jawOpen', 1);
        gltf.scene.traverse((mesh) => { mesh.frustumCulled = false; });
        const lit = picture(renderer, scene, camera, size);
        const calls = renderer.info.render.calls;
        const still = renderer.domElement.toDataURL('image/png');
        let meshes = 0, withMap = 0;
        gltf.scene.traverse((mesh) => {
            if (!mesh.isMesh) return;
            ++meshes;
            if (mesh.material.map) ++withMap;
        });
        const morphBytes = morphMemory(gltf.scene);
        paintBySubstance(gltf.scene);
        const plain = picture(renderer, scene, camera, size);
        say({
            mouth: mouthOf(lit, plain, size, 6),
            calls: calls,
            names: ['Face', 'LeftEye'].filter((name) => gltf.scene.getObjectByName(name)),
            meshes: meshes,
            withMap: withMap,
            morphBytes: morphBytes,
            picture: still,
        });
    }, (error) => say({error: String(error)}));
}
