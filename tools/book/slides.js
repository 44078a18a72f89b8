"use strict";
// Shows the slides of ./course slides one at a time, by keys or taps, with notes below or in a separate window.
const slides = [...document.querySelectorAll("section")];
const last = slides.length - 1;
let now = 0;
let notes = null;

function show(k, answered = false) {
  slides[now].classList.remove("now", "answered");
  now = Math.min(Math.max(k, 0), last);
  slides[now].classList.add("now");
  slides[now].classList.toggle("answered", answered);
  history.replaceState(null, "", `#${slides[now].id}`);
  tell();
}

function forward() {
  const hides = slides[now].querySelector(".answer") && !slides[now].classList.contains("answered");
  show(hides ? now : now + 1, hides);
}

function title(k) {
  return k > last ? "the end" : slides[k].querySelector("h1, h2").textContent;
}

function tell() {
  if (!notes || notes.closed) return;
  const answer = slides[now].querySelector(".answer");
  const page = notes.document;
  page.title = `${now + 1} of ${slides.length}`;
  page.body.innerHTML = `<p><strong>${now + 1} of ${slides.length}: ${title(now)}</strong> · then: ${title(now + 1)}</p>`;
  if (answer) page.body.append(page.importNode(answer, true));
  page.body.append(page.importNode(slides[now].querySelector("aside"), true));
}

function openNotes() {
  notes = window.open("", "notes", "width=760,height=900");
  if (!notes) return;
  for (const style of document.querySelectorAll("style")) notes.document.head.append(notes.document.importNode(style, true));
  notes.document.body.className = "noted";
  notes.onkeydown = onkeydown;
  tell();
}

function onkeydown(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const does = {
    ArrowRight: forward, PageDown: forward, " ": forward, Enter: forward,
    ArrowLeft: () => show(now - 1, true), PageUp: () => show(now - 1, true), Home: () => show(0), End: () => show(last),
    n: () => document.body.classList.toggle("noted"), s: openNotes, f: () => document.documentElement.requestFullscreen(),
  }[event.key];
  if (!does) return;
  event.preventDefault();
  does();
}

// Reduces the type size of a slide until it fits.
function fit() {
  for (const slide of document.querySelectorAll(".slide")) {
    const body = slide.querySelector(".body");
    let size = 1;
    const isTooLarge = () => body.scrollHeight > body.clientHeight + 1 || body.scrollWidth > body.clientWidth + 1 ||
      [...body.querySelectorAll(".formula")].some((formula) => formula.scrollWidth > formula.clientWidth + 1);
    while (size > 0.4 && isTooLarge()) slide.style.setProperty("--fit", String(size -= 0.05));
  }
}

window.onkeydown = onkeydown;
document.onclick = (event) => {
  if (!document.body.classList.contains("noted") && !event.target.closest("details")) forward();
};
document.fonts.ready.then(() => {
  fit();
  document.body.classList.add("showing");
  show(Number(location.hash.slice(1) || 1) - 1);
});
