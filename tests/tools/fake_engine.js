"use strict";
// Stands in a figure's worker for the engine where nothing can compile it: plays what the native program wrote, again and
// again, and answers commands. A control that is set keeps its value; the motion stays as it was recorded.

async function spookEngine() {
  let run = null, at = 0, held = false;
  const text = (...lines) => lines.map((line) => `${JSON.stringify(line)}\n`).join("");
  const show = (place) => text(run.header, run.frames[at = place]);
  const next = () => text(run.frames[at = (at + 1) % run.frames.length]);
  const does = {
    open({ scene, set }) {
      run = structuredClone(RECORDED.find((one) => one.header.scene === scene && sameSettings(one.set, set)));
      return show(0);
    },
    line(command) {
      if ("pause" in command) held = command.pause;
      if (command.restart) return show(0);
      if (command.step) return next();
      if (!command.set) return "";
      for (const control of run.header.controls)
        if (control.name in command.set) control.value = command.set[control.name];
      return show(at);
    },
    frame: next,
    held: () => Number(held),
    frame_seconds: () => 1 / 60,
  };
  return { ccall: (name, kind, kinds, [said]) => does[name.replace("spook_", "")](said && JSON.parse(said)) };
}

const sameSettings = (a, b) => JSON.stringify(Object.entries(a).sort()) === JSON.stringify(Object.entries(b).sort());
