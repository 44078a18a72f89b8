"use strict";
// Formats numbers; small helpers for all files.

const lastOf = (list) => list[list.length - 1];
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));

const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];

/** Returns a number as text with three digits, and a power of ten if it is far from 1. */
function short(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e5)) {
    const [digits, power] = value.toExponential(1).split("e");
    return `${minus(digits.replace(/\.0$/, ""))}·10${superscript(Number(power))}`;
  }
  return minus(String(Number(value.toPrecision(3))));
}

function inUnit(value, unit) {
  return unit && unit !== "relative" ? `${short(value)} ${unit}` : short(value);
}

const minus = (text) => text.replace("-", "−");

function superscript(power) {
  return String(power).replace(/[-0-9]/g, (c) => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]);
}

/** Returns the smallest of 1, 2, 5 times a power of ten that is at least the value. */
function niceAbove(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((digit) => digit * power >= value * (1 - 1e-9));
}

/** Returns the index of the frame nearest in time. */
function nearest(frames, time) {
  let low = 0, high = frames.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (frames[middle].time < time) low = middle + 1;
    else high = middle;
  }
  return low > 0 && time - frames[low - 1].time <= frames[low].time - time ? low - 1 : low;
}

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
