"use strict";
// Colours: bodies are grey, and every other kind of mark has one colour everywhere.

const LIGHT = {
  paper: "#fbfbf9", body: "#868d97", mark: "#cdd1d6", edge: "#343a42", shade: "#000000", floor: "#eeeeeb",
  line: "#c9cbcd", impulse: "#d9480f", velocity: "#1273b8", ghost: "#2b8a3e", contact: "#1f2328", pair: "#7048e8",
  pull: "#c2255c", push: "#0b7285", rod: "#9299a1", curve: "#2b8a3e", path: "#b08900", hand: "#e8a100",
  runs: ["#868d97", "#4263eb", "#e67700", "#ae3ec9", "#099268", "#e03131"],
  lines: ["#1f2328", "#c92a2a", "#1971c2", "#2f9e44", "#e8590c", "#7048e8", "#0b7285"],
};
const DARK = {
  ...LIGHT,
  paper: "#16181c", body: "#9aa1ab", mark: "#565c66", edge: "#e4e7eb", floor: "#1f2227", line: "#3a3f46",
  impulse: "#ff8c4b", velocity: "#5cb3f0", ghost: "#56c26a", contact: "#f1f3f5", pair: "#a78bfa", pull: "#f06595",
  push: "#3bc9db", rod: "#757c86", curve: "#56c26a", path: "#d9b84a", hand: "#ffd43b",
  runs: ["#9aa1ab", "#7c93ff", "#ffb055", "#d885ec", "#38d9a9", "#ff8787"],
  lines: ["#f1f3f5", "#ff8787", "#74c0fc", "#69db7c", "#ffa94d", "#b197fc", "#3bc9db"],
};
const IN_THE_DARK = window.matchMedia("(prefers-color-scheme: dark)");

function palette() {
  return IN_THE_DARK.matches ? DARK : LIGHT;
}

const colourOf = (text) => new THREE.Color(text);
