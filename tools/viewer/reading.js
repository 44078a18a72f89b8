"use strict";
// Reads a recording line by line. solutions/recording/README.md describes the format.
//
// Frames before an error are shown, with a notice about it. A run has
//   header   as recorded
//   frames   see frameOf
//   notice   an error or the reason of an early end; empty for a complete run

// In characters; a larger recording exhausts the memory of a tab.
const LARGEST = 512 * 2 ** 20, LONGEST_LINE = 64 * 2 ** 20;
const PER_BODY = { x: 3, v: 3, q: 4, omega: 3 };

/** Reads a recording from pieces of text. Never throws; the run's notice describes an error. */
async function readRecording(pieces) {
  const run = { header: null, frames: [], notice: "" };
  let line = 1;
  try {
    let ended = false;
    for await (const text of lines(pieces)) {
      ended = takeLine(run, text) || ended;
      ++line;
    }
    if (!run.header) throw whole("The recording is empty.");
    if (!run.frames.length) throw whole("The recording has no frames.");
    if (!ended) run.notice = `The recording is cut off at ${inUnit(lastOf(run.frames).time, "s")}: its end is missing.`;
  } catch (error) {
    run.notice = noticeOf(error, run, line);
  }
  return run;
}

/** Returns an error whose message needs no line number. */
const whole = (message) => Object.assign(new Error(message), { whole: true });

function noticeOf(error, run, line) {
  if (error.whole) return error.message;
  const shown = run.frames.length ? "shown is what comes before it" : "there is nothing before it to show";
  return `Line ${line} of the recording is damaged (${error.message}); ${shown}.`;
}

/** Yields the lines of the pieces. Throws if the recording is too large to be shown. */
async function* lines(pieces) {
  let begun = [], size = 0, length = 0;  // the pieces of an incomplete line
  for await (const piece of pieces) {
    const parts = piece.split("\n");
    size += piece.length;
    length = parts.length > 1 ? lastOf(parts).length : length + piece.length;
    if (size > LARGEST || length > LONGEST_LINE)
      throw whole("The recording is too large to be shown: record it with a lower --fps or a shorter --time.");
    while (parts.length > 1) {
      begun.push(parts.shift());
      yield begun.join("");
      begun = [];
    }
    begun.push(parts[0]);
  }
  const rest = begun.join("");
  if (rest) yield rest;
}

/** Adds a line to the run. Returns true for the last line of a recording. */
function takeLine(run, text) {
  const line = parsed(text, run.header ? new Error("it is not JSON") : whole("This file is not a recording of a run."));
  if (!run.header) run.header = checkedHeader(line);
  else if ("end" in line) {
    run.notice = endOf(line);
    return true;
  } else run.frames.push(frameOf(line, run.header));
  return false;
}

/** Returns a sentence about a run's early end; empty for a complete run. The engine's reason may include the verb. */
function endOf({ end, why }) {
  if (end === "done") return "";
  if (!why) return "The run diverged; the recording gives no reason.";
  return why.startsWith("blew up") ? `The run ${why}.` : `The run blew up: ${why}.`;
}

function parsed(text, otherwise) {
  try {
    const value = JSON.parse(text);
    if (value && typeof value === "object") return value;
  } catch { /* thrown below */ }
  throw otherwise;
}

function checkedHeader(header) {
  if (header.format !== "spook recording") throw whole("This file is not a recording of a run.");
  if (header.version !== 1) throw whole(`The recording has version ${header.version}; this page reads version 1.`);
  if (!Array.isArray(header.bodies)) throw whole("The recording's header lists no bodies.");
  const bodies = header.bodies.length;
  for (const joint of header.joints || [])
    if (!(joint.i < bodies && joint.j < bodies)) throw whole("The recording's header has a joint without bodies.");
  return { parameters: {}, method: {}, joints: [], curves: [], columns: [], stages: [], error: {}, ...header };
}

/** Returns a frame with its arrays unpacked. Throws if they do not fit the header. */
function frameOf(line, header) {
  if (!Number.isFinite(line.time)) throw new Error("its time is missing");
  const frame = { ...line };
  for (const [key, count] of Object.entries(PER_BODY)) {
    if (key !== "x" && !(key in line)) continue;
    frame[key] = numbers(line[key], Float32Array, key);
    expectCount(key, frame[key].length, count * header.bodies.length);
  }
  frame.between = numbers(line.between || "", Int32Array, "between");
  frame.contacts = numbers(line.contacts || "", Float32Array, "contacts");
  expectCount("contacts", frame.contacts.length, 5 * frame.between.length);
  if (frame.between.some((body) => !(body >= 0 && body < header.bodies.length)))
    throw new Error("between names a body that does not exist");
  frame.jointImpulses = numbers(line.joint_impulses || "", Float32Array, "joint_impulses");
  frame.ghostBodies = line.ghost_bodies || [];
  frame.ghost = numbers(line.ghost || "", Float32Array, "ghost");
  if (frame.ghostBodies.length && frame.ghost.length !== 7 * frame.ghostBodies.length)
    expectCount("ghost", frame.ghost.length, 3 * frame.ghostBodies.length);
  frame.energy = line.energy || {};
  frame.us = line.us || [];
  frame.sample = line.sample || [];
  return frame;
}

function expectCount(key, got, wanted) {
  if (got !== wanted) throw new Error(`${key} has ${got} numbers, not ${wanted}`);
}

function numbers(packed, Kind, key) {
  if (Array.isArray(packed)) return Kind.from(packed.flat());
  try {
    return new Kind(bytesOf(packed).buffer);
  } catch {
    throw new Error(`${key} cannot be read`);
  }
}
