/* What the search of a built site finds: node search.js SITE QUERY… prints a list of pages for each query, best first. */
"use strict";

const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");

const [site, ...queries] = process.argv.slice(2);
const page = fs.readFileSync(path.join(site, "search.html"), "utf8");
const scripts = [...page.matchAll(/src="(_static\/(?:language_data|[\w-]*stemmer|searchtools)\.js|searchindex\.js)/g)].map((one) => one[1]);
const world = vm.createContext({
  document: { getElementById: () => null, querySelectorAll: () => [] },
  URLSearchParams,
  localStorage: { setItem: () => {} },
  DOCUMENTATION_OPTIONS: {},
  SPHINX_HIGHLIGHT_ENABLED: false,
  Documentation: {},
  _: (text) => text,
  _ready: () => {},
  console,
});
world.window = world;
for (const file of scripts)
  vm.runInContext(fs.readFileSync(path.join(site, file), "utf8"), world, { filename: file });
const found = queries.map((query) => {
  world.query = query;
  world.location = { search: `?${new URLSearchParams({ q: query })}` };
  return vm.runInContext(
    "Search._performSearch(...Search._parseQuery(query)).reverse().map((one) => one[0] + one[2])",
    world,
  );
});
console.log(JSON.stringify(found));
