/* Dropping and choosing files: their bytes go to this machine's own application, one request a file. */
(function () {
"use strict";

/* Addresses of the pages begin with a path of their own, below which this file lies, too. */
const root = document.currentScript.src.replace(/\/static\/app\.js.*$/, "");

/* All files are sent, one after the other, before the page is told of them: it may draw itself again then. */
async function send(area, files) {
  const state = area.querySelector(".drop-state");
  const paths = [], refused = [];
  area.classList.remove("refused");
  for (const [number, file] of files.entries()) {
    state.textContent = `reading ${file.name} …` + (files.length > 1 ? ` (${number + 1} of ${files.length})` : "");
    try {
      const answer = await fetch(`${root}${area.dataset.upload}?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
      const found = await answer.json();
      if (found.error) refused.push(`${file.name}: ${found.error}`); else paths.push(found.path);
    } catch (error) {
      refused.push(`${file.name} could not be sent; is the application still running?`);
    }
  }
  const here = files.length === 1 ? `${files[0].name} is here` : `${paths.length} of ${files.length} files are here`;
  state.textContent = [...(paths.length ? [here] : []), ...refused].join("\n");
  area.classList.toggle("refused", refused.length > 0);
  if (paths.length) emitEvent("asperity-uploaded", { path: paths[paths.length - 1], paths });
}

function choose(area) {
  const input = Object.assign(document.createElement("input"), { type: "file", multiple: true });
  input.className = "drop-input";
  input.addEventListener("change", () => send(area, [...input.files]));
  area.querySelectorAll(".drop-input").forEach((old) => old.remove());
  area.append(input);
  input.click();
}

const areaOf = (event) => event.target.closest && event.target.closest("[data-upload]");

document.addEventListener("click", (event) => {
  const area = areaOf(event);
  if (area && !event.target.classList.contains("drop-input")) choose(area);
});
document.addEventListener("keydown", (event) => {
  const area = areaOf(event);
  if (area && (event.key === "Enter" || event.key === " ")) { event.preventDefault(); choose(area); }
});
for (const name of ["dragover", "drop", "dragleave"]) {
  document.addEventListener(name, (event) => {
    const area = areaOf(event);
    if (!area) return;
    event.preventDefault();
    area.classList.toggle("over", name === "dragover");
    if (name === "drop") send(area, [...event.dataTransfer.files]);
  });
}

/* Maps of runs: each area with a scene is shown once by the viewer of reports; areas side by side share their view. */
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
    const viewer = area.viewer = AsperityViewer.create(area, scene);
    last.set(area.id, viewer);
    if (before) goOn(viewer, before);
    await viewer.ready;
    area.style.minHeight = "";
    area.dataset.ready = String(1 + Number(area.dataset.ready || 0));
    together(viewer);
  } catch (error) {
    area.textContent = "The maps could not be shown.";
    console.error(error);
  }
}
window.asperityMaps = (id) => { const area = document.getElementById(id); if (area) mount(area); };

/* Maps of the same run that have become more: what is shown stays, and a person who is at the decisive step stays there. */
function goOn(viewer, before) {
  const steps = viewer.scene.steps, old = before.scene.steps, names = before.visible.map((panel) => panel.map.name);
  if (steps && old) {
    const there = steps.numbers.indexOf(old.numbers[before.position.steps]);
    if (before.position.steps !== old.first && there >= 0) viewer.position.steps = there;
    viewer.setTexts();
  }
  viewer.line = [...before.line]; viewer.lineShown = before.lineShown;
  viewer.setView(...before.centre, before.zoom);
  viewer.ready = viewer.ready.then(() => viewer.show(viewer.panels.map((panel) => panel.map.name).filter((name) => names.includes(name))));
}

/* The table of spots is that of the step that the maps show. */
document.addEventListener("viewer-set", (event) => {
  const area = event.target.closest("[data-scene]");
  if (area && event.detail.kind === "steps") emitEvent("asperity-step", { of: area.id, step: event.detail.number });
});

function together(viewer) {
  const own = viewer.setView.bind(viewer);
  viewer.setView = (x, y, zoom) => {
    own(x, y, zoom);
    for (const area of document.querySelectorAll("[data-scene][data-ready]")) {
      const other = area.viewer;
      if (!other || other === viewer || other.following) continue;
      other.following = viewer.following = true;
      other.setView((x / viewer.size[0]) * other.size[0], (y / viewer.size[1]) * other.size[1], zoom);
      other.following = viewer.following = false;
    }
  };
}

function mark(row) {
  const area = document.getElementById(row.dataset.of);
  if (!area || !area.viewer) return;
  const [x, y] = row.dataset.spot.split(",").map(Number);
  row.parentElement.querySelectorAll(".chosen").forEach((other) => other.classList.remove("chosen"));
  row.classList.add("chosen");
  area.viewer.highlight({ x, y, zoom: true });
  area.scrollIntoView({ block: "nearest", behavior: "smooth" });
}

document.addEventListener("click", (event) => { const row = event.target.closest && event.target.closest("[data-spot]"); if (row) mark(row); });
document.addEventListener("keydown", (event) => { if (event.key === "Enter" && event.target.matches && event.target.matches("[data-spot]")) mark(event.target); });

const look = () => document.querySelectorAll("[data-scene]:not([data-mounted])").forEach(mount);
new MutationObserver(look).observe(document.documentElement, { childList: true, subtree: true });
})();

// A picture that is taken away while the window changes has no size to be drawn in again; that is no error.
window.addEventListener("unhandledrejection", (event) => {
  const text = String((event.reason && event.reason.message) || event.reason);
  if (text.startsWith("Resize must be passed a displayed plot div")) event.preventDefault();
});
