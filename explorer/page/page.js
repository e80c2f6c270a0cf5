"use strict";
/* Controls, state and frames of the page. */

const $ = id => document.getElementById(id);
const bundle = JSON.parse($("bundle").textContent);
const own = { wheel: {}, rail: {} }; // profiles that the user has opened
const SWEEPS = [
  { name: "pose.y", canvas: "shift", choice: "over-shift", low: -8, high: 8, count: 81, title: "lateral shift [mm]" },
  { name: "creepage", canvas: "creepage", choice: "over-creepage", low: -2, high: 2, count: 81, title: "longitudinal creepage [%], positive brakes" },
];
const MORE = new Set(["pose.roll", "rail.inclination", "friction.kinetic", "friction.half_speed", "resolution.n_strips",
  "resolution.n_elements", "patches.surface", "friction.law", "friction.velocity"]);

function startState() {
  const starts = doubles(bundle.start), values = {};
  const value = name => {
    const row = bundle.variables[name], start = starts[row.at];
    return row.items.length ? row.items[start - 1][0] : start * row.factor;
  };
  for (const [name] of bundle.sliders) values[name] = name === "creepage" ? 0 : value(name);
  for (const [name] of bundle.choices) if (!name.startsWith("method.")) values[name] = value(name);
  values["pose.y"] = 1;
  return { wheel: "S1002", rail: "60E1", values, methods: [{ normal: value("method.normal"), tangential: value("method.tangential") }],
    map: "traction", shift: "force.y", creepage: "force.x" };
}

let state = startState(), dirty = true, lines = {}, asked = 0, answered = 0, solvers, left, worker, answers = [[], []];
const SECOND = { normal: "analyn", tangential: "fastrip" };

/* The state as a link: only what differs from the start. */
function write() {
  const start = startState(), parts = new URLSearchParams();
  for (const name of ["wheel", "rail", "map", "shift"])
    if (state[name] !== start[name] && !(own[name] && own[name][state[name]])) parts.set(name, state[name]);
  if (state.creepage !== start.creepage) parts.set("over-creepage", state.creepage);
  for (const [name, value] of Object.entries(state.values)) if (value !== start.values[name]) parts.set(name, value);
  state.methods.forEach((method, k) => {
    if (k || JSON.stringify(method) !== JSON.stringify(start.methods[0])) parts.set(`method${k + 1}`, `${method.normal} ${method.tangential}`);
  });
  return parts.toString();
}

/* Read a link. What this page does not know is left out. */
function read(text) {
  const made = startState();
  for (const [name, value] of new URLSearchParams(text)) {
    const slider = bundle.sliders.find(row => row[0] === name), row = bundle.variables[name];
    const found = /^method([12])$/.exec(name);
    if (name === "slip" && Number.isFinite(Number(value))) made.values.creepage = -Number(value); // links of earlier versions
    else if (slider && Number.isFinite(Number(value))) made.values[name] = Math.min(Math.max(Number(value), slider[2]), slider[3]);
    else if (row && row.items.some(item => item[0] === value) && name in made.values) made.values[name] = value;
    else if (name === "wheel" && bundle.wheels[value] || name === "rail" && bundle.rails[value]) made[name] = value;
    else if (name === "map" && MAPS[value]) made.map = value;
    else if ((name === "shift" || name === "over-creepage") && bundle.results.some(row => row[0] === value)) made[name.replace("over-", "")] = value;
    else if (found) {
      const [normal, tangential] = value.split(" "), has = (name, item) => bundle.variables[name].items.some(row => row[0] === item);
      if (has("method.normal", normal) && has("method.tangential", tangential)) made.methods[found[1] - 1] = { normal, tangential };
    }
  }
  made.methods = [made.methods[0], ...made.methods.slice(1, 2)];
  return made;
}

const points = kind => own[kind][state[kind]] ?? doubles(bundle[kind + "s"][state[kind]]);

/* The link follows the state a few times a second, since browsers limit how often it may change. */
let linked = 0, linking;
function link() {
  clearTimeout(linking);
  const wait = linked + 250 - performance.now();
  if (wait > 0) { linking = setTimeout(link, wait); return; }
  linked = performance.now();
  history.replaceState(null, "", "#" + write());
}

function changed() {
  dirty = true;
  link();
}

function option(value, text, title) {
  const made = document.createElement("option");
  made.value = value;
  made.textContent = text;
  if (title) made.title = title;
  return made;
}

function select(id, items, get, set) {
  const made = $(id);
  made.replaceChildren(...items.map(([value, text, title]) => option(value, text ?? value, title)));
  made.value = get();
  made.onchange = () => { set(made.value); changed(); };
}

function labelled(parent, title, description, control) {
  const label = document.createElement("label");
  label.title = description;
  label.append(title, ...control);
  parent.append(label);
}

function controls() {
  for (const id of ["inputs", "more", "method-0", "method-1"]) $(id).replaceChildren();
  for (const [name, title, low, high, by] of bundle.sliders) {
    const row = bundle.variables[name], input = document.createElement("input"), shown = document.createElement("output");
    const unit = name === "creepage" ? "%" : row.unit, digits = Math.max(0, -Math.floor(Math.log10(by) + 1e-9));
    Object.assign(input, { type: "range", min: low, max: high, step: by, value: state.values[name], id: "input-" + name });
    const show = () => { shown.textContent = `${state.values[name].toFixed(digits)} ${unit}`; };
    input.oninput = () => { state.values[name] = Number(input.value); show(); changed(); };
    show();
    const description = row ? row.description : "Of the wheelset: the wheel turns slower (+, it brakes) or faster (-, it drives) than its nominal radius rolls. The creepage of a patch differs: aside of the middle the wheel rolls on another radius, so forces remain at 0 %";
    labelled($(MORE.has(name) ? "more" : "inputs"), title, description, [shown, input]);
  }
  const choice = (parent, name, title, get, set) => {
    const made = document.createElement("select");
    made.id = `${parent}-${name}`;
    labelled($(parent), title, bundle.variables[name].description, [made]);
    select(made.id, bundle.variables[name].items.map(item => [item[0], item[0], item[1]]), get, set);
  };
  for (const [name, title] of bundle.choices) {
    const part = name.split(".")[1];
    if (name.startsWith("method.")) state.methods.forEach((method, k) =>
      choice(`method-${k}`, name, title, () => method[part], value => { method[part] = value; }));
    else choice("more", name, title, () => state.values[name], value => { state.values[name] = value; });
  }
  for (const kind of ["wheel", "rail"])
    select(kind, [...Object.keys(bundle[kind + "s"]), ...Object.keys(own[kind])].map(name => [name]), () => state[kind], value => { state[kind] = value; });
  const results = bundle.results.map(([name, title]) => [name, title]);
  for (const sweep of SWEEPS) select(sweep.choice, results, () => state[sweep.canvas], value => { state[sweep.canvas] = value; });
  select("map", Object.entries(MAPS).map(([name, row]) => [name, row.title]), () => state.map, value => { state.map = value; });
  $("second").checked = state.methods.length > 1;
}

/* Whether the pressure of a method leaves larger gaps than it may (docs/check/limits.md). */
const gapTooLarge = k => solvers[k].get("gap_error") > bundle.gapLimits[state.methods[k].normal];

/* The places in the documentation's site, which is beside the page if a server has sent it. */
const inSite = location.protocol.startsWith("http");
const explained = new Set();

function explanation(text, page) {
  const link = page && inSite ? ` <a href="${page}" target="_top">equations</a>` : "";
  return `<tr class="why"><td colspan="3">${text}${link}</td></tr>`;
}

/* What stays in sight below the patch on a narrow screen: the first method's results with these symbols. */
const BRIEF = [["force.x", "Fx "], ["force.y", "Fy "], ["pressure.max", ""], ["patches.area", ""]];

function brief(answer) {
  const value = ([name, symbol]) => `${symbol}${short(bundle.variables[name].factor * solvers[0].get(name), 3)} ${bundle.variables[name].unit}`;
  return answer.failed ? answer.text : BRIEF.map(value).join(" · ") + (answer.untrusted ? ` (${answer.text})` : "");
}

function numbers(found) {
  $("brief").textContent = brief(found[0]);
  const names = state.methods.map(method => `${method.normal} + ${method.tangential}`);
  const head = names.map((name, k) => `<th class="${k ? "second" : "first"}">${name}</th>`).join("");
  const row = (title, cells, kind = "", name = "") => `<tr><th>${title}${name && ` <button class="ask" data-why="${name}" type="button" aria-expanded="${explained.has(name)}" aria-label="explain ${title}">?</button>`}</th>${cells.map(cell => `<td class="${kind} ${cell[1] ?? ""}">${cell[0]}</td>`).join("")}</tr>`;
  const rows = bundle.results.map(([name, title, text, page]) => {
    const { unit, factor } = bundle.variables[name];
    return row(title, found.map((answer, k) => [answer.failed ? "–" : `${short(factor * solvers[k].get(name), 4)} ${unit}`,
      name === "gap_error" && gapTooLarge(k) ? "bad" : ""]), "", name) + (explained.has(name) ? explanation(text, page) : "");
  });
  for (const [name, factor, unit] of [["longitudinal", 1e3, "‰"], ["lateral", 1e3, "‰"], ["spin", 1, "1/m"]])
    rows.push(row(`${name} creepage of patch 1`, found.map((answer, k) => [answer.failed ? "–" :
      `${(factor * solvers[k].get(`patch[].${name}`)).toFixed(3)} ${unit}`]), "", "creepages") + (name === "spin" && explained.has("creepages") ? explanation(...bundle.creepages) : ""));
  const doubt = k => gapTooLarge(k) ? "; the gap error is large: the largest pressure may be more than 5 % wrong" : "";
  const status = row("status", found.map((answer, k) => [answer.text + (answer.failed ? "" : doubt(k)), answer.failed || answer.untrusted ? "bad" : ""]), "status");
  const text = `<table><thead><tr><th></th>${head}</tr></thead><tbody>${rows.join("")}${status}</tbody></table>`;
  if (text === shownNumbers) return;
  shownNumbers = text;
  $("numbers").innerHTML = text;
}
let shownNumbers = "";

/* Ask for the curves: one question at a time, and not at every frame, so that a core is left for the frames. */
function ask() {
  if (!worker || asked > answered || waiting) return; // the newest state is asked when the answer comes
  const wait = askedAt + 100 - performance.now();
  if (wait > 0) { waiting = setTimeout(() => { waiting = 0; ask(); }, wait); return; }
  asked++;
  askedAt = performance.now();
  asking = write() + state.wheel + state.rail;
  worker.postMessage({ number: asked, state, wheel: points("wheel"), rail: points("rail"),
    name: state.wheel + "|" + state.rail, sweeps: SWEEPS.map(({ name, low, high, count }) => ({ name, low, high, count })) });
}
let asking = "", askedAt = 0, waiting = 0;

/* Whether a canvas already shows what follows from `key` at its size. */
function shows(canvas, ...key) {
  const now = [...key, canvas.clientWidth, window.devicePixelRatio, document.documentElement.dataset.theme], last = canvas.key ?? [];
  canvas.key = now;
  return now.length === last.length && now.every((part, i) => part === last[i]);
}

function drawCurves() {
  for (const sweep of SWEEPS) {
    const name = state[sweep.canvas], row = bundle.variables[name], title = bundle.results.find(result => result[0] === name)[1];
    if (shows($(sweep.canvas), lines[sweep.name], state.methods.length, name, state.values[sweep.name])) continue;
    const drawn = (lines[sweep.name] ?? []).slice(0, state.methods.length).map((line, k) => ({ x: line.x, y: line.results[name], dashed: k > 0 }));
    curves($(sweep.canvas), drawn, sweep.low, sweep.high, state.values[sweep.name], [sweep.title, row.unit ? `${title} [${row.unit}]` : title]);
  }
}

function drawConicity() {
  if (shows($("conicity"), lines.conicity?.[0].results.conicity, Math.abs(state.values["pose.y"]))) return;
  const drawn = (lines.conicity ?? []).map(line => ({ x: line.x, y: line.results.conicity }));
  curves($("conicity"), drawn, 0.5, 7, Math.abs(state.values["pose.y"]), ["amplitude [mm]", "equivalent conicity [-]"]);
}

let fresh = false, told = 0, untold; // numbers change ten times a second: nobody reads faster, and their table is laid out anew

function frame(now) {
  requestAnimationFrame(frame);
  if (dirty) draw();
  if (fresh) { drawCurves(); drawConicity(); }
  fresh = false;
  if (!untold || now - told < 100) return;
  numbers(untold); // after the canvases, which ask for their widths
  told = now;
  untold = undefined;
}

function draw() {
  dirty = false;
  const wheel = points("wheel"), rail = points("rail"), key = state.wheel + "|" + state.rail;
  const solve = (solver, state, k) => {
    if (solver.loaded !== key || own.wheel[state.wheel] || own.rail[state.rail]) { solver.profiles(wheel, rail); solver.loaded = key; }
    apply(solver, state, k);
    return solver.solve();
  };
  const found = state.methods.map((method, k) => {
    const answer = solve(solvers[k], state, k);
    answers[k] = solvers[k].patches();
    return answer;
  });
  solve(left, mirrored(state), 0);
  const shown = answers.slice(0, state.methods.length), boxes = shown.map(extent);
  const width = Math.max(18e-3, ...boxes.map(list => list.reduce((sum, box) => sum + box[1] - box[0] + 3e-3, 0)));
  const reach = Math.max(6e-3, ...boxes.flat().map(box => 1.08 * box[2])), scale = { width, reach, top: greatest(shown, state.map) };
  section($("section"), solvers[0], left, wheel, rail);
  state.methods.forEach((method, k) => {
    $(`title-${k}`).textContent = `${method.normal} + ${method.tangential}`;
    map($(`map-${k}`), answers[k], state.map, scale);
  });
  $("figure-1").hidden = state.methods.length < 2;
  drawCurves();
  drawConicity();
  untold = found;
  ask();
  window.last = { found, force: ["x", "y", "z"].map(axis => solvers[0].get("force." + axis)) }; // for the tests
}

function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function csv(id) {
  if (id === "conicity") {
    const line = (lines.conicity ?? [])[0] ?? { x: [], results: { conicity: [] } };
    const table = ["amplitude [mm],equivalent conicity [1]", ...line.x.map((x, i) => `${x},${line.results.conicity[i]}`)];
    return save("conicity.csv", new Blob([table.join("\n") + "\n"], { type: "text/csv" }));
  }
  const sweep = SWEEPS.find(row => row.canvas === id), rows = [`# wheelrail-contact ${bundle.version}, ${location.hash}`];
  if (sweep) {
    const unit = name => bundle.variables[name].unit || "1";
    const names = bundle.results.map(row => row[0]), shown = (lines[sweep.name] ?? []).slice(0, state.methods.length);
    rows.push([sweep.title, ...shown.flatMap((_, k) => names.map(name => `${name} [${unit(name)}] method ${k + 1}`))].join(","));
    (shown[0]?.x ?? []).forEach((x, i) => rows.push([x, ...shown.flatMap(line => names.map(name => line.results[name][i]))].join(",")));
  } else {
    rows.push("patch,y [m],x [m],dy [m],dx [m],pressure [Pa],qx [Pa],qy [Pa],sx [1],sy [1],stick,energy index [Pa]");
    answers[Number(id.slice(-1))].forEach((p, k) => {
      for (let i = 0; i < p.n; i++) for (let j = 0; j < p.m; j++) {
        const e = i * p.m + j;
        rows.push([k + 1, p.Y[i], p.X[e], p.DY[i], p.DX[e], p.P[e], p.QX[e], p.QY[e], p.SX[e], p.SY[e], p.STICK[e], p.ENERGY[e]].join(","));
      }
    });
  }
  save(`${id}.csv`, new Blob([rows.join("\n") + "\n"], { type: "text/csv" }));
}

/* Open a profile file. What was found in it stands beside the field. `kind` is null for a file that was dropped. */
async function open(file, kind) {
  const list = $("findings"), say = (text, bad) => {
    const item = document.createElement("li");
    item.textContent = text;
    if (bad) item.className = "bad";
    list.append(item);
  };
  list.replaceChildren();
  try {
    const found = readProfile(await file.arrayBuffer(), kind, bundle.rules), name = file.name.slice(0, 40);
    own[found.kind][name] = found.numbers;
    state[found.kind] = name;
    if (found.kind === "rail") state.values["rail.inclination"] = 0; // a file shows the rail as it lies
    say(`${file.name}: ${found.kind}, ${found.numbers[0]} points${found.findings.length ? "" : ", nothing found"}`);
    found.findings.forEach(text => say(text));
    controls();
    changed();
  } catch (error) {
    say(`${file.name}: ${error.message}`, true);
  }
}

function theme(name) {
  document.documentElement.dataset.theme = name;
  $("theme").textContent = name === "dark" ? "Light" : "Dark";
  dirty = true;
}

async function begin() {
  theme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  const module = await WebAssembly.compile(bytes(bundle.wasm));
  solvers = [0, 1].map(() => new Solver(module, bundle));
  left = new Solver(module, bundle);
  try {
    const code = $("solver").textContent + $("worker").textContent;
    worker = new Worker(URL.createObjectURL(new Blob([code], { type: "text/javascript" })));
    worker.onerror = event => { $("trouble").textContent = `No curves: ${event.message || "this browser allows no worker here"}.`; };
    worker.postMessage({ bundle });
    worker.onmessage = ({ data }) => {
      answered = data.number;
      lines = data.lines;
      fresh = true; // drawn with the next frame
      if (asking !== write() + state.wheel + state.rail) ask();
    };
  } catch (error) {
    worker = undefined;
    $("trouble").textContent = `No curves: ${error.message}.`;
  }
  state = read(location.hash.slice(1));
  controls();
  window.onresize = () => { dirty = true; };
  window.onhashchange = () => { state = read(location.hash.slice(1)); controls(); dirty = true; };
  $("theme").onclick = () => theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
  $("reset").onclick = () => { state = startState(); controls(); changed(); };
  $("link").onclick = async () => {
    history.replaceState(null, "", "#" + write());
    try { await navigator.clipboard.writeText(location.href); $("link").textContent = "Copied"; } catch { prompt("Link:", location.href); }
    setTimeout(() => { $("link").textContent = "Copy link"; }, 1500);
  };
  $("numbers").onclick = event => {
    const name = event.target.dataset.why;
    if (!name) return;
    if (!explained.delete(name)) explained.add(name);
    dirty = true;
  };
  $("second").onchange = () => { state.methods = $("second").checked ? [state.methods[0], { ...SECOND }] : [state.methods[0]]; controls(); changed(); };
  for (const button of document.querySelectorAll("[data-png]")) button.onclick = () => $(button.dataset.png).toBlob(blob => save(`${button.dataset.png}.png`, blob));
  for (const button of document.querySelectorAll("[data-csv]")) button.onclick = () => csv(button.dataset.csv);
  let kind = "wheel";
  for (const one of ["wheel", "rail"]) $(`open-${one}`).onclick = () => { kind = one; $("file").click(); };
  $("file").onchange = () => { if ($("file").files[0]) open($("file").files[0], kind); $("file").value = ""; };
  const drop = $("drop");
  drop.ondragover = event => { event.preventDefault(); drop.classList.add("over"); };
  drop.ondragleave = () => drop.classList.remove("over");
  drop.ondrop = event => {
    event.preventDefault();
    drop.classList.remove("over");
    const file = event.dataTransfer.files[0];
    if (file) open(file, null);
  };
  requestAnimationFrame(frame);
  window.ready = true;
}

begin().catch(error => { $("numbers").innerHTML = `<p class="bad">The page cannot start: ${error.message}</p>`; });
