// SPDX-License-Identifier: Apache-2.0
// What is read: summary, regime cards, published numbers, cases.
import { header } from "./data.js";
import { element, markdown, name, number, practical, practicalQuantity, quantity, unit } from "./text.js";

const { runs, definitions } = header;

function table(head, rows, className = "") {
  return element(
    "div",
    { className: "wide" },
    element("table", { className }, element("thead", {}, element("tr", {}, ...head.map((cell) => (cell instanceof Node ? cell : element("th", { scope: "col" }, cell))))), element("tbody", {}, ...rows)),
  );
}

function row(...cells) {
  return element("tr", {}, ...cells.map((cell) => (cell instanceof HTMLTableCellElement ? cell : element("td", {}, cell))));
}

const numericHead = (text) => element("th", { scope: "col", className: "number" }, text);
const numeric = (...content) => element("td", { className: "number" }, ...content);

/** One value, or mean ± standard deviation of members. */
function spread(values, itsUnit) {
  const finite = values.filter((v) => v !== null && Number.isFinite(v));
  if (finite.length < 2) return practicalQuantity(finite.length ? finite[0] : null, itsUnit);
  const mean = finite.reduce((a, b) => a + b) / finite.length;
  const deviation = Math.sqrt(finite.reduce((a, v) => a + (v - mean) ** 2, 0) / (finite.length - 1));
  const [factor, practicalUnit] = practical(mean, itsUnit);
  const suffix = unit(practicalUnit);
  return `${number(factor * mean)} ± ${number(factor * deviation, 2)}${suffix ? (suffix === "°" ? "°" : ` ${suffix}`) : ""}`;
}

/** What a reader wants first: a line for each key result, beside its analytical estimate. */
export function drawKeyResults(section, place) {
  const titles = [...new Set(runs.flatMap((run) => (run.key_results ?? []).map((line) => line.title)))];
  if (titles.length === 0) {
    section.hidden = true;
    document.querySelector('a[href="#key-results"]').hidden = true;
    return;
  }
  const estimated = runs.some((run) => (run.key_results ?? []).some((line) => line.estimate));
  const rows = titles.map((title) => {
    const lines = runs.map((run) => run.key_results?.find((line) => line.title === title));
    const estimate = lines.find((line) => line?.estimate)?.estimate ?? "";
    return row(element("th", { scope: "row" }, title), ...lines.map((line) => line?.value ?? "–"), ...(estimated ? [element("td", { className: "quiet" }, estimate)] : []));
  });
  place.append(table(["", ...runs.map((run) => (runs.length > 1 || run.members > 1 ? run.name : "Result")), ...(estimated ? ["Analytical estimate"] : [])], rows, "key-results"));
  const shown = runs.find((run) => run.members > 1);
  if (shown) place.append(element("p", { className: "quiet" }, "Of ensembles: those of the member that is shown."));
}

export function drawSummary(place) {
  const ofMachine = ["wall_seconds", "cpu_seconds", "peak_memory", "threads", "steps"];
  const names = [];
  for (const run of runs) for (const q of run.quantities) if (!names.includes(q.name)) names.push(q.name);
  names.sort((a, b) => ofMachine.includes(a) - ofMachine.includes(b));
  const rows = names.map((quantityName) => {
    const values = runs.map((run) => {
      const found = run.quantities.find((q) => q.name === quantityName);
      return numeric(found ? spread(found.values, found.unit) : "–");
    });
    return row(element("th", { scope: "row" }, name(quantityName)), ...values, element("td", { className: "meaning" }, ...markdown(definitions[quantityName] ?? "")));
  });
  place.append(
    table(["Quantity", ...runs.map((run) => numericHead(runs.length > 1 || run.members > 1 ? run.name : "Value")), "Meaning"], rows),
    element("p", { className: "quiet" }, runs.some((run) => run.members > 1) ? "Ensembles: mean ± standard deviation of the members." : ""),
    ...[...new Set(runs.map((run) => run.symbols).filter(Boolean))].map((symbols) => element("p", { className: "quiet symbols" }, ...markdown(symbols))),
  );
}

export function drawRegime(place) {
  for (const run of runs) {
    if (runs.length > 1) place.append(element("h3", {}, run.name));
    for (const warning of run.warnings) {
      const [, id, text] = /^([a-z0-9-]+): ([\s\S]*)$/.exec(warning) ?? [null, "", warning];
      place.append(element("p", { className: "warning", id: undefined }, element("strong", {}, "Warning. "), text, id ? element("span", { className: "quiet" }, ` (${id})`) : null));
    }
    if (run.regime.length === 0 && run.warnings.length === 0) place.append(element("p", { className: "quiet" }, "No warning."));
    if (run.regime.length === 0) continue;
    const rows = run.regime.map((line) => {
      const made = row(element("th", { scope: "row" }, line.quantity), numeric(line.value), element("td", { className: "meaning" }, line.warning ? "Outside: " : "", line.meaning));
      if (line.warning) made.className = "outside";
      return made;
    });
    place.append(table(["Group", numericHead("Value"), "Meaning"], rows));
  }
}

export function drawPublished(section, place) {
  if (header.comparisons.length === 0) {
    section.hidden = true;
    document.querySelector('a[href="#published"]').hidden = true;
    return;
  }
  for (const comparison of header.comparisons) {
    const has = (r, n) => r.verdicts[n] !== "not evaluated"; // a value without a meaning is null, and not met
    const evaluated = comparison.rows.filter((r) => r.values.some((_, n) => has(r, n)));
    const short = comparison.rows.filter((r) => !evaluated.includes(r) && r.missing);
    const others = comparison.rows.length - evaluated.length - short.length;
    const counts = new Map();
    for (const r of evaluated) counts.set(r.verdict, (counts.get(r.verdict) ?? 0) + 1);
    place.append(
      element("h3", {}, comparison.title),
      element("p", { className: "quiet" }, `${comparison.source}. `, [...counts].map(([verdict, count]) => `${count} ${verdict}`).join(", ") || "No row has a value", `; ${short.length ? `${short.length} rows have no value here, ` : ""}${others} rows need other runs.`),
    );
    const rows = evaluated.map((r) => {
      const values = r.values.map((v, n) => (!has(r, n) ? null : `${r.values.length > 1 ? `${r.variants[n] ?? ""}: ` : ""}${quantity(v, r.unit)}`)).filter(Boolean);
      const made = row(
        numeric(r.number ? String(r.number) : ""),
        element("th", { scope: "row" }, name(r.quantity), r.statistic && r.statistic !== "mean" ? element("span", { className: "quiet" }, `, ${r.statistic}`) : null),
        element("td", { className: "meaning" }, r.printed === "-" ? "" : r.printed || "", element("span", { className: "source" }, r.source ? ` [${r.source}]` : "")),
        r.criterion === "reported" ? "" : `${r.criterion}${unit(r.unit) === "°" ? "" : " "}${unit(r.unit)}`.replace(/(^|\s)-(?=\d)/g, "$1−"),
        numeric(values.join(", ")),
        element("td", { className: `verdict ${r.verdict.replace(" ", "-")}` }, { met: "✓ met", "not met": "✗ not met" }[r.verdict] ?? r.verdict),
      );
      return made;
    });
    if (rows.length) place.append(table([numericHead("Row"), "Quantity", "The paper", "Met if", numericHead("Here"), ""], rows));
    if (short.length)
      place.append(
        element("details", {}, element("summary", {}, "Rows without a value"),
          element("ul", {}, ...short.map((r) => element("li", {}, element("strong", {}, name(r.quantity)), ` (${r.id}): ${r.missing}`)))),
      );
  }
}

function download(text, file) {
  const link = element("a", { href: URL.createObjectURL(new Blob([text], { type: "text/plain" })), download: file });
  link.click();
  URL.revokeObjectURL(link.href);
}

export function drawCase(place) {
  if (runs.length > 1) {
    const keys = [...new Set(runs.flatMap((run) => Object.keys(run.keys)))].filter((key) => new Set(runs.map((run) => run.keys[key])).size > 1);
    const rows = keys.map((key) => row(element("th", { scope: "row" }, element("code", {}, key)), ...runs.map((run) => element("code", {}, run.keys[key] ?? "not given"))));
    place.append(element("h3", {}, "Keys that differ"), table(["Key", ...runs.map((run) => run.name)], rows));
  }
  for (const run of runs) {
    const m = run.manifest;
    const file = `${run.name.replace(/[^\w.-]+/g, "-")}.toml`;
    const members = run.members > 1 ? `talus ensemble ${file} --members ${run.members}` : `talus run ${file}`;
    const save = element("button", { type: "button" }, `Save ${file}`);
    save.addEventListener("click", () => download(run.case, file));
    place.append(
      element("h3", {}, runs.length > 1 ? run.name : "Run"),
      element(
        "dl",
        {},
        ...[
          ["Talus", `${m.version} (${m.revision}), ${m.compiler}`],
          ["Seed", run.members > 1 ? `${m.seed} and on, ${run.members} members` : String(m.seed)],
          ["Instruction set", `${m.instruction_set}: the same case, seed and instruction set are bitwise reproducible`],
          ["Status", run.status],
          ["Begun", `${m.started}, ${m.threads} thread${m.threads === 1 ? "" : "s"}, ${m.processor}, ${m.system}`],
          ["Fingerprint", m.fingerprint],
        ].flatMap(([term, text]) => [element("dt", {}, term), element("dd", {}, text)]),
        element("dt", {}, "Again"),
        element("dd", {}, element("span", { className: "on-screen" }, save, " and "), element("code", { className: "command" }, members)),
      ),
      element("details", {}, element("summary", {}, "The case as resolved: every key, in SI"), element("pre", {}, run.case)),
    );
  }
}
