"use strict";
/* False rows of a scan: what a device writes for "nothing seen", like 0 0 or -999 -999. The rules and numbers are those of
 * contact/geometry/false_rows.py, which says why; tests/explorer compares row by row. Points are [y, z], all finite. */

const _FALSE = {
  beyond: 1.5, spreads: 8, jump: 0.05, overSpacing: 4, back: 0.25, backOfCode: 0.7, few: 3, share: 0.05, shareAtEnd: 0.02,
  shareOfZeros: 0.25, shareRepeated: 0.1, mostAtEnds: 4, together: 3, mostRounds: 100, end: 0.4,
};
const _minus = (p, q) => [p[0] - q[0], p[1] - q[1]], _dot = (p, q) => p[0] * q[0] + p[1] * q[1];
const _length = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]), _same = (p, q) => p[0] === q[0] && p[1] === q[1];
const _steps = points => points.slice(1).map((p, i) => _length(p, points[i]));
const _axes = [0, 1];
const _range = (points, axis) => {
  let low = Infinity, high = -Infinity;
  for (const p of points) { low = Math.min(low, p[axis]); high = Math.max(high, p[axis]); }
  return high - low;
};
const _spanOf = points => points.length ? Math.hypot(_range(points, 0), _range(points, 1)) : 0;
const _allZero = (points, axis) => points.every(p => p[axis] === 0);
const _zeroColumn = points => _axes.some(axis => _allZero(points, axis));
const _unlike = points => 1 + points.slice(1).filter((p, i) => !_same(p, points[i])).length;

/* A quantile as NumPy has it, linear between the sorted values. */
function _quantile(sorted, share) {
  const at = share * (sorted.length - 1), k = Math.floor(at), t = at - k, a = sorted[k], b = sorted[Math.min(k + 1, sorted.length - 1)];
  return t >= 0.5 ? b - (b - a) * (1 - t) : a + (b - a) * t;
}
const _sorted = values => [...values].sort((a, b) => a - b);
const _usualStep = points => { const steps = _steps(points).filter(s => s > 0); return steps.length ? _quantile(_sorted(steps), 0.5) : 0; };
const _leastJump = points => Math.max(_FALSE.jump * _spanOf(points), _FALSE.overSpacing * _usualStep(points));

/* Begin and end of every run of true values. */
function _runs(rows) {
  const found = [];
  for (let a = 0; a < rows.length; a++) {
    if (!rows[a]) continue;
    let b = a;
    while (b < rows.length && rows[b]) b++;
    found.push([a, b]);
    a = b;
  }
  return found;
}

/* Rows with the one value that lies farthest beyond all others, if it is too far; however many have it. */
function _far(points) {
  let best = _FALSE.beyond, found = points.map(() => false);
  for (const axis of _axes) {
    const values = [...new Set(_sorted(points.map(p => p[axis])))], n = values.length;
    if (n < 3) continue;
    for (const [value, other] of [[values[0], values[1]], [values[n - 1], values[n - 2]]]) {
      const rows = points.map(p => p[axis] === value), extent = _spanOf(points.filter((_, i) => !rows[i]));
      if (Math.abs(value / 2 - other / 2) > best * extent / 2 && extent > 0) { best = Math.abs(value / 2 - other / 2) / (extent / 2); found = rows; }
    }
  }
  return found;
}

/* Rows far from the middle half of the points. */
function _spread(points) {
  const columns = _axes.map(axis => _sorted(points.map(p => p[axis])));
  const middle = columns.map(column => _quantile(column, 0.5));
  const size = Math.max(...columns.map(column => _quantile(column, 0.75) - _quantile(column, 0.25)), 1e-300);
  return points.map(p => _axes.some(axis => Math.abs(p[axis] - middle[axis]) > _FALSE.spreads * size));
}

/* Rows with a point that stands at several places of the scan, if few points do. */
function _repeated(points) {
  const found = points.map(() => false), changes = points.map((p, i) => !i || !_same(p, points[i - 1])), places = new Map();
  const key = p => `${p[0] + 0} ${p[1] + 0}`;
  points.forEach((p, i) => { if (changes[i]) places.set(key(p), (places.get(key(p)) ?? 0) + 1); });
  if (_same(points[0], points[points.length - 1])) places.set(key(points[0]), places.get(key(points[0])) - 1); // a closed outline
  const again = points.map(p => places.get(key(p)) > 1), count = rows => rows.filter(Boolean).length;
  const several = count(again.map((one, i) => one && changes[i]));
  if (!(several > 0 && several < _FALSE.shareRepeated * count(changes))) return found;
  const step = [Infinity, ..._steps(points), Infinity], far = _leastJump(points);
  for (const [a, b] of _runs(again)) if (step[a] > far && step[b] > far) found.fill(true, a, b);
  return found;
}

/* Whether one of the coordinates is 0, or the same in rows that lie apart as `usual` or less. */
function _code(points, usual) {
  const near = points.length > 1 && _steps(points).reduce((one, other) => Math.max(one, other)) <= _FALSE.overSpacing * usual;
  return _zeroColumn(points) || (near && _axes.some(axis => _range(points, axis) === 0));
}

/* The distance of the points around over the way by the points between, over what it may be: below 1 is false. */
function _detour(before, points, after, code) {
  const way = _length(points[0], before) + _length(after, points[points.length - 1]);
  return _length(after, before) / way / (code ? _FALSE.backOfCode : _FALSE.back);
}

/* Whether the few points `end` before a scan, the nearest first, do not lead it on. */
function _beside(end, scan, usual) {
  const step = _minus(end[0], scan[0]), back = _dot(_minus(scan[Math.min(5, scan.length - 1)], scan[0]), step) > 0;
  return back || _code(end, usual) || Math.hypot(...step) > _FALSE.end * _spanOf(scan);
}

/* Points to which a scan jumps and from which it comes back: those that are clearest of it, or at its ends. */
function _aside(points) {
  const n = points.length, found = points.map(() => false), least = _leastJump(points);
  const cuts = _steps(points).flatMap((step, i) => step > least ? [i + 1] : []);
  if (!(cuts.length > 0 && cuts.length < Math.floor(n / 3))) return found;
  const bounds = [0, ...cuts, n], few = Math.max(_FALSE.few, Math.trunc(_FALSE.share * n)), usual = _usualStep(points), ranked = [];
  for (let k = 1; k < bounds.length - 2; k++)
    for (let m = 1; m <= Math.min(_FALSE.together, bounds.length - 2 - k); m++) {
      const a = bounds[k], b = bounds[k + m], part = points.slice(a, b);
      let most = m === 1 ? few : _FALSE.few;
      if (m === 1 && _zeroColumn(part)) most = Math.trunc(_FALSE.shareOfZeros * n);
      if (b - a > Math.floor(n / 2) || _unlike(part) > most) break;
      const code = _code(part, usual), detour = _detour(points[a - 1], part, points[b], code);
      if (detour < 1) ranked.push([m, code ? 0 : 1, detour, k, a, b]);
    }
  const free = Array(bounds.length + 1).fill(true);
  ranked.sort((one, other) => { const i = one.findIndex((value, j) => value !== other[j]); return i < 0 ? 0 : one[i] - other[i]; });
  for (const [m, , , k, a, b] of ranked) // zeros first: good points between two false ones look aside too
    if (free.slice(k - 1, k + m + 1).every(Boolean)) { free.fill(false, k, k + m); found.fill(true, a, b); }
  if (found.some(Boolean) || cuts.length > _FALSE.mostAtEnds) return found;
  const fewAtEnd = Math.max(_FALSE.few, Math.trunc(_FALSE.shareAtEnd * n)), first = bounds[1], last = bounds[bounds.length - 2];
  for (const [from, to, nearest, scan] of [
    [0, first, points.slice(0, first).reverse(), points.slice(first)],
    [last, n, points.slice(last), points.slice(0, last).reverse()],
  ]) {
    const most = _zeroColumn(nearest) ? _FALSE.shareOfZeros * n : fewAtEnd;
    if (_unlike(nearest) <= most && most < scan.length && _beside(nearest, scan, usual)) found.fill(true, from, to);
  }
  return found;
}

/* Runs with 0 in a column to which the scan turns back, and from which it turns back again. */
function _zeros(points) {
  const n = points.length, found = points.map(() => false), least = 1.2 * _usualStep(points);
  for (const axis of _axes)
    for (const [a, b] of _runs(points.map(p => p[axis] === 0))) {
      const part = points.slice(a, b);
      if (!(a > 0 && b < n && b - a <= Math.max(_FALSE.few, _FALSE.shareOfZeros * n)) || _axes.every(one => _range(part, one) !== 0)) continue;
      const there = _minus(points[a], points[a - 1]), back = _minus(points[b], points[b - 1]);
      const far = Math.min(Math.hypot(...there), Math.hypot(...back)) > least || b - a > 1 || part.every(p => p[0] === 0 && p[1] === 0);
      if (far && _dot(there, back) < 0) found.fill(true, a, b);
    }
  return found;
}

/* Which rows are no points of the profile that the others lie on. */
function falseRows(points) {
  const wrong = points.map(() => false);
  for (const find of [_spread, _far, _spread, _repeated, _aside, _zeros])
    for (let round = 0; round < _FALSE.mostRounds; round++) {
      const there = wrong.flatMap((one, i) => one ? [] : [i]), found = there.length > 7 ? find(there.map(i => points[i])) : [];
      if (!found.some(Boolean)) break;
      found.forEach((one, i) => { if (one) wrong[there[i]] = true; });
    }
  return wrong;
}

if (typeof module !== "undefined") module.exports = { falseRows };
