"use strict";
// The player: chooses the frame of each run that is shown. Runs share one clock; the longest run sets its end.

const SPEEDS = [...Array.from({ length: 12 }, (_, k) => 2 ** (k - 12)), 1, 2, 4];
const SEEN = 2;  // least duration of a film at the default speed [s]

/** Returns the default speed: real time, or slow motion for a short run. */
function rateFor(run) {
  const lasts = lastOf(run.frames).time - run.frames[0].time;
  return lasts > 0 ? [...SPEEDS].reverse().find((rate) => rate <= 1 && lasts / rate >= SEEN) || SPEEDS[0] : 1;
}

class Player {
  constructor(changed) {
    Object.assign(this, { changed, runs: [], index: 0, time: 0, playing: false, rate: 1, loop: true });
  }

  show(runs) {
    this.runs = runs;
    const end = (run) => lastOf(run.frames).time;
    this.lead = runs.reduce((best, run) => end(run) > end(best) + 1e-9 ? run : best, runs[0]);
    this.goTo(0);
  }

  get count() {
    return this.lead ? this.lead.frames.length : 0;
  }

  goTo(index) {
    this.index = clamp(Math.round(index), 0, this.count - 1);
    this.time = this.clock = this.lead.frames[this.index].time;
    this.changed();
  }

  seek(time) {
    this.goTo(nearest(this.lead.frames, time));
  }

  step(count) {
    this.play(false);
    this.goTo(this.index + count);
  }

  play(on) {
    if (on && !this.playing && this.index === this.count - 1) this.goTo(0);
    this.playing = on;
    this.changed();
  }

  /** Advances the clock by this many real seconds. */
  advance(seconds) {
    if (!this.playing) return;
    this.clock += Math.min(seconds, 0.25) * this.rate;
    const { frames } = this.lead;
    if (this.clock > lastOf(frames).time + 0.5 * (this.lead.header.frame_time || 0)) {
      if (this.loop) return this.goTo(0);
      this.goTo(this.count - 1);
      return this.play(false);
    }
    const index = nearest(frames, this.clock);
    if (index === this.index) return;
    this.index = index;
    this.time = frames[index].time;
    this.changed();
  }

  frameOf(run) {
    return run.frames[run === this.lead ? this.index : nearest(run.frames, this.time)];
  }

  frames() {
    return this.runs.map((run) => this.frameOf(run));
  }
}
