"use strict";
// Joins the parts of the page. Tests and notebooks read its state from `window.viewer`.

class Viewer {
  constructor() {
    this.ready = false;
    this.draws = 0;
    this.notice = "";
    this.column = 1;
    this.graphs = [];
  }

  /** Opens the recordings of the page, or its live run. */
  async open() {
    try {
      if (typeof DecompressionStream === "undefined") throw new Error("This browser is too old to unpack the page.");
      await loadLibraries();
      this.start();
      const live = document.getElementById("live");
      if (!live) await this.openRecordings();
      else if (JSON.parse(live.textContent).figure) this.openFigure();
      else this.live = new Live(this, [new Side(new ServerTransport())]);
    } catch (error) {
      this.say(error.message);
    }
    this.ready = true;
  }

  start() {
    try {
      this.picture = new Picture(document.getElementById("picture"));
    } catch {
      throw new Error("This browser cannot draw in three dimensions: WebGL is missing or switched off.");
    }
    this.player = new Player(() => this.dirty());
    this.controls = new Controls(this);
    this.legend = new Legend(document.getElementById("stage"));
    this.picture.camera.orbit.addEventListener("change", () => this.dirty());
    this.telling = new Telling(this);
    this.pointing = new Pointing(this);
    new ResizeObserver(() => this.resize()).observe(document.getElementById("stage"));
    IN_THE_DARK.addEventListener("change", () => this.rebuild());
    const tick = (now) => {
      this.player.advance((now - (this.lastTick || now)) / 1000);
      this.lastTick = now;
      if (this.stale) this.draw();
      window.requestAnimationFrame(tick);
    };
    window.requestAnimationFrame(tick);
  }

  openFigure() {
    this.figure = new Figure(this);
    this.live = new Live(this, this.figure.sides(), this.figure);
  }

  async openRecordings() {
    const runs = [];
    for (const node of document.querySelectorAll("script[data-recording]")) {
      const run = await readRecording(unpacked(node));
      run.label = node.dataset.recording;
      const named = run.label ? `${run.label}: ` : "";
      if (run.notice) this.say([this.notice, named + run.notice].filter(Boolean).join(" "));
      if (run.frames.length) runs.push(run);
      node.remove();
    }
    if (!runs.length) return;
    this.show(runs);
    this.controls.setSpeed(rateFor(this.player.lead));
    const moment = momentAsked(this.player.lead);
    if (moment !== null) this.seek(moment);
    else this.player.play(true);
  }

  /** Shows runs from their start; `keep` leaves the camera where it is. */
  show(runs, keep = false) {
    this.runs = runs;
    this.picture.resize();
    this.picture.show(runs, keep);
    this.player.show(runs);
    this.since = runs.slice(1).map((run) => parting(runs[0], run, this.picture.box.size));
    this.farthest = runs.slice(1).map((run) => comparable(runs[0], run) ? farthest(runs[0], run) : null);
    this.controls.show(runs);
    describe(runs);
    this.makeGraphs();
    this.legend.show(this.picture);
    this.draw();
  }

  makeGraphs() {
    const parent = document.getElementById("graphs");
    parent.replaceChildren();
    this.graphs = [];
    if (this.figure && !this.figure.graph) return;
    const columns = this.runs[0].header.columns;
    this.column = clamp(this.column, 0, Math.max(0, columns.length - 1));
    const choose = (column) => {
      this.column = column;
      this.makeGraphs();
      this.dirty();
    };
    const only = this.figure ? this.figure.keyOf(this.runs[0].header) : "";
    this.graphs = quantities(this.runs, this.column, only).map((quantity) =>
      new Graph(parent, quantity, (time) => this.seek(time), choose));
    for (const graph of this.graphs) graph.prepare();
  }

  rebuild() {
    if (!this.runs) return;
    this.picture.build();
    this.makeGraphs();
    this.legend.show(this.picture);
    this.dirty();
  }

  resize() {
    this.picture.resize();
    for (const graph of this.graphs) graph.prepare();
    if (this.runs) this.legend.show(this.picture);
    if (this.runs) this.draw();
  }

  dirty() {
    this.stale = true;
  }

  draw() {
    this.stale = false;
    this.controls.update();
    if (!this.runs) return;
    const frames = this.player.frames();
    this.telling.draw(frames);
    this.picture.draw(frames);
    ++this.draws;
    const at = { time: this.player.time, frameOf: (run) => this.player.frameOf(run) };
    for (const graph of this.graphs) graph.drawCursor(at);
    this.legend.update(this.picture);
    const states = this.runs.map((run) => stateLine(run, this.player.frameOf(run), !this.figure));
    const partings = (this.live ? [] : this.runs.slice(1)).map((run, k) =>
      partingLine(this.runs[0], run, this.picture.box.size, this.since[k], this.farthest[k], frames[0]));
    const parting = document.getElementById("parting");
    parting.textContent = [...states.filter(Boolean), ...partings].join("\n");
    // A figure has no room for the reasons.
    if (this.figure) parting.title = this.runs.map((run) => stateLine(run, this.player.frameOf(run))).join("\n").trim();
  }

  say(notice) {
    this.notice = notice;
    const node = document.getElementById("notice");
    node.textContent = notice;
    node.hidden = !notice;
  }

  /** Puts this moment into the address, and copies it if the browser allows this. */
  flashMoment() {
    const node = document.getElementById("moment"), say = (text) => {
      node.textContent = text;
      setTimeout(() => { node.textContent = "link to this moment"; }, 1500);
    };
    const copied = navigator.clipboard ? navigator.clipboard.writeText(location.href) : Promise.reject();
    copied.then(() => say("address copied"), () => say("in the address bar"));
  }

  isRunning() { return this.live ? this.live.running : this.player.playing; }
  togglePlay() { if (this.live) this.live.hold(this.live.running); else this.player.play(!this.player.playing); }
  step(count) { if (this.live) this.live.step(count); else this.player.step(count); }
  toStart() { if (this.live) this.live.restart(); else { this.player.play(false); this.player.goTo(0); } }
  setRate(rate) { this.player.rate = rate; if (this.live) this.live.send({ rate }); }
  scrubTo(index) { if (this.live) this.live.hold(true); this.player.play(false); this.player.goTo(index); }
  seek(time) { this.scrubTo(nearest(this.player.lead.frames, time)); }

  fit() {
    this.picture.fit();
    this.dirty();
  }

  follow(body) {
    this.picture.camera.followed = body;
    this.dirty();
  }

  /** Prepares a film: shows the picture alone, at its start, with these marks, magnified by `zoom`. */
  film(marks, zoom) {
    document.body.classList.add("film");
    for (const mark of marks) this.picture.shown[mark] = true;
    this.scrubTo(0);
    this.resize();
    this.fit();
    const { eye, orbit } = this.picture.camera;
    eye.position.sub(orbit.target).divideScalar(zoom).add(orbit.target);
    orbit.update();
    this.dirty();
  }

  // For tests.

  get index() { return this.player.index; }
  get time() { return this.player.time; }
  get playing() { return this.isRunning(); }
  get count() { return this.player.count; }
  drawnAt(body, run = 0) { return this.picture.parts[run].bodies.drawnAt(body); }
  ghostAt(body, run = 0) { return this.picture.parts[run].ghosts.drawnAt(body); }
  drawn(run = 0) { return this.picture.parts[run].bodies.count(); }
  project(body, run = 0) { return this.picture.project(this.drawnAt(body, run), run); }

  /** Returns the pictures drawn per second, where each is complete before the next begins. */
  measure(pictures = 20) {
    const gl = this.picture.renderer.getContext(), pixel = new Uint8Array(4), start = performance.now();
    for (let k = 0; k < pictures; ++k) {
      this.picture.draw(this.runs.map((run) => run.frames[k % run.frames.length]));
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    }
    this.dirty();
    return 1000 * pictures / (performance.now() - start);
  }
}

/** Returns the time in a link such as film.html#t=1.25, limited to the run; null if the address has none. */
function momentAsked(run) {
  const found = /^#t=([0-9.]+)$/.exec(location.hash);
  return found ? clamp(Number(found[1]), run.frames[0].time, lastOf(run.frames).time) : null;
}

/** Writes the text above the picture. */
function describe(runs) {
  const { header } = runs[0], by = (id) => document.getElementById(id);
  by("scene").textContent = (header.scene || "").replaceAll("_", " ");
  by("summary").textContent = header.summary || "";
  by("answer").textContent = header.answer ? `The answer: ${header.answer}` : "";
  by("method").textContent = methodLine(header);
  document.title = `${header.scene || "recording"} · spook`;
}

function methodLine(header) {
  const { method, mine } = header, said = [];
  if (method.h) said.push(`h = ${inUnit(method.h, "s")}`);
  if (method.substeps > 1) said.push(`${method.substeps} substeps`);
  if (method.solver && method.solver !== "none") said.push(method.solver.replaceAll("_", " "));
  if (method.soft_steps) said.push(`soft steps of ${method.soft_steps} substeps`);
  if (method.iterations) said.push(`at most ${method.iterations} iterations`);
  if (method.warm_start) said.push("warm start");
  if (mine && mine.length) said.push(`yours: ${mine.join(", ")}`);
  return said.join(" · ");
}

window.viewer = new Viewer();
window.viewer.open();
