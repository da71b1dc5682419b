// As much of a browser as the script of compare's page meets, and a visitor who uses all of it.

class Context {
  drawn = [];  // names of what was drawn since the last clearRect(), and where
  drawImage(image, ...place) {
    this.image = image;
    this.drawn.push([image.id, ...place]);
  }
  getImageData(x, y, width, height) {
    const picture = this.image.picture;
    if (width !== picture.width || height !== picture.height) throw new Error("not the whole picture");
    return {data: Uint8ClampedArray.from(picture.bytes)};
  }
  createImageData(width, height) { return {data: new Uint8ClampedArray(4 * width * height)}; }
  putImageData(pixels) { this.pixels = pixels.data; }
  clearRect() { this.drawn = []; }
  save() {}
  restore() {}
  beginPath() {}
  rect() {}
  clip() {}
  fillRect() {}
}

class Element {
  listeners = {};
  attributes = {};
  dataset = {};
  parts = {};
  context = new Context();
  constructor(id, picture) {
    this.id = id;
    this.picture = picture;
    if (picture) [this.naturalWidth, this.naturalHeight] = [picture.width, picture.height];
  }
  addEventListener(type, listener) { this.listeners[type] = [...(this.listeners[type] ?? []), listener]; }
  fire(type, event = {}) {
    for (const listener of this.listeners[type]) listener({target: this, preventDefault() {}, ...event});
  }
  setAttribute(name, value) { this.attributes[name] = String(value); }
  setPointerCapture() {}
  getContext() { return this.context; }
  querySelector(name) { return this.parts[name] ??= new Element(name); }
}

// `page`: its ids, the views of its buttons, the text of its data, and its pictures by their ids, as RGBA bytes.
// `script`: the page's, as a function of the browser's globals that gives back its inner names.
// Returns what was seen.
function visit(page, script) {
  const elements = Object.fromEntries(page.ids.map((id) => [id, new Element(id, page.pictures[id])]));
  const buttons = page.views.map((view) => Object.assign(new Element(view), {dataset: {view}}));
  const rows = [0, 1, 2].map(() => ({cells: [0, 1, 2, 3, 4].map(() => ({textContent: ""}))}));
  const {stage, where, exposure} = elements, drawn = () => stage.context.drawn;
  elements.data.textContent = page.data;
  exposure.hidden = true;
  elements.views.querySelectorAll = () => buttons;
  elements.readout.tBodies = [{rows}];
  Object.assign(stage, {clientWidth: 100, clientHeight: 80});

  const timers = [], canvases = [];
  const window = Object.assign(new Element("window"), {devicePixelRatio: 2});
  const document = {
    getElementById: (id) => elements[id] ?? null,
    createElement() {
      canvases.push(new Element("canvas"));
      return canvases[canvases.length - 1];
    },
  };
  const {read, floatOfHalf} = script(window, document, (f) => timers.push(f));
  window.fire("load");

  const seen = {views: {}, pressed: {}, fit: drawn()};
  seen.halves = Array.from({length: 65536}, (_, bits) => String(floatOfHalf(bits)));
  seen.read = Object.fromEntries(Object.entries(read).map(([name, values]) => [name, Array.from(values, String)]));
  for (const key of "12345") {
    window.fire("keydown", {key});
    seen.views[key] = drawn().map(([name]) => name);
    seen.pressed[key] = buttons.filter((b) => b.attributes["aria-pressed"] === "true").map((b) => b.id);
  }
  elements.views.fire("click", {target: buttons[2]});
  timers.forEach((tick) => tick());
  seen.flipped = drawn()[0][0];
  window.fire("keydown", {key: " "});
  seen.other = drawn()[0][0];
  elements.one.fire("click");
  seen.one = drawn();
  // The stage has 200 x 160 pixels, and offsets count in half as many. Doubled about its centre, then dragged.
  stage.fire("wheel", {deltaY: -240, offsetX: 50, offsetY: 40});
  stage.fire("pointerdown", {offsetX: 10, offsetY: 10, pointerId: 1});
  stage.fire("pointermove", {offsetX: 15, offsetY: 8});
  stage.fire("pointerup");
  seen.moved = drawn();
  elements.fit.fire("click");
  const [, x, y, width] = drawn()[0], scale = width / JSON.parse(page.data).width;
  stage.fire("pointermove", {offsetX: (x + 1.5 * scale) / 2, offsetY: (y + 0.5 * scale) / 2});
  seen.where = where.textContent;
  seen.told = rows.map((row) => row.cells.slice(1).map((cell) => cell.textContent));
  seen.exposure = !exposure.hidden;
  if (seen.exposure) {
    Object.assign(exposure.parts.input, {value: "-1"}).fire("input");
    seen.exposed = [exposure.parts.output.textContent, Array.from(canvases[canvases.length - 2].context.pixels)];
  }
  return seen;
}
