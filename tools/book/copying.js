"use strict";
// Adds a button that copies each piece of code. If the page may not use the clipboard, the button selects the code.
(() => {
  const SAID = 1500; // time for which the button shows its result [ms]

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
