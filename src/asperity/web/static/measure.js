/* Measuring on maps and curves of Plotly: a line with two ends, cursors, regions that are drawn, outlines and scale bars,
   in one drawing above the picture. Lengths are in m; the page keeps all of them and is told of every change. */
(function () {
"use strict";

const SVG = "http://www.w3.org/2000/svg";
const states = new Map(), areas = new Map();
const EVERY = 40; /* milliseconds between two messages while something is dragged */
const LEAST = 4; /* pixels of the screen that a drag must have to count */

const stateOf = (key) => { if (!states.has(key)) states.set(key, { tool: "zoom" }); return states.get(key); };
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

function made(parent, name, attributes, text) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
}

/* One picture with the drawing above it. */
class Area {
  constructor(box, picture) {
    Object.assign(this, { box, picture, key: box.dataset.measure, kind: box.dataset.kind });
    this.svg = made(box, "svg", { class: "measure-drawing" });
    this.drawing = null; /* what is being drawn: points in m */
    this.told = 0;
    this.held = false;
    for (const name of ["plotly_afterplot", "plotly_relayout", "plotly_relayouting"]) picture.on(name, () => this.draw());
    this.svg.addEventListener("keydown", (event) => this.typed(event));
    this.draw();
  }

  get state() { return stateOf(this.key); }
  get axes() { const full = this.picture._fullLayout; return full && full.xaxis ? [full.xaxis, full.yaxis] : null; }
  get frame() { const [x, y] = this.axes; return { left: x._offset, top: y._offset, width: x._length, height: y._length }; }

  /* Places on the screen, from the corner of the box, and back. */
  px(x) { const axis = this.axes[0]; return axis._offset + axis.l2p(x / this.state.scale); }
  py(y) { const axis = this.axes[1]; return axis._offset + axis.l2p(y / (this.state.zscale || this.state.scale)); }
  place(event) {
    const rect = this.svg.getBoundingClientRect(), [ax, ay] = this.axes, scale = this.state.scale;
    return this.inside([ax.p2l(event.clientX - rect.left - ax._offset) * scale, ay.p2l(event.clientY - rect.top - ay._offset) * scale]);
  }
  inside([x, y]) {
    const [lx, ly] = this.state.size || [Infinity, Infinity];
    return [clamp(x, 0, lx), this.kind === "map" ? clamp(y, 0, ly) : y];
  }

  tell(what, more, done) {
    const now = performance.now();
    if (!done && now - this.told < EVERY) return;
    this.told = now;
    emitEvent("asperity-measure", { key: this.key, what, done, ...more });
  }

  /* Drawing again keeps the element that has the keyboard. */
  draw() {
    if (this.held || !this.axes || !this.state.scale || !this.svg.isConnected) return;
    const focused = this.svg.contains(document.activeElement) ? document.activeElement.dataset.part : null;
    this.svg.replaceChildren();
    const { left, top, width, height } = this.frame;
    const clip = made(made(this.svg, "defs", {}), "clipPath", { id: `clip-${this.key}` });
    made(clip, "rect", { x: left, y: top, width, height });
    this.clipped = made(this.svg, "g", { "clip-path": `url(#clip-${this.key})` });
    const drawn = this.state.tool && this.state.tool !== "zoom" && !(this.kind === "curve" && this.state.tool === "line");
    this.sheet = null;
    if (drawn) this.layer(left, top, width, height);
    if (this.kind === "map") { this.outlines(); this.bars(); this.line(); } else { this.bands(); this.cursors(); }
    this.sketch = made(this.clipped, "path", { class: "measure-sketch" });
    this.drawSketch();
    if (focused) { const again = this.svg.querySelector(`[data-part="${focused}"]`); if (again) again.focus({ preventScroll: true }); }
  }

  /* The sheet on which a tool draws. */
  layer(left, top, width, height) {
    const names = { line: "draw a line", rectangle: "draw a rectangle", ellipse: "draw an ellipse", polygon: "press the corners of a polygon",
      freehand: "draw around a region", range: "draw along a range" };
    const sheet = made(this.svg, "rect", { class: "measure-sheet", x: left, y: top, width, height, tabindex: -1, "data-part": "sheet", "aria-label": names[this.state.tool] });
    this.sheet = sheet;
    const tool = this.state.tool;
    sheet.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      event.preventDefault();
      sheet.focus({ preventScroll: true });
      if (tool === "polygon") return this.corner(event);
      sheet.setPointerCapture(event.pointerId);
      this.held = true;
      this.from = [event.clientX, event.clientY];
      this.drawing = [this.place(event)];
    });
    sheet.addEventListener("pointermove", (event) => {
      if (!this.drawing) return;
      const at = this.place(event);
      if (tool === "polygon") { this.next = at; this.drawSketch(); return; }
      if (tool === "freehand") this.drawing.push(at); else this.drawing[1] = tool === "ellipse" && event.shiftKey ? this.round(at) : tool === "line" && event.shiftKey ? this.straight(at) : at;
      this.drawSketch();
    });
    const ended = (event) => {
      if (tool === "polygon" || !this.drawing) return;
      this.held = false;
      const points = this.drawing, far = Math.hypot(event.clientX - this.from[0], event.clientY - this.from[1]);
      this.drawing = null;
      if (event.type === "pointerup" && points.length > 1 && (tool === "freehand" || far >= LEAST)) this.finish(tool, points);
      this.draw();
    };
    sheet.addEventListener("pointerup", ended);
    sheet.addEventListener("pointercancel", ended);
    sheet.addEventListener("dblclick", () => this.close());
  }

  round([x, y]) {
    const [x0, y0] = this.drawing[0], side = Math.max(Math.abs(x - x0), Math.abs(y - y0));
    return [x0 + Math.sign(x - x0) * side, y0 + Math.sign(y - y0) * side];
  }
  straight([x, y]) {
    const [x0, y0] = this.drawing[0];
    return Math.abs(x - x0) > Math.abs(y - y0) ? [x, y0] : [x0, y];
  }

  corner(event) {
    const at = this.place(event);
    if (this.drawing && this.drawing.length > 2) {
      const [x, y] = this.drawing[0], rect = this.svg.getBoundingClientRect();
      if (Math.hypot(this.px(x) + rect.left - event.clientX, this.py(y) + rect.top - event.clientY) < 10) return this.close();
    }
    this.drawing = [...(this.drawing || []), at];
    this.next = at;
    this.drawSketch();
  }

  close() {
    if (this.state.tool !== "polygon" || !this.drawing) return;
    const points = this.drawing;
    this.drawing = null;
    if (points.length > 2) this.finish("polygon", points);
    this.draw();
  }

  finish(tool, points) {
    if (tool === "line") { this.state.line = [...points[0], ...points[1]]; this.tell("line", { line: this.state.line }, true); }
    else if (tool === "range") this.tell("range", { from: points[0][0], to: points[1][0] }, true);
    else this.tell("region", { shape: tool === "freehand" ? "polygon" : tool, points }, true);
  }

  drawSketch() {
    if (!this.sketch) return;
    const points = this.drawing, tool = this.state.tool;
    if (!points) { this.sketch.setAttribute("d", ""); return; }
    const at = ([x, y]) => `${this.px(x)},${this.py(y)}`, [x0, y0] = points[0], [x1, y1] = points[1] || points[0];
    let path = "";
    if (tool === "rectangle") path = `M${[[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(at).join("L")}Z`;
    else if (tool === "range") { const { top, height } = this.frame; path = `M${this.px(x0)},${top}V${top + height}H${this.px(x1)}V${top}Z`; }
    else if (tool === "ellipse") {
      const rx = Math.abs(this.px(x1) - this.px(x0)) / 2, ry = Math.abs(this.py(y1) - this.py(y0)) / 2;
      const cx = (this.px(x0) + this.px(x1)) / 2, cy = (this.py(y0) + this.py(y1)) / 2;
      path = `M${cx - rx},${cy}A${rx},${ry} 0 1 0 ${cx + rx},${cy}A${rx},${ry} 0 1 0 ${cx - rx},${cy}Z`;
    } else path = `M${[...points, ...(tool === "polygon" && this.next ? [this.next] : [])].map(at).join("L")}`;
    this.sketch.setAttribute("d", path);
  }

  typed(event) {
    if (event.key === "Escape" && this.drawing) { this.drawing = null; this.held = false; this.draw(); event.stopPropagation(); }
    else if (event.key === "Enter" && this.state.tool === "polygon") this.close();
    else if (event.key === "Backspace" && this.state.tool === "polygon" && this.drawing) {
      this.drawing.pop();
      if (!this.drawing.length) this.drawing = null;
      this.drawSketch();
    } else return;
    event.preventDefault();
  }

  /* Something that is dragged with the mouse or moved with the keyboard: `move(at, done)` with a place, `step(x, y, done)` with steps. */
  drags(element, move, step) {
    element.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      event.preventDefault(); event.stopPropagation();
      element.focus({ preventScroll: true });
      element.setPointerCapture(event.pointerId);
      this.held = true;
      let last = this.place(event);
      const moved = (next) => { const at = this.place(next); move(at, false, [at[0] - last[0], at[1] - last[1]], next); last = at; };
      const ended = () => {
        for (const [name, handler] of [["pointermove", moved], ["pointerup", ended], ["pointercancel", ended]]) element.removeEventListener(name, handler);
        this.held = false;
        move(last, true, [0, 0], {});
        this.draw();
      };
      for (const [name, handler] of [["pointermove", moved], ["pointerup", ended], ["pointercancel", ended]]) element.addEventListener(name, handler);
    });
    element.addEventListener("keydown", (event) => {
      const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], Home: [-Infinity, 0], End: [Infinity, 0] };
      if (!(event.key in ways)) return;
      event.preventDefault(); event.stopPropagation();
      const by = event.shiftKey ? 10 : 1, [x, y] = ways[event.key];
      step(x * by, y * by);
    });
  }

  /* On maps: the line of the profile, its ends and the places of both cursors on it. */
  line() {
    const line = this.state.line;
    if (!line) return;
    const group = made(this.svg, "g", {});
    const under = made(this.clipped, "line", { class: "measure-line casing" }), over = made(this.clipped, "line", { class: "measure-line" });
    const whole = made(group, "line", { class: "measure-grip" });
    const marks = (this.state.marks || []).map((share, number) => [share, made(group, "circle", { class: "measure-mark", r: 4 }), made(group, "text", { class: "measure-name" }, "AB"[number])]);
    const ends = [0, 2].map((k) => {
      const name = k ? "end of the profile" : "start of the profile";
      const grip = made(group, "g", { class: "measure-handle", tabindex: 0, role: "slider", "aria-label": name, "data-part": `end-${k}` });
      made(grip, "circle", { class: "reach", r: 14 });
      made(grip, "circle", { class: "dot", r: 6 });
      return grip;
    });
    const put = () => {
      const now = this.state.line, [x0, y0, x1, y1] = [this.px(now[0]), this.py(now[1]), this.px(now[2]), this.py(now[3])];
      for (const element of [under, over, whole]) for (const [name, value] of Object.entries({ x1: x0, y1: y0, x2: x1, y2: y1 })) element.setAttribute(name, value);
      ends.forEach((grip, number) => {
        grip.setAttribute("transform", `translate(${number ? x1 : x0},${number ? y1 : y0})`);
        grip.setAttribute("aria-valuenow", now[2 * number] / this.state.scale);
        grip.setAttribute("aria-valuetext", `x ${(now[2 * number] / this.state.scale).toPrecision(4)}, y ${(now[2 * number + 1] / this.state.scale).toPrecision(4)} ${this.state.unit || ""}`);
      });
      for (const [share, dot, text] of marks) {
        const [x, y] = [x0 + share * (x1 - x0), y0 + share * (y1 - y0)];
        dot.setAttribute("cx", x); dot.setAttribute("cy", y); text.setAttribute("x", x + 7); text.setAttribute("y", y - 7);
      }
    };
    const changed = (done) => { put(); this.tell("line", { line: this.state.line }, done); };
    [0, 2].forEach((k, number) => this.drags(ends[number], (at, done, by, event) => {
      if (!done) {
        const other = this.state.line.slice(2 - k, 4 - k);
        if (event.shiftKey) at = Math.abs(at[0] - other[0]) > Math.abs(at[1] - other[1]) ? [at[0], other[1]] : [other[0], at[1]];
        this.state.line = k ? [...other, ...at] : [...at, ...other];
      }
      changed(done);
    }, (x, y) => {
      const now = [...this.state.line], [dx, dy] = this.state.pixel, [lx, ly] = this.state.size;
      now[k] = clamp(now[k] + clamp(x * dx, -lx, lx), 0, lx);
      now[k + 1] = clamp(now[k + 1] + clamp(y * dy, -ly, ly), 0, ly);
      this.state.line = now;
      changed(true);
    }));
    this.drags(whole, (at, done, by) => {
      if (!done) {
        const [lx, ly] = this.state.size, now = this.state.line;
        const dx = clamp(by[0], -Math.min(now[0], now[2]), lx - Math.max(now[0], now[2])), dy = clamp(by[1], -Math.min(now[1], now[3]), ly - Math.max(now[1], now[3]));
        this.state.line = [now[0] + dx, now[1] + dy, now[2] + dx, now[3] + dy];
      }
      changed(done);
    }, () => {});
    put();
  }

  /* On maps: outlines of what is masked, each with a button that removes it. */
  outlines() {
    for (const outline of this.state.outlines || []) {
      const points = outline.points.map(([x, y]) => [this.px(x), this.py(y)]);
      const path = `M${points.map((point) => point.join(",")).join("L")}Z`;
      made(this.clipped, "path", { class: "measure-outline casing", d: path });
      made(this.clipped, "path", { class: "measure-outline", d: path, "data-region": outline.name });
      const corner = points.reduce((best, point) => (point[0] - point[1] > best[0] - best[1] ? point : best));
      this.remover(outline, corner);
    }
  }

  remover(outline, [x, y]) {
    const { left, top, width, height } = this.frame;
    const button = made(this.svg, "g", { class: "measure-remove", tabindex: 0, role: "button", "aria-label": `remove ${outline.name} from the mask`, "data-part": `remove-${outline.step}-${outline.number}`,
      transform: `translate(${clamp(x, left + 10, left + width - 10)},${clamp(y, top + 10, top + height - 10)})` });
    made(button, "circle", { class: "reach", r: 13 });
    made(button, "circle", { class: "dot", r: 8 });
    made(button, "path", { d: "M-3,-3L3,3M3,-3L-3,3" });
    const remove = (event) => { event.preventDefault(); event.stopPropagation(); this.tell("remove", { step: outline.step, number: outline.number }, true); };
    button.addEventListener("click", remove);
    button.addEventListener("keydown", (event) => { if (["Enter", " ", "Delete", "Backspace"].includes(event.key)) remove(event); });
  }

  /* On maps: lengths of cut-offs as bars in the lower left corner. */
  bars() {
    const { left, top, width, height } = this.frame;
    const across = Math.abs(this.px(this.state.size ? this.state.size[0] : 0) - this.px(0)) / (this.state.size ? this.state.size[0] : 1);
    (this.state.bars || []).forEach((bar, number) => {
      const whole = bar.length * across, shown = Math.min(whole, width - 24), y = top + height - 14 - 26 * number, x = left + 12;
      const group = made(this.clipped, "g", { class: "measure-bar", "data-length": bar.length, "data-pixels": whole });
      const path = whole > shown ? `M${x},${y - 5}V${y + 5}M${x},${y}H${x + shown}M${x + shown - 7},${y - 5}l7,5l-7,5` : `M${x},${y - 5}V${y + 5}M${x},${y}H${x + shown}M${x + shown},${y - 5}V${y + 5}`;
      made(group, "path", { class: "casing", d: path });
      made(group, "path", { d: path });
      made(group, "text", { x: x + 3, y: y - 7 }, bar.text + (whole > shown ? ", longer than the view" : ""));
    });
  }

  /* On curves: what is masked, as bands. */
  bands() {
    const { top, height } = this.frame;
    for (const outline of this.state.outlines || []) {
      const places = outline.points.map((point) => this.px(point[0])), low = Math.min(...places), high = Math.max(...places);
      made(this.clipped, "rect", { class: "measure-band", x: low, y: top, width: high - low, height, "data-region": outline.name });
      this.remover(outline, [high, top + 12]);
    }
  }

  /* On curves: the points at the cursors. */
  dots() {
    if (!this.dotted) return;
    this.dotted.replaceChildren();
    (this.state.dots || []).forEach(([x, z], number) => {
      if (z !== null) made(this.dotted, "circle", { class: "measure-mark", cx: this.px(x), cy: this.py(z), r: 4, "data-dot": "AB"[number] });
    });
  }

  /* On curves: two cursors. */
  cursors() {
    if (!this.state.cursors) return;
    const { top, height, left, width } = this.frame, extent = this.state.extent;
    this.dotted = made(this.clipped, "g", {});
    this.dots();
    this.state.cursors.forEach((_, number) => {
      const name = "AB"[number];
      const grip = made(this.svg, "g", { class: "measure-cursor", tabindex: 0, role: "slider", "aria-label": `cursor ${name}`, "data-part": `cursor-${number}`, "aria-valuemin": extent[0] / this.state.scale, "aria-valuemax": extent[1] / this.state.scale });
      made(grip, "rect", { class: "reach", x: -9, y: top, width: 18, height });
      made(grip, "line", { class: "casing", x1: 0, x2: 0, y1: top, y2: top + height });
      made(grip, "line", { x1: 0, x2: 0, y1: top, y2: top + height });
      made(grip, "rect", { class: "flag", x: -9, y: top - 17, width: 18, height: 17, rx: 3 });
      made(grip, "text", { x: 0, y: top - 4, "text-anchor": "middle" }, name);
      const put = () => {
        const at = this.state.cursors[number];
        grip.setAttribute("transform", `translate(${clamp(this.px(at), left, left + width)},0)`);
        grip.setAttribute("aria-valuenow", at / this.state.scale);
        grip.setAttribute("aria-valuetext", `${(at / this.state.scale).toPrecision(4)} ${this.state.unit || ""}`);
      };
      const to = (at, done) => { this.state.cursors[number] = clamp(at, ...extent); put(); this.tell("cursors", { cursors: this.state.cursors }, done); };
      this.drags(grip, (at, done) => to(done ? this.state.cursors[number] : at[0], done), (x) => {
        const by = x === Infinity || x === -Infinity ? Math.sign(x) * (extent[1] - extent[0]) : x * this.state.step;
        if (by) to(this.state.cursors[number] + by, true);
      });
      put();
    });
  }
}

function look() {
  for (const box of document.querySelectorAll("[data-measure]")) {
    const picture = box.querySelector(".js-plotly-plot"), known = areas.get(box.dataset.measure);
    if (!picture || !picture._fullLayout || !picture.on || (known && known.picture === picture)) continue;
    if (known) known.svg.remove();
    areas.set(box.dataset.measure, new Area(box, picture));
  }
}
new MutationObserver(look).observe(document.documentElement, { childList: true, subtree: true, attributes: true, attributeFilter: ["data-measure"] });

/* The page sets what is shown; while a person draws, the picture stays as it is until that is done. */
window.AsperityMeasure = {
  set(key, state) {
    const area = areas.get(key);
    if (area && area.held) { delete state.line; delete state.cursors; }
    if (area && state.tool !== undefined && state.tool !== area.state.tool) { area.drawing = null; area.held = false; }
    Object.assign(stateOf(key), state);
    look();
    if (!area) return;
    if (area.held && area.axes && state.dots) area.dots();
    area.draw();
  },
};
})();
