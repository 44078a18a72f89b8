"use strict";
// Reads [{tex, display}] and writes [{html} or {error}], with KaTeX from the given file.
const katex = require(process.argv[2]);
const formulas = JSON.parse(require("fs").readFileSync(0, "utf8"));

// Formulas may contain characters such as λ and ⁻¹.
const strict = (code) => (code === "unicodeTextInMathMode" || code === "mathVsTextUnits" ? "ignore" : "error");

function render({ tex, display }) {
  try {
    return { html: katex.renderToString(tex, { displayMode: display, throwOnError: true, strict }) };
  } catch (error) {
    return { error: error.message };
  }
}

process.stdout.write(JSON.stringify(formulas.map(render)));
