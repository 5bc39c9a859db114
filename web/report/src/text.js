// SPDX-License-Identifier: Apache-2.0
// Numbers, units and names as people read them, and elements made from them.

/** An element with attributes and children; text is never taken for markup. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in made && key !== "list") made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Four significant digits, powers of ten where there would be many zeros, a true minus. */
export function number(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e7) return String(value).replace("-", "−");
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(digits))).replace("-", "−");
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  const raised = exponent.replace("+", "").replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]));
  return `${Number(mantissa)} × 10${raised}`.replace("-", "−");
}

export function unit(text) {
  if (!text || text === "1") return "";
  if (text === "deg") return "°";
  return text.replace(/([a-zA-Z])-?(\d)\b/g, (_, letter, digit) => letter + "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]).replace(/ /g, " ");
}

export function quantity(value, itsUnit) {
  const suffix = unit(itsUnit);
  return number(value) + (suffix && value !== null ? (suffix === "°" ? "°" : ` ${suffix}`) : "");
}

/** "stress_xx" as "stress xx". */
export function name(text) {
  return text.replaceAll("_", " ");
}

/** `code` and *stress* of one paragraph, as nodes. */
export function markdown(text) {
  return text
    .replaceAll("\n", " ")
    .split(/(`[^`]+`|\*[^*]+\*)/)
    .map((part) => (/^[`*]/.test(part) ? element(part[0] === "`" ? "code" : "em", {}, part.slice(1, -1)) : part));
}

/** What a column of a table is: "force_floor_z" has no definition of its own. */
export function meaning(definitions, column) {
  if (definitions[column]) return definitions[column];
  const force = /^force_(.*)_([xyz])$/.exec(column);
  if (force) return `force of the particles on the wall “${force[1]}” along ${force[2]}, mean over a hundredth of the run`;
  return "";
}
