// SPDX-License-Identifier: Apache-2.0
// Joins the parts of the page: header, viewer with its controls, curves, tables, keys. Longer than 400 lines because
// every control of the page is joined to its part here, once.
import { mapNames, colours } from "./colour.js";
import { decode, frames as unpackFrames, header } from "./data.js";
import { Plots } from "./plots.js";
import { drawCase, drawKeyResults, drawPublished, drawRegime, drawSummary } from "./tables.js";
import { element, name, number, practicalQuantity, unit } from "./text.js";
import { Viewer, directions } from "./viewer.js";
import { drawWalls } from "./walls.js";

const by = (id) => document.getElementById(id);
const preferredFields = ["velocity", "pressure", "packing"];
const shares = [0.01, 0.99]; // of all values, between which the colours reach

function lineColours() {
  const css = getComputedStyle(document.documentElement);
  const read = (variable) => css.getPropertyValue(variable).trim();
  return { ink: read("--ink"), paper: read("--stage"), gate: read("--accent") };
}

/** The viewer's controls: field, range, time, direction. */
class View {
  constructor(onTime) {
    this.runs = header.runs.filter((run) => run.frames);
    this.onTime = onTime;
    this.viewer = new Viewer(by("canvas"), this.runs);
    this.playing = false;
  }

  /** \param onLayout called once the place of the view is known */
  async start(onLayout) {
    await this.viewer.load(lineColours());
    this.times = this.viewer.times;
    const span = this.times.at(-1) - this.times[0];
    const power = 10 ** Math.floor(Math.log10(span / 8 || 1));
    this.speeds = [-2, -1, 0, 1, 2].flatMap((p) => [1, 2, 5].map((m) => m * power * 10 ** p));
    this.speed = this.speeds.findLastIndex((v) => v <= (span / 8) * 1.01);
    this.speeds.forEach((v, n) => by("speed").append(element("option", { value: n }, `${number(v)} × real time`)));
    by("speed").value = this.speed;
    by("time").max = this.times.length - 1;

    const names = [...new Set(this.runs.flatMap((run) => (run.frames.fields ?? []).map((f) => f.name)))].sort();
    for (const field of names) {
      const vector = names.includes(`${field}_x`) ? ", size" : "";
      by("field").append(element("option", { value: field }, name(field) + vector));
    }
    if (names.length === 0) for (const id of ["field", "map", "low", "high", "auto"]) (by(id).closest("label") ?? by(id)).hidden = true;
    for (const map of mapNames) by("map").append(element("option", {}, map));
    for (const [key, direction] of Object.entries(directions)) {
      const button = element("button", { type: "button" }, direction.label);
      button.addEventListener("click", () => this.viewer.look(key));
      by("views").append(button);
    }
    by("arrows-label").hidden = !this.runs.some((run) => run.frames.air);
    by("walls-label").hidden = !this.runs.some((run) => run.scene.walls.length || run.scene.slope);
    this.drawLabels();
    this.drawNote();
    this.connect();
    await this.setField(preferredFields.find((f) => names.includes(f)) ?? names[0]);
    this.setTime(this.tellingTime());
    this.viewer.render();
    document.documentElement.dataset.ready = "view";
    await onLayout();
    this.onTime(this.times[this.frame]);
    for (const field of names) {
      await new Promise((done) => setTimeout(done, 30)); // what is hovered over shows all fields
      await this.fieldsOf(field);
    }
    document.documentElement.dataset.ready = "all";
  }

  connect() {
    by("time").addEventListener("input", () => this.setFrame(Number(by("time").value)));
    by("field").addEventListener("change", () => this.setField(by("field").value));
    by("map").addEventListener("change", () => {
      this.viewer.setMap(by("map").value);
      this.drawLegend();
    });
    for (const id of ["low", "high"]) by(id).addEventListener("change", () => this.setRange(Number(by("low").value), Number(by("high").value)));
    by("auto").addEventListener("click", () => this.autoRange());
    by("arrows").addEventListener("change", () => {
      this.viewer.showArrows(by("arrows").checked);
      this.drawLegend();
    });
    by("walls").addEventListener("change", () => this.viewer.showWalls(by("walls").checked));
    by("play").addEventListener("click", () => this.play(!this.playing));
    by("speed").addEventListener("change", () => (this.speed = Number(by("speed").value)));
    by("save").addEventListener("click", () => this.save());
    const stage = by("stage");
    stage.addEventListener("pointermove", (event) => this.read(event));
    stage.addEventListener("pointerleave", () => (by("reading").hidden = true));
    stage.addEventListener("dblclick", () => this.viewer.look(this.runs[0].scene.view));
    new ResizeObserver(() => {
      this.viewer.resize();
      this.drawLabels();
    }).observe(stage);
    this.viewer.onrender = () => this.drawScale();
  }

  /** When there is most to see: the middle of the discharge, else of what follows the opening of the gate. */
  tellingTime() {
    const told = this.runs.find((run) => run.telling_time !== undefined);
    if (told) return told.telling_time;
    return (Math.max(0, this.times[0]) + this.times.at(-1)) / 2;
  }

  /** Of each run the field's description and codes, unpacked. */
  fieldsOf(fieldName) {
    return Promise.all(
      this.runs.map(async (run) => {
        const packed = (run.frames.fields ?? []).find((f) => f.name === fieldName);
        if (!packed) return null;
        packed.codes ??= await unpackFrames(packed.block, run.frames.count);
        return { packed, codes: packed.codes };
      }),
    );
  }

  async setField(fieldName) {
    if (!fieldName) return;
    const fields = await this.fieldsOf(fieldName);
    this.field = fieldName;
    this.fields = fields;
    this.fieldUnit = fields.find(Boolean)?.packed.unit;
    by("field").value = fieldName;
    this.autoRange();
    if (this.frame !== undefined) this.setFrame(this.frame);
  }

  /** The range that holds most values of all frames and runs; from 0 where that is near. */
  autoRange() {
    let low = Infinity;
    let high = -Infinity;
    for (const field of this.fields.filter(Boolean)) {
      const { packed, codes } = field;
      const counts = new Float64Array(packed.levels + 1);
      for (let n = 0; n < codes.length; ++n) ++counts[codes[n]];
      const all = codes.length - counts[packed.levels];
      let sum = 0;
      let first = 0;
      let last = packed.levels - 1;
      for (let code = 0; code < packed.levels; ++code) {
        if (sum <= shares[0] * all) first = code;
        if (sum < shares[1] * all) last = code;
        sum += counts[code];
      }
      low = Math.min(low, decode(packed, first));
      high = Math.max(high, decode(packed, last));
    }
    if (low > 0 && low < 0.2 * high) low = 0;
    const digits = 10 ** (Math.floor(Math.log10(high - low || 1)) - 1);
    this.setRange(Math.floor(low / digits) * digits, Math.ceil(high / digits) * digits);
  }

  setRange(low, high) {
    if (!(high > low)) high = low + (Math.abs(low) * 1e-3 || 1);
    this.range = [low, high];
    by("low").value = Number(low.toPrecision(4));
    by("high").value = Number(high.toPrecision(4));
    this.viewer.setRange(low, high);
    this.drawLegend();
  }

  setFrame(frame) {
    this.frame = Math.max(0, Math.min(this.times.length - 1, frame));
    by("time").value = this.frame;
    const time = this.times[this.frame];
    by("clock").textContent = `t = ${this.clock(time)}`;
    this.viewer.show(time, this.fields ?? this.runs.map(() => null));
    if (this.pointer) this.read(this.pointer);
    this.onTime(time);
  }

  /** As many digits as tell frames apart. */
  clock(time) {
    const between = (this.times.at(-1) - this.times[0]) / Math.max(1, this.times.length - 1);
    const digits = Math.max(0, Math.min(9, 1 - Math.floor(Math.log10(between || 1))));
    return `${time.toFixed(digits).replace("-", "−")} s`;
  }

  setTime(time) {
    let best = 0;
    this.times.forEach((t, n) => {
      if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = n;
    });
    this.setFrame(best);
  }

  play(on) {
    this.playing = on;
    by("play").textContent = on ? "Pause" : "Play";
    if (!on) return;
    if (this.frame === this.times.length - 1) this.setFrame(0);
    let simulated = this.times[this.frame];
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      simulated += ((now - before) / 1000) * this.speeds[this.speed];
      before = now;
      let frame = this.frame;
      while (frame + 1 < this.times.length && this.times[frame + 1] <= simulated) ++frame;
      if (frame !== this.frame) this.setFrame(frame);
      if (frame === this.times.length - 1) this.play(false);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  changeSpeed(by_) {
    this.speed = Math.max(0, Math.min(this.speeds.length - 1, this.speed + by_));
    by("speed").value = this.speed;
  }

  read(event) {
    this.pointer = event;
    const box = by("stage").getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const picked = event.buttons ? null : this.viewer.pick(x, y);
    const reading = by("reading");
    reading.hidden = !picked;
    if (!picked) return;
    const { panel, n } = picked;
    const place = panel.position(panel.frame, n);
    const fields = (panel.frames.fields ?? []).filter((f) => f.codes);
    const components = new Set(fields.flatMap((f) => ["x", "y", "z"].map((axis) => `${f.name}_${axis}`)));
    const rows = [
      ["particle", panel.identities ? panel.identities[n] : n],
      ["x, y, z", `${place.map((v) => number(v * 1e3)).join(", ")} mm`],
      ...fields
        .filter((f) => !components.has(f.name) || f.name === this.field)
        .map((f) => [name(f.name), practicalQuantity(decode(f, f.codes[panel.frame * panel.count + n]), f.unit), f.name === this.field]),
    ];
    reading.replaceChildren(element("table", {}, ...rows.map(([term, value, bold]) => element("tr", { className: bold ? "bold" : "" }, element("td", {}, term), element("td", { className: "number" }, String(value))))));
    const [width, height] = [reading.offsetWidth, reading.offsetHeight];
    reading.style.left = `${x + 18 + width > box.width ? Math.max(0, x - width - 18) : x + 18}px`;
    reading.style.top = `${Math.max(0, Math.min(y + 12, box.height - height - 4))}px`;
  }

  drawLabels() {
    const several = this.runs.length > 1;
    by("labels").replaceChildren(
      ...this.runs.map((run, n) => {
        const { left, top, width } = this.viewer.part(n);
        const label = element("div", { className: "panel-label" }, several ? run.name : "", element("span", { className: "scale" }));
        Object.assign(label.style, { left: `${left}px`, top: `${top}px`, width: `${width}px` });
        return label;
      }),
    );
    this.drawScale();
  }

  /** A length of 1, 2 or 5 times a power of ten that is some 90 pixels long. */
  scaleBar() {
    const pixels = this.viewer.pixelsPerLength() * this.viewer.scale; // per metre
    const power = 10 ** Math.floor(Math.log10(120 / pixels));
    const length = [1, 2, 5].map((m) => m * power).findLast((l) => l * pixels <= 120) ?? power;
    const [factor, suffix] = length >= 1 ? [1, "m"] : length >= 1e-3 ? [1e3, "mm"] : [1e6, "µm"];
    return { pixels: length * pixels, text: `${number(length * factor)} ${suffix}` };
  }

  drawScale() {
    const { pixels, text } = this.scaleBar();
    for (const scale of document.querySelectorAll(".scale")) {
      scale.style.width = `${pixels}px`;
      scale.textContent = text;
    }
  }

  legendText() {
    return this.field ? `${name(this.field)}${unit(this.fieldUnit) ? ` in ${unit(this.fieldUnit)}` : ""}` : "";
  }

  airText() {
    const panel = this.viewer.panels.find((p) => p.air);
    return panel && by("arrows").checked ? { panel, pixels: 2 * panel.cell() * this.viewer.scale * this.viewer.pixelsPerLength(), text: `air, ${number(panel.arrowSpeed)} m/s` } : null;
  }

  drawLegend() {
    const place = by("legend");
    place.replaceChildren();
    if (this.field) {
      const bar = element("canvas", { width: 256, height: 1, className: "map" });
      bar.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(colours(by("map").value)), 256, 1), 0, 0);
      const ticks = [0, 0.25, 0.5, 0.75, 1].map((t) => element("span", {}, number(this.range[0] + t * (this.range[1] - this.range[0]), 3)));
      place.append(element("span", { className: "legend-title" }, this.legendText()), element("div", { className: "scale-bar" }, bar, element("div", { className: "ticks" }, ...ticks)));
    }
    const air = this.airText();
    if (air) place.append(element("span", { className: "arrow-key" }, element("span", { className: "arrow" }), `${air.text} for two cells of the arrows`));
  }

  drawNote() {
    const notes = this.runs.flatMap((run) => {
      const f = run.frames;
      const said = [];
      if (f.count < f.of_particles) said.push(`${f.count.toLocaleString("en")} of ${f.of_particles.toLocaleString("en")} particles`);
      if (f.time.length < f.of_frames) said.push(`${f.time.length} of ${f.of_frames} snapshots`);
      return said.length ? [`${this.runs.length > 1 ? `${run.name}: ` : ""}thinned to ${said.join(" and ")}.`] : [];
    });
    const without = header.runs.length - this.runs.length;
    if (without > 0) notes.push(`${without} more run${without > 1 ? "s are" : " is"} in the curves and tables only.`);
    for (const run of this.runs) if (run.members > 1) notes.push(`${run.name}: the member with seed ${run.manifest.seed} is shown.`);
    if (this.runs.some((run) => run.from_gate)) notes.push("Times count from the opening of the gate.");
    notes.push("Positions are rounded to 1/65534 and fields to 1/1022 of their range in the run; colours beyond the ends of the bar are those of its ends.");
    by("view-note").textContent = notes.join(" ");
  }

  /** The view with names, time and legend, as PNG. */
  save() {
    this.viewer.render();
    const source = by("canvas");
    const ratio = source.width / this.viewer.width;
    const foot = 64;
    const canvas = element("canvas", { width: source.width, height: source.height + foot * ratio });
    const c = canvas.getContext("2d");
    const { ink, paper } = lineColours();
    c.fillStyle = paper;
    c.fillRect(0, 0, canvas.width, canvas.height);
    c.drawImage(source, 0, 0);
    c.scale(ratio, ratio);
    c.fillStyle = c.strokeStyle = ink;
    c.font = "13px system-ui, sans-serif";
    c.textBaseline = "alphabetic";
    this.runs.forEach((run, n) => {
      const part = this.viewer.part(n);
      c.fillText(this.runs.length > 1 ? run.name : header.title, part.left + 12, part.top + 20);
    });
    const { height, width } = this.viewer;
    const bar = this.scaleBar();
    c.fillRect(width - 12 - bar.pixels, 26, bar.pixels, 2);
    c.textAlign = "right";
    c.fillText(bar.text, width - 12, 20);
    c.textAlign = "left";
    c.fillText(`t = ${this.clock(this.times[this.frame])}`, 12, height + 26);
    if (this.field) {
      const legend = document.querySelector("#legend canvas");
      c.imageSmoothingEnabled = true;
      c.drawImage(legend, 160, height + 14, 256, 14);
      for (const t of [0, 0.5, 1]) {
        c.textAlign = ["left", "center", "right"][2 * t];
        c.fillText(number(this.range[0] + t * (this.range[1] - this.range[0]), 3), 160 + 256 * t, height + 46);
      }
      c.textAlign = "left";
      c.fillText(this.legendText(), 430, height + 26);
    }
    const air = this.airText();
    if (air) {
      c.fillRect(430, height + 42, air.pixels, 1.5);
      c.fillText(air.text, 438 + air.pixels, height + 46);
    }
    canvas.toBlob((blob) => {
      const link = element("a", { href: URL.createObjectURL(blob), download: `${header.title.replace(/[^\w.-]+/g, "-")}-${this.frame}.png` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    });
  }

  toggle(id) {
    if (by(`${id}-label`).hidden) return;
    by(id).checked = !by(id).checked;
    by(id).dispatchEvent(new Event("change"));
  }

  key(event) {
    const keys = {
      " ": () => this.play(!this.playing),
      ArrowLeft: () => this.setFrame(this.frame - (event.shiftKey ? 10 : 1)),
      ArrowRight: () => this.setFrame(this.frame + (event.shiftKey ? 10 : 1)),
      Home: () => this.setFrame(0),
      End: () => this.setFrame(this.times.length - 1),
      "+": () => this.changeSpeed(1),
      "-": () => this.changeSpeed(-1),
      f: () => {
        const options = [...by("field").options].map((o) => o.value);
        this.setField(options[(options.indexOf(this.field) + 1) % options.length]);
      },
      a: () => this.toggle("arrows"),
      w: () => this.toggle("walls"),
      s: () => this.save(),
    };
    Object.keys(directions).forEach((direction, n) => (keys[n + 1] = () => this.viewer.look(direction)));
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  retint() {
    this.viewer.recolour(lineColours());
    this.drawLegend();
  }
}

/** Light, dark or as the system has it. */
function connectTheme(onChange) {
  const themes = ["system", "light", "dark"];
  const button = by("theme");
  const system = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement.dataset;
  const apply = (theme) => {
    root.theme = theme;
    root.palette = theme === "system" ? (system.matches ? "dark" : "light") : theme;
    button.textContent = { system: "Auto", light: "Light", dark: "Dark" }[theme];
  };
  apply("system");
  button.addEventListener("click", () => {
    apply(themes[(themes.indexOf(root.theme) + 1) % themes.length]);
    onChange();
  });
  system.addEventListener("change", () => {
    apply(root.theme);
    onChange();
  });
}

/** On paper nothing can be unfolded: the pictures and the case are printed, and folded again as they were. */
function unfoldForPrint() {
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open])")];
    for (const part of folded) part.open = true;
  });
  addEventListener("afterprint", () => {
    for (const part of folded) part.open = false;
  });
}

function drawHead() {
  by("title").textContent = header.title;
  const { runs } = header;
  const what = runs.map((run) => (run.members > 1 ? `${run.name} (${run.members} members)` : run.name));
  by("subtitle").textContent = `${runs.length === 1 && what[0] === header.title ? runs[0].model : what.join(", ")} · Talus ${header.version} (${header.revision})`;
}

async function start() {
  drawHead();
  drawKeyResults(by("key-results"), by("key-results-body"));
  drawSummary(by("summary-body"));
  drawRegime(by("regime-body"));
  drawPublished(by("published"), by("published-body"));
  drawCase(by("case-body"));
  unfoldForPrint();
  drawWalls(by("wall-loads"), by("wall-loads-body"));
  const plots = new Plots((time) => view?.setTime(time));
  if (plots.curves.size === 0) by("curves").hidden = true;
  let view = null;
  if (header.runs.some((run) => run.frames)) {
    try {
      view = new View((time) => plots.setTime(time));
    } catch (error) {
      for (const id of ["view-controls", "stage", "legend", "time-controls"]) by(id).hidden = true;
      by("view-note").textContent = document.querySelector("#stills figure")
        ? "This browser has no WebGL: the pictures that the program drew stand in for the view."
        : "This browser has no WebGL, and the run no pictures: the view needs one of them.";
      by("stills").open = true;
    }
  } else {
    by("view").hidden = true;
  }
  if (!document.querySelector("#stills figure")) by("stills").hidden = true;
  connectTheme(() => {
    view?.retint();
    plots.redraw();
    drawWalls(by("wall-loads"), by("wall-loads-body"));
  });
  by("help").addEventListener("click", () => by("keys").showModal());
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || by("keys").open) return;
    if (/^(INPUT|SELECT|TEXTAREA|SUMMARY)$/.test(event.target.tagName) && event.target.id !== "time") return;
    if (event.target.tagName === "BUTTON" && event.key === " ") return;
    if (event.key === "?") by("keys").showModal();
    else view?.key(event);
  });
  await view?.start(() => plots.start());
  if (!view) await plots.start();
  if (!view) document.documentElement.dataset.ready = "all";
}

start();
