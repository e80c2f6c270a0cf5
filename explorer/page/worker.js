"use strict";
/* Curves, computed beside the page so that no frame is lost. solver.js stands before this text. */

let solvers, wheel, rail;

function curve(state, method, sweep) {
  const solver = solvers[method], found = { x: [], results: {} };
  solver.profiles(wheel, rail);
  for (const [name] of solver.bundle.results) found.results[name] = [];
  for (let i = 0; i < sweep.count; i++) {
    const x = sweep.low + (sweep.high - sweep.low) * i / (sweep.count - 1);
    apply(solver, { ...state, values: { ...state.values, [sweep.name]: x } }, method);
    const answer = solver.solve();
    found.x.push(x);
    for (const [name] of solver.bundle.results)
      found.results[name].push(answer.failed ? NaN : solver.get(name) * solver.bundle.variables[name].factor);
  }
  return found;
}

onmessage = ({ data }) => {
  if (data.bundle) {
    const module = new WebAssembly.Module(bytes(data.bundle.wasm)); // a page from a file may not share its own module
    solvers = [0, 1].map(() => new Solver(module, data.bundle));
    return;
  }
  [wheel, rail] = [data.wheel, data.rail];
  const lines = {};
  for (const sweep of data.sweeps)
    lines[sweep.name] = data.state.methods.map((_, method) => curve(data.state, method, sweep));
  postMessage({ number: data.number, lines });
};
