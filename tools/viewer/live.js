"use strict";
// A live run: receives frames and sends commands through one of transports.js.

const KEPT = 1200;      // past frames that remain available
const GROWN = 1.1;      // growth of the bodies' box after which the view is fitted again, unless the run was touched
const FARTHEST = 4;     // largest size that is still fitted, over the first size
const GRAPHS_EVERY = 150;  // [ms]

class Live {
  constructor(viewer, transport, figure = null) {
    this.viewer = viewer;
    this.transport = transport;
    this.figure = figure;
    this.running = true;
    this.sent = Promise.resolve();
    document.body.classList.add("live");
    document.getElementById("drop").onclick = () => this.drop();
    document.getElementById("reset").onclick = () => this.reset();
    document.getElementById("next").title = "next step (right)";
    transport.open((line) => this.take(line), (why) => this.lose(why));
  }

  lose(why) {
    this.viewer.say(why);
    if (this.figure && why) this.figure.lost(why);
  }

  take(line) {
    try {
      if ("said" in line) this.show(line.said);
      else if ("clock" in line) this.takeClock(line.clock);
      else if ("refused" in line) this.flash(`Refused: ${line.refused}`);
      else if ("end" in line) this.viewer.say(endOf(line));
      else if ("format" in line) this.header(line);
      else this.frame(frameOf(line, this.pending || this.run.header));
    } catch (error) {
      this.flash(`A line of the run cannot be read: ${error.message}.`);
    }
  }

  /** Restores the clock after the page was reloaded. */
  takeClock({ pause, rate }) {
    this.running = !pause;
    const { speed } = this.viewer.controls;
    speed.value = String(rate);
    this.viewer.dirty();
  }

  /** Shows the messages of a build until a run continues. */
  show(text) {
    const box = document.getElementById("said");
    box.textContent = text;
    box.hidden = !text;
  }

  flash(text) {
    this.viewer.say(text);
    clearTimeout(this.flashing);
    this.flashing = setTimeout(() => this.viewer.say(""), 5000);
  }

  /** Keeps a header until its first frame arrives. */
  header(line) {
    this.pending = checkedHeader(line);
  }

  frame(frame) {
    if (this.pending) this.begin(frame);
    const { frames } = this.run;
    if (frames.length && frame.time < lastOf(frames).time) frames.length = 0;
    frames.push(frame);
    if (frames.length > KEPT) frames.splice(0, frames.length - KEPT);
    this.viewer.player.goTo(frames.length - 1);
    document.body.classList.toggle("touched", Boolean(frame.touched));
    this.refresh();
  }

  begin(frame) {
    const header = this.pending, first = !this.run;
    this.pending = null;
    // After a drop the graphs keep their past; after a restart they begin again.
    const more = first ? 0 : header.bodies.length - this.run.header.bodies.length;
    const before = first || more < 0 || frame.time < lastOf(this.run.frames).time ? [] : this.run.frames;
    const same = !first && more === 0;
    this.run = { header, frames: [...before, frame], notice: "", label: "", live: true };
    if (first && this.figure) this.figure.begun(header);
    this.viewer.show([this.run], same || before.length > 0 || frame.touched);
    this.run.frames.pop();  // frame() adds it
    if (!before.length) this.firstSize = this.viewer.picture.box.size;
    if (first) this.first = header.controls || [];
    this.makeSliders(header.controls || []);
    document.getElementById("reset").hidden = Object.keys(this.changed()).length === 0;
  }

  /** Redraws the graphs at intervals, and fits the view unless the reader has turned it. */
  refresh() {
    const now = performance.now(), { viewer } = this;
    if (now - (this.refreshed || 0) < GRAPHS_EVERY) return;
    this.refreshed = now;
    for (const graph of viewer.graphs) graph.prepare();
    const last = lastOf(this.run.frames);
    if (!viewer.picture.camera.untouched() || last.touched) return;
    const box = boundsOf([this.run]), left = box.size >= FARTHEST * this.firstSize;
    if (box.size > GROWN * viewer.picture.box.size && !left) {
      viewer.picture.show([this.run]);
      viewer.legend.show(viewer.picture);
    }
    // A figure has no button to fit the view, so it restarts when its bodies leave. A lost run stays and is reported.
    if (left && this.figure && last.state !== "lost") this.send({ restart: true });
  }

  makeSliders(controls) {
    const parent = document.getElementById("sliders");
    if (parent.contains(document.activeElement)) return;
    parent.replaceChildren(...this.shownOf(controls).map((control) => controlNode(control, (value) =>
      this.send({ set: { [control.name]: value } }))));
  }

  shownOf(controls) {
    return this.figure ? this.figure.controlsOf(controls) : controls;
  }

  /** Returns the first values of all controls that have changed since the page was opened. */
  changed() {
    const first = new Map(this.first.map((control) => [control.name, control.value]));
    return Object.fromEntries(this.shownOf(this.run.header.controls || [])
      .filter(({ name, value }) => first.has(name) && first.get(name) !== value).map(({ name }) => [name, first.get(name)]));
  }

  /** Restores the first settings of the page and restarts. */
  reset() {
    const set = this.changed();
    document.activeElement.blur();  // so that the sliders follow
    if (Object.keys(set).length) this.send({ set });
    this.restart();
  }

  /** Sends commands one at a time, in order. */
  send(command) {
    this.sent = this.sent.then(() => this.transport.send(command));
    return this.sent;
  }

  hold(on) {
    this.running = !on;
    this.viewer.dirty();
    return this.send({ pause: on });
  }

  /** Steps the engine forwards, or shows earlier frames. */
  step(count) {
    const { player } = this.viewer;
    if (this.running) this.hold(true);
    if (count > 0 && player.index === player.count - 1) this.send({ step: count });
    else player.goTo(player.index + count);
  }

  restart() {
    this.running = true;
    this.send({ restart: true });
    return this.send({ pause: false });
  }

  pull(hit, to) {
    this.viewer.picture.hand = { body: hit.body, local: hit.local, to };
    this.viewer.dirty();
    this.wanted = { pull: { body: hit.body, point: hit.local, to } };
    if (!this.pulling) this.sendPulls();
  }

  /** Sends the latest place of the pointer; the places that it passes during a request are skipped. */
  async sendPulls() {
    this.pulling = true;
    while (this.wanted) {
      const { wanted } = this;
      this.wanted = null;
      await this.send(wanted);
    }
    this.pulling = false;
  }

  release() {
    this.wanted = null;
    this.viewer.picture.hand = null;
    this.viewer.dirty();
    this.send({ release: true });
  }

  /** Pushes a body away from the eye. The impulse gives a mass of 1 kg a speed of the scene's size per second. */
  push(hit, eye) {
    const along = eye.getWorldDirection(new THREE.Vector3()).multiplyScalar(this.viewer.picture.box.size);
    this.send({ push: { body: hit.body, impulse: along.toArray() } });
  }

  drop() {
    const { box } = this.viewer.picture, like = this.run.header.bodies.find((body) => body.shape === "ball");
    const radius = like ? like.radius : 0.05 * box.size;
    this.send({ drop: { x: [box.centre.x, box.centre.y, box.high.z + 2 * radius], radius, mass: 1 } });
  }
}

/** Returns a control's name and meaning: the first part as text, all of it in the tooltip. */
function controlName({ name, meaning }) {
  const spoken = name.replaceAll("_", " ");
  const words = element("span", { className: "words", textContent: (meaning || "").split(";")[0] });
  return element("span", { className: "control", title: `${spoken}: ${meaning}` }, element("b", { textContent: spoken }),
                 " ", words);
}

function controlNode(control, send) {
  const label = element("label", {}, controlName(control));
  if (control.choices) {
    const select = element("select", { name: control.name }, ...control.choices.map((choice) => element("option", {
      value: JSON.stringify(choice), textContent: String(choice), selected: choice === control.value })));
    select.onchange = () => send(JSON.parse(select.value));
    label.append(select);
    return label;
  }
  const { low, high, logarithmic, whole, value } = control;
  const position = (number) =>
    logarithmic ? Math.log(number / low) / Math.log(high / low) : (number - low) / (high - low);
  const shown = element("output", { textContent: inUnit(value, control.unit) });
  const slider = element("input", { type: "range", name: control.name, min: 0, max: 1, step: "any",
                                    value: position(value) });
  slider.oninput = () => {
    const part = Number(slider.value);
    let chosen = logarithmic ? low * (high / low) ** part : low + part * (high - low);
    chosen = whole ? Math.round(chosen) : Number(chosen.toPrecision(3));
    chosen = clamp(chosen, low, high);
    shown.textContent = inUnit(chosen, control.unit);
    send(chosen);
  };
  label.append(slider, shown);
  return label;
}
