/* Viewer of maps that share one grid: zoom, read-out, section line, steps and depths; and values of curves on pictures.

   No other file is needed, nothing is fetched unless an array names an address, and nothing is evaluated, so that the page may
   forbid everything but this script. The scene it shows is described in asperity/report/scene.py.

   AsperityViewer.create(element, scene, options)  -> Viewer, shown in the element
     layout: "grid" (by default), the chosen maps side by side; "one", one map large, all others as small pictures beside it
     above: points of the screen that a large map leaves to what stands around it
     centred: whether a spot that is pressed is brought into view, enlarged
   AsperityViewer.start(document)         -> mounts what a page declares: [data-viewer] and figures with [data-curves] */
(function () {
"use strict";

const MASKED = { 8: 255, 16: 65535 };
const pictures = []; // the oldest first
let counted = 0; // numbers of rasters and of states of colours
const KEPT = { grid: 5e7, one: 1.5e8 }; // bytes of decoded arrays that are kept, by layout
const PICTURES = 48; // coloured pictures that are kept
const COARSE = 256; // points along a side of what is kept of every step: shown at once, until all of its points are there
const SMALL = 160; // the same of a small picture
const CALM = 40; // ms without another step, after which all of its points are asked for
const STEP_KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/* ---- arrays ---- */

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

async function inflated(array) {
  const stream = new Blob([bytesOf(array.data)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* The numbers of an array; of one that is fetched, a line of JSON with its other entries comes first. */
async function numbersOf(array) {
  if (!array.url) return numbers(await inflated(array), array.bits, ...array.shape);
  const answer = await fetch(array.url);
  if (!answer.ok) throw new Error(`${array.url}: ${answer.status}`);
  const bytes = new Uint8Array(await answer.arrayBuffer()), end = bytes.indexOf(10) + 1;
  Object.assign(array, JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))));
  return array.bits === 8 ? bytes.subarray(end) : new Uint16Array(bytes.slice(end).buffer);
}

/* Rows of y, x fastest. Of 16 bits: first all low bytes, then all high bytes, of the differences along y of the differences along x, with the sign in the lowest bit. */
function numbers(bytes, bits, nx, ny) {
  if (bits === 8) return bytes;
  const n = nx * ny, out = new Uint16Array(n), along = new Uint16Array(nx);
  for (let y = 0, i = 0; y < ny; y++) {
    let last = 0;
    for (let x = 0; x < nx; x++, i++) {
      const folded = bytes[i] | (bytes[n + i] << 8);
      along[x] += (folded >>> 1) ^ -(folded & 1);
      out[i] = last += along[x];
    }
  }
  return out;
}

/* A decoded array and its coarser levels, each of which has half the points along both sides. */
class Raster {
  constructor(array, q, reduce) {
    this.id = counted++; this.low = array.low; this.step = array.step; this.cell = array.cell; this.reduce = reduce; this.known = array.known || array.step;
    this.masked = MASKED[array.bits]; this.shares = array.shares;
    this.levels = [{ nx: array.shape[0], ny: array.shape[1], q }];
    this.pictures = new Map();
  }
  get nx() { return this.levels[0].nx; }
  get ny() { return this.levels[0].ny; }
  value(i, j) {
    if (i < 0 || j < 0 || i >= this.nx || j >= this.ny) return NaN;
    const q = this.levels[0].q[j * this.nx + i];
    return q === this.masked ? NaN : this.low + this.step * q;
  }
  /* This one with few points only. */
  coarse() {
    let k = 0;
    while (Math.max(this.nx, this.ny) >> k > COARSE) k++;
    if (k === 0) return this;
    const found = this.level(k), level = this.levels[found], cell = [this.cell[0] * 2 ** found, this.cell[1] * 2 ** found];
    return new Raster({ low: this.low, step: this.step, cell, bits: this.masked === MASKED[8] ? 8 : 16, shares: this.shares, shape: [level.nx, level.ny] }, level.q, this.reduce);
  }
  level(k) {
    while (this.levels.length <= k) {
      const from = this.levels[this.levels.length - 1];
      if (from.nx < 2 || from.ny < 2) break;
      this.levels.push(halved(from, this.reduce, this.masked));
    }
    return Math.min(k, this.levels.length - 1);
  }
  /* Between the middles of the four points around x, y; NaN where one of them that counts is masked and has no value. */
  between(x, y, blank) {
    const u = Math.min(Math.max(x / this.cell[0] - 0.5, 0), this.nx - 1), v = Math.min(Math.max(y / this.cell[1] - 0.5, 0), this.ny - 1);
    const i = Math.min(Math.floor(u), Math.max(this.nx - 2, 0)), j = Math.min(Math.floor(v), Math.max(this.ny - 2, 0));
    let sum = 0;
    for (const [di, dj] of [[0, 0], [1, 0], [0, 1], [1, 1]]) {
      const weight = (di ? u - i : 1 - u + i) * (dj ? v - j : 1 - v + j);
      if (weight === 0) continue;
      const value = this.value(i + di, j + dj);
      sum += weight * (Number.isNaN(value) ? blank : value);
    }
    return sum;
  }
}

/* One value for 2 × 2 points: their largest, smallest or mean; at an odd end for those that are there. */
function halved(from, reduce, masked) {
  const nx = Math.ceil(from.nx / 2), ny = Math.ceil(from.ny / 2), old = from.q, q = new old.constructor(nx * ny), wide = from.nx;
  for (let y = 0, at = 0; y < ny; y++) {
    const above = 2 * y * wide, below = 2 * y + 1 < from.ny ? above + wide : above;
    for (let x = 0; x < nx; x++, at++) {
      const i = 2 * x, j = i + 1 < wide ? i + 1 : i;
      const a = old[above + i], b = old[above + j], c = old[below + i], d = old[below + j];
      if (reduce === "min") { const e = a < b ? a : b, f = c < d ? c : d; q[at] = e < f ? e : f; continue; } // what is masked is the largest number
      if (a !== masked && b !== masked && c !== masked && d !== masked) {
        if (reduce === "mean") q[at] = (a + b + c + d + 2) >> 2;
        else { const e = a > b ? a : b, f = c > d ? c : d; q[at] = e > f ? e : f; }
        continue;
      }
      let most = -1, sum = 0, count = 0;
      for (const value of [a, b, c, d]) if (value !== masked) { count++; sum += value; if (value > most) most = value; }
      q[at] = count === 0 ? masked : reduce === "mean" ? Math.round(sum / count) : most;
    }
  }
  return { nx, ny, q };
}

/* ---- text ---- */

/* Decimals to which a value is known that is stored in these steps: the last digit is five steps or more, and there are at most four. */
function decimalsFor(step, largest) {
  const known = step > 0 ? Math.floor(-Math.log10(5 * step)) : 12;
  const four = largest > 0 ? 3 - Math.floor(Math.log10(largest)) : 3;
  return Math.max(Math.min(known, four), -12);
}
function rounded(value, decimals) {
  const size = Math.abs(value);
  if (size > 0 && (decimals > 6 || decimals < 0)) {
    const digits = Math.floor(Math.log10(size)) + decimals;
    return digits < 0 ? "0" : value.toExponential(Math.min(digits, 20)).replace("-", "−").replace("e−", "e-").replace("e+", "e");
  }
  const text = value.toFixed(Math.max(decimals, 0));
  return (/[1-9]/.test(text) ? text : text.replace("-", "")).replace("-", "−");
}
function withUnit(text, symbol) { return symbol ? `${text} ${symbol}` : text; }
function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size < 1e-3 || size >= 1e5 ? value.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e") : String(Number(value.toPrecision(4)));
  return text.replace(/^-/, "−");
}
function ticks(low, high, count) {
  const span = high - low;
  if (!(span > 0) || !isFinite(span)) return [];
  const rough = span / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999);
  const found = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * span; n++) found.push(Number((n * step).toPrecision(12)));
  return found;
}
function make(tag, parent, attributes, text) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes || {})) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  if (parent) parent.append(element);
  return element;
}

/* Text of an element, written only where it is another one, so that nothing is laid out again in vain. */
function write(element, text) { if (element.textContent !== text) element.textContent = text; }

/* ---- drawing ---- */

function colourOf(element, name) { return getComputedStyle(element).getPropertyValue(name).trim(); }
function rgb(text) {
  const value = parseInt(text.slice(1).length === 3 ? [...text.slice(1)].map((c) => c + c).join("") : text.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}
function packed(r, g, b) { return (255 << 24) | (b << 16) | (g << 8) | r; }
function sized(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1, w = Math.round(width * ratio), h = Math.round(height * ratio);
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  canvas.style.width = `${width}px`; canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return context;
}
const FONT = '12px system-ui, "Segoe UI", Roboto, Arial, sans-serif';

/* Range and scale of the colours of one map, and the colour of every stored number. */
class Colours {
  constructor(map, palettes) {
    this.map = map; this.shared = null;
    this.palette = map.kind === "values" ? bytesOf(palettes[map.colours]) : null;
    this.reset();
  }
  /* The whole range: that of the map, or one that it shares with others. */
  reset() { [this.low, this.high] = this.shared || this.map.range || [0, 1]; this.log = Boolean(this.map.log); this.only = -1; this.changed(); }
  changed() { this.version = { id: counted++ }; }
  /* Of arrays that are fetched one by one the whole range is known only when all have been shown. */
  widen(raster) {
    const range = this.map.range, high = raster.low + raster.step * (raster.masked - 1);
    if (!range || !(raster.step > 0)) return;
    const room = 1e-6 * (range[1] - range[0]), whole = this.low === range[0] && this.high === range[1];
    if (raster.low >= range[0] - room && high <= range[1] + room) return;
    this.map.range = [Math.min(range[0], raster.low), Math.max(range[1], high)];
    if (whole) { [this.low, this.high] = this.map.range; this.changed(); }
  }
  get bottom() { return this.log ? Math.max(this.low, this.high / 10 ** this.map.decades) : this.low; }
  share(value) {
    const low = this.bottom;
    const t = this.log ? (value > 0 ? Math.log(value / low) / Math.log(this.high / low) : 0) : (value - low) / (this.high - low);
    return Math.min(Math.max(t, 0), 1);
  }
  colour(t) { const i = 3 * Math.min(255, Math.floor(256 * t)); return packed(this.palette[i], this.palette[i + 1], this.palette[i + 2]); }
  table(raster, blank) {
    const table = new Uint32Array(raster.masked + 1);
    if (this.map.kind === "classes") this.map.classes.forEach((item, k) => {
      table[k] = packed(...(this.only < 0 || this.only === k ? (k === 0 ? blank : rgb(item.colour)) : blank));
    });
    else {
      const colours = Uint32Array.from({ length: 256 }, (_, i) => this.colour((i + 0.5) / 256)), low = this.bottom, span = this.high - low;
      if (this.log) for (let q = 0; q < raster.masked; q++) table[q] = colours[Math.min(255, Math.floor(256 * this.share(raster.low + raster.step * q)))];
      else for (let q = 0, t = 256 * (raster.low - low) / span, by = 256 * raster.step / span; q < raster.masked; q++) { const at = t + by * q; table[q] = colours[at <= 0 ? 0 : at >= 255 ? 255 : at | 0]; }
    }
    table[raster.masked] = packed(...blank);
    return table;
  }
  /* Canvas with the coloured points of one level, kept until range or scheme change; the top row has the largest y. */
  picture(raster, k, blank) {
    const key = `${k} ${blank}`, kept = raster.pictures.get(key);
    if (kept && kept.version === this.version) return kept.canvas;
    const { nx, ny, q } = raster.levels[k], table = this.table(raster, blank);
    const canvas = kept ? kept.canvas : document.createElement("canvas");
    canvas.width = nx; canvas.height = ny;
    const context = canvas.getContext("2d"), image = context.createImageData(nx, ny), out = new Uint32Array(image.data.buffer);
    for (let y = 0; y < ny; y++) for (let x = 0, from = y * nx, to = (ny - 1 - y) * nx; x < nx; x++) out[to++] = table[q[from++]];
    context.putImageData(image, 0, 0);
    raster.pictures.set(key, { canvas, version: this.version });
    if (!kept) pictures.push([raster, key]);
    if (pictures.length > PICTURES) { const [old, which] = pictures.shift(); old.pictures.delete(which); }
    return canvas;
  }
}

/* Drawing of axes within a canvas: margins, ticks and labels, and conversion of coordinates. */
class Axes {
  constructor(width, height, margin) {
    this.left = margin.left; this.top = margin.top;
    this.width = width - margin.left - margin.right; this.height = height - margin.top - margin.bottom;
  }
  limits(x0, x1, y0, y1) { Object.assign(this, { x0, x1, y0, y1 }); return this; }
  px(x) { return this.left + (x - this.x0) / (this.x1 - this.x0) * this.width; }
  py(y) { return this.top + (this.y1 - y) / (this.y1 - this.y0) * this.height; }
  x(px) { return this.x0 + (px - this.left) / this.width * (this.x1 - this.x0); }
  y(py) { return this.y1 - (py - this.top) / this.height * (this.y1 - this.y0); }
  draw(context, look, xUnit, yUnit, xLabel, yLabel) {
    const { left, top, width, height } = this;
    context.font = FONT; context.fillStyle = look.soft; context.strokeStyle = look.soft; context.lineWidth = 1;
    context.strokeRect(left - 0.5, top - 0.5, width + 1, height + 1);
    context.textAlign = "center"; context.textBaseline = "top";
    let free = left - 8;
    for (const t of ticks(this.x0 / xUnit, this.x1 / xUnit, Math.max(2, Math.round(width / 80)))) {
      const at = this.px(t * xUnit), room = context.measureText(short(t)).width / 2 + 3;
      context.fillRect(at, top + height, 1, 4);
      if (at - room < free || at + room > left + width + 16) continue;
      free = at + room;
      context.fillText(short(t), at, top + height + 6);
    }
    context.fillText(xLabel, left + width / 2, top + height + 20);
    context.textAlign = "right"; context.textBaseline = "middle";
    const low = Math.min(this.y0, this.y1) / yUnit, high = Math.max(this.y0, this.y1) / yUnit;
    for (const t of ticks(low, high, Math.max(3, Math.round(height / 45)))) {
      const at = this.py(t * yUnit);
      context.fillRect(left - 4, at, 4, 1);
      context.fillText(short(t), left - 6, at);
    }
    context.save();
    context.translate(11, top + height / 2); context.rotate(-Math.PI / 2); context.textAlign = "center";
    context.fillText(yLabel, 0, 0);
    context.restore();
  }
}
const MAP_MARGIN = { left: 56, right: 8, top: 6, bottom: 38 };

/* ---- one map ---- */

/* Of a map or section of one step of a load path: the line that names it, and leads there from other steps; null for all others. */
function elsewhere(viewer, box, item) {
  const steps = viewer.scene.steps;
  if (!steps || item.step === null || item.step === undefined) return null;
  const line = make("p", box, { class: "av-step" }), text = make("span", line);
  const button = make("button", line, { type: "button" }, `show step ${steps.numbers[item.step]}`);
  button.addEventListener("click", () => viewer.set("steps", item.step));
  return { box, there: () => viewer.position.steps === item.step, tell: (there) => {
    box.classList.toggle("av-elsewhere", !there);
    button.hidden = there;
    text.textContent = `${there ? "At" : "Known only at"} step ${steps.texts[item.step]}${there ? "; known at no other step" : ""}.`;
  } };
}

class Panel {
  constructor(viewer, map) {
    this.viewer = viewer; this.map = map; this.colours = new Colours(map, viewer.scene.palettes); this.raster = null;
    const box = this.box = make("div", null, { class: "av-panel", "data-map": map.name });
    const head = make("div", box, { class: "av-head" });
    make(viewer.heading, head, {}, map.title);
    this.said = make("output", head, { class: "av-value" }, ""); this.where = make("span", head, { class: "av-at" }, "");
    this.other = elsewhere(viewer, box, map);
    const stage = this.stage = make("div", box, { class: "av-stage" });
    this.canvas = make("canvas", stage, { role: "application", "aria-roledescription": "map", tabindex: "0", "aria-label": `${map.alt} ${HELP}` });
    this.over = make("canvas", stage, { class: "av-over", "aria-hidden": "true" });
    this.handles = [0, 1].map((end) => this.handle(stage, end));
    if (map.kind === "values") this.bar(box); else this.legend(box);
    this.listen();
  }

  handle(stage, end) {
    const name = end ? "End" : "Start";
    const element = make("span", stage, { class: "av-handle", role: "slider", tabindex: "0", "aria-valuemin": "0", "aria-valuemax": "100", "aria-label": `${name} of the section line` });
    element.addEventListener("pointerdown", (event) => {
      event.stopPropagation(); element.setPointerCapture(event.pointerId);
      const move = (e) => { const [x, y] = this.place(e); this.viewer.moveLine(end, x, y); };
      element.addEventListener("pointermove", move);
      const stop = () => element.removeEventListener("pointermove", move);
      element.addEventListener("pointerup", stop, { once: true });
      element.addEventListener("pointercancel", stop, { once: true });
    });
    element.addEventListener("keydown", (event) => {
      const by = STEP_KEYS[event.key];
      if (!by) return;
      event.preventDefault(); event.stopPropagation();
      const v = this.viewer, far = event.shiftKey ? 10 : 1;
      v.moveLine(end, v.line[2 * end] + by[0] * far * v.cell[0], v.line[2 * end + 1] + by[1] * far * v.cell[1]);
    });
    return element;
  }

  bar(box) {
    const row = make("div", box, { class: "av-bar" }), unit = this.map.unit;
    const label = unit.symbol ? ` (${unit.symbol})` : "";
    this.barCanvas = make("canvas", row, { "aria-hidden": "true" });
    const controls = make("div", box, { class: "av-range" });
    const input = (name, key) => {
      const wrap = make("label", controls, {}, `${name} `);
      const field = make("input", wrap, { type: "text", inputmode: "decimal", size: "7", "aria-label": `${name} of the colours of ${this.map.title}${label}` });
      field.addEventListener("change", () => {
        const value = Number(field.value.replace("−", "-")) * this.map.unit.factor, other = key === "low" ? this.colours.high : this.colours.low;
        if (Number.isFinite(value) && field.value.trim() && (key === "low" ? value < other : value > other) && (!this.colours.log || key === "low" || value > 0)) {
          this.colours[key] = value; this.recoloured();
        }
        this.draw();
      });
      return field;
    };
    this.lowest = input("from", "low"); this.highest = input("to", "high");
    this.symbol = make("span", controls, {}, unit.symbol);
    if (this.map.decades) {
      const wrap = make("label", controls), box = this.logBox = make("input", wrap, { type: "checkbox" });
      wrap.append(" logarithmic");
      box.addEventListener("change", () => { this.colours.log = box.checked; this.recoloured(); this.draw(); });
    }
    const reset = make("button", controls, { type: "button" }, "whole range");
    reset.addEventListener("click", () => { const log = this.colours.log; this.colours.reset(); this.colours.log = log; this.recoloured(); this.draw(); });
  }
  /* Other colours: those who look at the same map elsewhere are told. */
  recoloured() {
    const { low, high, log } = this.colours;
    this.colours.changed();
    this.viewer.thumbsSoon();
    this.viewer.emit("colours", { name: this.map.name, low, high, log });
  }

  legend(box) {
    const row = make("div", box, { class: "av-legend", role: "group", "aria-label": `Kinds of points of ${this.map.title}; press one to see it alone` });
    this.kinds = this.map.classes.map((item, k) => {
      const button = make("button", row, { type: "button", "aria-pressed": "false" });
      make("canvas", button, { class: "av-swatch", width: "28", height: "20", "aria-hidden": "true" });
      make("span", button, {}, item.text);
      button.addEventListener("click", () => { this.colours.only = this.colours.only === k ? -1 : k; this.colours.changed(); this.draw(); this.viewer.thumbsSoon(); });
      return button;
    });
  }

  place(event) { const r = this.canvas.getBoundingClientRect(); return [this.axes.x(event.clientX - r.left), this.axes.y(event.clientY - r.top)]; }

  listen() {
    const c = this.canvas, v = this.viewer, held = new Map();
    let start = null, moved = false;
    const gesture = () => { const p = [...held.values()]; return p.length < 2 ? null : { d: Math.hypot(p[0].clientX - p[1].clientX, p[0].clientY - p[1].clientY), clientX: (p[0].clientX + p[1].clientX) / 2, clientY: (p[0].clientY + p[1].clientY) / 2 }; };
    c.addEventListener("pointerdown", (event) => {
      held.set(event.pointerId, event); c.setPointerCapture(event.pointerId);
      start = { at: this.place(event), pinch: gesture() }; moved = false;
      v.point(...start.at);
    });
    c.addEventListener("pointermove", (event) => {
      if (!held.has(event.pointerId)) { v.point(...this.place(event)); return; }
      const before = held.get(event.pointerId);
      held.set(event.pointerId, event);
      const pinch = gesture();
      if (pinch && start && start.pinch) {
        moved = true;
        const [x, y] = this.place(pinch);
        v.zoomBy(pinch.d / start.pinch.d, x, y);
        start.pinch = pinch;
      } else if (start && held.size === 1) {
        if (Math.hypot(event.clientX - before.clientX, event.clientY - before.clientY) > 0) {
          const [x, y] = this.place(event);
          if (Math.hypot(this.axes.px(x) - this.axes.px(start.at[0]), this.axes.py(y) - this.axes.py(start.at[1])) > 4) moved = true;
          if (moved && v.zoom > 1) v.panBy(start.at[0] - x, start.at[1] - y);
          else v.point(x, y);
        }
      }
    });
    const end = (event) => {
      held.delete(event.pointerId);
      if (event.type === "pointerup" && !moved && held.size === 0) v.pick(...this.place(event), this);
      if (held.size === 1) start = { at: this.place([...held.values()][0]), pinch: null };
    };
    c.addEventListener("pointerup", end); c.addEventListener("pointercancel", end);
    c.addEventListener("pointerleave", (event) => { if (held.size === 0 && event.pointerType !== "touch") v.leave(); });
    c.addEventListener("dblclick", () => v.reset());
    c.addEventListener("wheel", (event) => {
      if (!(event.ctrlKey || event.metaKey || v.element.contains(document.activeElement))) { v.tell("Click a map, then the wheel zooms."); return; }
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 33 : event.deltaMode === 2 ? 400 : 1;
      v.zoomBy(Math.exp(-event.deltaY * lines * 0.002), ...this.place(event));
    }, { passive: false });
    c.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const v = this.viewer, by = STEP_KEYS[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (by) {
      const span = [this.axes.x1 - this.axes.x0, this.axes.y1 - this.axes.y0];
      if (event.shiftKey) v.panBy(by[0] * span[0] / 8, by[1] * span[1] / 8);
      else {
        const [x, y] = v.cursor || [v.centre[0], v.centre[1]];
        const far = span.map((s, k) => Math.max(v.cell[k], s / 100));
        v.point(Math.min(Math.max(x + by[0] * far[0], 0), v.size[0]), Math.min(Math.max(y + by[1] * far[1], 0), v.size[1]));
        v.tell(this.spoken());
      }
    } else if (event.key === "+" || event.key === "=") v.zoomBy(1.5, ...(v.cursor || v.centre));
    else if (event.key === "-" || event.key === "_") v.zoomBy(1 / 1.5, ...(v.cursor || v.centre));
    else if (event.key === "0" || event.key === "Home") v.reset();
    else if (event.key === "Enter" && v.cursor) v.pick(...v.cursor, this);
    else if (event.key === "Escape") v.clear();
    else return;
    event.preventDefault();
  }

  spoken() { return `${this.map.title}: ${this.said.textContent}, ${this.viewer.placeText()}`; }

  /* The array of the step or depth that is shown, decoded. Until all its points are there, few of them are drawn, if these are at hand. */
  load() {
    const v = this.viewer, array = this.map.arrays[v.index(this.map)];
    if (this.wanted === array) return this.loading;
    this.wanted = array;
    const [found, whole] = v.atHand(array);
    this.box.classList.toggle("av-waiting", !found);
    if (found) { this.raster = found; v.drawSoon(); v.thumbsSoon(); }
    this.loading = whole ? Promise.resolve() : this.fill(array, found ? CALM : 0);
    return this.loading;
  }
  async fill(array, wait) {
    if (wait) await new Promise((done) => setTimeout(done, wait));
    if (this.wanted !== array) return;
    const raster = await this.viewer.raster(array, this.map).catch((error) => { console.warn(error); return null; });
    if (this.wanted !== array) return;
    this.box.classList.remove("av-waiting");
    this.raster = raster;
    if (raster) this.colours.widen(raster); else this.viewer.tell(`${this.map.title} could not be loaded.`);
    this.viewer.drawSoon(); this.viewer.thumbsSoon();
  }

  /* Value at x, y (m), SI; NaN where there is none. */
  at(x, y) {
    const r = this.raster;
    if (!r || x < 0 || y < 0 || x >= this.viewer.size[0] || y >= this.viewer.size[1]) return NaN;
    return r.value(Math.floor(x / r.cell[0]), Math.floor(y / r.cell[1]));
  }
  text(x, y) {
    if (!this.raster || x < 0 || y < 0 || x >= this.viewer.size[0] || y >= this.viewer.size[1]) return "";
    const value = this.at(x, y);
    if (Number.isNaN(value)) return this.map.blank.text;
    if (this.map.kind === "classes") return (this.map.classes[value] || this.map.classes[this.map.classes.length - 1]).text;
    return this.number(value);
  }
  number(value) {
    const r = this.raster;
    return this.quantity(value, r.known, Math.max(Math.abs(r.low), Math.abs(r.low + r.step * (r.masked - 1))));
  }
  /* A value in the unit of the map that is known in these steps, with as many digits as suit the largest. */
  quantity(value, step, largest) {
    const { factor, symbol } = this.map.unit;
    return withUnit(rounded(value / factor, decimalsFor(step / factor, largest / factor)), symbol);
  }

  draw() {
    if (this.other) this.other.tell(this.other.there());
    const v = this.viewer, look = v.look, width = this.stage.clientWidth;
    if (!width) return;
    const plot = width - MAP_MARGIN.left - MAP_MARGIN.right;
    const height = Math.min(Math.max(plot * v.size[1] / v.size[0], 110), v.tallest) + MAP_MARGIN.top + MAP_MARGIN.bottom;
    this.axes = v.fitted(new Axes(width, height, MAP_MARGIN));
    const context = sized(this.canvas, width, height), a = this.axes;
    this.canvas.style.touchAction = v.zoom > 1 ? "none" : "pan-y";
    if (this.raster) {
      context.save();
      context.beginPath(); context.rect(a.left, a.top, a.width, a.height); context.clip();
      this.paint(context);
      context.restore();
    }
    const { symbol, factor } = v.scene.length;
    a.draw(context, look, factor, factor, `x (${symbol})`, `y (${symbol})`);
    if (this.map.kind === "values") this.drawBar(); else this.drawLegend();
    this.drawOver();
  }

  /* Points of the screen that a point of a raster takes, and the level at which it is drawn. */
  dots(raster) { return (window.devicePixelRatio || 1) * raster.cell[0] * this.axes.width / (this.axes.x1 - this.axes.x0); }
  fine(raster) { const dots = this.dots(raster); return raster.level(dots < 0.75 ? Math.max(0, Math.round(Math.log2(1 / dots))) : 0); }

  paint(context) {
    const v = this.viewer, r = this.raster, a = this.axes;
    const dots = this.dots(r), k = this.fine(r);
    const level = r.levels[k], cell = [r.cell[0] * 2 ** k, r.cell[1] * 2 ** k];
    const picture = this.colours.picture(r, k, rgb(v.look.blank));
    const box = [a.px(0), a.py(level.ny * cell[1]), a.px(level.nx * cell[0]) - a.px(0), a.py(0) - a.py(level.ny * cell[1])];
    context.beginPath(); context.rect(a.px(0), a.py(v.size[1]), a.px(v.size[0]) - a.px(0), a.py(0) - a.py(v.size[1])); context.clip();
    context.imageSmoothingEnabled = dots < 1.5; context.imageSmoothingQuality = "high";
    context.drawImage(picture, ...box);
    if (this.map.kind === "classes") this.hatch(context, level, box);
  }

  /* The third kind of points is hatched and the fourth dotted, so that kinds differ by more than colour. */
  hatch(context, level, box) {
    for (let k = 2; k < this.map.classes.length; k++) {
      if (this.colours.only >= 0 && this.colours.only !== k) continue;
      const key = `hatch ${k}`;
      let mask = level[key];
      if (!mask) {
        mask = level[key] = document.createElement("canvas");
        mask.width = level.nx; mask.height = level.ny;
        const small = mask.getContext("2d"), image = small.createImageData(level.nx, level.ny), out = new Uint32Array(image.data.buffer);
        for (let y = 0; y < level.ny; y++) for (let x = 0; x < level.nx; x++) if (level.q[y * level.nx + x] === k) out[(level.ny - 1 - y) * level.nx + x] = 0xff000000;
        small.putImageData(image, 0, 0);
      }
      const a = this.axes, layer = document.createElement("canvas");
      const on = sized(layer, a.left + a.width, a.top + a.height);
      on.imageSmoothingEnabled = false;
      on.drawImage(mask, ...box);
      on.globalCompositeOperation = "source-in";
      on.fillStyle = on.createPattern(pattern(k), "repeat");
      on.fillRect(0, 0, a.left + a.width, a.top + a.height);
      context.drawImage(layer, 0, 0, a.left + a.width, a.top + a.height);
    }
  }

  drawBar() {
    const width = this.barCanvas.parentElement.clientWidth, context = sized(this.barCanvas, width, 34), { factor } = this.map.unit, c = this.colours;
    const left = MAP_MARGIN.left, wide = width - left - MAP_MARGIN.right - 8;
    for (let i = 0; i < wide; i++) { const p = c.colour(i / wide); context.fillStyle = `rgb(${p & 255},${(p >> 8) & 255},${(p >> 16) & 255})`; context.fillRect(left + i, 0, 1.5, 12); }
    context.fillStyle = this.viewer.look.soft; context.font = FONT; context.textAlign = "center"; context.textBaseline = "top";
    const low = c.bottom / factor, high = c.high / factor;
    const found = c.log ? decades(low, high) : ticks(low, high, Math.max(2, Math.round(wide / 60)));
    for (const t of found) { const at = left + wide * c.share(t * factor); context.fillRect(at, 12, 1, 4); context.fillText(short(t), at, 18); }
    context.textAlign = "right"; context.fillText(this.map.unit.symbol, left - 8, 0);
    if (document.activeElement !== this.lowest) this.lowest.value = short(low);
    if (document.activeElement !== this.highest) this.highest.value = short(high);
    if (this.logBox) this.logBox.checked = c.log;
  }

  drawLegend() {
    const shares = this.raster ? this.raster.shares : null;
    this.kinds.forEach((button, k) => {
      if (shares) button.querySelector("span").textContent = `${this.map.classes[k].text} ${short(100 * (shares[k] || 0))} %`;
      button.setAttribute("aria-pressed", String(this.colours.only === k));
      const canvas = button.querySelector("canvas"), context = canvas.getContext("2d");
      context.fillStyle = k === 0 ? this.viewer.look.blank : this.map.classes[k].colour;
      context.fillRect(0, 0, 28, 20);
      if (k >= 2) { context.fillStyle = context.createPattern(pattern(k), "repeat"); context.fillRect(0, 0, 28, 20); }
    });
  }

  /* What lies over the map and moves: cross, section line with its ends, and what is highlighted. */
  drawOver() {
    const v = this.viewer, a = this.axes;
    if (!a) return;
    const context = sized(this.over, a.left + a.width + MAP_MARGIN.right, a.top + a.height + MAP_MARGIN.bottom);
    context.save();
    context.beginPath(); context.rect(a.left, a.top, a.width, a.height); context.clip();
    const stroke = (draw, dash) => { for (const [wide, colour] of [[3, "#fff"], [1.3, "#000"]]) { context.lineWidth = wide; context.strokeStyle = colour; context.setLineDash(wide < 3 && dash ? dash : []); context.beginPath(); draw(); context.stroke(); } };
    if (v.marked) this.drawMarked(context, stroke);
    const [x0, y0, x1, y1] = v.line.map((value, k) => k % 2 ? a.py(value) : a.px(value));
    if (v.lineShown) stroke(() => { context.moveTo(x0, y0); context.lineTo(x1, y1); }, [6, 3]);
    if (v.cursor) {
      const [x, y] = [a.px(v.cursor[0]), a.py(v.cursor[1])];
      stroke(() => { context.moveTo(x - 9, y); context.lineTo(x - 2, y); context.moveTo(x + 2, y); context.lineTo(x + 9, y); context.moveTo(x, y - 9); context.lineTo(x, y - 2); context.moveTo(x, y + 2); context.lineTo(x, y + 9); });
    }
    context.restore();
    const value = v.cursor ? this.text(...v.cursor) : "";
    write(this.said, value); write(this.where, value ? `at ${v.placeText()}` : "");
    [[x0, y0], [x1, y1]].forEach(([x, y], end) => {
      const handle = this.handles[end], inside = x >= a.left - 2 && x <= a.left + a.width + 2 && y >= a.top - 2 && y <= a.top + a.height + 2;
      handle.hidden = !v.lineShown || !inside;
      handle.style.left = `${x}px`; handle.style.top = `${y}px`;
      handle.tabIndex = v.visible[0] === this ? 0 : -1;
      handle.setAttribute("aria-valuenow", String(Math.round(100 * v.line[2 * end] / v.size[0])));
      handle.setAttribute("aria-valuetext", v.placeText(v.line[2 * end], v.line[2 * end + 1]));
    });
  }

  drawMarked(context, stroke) {
    const a = this.axes, { cells, raster, x0, y0, x1, y1 } = this.viewer.marked;
    if (!cells) { stroke(() => context.rect(a.px(x0), a.py(y1), a.px(x1) - a.px(x0), a.py(y0) - a.py(y1))); return; }
    const [cx, cy] = raster.cell;
    stroke(() => {
      for (const at of cells) {
        const i = at % raster.nx, j = Math.floor(at / raster.nx);
        const side = (di, dj) => !cells.has(this.viewer.neighbour(raster, i, j, di, dj));
        const [l, r, b, t] = [a.px(i * cx), a.px((i + 1) * cx), a.py(j * cy), a.py((j + 1) * cy)];
        if (side(-1, 0)) { context.moveTo(l, b); context.lineTo(l, t); }
        if (side(1, 0)) { context.moveTo(r, b); context.lineTo(r, t); }
        if (side(0, -1)) { context.moveTo(l, b); context.lineTo(r, b); }
        if (side(0, 1)) { context.moveTo(l, t); context.lineTo(r, t); }
      }
    });
  }
}

const HELP = "Arrow keys move the cross and read the value, Shift with them moves the map, + and - zoom, 0 shows the whole map, Enter marks the spot under the cross.";

function pattern(k) {
  const canvas = document.createElement("canvas"), context = canvas.getContext("2d");
  canvas.width = canvas.height = 6;
  context.strokeStyle = context.fillStyle = "rgba(255,255,255,.85)";
  if (k === 2) { context.lineWidth = 1.2; context.beginPath(); context.moveTo(-1, 7); context.lineTo(7, -1); context.stroke(); } else { context.beginPath(); context.arc(3, 3, 1.2, 0, 7); context.fill(); }
  return canvas;
}
function decades(low, high) {
  const found = [];
  for (let p = Math.ceil(Math.log10(low) - 1e-9); 10 ** p <= high * (1 + 1e-9); p++) found.push(Number((10 ** p).toPrecision(6)));
  return found;
}

/* ---- what lies below the surface: a stored section, or planes along the section line ---- */

class Below {
  constructor(viewer, section) {
    this.viewer = viewer; this.section = section;
    this.colours = new Colours({ ...section, kind: "values" }, viewer.scene.palettes);
    const box = this.box = make("div", null, { class: "av-panel av-below" }), head = make("div", box, { class: "av-head" });
    make(viewer.heading, head, {}, section.title);
    this.said = make("output", head, { class: "av-value" }, "");
    this.other = elsewhere(viewer, box, section);
    this.canvas = make("canvas", box, { role: "application", "aria-roledescription": "section", tabindex: "0", "aria-label": `${section.alt} Arrow keys move the cross and read the value.` });
    this.barCanvas = make("canvas", box, { "aria-hidden": "true" });
    this.canvas.addEventListener("pointermove", (event) => { const r = this.canvas.getBoundingClientRect(); this.point(this.axes.x(event.clientX - r.left), this.axes.y(event.clientY - r.top)); });
    this.canvas.addEventListener("pointerleave", (event) => { if (event.pointerType === "touch") return; this.at = null; this.said.textContent = ""; this.draw(); });
    this.canvas.addEventListener("keydown", (event) => {
      const by = STEP_KEYS[event.key];
      if (!by) return;
      event.preventDefault();
      const a = this.axes, [x, z] = this.at || [(a.x0 + a.x1) / 2, (a.y0 + a.y1) / 2];
      this.point(Math.min(Math.max(x + by[0] * (a.x1 - a.x0) / 100, a.x0), a.x1), Math.min(Math.max(z + by[1] * (a.y1 - a.y0) / 100, a.y1), a.y0));
      this.viewer.tell(`${section.title}: ${this.said.textContent}`);
    });
  }
  async load() { if (this.section.array) { this.raster = await this.viewer.raster(this.section.array, { reduce: "mean" }); this.viewer.drawSoon(); } }

  /* Along the section line where it is made of planes, else along x or y of the map. */
  span() {
    const v = this.viewer, axis = this.section.axis;
    if (!axis) return [0, Math.hypot(v.line[2] - v.line[0], v.line[3] - v.line[1])];
    const k = axis === "x" ? 0 : 1, half = v.size[k] / v.zoom / 2, centre = v.centre[k];
    return [Math.max(0, centre - half), Math.min(v.size[k], centre + half)];
  }
  /* Number of the plane above a depth, and the share of the next: linear within a layer; an interface has a plane on either side. */
  planesAt(depth) {
    const d = this.section.depths, last = d.length - 1;
    if (depth < d[0] || depth > d[last]) return [-1, 0];
    let k = 0;
    while (k < last - 1 && d[k + 1] <= depth) k++;
    return [k, d[k + 1] > d[k] ? (depth - d[k]) / (d[k + 1] - d[k]) : 1];
  }
  value(at, depth) {
    const [k, t] = this.planesAt(depth);
    return k < 0 ? NaN : (1 - t) * this.plane(k, at) + t * this.plane(Math.min(k + 1, this.section.depths.length - 1), at);
  }
  plane(k, at) {
    if (this.section.axis) return this.raster.between((at - this.section.start), (k + 0.5) * this.raster.cell[1], NaN);
    const v = this.viewer, length = this.span()[1] || 1, t = at / length, [x0, y0, x1, y1] = v.line;
    return this.planes[k] ? this.planes[k].between(x0 + t * (x1 - x0), y0 + t * (y1 - y0), NaN) : NaN;
  }
  point(x, z) {
    this.at = [x, z];
    const value = this.ready() ? this.value(x, z) : NaN, { symbol, factor } = this.section.unit, l = this.viewer.scene.length;
    const step = (this.raster || this.planes[0]).step / factor, along = this.section.axis || "distance", dz = this.section.length;
    const largest = Math.max(...this.section.range.map(Math.abs)) / factor;
    this.said.textContent = Number.isNaN(value) ? "" : `${withUnit(rounded(value / factor, decimalsFor(step, largest)), symbol)} at ${along} = ${withUnit(short(x / l.factor), l.symbol)}, depth ${withUnit(short(z / dz.factor), dz.symbol)}`;
    this.draw();
  }
  ready() { return this.section.axis ? Boolean(this.raster) : Boolean(this.planes && this.planes.length); }

  /* Canvas with nx × nz coloured points of the part that is shown, kept until it or the colours change. */
  picture(nx, nz, from, to, deep) {
    const v = this.viewer, key = [nx, nz, from, to, deep, v.look.blank, this.section.axis ? "" : v.line].join(" ");
    if (this.made && this.made.key === key && this.made.version === this.colours.version) return this.made.canvas;
    const d = this.section.depths, rows = new Map(), table = new Uint32Array(256), blank = packed(...rgb(v.look.blank));
    for (let k = 0; k < 256; k++) table[k] = this.colours.colour((k + 0.5) / 256);
    const row = (k) => {
      if (!rows.has(k)) rows.set(k, Float64Array.from({ length: nx }, (_, c) => this.plane(k, from + (c + 0.5) / nx * (to - from))));
      return rows.get(k);
    };
    const image = new ImageData(nx, nz), out = new Uint32Array(image.data.buffer);
    for (let r = 0, at = 0; r < nz; r++) {
      const [k, t] = this.planesAt((r + 0.5) / nz * deep);
      const above = k < 0 ? null : row(k), under = k < 0 ? null : row(Math.min(k + 1, d.length - 1));
      for (let c = 0; c < nx; c++, at++) {
        const value = above ? (1 - t) * above[c] + t * under[c] : NaN;
        out[at] = Number.isNaN(value) ? blank : table[Math.min(255, Math.floor(256 * this.colours.share(value)))];
      }
    }
    const canvas = document.createElement("canvas");
    canvas.width = nx; canvas.height = nz; canvas.getContext("2d").putImageData(image, 0, 0);
    this.made = { key, version: this.colours.version, canvas };
    return canvas;
  }

  draw() {
    if (this.other) this.other.tell(this.other.there());
    const width = this.box.clientWidth, v = this.viewer;
    if (!width || !this.ready() || (this.other && !this.other.there())) return;
    const margin = { ...MAP_MARGIN, right: 12 }, s = this.section, [from, to] = this.span(), deep = s.depths[s.depths.length - 1] / (s.axis ? v.zoom : 1);
    const height = (v.one ? 120 : Math.min(230, Math.max(130, width * 0.3))) + margin.top + margin.bottom, context = sized(this.canvas, width, height);
    const a = this.axes = new Axes(width, height, margin).limits(from, to, deep, 0);
    const picture = this.picture(Math.max(2, Math.round(a.width)), Math.round(a.height), from, to, deep);
    context.drawImage(picture, a.left, a.top, a.width, a.height);
    context.font = FONT; context.textBaseline = "middle"; context.textAlign = "right";
    for (const item of s.interfaces) if (item.depth < deep) {
      for (const [wide, colour] of [[3, "#fff"], [1.2, "#000"]]) { context.lineWidth = wide; context.strokeStyle = colour; context.beginPath(); context.moveTo(a.left, a.py(item.depth)); context.lineTo(a.left + a.width, a.py(item.depth)); context.stroke(); }
    }
    for (const item of s.layers) {
      const top = Math.max(item.top, 0), bottom = Math.min(item.bottom === null ? deep : item.bottom, deep), y = a.py((top + bottom) / 2);
      if (top >= deep || a.py(bottom) - a.py(top) < 16) continue;
      context.lineWidth = 3; context.strokeStyle = "rgba(255,255,255,.85)"; context.strokeText(item.text, a.left + a.width - 6, y);
      context.fillStyle = "#000"; context.fillText(item.text, a.left + a.width - 6, y);
    }
    const l = v.scene.length;
    a.draw(context, v.look, l.factor, s.length.factor, s.axis ? `${s.axis} (${l.symbol})` : `along the section line (${l.symbol})`, `depth (${s.length.symbol})`);
    const along = s.axis ? (this.at ? this.at[0] : v.cursor && v.cursor[s.axis === "x" ? 0 : 1]) : this.at ? this.at[0] : v.along;
    if (along !== null && along !== undefined && along >= from && along <= to) { context.strokeStyle = v.look.ink; context.lineWidth = 1; context.setLineDash([3, 3]); context.beginPath(); context.moveTo(a.px(along), a.top); context.lineTo(a.px(along), a.top + a.height); context.stroke(); context.setLineDash([]); }
    Panel.prototype.drawBar.call({ barCanvas: this.barCanvas, map: s, colours: this.colours, viewer: v, lowest: {}, highest: {} });
  }
}

/* ---- curves along the section line ---- */

class Curve {
  constructor(viewer, panel) {
    this.viewer = viewer; this.panel = panel;
    this.box = make("div", null, { class: "av-curve", "data-curve": panel.map.name });
    const head = make("div", this.box, { class: "av-head" });
    make(viewer.heading, head, {}, panel.map.title);
    this.said = make("output", head, { class: "av-value" }, "");
    this.canvas = make("canvas", this.box, { role: "application", "aria-roledescription": "curve", tabindex: "0", "aria-label": `${panel.map.title} along the section line. Left and right arrow move along the line and read the value.` });
    this.canvas.addEventListener("pointermove", (event) => { const r = this.canvas.getBoundingClientRect(); viewer.go(this.axes.x(event.clientX - r.left)); });
    this.canvas.addEventListener("pointerleave", (event) => { if (event.pointerType !== "touch") viewer.leave(); });
    this.canvas.addEventListener("keydown", (event) => {
      const by = STEP_KEYS[event.key];
      if (!by || !by[0]) return;
      event.preventDefault();
      viewer.go((viewer.along || 0) + by[0] * viewer.length() / (event.shiftKey ? 20 : 200));
      viewer.tell(`${panel.map.title}: ${this.said.textContent}`);
    });
  }
  sample(t) {
    const { line } = this.viewer, r = this.panel.raster, blank = this.panel.map.blank.value;
    return r.between(line[0] + t * (line[2] - line[0]), line[1] + t * (line[3] - line[1]), blank === null ? NaN : blank);
  }
  /* Axes and curve, drawn once for a place of the line; the cross that moves over them is drawn by draw(). */
  under() {
    const width = this.box.clientWidth, v = this.viewer, p = this.panel, key = [width, v.line, window.devicePixelRatio, v.look.soft, v.look.accent].join(" ");
    if (this.kept && this.kept.key === key && this.kept.raster === p.raster) return true;
    if (!width || !p.raster) return false;
    const margin = { ...MAP_MARGIN, right: 12 }, height = 128, { factor, symbol } = p.map.unit, made = document.createElement("canvas"), context = sized(made, width, height);
    const n = Math.min(1500, Math.max(2, 2 * Math.ceil(Math.max(Math.abs(v.line[2] - v.line[0]) / p.raster.cell[0], Math.abs(v.line[3] - v.line[1]) / p.raster.cell[1])) + 1));
    this.values = Float64Array.from({ length: n }, (_, k) => this.sample(k / (n - 1)));
    let low = Infinity, high = -Infinity;
    for (const value of this.values) if (!Number.isNaN(value)) { low = Math.min(low, value); high = Math.max(high, value); }
    if (!(high > low)) { const middle = Number.isFinite(low) ? low : 0; low = middle - factor / 2; high = middle + factor / 2; }
    const room = 0.06 * (high - low), a = this.axes = new Axes(width, height, margin).limits(0, v.length() || 1, low - room, high + room);
    const l = v.scene.length;
    a.draw(context, v.look, l.factor, factor, `along the section line (${l.symbol})`, symbol);
    context.strokeStyle = v.look.accent; context.lineWidth = 1.5; context.beginPath();
    let pen = false;
    this.values.forEach((value, k) => {
      if (Number.isNaN(value)) { pen = false; return; }
      const x = a.px(k / (n - 1) * a.x1), y = a.py(value);
      if (pen) context.lineTo(x, y); else context.moveTo(x, y);
      pen = true;
    });
    context.stroke();
    this.kept = { key, raster: p.raster, canvas: made, width, height };
    return true;
  }
  draw() {
    if (!this.under()) return;
    const v = this.viewer, p = this.panel, a = this.axes, l = v.scene.length, { canvas: made, width, height } = this.kept, context = sized(this.canvas, width, height);
    context.drawImage(made, 0, 0, width, height);
    if (v.along === null) { write(this.said, ""); return; }
    const value = this.sample(v.along / (v.length() || 1));
    context.strokeStyle = v.look.ink; context.lineWidth = 1; context.setLineDash([3, 3]);
    context.beginPath(); context.moveTo(a.px(v.along), a.top); context.lineTo(a.px(v.along), a.top + a.height); context.stroke(); context.setLineDash([]);
    if (Number.isNaN(value)) { write(this.said, p.map.blank.text); return; }
    context.fillStyle = v.look.ink; context.beginPath(); context.arc(a.px(v.along), a.py(value), 3.5, 0, 7); context.fill();
    write(this.said, `${p.number(value)} at ${withUnit(short(v.along / l.factor), l.symbol)}`);
  }
}

/* ---- the other maps, small ---- */

/* A small picture of a map, of the step that is shown, with the place of the cross and the value there; pressed, it becomes the large one. */
class Thumb {
  constructor(viewer, panel, row) {
    this.viewer = viewer; this.panel = panel; this.drawn = "";
    const button = this.button = make("button", row, { class: "av-thumb", type: "button", "aria-pressed": "false", "data-thumb": panel.map.name });
    make("span", button, { class: "av-thumb-name" }, panel.map.title);
    const stage = make("span", button, { class: "av-thumb-stage" });
    this.canvas = make("canvas", stage, { "aria-hidden": "true" });
    this.frame = make("span", stage, { class: "av-thumb-frame", hidden: "" }); this.cross = make("span", stage, { class: "av-thumb-cross", hidden: "" });
    this.said = make("span", button, { class: "av-thumb-value" }, "");
    const [sx, sy] = viewer.size;
    stage.style.aspectRatio = String(Math.min(Math.max(sx / sy, 0.5), 3));
    button.addEventListener("click", () => viewer.choose(panel.map.name));
  }
  get stale() { return this.panel.raster && this.drawn !== this.key(); }
  key() { const p = this.panel, v = this.viewer; return [p.raster.id, p.colours.version.id, p.colours.only, v.look.blank, v.here(p)].join(" "); }
  draw() {
    const { panel, viewer, canvas } = this, r = panel.raster;
    this.drawn = this.key();
    let k = 0;
    while (Math.max(r.nx, r.ny) >> k > SMALL) k++;
    k = r.level(k);
    const { nx, ny } = r.levels[k], picture = panel.colours.picture(r, k, rgb(viewer.look.blank));
    canvas.width = Math.max(nx, 2); canvas.height = Math.max(ny, 2);
    const context = canvas.getContext("2d"), [w, h] = [viewer.size[0] / (r.cell[0] * 2 ** k), viewer.size[1] / (r.cell[1] * 2 ** k)];
    context.imageSmoothingEnabled = false;
    context.drawImage(picture, 0, ny - h, w, h, 0, 0, canvas.width, canvas.height); // an incomplete last point is cut
    const there = viewer.here(panel);
    this.button.classList.toggle("av-thumb-elsewhere", !there);
    if (!there) write(this.said, `step ${viewer.scene.steps.numbers[panel.map.step]} only`);
  }
  over() {
    const v = this.viewer, [sx, sy] = v.size, there = v.here(this.panel);
    this.cross.hidden = !v.cursor; this.frame.hidden = v.zoom <= 1;
    if (v.cursor) { this.cross.style.left = `${100 * v.cursor[0] / sx}%`; this.cross.style.top = `${100 - 100 * v.cursor[1] / sy}%`; }
    if (v.zoom > 1) {
      const w = 100 / v.zoom;
      Object.assign(this.frame.style, { width: `${w}%`, height: `${w}%`, left: `${100 * v.centre[0] / sx - w / 2}%`, top: `${100 - 100 * v.centre[1] / sy - w / 2}%` });
    }
    if (there) write(this.said, v.cursor ? this.panel.text(...v.cursor) : "");
  }
}

/* ---- the viewer ---- */

class Viewer {
  constructor(element, scene, options = {}) {
    this.element = element; this.scene = scene; this.size = scene.size; this.cell = scene.cell; this.options = options;
    this.zoom = 1; this.centre = [this.size[0] / 2, this.size[1] / 2];
    this.line = [...scene.line]; this.lineShown = true; this.cursor = null; this.along = null; this.marked = null;
    this.position = { steps: scene.steps ? scene.steps.first : 0, depths: 0 };
    this.kept = new Map(); this.few = new Map(); this.turns = {}; this.thumbs = []; this.one = options.layout === "one"; this.heading = this.one ? "h2" : "h4";
    element.classList.add("av"); element.replaceChildren();
    element.classList.toggle("av-one", this.one);
    this.panels = scene.maps.map((map) => new Panel(this, map));
    if (this.one) this.screen();
    else {
      this.toolbar(element);
      this.sliders(element);
      this.maps = make("div", element, { class: "av-maps" });
      this.sections(element);
    }
    this.maps.append(...this.panels.map((panel) => panel.box));
    this.live = make("p", element, { class: "av-live", role: "status", "aria-live": "polite" });
    this.notes(element);
    this.restyle();
    this.watch();
    const shown = scene.maps.filter((map) => map.shown).map((map) => map.name);
    this.ready = this.show(this.one ? [shown.includes("pressure") ? "pressure" : shown[0] || scene.maps[0].name] : shown);
  }

  /* One map large; beside it the sliders, the other maps in a row, and below these the section. */
  screen() {
    const screen = make("div", this.element, { class: "av-screen" }), left = make("div", screen);
    this.toolbar(left);
    this.maps = make("div", left, { class: "av-maps" });
    const side = make("div", screen, { class: "av-side" });
    this.sliders(side);
    if (this.panels.length > 1) {
      const row = make("div", side, { class: "av-row", role: "group", "aria-label": "All maps; press one to see it large" });
      this.thumbs = this.panels.map((panel) => new Thumb(this, panel, row));
    }
    this.sections(side);
  }
  /* Notes: below the maps, folded where one map is large. */
  notes(element) {
    const notes = this.scene.notes;
    if (!notes.length) return;
    const box = this.one ? make("details", element, { class: "av-notes" }) : element;
    if (this.one) make("summary", box, {}, "How exact these maps are");
    for (const note of notes) make("p", box, { class: "av-note" }, note);
  }
  /* Points of the screen that a map is tall at most. */
  get tallest() { return this.one ? Math.min(Math.max(window.innerHeight - (this.options.above || 490), 260), 700) : 460; }
  emit(kind, detail) { this.element.dispatchEvent(new CustomEvent(`viewer-${kind}`, { bubbles: true, detail: { viewer: this, ...detail } })); }

  watch() {
    const dark = matchMedia("(prefers-color-scheme: dark)");
    this.restyled = () => { this.restyle(); this.draw(); this.thumbsSoon(); };
    dark.addEventListener("change", this.restyled);
    this.observer = new ResizeObserver(() => this.drawSoon());
    this.observer.observe(this.element);
    this.stop = () => { this.turns = {}; dark.removeEventListener("change", this.restyled); this.observer.disconnect(); this.element.replaceChildren(); };
  }
  restyle() {
    const take = (name, otherwise) => colourOf(this.element, name) || otherwise;
    this.look = { ink: take("--av-ink", "#1b1f24"), soft: take("--av-soft", "#55606c"), accent: take("--av-accent", "#005a8f"), blank: take("--av-blank", "#ececec") };
  }

  /* Maps may have got other units. */
  renamed() { for (const panel of this.panels) if (panel.symbol) write(panel.symbol, panel.map.unit.symbol); }

  toolbar(parent) {
    const bar = make("div", parent, { class: "av-tools", role: "toolbar", "aria-label": "Maps" });
    const button = (text, label, action) => { const b = make("button", bar, { type: "button", "aria-label": label, title: label }, text); b.addEventListener("click", action); return b; };
    button("−", "Zoom out", () => this.zoomBy(1 / 1.5, ...this.centre));
    button("+", "Zoom in", () => this.zoomBy(1.5, ...this.centre));
    button("Whole map", "Show the whole map", () => this.reset());
    this.lineButton = button("Section line", "Show the section line and the curves along it", () => this.showLine(!this.lineShown));
    this.chips = [];
    if (this.one) return;
    const group = make("span", bar, { class: "av-chips", role: "group", "aria-label": "Maps shown" });
    this.chips = this.panels.map((panel) => {
      const chip = make("button", group, { type: "button", "aria-pressed": "false" }, panel.map.title);
      chip.addEventListener("click", () => { const names = this.visible.map((p) => p.map.name); this.show(panel.box.hidden ? [...names, panel.map.name] : names.filter((name) => name !== panel.map.name)); });
      return chip;
    });
  }

  sliders(parent) {
    this.ranges = {};
    for (const kind of ["steps", "depths"]) {
      const along = this.scene[kind];
      if (!along || along.texts.length < 2) continue;
      const row = make("label", parent, { class: "av-slider", "data-slider": kind });
      make("span", row, {}, along.label);
      const input = make("input", row, { type: "range", min: "0", max: String(along.texts.length - 1), value: String(this.position[kind]), step: "1" });
      const text = make("output", row);
      input.addEventListener("input", () => this.set(kind, Number(input.value)));
      this.ranges[kind] = { input, text };
    }
    this.setTexts();
  }
  setTexts() {
    for (const [kind, { input, text }] of Object.entries(this.ranges)) {
      input.value = String(this.position[kind]);
      text.textContent = this.scene[kind].texts[this.position[kind]];
      input.setAttribute("aria-valuetext", text.textContent);
    }
  }

  sections(parent) {
    this.under = make("div", parent, { class: "av-under" });
    this.curves = this.panels.filter((panel) => panel.map.kind === "values").map((panel) => new Curve(this, panel));
    this.under.append(...this.curves.map((curve) => curve.box));
    this.belows = this.scene.sections.map((section) => new Below(this, section));
    const planes = this.scene.maps.find((map) => map.along === "depths" && map.arrays.length > 1);
    if (planes) this.belows.push(this.planesBelow = new Below(this, { ...planes, ...this.scene.below, axis: null, title: `${planes.title} below the section line`, alt: `${planes.title} below the section line, depth downwards.` }));
    this.deep = make("div", parent, { class: "av-deep" });
    if (this.one && this.belows.length > 1) this.chooseBelow();
    this.deep.append(...this.belows.map((below) => below.box));
    this.ends(this.one ? make("details", parent, { class: "av-ends" }) : this.under);
    for (const below of this.belows) below.load();
    if (planes) Promise.all(planes.arrays.map((array) => this.raster(array, planes))).then((all) => { this.planesBelow.planes = all; this.drawSoon(); }, console.warn);
  }
  /* Which section in the body is shown, where only one is. */
  chooseBelow() {
    const label = make("label", this.deep, { class: "av-choose" }, "In the body "), select = make("select", label);
    this.belows.forEach((below, k) => make("option", select, { value: String(k) }, below.section.title));
    this.shownBelow = this.planesBelow ? this.belows.length - 1 : 0; // below the line that a person can move, where there is one
    select.value = String(this.shownBelow);
    select.addEventListener("change", () => { this.shownBelow = Number(select.value); this.drawSoon(); });
  }
  /* Ends of the section line as numbers. */
  ends(parent) {
    if (this.one) make("summary", parent, {}, "Ends of the section line");
    const place = make("fieldset", parent, { class: "av-place" });
    make("legend", place, {}, `Section line, in ${this.scene.length.symbol}`);
    this.fields = ["from x", "y", "to x", "y"].map((name, k) => {
      const label = make("label", place, {}, `${name} `), field = make("input", label, { type: "text", inputmode: "decimal", size: "7", "aria-label": `${k < 2 ? "Start" : "End"} of the section line, ${"xy"[k % 2]}` });
      field.addEventListener("change", () => {
        const value = Number(field.value.replace("−", "-")) * this.scene.length.factor, line = [...this.line];
        if (field.value.trim() && Number.isFinite(value)) line[k] = value;
        this.setLine(...line);
      });
      return field;
    });
  }

  /* What is known of an array without waiting: its raster, or one with few points, and whether these are all. */
  atHand(array) {
    const whole = this.kept.get(array);
    if (whole && whole.raster) return [whole.raster, true];
    return [this.few.get(array), false];
  }
  /* The raster of an array, decoded once; the least used ones are forgotten but for few of their points. */
  raster(array, map) {
    if (this.kept.has(array)) { const found = this.kept.get(array); this.kept.delete(array); this.kept.set(array, found); return found.promise; }
    const one = { raster: null }, decode = async () => new Raster(array, array.q || await numbersOf(array), map.reduce);
    one.promise = decode().then((raster) => { if (map.along && !this.few.has(array)) this.few.set(array, raster.coarse()); return one.raster = raster; });
    one.promise.catch(() => this.kept.delete(array));
    this.kept.set(array, one);
    const size = (other) => other.shape ? other.shape[0] * other.shape[1] * other.bits / 8 : 0, most = this.one ? KEPT.one : KEPT.grid;
    let bytes = 0;
    for (const other of this.kept.keys()) bytes += size(other);
    for (const other of this.kept.keys()) if (bytes > most && other !== array) { bytes -= size(other); this.kept.delete(other); }
    return one.promise;
  }
  /* While nothing else happens: the neighbours of a step or depth whole, nearest first, with their colours, and few points of all others, so that the slider finds them. */
  prefetch(kind) {
    const turn = this.turns[kind] = {}, count = this.scene[kind].texts.length, at = this.position[kind];
    const order = Array.from({ length: count }, (_, k) => k).sort((a, b) => Math.abs(a - at) - Math.abs(b - at)).slice(1);
    const idle = window.requestIdleCallback ? (limit) => new Promise((done) => requestIdleCallback(done, { timeout: limit })) : () => new Promise((done) => setTimeout(done, 30));
    const wanted = this.one ? this.panels : this.visible;
    (async () => {
      for (const k of order) for (const panel of wanted) {
        const array = panel.map.along === kind ? panel.map.arrays[k] : null, near = Math.abs(k - at) <= 3;
        if (!array || (!near && this.few.has(array))) continue;
        await idle(1500);
        if (this.turns[kind] !== turn) return;
        const raster = await this.raster(array, panel.map).catch(() => null);
        if (!raster) return;
        if (!near || panel.box.hidden || !panel.axes) continue;
        await idle(1500);
        if (this.turns[kind] !== turn) return;
        panel.colours.picture(raster, panel.fine(raster), rgb(this.look.blank));
      }
    })();
  }
  index(map) { return map.along ? this.position[map.along] : 0; }
  get visible() { return this.panels.filter((panel) => !panel.box.hidden); }
  here(panel) { return !panel.other || panel.other.there(); }
  length() { return Math.hypot(this.line[2] - this.line[0], this.line[3] - this.line[1]); }

  /* Show the maps of these names, and no others; resolves when they are drawn. */
  async show(names) {
    this.panels.forEach((panel, k) => {
      panel.box.hidden = !names.includes(panel.map.name);
      const button = this.one ? this.thumbs[k] && this.thumbs[k].button : this.chips[k];
      if (button) button.setAttribute("aria-pressed", String(!panel.box.hidden));
    });
    for (const curve of this.curves) curve.box.hidden = curve.panel.box.hidden;
    this.arrange();
    await Promise.all(this.visible.map((panel) => panel.load()));
    this.draw();
    if (this.one) await Promise.all(this.panels.map((panel) => panel.load()));
    for (const kind of Object.keys(this.ranges)) this.prefetch(kind);
  }
  /* Make the map of this name the large one. */
  choose(name) { const done = this.show([name]); this.emit("show", { name }); return done; }
  /* The slider through depths is there for maps that have some. */
  arrange() {
    if (!this.one || !this.ranges.depths) return;
    this.ranges.depths.input.parentElement.hidden = !this.visible.some((panel) => panel.map.along === "depths");
  }
  /* Position of the slider "steps" or "depths". */
  async set(kind, number) {
    this.position[kind] = Math.min(Math.max(number, 0), this.scene[kind].texts.length - 1);
    this.setTexts();
    if (this.marked && this.marked.cells) this.marked = null;
    this.emit("set", { kind, number: this.position[kind] });
    const loaded = [...this.visible, ...(this.one ? this.panels : [])].map((panel) => panel.load());
    this.drawSoon(); this.thumbsSoon();
    await Promise.all(loaded);
    this.drawSoon();
    this.prefetch(kind);
  }

  /* Limits of the axes of a map for the present view: to scale, unless the grid is very slender. */
  fitted(axes) {
    const [sx, sy] = this.size, slender = Math.max(sx / sy, sy / sx) > 8;
    let wide = sx / this.zoom, tall = sy / this.zoom;
    if (!slender) { const per = Math.max(wide / axes.width, tall / axes.height); wide = per * axes.width; tall = per * axes.height; }
    const middle = (k, span) => { const half = Math.min(span, this.size[k]) / 2; return Math.min(Math.max(this.centre[k], half), this.size[k] - half); };
    const x = middle(0, wide), y = middle(1, tall);
    return axes.limits(x - wide / 2, x + wide / 2, y - tall / 2, y + tall / 2);
  }
  zoomBy(factor, x, y) {
    const zoom = Math.min(Math.max(this.zoom * factor, 1), Math.max(this.size[0] / this.cell[0], this.size[1] / this.cell[1]) / 4, 1e4), real = zoom / this.zoom;
    this.setView(x + (this.centre[0] - x) / real, y + (this.centre[1] - y) / real, zoom);
  }
  panBy(dx, dy) { this.setView(this.centre[0] + dx, this.centre[1] + dy, this.zoom); }
  reset() { this.setView(this.size[0] / 2, this.size[1] / 2, 1); }
  setView(x, y, zoom) {
    const keep = (value, size) => { const half = size / zoom / 2; return Math.min(Math.max(value, half), size - half); };
    this.zoom = Math.max(zoom, 1); this.centre = [keep(x, this.size[0]), keep(y, this.size[1])];
    this.drawSoon(); this.emit("view", { centre: this.centre, zoom: this.zoom });
  }

  /* The cross at x, y (m) in all maps, with the values there. */
  point(x, y) { this.cursor = [x, y]; this.along = this.nearest(x, y); this.overSoon(); this.emit("cross", { at: this.cursor }); }
  go(along) {
    const t = Math.min(Math.max(along / (this.length() || 1), 0), 1), l = this.line;
    this.cursor = [l[0] + t * (l[2] - l[0]), l[1] + t * (l[3] - l[1])]; this.along = t * this.length();
    this.overSoon(); this.emit("cross", { at: this.cursor });
  }
  leave() { this.cursor = null; this.along = null; this.overSoon(); this.emit("cross", { at: null }); }
  /* Distance along the section line of a place on it, within a few points of the screen; else null. */
  nearest(x, y) {
    const [x0, y0, x1, y1] = this.line, length = this.length();
    if (!this.lineShown || length === 0) return null;
    const t = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length ** 2;
    const off = Math.abs((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) / length, first = this.visible[0];
    const dot = first && first.axes ? (first.axes.x1 - first.axes.x0) / first.axes.width : 0;
    return t >= 0 && t <= 1 && off < 8 * dot ? t * length : null;
  }
  placeText(x, y) {
    const { symbol, factor } = this.scene.length, at = x === undefined ? this.cursor : [x, y];
    return at ? `x = ${withUnit(short(at[0] / factor), symbol)}, y = ${withUnit(short(at[1] / factor), symbol)}` : "";
  }
  /* Values of all visible maps at x, y (m), as shown. */
  read(x, y) { return Object.fromEntries(this.visible.filter(this.here).map((panel) => [panel.map.name, panel.text(x, y)])); }

  setLine(x0, y0, x1, y1) {
    const keep = (value, k) => Math.min(Math.max(value, 0), this.size[k % 2]);
    this.line = [x0, y0, x1, y1].map(keep); this.along = null;
    this.drawSoon(); this.emit("line", { line: this.line });
  }
  moveLine(end, x, y) { const line = [...this.line]; line[2 * end] = x; line[2 * end + 1] = y; this.setLine(...line); }
  showLine(shown) { this.lineShown = shown; this.drawSoon(); }

  /* ---- contact spots ---- */

  neighbour(raster, i, j, di, dj) {
    let a = i + di, b = j + dj;
    if (this.scene.wraps[0]) a = ((a % raster.nx) + raster.nx) % raster.nx;
    if (this.scene.wraps[1]) b = ((b % raster.ny) + raster.ny) % raster.ny;
    return a < 0 || b < 0 || a >= raster.nx || b >= raster.ny ? -1 : b * raster.nx + a;
  }
  /* Mark the spot of map `name` that holds the place x, y (m), or the rectangle x0, y0, x1, y1; returns what is known of it, or null. */
  highlight({ x, y, x0, y0, x1, y1, name, zoom }) {
    this.marked = null;
    if (x0 !== undefined) this.marked = { x0, y0, x1, y1 };
    else {
      const panel = this.panels.find((p) => p.raster && p.map.name === (name || this.scene.spots));
      const found = panel && this.spot(panel, x, y);
      if (!found) { this.overSoon(); return null; }
      this.marked = found;
    }
    const m = this.marked;
    if (zoom) {
      const across = m.x0 < 0 || m.x1 > this.size[0] || m.y0 < 0 || m.y1 > this.size[1]; // a spot that goes on at the other side
      const most = Math.max(this.size[0] / this.cell[0], this.size[1] / this.cell[1]) / 12, near = Math.min(this.size[0] / (m.x1 - m.x0), this.size[1] / (m.y1 - m.y0)) / 4;
      this.setView(...(across ? [x, y] : [(m.x0 + m.x1) / 2, (m.y0 + m.y1) / 2]), Math.max(1, Math.min(near, most)));
    }
    this.overSoon();
    return m;
  }
  clear() { this.marked = null; this.tell(""); this.overSoon(); }
  spot(panel, x, y) {
    const r = panel.raster, q = r.levels[0].q, first = [Math.floor(x / r.cell[0]), Math.floor(y / r.cell[1])];
    const within = (at) => panel.map.kind === "classes" ? q[at] > 0 : q[at] !== r.masked;
    const start = this.neighbour(r, ...first, 0, 0);
    if (start < 0 || !within(start)) return null;
    const cells = new Set([start]), open = [first]; // places go on across the edges of a surface that repeats
    let top = q[start], [left, right, low, high] = [first[0], first[0], first[1], first[1]];
    while (open.length && cells.size < 400000) {
      const [i, j] = open.pop();
      left = Math.min(left, i); right = Math.max(right, i); low = Math.min(low, j); high = Math.max(high, j);
      for (const [di, dj] of [[-1, 0], [1, 0], [0, -1], [0, 1]]) {
        const next = this.neighbour(r, i, j, di, dj);
        if (next >= 0 && !cells.has(next) && within(next)) { cells.add(next); open.push([i + di, j + dj]); top = Math.max(top, q[next]); }
      }
    }
    return { cells, raster: r, area: cells.size * r.cell[0] * r.cell[1], largest: r.low + r.step * top, x0: left * r.cell[0], x1: (right + 1) * r.cell[0], y0: low * r.cell[1], y1: (high + 1) * r.cell[1] };
  }
  pick(x, y) {
    this.point(x, y);
    const panel = this.panels.find((p) => p.raster && p.map.name === this.scene.spots);
    const found = this.scene.spots ? this.highlight({ x, y, zoom: this.options.centred }) : null, { factor, symbol } = this.scene.length;
    if (found && panel) this.tell(`Spot at ${this.placeText(x, y)}: area ${withUnit(short(found.area / factor ** 2), `${symbol}²`)}${panel.map.kind === "values" ? `, largest ${panel.number(found.largest)}` : ""}.`);
    else this.clear();
    this.emit("pick", { x, y, spot: found });
  }
  tell(text) { if (this.live.textContent !== text) this.live.textContent = text; }

  /* ---- drawing, at most once a frame ---- */

  /* Small pictures follow one by one, in frames of their own, so that the large map never waits for them. */
  thumbsSoon() {
    if (this.frameThumbs || !this.thumbs.length) return;
    const next = () => {
      this.frameThumbs = 0;
      const thumb = this.thumbs.find((one) => one.stale);
      if (!thumb) return;
      if (!this.frame) { thumb.draw(); thumb.over(); }
      this.frameThumbs = requestAnimationFrame(next);
    };
    this.frameThumbs = requestAnimationFrame(next);
  }
  drawSoon() { if (!this.frame) this.frame = requestAnimationFrame(() => { this.frame = 0; this.draw(); }); }
  overSoon() { if (!this.frameOver) this.frameOver = requestAnimationFrame(() => { this.frameOver = 0; this.drawOver(); }); }
  draw() {
    for (const panel of this.visible) panel.draw();
    for (const thumb of this.thumbs) thumb.over();
    this.lineButton.setAttribute("aria-pressed", String(this.lineShown));
    this.under.hidden = !this.lineShown || (this.one && this.visible.every((panel) => panel.map.kind !== "values"));
    this.fields.forEach((field, k) => { if (document.activeElement !== field) field.value = short(this.line[k] / this.scene.length.factor); });
    this.drawCurves();
  }
  drawCurves() {
    for (const curve of this.curves) curve.box.hidden = curve.panel.box.hidden || !this.here(curve.panel);
    if (this.lineShown) for (const curve of this.curves) if (!curve.box.hidden) curve.draw();
    if (this.planesBelow && !this.one) this.planesBelow.box.hidden = !this.lineShown || !this.panels.some((panel) => panel.map.along === "depths" && !panel.box.hidden);
    if (this.shownBelow !== undefined) this.belows.forEach((below, k) => { below.box.hidden = k !== this.shownBelow || (below === this.planesBelow && !this.lineShown); });
    for (const below of this.belows) if (!below.box.hidden) below.draw();
  }
  drawOver() {
    for (const panel of this.visible) panel.drawOver();
    for (const thumb of this.thumbs) thumb.over();
    if (this.lineShown) for (const curve of this.curves) if (!curve.box.hidden) curve.draw();
  }
}

/* ---- values of the curves of a picture ---- */

function floats(text) { const bytes = bytesOf(text); return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.byteLength >> 2); }

/* Read-out of curves on a picture: each has its points, and the place of its axes as shares of the picture. */
class Curves {
  constructor(figure, described) {
    const image = this.image = figure.querySelector("img"), box = this.box = make("div", null, { class: "av-picture" });
    image.replaceWith(box); box.append(image);
    this.mark = make("span", box, { class: "av-mark", hidden: "" }); this.tip = make("output", box, { class: "av-tip", hidden: "" });
    this.points = [];
    this.cells = described.filter((axes) => axes.cells).map((axes) => axes.box); // filled with points, each of which is read out all over its cell
    for (const axes of described) for (const curve of axes.curves) {
      const x = floats(curve.x), y = floats(curve.y), places = [];
      for (let k = 0; k < x.length; k++) {
        const u = share(x[k], axes.x), v = share(y[k], axes.y);
        if (!(u >= -0.001 && u <= 1.001 && v >= -0.001 && v <= 1.001)) continue;
        const [l, t, r, b] = axes.box;
        places.push({ u: l + u * (r - l), v: b + v * (t - b), text: curve.texts ? curve.texts[k] : `${curve.name ? `${curve.name}: ` : ""}${said(axes.x.label, x[k])}, ${said(axes.y.label, y[k])}` });
      }
      if (places.length) this.points.push(places);
    }
    if (!this.points.length) return;
    image.tabIndex = 0;
    image.alt += " Left and right arrow read the points of a curve, up and down choose it.";
    box.addEventListener("pointermove", (event) => this.near(event)); box.addEventListener("pointerdown", (event) => this.near(event));
    box.addEventListener("pointerleave", (event) => { if (event.pointerType !== "touch") this.hide(); }); image.addEventListener("blur", () => this.hide());
    image.addEventListener("keydown", (event) => this.key(event));
  }
  near(event) {
    const r = this.image.getBoundingClientRect(), x = event.clientX - r.left, y = event.clientY - r.top;
    const within = this.cells.some(([l, t, right, b]) => x >= l * r.width && x <= right * r.width && y >= t * r.height && y <= b * r.height);
    let best = null, least = within ? Infinity : 40 ** 2;
    this.points.forEach((places, c) => places.forEach((p, k) => { const d = (p.u * r.width - x) ** 2 + (p.v * r.height - y) ** 2; if (d < least) { least = d; best = [c, k]; } }));
    if (best) this.show(...best); else this.hide();
  }
  show(c, k) {
    this.at = [c, k];
    const p = this.points[c][k], r = this.image.getBoundingClientRect(), left = this.image.offsetLeft, top = this.image.offsetTop;
    this.mark.hidden = this.tip.hidden = false;
    this.mark.style.left = `${left + p.u * r.width}px`; this.mark.style.top = `${top + p.v * r.height}px`;
    this.tip.textContent = p.text;
    const wide = this.tip.offsetWidth, from = Math.min(Math.max(left + p.u * r.width - wide / 2, left), left + Math.max(0, r.width - wide));
    this.tip.style.left = `${from}px`;
    const above = top + p.v * r.height - this.tip.offsetHeight - 12;
    this.tip.style.top = `${above < 0 ? top + p.v * r.height + 14 : above}px`;
  }
  hide() { this.mark.hidden = this.tip.hidden = true; }
  key(event) {
    const by = STEP_KEYS[event.key];
    if (event.key === "Escape") { this.hide(); return; }
    if (!by) return;
    event.preventDefault();
    let [c, k] = this.at || [0, -1];
    c = (c - by[1] + this.points.length) % this.points.length;
    this.show(c, Math.min(Math.max(k + by[0] * (event.shiftKey ? 10 : 1), 0), this.points[c].length - 1));
  }
}
/* "pressure (MPa)" and a value as "pressure 3 MPa". */
function said(label, value) {
  const found = /^(.*?) \(([^()]*)\)/.exec(label);
  return found ? `${found[1]} ${withUnit(short(value), found[2])}` : `${label} ${short(value)}`;
}
function share(value, axis) {
  const [low, high] = axis.limits;
  return axis.log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

/* ---- mounting what a page declares ---- */

async function start(root) {
  const read = (element) => JSON.parse(element.querySelector("script[type='application/json']").textContent);
  for (const figure of root.querySelectorAll("figure[data-curves]")) new Curves(figure, read(figure));
  if (!("DecompressionStream" in window)) return;
  for (const element of root.querySelectorAll("[data-viewer]")) {
    const scene = read(element), whole = element.closest("main") || element;
    try {
      whole.classList.add("av-live-page");
      const viewer = new Viewer(element, scene);
      element.viewer = viewer;
      await viewer.ready;
    } catch (error) {
      whole.classList.remove("av-live-page");
      element.replaceChildren();
      console.error(error);
    }
  }
}

window.AsperityViewer = { create: (element, scene, options) => new Viewer(element, scene, options), start, Curves, text: { short, withUnit, rounded, decimalsFor }, make };
if (document.querySelector("[data-viewer], figure[data-curves]")) start(document);
})();
