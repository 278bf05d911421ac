/* Dropping and choosing files: their bytes go to this machine's own application, one request a file. */
(function () {
"use strict";

async function send(area, files) {
  const state = area.querySelector(".drop-state");
  for (const file of files) {
    state.textContent = `reading ${file.name} …`;
    try {
      const answer = await fetch(`${area.dataset.upload}?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
      const found = await answer.json();
      state.textContent = found.error || `${file.name} is here`;
      area.classList.toggle("refused", Boolean(found.error));
      if (!found.error) emitEvent("asperity-uploaded", { path: found.path });
    } catch (error) {
      state.textContent = `${file.name} could not be sent; is the application still running?`;
    }
  }
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
