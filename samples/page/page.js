'use strict';
const $ = selector => document.querySelector(selector);
const {report, folder, frames} = JSON.parse($('#drive').textContent);
const STATUS = ['ok', 'not_significant', 'too_few_segments', 'no_consensus', 'not_observable', 'failed'];
// Of a curve: its key in the report, what it is, and the key of its standard deviation.
const CHARTS = [
  ['yaw rate (deg/s)', ['yaw_rate_deg_s', 'estimated, ± 2 sigma', 'yaw_rate_sigma'], ['given_yaw_rate_deg_s', 'given']],
  ['speed (km/h)', ['speed_km_h', 'estimated, ± 2 sigma', 'speed_sigma'], ['given_speed_km_h', 'given']],
  ['displacement (px)', ['expected_px_left', 'expected, corrected'], ['expected_px_raw', 'expected, raw']],
  ['status', ['level', 'status']]].map(([label, ...curves]) => ({label, curves, words: label === 'status' ? STATUS : null}));
const LEFT = 140, TOP = 8, BOTTOM = 132;

// A frame that has failed has no time: it comes after the one before it. Shards write their lines as they come.
let time = frames.find(f => f.time_s != null)?.time_s;
frames.forEach(f => { f.x = time = f.time_s ?? time; f.level = STATUS.indexOf(f.status); });
if (frames.every(f => f.frame == null)) frames.sort((a, b) => a.x - b.x);
const timed = frames.every((f, i) => (f.time_s != null || f.status === 'failed') && f.x >= (frames[i - 1] ?? f).x);
frames.forEach((f, i) => { f.index = i; f.x = timed ? f.x : i + 1; });
const badness = f => f.status === 'failed' ? 1e300 : f.expected_px_left ?? 1e200;
let order = frames, at = 0, shown = frames;

function ticks(low, high, most) {
  const unit = 10 ** Math.floor(Math.log10((high - low) / most));
  const step = unit * [1, 2, 5, 10].find(s => s * unit * most >= high - low), first = Math.ceil(low / step);
  return Array.from({length: Math.floor(high / step) - first + 1}, (_, k) => +((first + k) * step).toPrecision(8));
}

// The frames with a value, in runs that a line joins: it ends where a value is unknown, and with a video.
function runs(key) {
  const list = [];
  shown.forEach((f, i) => {
    const last = shown[i - 1];
    if (f[key] != null && (last?.[key] == null || (f.frame != null && f.input !== last.input))) list.push([]);
    if (f[key] != null) list[list.length - 1].push(f);
  });
  return list;
}

function draw(chart) {
  const right = chart.svg.clientWidth - 20, first = shown[0].x, last = Math.max(shown[shown.length - 1].x, first + 1e-3);
  const words = chart.words, all = share => chart.curves.flatMap(([key, , sigma]) =>
    shown.filter(f => f[key] != null).map(f => f[key] + share * (f[sigma] ?? 0))).sort((a, b) => a - b);
  const values = all(0), lower = all(-2), upper = all(2), end = values.length - 1;
  const rare = Math.floor(values.length / 20); // the widest bands are cut off, or no other would be seen
  const low = words ? -0.5 : 1.05 * Math.min(0, values[0] ?? 0, lower[rare] ?? 0);
  const high = words ? words.length - 0.5 : Math.max(low + 1e-3, 1.05 * Math.max(0, values[end] ?? 1, upper[end - rare] ?? 1));
  chart.X = x => LEFT + (x - first) / (last - first) * (right - LEFT);
  chart.Y = y => BOTTOM - (y - low) / (high - low) * (BOTTOM - TOP);
  const text = (place, word) => `<text text-anchor="middle" ${place}>${word}</text>`;
  const rows = (words ?? ticks(low, high, 4)).map((word, i) => [chart.Y(words ? i : word), word]).map(([y, word]) =>
    `<path d="M${LEFT} ${y}H${right}"/>` + text(`x="${LEFT - 8}" y="${y + 4}" style="text-anchor: end"`, word));
  const columns = ticks(first, last, 8).map(x =>
    `<path d="M${chart.X(x)} ${TOP}V${BOTTOM}"/>` + text(`x="${chart.X(x)}" y="${BOTTOM + 16}"`, x));
  const curves = chart.curves.map(([key, , sigma], c) => {
    const place = k => f => `${chart.X(f.x).toFixed(1)} ${chart.Y(f[key] + k * (f[sigma] ?? 0)).toFixed(1)}`, mean = place(0);
    const line = words ? shown.map(f => `M${mean(f)}m0 -5v10`) : runs(key).map(run => 'M' + (run[1] ? run.map(mean).join('L') : mean(run[0]) + 'm-2 0h4'));
    const band = runs(sigma).map(run => `M${run.map(place(2)).concat(run.map(place(-2)).reverse()).join('L')}Z`);
    return `<path class="band" d="${band.join('')}"/><path class="c${c}" d="${line.join('')}"/>`;
  });
  chart.svg.innerHTML = rows.concat(columns).join('') + text(`x="${(LEFT + right) / 2}" y="162"`, timed ? 'time (s)' : 'frame') +
    text(`transform="translate(14 ${(TOP + BOTTOM) / 2}) rotate(-90)"`, chart.label) + `<clipPath id="clip">
    <path d="M${LEFT - 3} 0H${right + 3}V${BOTTOM}H${LEFT - 3}Z"/></clipPath>
    <g clip-path="url(#clip)">${curves.join('')}</g><path class="cursor"/>`;
}

const number = (value, unit, digits) => value == null ? 'unknown' : value.toFixed(digits) + unit;
const measured = (value, sigma, unit) => number(value, unit, 1) + (sigma == null ? '' : ` ± ${(2 * sigma).toFixed(1)} (2 sigma)`);
const factsOf = f => [['status', f.status], ['error', f.error], ['time', f.time_s?.toFixed(3).concat(' s')], ...f.status === 'failed' ? [] : [
  ['yaw rate', measured(f.yaw_rate_deg_s, f.yaw_rate_sigma, ' deg/s')],
  ['… given', measured(f.given_yaw_rate_deg_s, f.given_yaw_rate_sigma, ' deg/s')],
  ['speed', measured(f.speed_km_h, f.speed_sigma, ' km/h')],
  ['… given', measured(f.given_speed_km_h, f.given_speed_sigma, ' km/h')],
  ['contradicts given', f.contradicts_prior ? 'yes' : 'no'], ['model, scale', `${f.model}, ${f.scale ?? 'unknown'}`],
  ['displacement', `${number(f.expected_px_raw, ' px', 2)} expected raw, ${number(f.expected_px_left, ' px', 2)} corrected`],
  ['probability worse', number(f.probability_worse, '', 3)], ['mean shift', number(f.mean_shift_px, ' px', 2)],
  ['segments', `${f.segments} detected, ${f.candidates} candidates, ${f.inliers} inliers`]]].filter(row => row[1] != null);

function showPicture(image, label, words, picture) {
  image.hidden = !picture;
  label.textContent = picture ? words : words + ': no picture';
  if (picture) image.src = folder ? encodeURIComponent(folder) + '/' + picture : picture;
}

function show() {
  const f = order[at], overlay = $('#segments').checked && f.overlay, near = $('#near').checked;
  $('h2').textContent = `${f.input}${f.frame == null ? '' : `, frame ${f.frame}`} (${f.index + 1} of ${frames.length})`;
  $('dl').replaceChildren(...factsOf(f).flatMap(row => row.map((words, i) =>
    Object.assign(document.createElement(i ? 'dd' : 'dt'), {textContent: words}))));
  showPicture($('#before'), $('b'), overlay ? 'raw, segments' : 'raw', overlay || f.raw);
  showPicture($('#after'), $('b + b'), 'corrected', f.corrected);
  $('#place').value = at;
  const from = near ? Math.max(0, Math.min(f.index - 50, frames.length - 100)) : 0;
  const list = frames.slice(from, near ? from + 100 : frames.length);
  const isDrawn = CHARTS[0].X && list.length === shown.length && list[0] === shown[0];
  shown = list;
  if (!isDrawn) CHARTS.forEach(draw);
  CHARTS.forEach(chart => chart.svg.lastChild.setAttribute('d', `M${chart.X(f.x)} ${TOP}V${BOTTOM}`));
}

const go = place => { at = Math.max(0, Math.min(order.length - 1, place)); show(); };
const cut = percent => { $('#cut').value = percent; $('#stack').style.setProperty('--cut', percent + '%'); };
document.title = $('h1').textContent = report;
$('#summary').textContent = `${frames.length} frames: ` + STATUS.map((word, i) => [frames.filter(f => f.level === i).length, word])
  .filter(([count]) => count).map(pair => pair.join(' ')).join(', ');
for (const chart of CHARTS) {
  const figure = $('#charts').appendChild(document.createElement('figure'));
  figure.innerHTML = chart.curves.map(([, words], c) => `<i class="c${c}"></i>${words}`).join('') +
    `<svg role="img" aria-label="${chart.label}"></svg>`;
  chart.svg = figure.lastChild;
  chart.svg.onclick = e => {
    const distance = f => Math.abs(chart.X(f.x) - e.clientX + chart.svg.getBoundingClientRect().left);
    go(order.indexOf(shown.reduce((a, b) => distance(b) < distance(a) ? b : a)));
  };
}
$('#place').max = frames.length - 1;
$('#place').oninput = e => go(+e.target.value);
$('#cut').oninput = e => cut(+e.target.value);
$('#stack').onpointerdown = $('#stack').onpointermove = e => e.buttons && cut(e.offsetX / $('#stack').clientWidth * 100);
$('#segments').onchange = $('#near').onchange = show;
$('#worst').onchange = e => {
  const f = order[at];
  order = e.target.checked ? [...frames].sort((a, b) => badness(b) - badness(a)) : frames;
  go(e.target.checked ? 0 : f.index);
};
const KEYS = {ArrowLeft: () => go(at - 1), ArrowRight: () => go(at + 1), PageUp: () => go(at - 10), PageDown: () => go(at + 10),
  Home: () => go(0), End: () => go(order.length - 1), b: () => cut($('#cut').value > 50 ? 0 : 100),
  s: () => $('#segments').click(), w: () => $('#worst').click(), z: () => $('#near').click()};
$('#previous').onclick = KEYS.ArrowLeft;
$('#next').onclick = KEYS.ArrowRight;
onkeydown = e => {
  if (!KEYS[e.key] || e.ctrlKey || e.metaKey || e.altKey || (e.key.length > 1 && e.target.type === 'range')) return;
  e.preventDefault();
  KEYS[e.key]();
};
onresize = () => { CHARTS.forEach(draw); show(); };
show();
