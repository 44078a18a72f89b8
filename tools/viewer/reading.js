"use strict";
// A recording, line by line: solutions/recording/README.md has the format.
//
// What is wrong with one is said in a line, and what comes before is shown. A run is
//   header   as recorded
//   frames   see frameOf
//   notice   what a viewer must know of it; empty if all is well

// Characters; beyond, a tab runs out of memory.
const LARGEST = 512 * 2 ** 20, LONGEST_LINE = 64 * 2 ** 20;
const PER_BODY = { x: 3, v: 3, q: 4, omega: 3 };

/** Reads a recording that comes as pieces of text. Never throws: what is wrong is the run's notice. */
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

/** An error that says all there is to say, whatever the line. */
const whole = (message) => Object.assign(new Error(message), { whole: true });

function noticeOf(error, run, line) {
  if (error.whole) return error.message;
  const shown = run.frames.length ? "shown is what comes before it" : "there is nothing before it to show";
  return `Line ${line} of the recording is damaged (${error.message}); ${shown}.`;
}

/** The pieces as lines. Throws for a recording that is too large to be shown. */
async function* lines(pieces) {
  let begun = [], size = 0, length = 0;  // the pieces of a line that is not complete
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

/** Adds what a line says to the run. True for the last line of a recording. */
function takeLine(run, text) {
  const line = parsed(text, run.header ? new Error("it is not JSON") : whole("This file is not a recording of a run."));
  if (!run.header) run.header = checkedHeader(line);
  else if ("end" in line) {
    run.notice = endOf(line);
    return true;
  } else run.frames.push(frameOf(line, run.header));
  return false;
}

/** How a run ended, in a sentence; empty if all is well. The engine's own reason may begin with the same words. */
function endOf({ end, why }) {
  if (end === "done") return "";
  if (!why) return "The run diverged; the recording gives no reason.";
  return why.startsWith("blew up") ? `The run ${why}.` : `The run blew up: ${why}.`;
}

function parsed(text, otherwise) {
  try {
    const value = JSON.parse(text);
    if (value && typeof value === "object") return value;
  } catch { /* said below */ }
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

/** A frame, its crowds of numbers unpacked. Throws if they do not fit the header. */
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
