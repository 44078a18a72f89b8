"use strict";
// A button at each piece of code that copies it. A page from the file system may have no clipboard: then the code is
// selected, for the keyboard.
(() => {
  const SAID = 1500; // how long the button says what it did [ms]

  async function copy(code) {
    try {
      await navigator.clipboard.writeText(code.textContent.replace(/\n$/, ""));
      return "copied";
    } catch {
      getSelection().selectAllChildren(code);
      return document.execCommand("copy") ? "copied" : "selected";
    }
  }

  for (const box of document.querySelectorAll("article .code")) {
    const button = document.createElement("button");
    button.className = "copy";
    button.textContent = "copy";
    button.addEventListener("click", async () => {
      button.textContent = await copy(box.querySelector("code"));
      setTimeout(() => { button.textContent = "copy"; }, SAID);
    });
    box.append(button);
  }
})();
