"use strict";
// The quantities of the graphs: each has a name, a unit, and lines of values over time.

const KINDS = ["motion", "turning", "weight", "field", "springs"];

/** Returns the speed below which velocities of these runs are round-off [m/s]. */
function leastSpeed(runs) {
  const fastest = Math.max(0, ...runs.map((run) => run.live ? 1 : Math.max(0, ...run.frames.map((frame) =>
    largestOf(velocitiesOf(frame))))));
  return 1e-14 * (fastest > 0 && Number.isFinite(fastest) ? fastest : 1);
}

const LEAST_ERROR = 1e-15;  // smaller errors, relative or of an angle, are round-off

/** Returns the size below which values of this unit are round-off; undefined if it is not known. */
function leastOf(unit, runs) {
  if (unit === "m/s") return leastSpeed(runs);
  return unit === "relative" || unit === "rad" ? LEAST_ERROR : undefined;
}

/** Returns the unit in a column's name, such as `v [m/s]`. */
const unitIn = (column) => (/\[(.+)\]$/.exec(column) || ["", ""])[1];

const totalOf = (values) => values.reduce((sum, value) => sum + (value === null ? NaN : value), 0);
const energyOf = (frame) => totalOf(Object.values(frame.energy));

/** Returns the graphs of these runs: a line per run, or the parts of a single run. `column` selects a sample's column.
 *  With `only`, returns the graph of this key alone, even without values. */
function quantities(runs, column, only = "") {
  const { header } = runs[0], name = header.error.name || "error", alone = runs.length === 1;
  const title = header.columns[column] || "";
  const each = (valueOf) => runs.map((run, k) => ({ name: run.label, run, colour: k, valueOf }));
  const parts = (names, valueOf, total) => [
    { name: "total", run: runs[0], colour: 0, valueOf: total },
    ...names.map((part, k) => ({ name: part, run: runs[0], colour: k + 1, valueOf: (frame) => valueOf(frame, part) }))];
  const kinds = KINDS.filter((kind) => runs[0].frames.some((frame) => frame.energy[kind]));
  const lists = [
    { key: "error", title: `Error: ${name}`, unit: header.error.unit, least: leastOf(header.error.unit, runs),
      lines: each((frame) => frame.error) },
    { key: "energy", title: "Energy", unit: "J",
      lines: alone ? parts(kinds, (frame, kind) => frame.energy[kind], energyOf) : each(energyOf) },
    { key: "residual", title: "Residual", unit: "m/s", least: leastOf("m/s", runs),
      lines: each((frame) => frame.residual) },
    { key: "sample", title, unit: "", columns: header.columns,
      least: unitIn(title) === "m/s" ? leastOf("m/s", runs) : undefined, lines: each((frame) => frame.sample[column]) },
    { key: "us", title: "Time a step", unit: "µs", floor: 0,
      lines: alone ? parts(header.stages, (frame, stage) => frame.us[header.stages.indexOf(stage)],
                           (frame) => frame.us.length ? totalOf(frame.us) : NaN)
        : each((frame) => frame.us.length ? totalOf(frame.us) : NaN) },
  ];
  if (only) return lists.filter((list) => list.key === only);
  // A run that solves nothing has residuals of 0, which need no graph.
  const solved = runs.some((run) => run.live || run.frames.some((frame) => frame.residual > 0));
  return lists.filter((list) => list.key !== "residual" || solved).filter((list) => list.lines.some(hasNumbers));
}

const hasNumbers = (line) => line.run.frames.some((frame) => isNumber(line.valueOf(frame)));
const isNumber = (value) => typeof value === "number" && Number.isFinite(value);
