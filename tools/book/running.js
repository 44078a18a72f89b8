"use strict";
// Live figures: the engine replaces a film when it comes into view, and pauses out of sight. At most two figures run; a
// third replaces the one that started first. Without this script, and on paper, the film stays.
(() => {
  const MOST = 2, SEEN = 0.3;  // running figures; part of a figure that counts as seen
  const seen = [];  // running figures, in the order in which they started
  const films = [...document.querySelectorAll("figure[data-live]")];
  if (!films.length) return;

  /** Loads the live figure, which stays hidden until its first picture. */
  function load(figure) {
    const frame = document.createElement("iframe");
    frame.title = `${figure.querySelector("img").alt}, running`;
    frame.src = `${window.bookRoot}assets/live.html#${encodeURIComponent(figure.dataset.live)}`;
    figure.prepend(frame);
    figure.frame = frame;
  }

  function say(figure, text) {
    const line = figure.querySelector(".says") || document.createElement("p");
    line.className = "says";
    line.textContent = text;
    figure.insertBefore(line, figure.querySelector("figcaption"));
  }

  function tell() {
    const running = document.hidden ? [] : seen.slice(-MOST);
    for (const figure of films) {
      if (!figure.frame && !figure.lost && running.includes(figure)) load(figure);
      if (figure.begun) figure.frame.contentWindow.postMessage({ seen: running.includes(figure) }, "*");
    }
  }

  window.addEventListener("message", ({ source, data }) => {
    const figure = films.find((film) => film.frame && film.frame.contentWindow === source);
    if (!figure) return;
    if (data.begun) {
      figure.begun = true;
      figure.classList.add("running");
      say(figure, figure.dataset.says);
      tell();
    } else if (data.lost) {
      figure.lost = true;
      figure.begun = false;
      figure.classList.remove("running");
      figure.frame.remove();
      figure.frame = null;
      say(figure, `${data.lost} The film is shown instead.`);
    }
  });
  document.addEventListener("visibilitychange", tell);

  const observer = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      const at = seen.indexOf(target);
      if (at >= 0) seen.splice(at, 1);
      if (isIntersecting) seen.push(target);
    }
    tell();
  }, { threshold: SEEN });
  for (const film of films) observer.observe(film);
})();
