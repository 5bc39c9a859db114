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

/** The unit that engineers use for a size of this unit, and the factor to it: kPa, t/h, mm, min. */
export function practical(size, itsUnit) {
  const choices = {
    Pa: [[1e6, 1e-6, "MPa"], [100, 1e-3, "kPa"]],
    "kg/s": [[10, 3.6, "t/h"], [0.1, 1, "kg/s"], [0, 1e3, "g/s"]],
    kg: [[1e4, 1e-3, "t"], [1, 1, "kg"], [0, 1e3, "g"]],
    m: [[1, 1, "m"], [1e-4, 1e3, "mm"], [0, 1e6, "µm"]],
    s: [[7200, 1 / 3600, "h"], [120, 1 / 60, "min"]],
    B: [[1e9, 1e-9, "GB"], [1e6, 1e-6, "MB"]],
  }[itsUnit];
  const choice = size === 0 ? null : choices?.find(([least]) => Math.abs(size) >= least);
  return choice ? choice.slice(1) : [1, itsUnit];
}

/** A quantity in the unit that engineers use. */
export function practicalQuantity(value, itsUnit) {
  const [factor, name] = practical(value ?? 0, itsUnit);
  return quantity(value === null || value === undefined ? null : factor === 1 ? value : Number((factor * value).toPrecision(6)), name);
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
