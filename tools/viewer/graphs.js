"use strict";
// Graphs that follow the time of the picture. A click or a drag in a graph goes to that time.

const MOST_DECADES = 8;  // of a logarithmic scale; smaller values are round-off
const SPIKE = 5;  // a few values this many times higher than the others are cut off, with a notice
const ROUND_OFF = 1e-14;  // of a graph's largest number; smaller values are shown as 0
const FLAT = 1e-12;  // a smaller change, relative to the graph's largest number, is drawn as a constant
const NOISE = 1e3;  // the scale of a graph of round-off alone, over the largest value that counts as round-off
const LABEL_GAP = 6;  // between labels of the time axis [pixels]
const PAD = { left: 60, right: 8, top: 6, bottom: 16 };  // around the curves [pixels]

class Graph {
  /** Adds a graph. Calls `seek` with a time, and `chooseColumn` with the index of a sample's column. */
  constructor(parent, quantity, seek, chooseColumn) {
    this.quantity = quantity;
    this.several = new Set(quantity.lines.map((line) => line.run)).size > 1;
    this.canvas = element("canvas", { className: "curves" });
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${quantity.title} over time`);
    this.scaleButton = element("button", { className: "scale", title: "linear or logarithmic" });
    this.logarithmic = spansDecades(quantity);
    this.scaleButton.onclick = () => this.changeScale();
    this.values = element("div", { className: "values" });
    const unit = quantity.unit && quantity.unit !== "relative" ? ` [${quantity.unit}]` : "";
    const title = quantity.key === "sample" ? columnChoice(quantity, chooseColumn)
      : element("h2", { title: quantity.title, textContent: quantity.title + unit });
    const head = element("div", { className: "title" }, title, this.scaleButton);
    this.node = element("section", { className: "graph" }, head, this.values, this.canvas);
    this.node.dataset.key = quantity.key;
    this.chips = quantity.lines.map((line) => this.chip(line));
    this.peak = element("span", { className: "peak" });
    this.values.append(this.peak);
    parent.append(this.node);
    this.listen(seek);
  }

  changeScale() {
    this.logarithmic = !this.logarithmic;
    this.prepare();
    this.drawCursor(this.at);
  }

  chip(line) {
    const number = element("b"), chip = element("span", { className: "chip" });
    const bar = element("i");
    bar.style.background = this.colour(line);
    // With several runs the colour identifies the run; the names are in the picture.
    chip.append(bar, this.quantity.lines.length > 1 && !this.several ? `${line.name} ` : "", number);
    this.values.append(chip);
    return number;
  }

  colour(line) {
    const { lines, runs } = palette();
    const colours = this.several ? runs : lines;
    return colours[line.colour % colours.length];
  }

  listen(seek) {
    const go = (event) => {
      const { left } = this.canvas.getBoundingClientRect();
      const part = (event.clientX - left - PAD.left) / (this.canvas.clientWidth - PAD.left - PAD.right);
      seek(this.first + clamp(part, 0, 1) * (this.last - this.first));
    };
    this.canvas.onpointerdown = (event) => { this.canvas.setPointerCapture(event.pointerId); go(event); };
    this.canvas.onpointermove = (event) => { if (event.buttons) go(event); };
  }

  /** Draws the curves once; the cursor is drawn over them. */
  prepare() {
    this.scaleButton.textContent = this.logarithmic ? "log" : "lin";
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight, dense = window.devicePixelRatio || 1;
    if (!width || !height) return;
    this.canvas.width = Math.round(width * dense);
    this.canvas.height = Math.round(height * dense);
    this.still = element("canvas", { width: this.canvas.width, height: this.canvas.height });
    const pen = this.still.getContext("2d");
    pen.scale(dense, dense);
    this.findRange();
    this.drawAxes(pen, width, height);
    for (const line of [...this.quantity.lines].reverse()) this.drawLine(pen, line, width, height);
  }

  findRange() {
    const { lines } = this.quantity;
    const values = lines.flatMap((line) => line.run.frames.map(line.valueOf))
      .filter((value) => isNumber(value) && !(this.logarithmic && value <= 0)).sort((a, b) => a - b);
    let [low, high] = values.length ? [values[0], lastOf(values)] : [Infinity, -Infinity];
    this.largest = values.length ? Math.max(-low, high) : 0;
    const { least } = this.quantity;
    this.noise = Boolean(least && this.largest > 0 && this.largest < least);
    const usual = values[Math.floor(0.98 * (values.length - 1))], constant = high - low <= FLAT * this.largest;
    const spiked = !this.logarithmic && !this.noise && !constant && high - low > SPIKE * (usual - low) && usual > low;
    this.peak.textContent = spiked ? `a spike reaches ${short(high)}` : "";
    if (spiked) high = low + 1.5 * (usual - low);
    if (this.noise) [low, high] = [this.logarithmic ? least : low < 0 ? -NOISE * least : 0, NOISE * least];
    else if (this.logarithmic && least) low = Math.max(low, least);
    this.first = Math.min(...lines.map((line) => line.run.frames[0].time));
    const shortest = Math.max(...lines.map((line) => line.run.header.frame_time || 0), 1e-9);
    this.last = Math.max(...lines.map((line) => lastOf(line.run.frames).time), this.first + shortest);
    [this.low, this.high] = this.widened(low, high);
  }

  widened(low, high) {
    if (!(low <= high)) return this.logarithmic ? [-1, 0] : [0, 1];
    if (this.logarithmic) {
      const top = Math.ceil(Math.log10(high)), bottom = Math.floor(Math.log10(low));
      return [clamp(bottom, top - MOST_DECADES, top - 1), top];
    }
    if (this.quantity.floor !== undefined) low = Math.min(low, this.quantity.floor);
    const flat = high - low <= FLAT * this.largest;
    const room = flat ? 0.1 * Math.abs(high) || 1 : 0.06 * (high - low);
    return [low === this.quantity.floor ? low : low - room, high + room];
  }

  xOf(time, width) {
    return PAD.left + (time - this.first) / (this.last - this.first) * (width - PAD.left - PAD.right);
  }

  yOf(value, height) {
    const part = ((this.logarithmic ? Math.log10(value) : value) - this.low) / (this.high - this.low);
    return PAD.top + (1 - part) * (height - PAD.top - PAD.bottom);
  }

  drawAxes(pen, width, height) {
    const style = getComputedStyle(this.canvas);
    pen.font = `10.5px ${style.fontFamily}`;
    pen.fillStyle = style.color;
    pen.strokeStyle = palette().line;
    pen.lineWidth = 1;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    const ticks = this.ticks();
    const texts = tickTexts(ticks);
    for (const [k, value] of ticks.entries()) {
      const y = Math.round(this.yOf(value, height)) + 0.5;
      stroke(pen, PAD.left, y, width - PAD.right, y);
      const power = this.logarithmic && superscript(Math.round(Math.log10(value)));
      pen.fillText(power ? `10${power}` : texts[k], PAD.left - 5, y);
    }
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    if (this.noise) writeOver(pen, "round-off", (PAD.left + width - PAD.right) / 2, height / 2);
    const times = steps(this.first, this.last, 5), when = tickTexts(times).map((text) => `${text} s`);
    const rooms = roomsFor(times.map((time) => this.xOf(time, width)), when.map((text) => pen.measureText(text).width),
                           width);
    for (const [k, time] of times.entries()) {
      const x = Math.round(this.xOf(time, width)) + 0.5;
      stroke(pen, x, height - PAD.bottom, x, height - PAD.bottom + 3);
      if (rooms[k] !== null) pen.fillText(when[k], rooms[k], height - 2);
    }
  }

  ticks() {
    if (!this.logarithmic) return steps(this.low, this.high, 3);
    const every = Math.ceil((this.high - this.low) / 3), powers = [];
    for (let power = this.high; power >= this.low; power -= every) powers.push(10 ** power);
    return powers;
  }

  drawLine(pen, line, width, height) {
    pen.save();
    pen.beginPath();
    pen.rect(PAD.left, 0, width - PAD.left - PAD.right, height - PAD.bottom + 1);
    pen.clip();
    pen.strokeStyle = this.colour(line);
    pen.lineWidth = line.colour === 0 ? 1.8 : 1.3;
    pen.lineJoin = "round";
    pen.beginPath();
    let down = false;
    for (const frame of line.run.frames) {
      const value = line.valueOf(frame), there = isNumber(value) && !(this.logarithmic && value <= 0);
      if (there) pen[down ? "lineTo" : "moveTo"](this.xOf(frame.time, width), this.yOf(value, height));
      down = there;
    }
    pen.stroke();
    pen.restore();
  }

  /** Returns a value's text; a value below round-off is shown as such. */
  valueText(value) {
    const { least } = this.quantity;
    if (least && value !== 0 && Math.abs(value) < least) return "round-off";
    return !this.logarithmic && Math.abs(value) < ROUND_OFF * this.largest ? "0" : short(value);
  }

  /** Draws the cursor; `at` has a time, and each run's frame at that time. */
  drawCursor(at) {
    this.at = at;
    if (!this.still || !at) return;
    const pen = this.canvas.getContext("2d"), dense = window.devicePixelRatio || 1;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    pen.drawImage(this.still, 0, 0);
    pen.scale(dense, dense);
    pen.strokeStyle = getComputedStyle(this.canvas).color;
    pen.lineWidth = 1;
    const x = Math.round(this.xOf(at.time, width)) + 0.5;
    stroke(pen, x, PAD.top, x, height - PAD.bottom);
    for (const [k, line] of this.quantity.lines.entries()) {
      const frame = at.frameOf(line.run), value = line.valueOf(frame);
      this.chips[k].textContent = this.valueText(value);
      if (!isNumber(value) || (this.logarithmic && value <= 0)) continue;
      const y = this.yOf(value, height);
      if (y > height - PAD.bottom + 1) continue;
      pen.fillStyle = this.colour(line);
      pen.beginPath();
      pen.arc(this.xOf(frame.time, width), y, 2.8, 0, 7);
      pen.fill();
    }
  }
}

function stroke(pen, x, y, toX, toY) {
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(toX, toY);
  pen.stroke();
}

/** Writes a centred text in place of the lines behind it. */
function writeOver(pen, text, x, y) {
  const { width } = pen.measureText(text);
  pen.clearRect(x - width / 2 - 4, y - 11, width + 8, 15);
  pen.fillText(text, x, y);
}

/** Returns the centre of each label of a time axis near its tick, inside the graph; null where the label has no room. */
function roomsFor(ticks, widths, width) {
  let end = -Infinity;
  return ticks.map((tick, k) => {
    const half = widths[k] / 2, centre = clamp(tick, PAD.left, width - half);
    if (centre - half < end + LABEL_GAP) return null;
    end = centre + half;
    return centre;
  });
}

/** Returns tick labels with enough digits to differ, or, beyond 7 digits, as differences from the first. */
function tickTexts(ticks) {
  for (let digits = 3; digits <= 7; ++digits) {
    const texts = ticks.map((value) => digits === 3 ? short(value) : minus(String(Number(value.toPrecision(digits)))));
    if (new Set(texts).size === ticks.length) return texts;
  }
  return ticks.map((value, k) => k ? `+${short(value - ticks[0])}` : short(value));
}

/** Returns about `count` round numbers from low to high. */
function steps(low, high, count) {
  const step = niceAbove((high - low) / count), found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-12) + 1e-12 * step; ++k) found.push(k * step);
  return found;
}

const DECADES = ["error", "residual"];  // quantities that may fall by powers of ten

/** Returns whether a logarithmic scale suits: non-zero values are positive and span three decades. */
function spansDecades({ lines, key }) {
  if (!DECADES.includes(key)) return false;
  let low = Infinity, high = 0;
  for (const line of lines)
    for (const frame of line.run.frames) {
      const value = line.valueOf(frame);
      if (!isNumber(value) || value === 0) continue;
      if (value < 0) return false;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  return high > 1e3 * low;
}

function columnChoice(quantity, choose) {
  const chosen = quantity.columns.indexOf(quantity.title);
  const select = element("select", { title: "one of the scene's own numbers" }, ...quantity.columns.map(
    (name, k) => element("option", { value: k, textContent: name, selected: k === chosen })));
  select.onchange = () => choose(Number(select.value));
  return select;
}
