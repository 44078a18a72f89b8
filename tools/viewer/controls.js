"use strict";
// Buttons, switches and keys.

const SWITCHES = [
  ["contacts", "contacts", "contact points and normals"],
  ["impulses", "impulses", "impulse of each contact, as an arrow on its second body"],
  ["friction", "friction limits", "the cone or the box that an impulse has to stay in"],
  ["velocities", "velocities", "velocity of each body"],
  ["pairs", "pairs", "lines between bodies in contact"],
  ["colours", "colours", "lines between bodies in contact; lines of one colour have no body in common (chapter 14)"],
  ["paths", "paths", "the way that bodies have come"],
  ["ghosts", "answer", "where the answer says the bodies should be"],
];

class Controls {
  constructor(viewer) {
    this.viewer = viewer;
    const { player } = viewer, by = (id) => document.getElementById(id);
    this.play = by("play");
    this.scrub = by("scrub");
    this.now = by("now");
    this.play.onclick = () => viewer.togglePlay();
    by("back").onclick = () => viewer.step(-1);
    by("next").onclick = () => viewer.step(1);
    by("start").onclick = () => viewer.toStart();
    by("loop").onclick = (event) => { player.loop = !player.loop; pressed(event.currentTarget, player.loop); };
    pressed(by("loop"), player.loop);
    by("moment").onclick = () => {
      location.replace(`#t=${Number(player.time.toPrecision(6))}`);
      viewer.flashMoment();
    };
    this.scrub.oninput = () => viewer.scrubTo(Number(this.scrub.value));
    this.speed = by("speed");
    this.speed.append(...SPEEDS.map((rate) => element("option", {
      value: rate, textContent: rate < 1 ? `1/${1 / rate} ×` : `${rate} ×`, selected: rate === 1 })));
    this.speed.onchange = () => viewer.setRate(Number(this.speed.value));
    by("fit").onclick = () => viewer.fit();
    document.addEventListener("keydown", (event) => this.key(event));
    // After a click on a button, keys still control the player.
    document.addEventListener("click", ({ detail, target }) => {
      if (detail && target.tagName === "BUTTON") target.blur();
    });
  }

  /** Shows a switch for each kind of mark that the runs contain. */
  show(runs) {
    const { picture } = this.viewer, has = whatIsThere(runs);
    const box = document.getElementById("switches");
    box.replaceChildren(...SWITCHES.filter(([key]) => has[key]).map(([key, text, title]) =>
      this.toggle(key, text, title, () => picture.shown[key], (on) => { picture.shown[key] = on; })));
    if (has.impulses || has.velocities) box.append(this.arrowScale());
    box.append(this.tints());
    if (runs.length > 1)
      box.append(this.toggle("overlaid", "in one picture", "laid over each other, not side by side",
                             () => picture.shown.overlaid, (on) => this.rebuildWith({ overlaid: on })));
  }

  toggle(key, text, title, get, set) {
    const button = element("button", { id: `show-${key}`, textContent: text, title });
    button.dataset.key = key;
    pressed(button, get());
    button.onclick = () => { set(!get()); pressed(button, get()); this.viewer.dirty(); };
    return button;
  }

  tints() {
    const { shown } = this.viewer.picture;
    const select = element("select", { id: "tint", title: "what the colour of a body tells" }, ...TINTS.map(
      ([value, textContent]) => element("option", { value, textContent, selected: value === shown.tint })));
    select.onchange = () => { shown.tint = select.value; this.viewer.dirty(); };
    return select;
  }

  arrowScale() {
    const { shown } = this.viewer.picture;
    const slider = element("input", { type: "range", min: -2, max: 2, step: 0.05, value: Math.log10(shown.scale),
                                      title: "length of arrows, at a fixed scale", id: "arrow-scale" });
    slider.oninput = () => { shown.scale = 10 ** Number(slider.value); this.viewer.dirty(); };
    slider.hidden = shown.automatic;
    const title = "on: the largest impulse of each frame has the same length; off: one scale for all frames";
    const button = this.toggle("automatic", "arrows fit", title, () => shown.automatic, (on) => {
      slider.hidden = on;
      this.rebuildWith({ automatic: on });
    });
    this.scaling = element("span", { className: "together" }, button, slider);
    return this.scaling;
  }

  rebuildWith(changed) {
    Object.assign(this.viewer.picture.shown, changed);
    this.viewer.rebuild();
  }

  /** Updates the controls to the present state. */
  update() {
    const { player } = this.viewer, running = this.viewer.isRunning();
    this.play.dataset.playing = running;
    this.play.title = running ? "pause (space)" : "play (space)";
    this.play.setAttribute("aria-label", this.play.title);
    this.scrub.max = Math.max(0, player.count - 1);
    this.scrub.value = player.index;
    const { shown } = this.viewer.picture;
    if (this.scaling) this.scaling.hidden = !(shown.impulses || shown.friction || shown.velocities);
    this.now.textContent = player.count ? `${player.time.toFixed(3)} s · frame ${player.index}` : "";
  }

  key(event) {
    const { target } = event;
    if (event.altKey || event.ctrlKey || event.metaKey || target.tagName === "SELECT") return;
    if (target.tagName === "INPUT" && target !== this.scrub) return;
    const { viewer } = this, many = event.shiftKey ? 10 : 1;
    const action = {
      " ": () => viewer.togglePlay(), ArrowRight: () => viewer.step(many), ArrowLeft: () => viewer.step(-many),
      Home: () => viewer.toStart(), End: () => viewer.scrubTo(viewer.player.count - 1),
      ArrowUp: () => this.changeSpeed(1), ArrowDown: () => this.changeSpeed(-1),
    }[event.key];
    if (!action || (event.key === " " && target.tagName === "BUTTON")) return;
    event.preventDefault();
    action();
  }

  setSpeed(rate) {
    this.speed.value = String(rate);
    this.viewer.setRate(rate);
  }

  changeSpeed(by) {
    this.speed.selectedIndex = clamp(this.speed.selectedIndex + by, 0, SPEEDS.length - 1);
    this.viewer.setRate(Number(this.speed.value));
  }
}

function whatIsThere(runs) {
  const any = (test) => runs.some((run) => run.live || run.frames.some(test));
  const contacts = any((frame) => frame.contacts.length > 0);
  const shaped = runs.some((run) => run.header.bodies.some((body) => body.shape !== "point"));
  const there = contacts && (shaped || runs.some((run) => !run.live));
  return { contacts: there, impulses: there, pairs: there, colours: there, velocities: any((frame) => frame.v),
           friction: there && runs.some((run) => run.header.parameters.mu > 0 || run.header.parameters.friction > 0),
           paths: runs.every(hasPaths),
           ghosts: any((frame) => frame.ghostBodies.length > 0) || runs.some((run) => run.header.curves.length > 0) };
}

function pressed(button, on) {
  button.setAttribute("aria-pressed", on);
}
