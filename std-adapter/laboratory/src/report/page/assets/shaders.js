"use strict";

function program(gl, vertexSource, fragmentSource) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = gl.getAttachedShaders(made).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error(`a shader does not build: ${gl.getProgramInfoLog(made)} ${logs.join(" ")}`);
  }
  const places = new Map();
  const at = (name) => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(made, name));
    return places.get(name);
  };
  return { program: made, at };
}

const SUNLIGHT = `
uniform mediump sampler2DShadow shadowMap;

// The share of sunlight at a point, over a few texels around its place on the map.
float sunlight(vec4 place) {
  vec3 p = place.xyz * 0.5 + 0.5;
  if (any(greaterThan(abs(p - 0.5), vec3(0.5)))) return 1.0;
  float sum = 0.0;
  for (int y = -2; y <= 2; y++) {
    for (int x = -2; x <= 2; x++) sum += texture(shadowMap, p + vec3(vec2(x, y) * (1.2 / 2048.0), 0.0));
  }
  return sum / 25.0;
}
`;

const SURFACE_VERTEX = `#version 300 es
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 matrix;
uniform mat4 sunMatrix;
uniform vec3 sun;
uniform float lift;
out vec3 where;
out vec3 outward;
out vec4 sunPlace;
out vec4 tint;
void main() {
  where = point;
  tint = colour;
  // Sums of areas may be so small that their squares underflow.
  outward = normal / max(max(abs(normal.x), abs(normal.y)), max(abs(normal.z), 1e-30));
  // The lookup is a little off the surface, towards the sun, so that coarse triangles do not shade themselves.
  vec3 lifted = point + normalize(outward) * sign(dot(outward, sun)) * lift;
  sunPlace = sunMatrix * vec4(lifted, 1.0);
  gl_Position = matrix * vec4(point, 1.0);
}`;

const SURFACE_FRAGMENT = `#version 300 es
precision highp float;
in vec3 where;
in vec3 outward;
in vec4 sunPlace;
in vec4 tint;
uniform vec3 eye;
uniform vec3 sun;
uniform vec3 front;
uniform vec3 back;
uniform float sheen;
out vec4 colour;
${SUNLIGHT}
void main() {
  vec3 n = normalize(outward) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 toEye = normalize(eye - where);
  vec3 base = mix(gl_FrontFacing ? front : back, tint.rgb, tint.a);
  float facing = dot(n, sun);
  float direct = max((facing + 0.2) / 1.2, 0.0) * mix(0.1, 1.0, sunlight(sunPlace));
  vec3 ambient = mix(vec3(0.13, 0.12, 0.115), vec3(0.30, 0.32, 0.36), 0.5 + 0.5 * n.y);
  // A lamp at the eye keeps folds in the shade legible.
  float lamp = 0.14 * max(dot(n, toEye), 0.0);
  float rim = pow(1.0 - max(dot(n, toEye), 0.0), 3.0);
  float gloss = pow(max(dot(n, normalize(sun + toEye)), 0.0), 32.0);
  vec3 light = base * (ambient + lamp + 0.85 * direct * vec3(1.0, 0.97, 0.92));
  light += sheen * 0.16 * rim * (base + 0.15) + (1.0 - sheen) * 0.08 * gloss * direct;
  colour = vec4(pow(light, vec3(1.0 / 2.2)), 1.0);
}`;

const DEPTH_VERTEX = `#version 300 es
layout(location = 0) in vec3 point;
uniform mat4 matrix;
void main() { gl_Position = matrix * vec4(point, 1.0); }`;

const DEPTH_FRAGMENT = `#version 300 es
void main() {}`;

const LINE_VERTEX = `#version 300 es
layout(location = 0) in vec3 point;
uniform mat4 matrix;
uniform vec3 eye;
uniform float lift;
// Lines are nearer to the eye than their triangles.
void main() { gl_Position = matrix * vec4(point + normalize(eye - point) * lift, 1.0); }`;

const LINE_FRAGMENT = `#version 300 es
precision highp float;
uniform vec4 colour;
out vec4 result;
void main() { result = colour; }`;

const FLOOR_VERTEX = `#version 300 es
uniform mat4 matrix;
uniform mat4 sunMatrix;
uniform float height;
uniform float radius;
out vec2 place;
out vec4 sunPlace;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  place = corner * 3.0 * radius;
  vec4 point = vec4(place.x, height, place.y, 1.0);
  sunPlace = sunMatrix * point;
  gl_Position = matrix * point;
}`;

const FLOOR_FRAGMENT = `#version 300 es
precision highp float;
in vec2 place;
in vec4 sunPlace;
uniform float radius;
uniform float spacing;
uniform vec2 origin;
uniform vec3 ink;
out vec4 colour;
${SUNLIGHT}
void main() {
  float fade = 1.0 - smoothstep(0.9, 2.6, length(place) / radius);
  vec2 cell = (place + origin) / spacing;
  vec2 width = fwidth(cell);
  vec2 distance = abs(fract(cell - 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 strength = clamp(1.0 - distance + 0.3, 0.0, 1.0) * clamp(0.35 / max(width, vec2(1e-6)), 0.0, 1.0);
  float line = max(strength.x, strength.y) * 0.55 * fade;
  float shade = (1.0 - sunlight(sunPlace)) * 0.28 * fade;
  float alpha = 1.0 - (1.0 - line) * (1.0 - shade);
  colour = vec4(pow(ink, vec3(1.0 / 2.2)) * line * (1.0 - shade), alpha);
}`;
