// SPDX-License-Identifier: Apache-2.0
// Pressure on a vessel's walls against height, of each run, beside its estimates: lines of each wall's bands.
import { curves as colours } from "./colour.js";
import { header } from "./data.js";
import { element, number } from "./text.js";

/** column, text, number of its colour (none: quiet), dashes, whether with points */
const lines = [
  ["pressure_at_rest", "at rest", 0, "", true],
  ["pressure_at_rest_by_hand", "at rest, Janssen and Walker", 0, "6 4", false],
  ["en_pressure_filling", "EN 1991-4, filling", 0, "8 3 1 3", false],
  ["pressure_in_flow", "in flow, mean", 1, "", true],
  ["pressure_in_flow_by_hand", "in flow, Janssen and Walker", 1, "6 4", false],
  ["pressure_in_flow_enstad", "in flow, Enstad", 1, "2 4", false],
  ["en_pressure_discharge", "EN 1991-4, discharge", 1, "8 3 1 3", false],
  ["pressure_largest", "peak", null, "2 3", false],
];
const size = { width: 640, height: 420, left: 64, right: 16, top: 12, bottom: 48 };

function svg(name, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** Round numbers from 0 or `low` to `high`, some five of them. */
function ticks(low, high) {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((n) => n * power >= rough);
  const found = [];
  for (let n = Math.ceil(low / step); n * step <= high * (1 + 1e-12); ++n) found.push(n * step);
  return found;
}

const isNumber = (v) => v !== null && Number.isFinite(v);

/** Rows of bands that have a height, of one wall, from below. */
function walls(loads) {
  const found = new Map();
  loads.patch.forEach((patch, row) => {
    if (!(loads.high[row] > loads.low[row])) return;
    if (!found.has(patch)) found.set(patch, []);
    found.get(patch).push(row);
  });
  const middle = (row) => 0.5 * (loads.low[row] + loads.high[row]);
  return [...found.values()].map((rows) => rows.sort((a, b) => middle(a) - middle(b)));
}

function figure(run) {
  const loads = run.wall_loads;
  const css = getComputedStyle(document.documentElement);
  const palette = css.getPropertyValue("--dark").trim() === "1" ? colours.dark : colours.light;
  const quiet = css.getPropertyValue("--quiet"), rule = css.getPropertyValue("--rule");
  const parts = walls(loads);
  const there = lines.filter(([column]) => loads[column] && parts.flat().some((row) => isNumber(loads[column][row])));
  const rows = parts.flat();
  const most = Math.max(...there.flatMap(([column]) => rows.map((row) => loads[column][row]).filter(isNumber)), 0);
  if (!(most > 0)) return null;
  const low = Math.min(...rows.map((row) => loads.low[row])), high = Math.max(...rows.map((row) => loads.high[row]));
  const [factor, unit] = most >= 100 ? [1e-3, "kPa"] : [1, "Pa"];
  const [scale, length] = high >= 1 ? [1, "m"] : [1e3, "mm"];
  const right = size.width - size.right, foot = size.height - size.bottom;
  const x = (p) => size.left + ((right - size.left) * p) / (1.04 * most);
  const y = (z) => foot - ((foot - size.top) * (z - low)) / (high - low);
  const text = (content, attributes) => svg("text", { fill: quiet, "font-size": 12, ...attributes }, content);
  const drawn = svg("svg", { viewBox: `0 0 ${size.width} ${size.height}`, width: size.width, role: "img", "aria-label": "Pressure on the walls against height", style: "max-width: 100%; height: auto" });
  for (const p of ticks(0, factor * most))
    drawn.append(
      svg("line", { x1: x(p / factor), x2: x(p / factor), y1: size.top, y2: foot, stroke: rule }),
      text(number(p), { x: x(p / factor), y: foot + 17, "text-anchor": "middle" }),
    );
  for (const z of ticks(scale * low, scale * high))
    drawn.append(
      svg("line", { x1: size.left, x2: right, y1: y(z / scale), y2: y(z / scale), stroke: rule }),
      text(number(z), { x: size.left - 7, y: y(z / scale) + 4, "text-anchor": "end" }),
    );
  drawn.append(text(`pressure on the wall in ${unit}`, { x: 0.5 * (size.left + right), y: size.height - 10, "text-anchor": "middle" }));
  drawn.append(text(`z in ${length}`, { x: 0, y: 0, "text-anchor": "middle", transform: `translate(16 ${0.5 * (size.top + foot)}) rotate(-90)` }));
  const key = element("div", { className: "key" });
  for (const [column, label, colour, dashes, points] of there) {
    const stroke = colour === null ? quiet : palette[colour];
    const style = { stroke, fill: "none", "stroke-width": 1.8, "stroke-dasharray": dashes };
    for (const part of parts) {
      const values = part.filter((row) => isNumber(loads[column][row]));
      const at = values.map((row) => [x(loads[column][row]), y(0.5 * (loads.low[row] + loads.high[row]))]);
      drawn.append(svg("polyline", { points: at.map((p) => p.join(",")).join(" "), ...style }));
      // A wall of one band would be no line.
      if (points || at.length === 1) for (const [cx, cy] of at) drawn.append(svg("circle", { cx, cy, r: 3, fill: points ? stroke : "none", stroke }));
    }
    key.append(element("span", {}, svg("svg", { width: 30, height: 8 }, svg("line", { x1: 0, x2: 30, y1: 4, y2: 4, ...style })), ` ${label}`));
  }
  const caption = element("figcaption", {}, header.runs.length > 1 ? element("strong", {}, run.name) : "");
  return element("figure", {}, caption, drawn, key);
}

/** Of each run with a vessel; \param section hidden without */
export function drawWalls(section, place) {
  place.replaceChildren(...header.runs.filter((run) => run.wall_loads).map(figure).filter(Boolean));
  section.hidden = !place.firstChild;
}
