/* Maps of runs on the page Explore: each area with a scene is shown once by the viewer of reports, one map large. Areas side by
   side share view, cross, section line, chosen map, load step and colours; what differs between two is a map of its own. */
(function () {
"use strict";

/* Addresses of the pages begin with a path of their own, below which this file lies, too. */
const root = document.currentScript.src.replace(/\/static\/explore\.js.*$/, "");
const { text: words, make } = AsperityViewer;
const all = (selector) => [...document.querySelectorAll(selector)];
const shownRuns = () => all("[data-scene][data-ready]").map((area) => area.viewer);

const last = new Map(); // the viewer of each area, which a later one of the same area goes on from

async function mount(area) {
  area.dataset.mounted = "1";
  const before = last.get(area.id), address = root + area.dataset.scene;
  if (area.viewer) area.style.minHeight = `${area.offsetHeight}px`; else area.textContent = "loading the maps …";
  try {
    const answer = await fetch(address);
    const scene = answer.ok ? await answer.json() : null;
    if (!scene) { area.textContent = "This contact has no maps: its grid is one line."; return; }
    for (const map of scene.maps) for (const array of map.arrays) if (array.url) array.url = `${address}/${encodeURIComponent(array.url)}`;
    if (area.viewer) area.viewer.stop();
    area.textContent = "";
    const viewer = area.viewer = AsperityViewer.create(area, scene, { layout: "one", centred: true, above: area.closest(".beside") ? 560 : 490 });
    last.set(area.id, viewer);
    if (before) goOn(viewer, before);
    await viewer.ready;
    area.style.minHeight = "";
    area.dataset.ready = String(1 + Number(area.dataset.ready || 0));
    begin();
  } catch (error) {
    area.textContent = "The maps could not be shown.";
    console.error(error);
  }
}
window.asperityMaps = (id) => { const area = document.getElementById(id); if (area) mount(area); };

/* Maps of the same run that have become more: what is shown stays, and a person who is at the decisive step stays there. */
function goOn(viewer, before) {
  const steps = viewer.scene.steps, old = before.scene.steps, name = before.visible.length ? before.visible[0].map.name : "";
  if (steps && old) {
    const there = steps.numbers.indexOf(old.numbers[before.position.steps]);
    if (before.position.steps !== old.first && there >= 0) viewer.position.steps = there;
    viewer.setTexts();
  }
  viewer.line = [...before.line]; viewer.lineShown = before.lineShown; viewer.cursor = before.cursor; viewer.along = before.along;
  viewer.setView(...before.centre, before.zoom);
  if (panelOf(viewer, name)) viewer.ready = Promise.all([viewer.ready, viewer.show([name])]);
}

/* ---- what runs side by side share ---- */

const panelOf = (viewer, name) => viewer.panels.find((panel) => panel.map.name === name);
const ticked = (name) => { const box = document.querySelector(`[data-together] input[name=${name}]`); return Boolean(box && box.checked); };

/* The controls, and a first state in which all is shared, once both runs are there. */
function begin() {
  const bar = document.querySelector("[data-together]"), [first, second] = shownRuns();
  if (bar && second && bar.dataset.begun) scales();
  if (!bar || !second || bar.dataset.begun) return;
  bar.dataset.begun = "1";
  const tick = (name, text, action) => {
    const label = make("label", bar, {}), box = make("input", label, { type: "checkbox", name });
    label.append(` ${text}`); box.checked = true;
    box.addEventListener("change", action);
  };
  tick("colours", "same colours", scales);
  if (first.scene.steps && second.scene.steps) tick("steps", "same load step", () => step(first, second, "steps"));
  const button = make("button", bar, { type: "button", "aria-pressed": "false", "data-subtract": "" }, "Difference");
  button.addEventListener("click", () => openDifference(button));
  make("output", bar, { "data-both": "", "aria-live": "off" });
  scales();
  step(first, second, "steps");
  const shown = first.visible[0].map.name;
  follow(second, () => SHARED.line(first, second, { line: first.line }));
  if (panelOf(second, shown)) follow(second, () => second.choose(shown));
}

function follow(viewer, action) { viewer.following = true; try { action(); } finally { viewer.following = false; } }

/* Ranges of the colours of maps that both have: those of both together, or each its own. */
function scales() {
  const viewers = shownRuns(), together = ticked("colours");
  if (viewers.length < 2) return;
  const parts = (viewer) => [...viewer.panels.map((panel) => [panel.map, panel.colours]), ...viewer.belows.map((below) => [below.section, below.colours])].filter(([map]) => map.range);
  const [first, second] = viewers.map(parts);
  for (const one of first) {
    const other = second.find(([map]) => map.name === one[0].name && Boolean(map.axis) === Boolean(one[0].axis));
    if (!other) continue;
    const ends = [Math.min(one[0].range[0], other[0].range[0]), Math.max(one[0].range[1], other[0].range[1])];
    const units = [one, other].map(([map]) => map.own || (map.own = map.unit)), larger = units[0].factor >= units[1].factor ? units[0] : units[1];
    for (const [map, colours] of [one, other]) {
      const log = together ? one[1].log : colours.log;
      map.unit = together ? larger : map.own;
      colours.shared = together ? ends : null;
      colours.reset(); colours.log = log; colours.changed();
    }
  }
  for (const viewer of viewers) { viewer.renamed(); viewer.drawSoon(); viewer.thumbsSoon(); }
}

/* The other one shows the step of the same number, or the depth that is nearest. */
function step(viewer, other, kind) {
  if (!viewer.scene[kind] || !other.scene[kind] || (kind === "steps" && !ticked("steps"))) return;
  const of = (one) => kind === "steps" ? one.scene.steps.numbers : one.scene.below.depths, wanted = of(viewer)[viewer.position[kind]];
  let best = 0;
  of(other).forEach((value, k) => { if (Math.abs(value - wanted) < Math.abs(of(other)[best] - wanted)) best = k; });
  if (best !== other.position[kind]) follow(other, () => other.set(kind, best));
}

/* Values of both runs, and how much they differ, at the cross of one of them. */
function both(viewer) {
  const output = document.querySelector("[data-both]"), [first, second] = shownRuns();
  if (!output || !second) return;
  const panels = [first, second].map((one) => one.visible[0]);
  const texts = panels.map((panel, k) => { const at = [first, second][k].cursor; return at && [first, second][k].here(panel) ? panel.text(...at) : ""; });
  let said = "";
  if (texts[0] && texts[1] && panels[0].map.name === panels[1].map.name) {
    said = `${panels[0].map.title}: ${label(0)} ${texts[0]}, ${label(1)} ${texts[1]}`;
    const values = panels.map((panel, k) => panel.at(...[first, second][k].cursor));
    if (panels[0].map.kind === "values" && values.every(Number.isFinite)) said += `, difference ${words.withUnit(words.rounded((values[0] - values[1]) / panels[0].map.unit.factor, words.decimalsFor((panels[0].raster.step + panels[1].raster.step) / 2 / panels[0].map.unit.factor, Math.max(...values.map(Math.abs)) / panels[0].map.unit.factor)), panels[0].map.unit.symbol)}`;
    said += `, at ${viewer.placeText()}`;
  }
  if (output.textContent !== said) output.textContent = said;
}
const label = (k) => all("[data-scene]")[k].dataset.label;

const others = (viewer) => [...shownRuns(), difference && difference.viewer].filter((one) => one && one !== viewer);
const scaledTo = (viewer, other, x, y) => [(x / viewer.size[0]) * other.size[0], (y / viewer.size[1]) * other.size[1]];
const SHARED = {
  view: (viewer, other, { centre, zoom }) => other.setView(...scaledTo(viewer, other, ...centre), zoom),
  cross: (viewer, other, { at }) => at ? other.point(...scaledTo(viewer, other, ...at)) : other.leave(),
  line: (viewer, other, { line }) => other.setLine(...scaledTo(viewer, other, line[0], line[1]), ...scaledTo(viewer, other, line[2], line[3])),
  show: (viewer, other, { name }) => { if (panelOf(other, name)) other.choose(name); },
  set: (viewer, other, { kind }) => { if (shownRuns().includes(other)) step(viewer, other, kind); },
  colours: (viewer, other, { name, low, high, log }) => {
    const panel = ticked("colours") && shownRuns().includes(viewer) ? panelOf(other, name) : null;
    if (!panel) return;
    Object.assign(panel.colours, { low, high, log });
    panel.colours.changed(); other.drawSoon(); other.thumbsSoon();
  },
};
for (const [kind, share] of Object.entries(SHARED)) document.addEventListener(`viewer-${kind}`, (event) => {
  const viewer = event.detail.viewer;
  if (!viewer.following) for (const other of others(viewer)) if (!other.following) follow(other, () => share(viewer, other, event.detail));
  if (kind === "cross" && !viewer.following && shownRuns().length > 1) both(viewer);
  if (kind === "set" || kind === "show") subtractSoon(kind === "show" ? event.detail.name : "");
});

/* ---- the difference of two runs ---- */

let difference = null, waiting = 0;

function openDifference(button) {
  const box = document.querySelector("[data-difference]"), open = box.hidden;
  box.hidden = !open;
  button.setAttribute("aria-pressed", String(open));
  box.parentElement.classList.toggle("three", open);
  if (!open) return;
  if (!difference) {
    const place = box.querySelector("[data-difference-map]"), [first, second] = shownRuns();
    const row = make("label", place, { class: "difference-choice" }, "Map "), select = make("select", row);
    for (const panel of first.panels) if (panel.map.kind === "values" && panelOf(second, panel.map.name)) make("option", select, { value: panel.map.name }, panel.map.title);
    select.addEventListener("change", () => { const name = select.value; for (const one of shownRuns()) follow(one, () => one.choose(name)); subtractSoon(name); });
    difference = { select, map: make("div", place), said: make("div", place, { "data-difference-words": "", role: "status" }), palette: box.dataset.palette, viewer: null };
    const shown = first.visible[0].map.name;
    if ([...select.options].some((option) => option.value === shown)) select.value = shown;
  }
  subtractSoon("");
  const { top } = box.getBoundingClientRect();
  if (top < 0 || top > 0.6 * window.innerHeight) box.scrollIntoView({ block: "start", behavior: calm() });
}

function subtractSoon(name) {
  if (!difference || document.querySelector("[data-difference]").hidden) return;
  if (name && [...difference.select.options].some((option) => option.value === name)) difference.select.value = name;
  clearTimeout(waiting);
  waiting = setTimeout(() => subtract().catch(console.error), 60);
}

async function subtract() {
  const viewers = shownRuns(), name = difference.select.value;
  const refusal = apart(viewers, name);
  difference.map.hidden = Boolean(refusal);
  if (refusal) { tell([refusal]); return; }
  const panels = viewers.map((viewer) => panelOf(viewer, name));
  const rasters = await Promise.all(panels.map((panel, k) => viewers[k].raster(panel.map.arrays[viewers[k].index(panel.map)], panel.map)));
  if (difference.select.value !== name) return;
  const grid = commonGrid(rasters), values = panels.map((panel, k) => onto(rasters[k], grid, panel.map.blank.value, viewers[k].size));
  const found = statistics(values[0], values[1], grid);
  show(viewers, panels, grid, found, rasters);
  tell(said(viewers, panels, rasters, grid, found));
}

/* Why there is no difference of the maps of this name; empty if there is. */
function apart([first, second], name) {
  if (!name) return "The two runs have no map of values in common.";
  if (first.size.some((side, k) => Math.abs(side - second.size[k]) > 1e-6 * side)) {
    const size = (one) => one.size.map((side) => words.withUnit(words.short(side / one.scene.length.factor), one.scene.length.symbol)).join(" × ");
    return `The runs differ in size, ${size(first)} and ${size(second)}: their maps cannot be subtracted point by point. Choose two runs on surfaces of the same size.`;
  }
  for (const [k, one] of [first, second].entries()) {
    const panel = panelOf(one, name);
    if (!one.here(panel)) return `${panel.map.title} of ${label(k)} is known only at step ${one.scene.steps.texts[panel.map.step]}. Choose that step.`;
  }
  return "";
}

/* Along each side that of the raster with the larger points. */
function commonGrid([a, b]) {
  const x = a.cell[0] >= b.cell[0] * (1 - 1e-9) ? a : b, y = a.cell[1] >= b.cell[1] * (1 - 1e-9) ? a : b;
  return { nx: x.nx, ny: y.ny, cell: [x.cell[0], y.cell[1]] };
}
const lies = (raster, grid) => raster.nx === grid.nx && raster.ny === grid.ny;

/* Values of a raster on a grid with larger points: the mean over the area of each; NaN where there is none. */
function onto(raster, grid, blank, size) {
  const { nx, ny } = raster, q = raster.levels[0].q, out = new Float64Array(grid.nx * grid.ny), empty = blank === null ? NaN : blank;
  const value = (at) => q[at] === raster.masked ? empty : raster.low + raster.step * q[at];
  if (lies(raster, grid)) { for (let at = 0; at < out.length; at++) out[at] = value(at); return out; }
  const shares = (n, from, to, side) => {
    const pairs = [];
    for (let i = 0; i < n; i++) {
      const low = i * from, high = Math.min((i + 1) * from, side);
      for (let k = Math.floor(low / to + 1e-9); k * to < high - 1e-9 * from; k++) pairs.push([i, k, Math.min(high, (k + 1) * to) - Math.max(low, k * to)]);
    }
    return pairs;
  };
  const across = shares(nx, raster.cell[0], grid.cell[0], size[0]), weight = new Float64Array(out.length);
  for (const [j, m, tall] of shares(ny, raster.cell[1], grid.cell[1], size[1])) for (const [i, k, wide] of across) {
    const found = value(j * nx + i), at = m * grid.nx + k;
    if (found === found && at < out.length) { out[at] += wide * tall * found; weight[at] += wide * tall; }
  }
  for (let at = 0; at < out.length; at++) out[at] = weight[at] > 0 ? out[at] / weight[at] : NaN;
  return out;
}

function statistics(first, second, grid) {
  const values = new Float64Array(first.length);
  let largest = 0, place = 0, sum = 0, squares = 0, count = 0;
  for (let at = 0; at < values.length; at++) {
    const found = values[at] = first[at] - second[at];
    if (found !== found) continue;
    count++; sum += found; squares += found * found;
    if (Math.abs(found) > Math.abs(largest)) { largest = found; place = at; }
  }
  const at = [(place % grid.nx + 0.5) * grid.cell[0], (Math.floor(place / grid.nx) + 0.5) * grid.cell[1]];
  return { values, largest, at, mean: count ? sum / count : NaN, rms: count ? Math.sqrt(squares / count) : NaN, count };
}

/* The unit with the prefix that suits a value. */
function suited(unit, value) {
  const prefixes = { p: 1e-12, n: 1e-9, µ: 1e-6, m: 1e-3, "": 1, k: 1e3, M: 1e6, G: 1e9 };
  const own = Object.keys(prefixes).find((prefix) => unit.symbol.startsWith(prefix) && Math.abs(prefixes[prefix] / unit.factor - 1) < 1e-6);
  const base = own === undefined ? "" : unit.symbol.slice(own.length);
  if (!/^[A-Za-z]+$/.test(base) || !(value > 0)) return unit;
  const best = Object.keys(prefixes).reverse().find((prefix) => prefixes[prefix] <= value * (1 + 1e-9)) || "p";
  return { symbol: best + base, factor: prefixes[best] };
}

function show([first], [panel], grid, found, rasters) {
  const most = Math.abs(found.largest) || panel.map.unit.factor, step = 2 * most / 65534, q = Uint16Array.from(found.values, (value) => Number.isNaN(value) ? 65535 : Math.round((value + most) / step));
  const array = { shape: [grid.nx, grid.ny], cell: grid.cell, bits: 16, low: -most, step, q, known: Math.max(step, (rasters[0].step + rasters[1].step) / 2) };
  const title = `${panel.map.title}, ${label(0)} − ${label(1)}`;
  const map = { name: "difference", title, alt: `Difference of ${title}.`, kind: "values", along: null, step: null, shown: true, blank: { text: "no value", value: null }, reduce: "mean",
    unit: suited(panel.map.unit, most), colours: "difference", range: [-most, most], log: false, decades: 0, arrays: [array] };
  const scene = { ...first.scene, cell: grid.cell, line: [...first.line], palettes: { difference: difference.palette }, maps: [map], steps: null, depths: null, below: null, sections: [], spots: null, notes: [] };
  if (difference.viewer) difference.viewer.stop();
  difference.viewer = AsperityViewer.create(difference.map, scene, { layout: "one", above: 560 });
  follow(difference.viewer, () => { difference.viewer.lineShown = first.lineShown; difference.viewer.setView(...first.centre, first.zoom); });
  difference.map.viewer = difference.viewer;
  difference.viewer.ready.then(() => { difference.map.dataset.of = panel.map.name; });
}

function said(viewers, panels, rasters, grid, found) {
  const number = (value) => difference.viewer.panels[0].quantity(value, Math.max(2 * Math.abs(found.largest) / 65534, (rasters[0].step + rasters[1].step) / 2), Math.abs(value));
  const known = (rasters[0].step + rasters[1].step) / 2 / Math.sqrt(Math.max(found.count, 1)); // of a mean of that many rounded values
  const told = (value) => { if (Math.abs(value) < known) return "0"; const unit = suited(panels[0].map.unit, Math.abs(value)); return words.withUnit(words.short(Number((value / unit.factor).toPrecision(3))), unit.symbol); };
  const at = viewers.map((one, k) => panels[k].map.along === "steps" ? `${label(k)} at step ${one.scene.steps.texts[one.position.steps]}` : label(k));
  const lines = [`${panels[0].map.title}: ${at[0]}, minus ${at[1]}.`];
  if (!found.count) return [...lines, "No point has a value in both."];
  lines.push(found.largest === 0 ? "The maps are equal at all points." : `Largest difference ${number(found.largest)} at ${viewers[0].placeText(...found.at)}; mean ${told(found.mean)}, root mean square ${told(found.rms)}.`);
  rasters.forEach((raster, k) => {
    const whole = viewers[k].cell[0], shown = Math.round(raster.cell[0] / whole);
    if (shown > 1) lines.push(`Of ${label(k)} this step is stored with one value, the ${{ max: "largest", min: "smallest", mean: "mean" }[panels[k].map.reduce]}, for each ${shown} × ${shown} points.`);
    if (!lies(raster, grid)) lines.push(`${label(k)[0].toUpperCase()}${label(k).slice(1)} has ${raster.nx} × ${raster.ny} points, ${label(1 - k)} ${rasters[1 - k].nx} × ${rasters[1 - k].ny} over the same size: it was brought to ${grid.nx} × ${grid.ny} points by the mean over the area of each.`);
  });
  const blank = panels[0].map.blank;
  if (blank.value !== null && [rasters[0], rasters[1]].some((raster) => raster.levels[0].q.includes(raster.masked))) lines.push(`Points with ${blank.text === "in contact" ? "contact" : blank.text} count as ${blank.value}.`);
  return lines;
}

function tell(lines) { difference.said.replaceChildren(...lines.map((line) => Object.assign(document.createElement("p"), { textContent: line }))); }

/* ---- contact spots ---- */

const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches ? "auto" : "smooth";

function bring(viewer) { const [panel] = viewer.visible; if (panel) panel.box.scrollIntoView({ block: "center", behavior: calm() }); }

function choose(row) {
  for (const other of row ? row.parentElement.querySelectorAll(".chosen") : []) { other.classList.remove("chosen"); }
  if (row) row.classList.add("chosen");
}

function mark(row) {
  const area = document.getElementById(row.dataset.of);
  if (!area || !area.viewer) return;
  const [x, y] = row.dataset.spot.split(",").map(Number);
  choose(row);
  area.viewer.highlight({ x, y, zoom: true });
  bring(area.viewer);
}

document.addEventListener("click", (event) => { const row = event.target.closest && event.target.closest("[data-spot]"); if (row) mark(row); });
document.addEventListener("keydown", (event) => { if (event.key === "Enter" && event.target.matches && event.target.matches("[data-spot]")) mark(event.target); });
/* A spot that is pressed on a map is chosen in the table, too. */
document.addEventListener("viewer-pick", (event) => {
  const { viewer, spot } = event.detail, area = viewer.element;
  if (!spot) return;
  bring(viewer);
  const row = all(`[data-of="${area.id}"][data-spot]`).find((one) => {
    const [x, y] = one.dataset.spot.split(",").map(Number), r = spot.raster;
    return spot.cells.has(Math.floor(y / r.cell[1]) * r.nx + Math.floor(x / r.cell[0]));
  });
  if (row) choose(row);
});

/* The table of spots is that of the step that the maps show. */
let told = 0;
document.addEventListener("viewer-set", (event) => {
  const { viewer, kind } = event.detail;
  if (kind !== "steps" || !viewer.element.id) return;
  viewer.untold = true;
  clearTimeout(told);
  told = setTimeout(() => { for (const one of shownRuns()) if (one.untold) { one.untold = false; emitEvent("asperity-step", { of: one.element.id, step: one.position.steps }); } }, 80);
});

/* ---- dark and light ---- */

/* Pictures of the viewer are drawn again in the colours of the page; so are axes in space, which no style sheet reaches. */
async function restyle() {
  for (const area of all("[data-scene], [data-difference-map] .av")) if (area.viewer) area.viewer.restyled();
  for (const plot of all(".js-plotly-plot")) if (plot.layout && plot.layout.scene) await inSpace(plot);
}
async function inSpace(plot) {
  const ink = getComputedStyle(document.body).getPropertyValue("--ink").trim();
  if (plot.dataset.ink === ink && plot.layout.scene.xaxis.color === ink) return;
  plot.dataset.ink = ink;
  const { Plotly } = await import("nicegui-plotly"), change = { "font.color": ink };
  for (const axis of ["xaxis", "yaxis", "zaxis"]) { change[`scene.${axis}.color`] = ink; change[`scene.${axis}.gridcolor`] = "#8a8f98"; }
  await Plotly.relayout(plot, change);
}
function watchPlots() {
  for (const plot of all(".js-plotly-plot:not([data-watched])")) if (plot.on && plot.layout && plot.layout.scene) {
    plot.dataset.watched = "1";
    plot.on("plotly_afterplot", () => inSpace(plot));
    inSpace(plot);
  }
}
const style = new MutationObserver(restyle);
document.addEventListener("DOMContentLoaded", () => style.observe(document.body, { attributes: true, attributeFilter: ["class"] }));

/* The bar at the top of the window is Quasar's, and has no name of its own. */
const named = () => { for (const bar of all(".q-loading-bar:not([aria-label])")) bar.setAttribute("aria-label", "loading"); };
const look = () => { all("[data-scene]:not([data-mounted])").forEach(mount); watchPlots(); named(); };
new MutationObserver(look).observe(document.documentElement, { childList: true, subtree: true });
})();
