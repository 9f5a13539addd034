"use strict";

/**
 * Draws frames on a canvas with WebGL 2, or returns null without it.
 *
 * The viewer has its own axes: x to the right, y up, z towards the reader, the scene's middle at 0. A recording has its direction
 * `up`, the number of `vertices`, `triangles`, `parts` of them, `frameSteps`, `bounds` of each frame, and `write(frame, out)`,
 * which writes positions.
 */
function createViewer(canvas, recording, onChange) {
  const gl = canvas.getContext("webgl2", { alpha: true, antialias: true });
  if (!gl) return null;

  const scene = placeScene(recording);
  const camera = { yaw: 0, pitch: 0, distance: 1, target: [0, 0, 0] };
  const shown = { edges: false, bodies: true };

  const SHADOW = 2048;
  const FIELD = 0.6; // The vertical field of view, in radians.
  const SUN = normalized([-0.5, 1, 0.65]);

  const surface = program(gl, SURFACE_VERTEX, SURFACE_FRAGMENT);
  const depth = program(gl, DEPTH_VERTEX, DEPTH_FRAGMENT);
  const floor = program(gl, FLOOR_VERTEX, FLOOR_FRAGMENT);
  const lines = program(gl, LINE_VERTEX, LINE_FRAGMENT);

  const points = new Float32Array(3 * recording.vertices);
  const normals = new Float32Array(3 * recording.vertices);
  const pointBuffer = gl.createBuffer();
  const normalBuffer = gl.createBuffer();
  const vertices = gl.createVertexArray();
  gl.bindVertexArray(vertices);
  attribute(gl, 0, pointBuffer, points.byteLength);
  attribute(gl, 1, normalBuffer, normals.byteLength);
  elements(gl, recording.triangles);
  gl.bindVertexArray(null);
  let edges = null;
  const tintBuffer = gl.createBuffer();
  gl.vertexAttrib4f(2, 0, 0, 0, 0); // Nothing is mixed in.

  const shadowMap = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, shadowMap);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW, SHADOW);
  for (const [name, value] of [
    [gl.TEXTURE_MIN_FILTER, gl.LINEAR],
    [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    [gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE],
    [gl.TEXTURE_COMPARE_FUNC, gl.LEQUAL],
  ]) gl.texParameteri(gl.TEXTURE_2D, name, value);
  const shadowTarget = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, shadowTarget);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, shadowMap, 0);
  gl.drawBuffers([gl.NONE]);
  gl.readBuffer(gl.NONE);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);

  const reach = 1.05 * scene.radius;
  const sunView = lookAt(scaled(SUN, 2 * reach), [0, 0, 0]);
  const sunMatrix = multiplied(orthographic(reach, reach, 4 * reach), sunView);

  /** Calls `draw` with each part's place among all triangles. */
  function eachPart(draw) {
    let first = 0;
    for (const part of recording.parts) {
      if (part.kind === "cloth" || shown.bodies) draw(part, first);
      first += part.triangles;
    }
  }

  function drawTriangles() {
    eachPart((part, first) => gl.drawElements(gl.TRIANGLES, 3 * part.triangles, gl.UNSIGNED_INT, 12 * first));
  }

  function setFrame(frame) {
    recording.write(frame, points);
    scene.place(points);
    writeNormals(recording.triangles, points, normals);
    gl.bindBuffer(gl.ARRAY_BUFFER, pointBuffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, points);
    gl.bindBuffer(gl.ARRAY_BUFFER, normalBuffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, normals);
  }

  /** Mixes a colour into the surface at each vertex: red, green, blue as linear light, and the share; `null` mixes in nothing. */
  function setTints(tints) {
    gl.bindVertexArray(vertices);
    if (tints) {
      gl.bindBuffer(gl.ARRAY_BUFFER, tintBuffer);
      gl.bufferData(gl.ARRAY_BUFFER, tints, gl.DYNAMIC_DRAW);
      gl.vertexAttribPointer(2, 4, gl.FLOAT, false, 0, 0);
      gl.enableVertexAttribArray(2);
    } else {
      gl.disableVertexAttribArray(2);
      gl.vertexAttrib4f(2, 0, 0, 0, 0);
    }
    gl.bindVertexArray(null);
    onChange();
  }

  /** Replaces the triangles where they have changed, as after a tear. */
  function setTriangles(triangles) {
    recording.triangles = triangles;
    gl.bindVertexArray(vertices);
    elements(gl, triangles);
    gl.bindVertexArray(null);
    edges = null;
  }

  /** The projection of the last draw, from the viewer's axes to the canvas. */
  let projected = null;

  /** Returns the vertex below a place on the canvas, from 0 to 1, and its depth; `null` if none is within `reach`. */
  function pick(across, down, reach) {
    if (!projected) return null;
    const aspect = canvas.width / canvas.height;
    let best = null;
    for (let v = 0; v < recording.vertices; v++) {
      const [x, y, , w] = transformed(projected, points.subarray(3 * v, 3 * v + 3));
      if (!(w > 0)) continue;
      const distance = Math.hypot((0.5 + 0.5 * x / w - across) * aspect, 0.5 - 0.5 * y / w - down);
      // Of the vertices below the place, the nearest to the eye.
      if (distance < reach && (!best || w + 20 * distance * scene.radius < best.rank)) {
        best = { vertex: v, depth: w, rank: w + 20 * distance * scene.radius };
      }
    }
    return best;
  }

  /** Returns the point of the recording at a place on the canvas and at a depth. */
  function pointAt(across, down, depth) {
    const toEye = lookAt(added(camera.target, eyeOffset()), camera.target);
    const tall = Math.tan(FIELD / 2) * depth, wide = (tall * canvas.width) / canvas.height;
    const seen = [(2 * across - 1) * wide, (1 - 2 * down) * tall, -depth];
    const eye = added(camera.target, eyeOffset());
    const p = [0, 1, 2].map((i) => eye[i] + toEye[4 * i] * seen[0] + toEye[4 * i + 1] * seen[1] + toEye[4 * i + 2] * seen[2]);
    return scene.unplace(p);
  }

  function eyeOffset() {
    const { yaw, pitch, distance } = camera;
    const level = Math.cos(pitch);
    return scaled([Math.sin(yaw) * level, Math.sin(pitch), Math.cos(yaw) * level], distance);
  }

  function draw() {
    const width = canvas.width, height = canvas.height;
    if (!width || !height || gl.isContextLost()) return;
    const eye = added(camera.target, eyeOffset());
    // The floor fades out until 2.6 radii.
    const away = Math.hypot(...eye);
    const near = Math.max(0.02 * camera.distance, away - 2.8 * scene.radius);
    const projection = perspective(FIELD, width / height, near, away + 3 * scene.radius);
    const matrix = multiplied(projection, lookAt(eye, camera.target));
    projected = matrix;
    const colours = themeColours(canvas);

    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.disable(gl.BLEND);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.bindVertexArray(vertices);

    gl.bindFramebuffer(gl.FRAMEBUFFER, shadowTarget);
    gl.viewport(0, 0, SHADOW, SHADOW);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.polygonOffset(2.5, 8);
    gl.useProgram(depth.program);
    gl.uniformMatrix4fv(depth.at("matrix"), false, sunMatrix);
    drawTriangles();

    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.polygonOffset(1, 1);
    gl.useProgram(surface.program);
    gl.uniformMatrix4fv(surface.at("matrix"), false, matrix);
    gl.uniformMatrix4fv(surface.at("sunMatrix"), false, sunMatrix);
    gl.uniform3fv(surface.at("eye"), eye);
    gl.uniform3fv(surface.at("sun"), SUN);
    gl.uniform1f(surface.at("lift"), 0.008 * scene.radius);
    eachPart((part, first) => {
      const isCloth = part.kind === "cloth";
      gl.uniform3fv(surface.at("front"), isCloth ? colours.cloths[part.colour] : colours.body);
      gl.uniform3fv(surface.at("back"), isCloth ? colours.lining : colours.body);
      gl.uniform1f(surface.at("sheen"), isCloth ? 1 : 0);
      gl.drawElements(gl.TRIANGLES, 3 * part.triangles, gl.UNSIGNED_INT, 12 * first);
    });

    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    if (shown.edges) {
      edges ??= createEdges(gl, recording, pointBuffer);
      gl.bindVertexArray(edges.vertices);
      gl.useProgram(lines.program);
      gl.uniformMatrix4fv(lines.at("matrix"), false, matrix);
      gl.uniform3fv(lines.at("eye"), eye);
      gl.uniform1f(lines.at("lift"), 0.003 * scene.radius);
      gl.uniform4fv(lines.at("colour"), [0, 0, 0, 0.4]);
      gl.drawElements(gl.LINES, shown.bodies ? edges.count : edges.ofCloth, gl.UNSIGNED_INT, 0);
    }
    if (eye[1] > scene.floor) {
      gl.bindVertexArray(null);
      gl.useProgram(floor.program);
      gl.uniformMatrix4fv(floor.at("matrix"), false, matrix);
      gl.uniformMatrix4fv(floor.at("sunMatrix"), false, sunMatrix);
      gl.uniform1f(floor.at("height"), scene.floor);
      gl.uniform1f(floor.at("radius"), scene.radius);
      gl.uniform1f(floor.at("spacing"), scene.gridSpacing);
      gl.uniform2fv(floor.at("origin"), scene.gridOrigin);
      gl.uniform3fv(floor.at("ink"), colours.grid);
      gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    }
  }

  /** Shows the whole animation from the front, a little from above and from the side. */
  function reset() {
    camera.yaw = scene.yaw - 0.45;
    camera.pitch = 0.3;
    camera.target = [0, 0, 0];
    camera.distance = 1;
    // The eye is far enough away that every point, at its own depth, is in view.
    const toView = lookAt(eyeOffset(), [0, 0, 0]);
    const tall = Math.tan(FIELD / 2) * 0.9;
    const wide = tall * (canvas.width / canvas.height || 1);
    let distance = 0;
    for (let i = 0; i < scene.sample.length; i += 3) {
      const [x, y, z] = transformed(toView, scene.sample.subarray(i, i + 3));
      distance = Math.max(distance, z + 1 + Math.abs(x) / wide, z + 1 + Math.abs(y) / tall);
    }
    camera.distance = Math.max(distance, 0.01 * scene.radius);
    onChange();
  }

  function turn(across, down) {
    camera.yaw -= across;
    camera.pitch = Math.min(1.55, Math.max(-1.55, camera.pitch + down));
    onChange();
  }

  function zoom(factor) {
    const { radius } = scene;
    camera.distance = Math.min(12 * radius, Math.max(0.02 * radius, camera.distance * factor));
    onChange();
  }

  /** Pans by shares of the canvas' height. */
  function shift(across, up) {
    const span = 2 * Math.tan(FIELD / 2) * camera.distance;
    const view = lookAt(eyeOffset(), [0, 0, 0]);
    for (let axis = 0; axis < 3; axis++) {
      camera.target[axis] += span * (across * view[4 * axis] + up * view[4 * axis + 1]);
    }
    onChange();
  }

  function resize() {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * scale), height = Math.round(canvas.clientHeight * scale);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
      onChange();
    }
  }

  return {
    setFrame, setTints, setTriangles, draw, reset, turn, zoom, shift, resize, pick, pointAt, shown, gridSpacing: scene.gridSpacing,
  };
}

/** Lets pointers and keys rotate, zoom and pan the view. */
function steerView(canvas, viewer) {
  const pointers = new Map();
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  const release = (event) => pointers.delete(event.pointerId);
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointermove", (event) => {
    const from = pointers.get(event.pointerId);
    if (!from) return;
    const to = [event.clientX, event.clientY];
    const across = (to[0] - from[0]) / canvas.clientHeight, down = (to[1] - from[1]) / canvas.clientHeight;
    const others = [...pointers].filter(([id]) => id !== event.pointerId);
    if (others.length) {
      const [, other] = others[0];
      const before = Math.hypot(from[0] - other[0], from[1] - other[1]);
      const after = Math.hypot(to[0] - other[0], to[1] - other[1]);
      viewer.zoom(before / Math.max(after, 1));
      viewer.shift(-across / 2, down / 2);
    } else if (event.buttons === 1 && !event.shiftKey) {
      viewer.turn(4 * across, 4 * down);
    } else {
      viewer.shift(-across, down);
    }
    pointers.set(event.pointerId, to);
  });
  // A reader who only scrolls past is not stopped.
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
    viewer.zoom(Math.exp(0.0015 * Math.max(-400, Math.min(400, pixels))));
  }, { passive: false });
  const keys = {
    ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
  };
  canvas.addEventListener("keydown", (event) => {
    const arrow = keys[event.key];
    if (arrow && event.shiftKey) viewer.shift(0.05 * arrow[0], -0.05 * arrow[1]);
    else if (arrow) viewer.turn(-0.12 * arrow[0], -0.12 * arrow[1]);
    else if (event.key === "+" || event.key === "=") viewer.zoom(0.9);
    else if (event.key === "-") viewer.zoom(1 / 0.9);
    else return;
    event.preventDefault();
  });
}

/** Returns places in the viewer's axes, over all frames. */
function placeScene(recording) {
  const up = recording.up;
  // The axis that is least upright becomes horizontal.
  const axis = [0, 1, 2].reduce((best, i) => (Math.abs(up[i]) < Math.abs(up[best]) ? i : best), 0);
  const across = normalized([0, 1, 2].map((i) => (i === axis ? 1 : 0) - up[axis] * up[i]));
  const rows = [across, up, crossed(across, up)];
  const rotate = (p) => rows.map((row) => dot(row, p));

  const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
  const frames = recording.frameSteps.length;
  for (let frame = 0; frame < frames; frame++) {
    const box = recording.bounds.subarray(6 * frame, 6 * frame + 6);
    for (let corner = 0; corner < 8; corner++) {
      const p = rotate([0, 1, 2].map((i) => box[i] + ((corner >> i) & 1) * box[3 + i]));
      for (let i = 0; i < 3; i++) {
        least[i] = Math.min(least[i], p[i]);
        most[i] = Math.max(most[i], p[i]);
      }
    }
  }
  const middle = least.map((low, i) => 0.5 * (low + most[i]));
  const place = (points) => {
    // Written out, since it runs for each vertex of each frame.
    const [[a, b, c], [d, e, f], [g, h, j]] = rows;
    for (let i = 0; i < points.length; i += 3) {
      const x = points[i], y = points[i + 1], z = points[i + 2];
      points[i] = a * x + b * y + c * z - middle[0];
      points[i + 1] = d * x + e * y + f * z - middle[1];
      points[i + 2] = g * x + h * y + j * z - middle[2];
    }
  };

  const unplace = (p) => {
    const q = added(p, middle);
    return [0, 1, 2].map((i) => rows[0][i] * q[0] + rows[1][i] * q[1] + rows[2][i] * q[2]);
  };

  // A few thousand points of a few frames determine the view.
  const points = new Float32Array(3 * recording.vertices);
  const sample = [];
  const stride = Math.max(1, Math.floor(recording.vertices / 400));
  for (let k = 0; k < 12; k++) {
    recording.write(Math.round((k / 11) * (frames - 1)), points);
    place(points);
    for (let v = 0; v < recording.vertices; v += stride) sample.push(...points.subarray(3 * v, 3 * v + 3));
  }
  let radius = 0;
  for (let i = 0; i < sample.length; i += 3) radius = Math.max(radius, Math.hypot(sample[i], sample[i + 1], sample[i + 2]));
  radius = Math.max(radius, 1e-9);
  const gridSpacing = niceStep(2 * radius, 10);
  return {
    place, unplace, radius, gridSpacing,
    sample: Float32Array.from(sample),
    gridOrigin: [middle[0], middle[2]],
    // A little lower, so that objects on the ground do not intersect it.
    floor: least[1] - middle[1] - 0.002 * radius,
    yaw: most[2] - least[2] > most[0] - least[0] ? Math.PI / 2 : 0,
  };
}

/** Returns vertex normals, each triangle weighted by its area. */
function writeNormals(triangles, points, normals) {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = points[b] - points[a], uy = points[b + 1] - points[a + 1], uz = points[b + 2] - points[a + 2];
    const vx = points[c] - points[a], vy = points[c + 1] - points[a + 1], vz = points[c + 2] - points[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    normals[a] += x; normals[a + 1] += y; normals[a + 2] += z;
    normals[b] += x; normals[b + 1] += y; normals[b + 2] += z;
    normals[c] += x; normals[c + 1] += y; normals[c + 2] += z;
  }
}

/** Returns every edge once, the cloth's first. */
function createEdges(gl, recording, pointBuffer) {
  const seen = new Set();
  const ends = [];
  let ofCloth = 0;
  const add = (a, b) => {
    const key = Math.min(a, b) * recording.vertices + Math.max(a, b);
    if (seen.has(key)) return;
    seen.add(key);
    ends.push(a, b);
  };
  for (const kind of ["cloth", "body"]) {
    let first = 0;
    for (const part of recording.parts) {
      const corners = recording.triangles.subarray(3 * first, 3 * (first + part.triangles));
      for (let i = 0; part.kind === kind && i < corners.length; i += 3) {
        for (let k = 0; k < 3; k++) add(corners[i + k], corners[i + ((k + 1) % 3)]);
      }
      first += part.triangles;
    }
    if (kind === "cloth") ofCloth = ends.length;
  }
  const vertices = gl.createVertexArray();
  gl.bindVertexArray(vertices);
  attribute(gl, 0, pointBuffer, null);
  elements(gl, Uint32Array.from(ends));
  return { vertices, count: ends.length, ofCloth };
}

function attribute(gl, index, buffer, bytes) {
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  if (bytes !== null) gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(index);
  gl.vertexAttribPointer(index, 3, gl.FLOAT, false, 0, 0);
}

function elements(gl, indices) {
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
}

/** Returns the theme's colours, as linear light. */
function themeColours(canvas) {
  const style = getComputedStyle(canvas);
  const linear = (name) => {
    const hex = style.getPropertyValue(name).trim().slice(1);
    return [0, 2, 4].map((i) => (parseInt(hex.slice(i, i + 2), 16) / 255) ** 2.2);
  };
  const cloths = [0, 1, 2, 3].map((colour) => linear(`--cloth-${colour}`));
  return { cloths, lining: linear("--lining"), body: linear("--body"), grid: linear("--grid") };
}
