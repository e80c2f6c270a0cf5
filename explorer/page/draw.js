"use strict";
/* Drawing on canvases: the section, the maps of the patches, curves. Lengths are in m, forces in N. */

/* Viridis (matplotlib, CC0) at eleven places. */
const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725"]
  .map(text => [0, 2, 4].map(at => parseInt(text.slice(at, at + 2), 16)));
const COLOURS = Array.from({ length: 256 }, (_, i) => {
  const t = i / 255 * (VIRIDIS.length - 1), k = Math.min(VIRIDIS.length - 2, Math.floor(t));
  return VIRIDIS[k].map((c, j) => Math.round(c + (VIRIDIS[k + 1][j] - c) * (t - k)));
});
/* The same as pixels of an image, opaque; byte 3 is the opacity. */
const pixel = ([red, green, blue]) => (red | green << 8 | blue << 16 | 255 << 24) >>> 0;
const PIXELS = Uint32Array.from(COLOURS, pixel);

/* Colours of the page, which follow light and dark. The browser is asked once for each theme, not once for each stroke. */
const inks = {};
function ink(name) {
  const key = document.documentElement.dataset.theme + name;
  return inks[key] ??= getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

/* Size a canvas for the screen and clear it. Return the context, width and height in CSS pixels. */
function fit(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth || 400;
  const height = Math.round(width * Number(canvas.dataset.ratio));
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    canvas.style.height = height + "px";
  }
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.fillStyle = ink("paper");
  g.fillRect(0, 0, width, height);
  g.font = "12px system-ui, sans-serif";
  g.textBaseline = "alphabetic";
  g.textAlign = "left";
  return [g, width, height];
}

/* A round number of 1, 2 or 5 times a power of ten, so that `range` holds about five of it. */
function step(range) {
  const raw = range / 5, ten = 10 ** Math.floor(Math.log10(raw));
  return ten * (raw / ten < 1.5 ? 1 : raw / ten < 3.5 ? 2 : raw / ten < 7.5 ? 5 : 10);
}

/* A number with `digits` significant digits, without an exponent if it is not very small. */
const short = (value, digits) => Number(value.toPrecision(digits)).toString();

const plain = (value, by) => Number(value.toFixed(Math.max(0, 1 - Math.floor(Math.log10(by) + 1e-9)))).toString();

/* Most nodes of a drawn profile; a pixel holds about one of them. */
const MOST_NODES = 300;

/* Nodes [y, z] of a profile, every n-th if there are many, with the ends. */
function nodesOf(points) {
  const n = points[0], by = Math.max(1, Math.ceil(n / MOST_NODES)), nodes = [];
  for (let i = 0; i < n - 1; i += by) nodes.push([points[1 + i], points[1 + n + i]]);
  nodes.push([points[n], points[2 * n]]);
  return nodes;
}

function pathOf(nodes) {
  const path = new Path2D();
  nodes.forEach(([y, z], i) => i ? path.lineTo(y, z) : path.moveTo(y, z));
  return path;
}

/* What is drawn of a profile is made once for each place of it, not once for each frame. */
const drawn = new WeakMap();
function kept(points, key, make) {
  const last = drawn.get(points);
  if (last && last.key === key) return last;
  const made = { key, ...make(points) };
  drawn.set(points, made);
  return made;
}

/* Place the rail in the track: turned by its inclination, its top at z = 0, the gauge at its depth. Return outline, area and middle. */
function railShape(points, solver) {
  const turn = -Math.atan(solver.get("rail.inclination")), depth = solver.get("track.gauge_point"), gauge = solver.get("track.gauge");
  return kept(points, [turn, depth, gauge].join(), () => {
    const c = Math.cos(turn), s = Math.sin(turn), n = points[0], all = [];
    for (let i = 0; i < n; i++) all.push([c * points[1 + i] - s * points[1 + n + i], s * points[1 + i] + c * points[1 + n + i]]);
    const top = all.reduce((least, node) => Math.min(least, node[1]), Infinity), crown = all.findIndex(node => node[1] === top);
    let k = crown;
    while (k > 0 && all[k][1] - top < depth) k--;
    const [y0, z0] = all[k], [y1, z1] = all[k + 1];
    const shift = gauge / 2 - (y0 + (y1 - y0) * (depth + top - z0) / (z1 - z0));
    const nodes = nodesOf(points).map(([y, z]) => [c * y - s * z + shift, s * y + c * z - top]);
    const line = pathOf(nodes), area = pathOf([...nodes, [nodes[nodes.length - 1][0], 1], [nodes[0][0], 1]]);
    return { line, area, middle: all.reduce((sum, node) => sum + node[0], 0) / n + shift };
  });
}

/* Draw both wheels on their rails, seen from behind. `left` has solved the mirror image of the left side. */
function section(canvas, right, left, wheel, rail) {
  const [g, width, height] = fit(canvas);
  half(g, left, wheel, rail, { x: 0, width: width / 2 - 4, height, side: -1, name: "left" });
  half(g, right, wheel, rail, { x: width / 2 + 4, width: width / 2 - 4, height, side: 1, name: "right" });
  bar(g, 8, height - 10, (width / 2 - 4) / 0.105 * 0.01, "10 mm");
}

/* Draw one wheel on its rail in `box`. The right side is drawn as it is, the left one mirrored. */
function half(g, solver, wheel, rail, box) {
  const shape = railShape(rail, solver), middle = shape.middle, scale = box.width / 0.105, centre = box.x + box.width / 2;
  const px = y => centre + box.side * scale * (y - middle), pz = z => 0.5 * box.height + scale * z;
  g.save();
  g.beginPath();
  g.rect(box.x, 0, box.width, box.height);
  g.clip();
  g.save(); // in metres of the track
  g.transform(box.side * scale, 0, 0, scale, px(0), pz(0));
  g.fillStyle = ink("steel");
  g.fill(shape.area);
  g.strokeStyle = ink("text");
  g.lineWidth = 1.4 / scale;
  g.stroke(shape.line);
  if (!solver.failed) {
    const roll = solver.get("pose.roll"), c = Math.cos(roll), s = Math.sin(roll), radius = solver.get("wheel.radius");
    g.transform(c, s, -s, c, solver.get("pose.y"), solver.get("wheelset.z") - radius);
    g.translate(solver.get("wheel.flange_back") / 2 + solver.bundle.tape, radius);
    g.strokeStyle = ink("wheel");
    g.lineWidth = 2 / scale;
    g.stroke(kept(wheel, "", () => ({ line: pathOf(nodesOf(wheel)) })).line);
  }
  g.restore();
  g.fillStyle = ink("faint");
  g.textAlign = "center";
  g.fillText(box.name, centre, 16);
  g.textAlign = "left";
  const count = solver.failed ? 0 : Math.min(solver.get("patches.count"), 3);
  for (let k = 0; k < count; k++) {
    const load = solver.get("patch[].n", k);
    if (!(load > 0)) continue;
    const y = px(solver.get("patch[].y", k)), z = pz(solver.get("patch[].z", k)), angle = solver.get("patch[].angle", k);
    const length = 14 + 50 * load / solver.get("load.normal_force");
    g.strokeStyle = g.fillStyle = ink("mark");
    g.lineWidth = 2.5;
    g.beginPath(); g.moveTo(y, z); g.lineTo(y + box.side * length * Math.sin(angle), z - length * Math.cos(angle)); g.stroke();
    g.beginPath(); g.arc(y, z, 4, 0, 7); g.fill();
    const inwards = solver.get("patch[].y", k) > 0 ? -angle : angle;  // positive: the rail pushes the wheel to the track's centre
    g.fillText(`${k + 1}: ${(load / 1e3).toFixed(1)} kN at ${(inwards * 180 / Math.PI).toFixed(1)}°`, box.x + 8, 32 + 15 * k);
  }
  g.restore();
}

function bar(g, x, y, length, text) {
  g.fillStyle = ink("text");
  g.fillRect(x, y, length, 2);
  g.fillText(text, x, y - 5);
}

/* What a map shows: title, unit, factor of the unit shown, its value at an element, and whether it vanishes at the edge. */
const MAPS = {
  pressure: { title: "pressure", unit: "MPa", factor: 1e-6, at: (p, e) => p.P[e], vanishes: true },
  traction: { title: "traction", unit: "MPa", factor: 1e-6, at: (p, e) => Math.hypot(p.QX[e], p.QY[e]), sticks: true, vanishes: true },
  slip: { title: "slip over speed", unit: "‰", factor: 1e3, at: (p, e) => Math.hypot(p.SX[e], p.SY[e]), sticks: true },
  energy: { title: "energy index", unit: "MPa", factor: 1e-6, at: (p, e) => Math.max(p.ENERGY[e], 0) },
};

function extent(patches) {
  return patches.map(p => {
    let low = Infinity, high = -Infinity, reach = 0;
    for (let i = 0; i < p.n; i++) {
      low = Math.min(low, p.Y[i] - p.DY[i] / 2);
      high = Math.max(high, p.Y[i] + p.DY[i] / 2);
      reach = Math.max(reach, Math.abs(p.XC[i]) + p.A[i]);
    }
    return [low, high, reach];
  });
}

/* Where y lies among the strips: half length and centre there, both strips and the share of the second; null outside of all.
   The squares of half lengths are interpolated and vanish at the edges of a row of strips, so an ellipse stays one. */
function across(p, y) {
  let i = 0;
  while (i < p.n - 1 && y > p.Y[i + 1]) i++;
  const beyond = (k, edge) => {
    const share = (y - edge) / (p.Y[k] - edge);
    return share > 0 && share <= 1 ? { a: p.A[k] * Math.sqrt(share), x: p.XC[k], i: k, next: k, t: 0, fall: Math.sqrt(share) } : null;
  };
  if (y < p.Y[0]) return beyond(0, p.Y[0] - p.DY[0] / 2);
  const after = p.Y[i] + p.DY[i] / 2;
  if (i === p.n - 1) return beyond(i, after);
  const before = p.Y[i + 1] - p.DY[i + 1] / 2;
  if (before - after > 0.2 * p.DY[i]) return beyond(i, after) ?? beyond(i + 1, before); // two rows of strips
  const t = (y - p.Y[i]) / (p.Y[i + 1] - p.Y[i]), mix = row => row[i] + t * (row[i + 1] - row[i]);
  return { a: Math.sqrt(p.A[i] ** 2 + t * (p.A[i + 1] ** 2 - p.A[i] ** 2)), x: mix(p.XC), i, next: i + 1, t, fall: 1 };
}

/* Zones in stick of strip `i`, as [from, to] in `s`, which falls from the leading edge: 1 and -1 are the edges. An element sticks or slides.
   Between two of them lies the border b, where the margin to full friction ends: its square is (s - b) / (1 + s) in Carter's solution. */
function stickZones(p, i, s) {
  const first = i * p.m, zones = [], share = j => Math.hypot(p.QX[first + j], p.QY[first + j]) / p.P[first + j];
  const sticks = j => j >= 0 && j < p.m && p.STICK[first + j] > 0.5;
  const border = (inside, outside) => {
    const before = 2 * inside - outside, full = share(outside), margin = j => (1 + s[j]) * (1 - share(j) / full) ** 2;
    const part = sticks(before) ? margin(inside) / (margin(before) - margin(inside)) * (s[inside] - s[before]) / (s[outside] - s[inside]) : 0.5;
    return s[inside] + (part >= 0 && part <= 1 ? part : part > 1 ? 1 : 0.5) * (s[outside] - s[inside]);
  };
  for (let j = 0; j < p.m; j++) {
    if (!sticks(j)) continue;
    if (!sticks(j - 1)) zones.push([j ? border(j, j - 1) : 1, -1]);
    if (!sticks(j + 1) && j + 1 < p.m) zones[zones.length - 1][1] = border(j, j + 1);
  }
  return zones;
}

/* Zones at the share `t` of the way from one strip to the next. A zone that the other strip lacks ends there in a point, at the leading
   edge if it begins there, since stick shrinks towards that edge. */
function zonesBetween(one, other, t) {
  const point = ([from, to]) => from === 1 ? [1, 1] : [(from + to) / 2, (from + to) / 2];
  if (!one.length) one = other.map(point);
  if (!other.length) other = one.map(point);
  if (one.length !== other.length) return t < 0.5 ? one : other;
  return one.map((zone, k) => zone.map((end, q) => (1 - t) * end + t * other[k][q]));
}

/* One canvas for all patches: `smooth` fills it, its caller copies it at once. It only grows. */
let board;

/* Put the field of one patch, interpolated between strips and elements, on the board. `scale` is in pixels per m. Return its size. */
function smooth(p, box, scale, shown, top) {
  const width = Math.max(1, Math.round(scale * (box[1] - box[0]))), height = Math.max(1, Math.round(2 * scale * box[2]));
  board ??= document.createElement("canvas").getContext("2d", { willReadFrequently: true }); // in memory: pixels are set, not drawn
  if (board.canvas.width < width || board.canvas.height < height)
    Object.assign(board.canvas, { width: Math.max(width, board.canvas.width), height: Math.max(height, board.canvas.height) });
  const places = 256, first = new Uint16Array(places + 1), share = new Float64Array(places + 1), edge = new Float64Array(places + 1).fill(1);
  const image = board.createImageData(width, height), data = new Uint32Array(image.data.buffer), m = p.m, n = p.n;
  const s = Array.from({ length: m }, (_, j) => (p.X[j] - p.XC[0]) / p.A[0]); // falls from the leading edge; the same in all strips
  for (let q = 0, j = m - 1; q <= places; q++) {
    const at = -1 + 2 * q / places;
    while (j > 1 && s[j - 1] < at) j--;
    first[q] = Math.max(1, j);
    share[q] = m > 1 ? Math.min(1, Math.max(0, (at - s[first[q]]) / (s[first[q] - 1] - s[first[q]]))) : 0;
    const limit = at > s[0] ? s[0] : at < s[m - 1] ? s[m - 1] : null;
    if (shown.vanishes && limit !== null) edge[q] = Math.sqrt((1 - at * at) / (1 - limit * limit));
  }
  const values = Float64Array.from({ length: n * m }, (_, e) => shown.at(p, e)), unit = top > 0 ? 255 / top : 0;
  const grey = pixel(/^#(..)(..)(..)$/.exec(ink("stick")).slice(1).map(text => parseInt(text, 16)));
  const strip = new Float64Array(m + 1); // m + 1: the last one twice
  const zones = shown.sticks ? Array.from({ length: n }, (_, i) => stickZones(p, i, s)) : [];
  for (let column = 0; column < width; column++) {
    const place = across(p, box[0] + (column + 0.5) / scale);
    if (!place || !(place.a > 0)) continue;
    const { i, next, t, a, x } = place, one = i * m, other = next * m, fall = shown.vanishes ? unit * place.fall : unit;
    for (let j = 0; j <= m; j++) {
      const k = Math.min(j, m - 1);
      strip[j] = fall * ((1 - t) * values[one + k] + t * values[other + k]);
    }
    const sticking = shown.sticks ? zonesBetween(zones[i], zones[next], t) : [];
    const half = a * scale, centre = (box[2] - x) * scale - 0.5; // row of the middle
    const low = Math.max(0, Math.ceil(centre - half + 1e-9)), high = Math.min(height - 1, Math.floor(centre + half - 1e-9));
    for (let row = low; row <= high; row++) {
      const at = (centre - row) / half, q = Math.round((at + 1) * 0.5 * places), j = first[q], u = share[q];
      const inside = half - Math.abs(centre - row); // pixels to the edge, which is smooth
      let rgba = grey;
      if (!sticking.some(([from, to]) => at <= from && at >= to)) {
        const value = edge[q] * ((1 - u) * strip[j] + u * strip[j - 1]);
        rgba = PIXELS[value > 255 ? 255 : value < 0 ? 0 : (value + 0.5) | 0];
      }
      data[row * width + column] = inside < 1 ? (rgba & 0xffffff | (255 * inside) << 24) >>> 0 : rgba;
    }
  }
  board.putImageData(image, 0, 0);
  return [width, height];
}

/* Greatest value of a map over several answers, so that two methods share one scale. */
function greatest(answers, kind) {
  let top = 0;
  for (const patches of answers) for (const p of patches) for (let e = 0; e < p.n * p.m; e++) top = Math.max(top, MAPS[kind].at(p, e));
  return top;
}

/* Draw the patches side by side, rolling upwards. `frame` is {width, reach, top} shared by both methods. */
function map(canvas, patches, kind, frame) {
  const [g, width, height] = fit(canvas), shown = MAPS[kind], gap = 3e-3;
  if (!patches.length) { g.fillStyle = ink("faint"); g.textAlign = "center"; g.fillText("no contact", width / 2, height / 2); return; }
  const scale = Math.min((width - 16) / frame.width, (height - 64) / (2 * frame.reach)), boxes = extent(patches);
  const total = boxes.reduce((sum, box) => sum + box[1] - box[0] + gap, -gap), middle = (height - 34) / 2 + 4;
  let left = (width - scale * total) / 2;
  patches.forEach((p, k) => {
    const at = y => left + scale * (y - boxes[k][0]), up = x => middle - scale * x;
    const [wide, tall] = smooth(p, boxes[k], scale * (window.devicePixelRatio || 1), shown, frame.top);
    g.drawImage(board.canvas, 0, 0, wide, tall, left, up(boxes[k][2]), scale * (boxes[k][1] - boxes[k][0]), 2 * scale * boxes[k][2]);
    if (kind === "traction") arrows(g, p, at, up, frame.top);
    if (kind === "slip") arrows(g, { ...p, QX: p.SX, QY: p.SY }, at, up, frame.top);
    g.fillStyle = ink("text");
    g.textAlign = "center";
    g.fillText(`${k + 1}`, left + scale * (boxes[k][1] - boxes[k][0]) / 2, height - 36);
    g.textAlign = "left";
    left += scale * (boxes[k][1] - boxes[k][0] + gap);
  });
  bar(g, 8, height - 10, scale * 5e-3, "5 mm");
  g.fillStyle = ink("faint");
  g.fillText("↑ rolling", 8, 14);
  legend(g, width, height, shown, frame.top);
}

function arrows(g, p, at, up, top) {
  if (!(top > 0)) return;
  const everyI = Math.max(1, Math.round(p.n / 9)), everyJ = Math.max(1, Math.round(p.m / 9)), length = 22;
  g.strokeStyle = ink("arrow");
  g.lineWidth = 1.2;
  g.beginPath();
  for (let i = everyI >> 1; i < p.n; i += everyI) for (let j = everyJ >> 1; j < p.m; j += everyJ) {
    const e = i * p.m + j, qx = p.QX[e] / top, qy = p.QY[e] / top;
    if (Math.hypot(qx, qy) < 0.04) continue;
    const x0 = at(p.Y[i]), y0 = up(p.X[e]), x1 = x0 + length * qy, y1 = y0 - length * qx, a = Math.atan2(y1 - y0, x1 - x0);
    g.moveTo(x0, y0); g.lineTo(x1, y1); g.lineTo(x1 - 4 * Math.cos(a - 0.5), y1 - 4 * Math.sin(a - 0.5));
    g.moveTo(x1, y1); g.lineTo(x1 - 4 * Math.cos(a + 0.5), y1 - 4 * Math.sin(a + 0.5));
  }
  g.stroke();
}

function legend(g, width, height, shown, top) {
  const size = Math.min(170, 0.42 * width), x = width - size - 10, y = height - 16;
  const shades = g.createLinearGradient(x, 0, x + size, 0);
  VIRIDIS.forEach((rgb, i) => shades.addColorStop(i / (VIRIDIS.length - 1), `rgb(${rgb})`));
  g.fillStyle = shades;
  g.fillRect(x, y, size, 8);
  g.fillStyle = ink("text");
  const value = shown.factor * top;
  g.textAlign = "right";
  g.fillText(`${short(value, 3)} ${shown.unit}`, x + size, y - 4);
  g.textAlign = "left";
  g.fillText("0", x, y - 4);
  if (shown.sticks) { g.fillStyle = ink("stick"); g.fillRect(x - 52, y, 10, 8); g.fillStyle = ink("text"); g.fillText("stick", x - 38, y + 8); }
}

/* Draw curves {x, y, dashed} over [low, high] with a marker at `now`. */
function curves(canvas, lines, low, high, now, titles) {
  const [g, width, height] = fit(canvas), left = 54, right = width - 10, top = 14, bottom = height - 36;
  let least = 0, most = 0;
  for (const line of lines) for (const y of line.y) if (Number.isFinite(y)) { least = Math.min(least, y); most = Math.max(most, y); }
  if (most - least < 1e-12) most = least + 1;
  const pad = 0.05 * (most - least), from = least < 0 ? least - pad : 0, to = most > 0 ? most + pad : 0;
  const px = x => left + (right - left) * (x - low) / (high - low), py = y => bottom - (bottom - top) * (y - from) / (to - from);
  g.strokeStyle = ink("line");
  g.fillStyle = ink("faint");
  g.lineWidth = 1;
  const sx = step(high - low), sy = step(to - from);
  g.textAlign = "center";
  for (let x = Math.ceil(low / sx - 1e-9) * sx; x <= high + 1e-9; x += sx) {
    g.beginPath(); g.moveTo(px(x), top); g.lineTo(px(x), bottom); g.stroke(); g.fillText(plain(x, sx), px(x), bottom + 14);
  }
  g.textAlign = "right";
  for (let y = Math.ceil(from / sy - 1e-9) * sy; y <= to + 1e-12; y += sy) {
    g.beginPath(); g.moveTo(left, py(y)); g.lineTo(right, py(y)); g.stroke(); g.fillText(plain(y, sy), left - 5, py(y) + 4);
  }
  g.textAlign = "center";
  g.fillStyle = ink("text");
  g.fillText(titles[0], (left + right) / 2, height - 6);
  g.save(); g.translate(13, (top + bottom) / 2); g.rotate(-Math.PI / 2); g.fillText(titles[1], 0, 0); g.restore();
  g.textAlign = "left";
  lines.forEach(line => {
    g.strokeStyle = ink(line.dashed ? "second" : "first");
    g.setLineDash(line.dashed ? [6, 4] : []);
    g.lineWidth = 2;
    g.beginPath();
    let drawing = false;
    line.x.forEach((x, i) => {
      if (!Number.isFinite(line.y[i])) { drawing = false; return; }
      if (drawing) g.lineTo(px(x), py(line.y[i])); else g.moveTo(px(x), py(line.y[i]));
      drawing = true;
    });
    g.stroke();
  });
  g.setLineDash([]);
  g.strokeStyle = ink("mark");
  g.lineWidth = 1.5;
  g.beginPath(); g.moveTo(px(now), top); g.lineTo(px(now), bottom); g.stroke();
}
