"use strict";
// Unpacks the large parts of a page, which are gzip in base64, with the browser's DecompressionStream.

/** Yields the text of an element that holds gzip in base64, in pieces. */
async function* unpacked(element) {
  const bytes = bytesOf(element.textContent.trim());
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))
    .pipeThrough(new TextDecoderStream());
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return;
    yield value;
  }
}

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

/** Runs the libraries of the page in order. */
async function loadLibraries() {
  for (const element of document.querySelectorAll("script[data-library]")) {
    const script = document.createElement("script");
    let text = "";
    for await (const piece of unpacked(element)) text += piece;
    script.textContent = text;
    document.head.append(script);
  }
}
