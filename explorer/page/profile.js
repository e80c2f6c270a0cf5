"use strict";
/* Profiles of users: from the text of a file to points in the right-side convention, with findings.
 *
 * The rules are those of contact/geometry/inspection.py and placing.py, with its numbers (`bundle.rules`). What `read` asks its
 * user for (unit, side, zero, repair) is found from the shape here, and each choice is a finding. tests/explorer compares. */

class ProfileError extends Error {}

const whichAreFalse = typeof require === "undefined" ? falseRows : require("./false_rows.js").falseRows;

const mm = value => `${Number((1e3 * value).toPrecision(3))} mm`;
const median = values => { const s = [...values].sort((a, b) => a - b), n = s.length; return n % 2 ? s[(n - 1) / 2] : 0.5 * (s[n / 2 - 1] + s[n / 2]); };
const distance = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]);
const sum = values => values.reduce((total, value) => total + value, 0);
const argmax = values => values.reduce((best, value, i) => value > values[best] ? i : best, 0);
const pathLength = points => sum(points.slice(1).map((p, i) => distance(p, points[i])));

/* The text of a file: UTF-8, UTF-16 with its mark, else Windows' letters; with plain signs for typographic ones. */
function textOf(content) {
  const bytes = new Uint8Array(content), mark = (a, b) => bytes[0] === a && bytes[1] === b;
  let text;
  if (mark(0xff, 0xfe) || mark(0xfe, 0xff)) text = new TextDecoder(mark(0xff, 0xfe) ? "utf-16le" : "utf-16be").decode(content);
  else try { text = new TextDecoder("utf-8", { fatal: true }).decode(content); } catch { text = new TextDecoder("latin1").decode(content); }
  return text.replace(/[\u2010-\u2014\u2212]/g, "-").replace(/[\u00a0\u2000-\u200a\u202f]/g, " ").replace(/[\u200b\ufeff]/g, "").replace(/[\u201c-\u201e]/g, '"');
}

/* Rows of two numbers or more, after any lines of text. Semicolons, tabs, blanks or commas separate; a comma may be decimal. */
function rowsOf(text, findings) {
  const rows = [];
  let left = 0;
  for (const line of text.split(/\r\n|\n|\r/)) {
    let bare = line.split(/[#!%]/)[0];
    if (bare.split('"').length % 2 === 0) bare = bare.split('"')[0]; // a quote without its partner begins a remark
    bare = bare.replaceAll('"', "").replace(/(\d)[dD]([+-]?\d)/g, "$1e$2").trim();
    if (!bare) continue;
    let words = bare.split(/[\s;]+/);
    if (words.length > 1 && words.every(word => /^[+-]?\d*,?\d*(e[+-]?\d+)?,?$/i.test(word)) && words.slice(0, 2).some(word => /,\d/.test(word)))
      words = words.map(word => word.replace(/,$/, "").replace(",", ".")); // decimal commas
    else words = bare.split(/[\s,;]+/);
    const row = words.filter(word => word !== "").slice(0, 2).map(Number);
    if (row.length === 2 && row.every(Number.isFinite)) rows.push(row);
    else if (rows.length === 1) rows.length = 0, left++; // the line belongs to the header, and so did the one before
    else if (rows.length) left++;
  }
  if (left) findings.push(`${left} line${left > 1 ? "s" : ""} without two numbers left out`);
  if (rows.length < 10) throw new ProfileError("a profile needs at least ten rows with two numbers, y and z");
  return rows;
}

/* The rows without those that are no points of the profile, like 0 0 or -999 -999 (false_rows.js). */
function trueRows(rows, findings) {
  const wrong = whichAreFalse(rows), left = rows.filter((_, i) => !wrong[i]), out = rows.filter((_, i) => wrong[i]);
  if (out.length) {
    const shown = out.slice(0, 3).map(row => row.join(" ")).join(", ");
    findings.push(`${out.length} of ${rows.length} rows are no points of the profile and left out: ${shown}${out.length > 3 ? " …" : ""}`);
  }
  if (left.length < 10) throw new ProfileError(`${left.length} rows are points of a profile; ten are needed`);
  return left;
}

/* Points in metres: the unit in which a wheel or a rail has a possible width. */
function inMetres(rows, rules, findings) {
  const y = rows.map(row => row[0]), width = Math.max(...y) - Math.min(...y);
  const found = Object.entries(rules.units).filter(([, size]) => rules.narrowest <= width * size && width * size <= rules.widest);
  const unlikely = ([, size]) => Math.abs(Math.log(width * size / rules.usual_width));
  found.sort((a, b) => unlikely(a) - unlikely(b));
  if (!found.length)
    throw new ProfileError(`the points are ${width.toPrecision(3)} wide; a wheel or a rail is ${mm(rules.narrowest)} to ${mm(rules.widest)} wide, and no unit of ${Object.keys(rules.units).join(", ")} makes that`);
  const [name, size] = found[0];
  if (name !== "mm") findings.push(`unit taken as ${name}, in which the profile is ${mm(width * size)} wide`);
  return rows.map(([a, b]) => [a * size, b * size]);
}

/* One scan in order: of several the one with the most points, of a scan there and back the longer way. */
function oneScan(points, rules, findings) {
  const y = points.map(p => p[0]), z = points.map(p => p[1]);
  const extent = Math.hypot(Math.max(...y) - Math.min(...y), Math.max(...z) - Math.min(...z)), parts = [[points[0]]];
  for (let i = 1; i < points.length; i++) {
    if (distance(points[i], points[i - 1]) > rules.jump * extent) parts.push([]);
    parts[parts.length - 1].push(points[i]);
  }
  const scans = parts.filter(part => part.length > 2);
  if (!scans.length || scans.length > rules.most_scans || Math.max(...scans.map(pathLength)) > rules.loops * extent)
    throw new ProfileError("the rows are not in order along the profile; contact check FILE shows them, repair=True sorts them");
  if (scans.length > 1) {
    findings.push(`the points run over the profile ${scans.length} times; the scan with the most points is kept`);
    points = scans.reduce((best, part) => part.length > best.length ? part : best);
  }
  const far = argmax(points.map(p => distance(p, points[0]))), last = points[points.length - 1];
  if (distance(last, points[far]) > rules.jump * distance(points[far], points[0]) && points.length - 1 - far > rules.return * points.length) {
    findings.push(`after ${far + 1} of ${points.length} points the scan comes back; the longer way is kept`);
    points = far + 1 >= points.length - far ? points.slice(0, far + 1) : points.slice(far);
  }
  return points;
}

/* What points look like, whichever way they lie: [wheel, rail or null, whether z points down]. */
function appearance(points, rules) {
  const y = points.map(p => p[0]), low = Math.min(...y), width = Math.max(...y) - low;
  for (const sign of [1, -1]) {
    const height = points.map(p => sign * p[1]), top = argmax(height), share = (y[top] - low) / width;
    const left = height[top] - Math.min(...height.slice(0, top + 1)), right = height[top] - Math.min(...height.slice(top));
    const nearAnEnd = Math.min(share, 1 - share) < rules.tip_share;
    if (nearAnEnd && Math.min(left, right) > rules.tip_rise && height[top] > median(height) + rules.flange) {
      const beyond = share < 0.5 ? height.slice(top) : height.slice(0, top + 1).reverse();
      return [beyond[beyond.length - 1] - Math.min(...beyond) > rules.head_drop ? "rail" : "wheel", sign > 0];
    }
    if (!nearAnEnd && Math.min(left, right) > rules.head_drop) return ["rail", sign < 0];
  }
  return [null, true];
}

/* Points from the gauge or flange side to the field side, z down, about the library's zero. */
function placed(points, kind, rules, findings) {
  const [, down] = appearance(points, rules), heights = points.map(p => p[1]);
  const grooved = kind === "rail" && sum(heights) / heights.length > median(heights);
  if (!down && !grooved) {
    findings.push("z pointed up: turned");
    points = points.map(([y, z]) => [y, -z]);
  }
  const y = points.map(p => p[0]), deepest = argmax(points.map(p => p[1]));
  if (y[deepest] > 0.5 * (Math.min(...y) + Math.max(...y))) {
    findings.push(`y pointed to the inside: mirrored, as the ${kind} of a left side is`);
    points = points.map(([a, z]) => [-a, z]);
  }
  if (points[0][0] > points[points.length - 1][0]) points = [...points].reverse();
  return points.filter((p, i) => !i || distance(p, points[i - 1]) > rules.nearest);
}

/* Drop points that step back against the chord around them. */
function withoutBackSteps(points, findings) {
  let dropped = 0;
  for (let round = 0; round < 20; round++) {
    const n = points.length, at = i => points[Math.min(Math.max(i, 0), n - 1)];
    const around = points.map((_, i) => [at(i + 2)[0] - at(i - 2)[0], at(i + 2)[1] - at(i - 2)[1]]);
    const kept = points.filter((p, i) => !i || n - dropped < 10 ||
      (p[0] - points[i - 1][0]) * (around[i][0] + around[i - 1][0]) + (p[1] - points[i - 1][1]) * (around[i][1] + around[i - 1][1]) >= 0);
    if (kept.length === n) break;
    dropped += n - kept.length;
    points = kept;
  }
  if (dropped) findings.push(`${dropped} point${dropped > 1 ? "s" : ""} stepping back along the profile dropped`);
  return points;
}

/* Move a profile to the library's zero. The gauge of the track places a rail, so only its height counts. */
function aboutZero(points, kind, rules, findings) {
  if (kind === "rail") {
    const top = Math.min(...points.map(p => p[1]));
    return points.map(([y, z]) => [y, z - top]);
  }
  const tip = argmax(points.map(p => p[1]));
  if (!(points[tip][1] > median(points.map(p => p[1])) + rules.flange)) {
    findings.push("no flange found: the file's own zero is kept, which must be the tape circle");
    return points;
  }
  const aside = points[tip][0] + rules.tip_from_tape;
  let shift = 0;
  if (Math.abs(points[tip][0] - rules.flange_back + rules.tip_from_tape) <= rules.side) shift = rules.flange_back;
  else if (Math.abs(aside) > rules.side) shift = aside;
  if (shift) findings.push(`moved by ${mm(-shift)} across: the flange's tip lies ${mm(rules.tip_from_tape)} inside the tape circle`);
  points = points.map(([y, z]) => [y - shift, z]);
  const outside = points.slice(tip), k = outside.findIndex(p => p[0] >= 0);
  if (k < 1) throw new ProfileError("the tape circle, 55 mm outside the flange's tip, is not on the profile");
  const [[y0, z0], [y1, z1]] = [outside[k - 1], outside[k]], tread = z0 + (z1 - z0) * -y0 / (y1 - y0);
  if (Math.abs(tread) <= rules.height) return points;
  findings.push(`moved by ${mm(-tread)} in height: the tread at the tape circle lies at z = 0`);
  return points.map(([y, z]) => [y, z - tread]);
}

/* What is said of a profile that is turned, as the library's `inspection.turned` finds it. */
function turned(points, kind, rules, findings) {
  const z = points.map(p => p[1]), top = argmax(z.map(v => -v));
  let middle = 0; // of a wheel its tape circle, which is at 0 by now
  if (kind === "rail") {
    const gauge = points.slice(0, top).findLastIndex(p => p[1] > z[top] + rules.gauge_depth);
    middle = gauge >= 0 ? points[gauge][0] + rules.crown_from_gauge : (points[0][0] + points[points.length - 1][0]) / 2;
    const field = Math.max(...z.slice(top)) > z[top] + rules.head_drop; // the field side is there: a head may be narrower
    if (gauge >= 0 && field) middle = Math.min(middle, (points[gauge][0] + Math.max(...points.map(p => p[0]))) / 2);
  }
  const [low, high] = rules.slope_between[kind].map(end => middle + end), inside = points.filter(([y]) => y > low && y < high);
  if (inside.length < 5 || inside[inside.length - 1][0] - inside[0][0] < 0.8 * (high - low)) return;
  const mean = axis => sum(inside.map(p => p[axis])) / inside.length, [my, mz] = [mean(0), mean(1)];
  const slope = Math.atan(sum(inside.map(([a, b]) => (a - my) * (b - mz))) / sum(inside.map(([a]) => (a - my) ** 2)));
  if (Math.abs(slope - rules.usual_slope[kind]) <= rules.turned_by[kind]) return;
  const [part, usual] = kind === "wheel" ? ["tread", "it rises by 1 to 3°"] : ["top", "it is level within 3°"];
  findings.push(`turned? the ${part} ${slope > 0 ? "falls" : "rises"} by ${(Math.abs(slope) * 180 / Math.PI).toFixed(1)}° to the field side, usually ${usual}`);
}

/* Root mean square of the noise across the profile: the rest beside local cubics through nine points. */
function noiseOf(points) {
  const rests = [];
  for (let i = 0; i + 9 <= points.length; i++) {
    const window = points.slice(i, i + 9), [p, q] = [window[0], window[8]], length = distance(p, q);
    if (!length) continue;
    const [cy, cz] = [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
    const u = window.map(w => (cy * (w[0] - p[0]) + cz * (w[1] - p[1])) / length);
    const v = window.map(w => cy * (w[1] - p[1]) - cz * (w[0] - p[0]));
    const basis = [];
    for (let power = 0; power < 4; power++) { // Gram and Schmidt, twice
      let column = u.map(value => value ** power);
      for (let twice = 0; twice < 2; twice++) for (const other of basis) {
        const part = sum(column.map((value, k) => value * other[k]));
        column = column.map((value, k) => value - part * other[k]);
      }
      const size = Math.hypot(...column);
      if (size > 1e-12) basis.push(column.map(value => value / size));
    }
    let rest = [...v];
    for (const other of basis) { const part = sum(v.map((value, k) => value * other[k])); rest = rest.map((value, k) => value - part * other[k]); }
    rests.push(sum(rest.map(value => value * value)));
  }
  return rests.length ? Math.sqrt(median(rests) / 4.35) : 0; // median of χ² with 5 degrees of freedom
}

/* Replace noisy points by local parabolas over `length` of arc. */
function smoothed(points, length) {
  const arc = [0];
  for (let i = 1; i < points.length; i++) arc.push(arc[i - 1] + distance(points[i], points[i - 1]));
  return points.map((_, i) => [0, 1].map(axis => {
    const s = Array(5).fill(0), f = Array(3).fill(0);
    for (let j = 0; j < points.length; j++) {
      const t = (arc[j] - arc[i]) / (0.5 * length);
      if (Math.abs(t) >= 1) continue;
      const w = (1 - t * t) ** 2;
      for (let k = 0; k < 5; k++) s[k] += w * t ** k;
      for (let k = 0; k < 3; k++) f[k] += w * t ** k * (points[j][axis] - points[i][axis]);
    }
    const d = s[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (s[1] * s[4] - s[2] * s[3]) + s[2] * (s[1] * s[3] - s[2] * s[2]);
    const at = f[0] * (s[2] * s[4] - s[3] * s[3]) - s[1] * (f[1] * s[4] - s[3] * f[2]) + s[2] * (f[1] * s[3] - s[2] * f[2]);
    return points[i][axis] + (Math.abs(d) > 1e-12 ? at / d : 0);
  }));
}

/* First derivatives of the interpolating cubic spline at its knots. The end segments are parabolas. */
function splineSlopes(u, f) {
  const n = u.length, h = [], d = [];
  for (let i = 0; i + 1 < n; i++) { h.push(u[i + 1] - u[i]); d.push((f[i + 1] - f[i]) / h[i]); }
  const lower = [...h.slice(1), 1], upper = [1, ...h.slice(0, -1)], middle = [1, ...h.slice(1).map((w, i) => 2 * (w + h[i])), 1];
  const right = [2 * d[0], ...h.slice(1).map((w, i) => 3 * (w * d[i] + h[i] * d[i + 1])), 2 * d[n - 2]];
  for (let i = 1; i < n; i++) {
    const factor = lower[i - 1] / middle[i - 1];
    middle[i] -= factor * upper[i - 1];
    right[i] -= factor * right[i - 1];
  }
  const slopes = right.map((value, i) => value / middle[i]);
  for (let i = n - 2; i >= 0; i--) slopes[i] = (right[i] - upper[i] * slopes[i + 1]) / middle[i];
  return slopes;
}

/* The resource of the kernels: the number of points, then y, z and the angles of the tangents. */
function resource(points) {
  const n = points.length, u = [0], found = new Float64Array(1 + 3 * n);
  for (let i = 1; i < n; i++) u.push(u[i - 1] + distance(points[i], points[i - 1]));
  const dy = splineSlopes(u, points.map(p => p[0])), dz = splineSlopes(u, points.map(p => p[1]));
  found[0] = n;
  let before = 0;
  for (let i = 0; i < n; i++) {
    let angle = Math.atan2(dz[i], dy[i]);
    if (i) angle -= 2 * Math.PI * Math.round((angle - before) / (2 * Math.PI));
    before = angle;
    found[1 + i] = points[i][0];
    found[1 + n + i] = points[i][1];
    found[1 + 2 * n + i] = angle;
  }
  return found;
}

/* Read a file: {kind, numbers, findings}. `asked` is the kind that the user chose, or null. Throws a ProfileError. */
function readProfile(content, asked, rules) {
  const findings = [], magic = new TextDecoder("latin1").decode(content.slice(0, 8));
  if (magic === "wr-wheel" || magic === "wr-rail\0") {
    const kind = magic === "wr-wheel" ? "wheel" : "rail", n = content.byteLength < 24 ? 0 : Number(new DataView(content).getBigInt64(16, true));
    if (!(n >= 10 && n <= rules.most)) throw new ProfileError(`the file says that it has ${n} points; 10 to ${rules.most} are possible`);
    if (content.byteLength < 24 + 24 * n) throw new ProfileError(`the file holds fewer than its ${n} points`);
    const numbers = new Float64Array(1 + 3 * n);
    numbers[0] = n;
    numbers.set(new Float64Array(content.slice(24, 24 + 24 * n)), 1);
    return { kind, numbers, findings };
  }
  if (content.byteLength > rules.largest_file) throw new ProfileError("a profile has some hundred kB; this file is larger than 20 MB");
  let points = oneScan(inMetres(trueRows(rowsOf(textOf(content), findings), findings), rules, findings), rules, findings);
  const [looks] = appearance(points, rules), kind = looks ?? asked;
  if (!kind) throw new ProfileError("the points could be a wheel or a rail: open the file with “wheel …” or “rail …”");
  if (asked && looks && asked !== looks)
    throw new ProfileError(`the points have the shape of a ${looks}: ${looks === "wheel" ? "a flange near one end" : "a crown in the middle"}`);
  const [width, height] = [0, 1].map(axis => Math.max(...points.map(p => p[axis])) - Math.min(...points.map(p => p[axis])));
  const swapped = `the points are ${mm(height)} high and ${mm(width)} wide: are the columns y and z swapped, or is the profile turned by 90°?`;
  if (height > rules.taller * width) {
    if (kind === "wheel") throw new ProfileError(swapped);
    findings.push(swapped);
  } else if (kind === "rail" && !looks) findings.push("no crown with sides that fall off: is this the head of a rail?");
  points = aboutZero(withoutBackSteps(placed(points, kind, rules, findings), findings), kind, rules, findings);
  turned(points, kind, rules, findings);
  const spacing = median(points.slice(1).map((p, i) => distance(p, points[i]))), sigma = noiseOf(points);
  if (rules.tangent_of_noise * sigma > rules.rough * spacing) {
    const off = 1e3 * rules.tangent_of_noise * sigma / spacing;
    findings.push(`noise of ${Number((1e6 * sigma).toPrecision(2))} µm on points ${mm(spacing)} apart makes tangents ${off.toFixed(0)} mrad off: smoothed over ${mm(rules.window)}`);
    points = withoutBackSteps(smoothed(points, rules.window), []);
  }
  if (points.length > rules.most) {
    const every = Math.ceil(points.length / rules.most);
    findings.push(`every ${every}th of ${points.length} points is kept`);
    points = points.filter((_, i) => i % every === 0);
  }
  if (points.length < 10) throw new ProfileError(`${points.length} points are left; a profile needs ten`);
  return { kind, numbers: resource(points), findings };
}

if (typeof module !== "undefined") module.exports = { readProfile, ProfileError };
