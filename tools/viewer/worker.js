"use strict";
// The worker that runs the engine of solutions/web/live.cpp in real time. The compiler's output precedes this file.

let engine = null, timer = 0, due = 0;

const call = (name, text) => text === undefined ? engine.ccall(`spook_${name}`, "string", [], [])
  : engine.ccall(`spook_${name}`, "string", ["string"], [text]);
const number = (name) => engine.ccall(`spook_${name}`, "number", [], []);

/** Schedules the next frame. A run slower than real time does not catch up later. */
function schedule() {
  clearTimeout(timer);
  if (number("held")) due = 0;
  else timer = setTimeout(frame, Math.max(0, due - performance.now()));
}

function frame() {
  guarded(() => {
    const now = performance.now();
    postMessage({ lines: call("frame") });
    due = Math.max((due || now) + 1000 * number("frame_seconds"), performance.now());
    schedule();
  });
}

function guarded(work) {
  try {
    work();
  } catch (error) {
    clearTimeout(timer);
    postMessage({ lost: error.message || String(error) });
  }
}

async function start({ wasm, open, rate }) {
  try {
    engine = await spookEngine({ wasmBinary: wasm });
    postMessage({ lines: call("open", JSON.stringify(open)) });
    if (rate) call("line", JSON.stringify({ rate }));
    schedule();
  } catch (error) {
    postMessage({ lost: error.message || String(error) });
  }
}

let started = null;

onmessage = ({ data }) => {
  if (data.wasm) started = start(data);
  else started.then(() => guarded(() => {
    postMessage({ lines: engine ? call("line", data.line) : "", taken: true });
    if (engine) schedule();
  }));
};
