// SPDX-License-Identifier: MIT
/// \file
/// Materials for machines without a graphics processor: light is computed at the vertices. A picture of 700 x 640 takes a third of the
/// time of three's standard material then.

import * as THREE from "three";

let known: boolean | null = null;

/// Whether WebGL draws on the processor, as far as the browser tells.
export function softwareGl(): boolean {
  if (known !== null) return known;
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  known = /swiftshader|llvmpipe|software|basic render/i.test(name);
  return known;
}

const vertexShader = `
  #ifdef USE_VERTEX_COLOUR
  attribute vec3 color;
  #endif
  varying vec3 lit;
  varying vec2 place;
  // The lamps of the stage, which move with the camera: directions and strengths in the frame of the view.
  void main() {
    vec3 n = normalize(normalMatrix * normal);
    vec3 key = normalize(vec3(-0.7, 0.8, 1.0)), fill = normalize(vec3(1.0, 0.2, 0.7)), rim = normalize(vec3(0.5, 0.7, -1.0));
    lit = mix(vec3(0.10, 0.085, 0.075), vec3(0.36, 0.38, 0.41), 0.5 + 0.5 * n.y);
    lit += max(dot(n, key), 0.0) * vec3(0.80, 0.77, 0.73) + max(dot(n, fill), 0.0) * vec3(0.29, 0.31, 0.34);
    lit += max(dot(n, rim), 0.0) * vec3(0.45, 0.47, 0.5);
    #ifdef USE_VERTEX_COLOUR
    lit *= color;
    #endif
    place = uv;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const fragmentShader = `
  uniform vec3 colour;
  uniform sampler2D picture;
  uniform mat3 pictureTransform;
  uniform float opacity;
  varying vec3 lit;
  varying vec2 place;
  void main() {
    vec3 c = lit * colour;
    float a = opacity;
    #ifdef USE_PICTURE
    c *= texture2D(picture, (pictureTransform * vec3(place, 1.0)).xy).rgb;
    #endif
    #ifdef USE_OPACITY
    a *= texture2D(picture, place).g;
    #endif
    gl_FragColor = vec4(c, a);
    #include <colorspace_fragment>
  }`;

/// The lean form of a standard material.
export function lean(from: THREE.Material): THREE.ShaderMaterial {
  const standard = from as THREE.MeshStandardMaterial;
  const map = standard.map ?? standard.alphaMap ?? null;
  if (standard.map) standard.map.updateMatrix();
  const defines: Record<string, string> = {};
  if (standard.map) defines.USE_PICTURE = "";
  else if (standard.alphaMap) defines.USE_OPACITY = "";
  if (standard.vertexColors) defines.USE_VERTEX_COLOUR = "";
  return new THREE.ShaderMaterial({
    defines,
    vertexShader,
    fragmentShader,
    uniforms: {
      colour: { value: standard.color ?? new THREE.Color(1, 1, 1) },
      picture: { value: map },
      pictureTransform: { value: standard.map ? standard.map.matrix : new THREE.Matrix3() },
      opacity: { value: standard.opacity },
    },
    transparent: standard.transparent,
    depthWrite: standard.depthWrite,
    side: standard.side,
  });
}
