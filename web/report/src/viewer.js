// SPDX-License-Identifier: Apache-2.0
// The particles of up to four runs side by side, at the same time and from the same direction. Longer than 400 lines because
// scene, camera and pointer share the state of one canvas.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { colours } from "./colour.js";
import { decode, frames as unpackFrames, numbers } from "./data.js";

const vertexShader = `
  attribute vec4 code;    // of position and field
  attribute float radius; // in the scene's length
  uniform vec3 low, step, centre;
  uniform vec2 field;     // value = field.x + code * field.y
  uniform vec2 range;
  uniform float none, pixels; // code without a value; pixels per length
  varying float place;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(low + code.xyz * step - centre, 1.0);
    if (code.x > 65534.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = max(2.0 * radius * pixels, 2.5);
    place = code.w > none - 0.5 ? -1.0 : clamp((field.x + code.w * field.y - range.x) / (range.y - range.x), 0.0, 1.0);
  }`;

const fragmentShader = `
  uniform sampler2D map;
  varying float place;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    float square = dot(at, at);
    if (square > 1.0) discard;
    vec3 colour = place < 0.0 ? vec3(0.5) : texture2D(map, vec2((place * 255.0 + 0.5) / 256.0, 0.5)).rgb;
    gl_FragColor = vec4(colour * (0.84 + 0.16 * sqrt(1.0 - square)), 1.0);
  }`;

export const directions = {
  xz: { label: "Front", from: [0, -1, 0] },
  yz: { label: "Side", from: [1, 0, 0] },
  xy: { label: "Top", from: [0, -1e-4, 1] },
  free: { label: "Oblique", from: [0.55, -0.75, 0.42] },
};

/** Particles, walls and air of one run. Lengths in the scene are those of the run times `scale`. */
class Panel {
  constructor(run, scale) {
    this.run = run;
    this.frames = run.frames;
    this.scale = scale;
    this.count = this.frames.count ?? 0;
    this.scene = new three.Scene();
    this.group = new three.Group(); // moves where the view follows the particles
    this.scene.add(this.group);
    this.frame = -1;
  }

  async load() {
    const { count, frames } = this;
    this.positions = await Promise.all((frames.position ?? []).map((axis) => unpackFrames(axis.block, count)));
    this.codes = new Uint16Array(4 * count);
    const radius = (frames.fields ?? []).find((field) => field.name === "radius");
    const radii = new Float32Array(count).fill(this.run.scene.radius * this.scale);
    if (radius) {
      const all = await unpackFrames(radius.block, count);
      for (let n = 0; n < count; ++n) radii[n] = decode(radius, all[n]) * this.scale || radii[n];
    }
    this.radii = radii;
    this.ratio = (frames.fields ?? []).find((field) => field.name === "mass_ratio");
    if (this.ratio) this.ratios = await unpackFrames(this.ratio.block, count);
    if (frames.identity !== undefined) this.identities = await numbers(frames.identity);
    if (frames.air)
      this.air = await Promise.all(
        frames.air.velocity.map((axis) => unpackFrames(axis.block, frames.air.count.reduce((a, b) => a * b))),
      );
  }

  /** Low and high corner of the vessel, or of what the particles reach, m. */
  extent() {
    if (this.run.scene.box) return this.run.scene.box;
    const axes = this.frames.position;
    return [axes.map((axis) => axis.low), axes.map((axis) => axis.high)];
  }

  /** The place of a particle, m. */
  position(frame, n) {
    return this.frames.position.map((axis, a) => decode(axis, this.positions[a][frame * this.count + n]));
  }

  /** Middle of the particles of a frame, and the half size of the box that holds 96 % of them along each axis, m. */
  middle(frame) {
    this.middles ??= [];
    return (this.middles[frame] ??= this.frames.position.map((axis, a) => {
      const codes = this.positions[a].slice(frame * this.count, (frame + 1) * this.count).sort();
      const at = (share) => decode(axis, Math.min(codes[Math.floor(share * (codes.length - 1))], axis.levels - 1));
      return { centre: 0.5 * (at(0.02) + at(0.98)), half: 0.5 * (at(0.98) - at(0.02)) };
    }));
  }

  build(centre, map, lineColours) {
    this.centre = centre;
    const axes = this.frames.position ?? [];
    if (this.count > 0) {
      const geometry = new three.BufferGeometry();
      this.code = new three.BufferAttribute(this.codes, 4).setUsage(three.DynamicDrawUsage);
      geometry.setAttribute("code", this.code);
      this.radius = new three.BufferAttribute(this.radii, 1).setUsage(three.DynamicDrawUsage);
      geometry.setAttribute("radius", this.radius);
      geometry.setDrawRange(0, this.count);
      const step = axes.map((axis) => ((axis.high - axis.low) / (axis.levels - 1)) * this.scale);
      this.material = new three.ShaderMaterial({
        vertexShader,
        fragmentShader,
        uniforms: {
          low: { value: new three.Vector3(...axes.map((axis) => axis.low * this.scale)) },
          step: { value: new three.Vector3(...step) },
          centre: { value: new three.Vector3(...centre.map((c) => c * this.scale)) },
          field: { value: new three.Vector2(0, 0) },
          range: { value: new three.Vector2(0, 1) },
          none: { value: 65536 },
          pixels: { value: 1 },
          map: { value: map },
        },
      });
      const points = new three.Points(geometry, this.material);
      points.frustumCulled = false;
      this.group.add(points);
    }
    const lines = (segments, colour, width, opacity = 1) => {
      const geometry = new LineSegmentsGeometry();
      geometry.setPositions(segments.length ? segments : [0, 0, 0, 0, 0, 0]);
      const material = new LineMaterial({ color: colour, linewidth: width, transparent: opacity < 1, opacity });
      const made = new LineSegments2(geometry, material);
      made.frustumCulled = false;
      this.group.add(made);
      return made;
    };
    const box = this.run.scene.box ?? this.extent();
    const walls = { fixed: [], gates: new Map() };
    for (const wall of this.run.scene.walls) {
      const to = wall.until === undefined ? walls.fixed : (walls.gates.get(wall.until) ?? []);
      if (wall.until !== undefined) walls.gates.set(wall.until, to);
      const corner = (place, side) => this.inScene([place[0], box[side][1], place[2]]);
      const [a, b, c, d] = [corner(wall.from, 0), corner(wall.to, 0), corner(wall.to, 1), corner(wall.from, 1)];
      to.push(...a, ...b, ...d, ...c, ...a, ...d, ...b, ...c);
    }
    if (this.run.scene.slope) {
      const [low, high] = this.extent();
      const margin = 0.02 * (high[0] - low[0]);
      const y = [low[1] - margin, high[1] + margin];
      const corners = [[low[0] - margin, y[0], 0], [high[0] + margin, y[0], 0], [high[0] + margin, y[1], 0], [low[0] - margin, y[1], 0]];
      corners.forEach((from, n) => walls.fixed.push(...this.inScene(from), ...this.inScene(corners[(n + 1) % 4])));
    }
    this.walls = lines(walls.fixed, lineColours.ink, 1.6);
    this.gates = [...walls.gates].map(([until, segments]) => ({ until, lines: lines(segments, lineColours.gate, 2.2) }));
    if (this.air) {
      this.halo = lines([], lineColours.paper, 2.6, 0.45);
      this.arrows = lines([], lineColours.ink, 1.1, 0.9);
      this.halo.geometry = this.arrows.geometry;
      for (const part of [this.halo, this.arrows]) part.material.depthTest = false;
      this.halo.renderOrder = 1;
      this.arrows.renderOrder = 2;
      this.airScale();
    }
  }

  recolour(lineColours) {
    this.walls.material.color.set(lineColours.ink);
    for (const gate of this.gates) gate.lines.material.color.set(lineColours.gate);
    this.halo?.material.color.set(lineColours.paper);
    this.arrows?.material.color.set(lineColours.ink);
  }

  inScene(place) {
    return place.map((x, a) => (x - this.centre[a]) * this.scale);
  }

  /** The speed, one of 1, 2 and 5 times a power of ten, that is drawn as long as two cells of the arrows. */
  airScale() {
    const { velocity } = this.frames.air;
    const speeds = [];
    for (let n = 0; n < this.air[0].length; n += 7)
      speeds.push(Math.hypot(...velocity.map((axis, a) => decode(axis, this.air[a][n]))));
    speeds.sort((a, b) => a - b);
    const large = speeds[Math.floor(0.995 * (speeds.length - 1))] || 1;
    const power = 10 ** Math.floor(Math.log10(large));
    this.arrowSpeed = [1, 2, 5, 10].map((m) => m * power).findLast((v) => v <= large) ?? power;
  }

  cell() {
    const { count, spacing } = this.frames.air;
    return Math.min(...spacing.filter((_, a) => count[a] > 1));
  }

  drawAir(frame, towards) {
    const { count, first, spacing, velocity } = this.frames.air;
    const cells = count[0] * count[1] * count[2];
    const length = (2 * this.cell() * this.scale) / this.arrowSpeed;
    const least = 0.04 * this.arrowSpeed;
    const segments = [];
    const u = new three.Vector3();
    const across = new three.Vector3();
    for (let n = 0; n < cells; ++n) {
      u.set(...velocity.map((axis, a) => decode(axis, this.air[a][frame * cells + n])));
      const speed = u.length();
      if (!(speed > least)) continue;
      const ijk = [n % count[0], Math.floor(n / count[0]) % count[1], Math.floor(n / (count[0] * count[1]))];
      const tail = this.inScene(ijk.map((i, a) => first[a] + i * spacing[a]));
      u.multiplyScalar(length);
      across.crossVectors(u, towards).normalize().multiplyScalar(0.16 * u.length());
      const tip = [tail[0] + u.x, tail[1] + u.y, tail[2] + u.z];
      const barb = (side) => [
        tip[0] - 0.32 * u.x + side * across.x,
        tip[1] - 0.32 * u.y + side * across.y,
        tip[2] - 0.32 * u.z + side * across.z,
      ];
      segments.push(...tail, ...tip, ...tip, ...barb(1), ...tip, ...barb(-1));
    }
    this.arrows.geometry.dispose();
    this.arrows.geometry = this.halo.geometry = new LineSegmentsGeometry();
    this.arrows.geometry.setPositions(segments.length ? segments : [0, 0, 0, 0, 0, 0]);
  }

  /** Fills the codes of a frame. \param field its description and codes, or nothing */
  show(frame, field) {
    this.frame = frame;
    const { count, codes } = this;
    if (count > 0) {
      const from = frame * count;
      const [x, y, z] = this.positions;
      for (let n = 0; n < count; ++n) {
        codes[4 * n] = x[from + n];
        codes[4 * n + 1] = y[from + n];
        codes[4 * n + 2] = z[from + n];
        codes[4 * n + 3] = field ? field.codes[from + n] : 0;
      }
      this.code.needsUpdate = true;
      if (this.ratio) {
        const finest = this.run.scene.radius * this.scale;
        for (let n = 0; n < count; ++n) this.radii[n] = finest * (Math.cbrt(decode(this.ratio, this.ratios[from + n])) || 1);
        this.radius.needsUpdate = true;
      }
      const uniforms = this.material.uniforms;
      uniforms.none.value = field ? field.packed.levels : 0;
      if (field) {
        const { low, high, levels } = field.packed;
        uniforms.field.value.set(low, (high - low) / (levels - 1));
      }
    }
    const time = this.frames.time[frame];
    for (const gate of this.gates) gate.lines.visible = this.wallsShown !== false && time < gate.until;
  }
}

export class Viewer {
  /** \throws where there is no WebGL \param runs those with frames */
  constructor(canvas, runs) {
    this.canvas = canvas;
    this.renderer = new three.WebGLRenderer({ canvas, alpha: true, antialias: true, preserveDrawingBuffer: true });
    this.renderer.autoClear = false;
    this.renderer.setClearColor(0x000000, 0);
    this.camera = new three.OrthographicCamera(-1, 1, 1, -1, -100, 100);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.request());
    this.map = new three.DataTexture(colours("viridis"), 256, 1);
    this.map.magFilter = this.map.minFilter = three.LinearFilter;
    this.map.needsUpdate = true;
    this.runs = runs;
    this.arrowsShown = true;
    this.onrender = () => {};
  }

  async load(lineColours) {
    const all = this.runs.map((run) => run.scene.box ?? [run.frames.position.map((a) => a.low), run.frames.position.map((a) => a.high)]);
    const size = Math.max(...all.map(([low, high]) => Math.max(...high.map((h, a) => h - low[a]))));
    this.scale = 2 / (size || 1);
    this.panels = this.runs.map((run) => new Panel(run, this.scale));
    for (const panel of this.panels) {
      await panel.load();
      const [low, high] = panel.extent();
      panel.build(low.map((l, a) => 0.5 * (l + high[a])), this.map, lineColours);
    }
    this.follows = this.panels.every((panel) => !panel.run.scene.box);
    const longest = this.panels.reduce((a, b) => (b.frames.time.length > a.frames.time.length ? b : a));
    this.times = longest.frames.time;
    document.documentElement.classList.toggle("beside", this.aspect() < 1.1);
    if (this.aspect() > 2) this.canvas.parentElement.style.height = `${Math.max(360, 100 + this.canvas.clientWidth / this.aspect())}px`;
    this.resize();
    this.look(this.runs[0].scene.view);
  }

  /** Half sizes of what a view is to hold, of all runs, in the scene's length. */
  halves() {
    const halves = [0, 0, 0];
    for (const panel of this.panels) {
      const [low, high] = panel.extent();
      const frames = panel.frames.time.length;
      for (let a = 0; a < 3; ++a) {
        let half = 0.5 * (high[a] - low[a]);
        if (this.follows) {
          half = 0;
          for (let f = 0; f < frames; f += Math.max(1, Math.floor(frames / 20))) half = Math.max(half, panel.middle(f)[a].half);
          half *= 1.25;
        }
        halves[a] = Math.max(halves[a], half * this.scale);
      }
    }
    return halves;
  }

  /** Width over height of all runs side by side, as they are seen first. */
  aspect() {
    const [hx, hy, hz] = this.halves();
    return (this.panels.length * hx) / Math.max(this.runs[0].scene.view === "xy" ? hy : hz, 1e-9);
  }

  /** Turns to a direction and fits what is there into the panels. */
  look(name) {
    const from = new three.Vector3(...directions[name].from).normalize();
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(from).multiplyScalar(10);
    this.camera.zoom = 1;
    this.camera.lookAt(0, 0, 0);
    this.camera.updateMatrixWorld();
    this.fit();
    this.controls.update();
    this.request();
  }

  fit() {
    const [hx, hy, hz] = this.halves();
    let width = 1e-9;
    let height = 1e-9;
    const corner = new three.Vector3();
    const turn = this.camera.matrixWorldInverse.copy(this.camera.matrixWorld).invert();
    for (let n = 0; n < 8; ++n) {
      corner.set(n & 1 ? hx : -hx, n & 2 ? hy : -hy, n & 4 ? hz : -hz).transformDirection(turn).multiplyScalar(Math.hypot(hx, hy, hz));
      width = Math.max(width, Math.abs(corner.x));
      height = Math.max(height, Math.abs(corner.y));
    }
    // As many columns as show the runs largest.
    const count = this.panels.length;
    let best = { size: 0 };
    for (let columns = 1; columns <= count; ++columns) {
      const rows = Math.ceil(count / columns);
      const size = Math.min(this.width / columns / (2.1 * width), (this.height / rows - 58) / (2.08 * height));
      if (size > best.size) best = { size, columns, rows };
    }
    this.layout = best;
    this.pixelsAtFit = best.size;
    this.setFrustum();
  }

  setFrustum() {
    const { columns, rows } = this.layout;
    const width = this.width / columns / this.pixelsAtFit / 2;
    const height = this.height / rows / this.pixelsAtFit / 2;
    Object.assign(this.camera, { left: -width, right: width, top: height, bottom: -height });
    this.camera.updateProjectionMatrix();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (!clientWidth || (clientWidth === this.width && clientHeight === this.height)) return;
    this.width = clientWidth;
    this.height = clientHeight;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    if (this.layout) this.fit();
    this.request();
  }

  setMap(name) {
    this.map.image.data.set(colours(name));
    this.map.needsUpdate = true;
    this.request();
  }

  setRange(low, high) {
    for (const panel of this.panels) panel.material?.uniforms.range.value.set(low, high > low ? high : low + 1e-30);
    this.request();
  }

  /** Frames of all runs nearest to a time, with their fields (one of each run, or nothing). */
  show(time, fields) {
    this.panels.forEach((panel, n) => {
      const times = panel.frames.time;
      let frame = 0;
      while (frame + 1 < times.length && Math.abs(times[frame + 1] - time) <= Math.abs(times[frame] - time)) ++frame;
      panel.airDrawn = false;
      panel.show(frame, fields[n]);
      if (this.follows && panel.count > 0) {
        const middle = panel.middle(frame).map((axis) => axis.centre);
        panel.group.position.set(...panel.inScene(middle).map((x) => -x));
      }
    });
    this.request();
  }

  showWalls(shown) {
    for (const panel of this.panels) {
      panel.wallsShown = shown;
      panel.walls.visible = shown;
      for (const gate of panel.gates) gate.lines.visible = shown && panel.frames.time[panel.frame] < gate.until;
    }
    this.request();
  }

  showArrows(shown) {
    this.arrowsShown = shown;
    this.request();
  }

  recolour(lineColours) {
    for (const panel of this.panels) panel.recolour(lineColours);
    this.request();
  }

  request() {
    this.waiting ??= requestAnimationFrame(() => this.render());
  }

  /** Corner and size of a run's part of the canvas, CSS pixels from its top left. */
  part(n) {
    const { columns, rows } = this.layout;
    const [width, height] = [this.width / columns, this.height / rows];
    return { left: (n % columns) * width, top: Math.floor(n / columns) * height, width, height };
  }

  pixelsPerLength() {
    return this.pixelsAtFit * this.camera.zoom;
  }

  render() {
    if (this.waiting) cancelAnimationFrame(this.waiting);
    this.waiting = undefined;
    if (!this.panels?.length || this.panels[0].frame < 0) return;
    const towards = new three.Vector3();
    this.camera.getWorldDirection(towards);
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    this.panels.forEach((panel, n) => {
      const { left, top, width, height } = this.part(n);
      const bottom = this.height - top - height;
      this.renderer.setViewport(left, bottom, width, height);
      this.renderer.setScissor(left, bottom, width, height);
      if (panel.material) panel.material.uniforms.pixels.value = this.pixelsPerLength() * window.devicePixelRatio;
      if (panel.air) {
        panel.arrows.visible = panel.halo.visible = this.arrowsShown;
        const key = towards.toArray().map((x) => x.toFixed(2)).join();
        if (this.arrowsShown && (!panel.airDrawn || panel.airDrawn !== key)) {
          panel.drawAir(panel.frame, towards);
          panel.airDrawn = key;
        }
      }
      this.renderer.render(panel.scene, this.camera);
    });
    this.onrender();
  }

  /** The foremost particle under a place of the canvas: its run and number, or nothing. */
  pick(x, y) {
    const n = this.panels.findIndex((_, k) => {
      const part = this.part(k);
      return x >= part.left && x < part.left + part.width && y >= part.top && y < part.top + part.height;
    });
    const panel = this.panels[n];
    if (!panel || panel.count === 0) return null;
    const part = this.part(n);
    const matrix = new three.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
    const point = new three.Vector3();
    const uniforms = panel.material.uniforms;
    const shift = panel.group.position.clone().sub(uniforms.centre.value);
    let best = null;
    for (let k = 0; k < panel.count; ++k) {
      if (panel.codes[4 * k] === 65535) continue;
      point.set(panel.codes[4 * k], panel.codes[4 * k + 1], panel.codes[4 * k + 2]).multiply(uniforms.step.value);
      point.add(uniforms.low.value).add(shift).applyMatrix4(matrix);
      const dx = part.left + (0.5 + 0.5 * point.x) * part.width - x;
      const dy = part.top + (0.5 - 0.5 * point.y) * part.height - y;
      const reach = Math.max(panel.radii[k] * this.pixelsPerLength(), 3);
      if (dx * dx + dy * dy > reach * reach) continue;
      if (!best || point.z < best.depth) best = { panel, n: k, depth: point.z };
    }
    return best;
  }
}
