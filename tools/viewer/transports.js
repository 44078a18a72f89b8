"use strict";
// Two connections to a running engine. Each calls take(line) for every line of output, and lost(why) when the engine
// has gone. send() returns a promise that resolves when the engine has received the command.

/** Connects to ./course play: receives lines as server-sent events and posts commands. */
class ServerTransport {
  open(take, lost) {
    this.lost = () => lost("The run has ended, because ./course play has stopped.");
    this.source = new EventSource("frames");
    this.source.onmessage = (event) => take(JSON.parse(event.data));
    this.source.onerror = this.lost;
    this.source.onopen = () => lost("");
    window.addEventListener("pagehide", () => this.source.close());
  }

  send(command) {
    return fetch("command", { method: "POST", body: JSON.stringify(command) }).catch(this.lost);
  }
}

/** Runs the engine in a worker of this page. A page from the file system may load a script but no worker's file, so the
 *  worker is made from the text of a script. */
class WorkerTransport {
  /** `opened` has the scene, the parameters to set, and the rate. */
  constructor(opened) {
    this.opened = opened;
    this.waiting = [];  // for replies to the commands sent
  }

  open(take, lost) {
    this.begun = this.begin(take, lost);
  }

  async begin(take, lost) {
    try {
      await new Promise((done, failed) => document.head.append(element("script", {
        src: "engine.js", onload: done, onerror: () => failed(new Error("its file engine.js is missing")) })));
      const [text, wasm] = [await this.part("text"), await this.part("wasm")];
      const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
      this.worker = new Worker(address);
      this.worker.onerror = (event) => { event.preventDefault(); lost(`The engine has stopped: ${event.message}.`); };
      this.worker.onmessage = ({ data }) => this.answer(data, take, lost);
      const { scene, set, rate } = this.opened;
      this.worker.postMessage({ wasm, open: { scene, set }, rate });
    } catch (error) {
      lost(`The engine cannot run here: ${error.message}.`);
    }
  }

  async part(name) {
    const packed = window.spookEngine && window.spookEngine[name];
    if (!packed) throw new Error("its file engine.js is damaged");
    const stream = new Blob([bytesOf(packed)]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
  }

  answer({ lines, taken, lost: why }, take, lost) {
    if (why) lost(`The engine has stopped: ${why}.`);
    for (const line of (lines || "").split("\n")) if (line) take(JSON.parse(line));
    if (taken) this.waiting.shift()();
  }

  async send(command) {
    await this.begun;
    if (!this.worker) return undefined;
    this.worker.postMessage({ line: JSON.stringify(command) });
    return new Promise((taken) => this.waiting.push(taken));
  }
}
