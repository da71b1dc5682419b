// The globals of a pipeline script, run before it in the same context: pipeline(), pass(), param(),
// print(). The host hands in `host` = {file, seed, overrides, print}; the last expression is the
// function that gives the result as JSON. docs/user/pipelines.md describes what scripts see.
(function (host) {
  "use strict";
  const rows = [], places = [], params = [];
  let header = null;
  const {stringify} = JSON;
  const overrides = new Map(Object.entries(host.overrides));

  // Line of the script's statement that is running: the innermost frame in the script's file.
  function lineOfCaller() {
    const frames = String(new Error().stack).split("\n");
    const frame = frames.find(text => text.includes(host.file + ":"));
    const match = frame && /:(\d+)(?::\d+)?$/.exec(frame);
    return match ? Number(match[1]) : 0;
  }

  function describe(value) {
    if (value === null) return "null";
    if (Array.isArray(value)) return "an array";
    return {undefined: "undefined", object: "an object", function: "a function"}[typeof value] ??
           `${typeof value} ${String(value)}`;
  }

  function checkNumber(what, value) {
    if (!Number.isFinite(value))
      throw new RangeError(`${what} is ${value}; a finite number is wanted`);
  }

  function checkedParam(what, value) {
    if (typeof value === "number") checkNumber(what, value);
    else if (Array.isArray(value)) {
      for (let i = 0; i < value.length; ++i) {
        if (typeof value[i] !== "number")
          throw new TypeError(`${what}[${i}] is ${describe(value[i])}; a number is wanted`);
        checkNumber(`${what}[${i}]`, value[i]);
      }
      return [...value];
    } else if (typeof value !== "boolean" && typeof value !== "string")
      throw new TypeError(`${what} is ${describe(value)}; a number, a boolean, a string or an ` +
                          "array of numbers is wanted");
    return value;
  }

  function checkedObject(what, value) {
    if (typeof value !== "object" || value === null || Array.isArray(value))
      throw new TypeError(`${what} is ${describe(value)}; an object like {key: value} is wanted`);
    return value;
  }

  function checkedText(what, value) {
    if (typeof value !== "string" || value === "")
      throw new TypeError(`${what} is ${describe(value) || "empty"}; a non-empty string is wanted`);
    return value;
  }

  // What pass() returns: any property is the port of that name ("GBuffer.depth"); the handle itself
  // stands for the row.
  const handles = new WeakMap();
  function makeHandle(name) {
    const handle = new Proxy(Object.freeze({}), {
      get(target, key) {
        if (key === Symbol.toPrimitive || key === "toString" || key === "toJSON") return () => name;
        return typeof key === "symbol" ? undefined : `${name}.${key}`;
      },
      set() {
        throw new TypeError(`the ports of '${name}' cannot be set; give the parameters to pass()`);
      },
    });
    handles.set(handle, name);
    return handle;
  }

  function checkedRead(what, value) {
    if (typeof value === "object" && value !== null && handles.has(value)) return handles.get(value);
    if (typeof value === "string") return value;
    throw new TypeError(`${what} is ${describe(value)}; a port like gbuffer.depth or ` +
                        '"GBuffer.depth" is wanted');
  }

  function pass(type, options = {}) {
    checkedText("the type of pass()", type);
    checkedObject(`the second argument of pass("${type}")`, options);
    const {name = type, enabled = true, reads = {}, params: given = {}, ...rest} = options;
    checkedText(`the name of pass("${type}")`, name);
    if (typeof enabled !== "boolean")
      throw new TypeError(`'enabled' of '${name}' is ${describe(enabled)}; true or false is wanted`);
    const row = {name, type, enabled, reads: {}, params: {}};
    for (const [port, source] of Object.entries(checkedObject(`'reads' of '${name}'`, reads)))
      row.reads[port] = checkedRead(`input '${port}' of '${name}'`, source);
    const values = {...checkedObject(`'params' of '${name}'`, given), ...rest};
    for (const [key, value] of Object.entries(values))
      row.params[key] = checkedParam(`parameter '${key}' of '${name}'`, value);
    rows.push(row);
    places.push(lineOfCaller());
    return makeHandle(name);
  }

  function pipeline(options) {
    checkedObject("the argument of pipeline()", options);
    if (header !== null) throw new Error("pipeline() is called twice; a script makes one pipeline");
    for (const key of Object.keys(options))
      if (key !== "name" && key !== "output")
        throw new TypeError(`pipeline() knows 'name' and 'output', not '${key}'`);
    header = {};
    if (options.name !== undefined) header.name = checkedText("the pipeline's name", options.name);
    if (options.output !== undefined)
      header.output = checkedRead("the pipeline's output", options.output);
  }

  function fromText(name, text, like) {
    if (typeof like === "string") return text;
    if (typeof like === "boolean") {
      if (text === "true" || text === "false") return text === "true";
      throw new TypeError(`script.${name} is '${text}'; true or false is wanted`);
    }
    const number = Number(text);
    if (text.trim() === "" || !Number.isFinite(number))
      throw new TypeError(`script.${name} is '${text}'; a number is wanted`);
    return number;
  }

  function param(name, defaultValue, options = {}) {
    checkedText("the name of param()", name);
    if (!["number", "boolean", "string"].includes(typeof defaultValue))
      throw new TypeError(`the default of param("${name}") is ${describe(defaultValue)}; a number, ` +
                          "a boolean or a string is wanted");
    if (typeof defaultValue === "number") checkNumber(`the default of param("${name}")`, defaultValue);
    const {min = -Infinity, max = Infinity} = checkedObject("the third argument of param()", options);
    if (params.includes(name))
      throw new Error(`param("${name}") is called twice; keep its value in a variable`);
    if (typeof defaultValue === "number" && (defaultValue < min || defaultValue > max))
      throw new RangeError(`the default of param("${name}") is ${defaultValue}; it must lie from ` +
                           `${min} to ${max}`);
    params.push(name);
    if (!overrides.has(name)) return defaultValue;
    const value = fromText(name, overrides.get(name), defaultValue);
    if (typeof value === "number" && (value < min || value > max))
      throw new RangeError(`script.${name} is ${value}; it must lie from ${min} to ${max}`);
    return value;
  }

  function print(...values) {
    host.print(values.map(value => typeof value === "object" && value !== null && !handles.has(value)
                                       ? stringify(value) : String(value)).join(" "));
  }

  // Mulberry32: a small generator with 32 bits of state, the same everywhere.
  let state = host.seed | 0;
  Math.random = function random() {
    state = (state + 0x6D2B79F5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  for (const name of ["Date", "Intl", "performance", "WeakRef", "FinalizationRegistry",
                      "SharedArrayBuffer", "Atomics", "WebAssembly", "console"]) {
    delete globalThis[name];
    Object.defineProperty(globalThis, name, {
      configurable: true,
      get() {
        throw new ReferenceError(`${name} is not there: a pipeline script has no clock, no locale ` +
                                 "and no threads, so that the same input gives the same pipeline");
      },
    });
  }
  for (const type of [Number, String, Array, Object, BigInt])
    type.prototype.toLocaleString = type.prototype.toString;
  Object.assign(globalThis, {pass, pipeline, param, print});

  return () => stringify({
    pipeline: {lucerna: "pipeline/1", ...header, passes: rows},
    places,
    params,
  });
})
