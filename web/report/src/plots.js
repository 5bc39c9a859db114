// SPDX-License-Identifier: Apache-2.0
// Curves against time: a plot for each quantity, the runs over each other, bands of one standard deviation for ensembles.
import uPlot from "uplot";
import { curves as colours, dashes } from "./colour.js";
import { header, numbers } from "./data.js";
import { element, meaning, name, number, unit } from "./text.js";

/** Shown first, as far as there are such. */
const preferred = [
  /^discharge\/discharge_rate$/, /^front_speed\/front_speed$/, /^forces\/force_floor_z$/,
  /^snapshots\/surface_angle_hopper$/, /^snapshots\/repose_angle_bin$/,
  /^series\/slit_velocity$/, /^series\/air_speed_max$/, /^series\/speed_max$/, /^series\/front_x$/, /^series\/overlap_max$/,
  /^snapshots\/descent/, /^snapshots\//, /^series\/energy/,
];
const mostAtFirst = 4;

/** All curves: "table/column" with, of each run that has it, where its numbers are. */
function findCurves() {
  const found = new Map();
  header.runs.forEach((run, r) => {
    for (const table of run.tables)
      for (const column of table.columns.slice(1)) {
        if (column.name.endsWith("_deviation") && run.members > 1) continue;
        const base = run.members > 1 ? column.name.replace(/_mean$/, "") : column.name;
        const key = `${table.name}/${base}`;
        if (!found.has(key)) found.set(key, { key, base, table: table.name, unit: column.unit, time: table.columns[0].unit, of: [] });
        found.get(key).of.push({
          run: r,
          time: table.columns[0].block,
          values: column.block,
          deviation: run.members > 1 ? table.columns.find((c) => c.name === `${base}_deviation`)?.block : undefined,
          thinned: table.of_rows > table.rows ? table : undefined,
        });
      }
  });
  return found;
}

export class Plots {
  /** \param onTime called with a time in s that was clicked */
  constructor(onTime) {
    this.curves = findCurves();
    this.onTime = onTime;
    this.shown = new Map();
    this.time = null;
    this.place = document.getElementById("plots");
    const select = document.getElementById("add-curve");
    select.append(element("option", { value: "" }, "choose …"));
    const groups = new Map();
    for (const curve of this.curves.values()) {
      if (!groups.has(curve.table)) groups.set(curve.table, element("optgroup", { label: name(curve.table) }));
      groups.get(curve.table).append(element("option", { value: curve.key }, name(curve.base)));
    }
    select.append(...groups.values());
    select.addEventListener("change", () => {
      if (select.value) this.add(select.value).then((plot) => plot?.figure.scrollIntoView({ block: "nearest" }));
      select.value = "";
    });
  }

  async start() {
    const first = [];
    for (const pattern of preferred)
      for (const key of this.curves.keys()) if (first.length < mostAtFirst && pattern.test(key) && !first.includes(key)) first.push(key);
    for (const key of this.curves.keys()) if (first.length < Math.min(2, this.curves.size) && !first.includes(key)) first.push(key);
    for (const key of first) await this.add(key);
    new ResizeObserver(() => {
      for (const plot of this.shown.values()) plot.chart.setSize({ width: plot.body.clientWidth, height: 230 });
    }).observe(this.place);
    this.drawKey();
  }

  style() {
    const css = getComputedStyle(document.documentElement);
    const dark = css.getPropertyValue("--dark").trim() === "1";
    return { ink: css.getPropertyValue("--quiet"), grid: css.getPropertyValue("--rule"), cursor: css.getPropertyValue("--ink"), curves: dark ? colours.dark : colours.light };
  }

  drawKey() {
    const { curves } = this.style();
    const key = document.getElementById("curve-key");
    key.replaceChildren();
    if (header.runs.length === 1 && header.runs[0].members === 1) return;
    header.runs.forEach((run, n) => {
      const line = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      line.setAttribute("width", "30");
      line.setAttribute("height", "8");
      const stroke = document.createElementNS(line.namespaceURI, "line");
      for (const [attribute, value] of Object.entries({ x1: 0, x2: 30, y1: 4, y2: 4, "stroke-width": 2, stroke: curves[n % curves.length], "stroke-dasharray": dashes[n % dashes.length].join(" ") }))
        stroke.setAttribute(attribute, value);
      line.append(stroke);
      const members = run.members > 1 ? `, mean of ${run.members} members and one standard deviation` : "";
      key.append(element("span", {}, line, ` ${run.name}${members}`));
    });
  }

  async add(key) {
    const curve = this.curves.get(key);
    if (!curve || this.shown.has(key)) return this.shown.get(key);
    const style = this.style();
    const tables = [];
    const series = [{ label: "time", value: (_, v) => number(v) }];
    const bands = [];
    const alone = header.runs.length === 1;
    for (const part of curve.of) {
      const run = header.runs[part.run];
      const stroke = style.curves[part.run % style.curves.length];
      const dash = dashes[part.run % dashes.length];
      const clean = (values) => Array.from(values, (v) => (Number.isFinite(v) ? v : null));
      const x = Array.from(await numbers(part.time));
      const y = clean(await numbers(part.values));
      const columns = [x, y];
      const index = series.length;
      const points = { show: x.length <= 60, size: 4, fill: stroke };
      series.push({ label: alone ? name(curve.base) : run.name, stroke, width: 1.4, dash, points, spanGaps: true, value: (_, v) => number(v) });
      if (part.deviation !== undefined) {
        const deviation = clean(await numbers(part.deviation));
        columns.push(y.map((v, n) => (v === null || deviation[n] === null ? null : v + deviation[n])));
        columns.push(y.map((v, n) => (v === null || deviation[n] === null ? null : v - deviation[n])));
        for (const side of ["+ deviation", "− deviation"])
          series.push({ label: side, stroke: "transparent", points: { show: false }, spanGaps: true, value: (_, v) => number(v) });
        bands.push({ series: [index + 1, index + 2], fill: stroke + "33" });
      }
      tables.push(columns);
    }
    const body = element("div", { className: "plot" });
    const thinned = curve.of.find((part) => part.thinned)?.thinned;
    const text = meaning(header.definitions, curve.base);
    const close = element("button", { type: "button", className: "close", title: "Remove this plot", ariaLabel: `Remove ${name(curve.base)}` }, "×");
    const figure = element(
      "figure",
      {},
      close,
      element("figcaption", {}, element("strong", {}, name(curve.base)), unit(curve.unit) ? ` in ${unit(curve.unit)}` : "", text ? element("span", { className: "quiet" }, ` – ${text}`) : null),
      body,
      thinned ? element("p", { className: "quiet small" }, `${thinned.of_rows.toLocaleString("en")} rows; of every stretch of ${Math.round((2 * thinned.of_rows) / thinned.rows)} the least and the largest value are drawn.`) : null,
    );
    figure.dataset.curve = key;
    this.place.append(figure);
    const axis = { stroke: style.ink, grid: { stroke: style.grid, width: 1 }, ticks: { stroke: style.grid, width: 1, size: 5 }, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif" };
    const inSeconds = curve.time === "s";
    const chart = new uPlot(
      {
        width: body.clientWidth || 400,
        height: 230,
        scales: { x: { time: false } },
        series,
        bands,
        cursor: { y: false, points: { size: 6 }, bind: {} },
        legend: { live: true },
        axes: [
          { ...axis, label: `time in ${unit(curve.time)}`, labelSize: 22, size: 34, values: (_, ticks) => ticks.map((t) => number(t)) },
          { ...axis, size: (_, texts) => Math.max(64, 20 + 7 * Math.max(...(texts ?? []).map((text) => text.length))), values: (_, ticks) => ticks.map((t) => number(t)) },
        ],
        hooks: {
          draw: [
            (u) => {
              if (this.time === null || !inSeconds) return;
              const x = u.valToPos(this.time, "x", true);
              if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
              u.ctx.save();
              u.ctx.strokeStyle = this.style().cursor;
              u.ctx.globalAlpha = 0.55;
              u.ctx.lineWidth = devicePixelRatio;
              u.ctx.setLineDash([]);
              u.ctx.beginPath();
              u.ctx.moveTo(x, u.bbox.top);
              u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
              u.ctx.stroke();
              u.ctx.restore();
            },
          ],
        },
      },
      tables.length === 1 ? tables[0] : uPlot.join(tables),
      body,
    );
    if (inSeconds)
      chart.over.addEventListener("click", () => {
        if (chart.select.width < 2 && chart.cursor.left >= 0) this.onTime(chart.posToVal(chart.cursor.left, "x"));
      });
    chart.root.querySelectorAll(".u-legend .u-series").forEach((row, n) => (row.hidden = series[n].stroke === "transparent"));
    const plot = { chart, figure, body };
    this.shown.set(key, plot);
    close.addEventListener("click", () => {
      chart.destroy();
      figure.remove();
      this.shown.delete(key);
    });
    return plot;
  }

  setTime(time) {
    this.time = time;
    for (const plot of this.shown.values()) plot.chart.redraw(false, false);
  }

  /** Draws all again, in the colours that hold now. */
  redraw() {
    this.drawing = (this.drawing ?? Promise.resolve()).then(() => this.drawAnew());
    return this.drawing;
  }

  async drawAnew() {
    const keys = [...this.shown.keys()];
    for (const { chart, figure } of this.shown.values()) {
      chart.destroy();
      figure.remove();
    }
    this.shown.clear();
    for (const key of keys) await this.add(key);
    this.drawKey();
  }
}
