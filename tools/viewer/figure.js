"use strict";
// The viewer as a live figure of a lesson, in an iframe. The address holds its settings as JSON behind #:
//   scene, set        the scene and its initial parameters
//   controls          names of the parameters that the reader may change
//   graph             error, energy, residual, or a column of the scene's own numbers. Default: no graph
//   beside            parameters of a second run, which is shown beside the first and has the same controls. A control
//                     of one of these parameters changes the first run alone
//   rate, shows       simulated seconds per second; marks that are shown, such as `contacts`
//   lasts             seconds after which the run begins again. Default: it goes on
// The lesson's page pauses the figure while it is out of sight.

class Figure {
  constructor(viewer) {
    this.viewer = viewer;
    Object.assign(this, { set: {}, controls: [], shows: [], rate: 1, seen: true, beside: null, lasts: 0 },
                  JSON.parse(decodeURIComponent(location.hash.slice(1))));
    document.body.classList.add("figure");
    document.body.classList.toggle("bare", !this.graph);
    for (const mark of this.shows) viewer.picture.shown[mark] = true;
    window.addEventListener("message", ({ source, data }) => {
      if (source === window.parent && typeof data.seen === "boolean") this.see(data.seen);
    });
  }

  /** Returns the sides of the figure: one run, or two with labels that follow their parameters. */
  sides() {
    const { scene, set, rate, beside } = this, opened = { scene, set, rate };
    if (!beside) return [new Side(new WorkerTransport(opened))];
    const names = Object.keys(beside), other = { scene, set: { ...set, ...beside }, rate };
    return [new Side(new WorkerTransport(opened), names), new Side(new WorkerTransport(other), names, names)];
  }

  /** Pauses a run out of sight and continues it in sight, unless the reader has paused it. */
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

  /** Returns the key, in quantities(), of the graph that the lesson discusses. */
  keyOf(header) {
    return header.columns.includes(this.graph) ? "sample" : this.graph;
  }

  begun(header) {
    this.viewer.column = Math.max(0, header.columns.indexOf(this.graph));
    window.parent.postMessage({ begun: true, summary: header.summary }, "*");
  }

  lost(why) {
    window.parent.postMessage({ lost: why }, "*");
  }
}
