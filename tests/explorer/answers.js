"use strict";
/* Solve the states of a JSON file with the classes of the page: node answers.js PAGE STATES. Print one answer a line. */

const fs = require("fs"), path = require("path");
const [page, states] = process.argv.slice(2);
const { Solver, apply, doubles, bytes } = require(path.join(__dirname, "../../explorer/page/solver.js"));
const bundle = JSON.parse(/<script id="bundle" type="application\/json">(.*?)<\/script>/s.exec(fs.readFileSync(page, "utf8"))[1]);
const module_ = new WebAssembly.Module(bytes(bundle.wasm));
if (WebAssembly.Module.imports(module_).length) throw new Error("the module imports something");
const solver = new Solver(module_, bundle);
for (const state of JSON.parse(fs.readFileSync(states, "utf8"))) {
  solver.profiles(doubles(bundle.wheels[state.wheel]), doubles(bundle.rails[state.rail]));
  apply(solver, state, 0);
  const { code } = solver.solve(), patches = solver.patches();
  console.log(JSON.stringify({
    code,
    force: ["x", "y", "z"].map(axis => solver.get("force." + axis)),
    moment: ["x", "y", "z"].map(axis => solver.get("moment." + axis)),
    pressure: solver.get("pressure.max"),
    patches: patches.map(p => ({ strips: p.n, loads: solver.get("patch[].n", patches.indexOf(p)),
      sum: p.P.reduce((total, value, e) => total + value * p.DX[e] * p.DY[Math.floor(e / p.m)], 0) })),
  }));
}
