"use strict";
// Shows a clicked figure in its full size, over the page. Without this script the link leads to the file.
(() => {
  const dialog = document.createElement("dialog");
  dialog.id = "large";
  dialog.setAttribute("aria-label", "figure in its own size");
  const close = document.createElement("button");
  close.textContent = "close";
  close.addEventListener("click", () => dialog.close());
  const place = document.createElement("div");
  dialog.append(place, close);
  document.body.append(dialog);

  document.addEventListener("click", (event) => {
    const link = event.target.closest("figure.picture > a");
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
    const image = link.querySelector("img").cloneNode();
    image.loading = "eager";
    const card = document.createElement("span");
    card.className = "card";
    card.append(image);
    place.replaceChildren(card);
    dialog.showModal();
    event.preventDefault();
  });
  place.addEventListener("click", (event) => { if (event.target === place) dialog.close(); });
})();
