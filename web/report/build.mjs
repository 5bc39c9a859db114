// SPDX-License-Identifier: Apache-2.0
// Bundles src/ with its packages into one HTML file: node build.mjs FOLDER_OF_NODE_MODULES PAGE
// The same sources and packages give the same bytes.
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [folder, page] = process.argv.slice(2);
const packages = join(folder, "node_modules");
const esbuild = createRequire(join(folder, "package.json"))("esbuild");

async function bundle(entry) {
  const built = await esbuild.build({
    entryPoints: [join(here, "src", entry)],
    bundle: true,
    minify: true,
    write: false,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none", // the licences stand at the top of the page
    nodePaths: [packages],
    logLevel: "warning",
  });
  return built.outputFiles[0].text;
}

function licence(name) {
  const { version } = JSON.parse(readFileSync(join(packages, name, "package.json"), "utf8"));
  return `${name} ${version}\n\n${readFileSync(join(packages, name, "LICENSE"), "utf8").trim()}\n`;
}

const licences = ["three", "uplot"].map(licence).join("\n").replaceAll("--", "- -");
const script = (await bundle("main.js")).replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const style = await bundle("style.css");
const html = readFileSync(join(here, "src", "index.html"), "utf8")
  .replace("<!--build:licences-->", () => `<!--\nThis page contains:\n\n${licences}-->`)
  .replace("<!--build:style-->", () => `<style>\n${style}</style>`)
  .replace("<!--build:script-->", () => `<script>\n${script}</script>`);
writeFileSync(page, html);
