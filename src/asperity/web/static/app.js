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
})();

// A picture that is taken away while the window changes has no size to be drawn in again; that is no error.
window.addEventListener("unhandledrejection", (event) => {
  const text = String((event.reason && event.reason.message) || event.reason);
  if (text.startsWith("Resize must be passed a displayed plot div")) event.preventDefault();
});
