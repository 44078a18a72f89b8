"use strict";
// Handles the contents on a small screen, folded text, and links to headings.
(() => {
  const menu = document.getElementById("menu");
  const contents = document.getElementById("contents");

  function open(yes) {
    document.body.classList.toggle("menu-open", yes);
    menu.setAttribute("aria-expanded", String(yes));
  }
  menu.addEventListener("click", () => open(!document.body.classList.contains("menu-open")));
  contents.addEventListener("click", (event) => { if (event.target.closest("a")) open(false); });
  document.addEventListener("keydown", (event) => { if (event.key === "Escape") open(false); });
  const current = contents.querySelector("[aria-current]");
  if (current) contents.scrollTop = current.offsetTop - contents.clientHeight / 3;

  // Marks the present section: the last one whose heading has passed the upper third of the window.
  const headingOf = (link) => document.getElementById(decodeURIComponent(link.hash.slice(1)));
  const entries = [...contents.querySelectorAll("ol a")].map((link) => ({ link, heading: headingOf(link) }))
    .filter((entry) => entry.heading);
  let marked = null;
  function markSection() {
    const passed = entries.filter(({ heading }) => heading.getBoundingClientRect().top < innerHeight / 3);
    const atEnd = innerHeight + scrollY >= document.documentElement.scrollHeight - 2;
    const now = (atEnd ? entries : passed).at(-1)?.link || null;
    if (now === marked) return;
    if (marked) marked.removeAttribute("aria-current");
    if (now) now.setAttribute("aria-current", "location");
    marked = now;
    if (!now) return;
    const { offsetTop: top } = now, { scrollTop, clientHeight } = contents;
    if (top < scrollTop || top > scrollTop + clientHeight - 60) contents.scrollTop = top - clientHeight / 2;
  }
  addEventListener("scroll", markSection, { passive: true });
  addEventListener("resize", markSection);
  markSection();

  // Unfolds the target of a link.
  function unfold() {
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    for (let at = target; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    target.scrollIntoView();
  }
  addEventListener("hashchange", unfold);
  if (location.hash) addEventListener("load", unfold);

  // Unfolds everything for printing.
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open])")];
    for (const details of folded) details.open = true;
  });
  addEventListener("afterprint", () => { for (const details of folded) details.open = false; });

  for (const heading of document.querySelectorAll("article :is(h2, h3, h4)[id]")) {
    const link = document.createElement("a");
    link.className = "anchor";
    link.href = `#${heading.id}`;
    link.setAttribute("aria-label", `link to ${heading.textContent}`);
    heading.append(link);
  }
})();
