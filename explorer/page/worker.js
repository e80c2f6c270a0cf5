"use strict";
/* Curves, computed beside the page so that no frame is lost. solver.js stands before this text. */

let solvers, wheel, rail, known, cones;
const made = {}; // curves of the last question, which hold while nothing but their own variable changes

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

/* Radius at the contact of the right wheel [m] over its shift y [m], without yaw and roll, under a small load. */
function radii(state, reach, count) {
  const solver = solvers[0], found = { y: [], radius: [] };
  const values = { ...state.values, "pose.yaw": 0, "pose.roll": 0, creepage: 0, "load.normal_force": 1 };
  for (let i = 0; i < count; i++) {
    const y = reach * (2 * i / (count - 1) - 1);
    apply(solver, { ...state, values: { ...values, "pose.y": 1e3 * y } }, 0);
    const answer = solver.solve();
    let most = -1, place = NaN;
    for (let k = 0; !answer.failed && k < Math.min(solver.get("patches.count"), 3); k++) {
      const load = solver.get("patch[].n", k);
      if (load > most) [most, place] = [load, solver.get("patch[].wheel_z", k)];
    }
    found.y.push(y);
    found.radius.push(place);
  }
  return found;
}

/* Equivalent conicity [-] over the amplitude [m] (EN 15302): that of the cones whose wheelset has the same wavelength.
   A wheelset that rolls slowly moves as y'' = -Δr(y)/(2 b r0). With b r0 = 1 a cone γ has the quarter wave π/(2√γ). The two
   rails are mirror images, so Δr(y) = r(y) - r(-y), and y = Y sin u takes the square root's end away. */
function conicity({ y, radius }, amplitudes) {
  const n = y.length, middle = (n - 1) / 2, by = y[1] - y[0], energy = [0];
  const force = i => (radius[middle + i] - radius[middle - i]) / 2; // of y'' = -force
  for (let i = 1; i <= middle; i++) energy.push(energy[i - 1] + by * (force(i) + force(i - 1)) / 2);
  const at = amplitude => {
    const i = Math.min(middle - 1, Math.floor(amplitude / by)), t = amplitude / by - i;
    return energy[i] + by * t * (force(i) + 0.5 * t * (force(i + 1) - force(i)));
  };
  return amplitudes.map(amplitude => {
    const top = at(amplitude), count = 400;
    let quarter = 0;
    for (let k = 0; k < count; k++) {
      const u = Math.PI / 2 * (k + 0.5) / count;
      quarter += Math.PI / 2 / count * amplitude * Math.cos(u) / Math.sqrt(2 * (top - at(amplitude * Math.sin(u))));
    }
    return (Math.PI / (2 * quarter)) ** 2;
  });
}

globalThis.onmessage = ({ data }) => {
  if (data.bundle) {
    const module = new WebAssembly.Module(bytes(data.bundle.wasm)); // a page from a file may not share its own module
    solvers = [0, 1].map(() => new Solver(module, data.bundle));
    return;
  }
  [wheel, rail] = [data.wheel, data.rail];
  const lines = {}, print = points => points.reduce((sum, value, i) => sum + (i % 97 + 1) * value, 0);
  for (const sweep of data.sweeps) {
    const { [sweep.name]: _, ...values } = data.state.values;
    const key = JSON.stringify([values, data.state.methods, data.name, print(wheel), print(rail)]);
    if (made[sweep.name]?.key !== key) made[sweep.name] = { key, curves: data.state.methods.map((_, method) => curve(data.state, method, sweep)) };
    lines[sweep.name] = made[sweep.name].curves;
  }
  const amplitudes = Array.from({ length: 27 }, (_, i) => 0.5 + 0.25 * i); // [mm]
  const shape = JSON.stringify([data.state.values["rail.inclination"], wheel[0], rail[0], wheel[1], rail[1]]) + data.name;
  if (shape !== known) [known, cones] = [shape, conicity(radii(data.state, 8e-3, 161), amplitudes.map(a => a / 1e3))];
  lines.conicity = [{ x: amplitudes, results: { conicity: cones } }];
  postMessage({ number: data.number, lines });
};

if (typeof module !== "undefined") module.exports = { conicity };
