"use strict";
// Shows the equation of a reference such as (4.10), or the glossary entry of a term, beside it.
(() => {
  const GAP = 8; // pixels from the reference, and from the window's edges
  let shown = null;

  function preview(tag) {
    const here = document.getElementById(`eq-${tag}`);
    if (here) return here.querySelector(".formula").cloneNode(true);
    const template = document.getElementById(`preview-${tag}`);
    return template && template.content.cloneNode(true);
  }

  function place(box, reference) {
    const at = reference.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = box;
    const left = Math.min(at.left, document.documentElement.clientWidth - width - GAP);
    const above = at.top - height - GAP;
    box.style.left = `${Math.max(GAP, left)}px`;
    box.style.top = `${above > GAP ? above : at.bottom + GAP}px`;
  }

  function hide() {
    if (!shown) return;
    shown.reference.removeAttribute("aria-describedby");
    shown.box.remove();
    shown = null;
  }

  function show(reference) {
    if (shown && shown.reference === reference) return;
    hide();
    const content = preview(reference.dataset.tag);
    if (!content) return;
    const box = document.createElement("div");
    box.id = "preview";
    box.setAttribute("role", "tooltip");
    box.append(content);
    document.body.append(box);
    reference.setAttribute("aria-describedby", box.id);
    place(box, reference);
    shown = { box, reference };
  }

  const reference = (event) => event.target.closest && event.target.closest("a.eqref, a.term");
  document.addEventListener("mouseover", (event) => {
    if (reference(event)) show(reference(event));
    else if (shown && !shown.box.contains(event.target)) hide();
  });
  document.addEventListener("focusin", (event) => (reference(event) ? show(reference(event)) : hide()));
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") hide(); });
  document.addEventListener("scroll", () => { if (shown) place(shown.box, shown.reference); }, { passive: true });
})();
