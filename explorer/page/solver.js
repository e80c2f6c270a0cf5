"use strict";
/* The kernels on one piece of memory. The page and its worker use the same class. */

const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
const doubles = text => new Float64Array(bytes(text).buffer);

class Solver {
  /* `module` is the compiled WebAssembly.Module, `bundle` what explorer/bundle.py has written. */
  constructor(module, bundle) {
    this.bundle = bundle;
    this.exports = new WebAssembly.Instance(module, {}).exports;
    if (this.exports._initialize) this.exports._initialize();
    this.start = doubles(bundle.start);
    this.base = 0;
  }

  /* Read the profiles (arrays n, y, z, angle). Memory is laid out anew if they need more than before. */
  profiles(wheel, rail) {
    const need = wheel.length + rail.length;
    if (!this.base) {
      this.room = Math.max(need, 1e4);
      this.base = this.exports.allocate(this.start.length + this.bundle.room, this.room);
      this.values.set(this.start);
    }
    if (need > this.room) throw new Error("the profiles have too many points");
    const at = new Float64Array(this.exports.memory.buffer, this.exports.resources_at(), this.room);
    at.set(wheel);
    at.set(rail, wheel.length);
    this.stale = true;
  }

  /* The values of the table. Growing memory detaches earlier views, so one is made for each memory. */
  get values() {
    const { buffer } = this.exports.memory;
    if (this.view?.buffer !== buffer || this.view.byteOffset !== this.base)
      this.view = new Float64Array(buffer, this.base, this.start.length + this.bundle.room);
    return this.view;
  }

  set(name, value) {
    const row = this.bundle.variables[name], values = this.values;
    if (values[row.at] === value) return;
    values[row.at] = value;
    if (row.parameter) this.stale = true;
  }

  get(name, k = 0) { return this.values[this.bundle.variables[name].at + k]; }

  /* Solve from a cold start, so that an answer does not depend on earlier ones. Return {code, failed, text}. */
  solve() {
    let code = 0;
    if (this.stale) {
      code = this.exports.prepare();
      if (code < 0) throw new Error("there is no memory for this resolution");
      this.stale = code !== 0;
    }
    if (!code) {
      this.exports.forget();
      code = this.exports.solve();
    }
    const failure = this.bundle.failures[code], status = this.bundle.variables.status.items[code - 1];
    this.failed = failure !== undefined;
    return { code, failed: this.failed, untrusted: this.bundle.untrusted.includes(code),
             text: failure ?? (status ? `${status[0]}: ${status[1]}` : `code ${code}`) };
  }

  /* Strips and fields of patch k: n strips, m elements, one array for each row. */
  patch(k) {
    const n = this.exports.patch(k), m = this.get("resolution.n_elements"), values = this.values;
    const found = { n, m, angle: this.get("patch[].angle", k), load: this.get("patch[].n", k) };
    let at = this.start.length;
    for (const row of this.bundle.stripRows) { found[row] = values.slice(at, at + n); at += n; }
    for (const row of this.bundle.fieldRows) { found[row] = values.slice(at, at + n * m); at += n * m; }
    return found;
  }

  patches() {
    if (this.failed) return [];
    const found = [], count = Math.min(this.get("patches.count"), 3);
    for (let k = 0; k < count; k++) { const one = this.patch(k); if (one.n > 0) found.push(one); }
    return found;
  }
}

/* Inputs and parameters that follow from the state of the page. `method` is 0 or 1. The sign of the creepage is the library's. */
function apply(solver, state, method) {
  const variables = solver.bundle.variables;
  for (const [name, value] of Object.entries(state.values)) {
    if (name === "creepage") continue;
    const row = variables[name];
    if (row.items.length) solver.set(name, row.items.findIndex(item => item[0] === value) + 1);
    else solver.set(name, value / row.factor);
  }
  for (const name of ["method.normal", "method.tangential"]) {
    const chosen = state.methods[method][name.split(".")[1]];
    solver.set(name, variables[name].items.findIndex(item => item[0] === chosen) + 1);
  }
  const speed = solver.get("velocity.x");
  solver.set("velocity.spin", -speed / solver.get("wheel.radius") * (1 - state.values.creepage / 100));
}

/* The state of the left wheel, as the mirror image that the kernels solve. */
function mirrored(state) {
  const values = { ...state.values };
  for (const name of ["pose.y", "pose.roll", "pose.yaw"]) values[name] = -values[name];
  return { ...state, values };
}

if (typeof module !== "undefined") module.exports = { Solver, apply, doubles, bytes };
