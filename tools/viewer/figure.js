"use strict";
// The viewer as a lesson's live figure: a frame in the lesson's page. The address says what runs, as JSON behind #:
//   scene, set        what is run, and what is set at first
//   controls          names of those that the reader may turn
//   graph             error, energy, residual, or a column of the scene's own numbers; without one there is a picture alone
//   rate, shows       simulated seconds a second; marks that are on, as `contacts`
// The page around tells it to pause while it is out of sight.

class Figure {
  constructor(viewer) {
    this.viewer = viewer;
    Object.assign(this, { set: {}, controls: [], shows: [], rate: 1, seen: true },
                  JSON.parse(decodeURIComponent(location.hash.slice(1))));
    document.body.classList.add("figure");
    document.body.classList.toggle("bare", !this.graph);
    for (const mark of this.shows) viewer.picture.shown[mark] = true;
    window.addEventListener("message", ({ source, data }) => {
      if (source === window.parent && typeof data.seen === "boolean") this.see(data.seen);
    });
  }

  /** A run that its reader has paused stays so when it comes into sight again. */
  see(seen) {
    const { live } = this.viewer;
    if (seen === this.seen) return;
    this.seen = seen;
    if (!seen) this.ran = live.running;
    if (this.ran) live.hold(!seen);
  }

  controlsOf(all) {
    return this.controls.map((name) => all.find((control) => control.name === name)).filter(Boolean);
  }

  /** Of the graph that the lesson speaks of, as quantities() has it. */
  keyOf(header) {
    return header.columns.includes(this.graph) ? "sample" : this.graph;
  }

  begun(header) {
    this.viewer.column = Math.max(0, header.columns.indexOf(this.graph));
    window.parent.postMessage({ begun: true }, "*");
  }

  lost(why) {
    window.parent.postMessage({ lost: why }, "*");
  }
}
