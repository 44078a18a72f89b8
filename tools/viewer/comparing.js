"use strict";
// Compares runs with the first: distances of their bodies at the same time, and when they part.

const PARTED = 1e-3;  // of the scene's size

/** Returns the largest { distance, body } between two runs at a frame of the first; null if it cannot be compared. */
function apart(first, other, frame) {
  if (!comparable(first, other) || !other.frames.length) return null;
  const last = lastOf(other.frames).time, slack = 1e-6 * (1 + Math.abs(frame.time));
  if (frame.time > last + slack || frame.time < other.frames[0].time - slack) return null;
  const [a, b, part] = around(other.frames, frame.time, slack);
  let distance = 0, body = -1;
  for (let k = 0; 3 * k < frame.x.length; ++k) {
    let square = 0;
    for (let c = 3 * k; c < 3 * k + 3; ++c) square += (frame.x[c] - (a.x[c] + part * (b.x[c] - a.x[c]))) ** 2;
    if (!(square <= distance * distance)) [distance, body] = [Math.sqrt(square), k];
  }
  return { distance, body };
}

function comparable(first, other) {
  return first.header.bodies.length === other.header.bodies.length;
}

/** Returns the frames before and after a time, and its fraction of the time between them. */
function around(frames, time, slack) {
  const k = nearest(frames, time), at = frames[k].time;
  if (Math.abs(at - time) <= slack) return [frames[k], frames[k], 0];
  const [a, b] = at < time ? [frames[k], frames[k + 1]] : [frames[k - 1], frames[k]];
  return [a, b, (time - a.time) / (b.time - a.time)];
}

/** Returns the first time at which two runs differ by more than PARTED of the size; null if there is none. */
function parting(first, other, size) {
  for (const frame of first.frames) {
    const found = apart(first, other, frame);
    if (found && !(found.distance <= PARTED * size)) return frame.time;
  }
  return null;
}

/** Returns the largest { distance, time } over the frames of the first run; null if no time is common. */
function farthest(first, other) {
  let most = null;
  for (const frame of first.frames) {
    const found = apart(first, other, frame);
    if (found && (!most || !(found.distance <= most.distance))) most = { distance: found.distance, time: frame.time };
  }
  return most;
}

/** Returns the text that compares a run with the first, at the cursor. */
function partingLine(first, other, size, since, most, frame) {
  if (!comparable(first, other)) return `${other.label}: its bodies differ, so their places are not compared.`;
  const now = apart(first, other, frame);
  const here = now ? `Now ${inUnit(now.distance, "m")}${now.body >= 0 ? `, at body ${now.body}` : ""}.`
    : "Only one of the runs has this time.";
  const limit = inUnit(PARTED * size, "m");
  if (!most) return `${other.label}: it has no time in common with ${first.label}.`;
  if (most.distance === 0) return `${other.label}: at the same places as ${first.label}, in every frame.`;
  const largest = `${inUnit(most.distance, "m")} from ${first.label} at most, at ${inUnit(most.time, "s")}`;
  const parted = since === null ? "" : `, and more than ${limit} since ${inUnit(since, "s")}`;
  const chaos = since !== null && first.header.chaotic ? " This scene is chaotic: round-off alone parts runs." : "";
  return `${other.label}: ${largest}${parted}. ${here}${chaos}`;
}

/** Returns a run's state at a frame, with the reason if it is asked for; empty if the run is sound. */
function stateLine(run, frame, reason = true) {
  if (!frame || !frame.state || frame.state === "sound") return "";
  const named = run.label ? `${run.label}: ` : "";
  return `${named}${frame.state} by now${reason ? `: ${frame.why}` : ""}.`;
}
