"use strict";
// Runs scenes in the engine that pages have. Arguments: the script that em++ made, and steps a scene. Standard input:
// names of scenes, a line each. Standard output: a JSON object a line, with what the engine wrote for that scene.
const { readFileSync } = require("fs");
const { resolve } = require("path");

const [script, steps] = process.argv.slice(2);

// The page, too, hands the compiled engine over; em++'s own way of loading it breaks in newer versions of node.
require(resolve(script))({ wasmBinary: readFileSync(script.replace(/js$/, "wasm")) }).then((engine) => {
  const call = (name, text) => engine.ccall(`spook_${name}`, "string", ["string"], [text]);
  for (const scene of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
    call("open", JSON.stringify({ scene }));
    const text = ['{"pause": true}', '{"restart": true}', `{"step": ${steps}}`].map((line) => call("line", line)).join("");
    process.stdout.write(`${JSON.stringify({ scene, text })}\n`);
  }
});
