#include "app/compare_page_parts.hpp"

namespace lucerna::app {

const std::string_view kComparePageStyle = R"css(
#stage { display: block; width: 100%; height: 65vh; background: #333; border-radius: 4px;
         cursor: crosshair; touch-action: none; }
.controls { display: flex; flex-wrap: wrap; gap: .4rem; align-items: center; margin: .6rem 0; }
.controls button { font: inherit; padding: .2rem .7rem; }
.controls button[aria-pressed=true] { outline: 2px solid #0072b2; }
#readout { margin: .6rem 0; }
#readout th, #readout td { min-width: 5.5rem; }
.pictures { display: flex; gap: 1rem; flex-wrap: wrap; }
#metrics td:last-child { text-align: left; }
figure { flex: 1 1 15rem; margin: 0; } figure img { width: 100%; image-rendering: auto; }
#legend { height: .8rem; }
)css";

const std::string_view kComparePageStage = R"html(
<div class="controls" id="views">
<button data-view="reference" title="key 1">Reference</button>
<button data-view="test" title="key 2">Test</button>
<button data-view="flip" title="key 3">Flip</button>
<button data-view="slider" title="key 4">Slider</button>
<button data-view="error" title="key 5">Error</button>
<span class="quiet">Space: the other picture. Wheel: zoom. Drag: move.</span>
<button id="fit" title="key 0">Fit</button>
<button id="one">1:1</button>
<label id="exposure" hidden>Exposure <input type="range" min="-10" max="10" step="0.5" value="0">
<output>0 EV</output></label>
</div>
<canvas id="stage" tabindex="0"></canvas>
<table id="readout">
<thead><tr><th id="where">Point at a pixel</th><th>red</th><th>green</th><th>blue</th><th>FLIP</th></tr></thead>
<tbody>
<tr><td>reference</td><td></td><td></td><td></td><td></td></tr>
<tr><td>test</td><td></td><td></td><td></td><td></td></tr>
<tr><td>difference</td><td></td><td></td><td></td><td></td></tr>
</tbody>
</table>
)html";

const std::string_view kComparePageScript = R"js(
"use strict";
const byId = (id) => document.getElementById(id);
const { width, height, values } = JSON.parse(byId("data").textContent);
const stage = byId("stage"), context = stage.getContext("2d");
const shown = { reference: byId("reference"), test: byId("test"), error: byId("error") };
const state = { view: "reference", flipped: false, slider: 0.5, scale: 1, x: 0, y: 0 };
const read = {};  // the values of every pixel, four a pixel: reference, test, flip

function bytesOf(image) {
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}

function floatOfHalf(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = (bits & 1023) / 1024;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + fraction) : 2 ** -14 * fraction);
}

// High bytes lie in the upper half of the picture, low bytes in the lower.
function halvesOf(image) {
  const bytes = bytesOf(image), count = bytes.length / 2;
  const table = Float32Array.from({ length: 65536 }, (_, bits) => floatOfHalf(bits));
  return Float32Array.from({ length: count }, (_, i) => table[bytes[i] << 8 | bytes[count + i]]);
}

function encodedFromLinear(v) {
  const x = Math.min(Math.max(v, 0), 1);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

// A picture of linear values, 2^stops times as bright.
function exposed(linear, stops) {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d"), pixels = context.createImageData(width, height);
  const gain = 2 ** stops;
  for (let i = 0; i < linear.length; ++i)
    pixels.data[i] = i % 4 === 3 ? 255 : 255 * encodedFromLinear(gain * linear[i]);
  context.putImageData(pixels, 0, 0);
  return canvas;
}

function drawPicture(picture) {
  context.drawImage(picture, state.x, state.y, width * state.scale, height * state.scale);
}

function drawSlider() {
  const at = state.slider * stage.width;
  for (const [picture, left, right] of [[shown.reference, 0, at], [shown.test, at, stage.width]]) {
    context.save();
    context.beginPath();
    context.rect(left, 0, right - left, stage.height);
    context.clip();
    drawPicture(picture);
    context.restore();
  }
  context.fillStyle = "#fff";
  context.fillRect(at - 1, 0, 2, stage.height);
}

function nameOnStage() {
  if (state.view === "flip") return state.flipped ? "test" : "reference";
  return state.view;
}

function draw() {
  context.clearRect(0, 0, stage.width, stage.height);
  context.imageSmoothingEnabled = state.scale < 1;
  if (state.view === "slider") drawSlider();
  else drawPicture(shown[nameOnStage()]);
  for (const button of byId("views").querySelectorAll("[data-view]"))
    button.setAttribute("aria-pressed", button.dataset.view === state.view ||
      state.view === "flip" && button.dataset.view === nameOnStage());
}

function show(view) {
  state.view = view;
  draw();
}

function zoomTo(scale, x, y) {
  const wanted = Math.min(Math.max(scale, 1 / 64), 128), ratio = wanted / state.scale;
  state.x = x - (x - state.x) * ratio;
  state.y = y - (y - state.y) * ratio;
  state.scale = wanted;
  draw();
}

function centre(scale) {
  state.scale = scale;
  state.x = (stage.width - width * scale) / 2;
  state.y = (stage.height - height * scale) / 2;
  draw();
}

function fit() {
  const ratio = window.devicePixelRatio || 1;
  stage.width = Math.round(stage.clientWidth * ratio);
  stage.height = Math.round(stage.clientHeight * ratio);
  centre(Math.min(stage.width / width, stage.height / height));
}

function pointOf(event) {
  const ratio = stage.width / stage.clientWidth;
  return [event.offsetX * ratio, event.offsetY * ratio];
}

function numberText(value) {
  return values === "bytes" ? String(value) : String(Number(value.toPrecision(4)));
}

function tell(event) {
  const [px, py] = pointOf(event);
  const x = Math.floor((px - state.x) / state.scale), y = Math.floor((py - state.y) / state.scale);
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  const at = 4 * (y * width + x), rows = byId("readout").tBodies[0].rows;
  byId("where").textContent = `x ${x}, y ${y} (from the top left)`;
  for (let c = 0; c < 3; ++c) {
    const reference = read.reference[at + c], test = read.test[at + c];
    [reference, test, test - reference].forEach((value, row) => {
      rows[row].cells[1 + c].textContent = numberText(value);
    });
  }
  rows[2].cells[4].textContent = read.flip[at].toFixed(4);
}

function listen() {
  let last = null;  // where a drag is
  stage.addEventListener("pointerdown", (event) => {
    last = pointOf(event);
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener("pointerup", () => { last = null; });
  stage.addEventListener("pointermove", (event) => {
    const [x, y] = pointOf(event);
    if (last && state.view === "slider") state.slider = x / stage.width;
    else if (last) [state.x, state.y] = [state.x + x - last[0], state.y + y - last[1]];
    if (last) {
      last = [x, y];
      draw();
    }
    tell(event);
  });
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomTo(state.scale * 2 ** (-event.deltaY / 240), ...pointOf(event));
  }, { passive: false });
  byId("views").addEventListener("click", (event) => {
    if (event.target.dataset.view) show(event.target.dataset.view);
  });
  byId("fit").addEventListener("click", fit);
  byId("one").addEventListener("click", () => centre(1));
  window.addEventListener("resize", fit);
  window.addEventListener("keydown", (event) => {
    const view = ["reference", "test", "flip", "slider", "error"][event.key - 1];
    if (view) show(view);
    else if (event.key === "0") fit();
    else if (event.key === " ") show(nameOnStage() === "reference" ? "test" : "reference");
    else return;
    event.preventDefault();
  });
  setInterval(() => {
    state.flipped = !state.flipped;
    if (state.view === "flip") draw();
  }, 600);
}

function offerExposure() {
  const label = byId("exposure"), input = label.querySelector("input");
  label.hidden = false;
  input.addEventListener("input", () => {
    label.querySelector("output").textContent = `${input.value} EV`;
    for (const name of ["reference", "test"]) shown[name] = exposed(read[name], Number(input.value));
    draw();
  });
}

function start() {
  for (const name of ["reference", "test"])
    read[name] = values === "bytes" ? bytesOf(byId(name)) : halvesOf(byId(name + "-values"));
  read.flip = halvesOf(byId("flip-values"));
  if (values === "linear") offerExposure();
  listen();
  fit();
}
window.addEventListener("load", start);  // when the pictures are there
)js";

}  // namespace lucerna::app
